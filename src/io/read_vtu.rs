//! Reads VTK XML unstructured grids. Source: as in [`vtu`](crate::io::vtu).
//!
//! One piece, little endian; arrays appended in raw binary, plain or zlib-compressed, as our writer makes them, or as text inside the
//! document. Not read: base64, other compressors. Tetrahedra have the cell array `region` as their attribute; triangles and lines are faces and
//! edges to be kept, with the cell array `marker`. Of the point arrays `marker` and `attribute_0`, `attribute_1` … are read.
//!
//! The header is XML, but no parser is needed: it has no text besides arrays, and comments have no place in it.
use crate::control::Control;
use crate::error::Element;
use crate::error::{Error, Status};
use crate::fallible;
use crate::io::mesh_file::{Builder, MeshFile};
use crate::io::surface::no_such_point;
use crate::io::text::{bad, float, int, shown};

/// How numbers are stored.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Float { bytes: usize },
    Int { bytes: usize, signed: bool },
}

impl Kind {
    fn of(name: &[u8]) -> Option<Kind> {
        Some(match name {
            b"Float32" => Kind::Float { bytes: 4 },
            b"Float64" => Kind::Float { bytes: 8 },
            b"Int8" => Kind::Int { bytes: 1, signed: true },
            b"UInt8" => Kind::Int { bytes: 1, signed: false },
            b"Int16" => Kind::Int { bytes: 2, signed: true },
            b"UInt16" => Kind::Int { bytes: 2, signed: false },
            b"Int32" => Kind::Int { bytes: 4, signed: true },
            b"UInt32" => Kind::Int { bytes: 4, signed: false },
            b"Int64" => Kind::Int { bytes: 8, signed: true },
            b"UInt64" => Kind::Int { bytes: 8, signed: false },
            _ => return None,
        })
    }

    fn bytes(self) -> usize {
        match self {
            Kind::Float { bytes } | Kind::Int { bytes, .. } => bytes,
        }
    }
}

/// Where an array is.
#[derive(Clone, Copy)]
enum Place<'a> {
    /// Text in the document.
    Text(&'a [u8]),
    /// So many bytes behind the mark in the appended data.
    Appended(usize),
}

/// One array of the header.
#[derive(Clone, Copy)]
struct Array<'a> {
    section: &'a [u8],
    name: &'a [u8],
    kind: Kind,
    place: Place<'a>,
    line: usize,
}

/// The header: everything before the appended data.
struct Header<'a> {
    points: usize,
    cells: usize,
    arrays: Vec<Array<'a>>,
    /// What is behind the mark.
    appended: &'a [u8],
    /// Sizes of blocks have four bytes, not eight.
    is_short: bool,
    is_compressed: bool,
}

/// A tag of the document: what is between its angle brackets.
#[derive(Clone, Copy)]
struct Tag<'a> {
    name: &'a [u8],
    rest: &'a [u8],
    line: usize,
}

impl<'a> Tag<'a> {
    /// The value of an attribute.
    fn get(&self, key: &str) -> Option<&'a [u8]> {
        let mut rest = self.rest;
        loop {
            let equals = rest.iter().position(|&b| b == b'=')?;
            let (name, behind) = (rest[..equals].trim_ascii(), &rest[equals + 1..]);
            let behind = behind.trim_ascii_start();
            let quote = *behind.first().filter(|&&b| b == b'"' || b == b'\'')?;
            let end = behind[1..].iter().position(|&b| b == quote)?;
            if name == key.as_bytes() {
                return Some(&behind[1..=end]);
            }
            rest = &behind[end + 2..];
        }
    }

    fn count(&self, key: &str) -> Result<usize, Error> {
        let value = self.get(key).and_then(int).and_then(|value| usize::try_from(value).ok());
        value
            .filter(|&count| count < u32::MAX as usize)
            .ok_or_else(|| bad(self.line, format_args!("<{}> without a number {key}", shown(self.name))))
    }
}

