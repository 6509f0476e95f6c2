//! PLY, text and binary of both byte orders. Source: Greg Turk, The PLY Polygon File Format (1994).
//!
//! It uses the elements `vertex` (x, y, z of any scalar type), `face` (the list `vertex_index` or `vertex_indices`; a scalar `marker`,
//! otherwise `material_index`, otherwise the colour `red`, `green`, `blue`, which numbers groups if there is more than one) and `edge`
//! (`vertex1`, `vertex2`: segments). Everything else is skipped. A comment
//! `marker K NAME` names a marker. Equal points are joined.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::io::groups;
use crate::io::groups::{Groups, Single};
use crate::io::surface::Surface;
use crate::io::text::{bad, float, int, shown, Line, Lines};
use crate::plc::{Plc, Segment};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn parse(name: &[u8]) -> Option<Scalar> {
        Some(match name {
            b"char" | b"int8" => Scalar::I8,
            b"uchar" | b"uint8" => Scalar::U8,
            b"short" | b"int16" => Scalar::I16,
            b"ushort" | b"uint16" => Scalar::U16,
            b"int" | b"int32" => Scalar::I32,
            b"uint" | b"uint32" => Scalar::U32,
            b"float" | b"float32" => Scalar::F32,
            b"double" | b"float64" => Scalar::F64,
            _ => return None,
        })
    }

    fn is_float(self) -> bool {
        matches!(self, Scalar::F32 | Scalar::F64)
    }

    fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Encoding {
    Text,
    Little,
    Big,
}

/// What a property is used for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Skip,
    Coordinate(usize),
    Corners,
    Marker,
    Material,
    Colour(usize),
    End(usize),
}

struct Property {
    role: Role,
    scalar: Scalar,
    /// The type of the count, for a list.
    list: Option<Scalar>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Vertex,
    Face,
    Edge,
    Other,
}

struct Element {
    kind: Kind,
    count: usize,
    properties: Vec<Property>,
}

impl Element {
    fn has(&self, role: Role) -> bool {
        self.properties.iter().any(|p| p.role == role)
    }

    /// Leaves one source of markers: `marker`, else `material_index`, else a whole colour.
    fn settle_marker(&mut self) {
        let marked = self.has(Role::Marker);
        let material = !marked && self.has(Role::Material);
        let colour = !marked && !material && (0..3).all(|i| self.has(Role::Colour(i)));
        for property in &mut self.properties {
            property.role = match property.role {
                Role::Material if material => Role::Marker,
                Role::Material => Role::Skip,
                Role::Colour(_) if !colour => Role::Skip,
                role => role,
            };
        }
    }
}

/// Reads a file.
pub(super) fn read(bytes: &[u8], control: &Control) -> Result<Plc, Error> {
    let mut lines = Lines::new(bytes, control);
    let Header { encoding, elements, names } = header(&mut lines)?;
    let mut groups = Groups::default();
    let mut values = Values { encoding, line: None, lines, binary: &[] };
    if encoding != Encoding::Text {
        values.binary = values.lines.remaining();
    }
    let mut surface = Surface::new(control);
    for element in &elements {
        reserve(&mut surface, element)?;
        for _ in 0..element.count {
            item(&mut values, element, &mut surface, &mut groups)?;
        }
    }
    values.expect_end()?;
    let mut plc = surface.finish_groups(true, &groups, Single::Nothing)?;
    for name in names.names {
        plc.set_marker_name(name.marker, &name.name)?;
    }
    Ok(plc)
}

fn reserve(surface: &mut Surface, element: &Element) -> Result<(), Error> {
    match element.kind {
        Kind::Vertex => surface.reserve(element.count, 0, 0),
        Kind::Face => surface.reserve(0, element.count, 3 * element.count),
        Kind::Edge => Ok(surface.segments.try_reserve_exact(element.count)?),
        Kind::Other => Ok(()),
    }
}

struct Header {
    encoding: Encoding,
    elements: Vec<Element>,
    /// The names of markers that comments gave.
    names: Plc,
}

fn header(lines: &mut Lines<'_>) -> Result<Header, Error> {
    let ended = |number: usize| bad(number, "the file ends within the header");
    let mut line = lines.next_raw().ok_or_else(|| ended(1))?;
    if line.token() != Some(b"ply") {
        return Err(bad(1, "not a PLY file: it does not start with 'ply'"));
    }
    let mut encoding = None;
    let mut names = Plc::default();
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let mut line = lines.next_raw().ok_or_else(|| ended(lines.number()))?;
        match line.token() {
            None | Some(b"obj_info") => {}
            Some(b"comment") => groups::take_name(line.rest(), &mut names)?,
            Some(b"format") => {
                encoding = Some(match line.expect("the format")? {
                    b"ascii" => Encoding::Text,
                    b"binary_little_endian" => Encoding::Little,
                    b"binary_big_endian" => Encoding::Big,
                    other => {
                        return Err(bad(line.number(), format_args!("unknown format '{}'", shown(other))))
                    }
                });
            }
            Some(b"element") => {
                fallible::push(&mut elements, element(&mut line, lines.remaining().len())?)?;
            }
            Some(b"property") => {
                let Some(element) = elements.last_mut() else {
                    return Err(bad(line.number(), "a property before the first element"));
                };
                fallible::push(&mut element.properties, property(&mut line, element.kind)?)?;
            }
            Some(b"end_header") => break,
            Some(other) => {
                return Err(bad(line.number(), format_args!("unknown header word '{}'", shown(other))))
            }
        }
    }
    let encoding = encoding.ok_or_else(|| bad(lines.number(), "the header names no format"))?;
    check_elements(&elements, encoding, lines)?;
    elements.iter_mut().for_each(Element::settle_marker);
    Ok(Header { encoding, elements, names })
}

