//! The library as C and C++ programs see it, with the compiler that `cc` finds: layouts in C99, C11 and C++17, every program of
//! `capi-tests/c`, code that must not compile, symbol versions, and a program short of memory. They link what cargo built for this test; in one
//! profile, since compilers take most of the time.
#![cfg(all(unix, not(debug_assertions)))]
#![allow(unsafe_code)]
use delotet::ffi;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::mem::offset_of;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicUsize, Ordering};

const C_WARNINGS: &[&str] = &[
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wundef",
    "-Wconversion",
    "-Wcast-qual",
    "-Werror",
    "-Wc++-compat",
    "-Wstrict-prototypes",
    "-Wmissing-prototypes",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Where cargo put the libraries that this test depends on.
fn libraries() -> PathBuf {
    std::env::current_exe().expect("this program").parent().expect("its folder").to_path_buf()
}

/// A folder for this test alone: those of the other profile may run at the same time.
fn folder(name: &str) -> PathBuf {
    let profile = if cfg!(debug_assertions) { "debug" } else { "release" };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("callers").join(profile).join(name);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// The C or C++ compiler with a standard and our headers.
fn compiler(standard: &str) -> Command {
    let mut build = cc::Build::new();
    build.target(env!("DELOTET_TARGET")).host(env!("DELOTET_TARGET")).opt_level(0).debug(false);
    build.cargo_metadata(false).warnings(false).cpp(standard.starts_with("c++")).out_dir(folder("cc"));
    let mut command = build.get_compiler().to_command();
    command.arg(format!("-std={standard}")).arg("-I").arg(root().join("include"));
    command
}

fn run(command: &mut Command) -> Output {
    command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"))
}

/// Runs a command that must succeed; returns its output.
fn succeed(command: &mut Command) -> String {
    let output = run(command);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(output.status.success(), "{command:?}\n{}{}", text(&output.stdout), text(&output.stderr));
    text(&output.stdout)
}

/// Links with the shared library, and finds it at run time.
fn link_shared(command: &mut Command) -> &mut Command {
    let folder = folder("lib");
    let version = concat!(env!("CARGO_PKG_VERSION_MAJOR"), ".", env!("CARGO_PKG_VERSION_MINOR"));
    let library =
        libraries().join(format!("{}delotet{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX));
    let link = folder.join(if cfg!(target_os = "macos") {
        format!("libdelotet.{version}.dylib")
    } else {
        format!("libdelotet.so.{version}")
    });
    // Tests run concurrently, so the link is created by renaming.
    let new = folder.join(format!("{}-{}", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed)));
    std::os::unix::fs::symlink(&library, &new).expect("a link");
    fs::rename(&new, link).expect("a link");
    command.arg(library).arg(format!("-Wl,-rpath,{}", folder.display())).args(["-lm", "-lpthread"])
}
static NEXT: AtomicUsize = AtomicUsize::new(0);

/// A struct: name, size, and per field name, offset and size.
struct Layout {
    name: &'static str,
    size: usize,
    fields: Vec<(&'static str, usize, usize)>,
}

fn size_of_field<T, F>(_: impl Fn(&T) -> &F) -> usize {
    size_of::<F>()
}

macro_rules! layouts {
    ($($module:ident::$name:ident { $($field:ident),* })*) => {
        vec![$(Layout {
            name: stringify!($name),
            size: size_of::<ffi::$module::$name>(),
            fields: vec![$((
                stringify!($field),
                offset_of!(ffi::$module::$name, $field),
                size_of_field(|x: &ffi::$module::$name| &x.$field),
            )),*],
        }),*]
    };
}

/// All structs that C sees, as Rust has them.
fn layouts() -> Vec<Layout> {
    layouts! {
        error::DelotetDefect { kind, first_element, first, second_element, second, has_point, point }
        error::DelotetDefectsView { first, count, stride }
        warning::DelotetWarning { kind, first_element, first, second_element, second, has_point, point }
        warning::DelotetWarningsView { first, count, stride }
        view::DelotetPointsView { data, count }
        view::DelotetDoublesView { data, count, width }
        view::DelotetMarkersView { data, count }
        view::DelotetIndicesView { data, count }
        view::DelotetIndexRowsView { data, count, width }
        view::DelotetTetsView { data, count }
        view::DelotetSegment { ends, marker }
        view::DelotetSegmentsView { first, count, stride }
        view::DelotetRegionSeed { point, attribute, max_volume }
        view::DelotetRegionSeedsView { first, count, stride }
        view::DelotetRegion { attribute, max_volume, seed }
        view::DelotetRegionsView { first, count, stride }
        view::DelotetSubface { corners, facet, marker, tets }
        view::DelotetSubfacesView { first, count, stride }
        view::DelotetSubsegment { ends, segment, marker }
        view::DelotetSubsegmentsView { first, count, stride }
        view::DelotetSteinerPoint { ends, t, segment, exact, third, facet, u }
        view::DelotetSteinerView { first, count, stride }
        view::DelotetSteinerTerm { steiner, value }
        view::DelotetSteinerTermsView { first, count, stride }
        view::DelotetFacetFlip { old_ends, new_ends, facets }
        view::DelotetFacetFlipsView { first, count, stride }
        view::DelotetFace { corners, tets, subface, marker }
        view::DelotetFacesView { first, count, stride }
        view::DelotetEdge { ends, tet, subsegment, marker }
        view::DelotetEdgesView { first, count, stride }
        view::DelotetSecondOrderView { nodes, node_count, tets, tet_count }
        quality::DelotetTetQuality { dihedrals, radius_edge, eta, volume }
        quality::DelotetTetQualitiesView { first, count, stride }
        quality::DelotetForcedTet { tet, facets, ends, angle }
        quality::DelotetForcedTetsView { first, count, stride }
        skinny::DelotetSkinnyTet { tet, cause, facets, radius_edge }
        skinny::DelotetSkinnyTetsView { first, count, stride }
        voronoi::DelotetVoronoiEdge { vertices, direction }
        voronoi::DelotetVoronoiEdgesView { first, count, stride }
        voronoi::DelotetVoronoiFacet { cells, first, count, bounded }
        voronoi::DelotetVoronoiFacetsView { first, count, stride }
        voronoi::DelotetVoronoiCell { first, count, bounded }
        voronoi::DelotetVoronoiCellsView { first, count, stride }
        quality::DelotetQualitySummary {
            struct_size, tet_count, forced_count, worst, worst_tets, histograms, unforced_worst, unforced_worst_tets,
            unforced_histograms
        }
        mesh::DelotetStats {
            struct_size, steiner, steiner_exact, steiner_moved, duplicate_points, missing_segments, missing_regions, peak_bytes,
            seconds, preserve_missing_edges, preserve_missing_faces, preserve_by_reconnection, preserve_by_interior_points,
            preserve_by_splits, preserve_deleted, preserve_relocated, preserve_interior, preserve_on_internal_facets, replaced,
            peak_resident_bytes, refine_on_segments, refine_on_facets, refine_inside, refine_for_sizes, refine_for_shapes, refine_too_near, refine_too_flat, refine_encroaching, refine_blocked, refine_elsewhere, refine_over_budget, optimize_passes, optimize_moves, optimize_edges_removed, optimize_faces_removed, optimize_reconnected, optimize_points_added, optimize_points_removed, optimize_worst_before, optimize_worst_after
        }
    }
}

/// The structs of the header and the names of their fields.
fn structs_of_header() -> BTreeMap<String, Vec<String>> {
    let header = fs::read_to_string(root().join("include/delotet/delotet.h")).expect("the header");
    let mut structs = BTreeMap::new();
    for part in header.split("typedef struct ").skip(1) {
        let Some((name, rest)) = part.split_once(" {\n") else { continue };
        if name.contains(';') {
            continue; // An opaque handle.
        }
        let body = rest.split_once("\n}").expect("its end").0;
        let mut in_comment = false;
        let mut fields = Vec::new();
        for line in body.lines().map(str::trim) {
            in_comment |= line.starts_with("/*");
            if !in_comment {
                let declared = line.trim_end_matches(';').split('[').next().expect("a field");
                fields.push(declared.rsplit([' ', '*']).next().expect("a name").to_string());
            }
            in_comment &= !line.ends_with("*/");
        }
        structs.insert(name.to_string(), fields);
    }
    structs
}

#[test]
fn c_and_cpp_see_the_layouts_of_rust() {
    let layouts = layouts();
    let listed: BTreeMap<String, Vec<String>> = layouts
        .iter()
        .map(|layout| (layout.name.into(), layout.fields.iter().map(|field| field.0.into()).collect()))
        .collect();
    assert_eq!(listed, structs_of_header(), "the header has other structs than this test knows");

    let (mut expected, mut probe) = (String::new(), String::new());
    let mut ask = |text: String, value: usize| {
        probe += &format!("    printf(\"%s %lu\\n\", \"{text}\", (unsigned long)({text}));\n");
        expected += &format!("{text} {value}\n");
    };
    for Layout { name, size, fields } in &layouts {
        ask(format!("sizeof({name})"), *size);
        for (field, offset, size) in fields {
            ask(format!("offsetof({name}, {field})"), *offset);
            ask(format!("sizeof((({name} *)0)->{field})"), *size);
        }
    }
    use ffi::{options, plc_view, quality, query, sizes, status};
    ask("sizeof(DelotetStatus)".into(), size_of::<status::DelotetStatus>());
    ask("sizeof(DelotetPhase)".into(), size_of::<status::DelotetPhase>());
    ask("sizeof(DelotetElement)".into(), size_of::<status::DelotetElement>());
    ask("sizeof(DelotetDefectKind)".into(), size_of::<status::DelotetDefectKind>());
    ask("sizeof(DelotetWarningKind)".into(), size_of::<status::DelotetWarningKind>());
    ask("sizeof(DelotetMode)".into(), size_of::<options::DelotetMode>());
    ask("sizeof(DelotetPreserve)".into(), size_of::<options::DelotetPreserve>());
    ask("sizeof(DelotetNodeOrder)".into(), size_of::<query::DelotetNodeOrder>());
    ask("sizeof(DelotetQualityMeasure)".into(), size_of::<quality::DelotetQualityMeasure>());
    ask("sizeof(DelotetFacetRule)".into(), size_of::<plc_view::DelotetFacetRule>());
    ask("sizeof(DelotetProgressFn)".into(), size_of::<options::DelotetProgressFn>());
    ask("sizeof(DelotetSizeFunction)".into(), size_of::<sizes::DelotetSizeFunction>());
    ask("DELOTET_INVALID_INDEX".into(), delotet::INVALID as usize);
    let folder = folder("layout");
    let source = format!(
        "#include <delotet/delotet.h>\n#include <stdio.h>\nint main(void)\n{{\n{probe}    return 0;\n}}\n"
    );
    for (standard, extension) in [("c99", "c"), ("c11", "c"), ("c++17", "cpp")] {
        let file = folder.join(format!("{standard}.{extension}"));
        let program = folder.join(standard);
        fs::write(&file, &source).expect("the probe");
        succeed(compiler(standard).arg(&file).arg("-o").arg(&program));
        assert_eq!(succeed(&mut Command::new(&program)), expected, "{standard}");
    }
}

/// Every file of `capi-tests/c` with the tests of one function: compiled as C99 with all warnings, and run in a folder of its own.
#[test]
fn every_c_program_runs() {
    let mut sources: Vec<PathBuf> = fs::read_dir(root().join("capi-tests/c"))
        .expect("the programs")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| {
            path.extension() == Some(OsStr::new("c")) && path.file_name() != Some(OsStr::new("header.c"))
        })
        .collect();
    sources.sort();
    assert!(sources.len() > 80, "only {} programs", sources.len());
    let next = AtomicUsize::new(0);
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                while let Some(source) = sources.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let folder = folder(source.file_stem().and_then(OsStr::to_str).expect("a name"));
                    let program = folder.join("program");
                    let mut compile = compiler("c99");
                    compile.args(C_WARNINGS).arg(source).arg("-o").arg(&program);
                    succeed(link_shared(&mut compile));
                    succeed(Command::new(&program).current_dir(&folder));
                }
            });
        }
    });
}

