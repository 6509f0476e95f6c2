//! A mesh into the kernel, filled and optimised there, and out again.
//!
//! Vertex ids are the mesh's point indices, slots its tetrahedra. Subfaces are walls that carry their index, so they are found again. What
//! comes out is audited: every point that stays, orientation, neighbours, each subface and each subsegment.
use crate::blocks::{Crew, Model};
use crate::check::{audit, audit_promise, Promise};
use crate::control::{Control, Part};
use crate::error::{DefectKind, Element, Error, Status};
use crate::fallible;
use crate::fill::{bound_volumes, estimate, fill, Shape};
use crate::kernel::tables::EDGE;
use crate::kernel::{edge_key, Mesh, NONE};
use crate::optimise::{optimise, Subject};
use crate::options::{Mode, Options};
use crate::output::{
    FacetFlip, Guarantee, OptimizeStatistics, RefineStatistics, Region, Statistics, SteinerPoint,
    SteinerTerm, Subface, Subsegment, TetMesh,
};
use crate::plan::assemble;
use crate::plan::given::complex::{is_odd, Complex};
use crate::plan::given::faults::Faults;
use crate::plan::given::MeshSizes;
use crate::plan::refine::{check, edge_of, fills, refines, request};
use crate::plc::Plc;
use crate::predicates::{scale, Points};
use crate::preserve::inside::Inside;
use crate::progress::Phase;
use crate::size::{scaled, Bounds, Given, Size};
use crate::INVALID;
use rustc_hash::FxHashSet;
use std::time::Instant;

/// A mesh in the kernel.
struct Work<'a> {
    given: &'a TetMesh,
    points: Points,
    exponent: i32,
    alias: Vec<u32>,
    mesh: Mesh,
    inside: Inside,
    /// Points that stay, by index.
    stays: Vec<bool>,
    /// Subsegments on no subface.
    isolated: FxHashSet<[u32; 2]>,
    refine: RefineStatistics,
    optimize: OptimizeStatistics,
}

/// Refines or improves a mesh.
///
/// # Errors
/// See [`refine`](fn@crate::plan::given::refine).
pub(super) fn refined(
    mesh: &TetMesh,
    sizes: &MeshSizes,
    options: &Options,
    control: &Control,
) -> Result<TetMesh, Error> {
    let start = Instant::now();
    control.progress(Phase::Validate, 0.0)?;
    let options = &Options { mode: Mode::Preserve, ..options.copied() };
    check(&Plc::default(), options)?;
    check_sizes(mesh, sizes)?;
    check_arrays(mesh, options.max_defects)?;
    let mut work = Work::new(mesh, options.max_defects, control)?;
    let mut statistics = Statistics::default();
    let mut lap = start;
    let mut book = |phase: Phase, statistics: &mut Statistics| {
        let now = Instant::now();
        statistics.seconds[phase as usize] += (now - lap).as_secs_f64();
        lap = now;
    };
    book(Phase::Validate, &mut statistics);
    control.progress(Phase::Preserve, 0.0)?;
    work.run(sizes, options, control.whole(Phase::Preserve))?;
    statistics.peak_bytes = work.mesh.bytes() as u64;
    let mut out = work.out(control)?;
    control.tetrahedra(out.tets.len())?;
    book(Phase::Preserve, &mut statistics);
    control.progress(Phase::Audit, 0.0)?;
    audit_kept(mesh, &work.stays, &out, options.max_defects, control)?;
    control.progress(Phase::Audit, 1.0)?;
    book(Phase::Audit, &mut statistics);
    let on_edges = || out.steiner.iter().filter(|point| !point.is_inside());
    statistics.steiner = on_edges().count() as u64;
    statistics.steiner_exact = on_edges().filter(|point| point.exact).count() as u64;
    statistics.duplicate_points = mesh.statistics.duplicate_points;
    (statistics.refine, statistics.optimize) = (work.refine, work.optimize);
    out.statistics = statistics;
    out.ratio = options.quality.or(mesh.ratio);
    Ok(out)
}