/// Goes through the tags of a document.
struct Tags<'a> {
    rest: &'a [u8],
    line: usize,
    control: &'a Control<'a>,
}

impl<'a> Tags<'a> {
    fn next(&mut self) -> Option<Tag<'a>> {
        self.control.step().ok()?;
        let start = self.skip_to(b'<')?;
        debug_assert!(start <= self.rest.len());
        let line = self.line;
        let end = self.rest.iter().position(|&b| b == b'>')?;
        let tag = &self.rest[..end];
        self.line += lines(tag);
        self.rest = &self.rest[end + 1..];
        let name_end = tag.iter().position(|&b| b <= b' ').unwrap_or(tag.len());
        let (name, rest) = tag.split_at(name_end);
        Some(Tag { name: name.strip_suffix(b"/").unwrap_or(name), rest, line })
    }

    /// Goes behind the next such byte; returns how many bytes were before it.
    fn skip_to(&mut self, byte: u8) -> Option<usize> {
        let at = self.rest.iter().position(|&b| b == byte)?;
        self.line += lines(&self.rest[..at]);
        self.rest = &self.rest[at + 1..];
        Some(at)
    }

    /// The text up to the next tag.
    fn text(&self) -> &'a [u8] {
        let end = self.rest.iter().position(|&b| b == b'<').unwrap_or(self.rest.len());
        &self.rest[..end]
    }
}

fn lines(text: &[u8]) -> usize {
    text.iter().filter(|&&b| b == b'\n').count()
}

fn unsupported(line: usize, what: &str) -> Error {
    Error::new(Status::Unsupported, format_args!("line {line}: {what}"))
}

impl<'a> Header<'a> {
    fn read(bytes: &'a [u8], control: &'a Control<'a>) -> Result<Header<'a>, Error> {
        let mut tags = Tags { rest: bytes, line: 1, control };
        let mut header = Header {
            points: 0,
            cells: 0,
            arrays: Vec::new(),
            appended: &[],
            is_short: true,
            is_compressed: false,
        };
        let (mut section, mut pieces, mut is_grid): (&[u8], _, _) = (b"", 0, false);
        while let Some(tag) = tags.next() {
            match tag.name {
                b"VTKFile" => {
                    header.file(&tag)?;
                    is_grid = true;
                }
                b"Piece" => {
                    pieces += 1;
                    header.points = tag.count("NumberOfPoints")?;
                    header.cells = tag.count("NumberOfCells")?;
                }
                b"PointData" | b"CellData" | b"Points" | b"Cells" => section = tag.name,
                b"DataArray" => {
                    let array = array_of(&tag, section, &tags)?;
                    fallible::push(&mut header.arrays, array)?;
                }
                b"AppendedData" => {
                    if tag.get("encoding") != Some(b"raw") {
                        return Err(unsupported(tag.line, "appended data are read in raw binary only"));
                    }
                    if tags.skip_to(b'_').is_none() {
                        return Err(bad(tag.line, "the appended data lack their mark '_'"));
                    }
                    header.appended = tags.rest;
                    break;
                }
                _ => {}
            }
        }
        match (is_grid, pieces) {
            (false, _) => Err(bad(1, "'<VTKFile' expected")),
            (_, 1) => Ok(header),
            (_, 0) => Err(bad(tags.line, "the grid has no <Piece>")),
            _ => Err(unsupported(tags.line, "grids of several pieces are not read")),
        }
    }

    fn file(&mut self, tag: &Tag) -> Result<(), Error> {
        if tag.get("type") != Some(b"UnstructuredGrid") {
            return Err(unsupported(tag.line, "only unstructured grids are read"));
        }
        if tag.get("byte_order").is_some_and(|order| order != b"LittleEndian") {
            return Err(unsupported(tag.line, "only little endian is read"));
        }
        self.is_short = tag.get("header_type") != Some(b"UInt64");
        self.is_compressed = match tag.get("compressor") {
            None => false,
            Some(b"vtkZLibDataCompressor") => true,
            Some(_) => return Err(unsupported(tag.line, "of compressors only zlib is read")),
        };
        Ok(())
    }

    fn find(&self, section: &str, name: &str) -> Option<&Array<'a>> {
        let has = |array: &&Array| array.section == section.as_bytes() && array.name == name.as_bytes();
        self.arrays.iter().find(has)
    }

