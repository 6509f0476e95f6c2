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

use crate::control::{Control, Part};
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
use rustc_hash::{FxHashMap, FxHashSet};
use settle::Settled;
use std::collections::TryReserveError;

/// Default number of steps per search: more fill more polyhedra, but what cannot be filled costs all of them. On eleven models with 22
/// points inside 100 changes none, 400 one mesh, but never their number.
const BUDGET: u32 = 200;

/// How far the surroundings of a point grow before points inside are used: time for fewer points inside. On eleven models with 22 points
/// inside one branch in both takes two fewer (three meshes changed), six as many (one mesh changed). There 12 tries changes none, 48 one
/// mesh, but never their number. With one branch two models with ten points inside take 2.2 to 2.4 times as long.
const SOME: Growth = Growth { budget: 50, branches: 3, tries: 24 };
/// How far those of a flip, and in the end those of points inside. On eleven models with 22 points inside 30 tries takes as many (none
/// changed), 120 three fewer (one mesh changed). Half of both budgets and double change nothing on eleven models: it only bounds the work
/// on worse ones. With 120 tries two models with ten points inside take 1.5 to 2 times as long.
const MORE: Growth = Growth { budget: 50, branches: 3, tries: 60 };

/// Sweeps over all points inside: time for better tetrahedra. On six models with 22 points inside 1 changes two meshes, 6 one mesh, but
/// never their number.
const SWEEPS: usize = 3;

/// Carves the domain out of a constrained mesh with regions, and names its subfaces by their patches.
///
/// # Errors
/// [`Status::OutOfMemory`](crate::Status::OutOfMemory), and what ends the run.
pub fn carve(
    mesh: &mut Mesh,
    vertex_count: usize,
    subfaces: &Subfaces,
    control: &Control,
) -> Result<(), Error> {
    mesh.carve(vertex_count, control)?;
    control.look()?;
    let keyed = |(&corners, &patch): (&[u32; 3], &u32)| {
        let [a, b, c] = face_key(corners);
        (a, [b, c], patch)
    };
    let keys = || subfaces.verts.iter().zip(&subfaces.patch).map(keyed);
    let patch_of = Lookup::new(vertex_count, keys, control)?;
    control.look()?;
    let name = |mesh: &Mesh, code| {
        let [a, b, c] = face_key(mesh.face(code));
        patch_of.get(a, [b, c])
    };
    mesh.name_subfaces(name, control)?;
    mesh.track();
    Ok(())
}

/// What [`from_constrained`] has left.
#[derive(Debug, Default)]
pub struct Freed {
    /// The points inside.
    pub inside: Inside,
    /// Points on internal segments.
    pub settled: Vec<Settled>,
    /// Edges on no facet that must stay.
    pub isolated: FxHashSet<[u32; 2]>,
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
#[derive(Debug)]
pub enum Failure {
    /// Doubles are too coarse at these places.
    Crowded(Vec<Spot>),
    /// Something else.
    Other(Error),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Failure::Other(error)
    }
}

impl From<TryReserveError> for Failure {
    fn from(short: TryReserveError) -> Self {
        Failure::Other(Error::from(short))
    }
}

