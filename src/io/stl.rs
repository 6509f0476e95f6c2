//! STL, text and binary. Source: 3D Systems, StereoLithography Interface Specification (1989).
//!
//! A file is binary if its length is 84 + 50 n, with n the count at byte 80: text never satisfies this, and there are binary files that
//! begin with "solid". Equal points are joined, since the format has no other way to express that triangles meet.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::io::groups::{Groups, Single};
use crate::io::surface::Surface;
use crate::io::text::{bad, float, shown, Lines};
use crate::plc::Plc;

/// Reads a file of either kind. The triangles of the k-th solid of several have marker k, from 1, and the solid's name names
/// it; a solid `marker_K NAME` has marker K. In a binary file the two attribute bytes of a triangle (colours, in most files that use them)
/// number groups, if they differ.
pub(super) fn read(bytes: &[u8], control: &Control) -> Result<Plc, Error> {
    if let Some(count) = binary_count(bytes) {
        return read_binary(bytes, count, control);
    }
    let start = bytes.iter().position(|&b| b > b' ').unwrap_or(bytes.len());
    if bytes[start..].len() >= 5 && bytes[start..start + 5].eq_ignore_ascii_case(b"solid") {
        return read_text(bytes, control);
    }
    let error = |message: std::fmt::Arguments| Err(Error::new(Status::Format, message));
    match bytes.get(80..84).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes) {
            Some(n) => error(format_args!(
                "not an STL file, or cut short: it does not start with 'solid' as text does, and the {n} triangles that a \
                 binary file would announce take {} bytes, not {}",
                84 + 50 * u64::from(n),
                bytes.len()
            )),
            None => error(format_args!("not an STL file: {} bytes that do not start with 'solid'", bytes.len())),
    }
}

fn binary_count(bytes: &[u8]) -> Option<usize> {
    let count = u32::from_le_bytes(bytes.get(80..84)?.try_into().ok()?);
    (84 + 50 * u64::from(count) == bytes.len() as u64).then_some(count as usize)
}

fn read_binary(bytes: &[u8], count: usize, control: &Control) -> Result<Plc, Error> {
    if count == 0 {
        return Err(Error::new(Status::Format, "the file has no triangles"));
    }
    let mut groups = Groups::default();
    let mut surface = Surface::new(control);
    surface.reserve(3 * count, count, 3 * count)?;
    for triangle in bytes[84..].chunks_exact(50) {
        for corner in triangle[12..48].chunks_exact(12) {
            let at = |i: usize| {
                f64::from(f32::from_le_bytes([corner[i], corner[i + 1], corner[i + 2], corner[i + 3]]))
            };
            surface.corner(surface.points.len() as i64)?;
            surface.point([at(0), at(4), at(8)])?;
        }
        let number = groups.of_key(&triangle[48..50], || attribute_name(triangle[48], triangle[49]))?;
        surface.end_polygon(number)?;
    }
    surface.finish_groups(true, &groups, Single::Nothing)
}

/// The name of the group of an attribute.
fn attribute_name(low: u8, high: u8) -> Result<Vec<u8>, Error> {
    const DIGITS: &[u8; 16] = b"0123456789abcdef";
    let mut name = fallible::reserved(16)?;
    fallible::append(&mut name, b"attribute 0x")?;
    for byte in [high, low] {
        fallible::append(&mut name, &[DIGITS[usize::from(byte >> 4)], DIGITS[usize::from(byte & 15)]])?;
    }
    Ok(name)
}

/// The words of a text STL with their line.
struct Words<'a> {
    lines: Lines<'a>,
    line: Option<super::text::Line<'a>>,
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(token) = self.line.as_mut().and_then(|line| line.token()) {
                return Some(token);
            }
            self.line = Some(self.lines.next_raw()?);
        }
    }

    fn expect(&mut self, word: &str) -> Result<(), Error> {
        let found = self.next();
        if found.is_some_and(|f| f.eq_ignore_ascii_case(word.as_bytes())) {
            return Ok(());
        }
        Err(self.unexpected(word, found))
    }

    fn unexpected(&self, expected: &str, found: Option<&[u8]>) -> Error {
        match found {
            None => bad(self.lines.number(), format_args!("the file ends where '{expected}' was expected")),
            Some(token) => {
                bad(self.lines.number(), format_args!("'{expected}' expected, found '{}'", shown(token)))
            }
        }
    }

    fn float(&mut self, what: &str) -> Result<f64, Error> {
        let token = self.next();
        token.and_then(float).ok_or_else(|| self.unexpected(what, token))
    }
}

fn read_text(bytes: &[u8], control: &Control) -> Result<Plc, Error> {
    let mut words = Words { lines: Lines::new(bytes, control), line: None };
    let mut surface = Surface::new(control);
    let mut groups = Groups::default();
    let mut triangles = 0u64;
    while let Some(word) = words.next() {
        if !word.eq_ignore_ascii_case(b"solid") {
            return Err(words.unexpected("solid", Some(word)));
        }
        let name = words.line.take().map_or(&[][..], |line| line.rest().trim_ascii());
        let solid = groups.add(name)?;
        loop {
            let word = words.next();
            match word {
                Some(w) if w.eq_ignore_ascii_case(b"facet") => {
                    read_facet(&mut words, &mut surface, solid)?;
                    triangles += 1;
                }
                Some(w) if w.eq_ignore_ascii_case(b"endsolid") => {
                    words.line = None;
                    break;
                }
                _ => return Err(words.unexpected("facet or endsolid", word)),
            }
        }
    }
    if triangles == 0 {
        return Err(bad(words.lines.number(), "the file has no triangles"));
    }
    surface.finish_groups(true, &groups, Single::Unmarked)
}

fn read_facet(words: &mut Words<'_>, surface: &mut Surface, solid: i32) -> Result<(), Error> {
    words.expect("normal")?;
    for _ in 0..3 {
        words.float("a number of the normal")?;
    }
    words.expect("outer")?;
    words.expect("loop")?;
    for _ in 0..3 {
        words.expect("vertex")?;
        surface.corner(surface.points.len() as i64)?;
        let point =
            [words.float("coordinate x")?, words.float("coordinate y")?, words.float("coordinate z")?];
        surface.point(point)?;
    }
    words.expect("endloop")?;
    words.expect("endfacet")?;
    surface.end_polygon(solid)
}
