//! The command line program with the engine: meshes, their files, and errors.
mod program;
use program::{delotet, error_line, text, two_rooms};
use std::path::{Path, PathBuf};
use std::process::Command;

fn folder(name: &str) -> PathBuf {
    program::folder(&format!("cli-mesh-{name}"))
}

const CUBE: &str = "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n\
                    4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

#[test]
fn a_cube_in_every_mesh_format() {
    let dir = folder("formats");
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    for output in ["c.ele", "c.vtu", "c.vtk", "c.msh", "c.inp", "c.mesh"] {
        let result =
            delotet(&["mesh", "cube.off", "-o", output, "--stats", "s.json", "--report", "r.json"], &dir);
        assert_eq!(result.status.code(), Some(0), "{output}: {}", error_line(&result));
        assert!(String::from_utf8_lossy(&result.stdout).contains("volume 1.000000"));
        let stats = text(dir.join("s.json"));
        for key in [
            "version",
            "points_in",
            "points",
            "tets",
            "steiner",
            "steiner_exact",
            "regions",
            "status",
            "peak_bytes",
            "peak_resident_bytes",
            "total",
            "audit",
        ] {
            assert!(stats.contains(&format!("\"{key}\":")), "{key} in {stats}");
        }
        assert!(stats.contains("\"points_in\": 8") && stats.contains("\"regions\": 1"), "{stats}");
        assert!(text(dir.join("r.json")).contains("\"status\": \"Ok\""));
    }
    assert_eq!(text(dir.join("c.node")).lines().next(), Some("8  3  0  0"));
    let quiet = delotet(&["mesh", "cube.off", "-o", "c.vtu", "--subfaces", "--compress", "--quiet"], &dir);
    assert!(quiet.status.success() && quiet.stdout.is_empty() && quiet.stderr.is_empty());
    assert!(dir.join("c_subfaces.vtu").exists());
}

/// A prism with an edge of 10 degrees between its facets 1 and 3: the summary, the statistics and the report say so.
#[test]
fn quality_is_told_in_lines_and_in_json() {
    let dir = folder("quality");
    let (sine, cosine) = 10f64.to_radians().sin_cos();
    let prism = format!(
        "OFF\n6 5 0\n0 0 0\n1 0 0\n{cosine} {sine} 0\n0 0 1\n1 0 1\n{cosine} {sine} 1\n\
         3 0 2 1\n4 0 1 4 3\n3 3 4 5\n4 2 0 3 5\n4 1 2 5 4\n"
    );
    std::fs::write(dir.join("prism.off"), prism).unwrap();
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    let run = |name: &str| {
        let output = delotet(&["mesh", name, "-o", "m.vtu", "--stats", "s.json", "--report", "r.json"], &dir);
        assert!(output.status.success(), "{}", error_line(&output));
        let json = |file: &str| serde_json::from_str::<serde_json::Value>(&text(dir.join(file))).unwrap();
        (String::from_utf8_lossy(&output.stdout).into_owned(), json("s.json"), json("r.json"))
    };
    let (said, stats, report) = run("prism.off");
    assert!(said.contains("\ninput-forced   "), "{said}");
    assert!(
        said.contains("in wedges below 30° between facets; the narrowest, 10.000°, between 1 and 3\n"),
        "{said}"
    );
    let quality = &stats["quality"];
    let tets = quality["tets"].as_u64().unwrap();
    for measure in ["min_dihedral", "max_dihedral", "radius_edge", "eta"] {
        let of = |which: &str| &quality[measure][which];
        let sum = |which: &str| -> u64 {
            of(which)["histogram"].as_array().unwrap().iter().map(|count| count.as_u64().unwrap()).sum()
        };
        assert_eq!((sum("all"), sum("unforced")), (tets, tets - quality["forced"].as_u64().unwrap()));
        assert_eq!(of("all")["worst"].as_array().unwrap().len() as u64, tets.min(10));
        assert_eq!(of("bins").as_array().unwrap().len(), 10);
    }
    let forced = report["forced_by"].as_array().unwrap();
    assert_eq!((forced.len(), &forced[0]["between"]), (1, &serde_json::json!([1, 3])));
    assert_eq!(forced[0]["tets"], quality["forced"]);
    assert!((forced[0]["angle"].as_f64().unwrap() - 10.0).abs() < 1e-9);

    let (said, stats, report) = run("cube.off");
    assert!(!said.contains("input-forced") && said.contains("\nradius-edge    up to 0.866\n"), "{said}");
    assert_eq!((&stats["quality"]["forced"], &report["forced_by"]), (&0.into(), &serde_json::json!([])));
    assert!(stats["quality"]["skinny"].is_null() && report["above_ratio"].is_null(), "{stats}");
}

/// A prism with an edge of 10 degrees: with a ratio, what is above it is counted and listed with the facets that force it.
#[test]
fn tetrahedra_above_the_ratio_are_told() {
    let dir = folder("skinny");
    let (sine, cosine) = 10f64.to_radians().sin_cos();
    let prism = format!(
        "OFF\n6 5 0\n0 0 0\n1 0 0\n{cosine} {sine} 0\n0 0 1\n1 0 1\n{cosine} {sine} 1\n\
         3 0 2 1\n4 0 1 4 3\n3 3 4 5\n4 2 0 3 5\n4 1 2 5 4\n"
    );
    std::fs::write(dir.join("prism.off"), prism).unwrap();
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    let run = |arguments: &[&str]| {
        let output = delotet(&[arguments, &["--stats", "s.json", "--report", "r.json"]].concat(), &dir);
        assert!(output.status.success(), "{}", error_line(&output));
        let json = |file: &str| serde_json::from_str::<serde_json::Value>(&text(dir.join(file))).unwrap();
        (String::from_utf8_lossy(&output.stdout).into_owned(), json("s.json"), json("r.json"))
    };
    let (said, stats, report) = run(&["mesh", "prism.off", "-o", "p.ele", "--quality=1.5"]);
    let (counts, list) = (&stats["quality"]["skinny"], report["above_ratio"].as_array().unwrap());
    assert_eq!((&counts["ratio"], counts["tets"].as_u64()), (&1.5.into(), Some(list.len() as u64)));
    let count = |cause: &str| list.iter().filter(|tet| tet["cause"] == cause).count();
    let forced = count("wedge") + count("corner");
    assert!(forced > 0 && count("face") == 0);
    for cause in ["wedge", "corner", "face", "beside", "other"] {
        assert_eq!(counts[cause].as_u64(), Some(count(cause) as u64), "{cause}: {counts}");
    }
    let (beside, other) = (count("beside"), count("other"));
    let all = list.len();
    assert!(
        said.contains(&format!(
            "{all} above 1.5: {forced} input-forced, {beside} beside these, {other} others\n"
        )),
        "{said}"
    );
    for tet in list {
        assert!(tet["radius_edge"].as_f64().unwrap() > 1.5 && tet["tet"].is_u64(), "{tet}");
        assert_eq!(tet["facets"].is_null(), tet["cause"] == "other", "{tet}");
        if tet["cause"] == "wedge" {
            assert_eq!(tet["facets"], serde_json::json!([1, 3]));
        }
    }
    let (said, ..) = run(&["refine", "p.ele", "-o", "r.vtu", "--quality=1.8"]);
    assert!(said.contains(" above 1.8"), "{said}");
    let (said, ..) = run(&["mesh", "cube.off", "-o", "c.ele", "--quality=1.5"]);
    assert!(said.contains("none above 1.5\n"), "{said}");
}

