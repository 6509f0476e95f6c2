//! Which triangles of a facet's triangulation belong to the facet.
//!
//! A flood fill from outside computes, for the outer ring and the current hole, the winding number around each triangle. A ring bounds a
//! region exactly if its winding numbers are 0 and one of +1, −1: it may touch itself, or run back and forth along a bridge, but not cross
//! itself.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::polygon::constraint::Cover;
use crate::plc::polygon::delaunay::{Triangulation, GHOST};
use crate::plc::polygon::{Fault, FaultKind, Role};
use crate::plc::Interior;
use crate::INVALID;

/// The winding numbers of the rings around a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Winding {
    outer: i32,
    hole: u32,
    hole_winding: i32,
}

const OUTSIDE: Winding = Winding { outer: 0, hole: INVALID, hole_winding: 0 };

/// Finds the inside; its storage is reused from facet to facet.
#[derive(Default)]
pub struct Regions {
    /// For each triangle whether it belongs to the facet.
    pub inside: Vec<bool>,
    /// Whether the outer ring is counter-clockwise, like the triangles of the triangulation.
    pub counter_clockwise: bool,
    winding: Vec<Winding>,
    visited: Vec<bool>,
    stack: Vec<u32>,
    hole_sense: Vec<i32>,
}

impl Regions {
    /// Classifies all triangles. `roles` has one entry per polygon, `seeds` are in projection.
    pub fn classify(
        &mut self,
        mesh: &Triangulation,
        covers: &[Cover],
        roles: &[Role],
        interior: Interior,
        seeds: &[[f64; 2]],
        control: &Control,
    ) -> Result<Result<(), Fault>, Error> {
        let count = mesh.triangle_count() as usize;
        self.inside.clear();
        self.visited.clear();
        self.stack.clear();
        fallible::resize(&mut self.visited, count, false)?;
        match interior {
            Interior::FirstMinusOthers => {
                fallible::resize(&mut self.inside, count, false)?;
                self.winding.clear();
                fallible::resize(&mut self.winding, count, OUTSIDE)?;
                self.hole_sense.clear();
                fallible::resize(&mut self.hole_sense, roles.len(), 0)?;
                self.wind(mesh, covers, roles, control)
            }
            Interior::Seeds => {
                fallible::resize(&mut self.inside, count, true)?;
                self.flood_seeds(mesh, covers, seeds, control)
            }
        }
    }

    /// A triangle with the vertex at infinity, where every flood fill begins.
    fn start(mesh: &Triangulation) -> u32 {
        (0..mesh.triangle_count()).find(|&t| mesh.is_ghost(t)).unwrap_or(0)
    }

    fn wind(
        &mut self,
        mesh: &Triangulation,
        covers: &[Cover],
        roles: &[Role],
        control: &Control,
    ) -> Result<Result<(), Fault>, Error> {
        let start = Self::start(mesh);
        self.visited[start as usize] = true;
        fallible::push(&mut self.stack, start)?;
        let mut sense = 0;
        while let Some(t) = self.stack.pop() {
            control.step()?;
            for h in 3 * t..3 * t + 3 {
                let beyond = mesh.twin[h as usize] / 3;
                if std::mem::replace(&mut self.visited[beyond as usize], true) {
                    continue;
                }
                let mut w = self.winding[t as usize];
                if mesh.mark[h as usize] != INVALID && !step(mesh, covers, roles, h, &mut w) {
                    return Ok(Err(fault(mesh, beyond, FaultKind::Nesting)));
                }
                self.winding[beyond as usize] = w;
                if !fits(&mut sense, w.outer)
                    || (w.hole != INVALID && !fits(&mut self.hole_sense[w.hole as usize], w.hole_winding))
                {
                    return Ok(Err(fault(mesh, beyond, FaultKind::Crossing)));
                }
                if w.hole != INVALID && w.outer == 0 {
                    return Ok(Err(fault(mesh, beyond, FaultKind::Nesting)));
                }
                self.inside[beyond as usize] = w.outer != 0 && w.hole == INVALID;
                fallible::push(&mut self.stack, beyond)?;
            }
        }
        self.counter_clockwise = sense > 0;
        Ok(Ok(()))
    }

