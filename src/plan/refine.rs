//! Points inside by size and shape, then optimisation ([`Options::size`], [`Options::quality`], [`Options::optimize`]).
use crate::blocks::{Crew, Model};
use crate::domain::Domain;
use crate::elementary::{cosine_of_degrees, exponent, power_of_two};
use crate::error::{Error, Status};
use crate::fallible;
use crate::fill::{bound_volumes, estimate, fill, Shape};
use crate::kernel::tables::EDGE;
use crate::kernel::{edge_key, Mesh};
use crate::optimise::slide::Slides;
use crate::optimise::{optimise, Extent, Request, Subject};
use crate::options::{Mode, Options};
use crate::output::Region;
use crate::plan::{Engine, Run};
use crate::plc::surface::Surface;
use crate::plc::Plc;
use crate::preserve::inside::Inside;
use crate::preserve::Freed;
use crate::progress::Phase;
use crate::size::{scaled, Bounds, Given, Size};
use rustc_hash::FxHashSet;

/// What a mesh is made from.
#[derive(Clone, Copy)]
pub(super) struct Input<'a> {
    pub plc: &'a Plc,
    pub surface: &'a Surface,
    pub regions: &'a Domain,
}

/// Whether the mesh is filled with points.
pub(super) fn fills(options: &Options) -> bool {
    let lengths = options.size.is_some() || options.max_volume.is_some() || options.size_function.is_some();
    lengths || options.quality.is_some()
}

/// Whether the mesh is filled or optimised.
pub(super) fn refines(options: &Options) -> bool {
    fills(options) || request(options).is_some()
}

/// How the mesh is optimised; `None`: not at all.
pub(super) fn request(options: &Options) -> Option<Request> {
    // An angle is reached from the state after some effort.
    let effort = options.optimize.max(u32::from(options.min_angle.is_some()));
    let effort = (effort > 0).then_some(Extent::Effort(effort));
    let extent = options.optimize_seconds.map(Extent::Seconds).or(effort)?;
    Some(Request { extent, sine: options.min_angle.map_or(0.0, |angle| cosine_of_degrees(90.0 - angle)) })
}

/// Refuses sizes and shapes that nothing can have, and modes that offer none.
pub(super) fn check(plc: &Plc, options: &Options) -> Result<(), Error> {
    let refuse = |what: std::fmt::Arguments| Err(Error::new(Status::InvalidArgument, what));
    let (least, most) = (Options::LEAST_RATIO, Options::LARGEST_MIN_ANGLE);
    if let Some(size) = options.size.filter(|&size| !(size > 0.0 && size.is_finite())) {
        return refuse(format_args!("size: {size} is no positive finite length"));
    }
    if let Some(ratio) = options.quality.filter(|&ratio| !(ratio >= least && ratio.is_finite())) {
        return refuse(format_args!("quality: {ratio} is no finite ratio of at least {least}"));
    }
    if let Some(volume) = options.max_volume.filter(|&volume| !(volume > 0.0 && volume.is_finite())) {
        return refuse(format_args!("max_volume: {volume} is no positive finite volume"));
    }
    if let Some(seconds) = options.optimize_seconds.filter(|&x| !(x > 0.0 && x.is_finite())) {
        return refuse(format_args!("optimize_seconds: {seconds} is no positive finite number of seconds"));
    }
    if let Some(angle) = options.min_angle.filter(|&angle| !(angle > 0.0 && angle <= most)) {
        return refuse(format_args!("min_angle: {angle} is not above 0 and at most {most} degrees"));
    }
    let gradation = options.gradation;
    if !(gradation > 0.0 && gradation <= 1.0) {
        return refuse(format_args!("gradation: {gradation} is not above 0 and at most 1"));
    }
    plc.sizes.check(plc.points.len())?;
    if refines(options) && options.mode == Mode::Delaunay {
        return refuse(format_args!("size, quality, optimize: not offered in mode delaunay"));
    }
    if request(options).is_some() && options.exact_form && options.mode == Mode::Constrained {
        return refuse(format_args!(
            "optimize: not offered with exact_form, whose tetrahedra need not be positive"
        ));
    }
    Ok(())
}