    /// The numbers of an array that must have so many; up to `more` of them may be there if that is not known.
    fn numbers(&self, array: &Array, count: usize, control: &Control) -> Result<Vec<f64>, Error> {
        let wrong = |found: usize| {
            let name = shown(array.name);
            Err(bad(array.line, format_args!("array '{name}' has {found} numbers instead of {count}")))
        };
        let mut out = Vec::new();
        match array.place {
            Place::Text(text) => {
                for token in text.split(|&b| b <= b' ').filter(|token| !token.is_empty()) {
                    control.step()?;
                    let Some(value) = float(token) else {
                        return Err(bad(
                            array.line,
                            format_args!("a number expected, found '{}'", shown(token)),
                        ));
                    };
                    fallible::push(&mut out, value)?;
                }
                if out.len() != count {
                    return wrong(out.len());
                }
            }
            Place::Appended(offset) => {
                let data = self.data(array, offset, count.saturating_mul(array.kind.bytes()), control)?;
                if data.len() != count.saturating_mul(array.kind.bytes()) {
                    return wrong(data.len() / array.kind.bytes());
                }
                out.try_reserve_exact(count)?;
                for item in data.chunks_exact(array.kind.bytes()) {
                    fallible::push(&mut out, number(item, array.kind))?;
                }
            }
        }
        Ok(out)
    }

    /// The bytes of an appended array, of which there should be `wanted`.
    fn data(&self, array: &Array, offset: usize, wanted: usize, control: &Control) -> Result<Vec<u8>, Error> {
        let short =
            || bad(array.line, format_args!("the data of array '{}' are not there", shown(array.name)));
        let mut rest = self.appended.get(offset..).ok_or_else(short)?;
        let word = |rest: &mut &[u8]| -> Result<usize, Error> {
            let size = if self.is_short { 4 } else { 8 };
            let (word, behind) = rest.split_at_checked(size).ok_or_else(short)?;
            *rest = behind;
            let mut bytes = [0; 8];
            bytes[..size].copy_from_slice(word);
            usize::try_from(u64::from_le_bytes(bytes)).map_err(|_| short())
        };
        if !self.is_compressed {
            let size = word(&mut rest)?;
            let data = rest.get(..size).ok_or_else(short)?;
            return Ok(fallible::copied(data)?);
        }
        let (blocks, block, partial) = (word(&mut rest)?, word(&mut rest)?, word(&mut rest)?);
        // What is not wanted is not unpacked: a small file may claim to hold any number of bytes.
        let whole = blocks.saturating_sub(usize::from(partial > 0));
        let total = whole.saturating_mul(block).saturating_add(partial);
        if total != wanted || blocks > rest.len() / 4 {
            let name = shown(array.name);
            return Err(bad(
                array.line,
                format_args!("array '{name}' has {total} bytes instead of {wanted}"),
            ));
        }
        let mut sizes = fallible::reserved(blocks)?;
        for _ in 0..blocks {
            fallible::push(&mut sizes, word(&mut rest)?)?;
        }
        // Deflate packs at most 1032 bytes into one.
        let packed = sizes.iter().fold(0usize, |sum, &size| sum.saturating_add(size));
        if packed > rest.len() || total > packed.saturating_mul(1040).saturating_add(64) {
            return Err(short());
        }
        control.room(total)?;
        let mut data = fallible::filled(0u8, total)?;
        let mut left = &mut data[..];
        for (i, &size) in sizes.iter().enumerate() {
            control.look()?;
            let (block_data, behind) = rest.split_at_checked(size).ok_or_else(short)?;
            rest = behind;
            let length = if i == whole { partial } else { block };
            let (target, others) = left.split_at_mut_checked(length).ok_or_else(short)?;
            let (found, code) =
                zlib_rs::decompress_slice(target, block_data, zlib_rs::InflateConfig::default());
            let found = found.len();
            if code == zlib_rs::ReturnCode::MemError {
                return Err(Error::new(Status::OutOfMemory, "out of memory"));
            }
            if code != zlib_rs::ReturnCode::Ok || found != length {
                let name = shown(array.name);
                return Err(bad(array.line, format_args!("the data of array '{name}' are damaged")));
            }
            left = others;
        }
        Ok(data)
    }
}