/// The header alone in every standard, the wrapper's traits, and the recorded layouts and numbers.
#[test]
fn headers_compile_in_every_standard() {
    let object = folder("headers").join("object.o");
    for standard in ["c99", "c11", "c17"] {
        let file = root().join("capi-tests/c/header.c");
        succeed(compiler(standard).args(C_WARNINGS).arg("-c").arg(file).arg("-o").arg(&object));
    }
    succeed(compiler("c11").arg("-c").arg(root().join("capi-tests/abi/layout.c")).arg("-o").arg(&object));
    for standard in ["c++17", "c++20"] {
        let mut compile = compiler(standard);
        compile.args([
            "-Wall",
            "-Wextra",
            "-Wpedantic",
            "-Wshadow",
            "-Wold-style-cast",
            "-Werror",
            "-fsyntax-only",
        ]);
        succeed(compile.arg(root().join("capi-tests/cpp/header.cpp")));
    }
}

/// Small callers in C++: the wrapper with the shared library, and a C program with the static one.
#[test]
fn cpp_and_static_callers_run() {
    let folder = folder("wrapper");
    for name in ["test_wrapper", "test_inputs", "test_exceptions", "test_sizes"] {
        let program = folder.join(name);
        let mut compile = compiler("c++17");
        compile.arg(root().join(format!("capi-tests/cpp/{name}.cpp"))).arg("-o").arg(&program);
        succeed(link_shared(&mut compile));
        succeed(Command::new(&program).current_dir(&folder));
    }
    let program = folder.join("static");
    let mut compile = compiler("c11");
    compile.arg(root().join("capi-tests/c/test_tetrahedralize.c")).arg("-o").arg(&program);
    compile.arg(libraries().join("libdelotet.a"));
    compile.args(if cfg!(target_os = "linux") { &["-lpthread", "-ldl", "-lm"][..] } else { &["-lm"][..] });
    succeed(&mut compile);
    succeed(Command::new(&program).current_dir(&folder));
}

