//! The arguments.
use super::sizes::{angle, extent, Extent, MeshSizeArgs, SizeArgs};
use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use delotet::io::RegionName;
use std::path::PathBuf;
use std::time::Duration;

/// Exact 3D constrained Delaunay tetrahedralization.
#[derive(Debug, Parser)]
#[command(name = "delotet", version, about, arg_required_else_help = true)]
#[command(after_help = "Exit codes: 0 done, 1 invalid input, 2 usage, 3 limit or cancel, 4 internal.")]
pub struct Args {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Mesh the volume that a surface encloses (or the convex hull of a point set).
    Mesh(Box<MeshArgs>),
    /// Refine a mesh: add points inside, keep its faces and edges.
    Refine(Box<RefineArgs>),
    /// Improve the angles of a mesh, keep its faces and edges.
    Improve(Box<ImproveArgs>),
    /// Check a mesh exactly against its input.
    Check(CheckArgs),
    /// Show what is in a surface file, whether it is valid, and where it is not.
    Info(InfoArgs),
    /// Convert between surface formats.
    Convert(ConvertArgs),
    /// Mesh or refine with the switches and files of TetGen; also by a link to this program named tetgen.
    #[cfg(feature = "tetgen")]
    #[command(disable_help_flag = true)]
    Tetgen(TetgenArgs),
}

