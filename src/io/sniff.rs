//! Recognizes content that does not match a file's extension, for messages that say more than where reading stopped.
use crate::io::Format;

/// First bytes and what they belong to.
const BEGINNINGS: &[(&[u8], &str)] = &[
    (b"\x89PNG", "a PNG image"),
    (b"\xff\xd8\xff", "a JPEG image"),
    (b"GIF8", "a GIF image"),
    (b"%PDF", "a PDF document"),
    (b"PK\x03\x04", "a ZIP archive (3MF and Office files are such)"),
    (b"\x1f\x8b", "gzip data: unpack it first"),
    (b"BZh", "bzip2 data: unpack it first"),
    (b"\xfd7zXZ", "xz data: unpack it first"),
    (b"\x28\xb5\x2f\xfd", "zstd data: unpack it first"),
    (b"7z\xbc\xaf", "a 7-Zip archive"),
    (b"\x7fELF", "a program"),
    (b"MZ", "a program"),
    (b"glTF", "a glTF model"),
    (b"\x89HDF", "an HDF5 file"),
    (b"\xff\xfe", "UTF-16 text: save it as UTF-8"),
    (b"\xfe\xff", "UTF-16 text: save it as UTF-8"),
    (b"ISO-10303-21", "a STEP model: export it as STL or another surface format"),
    (b"$MeshFormat", "a Gmsh mesh"),
    (b"# vtk DataFile", "a legacy VTK file"),
    (b"MeshVersionFormatted", "a MEDIT mesh"),
    (b"<VTKFile", "a VTK XML file"),
    (b"<!DOCTYPE", "a web page"),
    (b"<!doctype", "a web page"),
    (b"<html", "a web page"),
    (b"<?xml", "an XML document"),
];

/// First words of our own text formats.
const WORDS: &[(&[u8], Format, &str)] = &[
    (b"OFF", Format::Off, "an OFF file: its name should end in .off"),
    (b"COFF", Format::Off, "an OFF file: its name should end in .off"),
    (b"ply", Format::Ply, "a PLY file: its name should end in .ply"),
    (b"solid", Format::Stl, "an STL file: its name should end in .stl"),
    (b"v", Format::Obj, "an OBJ file: its name should end in .obj"),
];

/// A description of content that could not be read in a format; `None` if it is not recognized.
pub(super) fn other_kind(bytes: &[u8], format: Format) -> Option<&'static str> {
    if let Some((_, kind)) = BEGINNINGS.iter().find(|(beginning, _)| bytes.starts_with(beginning)) {
        return Some(kind);
    }
    let text = &bytes[..bytes.len().min(1024)];
    if text.iter().any(|&b| b < b' ' && !matches!(b, b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)) {
        // These two may be binary: their readers report what is wrong.
        return (!matches!(format, Format::Stl | Format::Ply)).then_some("binary data");
    }
    let lines = text.split(|&b| b == b'\n').map(<[u8]>::trim_ascii);
    let content = lines.into_iter().find(|line| !line.is_empty() && !line.starts_with(b"#"))?;
    let word = content.split(|&b| b <= b' ').next()?;
    WORDS.iter().find(|(known, of, _)| *known == word && *of != format).map(|(.., kind)| *kind)
}
