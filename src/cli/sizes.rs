//! The arguments for points by size and shape, and the file with a size per point.
use super::given::invalid;
use super::Failure;
use clap::Args;
use delotet::{Control, Error, MarkerSize, MeshSizes, Options, Plc, RegionSize, SizeFunction, Status};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

#[derive(Debug, Default, Args)]
pub struct SizeArgs {
    /// Fill with points, for edges no longer than this; with --mode preserve only inside
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = positive)]
    pub size: Option<f64>,
    /// Fill with points, for no tetrahedron larger than this where the surface allows it
    #[arg(long, value_name = "VOLUME", allow_hyphen_values = true, value_parser = positive)]
    pub max_volume: Option<f64>,
    /// How fast sizes may grow: by at most this times the distance (default: 0.3)
    #[arg(long, value_name = "SLOPE", allow_hyphen_values = true, value_parser = slope)]
    pub gradation: Option<f64>,
    /// Fill with points, for circumradii of at most RATIO (1.414; with --mode preserve 2) shortest edges where the surface allows it
    #[arg(long, value_name = "RATIO", num_args = 0..=1, require_equals = true, value_parser = ratio)]
    pub quality: Option<Option<f64>>,
    /// Optimise the smallest dihedral angles; larger efforts take longer. Or for some seconds, as in 10s
    #[arg(long, value_name = "EFFORT", num_args = 0..=1, require_equals = true, default_missing_value = "1", value_parser = extent)]
    pub optimize: Option<Extent>,
    /// The smallest dihedral angle wanted, in degrees: larger efforts are tried until it is reached
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = angle)]
    pub min_angle: Option<f64>,
    /// The edge length wanted in the regions with an attribute (may be repeated)
    #[arg(long, value_name = "ATTRIBUTE=LENGTH", allow_hyphen_values = true, value_parser = region_size)]
    pub region_size: Vec<RegionSize>,
    /// The edge length wanted at the facets with a marker (may be repeated)
    #[arg(long, value_name = "MARKER=LENGTH", allow_hyphen_values = true, value_parser = marker_size)]
    pub facet_size: Vec<MarkerSize>,
    /// The largest area wanted of the pieces of the facets with a marker (may be repeated)
    #[arg(long, value_name = "MARKER=AREA", allow_hyphen_values = true, value_parser = marker_size)]
    pub facet_area: Vec<MarkerSize>,
    /// The edge length wanted at the segments with a marker (may be repeated)
    #[arg(long, value_name = "MARKER=LENGTH", allow_hyphen_values = true, value_parser = marker_size)]
    pub segment_size: Vec<MarkerSize>,
    /// The edge lengths wanted at the points: a number for each, one to a line, or TetGen's .mtr; 0 is no wish
    #[arg(long, value_name = "FILE")]
    pub size_file: Option<PathBuf>,
    #[command(flatten)]
    pub background: BackgroundArgs,
}

/// A mesh with a size at each of its points.
#[derive(Debug, Default, Args)]
pub struct BackgroundArgs {
    /// Fill with points, for edges as long as a background mesh says: linear between the sizes at its points (.ele .vtu .msh .mesh)
    #[arg(long, value_name = "MESH")]
    pub background: Option<PathBuf>,
    /// The sizes at the points of the background mesh: a number for each, one to a line, or TetGen's .mtr; 0 is no wish (default: the .mtr
    /// beside it)
    #[arg(long, value_name = "FILE", requires = "background")]
    pub background_sizes: Option<PathBuf>,
}

impl BackgroundArgs {
    /// The file of sizes.
    fn sizes(&self, mesh: &Path) -> PathBuf {
        self.background_sizes.clone().unwrap_or_else(|| mesh.with_extension("mtr"))
    }

    /// The files that are read.
    pub fn inputs(&self) -> Result<Vec<PathBuf>, Failure> {
        let Some(mesh) = &self.background else { return Ok(Vec::new()) };
        let mut inputs = delotet::io::array_sources(mesh)?;
        inputs.push(self.sizes(mesh));
        Ok(inputs)
    }

    /// The sizes that the files say.
    pub fn read(&self, control: &Control) -> Result<Option<SizeFunction>, Failure> {
        let Some(path) = &self.background else { return Ok(None) };
        let mesh = control.muted(|| {
            let arrays = delotet::io::read_arrays_with(path, control)?.arrays;
            delotet::mesh_from_arrays_with(arrays, 1000, control).map_err(invalid)
        })?;
        let path = self.sizes(path);
        let sizes = sizes(&text_of(&path)?, mesh.points.len()).map_err(|what| {
            let what = what.replace("the input has", "the background mesh has");
            Error::new(Status::Format, format!("{}: {what}", path.display()))
        })?;
        Ok(Some(SizeFunction::of_mesh(&mesh, &sizes)?))
    }
}

