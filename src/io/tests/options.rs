//! Options of the mesh writers: second order, versions, names, decks; and what formats lose.
use crate::error::Element;
use crate::io::tests::meshes::{small_mesh, vtu_arrays};
use crate::io::tests::Folder;
use crate::io::*;
use crate::warning::WarningKind;
use crate::{Plc, TetMesh};

/// Writes a mesh and returns the text of the file.
fn written(name: &str, options: &WriteOptions) -> String {
    let folder = Folder::new(&format!("options-{name}"));
    let (mesh, plc) = small_mesh();
    write(&folder.file(name), &mesh, &plc, options).unwrap();
    std::fs::read_to_string(folder.file(name)).unwrap()
}

fn second_order() -> WriteOptions {
    WriteOptions { second_order: true, ..WriteOptions::default() }
}

const DECK: &str = "*HEADING\ndelotet: points, tetrahedra and their sets\n*NODE, NSET=ALL\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 0.1, 0\n\
    4, 0, 0, 1e-310\n5, 0.3333333333333333, -0, -1\n*ELEMENT, TYPE=C3D4, ELSET=REGION_1\n1, 1, 2, 3, 4\n\
    *ELEMENT, TYPE=C3D4, ELSET=REGION_3\n2, 1, 3, 2, 5\n*ELSET, ELSET=ALL, GENERATE\n1, 2, 1\n*NSET, NSET=MARKER_MINUS_4\n1, 2, 3\n\
    *SURFACE, NAME=MARKER_MINUS_4, TYPE=ELEMENT\n2, S1\n*NSET, NSET=MARKER_6\n1, 2, 4\n\
    *SURFACE, NAME=MARKER_6, TYPE=ELEMENT\n1, S2\n*NSET, NSET=SEGMENT_8\n1, 5\n";

#[test]
fn inp_to_the_letter() {
    assert_eq!(written("m.inp", &WriteOptions::default()), DECK);
    let second = written("m.inp", &second_order());
    assert!(second.contains("\n6, 0.5, 0, 0\n7, 0, 0.05, 0\n8, 0, 0, 5e-311\n"));
    assert!(second.contains("*ELEMENT, TYPE=C3D10, ELSET=REGION_1\n1, 1, 2, 3, 4, 6, 10, 7, 8, 11, 13\n"));
    assert!(second.contains("*ELEMENT, TYPE=C3D10, ELSET=REGION_3\n2, 1, 3, 2, 5, 7, 10, 6, 9, 14, 12\n"));
    assert!(second.contains("*NSET, NSET=MARKER_MINUS_4\n1, 2, 3, 6, 7, 10\n"));
    assert!(second.contains("*NSET, NSET=SEGMENT_8\n1, 5, 9\n"));
}

#[test]
fn msh_2_2_to_the_letter() {
    let options = WriteOptions { msh_version: MshVersion::V22, ..WriteOptions::default() };
    let expected = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 8 \"marker 8\"\n2 1 \"marker -4\"\n2 6 \"marker 6\"\n\
        3 1 \"region 2.5\"\n3 3 \"region 3\"\n$EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 0.1 0\n4 0 0 1e-310\n\
        5 0.3333333333333333 -0 -1\n$EndNodes\n$Elements\n5\n1 1 2 8 1 1 5\n2 2 2 1 1 1 2 3\n3 2 2 6 2 1 2 4\n\
        4 4 2 1 1 1 2 3 4\n5 4 2 3 2 1 3 2 5\n$EndElements\n";
    assert_eq!(written("m.msh", &options), expected);
    let second = written("m.msh", &WriteOptions { second_order: true, ..options });
    let elements = "$Elements\n5\n1 8 2 8 1 1 5 9\n2 9 2 1 1 1 2 3 6 10 7\n3 9 2 6 2 1 2 4 6 11 8\n\
        4 11 2 1 1 1 2 3 4 6 10 7 8 13 11\n5 11 2 3 2 1 3 2 5 7 10 6 9 12 14\n$EndElements\n";
    assert!(second.ends_with(elements), "{second}");
    assert!(written("m.msh", &second_order()).contains("\n3 1 11 1\n4 1 2 3 4 6 10 7 8 13 11\n"));
}

