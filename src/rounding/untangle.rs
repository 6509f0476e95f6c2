//! Reconnection where doubles are too coarse for the exact mesh: replaces tetrahedra that rounding has flattened or inverted.
//!
//! Nearly flat facets have tetrahedra at them that are thinner than the last place of their coordinates; no move of a point within its
//! surroundings makes all of these positive, but other tetrahedra on the same vertices are. So a tetrahedron that is not positive is
//! removed together with some around it (those around one of its edges, at one of its vertices, or up to a few faces away), and the
//! polyhedron is filled by small polyhedron reconnection ([`crate::ops::reconnect`]), using exact signs of the output doubles.
//!
//! Invariants: subfaces and subsegments stay; new tetrahedra are positive in doubles; regions keep their space, because no cavity
//! extends across a subface, and none contains ghosts. The new tetrahedra need not be Delaunay, nor positive at the exact positions, so
//! they are listed.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::cavity::{Cavity, Edges, Terms};
use crate::kernel::replace::Replace;
use crate::kernel::tables::{EDGE, FACE};
use crate::kernel::{edge_key, face_key, Mesh};
use crate::ops::reconnect::{Polyhedron, Reconnect, MOST_VERTICES};
use crate::predicates::Points;
use crate::rounding::lawson::Lawson;
use crate::rounding::work;
use crate::rounding::work::Work;
use crate::rounding::{positive, Repair};
use rustc_hash::FxHashSet;

/// Steps of a search: more fill more cavities, but what cannot be filled costs all of them. 1,000 and 4,000 change nothing on the only
/// model measured whose points have to move.
const BUDGET: u32 = 2000;
/// Most tetrahedra of a cavity: more have too many vertices. 80 and 320 change nothing on the only model measured whose points have to
/// move.
const MOST_TETS: usize = 160;
/// How many faces away a cavity reaches at most: larger ones replace more tetrahedra of the Delaunay mesh. 2 and 8 change nothing on the
/// only model measured whose points have to move.
const MOST_LAYERS: usize = 4;

/// What is repaired.
pub struct Place<'a> {
    /// The mesh.
    pub mesh: &'a mut Mesh,
    /// Subsegments, by [`edge_key`].
    pub edges: Edges,
    /// Puts tetrahedra in place.
    pub replace: Replace,
    /// Scratch space: faces, and which side a tetrahedron is on.
    pub sides: Vec<([u32; 3], bool)>,
    /// Slots of tetrahedra that took the place of others.
    pub replaced: &'a mut FxHashSet<u32>,
}

impl Place<'_> {
    /// Replaces tetrahedra of one region by others with the same boundary; false (and nothing is changed) if these do not fit.
    ///
    /// As long as some tetrahedra are not positive, the boundary of a cavity may cross itself. Positive tetrahedra that fill it then cover
    /// some points twice, and may have a face four times, or one that already exists next to the cavity.
    pub fn put(&mut self, old: &[u32], new: &[[u32; 4]]) -> Result<bool, Error> {
        if !self.fits(old, new)? {
            return Ok(false);
        }
        self.replace.cavity(self.mesh, old, new, &[])?;
        for t in old {
            self.replaced.remove(t);
        }
        fallible::add_all(self.replaced, self.replace.fresh.iter().copied())?;
        Ok(true)
    }

    /// Whether every face occurs twice, once from each side.
    fn fits(&mut self, old: &[u32], new: &[[u32; 4]]) -> Result<bool, Error> {
        let mesh = &self.mesh;
        let sides = &mut self.sides;
        sides.clear();
        sides.try_reserve(4 * (old.len() + new.len()))?;
        for code in old.iter().flat_map(|&t| 4 * t..4 * t + 4) {
            let beyond = mesh.across(code);
            if !old.contains(&(beyond >> 2)) {
                fallible::push(sides, side(mesh.face(beyond)))?;
            }
        }
        fallible::extend(
            sides,
            new.iter().flat_map(|tet| FACE.map(|face| side(face.map(|k| tet[k as usize])))),
        )?;
        sides.sort_unstable();
        let mut runs = sides.chunk_by(|x, y| x.0 == y.0);
        Ok(runs.all(|run| matches!(run, [x, y] if x.1 != y.1)))
    }
}

/// A face by its corners in order, and whether these are turned the other way round.
fn side([a, b, c]: [u32; 3]) -> ([u32; 3], bool) {
    (face_key([a, b, c]), (a > b) ^ (b > c) ^ (a > c))
}

impl Repair<'_> {
    /// Replaces the tetrahedra in the list; those without a filling stay in it.
    pub(super) fn reconnect(&mut self, bad: &mut Vec<u32>) -> Result<(), Error> {
        self.keep_exact()?;
        let mut edges: FxHashSet<[u32; 2]> = FxHashSet::default();
        let pieces = self.segments.pieces.iter();
        fallible::add_all(&mut edges, pieces.map(|piece| edge_key(piece.ends[0], piece.ends[1])))?;
        let points = Points::new(fallible::copied(self.xyz)?);
        let replaced = &mut self.replaced;
        let (replace, sides) = (Replace::default(), Vec::new());
        let mut place = Place { mesh: self.mesh, edges, replace, sides, replaced };
        let control = self.work.control();
        let (mut untangle, mut lawson) = (Untangle::new(control), Lawson::default());
        for &t in bad.iter() {
            control.look()?;
            let mesh = &place.mesh;
            // An earlier replacement may have taken it, and its slot.
            if !self.work.is_done()
                && mesh.is_live(t)
                && !positive(self.xyz, mesh.verts(t))
                && untangle.replace(&mut place, &points, t, &self.work)?
            {
                self.moves += 1;
                let fresh = fallible::copied(&place.replace.fresh)?;
                lawson.run(&mut place, &points, fresh, control)?;
            }
        }
        self.keep_bad(bad);
        Ok(())
    }
}