/// The same for a mesh that is refined.
#[derive(Debug, Default, Args)]
pub struct MeshSizeArgs {
    /// The edge lengths wanted in the mesh: a number for each point or for each tetrahedron, one to a line, or TetGen's .mtr; 0 is no wish
    #[arg(long, value_name = "FILE")]
    pub sizes: Option<PathBuf>,
    /// The largest edge length wanted anywhere inside
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = positive)]
    pub size: Option<f64>,
    /// The largest volume of a tetrahedron, where the kept faces allow it
    #[arg(long, value_name = "VOLUME", allow_hyphen_values = true, value_parser = positive)]
    pub max_volume: Option<f64>,
    /// How fast sizes may grow: by at most this times the distance (default: 0.3)
    #[arg(long, value_name = "SLOPE", allow_hyphen_values = true, value_parser = slope)]
    pub gradation: Option<f64>,
    /// Circumradii of at most RATIO shortest edges, where the kept faces allow it
    #[arg(long, value_name = "RATIO", num_args = 0..=1, require_equals = true, default_missing_value = "2", value_parser = ratio)]
    pub quality: Option<f64>,
    /// The edge length wanted in the regions with an attribute (may be repeated)
    #[arg(long, value_name = "ATTRIBUTE=LENGTH", allow_hyphen_values = true, value_parser = region_size)]
    pub region_size: Vec<RegionSize>,
    /// The edge length wanted at the kept faces with a marker (may be repeated)
    #[arg(long, value_name = "MARKER=LENGTH", allow_hyphen_values = true, value_parser = marker_size)]
    pub facet_size: Vec<MarkerSize>,
    /// The area of a face that fits the edge length wanted at the kept faces with a marker (may be repeated)
    #[arg(long, value_name = "MARKER=AREA", allow_hyphen_values = true, value_parser = marker_size)]
    pub facet_area: Vec<MarkerSize>,
    /// The edge length wanted at the kept edges with a marker (may be repeated)
    #[arg(long, value_name = "MARKER=LENGTH", allow_hyphen_values = true, value_parser = marker_size)]
    pub segment_size: Vec<MarkerSize>,
    #[command(flatten)]
    pub background: BackgroundArgs,
}

impl MeshSizeArgs {
    /// The sizes wanted in a mesh of so many points and tetrahedra.
    pub fn of(&self, points: usize, tets: usize) -> Result<MeshSizes, Failure> {
        let mut wanted = MeshSizes::default();
        for size in &self.facet_size {
            wanted.parts.set_facets(size.marker, size.size)?;
        }
        for area in &self.facet_area {
            wanted.parts.set_facet_areas(area.marker, area.size)?;
        }
        for size in &self.segment_size {
            wanted.parts.set_segments(size.marker, size.size)?;
        }
        for size in &self.region_size {
            wanted.parts.set_regions(size.attribute, size.size)?;
        }
        if let Some(path) = &self.sizes {
            let text = text_of(path)?;
            // Told apart by their number.
            let of_points = sizes(&text, points);
            match (of_points, sizes(&text, tets)) {
                (Ok(list), _) => wanted.parts.points = list,
                (Err(_), Ok(list)) => wanted.tets = list,
                (Err(what), Err(_)) => {
                    let what = what.replace("the input has", "the mesh has");
                    let message = format!("{}: {what} and {tets} tetrahedra", path.display());
                    return Err(Error::new(Status::Format, message).into());
                }
            }
        }
        Ok(wanted)
    }

    /// Whether nothing is wanted.
    pub fn is_empty(&self) -> bool {
        let facets = self.facet_size.is_empty() && self.facet_area.is_empty();
        let lists = facets && self.region_size.is_empty() && self.segment_size.is_empty();
        let bounds = self.size.is_none() && self.max_volume.is_none() && self.quality.is_none();
        lists && bounds && self.sizes.is_none() && self.background.background.is_none()
    }
}

impl SizeArgs {
    /// Gives the input the sizes of its parts.
    pub fn add_to(&self, plc: &mut Plc) -> Result<(), Failure> {
        for wanted in &self.facet_size {
            plc.sizes.set_facets(wanted.marker, wanted.size)?;
        }
        for wanted in &self.facet_area {
            plc.sizes.set_facet_areas(wanted.marker, wanted.size)?;
        }
        for wanted in &self.segment_size {
            plc.sizes.set_segments(wanted.marker, wanted.size)?;
        }
        for wanted in &self.region_size {
            plc.sizes.set_regions(wanted.attribute, wanted.size)?;
        }
        if let Some(path) = &self.size_file {
            plc.sizes.points = read(path, plc.points.len())?;
        }
        Ok(())
    }

