//! Meshes are written, read and are the same; damaged files are refused with the line.
use crate::io::tests::Folder;
use crate::io::*;
use crate::plc::{RegionSeed, Segment};
use crate::{mesh_from_arrays, tetrahedralize, Mode, Options, Silent};

/// Two boxes side by side with attributes and markers that all formats can hold, a segment inside, and a Steiner point or two.
fn model() -> (TetMesh, Plc) {
    let mut plc = Plc { point_attribute_count: 2, ..Plc::default() };
    for x in [0.0, 1.0, 2.1] {
        plc.points.extend([[x, 0.0, 0.0], [x, 1.0, 0.0], [x, 1.0, 1.0 / 3.0], [x, 0.0, 1.0 / 3.0]]);
    }
    plc.points.extend([[0.3, 0.4, 0.1], [0.6, 0.5, 0.2]]);
    for x in [0u32, 4, 8] {
        for corners in [[0, 1, 2], [0, 2, 3]] {
            plc.triangles.push(corners.map(|v| v + x));
            plc.triangle_markers.push(1 + x as i32);
        }
    }
    for x in [0u32, 4] {
        for k in 0..4 {
            let (a, b) = (x + k, x + (k + 1) % 4);
            for corners in [[a, b, b + 4], [a, b + 4, a + 4]] {
                plc.triangles.push(corners);
                plc.triangle_markers.push(7);
            }
        }
    }
    plc.segments.push(Segment { ends: [12, 13], marker: 5 });
    for (x, attribute) in [(0.5, 2.0), (1.5, 9.0)] {
        plc.regions.push(RegionSeed { point: [x, 0.5, 0.1], attribute, max_volume: None });
    }
    plc.point_markers = (1..=14).collect();
    plc.point_attributes = (0..28).map(|i| f64::from(i) / 7.0).collect();
    let options = Options { mode: Mode::Preserve, quality: Some(1.5), ..Options::default() };
    let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
    assert!(!mesh.steiner.is_empty());
    (mesh, plc)
}

/// Elements of a mesh without the order in which files have them.
fn content(mesh: &TetMesh) -> impl PartialEq + std::fmt::Debug {
    let sorted = |corners: &[u32]| {
        let mut corners = corners.to_vec();
        corners.sort_unstable();
        corners
    };
    let mut tets: Vec<_> = mesh
        .tets
        .iter()
        .zip(&mesh.tet_region)
        .map(|(tet, &region)| (sorted(tet), mesh.regions[region as usize].attribute.to_bits()))
        .collect();
    let mut faces: Vec<_> = mesh.subfaces.iter().map(|face| (sorted(&face.corners), face.marker)).collect();
    tets.sort();
    faces.sort();
    let bits: Vec<_> = mesh.points.iter().map(|p| p.map(f64::to_bits)).collect();
    (bits, tets, faces)
}

fn segments(mesh: &TetMesh) -> Vec<([u32; 2], i32)> {
    let key = |ends: [u32; 2]| [ends[0].min(ends[1]), ends[0].max(ends[1])];
    let marked = mesh.subsegments.iter().filter(|edge| edge.marker != 0);
    let mut list: Vec<_> = marked.map(|edge| (key(edge.ends), edge.marker)).collect();
    list.sort();
    list
}

fn made(file: &MeshFile) -> TetMesh {
    mesh_from_arrays(file.arrays.clone(), 100).unwrap_or_else(|e| panic!("{e}: {:?}", e.defects))
}