fn array_of<'a>(tag: &Tag<'a>, section: &'a [u8], tags: &Tags<'a>) -> Result<Array<'a>, Error> {
    let Some(kind) = tag.get("type").and_then(Kind::of) else {
        return Err(unsupported(tag.line, "an array of a type that is not read"));
    };
    let place = match tag.get("format") {
        Some(b"appended") => Place::Appended(tag.count("offset")?),
        Some(b"ascii") => Place::Text(tags.text()),
        _ => {
            return Err(unsupported(
                tag.line,
                "arrays in base64 are not read: save as text or appended raw data",
            ))
        }
    };
    let name = tag.get("Name").unwrap_or_default();
    Ok(Array { section, name, kind, place, line: tag.line })
}

fn number(item: &[u8], kind: Kind) -> f64 {
    let mut bytes = [0; 8];
    bytes[..item.len()].copy_from_slice(item);
    match kind {
        Kind::Float { bytes: 4 } => f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])),
        Kind::Float { .. } => f64::from_le_bytes(bytes),
        Kind::Int { signed: false, .. } => u64::from_le_bytes(bytes) as f64,
        Kind::Int { bytes: size, .. } => {
            let unused = 64 - 8 * size as u32;
            ((u64::from_le_bytes(bytes) << unused) as i64 >> unused) as f64
        }
    }
}

/// Nodes and corners of a type of cells, if it is read.
fn shape(kind: f64) -> Option<(usize, usize)> {
    // Vertices are passed over.
    let kinds =
        [(1.0, 1, 1), (3.0, 2, 2), (21.0, 3, 2), (5.0, 3, 3), (22.0, 6, 3), (10.0, 4, 4), (24.0, 10, 4)];
    kinds.iter().find(|x| x.0 == kind).map(|x| (x.1, x.2))
}

/// Reads a mesh.
pub(super) fn read(bytes: &[u8], control: &Control) -> Result<MeshFile, Error> {
    let header = Header::read(bytes, control)?;
    let mut built = Builder::default();
    built.file.arrays.points = points_of(&header, control)?;
    point_data(&header, &mut built.file, control)?;
    let data = |name: &str| -> Result<Vec<f64>, Error> {
        match header.find("CellData", name) {
            Some(array) => header.numbers(array, header.cells, control),
            None => Ok(Vec::new()),
        }
    };
    let (regions, markers) = (data("region")?, data("marker")?);
    each_cell(&header, control, |cell, nodes, corners| {
        let list = if corners == 4 { &regions } else { &markers };
        built.add(nodes, corners, list.get(cell).copied().unwrap_or(0.0))
    })?;
    if regions.is_empty() {
        built.file.arrays.attributes = Vec::new();
    }
    built.finish()
}

/// Triangles with their markers.
type Faces = (Vec<[u32; 3]>, Vec<i32>);

