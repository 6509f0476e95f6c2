//! TetGen's input formats: `.node` (points), `.poly` and `.smesh` (PLCs). Source: Hang Si, TetGen User's Manual,
//! section 5 "File Formats".
//!
//! `#` starts a comment. Indices start at the first point's number, 0 or 1. The corners of a polygon may go on over
//! several lines. A facet whose polygons all have fewer than three corners is no facet: two corners are a segment, one
//! corner is a point that is there anyway.
use crate::control::Control;
use crate::error::{Element, Error, Status};
use crate::fallible;
use crate::io::surface::{no_such_point, out_of_range};
use crate::io::text::{bad, Line, Lines};
use crate::plc::{Facet, Interior, Plc, RegionSeed, Segment};
use crate::query::NodeOrder;

/// What a `.node` section holds.
#[derive(Default)]
pub(super) struct Nodes {
    /// The points.
    pub points: Vec<[f64; 3]>,
    attribute_count: usize,
    attributes: Vec<f64>,
    markers: Vec<i32>,
    /// The number of the first point: 0 or 1.
    pub base: i64,
}

/// Points and what they carry.
pub(super) struct NodeData {
    pub points: Vec<[f64; 3]>,
    pub attribute_count: usize,
    pub attributes: Vec<f64>,
    pub markers: Vec<i32>,
}

impl Nodes {
    /// What the points are, without their numbers.
    pub fn into_data(self) -> NodeData {
        let Nodes { points, attribute_count, attributes, markers, .. } = self;
        NodeData { points, attribute_count, attributes, markers }
    }

    fn into_plc(self) -> Plc {
        Plc {
            points: self.points,
            point_attribute_count: self.attribute_count,
            point_attributes: self.attributes,
            point_markers: self.markers,
            ..Plc::default()
        }
    }
}

/// Reads a `.node` file: a PLC of points alone.
pub(super) fn read_node(bytes: &[u8], control: &Control) -> Result<Plc, Error> {
    Ok(read_nodes(bytes, control)?.into_plc())
}

/// Reads the points of a `.node` file.
pub(super) fn read_nodes(bytes: &[u8], control: &Control) -> Result<Nodes, Error> {
    let mut lines = Lines::new(bytes, control);
    let nodes = node_section(&mut lines)?;
    lines.expect_end("point")?;
    Ok(nodes)
}

/// Reads a `.poly` file, or with `smesh` an `.smesh` file. `nodes` gives the content of the `.node` file beside it and is
/// asked only if the file has no points of its own.
pub(super) fn read_plc(
    bytes: &[u8],
    smesh: bool,
    nodes: impl FnOnce() -> Result<Vec<u8>, Error>,
    control: &Control,
) -> Result<Plc, Error> {
    let mut lines = Lines::new(bytes, control);
    let mut section = node_section(&mut lines)?;
    if section.points.is_empty() {
        let beside = nodes()?;
        section = read_nodes(&beside, control).map_err(|e| e.at(format_args!(".node file")))?;
    }
    let base = section.base;
    let mut plc = section.into_plc();
    facet_section(&mut lines, &mut plc, base, smesh)?;
    hole_section(&mut lines, &mut plc)?;
    region_section(&mut lines, &mut plc)?;
    lines.expect_end("region")?;
    Ok(plc)
}

/// Whether a `.poly` or `.smesh` file announces no points: they are in the `.node` file beside it.
pub(super) fn lacks_points(bytes: &[u8]) -> bool {
    let free = Control::free();
    let first = Lines::new(bytes, &free).next_line();
    first.and_then(|mut line| line.int("the number of points").ok()) == Some(0)
}

