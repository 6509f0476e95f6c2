//! From PLC to surface: the steps in their order, and the collection of defects.
//!
//! Indices and coordinates come first, since nothing else can be examined while they are wrong; then equal points, each facet by itself,
//! then (in [`split`](crate::plc::split) and [`patch`](crate::plc::patch)) what the facets share.
use crate::control::{controlled, Control, Part};
use crate::elementary::quotient;
use crate::error::{Defect, DefectKind, Element, Error, KindCounts, Message, Status};
use crate::fallible;
use crate::options::{Mode, Options};
use crate::plc::duplicates::first_equal;
use crate::plc::intersect::{find_named_intersections, IntersectInput, Intersections, Names};
use crate::plc::merge::net::net_flips;
use crate::plc::merge::Merger;
use crate::plc::open::{open_shells, OpenEdge};
use crate::plc::patch::{connect, FixedEdge};
use crate::plc::polygon::{collinear, Fault, FaultKind, Role, Triangulator};
use crate::plc::split::split;
use crate::plc::surface::Surface;
use crate::plc::{Facet, Interior, Plc};
use crate::predicates::{far_from_most, range_scale, scale};
use crate::progress::{Observer, Phase};
use crate::warning::{Warning, WarningKind, Warnings};
use crate::INVALID;
use std::fmt;

/// Defects found so far; as many are listed as the caller wants.
pub(crate) struct Defects {
    limit: usize,
    list: Vec<Defect>,
    count: usize,
    /// Defects per kind.
    kinds: KindCounts,
}

impl Defects {
    pub(crate) fn new(limit: usize) -> Self {
        Defects { limit, list: Vec::new(), count: 0, kinds: KindCounts::default() }
    }

    pub(crate) fn push(
        &mut self,
        kind: DefectKind,
        first: Element,
        second: Option<Element>,
        point: Option<[f64; 3]>,
    ) {
        self.count += 1;
        self.kinds.add(kind);
        if self.list.len() < self.limit {
            // Without memory, the defect is only counted.
            let _ = fallible::push(&mut self.list, Defect { kind, first, second, point });
        }
    }

    fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Fails with the defects if there are any.
    pub(crate) fn into_result(self) -> Result<(), Error> {
        let Some(status) = self.kinds.iter().map(|k| status_of(k.0)).max_by_key(|&s| severity(s)) else {
            return Ok(());
        };
        let listed: usize = self.kinds.iter().map(|k| k.1).sum();
        let (count, plural) = (self.count, if self.count == 1 { "" } else { "s" });
        let kinds = self.kinds.shown(" ");
        let message = match count.saturating_sub(listed) {
            0 => Message::from(format_args!("{count} defect{plural}: {kinds}")),
            more => Message::from(format_args!("{count} defect{plural}: {kinds}, {more} not listed")),
        };
        Err(Error::with_defects(status, message, self.list, count))
    }
}

fn status_of(kind: DefectKind) -> Status {
    match kind {
        DefectKind::NonFinite => Status::NonFinitePoint,
        DefectKind::CoordinateRange => Status::CoordinateRange,
        DefectKind::IndexOutOfRange => Status::IndexOutOfRange,
        DefectKind::DegenerateSegment | DefectKind::DegenerateFacet | DefectKind::RingNesting => {
            Status::DegenerateFacet
        }
        DefectKind::NonPlanarFacet => Status::NonPlanarFacet,
        DefectKind::SeedOnFacet | DefectKind::SeedOutside => Status::SeedOutside,
        _ => Status::SelfIntersection,
    }
}

/// The severity of a status: the most severe one among the defects becomes the status of the error.
fn severity(status: Status) -> u32 {
    match status {
        Status::NonFinitePoint => 6,
        Status::IndexOutOfRange => 5,
        Status::CoordinateRange => 4,
        Status::SelfIntersection => 3,
        Status::NonPlanarFacet => 2,
        Status::DegenerateFacet => 1,
        _ => 0,
    }
}

