//! A small surface in the convex hull of its points: all of it is one polyhedron to fill.
//!
//! Between facets an ulp apart, points that the constrained Delaunay tetrahedralization takes may have no counterpart in doubles, while a
//! tetrahedralization with other points exists, or one with none. The walls of the polyhedron are the faces of the convex hull and the
//! triangles of the surface, these from both sides; [`Reconnect`] searches.
//!
//! Points inside: where two edges cross each other an ulp apart, the tetrahedron that they span must be there, or thinner ones between
//! them, whose other corners are on neither edge but within an ulp or two of one. Hence, if there is no filling without points, points at
//! random near edges are tried: a filling is found after some hundred sets, each of which takes some hundred steps.
//!
//! Points of no facet and no segment are left out of the search and added afterwards: one inside splits the tetrahedra that it is in or
//! on, one outside is joined to the faces of the hull that it sees.
use crate::control::Control;
use crate::delaunay::Construction;
use crate::error::{Error, Status};
use crate::fallible;
use crate::kernel::face_key;
use crate::kernel::ghosts::outer_faces;
use crate::kernel::tables::FACE;
use crate::kernel::Mesh;
use crate::ops::place::step;
use crate::ops::reconnect::{Polyhedron, Reconnect, MOST_VERTICES};
use crate::predicates::{in_range, Points, Sign};
use crate::preserve::release::segments::axis_of;

/// Steps of the search without points, of one with points, and of all: less than half a second. None of the models measured reaches this
/// search.
const FIRST: u32 = 20_000;
const BUDGET: u32 = 500;
const TOTAL: u32 = 200_000;
/// What a set of points costs besides, in steps.
const SET: u32 = 10;
/// The most points inside. Of 27 small inputs that had no mesh before, 13 need no point, 13 one or more; the last gets none.
const MOST_INSIDE: u32 = 4;

/// The most points added afterwards: each takes a pass over all tetrahedra.
const MOST_LOOSE: usize = 500;

/// What the tetrahedralization must have.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'a> {
    /// Triangles that must be faces, in vertex ids.
    pub triangles: &'a [[u32; 3]],
    /// Edges, those of the triangles among them, as sorted pairs in ascending order.
    pub edges: &'a [[u32; 2]],
}

/// Makes a tetrahedralization of the points that has all triangles and edges, and returns the points added inside. `None`, with
/// nothing changed, if there are too many vertices or none was found.
///
/// # Errors
/// `Cancelled`, `OutOfMemory`, `Internal`, `TooLarge`.
pub fn fill_hull(
    mesh: &mut Mesh,
    points: &mut Points,
    wanted: Wanted,
    control: &Control,
) -> Result<Option<Vec<u32>>, Error> {
    let count = points.len();
    let Some(mut walls) = Walls::collect(points, wanted, control)? else { return Ok(None) };
    let mut reconnect = Reconnect::new(control);
    let mut random = Random(1);
    let mut left = TOTAL;
    for set in 0u32.. {
        control.look()?;
        points.truncate(count);
        walls.inner.truncate(walls.ends);
        // Half of the sets have one point, a quarter two, and so on.
        let inside = if set == 0 { 0 } else { (1 + set.trailing_zeros()).min(MOST_INSIDE) };
        let mut edge = [0; 2];
        for k in 0..inside {
            // Two near each edge, one on either side of where it all but crosses another.
            if k % 2 == 0 {
                edge = wanted.edges[random.next(wanted.edges.len())];
            }
            let at = random.near(points, edge);
            if at.into_iter().all(in_range) {
                fallible::push(&mut walls.inner, points.push(at)?)?;
            }
        }
        let mut tets = Vec::new();
        let polyhedron = Polyhedron { faces: &walls.faces, inner: &walls.inner, edges: wanted.edges };
        let budget = if set == 0 { FIRST } else { BUDGET };
        if reconnect.fill(points, &polyhedron, budget, &mut tets)? {
            for &v in &walls.loose {
                control.look()?;
                add(points, &mut tets, v)?;
            }
            *mesh = Mesh::of_tetrahedra(&tets, points.len())?;
            return Ok(Some(fallible::copied(&walls.inner[walls.ends..])?));
        }
        left = left.saturating_sub(reconnect.steps() + SET);
        if left == 0 {
            break;
        }
    }
    points.truncate(count);
    Ok(None)
}

/// The polyhedron, and what is not part of it.
#[derive(Default)]
struct Walls {
    faces: Vec<[u32; 3]>,
    /// Vertices of edges.
    vertices: Vec<u32>,
    /// Vertices on no face: first ends of edges.
    inner: Vec<u32>,
    /// The number of these.
    ends: usize,
    /// Vertices of no edge.
    loose: Vec<u32>,
}

