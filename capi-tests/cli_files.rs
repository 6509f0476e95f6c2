//! The command line program with wrong files, options of writers, and other programs that read the output: CalculiX (`ccx`) and meshio
//! (Python), if they are installed; if not, the test says so.
mod program;
use program::{command, delotet, error_lines, text, two_rooms};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn folder(name: &str) -> PathBuf {
    let path = program::folder(&format!("cli-files-{name}"));
    std::fs::write(path.join("cube.off"), CUBE).expect("a file for the test");
    std::fs::write(path.join("rooms.poly"), two_rooms()).expect("a file for the test");
    path
}

/// Sides with the markers 1 to 6.
const CUBE: &str = "OFF\n# marker 1 bottom\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n\
                    4 0 3 2 1 1\n4 4 5 6 7 2\n4 0 1 5 4 3\n4 1 2 6 5 4\n4 2 3 7 6 5\n4 3 0 4 7 6\n";

#[test]
fn files_that_are_none_are_one_line_and_the_right_code() {
    let dir = folder("names");
    std::fs::create_dir(dir.join("dir.off")).unwrap();
    std::fs::write(dir.join("empty.stl"), "").unwrap();
    std::fs::write(dir.join("image.stl"), b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR").unwrap();
    std::fs::write(dir.join("noise.off"), [7, 0, 255, 3, 9]).unwrap();
    std::fs::write(dir.join("cut.off"), &CUBE[..CUBE.len() - 30]).unwrap();
    std::fs::write(dir.join("cube.ply"), CUBE).unwrap();
    for (input, code, message) in [
        ("-", 2, "standard input is not supported"),
        ("cube", 2, "the name has no extension"),
        ("cube.xyz", 2, "unknown file format '.xyz'"),
        ("absent.off", 1, "cannot read"),
        ("dir.off", 1, "it is a folder"),
        ("empty.stl", 1, "the file is empty"),
        ("image.stl", 1, "not an STL file: it is a PNG image"),
        ("noise.off", 1, "not an OFF file: it is binary data"),
        ("cut.off", 1, "line 15: "),
        ("cube.ply", 1, "not a PLY file: it is an OFF file"),
    ] {
        for command in
            [&["info", input][..], &["mesh", input, "-o", "m.vtu"], &["convert", input, "-o", "c.off"]]
        {
            let output = delotet(command, &dir);
            let lines = error_lines(&output);
            assert_eq!(output.status.code(), Some(code), "{command:?}: {lines:?}");
            assert!(
                lines.len() == 1 && lines[0].starts_with("error: ") && lines[0].contains(message),
                "{lines:?}"
            );
        }
    }
    for (output, message) in [
        ("-", "standard output is not supported"),
        ("m", "the name has no extension"),
        ("dir.off/", "is a folder"),
        ("absent/m.vtu", "its folder does not exist"),
        ("m.off", "not a mesh format"),
    ] {
        let output = delotet(&["mesh", "cube.off", "-o", output], &dir);
        let lines = error_lines(&output);
        assert_eq!(output.status.code(), Some(2), "{lines:?}");
        assert!(lines.len() == 1 && lines[0].contains(message), "{lines:?}");
    }
    assert!(!dir.join("m.vtu").exists() && !dir.join("c.off").exists());
}

#[test]
#[cfg(unix)]
fn devices_and_full_disks_are_one_line_and_the_right_code() {
    let dir = folder("devices");
    for (device, name) in [("/dev/zero", "zero.off"), ("/dev/null", "null.off"), ("/dev/full", "full.vtu")] {
        std::os::unix::fs::symlink(device, dir.join(name)).unwrap();
    }
    for (input, code) in [("zero.off", 1), ("null.off", 1), ("/dev/null", 2)] {
        let output = delotet(&["info", input], &dir);
        assert_eq!((output.status.code(), error_lines(&output).len()), (Some(code), 1), "{input}");
    }
    let full = |arguments: &[&str]| {
        let output = delotet(arguments, &dir);
        let lines = error_lines(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {lines:?}");
        assert!(lines.len() == 1 && lines[0].starts_with("error: "), "{lines:?}");
        assert!(lines[0].contains("cannot write") && lines[0].contains("full"), "{lines:?}");
    };
    full(&["mesh", "cube.off", "-o", "full.vtu"]);
    full(&["mesh", "cube.off", "-o", "m.vtu", "--stats", "/dev/full"]);
    full(&["mesh", "cube.off", "-o", "m.vtu", "--quiet", "--report", "/dev/full"]);
    full(&["info", "cube.off", "--report", "/dev/full"]);
    // A report that cannot be written does not hide the error.
    let output = delotet(&["info", "absent.off", "--report", "/dev/full"], &dir);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        error_lines(&output)[0].starts_with("warning: ") && error_lines(&output)[1].starts_with("error: ")
    );
    // Standard output.
    assert!(delotet(&["mesh", "cube.off", "-o", "m.ele", "-q"], &dir).status.success());
    for arguments in [
        &["mesh", "cube.off", "-o", "m.vtu"][..],
        &["info", "cube.off"],
        &["check", "m.ele", "--input", "cube.off"],
        &["--help"],
        &["--version"],
    ] {
        let target = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = command(arguments, &dir).stdout(target).output().unwrap();
        let lines = error_lines(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {lines:?}");
        assert!(
            lines.len() == 1 && lines[0].starts_with("error: standard output: cannot write: "),
            "{lines:?}"
        );
        // A closed standard output is no error, and a closed standard error no panic.
        let mut child =
            command(arguments, &dir).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop((child.stdout.take(), child.stderr.take()));
        assert_eq!(child.wait().unwrap().code(), Some(0), "{arguments:?}");
    }
    let target = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let told = command(&["info", "absent.off"], &dir).stderr(target).status().unwrap();
    assert_eq!(told.code(), Some(1));
}

#[test]
fn an_output_replaces_neither_the_input_nor_another_output() {
    let dir = folder("distinct");
    let nodes = "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
    std::fs::write(dir.join("a.node"), nodes).unwrap();
    for arguments in [
        &["mesh", "a.node", "-o", "a.ele"][..],
        &["mesh", "a.node", "-o", "./a.ele"],
        &["mesh", "a.node", "-o", "b.vtu", "--stats", "a.node"],
        &["mesh", "a.node", "-o", "b.vtu", "--stats", "b.json", "--report", "b.json"],
        &["mesh", "a.node", "-o", "b.vtu", "--subfaces", "--stats", "b_subfaces.vtu"],
        &["mesh", "a.node", "-o", "b.vtu", "--report", "a.node"],
        &["info", "a.node", "--report", "a.node"],
    ] {
        let output = delotet(arguments, &dir);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {:?}", error_lines(&output));
        assert_eq!(text(dir.join("a.node")), nodes, "{arguments:?}");
    }
    assert_eq!(delotet(&["mesh", "a.node", "-o", "b.ele", "-q"], &dir).status.code(), Some(0));
    // A surface may be converted onto itself.
    assert_eq!(delotet(&["convert", "cube.off", "-o", "cube.off"], &dir).status.code(), Some(0));
    assert_eq!(delotet(&["info", "cube.off"], &dir).status.code(), Some(0));
}

/// What a command reads is not only the file that it is given.
#[test]
fn an_output_does_not_replace_what_belongs_to_the_input() {
    let dir = folder("belongs");
    let nodes = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
    let facets = "4 0\n3 1 3 2\n3 1 2 4\n3 1 4 3\n3 2 3 4\n0\n0\n";
    std::fs::write(dir.join("s.node"), nodes).unwrap();
    std::fs::write(dir.join("s.smesh"), format!("# points beside\n0 3 0 0\n{facets}")).unwrap();
    let one_line_each = facets.replace("\n3 ", "\n1\n3 ");
    std::fs::write(dir.join("s.poly"), format!("0\n{one_line_each}")).unwrap();
    std::fs::write(dir.join("own.smesh"), format!("{nodes}{facets}")).unwrap();
    std::fs::write(dir.join("own.node"), nodes).unwrap();
    assert_eq!(delotet(&["mesh", "s.smesh", "-o", "m.ele", "-q"], &dir).status.code(), Some(0));
    let files = ["s.node", "s.smesh", "s.poly", "m.node", "m.ele", "m.face", "m.parents"];
    let before = files.map(|name| text(dir.join(name)));
    for arguments in [
        &["mesh", "s.smesh", "-o", "s.ele"][..],
        &["mesh", "s.poly", "-o", "s.ele"],
        &["mesh", "s.poly", "-o", "s.ele", "--report", "r.json"],
        &["mesh", "s.poly", "-o", "b.vtu", "--stats", "s.node"],
        &["mesh", "s.poly", "-o", "b.vtu", "--report", "s.node"],
        &["convert", "s.poly", "-o", "s.node"],
        &["info", "s.smesh", "--report", "./s.node"],
        &["check", "m.ele", "--input", "s.poly", "--report", "s.poly"],
        &["check", "m.ele", "--input", "s.poly", "--report", "s.node"],
        &["check", "m.ele", "--input", "s.poly", "--report", "m.ele"],
        &["check", "m.ele", "--input", "s.poly", "--report", "m.node"],
        &["check", "m.node", "--input", "s.poly", "--report", "m.face"],
        &["check", "m", "--input", "s.poly", "--report", "m.parents"],
        &["mesh", "s.poly", "-o", "b.vtu", "--report", "-"],
    ] {
        let output = delotet(arguments, &dir);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {:?}", error_lines(&output));
        assert_eq!(error_lines(&output).len(), 1, "{arguments:?}: {:?}", error_lines(&output));
        assert_eq!(files.map(|name| text(dir.join(name))), before, "{arguments:?}");
    }
    assert!(["s.ele", "b.vtu", "-"].iter().all(|name| !dir.join(name).exists()));
    // A file that is not read may be replaced: that of an earlier run, say.
    for arguments in [
        &["mesh", "own.smesh", "-o", "own.ele", "-q"][..],
        &["convert", "own.smesh", "-o", "own.node"],
        &["convert", "s.poly", "-o", "s.poly"],
    ] {
        assert_eq!(delotet(arguments, &dir).status.code(), Some(0), "{arguments:?}");
    }
}

#[test]
fn what_has_no_effect_is_said() {
    let dir = folder("effect");
    let bent = two_rooms().replace("\n11 2 1 1\n", "\n11 2.2 1 1.3\n").replace("0.5 10\n", "0.5 10 0.25\n");
    std::fs::write(dir.join("bent.poly"), bent).unwrap();
    std::fs::write(dir.join("marked.node"), "4 3 1 1\n0 0 0 0 5 1\n1 1 0 0 5 1\n2 0 1 0 5 1\n3 0 0 1 5 1\n")
        .unwrap();
    for (arguments, said) in [
        (&["cube.off", "-o", "m.msh", "--compress"][..], "--compress: only .vtu"),
        (&["cube.off", "-o", "m.msh", "--subfaces"], "--subfaces: the file always contains the subfaces"),
        (&["cube.off", "-o", "m.vtk", "--subfaces"], "--subfaces: only .vtu"),
        (&["cube.off", "-o", "m.msh", "--quality-data"], "--quality-data: only .vtu"),
        (&["cube.off", "-o", "m.vtu", "--msh-version", "2.2"], "--msh-version: "),
        (&["cube.off", "-o", "m.vtu", "--region-name", "1=a"], "--region-name: "),
        (
            &["cube.off", "-o", "m.vtu", "--mode", "delaunay", "--region", ".5,.5,.5,7"],
            "--mode delaunay: --region",
        ),
        (
            &["cube.off", "-o", "m.vtu", "--mode", "delaunay", "--merge-facets"],
            "--mode delaunay: --merge-facets",
        ),
        (
            &["cube.off", "-o", "m.vtu", "--region", ".5,.5,.5,7,0.01"],
            "has a volume bound, which has no effect",
        ),
        (&["bent.poly", "-o", "m.vtu"], "has a volume bound, which has no effect"),
        (&["bent.poly", "-o", "m.vtu"], "not planar"),
        (
            &["cube.off", "-o", "m.msh", "--region", ".5,.5,.5,2.5"],
            "cannot be stored in this file format (region 0)",
        ),
        (&["marked.node", "-o", "m.msh"], "cannot be stored in this file format (first: point 0)"),
    ] {
        let with = |quiet: bool| {
            let mut all = vec!["mesh"];
            all.extend_from_slice(arguments);
            all.extend_from_slice(if quiet { &["-q"] } else { &[] });
            delotet(&all, &dir)
        };
        let lines = error_lines(&with(false));
        let found = lines.iter().filter(|line| line.starts_with("warning: ") && line.contains(said)).count();
        assert_eq!(found, 1, "{arguments:?}: {lines:?}");
        let quiet = with(true);
        assert!(
            quiet.status.success() && quiet.stderr.is_empty() && quiet.stdout.is_empty(),
            "{arguments:?}"
        );
    }
    let fine =
        delotet(&["mesh", "rooms.poly", "-o", "m.vtu", "--subfaces", "--compress", "--quality-data"], &dir);
    assert!(fine.status.success() && fine.stderr.is_empty(), "{:?}", error_lines(&fine));
    let mesh = delotet(&["mesh", "cube.off", "-o", "m.mesh", "--second-order"], &dir);
    assert_eq!(mesh.status.code(), Some(2));
    assert!(error_lines(&mesh)[0].contains("second-order tetrahedra have no common form in .mesh"));
    let convert = delotet(&["convert", "marked.node", "-o", "m.off"], &dir);
    assert!(convert.status.success() && error_lines(&convert)[0].contains("cannot be stored"));
}

#[test]
fn options_of_the_writers() {
    let dir = folder("options");
    let names = ["--region-name", "10=left room", "--region-name", "20=right"];
    let run = |arguments: &[&str]| {
        let mut all = vec!["mesh", "rooms.poly", "-o"];
        all.extend_from_slice(arguments);
        all.extend_from_slice(&names);
        let output = delotet(&all, &dir);
        assert!(output.status.success() && output.stderr.is_empty(), "{:?}", error_lines(&output));
        text(dir.join(arguments[0]))
    };
    let legacy = run(&["m.msh", "--msh-version", "2.2", "--second-order"]);
    assert!(
        legacy.starts_with("$MeshFormat\n2.2 0 8\n")
            && legacy.contains("3 10 \"left room\"\n3 20 \"right\"\n")
    );
    assert!(legacy.lines().any(|line| line.contains(" 11 2 10 ")));
    assert!(run(&["n.msh"]).starts_with("$MeshFormat\n4.1 0 8\n"));
    assert!(run(&["m.inp", "--second-order"]).contains("*ELEMENT, TYPE=C3D10, ELSET=LEFT_ROOM\n"));
    // Names of markers come from the surface.
    assert!(delotet(&["mesh", "cube.off", "-o", "c.inp", "-q"], &dir).status.success());
    assert!(text(dir.join("c.inp")).contains("*SURFACE, NAME=BOTTOM, TYPE=ELEMENT\n"));
    for bad in ["left", "=left", "x=left", "1="] {
        assert_eq!(
            delotet(&["mesh", "cube.off", "-o", "c.inp", "--region-name", bad], &dir).status.code(),
            Some(2)
        );
    }
}

/// The total that CalculiX prints under a heading: the last number of the first line of numbers after it.
fn total(dat: &str, heading: &str) -> Vec<f64> {
    let (_, rest) = dat.split_once(heading).unwrap_or_else(|| panic!("{heading} in {dat}"));
    let numbers =
        |line: &str| line.split_whitespace().filter_map(|word| word.parse().ok()).collect::<Vec<f64>>();
    rest.lines().skip(1).map(numbers).find(|found| !found.is_empty()).expect("numbers")
}

#[test]
fn calculix_reads_decks_and_finds_volume_and_forces() {
    if Command::new("ccx").arg("-v").output().is_err() {
        println!("not run: CalculiX (ccx) is not installed");
        return;
    }
    let dir = folder("calculix");
    for second_order in [false, true] {
        let mut arguments = vec!["mesh", "rooms.poly", "-o", "mesh.inp", "-q"];
        arguments.extend_from_slice(if second_order { &["--second-order"] } else { &[] });
        assert!(delotet(&arguments, &dir).status.success());
        // Held at x = 0 (marker 1), under a pressure of 3 at x = 2 (marker 2): the force there is 3 along -x.
        let deck = "*INCLUDE, INPUT=mesh.inp\n*MATERIAL, NAME=M\n*ELASTIC\n1000, 0\n\
            *SOLID SECTION, ELSET=REGION_10, MATERIAL=M\n*SOLID SECTION, ELSET=REGION_20, MATERIAL=M\n\
            *BOUNDARY\nMARKER_1, 1, 3\n*STEP\n*STATIC\n*DSLOAD\nMARKER_2, P, 3\n\
            *NODE PRINT, NSET=MARKER_1, TOTALS=ONLY\nRF\n*EL PRINT, ELSET=ALL, TOTALS=ONLY\nEVOL\n\
            *EL PRINT, ELSET=REGION_20, TOTALS=ONLY\nEVOL\n*NODE PRINT, NSET=MARKER_7\nU\n*END STEP\n";
        std::fs::write(dir.join("deck.inp"), deck).unwrap();
        let output = Command::new("ccx").args(["-i", "deck"]).current_dir(&dir).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
        let dat = text(dir.join("deck.dat"));
        let forces = total(&dat, "total force (fx,fy,fz) for set MARKER_1");
        for (found, expected) in forces.iter().zip([3.0, 0.0, 0.0]) {
            assert!((found - expected).abs() < 1e-5, "{forces:?}");
        }
        let volume = |set: &str| total(&dat, &format!("total volume for set {set}"))[0];
        assert!((volume("ALL") - 2.0).abs() < 1e-5 && (volume("REGION_20") - 1.0).abs() < 1e-5, "{dat}");
        // Without lateral contraction the bar is under plain pressure: the wall moves by 3 / 1000.
        let moved = total(&dat, "displacements (vx,vy,vz) for set MARKER_7");
        assert!((moved[1] + 0.003).abs() < 1e-8, "{moved:?}");
    }
}

#[test]
fn meshio_reads_every_format() {
    let python = |script: &str, dir: &Path| {
        Command::new("python3").args(["-c", script]).current_dir(dir).output().map(|output| {
            (
                output.status.success(),
                format!("{}{}", String::from_utf8_lossy(&output.stdout), error_lines(&output).join("\n")),
            )
        })
    };
    let dir = folder("meshio");
    if !python("import meshio", &dir).is_ok_and(|(found, _)| found) {
        println!("not run: meshio is not installed for python3");
        return;
    }
    for (name, arguments, kind) in [
        ("m.vtu", &[][..], "tetra"),
        ("n.vtu", &["--second-order", "--compress"], "tetra10"),
        ("m.vtk", &[], "tetra"),
        ("n.vtk", &["--second-order"], "tetra10"),
        ("m.msh", &[], "tetra"),
        ("n.msh", &["--second-order"], "tetra10"),
        ("o.msh", &["--msh-version", "2.2"], "tetra"),
        ("p.msh", &["--msh-version", "2.2", "--second-order"], "tetra10"),
        ("m.inp", &[], "tetra"),
        ("n.inp", &["--second-order"], "tetra10"),
        ("m.mesh", &[], "tetra"),
    ] {
        let mut all = vec!["mesh", "rooms.poly", "-q", "-o", name];
        all.extend_from_slice(arguments);
        assert!(delotet(&all, &dir).status.success());
        // The volume from the corners, and every mid-edge node at the midpoint of its edge.
        let script = format!(
            "
import numpy, meshio
mesh = meshio.read('{name}')
tets = numpy.vstack([block.data for block in mesh.cells if block.type == '{kind}'])
assert not any(block.type.startswith('tetra') and block.type != '{kind}' for block in mesh.cells)
p = mesh.points[tets[:, :4]]
volume = numpy.linalg.det(p[:, 1:] - p[:, :1]) / 6
assert volume.min() > 0 and abs(volume.sum() - 2) < 1e-12, volume
if '{kind}' == 'tetra10':
    for k, (a, b) in enumerate([(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]):
        middle = (p[:, a] + p[:, b]) / 2
        assert numpy.abs(mesh.points[tets[:, 4 + k]] - middle).max() < 1e-12, k
# What meshio makes of legacy VTK and of Gmsh's tags has two dimensions in any case.
for data in [] if not '{name}'.endswith('.vtu') else list(mesh.point_data.values()) + [d for ds in mesh.cell_data.values() for d in ds]:
    assert data.ndim == 1, data.shape
if '{name}'.endswith('.vtu') or '{name}'.endswith('.vtk'):
    assert set(numpy.concatenate(mesh.cell_data['region']).flat) == {{10, 20}}
"
        );
        let (fine, said) = python(&script, &dir).unwrap();
        assert!(fine, "{name}: {said}");
    }
}
