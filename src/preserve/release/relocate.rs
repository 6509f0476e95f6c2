//! Points inside that replace a point on a segment: one per sector, where the sector cannot be filled.
//!
//! A sector between two walls gets one that sees all of it (Si & Gärtner 2011, section 8.1), near the old point or, where no double
//! does, farther away and with surroundings of the sector ([`widen`](crate::ops::widen)). A sector all around the segment has no such position:
//! it gets two to four points around the segment.
use crate::elementary::power_of_two;
use crate::error::Error;
use crate::fallible;
use crate::kernel::replace::Sector;
use crate::ops::hollow::Start;
use crate::ops::place::place;
use crate::ops::reconnect::Polyhedron;
use crate::ops::widen::{Kept, Rays};
use crate::preserve::release::segments::{unit, Effort, Unsplit};
use crate::vector::{cross, dot, sub};

impl Unsplit<'_> {
    /// A sector with points inside.
    pub(super) fn place_inside(
        &mut self,
        v: u32,
        s: usize,
        ends: [u32; 2],
        taken: &[Sector],
        effort: Effort,
    ) -> Result<Option<Sector>, Error> {
        let region = self.star.sectors[s].region;
        let old = fallible::copied(&self.star.sectors[s].tets)?;
        let from = *self.points.xyz(v);
        let normals = self.wall_normals(s, from, ends)?;
        if self.convex(s) {
            let toward = match normals[..] {
                [m, n] => fallible::copied(&[unit([0, 1, 2].map(|k| m[k] + n[k])), m, n])?,
                _ => fallible::copied(&normals)?,
            };
            let p = self.new_point(from)?;
            if place(self.points, p, &self.faces, from, &toward, self.control)? {
                let new = fallible::collect(self.faces.iter().map(|&[x, y, z]| [p, x, y, z]))?;
                return Ok(Some(Sector { old, new, region }));
            }
            if let Some(new) = self.widen(v, s, taken, &Rays { point: p, from, toward: &toward })? {
                return Ok(Some(Sector { old: std::mem::take(&mut self.widen.cavity.tets), new, region }));
            }
            let last = self.inside.list.len() - 1;
            self.discard(last);
        }
        let new = self.fill_around(v, s, ends, &normals, effort)?;
        Ok(new.map(|new| Sector { old, new, region }))
    }

    /// A place for a point in a sector with surroundings.
    fn widen(
        &mut self,
        v: u32,
        s: usize,
        taken: &[Sector],
        rays: &Rays,
    ) -> Result<Option<Vec<[u32; 4]>>, Error> {
        let [gone, walls] = self.walls_of(s)?;
        let start = Start {
            tets: &self.star.sectors[s].tets,
            gone: &gone,
            walls: &walls,
            without: v,
            edge: None,
            avoid: [v; 2],
            taken,
        };
        let kept = Kept { isolated: self.isolated, inside: &self.inside.list };
        let new = self.widen.place(self.mesh, self.points, &start, kept, rays, self.control)?;
        fallible::append(&mut self.read, &self.widen.read)?;
        if new.is_some() {
            fallible::append(&mut self.swallowed, &self.widen.swallowed)?;
        }
        Ok(new)
    }

    /// Whether the sector has two different walls, so that it is not all around the segment.
    fn convex(&self, s: usize) -> bool {
        let count = self.star.walls.iter().filter(|w| w.sides.iter().any(|side| side.0 == s)).count();
        count == 2
    }

    /// The unit normals of the walls at a sector, turned inward, in plain arithmetic.
    fn wall_normals(&self, s: usize, from: [f64; 3], ends: [u32; 2]) -> Result<Vec<[f64; 3]>, Error> {
        let mut normals = Vec::new();
        let [a, b] = ends.map(|e| sub(self.points.xyz(e), &from));
        let along = if dot(&a, &a) > dot(&b, &b) { a.map(|x| -x) } else { b };
        for wall in &self.star.walls {
            for &(sector, forward) in &wall.sides {
                if sector != s {
                    continue;
                }
                // The corner farthest from the line tells the plane best.
                let normal = wall.polygon[1..wall.polygon.len() - 1]
                    .iter()
                    .map(|&u| unit(cross(&along, &sub(self.points.xyz(u), &from))))
                    .find(|n| dot(n, n) > 0.5);
                if let Some(n) = normal {
                    // The polygon runs from the first end round to the second: it turns about −(along × u).
                    // A face turned inward has its normal pointing away from the inside.
                    fallible::push(&mut normals, if forward { n } else { n.map(|x| -x) })?;
                }
            }
        }
        Ok(normals)
    }

    pub(super) fn new_point(&mut self, at: [f64; 3]) -> Result<u32, Error> {
        self.inside.add(self.mesh, self.points, at)
    }

    /// Takes the last points inside back, all but the first `count`.
    pub(super) fn discard(&mut self, count: usize) {
        self.inside.shorten(count);
    }

    /// Fills a sector all around the segment, possibly from one side of a wall to the other, with two or three points inside near the
    /// segment, joined by reconnection.
    fn fill_around(
        &mut self,
        v: u32,
        s: usize,
        ends: [u32; 2],
        normals: &[[f64; 3]],
        effort: Effort,
    ) -> Result<Option<Vec<[u32; 4]>>, Error> {
        let from = *self.points.xyz(v);
        let along = unit(sub(self.points.xyz(ends[1]), self.points.xyz(ends[0])));
        let up = match normals.first() {
            Some(&n) => n,
            None => any_normal(&along),
        };
        let side = cross(&along, &up);
        // Cosine and sine of the angle from `up`.
        let way = |[cosine, sine]: [f64; 2]| [0, 1, 2].map(|k| cosine * up[k] + sine * side[k]);
        const HALF_ROOT_OF_THREE: f64 = 0.866_025_403_784_438_6;
        const AHEAD: [f64; 2] = [1.0, 0.0];
        const LEFT: [f64; 2] = [0.0, 1.0];
        const RIGHT: [f64; 2] = [0.0, -1.0];
        const BACK: [f64; 2] = [-1.0, 0.0];
        let sets: [&[[f64; 2]]; 5] = [
            &[LEFT],
            &[RIGHT],
            &[AHEAD, BACK],
            &[AHEAD, [-0.5, HALF_ROOT_OF_THREE], [-0.5, -HALF_ROOT_OF_THREE]],
            &[AHEAD, LEFT, BACK, RIGHT],
        ];
        let reach = self.star.sectors[s].link.iter().flatten().map(|&w| {
            let d = sub(self.points.xyz(w), &from);
            dot(&d, &d)
        });
        let reach = reach.fold(f64::INFINITY, f64::min).sqrt();
        let walled = !normals.is_empty();
        let edges: &[[u32; 2]] = if walled { &[] } else { &[ends] };
        let before = self.inside.list.len();
        for set in sets {
            for halvings in [2, 4, 8, 16, 24, 32] {
                let distance = reach * power_of_two(-halvings);
                for &angle in set {
                    let w = way(angle);
                    self.new_point([0, 1, 2].map(|k| from[k] + distance * w[k]))?;
                }
                let inner: Vec<u32> = fallible::copied(&self.inside.list[before..])?;
                let polyhedron = Polyhedron { faces: &self.faces, inner: &inner, edges };
                let mut new = Vec::new();
                if self.reconnect.fill(self.points, &polyhedron, effort.budget, &mut new)? {
                    return Ok(Some(new));
                }
                self.discard(before);
            }
        }
        Ok(None)
    }
}

/// A unit vector across.
fn any_normal(along: &[f64; 3]) -> [f64; 3] {
    let k = (0..3).min_by(|&i, &j| along[i].abs().total_cmp(&along[j].abs())).unwrap_or(0);
    let mut e = [0.0; 3];
    e[k] = 1.0;
    unit(cross(along, &e))
}
