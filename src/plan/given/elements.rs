//! From arrays to a mesh: kept faces and edges, regions, neighbours.
//!
//! Kept are the given faces, the boundary, and the faces between different attributes. Regions are connected through the others. They are
//! numbered by attribute, then by their first tetrahedron.
use crate::control::Control;
use crate::error::{DefectKind, Element, Error, Status};
use crate::fallible;
use crate::kernel::tables::EDGE;
use crate::kernel::{edge_key, NONE};
use crate::output::{Guarantee, MeshArrays, Region, SteinerPoint, Subface, Subsegment, TetMesh};
use crate::plan::given::complex::{is_odd, Complex};
use crate::plan::given::faults::Faults;
use crate::INVALID;

/// Makes the mesh.
pub(super) fn assembled(
    arrays: MeshArrays,
    complex: Complex,
    most: usize,
    control: &Control,
) -> Result<TetMesh, Error> {
    let kept = kept_faces(&arrays, &complex, most, control)?;
    let mut is_kept = fallible::filled(0u8, complex.tets.len())?;
    for &(code, ..) in &kept {
        for side in [code, across(&complex, code)].into_iter().filter(|&side| side != NONE) {
            is_kept[(side >> 2) as usize] |= 1 << (side & 3);
        }
    }
    let subsegments = kept_edges(&arrays, &complex, most, control)?;
    let Regions { regions, of } = regions(&arrays, &complex, &is_kept, control)?;
    let mut subfaces = fallible::reserved(kept.len())?;
    for &(code, facet, marker) in &kept {
        control.step()?;
        let listed = arrays.faces.get(facet as usize).map(|f| f.map(|v| complex.alias[v as usize]));
        let face = Face { code, corners: listed.unwrap_or_else(|| complex.face(code)) };
        let (corners, tets) = oriented(face, &complex, &of);
        fallible::push(&mut subfaces, Subface { corners, facet, marker, tets })?;
    }
    let inputs = input_count(&arrays, &complex, &subfaces, &subsegments);
    let mut used = fallible::filled(false, arrays.points.len())?;
    complex.tets.iter().flatten().for_each(|&v| used[v as usize] = true);
    let unused = (0..).zip(&used).filter(|x| !*x.1).map(|x| x.0);
    let unmeshed_points = fallible::collect(unused)?;
    let Complex { mut alias, tets, across, .. } = complex;
    alias.truncate(inputs);
    let beyond = |code: u32| if code == NONE { INVALID } else { code >> 2 };
    Ok(TetMesh {
        input_point_count: inputs as u32,
        point_alias: alias,
        neighbors: fallible::collect(across.iter().map(|codes| codes.map(beyond)))?,
        tets,
        tet_region: of,
        regions,
        subfaces,
        subsegments,
        unmeshed_points,
        steiner: fallible::filled(SteinerPoint::INSIDE, arrays.points.len() - inputs)?,
        points: arrays.points,
        guarantee: Guarantee::Given,
        ..TetMesh::default()
    })
}

fn across(complex: &Complex, code: u32) -> u32 {
    complex.across[(code >> 2) as usize][(code & 3) as usize]
}

/// Corner code, facet and marker of each face that is kept: those given, then the others in the order of tetrahedra.
fn kept_faces(
    arrays: &MeshArrays,
    complex: &Complex,
    most: usize,
    control: &Control,
) -> Result<Vec<(u32, u32, i32)>, Error> {
    let mut faults = Faults::new(&arrays.points, most);
    let mut kept: Vec<(u32, u32, i32)> = fallible::reserved(arrays.faces.len())?;
    let mut is_given = fallible::filled(0u8, complex.tets.len())?;
    for (i, &face) in (0u32..).zip(&arrays.faces) {
        control.step()?;
        let Some(code) = complex.find(face) else {
            faults.add(DefectKind::FacetMissing, Element::Facet(i), None, face[0]);
            continue;
        };
        let given = &mut is_given[(code >> 2) as usize];
        if *given >> (code & 3) & 1 == 0 {
            *given |= 1 << (code & 3);
            let marker = arrays.face_markers.get(i as usize).copied().unwrap_or(0);
            fallible::push(&mut kept, (code, i, marker))?;
        }
    }
    faults.finish(Status::CheckFailed, "a given face is no face of the mesh")?;
    let attribute = |code: u32| arrays.attributes.get((code >> 2) as usize).copied();
    let mut next = arrays.faces.len() as u32;
    for code in 0..4 * complex.tets.len() as u32 {
        let other = across(complex, code);
        let known = |side: u32| is_given[(side >> 2) as usize] >> (side & 3) & 1 == 1;
        let divides = other == NONE || code < other && attribute(code) != attribute(other);
        if divides && !known(code) && (other == NONE || !known(other)) {
            fallible::push(&mut kept, (code, next, 0))?;
            next += 1;
        }
    }
    Ok(kept)
}