    /// The options without effect because nothing is filled.
    pub fn unused(&self) -> impl Iterator<Item = &'static str> {
        let bounds = self.size.is_some() || self.max_volume.is_some() || self.quality.is_some();
        let fills = bounds || self.background.background.is_some();
        let given = [
            (self.gradation.is_some(), "--gradation"),
            (!self.region_size.is_empty(), "--region-size"),
            (!self.facet_size.is_empty(), "--facet-size"),
            (!self.facet_area.is_empty(), "--facet-area"),
            (!self.segment_size.is_empty(), "--segment-size"),
            (self.size_file.is_some(), "--size-file"),
        ];
        given.into_iter().filter(move |option| option.0 && !fills).map(|option| option.1)
    }
}

fn read(path: &Path, points: usize) -> Result<Vec<f64>, Error> {
    let text = text_of(path)?;
    sizes(&text, points).map_err(|what| Error::new(Status::Format, format!("{}: {what}", path.display())))
}

fn text_of(path: &Path) -> Result<String, Error> {
    let fail = |status, what: std::fmt::Arguments| Error::new(status, format!("{}: {what}", path.display()));
    let bytes = std::fs::read(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => fail(Status::File, format_args!("no such file")),
        _ => fail(Status::File, format_args!("{error}")),
    })?;
    String::from_utf8(bytes)
        .map_err(|_| fail(Status::Format, format_args!("not a file of sizes: it is not text")))
}

/// One size for each of so many points. A first line of two numbers is the header of an .mtr file: count, and sizes per point.
fn sizes(text: &str, points: usize) -> Result<Vec<f64>, String> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let content = text.lines().map(|line| line.split('#').next().unwrap_or_default().trim());
    let mut lines = content.zip(1..).filter(|line| !line.0.is_empty()).peekable();
    let header = lines.next_if(|line| line.0.split_whitespace().count() == 2);
    if let Some((header, number)) = header {
        let mut words = header.split_whitespace().map(str::parse::<usize>);
        let (Some(Ok(count)), Some(Ok(width))) = (words.next(), words.next()) else {
            return Err(format!("line {number}: two counts expected, found '{header}'"));
        };
        if width != 1 {
            return Err(format!(
                "line {number}: {width} numbers per point; only one, an edge length, is supported"
            ));
        }
        if count != points {
            return Err(format!("line {number}: sizes of {count} points; the input has {points}"));
        }
    }
    let values: Result<Vec<f64>, String> = lines.map(|(line, number)| size(line, number)).collect();
    let values = values?;
    match values.len() == points {
        true => Ok(values),
        false => Err(format!("{} sizes; the input has {points} points", values.len())),
    }
}

/// A line's number; infinite for no wish.
fn size(line: &str, number: usize) -> Result<f64, String> {
    match line.parse::<f64>() {
        Ok(size) if size > 0.0 => Ok(size),
        Ok(size) if size <= 0.0 => Ok(f64::INFINITY),
        _ => Err(format!("line {number}: a size expected, found '{}'", line.escape_debug())),
    }
}

fn positive(text: &str) -> Result<f64, String> {
    let value = text.trim().parse::<f64>().ok().filter(|&value| value > 0.0 && value.is_finite());
    value.ok_or_else(|| "expected a finite number above 0".to_string())
}

/// How long to optimise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    Effort(u32),
    Seconds(f64),
}

impl Extent {
    pub fn effort(self) -> u32 {
        match self {
            Extent::Effort(effort) => effort,
            Extent::Seconds(_) => 0,
        }
    }

    pub fn seconds(self) -> Option<f64> {
        match self {
            Extent::Effort(_) => None,
            Extent::Seconds(seconds) => Some(seconds),
        }
    }
}

pub fn extent(text: &str) -> Result<Extent, String> {
    let extent = match text.strip_suffix('s') {
        Some(seconds) => positive(seconds).ok().map(Extent::Seconds),
        None => text.parse().ok().map(Extent::Effort),
    };
    extent.ok_or_else(|| "expected a number that is an effort, or seconds above 0, as in 10s".to_string())
}

fn slope(text: &str) -> Result<f64, String> {
    let value = text.trim().parse::<f64>().ok().filter(|&value| value > 0.0 && value <= 1.0);
    value.ok_or_else(|| "expected a number above 0, at most 1".to_string())
}