#[test]
fn check_accepts_the_mesh_and_refuses_a_damaged_one() {
    let dir = folder("check");
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    assert!(delotet(&["mesh", "cube.off", "-o", "c.ele"], &dir).status.success());
    for name in ["c.ele", "c"] {
        let output = delotet(&["check", name, "--input", "cube.off"], &dir);
        assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
    }
    let ele = text(dir.join("c.ele"));
    let first: Vec<&str> = ele.lines().nth(1).unwrap().split(' ').collect();
    let inverted = format!("0 {} {} {} {}", first[2], first[1], first[3], first[4]);
    std::fs::write(dir.join("c.ele"), ele.replacen(ele.lines().nth(1).unwrap(), &inverted, 1)).unwrap();
    let output = delotet(&["check", "c", "--input", "cube.off", "--report", "r.json"], &dir);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(dir.join("r.json")).contains("tetrahedron not positive"));
}

/// Conformity of a mesh with Steiner points is judged from its files: `.parents` says where they lie.
#[test]
fn check_judges_conformity_by_the_parents_file() {
    let dir = folder("parents");
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("capi-tests/data/schoenhardt.off");
    std::fs::copy(model, dir.join("s.off")).unwrap();
    assert!(delotet(&["mesh", "s.off", "-o", "s.ele"], &dir).status.success());
    let check = || {
        let output = delotet(&["check", "s.ele", "--input", "s.off"], &dir);
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let (code, said) = check();
    assert!(code == Some(0) && said.contains("correct") && !said.contains("not judged"), "{said}");
    let parents = text(dir.join("s.parents"));
    // Another parameter of the first Steiner point: beyond the other one on its segment.
    let line = parents.lines().nth(1).unwrap();
    let other = format!("{} 0.9375", line.rsplit_once(' ').unwrap().0);
    std::fs::write(dir.join("s.parents"), parents.replacen(line, &other, 1)).unwrap();
    assert_eq!(check().0, Some(1));
    // A number of faces other than the mesh's.
    std::fs::write(dir.join("s.parents"), "0 1 0 0\n0\n").unwrap();
    assert_eq!(check().0, Some(1));
    std::fs::remove_file(dir.join("s.parents")).unwrap();
    let (code, said) = check();
    assert!(code == Some(0) && said.contains("conformity was not judged"), "{said}");
}

#[test]
fn regions_carry_their_attributes() {
    let dir = folder("regions");
    std::fs::write(dir.join("two.poly"), two_rooms()).unwrap();
    assert!(delotet(&["mesh", "two.poly", "-o", "t.ele"], &dir).status.success());
    let attributes: std::collections::BTreeSet<String> = text(dir.join("t.ele"))
        .lines()
        .skip(1)
        .filter_map(|l| l.split(' ').nth(5))
        .map(str::to_string)
        .collect();
    assert_eq!(attributes.into_iter().collect::<Vec<_>>(), ["10", "20"]);
    let markers: std::collections::BTreeSet<String> = text(dir.join("t.face"))
        .lines()
        .skip(1)
        .filter_map(|l| l.split(' ').nth(4))
        .map(str::to_string)
        .collect();
    assert_eq!(markers.into_iter().collect::<Vec<_>>(), ["1", "2", "3", "4", "5", "6", "7"]);
    let output = delotet(&["check", "t.ele", "--input", "two.poly"], &dir);
    assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
}

#[test]
fn holes_are_carved_and_regions_set_by_arguments() {
    let dir = folder("holes");
    let (points, faces) =
        CUBE["OFF\n8 6 0\n".len()..].split_at(CUBE.find("4 0 3").unwrap() - "OFF\n8 6 0\n".len());
    let inner = points.replace('1', "0.75").replace("0 ", "0.25 ").replace(" 0\n", " 0.25\n");
    let inner_faces: String = faces
        .lines()
        .map(|line| {
            let corners: Vec<u32> = line.split(' ').skip(1).map(|c| c.parse::<u32>().unwrap() + 8).collect();
            format!("4 {} {} {} {}\n", corners[0], corners[1], corners[2], corners[3])
        })
        .collect();
    std::fs::write(dir.join("box.off"), format!("OFF\n16 12 0\n{points}{inner}{faces}{inner_faces}"))
        .unwrap();
    let arguments = [
        "mesh",
        "box.off",
        "-o",
        "b.ele",
        "--hole",
        "0.5,0.5,0.5",
        "--region",
        "0.1,0.1,0.1,-7",
        "--stats",
        "s.json",
    ];
    let output = delotet(&arguments, &dir);
    assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
    assert!(text(dir.join("b.ele")).lines().skip(1).all(|l| l.ends_with(" -7")));
    assert!(text(dir.join("s.json")).contains("\"regions\": 1"));
    assert!(String::from_utf8_lossy(&output.stdout).contains("volume 0.875000"));
}

#[test]
fn an_open_surface_is_refused_unless_the_hull_is_kept() {
    let dir = folder("open");
    let open = CUBE.replace("8 6 0", "8 5 0").replace("4 3 0 4 7\n", "");
    std::fs::write(dir.join("open.off"), open).unwrap();
    let output = delotet(&["mesh", "open.off", "-o", "o.ele", "--report", "r.json"], &dir);
    assert_eq!(output.status.code(), Some(1), "{}", error_line(&output));
    assert!(text(dir.join("r.json")).contains("\"status\": \"NothingEnclosed\""));
    // The edges around the missing side, with their locations, in the message, the list below it and the report.
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("encloses nothing: 4 open edges, such as that of facet"), "{said}");
    for (a, b, at) in [(0, 3, "0, 0.5, 0"), (0, 4, "0, 0, 0.5"), (3, 7, "0, 1, 0.5"), (4, 7, "0, 0.5, 1")] {
        assert!(said.contains(&format!("  open edge: point {a} and point {b} at ({at})\n")), "{said}");
    }
    let report = text(dir.join("r.json"));
    assert!(report.contains("\"defect_count\": 4") && report.contains("\"kind\": \"open edge\""), "{report}");
    assert!(!dir.join("o.ele").exists() && !dir.join("o.node").exists());
    let info = delotet(&["info", "open.off", "--report", "i.json"], &dir);
    assert_eq!(info.status.code(), Some(0));
    let said = String::from_utf8_lossy(&info.stderr).into_owned();
    assert!(
        said.starts_with("warning: 4 open edges: ") && said.contains("point 0 and point 3 at (0, 0.5, 0)"),
        "{said}"
    );
    assert!(text(dir.join("i.json")).contains("\"warning_count\": 4"));
    let output = delotet(&["mesh", "open.off", "-o", "o.ele", "--keep-hull"], &dir);
    assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
}