/// The edges that are kept.
fn kept_edges(
    arrays: &MeshArrays,
    complex: &Complex,
    most: usize,
    control: &Control,
) -> Result<Vec<Subsegment>, Error> {
    let mut out = Vec::new();
    if arrays.edges.is_empty() {
        return Ok(out);
    }
    let count = arrays.points.len();
    let alias = |v: u32| complex.alias.get(v as usize).copied().unwrap_or(NONE);
    let key = |&[a, b]: &[u32; 2]| edge_key(alias(a), alias(b));
    // Each with its place in the list.
    let mut wanted: Vec<([u32; 2], u32)> = fallible::collect(arrays.edges.iter().map(key).zip(0..))?;
    control.sort(&mut wanted)?;
    let mut is_end = fallible::filled(false, count)?;
    for v in wanted.iter().flat_map(|x| x.0).filter(|&v| v != NONE) {
        is_end[v as usize] = true;
    }
    let mut found = fallible::filled(false, wanted.len())?;
    for tet in &complex.tets {
        control.step()?;
        for edge in EDGE.map(|[i, j]| edge_key(tet[i as usize], tet[j as usize])) {
            if edge.iter().all(|&v| is_end[v as usize]) {
                let at = wanted.partition_point(|x| x.0 < edge);
                if let Some(found) = found.get_mut(at).filter(|_| wanted[at].0 == edge) {
                    *found = true;
                }
            }
        }
    }
    let mut faults = Faults::new(&arrays.points, most);
    let mut kept = Vec::new();
    let mut from = 0;
    for run in wanted.chunk_by(|x, y| x.0 == y.0) {
        // One given twice counts once.
        if found[from] {
            fallible::push(&mut kept, run[0].1)?;
        } else {
            for &(_, i) in run {
                faults.add(DefectKind::SegmentMissing, Element::Segment(i), None, run[0].0[0]);
            }
        }
        from += run.len();
    }
    faults.finish(Status::CheckFailed, "a given edge is no edge of the mesh")?;
    control.sort(&mut kept)?;
    for i in kept {
        let marker = arrays.edge_markers.get(i as usize).copied().unwrap_or(0);
        let ends = arrays.edges[i as usize].map(alias);
        fallible::push(&mut out, Subsegment { ends, segment: i, marker })?;
    }
    Ok(out)
}

struct Regions {
    regions: Vec<Region>,
    /// By tetrahedron.
    of: Vec<u32>,
}

/// Floods between kept faces.
fn regions(
    arrays: &MeshArrays,
    complex: &Complex,
    is_kept: &[u8],
    control: &Control,
) -> Result<Regions, Error> {
    let mut of = fallible::filled(NONE, complex.tets.len())?;
    let mut attributes: Vec<f64> = Vec::new();
    let mut stack = Vec::new();
    for seed in 0..complex.tets.len() {
        if of[seed] != NONE {
            continue;
        }
        let label = attributes.len() as u32;
        // No attributes: each part has a number of its own.
        let own = arrays.attributes.get(seed).copied().unwrap_or(f64::from(label) + 1.0);
        fallible::push(&mut attributes, own + 0.0)?;
        of[seed] = label;
        fallible::push(&mut stack, seed)?;
        while let Some(t) = stack.pop() {
            control.step()?;
            for (f, &code) in complex.across[t].iter().enumerate() {
                let other = (code >> 2) as usize;
                if code != NONE && is_kept[t] >> f & 1 == 0 && of[other] == NONE {
                    of[other] = label;
                    fallible::push(&mut stack, other)?;
                }
            }
        }
    }
    let mut order = fallible::collect(0..attributes.len())?;
    control.sort_by(&mut order, |&x, &y| attributes[x].total_cmp(&attributes[y]).then(x.cmp(&y)))?;
    let mut number = fallible::filled(NONE, order.len())?;
    let mut regions = fallible::reserved(order.len())?;
    for (new, &old) in (0..).zip(&order) {
        number[old] = new;
        fallible::push(&mut regions, Region { attribute: attributes[old], seed: INVALID, max_volume: None })?;
    }
    of.iter_mut().for_each(|label| *label = number[*label as usize]);
    Ok(Regions { regions, of })
}

/// A face with its corners in some order, and one of its corner codes.
#[derive(Clone, Copy)]
struct Face {
    code: u32,
    corners: [u32; 3],
}

/// The corners and tetrahedra of a subface, as [`Subface`] has them.
fn oriented(Face { code, corners }: Face, complex: &Complex, region: &[u32]) -> ([u32; 3], [u32; 2]) {
    let beyond = across(complex, code);
    let other = if beyond == NONE { INVALID } else { beyond >> 2 };
    // The normal of a face points away from its tetrahedron.
    let mut tets = match is_odd(corners) == is_odd(complex.face(code)) {
        true => [code >> 2, other],
        false => [other, code >> 2],
    };
    let [a, b, c] = corners;
    let rank = |t: u32| (region.get(t as usize).copied().unwrap_or(INVALID), t);
    if rank(tets[0]) > rank(tets[1]) {
        tets.swap(0, 1);
        return ([a, c, b], tets);
    }
    (corners, tets)
}

/// How many points are input points: those said to be, and all up to the last one that must stay.
fn input_count(
    arrays: &MeshArrays,
    complex: &Complex,
    subfaces: &[Subface],
    subsegments: &[Subsegment],
) -> usize {
    let count = arrays.points.len();
    let Some(said) = arrays.input_point_count.map(|said| (said as usize).min(count)) else { return count };
    let kept = subfaces.iter().flat_map(|face| face.corners);
    let kept = kept.chain(subsegments.iter().flat_map(|edge| edge.ends));
    // Of equal points all but the first are in no tetrahedron: only input points may be.
    let equal = (0..).zip(&complex.alias).filter(|&(i, &first)| i != first).map(|x| x.0);
    kept.chain(equal).map(|v| v as usize + 1).max().unwrap_or(0).max(said)
}