/// The error of a C++ program that must not compile.
fn refused(standard: &str, name: &str, body: &str) -> String {
    let file = folder("refused").join(name);
    fs::write(&file, body).expect("a program");
    let output = run(compiler(standard).args(["-fsyntax-only", "-fno-diagnostics-color"]).arg(&file));
    assert!(!output.status.success(), "compiled: {body}");
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn views_of_temporaries_do_not_compile() {
    let program = |body: &str| {
        format!(
            "#include <delotet/delotet.hpp>\n#include <vector>\ndelotet::Mesh mesh();\ndelotet::Plc plc();\nvoid f()\n{{\n    {body}\n}}\n"
        )
    };
    let dangling = [
        "for (const auto &tet : mesh().tets()) (void)tet;",
        "auto faces = mesh().subfaces(); (void)faces;",
        "auto points = plc().add_segment(0, 1).points(); (void)points;",
        "auto corners = plc().facet_ring(3); (void)corners;",
        "auto edges = mesh().edges(); (void)edges;",
    ];
    for (i, body) in dangling.iter().enumerate() {
        let error = refused("c++17", &format!("dangling{i}.cpp"), &program(body));
        assert!(error.contains("deleted"), "{body}: {error}");
        // With a name the same compiles.
        let named = body
            .replace("mesh()", "m")
            .replace("plc().add_segment(0, 1)", "p.add_segment(0, 1)")
            .replace("plc()", "p");
        let file = folder("refused").join(format!("named{i}.cpp"));
        let body = format!(
            "const delotet::Mesh m = mesh();\n    delotet::Plc p = plc();\n    {named}\n    (void)m;"
        );
        fs::write(&file, program(&body)).expect("a program");
        succeed(compiler("c++17").arg("-fsyntax-only").arg(&file));
    }
    // Corners in rows of another width, and numbers that are no integers.
    for (i, corners) in ["std::array<int, 4>", "double", "bool"].iter().enumerate() {
        let body = program(&format!("delotet::Plc p; p.add_triangles(std::vector<{corners}>(12));"));
        refused("c++17", &format!("corners{i}.cpp"), &body);
    }
}

#[test]
fn a_record_of_the_wrong_type_does_not_compile() {
    let program = |name: &str| {
        format!(
            "#include <delotet/delotet.h>\nint32_t f(DelotetSubfacesView view);\nint32_t f(DelotetSubfacesView view)\n{{\n    return DELOTET_AT({name}, view, 1)->marker;\n}}\n"
        )
    };
    refused("c99", "record.c", &program("DelotetFace"));
    let file = folder("refused").join("record_named.c");
    fs::write(&file, program("DelotetSubface")).expect("a program");
    succeed(compiler("c99").args(C_WARNINGS).arg("-fsyntax-only").arg(&file));
}

/// Examples and consumers, except those with other dependencies.
#[test]
fn examples_compile() {
    let mut count = 0;
    for folder in ["examples-c", "capi-tests/consumer"] {
        for entry in fs::read_dir(root().join(folder)).expect("the examples") {
            let path = entry.expect("an entry").path();
            let standard = match path.extension().and_then(OsStr::to_str) {
                Some("c") => "c99",
                Some("cpp") => "c++17",
                _ => continue,
            };
            // These need Eigen, by a header that they share.
            if fs::read_to_string(&path).expect("an example").contains("\"elements.hpp\"") {
                continue;
            }
            succeed(compiler(standard).args(["-Wall", "-Wextra", "-Werror", "-fsyntax-only"]).arg(&path));
            count += 1;
        }
    }
    assert!(count >= 6, "only {count}");
}

/// Checks the whole wrapper: no member of an owning class returns a view without `&`.
#[test]
fn every_view_of_the_wrapper_needs_a_name() {
    let text = fs::read_to_string(root().join("include/delotet/delotet.hpp")).expect("the wrapper");
    let (mut class, mut views, mut deleted) = (String::new(), 0, 0);
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("class ") {
            class = name.split([' ', ':']).next().unwrap_or_default().to_string();
        }
        let owner =
            ["Error", "Exception", "Options", "WriteOptions", "Plc", "Mesh"].contains(&class.as_str());
        let member = line.starts_with("    ") && !line.starts_with("     ") && line.contains(") const");
        let view = ["    Span<", "    Records<", "    DelotetDoublesView ", "    SecondOrder "]
            .iter()
            .any(|start| line.starts_with(start));
        if owner && member && view {
            views += 1;
            assert!(line.contains(") const &"), "{class}: {line}");
        }
        deleted += usize::from(line.ends_with("const && = delete;"));
        if line.starts_with("};") {
            class.clear();
        }
    }
    assert!(views > 30 && deleted >= views, "{views} views, {deleted} deleted");
}

