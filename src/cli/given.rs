//! `delotet refine` and `delotet improve`.
use super::args::{GivenArgs, ImproveArgs, LimitArgs, RefineArgs};
use super::mesh::{reported, tell_unused_in, told, write_options};
use super::observer::Console;
use super::sizes::Extent;
use super::{page, paths, Failure};
use delotet::io::{self, MeshFile, WriteOptions};
use delotet::query::PointData;
use delotet::{controlled, Control, MeshArrays, Options, Phase, Plc, TetMesh};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Where a mesh comes from and goes to, and how.
struct Job<'a> {
    input: &'a Path,
    output: &'a Path,
    args: &'a GivenArgs,
    /// The files that are read.
    inputs: Vec<PathBuf>,
}

/// Reads a mesh, refines it and writes the result.
pub fn refine(args: &RefineArgs) -> Result<(), Failure> {
    let mut inputs = io::array_sources(&args.input)?;
    inputs.extend(args.sizes.sizes.clone());
    inputs.extend(args.sizes.background.inputs()?);
    let job = Job { input: &args.input, output: &args.output, args: &args.given, inputs };
    let defaults = Options::default();
    let options = Options {
        size: args.sizes.size,
        max_volume: args.sizes.max_volume,
        gradation: args.sizes.gradation.unwrap_or(defaults.gradation),
        quality: args.sizes.quality,
        optimize: args.optimize.map_or(0, Extent::effort),
        optimize_seconds: args.optimize.and_then(Extent::seconds),
        min_angle: args.min_angle,
        ..limited(&args.given.limits)
    };
    if !args.given.say.quiet && args.sizes.is_empty() && args.optimize.is_none() && args.min_angle.is_none() {
        page::tell(format_args!("warning: no sizes are given: nothing is refined"));
    }
    job.run(options, |mesh, options, control| {
        let sizes = args.sizes.of(mesh.points.len(), mesh.tets.len())?;
        let options = Options { size_function: args.sizes.background.read(control)?, ..options.clone() };
        Ok(delotet::refine_with(mesh, &sizes, &options, control)?)
    })
}

/// Reads a mesh, improves it and writes the result.
pub fn improve(args: &ImproveArgs) -> Result<(), Failure> {
    let inputs = io::array_sources(&args.input)?;
    let job = Job { input: &args.input, output: &args.output, args: &args.given, inputs };
    let options = Options {
        optimize: args.optimize.effort(),
        optimize_seconds: args.optimize.seconds(),
        min_angle: args.min_angle,
        ..limited(&args.given.limits)
    };
    job.run(options, |mesh, options, control| Ok(delotet::improve_with(mesh, options, control)?))
}

fn limited(limits: &LimitArgs) -> Options {
    Options {
        time_limit: limits.time_limit,
        memory_limit: limits.memory_limit,
        steiner_limit: limits.steiner_limit,
        tetrahedra_limit: limits.tetrahedra_limit,
        ..Options::default()
    }
}

impl Job<'_> {
    /// The whole command, where `change` makes the new mesh.
    fn run(
        &self,
        options: Options,
        change: impl Fn(&TetMesh, &Options, &Control) -> Result<TetMesh, Failure>,
    ) -> Result<(), Failure> {
        let say = &self.args.say;
        paths::check_report(say.report.as_deref(), &self.inputs)?;
        paths::check_distinct(&self.inputs, &self.outputs())?;
        let start = Instant::now();
        let mut console = Console::new(say.quiet);
        let write_options = write_options(&self.args.write, say);
        let max_defects = if say.report.is_some() { 10_000_000 } else { 1000 };
        let options = Options { cancel: Some(console.token()), max_defects, ..options };
        let made = self.check(&write_options).and_then(|()| {
            let make = |control: &Control| self.make(&options, &write_options, &change, control);
            let mesh = controlled(options.limits(), &mut console, make)?;
            told(mesh, self.output, say, start.elapsed().as_secs_f64(), &mut console)
        });
        console.finish();
        reported(say, made)
    }

    /// Fails early for file names and options that would fail only in the end.
    fn check(&self, write_options: &WriteOptions) -> Result<(), Failure> {
        paths::check_input(self.input)?;
        self.outputs().iter().try_for_each(|path| paths::check_output(path))?;
        write_options.check(self.output)?;
        if !self.args.say.quiet {
            tell_unused_in(self.output, write_options);
        }
        Ok(())
    }

    /// All files that are written.
    fn outputs(&self) -> Vec<PathBuf> {
        let mut outputs = paths::of_mesh(self.output, self.args.write.subfaces);
        outputs.extend(self.args.say.stats.clone());
        outputs.extend(self.args.say.report.clone());
        outputs
    }

    /// What the limits count for.
    fn make(
        &self,
        options: &Options,
        write_options: &WriteOptions,
        change: impl Fn(&TetMesh, &Options, &Control) -> Result<TetMesh, Failure>,
        control: &Control,
    ) -> Result<TetMesh, Failure> {
        let start = Instant::now();
        control.progress(Phase::Read, 0.0)?;
        let MeshFile { arrays, attribute_count, attributes, markers } =
            io::read_arrays_with(self.input, control)?;
        let arrays = MeshArrays { input_point_count: self.args.input_points, ..arrays };
        let read = start.elapsed().as_secs_f64();
        // A file that holds no mesh is invalid input.
        let mesh = delotet::mesh_from_arrays_with(arrays, options.max_defects, control).map_err(invalid)?;
        let data = PointData { attribute_count, attributes, markers };
        let mut made = change(&mesh, options, control)?;
        control.progress(Phase::Write, 0.0)?;
        let start = Instant::now();
        let data = data.continued(&mesh, &made)?;
        let plc = carrier(&made, data);
        let lost = io::write_with(self.output, &made, &plc, write_options, control);
        made.warnings.append(&lost.map_err(Failure::usage)?);
        let seconds = &mut made.statistics.seconds;
        seconds[Phase::Read as usize] = read;
        seconds[Phase::Write as usize] = start.elapsed().as_secs_f64();
        Ok(made)
    }
}

pub(super) fn invalid(error: delotet::Error) -> Failure {
    let of_input = matches!(error.status, delotet::Status::CheckFailed | delotet::Status::InvalidArgument);
    let failure = Failure::from(error);
    if of_input {
        failure.with_code(1)
    } else {
        failure
    }
}

/// What the writers take points' markers and attributes from.
fn carrier(mesh: &TetMesh, data: PointData) -> Plc {
    let (inputs, width) = (mesh.input_point_count as usize, data.attribute_count);
    let head = |list: &[f64]| list.get(..inputs * width).unwrap_or_default().to_vec();
    Plc {
        points: mesh.points.get(..inputs).unwrap_or_default().to_vec(),
        point_attribute_count: width,
        point_attributes: head(&data.attributes),
        point_markers: data.markers.get(..inputs).unwrap_or_default().to_vec(),
        ..Plc::default()
    }
}
