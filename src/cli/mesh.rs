//! `delotet mesh`.
use super::args::{MeshArgs, ModeArg, MshVersionArg, PreserveArg, SayArgs, WriteArgs};
use super::observer::Console;
use super::page::{self, Page};
use super::quality::Quality;
use super::sizes::Extent;
use super::{paths, report, summary, weights, Failure};
use delotet::io::{Format, MshVersion, UnusedOption, WriteOptions};
use delotet::{controlled, Control, Error, Mode, Options, Phase, Plc, Preserve, RegionSeed, Status, TetMesh};
use serde_json::{json, Map, Value};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Reads the input, meshes it and writes the mesh.
pub fn run(args: &MeshArgs) -> Result<(), Failure> {
    let mut inputs = delotet::io::sources(&args.input)?;
    inputs.extend(args.sizes.size_file.clone());
    inputs.extend(args.sizes.background.inputs()?);
    paths::check_report(args.say.report.as_deref(), &inputs)?;
    paths::check_distinct(&inputs, &outputs(args))?;
    let mut console = Console::new(args.say.quiet);
    let outcome = mesh(args, &mut console);
    console.finish();
    reported(&args.say, outcome)
}

/// A mesh and what is reported of its quality.
pub(super) struct Made {
    mesh: TetMesh,
    quality: Quality,
}

fn mesh(args: &MeshArgs, console: &mut Console) -> Result<Made, Failure> {
    let start = Instant::now();
    let write_options = write_options(&args.write, &args.say);
    check_files(args, &write_options)?;
    let options = Options { cancel: Some(console.token()), ..options(args)? };
    if !args.say.quiet {
        tell_unused(args, options.mode, &write_options);
    }
    let make = |control: &Control| read_mesh_and_write(args, &options, &write_options, control);
    let mesh = controlled(options.limits(), console, make)?;
    told(mesh, &args.output, &args.say, start.elapsed().as_secs_f64(), console)
}

/// Says what has been made, in the ways that are asked for.
pub(super) fn told(
    mesh: TetMesh,
    output: &Path,
    say: &SayArgs,
    total: f64,
    console: &mut Console,
) -> Result<Made, Failure> {
    // It takes a moment on large meshes, so only where somebody sees it.
    let seen = !say.quiet || say.stats.is_some() || say.report.is_some();
    let quality = if seen { Quality::of(&mesh)? } else { Quality::default() };
    if let Some(path) = &say.stats {
        let mut statistics = statistics(&mesh, total);
        statistics["quality"] = quality.as_json(&mesh)?;
        report::write(path, &statistics).map_err(Failure::usage)?;
    }
    console.finish();
    if !say.quiet {
        report::print_warnings(&mesh.warnings);
        let mut page = Page::default();
        summary::describe_mesh(&mut page, output, &mesh, &quality, total);
        page.print()?;
    }
    Ok(Made { mesh, quality })
}

/// Writes the report of a run, if there is to be one.
pub(super) fn reported(say: &SayArgs, outcome: Result<Made, Failure>) -> Result<(), Failure> {
    let of_mesh = |made: &Made| report::of_success(Some(&made.mesh), &made.quality, &made.mesh.warnings);
    report::write_if_asked(say.report.as_deref(), outcome, of_mesh).map(|_| ())
}

/// What the limits count for.
fn read_mesh_and_write(
    args: &MeshArgs,
    options: &Options,
    write_options: &WriteOptions,
    control: &Control,
) -> Result<TetMesh, Failure> {
    let start = Instant::now();
    control.progress(Phase::Read, 0.0)?;
    let mut plc = delotet::io::read_with(&args.input, control)?;
    add_seeds(&mut plc, args);
    weights::add_to(&mut plc, args.weights)?;
    args.sizes.add_to(&mut plc)?;
    let options = &Options { size_function: args.sizes.background.read(control)?, ..options.clone() };
    let read = start.elapsed().as_secs_f64();
    let mut mesh = delotet::tetrahedralize_with(&plc, options, control)?;
    control.progress(Phase::Write, 0.0)?;
    let start = Instant::now();
    let lost = delotet::io::write_with(&args.output, &mesh, &plc, write_options, control);
    mesh.warnings.append(&lost.map_err(Failure::usage)?);
    if let Some(path) = &args.voronoi {
        weights::write_cells(path, &mesh, control)?;
    }
    let seconds = &mut mesh.statistics.seconds;
    seconds[Phase::Read as usize] = read;
    seconds[Phase::Write as usize] = start.elapsed().as_secs_f64();
    Ok(mesh)
}