#[test]
fn tetgen_second_order_has_the_order_of_tetgen() {
    let folder = Folder::new("ele-second");
    let (mesh, plc) = small_mesh();
    write(&folder.file("m.ele"), &mesh, &plc, &second_order()).unwrap();
    let text = |name: &str| std::fs::read_to_string(folder.file(name)).unwrap();
    assert_eq!(text("m.ele"), "2  10  1\n0 0 1 2 3 12 7 5 9 10 6 2.5\n1 0 2 1 4 11 8 6 9 13 5 3\n");
    assert_eq!(text("m.face"), "2  1\n0 0 1 2 5 9 6 -4\n1 0 1 3 5 10 7 6\n");
    assert_eq!(text("m.edge"), "2  1\n0 0 4 8 8\n1 0 1 5 0\n");
    let node = text("m.node");
    // Attributes at midpoints are means; a piece of a segment has its marker.
    assert_eq!(node.lines().next(), Some("14  3  1  1"));
    assert_eq!(node.lines().nth(6), Some("5 0.5 0 0 2 0"));
    assert_eq!(node.lines().nth(9), Some("8 0.16666666666666666 0 -0.5 1.25 8"));
}

#[test]
fn tetgen_second_order_is_read_back_without_the_middles() {
    let folder = Folder::new("ele-second-read");
    let (mesh, plc) = small_mesh();
    write(&folder.file("a.ele"), &mesh, &plc, &WriteOptions::default()).unwrap();
    write(&folder.file("b.ele"), &mesh, &plc, &second_order()).unwrap();
    assert_eq!(read_mesh(&folder.file("b.ele")), read_mesh(&folder.file("a.ele")));
    let change = |suffix: &str, from: &str, to: &str| {
        for name in ["ele", "node", "face", "parents"] {
            std::fs::copy(folder.file(&format!("b.{name}")), folder.file(&format!("c.{name}"))).unwrap();
        }
        let file = folder.file(&format!("c.{suffix}"));
        let text = std::fs::read_to_string(&file).unwrap();
        assert!(text.contains(from), "{text}");
        std::fs::write(&file, text.replacen(from, to, 1)).unwrap();
        read_mesh(&folder.file("c.ele")).unwrap_err()
    };
    for (suffix, from, to, said) in [
        ("node", "\n5 0.5 0 0", "\n5 0.5 0.01 0", "node 5 is not in the middle of the straight edge"),
        ("node", "\n5 0.5 0 0", "\n5 inf 0 0", "node 5 is not in the middle of the straight edge"),
        ("ele", " 12 7 5 9", " 12 7 5 8", "node 8 is in the middle of two edges"),
        ("ele", " 12 7 5 9", " 12 7 5 2", "not behind all points"),
        ("ele", "9 10 6 2.5", "9 10 12 2.5", "node 12 is in the middle of two edges"),
    ] {
        let error = change(suffix, from, to);
        assert_eq!(error.status, Status::Unsupported, "{from} to {to}: {error}");
        assert!(error.message.contains(said), "{from} to {to}: {error}");
    }
    for (suffix, from, to) in [
        ("ele", " 12 7 5 9", " 14 7 5 9"),
        ("ele", " 12 7 5 9", " -1 7 5 9"),
        ("face", "0 0 1 2 5", "0 0 1 2 14"),
        ("face", "0 0 1 2 5", "0 0 1 2 4"),
        ("face", "0 0 1 2 5", "0 0 1 5 5"),
    ] {
        assert_eq!(change(suffix, from, to).status, Status::IndexOutOfRange, "{from} to {to}");
    }
}

