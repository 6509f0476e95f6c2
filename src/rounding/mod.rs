//! Rounding: positions in doubles for implicit Steiner points, with every tetrahedron strictly positive.
//!
//! A Steiner point that is no double is rounded to the nearest one. If that flattens or inverts a tetrahedron, one of its implicit vertices
//! is moved: along its segment to a parameter that makes it an exact double, if the exact mesh stays constrained Delaunay; otherwise to a
//! neighbouring lattice point; otherwise along its segment to a parameter that rounds better. Every such move lowers the number of
//! tetrahedra that are not positive. If none helps, the points at these tetrahedra are moved to doubles nearest to the planes that they are
//! close to ([`precise`]), or the tetrahedra are replaced ([`untangle`]), a fixed number of times ([`STAGES`]), so the search terminates.
//! It ends earlier if its budget is spent ([`work`]).
mod candidates;
mod lawson;
mod moves;
mod precise;
#[cfg(test)]
mod tests;
mod untangle;
mod wedge;
mod work;

use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::{Mesh, NONE};
use crate::predicates::{orient3d, surviving, Points, Sign};
use crate::segments::recovery::Segments;
use precise::Reach;
use rustc_hash::FxHashSet;
use work::Work;

/// What is done if moving points one by one has not helped.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// Points are moved nearest to the planes that they are close to.
    Place(Reach),
    /// Points may move far.
    Stray,
    /// Tetrahedra are replaced.
    Reconnect,
}

/// One after the other, until every tetrahedron is positive: what moves points least comes first. Half of all parameters and double change
/// nothing on the only model measured whose points have to move. Half of all radii and double change nothing on the only model measured
/// whose points have to move.
const STAGES: [Stage; 7] = [
    Stage::Place(Reach { parameters: 0, radius: 3 }),
    Stage::Place(Reach { parameters: 16, radius: 3 }),
    Stage::Place(Reach { parameters: 112, radius: 3 }),
    Stage::Reconnect,
    Stage::Place(Reach { parameters: 0, radius: 12 }),
    Stage::Stray,
    Stage::Reconnect,
];

/// Positions in doubles.
#[derive(Debug, Default)]
pub struct Rounded {
    /// One per engine vertex.
    pub xyz: Vec<[f64; 3]>,
    /// Points that are not where segment recovery and rounding to nearest had put them.
    pub moved: u64,
    /// Slots of replacement tetrahedra, ascending: positive in doubles, not necessarily Delaunay.
    pub replaced: Vec<u32>,
    /// Steiner points without a valid position: tetrahedra at them are flat or inverted in doubles.
    pub crowded: Vec<u32>,
}

impl Rounded {
    /// Positions of points that are all explicit.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn explicit(points: &Points) -> Result<Self, Error> {
        Ok(Rounded { xyz: fallible::copied(points.coordinates())?, ..Rounded::default() })
    }
}

/// Whether a tetrahedron is handed out.
fn is_kept(mesh: &Mesh, t: u32) -> bool {
    mesh.is_live(t) && mesh.region(t) != NONE
}

/// Finds positions in doubles for all vertices. `scale_exponent`: coordinates are the caller's times two to this power.
/// `reconnect`: tetrahedra may be replaced where moving points is not enough. If that fails too, the exact mesh is left unchanged, except
/// for parameters on segments.
pub fn round(
    mesh: &mut Mesh,
    points: &mut Points,
    segments: &mut Segments,
    scale_exponent: i32,
    reconnect: bool,
    control: &Control,
) -> Result<Rounded, Error> {
    let mut rounded = Rounded::explicit(points)?;
    for p in &mut rounded.xyz[segments.first_steiner as usize..] {
        *p = p.map(|x| surviving(x, scale_exponent));
    }
    let mut bad: Vec<u32> = Vec::new();
    for t in mesh.all() {
        control.step()?;
        if is_kept(mesh, t) && !is_positive(mesh, points, &rounded.xyz, t) {
            fallible::push(&mut bad, t)?;
        }
    }
    let work = Work::for_mesh(mesh.slot_count(), control);
    let mut repair = Repair {
        work,
        mesh,
        points,
        segments,
        scale_exponent,
        xyz: &mut rounded.xyz,
        search: StarSearch::default(),
        touched: Vec::new(),
        moved: FxHashSet::default(),
        moves: 0,
        replaced: FxHashSet::default(),
        exact: None,
    };
    let mut stages = STAGES.iter();
    let mut far = false;
    loop {
        repair.mend_all(&mut bad, far)?;
        control.look()?;
        if bad.is_empty() {
            break;
        }
        match stages.next().filter(|_| !repair.work.is_done()) {
            Some(&Stage::Place(reach)) => repair.place_all(&mut bad, reach)?,
            Some(Stage::Stray) => far = true,
            Some(Stage::Reconnect) if reconnect => repair.reconnect(&mut bad)?,
            Some(Stage::Reconnect) => {}
            None => {
                rounded.crowded = crowded(&repair, &bad)?;
                repair.restore();
                return Ok(rounded);
            }
        }
    }
    rounded.moved = repair.moved.len() as u64;
    let Repair { replaced, .. } = repair;
    fallible::extend(&mut rounded.replaced, replaced)?;
    rounded.replaced.sort_unstable();
    Ok(rounded)
}

