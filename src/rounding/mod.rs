//! Handing out doubles: positions of implicit Steiner points, with every tetrahedron strictly positive.
//!
//! Engine notes §9. A Steiner point that is no double goes to the nearest one. Where that flattens or inverts a tetrahedron,
//! one of its implicit vertices is moved: along its segment to a parameter that makes it an exact double, if the
//! exact mesh stays constrained Delaunay; else to a neighbouring lattice point; else along its segment to a parameter whose
//! rounding is kinder. Every move lowers the number of tetrahedra that are not positive, so the search ends.
mod candidates;
mod wedge;

use crate::constrain::segment::Segments;
use crate::delaunay::Delaunay;
use crate::error::Error;
use crate::mesh::star::StarSearch;
use crate::mesh::{flag, Tetrahedra};
use crate::predicates::{orient3d, scale, to_range, Expansion, Points, Sign};
use crate::region::{Components, Regions};
use crate::INVALID;
use candidates::{lattice, Candidate};
use wedge::{escape, Plane, MOST};

/// Positions in doubles.
#[derive(Clone, Debug, Default)]
pub struct Rounded {
    /// One per engine vertex.
    pub xyz: Vec<[f64; 3]>,
    /// Points that are not where segment recovery and rounding to nearest had put them.
    pub moved: u64,
    /// Steiner points without a valid position: tetrahedra at them are flat or inverted in doubles.
    pub crowded: Vec<u32>,
}

impl Rounded {
    /// Positions of points that are all explicit.
    pub fn explicit(points: &Points) -> Self {
        Rounded { xyz: points.coordinates().to_vec(), ..Rounded::default() }
    }
}

/// Which tetrahedra are handed out.
pub struct Kept<'a> {
    /// The components of the mesh.
    pub components: &'a Components,
    /// Their regions.
    pub regions: &'a Regions,
}

impl Kept<'_> {
    fn has(&self, mesh: &Tetrahedra, t: u32) -> bool {
        mesh.is_live(t)
            && !mesh.is_ghost(t)
            && self.regions.of_component[self.components.of[t as usize] as usize] != INVALID
    }
}

/// Finds positions in doubles for all vertices. `scale_exponent`: coordinates are the caller's times two to this power.
pub fn round(
    delaunay: &mut Delaunay,
    points: &mut Points,
    segments: &mut Segments,
    kept: &Kept,
    scale_exponent: i32,
) -> Result<Rounded, Error> {
    let mut rounded = Rounded::explicit(points);
    for p in &mut rounded.xyz[segments.first_steiner as usize..] {
        *p = p.map(|x| surviving(x, scale_exponent));
    }
    let mut bad: Vec<u32> = (0..delaunay.mesh.slot_count() as u32)
        .filter(|&t| kept.has(&delaunay.mesh, t) && !is_positive(&delaunay.mesh, points, &rounded.xyz, t))
        .collect();
    let mut repair = Repair {
        delaunay,
        points,
        segments,
        kept,
        scale_exponent,
        xyz: &mut rounded.xyz,
        search: StarSearch::default(),
        touched: Vec::new(),
        moved: 0,
    };
    while !bad.is_empty() {
        let before = repair.moved;
        for &t in &bad {
            repair.mend(t)?;
        }
        // A move may trade two bad tetrahedra of a star for another one.
        bad.append(&mut repair.touched);
        bad.sort_unstable();
        bad.dedup();
        bad.retain(|&t| {
            kept.has(&repair.delaunay.mesh, t)
                && !is_positive(&repair.delaunay.mesh, repair.points, repair.xyz, t)
        });
        if repair.moved == before {
            rounded.crowded = crowded(&repair, &bad);
            return Ok(rounded);
        }
    }
    rounded.moved = repair.moved;
    Ok(rounded)
}

/// The nearest number that exact arithmetic can take, and that the caller's scale holds: that may lose bits of subnormal
/// numbers.
fn surviving(x: f64, scale_exponent: i32) -> f64 {
    scale(scale(to_range(x), -scale_exponent), scale_exponent)
}

