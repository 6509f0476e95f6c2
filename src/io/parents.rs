//! `.parents`, next to TetGen's files: what these cannot express and an exact check needs. A plain text format of delotet, numbered from 0.
//!
//! First line: the numbers of Steiner points (the last points of `.node`), of faces (those of `.face`) and of facet flips; 1 if the convex
//! hull was kept, otherwise 0; the numbers of tetrahedra replaced by rounding and of unmeshed faces and edges; and what the mesh
//! guarantees: 0 constrained Delaunay, 1 Delaunay, 2 the surface kept, 3 the outer boundary kept, 4 the faces of a given
//! mesh kept, 5 conforming, 6 weighted Delaunay. Then a line per Steiner point: the two
//! ends `a` and `b` of its edge (input points), the input segment or -1, and the parameter `t` with any further terms of it: exactly, the
//! point is `a + t (b − a)`. For a point on a facet: `f`, the facet, points `a`, `b` and `c` of its plane, `t` and `u`: exactly, it is
//! `a + t (b − a) + u (c − a)`; or -1 three times if its doubles are its position. Then a line per face: its input facet. Then a line per
//! flip, in order: the old edge, the new edge, the two facets. Then a line per replaced tetrahedron, ascending: its number. Then a line per piece of a facet that bounds no tetrahedron: its
//! corners, its facet, its marker; and one per piece of an edge that no tetrahedron has: its ends, its segment or -1, its marker.
//! If points were left out of the mesh, the first line ends with one more number, the number of input points. The lines about unmeshed
//! pieces then use the input's indices. At the end of the file come the number of old points and a line for each with its new index or -1,
//! then the number of Steiner points left out, and for each a line with its coordinates and one as above.
//! Doubles read back bit for bit.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::io::output_files::Out;
use crate::io::text::{bad, float, Line, Lines};
use crate::output::{Dropped, FacetFlip, Guarantee, SteinerPoint, SteinerTerm, Subface, Subsegment, TetMesh};
use crate::INVALID;
use std::io;
use std::iter::Peekable;
use std::slice::Iter;

/// What the numbers of the last field of the first line stand for.
const GUARANTEES: [Guarantee; 7] = [
    Guarantee::ConstrainedDelaunay,
    Guarantee::Delaunay,
    Guarantee::Preserved,
    Guarantee::PreservedOuter,
    Guarantee::Given,
    Guarantee::Conforming,
    Guarantee::WeightedDelaunay,
];

/// Writes the file.
pub(super) fn write(out: &mut Out, mesh: &TetMesh) -> io::Result<()> {
    let counts = [mesh.steiner.len(), mesh.subfaces.len(), mesh.facet_flips.len()];
    let (hull, replaced) = (u8::from(mesh.hull_kept), mesh.replaced.len());
    let (unmeshed_faces, unmeshed_edges) = match &mesh.dropped {
        Some(dropped) => (&dropped.subfaces, &dropped.subsegments),
        None => (&mesh.unmeshed_subfaces, &mesh.unmeshed_subsegments),
    };
    let (faces, edges) = (unmeshed_faces.len(), unmeshed_edges.len());
    let [steiner, subfaces, flips] = counts;
    let guarantee = GUARANTEES.iter().position(|&guarantee| guarantee == mesh.guarantee).unwrap_or(0);
    out.format(format_args!(
        "{steiner}  {subfaces}  {flips}  {hull}  {replaced}  {faces}  {edges}  {guarantee}"
    ))?;
    if let Some(dropped) = &mesh.dropped {
        out.format(format_args!("  {}", dropped.input_point_count))?;
    }
    out.put(b"\n")?;
    let mut terms = mesh.steiner_terms.iter().peekable();
    for (i, point) in mesh.steiner.iter().enumerate() {
        steiner_point(out, point, i, &mut terms)?;
    }
    for face in &mesh.subfaces {
        out.int(or_none(face.facet))?;
        out.put(b"\n")?;
    }
    for flip in &mesh.facet_flips {
        let [a, b] = flip.old;
        let [c, d] = flip.new;
        let [f, g] = flip.facets;
        out.format(format_args!("{a} {b} {c} {d} {f} {g}\n"))?;
    }
    for t in &mesh.replaced {
        out.format(format_args!("{t}\n"))?;
    }
    for face in unmeshed_faces {
        let ([a, b, c], facet) = (face.corners, or_none(face.facet));
        out.format(format_args!("{a} {b} {c} {facet} {}\n", face.marker))?;
    }
    for edge in unmeshed_edges {
        let ([a, b], segment) = (edge.ends, or_none(edge.segment));
        out.format(format_args!("{a} {b} {segment} {}\n", edge.marker))?;
    }
    match &mesh.dropped {
        Some(dropped) => write_dropped(out, dropped),
        None => Ok(()),
    }
}

