//! Round trips of the surface formats, and malformed files.
use crate::control::Control;
use crate::error::{DefectKind, Element};
use crate::io::tests::Folder;
use crate::io::*;
use crate::plc::{Facet, Interior, RegionSeed, Segment};
use proptest::prelude::*;

/// Coordinates that a careless reader or writer spoils.
const AWKWARD: [f64; 8] =
    [0.1, 1e-310, -0.0, f64::MAX, f64::MIN_POSITIVE, 1.0 / 3.0, -123_456_789.123_456_79, 5e-324];

fn awkward_triangles() -> Plc {
    let point = |i: usize| [AWKWARD[i % 8], AWKWARD[(i / 2 + 3) % 8], i as f64];
    Plc {
        points: (0..9).map(point).collect(),
        triangles: vec![[0, 1, 2], [3, 4, 5], [8, 1, 0]],
        triangle_markers: vec![0, 7, -3],
        segments: vec![Segment { ends: [6, 7], marker: 0 }],
        ..Plc::default()
    }
}

fn bits(plc: &Plc) -> Vec<[u64; 3]> {
    plc.points.iter().map(|p| p.map(f64::to_bits)).collect()
}

#[test]
fn triangles_come_back_bit_for_bit() {
    let folder = Folder::new("triangles");
    let plc = awkward_triangles();
    for name in ["a.off", "a.obj", "a.ply", "a.poly"] {
        write_surface(&folder.file(name), &plc).unwrap();
        let back = read(&folder.file(name)).unwrap();
        assert_eq!(bits(&back), bits(&plc), "{name}");
        assert_eq!(back.triangles, plc.triangles, "{name}");
        assert_eq!(back.segments, plc.segments, "{name}");
        assert_eq!(back.triangle_markers, plc.triangle_markers, "{name}");
    }
    let unsegmented = Plc { segments: vec![], ..plc };
    write_surface(&folder.file("a.smesh"), &unsegmented).unwrap();
    let back = read(&folder.file("a.smesh")).unwrap();
    assert_eq!((bits(&back), &back), (bits(&unsegmented), &unsegmented));
    assert_eq!(
        folder.names(),
        ["a.obj", "a.off", "a.ply", "a.poly", "a.smesh"],
        "no temporary file may remain"
    );
}

fn general_plc() -> Plc {
    let ring = |corners: &[u32]| corners.to_vec();
    Plc {
        points: (0..12).map(|i| [f64::from(i), f64::from(i * i), 0.5]).collect(),
        point_attribute_count: 2,
        point_attributes: (0..24).map(|i| f64::from(i) / 7.0).collect(),
        point_markers: (0..12).map(|i| i - 5).collect(),
        segments: vec![Segment { ends: [10, 11], marker: 4 }],
        facets: vec![
            Facet {
                polygons: vec![ring(&[0, 1, 2, 3]), ring(&[4, 5, 6]), ring(&[7, 8]), ring(&[9])],
                holes: vec![[0.5, 0.25, 0.125]],
                interior: Interior::Seeds,
                marker: 9,
            },
            Facet { polygons: vec![ring(&[0, 1, 5])], ..Facet::default() },
        ],
        holes: vec![[0.1, 0.2, 0.3]],
        regions: vec![
            RegionSeed { point: [1.0, 2.0, 3.0], attribute: 5.5, max_volume: Some(0.01) },
            RegionSeed { point: [4.0, 2.0, 3.0], attribute: -1.0, max_volume: None },
        ],
        ..Plc::default()
    }
}

#[test]
fn poly_carries_everything() {
    let folder = Folder::new("poly");
    let plc = general_plc();
    write_surface(&folder.file("a.poly"), &plc).unwrap();
    assert_eq!(read(&folder.file("a.poly")).unwrap(), plc);
}