fn element(line: &mut Line<'_>, available: usize) -> Result<Element, Error> {
    let kind = match line.expect("the name of an element")? {
        b"vertex" => Kind::Vertex,
        b"face" => Kind::Face,
        b"edge" => Kind::Edge,
        b"tristrips" => return Err(Error::new(Status::Unsupported, "PLY triangle strips are not supported")),
        _ => Kind::Other,
    };
    let count = line.count("the number of elements", 1, available)?;
    Ok(Element { kind, count, properties: Vec::new() })
}

fn property(line: &mut Line<'_>, kind: Kind) -> Result<Property, Error> {
    let first = line.expect("a type")?;
    let (list, scalar) = if first == b"list" {
        (Some(scalar(line, None)?), scalar(line, None)?)
    } else {
        (None, scalar(line, Some(first))?)
    };
    let name = line.expect("the name of a property")?;
    let role = match (kind, name, list.is_some()) {
        (Kind::Vertex, b"x", false) => Role::Coordinate(0),
        (Kind::Vertex, b"y", false) => Role::Coordinate(1),
        (Kind::Vertex, b"z", false) => Role::Coordinate(2),
        (Kind::Face, b"vertex_index" | b"vertex_indices", true) => Role::Corners,
        (Kind::Face | Kind::Edge, b"marker", false) => Role::Marker,
        (Kind::Face, b"material_index", false) => Role::Material,
        (Kind::Face, b"red" | b"diffuse_red", false) => Role::Colour(0),
        (Kind::Face, b"green" | b"diffuse_green", false) => Role::Colour(1),
        (Kind::Face, b"blue" | b"diffuse_blue", false) => Role::Colour(2),
        (Kind::Edge, b"vertex1", false) => Role::End(0),
        (Kind::Edge, b"vertex2", false) => Role::End(1),
        _ => Role::Skip,
    };
    let integral = matches!(role, Role::Corners | Role::Marker | Role::Material | Role::End(_));
    if (integral && scalar.is_float()) || list.is_some_and(Scalar::is_float) {
        return Err(bad(line.number(), format_args!("property '{}' must have an integer type", shown(name))));
    }
    Ok(Property { role, scalar, list })
}

fn scalar(line: &mut Line<'_>, token: Option<&[u8]>) -> Result<Scalar, Error> {
    let token = match token {
        Some(token) => token,
        None => line.expect("a type")?,
    };
    Scalar::parse(token).ok_or_else(|| bad(line.number(), format_args!("unknown type '{}'", shown(token))))
}

/// Checks that everything required is present once, and that the counts fit the file.
fn check_elements(elements: &[Element], encoding: Encoding, lines: &Lines<'_>) -> Result<(), Error> {
    let fail = |what: &str| Err(bad(lines.number(), what));
    for kind in [Kind::Vertex, Kind::Face, Kind::Edge] {
        if elements.iter().filter(|e| e.kind == kind).count() > 1 {
            return fail("an element is declared twice");
        }
    }
    let mut needed = 0u64;
    for element in elements {
        let roles: &[Role] = match element.kind {
            Kind::Vertex => &[Role::Coordinate(0), Role::Coordinate(1), Role::Coordinate(2)],
            Kind::Face => &[Role::Corners],
            Kind::Edge => &[Role::End(0), Role::End(1)],
            Kind::Other => &[],
        };
        if let Some(missing) = roles.iter().find(|&&role| !element.has(role)) {
            return fail(match missing {
                Role::Coordinate(_) => "the vertices lack a coordinate (properties x, y, z)",
                Role::Corners => "the faces lack the list vertex_index or vertex_indices",
                _ => "the edges lack vertex1 or vertex2",
            });
        }
        let size = |p: &Property| match (encoding, p.list) {
            (Encoding::Text, _) => 2,
            (_, Some(count)) => count.size() as u64,
            (_, None) => p.scalar.size() as u64,
        };
        let each: u64 = element.properties.iter().map(size).sum();
        needed = needed.saturating_add(each.saturating_mul(element.count as u64));
    }
    if !elements.iter().any(|e| e.kind == Kind::Vertex) {
        return fail("the header declares no vertices");
    }
    // The last number of a text needs no blank behind it.
    if needed > lines.remaining().len() as u64 + u64::from(encoding == Encoding::Text) {
        return fail("the header counts more elements than the file can hold");
    }
    Ok(())
}