fn write_dropped(out: &mut Out, dropped: &Dropped) -> io::Result<()> {
    out.format(format_args!("{}\n", dropped.new_index.len()))?;
    for &index in &dropped.new_index {
        out.int(or_none(index))?;
        out.put(b"\n")?;
    }
    out.format(format_args!("{}\n", dropped.steiner.len()))?;
    let mut terms = dropped.steiner_terms.iter().peekable();
    for (i, (at, point)) in dropped.points.iter().zip(&dropped.steiner).enumerate() {
        out.point(at)?;
        out.put(b"\n")?;
        steiner_point(out, point, i, &mut terms)?;
    }
    Ok(())
}

/// Writes the line of Steiner point `i`, with its terms.
fn steiner_point(
    out: &mut Out,
    point: &SteinerPoint,
    i: usize,
    terms: &mut Peekable<Iter<'_, SteinerTerm>>,
) -> io::Result<()> {
    if point.facet != INVALID {
        out.put(b"f ")?;
        out.int(or_none(point.facet))?;
        for v in [point.ends[0], point.ends[1], point.third] {
            out.blank_int(or_none(v))?;
        }
        out.blank_float(point.t)?;
        out.blank_float(point.u)?;
        return out.put(b"\n");
    }
    out.int(point.ends[0])?;
    out.blank_int(point.ends[1])?;
    out.blank_int(or_none(point.segment))?;
    out.blank_float(point.t)?;
    while let Some(term) = terms.next_if(|term| term.steiner as usize == i) {
        out.blank_float(term.value)?;
    }
    out.put(b"\n")
}

fn or_none(index: u32) -> i64 {
    if index == INVALID {
        -1
    } else {
        i64::from(index)
    }
}

/// Reads the file into a mesh that has its points and faces already.
pub(super) fn read(bytes: &[u8], mesh: &mut TetMesh, control: &Control) -> Result<(), Error> {
    let mut lines = Lines::new(bytes, control);
    let mut line = lines.expect("the numbers of Steiner points, faces and flips")?;
    let available = lines.remaining().len();
    let steiner = line.count("the number of Steiner points", 8, available)?;
    let faces = line.count("the number of faces", 2, available)?;
    let flips = line.count("the number of flips", 12, available)?;
    mesh.hull_kept = line.optional_int("whether the hull was kept")?.unwrap_or(0) != 0;
    let replaced = line.optional_int("the number of replaced tetrahedra")?.unwrap_or(0);
    let replaced = usize::try_from(replaced).ok().filter(|&n| n <= mesh.tets.len());
    let Some(replaced) = replaced else {
        return Err(bad(line.number(), "the number of replaced tetrahedra does not match the mesh"));
    };
    let mut unmeshed = |what| -> Result<usize, Error> {
        let count = line.optional_int(what)?.unwrap_or(0);
        let count = usize::try_from(count).ok().filter(|&n| n <= available / 8);
        count.ok_or_else(|| bad(line.number(), format_args!("{what} is too large for the file")))
    };
    let unmeshed_faces = unmeshed("the number of faces that are not meshed")?;
    let unmeshed_edges = unmeshed("the number of edges that are not meshed")?;
    let guarantee = line.optional_int("what the mesh guarantees")?.unwrap_or(0);
    let guarantee = usize::try_from(guarantee).ok().and_then(|i| GUARANTEES.get(i));
    mesh.guarantee =
        *guarantee.ok_or_else(|| bad(line.number(), "what the mesh guarantees is a number from 0 to 3"))?;
    if steiner > mesh.points.len() || faces != mesh.subfaces.len() {
        let message = "the numbers of points and faces do not match the mesh";
        return Err(Error::new(Status::Format, message));
    }
    let inputs = line.optional_int("the number of input points")?;
    mesh.steiner.try_reserve_exact(steiner)?;
    for _ in 0..steiner {
        read_steiner_point(&mut lines, &mut mesh.steiner, &mut mesh.steiner_terms)?;
    }
    for face in &mut mesh.subfaces {
        face.facet = index(&mut lines.expect("the facet of a face")?)?;
    }
    mesh.facet_flips.try_reserve_exact(flips)?;
    for _ in 0..flips {
        let mut line = lines.expect("a flip")?;
        let mut pair = || -> Result<[u32; 2], Error> { Ok([index(&mut line)?, index(&mut line)?]) };
        fallible::push(&mut mesh.facet_flips, FacetFlip { old: pair()?, new: pair()?, facets: pair()? })?;
    }
    mesh.replaced.try_reserve_exact(replaced)?;
    for _ in 0..replaced {
        fallible::push(&mut mesh.replaced, index(&mut lines.expect("a replaced tetrahedron")?)?)?;
    }
    mesh.unmeshed_subfaces.try_reserve_exact(unmeshed_faces)?;
    for _ in 0..unmeshed_faces {
        let mut line = lines.expect("a face that is not meshed")?;
        let corners = [index(&mut line)?, index(&mut line)?, index(&mut line)?];
        let facet = index(&mut line)?;
        let marker = marker(&mut line)?;
        fallible::push(&mut mesh.unmeshed_subfaces, Subface { corners, facet, marker, tets: [INVALID; 2] })?;
    }
    mesh.unmeshed_subsegments.try_reserve_exact(unmeshed_edges)?;
    for _ in 0..unmeshed_edges {
        let mut line = lines.expect("an edge that is not meshed")?;
        let ends = [index(&mut line)?, index(&mut line)?];
        let segment = index(&mut line)?;
        fallible::push(
            &mut mesh.unmeshed_subsegments,
            Subsegment { ends, segment, marker: marker(&mut line)? },
        )?;
    }
    if let Some(inputs) = inputs {
        let mut dropped = read_dropped(&mut lines, inputs)?;
        dropped.subfaces = std::mem::take(&mut mesh.unmeshed_subfaces);
        dropped.subsegments = std::mem::take(&mut mesh.unmeshed_subsegments);
        mesh.dropped = Some(dropped);
    }
    lines.expect_end("line")
}