fn node_section(lines: &mut Lines<'_>) -> Result<Nodes, Error> {
    let mut line = lines.expect("the number of points")?;
    let available = lines.remaining().len();
    let count = line.count("the number of points", 8, available)?;
    let dimension = line.optional_int("the dimension")?.unwrap_or(3);
    if dimension != 3 {
        return Err(bad(line.number(), format_args!("the dimension is {dimension}, not 3")));
    }
    let attribute_count = match line.optional_int("the number of attributes")? {
        None => 0,
        Some(n) if n >= 0 && (count as u64).saturating_mul(2 * n as u64) <= available as u64 + 1 => {
            n as usize
        }
        Some(n) => return Err(bad(line.number(), format_args!("{n} attributes per point"))),
    };
    let marked = line.optional_int("whether there are markers")?.unwrap_or(0) != 0;
    let mut nodes = Nodes { attribute_count, ..Nodes::default() };
    nodes.points.try_reserve_exact(count)?;
    nodes.attributes.try_reserve_exact(count.saturating_mul(attribute_count))?;
    nodes.markers.try_reserve_exact(if marked { count } else { 0 })?;
    for i in 0..count {
        let mut line = lines.expect("a point")?;
        let number = line.int("the number of a point")?;
        if i == 0 {
            nodes.base = number;
        }
        if number != nodes.base + i as i64 || !(0..=1).contains(&nodes.base) {
            let what =
                format_args!("point {number} where {} was expected", nodes.base.clamp(0, 1) + i as i64);
            return Err(bad(line.number(), what));
        }
        fallible::push(&mut nodes.points, line.point()?)?;
        for _ in 0..attribute_count {
            fallible::push(&mut nodes.attributes, line.float("an attribute")?)?;
        }
        if marked {
            fallible::push(&mut nodes.markers, line.optional_marker()?)?;
        }
    }
    Ok(nodes)
}

/// The corners of a polygon: the count is read from `line`, which is moved on where they continue on further lines. `facet` has its
/// polygons so far.
fn polygon<'a>(
    lines: &mut Lines<'a>,
    line: &mut Line<'a>,
    plc: &Plc,
    base: i64,
    facet: &Facet,
) -> Result<Vec<u32>, Error> {
    let points = plc.points.len();
    let count = line.count("the number of corners", 2, line.rest().len() + lines.remaining().len())?;
    if count == 0 {
        return Err(bad(line.number(), "a polygon without corners"));
    }
    let mut corners = fallible::reserved(count)?;
    while corners.len() < count {
        let Some(number) = line.optional_int("a point index")? else {
            *line = lines.expect("a point index")?;
            continue;
        };
        match number.checked_sub(base).and_then(|i| usize::try_from(i).ok()) {
            Some(index) if index < points => fallible::push(&mut corners, index as u32)?,
            _ => {
                let (at, last) = (line.number(), base + points as i64 - 1);
                return Err(no_such_point(
                    next_element(plc, facet, count),
                    format_args!("line {at}: point index {number}, but the points are {base} to {last}"),
                ));
            }
        }
    }
    Ok(corners)
}

/// What a polygon of so many corners is a part of, behind those of `facet`; see [`add_facet`].
fn next_element(plc: &Plc, facet: &Facet, corners: usize) -> Element {
    let segments = || facet.polygons.iter().filter(|p| p.len() == 2).count();
    match corners == 2 && facet.polygons.iter().all(|p| p.len() <= 2) {
        true => Element::Segment((plc.segments.len() + segments()) as u32),
        false => Element::Facet(plc.facets.len() as u32),
    }
}

fn facet_section(lines: &mut Lines<'_>, plc: &mut Plc, base: i64, smesh: bool) -> Result<(), Error> {
    let mut line = lines.expect("the number of facets")?;
    let count = line.count("the number of facets", 4, lines.remaining().len())?;
    let marked = line.optional_int("whether there are markers")?.unwrap_or(0) != 0;
    plc.facets.try_reserve(count)?;
    for _ in 0..count {
        let line = lines.expect("a facet")?;
        let mut facet =
            if smesh { smesh_facet(lines, line, plc, base)? } else { poly_facet(lines, line, plc, base)? };
        if !marked {
            facet.marker = 0;
        }
        add_facet(plc, facet)?;
    }
    take_triangles(plc)
}

fn smesh_facet<'a>(lines: &mut Lines<'a>, mut line: Line<'a>, plc: &Plc, base: i64) -> Result<Facet, Error> {
    let corners = polygon(lines, &mut line, plc, base, &Facet::default())?;
    let polygons = fallible::collect([corners])?;
    let marker = line.optional_marker()?;
    Ok(Facet { polygons, holes: Vec::new(), interior: Interior::FirstMinusOthers, marker })
}

