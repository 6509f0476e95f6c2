//! The exact content of the mesh formats, and that a failed write leaves nothing behind.
use crate::io::tests::Folder;
use crate::io::*;
use crate::output::{Region, Statistics, SteinerPoint, Subsegment};
use crate::query::TetQuality;

/// Two tetrahedra of two regions on a common face, one Steiner point.
pub(super) fn small_mesh() -> (TetMesh, Plc) {
    let subface = |corners, facet, marker, tets| Subface { corners, facet, marker, tets };
    let region = |attribute, seed| Region { attribute, seed, max_volume: None };
    let mesh = TetMesh {
        points: vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 0.1, 0.0],
            [0.0, 0.0, 1e-310],
            [1.0 / 3.0, -0.0, -1.0],
        ],
        input_point_count: 4,
        point_alias: vec![0, 1, 2, 3],
        tets: vec![[0, 1, 2, 3], [0, 2, 1, 4]],
        neighbors: vec![[INVALID, INVALID, INVALID, 1], [INVALID, INVALID, INVALID, 0]],
        tet_region: vec![0, 1],
        regions: vec![region(2.5, 0), region(3.0, INVALID)],
        subfaces: vec![subface([0, 1, 2], 0, -4, [1, 0]), subface([0, 1, 3], 1, 6, [0, INVALID])],
        subsegments: vec![
            Subsegment { ends: [0, 4], segment: 0, marker: 8 },
            Subsegment { ends: [0, 1], segment: INVALID, marker: 0 },
        ],
        replaced: vec![1],
        steiner: vec![SteinerPoint {
            ends: [0, 1],
            t: 0.25,
            segment: INVALID,
            exact: true,
            ..SteinerPoint::INSIDE
        }],
        statistics: Statistics { steiner: 1, steiner_exact: 1, ..Statistics::default() },
        ..TetMesh::default()
    };
    let plc = Plc {
        points: mesh.points[..4].to_vec(),
        point_attribute_count: 1,
        point_attributes: vec![1.0, 3.0, 0.0, 0.0],
        point_markers: vec![1, 2, 3, 4],
        ..Plc::default()
    };
    (mesh, plc)
}

#[test]
fn tetgen_files_to_the_letter() {
    let folder = Folder::new("ele");
    let (mesh, plc) = small_mesh();
    write(&folder.file("m.ele"), &mesh, &plc, &WriteOptions::default()).unwrap();
    assert_eq!(folder.names(), ["m.edge", "m.ele", "m.face", "m.neigh", "m.node", "m.parents"]);
    let text = |name: &str| std::fs::read_to_string(folder.file(name)).unwrap();
    let node = text("m.node");
    assert_eq!(node.lines().next(), Some("5  3  1  1"));
    assert_eq!(
        node.lines().nth(5),
        Some("4 0.3333333333333333 -0 -1 1.5 0"),
        "the attribute is interpolated"
    );
    assert_eq!(text("m.ele"), "2  4  1\n0 0 1 2 3 2.5\n1 0 2 1 4 3\n");
    assert_eq!(text("m.face"), "2  1\n0 0 1 2 -4\n1 0 1 3 6\n");
    assert_eq!(text("m.edge"), "2  1\n0 0 4 8\n1 0 1 0\n");
    assert_eq!(text("m.neigh"), "2  4\n0 -1 -1 -1 1\n1 -1 -1 -1 0\n");
    let facets: Vec<String> = mesh.subfaces.iter().map(|face| format!("{}\n", face.facet as i32)).collect();
    assert_eq!(text("m.parents"), format!("1  2  0  0  1  0  0  0\n0 1 -1 0.25\n{}1\n", facets.concat()));
    for path in ["m.ele", "m.node", "m"] {
        let back = read_mesh(&folder.file(path)).unwrap();
        assert_eq!(
            back.points.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>(),
            mesh.points.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>()
        );
        assert_eq!((&back.tets, &back.tet_region), (&mesh.tets, &mesh.tet_region));
        assert_eq!(back.replaced, mesh.replaced);
        assert_eq!(
            back.subfaces.iter().map(|f| (f.corners, f.marker)).collect::<Vec<_>>(),
            [([0, 1, 2], -4), ([0, 1, 3], 6)]
        );
    }
}