#[test]
fn a_self_intersection_is_named() {
    let dir = folder("crossing");
    let shifted: String = (0..8)
        .map(|i| {
            format!("{} {} {}\n", 0.5 + f64::from(i % 2), 0.3 + f64::from(i / 2 % 2), 0.2 + f64::from(i / 4))
        })
        .collect();
    let faces = "4 8 10 11 9\n4 12 13 15 14\n4 8 9 13 12\n4 9 11 15 13\n4 11 10 14 15\n4 10 8 12 14\n";
    let (points, cube_faces) =
        CUBE["OFF\n8 6 0\n".len()..].split_at(CUBE.find("4 0 3").unwrap() - "OFF\n8 6 0\n".len());
    std::fs::write(dir.join("x.off"), format!("OFF\n16 12 0\n{points}{shifted}{cube_faces}{faces}")).unwrap();
    for command in [
        &["mesh", "x.off", "-o", "x.ele", "--report", "r.json"][..],
        &["info", "x.off", "--report", "r.json"],
    ] {
        let output = delotet(command, &dir);
        assert_eq!(output.status.code(), Some(1), "{}", error_line(&output));
        assert!(error_line(&output).starts_with("error: "));
        assert!(text(dir.join("r.json")).contains("\"status\": \"SelfIntersection\""));
        assert!(
            text(dir.join("r.json")).contains("\"kind\": \"facet crosses facet\""),
            "{}",
            text(dir.join("r.json"))
        );
    }
}

#[test]
fn points_alone_are_meshed_to_their_hull() {
    let dir = folder("points");
    let points: String = (0..27).map(|i| format!("{} {} {} {}\n", i + 1, i % 3, i / 3 % 3, i / 9)).collect();
    std::fs::write(dir.join("grid.node"), format!("# a grid\n27 3 0 0\n{points}")).unwrap();
    let output = delotet(&["mesh", "grid.node", "-o", "g.ele"], &dir);
    assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
    assert!(String::from_utf8_lossy(&output.stdout).contains("volume 8.000000"));
}

#[cfg(unix)]
/// A grid with a heavy point in it, whose weight is the first of two attributes.
#[test]
fn weighted_points_and_their_cells() {
    let dir = folder("weights");
    let weight = |i: u32| if i == 21 { 3.5 } else { 0.0 };
    let point = |i: u32| format!("{i} {} {} {} {} 7\n", i % 4, i / 4 % 4, i / 16, weight(i));
    std::fs::write(dir.join("p.node"), "64 3 2 0\n".to_string() + &(0..64).map(point).collect::<String>())
        .unwrap();
    let run = |extra: &[&str]| {
        let result =
            delotet(&[&["mesh", "p.node", "-o", "m.ele", "--voronoi", "cells.vtu"], extra].concat(), &dir);
        assert_eq!(result.status.code(), Some(0), "{extra:?}: {}", error_line(&result));
        let cells = text(dir.join("cells.vtu"));
        let part = |name: &str| {
            let from = cells.split_once(&format!("Name=\"{name}\"")).expect("an array").1;
            let rows = from.split_once('\n').and_then(|x| x.1.split_once("</DataArray>")).expect("its end").0;
            rows.split_whitespace().map(|x| x.parse::<u32>().unwrap()).collect::<Vec<u32>>()
        };
        (part("point"), part("faces"), part("faceoffsets"))
    };
    let (points, faces, offsets) = run(&[]);
    assert_eq!(points, [21, 22, 25, 26, 37, 38, 41, 42]);
    assert_eq!(offsets.last().copied(), Some(faces.len() as u32));
    // Of the heavy point's inner neighbours three are hidden.
    let (points, _, _) = run(&["--weights"]);
    assert_eq!(points, [21, 26, 38, 41, 42]);
    let check = |extra: &[&str]| delotet(&[&["check", "m.ele", "--input", "p.node"], extra].concat(), &dir);
    let said = String::from_utf8_lossy(&check(&["--weights"]).stdout).into_owned();
    assert!(said.contains("correct (64 points") && said.contains("; weighted Delaunay"), "{said}");
    let said = String::from_utf8_lossy(&check(&[]).stdout).into_owned();
    assert!(said.contains("without --weights the Delaunay property was not judged"), "{said}");
    assert_eq!(check(&["--weights=height"]).status.code(), Some(1));
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    for (arguments, line) in [
        (vec!["cube.off", "--weights"], "--weights: the points of the input have no attributes"),
        (vec!["cube.off", "--voronoi", "v.vtu"], "--voronoi requires --mode delaunay"),
        (vec!["p.node", "--voronoi", "v.obj"], "v.obj: Voronoi cells are written to .vtu files only"),
        (vec!["p.node", "--weights", "--mode", "cdt"], "weights of points: only mode delaunay counts them"),
    ] {
        let result = delotet(&[&["mesh", "-o", "n.vtu"], &arguments[..]].concat(), &dir);
        assert_eq!(result.status.code(), Some(2), "{arguments:?}");
        assert!(error_line(&result).contains(line), "{}", error_line(&result));
    }
}

#[test]
fn an_interrupt_ends_cleanly_with_3() {
    let dir = folder("interrupt");
    // Enough points to be busy for a while; a linear congruential sequence.
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let points: String = (0..800_000).map(|i| format!("{i} {} {} {}\n", next(), next(), next())).collect();
    std::fs::write(dir.join("p.node"), format!("800000 3 0 0\n{points}")).unwrap();
    let child = Command::new(env!("CARGO_BIN_EXE_delotet"))
        .args(["mesh", "p.node", "-o", "m.ele"])
        .current_dir(&dir)
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    // As soon as it has a handler (SIGINT is the second bit of the mask) it may be interrupted.
    let caught = || {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let mask =
            status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap_or("2").trim().to_string();
        u64::from_str_radix(&mask, 16).unwrap() & 2 != 0
    };
    while !caught() {
        std::thread::yield_now();
    }
    let sent = Command::new("sh").args(["-c", &format!("kill -INT {}", child.id())]).status().unwrap();
    assert!(sent.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(3), "{}", error_line(&output));
    assert!(error_line(&output).contains("cancelled"), "{}", error_line(&output));
    assert!(std::fs::read_dir(&dir).unwrap().count() == 1, "nothing may be left behind");
}