fn poly_facet<'a>(lines: &mut Lines<'a>, mut line: Line<'a>, plc: &Plc, base: i64) -> Result<Facet, Error> {
    let polygon_count = line.count("the number of polygons", 4, lines.remaining().len())?;
    if polygon_count == 0 {
        return Err(bad(line.number(), "a facet without polygons"));
    }
    let hole_count = line.optional_int("the number of holes")?.unwrap_or(0);
    if hole_count < 0 || (hole_count as u64).saturating_mul(8) > lines.remaining().len() as u64 {
        return Err(bad(line.number(), format_args!("{hole_count} holes in a facet")));
    }
    let marker = line.optional_marker()?;
    let mut facet = Facet { marker, ..Facet::default() };
    facet.polygons.try_reserve_exact(polygon_count)?;
    for _ in 0..polygon_count {
        let mut line = lines.expect("a polygon")?;
        let corners = polygon(lines, &mut line, plc, base, &facet)?;
        fallible::push(&mut facet.polygons, corners)?;
    }
    for _ in 0..hole_count {
        let mut line = lines.expect("a hole of the facet")?;
        line.int("the number of a hole")?;
        fallible::push(&mut facet.holes, line.point()?)?;
    }
    if polygon_count > 1 || hole_count > 0 {
        facet.interior = Interior::Seeds;
    }
    Ok(facet)
}

/// Adds a facet, or the segments that it is made of if it bounds nothing.
fn add_facet(plc: &mut Plc, facet: Facet) -> Result<(), Error> {
    if facet.polygons.iter().any(|p| p.len() > 2) {
        return Ok(fallible::push(&mut plc.facets, facet)?);
    }
    for polygon in &facet.polygons {
        if let [a, b] = polygon[..] {
            fallible::push(&mut plc.segments, Segment { ends: [a, b], marker: facet.marker })?;
        }
    }
    Ok(())
}

/// Moves the facets to the triangle list if all are triangles; else the numbering would not be the file's.
fn take_triangles(plc: &mut Plc) -> Result<(), Error> {
    let simple = |f: &Facet| f.holes.is_empty() && f.polygons.len() == 1 && f.polygons[0].len() == 3;
    if !plc.facets.iter().all(simple) {
        return Ok(());
    }
    plc.triangles.try_reserve_exact(plc.facets.len())?;
    let marked = plc.facets.iter().any(|f| f.marker != 0);
    plc.triangle_markers.try_reserve_exact(if marked { plc.facets.len() } else { 0 })?;
    for facet in std::mem::take(&mut plc.facets) {
        fallible::extend(&mut plc.triangles, facet.polygons.iter().map(|p| [p[0], p[1], p[2]]))?;
        if marked {
            fallible::push(&mut plc.triangle_markers, facet.marker)?;
        }
    }
    Ok(())
}

fn hole_section(lines: &mut Lines<'_>, plc: &mut Plc) -> Result<(), Error> {
    let Some(mut line) = lines.next_line() else { return Ok(()) };
    let count = line.count("the number of holes", 8, lines.remaining().len())?;
    plc.holes.try_reserve_exact(count)?;
    for _ in 0..count {
        let mut line = lines.expect("a hole")?;
        line.int("the number of a hole")?;
        fallible::push(&mut plc.holes, line.point()?)?;
    }
    Ok(())
}

fn region_section(lines: &mut Lines<'_>, plc: &mut Plc) -> Result<(), Error> {
    let Some(mut line) = lines.next_line() else { return Ok(()) };
    let count = line.count("the number of regions", 10, lines.remaining().len())?;
    plc.regions.try_reserve_exact(count)?;
    for _ in 0..count {
        let mut line = lines.expect("a region")?;
        line.int("the number of a region")?;
        let point = line.point()?;
        let attribute = line.float("the attribute of a region")?;
        let max_volume =
            if line.rest().trim_ascii().is_empty() { None } else { Some(line.float("a volume bound")?) };
        fallible::push(
            &mut plc.regions,
            RegionSeed { point, attribute, max_volume: max_volume.filter(|&v| v > 0.0) },
        )?;
    }
    Ok(())
}