#[test]
fn what_is_written_is_read_again() {
    let folder = Folder::new("given");
    let (mesh, plc) = model();
    let options = || WriteOptions { subfaces: true, ..WriteOptions::default() };
    let variants = [
        ("a.ele", options(), true, true),
        ("b.ele", WriteOptions { second_order: true, ..options() }, true, true),
        ("a.mesh", options(), true, true),
        ("a.msh", options(), true, false),
        ("b.msh", WriteOptions { second_order: true, ..options() }, true, false),
        ("c.msh", WriteOptions { msh_version: MshVersion::V22, ..options() }, true, false),
        (
            "d.msh",
            WriteOptions { msh_version: MshVersion::V22, second_order: true, ..options() },
            true,
            false,
        ),
        ("a.vtu", options(), false, true),
        ("b.vtu", WriteOptions { compress: true, ..options() }, false, true),
        ("c.vtu", WriteOptions { compress: true, quality_data: true, ..options() }, false, true),
        ("d.vtu", WriteOptions { second_order: true, ..options() }, false, true),
    ];
    for (name, options, has_segments, has_markers) in variants {
        let path = folder.file(name);
        write(&path, &mesh, &plc, &options).unwrap();
        let file = read_arrays(&path).unwrap_or_else(|e| panic!("{name}: {e}"));
        let again = made(&file);
        assert!(content(&again) == content(&mesh), "{name}");
        if has_segments {
            assert_eq!(segments(&again), segments(&mesh), "{name}");
        }
        if has_markers {
            assert_eq!(file.markers[..14], plc.point_markers, "{name}");
            assert_eq!(file.markers.len(), mesh.points.len(), "{name}");
        }
        if name.ends_with("ele") || name.ends_with("vtu") {
            assert_eq!(
                (file.attribute_count, &file.attributes[..28]),
                (2, &plc.point_attributes[..]),
                "{name}"
            );
            assert_eq!(file.attributes.len(), 2 * mesh.points.len(), "{name}");
        }
        for source in array_sources(&path).unwrap() {
            assert!(source.exists(), "{name}");
        }
    }
}

#[test]
fn without_their_companions() {
    let folder = Folder::new("given-alone");
    let (mesh, plc) = model();
    write(&folder.file("a.ele"), &mesh, &plc, &WriteOptions::default()).unwrap();
    write(&folder.file("a.vtu"), &mesh, &plc, &WriteOptions::default()).unwrap();
    for name in ["a.face", "a.edge"] {
        std::fs::remove_file(folder.file(name)).unwrap();
    }
    for name in ["a.ele", "a.vtu"] {
        let again = made(&read_arrays(&folder.file(name)).unwrap());
        assert_eq!(again.tets, mesh.tets);
        assert_eq!(again.subfaces.len(), mesh.subfaces.len(), "boundary and wall are found");
        assert!(again.subfaces.iter().all(|face| face.marker == 0) && again.subsegments.is_empty());
    }
}

/// A grid as other programs write it: text, several types of cells.
const TEXT_GRID: &str = "<?xml version='1.0'?>
<VTKFile type='UnstructuredGrid' version='0.1'>
<UnstructuredGrid><Piece NumberOfPoints='4' NumberOfCells='3'>
<CellData><DataArray type='Int32' Name='marker' format='ascii'>4 0 6</DataArray></CellData>
<Points><DataArray type='Float32' NumberOfComponents='3' format='ascii'>0 0 0  1 0 0
0 1 0  0 0 1</DataArray></Points>
<Cells><DataArray type='Int64' Name='connectivity' format='ascii'>0 1 2  0 1 2 3  2 3</DataArray>
<DataArray type='Int64' Name='offsets' format='ascii'>3 7 9</DataArray>
<DataArray type='UInt8' Name='types' format='ascii'>5 10 3</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>";

const MEDIT: &str = "MeshVersionFormatted 1
Dimension
3
Vertices 4
0 0 0 1  1 0 0 0
0 1 0 0 0 0 1 0
Corners 1 2
RequiredEdges
1
1
Triangles 1
1 2 3 4
Edges 1 3 4 6
Tetrahedra 1
1 2 3 4 8
End
";

const MSH: &str = "$MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 1 1 1
5 0 0 0 0 1 1 1 6 2 1 2
7 0 0 0 1 1 0 1 4 0
9 0 0 0 1 1 1 0 0
$EndEntities
$Nodes
2 4 10 40
0 1 0 1
10
0 0 0
2 7 1 3
20
30
40
1 0 0 0.5 0.5
0 1 0 0.1 0.2
0 0 1 0.2 0.2
$EndNodes
$Elements
4 4 1 4
0 1 15 1
1 10
1 5 1 1
2 30 40
2 7 2 1
3 10 20 30
3 9 4 1
4 10 20 30 40
$EndElements
";