/// The numbers of the body, one after the other.
struct Values<'a> {
    encoding: Encoding,
    lines: Lines<'a>,
    line: Option<Line<'a>>,
    binary: &'a [u8],
}

impl<'a> Values<'a> {
    fn token(&mut self) -> Result<&'a [u8], Error> {
        loop {
            if let Some(token) = self.line.as_mut().and_then(|line| line.token()) {
                return Ok(token);
            }
            match self.lines.next_raw() {
                None => return Err(bad(self.lines.number(), "the file ends before the last element")),
                next => self.line = next,
            }
        }
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let Some((head, rest)) = self.binary.split_first_chunk::<N>() else {
            return Err(Error::new(Status::Format, "the file ends before the last element"));
        };
        self.binary = rest;
        let mut bytes = *head;
        if self.encoding == Encoding::Big {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn float(&mut self, scalar: Scalar) -> Result<f64, Error> {
        if self.encoding == Encoding::Text {
            let token = self.token()?;
            return float(token).ok_or_else(|| {
                bad(self.lines.number(), format_args!("a number expected, found '{}'", shown(token)))
            });
        }
        Ok(match scalar {
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
            _ => self.int(scalar)? as f64,
        })
    }

    fn int(&mut self, scalar: Scalar) -> Result<i64, Error> {
        if self.encoding == Encoding::Text {
            let token = self.token()?;
            return int(token).ok_or_else(|| {
                bad(self.lines.number(), format_args!("an integer expected, found '{}'", shown(token)))
            });
        }
        Ok(match scalar {
            Scalar::I8 => i64::from(i8::from_le_bytes(self.take()?)),
            Scalar::U8 => i64::from(u8::from_le_bytes(self.take()?)),
            Scalar::I16 => i64::from(i16::from_le_bytes(self.take()?)),
            Scalar::U16 => i64::from(u16::from_le_bytes(self.take()?)),
            Scalar::I32 => i64::from(i32::from_le_bytes(self.take()?)),
            Scalar::U32 => i64::from(u32::from_le_bytes(self.take()?)),
            // No count, index or marker has such a type.
            Scalar::F32 | Scalar::F64 => {
                return Err(Error::new(Status::Format, "an integer expected, found a real"))
            }
        })
    }

    fn expect_end(&mut self) -> Result<(), Error> {
        if self.encoding != Encoding::Text {
            return match self.binary {
                // Some writers end the last line of a binary file.
                [] | b"\n" | b"\r\n" => Ok(()),
                rest => Err(Error::new(
                    Status::Format,
                    format_args!("{} bytes after the last element: more than the header counts", rest.len()),
                )),
            };
        }
        match self.token() {
            Err(_) => Ok(()),
            Ok(token) => Err(bad(
                self.lines.number(),
                format_args!("'{}' after the last element: more than the header counts", shown(token)),
            )),
        }
    }
}

/// Reads one vertex, face, edge or other item.
fn item(
    values: &mut Values<'_>,
    element: &Element,
    surface: &mut Surface,
    groups: &mut Groups,
) -> Result<(), Error> {
    let (mut point, mut ends, mut marker, mut colour, mut coloured) =
        ([0.0; 3], [0u32; 2], 0i32, [0.0; 3], false);
    for property in &element.properties {
        match (property.role, property.list) {
            (Role::Coordinate(axis), _) => point[axis] = values.float(property.scalar)?,
            (Role::End(end), _) => {
                ends[end] = u32::try_from(values.int(property.scalar)?).unwrap_or(u32::MAX)
            }
            (Role::Colour(i), None) => {
                let value = values.float(property.scalar)?;
                coloured = true;
                // Reals go from 0 to 1; what does not counts as 0.
                colour[i] = match property.scalar.is_float() {
                    true if (0.0..=1.0).contains(&value) => 255.0 * value,
                    true => 0.0,
                    false => value,
                };
            }
            (Role::Marker, _) => {
                let value = values.int(property.scalar)?;
                marker = i32::try_from(value).map_err(|_| {
                    bad(values.lines.number(), format_args!("marker {value} does not fit 32 bits"))
                })?;
            }
            (role, Some(count_type)) => {
                let count = values.int(count_type)?;
                if role == Role::Corners && count < 2 || count < 0 {
                    return Err(bad(values.lines.number(), format_args!("a list of {count} entries")));
                }
                for _ in 0..count {
                    match role {
                        Role::Corners => surface.corner(values.int(property.scalar)?)?,
                        _ => drop(values.float(property.scalar)?),
                    }
                }
            }
            (_, None) => drop(values.float(property.scalar)?),
        }
    }
    let group = match coloured {
        true => groups.of_colour(&colour)?,
        false => groups.of_marker(marker)?,
    };
    match element.kind {
        Kind::Vertex => surface.point(point)?,
        Kind::Face => surface.end_polygon(group)?,
        Kind::Edge => {
            fallible::push(&mut surface.segments, Segment { ends, marker: group })?;
        }
        Kind::Other => {}
    }
    Ok(())
}
