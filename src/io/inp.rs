//! Input decks of Abaqus and CalculiX, the mesh alone: `*INCLUDE` it in a deck. Sources: Abaqus Keywords Guide (*NODE, *ELEMENT,
//! *ELSET, *NSET, *SURFACE); Guido Dhondt, CalculiX CrunchiX User's Manual, the same keywords.
//!
//! Node and element numbers are ours plus one. Sets: `ALL` of nodes and of elements; one of elements per region; per facet marker
//! one of nodes and a surface; per segment marker one of nodes. Their names are those of regions and markers where they have
//! one, else `REGION_K`, `MARKER_K`, `SEGMENT_K` (`MINUS_K` for negative markers).
use crate::error::{Element, Error};
use crate::fallible;
use crate::io::model::{lose, Model};
use crate::io::output_files::Out;
use crate::io::tags::{Group, Groups};
use crate::query::NodeOrder;
use crate::warning::Warnings;
use std::fmt::{self, Write};
use std::io;

/// The widest field that readers take whole: CalculiX reads numbers by Fortran's f20.0, Abaqus allows 20 characters.
const FIELD: usize = 20;

/// A short text on the stack.
struct Field {
    text: [u8; 40],
    length: usize,
}

impl fmt::Write for Field {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let room = self.text.get_mut(self.length..self.length + text.len()).ok_or(fmt::Error)?;
        room.copy_from_slice(text.as_bytes());
        self.length += text.len();
        Ok(())
    }
}

/// A finite number in the fewest digits that read back bit for bit, if these fit a field, else as many as fit.
#[expect(clippy::disallowed_methods, reason = "the text is on the stack")]
fn field(value: f64) -> Field {
    let mut field = Field { text: [0; 40], length: 0 };
    let mut buffer = zmij::Buffer::new();
    let exact = buffer.format_finite(value);
    let exact = exact.strip_suffix(".0").unwrap_or(exact);
    if exact.len() <= FIELD && field.write_str(exact).is_ok() {
        return field;
    }
    field.length = 0;
    // All 17 digits, of which the last ones are cut: rounding up could leave the range of doubles.
    if write!(field, "{value:.16e}").is_ok() {
        let end = field.length;
        let exponent = field.text[..end].iter().position(|&b| b == b'e').unwrap_or(end);
        let kept = exponent.min(FIELD.saturating_sub(end - exponent));
        field.text.copy_within(exponent..end, kept);
        field.length = kept + end - exponent;
    }
    field
}

/// Whether a number is read back bit for bit from its field.
fn is_held(value: f64) -> bool {
    let field = field(value);
    std::str::from_utf8(&field.text[..field.length]).ok().and_then(|t| t.parse::<f64>().ok()) == Some(value)
}

/// Warns of nodes with coordinates that are rounded.
pub(super) fn lose_digits(model: &Model<'_>, warnings: &mut Warnings) {
    for (i, point) in (0..).zip(&model.mesh.points) {
        if !point.iter().all(|&x| !x.is_finite() || is_held(x)) {
            lose(warnings, model.options, Element::Point(i));
        }
    }
}

/// Names of sets, by dimension as in [`Groups`].
pub(super) struct Names {
    curves: Vec<String>,
    surfaces: Vec<String>,
    volumes: Vec<String>,
}

impl Names {
    /// Names that are labels of Abaqus: letters, digits and underscores, a letter first, each once.
    pub fn new(groups: &Groups) -> Result<Self, Error> {
        let list = |groups: &[Group], prefix: &str| -> Result<Vec<String>, Error> {
            let mut names: Vec<String> = Vec::new();
            for group in groups {
                let mut name = label(group, prefix)?;
                let mut copy = 1;
                while names.contains(&name) || name == "ALL" {
                    copy += 1;
                    name = fallible::text(format_args!("{}_{copy}", label(group, prefix)?))?;
                }
                fallible::push(&mut names, name)?;
            }
            Ok(names)
        };
        Ok(Names {
            curves: list(&groups.curves, "SEGMENT")?,
            surfaces: list(&groups.surfaces, "MARKER")?,
            volumes: list(&groups.volumes, "REGION")?,
        })
    }
}