/// C++ has every C function, except those for names of constants, which C++ programs call directly, and for callbacks, which the wrapper
/// keeps.
#[test]
fn the_wrapper_has_every_function() {
    let wrapper = fs::read_to_string(root().join("include/delotet/delotet.hpp")).expect("the wrapper");
    let listed = fs::read_to_string(root().join("capi-tests/abi/symbols.txt")).expect("the list");
    let own = [
        "delotet_options_log",
        "delotet_options_progress",
        "delotet_options_size_function",
        "delotet_version_string",
        "delotet_write_options_log",
    ];
    for name in listed.lines().filter(|name| !name.ends_with("_name") || name.contains("marker")) {
        let used = wrapper.match_indices(name).any(|(at, _)| {
            !wrapper[at + name.len()..].starts_with(|c: char| c == '_' || c.is_alphanumeric())
        });
        assert!(used || own.contains(&name), "{name} has no method in delotet.hpp");
    }
}

#[test]
fn before_cpp17_there_is_one_error() {
    let error = refused("c++14", "before.cpp", "#include <delotet/delotet.hpp>\nint main() {}\n");
    assert_eq!(error.matches("error: ").count(), 1, "{error}");
    assert!(error.contains("needs C++17"), "{error}");
}

/// Every exported function carries the version of this ABI, so that the loader refuses another one.
#[test]
#[cfg(target_os = "linux")]
fn exported_functions_have_versions() {
    let library = libraries().join("libdelotet.so");
    let text = succeed(Command::new("readelf").args(["--dyn-syms", "-W"]).arg(library));
    let node =
        concat!("@@libdelotet.so.", env!("CARGO_PKG_VERSION_MAJOR"), ".", env!("CARGO_PKG_VERSION_MINOR"));
    let mut seen = Vec::new();
    for name in
        text.lines().filter(|line| !line.contains(" UND ")).filter_map(|line| line.split_whitespace().last())
    {
        if name.starts_with("delotet_") {
            seen.push(name.strip_suffix(node).unwrap_or_else(|| panic!("{name} has another version")));
        }
    }
    seen.sort_unstable();
    let listed = fs::read_to_string(root().join("capi-tests/abi/symbols.txt")).expect("the list");
    assert_eq!(seen, listed.lines().collect::<Vec<_>>());
}