impl Run<'_> {
    /// Fills a mesh whose surface is kept, and optimises it, as the options say.
    pub(super) fn refine(
        &mut self,
        options: &Options,
        engine: &mut Engine,
        mesh: &mut Mesh,
        freed: &mut Freed,
        input: Input,
    ) -> Result<(), Error> {
        if !refines(options) {
            return Ok(());
        }
        // What fails from here on fails for good: other ways to the surface would lead to the same.
        self.is_refining = true;
        self.lap(Phase::Preserve);
        self.forget_refinement();
        let Freed { inside, isolated, settled, .. } = freed;
        inside.elsewhere = settled.len() as u64;
        mark_isolated(mesh, isolated)?;
        let interior = Interior { mesh, inside, isolated, slides: None };
        self.fill_and_optimise(options, engine, interior, input)?;
        self.is_refining = false;
        Ok(())
    }

    /// Forgets counts of a mesh that was given up.
    pub(super) fn forget_refinement(&mut self) {
        (self.statistics.refine, self.statistics.optimize) = Default::default();
    }

    /// Points inside between walls that stay, and optimisation, as the options say.
    pub(super) fn fill_and_optimise(
        &mut self,
        options: &Options,
        engine: &mut Engine,
        interior: Interior,
        input: Input,
    ) -> Result<(), Error> {
        let Interior { mesh, inside, isolated, slides } = interior;
        let mut limits = Bounds::default();
        if fills(options) {
            let part = self.control.whole(Phase::Refine);
            part.progress(0.0)?;
            part.steiner(inside.total(), usize::MAX / 200)?;
            limits = bounds(options, engine, input)?;
            let given = given(options, engine, input)?;
            let mut size = Size::new(mesh, &engine.points, isolated, given, options.gradation, &part)?;
            estimate(mesh, &engine.points, &size, &part)?;
            let shape = Shape { ratio: options.quality.unwrap_or(Options::USUAL_RATIO), delaunay: false };
            let counts = &mut self.statistics.refine;
            let points = &mut engine.points;
            let crew = Crew { threads: options.worker_threads(), part: part.part(0.0, 0.8) };
            counts.add(&fill(Model { mesh, points, inside }, &mut size, shape, crew)?);
            if !limits.is_empty() {
                let part = part.part(0.8, 1.0);
                counts.add(&bound_volumes(mesh, points, inside, &mut size, &limits, part)?);
            }
            self.lap(Phase::Refine);
        }
        let interior = Interior { mesh, inside, isolated, slides };
        self.optimise(options, engine, interior, &limits)
    }

    /// Optimisation, as the options say.
    pub(super) fn optimise(
        &mut self,
        options: &Options,
        engine: &mut Engine,
        interior: Interior,
        bounds: &Bounds,
    ) -> Result<(), Error> {
        let Interior { mesh, inside, isolated, slides } = interior;
        if let Some(request) = request(options) {
            let part = self.control.whole(Phase::Optimize);
            part.progress(0.0)?;
            let points = &mut engine.points;
            let subject = Subject { mesh, points, inside, isolated, slides, bounds };
            let crew = Crew { threads: options.worker_threads(), part };
            self.statistics.optimize.add(&optimise(subject, request, crew)?);
            self.lap(Phase::Optimize);
        }
        Ok(())
    }
}

/// What is inside of the walls.
pub(super) struct Interior<'a> {
    /// Carved, with isolated edges marked as subsegments.
    pub mesh: &'a mut Mesh,
    pub inside: &'a mut Inside,
    /// Edges on no wall that stay.
    pub isolated: &'a FxHashSet<[u32; 2]>,
    /// Points of the surface that may slide on it.
    pub slides: Option<&'a mut Slides>,
}

/// Marks these edges, and no others, as subsegments.
pub(super) fn mark_isolated(mesh: &mut Mesh, isolated: &FxHashSet<[u32; 2]>) -> Result<(), Error> {
    mesh.clear_subsegments();
    if isolated.is_empty() {
        return Ok(());
    }
    mesh.mark_subsegments(|v| {
        let bit = |(e, &[i, j]): (usize, &[u8; 2])| {
            u16::from(isolated.contains(&edge_key(v[i as usize], v[j as usize]))) << e
        };
        Ok(EDGE.iter().enumerate().map(bit).fold(0, |all, bit| all | bit))
    })
}

/// What the caller wants, in the engine's lengths.
pub(super) fn given<'a>(options: &'a Options, engine: &Engine, input: Input) -> Result<Given<'a>, Error> {
    let scaled = |x: f64| scaled(x, engine.scale);
    let least = |x: Option<f64>, y: Option<f64>| x.into_iter().chain(y).reduce(f64::min);
    let of_volume = |volume: f64| scaled(edge_of(volume));
    let sizes = &input.plc.sizes;
    let of_region = |region: &Region| {
        let wanted = sizes.regions.iter().find(|wanted| wanted.attribute == region.attribute);
        least(wanted.map(|wanted| scaled(wanted.size)), region.max_volume.map(of_volume))
    };
    Ok(Given {
        length: least(options.size.map(scaled), options.max_volume.map(of_volume)),
        of_region: fallible::collect(input.regions.regions.iter().map(of_region))?,
        at_vertices: at_vertices(engine, input)?,
        function: options.size_function.as_ref(),
        exponent: engine.scale,
    })
}

