//! Keeping the surface as it is: a tetrahedralization without points on it.
//!
//! First, edges and faces missing from the Delaunay tetrahedralization are recovered by reconnecting tetrahedra ([`recover`]), with points
//! on the edges that resist; if that is given up, the constrained Delaunay tetrahedralization is used instead. Then points on the surface
//! are removed ([`from_constrained`], [`release`]): the domain is carved out ([`carve`]), the points on segments are removed, patches get the
//! surface's triangles again, unneeded points inside are removed, and the others move to better positions. Finally bad tetrahedra are
//! reconnected ([`mod@improve`]). Where doubles leave a point no room, small surfaces are filled as a [`whole`], without points.
//!
//! If only the outer boundary is kept, points on segments inside ([`internal`]) may stay, and patches inside keep their triangles where the
//! surface's would need points. Such points get positions in doubles ([`mod@settle`]) at the very end: until then they are exactly on their
//! segments, and every step tests them there.
pub mod improve;
pub mod inside;
pub mod internal;
pub mod memory;
pub mod recover;
pub mod release;
pub mod settle;
pub mod star;
pub mod whole;

use crate::error::Error;
use crate::facets::subface::Subfaces;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::face_key;
use crate::kernel::lookup::Lookup;
use crate::kernel::Mesh;
use crate::ops::hollow::Growth;
use crate::ops::smooth::smooth;
use crate::output::PreserveStatistics;
use crate::predicates::Points;
use crate::preserve::release::facets::{name_facets, Gone};
use crate::preserve::release::inside::Thin;
use crate::preserve::release::patches::{Retarget, Target};
use crate::segments::recovery::Segments;
use inside::Inside;
use internal::Internal;
use rustc_hash::FxHashMap;
use settle::Settled;

/// Default number of steps per search.
const BUDGET: u32 = 200;

/// How far the surroundings of a point grow before points inside are used, and how far those of a flip.
const SOME: Growth = Growth { budget: 50, branches: 3, tries: 24 };
const MORE: Growth = Growth { budget: 50, branches: 3, tries: 60 };

/// Carves the domain out of a constrained mesh with regions, and names its subfaces by their patches.
///
/// # Errors
/// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn carve(mesh: &mut Mesh, vertex_count: usize, subfaces: &Subfaces) -> Result<(), Error> {
    mesh.carve(vertex_count)?;
    let keys = subfaces.verts.iter().zip(&subfaces.patch).map(|(&corners, &patch)| {
        let [a, b, c] = face_key(corners);
        (a, [b, c], patch)
    });
    let patch_of = Lookup::new(vertex_count, keys)?;
    mesh.name_subfaces(|mesh, code| {
        let [a, b, c] = face_key(mesh.face(code));
        patch_of.get(a, [b, c])
    })?;
    mesh.track();
    Ok(())
}

/// What [`from_constrained`] has left.
#[derive(Clone, Debug, Default)]
pub struct Freed {
    /// The points inside.
    pub inside: Inside,
    /// Points on internal segments.
    pub settled: Vec<Settled>,
    /// The surface's faces, and the facet of each.
    pub subfaces: Vec<([u32; 3], u32)>,
}

/// Where a point inside has no valid position in doubles.
#[derive(Clone, Copy, Debug)]
pub enum Spot {
    /// At a point on a segment with these ends (vertex ids), which must go.
    Edge([u32; 2], [f64; 3]),
    /// At a triangle of this facet, which must come.
    Facet(u32, [f64; 3]),
}

/// Why there is no mesh.
#[derive(Clone, Debug)]
pub enum Failure {
    /// Doubles are too coarse at these places.
    Crowded(Vec<Spot>),
    /// Something else.
    Other(Error),
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Failure::Other(error.into())
    }
}

/// Takes all points off the surface, or off the outer boundary; the mesh then has the target's triangles as faces.
///
/// # Errors
/// [`Failure::Crowded`] if a point inside has no valid position in doubles;
/// [`Status::Cancelled`](crate::Status::Cancelled), [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn from_constrained(
    mesh: &mut Mesh,
    points: &mut Points,
    segments: &Segments,
    target: &Target,
    mut inside: Inside,
    statistics: &mut PreserveStatistics,
    tick: &mut dyn FnMut(f64) -> Result<(), Error>,
) -> Result<Freed, Failure> {
    inside.sweep(mesh);
    let mut internal = Internal::find(target.preserve, mesh, segments)?;
    let mut done = 0.0;
    let mut tick = |f: f64| {
        done = f.max(done);
        tick(done)
    };
    loop {
        let start = internal
            .any_may_stay()
            .then(|| Ok::<_, Error>((mesh.copied()?, points.clone(), inside.clone(), statistics.clone())))
            .transpose()?;
        let terms = Terms { segments, target, internal: &internal };
        let (mut freed, staying) = free(mesh, points, terms, inside, statistics, &mut tick)?;
        let (settled, crowded) = settle::settle(mesh, points, segments, &staying)?;
        let Some(start) = start.filter(|_| !crowded.is_empty()) else {
            statistics.on_internal_facets = settled.len() as u64;
            freed.settled = settled;
            return Ok(freed);
        };
        // These have no valid position in doubles, so they must be removed as well.
        internal.forbid(&crowded);
        (*mesh, *points, inside, *statistics) = start;
    }
}