/// The label of a group: its own name as far as it goes, or the prefix and what the group stands for.
fn label(group: &Group, prefix: &str) -> Result<String, Error> {
    // Readers cut labels at 80 characters; a number may follow.
    const LONGEST: usize = 70;
    let Some(name) = &group.named else {
        // `marker -4` and `region 2.5` hold the number; a region's tag is an integer.
        let number = group.plain.strip_prefix("marker ").unwrap_or_default();
        return Ok(match (number.is_empty(), number.strip_prefix('-')) {
            (true, _) => fallible::text(format_args!("{prefix}_{}", group.tag))?,
            (_, Some(positive)) => fallible::text(format_args!("{prefix}_MINUS_{positive}"))?,
            (_, None) => fallible::text(format_args!("{prefix}_{number}"))?,
        });
    };
    let mut label = String::new();
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        fallible::append_text(&mut label, "G_")?;
    }
    let allowed = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' };
    for c in name.chars().take(LONGEST) {
        fallible::append_text(&mut label, allowed(c).encode_utf8(&mut [0; 4]))?;
    }
    Ok(label)
}

/// Writes a mesh.
pub(super) fn write(out: &mut Out, model: &Model<'_>, groups: &Groups, names: &Names) -> io::Result<()> {
    let mesh = model.mesh;
    out.put("*HEADING\ndelotet: points, tetrahedra and their sets\n*NODE, NSET=ALL\n")?;
    for node in 0..model.node_count() {
        out.int(node + 1)?;
        for x in model.node(node) {
            if !x.is_finite() {
                // Refused there, with the reason.
                return out.float(x);
            }
            let field = field(x);
            out.put(", ")?;
            out.put(&field.text[..field.length])?;
        }
        out.put("\n")?;
    }
    let kind = if model.options.second_order { "C3D10" } else { "C3D4" };
    for (group, name) in groups.volumes.iter().zip(&names.volumes).filter(|(g, _)| !g.elements.is_empty()) {
        out.format(format_args!("*ELEMENT, TYPE={kind}, ELSET={name}\n"))?;
        for &tet in &group.elements {
            out.int(u64::from(tet) + 1)?;
            for &node in model.tet(tet as usize, NodeOrder::Vtk).iter() {
                out.put(", ")?;
                out.int(u64::from(node) + 1)?;
            }
            out.put("\n")?;
        }
    }
    if !mesh.tets.is_empty() {
        out.format(format_args!("*ELSET, ELSET=ALL, GENERATE\n1, {}, 1\n", mesh.tets.len()))?;
    }
    for (group, name) in groups.surfaces.iter().zip(&names.surfaces) {
        node_set(out, name, group, |face| model.face(face as usize))?;
        out.format(format_args!("*SURFACE, NAME={name}, TYPE=ELEMENT\n"))?;
        for &face in &group.elements {
            if let Some((tet, side)) = side(model, face as usize) {
                out.format(format_args!("{}, S{side}\n", u64::from(tet) + 1))?;
            }
        }
    }
    for (group, name) in groups.curves.iter().zip(&names.curves) {
        node_set(out, name, group, |piece| model.piece(piece as usize))?;
    }
    Ok(())
}

/// The first tetrahedron of a subface and Abaqus' number of that face: S1 is 1-2-3, S2 is 1-4-2, S3 is 2-4-3, S4 is 3-4-1.
fn side(model: &Model<'_>, face: usize) -> Option<(u32, u32)> {
    const OPPOSITE: [u32; 4] = [3, 4, 2, 1];
    let face = model.mesh.subfaces.get(face)?;
    let corners = model.mesh.tets.get(face.tets[0] as usize)?;
    let opposite = corners.iter().position(|v| !face.corners.contains(v))?;
    Some((face.tets[0], OPPOSITE[opposite]))
}

/// The nodes of a group's elements, each once, ascending.
fn node_set(
    out: &mut Out,
    name: &str,
    group: &Group,
    nodes_of: impl Fn(u32) -> super::model::Nodes,
) -> io::Result<()> {
    let mut nodes: Vec<u32> = Vec::new();
    for &element in &group.elements {
        fallible::append(&mut nodes, &nodes_of(element))?;
    }
    nodes.sort_unstable();
    nodes.dedup();
    out.format(format_args!("*NSET, NSET={name}\n"))?;
    // Sixteen entries are the most that a line may have.
    for line in nodes.chunks(16) {
        for (i, &node) in line.iter().enumerate() {
            out.put(if i > 0 { ", " } else { "" })?;
            out.int(u64::from(node) + 1)?;
        }
        out.put("\n")?;
    }
    Ok(())
}