fn mode(args: &MeshArgs) -> Result<Mode, Failure> {
    let points_only = Format::of(&args.input)? == Format::Node;
    Ok(match args.mode {
        Some(ModeArg::Delaunay) => Mode::Delaunay,
        Some(ModeArg::Cdt) => Mode::Constrained,
        Some(ModeArg::Preserve) => Mode::Preserve,
        None if points_only => Mode::Delaunay,
        None => Mode::Constrained,
    })
}

fn options(args: &MeshArgs) -> Result<Options, Failure> {
    let mode = mode(args)?;
    let preserve = match args.preserve {
        PreserveArg::All => Preserve::All,
        PreserveArg::Outer if mode == Mode::Preserve => Preserve::Outer,
        PreserveArg::Outer => {
            let message = "--preserve outer requires --mode preserve";
            return Err(Error::new(Status::InvalidArgument, message).into());
        }
    };
    if let Some(angle) = args.merge_facets.filter(|a| !(90.0..=180.0).contains(a)) {
        let message = format!("--merge-facets={angle}: expected an angle of 90 to 180 degrees");
        return Err(Error::new(Status::InvalidArgument, message).into());
    }
    // Where points may come on the surface as well, a finer bound can be kept.
    let default_ratio = if mode == Mode::Constrained { 1.414 } else { 2.0 };
    let defaults = Options::default();
    Ok(Options {
        mode,
        preserve,
        keep_hull: args.keep_hull,
        drop_unmeshed_points: args.drop_points,
        merge_facets: args.merge_facets,
        size: args.sizes.size,
        max_volume: args.sizes.max_volume,
        gradation: args.sizes.gradation.unwrap_or(defaults.gradation),
        quality: args.sizes.quality.map(|ratio| ratio.unwrap_or(default_ratio)),
        optimize: args.sizes.optimize.map_or(defaults.optimize, Extent::effort),
        optimize_seconds: args.sizes.optimize.and_then(Extent::seconds),
        min_angle: args.sizes.min_angle,
        threads: args.threads,
        time_limit: args.limits.time_limit,
        memory_limit: args.limits.memory_limit,
        steiner_limit: args.limits.steiner_limit,
        tetrahedra_limit: args.limits.tetrahedra_limit,
        // A report lists everything, but memory stays bounded.
        max_defects: if args.say.report.is_some() { 10_000_000 } else { 1000 },
        ..defaults
    })
}

pub(super) fn write_options(args: &WriteArgs, say: &SayArgs) -> WriteOptions {
    WriteOptions {
        compress: args.compress,
        subfaces: args.subfaces,
        quality_data: args.quality_data,
        second_order: args.second_order,
        msh_version: match args.msh_version {
            MshVersionArg::V41 => MshVersion::V41,
            MshVersionArg::V22 => MshVersion::V22,
        },
        region_names: args.region_name.clone(),
        max_warnings: if say.report.is_some() { 10_000_000 } else { 1000 },
    }
}

/// Fails early for file names and options that would fail only after meshing.
fn check_files(args: &MeshArgs, options: &WriteOptions) -> Result<(), Failure> {
    paths::check_input(&args.input)?;
    outputs(args).iter().try_for_each(|path| paths::check_output(path))?;
    check_diagram(args)?;
    Ok(options.check(&args.output)?)
}

/// Fails for a diagram that no mesh of this run has.
fn check_diagram(args: &MeshArgs) -> Result<(), Failure> {
    let Some(path) = &args.voronoi else { return Ok(()) };
    let message = match Format::of(path)? {
        _ if mode(args)? != Mode::Delaunay => "--voronoi requires --mode delaunay".to_string(),
        Format::Vtu => return Ok(()),
        _ => format!("{}: Voronoi cells are written to .vtu files only", path.display()),
    };
    Err(Error::new(Status::InvalidArgument, message).into())
}

/// All files that are written.
fn outputs(args: &MeshArgs) -> Vec<PathBuf> {
    let mut outputs = paths::of_mesh(&args.output, args.write.subfaces);
    outputs.extend(args.voronoi.clone());
    outputs.extend(args.say.stats.clone());
    outputs.extend(args.say.report.clone());
    outputs
}

