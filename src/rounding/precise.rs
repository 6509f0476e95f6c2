//! Doubles that are far nearer to some planes than to the point that they represent.
//!
//! Nearly coplanar facets have tetrahedra between them that are thinner than a unit in the last place: rounding moves their vertices
//! through each other's planes. Only the error across these planes does that; the error along them is harmless. Among the doubles within a
//! few units of a Steiner point there is one that lies a hundred to a thousand times nearer to a plane than the nearest double does: of the
//! (2r + 1)³ doubles within r units on each axis the best of n planes is off by some r^(1 − 3/n) / 3 units.
//!
//! Everything here is approximate: it chooses a position, and the caller tests tetrahedra exactly.
use crate::error::Error;
use crate::fallible;
use crate::predicates::Expansion;
use crate::rounding::candidates::Candidate;
use crate::rounding::{is_kept, is_positive, surviving, work, Repair};
use crate::vector::dot;
use rustc_hash::FxHashSet;

/// The extent of the search for one point.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// Other parameters on its segment.
    pub parameters: usize,
    /// Units in the last place on each axis.
    pub radius: i32,
}

/// Most exact tests of a star for other parameters: exact tests cost most. 4 and 16 change nothing on the only model measured whose points
/// have to move.
const MOST_TESTS: usize = 8;

impl Repair<'_> {
    /// Puts the implicit vertices of tetrahedra that are not positive, and of those that this spoils, nearest to the planes that they
    /// are close to; each once.
    pub(super) fn place_all(&mut self, bad: &mut Vec<u32>, reach: Reach) -> Result<(), Error> {
        let mut placed: FxHashSet<u32> = FxHashSet::default();
        let mut next = 0;
        while next < bad.len() {
            let t = bad[next];
            next += 1;
            self.work.control().look()?;
            for v in self.mesh.verts(t) {
                let spoilt = is_kept(self.mesh, t) && !is_positive(self.mesh, self.points, self.xyz, t);
                if self.work.is_done() {
                    break;
                }
                if !spoilt || self.points.is_explicit(v) || !fallible::add(&mut placed, v)? {
                    continue;
                }
                let start = self.mesh.vertex_tet[v as usize];
                self.search.vertex_star(self.mesh, v, start)?;
                self.place(v, reach)?;
                fallible::append(bad, &self.search.tets)?;
            }
        }
        self.keep_bad(bad);
        Ok(())
    }

    /// Puts `v`, whose star was searched, nearest to the planes of its link that it is close to.
    fn place(&mut self, v: u32, reach: Reach) -> Result<(), Error> {
        let at = *self.points.xyz(v);
        let unit = at.iter().fold(0.0, |m, &x| f64::max(m, unit_of(x)));
        let normals: Vec<[f64; 3]> =
            fallible::collect(self.planes(v, 64.0 * unit)?.iter().map(|p| p.normal))?;
        self.work.spend(cells(reach.radius, normals.len()));
        let here = nearest(self.error(v), at.map(unit_of), &normals, reach.radius);
        if reach.parameters > 0 {
            if let Some(candidate) = Candidate::of(self.points, self.segments, v) {
                let mut others: Vec<(f64, f64)> = fallible::reserved(reach.parameters)?;
                for t in candidate.nearby_parameters()?.into_iter().take(reach.parameters) {
                    self.work.spend(work::MOVE + cells(reach.radius, normals.len()));
                    self.points.move_on_segment(v, candidate.ends, &Expansion::from(t))?;
                    let at = self.points.xyz(v).map(unit_of);
                    let off = nearest(self.error(v), at, &normals, reach.radius).1;
                    if off < 0.5 * here.1 {
                        fallible::push(&mut others, (off, t))?;
                    }
                }
                fallible::stable_sort_by(&mut others, |x, y| x.0.total_cmp(&y.0))?;
                for &(_, t) in others.iter().take(MOST_TESTS) {
                    self.points.move_on_segment(v, candidate.ends, &Expansion::from(t))?;
                    if self.star_is_valid() {
                        self.segments.move_steiner(v, t);
                        return self.step(v, &normals, reach.radius);
                    }
                }
                self.points.move_on_segment(v, candidate.ends, &Expansion::from(candidate.t))?;
            }
        }
        self.step(v, &normals, reach.radius)
    }

    /// From the exact point to its nearest double.
    fn error(&self, v: u32) -> [f64; 3] {
        let (at, exact) = (*self.points.xyz(v), self.points.exact_coordinates(v));
        std::array::from_fn(|k| -exact[k].difference(&Expansion::from(at[k])).approximate())
    }

    /// Puts `v` where it is nearest to the planes with these normals.
    fn step(&mut self, v: u32, normals: &[[f64; 3]], radius: i32) -> Result<(), Error> {
        let at = *self.points.xyz(v);
        let steps = nearest(self.error(v), at.map(unit_of), normals, radius).0;
        let to: [f64; 3] = std::array::from_fn(|k| at[k] + f64::from(steps[k]) * unit_of(at[k]));
        if to.iter().all(|&x| surviving(x, self.scale_exponent) == x) && to != self.xyz[v as usize] {
            self.xyz[v as usize] = to;
            self.note_move(v)?;
        }
        Ok(())
    }
}

/// The cost of a search among the doubles around a point.
fn cells(radius: i32, normals: usize) -> u64 {
    let side = 2 * radius.unsigned_abs() as u64 + 1;
    side * side * side * (normals as u64 + 1) / 4
}

/// A unit in the last place.
fn unit_of(x: f64) -> f64 {
    x.abs().next_up() - x.abs()
}

/// The steps, in units of each axis, from the nearest double to the one within `radius` steps that is nearest to all planes.
/// `error`: from the exact point to its nearest double; `normals`: unit normals of planes through the exact point. Also returns the
/// largest distance.
fn nearest(error: [f64; 3], units: [f64; 3], normals: &[[f64; 3]], radius: i32) -> ([i32; 3], f64) {
    let mut best = ([0; 3], f64::INFINITY, f64::INFINITY);
    for x in -radius..=radius {
        for y in -radius..=radius {
            for z in -radius..=radius {
                let step = [x, y, z];
                let d: [f64; 3] = std::array::from_fn(|k| error[k] + f64::from(step[k]) * units[k]);
                let worst = normals.iter().map(|n| dot(n, &d).abs()).fold(0.0, f64::max);
                let size = dot(&d, &d);
                if worst < best.1 || worst == best.1 && size < best.2 {
                    best = (step, worst, size);
                }
            }
        }
    }
    (best.0, best.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_is_met_a_hundred_times_better() {
        let normal = [2.0f64 / 7.0, 3.0 / 7.0, 6.0 / 7.0].map(|x: f64| x + 0.01);
        let size = dot(&normal, &normal).sqrt();
        let normal = normal.map(|x| x / size);
        let error = [0.4, -0.3, 0.35];
        let off = |radius| {
            let step = nearest(error, [1.0, 0.5, 1.0], &[normal], radius).0;
            let d: [f64; 3] = std::array::from_fn(|k| error[k] + f64::from(step[k]) * [1.0, 0.5, 1.0][k]);
            dot(&normal, &d).abs()
        };
        assert!(off(0) > 0.2);
        assert!(off(4) < 0.05 * off(0), "{} {}", off(4), off(0));
    }
}