#[test]
fn vtk_formats_in_second_order() {
    let folder = Folder::new("vtk-second");
    let (mesh, plc) = small_mesh();
    let options = WriteOptions { subfaces: true, ..second_order() };
    write(&folder.file("m.vtu"), &mesh, &plc, &options).unwrap();
    let words = |bytes: &[u8]| -> Vec<u32> {
        bytes.chunks_exact(4).map(|w| u32::from_le_bytes(w.try_into().unwrap())).collect()
    };
    let cells = [0, 1, 2, 3, 5, 9, 6, 7, 10, 12, 0, 2, 1, 4, 6, 9, 5, 8, 13, 11];
    let arrays = vtu_arrays(&std::fs::read(folder.file("m.vtu")).unwrap());
    assert_eq!(words(&arrays["connectivity"]), cells);
    assert_eq!(words(&arrays["offsets"]), [10, 20]);
    assert_eq!(arrays["types"], [24, 24]);
    assert_eq!(arrays["steiner"].len(), 14);
    let faces = vtu_arrays(&std::fs::read(folder.file("m_subfaces.vtu")).unwrap());
    assert_eq!((&faces["types"][..], words(&faces["offsets"])), (&[22, 22][..], vec![6, 12]));
    assert_eq!(words(&faces["point"]), [0, 1, 2, 5, 9, 6, 3, 10, 7]);
    write(&folder.file("m.vtk"), &mesh, &plc, &options).unwrap();
    let bytes = std::fs::read(folder.file("m.vtk")).unwrap();
    let at = bytes.windows(11).position(|w| w == b"CELLS 2 22\n").unwrap() + 11;
    let big: Vec<u32> =
        bytes[at..at + 88].chunks_exact(4).map(|w| u32::from_be_bytes(w.try_into().unwrap())).collect();
    assert_eq!((big[0], &big[1..11], big[11], &big[12..]), (10, &cells[..10], 10, &cells[10..]));
    for name in ["POINT_DATA 14", "SCALARS attribute_0 double\n", "SCALARS marker int\n"] {
        assert!(bytes.windows(name.len()).any(|w| w == name.as_bytes()), "{name}");
    }
}

#[test]
fn scalars_of_vtu_do_not_count_their_components() {
    let folder = Folder::new("components");
    let (mesh, plc) = small_mesh();
    write(&folder.file("m.vtu"), &mesh, &plc, &WriteOptions::default()).unwrap();
    let bytes = std::fs::read(folder.file("m.vtu")).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    let counted: Vec<&str> = text.lines().filter(|line| line.contains("NumberOfComponents")).collect();
    assert_eq!(counted.len(), 1);
    assert!(counted[0].contains("Name=\"Points\" NumberOfComponents=\"3\""));
}

#[test]
fn names_of_regions_and_markers_name_groups() {
    let folder = Folder::new("group-names");
    let (mesh, mut plc) = small_mesh();
    plc.set_marker_name(6, "top \"lid\"").unwrap();
    plc.set_marker_name(-4, "größe").unwrap();
    let name = |attribute, name: &str| RegionName { attribute, name: name.to_string() };
    let region_names = vec![name(3.0, "steel part"), name(2.5, "7 up"), name(9.0, "absent")];
    let options = WriteOptions { region_names, ..WriteOptions::default() };
    write(&folder.file("m.msh"), &mesh, &plc, &options).unwrap();
    let names = "1 8 \"marker 8\"\n2 1 \"größe\"\n2 6 \"top 'lid'\"\n3 1 \"7 up\"\n3 3 \"steel part\"\n";
    assert!(std::fs::read_to_string(folder.file("m.msh")).unwrap().contains(names));
    write(&folder.file("m.inp"), &mesh, &plc, &options).unwrap();
    let deck = std::fs::read_to_string(folder.file("m.inp")).unwrap();
    for set in ["ELSET=G_7_UP", "ELSET=STEEL_PART", "NSET=GR__E", "NAME=TOP__LID_", "NSET=SEGMENT_8"] {
        assert!(deck.contains(&format!("{set}\n")) || deck.contains(&format!("{set}, ")), "{set}");
    }
    // Equal labels are made distinct.
    plc.set_marker_name(-4, "top (lid)").unwrap();
    write(&folder.file("m.inp"), &mesh, &plc, &options).unwrap();
    let deck = std::fs::read_to_string(folder.file("m.inp")).unwrap();
    assert!(deck.contains("NSET=TOP__LID_\n") && deck.contains("NSET=TOP__LID__2\n"), "{deck}");
}

#[test]
fn coordinates_of_a_deck_fit_twenty_characters() {
    let folder = Folder::new("fields");
    let (mut mesh, plc) = small_mesh();
    mesh.points[1] = [-1.234_567_890_123_456_7e-300, f64::MAX, -1.0 / 3.0];
    mesh.points[2] = [1e22, -123_456_789.123_456_79, 5e-324];
    let warnings = write(&folder.file("m.inp"), &mesh, &plc, &WriteOptions::default()).unwrap();
    let deck = std::fs::read_to_string(folder.file("m.inp")).unwrap();
    for (line, point) in deck.lines().skip(3).zip(&mesh.points) {
        for (field, x) in line.split(", ").skip(1).zip(point) {
            let read: f64 = field.parse().unwrap();
            assert!(field.len() <= 20, "{field}");
            assert!(read == *x || ((read - x) / x).abs() < 1e-11, "{field} for {x}");
        }
    }
    let rounded: Vec<_> = warnings.of(WarningKind::LostValue).map(|w| w.first).collect();
    assert!(rounded.contains(&Element::Point(1)) && !rounded.contains(&Element::Point(2)), "{rounded:?}");
}