/// Replaces tetrahedra; keeps its scratch space.
struct Untangle<'a> {
    reconnect: Reconnect<'a>,
    cavity: Cavity,
    new: Vec<[u32; 4]>,
}

impl<'a> Untangle<'a> {
    fn new(control: &'a Control<'a>) -> Self {
        Untangle { reconnect: Reconnect::new(control), cavity: Cavity::default(), new: Vec::new() }
    }

    /// Replaces the tetrahedron `t` and some around it by positive ones, if a filling is found; they are in `place.replace.fresh`.
    fn replace(&mut self, place: &mut Place, points: &Points, t: u32, work: &Work) -> Result<bool, Error> {
        for cavity in cavities(place.mesh, t)? {
            if work.is_done() {
                break;
            }
            let filled = self.fill(place, points, &cavity)?;
            work.spend(
                work::STEP * u64::from(self.reconnect.steps()) + work::EXACT_TET * cavity.len() as u64,
            );
            if filled && place.put(&cavity, &self.new)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Fills a cavity with positive tetrahedra into `self.new`.
    fn fill(&mut self, place: &Place, points: &Points, cavity: &[u32]) -> Result<bool, Error> {
        self.cavity.set(cavity)?;
        self.cavity.bound(place.mesh, &Terms::keep(&place.edges))?;
        if self.cavity.vertex_count() > MOST_VERTICES {
            return Ok(false);
        }
        self.new.clear();
        let polyhedron =
            Polyhedron { faces: &self.cavity.faces, inner: &self.cavity.inner, edges: &self.cavity.edges };
        self.reconnect.fill(points, &polyhedron, BUDGET, &mut self.new)
    }
}

/// The face bounds every cavity: it is a subface, or a face of the convex hull.
pub fn is_closed(mesh: &Mesh, code: u32) -> bool {
    mesh.is_subface(code) || mesh.is_ghost(mesh.across(code) >> 2)
}

/// The cavities to try, in this order: with each neighbour, round each edge, at each vertex, and all within more and more faces; each
/// sorted by slots.
fn cavities(mesh: &Mesh, t: u32) -> Result<Vec<Vec<u32>>, Error> {
    let mut list: Vec<Vec<u32>> = Vec::new();
    let verts = mesh.verts(t);
    list.try_reserve(4 + EDGE.len() + 4 + MOST_LAYERS)?;
    for f in 0..4 {
        if !is_closed(mesh, 4 * t + f) {
            fallible::push(&mut list, fallible::copied(&[t, mesh.across(4 * t + f) >> 2])?)?;
        }
    }
    for [i, j] in EDGE {
        fallible::push(&mut list, around(mesh, t, &[verts[i as usize], verts[j as usize]])?)?;
    }
    for v in verts {
        fallible::push(&mut list, around(mesh, t, &[v])?)?;
    }
    let mut layers = fallible::copied(&[t])?;
    let mut from = 0;
    for _ in 0..MOST_LAYERS {
        let to = layers.len();
        for i in from..to {
            add_neighbors(mesh, layers[i], &[], &mut layers)?;
        }
        from = to;
        fallible::push(&mut list, fallible::copied(&layers)?)?;
    }
    for cavity in &mut list {
        cavity.sort_unstable();
    }
    list.retain(|cavity| cavity.len() <= MOST_TETS);
    let mut sizes = fallible::collect(list.iter().map(Vec::len).zip(0..))?;
    sizes.sort_unstable();
    let mut sorted = fallible::reserved(list.len())?;
    for (_, i) in sizes {
        fallible::push(&mut sorted, std::mem::take(&mut list[i]))?;
    }
    sorted.dedup();
    Ok(sorted)
}

/// The tetrahedra that have all of `common`, from `t` across faces that are open.
fn around(mesh: &Mesh, t: u32, common: &[u32]) -> Result<Vec<u32>, Error> {
    let mut list = fallible::copied(&[t])?;
    let mut next = 0;
    while next < list.len() && list.len() <= MOST_TETS {
        add_neighbors(mesh, list[next], common, &mut list)?;
        next += 1;
    }
    Ok(list)
}

/// Adds the neighbours of `t` across faces that are open and have all of `common`.
fn add_neighbors(mesh: &Mesh, t: u32, common: &[u32], list: &mut Vec<u32>) -> Result<(), Error> {
    for code in 4 * t..4 * t + 4 {
        let n = mesh.across(code) >> 2;
        let face = mesh.face(code);
        if !is_closed(mesh, code) && common.iter().all(|v| face.contains(v)) && !list.contains(&n) {
            fallible::push(list, n)?;
        }
    }
    Ok(())
}