#[test]
fn limits_end_with_3_and_leave_nothing_behind() {
    let dir = folder("limits");
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let points: String = (0..200_000).map(|i| format!("{i} {} {} {}\n", next(), next(), next())).collect();
    std::fs::write(dir.join("p.node"), format!("200000 3 0 0\n{points}")).unwrap();
    let prism = Path::new(env!("CARGO_MANIFEST_DIR")).join("capi-tests/data/schoenhardt.off");
    std::fs::copy(prism, dir.join("prism.off")).unwrap();
    let files = std::fs::read_dir(&dir).unwrap().count();
    let mut cases = vec![
        (["p.node", "--time-limit", "0.001"], "the time limit of 0.001 s"),
        (["prism.off", "--steiner-limit", "0"], "the limit of 0 Steiner points"),
        (["prism.off", "--tetrahedra-limit", "2"], "the limit of 2 tetrahedra"),
    ];
    if cfg!(target_os = "linux") {
        cases.push((["p.node", "--memory-limit", "20M"], "the memory limit of 20.0 MB"));
    }
    for ([input, option, value], message) in cases {
        let output = delotet(&["mesh", input, "-o", "m.vtu", option, value], &dir);
        assert_eq!(output.status.code(), Some(3), "{}", error_line(&output));
        assert!(error_line(&output).contains(message), "{}", error_line(&output));
        assert_eq!(std::fs::read_dir(&dir).unwrap().count(), files, "{option}");
    }
    let wide = [
        "--time-limit",
        "1e6",
        "--memory-limit",
        "1.5Gi",
        "--steiner-limit",
        "1000",
        "--tetrahedra-limit",
        "99",
    ];
    let output = delotet(&[&["mesh", "prism.off", "-o", "m.vtu"], &wide[..]].concat(), &dir);
    assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
    for wrong in
        [["--time-limit", "0"], ["--time-limit", "-1"], ["--time-limit", "nan"], ["--time-limit", "1e30"]]
            .into_iter()
            .chain([
                ["--memory-limit", "0"],
                ["--memory-limit", "5X"],
                ["--memory-limit", "M"],
                ["--steiner-limit", "-1"],
            ])
    {
        let output = delotet(&[&["mesh", "prism.off", "-o", "n.vtu"], &wrong[..]].concat(), &dir);
        assert_eq!(output.status.code(), Some(2), "{wrong:?}");
    }
}

#[test]
fn merged_facets_are_counted_and_reported() {
    let dir = folder("merge");
    // A pyramid over a kite that is cut along its long diagonal and almost flat.
    let mut off = String::from("OFF\n5 6 0\n0 0 0\n1 0 0\n0.5 0.1 0\n0.5 -0.1 0.000001\n0.5 0 -1\n");
    off += "3 0 1 2\n3 1 0 3\n3 1 4 2\n3 2 4 0\n3 0 4 3\n3 3 4 1\n";
    std::fs::write(dir.join("kite.off"), off).unwrap();
    let count = |merge: &str| {
        let mut arguments =
            vec!["mesh", "kite.off", "-o", "k.vtu", "--stats", "s.json", "--report", "r.json"];
        arguments.extend((!merge.is_empty()).then_some(merge));
        let result = delotet(&arguments, &dir);
        assert_eq!(result.status.code(), Some(0), "{}", error_line(&result));
        let report = text(dir.join("r.json"));
        let reported = report.matches("\"facets\"").count();
        let stats = text(dir.join("s.json"));
        assert!(stats.contains(&format!("\"facet_flips\": {reported}")), "{stats}");
        reported
    };
    assert_eq!(count(""), 0);
    assert_eq!(count("--merge-facets"), 1);
    assert_eq!(count("--merge-facets=179.99999"), 0);
}

/// Schönhardt's polyhedron: no tetrahedralization without Steiner points.
const TWISTED_PRISM: &str = "OFF\n6 8 0\n0 0 0\n4 0 0\n2 3 0\n1 -1 4\n4 1.5 4\n0.5 2.5 4\n3 0 2 1\n3 3 4 5\n\
                             3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n3 2 0 3\n3 2 3 5\n";

#[test]
fn the_surface_is_preserved() {
    let dir = folder("preserve");
    std::fs::write(dir.join("prism.off"), TWISTED_PRISM).unwrap();
    std::fs::write(dir.join("two.poly"), two_rooms()).unwrap();
    let preserve = ["mesh", "prism.off", "-o", "p.ele", "--mode", "preserve", "--stats", "s.json"];
    let output = delotet(&preserve, &dir);
    assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("1 inside; the boundary is exactly the input's"), "{said}");
    let stats = text(dir.join("s.json"));
    assert!(stats.contains("\"interior\": 1") && stats.contains("\"subfaces\": 8"), "{stats}");
    assert!(stats.contains("\"preserve\": {") && stats.contains("\"missing_edges\": "), "{stats}");
    assert_eq!(text(dir.join("p.node")).lines().next(), Some("7  3  0  0"));
    let check = delotet(&["check", "p.ele", "--input", "prism.off", "--preserved"], &dir);
    assert_eq!(check.status.code(), Some(0), "{}", error_line(&check));
    let output =
        delotet(&["mesh", "two.poly", "-o", "t.ele", "--mode", "preserve", "--stats", "s.json"], &dir);
    assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
    assert!(text(dir.join("s.json")).contains("\"regions\": 2"));
    let check = delotet(&["check", "t.ele", "--input", "two.poly", "--preserved"], &dir);
    assert_eq!(check.status.code(), Some(0), "{}", error_line(&check));
}

#[test]
fn the_outer_boundary_is_preserved() {
    let dir = folder("preserve-outer");
    std::fs::write(dir.join("two.poly"), two_rooms()).unwrap();
    let outer =
        ["mesh", "two.poly", "-o", "t.ele", "--mode", "preserve", "--preserve", "outer", "--stats", "s.json"];
    let output = delotet(&outer, &dir);
    assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
    assert!(text(dir.join("s.json")).contains("\"on_internal_facets\": 0"));
    let check = delotet(&["check", "t.ele", "--input", "two.poly", "--preserved=outer"], &dir);
    assert_eq!(check.status.code(), Some(0), "{}", error_line(&check));
    // Adjacent fins around a twisted prism, in a box: the one point needed stays on the fins, none is inside.
    let fins = concat!(env!("CARGO_MANIFEST_DIR"), "/capi-tests/data/fins_in_box.poly");
    let outer =
        ["mesh", fins, "-o", "f.ele", "--mode", "preserve", "--preserve", "outer", "--stats", "s.json"];
    let output = delotet(&outer, &dir);
    assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
    let stats = text(dir.join("s.json"));
    assert!(stats.contains("\"on_internal_facets\": 1") && stats.contains("\"interior\": 0"), "{stats}");
    let check = delotet(&["check", "f.ele", "--input", fins, "--preserved=outer"], &dir);
    assert_eq!(check.status.code(), Some(0), "{}", error_line(&check));
    assert_eq!(delotet(&["check", "f.ele", "--input", fins, "--preserved"], &dir).status.code(), Some(1));
    let refused = delotet(&["mesh", "two.poly", "-o", "t.ele", "--preserve", "outer"], &dir);
    assert_eq!(refused.status.code(), Some(2), "{}", error_line(&refused));
}