/// A PLC that has been checked and split; the edges of its triangles are not yet classified.
pub struct Prepared {
    surface: Surface,
    fixed: Vec<FixedEdge>,
}

impl Prepared {
    /// The surface so far: points, aliases and triangles.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// A copy.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`].
    pub fn copied(&self) -> Result<Prepared, Error> {
        Ok(Prepared { surface: self.surface.copied()?, fixed: fallible::copied(&self.fixed)? })
    }

    /// Finds segments and patches, without merging facets.
    ///
    /// # Errors
    /// [`Status::Cancelled`], [`Status::OutOfMemory`], [`Status::TooLarge`].
    pub fn connect(self, plc: &Plc, control: &Control) -> Result<Surface, Error> {
        let Prepared { mut surface, fixed } = self;
        connect(&mut surface, &fixed, |facet| plc.facet_marker(facet as usize), control)?;
        control.progress(Phase::Validate, 1.0)?;
        Ok(surface)
    }

    /// Begins merging facets that meet at more than `degrees`.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`].
    pub fn merger<'a>(
        &'a mut self,
        plc: &'a Plc,
        degrees: f64,
        control: &Control,
    ) -> Result<Merger<'a>, Error> {
        Merger::new(&mut self.surface, std::mem::take(&mut self.fixed), plc, degrees, control)
    }

    /// The surface after merging, listing only net flips.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`].
    pub fn into_surface(mut self, control: &Control) -> Result<Surface, Error> {
        self.surface.facet_flips = net_flips(&self.surface.facet_flips, control)?;
        Ok(self.surface)
    }
}

/// Checks a PLC and prepares it for tetrahedralization.
///
/// # Errors
/// All defects found, with the most severe status; without `options.validate`, elements are not checked for crossings.
/// [`Status::Cancelled`], [`Status::OutOfMemory`], [`Status::TooLarge`].
pub fn prepare(plc: &Plc, options: &Options, control: &Control) -> Result<Surface, Error> {
    let mut prepared = check_and_split(plc, options, control)?;
    let Some(degrees) = options.merge_facets else { return prepared.connect(plc, control) };
    prepared.merger(plc, degrees, control)?.run(None, control)?;
    prepared.into_surface(control)
}

/// The first part of [`prepare`]: everything that does not depend on the Delaunay tetrahedralization.
///
/// # Errors
/// As [`prepare`].
pub fn check_and_split(plc: &Plc, options: &Options, control: &Control) -> Result<Prepared, Error> {
    control.progress(Phase::Validate, 0.0)?;
    check_references(plc, options.max_defects, control)?;
    let mut defects = Defects::new(options.max_defects);
    let mut surface = Surface::default();
    scale_points(plc, &mut surface, &mut defects)?;
    control.look()?;
    surface.alias = first_equal(&surface.points, control)?;
    control.progress(Phase::Validate, 0.05)?;
    let mut fixed = Fixed::default();
    alias_segments(plc, &surface, &mut fixed, &mut defects)?;
    control.look()?;
    triangulate_facets(plc, &mut surface, &mut fixed, &mut defects, control)?;
    let marker = |facet: u32| plc.facet_marker(facet as usize);
    if options.validate {
        let found = intersect(&surface, &mut fixed, &mut defects, control)?;
        if defects.is_empty() {
            let may_join = |f: u32, g: u32| f == g || marker(f) == marker(g);
            let crossings = split(&mut surface, &mut fixed.edges, &found, may_join, control)?;
            let pair = |&(edge, triangle): &(u32, u32)| {
                let facet = Element::Facet(surface.triangle_facet[triangle as usize]);
                let owner = fixed.owner[edge as usize];
                [owner.min(facet), owner.max(facet)]
            };
            let mut pairs: Vec<[Element; 2]> = fallible::collect(crossings.iter().map(pair))?;
            control.sort(&mut pairs)?;
            pairs.dedup();
            for [first, second] in pairs {
                defects.push(DefectKind::SegmentSegment, first, Some(second), None);
            }
        }
    } else {
        find_duplicates(&surface, &mut defects, control)?;
    }
    defects.into_result()?;
    Ok(Prepared { surface, fixed: fixed.edges })
}