/// The bytes are the same for any number; threads are started nevertheless.
#[test]
#[cfg(target_os = "linux")]
fn threads_are_started_where_they_are_asked_for() {
    let folder = folder("threads");
    let (file, program) = (folder.join("threads.c"), folder.join("threads"));
    fs::write(&file, THREADS).expect("a program");
    let mut compile = compiler("c99");
    compile.arg(&file).arg("-o").arg(&program);
    succeed(link_shared(compile.arg("-ldl")));
    let count = |threads: &str, points: &str| -> u32 {
        succeed(Command::new(&program).args([threads, points])).trim().parse().expect("a number")
    };
    assert_eq!(count("1", "72000"), 0);
    assert!(count("2", "72000") > 0);
    // Too few points for a second thread to gain anything.
    assert_eq!(count("2", "1000"), 0);
}

/// Makes Delaunay tetrahedra of a number of points with a number of threads; prints how many threads the library started.
const THREADS: &str = r#"
#define _GNU_SOURCE
#include <delotet/delotet.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double xyz[216000];
static int started;

/* Stands before that of the system. */
int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*work)(void *), void *data)
{
    int (*real)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    void *found = dlsym(RTLD_NEXT, "pthread_create");
    memcpy(&real, &found, sizeof real);
    started++;
    return real(thread, attributes, work, data);
}