impl Walls {
    /// `None` if there are too many vertices, or those of the polyhedron are all in one plane.
    fn collect(points: &Points, wanted: Wanted, control: &Control) -> Result<Option<Walls>, Error> {
        let mut walls = Walls::default();
        let mut used = fallible::filled(false, points.len())?;
        for &v in wanted.edges.iter().flatten() {
            if walls.vertices.len() + MOST_INSIDE as usize > MOST_VERTICES {
                return Ok(None);
            }
            if !std::mem::replace(&mut used[v as usize], true) {
                fallible::push(&mut walls.vertices, v)?;
            }
        }
        walls.loose = fallible::collect((0..points.len() as u32).filter(|&v| !used[v as usize]))?;
        if walls.loose.len() > MOST_LOOSE {
            return Ok(None);
        }
        let mut hull = Construction::default();
        match hull.build(points, &mut fallible::copied(&walls.vertices)?, control) {
            Err(e) if e.status == Status::DegenerateInput => return Ok(None),
            built => built?,
        }
        let mesh = &hull.mesh;
        let ghosts = (0..mesh.slot_count() as u32).filter(|&t| mesh.is_live(t) && mesh.is_ghost(t));
        let outside = ghosts.map(|t| mesh.face(mesh.across(4 * t + 3)));
        walls.faces = fallible::collect(outside)?;
        for &edge in wanted.edges {
            control.step()?;
            insert_in_hull(points, &mut walls.faces, edge)?;
        }
        let mut known = fallible::collect(walls.faces.iter().map(|&face| face_key(face)))?;
        known.sort_unstable();
        walls.faces.try_reserve(2 * wanted.triangles.len())?;
        for &[a, b, c] in wanted.triangles {
            if known.binary_search(&face_key([a, b, c])).is_err() {
                fallible::extend(&mut walls.faces, [[a, b, c], [a, c, b]])?;
            }
        }
        walls.faces.iter().flatten().for_each(|&v| used[v as usize] = false);
        let inner = walls.vertices.iter().copied().filter(|&v| used[v as usize]);
        walls.inner = fallible::collect(inner)?;
        walls.ends = walls.inner.len();
        Ok(Some(walls))
    }
}

/// Two faces of the hull in one plane, the first with the edge of the first two corners: `c d p` and `d c q`.
#[derive(Clone, Copy)]
struct Pair {
    faces: [usize; 2],
    corners: [u32; 4],
}

/// Makes a pair of vertices an edge of the hull if it is in one of its planes: flips the edges that it crosses (Sloan 1993).
fn insert_in_hull(points: &Points, faces: &mut [[u32; 3]], [a, b]: [u32; 2]) -> Result<(), Error> {
    for round in 0..faces.len() * faces.len() {
        let turned = faces.iter().flat_map(|&[x, y, z]| [[x, y, z], [y, z, x], [z, x, y]]);
        let mut crossing: Vec<Pair> = Vec::new();
        for (i, [c, d, p]) in turned.enumerate() {
            if [c, d] == [a, b] || [d, c] == [a, b] {
                return Ok(());
            }
            let flat = |v| points.orient3d(c, d, p, v) == Sign::Zero;
            if c > d || [c, d].contains(&a) || [c, d].contains(&b) || !flat(a) || !flat(b) {
                continue;
            }
            let other = faces.iter().position(|f| (0..3).any(|k| f[k] == d && f[(k + 1) % 3] == c));
            let (Some(j), Some(axis)) = (other, axis_of(points, &[c, d, p])) else { continue };
            let Some(q) = faces[j].into_iter().find(|&v| v != c && v != d && flat(v)) else { continue };
            let apart = |[x, y]: [u32; 2], [v, w]: [u32; 2]| {
                let [v, w] = [v, w].map(|v| points.orient_in_plane(axis, x, y, v));
                v != Sign::Zero && v == -w
            };
            if apart([c, d], [a, b]) && apart([a, b], [c, d]) && apart([p, q], [c, d]) {
                fallible::push(&mut crossing, Pair { faces: [i / 3, j], corners: [c, d, p, q] })?;
            }
        }
        if crossing.is_empty() {
            return Ok(());
        }
        // Not always the same, or the flips might go back and forth.
        let Pair { faces: [i, j], corners: [c, d, p, q] } = crossing[round % crossing.len()];
        faces[i] = [p, c, q];
        faces[j] = [q, d, p];
    }
    Ok(())
}

/// Numbers that look random (Knuth's multiplier).
pub(super) struct Random(pub u64);

impl Random {
    /// A number below `count`.
    pub fn next(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) % count as u64) as usize
    }

    /// A point on an edge, between its ends, up to rounding and up to one double more or less in each coordinate.
    fn near(&mut self, points: &Points, edge: [u32; 2]) -> [f64; 3] {
        let [a, b] = edge.map(|v| *points.xyz(v));
        let t = (1 + self.next(1023)) as f64 / 1024.0;
        std::array::from_fn(|k| {
            let beside = [0, -1, 0, 1][self.next(4)];
            step(a[k] + t * (b[k] - a[k]), beside)
        })
    }
}

/// Adds a vertex to a tetrahedralization of a convex domain, all of whose constraints it misses.
fn add(points: &Points, tets: &mut Vec<[u32; 4]>, v: u32) -> Result<(), Error> {
    let mut new: Vec<[u32; 4]> = fallible::reserved(4 * tets.len())?;
    let mut kept = 0;
    for i in 0..tets.len() {
        let faces = FACE.map(|face| face.map(|k| tets[i][k as usize]));
        let sides = faces.map(|[x, y, z]| points.orient3d(v, x, y, z));
        if sides.contains(&Sign::Negative) {
            tets[kept] = tets[i];
            kept += 1;
            continue;
        }
        // Faces through the point are between two of these, or around it.
        let ahead = faces.iter().zip(sides).filter(|(_, side)| *side == Sign::Positive);
        fallible::extend(&mut new, ahead.map(|(&[x, y, z], _)| [v, x, y, z]))?;
    }
    tets.truncate(kept);
    if new.is_empty() {
        let hull = outer_faces(tets)?;
        new.try_reserve(hull.len())?;
        let seen = hull.into_iter().filter(|&[x, y, z]| points.orient3d(v, x, y, z) == Sign::Negative);
        fallible::extend(&mut new, seen.map(|[x, y, z]| [v, x, z, y]))?;
    }
    fallible::append(tets, &new)?;
    Ok(())
}