#[test]
fn what_a_format_cannot_express_is_refused() {
    let folder = Folder::new("refused");
    for name in ["a.off", "a.stl", "a.obj", "a.ply", "a.smesh", "a.vtu"] {
        let error = write_surface(&folder.file(name), &general_plc()).unwrap_err();
        assert_eq!(error.status, Status::Unsupported, "{name}: {error}");
    }
    let mut plc = awkward_triangles();
    plc.points[1][2] = f64::NAN;
    assert_eq!(write_surface(&folder.file("a.off"), &plc).unwrap_err().status, Status::NonFinitePoint);
    assert!(folder.names().is_empty());
}

#[test]
fn stl_is_rounded_to_single_precision_and_joined() {
    let folder = Folder::new("stl");
    let points = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.1]];
    let triangles = vec![[0, 1, 2], [0, 2, 3], [1, 3, 2]];
    let plc = Plc { points, triangles, ..Plc::default() };
    write_surface(&folder.file("a.stl"), &plc).unwrap();
    let back = read(&folder.file("a.stl")).unwrap();
    assert_eq!(back.triangles, plc.triangles);
    assert_eq!(back.points[3][2], f64::from(0.1f32));
    let lost = write_surface(&folder.file("a.stl"), &plc).unwrap();
    assert_eq!(lost.list().iter().map(|w| w.first).collect::<Vec<_>>(), [crate::Element::Point(3)]);
    assert_eq!(back.points.len(), 4);
}