int main(int count, char **words)
{
    DelotetPlc *plc = NULL;
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh = NULL;
    uint64_t state = 1;
    size_t i;
    if (count != 3)
        return 2;
    for (i = 0; i < 216000; i++) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        xyz[i] = (double)(state >> 11);
    }
    if (delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, NULL) ||
        delotet_options_set_threads(options, strtoul(words[1], NULL, 10), NULL) ||
        delotet_plc_new(xyz, strtoul(words[2], NULL, 10), &plc, NULL) || delotet_tetrahedralize(plc, options, &mesh, NULL))
        return 1;
    printf("%d\n", started);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return 0;
}
"#;

/// A process with limited address space gets the status, not an abort, and the statistics say how much it took.
#[test]
#[cfg(target_os = "linux")]
fn a_limit_of_memory_becomes_a_status() {
    let folder = folder("limit");
    let (file, program) = (folder.join("limit.c"), folder.join("limit"));
    fs::write(&file, LIMITED).expect("a program");
    let mut compile = compiler("c99");
    compile.arg(&file).arg("-o").arg(&program);
    succeed(link_shared(&mut compile));
    let limited = |bytes: libc::rlim_t| {
        let mut command = Command::new(&program);
        // SAFETY: setrlimit is safe to call between fork and exec.
        unsafe {
            command.pre_exec(move || {
                let limit = libc::rlimit { rlim_cur: bytes, rlim_max: bytes };
                match libc::setrlimit(libc::RLIMIT_AS, &limit) {
                    0 => Ok(()),
                    _ => Err(std::io::Error::last_os_error()),
                }
            });
        }
        run(&mut command)
    };
    let plenty = limited(libc::RLIM_INFINITY);
    assert!(plenty.status.success(), "{plenty:?}");
    let peak: libc::rlim_t = String::from_utf8_lossy(&plenty.stdout).trim().parse().expect("the peak");
    assert!(peak > 20 << 20, "{peak}");
    let mut short = 0;
    // From hardly more than the program itself to the amount it took.
    for part in 1..=4 {
        let output = limited((16 << 20) + peak * part / 4);
        assert_eq!(output.status.signal(), None, "{output:?}");
        let status = output.status.code();
        let out_of_memory = ffi::status::DelotetStatus::OutOfMemory as i32;
        assert!(status == Some(0) || status == Some(out_of_memory), "{output:?}");
        short += usize::from(status == Some(out_of_memory));
    }
    assert!(short > 0, "no limit was too small");
}

/// Delaunay tetrahedra of 60,000 points; prints the largest resident memory, returns the status.
const LIMITED: &str = r#"
#include <delotet/delotet.h>
#include <stdio.h>

static double xyz[180000];

int main(void)
{
    DelotetPlc *plc = NULL;
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh = NULL;
    DelotetStats stats;
    DelotetStatus status = options ? DELOTET_STATUS_OK : DELOTET_STATUS_OUT_OF_MEMORY;
    uint64_t state = 1;
    size_t i;
    for (i = 0; i < 180000; i++) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        xyz[i] = (double)(state >> 11);
    }
    stats.struct_size = sizeof stats;
    if (!status)
        status = delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, NULL);
    if (!status)
        status = delotet_plc_new(xyz, 60000, &plc, NULL);
    if (!status)
        status = delotet_tetrahedralize(plc, options, &mesh, NULL);
    if (!status)
        status = delotet_mesh_stats(mesh, &stats, NULL);
    if (!status)
        printf("%llu\n", (unsigned long long)stats.peak_resident_bytes);
    delotet_mesh_free(mesh);
    delotet_plc_free(plc);
    delotet_options_free(options);
    return (int)status;
}
"#;