#[test]
fn check_says_that_the_surface_was_not_preserved() {
    let dir = folder("not-preserved");
    std::fs::write(dir.join("prism.off"), TWISTED_PRISM).unwrap();
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    assert!(delotet(&["mesh", "prism.off", "-o", "p.ele"], &dir).status.success());
    let arguments = ["check", "p.ele", "--input", "prism.off", "--preserved", "--report", "r.json"];
    let output = delotet(&arguments, &dir);
    assert_eq!(output.status.code(), Some(1), "{}", error_line(&output));
    assert!(error_line(&output).contains("corner of a face on the surface"), "{}", error_line(&output));
    assert!(text(dir.join("r.json")).contains("\"kind\": \"facet missing\""), "{}", text(dir.join("r.json")));
    // The cube needs no points, however it is meshed; its square sides may be cut either way.
    assert!(delotet(&["mesh", "cube.off", "-o", "c.ele"], &dir).status.success());
    let output = delotet(&["check", "c.ele", "--input", "cube.off", "--preserved"], &dir);
    assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
}

/// A cube, an open box around it, and a triangle far away.
fn leaky_shell() -> String {
    let cube = |base: usize, low: f64, high: f64| {
        let at = |i: usize, bits: [usize; 3]| bits.map(|b| if i & b != 0 { high } else { low });
        let points: String =
            (0..8).map(|i| at(i, [1, 2, 4])).map(|p| format!("{} {} {}\n", p[0], p[1], p[2])).collect();
        let rings = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        (points, rings.map(|r| r.map(|v: usize| v + base)))
    };
    let ((inner, closed), (outer, open)) = (cube(0, 1.0, 2.0), cube(8, 0.0, 3.0));
    let rings = closed.iter().chain(&open[1..]);
    let rings: String = rings.map(|r| format!("4 {} {} {} {}\n", r[0], r[1], r[2], r[3])).collect();
    format!("OFF\n19 12 0\n{inner}{outer}9 9 9\n9 8 9\n8 9 9\n{rings}3 16 17 18\n")
}

#[test]
fn a_shell_that_leaks_beside_others_is_said_and_not_written() {
    let dir = folder("leak");
    std::fs::write(dir.join("leak.off"), leaky_shell()).unwrap();
    for mode in ["cdt", "preserve"] {
        let output = delotet(
            &["mesh", "leak.off", "-o", "m.ele", "--mode", mode, "--stats", "s.json", "--report", "r.json"],
            &dir,
        );
        assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.contains("warning: 7 open edges: "), "{said}");
        assert!(
            said.contains("warning: 11 parts of facets bound no tetrahedron (first: facet 6 at ("),
            "{said}"
        );
        assert!(said.contains("warning: 11 points are in no tetrahedron"), "{said}");
        let stats = text(dir.join("s.json"));
        for count in ["\"open edge\": 7", "\"unmeshed facet\": 11", "\"unmeshed point\": 11"] {
            assert!(stats.contains(count), "{stats}");
        }
        assert!(text(dir.join("r.json")).contains("\"warning_count\": 29"));
        assert!(text(dir.join("m.face")).starts_with("12  1\n"));
        let check = ["check", "m.ele", "--input", "leak.off"];
        let with: &[&str] = if mode == "preserve" { &["--preserved"] } else { &[] };
        let output = delotet(&[&check, with].concat(), &dir);
        assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
        assert!(String::from_utf8_lossy(&output.stdout).contains("correct"));
        let quiet = delotet(&["mesh", "leak.off", "-o", "m.vtu", "--mode", mode, "-q"], &dir);
        assert!(quiet.status.success() && quiet.stderr.is_empty());
        // Without the points that no tetrahedron has, the files are still checked against the whole input.
        let arguments = ["mesh", "leak.off", "-o", "d.ele", "--mode", mode, "--drop-points", "-q"];
        assert_eq!(delotet(&arguments, &dir).status.code(), Some(0));
        assert!(text(dir.join("d.node")).starts_with("8  3  0  0\n"));
        let output = delotet(&[&["check", "d.ele", "--input", "leak.off"], with].concat(), &dir);
        assert_eq!(output.status.code(), Some(0), "{}", error_line(&output));
        // A file that lists them among the mesh's faces is refused.
        let faces = text(dir.join("m.face")).replacen("12  1", "13  1", 1) + "12 8 10 11 0\n";
        let parents = text(dir.join("m.parents")).replacen("12", "13", 1);
        let mut parents: Vec<&str> = parents.lines().collect();
        parents.insert(13, "6");
        std::fs::write(dir.join("m.face"), faces).unwrap();
        std::fs::write(dir.join("m.parents"), parents.join("\n")).unwrap();
        let output = delotet(&check, &dir);
        assert_eq!(output.status.code(), Some(1));
        assert!(String::from_utf8_lossy(&output.stderr).contains("facet missing: facet 6"));
    }
}

