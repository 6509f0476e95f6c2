//! The apex layer: points over the walls.
use crate::error::Error;
use crate::fallible;
use crate::fill::near::Near;
use crate::fill::{Fill, Limits, APART};
use crate::kernel::around::StarSearch;
use crate::kernel::visited::Visited;
use crate::kernel::NONE;
use crate::ops::apex::apex;

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
        let mut near = Near::of(self.points, self.size, &self.part)?;
        let mut chosen = Vec::new();
        for Wall { corners: wall, region } in self.walls()? {
            self.part.step()?;
            let Some(at) = apex(self.points, wall) else { continue };
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
}