/// The implicit vertices of tetrahedra that are not positive.
fn crowded(repair: &Repair, bad: &[u32]) -> Vec<u32> {
    let mut vertices: Vec<u32> = bad
        .iter()
        .flat_map(|&t| repair.delaunay.mesh.verts[t as usize])
        .filter(|&v| !repair.points.is_explicit(v))
        .collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

/// The tetrahedron is positive in doubles; those of explicit points are by construction.
fn is_positive(mesh: &Tetrahedra, points: &Points, xyz: &[[f64; 3]], t: u32) -> bool {
    let v = mesh.verts[t as usize];
    if v.iter().all(|&w| points.is_explicit(w)) {
        return true;
    }
    let [a, b, c, d] = v.map(|w| &xyz[w as usize]);
    orient3d(a, b, c, d) == Sign::Positive
}

struct Repair<'a> {
    delaunay: &'a mut Delaunay,
    points: &'a mut Points,
    segments: &'a mut Segments,
    kept: &'a Kept<'a>,
    scale_exponent: i32,
    xyz: &'a mut Vec<[f64; 3]>,
    search: StarSearch,
    /// Tetrahedra of the stars of moved vertices.
    touched: Vec<u32>,
    moved: u64,
}

impl Repair<'_> {
    /// Tries to make a tetrahedron positive by moving one of its implicit vertices.
    fn mend(&mut self, t: u32) -> Result<(), Error> {
        if is_positive(&self.delaunay.mesh, self.points, self.xyz, t) {
            return Ok(());
        }
        let verts = self.delaunay.mesh.verts[t as usize];
        for stage in 0..4 {
            for v in verts {
                if self.points.is_explicit(v) {
                    continue;
                }
                let start = self.delaunay.vertex_tet[v as usize];
                self.search.vertex_star(&mut self.delaunay.mesh, v, start);
                let moved = match stage {
                    0 => self.try_exact(v)?,
                    1 => self.try_lattice(v),
                    2 => self.try_parameters(v)?,
                    _ => self.try_wedge(v),
                };
                if moved {
                    self.touched.try_reserve(self.search.tets.len())?;
                    self.touched.extend_from_slice(&self.search.tets);
                }
                if moved && is_positive(&self.delaunay.mesh, self.points, self.xyz, t) {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// How many kept tetrahedra of the star are not positive with `v` at `at`, counting no further than `limit`.
    fn bad_in_star(&self, v: u32, at: [f64; 3], limit: usize) -> usize {
        let mesh = &self.delaunay.mesh;
        let mut count = 0;
        for &t in &self.search.tets {
            if count >= limit {
                break;
            }
            if !self.kept.has(mesh, t) {
                continue;
            }
            let [a, b, c, d] = mesh.verts[t as usize].map(|w| if w == v { at } else { self.xyz[w as usize] });
            count += (orient3d(&a, &b, &c, &d) != Sign::Positive) as usize;
        }
        count
    }

    /// Moves `v` in doubles only, to the nearest lattice point that is better.
    fn try_lattice(&mut self, v: u32) -> bool {
        let bad = self.bad_in_star(v, self.xyz[v as usize], usize::MAX);
        let mut best = (bad, self.xyz[v as usize]);
        for step in lattice() {
            let Some(at) = self.step_from(v, step) else { continue };
            let count = self.bad_in_star(v, at, best.0);
            if count < best.0 {
                best = (count, at);
                if count == 0 {
                    break;
                }
            }
        }
        if best.0 < bad {
            self.xyz[v as usize] = best.1;
            self.moved += 1;
        }
        best.0 < bad
    }

    /// Moves `v` in doubles only, into the wedge between the planes of the faces of its link that it is closest to.
    fn try_wedge(&mut self, v: u32) -> bool {
        let old = self.xyz[v as usize];
        let bad = self.bad_in_star(v, old, usize::MAX);
        let unit = old.iter().fold(0.0f64, |m, x| m.max(x.abs())) * f64::EPSILON;
        let planes = self.planes(v, 1024.0 * unit);
        for power in 0..10 {
            let Some(d) = escape(&planes, unit * f64::from(1u32 << power)) else { continue };
            let at: [f64; 3] = std::array::from_fn(|k| surviving(old[k] + d[k], self.scale_exponent));
            if self.bad_in_star(v, at, bad) < bad {
                self.xyz[v as usize] = at;
                self.moved += 1;
                return true;
            }
        }
        false
    }

    /// Planes of the link's faces nearer to `v` than `reach`, nearest first.
    fn planes(&self, v: u32, reach: f64) -> Vec<Plane> {
        let mesh = &self.delaunay.mesh;
        let p = self.xyz[v as usize];
        let mut planes = Vec::new();
        for &t in self.search.tets.iter().filter(|&&t| self.kept.has(mesh, t)) {
            let Some(slot) = mesh.slot_of(t, v) else { continue };
            let [a, b, c] = mesh.face(4 * t + slot).map(|w| {
                let q = self.xyz[w as usize];
                [q[0] - p[0], q[1] - p[1], q[2] - p[2]]
            });
            // (v, a, b, c) is positive where det(a, b, c) > 0; that grows when v moves against (b − a) × (c − a).
            let (u, w) = ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
            let n = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
            let size = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
            let height = (a[0] * n[0] + a[1] * n[1] + a[2] * n[2]) / size;
            if height.abs() < reach {
                planes.push(Plane { normal: n.map(|x| -x / size), height });
            }
        }
        planes.sort_by(|x, y| x.height.total_cmp(&y.height));
        planes.truncate(MOST);
        planes
    }

    /// The nearest double of `v`, some units in the last place away, if the caller's scale can hold it.
    fn step_from(&self, v: u32, step: [i8; 3]) -> Option<[f64; 3]> {
        let p = self.points.xyz(v);
        let at: [f64; 3] = std::array::from_fn(|k| {
            let mut x = p[k];
            for _ in 0..step[k].unsigned_abs() {
                x = if step[k] < 0 { x.next_down() } else { x.next_up() };
            }
            x
        });
        let survives = |x: f64| surviving(x, self.scale_exponent) == x;
        at.iter().all(|&x| survives(x)).then_some(at)
    }

    /// Moves `v` along its segment to where it is an exact double.
    fn try_exact(&mut self, v: u32) -> Result<bool, Error> {
        let Some(candidate) = Candidate::of(self.points, self.segments, v) else { return Ok(false) };
        for t in candidate.exact_parameters(self.points) {
            if self.try_parameter(v, &candidate, t)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Moves `v` along its segment to where its rounding is better.
    fn try_parameters(&mut self, v: u32) -> Result<bool, Error> {
        let Some(candidate) = Candidate::of(self.points, self.segments, v) else { return Ok(false) };
        for t in candidate.nearby_parameters() {
            if self.try_parameter(v, &candidate, t)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Moves `v` to parameter `t` if the exact mesh stays valid and the rounded one gets better.
    fn try_parameter(&mut self, v: u32, candidate: &Candidate, t: f64) -> Result<bool, Error> {
        let old = self.xyz[v as usize];
        let bad = self.bad_in_star(v, old, usize::MAX);
        self.points.move_on_segment(v, candidate.ends, &Expansion::from(t))?;
        let at = self.points.xyz(v).map(|x| surviving(x, self.scale_exponent));
        if self.bad_in_star(v, at, bad) < bad && self.star_is_valid() {
            self.xyz[v as usize] = at;
            self.segments.move_steiner(v, t);
            self.moved += 1;
            return Ok(true);
        }
        self.points.move_on_segment(v, candidate.ends, &Expansion::from(candidate.t))?;
        Ok(false)
    }

    /// The star of `v` is positive and constrained Delaunay in exact positions.
    fn star_is_valid(&self) -> bool {
        let mesh = &self.delaunay.mesh;
        self.search.tets.iter().all(|&t| {
            if mesh.is_ghost(t) {
                return true;
            }
            let [a, b, c, d] = mesh.verts[t as usize];
            if self.points.orient3d(a, b, c, d) != Sign::Positive {
                return false;
            }
            (0..4u32).all(|f| {
                let other = mesh.across(4 * t + f);
                mesh.flags[t as usize] & (flag::FACE << f) != 0
                    || mesh.is_ghost(other >> 2)
                    || self.points.insphere(a, b, c, d, mesh.apex(other)) != Sign::Positive
            })
        })
    }
}
