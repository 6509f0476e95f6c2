//! Hosts that trap floating-point exceptions, as Fortran programs and many solvers do: no operation divides by zero, is invalid (makes a
//! NaN) or overflows, on any path.
//!
//! A child process per input enables the traps, reads the model, makes meshes of it in all modes, checks and writes them; a trap ends it
//! by a signal. Inputs are our own models, some inputs at the limits of what is allowed, and the sample of the corpus, if present (in debug
//! builds only small models, which take long enough). Only with glibc, which can enable traps.
#![allow(unsafe_code)]

#[cfg(not(all(target_os = "linux", target_env = "gnu", target_arch = "x86_64")))]
fn main() {}

#[cfg(all(target_os = "linux", target_env = "gnu", target_arch = "x86_64"))]
fn main() {
    glibc::main();
}

#[cfg(all(target_os = "linux", target_env = "gnu", target_arch = "x86_64"))]
mod glibc {
    use delotet::io::{read, read_arrays, write, write_surface, WriteOptions};
    use delotet::{
        check_mesh, improve, mesh_from_arrays, refine, tetrahedralize, Lift, MeshSizes, Mode, Options, Plc,
        Segment, Silent, SizeFunction, Status, TetMesh,
    };
    use std::path::{Path, PathBuf};
    use std::process::Command;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::sync::Mutex;

    #[link(name = "m")]
    extern "C" {
        /// glibc, fenv.h.
        fn feenableexcept(exceptions: i32) -> i32;
    }
    /// FE_INVALID, FE_DIVBYZERO and FE_OVERFLOW of x86.
    const TRAPS: i32 = 1 | 4 | 8;