#[test]
fn points_of_no_triangle_are_lost_in_stl_and_reported() {
    let folder = Folder::new("stl-lone");
    let points = vec![[0.0, 0.0, 0.0], [5.0, 5.0, 5.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mut plc = Plc { points, triangles: vec![[0, 2, 3]], ..Plc::default() };
    let lost = |plc: &Plc| {
        let lost = write_surface(&folder.file("a.stl"), plc).unwrap();
        lost.list().iter().map(|w| w.first).collect::<Vec<_>>()
    };
    assert_eq!(lost(&plc), [crate::Element::Point(1)]);
    plc.triangle_markers = vec![4];
    assert_eq!(lost(&plc), [crate::Element::Point(1)]);
    assert!(write_surface(&folder.file("a.off"), &plc).unwrap().is_empty());
}

#[test]
fn stl_beyond_single_precision_is_text() {
    let folder = Folder::new("stl-range");
    let points = vec![[0.0, 0.0, 0.0], [1e39, 0.0, 0.0], [0.0, 1e39, 0.0]];
    let plc = Plc { points, triangles: vec![[0, 1, 2]], ..Plc::default() };
    assert!(write_surface(&folder.file("a.stl"), &plc).unwrap().is_empty());
    assert_eq!(read(&folder.file("a.stl")).unwrap().points, plc.points);
}

#[test]
fn binary_stl_may_begin_with_solid() {
    let mut bytes = b"solid but binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend_from_slice(&1u32.to_le_bytes());
    for value in [0f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -0.0, 1.0, 0.0] {
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    bytes.extend_from_slice(&[0, 0]);
    assert_eq!(read_bytes(&bytes, Format::Stl).unwrap().triangles, [[0, 1, 2]]);
    bytes.pop();
    assert_eq!(read_bytes(&bytes, Format::Stl).unwrap_err().status, Status::Format);
}

const TEXT_STL: &str = "solid a name of words
  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n      vertex 0 1 0\n    endloop\n  endfacet
endsolid a name of words
SOLID b
  FACET NORMAL nan 0 -0\n    OUTER LOOP\n      VERTEX -0 0 0\n      VERTEX 0 1e0 0\n      VERTEX 0 0 .5\n    ENDLOOP\n  ENDFACET
ENDSOLID
";

#[test]
fn text_stl_joins_points_across_solids_and_numbers_these() {
    let plc = read_bytes(TEXT_STL.as_bytes(), Format::Stl).unwrap();
    assert_eq!(plc.points, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.5]]);
    assert_eq!(plc.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(plc.triangle_markers, [1, 2]);
}

#[test]
fn off_header_variants() {
    for text in [
        "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "\u{feff}OFF # comment\r\n\r\n# another\r\n3 1 0\r\n0 0 0\r\n1 0 0 # here\r\n0 1 0\r\n3 0 1 2 255 0 0\r\n",
        "COFF\n3 1\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2",
        "STCNOFF\n3 1 3\n0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2\n\n\n",
    ] {
        let plc = read_bytes(text.as_bytes(), Format::Off).unwrap();
        assert_eq!(plc.points, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!(plc.triangles, [[0, 1, 2]]);
    }
}

#[test]
fn off_keeps_equal_points_and_makes_all_facets_general_if_one_is() {
    let text = "OFF\n5 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 0\n3 0 1 2\n4 4 1 2 3\n2 0 2\n";
    let plc = read_bytes(text.as_bytes(), Format::Off).unwrap();
    assert_eq!(plc.points.len(), 5);
    assert!(plc.triangles.is_empty());
    assert_eq!(plc.facets[0].polygons, [[0, 1, 2]]);
    assert_eq!(plc.facets[1].polygons, [[4, 1, 2, 3]]);
    assert_eq!(plc.segments, [Segment { ends: [0, 2], marker: 0 }]);
}

const OBJ: &str = "# a comment\nmtllib x.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\nvn 0 0 1\nvt 0.5 0.5\nv 0 1 0\nv 0 0 0\n\
                   g top\nusemtl red\nf 1/1/1 2//1 3/1\ns off\nusemtl blue\nf -1 \\\n -2 -3\nusemtl red\nf 4 3 2\nl 1 2 3\n";

#[test]
fn obj_joins_points_and_numbers_groups() {
    let plc = read_bytes(OBJ.as_bytes(), Format::Obj).unwrap();
    assert_eq!(plc.points, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(plc.triangles, [[0, 1, 2], [0, 2, 1], [0, 2, 1]]);
    let markers = &plc.triangle_markers;
    assert!(markers[0] == markers[2] && markers[0] != markers[1] && !markers.contains(&0), "{markers:?}");
    assert_eq!(plc.segments.iter().map(|s| s.ends).collect::<Vec<_>>(), [[0, 1], [1, 2]]);
}

const PLY: &str =
    "ply\nformat ascii 1.0\ncomment a comment\nelement vertex 4\nproperty uchar red\nproperty float x\n\
                   property double y\nproperty int z\nelement junk 2\nproperty list uchar short stuff\n\
                   element face 2\nproperty list uchar int vertex_index\nproperty uchar flags\nend_header\n\
                   255 0 0 0\n0 1 0.5 0\n0 0 1 0\n7 0 0 -2\n2 1 2\n0\n3 0 1 2 9\n4 0 1 2 3 9\n";

fn binary_ply(big: bool) -> Vec<u8> {
    let order = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = PLY[..PLY.find("255").unwrap()].replace("ascii", order).into_bytes();
    let mut put = |word: &[u8]| {
        let reversed: Vec<u8> = word.iter().rev().copied().collect();
        bytes.extend_from_slice(if big { &reversed } else { word });
    };
    for (red, x, y, z) in [(255u8, 0f32, 0f64, 0i32), (0, 1.0, 0.5, 0), (0, 0.0, 1.0, 0), (7, 0.0, 0.0, -2)] {
        put(&[red]);
        put(&x.to_le_bytes());
        put(&y.to_le_bytes());
        put(&z.to_le_bytes());
    }
    put(&[2]);
    put(&1i16.to_le_bytes());
    put(&2i16.to_le_bytes());
    put(&[0]);
    for ring in [&[0i32, 1, 2][..], &[0, 1, 2, 3]] {
        put(&[ring.len() as u8]);
        ring.iter().for_each(|c| put(&c.to_le_bytes()));
        put(&[9]);
    }
    bytes
}

#[test]
fn ply_in_three_encodings() {
    let text = read_bytes(PLY.as_bytes(), Format::Ply).unwrap();
    assert_eq!(text.points, [[0.0, 0.0, 0.0], [1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -2.0]]);
    assert_eq!(
        text.facets.iter().map(|f| f.polygons[0].clone()).collect::<Vec<_>>(),
        [vec![0, 1, 2], vec![0, 1, 2, 3]]
    );
    assert_eq!(read_bytes(&binary_ply(false), Format::Ply).unwrap(), text);
    assert_eq!(read_bytes(&binary_ply(true), Format::Ply).unwrap(), text);
}

const POLY: &str = "# TetGen's example, from 1\n6 3 1 1\n1 0 0 0  5.5 1\n2 1 0 0  5.5 2\n3 1 1 0 5.5 3\n4 0 1 0 5.5 4 # fourth\n\
                    5 .5 .5 0 0 0\n6 .5 .5 1 0 0\n3 1\n# a facet with a hole\n2 1 -7\n4 1 2\n3\n4\n1 5\n1 .25 .25 0\n\
                    1\n3 1 2 6\n1 0 12\n2 5 6\n1\n1 0.1 0.2 0.3\n1\n1 0.5 0.5 0.5 10 0.1\n";

#[test]
fn poly_from_one_with_comments_continued_lines_holes_and_segments() {
    let plc = read_bytes(POLY.as_bytes(), Format::Poly).unwrap();
    assert_eq!((plc.points.len(), plc.point_attribute_count), (6, 1));
    assert_eq!(plc.point_markers, [1, 2, 3, 4, 0, 0]);
    assert_eq!(plc.point_attributes[3], 5.5);
    let first = &plc.facets[0];
    assert_eq!(first.polygons, [vec![0, 1, 2, 3], vec![4]]);
    assert_eq!(
        (first.interior, first.marker, &first.holes[..]),
        (Interior::Seeds, -7, &[[0.25, 0.25, 0.0]][..])
    );
    assert_eq!(plc.facets[1].polygons, [[0, 1, 5]]);
    assert!(plc.triangles.is_empty(), "the numbering of facets must be the file's");
    assert_eq!(plc.segments, [Segment { ends: [4, 5], marker: 12 }]);
    assert_eq!(plc.holes, [[0.1, 0.2, 0.3]]);
    assert_eq!(plc.regions, [RegionSeed { point: [0.5; 3], attribute: 10.0, max_volume: Some(0.1) }]);
}

const SMESH: &str = "0 3 0 0\n1 1\n3 1 2\n 3 -2\n0\n0\n";

#[test]
fn smesh_takes_points_from_the_node_file_beside() {
    let folder = Folder::new("beside");
    std::fs::write(folder.file("a.smesh"), SMESH).unwrap();
    let error = read(&folder.file("a.smesh")).unwrap_err();
    assert_eq!(error.status, Status::File, "{error}");
    std::fs::write(folder.file("a.node"), "3 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n").unwrap();
    let plc = read(&folder.file("a.smesh")).unwrap();
    assert_eq!((&plc.triangles[..], &plc.triangle_markers[..]), (&[[0, 1, 2]][..], &[-2][..]));
    assert_eq!(read(&folder.file("a.node")).unwrap().points, plc.points);
}

#[test]
fn malformed_files_are_refused_with_the_line() {
    use Format::*;
    for (format, text, message) in [
        (Off, "", "the file is empty"),
        (Off, "# nothing\n", "line 1: the file ends where the header"),
        (Off, "OFF\n0 0 0\n", "holds no points"),
        (Obj, "# nothing\n", "holds no points"),
        (Off, "4OFF\n", "variant '4OFF'"),
        (Off, "nonsense", "'OFF' expected, found 'nonsense'"),
        (Off, "OFF\n-3 1 0\n", "line 2: the number of vertices is negative"),
        (Off, "OFF\n4000000000 1 0\n0 0 0\n", "more than the rest of the file can hold"),
        (Off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "line 6: the line ends"),
        (Off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: vertex index 3"),
        (Off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 6: vertex index -1"),
        (Off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1 0\n", "line 6: a face of 1 corners"),
        (Off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n", "line 7: '3' after the last face"),
        (Off, "OFF\n3 1 0\n0 0 0\n1,5 0 0\n0 1 0\n3 0 1 2\n", "line 4: coordinate x expected, found '1,5'"),
        (Stl, "solid x\nendsolid x\n", "no triangles"),
        (
            Stl,
            "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop",
            "line 6: 'vertex' expected",
        ),
        (Obj, "v 0 0 0\nf 1 1\n", "line 2: a face of 2 corners"),
        (Obj, "v 0 0 0\nf 1 1 x\n", "line 2: a vertex index expected, found 'x'"),
        (Obj, "v 0 0 0\nf 1 1 -2\n", "line 2: vertex index -2 reaches before"),
        (Obj, "v 0 0 0\nf 1 1 2\n", "line 2: facet 0 refers to a point that does not exist"),
        (Obj, "v 0 0 0\nsurf 0 1\n", "free-form"),
        (Obj, "w 0 0 0\n", "unknown keyword 'w'"),
        (
            Ply,
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
            "lack a coordinate",
        ),
        (Ply, "ply\nelement vertex 0\n", "line 2: the file ends within the header"),
        (Poly, "2 2 0 0\n1 0.0 0.0\n2 1.0 0.0\n", "the dimension is 2"),
        (Poly, "2 3 0 0\n1 0 0 0\n3 1 0 0\n", "line 3: point 3 where 2 was expected"),
        (Poly, "1 3 0 0\n1 0 0 0\n1 0\n1\n3 1 2 1\n", "line 5: point index 2, but the points are 1 to 1"),
        (Poly, "1 3 0 0\n1 0 0 0\n1 0\n0\n0\n0\n", "line 4: a facet without polygons"),
        (Poly, "0 3 0 0\n", "no points"),
        (Smesh, "1 3 0 0\n1 0 0 0\n99999999999999999999 0\n", "line 3: the number of facets expected"),
        (Node, "1 3 0 0\n1 0 0 0\n1 0 0 0\n", "after the last point"),
    ] {
        let error = read_bytes(text.as_bytes(), format).expect_err(text);
        assert!(error.message.contains(message), "{text:?}: {}", error.message);
    }
}

/// It is another status than that of a malformed file, and says which element it is.
#[test]
fn an_index_of_no_point_is_out_of_range_in_every_reader() {
    use Format::*;
    let off = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 2\nproperty list uchar int vertex_index\nelement edge 1\nproperty int vertex1\n\
               property int vertex2\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let poly = "3 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n";
    for (format, start, rest, element) in [
        (Off, off, "3 0 1 3\n", Element::Facet(1)),
        (Off, off, "3 0 1 -1\n", Element::Facet(1)),
        (Off, off, "2 0 3\n", Element::Segment(0)),
        (Obj, obj, "f 1 2 4\n", Element::Facet(1)),
        (Obj, obj, "f 1 2 0\n", Element::Facet(1)),
        (Obj, obj, "f 1 2 -4\n", Element::Facet(1)),
        (Obj, obj, "l 1 4\n", Element::Segment(0)),
        (Obj, obj, "l 1 -4\n", Element::Segment(0)),
        (Ply, ply, "3 0 1 3\n0 1\n", Element::Facet(1)),
        (Ply, ply, "3 0 1 -1\n0 1\n", Element::Facet(1)),
        (Ply, ply, "3 0 2 1\n0 3\n", Element::Segment(0)),
        (Poly, poly, "2 0\n1\n3 1 2 3\n1\n3 1 2 4\n", Element::Facet(1)),
        (Poly, poly, "2 0\n1\n3 1 2 3\n1\n3 1 2 0\n", Element::Facet(1)),
        (Poly, poly, "2 0\n1\n2 1 2\n1\n2 1 4\n", Element::Segment(1)),
        (Poly, poly, "1 0\n2\n2 1 2\n2 1 4\n", Element::Segment(1)),
        (Poly, poly, "1 0\n2\n3 1 2 3\n2 1 4\n", Element::Facet(0)),
        (Smesh, poly, "2 0\n3 1 2 3\n3 1 2 4\n", Element::Facet(1)),
    ] {
        let text = [start, rest].concat();
        let error = read_bytes(text.as_bytes(), format).expect_err(&text);
        assert_eq!(error.status, Status::IndexOutOfRange, "{text:?}: {}", error.message);
        let [defect] = error.defects[..] else { panic!("{text:?}: {error:?}") };
        assert_eq!((defect.kind, defect.first), (DefectKind::IndexOutOfRange, element), "{text:?}");
    }
}

/// Files that are valid, one per format and encoding.
fn valid_files() -> Vec<(Format, Vec<u8>)> {
    let off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n";
    let smesh = SMESH.replace("0 3 0 0", "3 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0");
    let mut files: Vec<(Format, Vec<u8>)> = [
        (Format::Off, off),
        (Format::Stl, TEXT_STL),
        (Format::Obj, OBJ),
        (Format::Ply, PLY),
        (Format::Poly, POLY),
        (Format::Smesh, &smesh),
        (Format::Node, "2 3 1 1\n0 1 2 3 4.5 6\n1 0 0 0 1 2\n"),
    ]
    .into_iter()
    .map(|(format, text)| (format, text.as_bytes().to_vec()))
    .collect();
    files.push((Format::Ply, binary_ply(false)));
    files.push((Format::Ply, binary_ply(true)));
    let mut stl = vec![b' '; 80];
    stl.extend_from_slice(&2u32.to_le_bytes());
    for i in 0..24u16 {
        stl.extend_from_slice(&f32::from(i % 5).to_le_bytes());
        stl.extend_from_slice(if i % 12 == 11 { &[0, 0] } else { &[] });
    }
    files.push((Format::Stl, stl));
    files
}

/// What every reader guarantees for accepted files.
fn assert_consistent(plc: &Plc) {
    let fine = |&c: &u32| (c as usize) < plc.points.len();
    assert!(plc.triangles.iter().flatten().all(fine));
    assert!(plc.facets.iter().flat_map(|f| f.polygons.iter().flatten()).all(fine));
    assert!(plc.segments.iter().flat_map(|s| &s.ends).all(fine));
    assert!(plc.point_markers.is_empty() || plc.point_markers.len() == plc.points.len());
    assert!(plc.triangle_markers.is_empty() || plc.triangle_markers.len() == plc.triangles.len());
    assert_eq!(plc.point_attributes.len(), plc.point_attribute_count * plc.points.len());
}

#[test]
fn truncations_at_every_byte_are_refused_or_consistent() {
    for (format, bytes) in valid_files() {
        let whole = read_bytes(&bytes, format).unwrap();
        assert_consistent(&whole);
        let mut refused = 0;
        for length in 0..bytes.len() {
            match read_bytes(&bytes[..length], format) {
                Ok(plc) => assert_consistent(&plc),
                Err(_) => refused += 1,
            }
        }
        assert!(
            refused > 2 * bytes.len() / 5,
            "{format:?}: {refused} of {} truncations refused",
            bytes.len()
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2000,
        rng_seed: proptest::test_runner::RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn damaged_files_never_panic(
        file in 0usize..10,
        damage in prop::collection::vec((any::<prop::sample::Index>(), prop::sample::select(&b"\0\x01\n 0123456789-.e#\\/\xff\x7f"[..])), 1..6),
        cut in any::<prop::sample::Index>(),
        cut_length in 0usize..4,
    ) {
        let (format, mut bytes) = valid_files().swap_remove(file);
        for (at, byte) in damage {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        let from = cut.index(bytes.len());
        let to = (from + cut_length).min(bytes.len());
        bytes.drain(from..to);
        if let Ok(plc) = read_bytes(&bytes, format) {
            assert_consistent(&plc);
        }
    }

    #[test]
    fn joining_keeps_the_first_of_equal_points(values in prop::collection::vec((0i8..4, 0i8..4, -1i8..2), 0..200)) {
        let signed_zero = |x: i8| if x == 0 { -0.0 } else { f64::from(x) };
        let points: Vec<[f64; 3]> = values.iter().map(|&(x, y, z)| [x.into(), y.into(), signed_zero(z)]).collect();
        let mut joined = points.clone();
        let map = surface::join_points(&mut joined, &Control::free()).unwrap();
        let mut expected: Vec<[f64; 3]> = Vec::new();
        for (point, &index) in points.iter().zip(&map) {
            if !expected.contains(point) {
                expected.push(*point);
            }
            prop_assert_eq!(expected[index as usize], *point);
        }
        prop_assert_eq!(joined, expected);
    }
}