/// Refuses sizes that do not fit the mesh, or are none.
fn check_sizes(mesh: &TetMesh, sizes: &MeshSizes) -> Result<(), Error> {
    sizes.parts.check(mesh.points.len())?;
    let (given, count) = (sizes.tets.len(), mesh.tets.len());
    if given != 0 && given != count {
        return Err(Error::new(
            Status::InvalidArgument,
            format_args!("{given} sizes for {count} tetrahedra: one each is needed, or none"),
        ));
    }
    if let Some((t, size)) = (0..).zip(&sizes.tets).find(|x: &(u32, &f64)| x.1.is_nan() || *x.1 <= 0.0) {
        return Err(Error::new(
            Status::InvalidArgument,
            format_args!("the size {size} of tetrahedron {t} is not positive"),
        ));
    }
    Ok(())
}

/// Refuses a mesh whose lists do not fit together, which only a caller can have made. The points of tetrahedra come later.
fn check_arrays(mesh: &TetMesh, most: usize) -> Result<(), Error> {
    let (points, tets) = (mesh.points.len(), mesh.tets.len());
    let lengths = [
        ("regions of tetrahedra", mesh.tet_region.len(), tets),
        ("Steiner points", mesh.steiner.len(), points.saturating_sub(mesh.input_point_count as usize)),
    ];
    for (what, length, wanted) in lengths {
        if length != wanted {
            return Err(Error::new(
                Status::InvalidArgument,
                format_args!("the mesh has {length} {what} instead of {wanted}"),
            ));
        }
    }
    let mut faults = Faults::new(&mesh.points, most);
    let bad_index = DefectKind::IndexOutOfRange;
    for (t, _) in (0..).zip(&mesh.tet_region).filter(|x| *x.1 as usize >= mesh.regions.len()) {
        faults.add(bad_index, Element::Tet(t), None, INVALID);
    }
    let is_point = |&v: &u32| (v as usize) < points;
    let faces = mesh.subfaces.iter().chain(&mesh.unmeshed_subfaces);
    for face in faces.filter(|face| !face.corners.iter().all(is_point)) {
        faults.add(bad_index, Element::Facet(face.facet), None, INVALID);
    }
    let edges = mesh.subsegments.iter().chain(&mesh.unmeshed_subsegments);
    for edge in edges.filter(|edge| !edge.ends.iter().all(is_point)) {
        faults.add(bad_index, Element::Segment(edge.segment), None, INVALID);
    }
    for term in mesh.steiner_terms.iter().filter(|term| term.steiner as usize >= mesh.steiner.len()) {
        faults.add(bad_index, Element::Point(term.steiner), None, INVALID);
    }
    faults.finish(Status::IndexOutOfRange, "an index of the mesh refers to nothing")
}