/// What `.node` and `.ele` files hold.
pub(super) struct Tets {
    /// The points.
    pub nodes: Nodes,
    /// How many further nodes there were, in the middle of edges.
    pub middles: usize,
    /// The tetrahedra.
    pub tets: Vec<[u32; 4]>,
    /// The first attribute of each tetrahedron; empty if they have none.
    pub attributes: Vec<f64>,
}

/// Reads a mesh from the contents of its `.node` and `.ele` files. Of tetrahedra of ten nodes the six others must be the middles of
/// the edges, and come after all points.
pub(super) fn read_tets(node: &[u8], ele: &[u8], control: &Control) -> Result<Tets, Error> {
    let mut nodes = read_nodes(node, control).map_err(|e| e.at(format_args!(".node file")))?;
    let mut lines = Lines::new(ele, control);
    let mut line = lines.expect("the number of tetrahedra")?;
    let count = line.count("the number of tetrahedra", 10, lines.remaining().len())?;
    let corners = line.optional_int("the number of corners")?.unwrap_or(4);
    if corners != 4 && corners != 10 {
        return Err(Error::new(
            Status::Unsupported,
            format_args!("tetrahedra of {corners} corners are not supported"),
        ));
    }
    let attributed = line.optional_int("the number of attributes")?.unwrap_or(0) > 0;
    let (mut tets, mut attributes, mut middles) = (Vec::new(), Vec::new(), Vec::new());
    tets.try_reserve_exact(count)?;
    attributes.try_reserve_exact(if attributed { count } else { 0 })?;
    middles.try_reserve_exact(if corners == 10 { count.saturating_mul(6) } else { 0 })?;
    for tet in 0..count {
        let mut line = lines.expect("a tetrahedron")?;
        line.int("the number of a tetrahedron")?;
        let element = Element::Tet(tet as u32);
        let row = index_row::<4>(&mut line, &nodes, element)?;
        fallible::push(&mut tets, row)?;
        if corners == 10 {
            let six = index_row::<6>(&mut line, &nodes, element)?;
            let edges = NodeOrder::Tetgen.edges().map(|i| EDGES[i].map(|k| row[k]));
            fallible::extend(
                &mut middles,
                six.into_iter().zip(edges).map(|(node, [a, b])| [node, a.min(b), a.max(b)]),
            )?;
        }
        if attributed {
            fallible::push(&mut attributes, line.float("an attribute")?)?;
        }
    }
    lines.expect_end("tetrahedron")?;
    let middles = take_off_middles(middles, &mut nodes)?;
    Ok(Tets { nodes, middles, tets, attributes })
}

/// The edges 01 02 03 12 13 23 of a tetrahedron.
const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// Takes the nodes in the middle of edges off the end of the points, and returns how many there were. `uses`: the node and the ends of
/// the edge, for each tetrahedron.
fn take_off_middles(mut uses: Vec<[u32; 3]>, nodes: &mut Nodes) -> Result<usize, Error> {
    uses.sort_unstable();
    uses.dedup();
    let Some(&[first, ..]) = uses.first() else { return Ok(0) };
    let refused = |node: u32, what: &str| {
        let number = i64::from(node) + nodes.base;
        Error::new(Status::Unsupported, format_args!("node {number} {what}: not read"))
    };
    let count = nodes.points.len() - first as usize;
    if let Some((_, &[node, ..])) = (first..).zip(&uses).find(|(expected, [node, ..])| expected != node) {
        return Err(refused(node, "is in the middle of two edges, or not behind all points"));
    }
    for &[node, a, b] in &uses {
        let at = |v: u32| nodes.points.get(v as usize).copied().unwrap_or_default();
        let (ends, middle) = ([at(a), at(b)], at(node));
        // As they are written.
        let finite = ends.iter().flatten().all(|x| x.is_finite());
        let straight = finite && (0..3).all(|k| middle[k] == 0.5 * ends[0][k] + 0.5 * ends[1][k]);
        if b >= first {
            return Err(refused(b, "is in the middle of an edge and a corner"));
        }
        if !straight {
            return Err(refused(node, "is not in the middle of the straight edge that it belongs to"));
        }
    }
    if uses.len() != count {
        return Err(refused(first, "is in the middle of an edge, and points come after the last such node"));
    }
    // Each edge has one node.
    uses.sort_unstable_by_key(|&[node, a, b]| [a, b, node]);
    if let Some(two) = uses.windows(2).find(|two| two[0][1..] == two[1][1..]) {
        return Err(refused(two[1][0], "is in the middle of an edge that has another such node"));
    }
    nodes.points.truncate(first as usize);
    nodes.markers.truncate(first as usize);
    nodes.attributes.truncate(first as usize * nodes.attribute_count);
    Ok(count)
}