/// The largest volumes, in the engine's lengths.
pub(super) fn bounds(options: &Options, engine: &Engine, input: Input) -> Result<Bounds, Error> {
    let scaled = |volume: f64| scaled(volume, 3 * engine.scale);
    let regions = input.regions.regions.iter().map(|region| region.max_volume.map(scaled));
    Ok(Bounds { all: options.max_volume.map(scaled), of_region: fallible::collect(regions)? })
}

/// The lengths wanted at points, facets and segments, by vertex; empty if there are none.
fn at_vertices(engine: &Engine, Input { plc, surface, .. }: Input) -> Result<Vec<f64>, Error> {
    let sizes = &plc.sizes;
    if sizes.points.is_empty() && !sizes.on_facets() && sizes.segments.is_empty() {
        return Ok(Vec::new());
    }
    let mut out = fallible::filled(f64::INFINITY, engine.points.len())?;
    let mut lower = |point: u32, size: f64| {
        let size = scaled(size, engine.scale);
        if let Some(known) = out.get_mut(engine.engine_of[point as usize] as usize) {
            *known = size.min(*known);
        }
    };
    (0u32..).zip(&sizes.points).for_each(|(point, &size)| lower(point, size));
    for (corners, &facet) in surface.triangles.iter().zip(&surface.triangle_facet) {
        if let Some(size) = sizes.edge_of_facet(plc.facet_marker(facet as usize)) {
            corners.iter().for_each(|&v| lower(v, size));
        }
    }
    for (ends, &parent) in surface.segments.iter().zip(&surface.segment_parent) {
        let marker = plc.segments.get(parent as usize).map(|segment| segment.marker);
        if let Some(size) = marker.and_then(|marker| sizes.of_segment(marker)) {
            ends.iter().for_each(|&v| lower(v, size));
        }
    }
    Ok(out)
}

/// The edge of the regular tetrahedron of a volume: the cube root of 6 √2 times it, by Newton's method.
pub(super) fn edge_of(volume: f64) -> f64 {
    // A number of this size would overflow, and asks for nothing.
    if exponent(volume) > 1000 {
        return f64::INFINITY;
    }
    let cube = 6.0 * 2.0f64.sqrt() * volume;
    if cube < f64::MIN_POSITIVE {
        return f64::INFINITY;
    }
    let mut x = power_of_two(exponent(cube) / 3);
    for _ in 0..64 {
        x = (2.0 * x + cube / (x * x)) / 3.0;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edge_of_a_volume_has_this_volume() {
        for volume in [1e-30, 0.01, 1.0, 12345.0, 1e100] {
            let edge = edge_of(volume);
            assert!((edge * edge * edge / 72f64.sqrt() / volume - 1.0).abs() < 1e-12, "{volume}");
        }
    }

    #[test]
    fn nonsense_is_refused() {
        let base = || Options { mode: Mode::Preserve, ..Options::default() };
        let status = |options: Options| check(&Plc::default(), &options).err().map(|e| e.status);
        for x in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(status(Options { size: Some(x), ..base() }), Some(Status::InvalidArgument));
            assert_eq!(status(Options { quality: Some(x), ..base() }), Some(Status::InvalidArgument));
            assert_eq!(status(Options { max_volume: Some(x), ..base() }), Some(Status::InvalidArgument));
            assert_eq!(status(Options { gradation: x, ..base() }), Some(Status::InvalidArgument));
            assert_eq!(
                status(Options { optimize_seconds: Some(x), ..base() }),
                Some(Status::InvalidArgument)
            );
        }
        for x in [0.0, -1.0, f64::NAN, 60.001] {
            assert_eq!(status(Options { min_angle: Some(x), ..base() }), Some(Status::InvalidArgument));
        }
        let delaunay = Options { mode: Mode::Delaunay, min_angle: Some(20.0), ..Options::default() };
        assert_eq!(status(delaunay), Some(Status::InvalidArgument));
        assert_eq!(status(Options { min_angle: Some(60.0), ..base() }), None);
        assert_eq!(status(Options { size: Some(0.5), quality: Some(2.0), ..base() }), None);
        assert_eq!(status(Options { size: Some(0.5), ..Options::default() }), None);
        let mode = Mode::Delaunay;
        assert_eq!(
            status(Options { size: Some(0.5), mode, ..Options::default() }),
            Some(Status::InvalidArgument)
        );
    }
}