#[test]
fn one_region_without_seeds_has_no_attribute_column() {
    let folder = Folder::new("plain");
    let (mut mesh, _) = small_mesh();
    mesh.regions.truncate(1);
    mesh.tet_region = vec![0, 0];
    write(&folder.file("m.ele"), &mesh, &Plc::default(), &WriteOptions::default()).unwrap();
    assert_eq!(std::fs::read_to_string(folder.file("m.ele")).unwrap(), "2  4  0\n0 0 1 2 3\n1 0 2 1 4\n");
    assert!(std::fs::read_to_string(folder.file("m.node")).unwrap().starts_with("5  3  0  0\n0 0 0 0\n"));
}

#[test]
fn malformed_meshes_are_refused() {
    let folder = Folder::new("badmesh");
    let (mesh, plc) = small_mesh();
    write(&folder.file("m.ele"), &mesh, &plc, &WriteOptions::default()).unwrap();
    let good = std::fs::read_to_string(folder.file("m.ele")).unwrap();
    for (bad, status) in [
        (good.replace("1 0 2 1 4", "1 0 2 1 5"), Status::IndexOutOfRange),
        (good.replace("1 0 2 1 4", "1 0 2 1 -1"), Status::IndexOutOfRange),
        (good.replace("2  4  1", "3  4  1"), Status::Format),
        (good.replace("2  4  1", "1  4  1"), Status::Format),
        (good.replace("2  4  1", "2  10  1"), Status::Format),
        (good.replace("2  4  1", "2  5  1"), Status::Unsupported),
    ] {
        std::fs::write(folder.file("m.ele"), &bad).unwrap();
        assert_eq!(read_mesh(&folder.file("m.ele")).unwrap_err().status, status, "{bad}");
    }
}

#[test]
fn a_failed_write_leaves_nothing_behind() {
    let folder = Folder::new("failed");
    let (mut mesh, plc) = small_mesh();
    mesh.points[4][0] = f64::INFINITY;
    for name in ["m.ele", "m.msh", "m.mesh"] {
        std::fs::write(folder.file(name), "old").unwrap();
        let error = write(&folder.file(name), &mesh, &plc, &WriteOptions::default()).unwrap_err();
        assert_eq!(error.status, Status::File, "{name}");
        assert_eq!(std::fs::read_to_string(folder.file(name)).unwrap(), "old");
    }
    assert_eq!(folder.names(), ["m.ele", "m.mesh", "m.msh"]);
    let error = write(&folder.file("absent/m.ele"), &mesh, &plc, &WriteOptions::default()).unwrap_err();
    assert_eq!(error.status, Status::File);
}

#[test]
fn an_output_that_cannot_be_moved_to_its_place_leaves_no_temporary_file() {
    let folder = Folder::new("unmoved");
    let (mesh, plc) = small_mesh();
    // A folder cannot be replaced by a file; this is the last but one of the six.
    std::fs::create_dir(folder.file("m.neigh")).unwrap();
    let error = write(&folder.file("m.ele"), &mesh, &plc, &WriteOptions::default()).unwrap_err();
    assert_eq!(error.status, Status::File);
    assert!(folder.names().iter().all(|name| !name.ends_with(".tmp")), "{:?}", folder.names());
}

#[test]
#[cfg(unix)]
fn a_link_stays_one_and_what_it_leads_to_is_replaced() {
    let folder = Folder::new("linked");
    let (mesh, plc) = small_mesh();
    std::fs::create_dir(folder.file("beyond")).unwrap();
    std::fs::write(folder.file("beyond/real.mesh"), "old").unwrap();
    std::os::unix::fs::symlink("beyond/real.mesh", folder.file("m.mesh")).unwrap();
    write(&folder.file("m.mesh"), &mesh, &plc, &WriteOptions::default()).unwrap();
    assert!(std::fs::symlink_metadata(folder.file("m.mesh")).unwrap().file_type().is_symlink());
    assert!(std::fs::read_to_string(folder.file("beyond/real.mesh")).unwrap().starts_with("MeshVersion"));
    assert_eq!(folder.names(), ["beyond", "m.mesh"]);
}