impl<'a> Work<'a> {
    fn new(given: &'a TetMesh, most: usize, control: &Control) -> Result<Work<'a>, Error> {
        let complex = Complex::new(&given.points, &given.tets, most, control)?;
        control.room(given.tets.len() * 8 * size_of::<u64>())?;
        let mut mesh = complex.mesh(control)?;
        // Tetrahedra keep their slots; a mesh of ours has positive ones, whose corners are the first of equal points.
        mesh.set_regions(|t| given.tet_region.get(t as usize).copied().unwrap_or(NONE))?;
        let mut stays = fallible::filled(false, given.points.len())?;
        let mut names: Vec<(u32, u32)> = fallible::reserved(given.subfaces.len())?;
        let mut faults = Faults::new(&given.points, most);
        for (i, face) in (0..).zip(&given.subfaces) {
            control.step()?;
            match complex.find(face.corners) {
                Some(code) => {
                    mesh.set_subface(code);
                    fallible::push(&mut names, (code.min(mesh.across(code)), i))?;
                }
                None => {
                    faults.add(DefectKind::FacetMissing, Element::Facet(face.facet), None, face.corners[0])
                }
            }
            face.corners.iter().for_each(|&v| stays[v as usize] = true);
        }
        faults.finish(Status::CheckFailed, "a subface is no face of the mesh")?;
        control.sort(&mut names)?;
        let name = |_: &Mesh, code: u32| {
            let at = names.partition_point(|x| x.0 < code);
            names.get(at).filter(|x| x.0 == code).map(|x| x.1)
        };
        mesh.name_subfaces(name, control)?;
        mesh.track();
        let isolated = isolated(given, &mut mesh, control)?;
        let kept = given.subsegments.iter().flat_map(|edge| edge.ends);
        let outer = |&code: &u32| mesh.is_ghost(mesh.across(code) >> 2);
        let boundary = (0..4 * given.tets.len() as u32).filter(outer).flat_map(|code| mesh.face(code));
        kept.chain(boundary).chain(0..given.input_point_count).for_each(|v| stays[v as usize] = true);
        let mut inside = Vec::new();
        for (v, stays) in (given.input_point_count..).zip(&mut stays[given.input_point_count as usize..]) {
            let point = given.steiner.get((v - given.input_point_count) as usize);
            *stays |= !point.is_some_and(SteinerPoint::is_inside) || complex.alias[v as usize] != v;
            if !*stays {
                fallible::push(&mut inside, v)?;
            }
        }
        let Complex { points, exponent, alias, .. } = complex;
        let mut inside = Inside::of(inside);
        inside.sweep(&mesh);
        let (refine, optimize) = Default::default();
        Ok(Work { given, points, exponent, alias, mesh, inside, stays, isolated, refine, optimize })
    }

    /// Fills and optimises.
    fn run(&mut self, sizes: &MeshSizes, options: &Options, part: Part) -> Result<(), Error> {
        let wishes = !sizes.parts.is_empty() || !sizes.tets.is_empty();
        if !wishes && !refines(options) {
            return Ok(());
        }
        part.steiner(self.inside.total(), usize::MAX / 200)?;
        let bounds = if wishes || fills(options) { self.bounds(options)? } else { Bounds::default() };
        if wishes || fills(options) {
            let given = self.wanted(sizes, options)?;
            let Work { mesh, points, inside, isolated, refine, .. } = self;
            let mut size = Size::new(mesh, points, isolated, given, options.gradation, &part)?;
            let ratio = options.quality.unwrap_or(Options::USUAL_RATIO);
            estimate(mesh, points, &size, &part)?;
            let shape = Shape { ratio, delaunay: false };
            let crew = Crew { threads: options.worker_threads(), part: part.part(0.0, 0.4) };
            refine.add(&fill(Model { mesh, points, inside }, &mut size, shape, crew)?);
            if !bounds.is_empty() {
                let part = part.part(0.4, 0.45);
                refine.add(&bound_volumes(mesh, points, inside, &mut size, &bounds, part)?);
            }
        }
        if let Some(request) = request(options) {
            let part = part.part(0.45, 1.0);
            let Work { mesh, points, inside, isolated, optimize, .. } = self;
            let subject = Subject { mesh, points, inside, isolated, slides: None, bounds: &bounds };
            let crew = Crew { threads: options.worker_threads(), part };
            optimize.add(&optimise(subject, request, crew)?);
        }
        self.inside.sweep(&self.mesh);
        Ok(())
    }

    /// The largest volumes, in the engine's lengths.
    fn bounds(&self, options: &Options) -> Result<Bounds, Error> {
        let scaled = |volume: f64| scaled(volume, 3 * self.exponent);
        let regions = self.given.regions.iter().map(|region| region.max_volume.map(scaled));
        Ok(Bounds { all: options.max_volume.map(scaled), of_region: fallible::collect(regions)? })
    }

    /// What the caller wants, in the engine's lengths.
    fn wanted<'o>(&self, sizes: &MeshSizes, options: &'o Options) -> Result<Given<'o>, Error> {
        let scaled = |x: f64| scaled(x, self.exponent);
        let least = |x: Option<f64>, y: Option<f64>| x.into_iter().chain(y).reduce(f64::min);
        let of_volume = |volume: f64| scaled(edge_of(volume));
        let of_region = |region: &Region| {
            let wanted = sizes.parts.regions.iter().find(|wanted| wanted.attribute == region.attribute);
            least(wanted.map(|wanted| scaled(wanted.size)), region.max_volume.map(of_volume))
        };
        Ok(Given {
            length: least(options.size.map(scaled), options.max_volume.map(of_volume)),
            of_region: fallible::collect(self.given.regions.iter().map(of_region))?,
            at_vertices: self.at_vertices(sizes)?,
            function: options.size_function.as_ref(),
            exponent: self.exponent,
        })
    }

    /// The lengths wanted at points, in tetrahedra, on subfaces and subsegments, by vertex; empty if there are none. Of those in tetrahedra
    /// a vertex gets the smallest around it.
    fn at_vertices(&self, MeshSizes { parts, tets }: &MeshSizes) -> Result<Vec<f64>, Error> {
        let none = parts.points.is_empty() && !parts.on_facets() && parts.segments.is_empty();
        if none && tets.is_empty() {
            return Ok(Vec::new());
        }
        let mut out = fallible::filled(f64::INFINITY, self.points.len())?;
        let mut lower = |point: u32, size: f64| {
            let known = &mut out[self.alias[point as usize] as usize];
            *known = scaled(size, self.exponent).min(*known);
        };
        (0u32..).zip(&parts.points).for_each(|(point, &size)| lower(point, size));
        for (corners, &size) in self.given.tets.iter().zip(tets) {
            corners.iter().for_each(|&v| lower(v, size));
        }
        for face in &self.given.subfaces {
            if let Some(size) = parts.edge_of_facet(face.marker) {
                face.corners.iter().for_each(|&v| lower(v, size));
            }
        }
        for edge in &self.given.subsegments {
            if let Some(size) = parts.of_segment(edge.marker) {
                edge.ends.iter().for_each(|&v| lower(v, size));
            }
        }
        Ok(out)
    }

    /// The mesh that has come out: points that stay in their order, then those inside.
    fn out(&self, control: &Control) -> Result<TetMesh, Error> {
        let given = self.given;
        let mut number = fallible::filled(INVALID, self.points.len())?;
        let mut points = fallible::reserved(self.points.len())?;
        let mut steiner = Vec::new();
        for (v, &at) in given.points.iter().enumerate().filter(|x| self.stays[x.0]) {
            number[v] = points.len() as u32;
            fallible::push(&mut points, at)?;
            if let Some(i) = v.checked_sub(given.input_point_count as usize) {
                fallible::push(&mut steiner, given.steiner[i])?;
            }
        }
        for &v in &self.inside.list {
            number[v as usize] = points.len() as u32;
            fallible::push(&mut points, self.points.xyz(v).map(|x| scale(x, -self.exponent)))?;
            fallible::push(&mut steiner, SteinerPoint::INSIDE)?;
        }
        let of = |v: u32| number[v as usize];
        let mut out = TetMesh {
            points,
            steiner,
            input_point_count: given.input_point_count,
            point_alias: fallible::copied(&given.point_alias)?,
            regions: fallible::copied(&given.regions)?,
            subsegments: fallible::collect(given.subsegments.iter().map(|edge| edge_of_new(edge, of)))?,
            unmeshed_subfaces: fallible::collect(
                given.unmeshed_subfaces.iter().map(|face| Subface { corners: face.corners.map(of), ..*face }),
            )?,
            unmeshed_subsegments: fallible::collect(
                given.unmeshed_subsegments.iter().map(|edge| edge_of_new(edge, of)),
            )?,
            steiner_terms: self.terms(of)?,
            facet_flips: fallible::collect(given.facet_flips.iter().map(|flip| FacetFlip { ..*flip }))?,
            hull_kept: given.hull_kept,
            preserved: given.preserved,
            guarantee: match given.guarantee {
                kept @ (Guarantee::Preserved | Guarantee::PreservedOuter) => kept,
                _ => Guarantee::Given,
            },
            warnings: given.warnings.try_clone()?,
            ..TetMesh::default()
        };
        let slots = assemble::tets(&self.mesh, &mut out, of, control)?;
        self.subfaces(&slots, of, &mut out, control)?;
        let mut used = fallible::filled(false, out.points.len())?;
        out.tets.iter().flatten().for_each(|&v| used[v as usize] = true);
        out.unmeshed_points = fallible::collect((0..).zip(&used).filter(|x| !*x.1).map(|x| x.0))?;
        Ok(out)
    }

    /// The subfaces, with the tetrahedra that are there now.
    fn subfaces(
        &self,
        slots: &[u32],
        of: impl Fn(u32) -> u32,
        out: &mut TetMesh,
        control: &Control,
    ) -> Result<(), Error> {
        let mut codes = fallible::filled(NONE, self.given.subfaces.len())?;
        for code in self.mesh.subfaces() {
            control.step()?;
            if let Some(known) = codes.get_mut(self.mesh.subface(code) as usize) {
                *known = code;
            }
        }
        out.subfaces.try_reserve_exact(codes.len())?;
        for (face, &code) in self.given.subfaces.iter().zip(&codes) {
            control.step()?;
            if code == NONE {
                return Err(Error::internal("a kept face is no longer a face of the mesh"));
            }
            let corners = face.corners.map(|v| self.alias[v as usize]);
            let beyond = self.mesh.across(code);
            // The normal of a face points away from its tetrahedron.
            let (behind, ahead) = match is_odd(corners) == is_odd(self.mesh.face(code)) {
                true => (code, beyond),
                false => (beyond, code),
            };
            let mut tets = [behind, ahead].map(|code| slots[(code >> 2) as usize]);
            let mut corners = corners.map(&of);
            let rank = |t: u32| (out.tet_region.get(t as usize).copied().unwrap_or(INVALID), t);
            if rank(tets[0]) > rank(tets[1]) {
                tets.swap(0, 1);
                corners.swap(1, 2);
            }
            fallible::push(&mut out.subfaces, Subface { corners, tets, ..*face })?;
        }
        Ok(())
    }

    /// The terms of parameters, renumbered.
    fn terms(&self, of: impl Fn(u32) -> u32) -> Result<Vec<SteinerTerm>, Error> {
        let inputs = self.given.input_point_count;
        let renumbered = self.given.steiner_terms.iter().filter_map(|term| {
            let new = of(inputs + term.steiner);
            (new != INVALID).then(|| SteinerTerm { steiner: new - inputs, ..*term })
        });
        Ok(fallible::collect(renumbered)?)
    }
}