fn read_dropped(lines: &mut Lines<'_>, inputs: i64) -> Result<Dropped, Error> {
    let mut line = lines.expect("the number of points before")?;
    let count = line.count("the number of points before", 2, lines.remaining().len())?;
    let input_point_count = u32::try_from(inputs).ok().filter(|&n| n as usize <= count);
    let Some(input_point_count) = input_point_count else {
        return Err(bad(line.number(), "there are fewer points than the input has"));
    };
    let mut dropped = Dropped { input_point_count, ..Dropped::default() };
    dropped.new_index.try_reserve_exact(count)?;
    for _ in 0..count {
        fallible::push(&mut dropped.new_index, index(&mut lines.expect("the number of a point")?)?)?;
    }
    let mut line = lines.expect("the number of Steiner points left out")?;
    let count = line.count("the number of Steiner points left out", 8, lines.remaining().len())?;
    dropped.points.try_reserve_exact(count)?;
    dropped.steiner.try_reserve_exact(count)?;
    for _ in 0..count {
        let mut line = lines.expect("the place of a Steiner point")?;
        let mut x = || line.float("a coordinate");
        fallible::push(&mut dropped.points, [x()?, x()?, x()?])?;
        read_steiner_point(lines, &mut dropped.steiner, &mut dropped.steiner_terms)?;
    }
    Ok(dropped)
}

fn read_steiner_point(
    lines: &mut Lines<'_>,
    points: &mut Vec<SteinerPoint>,
    terms: &mut Vec<SteinerTerm>,
) -> Result<(), Error> {
    let mut line = lines.expect("a Steiner point")?;
    if line.skip(b"f") {
        return read_facet_point(&mut line, points);
    }
    let ends = [index(&mut line)?, index(&mut line)?];
    let segment = index(&mut line)?;
    // Points inside lie at their doubles.
    let exact = ends == [INVALID; 2];
    let steiner = points.len() as u32;
    let t = line.float("a parameter")?;
    fallible::push(points, SteinerPoint { ends, t, segment, exact, ..SteinerPoint::INSIDE })?;
    while let Some(token) = line.token() {
        let value = float(token).ok_or_else(|| bad(line.number(), "a term is no number"))?;
        fallible::push(terms, SteinerTerm { steiner, value })?;
    }
    Ok(())
}

/// The rest of the line of a point on a facet: the facet, its frame, and its parameters.
fn read_facet_point(line: &mut Line<'_>, points: &mut Vec<SteinerPoint>) -> Result<(), Error> {
    let facet = index(line)?;
    let ends = [index(line)?, index(line)?];
    let third = index(line)?;
    let (t, u) = (line.float("a parameter")?, line.float("a second parameter")?);
    // Without a frame it lies at its doubles.
    let exact = third == INVALID;
    fallible::push(points, SteinerPoint { ends, t, exact, third, facet, u, ..SteinerPoint::INSIDE })?;
    Ok(())
}

fn marker(line: &mut Line<'_>) -> Result<i32, Error> {
    let value = line.int("a marker")?;
    i32::try_from(value).map_err(|_| bad(line.number(), format_args!("{value} is no marker")))
}

/// An index, or -1 for none. Whether it refers to something is asked by the check.
fn index(line: &mut Line<'_>) -> Result<u32, Error> {
    let value = line.int("an index")?;
    if value == -1 {
        return Ok(INVALID);
    }
    u32::try_from(value).map_err(|_| {
        Error::new(Status::IndexOutOfRange, format_args!("line {}: {value} is no index", line.number()))
    })
}