#[test]
fn medit_to_the_letter() {
    let folder = Folder::new("medit");
    let (mesh, plc) = small_mesh();
    write(&folder.file("m.mesh"), &mesh, &plc, &WriteOptions::default()).unwrap();
    let text = std::fs::read_to_string(folder.file("m.mesh")).unwrap();
    let expected =
        "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n5\n0 0 0 1\n1 0 0 2\n0 0.1 0 3\n0 0 1e-310 4\n\
                    0.3333333333333333 -0 -1 0\n\nEdges\n1\n1 5 8\n\nTriangles\n2\n1 2 3 -4\n1 2 4 6\n\n\
                    Tetrahedra\n2\n1 2 3 4 1\n1 3 2 5 3\n\nEnd\n";
    assert_eq!(text, expected);
}

#[test]
fn msh_has_entities_and_physical_groups() {
    let folder = Folder::new("msh");
    let (mesh, plc) = small_mesh();
    write(&folder.file("m.msh"), &mesh, &plc, &WriteOptions::default()).unwrap();
    let text = std::fs::read_to_string(folder.file("m.msh")).unwrap();
    let section = |name: &str| {
        let (_, rest) = text.split_once(&format!("${name}\n")).unwrap();
        rest.split_once(&format!("$End{name}\n")).unwrap().0.to_string()
    };
    assert_eq!(section("MeshFormat"), "4.1 0 8\n");
    let names =
        "5\n1 8 \"marker 8\"\n2 1 \"marker -4\"\n2 6 \"marker 6\"\n3 1 \"region 2.5\"\n3 3 \"region 3\"\n";
    assert_eq!(section("PhysicalNames"), names);
    assert!(section("Entities").starts_with("0 1 2 2\n1 0 0 -1 0.3333333333333333 0 0 1 8 0\n"));
    assert!(section("Nodes").starts_with("1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n"));
    let elements = "5 5 1 5\n1 1 1 1\n1 1 5\n2 1 2 1\n2 1 2 3\n2 2 2 1\n3 1 2 4\n3 1 4 1\n4 1 2 3 4\n3 2 4 1\n5 1 3 2 5\n";
    assert_eq!(section("Elements"), elements);
}

/// The appended arrays of a `.vtu` by name, inflated where compressed.
pub(super) fn vtu_arrays(bytes: &[u8]) -> std::collections::HashMap<String, Vec<u8>> {
    let start = bytes.windows(2).position(|w| w == b"\n_").unwrap() + 2;
    let header = std::str::from_utf8(&bytes[..start]).unwrap();
    let word = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
    let mut arrays = std::collections::HashMap::new();
    for tag in header.split("<DataArray ").skip(1) {
        let attribute =
            |name: &str| tag.split_once(&format!("{name}=\"")).unwrap().1.split('"').next().unwrap();
        let at = start + attribute("offset").parse::<usize>().unwrap();
        let mut data = Vec::new();
        if header.contains("vtkZLibDataCompressor") {
            let mut block = at + 24 + 8 * word(at);
            for i in 0..word(at) {
                let size = word(at + 24 + 8 * i);
                std::io::copy(&mut flate2::read::ZlibDecoder::new(&bytes[block..block + size]), &mut data)
                    .unwrap();
                block += size;
            }
        } else {
            data.extend_from_slice(&bytes[at + 8..at + 8 + word(at)]);
        }
        arrays.insert(attribute("Name").to_string(), data);
    }
    arrays
}