fn edge_of_new(edge: &Subsegment, of: impl Fn(u32) -> u32) -> Subsegment {
    Subsegment { ends: edge.ends.map(of), ..*edge }
}

/// The subsegments on no subface, marked in the mesh.
fn isolated(given: &TetMesh, mesh: &mut Mesh, control: &Control) -> Result<FxHashSet<[u32; 2]>, Error> {
    // Looked up only, never iterated, but by who sorts it.
    let mut isolated: FxHashSet<[u32; 2]> = FxHashSet::default();
    isolated.try_reserve(given.subsegments.len())?;
    fallible::add_all(
        &mut isolated,
        given.subsegments.iter().map(|edge| edge_key(edge.ends[0], edge.ends[1])),
    )?;
    for code in (0..4 * given.tets.len() as u32).filter(|&code| mesh.is_wall(code)) {
        let [a, b, c] = mesh.face(code);
        for edge in [edge_key(a, b), edge_key(b, c), edge_key(c, a)] {
            isolated.remove(&edge);
        }
    }
    control.look()?;
    if !isolated.is_empty() {
        mesh.mark_subsegments(|v| {
            let bit = |(e, &[i, j]): (usize, &[u8; 2])| {
                u16::from(isolated.contains(&edge_key(v[i as usize], v[j as usize]))) << e
            };
            Ok(EDGE.iter().enumerate().map(bit).fold(0, |all, bit| all | bit))
        })?;
    }
    Ok(isolated)
}

/// Audits what must have stayed.
fn audit_kept(
    given: &TetMesh,
    stays: &[bool],
    mesh: &TetMesh,
    most: usize,
    control: &Control,
) -> Result<(), Error> {
    let mut faults = Faults::new(&mesh.points, most);
    let kept = given.points.iter().zip(stays).filter(|x| *x.1).map(|x| x.0);
    for (i, (p, q)) in (0..).zip(kept.zip(&mesh.points)) {
        if (0..3).any(|k| p[k].to_bits() != q[k].to_bits()) {
            faults.add(DefectKind::PointMoved, Element::Point(i), None, i);
        }
    }
    faults.finish(Status::Internal, "audit")?;
    let promise = Promise {
        triangles: fallible::collect(mesh.subfaces.iter().map(|face| (face.corners, face.facet)))?,
        segments: fallible::collect(mesh.subsegments.iter().map(|edge| (edge.ends, edge.segment)))?,
        ..Promise::default()
    };
    let audited = audit(&Plc::default(), mesh, most, control)
        .and_then(|()| audit_promise(mesh, &promise, most, control));
    audited.map_err(|e| match e.status {
        Status::CheckFailed => Error { status: Status::Internal, ..e.at(format_args!("audit")) },
        _ => e,
    })
}