/// The input does not know the seeds of the command line, and files do not tell regions of one attribute apart.
#[test]
fn meshes_of_any_seeds_pass_their_check() {
    let dir = folder("any-seeds");
    let rooms = two_rooms();
    let seeds = "2\n0 0.5 0.5 0.5 10\n1 1.5 0.5 0.5 20\n";
    let with = |name: &str, to: &str| {
        assert!(rooms.ends_with(seeds));
        std::fs::write(dir.join(name), rooms.replace(seeds, to)).unwrap();
    };
    with("none.poly", "");
    with("right.poly", "1\n0 1.5 0.5 0.5 20\n");
    with("same.poly", "2\n0 0.5 0.5 0.5 10\n1 1.5 0.5 0.5 10\n");
    with("turned.poly", "2\n0 1.5 0.5 0.5 10\n1 0.5 0.5 0.5 10\n");
    let (left, right) = ("0.5,0.5,0.5,", "1.5,0.5,0.5,");
    let at = |place: &str, attribute: u32| format!("--region={place}{attribute}");
    for (input, seeds) in [
        ("none.poly", vec![]),
        ("none.poly", vec![at(left, 7)]),
        ("none.poly", vec![at(right, 7)]),
        ("none.poly", vec![at(left, 7), at(right, 3)]),
        ("none.poly", vec![at(right, 7), at(left, 3)]),
        ("none.poly", vec![at(left, 5), at(right, 5)]),
        ("none.poly", vec![at(right, 5), at(left, 5)]),
        ("right.poly", vec![]),
        ("right.poly", vec![at(left, 3)]),
        ("right.poly", vec![at(left, 20)]),
        ("same.poly", vec![]),
        ("turned.poly", vec![]),
    ] {
        for mode in ["cdt", "preserve"] {
            let mut arguments = vec!["mesh", input, "-o", "m.ele", "-q", "--mode", mode];
            arguments.extend(seeds.iter().map(String::as_str));
            let output = delotet(&arguments, &dir);
            assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", error_line(&output));
            let output = delotet(&["check", "m.ele", "--input", input], &dir);
            assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", error_line(&output));
        }
    }
    // An attribute that changes where there is no wall is still found.
    let ele = text(dir.join("m.ele"));
    let (first, rest) = ele.split_once('\n').unwrap();
    let (tet, others) = rest.split_once('\n').unwrap();
    let changed = format!("{first}\n{} 11\n{others}", tet.rsplit_once(' ').unwrap().0);
    std::fs::write(dir.join("m.ele"), changed).unwrap();
    assert_eq!(delotet(&["check", "m.ele", "--input", "turned.poly"], &dir).status.code(), Some(1));
}

#[test]
fn a_mesh_without_its_faces_is_not_called_correct() {
    let dir = folder("faceless");
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    assert_eq!(delotet(&["mesh", "cube.off", "-o", "c.ele", "-q"], &dir).status.code(), Some(0));
    for name in ["c.face", "c.parents"] {
        std::fs::remove_file(dir.join(name)).unwrap();
    }
    for mesh in ["c.ele", "c"] {
        let output = delotet(&["check", mesh, "--input", "cube.off"], &dir);
        assert_eq!(output.status.code(), Some(1), "{mesh}");
        assert!(error_line(&output).contains("c.face: no such file"), "{}", error_line(&output));
    }
    // A file that lists none does not help.
    std::fs::write(dir.join("c.face"), "0 1\n").unwrap();
    let output = delotet(&["check", "c.ele", "--input", "cube.off"], &dir);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("facet missing"));
}

/// Two spheres in one another with fine surfaces, so that there is room inside.
const NESTED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/capi-tests/data/nested.off");

/// A mesh of it with the surface kept, whose files pass their check; the number of points.
fn points_of_nested(options: &[&str], dir: &Path) -> u64 {
    let fixed = ["mesh", NESTED, "-o", "n.ele", "--mode", "preserve", "-q", "--stats", "s.json"];
    let output = delotet(&[&fixed[..], options].concat(), dir);
    assert_eq!(output.status.code(), Some(0), "{options:?}: {}", error_line(&output));
    let check = delotet(&["check", "n.ele", "--input", NESTED, "--preserved"], dir);
    assert_eq!(check.status.code(), Some(0), "{options:?}: {}", error_line(&check));
    let stats: serde_json::Value = serde_json::from_str(&text(dir.join("s.json"))).unwrap();
    stats["points"].as_u64().unwrap()
}

#[test]
fn a_kept_surface_is_filled_by_size_and_shape() {
    let dir = folder("sizes");
    let none = points_of_nested(&[], &dir);
    let coarse = points_of_nested(&["--size", "4"], &dir);
    let fine = points_of_nested(&["--size", "1.2"], &dir);
    assert!(none < coarse && coarse < fine, "{none}, {coarse}, {fine}");
    assert!(none < points_of_nested(&["--quality", "--optimize"], &dir));
    assert!(none < points_of_nested(&["--quality=1.5", "--optimize=0"], &dir));
    assert!(none < points_of_nested(&["--quality=1.5", "--optimize=0.001s"], &dir));
    assert!(none < points_of_nested(&["--max-volume", "0.5"], &dir));
    assert!(
        points_of_nested(&["--quality", "--gradation", "1"], &dir)
            < points_of_nested(&["--quality", "--gradation", "0.01"], &dir)
    );
}

#[test]
fn parts_of_the_input_have_sizes() {
    let dir = folder("part-sizes");
    let none = points_of_nested(&["--size", "4"], &dir);
    let more = |options: &[&str]| {
        let count = points_of_nested(&[&["--size", "4"], options].concat(), &dir);
        assert!(none < count, "{options:?}: {count}");
    };
    more(&["--facet-size", "0=0.5"]);
    more(&["--facet-area", "0=0.1"]);
    more(&["--region", "0,0,0,-2.5", "--region-size", "-2.5=0.5", "--region-size", "7=1"]);
    let sizes: String = (0..648).map(|i| if i % 2 == 0 { "0.4\n" } else { "0\n" }).collect();
    std::fs::write(dir.join("sizes.txt"), &sizes).unwrap();
    more(&["--size-file", "sizes.txt"]);
    std::fs::write(dir.join("sizes.mtr"), format!("648 1\n{sizes}")).unwrap();
    more(&["--size-file", "sizes.mtr"]);
    // No segment has this marker.
    assert_eq!(points_of_nested(&["--size", "4", "--segment-size", "-3=0.01"], &dir), none);
}

#[test]
fn nonsense_for_sizes_is_refused_with_2() {
    let dir = folder("no-sizes");
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    for options in [
        &["--size", "0"][..],
        &["--size", "-1"],
        &["--size", "nan"],
        &["--size", "inf"],
        &["--max-volume", "0"],
        &["--max-volume", "-0.5"],
        &["--gradation", "0"],
        &["--gradation", "1.5"],
        &["--quality=0.9"],
        &["--quality=inf"],
        &["--optimize=-1"],
        &["--min-angle=0"],
        &["--min-angle", "61"],
        &["--optimize=0s"],
        &["--optimize=1.5"],
        &["--facet-size", "3"],
        &["--facet-size", "3=0"],
        &["--facet-area", "3=0"],
        &["--segment-size", "1.5=1"],
        &["--region-size", "x=1"],
    ] {
        let arguments = [&["mesh", "cube.off", "-o", "m.vtu", "--mode", "preserve"], options].concat();
        let output = delotet(&arguments, &dir);
        assert_eq!(output.status.code(), Some(2), "{options:?}");
        assert!(error_line(&output).starts_with("error: "), "{options:?}: {}", error_line(&output));
    }
    for option in ["--size=1", "--max-volume=1", "--quality", "--optimize", "--min-angle=20"] {
        let output = delotet(&["mesh", "cube.off", "-o", "m.vtu", "--mode", "delaunay", option], &dir);
        assert_eq!(output.status.code(), Some(2), "{option}");
        assert!(error_line(&output).contains("mode delaunay"), "{}", error_line(&output));
    }
    assert_eq!(std::fs::read_dir(&dir).unwrap().count(), 1, "nothing may be written");
}