/// The triangles of a `.face` file with their markers. If there are nodes in the middle of edges, three follow the corners.
pub(super) fn read_faces(
    bytes: &[u8],
    nodes: &Nodes,
    middles: usize,
    control: &Control,
) -> Result<Vec<([u32; 3], i32)>, Error> {
    let words =
        Words { count: "the number of faces", one: "a face", number: "the number of a face", last: "face" };
    read_marked(bytes, nodes, Middles { each: 3, count: middles }, words, Element::Facet, control)
}

/// The edges of an `.edge` file with their markers. If there are nodes in the middle of edges, one follows the ends.
pub(super) fn read_edges(
    bytes: &[u8],
    nodes: &Nodes,
    middles: usize,
    control: &Control,
) -> Result<Vec<([u32; 2], i32)>, Error> {
    let words =
        Words { count: "the number of edges", one: "an edge", number: "the number of an edge", last: "edge" };
    read_marked(bytes, nodes, Middles { each: 1, count: middles }, words, Element::Segment, control)
}

/// What elements are called.
struct Words {
    count: &'static str,
    one: &'static str,
    number: &'static str,
    last: &'static str,
}

/// Nodes in the middle of edges: how many an element has, if there are any, and how many there are.
struct Middles {
    each: usize,
    count: usize,
}

/// Elements with a marker each.
fn read_marked<const N: usize>(
    bytes: &[u8],
    nodes: &Nodes,
    middles: Middles,
    words: Words,
    element: fn(u32) -> Element,
    control: &Control,
) -> Result<Vec<([u32; N], i32)>, Error> {
    let mut lines = Lines::new(bytes, control);
    let mut line = lines.expect(words.count)?;
    let count = line.count(words.count, 2 * N + 2, lines.remaining().len())?;
    let mut list = fallible::reserved(count)?;
    for i in 0..count {
        let mut line = lines.expect(words.one)?;
        line.int(words.number)?;
        let element = element(i as u32);
        let corners = index_row::<N>(&mut line, nodes, element)?;
        for _ in 0..if middles.count > 0 { middles.each } else { 0 } {
            let number = line.int("a node in the middle of an edge")?;
            let place = number.saturating_sub(nodes.base).saturating_sub(nodes.points.len() as i64);
            if !(0..middles.count as i64).contains(&place) {
                let at = line.number();
                let what = format_args!("line {at}: node {number} is not in the middle of an edge");
                return Err(no_such_point(element, what));
            }
        }
        fallible::push(&mut list, (corners, line.optional_marker()?))?;
    }
    lines.expect_end(words.last)?;
    Ok(list)
}

fn index_row<const N: usize>(
    line: &mut Line<'_>,
    nodes: &Nodes,
    element: Element,
) -> Result<[u32; N], Error> {
    let mut row = [0; N];
    for corner in &mut row {
        let index = line.int("a point index")?.saturating_sub(nodes.base);
        if index < 0 || index as usize >= nodes.points.len() {
            let error = out_of_range(element, nodes.points.len());
            return Err(error.at(format_args!("line {}", line.number())));
        }
        *corner = index as u32;
    }
    Ok(row)
}