/// The implicit vertices of tetrahedra that are not positive.
fn crowded(repair: &Repair, bad: &[u32]) -> Result<Vec<u32>, Error> {
    let all = bad.iter().flat_map(|&t| repair.mesh.verts(t));
    let mut vertices = fallible::collect(all.filter(|&v| !repair.points.is_explicit(v)))?;
    vertices.sort_unstable();
    vertices.dedup();
    Ok(vertices)
}

/// The tetrahedron is positive in doubles; those of explicit points are by construction.
fn is_positive(mesh: &Mesh, points: &Points, xyz: &[[f64; 3]], t: u32) -> bool {
    let v = mesh.verts(t);
    if v.iter().all(|&w| points.is_explicit(w)) {
        return true;
    }
    positive(xyz, v)
}

fn positive(xyz: &[[f64; 3]], verts: [u32; 4]) -> bool {
    let [a, b, c, d] = verts.map(|w| &xyz[w as usize]);
    orient3d(a, b, c, d) == Sign::Positive
}

struct Repair<'a> {
    /// What may still be spent.
    work: Work<'a>,
    mesh: &'a mut Mesh,
    points: &'a mut Points,
    segments: &'a mut Segments,
    scale_exponent: i32,
    xyz: &'a mut Vec<[f64; 3]>,
    search: StarSearch,
    /// Tetrahedra of the stars of moved vertices.
    touched: Vec<u32>,
    /// Vertices that were moved; never iterated.
    moved: FxHashSet<u32>,
    moves: u64,
    /// Tetrahedra that took the place of others.
    replaced: FxHashSet<u32>,
    /// The exact mesh, once tetrahedra may have been replaced. No parameter changes from then on, since it could no longer be verified that
    /// the exact mesh stays valid.
    exact: Option<Mesh>,
}

impl Repair<'_> {
    /// Moves vertices of tetrahedra that are not positive until that no longer helps; leaves in the list those that remain so.
    fn mend_all(&mut self, bad: &mut Vec<u32>, far: bool) -> Result<(), Error> {
        loop {
            let before = self.moves;
            for &t in bad.iter() {
                if self.work.is_done() {
                    break;
                }
                self.work.control().look()?;
                self.mend(t, far)?;
            }
            // A move may trade two bad tetrahedra of a star for another one.
            fallible::append(bad, &self.touched)?;
            self.touched.clear();
            self.keep_bad(bad);
            if bad.is_empty() || self.moves == before {
                return Ok(());
            }
        }
    }

    /// Keeps in the list only tetrahedra that are part of the output and not positive.
    fn keep_bad(&self, bad: &mut Vec<u32>) {
        bad.sort_unstable();
        bad.dedup();
        bad.retain(|&t| is_kept(self.mesh, t) && !is_positive(self.mesh, self.points, self.xyz, t));
    }

    /// Keeps the exact mesh, for the case that replacing tetrahedra does not help either.
    fn keep_exact(&mut self) -> Result<(), Error> {
        if self.exact.is_none() {
            self.work.control().room(self.mesh.bytes())?;
            self.exact = Some(self.mesh.copied()?);
        }
        Ok(())
    }

    /// Puts the exact mesh back.
    fn restore(&mut self) {
        if let Some(exact) = self.exact.take() {
            *self.mesh = exact;
        }
    }

    fn note_move(&mut self, v: u32) -> Result<(), Error> {
        self.moves += 1;
        fallible::add(&mut self.moved, v)?;
        Ok(())
    }
}