/// Reads the faces of a mesh with so many points from the file that has them alone: `point` is the mesh's point of each node.
pub(super) fn read_faces(bytes: &[u8], points: usize, control: &Control) -> Result<Faces, Error> {
    let header = Header::read(bytes, control)?;
    let Some(array) = header.find("PointData", "point") else {
        return Err(bad(1, "the faces lack the point array 'point', which says where they are in the mesh"));
    };
    let of = header.numbers(array, header.points, control)?;
    let markers = match header.find("CellData", "marker") {
        Some(array) => header.numbers(array, header.cells, control)?,
        None => Vec::new(),
    };
    let mut found: Faces = Default::default();
    each_cell(&header, control, |cell, nodes, corners| {
        let mut face = [0; 3];
        if corners != 3 {
            return Ok(());
        }
        // Of second order the other nodes are no points.
        for (corner, &node) in face.iter_mut().zip(nodes) {
            let v = of[node as usize];
            if !(v >= 0.0 && v < points as f64) {
                return Err(bad(array.line, format_args!("node {node} is no point of the mesh")));
            }
            *corner = v as u32;
        }
        fallible::push(&mut found.0, face)?;
        fallible::push(&mut found.1, markers.get(cell).copied().unwrap_or(0.0) as i32)?;
        Ok(())
    })?;
    Ok(found)
}

fn points_of(header: &Header, control: &Control) -> Result<Vec<[f64; 3]>, Error> {
    let points = header.arrays.iter().find(|array| array.section == b"Points");
    let array = points.ok_or_else(|| bad(1, "the grid has no points"))?;
    let numbers = header.numbers(array, 3 * header.points, control)?;
    Ok(fallible::collect(numbers.chunks_exact(3).map(|p| [p[0], p[1], p[2]]))?)
}

fn point_data(header: &Header, file: &mut MeshFile, control: &Control) -> Result<(), Error> {
    if let Some(array) = header.find("PointData", "marker") {
        let markers = header.numbers(array, header.points, control)?;
        file.markers = fallible::collect(markers.iter().map(|&marker| marker as i32))?;
    }
    let mut columns: Vec<Vec<f64>> = Vec::new();
    loop {
        let name = fallible::text(format_args!("attribute_{}", columns.len()))?;
        let Some(array) = header.find("PointData", &name) else { break };
        let column = header.numbers(array, header.points, control)?;
        fallible::push(&mut columns, column)?;
    }
    file.attribute_count = columns.len();
    file.attributes.try_reserve_exact(columns.len() * header.points)?;
    for i in 0..header.points {
        fallible::extend(&mut file.attributes, columns.iter().map(|column| column[i]))?;
    }
    Ok(())
}

/// Hands each cell over: its number, its nodes, and how many of these are corners.
fn each_cell(
    header: &Header,
    control: &Control,
    mut each: impl FnMut(usize, &[u32], usize) -> Result<(), Error>,
) -> Result<(), Error> {
    let array = |name: &str| {
        header.find("Cells", name).ok_or_else(|| bad(1, format_args!("the cells have no array '{name}'")))
    };
    let types = header.numbers(array("types")?, header.cells, control)?;
    let offsets = header.numbers(array("offsets")?, header.cells, control)?;
    let nodes = array("connectivity")?;
    let mut count = 0;
    for (cell, &kind) in types.iter().enumerate() {
        let Some((size, _)) = shape(kind) else {
            return Err(unsupported(
                array("types")?.line,
                "cells of other types than tetrahedra, triangles and lines are not read",
            ));
        };
        count += size;
        if offsets[cell] != count as f64 {
            return Err(bad(
                array("offsets")?.line,
                format_args!("the offset of cell {cell} does not fit its type"),
            ));
        }
    }
    let list = header.numbers(nodes, count, control)?;
    let (mut from, mut row) = (0, Vec::new());
    for (cell, &kind) in types.iter().enumerate() {
        control.step()?;
        let (size, corners) = shape(kind).unwrap_or((1, 1));
        row.clear();
        for &node in &list[from..from + size] {
            if !(node >= 0.0 && node < header.points as f64) {
                let what =
                    format_args!("line {}: cell {cell} has node {node}, which does not exist", nodes.line);
                return Err(no_such_point(Element::Tet(cell as u32), what));
            }
            fallible::push(&mut row, node as u32)?;
        }
        from += size;
        each(cell, &row, corners)?;
    }
    Ok(())
}