#[test]
fn files_of_other_programs() {
    let folder = Folder::new("given-others");
    for (name, text, attribute) in [("t.vtu", TEXT_GRID, 1.0), ("t.mesh", MEDIT, 8.0), ("t.msh", MSH, 9.0)] {
        std::fs::write(folder.file(name), text).unwrap();
        let file = read_arrays(&folder.file(name)).unwrap_or_else(|e| panic!("{e}"));
        let mesh = made(&file);
        assert_eq!((&mesh.points[3], &mesh.tets[..]), (&[0.0, 0.0, 1.0], &[[0, 1, 2, 3]][..]), "{name}");
        assert_eq!((mesh.subfaces.len(), mesh.subfaces[0].marker), (4, 4), "{name}");
        assert_eq!((mesh.subsegments[0].ends, mesh.subsegments[0].marker), ([2, 3], 6), "{name}");
        assert_eq!(mesh.regions[0].attribute, attribute, "{name}");
    }
}

/// What is wrong, and what the message must contain.
#[test]
fn damaged_files_are_refused() {
    let folder = Folder::new("given-damaged");
    let cases: &[(&str, &str, &str, &str, Status, &str)] = &[
        (
            "m.mesh",
            MEDIT,
            "MeshVersionFormatted 1",
            "Mesh 1",
            Status::Format,
            "line 1: 'MeshVersionFormatted'",
        ),
        ("m.mesh", MEDIT, "\n3\n", "\n2\n", Status::Format, "line 3: the dimension is 2"),
        ("m.mesh", MEDIT, "Vertices 4", "Vertices 4000", Status::Format, "line 4: 4000 is more"),
        ("m.mesh", MEDIT, "0 1 0 0 0 0 1 0", "0 1 x 0 0 0 1 0", Status::Format, "line 6: coordinate z"),
        ("m.mesh", MEDIT, "1 2 3 4 8", "1 2 3 5 8", Status::IndexOutOfRange, "line 15: there is no node 5"),
        ("m.mesh", MEDIT, "1 2 3 4 8", "1 2 3 0 8", Status::IndexOutOfRange, "line 15: there is no node 0"),
        ("m.mesh", MEDIT, "1 2 3 4 8", "1 2 3 4 9999999999", Status::Format, "does not fit 32 bits"),
        ("m.mesh", MEDIT, "Tetrahedra", "Hexahedra", Status::Unsupported, "line 14: only tetrahedra"),
        ("m.mesh", MEDIT, "Tetrahedra 1\n1 2 3 4 8\n", "", Status::Format, "no tetrahedra"),
        ("m.mesh", MEDIT, MEDIT, "", Status::Format, "the file is empty"),
        ("m.mesh", MEDIT, MEDIT, "OFF\n0 0 0", Status::Format, "it is an OFF file"),
        ("m.msh", MSH, "4.1 0 8", "4.1 1 8", Status::Unsupported, "line 2: binary"),
        ("m.msh", MSH, "4.1 0 8", "3 0 8", Status::Unsupported, "line 2: this version"),
        ("m.msh", MSH, "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n", "", Status::Format, "line 1: '$MeshFormat'"),
        ("m.msh", MSH, "\n30\n", "\n20\n", Status::Format, "node 20 comes twice"),
        (
            "m.msh",
            MSH,
            "4 10 20 30 40",
            "4 10 20 30 41",
            Status::IndexOutOfRange,
            "line 32: there is no node 41",
        ),
        ("m.msh", MSH, "4 10 20 30 40", "4 10 20 30", Status::Format, "line 32: the line ends"),
        ("m.msh", MSH, "3 9 4 1", "3 9 5 1", Status::Unsupported, "line 31: elements of type 5"),
        ("m.msh", MSH, "3 9 4 1", "3 9 4 2", Status::Format, "line 33"),
        ("m.msh", MSH, "3 9 4 1\n", "3 9 4 0\n", Status::Format, "where section '$Elements' should end"),
        ("m.msh", MSH, "$EndElements\n", "", Status::Format, "section '$Elements' does not end"),
        ("m.msh", MSH, "4 4 1 4", "99999 4 1 4", Status::Format, "more than the rest of the file"),
        ("m.vtu", TEXT_GRID, "VTKFile type", "VTUFile type", Status::Format, "'<VTKFile' expected"),
        (
            "m.vtu",
            TEXT_GRID,
            "'UnstructuredGrid'",
            "'PolyData'",
            Status::Unsupported,
            "line 2: only unstructured",
        ),
        ("m.vtu", TEXT_GRID, "version='0.1'", "byte_order='BigEndian'", Status::Unsupported, "little endian"),
        (
            "m.vtu",
            TEXT_GRID,
            "version='0.1'",
            "compressor='vtkLZ4DataCompressor'",
            Status::Unsupported,
            "zlib",
        ),
        (
            "m.vtu",
            TEXT_GRID,
            "NumberOfPoints='4'",
            "NumberOfPoints='5'",
            Status::Format,
            "line 5: array '' has 12 numbers instead of 15",
        ),
        ("m.vtu", TEXT_GRID, "NumberOfPoints='4'", "", Status::Format, "without a number NumberOfPoints"),
        (
            "m.vtu",
            TEXT_GRID,
            "0 1 2 3  2 3",
            "0 1 2 4  2 3",
            Status::IndexOutOfRange,
            "line 7: cell 1 has node 4",
        ),
        ("m.vtu", TEXT_GRID, "3 7 9", "3 8 9", Status::Format, "line 8: the offset of cell 1"),
        ("m.vtu", TEXT_GRID, "5 10 3", "5 12 3", Status::Unsupported, "line 9: cells of other types"),
        ("m.vtu", TEXT_GRID, "5 10 3", "5 10 x", Status::Format, "line 9: a number expected"),
        (
            "m.vtu",
            TEXT_GRID,
            "Name='types' format='ascii'",
            "Name='types' format='binary'",
            Status::Unsupported,
            "line 9: arrays in base64",
        ),
        (
            "m.vtu",
            TEXT_GRID,
            "Name='types' format='ascii'",
            "Name='types' format='appended' offset='0'",
            Status::Format,
            "line 9: the data",
        ),
        (
            "m.vtu",
            TEXT_GRID,
            "'Int64' Name='offsets'",
            "'String' Name='offsets'",
            Status::Unsupported,
            "line 8: an array of a type",
        ),
        ("m.vtu", TEXT_GRID, "<Piece", "<Price", Status::Format, "no <Piece>"),
        ("m.vtk", "# vtk DataFile", "#", "#", Status::Unsupported, "meshes are read from"),
        ("m.off", "OFF", "OFF", "OFF", Status::Unsupported, "meshes are read from"),
    ];
    for &(name, text, from, to, status, message) in cases {
        assert!(text.contains(from), "{from}");
        std::fs::write(folder.file(name), text.replacen(from, to, 1)).unwrap();
        let error = read_arrays(&folder.file(name)).expect_err(to);
        assert_eq!(error.status, status, "{from} -> {to}: {error}");
        assert!(error.message.contains(message), "{from} -> {to}: {error}");
    }
}

/// Every prefix and every flipped byte of a binary file: an error or a mesh, never a panic.
#[test]
fn truncated_and_damaged_binary_files() {
    let folder = Folder::new("given-binary");
    let (mesh, plc) = model();
    for compress in [false, true] {
        let path = folder.file("a.vtu");
        write(&path, &mesh, &plc, &WriteOptions { compress, ..WriteOptions::default() }).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        for end in (0..bytes.len()).step_by(97) {
            std::fs::write(&path, &bytes[..end]).unwrap();
            let cut = read_arrays(&path);
            assert!(cut.is_err() || end > bytes.len() / 2);
        }
        for at in (0..bytes.len()).step_by(53) {
            let mut bad = bytes.clone();
            bad[at] ^= 0x55;
            std::fs::write(&path, &bad).unwrap();
            if let Ok(file) = read_arrays(&path) {
                let _ = mesh_from_arrays(file.arrays, 10);
            }
        }
    }
}