/// Warns of options of the writer that have no effect in the format.
pub(super) fn tell_unused_in(output: &Path, options: &WriteOptions) {
    let format = Format::of(output).unwrap_or(Format::Vtu);
    let name = output.extension().unwrap_or_default().to_string_lossy();
    for option in options.unused(format) {
        let text = match (option, format) {
            (UnusedOption::Compress, _) => "--compress: only .vtu can be compressed",
            (UnusedOption::Subfaces, Format::Vtk) => "--subfaces: only .vtu writes them to a second file",
            (UnusedOption::Subfaces, _) => "--subfaces: the file always contains the subfaces",
            (UnusedOption::QualityData, _) => "--quality-data: only .vtu holds it",
            (UnusedOption::SecondOrder, _) => "--second-order: the file holds no tetrahedra",
            (UnusedOption::MshVersion, _) => "--msh-version: the file is not .msh",
            (UnusedOption::RegionNames, _) => "--region-name: only .msh and .inp store names of regions",
        };
        page::tell(format_args!("warning: no effect with .{name}: {text}"));
    }
}

/// Warns of options that have no effect together with the others.
fn tell_unused(args: &MeshArgs, mode: Mode, options: &WriteOptions) {
    tell_unused_in(&args.output, options);
    for option in args.sizes.unused() {
        page::tell(format_args!(
            "warning: no effect without --size, --max-volume, --quality or --background: {option}: nothing is filled with points"
        ));
    }
    let delaunay = [
        (args.merge_facets.is_some(), "--merge-facets"),
        (args.keep_hull, "--keep-hull"),
        (!args.hole.is_empty(), "--hole"),
        (!args.region.is_empty(), "--region"),
    ];
    for (_, option) in delaunay.iter().filter(|x| x.0 && mode == Mode::Delaunay) {
        page::tell(format_args!(
            "warning: no effect with --mode delaunay: {option}: the mesh is the hull of the points, without facets"
        ));
    }
}

fn add_seeds(plc: &mut Plc, args: &MeshArgs) {
    plc.holes.extend(args.hole.iter().filter_map(|n| n.0.first_chunk::<3>().copied()));
    plc.regions.extend(args.region.iter().filter_map(|n| {
        let (&point, rest) = n.0.split_first_chunk::<3>()?;
        let max_volume = rest.get(1).copied().filter(|&v| v > 0.0);
        Some(RegionSeed { point, attribute: *rest.first()?, max_volume })
    }));
}

fn statistics(mesh: &TetMesh, total: f64) -> Value {
    let s = &mesh.statistics;
    let mut seconds: Map<String, Value> =
        Phase::ALL.iter().map(|&p| (p.name().to_string(), json!(s.seconds[p as usize]))).collect();
    seconds.insert("total".to_string(), json!(total));
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "status": "ok",
        "points_in": mesh.input_point_count,
        "points": mesh.points.len(),
        "duplicate_points": s.duplicate_points,
        "tets": mesh.tets.len(),
        "subfaces": mesh.subfaces.len(),
        "subsegments": mesh.subsegments.len(),
        "steiner": s.steiner,
        "steiner_exact": s.steiner_exact,
        "steiner_moved": s.steiner_moved,
        "replaced": s.replaced,
        "missing_segments": s.missing_segments,
        "missing_regions": s.missing_regions,
        "facet_flips": mesh.facet_flips.len(),
        "regions": mesh.regions.len(),
        "hull_kept": mesh.hull_kept,
        "warnings": report::warning_counts(&mesh.warnings),
        "peak_bytes": s.peak_bytes,
        "peak_resident_bytes": delotet::ffi::memory::peak_resident(),
        "preserve": {
            "missing_edges": s.preserve.missing_edges,
            "missing_faces": s.preserve.missing_faces,
            "by_reconnection": s.preserve.by_reconnection,
            "by_interior_points": s.preserve.by_interior_points,
            "by_splits": s.preserve.by_splits,
            "deleted": s.preserve.deleted,
            "relocated": s.preserve.relocated,
            "interior": s.preserve.interior,
            "on_internal_facets": s.preserve.on_internal_facets,
        },
        "refine": {
            "on_segments": s.refine.on_segments,
            "on_facets": s.refine.on_facets,
            "inside": s.refine.inside,
            "for_sizes": s.refine.for_sizes,
            "for_shapes": s.refine.for_shapes,
            "too_near": s.refine.too_near,
            "too_flat": s.refine.too_flat,
            "encroaching": s.refine.encroaching,
            "blocked": s.refine.blocked,
            "elsewhere": s.refine.elsewhere,
            "over_budget": s.refine.over_budget,
        },
        "optimize": {
            "passes": s.optimize.passes,
            "moves": s.optimize.moves,
            "edges_removed": s.optimize.edges_removed,
            "faces_removed": s.optimize.faces_removed,
            "reconnected": s.optimize.reconnected,
            "points_added": s.optimize.points_added,
            "points_removed": s.optimize.points_removed,
            "worst_before": s.optimize.worst_before,
            "worst_after": s.optimize.worst_after,
        },
        "seconds": seconds,
    })
}