/// The requirements on the surface after its Steiner points are removed.
#[derive(Clone, Copy)]
struct Terms<'a> {
    segments: &'a Segments,
    target: &'a Target<'a>,
    /// What may keep its points.
    internal: &'a Internal,
}

/// Removes the points that must go; also returns those that stay, still exactly on their segments, so that every tetrahedron is positive
/// there and stays so while others get doubles.
fn free(
    mesh: &mut Mesh,
    points: &mut Points,
    terms: Terms,
    mut inside: Inside,
    statistics: &mut PreserveStatistics,
    tick: &mut dyn FnMut(f64) -> Result<(), Error>,
) -> Result<(Freed, Vec<u32>), Failure> {
    let removal = release::schedule::remove_all(mesh, points, terms, &mut inside, &mut |f| tick(0.6 * f))?;
    let Terms { segments, target, internal } = terms;
    statistics.deleted += removal.deleted;
    statistics.relocated += removal.relocated;
    if !removal.left.is_empty() {
        let spot = |&v: &u32| {
            let segment = segments.steiner_segment[(v - segments.first_steiner) as usize];
            Spot::Edge(segments.ends[segment as usize], *points.xyz(v))
        };
        return Err(Failure::Crowded(fallible::collect(removal.left.iter().map(spot))?));
    }
    let isolated = removal.isolated;
    let growth = Growth { budget: BUDGET, ..MORE };
    let flips = Retarget::new(mesh, points, &mut inside, &isolated, &internal.patches, growth).run(
        target,
        segments.first_steiner,
        &mut |f| tick(0.6 + 0.2 * f),
    )?;
    if !flips.missing.is_empty() {
        let missing = target.triangles.iter().zip(target.facet).filter(|(t, _)| flips.missing.contains(t));
        let spots = missing.map(|(t, &facet)| {
            let [a, b, c] = t.map(|v| points.xyz(v));
            Spot::Facet(facet, [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0))
        });
        return Err(Failure::Crowded(fallible::collect(spots)?));
    }
    if !inside.list.is_empty() {
        let mut thin = Thin::default();
        let rounds = [Growth { budget: BUDGET, tries: 0, ..SOME }, SOME, MORE];
        for (i, growth) in rounds.into_iter().enumerate() {
            let done = 0.8 + 0.2 * i as f64 / rounds.len() as f64;
            thin.run(mesh, points, &mut inside, &isolated, growth, &mut || tick(done))?;
        }
        smooth_inside(mesh, points, &inside)?;
    }
    improve::improve(mesh, points, &isolated, &mut || tick(0.99))?;
    statistics.interior = inside.list.len() as u64;
    let subfaces = subfaces(mesh, points, target, internal)?;
    Ok((Freed { inside, settled: Vec::new(), subfaces }, removal.staying))
}

/// Sweeps over all points inside.
const SWEEPS: usize = 3;

/// Moves the points inside to better positions.
fn smooth_inside(mesh: &Mesh, points: &mut Points, inside: &Inside) -> Result<(), Error> {
    let mut search = StarSearch::default();
    let mut faces = Vec::new();
    for _ in 0..SWEEPS {
        for &p in &inside.list {
            search.link(mesh, p, &mut faces)?;
            smooth(points, p, &faces)?;
        }
    }
    Ok(())
}

/// The surface's faces: its triangles, except those that polygons and internal patches have replaced.
fn subfaces(
    mesh: &Mesh,
    points: &Points,
    target: &Target,
    internal: &Internal,
) -> Result<Vec<([u32; 3], u32)>, Error> {
    let mut out = Vec::new();
    out.try_reserve(target.triangles.len())?;
    let any_will_do =
        |facet: u32, patch: u32| facet >= target.first_polygon || internal.patches.contains(&patch);
    let all = || target.triangles.iter().zip(target.patch).zip(target.facet);
    if !all().any(|((_, &patch), &facet)| any_will_do(facet, patch)) {
        out.extend(all().map(|((&corners, _), &facet)| (corners, facet)));
        return Ok(out);
    }
    let mut left: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    let mut in_mesh: Vec<u32> = Vec::new();
    for code in mesh.subfaces() {
        left.try_reserve(1)?;
        left.insert(face_key(mesh.face(code)), mesh.subface(code));
        fallible::push(&mut in_mesh, mesh.subface(code))?;
    }
    in_mesh.sort_unstable();
    in_mesh.dedup();
    let mut gone: Vec<Gone> = Vec::new();
    for ((&corners, &patch), &facet) in all() {
        let there = left.remove(&face_key(corners)).is_some();
        if there || !any_will_do(facet, patch) || in_mesh.binary_search(&patch).is_err() {
            out.push((corners, facet));
        } else {
            gone.try_reserve(1)?;
            gone.push(Gone { patch, corners, facet });
        }
    }
    let mut others: Vec<(u32, [u32; 3])> = Vec::new();
    others.try_reserve(left.len())?;
    others.extend(left.into_iter().map(|(face, patch)| (patch, face)));
    others.sort_unstable();
    name_facets(points, &mut gone, &others, &mut out)?;
    Ok(out)
}

#[cfg(test)]
mod tests;
#[cfg(test)]
mod whole_tests;
