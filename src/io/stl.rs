//! STL, text and binary. Source: 3D Systems, StereoLithography Interface Specification (1989).
//!
//! A file is binary if its length is 84 + 50 n, n being the count at byte 80: text cannot fulfil that, and binary files
//! that begin with "solid" exist. Equal points are joined: the format has no other way to say that triangles meet.
use super::surface::Surface;
use super::text::{bad, float, shown, Lines};
use crate::error::{Error, Status};
use crate::plc::Plc;

/// Reads a file of either kind. The triangles of the k-th solid of several have marker k, from 1.
pub(super) fn read(bytes: &[u8]) -> Result<Plc, Error> {
    if let Some(count) = binary_count(bytes) {
        return read_binary(bytes, count);
    }
    let start = bytes.iter().position(|&b| b > b' ').unwrap_or(bytes.len());
    if bytes[start..].len() >= 5 && bytes[start..start + 5].eq_ignore_ascii_case(b"solid") {
        return read_text(bytes);
    }
    Err(Error::new(
        Status::Format,
        match bytes.get(80..84).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes) {
            Some(n) => format!(
                "line 1: not an STL file: it does not start with 'solid', and a binary file of {n} triangles would have {} bytes, not {}",
                84 + 50 * u64::from(n),
                bytes.len()
            ),
            None => format!("line 1: not an STL file: {} bytes that do not start with 'solid'", bytes.len()),
        },
    ))
}

fn binary_count(bytes: &[u8]) -> Option<usize> {
    let count = u32::from_le_bytes(bytes.get(80..84)?.try_into().ok()?);
    (84 + 50 * u64::from(count) == bytes.len() as u64).then_some(count as usize)
}

fn read_binary(bytes: &[u8], count: usize) -> Result<Plc, Error> {
    if count == 0 {
        return Err(Error::new(Status::Format, "the file has no triangles"));
    }
    let mut surface = Surface::default();
    surface.reserve(3 * count, count, 3 * count)?;
    for triangle in bytes[84..].chunks_exact(50) {
        for corner in triangle[12..48].chunks_exact(12) {
            let at = |i: usize| {
                f64::from(f32::from_le_bytes([corner[i], corner[i + 1], corner[i + 2], corner[i + 3]]))
            };
            surface.corner(surface.points.len() as i64)?;
            surface.point([at(0), at(4), at(8)])?;
        }
        surface.end_polygon(0)?;
    }
    surface.finish(true)
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

fn read_text(bytes: &[u8]) -> Result<Plc, Error> {
    let mut words = Words { lines: Lines::new(bytes), line: None };
    let mut surface = Surface::default();
    let mut marker_of = Vec::new();
    let mut solids = 0i32;
    while let Some(word) = words.next() {
        if !word.eq_ignore_ascii_case(b"solid") {
            return Err(words.unexpected("solid", Some(word)));
        }
        words.line = None; // the rest of the line is the name
        solids = solids.saturating_add(1);
        loop {
            let word = words.next();
            match word {
                Some(w) if w.eq_ignore_ascii_case(b"facet") => {
                    read_facet(&mut words, &mut surface)?;
                    marker_of.try_reserve(1)?;
                    marker_of.push(solids);
                }
                Some(w) if w.eq_ignore_ascii_case(b"endsolid") => {
                    words.line = None;
                    break;
                }
                _ => return Err(words.unexpected("facet or endsolid", word)),
            }
        }
    }
    if marker_of.is_empty() {
        return Err(bad(words.lines.number(), "the file has no triangles"));
    }
    let mut plc = surface.finish(true)?;
    if solids > 1 {
        plc.triangle_markers = marker_of;
    }
    Ok(plc)
}

fn read_facet(words: &mut Words<'_>, surface: &mut Surface) -> Result<(), Error> {
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
    surface.end_polygon(0)
}