fn ratio(text: &str) -> Result<f64, String> {
    let least = Options::LEAST_RATIO;
    let value = text.trim().parse::<f64>().ok().filter(|&value| value >= least && value.is_finite());
    value.ok_or_else(|| format!("expected a finite number of at least {least}"))
}

pub fn angle(text: &str) -> Result<f64, String> {
    let most = Options::LARGEST_MIN_ANGLE;
    let value = text.trim().parse::<f64>().ok().filter(|&value| value > 0.0 && value <= most);
    value.ok_or_else(|| format!("expected an angle above 0, at most {most}"))
}

fn marker_size(text: &str) -> Result<MarkerSize, String> {
    let parts = text.split_once('=').map(|(marker, size)| (marker.trim().parse(), positive(size)));
    match parts {
        Some((Ok(marker), Ok(size))) => Ok(MarkerSize { marker, size }),
        _ => Err("expected an integer, '=' and a finite number above 0".to_string()),
    }
}

fn region_size(text: &str) -> Result<RegionSize, String> {
    let parts =
        text.split_once('=').map(|(attribute, size)| (attribute.trim().parse::<f64>(), positive(size)));
    match parts {
        Some((Ok(attribute), Ok(size))) if attribute.is_finite() => Ok(RegionSize { attribute, size }),
        _ => Err("expected a number, '=' and a finite number above 0".to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_with_and_without_a_header() {
        let no_wish = f64::INFINITY;
        let expected = Ok(vec![0.5, no_wish, no_wish, 1e-3]);
        for text in [
            "0.5\n0\n-1\n1e-3\n",
            "# a file\r\n 0.5 # the first\r\n\r\ninf\r\n-inf\r\n1e-3",
            "4 1\n0.5\n0\n0\n.001\n",
        ] {
            assert_eq!(sizes(text, 4), expected, "{text}");
        }
        assert_eq!(sizes("", 0), Ok(vec![]));
        assert_eq!(sizes("\u{feff}0 1\n", 0), Ok(vec![]));
    }

    #[test]
    fn files_of_anything_else_are_refused_with_the_line() {
        for (text, said) in [
            ("1\n2\n", "2 sizes; the input has 3 points"),
            ("1\n2\n3\n4\n", "4 sizes; the input has 3 points"),
            ("2 1\n1\n2\n", "line 1: sizes of 2 points; the input has 3"),
            ("# metric\n3 6\n", "line 2: 6 numbers per point; only one, an edge length, is supported"),
            ("3 1\n1\n2\n", "2 sizes; the input has 3 points"),
            ("1 a\n", "line 1: two counts expected, found '1 a'"),
            ("1\nnan\n2\n", "line 2: a size expected, found 'nan'"),
            ("1\n2 3\n4\n", "line 2: a size expected, found '2 3'"),
        ] {
            assert_eq!(sizes(text, 3), Err(said.to_string()), "{text}");
        }
    }

    #[test]
    fn sizes_of_parts_have_a_name_and_a_length() {
        assert_eq!(marker_size("-3=0.5"), Ok(MarkerSize { marker: -3, size: 0.5 }));
        assert_eq!(region_size(" 2.5 = 1e3 "), Ok(RegionSize { attribute: 2.5, size: 1e3 }));
        for text in ["", "3", "3=", "=1", "3=0", "3=-1", "3=nan", "3=inf", "x=1"] {
            assert!(marker_size(text).is_err() && region_size(text).is_err(), "{text}");
        }
        assert!(marker_size("2.5=1").is_err() && region_size("nan=1").is_err());
        assert!(slope("1").is_ok() && slope("1.01").is_err() && slope("0").is_err() && slope("nan").is_err());
        assert!(
            ratio("1").is_ok() && ratio("0.99").is_err() && ratio("inf").is_err() && ratio("nan").is_err()
        );
    }

    #[test]
    fn efforts_are_numbers_or_seconds() {
        assert_eq!(extent("3"), Ok(Extent::Effort(3)));
        assert_eq!(extent("0"), Ok(Extent::Effort(0)));
        assert_eq!(extent("2.5s"), Ok(Extent::Seconds(2.5)));
        for text in ["", "s", "-1", "1.5", "0s", "-1s", "nans", "infs", "1m", "1 s s"] {
            assert!(extent(text).is_err(), "{text}");
        }
    }

    #[test]
    fn what_fills_nothing_is_named() {
        let mut args =
            SizeArgs { gradation: Some(0.5), size_file: Some(PathBuf::from("a")), ..SizeArgs::default() };
        assert_eq!(args.unused().collect::<Vec<_>>(), ["--gradation", "--size-file"]);
        args.quality = Some(None);
        assert_eq!(args.unused().count(), 0);
    }
}