#[cfg(feature = "tetgen")]
#[derive(Debug, ClapArgs)]
pub struct TetgenArgs {
    /// Switches and a file; -h lists them
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    pub words: Vec<std::ffi::OsString>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ModeArg {
    /// The Delaunay tetrahedralization of the points; facets and segments are ignored.
    Delaunay,
    /// The constrained Delaunay tetrahedralization of the surface.
    Cdt,
    /// The surface kept as it is, except for diagonals of polygons: points are added only inside.
    Preserve,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PreserveArg {
    /// Every facet and segment.
    All,
    /// The outer boundary; internal facets may get points.
    Outer,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MshVersionArg {
    /// The version of Gmsh 4.
    #[value(name = "4.1")]
    V41,
    /// The version that many solvers read; some read no other.
    #[value(name = "2.2")]
    V22,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum WeightsArg {
    /// Of two points the one with the smaller squared distance minus weight is the nearer one.
    Weight,
    /// The height of the lifted point, which stands for the weight x² + y² + z² minus it.
    Height,
}

#[derive(Debug, ClapArgs)]
pub struct MeshArgs {
    /// The surface: .off .stl .obj .ply .poly .smesh, or points: .node
    pub input: PathBuf,
    /// The mesh: .vtu .vtk .msh .inp .mesh, or .ele (with .node .face .edge .neigh beside it)
    #[arg(short, long)]
    pub output: PathBuf,
    /// What is made (default: cdt; delaunay for a .node file)
    #[arg(long, value_enum)]
    pub mode: Option<ModeArg>,
    /// With --mode preserve: what is kept
    #[arg(long, value_enum, default_value = "all")]
    pub preserve: PreserveArg,
    /// With --mode delaunay: the first attribute of each point is its weight (or the height of its lift); points that others hide by their
    /// weights are left out
    #[arg(long, value_name = "KIND", value_enum, num_args = 0..=1, require_equals = true, default_missing_value = "weight")]
    pub weights: Option<WeightsArg>,
    /// With --mode delaunay: also write the bounded cells of the Voronoi diagram (with --weights: of the power diagram) as polyhedra
    #[arg(long, value_name = "FILE.vtu")]
    pub voronoi: Option<PathBuf>,
    /// First flip the triangles of nearly coplanar facets (meeting at more than DEG degrees) to be Delaunay on the surface
    #[arg(long, value_name = "DEG", num_args = 0..=1, require_equals = true, default_missing_value = "179.9")]
    pub merge_facets: Option<f64>,
    #[command(flatten)]
    pub sizes: SizeArgs,
    /// Keep the whole convex hull
    #[arg(long)]
    pub keep_hull: bool,
    /// Leave out points that belong to no tetrahedron; the others are renumbered, as STEM.parents records
    #[arg(long)]
    pub drop_points: bool,
    /// A point in a hole (may be repeated)
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers::<3, 3>)]
    pub hole: Vec<Numbers>,
    /// A point in a region and the attribute of its tetrahedra (may be repeated)
    #[arg(long, value_name = "X,Y,Z,ATTRIBUTE", allow_hyphen_values = true, value_parser = numbers::<4, 5>)]
    pub region: Vec<Numbers>,
    /// Worker threads, 0 for one per processor; the mesh is the same for any number
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub threads: usize,
    #[command(flatten)]
    pub limits: LimitArgs,
    #[command(flatten)]
    pub write: WriteArgs,
    #[command(flatten)]
    pub say: SayArgs,
}

/// What ends a run.
#[derive(Debug, ClapArgs)]
pub struct LimitArgs {
    /// Stop after this time
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time_limit: Option<Duration>,
    /// Stop before memory has grown by this much; K, M, G (1000s) and Ki, Mi, Gi (1024s) may follow
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    pub memory_limit: Option<u64>,
    /// Stop if more Steiner points than this are needed
    #[arg(long, value_name = "N")]
    pub steiner_limit: Option<u64>,
    /// Stop if the mesh has more tetrahedra than this
    #[arg(long, value_name = "N")]
    pub tetrahedra_limit: Option<u64>,
}

/// How a mesh is written.
#[derive(Debug, ClapArgs)]
pub struct WriteArgs {
    /// With .vtu: compress the arrays
    #[arg(long)]
    pub compress: bool,
    /// With .vtu: also write the pieces of the facets, to STEM_subfaces.vtu
    #[arg(long)]
    pub subfaces: bool,
    /// With .vtu: also write largest dihedral angles, radius-edge ratios, mean ratios and volumes
    #[arg(long)]
    pub quality_data: bool,
    /// Write tetrahedra of ten nodes: corners and edge midpoints (not in .mesh)
    #[arg(long)]
    pub second_order: bool,
    /// With .msh: the version of the format
    #[arg(long, value_enum, value_name = "VERSION", default_value = "4.1")]
    pub msh_version: MshVersionArg,
    /// With .msh and .inp: the name of the regions with an attribute (may be repeated)
    #[arg(long, value_name = "ATTRIBUTE=NAME", allow_hyphen_values = true, value_parser = region_name)]
    pub region_name: Vec<RegionName>,
}

/// What is printed and reported.
#[derive(Debug, ClapArgs)]
pub struct SayArgs {
    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
    /// Write counts, quality and times as JSON
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
    /// Write the outcome with every defect (or flips of --merge-facets and facets in narrow wedges) as JSON, even on failure
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub struct RefineArgs {
    /// The mesh: .ele (with .node, and .face and .edge if they are there), .vtu .msh .mesh
    pub input: PathBuf,
    /// The refined mesh: .vtu .vtk .msh .inp .mesh, or .ele (with .node .face .edge .neigh beside it)
    #[arg(short, long)]
    pub output: PathBuf,
    #[command(flatten)]
    pub sizes: MeshSizeArgs,
    /// Optimise the smallest dihedral angles; larger efforts take longer. Or for some seconds, as in 10s
    #[arg(long, value_name = "EFFORT", num_args = 0..=1, require_equals = true, default_missing_value = "1", value_parser = extent)]
    pub optimize: Option<Extent>,
    /// The smallest dihedral angle wanted, in degrees: larger efforts are tried until it is reached
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = angle)]
    pub min_angle: Option<f64>,
    #[command(flatten)]
    pub given: GivenArgs,
}

#[derive(Debug, ClapArgs)]
pub struct ImproveArgs {
    /// The mesh: .ele (with .node, and .face and .edge if they are there), .vtu .msh .mesh
    pub input: PathBuf,
    /// The improved mesh: .vtu .vtk .msh .inp .mesh, or .ele (with .node .face .edge .neigh beside it)
    #[arg(short, long)]
    pub output: PathBuf,
    /// The effort: larger ones take longer. Or some seconds, as in 10s
    #[arg(long, value_name = "EFFORT", require_equals = true, num_args = 0..=1, default_value = "1", default_missing_value = "1", value_parser = extent)]
    pub optimize: Extent,
    /// The smallest dihedral angle wanted, in degrees: larger efforts are tried until it is reached
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = angle)]
    pub min_angle: Option<f64>,
    #[command(flatten)]
    pub given: GivenArgs,
}

