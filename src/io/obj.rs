//! Wavefront OBJ: vertices, polygons, lines; groups and materials become markers. Source: Wavefront Technologies, Object
//! Files (.obj), appendix B1.
//!
//! Faces and lines without group and material have marker 0. Each new pair of group and material gets the next number from 1 and its name;
//! a group `marker_K NAME` has marker K, whatever its material. Texture coordinates, normals and display attributes are skipped, free-form
//! curves and surfaces refused. Equal points are joined.
use crate::control::Control;
use crate::error::{Element, Error, Status};
use crate::fallible;
use crate::io::groups;
use crate::io::groups::{Groups, Single};
use crate::io::surface::{no_such_point, out_of_range, Surface};
use crate::io::text::{bad, int, shown, Line, Lines};
use crate::plc::{Plc, Segment};
use std::borrow::Cow;

/// Reads a file.
pub(super) fn read(bytes: &[u8], control: &Control) -> Result<Plc, Error> {
    let text = join_continued_lines(bytes)?;
    let mut lines = Lines::new(&text, control);
    let mut reader = Reader::new(control);
    while let Some(mut line) = lines.next_line() {
        reader.line(&mut line)?;
    }
    reader.check_ranges()?;
    reader.surface.finish_groups(true, &reader.groups, Single::Counts)
}

/// A backslash at the end of a line continues it on the next one: both become blanks.
fn join_continued_lines(bytes: &[u8]) -> Result<Cow<'_, [u8]>, Error> {
    if !bytes.contains(&b'\\') {
        return Ok(Cow::Borrowed(bytes));
    }
    let mut text = fallible::copied(bytes)?;
    for i in 0..text.len() {
        if text[i] != b'\\' {
            continue;
        }
        let end = if text.get(i + 1) == Some(&b'\r') { i + 2 } else { i + 1 };
        if text.get(end) == Some(&b'\n') {
            text[i..=end].fill(b' ');
        }
    }
    Ok(Cow::Owned(text))
}

struct Reader<'a> {
    surface: Surface<'a>,
    group: Vec<u8>,
    material: Vec<u8>,
    groups: Groups,
    /// The number of the group and material that faces and lines belong to now.
    current: i32,
    facets: u32,
    /// The largest index used so far with the element and line that used it.
    largest: Option<(i64, Element, usize)>,
}

impl<'a> Reader<'a> {
    fn new(control: &'a Control<'a>) -> Self {
        Reader {
            surface: Surface::new(control),
            group: Vec::new(),
            material: Vec::new(),
            groups: Groups::default(),
            current: 0,
            facets: 0,
            largest: None,
        }
    }

    fn line(&mut self, line: &mut Line<'_>) -> Result<(), Error> {
        match line.token().unwrap_or_default() {
            b"v" => {
                let point = line.point()?;
                self.surface.point(point)
            }
            b"f" | b"fo" => self.face(line),
            b"l" => self.polyline(line),
            b"g" | b"o" => {
                self.group = fallible::copied(line.rest().trim_ascii())?;
                self.enter_group()
            }
            b"usemtl" => {
                self.material = fallible::copied(line.rest().trim_ascii())?;
                self.enter_group()
            }
            b"vt" | b"vn" | b"vp" | b"p" | b"s" | b"mtllib" | b"mg" | b"bevel" | b"c_interp"
            | b"d_interp" | b"lod" | b"usemap" | b"maplib" | b"shadow_obj" | b"trace_obj" | b"call"
            | b"csh" => Ok(()),
            word @ (b"curv" | b"curv2" | b"surf" | b"cstype" | b"deg" | b"parm" | b"end" | b"con") => {
                Err(Error::new(
                    Status::Unsupported,
                    format_args!(
                        "line {}: free-form geometry ('{}') is not supported",
                        line.number(),
                        shown(word)
                    ),
                ))
            }
            word => Err(bad(line.number(), format_args!("unknown keyword '{}'", shown(word)))),
        }
    }

    fn enter_group(&mut self) -> Result<(), Error> {
        if self.group.is_empty() && self.material.is_empty() {
            self.current = 0;
            return Ok(());
        }
        let stated = groups::stated_marker(&self.group).is_some();
        let material = if stated { &[][..] } else { &self.material };
        // A line feed is in no name.
        let mut key = fallible::copied(&self.group)?;
        fallible::push(&mut key, b'\n')?;
        fallible::append(&mut key, material)?;
        let group = &self.group;
        self.current = self.groups.of_key(&key, || {
            let mut name = fallible::copied(group)?;
            if !group.is_empty() && !material.is_empty() {
                fallible::push(&mut name, b'/')?;
            }
            fallible::append(&mut name, material)?;
            Ok(name)
        })?;
        Ok(())
    }

    /// An index from 0: positive ones count from the first point, negative ones back from the last so far.
    fn index(&mut self, token: &[u8], element: Element, line: usize) -> Result<i64, Error> {
        let mut parts = token.split(|&b| b == b'/');
        let index = parts.next().and_then(int);
        let rest_fine = parts.all(|part| part.is_empty() || int(part).is_some());
        let (Some(index), true) = (index, rest_fine) else {
            return Err(bad(line, format_args!("a vertex index expected, found '{}'", shown(token))));
        };
        if index == 0 {
            let what = format_args!("line {line}: vertex index 0, but vertices are counted from 1");
            return Err(no_such_point(element, what));
        }
        let index = if index > 0 { index - 1 } else { self.surface.points.len() as i64 + index };
        if index < 0 {
            let token = shown(token);
            let what = format_args!("line {line}: vertex index {token} reaches before the first vertex");
            return Err(no_such_point(element, what));
        }
        if self.largest.is_none_or(|(largest, ..)| index > largest) {
            self.largest = Some((index, element, line));
        }
        Ok(index)
    }

    fn face(&mut self, line: &mut Line<'_>) -> Result<(), Error> {
        let element = Element::Facet(self.facets);
        let mut corners = 0;
        while let Some(token) = line.token() {
            let corner = self.index(token, element, line.number())?;
            self.surface.corner(corner)?;
            corners += 1;
        }
        if corners < 3 {
            return Err(bad(line.number(), format_args!("a face of {corners} corners")));
        }
        self.facets = self.facets.saturating_add(1);
        self.surface.end_polygon(self.current)
    }

    fn polyline(&mut self, line: &mut Line<'_>) -> Result<(), Error> {
        let mut last: Option<i64> = None;
        let mut count = 0;
        while let Some(token) = line.token() {
            let element = Element::Segment(self.surface.segments.len() as u32);
            let index = self.index(token, element, line.number())?;
            if let Some(last) = last {
                let ends = [last, index].map(|i| u32::try_from(i).unwrap_or(u32::MAX));
                fallible::push(&mut self.surface.segments, Segment { ends, marker: self.current })?;
            }
            last = Some(index);
            count += 1;
        }
        if count < 2 {
            return Err(bad(line.number(), format_args!("a line of {count} points")));
        }
        Ok(())
    }

    fn check_ranges(&self) -> Result<(), Error> {
        match self.largest {
            Some((index, element, line)) if index >= self.surface.points.len() as i64 => {
                let error = out_of_range(element, self.surface.points.len());
                Err(error.at(format_args!("line {line}")))
            }
            _ => Ok(()),
        }
    }
}