#[test]
fn vtu_raw_and_compressed_hold_the_same_arrays() {
    let folder = Folder::new("vtu");
    let (mesh, plc) = small_mesh();
    let mut both = Vec::new();
    for compress in [false, true] {
        let options = WriteOptions { compress, subfaces: true, ..WriteOptions::default() };
        write(&folder.file("m.vtu"), &mesh, &plc, &options).unwrap();
        let arrays = vtu_arrays(&std::fs::read(folder.file("m.vtu")).unwrap());
        let faces = vtu_arrays(&std::fs::read(folder.file("m_subfaces.vtu")).unwrap());
        both.push((arrays, faces));
    }
    assert_eq!(both[0], both[1]);
    let (arrays, faces) = &both[0];
    let points: Vec<u8> = mesh.points.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    assert_eq!(arrays["Points"], points);
    assert_eq!(
        arrays["connectivity"],
        mesh.tets.iter().flatten().flat_map(|v| v.to_le_bytes()).collect::<Vec<_>>()
    );
    assert_eq!(arrays["offsets"], [4, 0, 0, 0, 8, 0, 0, 0]);
    assert_eq!(arrays["types"], [10, 10]);
    assert_eq!(arrays["region"], [2.5f64, 3.0].iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>());
    assert_eq!(arrays["steiner"], [0, 0, 0, 0, 1]);
    assert_eq!(faces["marker"], [-4i32, 6].iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>());
    assert_eq!(faces["connectivity"].len(), 24);
}

/// On request; without it, the file has no such arrays.
#[test]
fn vtu_holds_the_quality_of_tetrahedra() {
    let folder = Folder::new("vtu-quality");
    let (mesh, plc) = small_mesh();
    let arrays = |quality_data: bool| {
        let options = WriteOptions { quality_data, ..WriteOptions::default() };
        write(&folder.file("m.vtu"), &mesh, &plc, &options).unwrap();
        vtu_arrays(&std::fs::read(folder.file("m.vtu")).unwrap())
    };
    let (mut without, mut with) = (arrays(false), arrays(true));
    let qualities = crate::query::quality::tet_qualities(&mesh).unwrap();
    let bytes =
        |of: fn(&TetQuality) -> f64| qualities.iter().flat_map(|q| of(q).to_le_bytes()).collect::<Vec<_>>();
    for (name, of) in [
        ("max_dihedral", TetQuality::max_dihedral as fn(&TetQuality) -> f64),
        ("radius_edge", |q| q.radius_edge),
        ("eta", |q| q.eta),
        ("volume", |q| q.volume),
    ] {
        assert_eq!(with.remove(name), Some(bytes(of)), "{name}");
    }
    let least = without.remove("min_dihedral").unwrap();
    let least = least.chunks(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()));
    assert!(least.zip(&qualities).all(|(angle, q)| (f64::from(angle) - q.min_dihedral()).abs() < 1e-5));
    with.remove("min_dihedral");
    assert_eq!(with, without);
}

/// Several blocks per array, a whole one at the end among them; what is compressed does not depend on the run.
#[test]
fn vtu_is_compressed_block_by_block() {
    let folder = Folder::new("vtu-blocks");
    let points = (0..3 << 14).map(|i| [f64::from(i) * 0.1, f64::from(i % 7), 1.0 / f64::from(i + 1)]);
    let mut mesh = TetMesh { points: points.collect(), ..TetMesh::default() };
    mesh.tets = (0..1 << 14).map(|i| [i, i + 1, i + 2, (i * 7919) % 49_152]).collect();
    mesh.input_point_count = mesh.points.len() as u32;
    let written = |compress: bool| {
        let options = WriteOptions { compress, ..WriteOptions::default() };
        write(&folder.file("m.vtu"), &mesh, &Plc::default(), &options).unwrap();
        std::fs::read(folder.file("m.vtu")).unwrap()
    };
    let (plain, packed) = (written(false), written(true));
    assert_eq!(packed, written(true));
    assert!(2 * packed.len() < plain.len(), "{} of {}", packed.len(), plain.len());
    assert_eq!(vtu_arrays(&packed), vtu_arrays(&plain));
}

#[test]
fn dihedral_angles_of_the_unit_corner_and_of_a_regular_tetrahedron() {
    let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let [low, high] = quality::dihedrals(corner);
    assert!((low - 54.735_610_317).abs() < 1e-8 && (high - 90.0).abs() < 1e-12, "{low} {high}");
    let regular = [[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0], [-1.0, -1.0, 1.0]];
    let [low, high] = quality::dihedrals(regular);
    assert!((low - 70.528_779_366).abs() < 1e-8 && (high - low).abs() < 1e-12, "{low} {high}");
}