#[test]
fn what_a_format_cannot_hold_is_a_warning() {
    let folder = Folder::new("lost");
    let (mesh, plc) = small_mesh();
    let lost = |name: &str, mesh: &TetMesh, plc: &Plc| -> Vec<Element> {
        let warnings = write(&folder.file(name), mesh, plc, &WriteOptions::default()).unwrap();
        assert_eq!(warnings.total(), warnings.count(WarningKind::LostValue));
        warnings.list().iter().map(|w| w.first).collect()
    };
    let (facet, region, point) = (Element::Facet(0), Element::Region(0), Element::Point(0));
    assert_eq!(lost("m.msh", &mesh, &plc), [facet, region, point, point]);
    assert_eq!(lost("m.inp", &mesh, &plc), [facet, region, point, point]);
    assert_eq!(lost("m.mesh", &mesh, &plc), [region, point]);
    for name in ["m.vtu", "m.vtk", "m.ele"] {
        assert_eq!(lost(name, &mesh, &plc), []);
    }
    // Marker 0 next to others is a group with another tag; alone it means that nothing is marked.
    let mut marked = mesh.clone();
    marked.regions[0].attribute = 2.0;
    marked.subfaces[0].marker = 0;
    assert_eq!(lost("m.msh", &marked, &Plc::default()), [facet]);
    marked.subfaces[1].marker = 0;
    assert_eq!(lost("m.msh", &marked, &Plc::default()), []);
}

#[test]
fn options_without_effect_and_impossible_ones_are_known_before_meshing() {
    let name = RegionName { attribute: 1.0, name: "a".to_string() };
    let all = WriteOptions {
        compress: true,
        subfaces: true,
        quality_data: true,
        msh_version: MshVersion::V22,
        region_names: vec![name],
        ..WriteOptions::default()
    };
    use UnusedOption::{Compress, QualityData, RegionNames, Subfaces};
    const MSH: UnusedOption = UnusedOption::MshVersion;
    let unused = |options: &WriteOptions, format| options.unused(format).collect::<Vec<_>>();
    assert_eq!(unused(&all, Format::Vtu), [MSH, RegionNames]);
    assert_eq!(unused(&all, Format::Msh), [Compress, Subfaces, QualityData]);
    assert_eq!(unused(&all, Format::Inp), [Compress, Subfaces, QualityData, MSH]);
    assert_eq!(unused(&WriteOptions::default(), Format::Vtk), []);
    assert_eq!(unused(&second_order(), Format::Vtk), []);
    let surface = WriteOptions { second_order: true, ..all.clone() };
    let none = [Compress, Subfaces, QualityData, UnusedOption::SecondOrder, MSH, RegionNames];
    assert_eq!(unused(&surface, Format::Poly), none);
    let check = |options: &WriteOptions, name: &str| options.check(Path::new(name)).map_err(|e| e.status);
    assert_eq!(check(&second_order(), "m.mesh"), Err(Status::Unsupported));
    assert_eq!(check(&all, "m.off"), Err(Status::Unsupported));
    assert_eq!(check(&second_order(), "m.inp"), Ok(()));
    // A mesh whose subface is no face has no midpoints for its edges.
    let folder = Folder::new("contradiction");
    let (mut mesh, plc) = small_mesh();
    mesh.subfaces[0].corners = [2, 3, 4];
    let error = write(&folder.file("m.msh"), &mesh, &plc, &second_order()).unwrap_err();
    assert_eq!(error.status, Status::InvalidArgument);
    mesh.tets[0][0] = 99;
    let error = write(&folder.file("m.msh"), &mesh, &plc, &second_order()).unwrap_err();
    assert_eq!(error.status, Status::IndexOutOfRange);
    assert!(folder.names().is_empty());
}
