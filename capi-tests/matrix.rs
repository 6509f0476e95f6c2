//! `check` accepts what `mesh` makes: all our models in all modes, with all options, in memory and from files.
use delotet::{
    check_guarantee, check_mesh, tetrahedralize, Guarantee, Mode, Options, Plc, Preserve, Silent, Status,
    TetMesh,
};
use std::path::{Path, PathBuf};
#[cfg(not(debug_assertions))]
use std::process::Command;

const MODES: [(Mode, Preserve, &[&str]); 4] = [
    (Mode::Constrained, Preserve::All, &["--mode", "cdt"]),
    (Mode::Preserve, Preserve::All, &["--mode", "preserve"]),
    (Mode::Preserve, Preserve::Outer, &["--mode", "preserve", "--preserve", "outer"]),
    (Mode::Delaunay, Preserve::All, &["--mode", "delaunay"]),
];

/// The valid models next to this file, by name.
fn models() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("capi-tests/data");
    let formats = ["off", "obj", "ply", "stl", "poly", "smesh"];
    let is_model = |p: &PathBuf| p.extension().is_some_and(|e| formats.iter().any(|f| e == *f));
    let entries = std::fs::read_dir(&folder).expect("the folder of models");
    let mut models: Vec<_> = entries.map(|e| e.expect("an entry").path()).filter(is_model).collect();
    models.sort();
    assert!(models.len() >= 15, "{} models", models.len());
    models
}

/// Every combination of the options that change what is in a mesh.
fn options() -> impl Iterator<Item = (Options, &'static [&'static str])> {
    MODES.into_iter().flat_map(|(mode, preserve, arguments)| {
        // The exact form makes a difference only for constrained Delaunay meshes, and only these and kept surfaces are refined.
        let kinds = match mode {
            Mode::Constrained => 10,
            Mode::Preserve => 5,
            Mode::Delaunay => 4,
        };
        (0..kinds).map(move |bits| {
            let merge_facets = (bits & 1 != 0).then_some(179.9);
            let (keep_hull, last) = (bits & 2 != 0, bits & 4 != 0);
            let exact_form = last && mode == Mode::Constrained;
            let shaped = if mode == Mode::Constrained { bits >= 8 } else { last && mode == Mode::Preserve };
            let quality = shaped.then_some(2.0);
            // It takes the longest, so not everywhere.
            let optimize = u32::from(shaped && preserve == Preserve::All && bits != 8);
            let base = Options { mode, preserve, merge_facets, keep_hull, ..Options::default() };
            (Options { exact_form, quality, optimize, ..base }, arguments)
        })
    })
}

#[test]
fn what_is_made_passes_its_check_in_memory() {
    let mut kept = 0;
    for model in models() {
        let plc = delotet::io::read(&model).unwrap();
        for (options, _) in options() {
            let what = format!("{}, {options:?}", model.display());
            let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap_or_else(|e| panic!("{what}: {e}"));
            check_guarantee(&plc, &mesh, 10).unwrap_or_else(|e| panic!("{what}: {e}"));
            check_mesh(&plc, &mesh, false, 10).unwrap_or_else(|e| panic!("{what}: {e}"));
            kept += usize::from(mesh.guarantee == Guarantee::Preserved);
        }
    }
    assert!(kept >= 4 * 15, "{kept}");
}

/// In one profile, since writing, reading and checking files takes the most time here.
#[cfg(not(debug_assertions))]
#[test]
fn what_is_made_passes_its_check_from_files() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("matrix");
    std::fs::create_dir_all(&folder).unwrap();
    let mesh = folder.join("m.ele");
    let name = |path: &Path| path.to_str().expect("a path in UTF-8").to_string();
    let delotet = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_delotet")).args(arguments).output().unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let models = models();
    for (turn, (model, mesh)) in models.iter().map(|model| (name(model), name(&mesh))).enumerate() {
        for (round, (options, mode)) in options().filter(|(options, _)| !options.exact_form).enumerate() {
            let mut arguments = vec!["mesh", &model, "-q", "-o", &mesh];
            arguments.extend(mode);
            arguments.extend(options.merge_facets.map(|_| "--merge-facets"));
            arguments.extend(options.keep_hull.then_some("--keep-hull"));
            arguments.extend(options.quality.map(|_| "--quality"));
            arguments.extend((options.optimize > 0).then_some("--optimize"));
            // What only the files have: by turns, so that each mode with each other option meets them.
            arguments.extend([None, Some("--second-order")][(turn + round) % 2]);
            arguments.extend([None, Some("--drop-points")][(turn + round) / 2 % 2]);
            delotet(&arguments);
            let said = delotet(&["check", &mesh, "--input", &model]);
            assert!(!said.contains("was not judged"), "{said}");
            assert_eq!(said.contains("the surface is kept"), mode == ["--mode", "preserve"], "{said}");
        }
    }
}

/// A twisted prism of a few units where doubles are the integers: its edges must be split, and there is no room for that.
#[test]
fn the_exact_form_passes_its_check() {
    let lattice = [[2, 0, 1], [3, 1, 1], [3, 2, 0], [3, 1, 0], [0, 0, 0], [1, 1, 1]];
    let points = lattice.map(|p: [u64; 3]| p.map(|x| ((1 << 52) + x) as f64)).to_vec();
    let triangles =
        vec![[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
    let plc = Plc { points, triangles, ..Plc::default() };
    assert_eq!(tetrahedralize(&plc, &Options::default(), &mut Silent).unwrap_err().status, Status::Rounding);
    let exact = Options { exact_form: true, ..Options::default() };
    let mesh = tetrahedralize(&plc, &exact, &mut Silent).unwrap();
    assert!(!mesh.crowded.is_empty());
    check_guarantee(&plc, &mesh, 10).unwrap();
    // It fails if it does not list these points.
    let hidden = TetMesh { crowded: Vec::new(), ..mesh };
    assert_eq!(check_guarantee(&plc, &hidden, 10).unwrap_err().status, Status::CheckFailed);
}