#[test]
fn files_of_sizes_fail_with_1_and_name_the_line() {
    let dir = folder("size-files");
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    let run = |file: &str, text: Option<&[u8]>| {
        if let Some(text) = text {
            std::fs::write(dir.join(file), text).unwrap();
        }
        let fixed =
            ["mesh", "cube.off", "-o", "m.vtu", "--mode", "preserve", "--size", "1", "--size-file", file];
        delotet(&fixed, &dir)
    };
    for (text, said) in [
        (None, "no such file"),
        (Some(&b"1\n2\n"[..]), "2 sizes; the input has 8 points"),
        (Some(b"8 1\n1\n2\n3\nx\n"), "line 5: a size expected, found 'x'"),
        (Some(b"8 6\n"), "line 1: 6 numbers per point"),
        (Some(b"\xff\xfe"), "it is not text"),
    ] {
        let output = run("s.txt", text);
        assert_eq!(output.status.code(), Some(1), "{said}: {}", error_line(&output));
        let line = error_line(&output);
        assert!(line.starts_with("error: s.txt: ") && line.contains(said), "{line}");
    }
    assert_eq!(run("s.txt", Some(b"1 # the first\n1\n1\n1\n0\n0\ninf\n-1\n")).status.code(), Some(0));
    // An output does not replace it.
    let both = ["mesh", "cube.off", "-o", "s.vtu", "--mode", "preserve", "--size-file", "s.vtu"];
    let output = delotet(&both, &dir);
    assert!(output.status.code() == Some(2) && error_line(&output).contains("would replace the input"));
    // Without an option that fills, sizes have no effect.
    let idle = [
        "mesh",
        "cube.off",
        "-o",
        "m.vtu",
        "--mode",
        "preserve",
        "--size-file",
        "s.txt",
        "--facet-size",
        "1=1",
    ];
    let output = delotet(&idle, &dir);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(
        said.contains("no effect without --size, --max-volume, --quality or --background: --facet-size"),
        "{said}"
    );
    assert!(said.contains("--background: --size-file"), "{said}");
}

#[test]
fn a_mesh_is_refined_and_improved() {
    let dir = folder("given");
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    let done = |arguments: &[&str]| {
        let result = delotet(arguments, &dir);
        assert_eq!(result.status.code(), Some(0), "{arguments:?}: {}", error_line(&result));
        String::from_utf8_lossy(&result.stdout).into_owned()
    };
    let failed = |arguments: &[&str], code: i32, said: &str| {
        let result = delotet(arguments, &dir);
        assert_eq!(result.status.code(), Some(code), "{arguments:?}: {}", error_line(&result));
        assert!(error_line(&result).contains(said), "{arguments:?}: {}", error_line(&result));
    };
    done(&["mesh", "cube.off", "--mode", "preserve", "-o", "c.vtu", "--subfaces"]);
    let told =
        done(&["refine", "c.vtu", "-o", "r.ele", "--size", "0.4", "--stats", "s.json", "--report", "r.json"]);
    assert!(told.contains("8 in") && told.contains("volume 1.000000"), "{told}");
    let stats: serde_json::Value = serde_json::from_str(&text(dir.join("s.json"))).unwrap();
    let count = |part: &str, key: &str| stats[part][key].as_u64().unwrap();
    assert_eq!(
        (&stats["points_in"], stats["points"].as_u64()),
        (&8.into(), Some(8 + count("refine", "inside")))
    );
    assert_eq!(count("refine", "inside"), count("refine", "for_sizes") + count("refine", "for_shapes"));
    assert!(count("refine", "on_segments") + count("refine", "on_facets") + count("optimize", "passes") == 0);
    assert!(text(dir.join("r.json")).contains("\"status\": \"Ok\""));
    let node = text(dir.join("r.node"));
    let points: usize = node.split_whitespace().next().unwrap().parse().unwrap();
    assert!(points > 8, "{points}");
    for output in ["i.msh", "i.mesh", "i.vtu"] {
        let told = done(&["improve", "r.ele", "-o", output, "--optimize=2", "--input-points", "8"]);
        assert!(told.contains("8 in") && told.contains("volume 1.000000"), "{told}");
        done(&["refine", output, "-o", "again.ele", "--quality", "--optimize", "--quiet"]);
    }
    done(&["improve", "r.ele", "-o", "i.vtu", "--optimize=0.01s"]);
    done(&["refine", "r.ele", "-o", "i.vtu", "--optimize=0.01s"]);
    // One size per point, or per tetrahedron.
    let tets = text(dir.join("r.ele")).split_whitespace().next().unwrap().parse::<usize>().unwrap();
    for (name, count) in [("points.mtr", points), ("tets.txt", tets)] {
        let sizes = "0.2\n".repeat(count);
        let header = if name == "points.mtr" { format!("{count} 1\n") } else { String::new() };
        std::fs::write(dir.join(name), header + &sizes).unwrap();
        done(&["refine", "r.ele", "-o", "fine.ele", "--sizes", name]);
        let fine = text(dir.join("fine.node")).split_whitespace().next().unwrap().parse::<usize>().unwrap();
        assert!(fine > points, "{name}: {fine}");
    }
    done(&["refine", "r.ele", "-o", "fine.ele", "--facet-area", "0=0.01"]);
    let fine = text(dir.join("fine.node")).split_whitespace().next().unwrap().parse::<usize>().unwrap();
    assert!(fine > points, "{fine}");
    std::fs::write(dir.join("few.txt"), "1\n2\n").unwrap();
    failed(&["refine", "r.ele", "-o", "x.vtu", "--sizes", "few.txt"], 1, "2 sizes; the mesh has");
    failed(&["refine", "r.ele", "-o", "x.vtu", "--sizes", "none.txt"], 1, "no such file");
    failed(&["refine", "none.vtu", "-o", "x.vtu", "--size", "1"], 1, "none.vtu");
    failed(&["improve", "cube.off", "-o", "x.vtu"], 2, "meshes are read from");
    failed(&["improve", "r.ele", "-o", "r.vtu.none"], 2, "unknown file format");
    failed(&["improve", "r.ele", "-o", "r.ele"], 2, "");
    failed(&["refine", "r.ele", "-o", "x.vtu", "--size", "0.1", "--steiner-limit", "3"], 3, "Steiner");
    failed(
        &["refine", "r.ele", "-o", "x.vtu", "--size", "0.1", "--tetrahedra-limit", "200"],
        3,
        "200 tetrahedra",
    );
    failed(&["refine", "r.ele", "-o", "x.vtu", "--size", "0"], 2, "");
    std::fs::write(
        dir.join("flat.mesh"),
        "MeshVersionFormatted 2 Dimension 3 Vertices 4 0 0 0 0 1 0 0 0 0 1 0 0 1 1 0 0 \
                   Tetrahedra 1 1 2 3 4 0 End",
    )
    .unwrap();
    failed(&["improve", "flat.mesh", "-o", "x.vtu", "--report", "flat.json"], 1, "a tetrahedron is flat");
    assert!(text(dir.join("flat.json")).contains("tetrahedron not positive"));
    let unused = delotet(&["refine", "r.ele", "-o", "same.ele"], &dir);
    assert!(String::from_utf8_lossy(&unused.stderr).contains("nothing is refined"));
}

