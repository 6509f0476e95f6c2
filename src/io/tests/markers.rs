//! Markers and their names in each surface format, and the recognition of content that is no surface.
use crate::io::tests::Folder;
use crate::io::*;
use crate::plc::Segment;

fn named(plc: &Plc) -> Vec<(i32, &str)> {
    plc.names.iter().map(|n| (n.marker, n.name.as_str())).collect()
}

fn text(content: &str, format: Format) -> Plc {
    read_bytes(content.as_bytes(), format).unwrap()
}

/// A fan of triangles with these markers.
fn fan(markers: &[i32]) -> Plc {
    let count = markers.len() as u32;
    Plc {
        points: (0..count + 2).map(|i| [f64::from(i), f64::from(i * i) / 3.0, 1e-300]).collect(),
        triangles: (0..count).map(|i| [i, i + 1, i + 2]).collect(),
        triangle_markers: markers.to_vec(),
        ..Plc::default()
    }
}

#[test]
fn markers_and_names_survive_every_format_that_has_facets() {
    let folder = Folder::new("names");
    let mut plc = fan(&[7, 0, -3, 7, i32::MAX, i32::MIN]);
    for (marker, name) in [(7, "left wall"), (-3, "größe \"5\""), (0, "rest"), (99, "unused")] {
        plc.set_marker_name(marker, name).unwrap();
    }
    for name in ["a.off", "a.obj", "a.ply", "a.poly", "a.smesh", "a.stl"] {
        write_surface(&folder.file(name), &plc).unwrap();
        let back = read(&folder.file(name)).unwrap();
        assert_eq!(back.triangle_markers, plc.triangle_markers, "{name}");
        assert_eq!(back.points, plc.points, "{name}");
        // A group without facets has no place in OBJ and STL.
        let names = if matches!(name, "a.obj" | "a.stl") { &plc.names[..3] } else { &plc.names[..] };
        assert_eq!(back.names, names, "{name}");
    }
}

#[test]
fn segments_keep_their_markers() {
    let folder = Folder::new("segments");
    let segments = vec![Segment { ends: [0, 2], marker: 4 }, Segment { ends: [1, 2], marker: 0 }];
    let plc = Plc { segments, ..fan(&[4]) };
    for name in ["a.off", "a.obj", "a.ply", "a.poly"] {
        write_surface(&folder.file(name), &plc).unwrap();
        assert_eq!(read(&folder.file(name)).unwrap(), plc, "{name}");
    }
}

fn solid(name: &str, z: u32) -> String {
    let vertices = format!("vertex 0 0 {z}\nvertex 1 0 {z}\nvertex 0 1 {z}\n");
    format!("solid {name}\nfacet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\nendsolid {name}\n")
}

#[test]
fn solids_of_an_stl_file_are_numbered_and_named() {
    let several = text(&[solid("inlet", 0), solid("", 1), solid("inlet", 2)].concat(), Format::Stl);
    assert_eq!(several.triangle_markers, [1, 2, 3]);
    assert_eq!(named(&several), [(1, "inlet"), (3, "inlet")]);
    // A single solid divides nothing; a solid that states a marker has it. Others get numbers that none states.
    let alone = text(&solid("part 1", 0), Format::Stl);
    assert_eq!((alone.triangle_markers.len(), named(&alone)), (0, vec![(0, "part 1")]));
    let stated = text(&[solid("a", 0), solid("marker_1 lid", 1), solid("c", 2)].concat(), Format::Stl);
    assert_eq!(
        (&stated.triangle_markers[..], named(&stated)),
        (&[2, 1, 3][..], vec![(1, "lid"), (2, "a"), (3, "c")])
    );
}

#[test]
fn attribute_bytes_of_a_binary_stl_file_number_groups_where_they_differ() {
    let file = |attributes: &[[u8; 2]]| {
        let mut bytes = vec![b' '; 80];
        bytes.extend_from_slice(&(attributes.len() as u32).to_le_bytes());
        for (i, attribute) in attributes.iter().enumerate() {
            for x in [0.0, 0.0, 1.0, 0.0, 0.0, i as f32, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
                bytes.extend_from_slice(&x.to_le_bytes());
            }
            bytes.extend_from_slice(attribute);
        }
        read_bytes(&bytes, Format::Stl).unwrap()
    };
    let coloured = file(&[[0x1f, 0x80], [0, 0], [0x1f, 0x80]]);
    assert_eq!(coloured.triangle_markers, [1, 2, 1]);
    assert_eq!(named(&coloured), [(1, "attribute 0x801f"), (2, "attribute 0x0000")]);
    let plain = file(&[[0xff, 0xff], [0xff, 0xff]]);
    assert!(plain.triangle_markers.is_empty() && plain.names.is_empty());
}

#[test]
fn groups_and_materials_of_an_obj_file() {
    let plc = text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\ng top\nf 1 2 4\nusemtl steel\nf 2 3 4\nl 1 2\n\
         g marker_1 stated\nusemtl\nf 3 1 4\ng\nf 1 2 3\nusemtl steel\nf 3 2 1\n",
        Format::Obj,
    );
    assert_eq!(plc.triangle_markers, [0, 2, 3, 1, 0, 4]);
    assert_eq!(plc.segments, [Segment { ends: [0, 1], marker: 3 }]);
    assert_eq!(named(&plc), [(1, "stated"), (2, "top"), (3, "top/steel"), (4, "steel")]);
}