/// Edges that constrain by themselves, and the elements that they come from.
#[derive(Default)]
struct Fixed {
    edges: Vec<FixedEdge>,
    owner: Vec<Element>,
}

impl Fixed {
    fn push(&mut self, ends: [u32; 2], owner: Element) -> Result<(), Error> {
        let parent = if let Element::Segment(i) = owner { i } else { INVALID };
        fallible::push(&mut self.edges, FixedEdge { ends, parent })?;
        fallible::push(&mut self.owner, owner)?;
        Ok(())
    }
}

/// Finds all contacts and adds the defects among them to the others. Edges of facets in the interior of other facets become fixed.
fn intersect(
    surface: &Surface,
    fixed: &mut Fixed,
    defects: &mut Defects,
    control: &Control,
) -> Result<Intersections, Error> {
    let given = fixed.edges.len();
    let whole = control.whole(Phase::Validate);
    let mut found = contacts(surface, fixed, given, defects.limit, whole.part(0.3, 0.8))?;
    let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let mut known: Vec<[u32; 2]> = fallible::collect(fixed.edges.iter().map(|edge| sorted(edge.ends)))?;
    control.sort(&mut known)?;
    for &(edge, facet) in found.edge_in_facet.iter().filter(|x| known.binary_search(&x.0).is_err()) {
        fixed.push(edge, Element::Facet(facet))?;
    }
    if fixed.edges.len() > given {
        found = contacts(surface, fixed, given, defects.limit, whole.part(0.8, 0.9))?;
    }
    for d in &found.defects {
        let point = d.point.map(|p| p.map(|x| scale(x, -surface.scale)));
        defects.push(d.kind, d.first, d.second, point);
    }
    defects.count += found.defect_count - found.defects.len().min(found.defect_count);
    Ok(found)
}

/// All contacts of facets, fixed edges and vertices. Fixed edges from index `given` on are edges of facets in the interior of others.
fn contacts(
    surface: &Surface,
    fixed: &Fixed,
    given: usize,
    max_defects: usize,
    part: Part,
) -> Result<Intersections, Error> {
    let mut vertices: Vec<u32> = fallible::reserved(surface.points.len())?;
    fallible::extend(
        &mut vertices,
        (0..).zip(&surface.alias).filter(|(i, alias)| i == *alias).map(|(i, _)| i),
    )?;
    let segments: Vec<[u32; 2]> = fallible::collect(fixed.edges.iter().map(|edge| edge.ends))?;
    let input = IntersectInput {
        points: &surface.points,
        vertices: &vertices,
        triangles: &surface.triangles,
        triangle_facet: &surface.triangle_facet,
        segments: &segments,
    };
    let names = Names { owners: &fixed.owner, edges_from: given };
    // At least one is requested: its kind determines the status.
    find_named_intersections(&input, names, max_defects.max(1), part)
}

/// Reports every defect of a PLC. Only the options `max_defects`, the limits,
/// and `keep_hull` and `mode`, which allow open surfaces, have an effect.
/// Returns warnings about shells that enclose nothing if others do.
///
/// # Errors
/// As [`prepare`] with validation on; [`Status::NothingEnclosed`], with the open edges, if the whole surface encloses nothing.
pub fn check(plc: &Plc, options: &Options, observer: &mut dyn Observer) -> Result<Warnings, Error> {
    controlled(options.limits(), observer, |control| check_with(plc, options, control))
}

