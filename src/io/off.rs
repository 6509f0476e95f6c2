//! The Object File Format: `OFF`, counts, a line per vertex, a line per polygon. Source: the Geomview manual, "OFF Files".
//!
//! Prefixes `ST`, `C`, `N` (texture coordinates, colours, normals) only add columns after the coordinates; these are
//! skipped. What follows the corners of a face is its colour: a single integer is an index into a colour map and becomes the marker;
//! colours of three or four numbers are numbered as groups, if there is more than one; anything else is skipped. Homogeneous (`4OFF`),
//! n-dimensional (`nOFF`) and binary files are refused.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::io::groups::{Groups, Single};
use crate::io::surface::{no_such_point, Surface};
use crate::io::text::{bad, float, int, shown, Line, Lines};
use crate::plc::Plc;

/// Reads a file. Points stay as they are, equal ones included.
pub(super) fn read(bytes: &[u8], control: &Control) -> Result<Plc, Error> {
    let mut lines = Lines::new(bytes, control);
    let mut line = lines.expect("the header 'OFF'")?;
    let magic = line.token().unwrap_or_default();
    check_magic(magic, line.number())?;
    let mut ahead = line;
    match ahead.token() {
        None => line = lines.expect("the counts of vertices and faces")?,
        Some(b"BINARY") => return Err(Error::new(Status::Unsupported, "binary OFF is not supported")),
        Some(_) => {}
    }
    let available = bytes.len();
    let vertex_count = line.count("the number of vertices", 6, available)?;
    let face_count = line.count("the number of faces", 4, available)?;
    let mut groups = Groups::default();
    let mut surface = Surface::new(control);
    surface.reserve(vertex_count, face_count, 3 * face_count)?;
    for _ in 0..vertex_count {
        let point = lines.expect("a vertex")?.point()?;
        surface.point(point)?;
    }
    for _ in 0..face_count {
        let mut line = lines.expect("a face")?;
        let corners = line.int("the number of corners")?;
        if corners < 2 {
            return Err(bad(line.number(), format_args!("a face of {corners} corners")));
        }
        for _ in 0..corners {
            let corner = line.int("a vertex index")?;
            if corner < 0 || corner >= vertex_count as i64 {
                let number = line.number();
                return Err(no_such_point(
                    surface.next_element(corners),
                    format_args!(
                        "line {number}: vertex index {corner}, but there are {vertex_count} vertices"
                    ),
                ));
            }
            surface.corner(corner)?;
        }
        let group = match line.rest().trim_ascii().is_empty() {
            true => 0,
            false => colour_group(&mut line, &mut groups)?,
        };
        surface.end_polygon(group)?;
    }
    lines.expect_end("face")?;
    surface.finish_groups(false, &groups, Single::Nothing)
}

/// The group of a face by what follows its corners, 0 for none.
fn colour_group(line: &mut Line<'_>, groups: &mut Groups) -> Result<i32, Error> {
    let (mut values, mut count, mut integers, mut index) = ([0.0; 4], 0, true, 0);
    while let Some(token) = line.token() {
        let Some(value) = float(token).filter(|_| count < 4) else { return Ok(0) };
        values[count] = value;
        count += 1;
        index = int(token).unwrap_or(0);
        integers &= int(token).is_some();
    }
    let most = if integers { 255.0 } else { 1.0 };
    let colour = (3..=4).contains(&count) && values.iter().all(|x| (0.0..=most).contains(x));
    match (count, i32::try_from(index)) {
        (1, Ok(marker)) if integers => groups.of_marker(marker),
        _ if colour => groups.of_colour(&values.map(|x| x * (255.0 / most))[..count]),
        _ => Ok(0),
    }
}

fn check_magic(magic: &[u8], line: usize) -> Result<(), Error> {
    let Some(prefix) = magic.strip_suffix(b"OFF") else {
        return Err(bad(line, format_args!("'OFF' expected, found '{}'", shown(magic))));
    };
    let rest = prefix.strip_prefix(b"ST").unwrap_or(prefix);
    let rest = rest.strip_prefix(b"C").unwrap_or(rest);
    let rest = rest.strip_prefix(b"N").unwrap_or(rest);
    if rest.is_empty() {
        return Ok(());
    }
    Err(Error::new(
        Status::Unsupported,
        format_args!("line {line}: the OFF variant '{}' is not supported", shown(magic)),
    ))
}