    /// Inputs at the limits of what is allowed: huge and tiny coordinates, flat and coincident elements.
    fn extremes() -> Vec<(&'static str, Plc)> {
        let cube = |size: f64| Plc {
            points: (0..8)
                .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|bit| if bit == 1 { size } else { -size }))
                .collect(),
            triangles: vec![
                [0, 2, 1],
                [1, 2, 3],
                [4, 5, 6],
                [5, 7, 6],
                [0, 1, 4],
                [1, 5, 4],
                [2, 6, 3],
                [3, 6, 7],
                [0, 4, 2],
                [2, 4, 6],
                [1, 3, 5],
                [3, 7, 5],
            ],
            ..Plc::default()
        };
        let with_segment = |size: f64, far: f64| {
            let mut plc = cube(size);
            plc.points.extend([[0.1 * size, 0.0, far], [-0.1 * size, 0.05 * size, -far]]);
            plc.segments.push(Segment { ends: [8, 9], marker: 1 });
            plc
        };
        let mut crossing = cube(1.0);
        crossing.points.push([3.0, 0.0, 0.0]);
        crossing.triangles.push([0, 7, 8]);
        let mut overlapping = cube(1.0);
        overlapping.triangles.push([0, 1, 3]);
        vec![
            ("cube of 10^60", with_segment(1e60, 5e59)),
            ("cube of 10^150", with_segment(1e150, 5e149)),
            ("cube of 10^307", with_segment(1e307, 5e306)),
            ("cube of 10^-200", with_segment(1e-200, 5e-201)),
            ("cube of 10^-300", cube(1e-300)),
            ("needle", with_segment(1.0, 1e-9)),
            ("crossing", crossing),
            ("overlapping", overlapping),
            (
                "points in a plane",
                Plc { points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], ..Plc::default() },
            ),
            ("nothing", Plc::default()),
            ("one point", Plc { points: vec![[1.0, -3.0, 0.1]], ..Plc::default() }),
            ("equal points", Plc { points: vec![[5e-300; 3]; 4], ..Plc::default() }),
            (
                "points that are nearly one",
                Plc { points: vec![[1.0; 3], [1.0, 1.0, 1.0 + f64::EPSILON]], ..Plc::default() },
            ),
            (
                "points in a tiny plane",
                Plc { points: vec![[1.0, 0.0, 0.0], [1.0, 1e-30, 0.0], [1.0, 0.0, 1e-30]], ..Plc::default() },
            ),
        ]
    }

    fn files() -> Vec<PathBuf> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let data = root.join("capi-tests/data");
        let most_of_ours = if cfg!(debug_assertions) { 40_000 } else { u64::MAX };
        let known = ["off", "poly", "smesh", "ply", "stl", "obj"];
        let mut files = Vec::new();
        for folder in [data.clone(), data.join("invalid")] {
            let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
            files.extend(entries.filter(|path| {
                path.extension().and_then(|e| e.to_str()).is_some_and(|e| known.contains(&e))
                    && std::fs::metadata(path).is_ok_and(|data| data.len() <= most_of_ours)
            }));
        }
        files.sort();
        assert!(files.len() > 20);
        let most = if cfg!(debug_assertions) { 20_000 } else { u64::MAX };
        let sample = std::fs::read_to_string(root.join("capi-tests/corpus-sample.txt")).unwrap();
        let models = root.join("../shared/corpus/models");
        let models = sample.lines().map(|line| models.join(line));
        files.extend(models.filter(|path| std::fs::metadata(path).is_ok_and(|data| data.len() <= most)));
        files
    }

    fn use_all(name: &str, plc: &Plc) {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("traps-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let plain = Options::default();
        let refined = Options { steiner_limit: Some(500), ..plain.clone() };
        let filled = Options { mode: Mode::Preserve, ..refined.clone() };
        let runs = [
            Options { mode: Mode::Delaunay, ..plain.clone() },
            plain.clone(),
            Options { keep_hull: true, exact_form: true, ..plain.clone() },
            Options { merge_facets: Some(175.0), ..plain.clone() },
            Options { mode: Mode::Preserve, ..plain },
            Options { quality: Some(2.0), optimize: 1, ..filled.clone() },
            Options { size: Some(f64::MAX), max_volume: Some(f64::MAX), ..filled.clone() },
            Options { size: Some(1e-200), ..filled.clone() },
            Options { max_volume: Some(f64::MIN_POSITIVE), ..filled },
            Options { quality: Some(1.5), optimize: 1, ..refined.clone() },
            Options { size: Some(f64::MAX), max_volume: Some(f64::MAX), ..refined.clone() },
            Options { size: Some(1e-200), ..refined.clone() },
            Options { max_volume: Some(f64::MIN_POSITIVE), ..refined },
        ];
        for options in runs {
            let sized = options.size.or(options.quality).or(options.max_volume).is_some();
            // More of the same points would only take time.
            if sized && plc.points.len() > 1000 {
                continue;
            }
            let mode = options.mode;
            match tetrahedralize(plc, &options, &mut Silent) {
                Ok(mesh) => {
                    let _ = check_mesh(plc, &mesh, false, 10);
                    if mode == Mode::Delaunay {
                        delotet::query::Voronoi::new(&mesh).unwrap();
                    }
                    for extension in ["vtu", "vtk", "msh", "mesh", "ele"] {
                        let path = folder.join("mesh").with_extension(extension);
                        let with_quality = WriteOptions { quality_data: true, ..WriteOptions::default() };
                        write(&path, &mesh, plc, &with_quality).unwrap();
                    }
                    if !sized && mesh.tets.len() < 20_000 {
                        given(name, &folder, &mesh);
                    }
                    let forced = delotet::query::quality::forced_tets(&mesh).unwrap();
                    delotet::query::QualitySummary::new(&mesh, &forced);
                    delotet::query::quality::skinny_tets(&mesh, None, &forced).unwrap();
                    let locator = delotet::query::Locator::new(&mesh).unwrap();
                    let (mut tets, mut weights) = ([0; 2], [[0.0; 4]; 2]);
                    locator.locate(&mesh, &[mesh.points[0], [0.1, 0.2, 0.3]], &mut tets, Some(&mut weights));
                }
                Err(error) => assert_ne!(error.status, Status::Internal, "{name}, {mode:?}: {error}"),
            }
        }
        weighted(name, plc);
        let mut sized = plc.clone();
        for area in [f64::MIN_POSITIVE, 1e-3, f64::MAX] {
            sized.sizes.set_facet_areas(0, area).unwrap();
            let options = Options { quality: Some(2.0), steiner_limit: Some(500), ..Options::default() };
            if plc.points.len() <= 1000 {
                let status = tetrahedralize(&sized, &options, &mut Silent).err().map(|error| error.status);
                assert_ne!(status, Some(Status::Internal), "{name}, area {area}");
            }
        }
        for extension in ["off", "obj", "ply", "poly", "stl"] {
            let _ = write_surface(&folder.join("surface").with_extension(extension), plc);
        }
        std::fs::remove_dir_all(folder).unwrap();
    }

    /// Its points with weights and heights of all sizes.
    fn weighted(name: &str, plc: &Plc) {
        let sizes = plc.points.iter().flatten().filter(|x| x.is_finite()).map(|x| x.abs());
        let scale = sizes.fold(0.0, f64::max).clamp(1e-150, 1e150);
        let square = scale * scale;
        let lists = [
            [0.0, f64::MIN_POSITIVE, f64::from_bits(1), -f64::MIN_POSITIVE],
            [0.0, square, 0.3 * square, -square],
            [0.0, f64::MAX, -f64::MAX, 1.0],
            [1e-10, 1e10, -1e100, 1e-100],
        ];
        for (list, are_heights) in lists.into_iter().flat_map(|list| [(list, false), (list, true)]) {
            let values = (0..plc.points.len()).map(|i| list[i * 7 % 4]).collect();
            let lift = if are_heights { Lift::Heights(values) } else { Lift::Weights(values) };
            let plc = Plc { points: plc.points.clone(), lift, ..Plc::default() };
            let options = Options { mode: Mode::Delaunay, ..Options::default() };
            match tetrahedralize(&plc, &options, &mut Silent) {
                Ok(mesh) => {
                    if plc.points.len() <= 1000 {
                        check_mesh(&plc, &mesh, true, 10).unwrap_or_else(|error| panic!("{name}: {error}"));
                    }
                    delotet::query::Voronoi::new(&mesh).unwrap();
                }
                Err(error) => assert_ne!(error.status, Status::Internal, "{name}, weighted: {error}"),
            }
        }
    }

    /// The same mesh from files, refined and improved.
    fn given(name: &str, folder: &Path, mesh: &TetMesh) {
        for extension in ["vtu", "msh", "mesh", "ele"] {
            let file = read_arrays(&folder.join("mesh").with_extension(extension)).unwrap();
            let _ = mesh_from_arrays(file.arrays, 10);
        }
        let options = Options { quality: Some(2.0), steiner_limit: Some(500), ..Options::default() };
        let sizes = [f64::MIN_POSITIVE, 1.0, f64::MAX, f64::INFINITY];
        let sizes: Vec<f64> = (0..mesh.points.len()).map(|i| sizes[i % 4]).collect();
        let background = SizeFunction::of_mesh(mesh, &sizes).unwrap();
        let sized = Options { size_function: Some(background), ..options.clone() };
        for outcome in [
            refine(mesh, &MeshSizes::default(), &options, &mut Silent),
            refine(mesh, &MeshSizes::default(), &sized, &mut Silent),
            improve(mesh, &options, &mut Silent),
        ] {
            let status = outcome.err().map(|error| error.status);
            assert_ne!(status, Some(Status::Internal), "{name}");
        }
    }

    fn child(number: usize) {
        // SAFETY: a call of the C library, which changes how this process takes exceptions.
        assert_ne!(unsafe { feenableexcept(TRAPS) }, -1);
        let extremes = extremes();
        match number.checked_sub(extremes.len()) {
            None => use_all(extremes[number].0, &extremes[number].1),
            Some(file) => {
                let path = &files()[file];
                if let Ok(plc) = read(path) {
                    use_all(&path.display().to_string(), &plc);
                }
            }
        }
    }

    pub fn main() {
        let arguments: Vec<String> = std::env::args().skip(1).collect();
        match arguments.first().map(String::as_str) {
            Some("--child") => return child(arguments[1].parse().unwrap()),
            // The traps are on: a child that divides by zero is killed.
            Some("--divide") => {
                // SAFETY: as above.
                assert_ne!(unsafe { feenableexcept(TRAPS) }, -1);
                let zero: f64 = arguments[1].parse().unwrap();
                println!("{}", 1.0 / zero);
                return;
            }
            _ => {}
        }
        let run = |arguments: &[&str]| {
            Command::new(std::env::current_exe().unwrap()).args(arguments).output().unwrap()
        };
        use std::os::unix::process::ExitStatusExt;
        const SIGFPE: i32 = 8;
        assert_eq!(run(&["--divide", "0"]).status.signal(), Some(SIGFPE), "nothing is trapped here");
        let (extremes, files) = (extremes(), files());
        let names = extremes.iter().map(|input| input.0.to_string());
        let names: Vec<String> = names.chain(files.iter().map(|path| path.display().to_string())).collect();
        let (next, faults) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
        let work = || loop {
            let number = next.fetch_add(1, Ordering::SeqCst);
            let Some(name) = names.get(number) else { break };
            let output = run(&["--child", &number.to_string()]);
            if !output.status.success() {
                let text = String::from_utf8_lossy(&output.stderr).into_owned();
                faults.lock().unwrap().push((number, format!("{name}: {} {text}", output.status)));
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
                scope.spawn(work);
            }
        });
        let mut faults = faults.into_inner().unwrap();
        faults.sort_unstable();
        let faults: Vec<String> = faults.into_iter().map(|fault| fault.1).collect();
        let count = names.len();
        assert!(faults.is_empty(), "\n{}\n", faults.join("\n"));
        println!("{count} inputs, no trap");
    }
}