/// The same in a run with a control of its own, whose limits count instead of those of `options`.
///
/// # Errors
/// As [`check`].
pub fn check_with(plc: &Plc, options: &Options, control: &Control) -> Result<Warnings, Error> {
    plc.check_lift(options)?;
    let strict = Options { max_defects: options.max_defects, ..Options::default() };
    let surface = prepare(plc, &strict, control)?;
    let mut warnings = Warnings::default();
    if options.mode == Mode::Delaunay || surface.triangles.is_empty() {
        return Ok(warnings);
    }
    let (open, all) = open_shells(&surface, control)?;
    if all && !options.keep_hull {
        return Err(nothing_enclosed(plc, &surface, &open, options.max_defects));
    }
    for edge in &open {
        let [first, second] = edge.ends.map(Element::Point);
        let (kind, point) = (WarningKind::OpenEdge, edge.middle(&surface));
        warnings.push(Warning { kind, first, second: Some(second), point }, options.max_defects);
    }
    Ok(warnings)
}

/// The error for a surface that encloses nothing, with its open edges.
pub(crate) fn nothing_enclosed(plc: &Plc, surface: &Surface, open: &[OpenEdge], max_defects: usize) -> Error {
    let listed = open[..open.len().min(max_defects)].iter().map(|edge| Defect {
        kind: DefectKind::OpenEdge,
        first: Element::Point(edge.ends[0]),
        second: Some(Element::Point(edge.ends[1])),
        point: edge.middle(surface),
    });
    // When memory is short, the message alone must suffice.
    let defects = fallible::collect(listed).unwrap_or_default();
    let because = |reason: fmt::Arguments<'_>| {
        Message::from(format_args!("the surface encloses nothing: {reason}, or keep the convex hull"))
    };
    let message = match open.first() {
        Some(edge) => {
            let [x, y, z] = edge.middle(surface).unwrap_or_default();
            let facet = surface.triangle_facet.get(edge.triangle as usize).copied().unwrap_or(INVALID);
            let (count, [a, b]) = (open.len(), edge.ends);
            let edges = if count == 1 { "open edge" } else { "open edges, such as that" };
            because(format_args!(
                "{count} {edges} of facet {facet} between points {a} and {b} at ({x}, {y}, {z}); close it"
            ))
        }
        None if surface.triangles.is_empty() => because(format_args!("it has no facet; add facets")),
        None if !plc.holes.is_empty() => because(format_args!("the hole seeds carve all of it; remove one")),
        None => because(format_args!("it has no inside; change it")),
    };
    Error::with_defects(Status::NothingEnclosed, message, defects, open.len())
}

/// Fails unless coordinates are finite and indices refer to points.
fn check_references(plc: &Plc, max_defects: usize, control: &Control) -> Result<(), Error> {
    if plc.points.len() >= INVALID as usize
        || plc.facet_count() >= INVALID as usize
        || plc.segments.len() >= INVALID as usize
    {
        return Err(Error::new(
            Status::TooLarge,
            "the input has more elements than 32-bit indices can address",
        ));
    }
    let mut defects = Defects::new(max_defects);
    let finite = |p: &[f64; 3]| p.iter().all(|x| x.is_finite());
    for (i, p) in plc.points.iter().enumerate().filter(|(_, p)| !finite(p)) {
        defects.push(DefectKind::NonFinite, Element::Point(i as u32), None, Some(*p));
    }
    for (i, p) in plc.holes.iter().enumerate().filter(|(_, p)| !finite(p)) {
        defects.push(DefectKind::NonFinite, Element::Hole(i as u32), None, Some(*p));
    }
    for (i, r) in plc.regions.iter().enumerate().filter(|(_, r)| !finite(&r.point)) {
        defects.push(DefectKind::NonFinite, Element::Region(i as u32), None, Some(r.point));
    }
    control.look()?;
    let known = |v: &u32| (*v as usize) < plc.points.len();
    let mut bad = |element: Element| defects.push(DefectKind::IndexOutOfRange, element, None, None);
    for (i, _) in plc.segments.iter().enumerate().filter(|(_, s)| !s.ends.iter().all(known)) {
        bad(Element::Segment(i as u32));
    }
    for (i, _) in plc.triangles.iter().enumerate().filter(|(_, t)| !t.iter().all(known)) {
        bad(Element::Facet(i as u32));
    }
    for (i, _) in plc.facets.iter().enumerate().filter(|(_, f)| !f.polygons.iter().flatten().all(known)) {
        bad(Element::Facet((plc.triangles.len() + i) as u32));
    }
    control.look()?;
    for (i, facet) in plc.facets.iter().enumerate() {
        for p in facet.holes.iter().filter(|p| !finite(p)) {
            defects.push(
                DefectKind::NonFinite,
                Element::Facet((plc.triangles.len() + i) as u32),
                None,
                Some(*p),
            );
        }
    }
    defects.into_result()
}