    fn flood_seeds(
        &mut self,
        mesh: &Triangulation,
        covers: &[Cover],
        seeds: &[[f64; 2]],
        control: &Control,
    ) -> Result<Result<(), Fault>, Error> {
        self.erase(mesh, Self::start(mesh), control)?;
        // Before holes are removed, only the outer boundary borders the outside.
        self.counter_clockwise = (0..mesh.corner.len() as u32)
            .find(|&h| {
                self.inside[h as usize / 3]
                    && !self.inside[mesh.twin[h as usize] as usize / 3]
                    && mesh.mark[h as usize] != INVALID
            })
            .is_none_or(|h| covers[mesh.mark[h as usize] as usize].from == mesh.from(h));
        for &seed in seeds {
            control.steps(mesh.triangle_count())?;
            match find(mesh, seed) {
                Some((_, true)) => {
                    return Ok(Err(Fault { kind: FaultKind::Seed, vertices: [INVALID; 4] }));
                }
                Some((t, false)) => self.erase(mesh, t, control)?,
                None => {}
            }
        }
        Ok(Ok(()))
    }

    /// Marks as outside all triangles that can be reached without crossing a constrained edge.
    fn erase(&mut self, mesh: &Triangulation, start: u32, control: &Control) -> Result<(), Error> {
        if std::mem::replace(&mut self.visited[start as usize], true) {
            return Ok(());
        }
        fallible::push(&mut self.stack, start)?;
        while let Some(t) = self.stack.pop() {
            control.step()?;
            self.inside[t as usize] = false;
            for h in 3 * t as usize..3 * t as usize + 3 {
                let beyond = mesh.twin[h] / 3;
                if mesh.mark[h] == INVALID && !std::mem::replace(&mut self.visited[beyond as usize], true) {
                    fallible::push(&mut self.stack, beyond)?;
                }
            }
        }
        Ok(())
    }
}

/// Whether a winding number agrees with the ring's orientation, which the first non-zero one sets.
fn fits(sense: &mut i32, winding: i32) -> bool {
    if *sense == 0 {
        *sense = winding;
    }
    winding == 0 || (winding == *sense && winding.abs() == 1)
}

fn fault(mesh: &Triangulation, t: u32, kind: FaultKind) -> Fault {
    let v = mesh.corners(t).into_iter().find(|&v| v != GHOST).unwrap_or(0);
    Fault { kind, vertices: [v; 4] }
}

/// Updates the winding numbers across half-edge `h`; returns false if that enters a second hole.
fn step(mesh: &Triangulation, covers: &[Cover], roles: &[Role], h: u32, w: &mut Winding) -> bool {
    let uses = || {
        let mut at = mesh.mark[h as usize];
        std::iter::from_fn(move || {
            let cover = *covers.get(at as usize)?;
            at = cover.next;
            // The triangle of `h` is left of it.
            Some((cover.polygon, if cover.from == mesh.from(h) { -1 } else { 1 }))
        })
    };
    for (polygon, change) in uses() {
        match roles[polygon as usize] {
            Role::Outer => w.outer += change,
            Role::Hole if polygon == w.hole => w.hole_winding += change,
            _ => {}
        }
    }
    let left = w.hole;
    if w.hole_winding == 0 {
        w.hole = INVALID;
    }
    for (polygon, change) in
        uses().filter(|&(polygon, _)| roles[polygon as usize] == Role::Hole && polygon != left)
    {
        if w.hole != INVALID && w.hole != polygon {
            return false;
        }
        w.hole_winding += change;
        w.hole = if w.hole_winding == 0 { INVALID } else { polygon };
    }
    true
}

/// The finite closed triangle that contains `p`, and whether `p` is on a constrained edge; `None` if `p` is outside.
fn find(mesh: &Triangulation, p: [f64; 2]) -> Option<(u32, bool)> {
    use crate::predicates::{orient2d, Sign};
    let at = |v: u32| mesh.points[v as usize];
    (0..mesh.triangle_count()).filter(|&t| !mesh.is_ghost(t)).find_map(|t| {
        let signs = [0, 1, 2].map(|i| orient2d(at(mesh.from(3 * t + i)), at(mesh.to(3 * t + i)), p));
        let on = (0..3).any(|i| signs[i] == Sign::Zero && mesh.mark[3 * t as usize + i] != INVALID);
        (!signs.contains(&Sign::Negative)).then_some((t, on))
    })
}

/// Whether the edge of `h` is used by a polygon that only constrains.
pub fn constrains(mesh: &Triangulation, covers: &[Cover], roles: &[Role], h: u32) -> bool {
    let mut at = mesh.mark[h as usize];
    while let Some(cover) = covers.get(at as usize) {
        if roles[cover.polygon as usize] == Role::Edge {
            return true;
        }
        at = cover.next;
    }
    false
}
