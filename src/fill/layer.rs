//! The apex layer: points over the walls.
use crate::error::Error;
use crate::fallible;
use crate::fill::near::Near;
use crate::fill::{Fill, Limits, APART};
use crate::kernel::around::StarSearch;
use crate::kernel::visited::Visited;
use crate::kernel::NONE;
use crate::vector::{cross, dot, sub};

/// Height of an apex over the edge of the equilateral triangle of the same area; the regular tetrahedron has 0.816.
/// On the clean models of `quality_figures.py` 0.7 leaves 1.6 % below 30° instead of 1.4 %, 0.9 only 1.1 %, but the worst angle is a degree less.
const HEIGHT: f64 = 0.8;

/// How many rounds of insertion come before the last; each has about a quarter of the next. In one round, cavities have 340 tetrahedra on
/// average on the model spot, and filling takes twice as long.
const ROUNDS: u32 = 6;

/// A wall as one side sees it, and the region there.
struct Wall {
    corners: [u32; 3],
    region: u32,
}

/// An apex over a wall.
struct Apex {
    wall: [u32; 3],
    at: [f64; 3],
}

impl Fill<'_, '_> {
    /// Puts points over walls.
    pub(super) fn layer(&mut self) -> Result<(), Error> {
        let chosen = self.chosen()?;
        let mut search = StarSearch::default();
        let mut done = 0;
        // The first ones meet a mesh without points inside, whose cavities are large: few of them, spread evenly.
        for round in (0..=ROUNDS).rev() {
            for (i, apex) in chosen.iter().enumerate() {
                let comes_in = (i as u32).trailing_zeros().div_ceil(2).min(ROUNDS);
                if comes_in != round {
                    continue;
                }
                if done % 64 == 0 {
                    self.part.progress(0.3 * f64::from(done) / chosen.len() as f64)?;
                }
                done += 1;
                self.part.step()?;
                if self.is_wasting() {
                    return Ok(());
                }
                if let Some(code) = self.wall(&mut search, apex.wall)? {
                    self.attempt(
                        apex.at,
                        code >> 2,
                        Limits { apart: APART, at_walls: true, for_size: true },
                    )?;
                }
            }
        }
        Ok(())
    }

    /// The apexes that are far enough from all vertices and from those before them, as far as places tell; in the order of walls.
    fn chosen(&self) -> Result<Vec<Apex>, Error> {
        let mut near = Near::default();
        for v in 0..self.points.len() as u32 {
            self.part.step()?;
            near.add(*self.points.xyz(v), self.size.of(v))?;
        }
        let mut chosen = Vec::new();
        for Wall { corners: wall, region } in self.walls()? {
            self.part.step()?;
            let Some(at) = self.apex(wall) else { continue };
            let size = self.size.at(self.points, &at, region, &wall)?.length;
            if !near.any(&at, APART * size, size) {
                near.add(at, size)?;
                fallible::push(&mut chosen, Apex { wall, at })?;
            }
        }
        Ok(chosen)
    }

    /// The corner of a wall on the side that sees it in this order, if the domain is there.
    fn wall(&self, search: &mut StarSearch, [a, b, c]: [u32; 3]) -> Result<Option<u32>, Error> {
        let start = self.mesh.vertex_tet[a as usize];
        let Some(code) = search.find_face(self.mesh, [a, b, c], start)? else { return Ok(None) };
        let [x, y, z] = self.mesh.face(code);
        let same = [[x, y, z], [y, z, x], [z, x, y]].contains(&[a, b, c]);
        let code = if same { code } else { self.mesh.across(code) };
        Ok((self.mesh.region(code >> 2) != NONE).then_some(code))
    }

    /// All walls as seen from inside and the region there, twice where the domain is on both sides, in breadth-first order over the surface.
    fn walls(&self) -> Result<Vec<Wall>, Error> {
        let mut seen = Visited::default();
        seen.begin();
        let (mut codes, mut out) = (Vec::new(), Vec::new());
        let mut next = 0;
        for t in self.mesh.all().filter(|&t| self.mesh.is_live(t) && self.mesh.region(t) != NONE) {
            self.part.step()?;
            for first in (4 * t..4 * t + 4).filter(|&code| self.mesh.is_wall(code)) {
                if seen.insert(first)? {
                    fallible::push(&mut codes, first)?;
                }
                while next < codes.len() {
                    let code = codes[next];
                    next += 1;
                    self.part.step()?;
                    let [x, y, z] = self.mesh.face(code);
                    fallible::push(
                        &mut out,
                        Wall { corners: [x, y, z], region: self.mesh.region(code >> 2) },
                    )?;
                    for edge in [[x, y], [y, z], [z, x]] {
                        if let Some(n) = self.mesh.next_wall(code, edge) {
                            if seen.insert(n)? {
                                fallible::push(&mut codes, n)?;
                            }
                        }
                    }
                }
            }
        }
        Ok(out)
    }

    /// The apex over a wall, on the side that sees it in this order; `None` if the wall is flat in plain arithmetic.
    pub(super) fn apex(&self, wall: [u32; 3]) -> Option<[f64; 3]> {
        let [x, y, z] = wall.map(|v| self.points.xyz(v));
        let n = cross(&sub(z, x), &sub(y, x));
        let area = dot(&n, &n).sqrt();
        if area <= 0.0 || !area.is_finite() {
            return None;
        }
        // The area is √3/4 of the square of the edge; `area` is twice that.
        let edge = (area * (2.0 / 3.0f64.sqrt())).sqrt();
        let up = HEIGHT * edge / area;
        // (p, x, y, z) is positive for p on this side: against (y − x) × (z − x).
        Some([0, 1, 2].map(|k| (x[k] + y[k] + z[k]) / 3.0 + up * n[k]))
    }
}