/// Scales the points into the range of exact arithmetic.
fn scale_points(plc: &Plc, surface: &mut Surface, defects: &mut Defects) -> Result<(), Error> {
    surface.points.try_reserve_exact(plc.points.len())?;
    match range_scale(&plc.points) {
        Ok(k) => surface.scale = k,
        Err(_) => {
            for i in far_from_most(&plc.points) {
                let point = plc.points[i];
                defects.push(DefectKind::CoordinateRange, Element::Point(i as u32), None, Some(point));
            }
            return std::mem::replace(defects, Defects::new(0)).into_result();
        }
    }
    fallible::extend(&mut surface.points, plc.points.iter().map(|p| p.map(|x| scale(x, surface.scale))))?;
    Ok(())
}

/// Input segments between representatives.
fn alias_segments(
    plc: &Plc,
    surface: &Surface,
    fixed: &mut Fixed,
    defects: &mut Defects,
) -> Result<(), Error> {
    for (i, segment) in plc.segments.iter().enumerate() {
        let ends = segment.ends.map(|v| surface.alias[v as usize]);
        if ends[0] == ends[1] {
            let point = plc.points[ends[0] as usize];
            defects.push(DefectKind::DegenerateSegment, Element::Segment(i as u32), None, Some(point));
        } else {
            fixed.push(ends, Element::Segment(i as u32))?;
        }
    }
    Ok(())
}

/// Triangles of all facets; edges in them that constrain are added to `fixed`.
fn triangulate_facets(
    plc: &Plc,
    surface: &mut Surface,
    fixed: &mut Fixed,
    defects: &mut Defects,
    control: &Control,
) -> Result<(), Error> {
    surface.first_polygon = plc.triangles.len() as u32;
    surface.triangles.try_reserve(plc.triangles.len())?;
    surface.triangle_facet.try_reserve(plc.triangles.len())?;
    for (i, corners) in plc.triangles.iter().enumerate() {
        control.step()?;
        let corners = corners.map(|v| surface.alias[v as usize]);
        if collinear(&surface.points, corners[0], corners[1], corners[2]) {
            let point = plc.points[corners[0] as usize];
            defects.push(DefectKind::DegenerateFacet, Element::Facet(i as u32), None, Some(point));
        } else {
            fallible::push(&mut surface.triangles, corners)?;
            fallible::push(&mut surface.triangle_facet, i as u32)?;
        }
    }
    if plc.facets.is_empty() {
        return Ok(());
    }
    let mut triangulator = Triangulator::new(plc.points.len())?;
    for (i, facet) in plc.facets.iter().enumerate() {
        if i % 4096 == 0 {
            control.progress(Phase::Validate, 0.05 + 0.25 * i as f64 / plc.facets.len() as f64)?;
        }
        let number = (plc.triangles.len() + i) as u32;
        match triangulate_facet(facet, surface, &mut triangulator, control)? {
            Ok(()) => {
                surface.triangles.try_reserve(triangulator.triangles.len())?;
                surface.triangle_facet.try_reserve(triangulator.triangles.len())?;
                fallible::append(&mut surface.triangles, &triangulator.triangles)?;
                fallible::resize(&mut surface.triangle_facet, surface.triangles.len(), number)?;
                for &ends in &triangulator.edges {
                    fixed.push(ends, Element::Facet(number))?;
                }
            }
            Err(fault) => {
                let Some(kind) = defect_kind(fault.kind) else {
                    return Err(Error::internal("the triangulation of a facet failed"));
                };
                defects.push(kind, Element::Facet(number), None, fault_point(&plc.points, fault));
            }
        }
    }
    Ok(())
}

