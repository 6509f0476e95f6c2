//! Reads MEDIT's `.mesh`, in text. Source: as in [`medit`](crate::io::medit).
//!
//! Vertices, edges, triangles and tetrahedra with their references are read: those of points, edges and triangles are markers, those of
//! tetrahedra attributes. Other lists of numbers (corners, ridges, normals, …) are passed over; elements that are no tetrahedra are refused.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::io::mesh_file::{Builder, MeshFile};
use crate::io::text::{bad, float, int, shown, Line, Lines};

/// Words over several lines.
struct Tokens<'a> {
    lines: Lines<'a>,
    line: Option<Line<'a>>,
}

impl<'a> Tokens<'a> {
    fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(token) = self.line.as_mut().and_then(Line::token) {
                return Some(token);
            }
            self.line = Some(self.lines.next_line()?);
        }
    }

    fn number(&self) -> usize {
        self.lines.number()
    }

    fn int(&mut self, what: &str) -> Result<i64, Error> {
        let token = self.next();
        let found = token.unwrap_or(b"the end");
        token
            .and_then(int)
            .ok_or_else(|| bad(self.number(), format_args!("{what} expected, found '{}'", shown(found))))
    }

    fn float(&mut self, what: &str) -> Result<f64, Error> {
        let token = self.next();
        let found = token.unwrap_or(b"the end");
        token
            .and_then(float)
            .ok_or_else(|| bad(self.number(), format_args!("{what} expected, found '{}'", shown(found))))
    }

    /// A count of things of at least so many bytes each.
    fn count(&mut self, bytes_each: usize) -> Result<usize, Error> {
        let value = self.int("a count")?;
        let left = self.lines.remaining().len() + self.line.map_or(0, |line| line.rest().len());
        match usize::try_from(value) {
            Ok(count) if count.saturating_mul(bytes_each) <= left + 1 && count < u32::MAX as usize => {
                Ok(count)
            }
            _ => Err(bad(self.number(), format_args!("{value} is more than the rest of the file can hold"))),
        }
    }

    fn marker(&mut self) -> Result<i32, Error> {
        let value = self.int("a reference")?;
        i32::try_from(value)
            .map_err(|_| bad(self.number(), format_args!("reference {value} does not fit 32 bits")))
    }
}

/// Reads a mesh.
pub(super) fn read(bytes: &[u8], control: &Control) -> Result<MeshFile, Error> {
    let mut tokens = Tokens { lines: Lines::new(bytes, control), line: None };
    let mut built = Builder::default();
    let first = tokens.next();
    if first != Some(b"MeshVersionFormatted") {
        return Err(bad(tokens.number(), "'MeshVersionFormatted' expected"));
    }
    tokens.int("a version")?;
    let mut word = tokens.next();
    while let Some(keyword) = word {
        match keyword {
            b"Dimension" => {
                let dimension = tokens.int("the dimension")?;
                if dimension != 3 {
                    return Err(bad(tokens.number(), format_args!("the dimension is {dimension}, not 3")));
                }
            }
            b"Vertices" => {
                for _ in 0..tokens.count(8)? {
                    let [x, y, z] = ["coordinate x", "coordinate y", "coordinate z"];
                    let point = [tokens.float(x)?, tokens.float(y)?, tokens.float(z)?];
                    fallible::push(&mut built.file.arrays.points, point)?;
                    let marker = tokens.marker()?;
                    fallible::push(&mut built.file.markers, marker)?;
                }
            }
            b"Edges" => elements::<2>(&mut tokens, &mut built)?,
            b"Triangles" => elements::<3>(&mut tokens, &mut built)?,
            b"Tetrahedra" => elements::<4>(&mut tokens, &mut built)?,
            b"Quadrilaterals" | b"Hexahedra" | b"Hexaedra" | b"Prisms" | b"Pentahedra" | b"Pyramids" => {
                if tokens.count(2)? > 0 {
                    return Err(Error::new(
                        Status::Unsupported,
                        format_args!("line {}: only tetrahedra and triangles are read", tokens.number()),
                    ));
                }
            }
            b"End" => break,
            other if other[0].is_ascii_alphabetic() => {
                // A list that says nothing to us: numbers up to the next word.
                word = tokens.next();
                while word.is_some_and(|token| float(token).is_some()) {
                    word = tokens.next();
                }
                continue;
            }
            other => {
                return Err(bad(tokens.number(), format_args!("a word expected, found '{}'", shown(other))))
            }
        }
        word = tokens.next();
    }
    if built.file.markers.iter().all(|&marker| marker == 0) {
        built.file.markers = Vec::new();
    }
    built.finish()
}

fn elements<const N: usize>(tokens: &mut Tokens, built: &mut Builder) -> Result<(), Error> {
    let points = built.file.arrays.points.len();
    for _ in 0..tokens.count(2 * N + 2)? {
        let mut corners = [0u32; N];
        for corner in &mut corners {
            let number = tokens.int("a vertex")?;
            match usize::try_from(number).ok().and_then(|n| n.checked_sub(1)) {
                Some(v) if v < points => *corner = v as u32,
                _ => return Err(built.no_such_node(tokens.number(), N, number)),
            }
        }
        let reference = tokens.marker()?;
        built.add(&corners, N, f64::from(reference))?;
    }
    Ok(())
}