#[test]
fn colours_of_an_off_file() {
    let file = |tails: &[&str]| {
        let faces: String = tails.iter().map(|tail| format!("3 0 1 2 {tail}\n")).collect();
        text(&format!("OFF\n3 {} 0\n0 0 0\n1 0 0\n0 1 0\n{faces}", tails.len()), Format::Off)
    };
    // An index is the marker itself.
    let index = file(&["7", "", "-2", "0"]);
    assert_eq!((&index.triangle_markers[..], named(&index)), (&[7, 0, -2, 0][..], vec![]));
    let colours = file(&["255 0 0", "0.5 0.5 1.0 1.0", "255 0 0", "", "one two"]);
    assert_eq!(colours.triangle_markers, [1, 2, 1, 0, 0]);
    assert_eq!(named(&colours), [(1, "#ff0000"), (2, "#8080ffff")]);
    let plain = file(&["200 200 200", "200 200 200"]);
    assert!(plain.triangle_markers.is_empty() && plain.names.is_empty());
}

#[test]
fn markers_of_a_ply_file_are_a_property_or_colours() {
    let file = |properties: &str, tails: [&str; 2]| {
        text(
            &format!(
                "ply\nformat ascii 1.0\ncomment marker 5 lid of it\nelement vertex 3\nproperty float x\nproperty float y\n\
                 property float z\nelement face 2\nproperty list uchar int vertex_index\n{properties}element edge 1\n\
                 property int vertex1\nproperty int vertex2\nproperty int marker\nend_header\n0 0 0\n1 0 0\n0 1 0\n\
                 3 0 1 2 {}\n3 2 1 0 {}\n0 1 8\n",
                tails[0], tails[1]
            ),
            Format::Ply,
        )
    };
    let colour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let material = format!("property int material_index\n{colour}");
    let marker = format!("property short marker\n{material}");
    for (properties, tails, markers) in [
        (&marker[..], ["5 1 255 0 0", "-6 2 0 255 0"], vec![5, -6]),
        (&material, ["1 255 0 0", "2 0 255 0"], vec![1, 2]),
        (colour, ["255 0 0", "0 255 0"], vec![1, 2]),
        (colour, ["255 0 0", "255 0 0"], vec![]),
        ("property uchar red\n", ["1", "2"], vec![]),
    ] {
        let plc = file(properties, tails);
        assert_eq!(plc.triangle_markers, markers, "{properties}");
        assert_eq!(plc.segments, [Segment { ends: [0, 1], marker: 8 }], "{properties}");
        assert_eq!(plc.marker_name(5), Some("lid of it"));
        assert_eq!(plc.marker_name(1), (properties == colour && !markers.is_empty()).then_some("#ff0000"));
    }
}

#[test]
fn a_content_that_is_not_what_its_name_says_is_named() {
    use Format::*;
    let off = b"OFF\n1 0 0\n0 0 0\n";
    for (format, bytes, message) in [
        (Stl, &b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"[..], "not an STL file: it is a PNG image"),
        (Off, b"\x1f\x8b\x08\x00junk", "not an OFF file: it is gzip data: unpack it first"),
        (Obj, b"PK\x03\x04junk", "not an OBJ file: it is a ZIP archive"),
        (Ply, b"%PDF-1.5\n", "not a PLY file: it is a PDF document"),
        (Poly, b"ISO-10303-21;\nHEADER;\n", "not a .poly file: it is a STEP model"),
        (Smesh, b"\xff\xfe1\0 \0", "not a .smesh file: it is UTF-16 text"),
        (Node, b"\x01\x02\x03\x04", "not a .node file: it is binary data"),
        (Off, b"<!DOCTYPE html><html>", "not an OFF file: it is a web page"),
        (Stl, off, "not an STL file: it is an OFF file: its name should end in .off"),
        (Obj, off, "not an OBJ file: it is an OFF file"),
        (Ply, off, "not a PLY file: it is an OFF file"),
        (Off, b"# made by hand\n\nv 0 0 0\nv 1 0 0\n", "not an OFF file: it is an OBJ file"),
        (Off, b"solid x\nfacet normal", "not an OFF file: it is an STL file"),
        (Poly, b"ply\nformat ascii 1.0\n", "not a .poly file: it is a PLY file"),
        // For broken files of the right kind the error has the line.
        (Off, b"OFF\n1 0 0\n0 0\n", "line 3: "),
        (Stl, &[7; 300], "not an STL file, or cut short"),
    ] {
        let error = read_bytes(bytes, format).unwrap_err();
        assert_eq!(error.status, Status::Format, "{message}");
        assert!(error.message.starts_with(message), "{message}: {}", error.message);
        assert!(!error.message.contains('\n'));
    }
}

#[test]
#[cfg(unix)]
fn folders_and_devices_are_not_read() {
    let folder = Folder::new("devices");
    std::fs::create_dir(folder.file("a.off")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", folder.file("b.off")).unwrap();
    for (name, what) in [("a.off", "it is a folder"), ("b.off", "it is a device")] {
        let error = read(&folder.file(name)).unwrap_err();
        assert_eq!(error.status, Status::File);
        assert!(error.message.contains(what), "{error}");
    }
}