/// One general facet.
fn triangulate_facet(
    facet: &Facet,
    surface: &Surface,
    triangulator: &mut Triangulator,
    control: &Control,
) -> Result<Result<(), Fault>, Error> {
    control.step()?;
    if let [polygon] = &facet.polygons[..] {
        let mut ring = [0; 4];
        if let (Some(ring), true) = (ring.get_mut(..polygon.len()), facet.holes.is_empty()) {
            for (corner, &v) in ring.iter_mut().zip(polygon) {
                *corner = surface.alias[v as usize];
            }
            if triangulator.triangulate_ring(&surface.points, ring)? {
                return Ok(Ok(()));
            }
        }
    }
    triangulator.clear();
    let mut rings = 0;
    for polygon in &facet.polygons {
        let role = match (polygon.len(), facet.interior) {
            (0..=2, _) => Role::Edge,
            (_, Interior::FirstMinusOthers) if rings > 0 => Role::Hole,
            _ => Role::Outer,
        };
        rings += usize::from(role != Role::Edge);
        let number = triangulator.add_polygon(role)?;
        let corner = |i: usize| surface.alias[polygon[i] as usize];
        for i in 0..polygon.len() {
            triangulator.add_edge(number, corner(i), corner((i + 1) % polygon.len()))?;
        }
    }
    let seeds = fallible::collect(facet.holes.iter().map(|p| p.map(|x| scale(x, surface.scale))))?;
    triangulator.triangulate(&surface.points, facet.interior, &seeds, control)
}

fn defect_kind(kind: FaultKind) -> Option<DefectKind> {
    match kind {
        FaultKind::Degenerate => Some(DefectKind::DegenerateFacet),
        FaultKind::Crossing => Some(DefectKind::RingIntersection),
        FaultKind::Nesting => Some(DefectKind::RingNesting),
        FaultKind::NonPlanar => Some(DefectKind::NonPlanarFacet),
        FaultKind::Seed => Some(DefectKind::SeedOnFacet),
        FaultKind::Broken => None,
    }
}

/// The location of a fault: about where the two edges cross, or at the vertex.
fn fault_point(points: &[[f64; 3]], fault: Fault) -> Option<[f64; 3]> {
    if fault.vertices.contains(&INVALID) {
        return None;
    }
    let [p, q, r, s] = fault.vertices.map(|v| points[v as usize]);
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (d, e) = (minus(q, p), minus(s, r));
    let normal = cross(d, e);
    let t = quotient(dot(cross(minus(r, p), e), normal), dot(normal, normal));
    Some(t.map_or(p, |t| [0, 1, 2].map(|k| p[k] + t.clamp(0.0, 1.0) * d[k])))
}

/// Facets that cover the same triangle.
fn find_duplicates(surface: &Surface, defects: &mut Defects, control: &Control) -> Result<(), Error> {
    let mut keys: Vec<([u32; 3], u32)> =
        fallible::collect(surface.triangles.iter().zip(&surface.triangle_facet).map(|(corners, &facet)| {
            let mut corners = *corners;
            corners.sort_unstable();
            (corners, facet)
        }))?;
    control.sort(&mut keys)?;
    let mut pairs: Vec<(u32, u32, u32)> = Vec::new();
    for pair in keys.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        fallible::push(&mut pairs, (pair[0].1, pair[1].1, pair[0].0[0]))?;
    }
    pairs.sort_unstable();
    pairs.dedup_by_key(|pair| (pair.0, pair.1));
    for (first, second, v) in pairs {
        let point = surface.points[v as usize].map(|x| scale(x, -surface.scale));
        defects.push(
            DefectKind::DuplicateFacet,
            Element::Facet(first),
            Some(Element::Facet(second)),
            Some(point),
        );
    }
    Ok(())
}