/// What refining and improving share.
#[derive(Debug, ClapArgs)]
pub struct GivenArgs {
    /// The number of input points, which come first and stay; others may move and go if they are behind the last one on a kept face or edge
    /// (default: all points)
    #[arg(long, value_name = "N")]
    pub input_points: Option<u32>,
    #[command(flatten)]
    pub limits: LimitArgs,
    #[command(flatten)]
    pub write: WriteArgs,
    #[command(flatten)]
    pub say: SayArgs,
}

#[derive(Debug, ClapArgs)]
pub struct CheckArgs {
    /// The mesh: STEM.ele, with STEM.node and STEM.face beside it
    pub mesh: PathBuf,
    /// The surface that it was made from
    #[arg(long)]
    pub input: PathBuf,
    /// The first attribute of each input point was its weight (or the height of its lift): the mesh must be weighted Delaunay
    #[arg(long, value_name = "KIND", value_enum, num_args = 0..=1, require_equals = true, default_missing_value = "weight")]
    pub weights: Option<WeightsArg>,
    /// Do not require what the mode of the mesh (recorded in STEM.parents) guarantees: constrained Delaunay, or the surface kept
    #[arg(long)]
    pub no_delaunay: bool,
    /// Require the surface, or its outer boundary, unchanged: every triangle a face, no added point on it (implies --no-delaunay)
    #[arg(long, value_enum, num_args = 0..=1, require_equals = true, default_missing_value = "all")]
    pub preserved: Option<PreserveArg>,
    /// Write every defect as JSON
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub struct InfoArgs {
    /// The file: .off .stl .obj .ply .poly .smesh .node
    pub input: PathBuf,
    /// Write every defect as JSON
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub struct ConvertArgs {
    /// The file: .off .stl .obj .ply .poly .smesh .node
    pub input: PathBuf,
    /// The file to write: .off .stl .obj .ply .poly .smesh .node
    #[arg(short, long)]
    pub output: PathBuf,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let limit = text.parse::<f64>().ok().filter(|&seconds| seconds > 0.0);
    let limit = limit.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    limit.ok_or_else(|| "expected a number of seconds above 0".to_string())
}

/// `1.5G`: a number and a unit.
fn bytes(text: &str) -> Result<u64, String> {
    let (number, unit) = text.split_at(text.find(|c: char| c.is_alphabetic()).unwrap_or(text.len()));
    let unit = match unit {
        "" => 1.0,
        "K" => 1e3,
        "M" => 1e6,
        "G" => 1e9,
        "Ki" => 1024.0,
        "Mi" => 1024.0 * 1024.0,
        "Gi" => 1024.0 * 1024.0 * 1024.0,
        _ => f64::NAN,
    };
    match number.parse::<f64>().map(|number| number * unit) {
        // A saturating conversion: more than there are addresses is no limit.
        Ok(bytes) if bytes >= 1.0 && bytes.is_finite() => Ok(bytes as u64),
        _ => {
            Err("expected a number of bytes above 0, with K, M, G, Ki, Mi, Gi or nothing behind it"
                .to_string())
        }
    }
}

fn region_name(text: &str) -> Result<RegionName, String> {
    let parts = text.split_once('=').map(|(attribute, name)| (attribute.trim().parse::<f64>(), name.trim()));
    match parts {
        Some((Ok(attribute), name)) if attribute.is_finite() && !name.is_empty() => {
            Ok(RegionName { attribute, name: name.to_string() })
        }
        _ => Err("expected a number, '=' and a name".to_string()),
    }
}

/// Numbers separated by commas.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers(pub Vec<f64>);

fn numbers<const MIN: usize, const MAX: usize>(text: &str) -> Result<Numbers, String> {
    let values: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    match values {
        Ok(values) if (MIN..=MAX).contains(&values.len()) && values.iter().all(|x| x.is_finite()) => {
            Ok(Numbers(values))
        }
        _ => Err(format!("expected {MIN} finite numbers separated by commas")),
    }
}