/// Takes all points off the surface, or off the outer boundary; the mesh then has the target's triangles as faces.
///
/// # Errors
/// [`Failure::Crowded`] if a point inside has no valid position in doubles;
/// [`Status::OutOfMemory`](crate::Status::OutOfMemory), and what ends the run.
pub fn from_constrained(
    mesh: &mut Mesh,
    points: &mut Points,
    segments: &Segments,
    target: &Target,
    mut inside: Inside,
    statistics: &mut PreserveStatistics,
    part: Part,
) -> Result<Freed, Failure> {
    inside.sweep(mesh);
    let mut internal = Internal::find(target.preserve, mesh, segments, &part)?;
    loop {
        let start = internal
            .any_may_stay()
            .then(|| {
                part.control().room(mesh.bytes() + points.len() * size_of::<[f64; 3]>())?;
                Ok::<_, Error>((mesh.copied()?, points.copied()?, inside.copied()?, *statistics))
            })
            .transpose()?;
        let terms = Terms { segments, target, internal: &internal };
        let (mut freed, staying) = free(mesh, points, terms, inside, statistics, part)?;
        let (settled, crowded) = settle::settle(mesh, points, segments, &staying, &part)?;
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
    part: Part,
) -> Result<(Freed, Vec<u32>), Failure> {
    let removal = release::schedule::remove_all(mesh, points, terms, &mut inside, part.part(0.0, 0.6))?;
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
    let flips = part.part(0.6, 0.8);
    let flips = Retarget::new(mesh, points, &mut inside, &isolated, &internal.patches, growth, flips)
        .run(target, segments.first_steiner)?;
    if !flips.missing.is_empty() {
        let missing = target.triangles.iter().zip(target.facet).filter(|(t, _)| flips.missing.contains(t));
        let spots = missing.map(|(t, &facet)| {
            let [a, b, c] = t.map(|v| points.xyz(v));
            Spot::Facet(facet, [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0))
        });
        return Err(Failure::Crowded(fallible::collect(spots)?));
    }
    if !inside.list.is_empty() {
        let mut thin = Thin::new(&part);
        let rounds = [Growth { budget: BUDGET, tries: 0, ..SOME }, SOME, MORE];
        for (i, growth) in rounds.into_iter().enumerate() {
            part.progress(0.8 + 0.2 * i as f64 / rounds.len() as f64)?;
            thin.run(mesh, points, &mut inside, &isolated, growth)?;
        }
        smooth_inside(mesh, points, &inside, &part)?;
    }
    part.progress(0.99)?;
    improve::improve(mesh, points, &isolated, &part)?;
    statistics.interior = inside.list.len() as u64;
    let subfaces = subfaces(mesh, points, target, internal)?;
    Ok((Freed { inside, settled: Vec::new(), isolated, subfaces }, removal.staying))
}

/// Moves the points inside to better positions.
fn smooth_inside(mesh: &Mesh, points: &mut Points, inside: &Inside, control: &Control) -> Result<(), Error> {
    let mut search = StarSearch::default();
    let mut faces = Vec::new();
    for _ in 0..SWEEPS {
        for &p in &inside.list {
            control.look()?;
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
    let mut out = fallible::reserved(target.triangles.len())?;
    let any_will_do =
        |facet: u32, patch: u32| facet >= target.first_polygon || internal.patches.contains(&patch);
    let all = || target.triangles.iter().zip(target.patch).zip(target.facet);
    if !all().any(|((_, &patch), &facet)| any_will_do(facet, patch)) {
        fallible::extend(&mut out, all().map(|((&corners, _), &facet)| (corners, facet)))?;
        return Ok(out);
    }
    let mut left: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    let mut in_mesh: Vec<u32> = Vec::new();
    for code in mesh.subfaces() {
        fallible::insert(&mut left, face_key(mesh.face(code)), mesh.subface(code))?;
        fallible::push(&mut in_mesh, mesh.subface(code))?;
    }
    in_mesh.sort_unstable();
    in_mesh.dedup();
    let mut gone: Vec<Gone> = Vec::new();
    for ((&corners, &patch), &facet) in all() {
        let there = left.remove(&face_key(corners)).is_some();
        if there || !any_will_do(facet, patch) || in_mesh.binary_search(&patch).is_err() {
            fallible::push(&mut out, (corners, facet))?;
        } else {
            fallible::push(&mut gone, Gone { patch, corners, facet })?;
        }
    }
    let mut others: Vec<(u32, [u32; 3])> =
        fallible::collect(left.into_iter().map(|(face, patch)| (patch, face)))?;
    others.sort_unstable();
    name_facets(points, &mut gone, &others, &mut out)?;
    Ok(out)
}

#[cfg(test)]
mod tests;
#[cfg(test)]
mod whole_tests;