/// The rows of numbers in a file of TetGen's, without its header.
fn rows(path: PathBuf) -> Vec<Vec<f64>> {
    let lines = text(path);
    let lines = lines.lines().map(|line| line.split('#').next().unwrap_or_default());
    let numbers =
        |line: &str| line.split_whitespace().map(|word| word.parse().unwrap()).collect::<Vec<f64>>();
    lines.map(numbers).filter(|row| !row.is_empty()).skip(1).collect()
}

/// The smallest dihedral angle of a mesh in `.node` and `.ele`, in degrees: between the parts of two edges across a third.
fn smallest_dihedral(dir: &Path, stem: &str) -> f64 {
    let points: Vec<[f64; 3]> =
        rows(dir.join(format!("{stem}.node"))).iter().map(|row| [row[1], row[2], row[3]]).collect();
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let mut least = 180.0f64;
    for row in rows(dir.join(format!("{stem}.ele"))) {
        let at = [1, 2, 3, 4].map(|k| points[row[k] as usize]);
        for (i, j) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
            let minus = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k] - q[k]);
            let axis = minus(at[j], at[i]);
            let across = |k: usize| {
                let edge = minus(at[k], at[i]);
                let along = dot(edge, axis) / dot(axis, axis);
                [0, 1, 2].map(|k| edge[k] - along * axis[k])
            };
            let mut others = (0..4).filter(|&k| k != i && k != j).map(across);
            let (u, v) = (others.next().unwrap(), others.next().unwrap());
            least = least.min((dot(u, v) / (dot(u, u) * dot(v, v)).sqrt()).acos().to_degrees());
        }
    }
    least
}

/// The angle is that of the mesh in the files; the usual effort does not reach it.
#[test]
fn a_wanted_angle_is_reached() {
    let dir = folder("angle");
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    let reached = |arguments: &[&str]| {
        let result = delotet(arguments, &dir);
        assert_eq!(result.status.code(), Some(0), "{arguments:?}: {}", error_line(&result));
        smallest_dihedral(&dir, arguments[3].strip_suffix(".ele").unwrap())
    };
    let before = reached(&["mesh", "cube.off", "-o", "c.ele", "--size", "0.3"]);
    assert!(before < 25.0, "{before}");
    for command in ["refine", "improve"] {
        let usual = reached(&[command, "c.ele", "-o", "m.ele", "--optimize=1"]);
        assert!(usual > before && usual < 30.0, "{command}: {before} {usual}");
        let angle = reached(&[command, "c.ele", "-o", "m.ele", "--min-angle", "30"]);
        assert!(angle >= 30.0, "{command}: {angle}");
        // What nothing reaches is come as near to as can be.
        let most = reached(&[command, "c.ele", "-o", "m.ele", "--min-angle", "60"]);
        assert!((usual..60.0).contains(&most), "{command}: {usual} {most}");
    }
    let made = reached(&["mesh", "cube.off", "-o", "c.ele", "--size", "0.3", "--min-angle", "30"]);
    assert!(made >= 30.0, "{made}");
}

#[test]
fn a_background_mesh_has_the_sizes() {
    let dir = folder("background");
    std::fs::write(dir.join("cube.off"), CUBE).unwrap();
    let done = |arguments: &[&str]| {
        let result = delotet(arguments, &dir);
        assert_eq!(result.status.code(), Some(0), "{arguments:?}: {}", error_line(&result));
        text(dir.join("m.node")).split_whitespace().next().unwrap().parse::<usize>().unwrap()
    };
    let coarse = done(&["mesh", "cube.off", "-o", "m.ele"]);
    for file in ["b.ele", "b.vtu"] {
        let made = delotet(&["mesh", "cube.off", "-o", file], &dir);
        assert_eq!(made.status.code(), Some(0), "{}", error_line(&made));
    }
    assert_eq!(coarse, 8);
    std::fs::write(dir.join("b.mtr"), format!("8 1\n{}", "0.3\n".repeat(8))).unwrap();
    std::fs::write(dir.join("none.txt"), "0\n".repeat(8)).unwrap();
    let fine = done(&["mesh", "cube.off", "-o", "m.ele", "--background", "b.ele"]);
    assert!(fine > 50, "{fine}");
    assert_eq!(done(&["mesh", "cube.off", "-o", "m.ele", "--background", "b.vtu"]), fine);
    let unasked =
        ["mesh", "cube.off", "-o", "m.ele", "--background", "b.ele", "--background-sizes", "none.txt"];
    assert!(done(&unasked) < fine);
    let refined = done(&["refine", "b.ele", "-o", "m.ele", "--background", "b.ele"]);
    assert!(refined > coarse, "{refined}");
    let failed = |arguments: &[&str], code: i32, said: &str| {
        let result = delotet(&[&["mesh", "cube.off", "-o", "x.vtu"], arguments].concat(), &dir);
        assert_eq!(result.status.code(), Some(code), "{arguments:?}: {}", error_line(&result));
        assert!(error_line(&result).contains(said), "{arguments:?}: {}", error_line(&result));
    };
    std::fs::write(dir.join("few.txt"), "1\n2\n").unwrap();
    std::fs::write(dir.join("nan.txt"), "1\n2\nnan\n").unwrap();
    failed(
        &["--background", "b.ele", "--background-sizes", "few.txt"],
        1,
        "2 sizes; the background mesh has 8 points",
    );
    failed(&["--background", "b.ele", "--background-sizes", "nan.txt"], 1, "line 3: a size expected");
    failed(&["--background", "m.ele"], 1, "m.mtr: no such file");
    failed(&["--background", "cube.off"], 2, "meshes are read from");
    failed(&["--background-sizes", "b.mtr"], 2, "required arguments were not provided");
    let over = delotet(&["mesh", "cube.off", "-o", "b.vtu", "--background", "b.vtu"], &dir);
    assert!(
        over.status.code() == Some(2) && error_line(&over).contains("would replace"),
        "{}",
        error_line(&over)
    );
}
