//! Reads Gmsh's MSH 4.1 and 2.2, in text. Source: as in [`msh`](crate::io::msh).
//!
//! The attribute of a tetrahedron and the marker of a triangle or line is its physical group's tag or, if it is in none, its entity's. Single
//! points are passed over; elements that are no simplices are refused. Nodes keep the file's order, whatever their tags are.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::io::mesh_file::{Builder, MeshFile};
use crate::io::text::{bad, int, shown, Line, Lines};

/// How many nodes an element has, and how many of them are corners.
#[derive(Clone, Copy)]
struct Shape {
    nodes: usize,
    corners: usize,
}

/// The kinds of elements that are read.
fn shape(kind: i64, line: usize) -> Result<Shape, Error> {
    let (nodes, corners) = match kind {
        15 => (1, 1),
        1 => (2, 2),
        8 => (3, 2),
        2 => (3, 3),
        9 => (6, 3),
        4 => (4, 4),
        11 => (10, 4),
        _ => {
            return Err(Error::new(
                Status::Unsupported,
                format_args!(
                    "line {line}: elements of type {kind} are not read: only tetrahedra, triangles and lines"
                ),
            ))
        }
    };
    Ok(Shape { nodes, corners })
}

/// An entity's dimension and tag, and the first physical group that it is in.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Entity {
    dimension: i64,
    tag: i64,
    physical: i64,
}

#[derive(Default)]
struct File {
    built: Builder,
    /// Tag and place of each node, sorted once all are there.
    nodes: Vec<(i64, u32)>,
    entities: Vec<Entity>,
}

/// Reads a mesh.
pub(super) fn read(bytes: &[u8], control: &Control) -> Result<MeshFile, Error> {
    let mut lines = Lines::new(bytes, control);
    let mut file = File::default();
    let mut version = None;
    while let Some(mut line) = lines.next_line() {
        let word = line.token().unwrap_or_default();
        let mut is_read = true;
        match (word, version) {
            (b"$MeshFormat", _) => version = Some(is_version_4(&mut lines)?),
            (_, None) => return Err(bad(line.number(), "'$MeshFormat' expected")),
            (b"$Entities", Some(true)) => file.entities(&mut lines)?,
            (b"$Nodes", Some(true)) => file.nodes(&mut lines)?,
            (b"$Nodes", Some(false)) => file.legacy_nodes(&mut lines)?,
            (b"$Elements", Some(true)) => file.elements(&mut lines)?,
            (b"$Elements", Some(false)) => file.legacy_elements(&mut lines)?,
            _ if word.first() == Some(&b'$') => is_read = false,
            _ => return Err(bad(line.number(), format_args!("a section expected, found '{}'", shown(word)))),
        }
        skip_to_end(&mut lines, word, is_read)?;
    }
    file.built.finish()
}

/// Goes behind the end of a section, which must come next if the section has been read.
fn skip_to_end(lines: &mut Lines, section: &[u8], is_read: bool) -> Result<(), Error> {
    loop {
        let Some(mut line) = lines.next_raw() else {
            return Err(bad(lines.number(), format_args!("section '{}' does not end", shown(section))));
        };
        match line.token() {
            Some(word) if word.starts_with(b"$End") => return Ok(()),
            Some(word) if is_read => {
                let what = format_args!("'{}' where section '{}' should end", shown(word), shown(section));
                return Err(bad(line.number(), what));
            }
            _ => {}
        }
    }
}

/// Whether the format is 4.1, not 2.2.
fn is_version_4(lines: &mut Lines) -> Result<bool, Error> {
    let mut line = lines.expect("a version")?;
    let version = line.expect("a version")?;
    let is_binary = line.int("the kind of file")? != 0;
    let unsupported =
        |what: &str| Error::new(Status::Unsupported, format_args!("line {}: {what}", line.number()));
    if is_binary {
        return Err(unsupported("binary .msh files are not read: save as text"));
    }
    match version {
        b"4.1" => Ok(true),
        b"2.2" | b"2" | b"2.1" | b"2.0" => Ok(false),
        _ => Err(unsupported("this version is not read: save as 4.1 or 2.2")),
    }
}

impl File {
    /// Numbers of points, curves, surfaces and volumes, then a line each.
    fn entities(&mut self, lines: &mut Lines) -> Result<(), Error> {
        let mut line = lines.expect("the numbers of entities")?;
        let mut counts = [0; 4];
        for count in &mut counts {
            *count = line.count("the number of entities", 2, lines.remaining().len())?;
        }
        for (dimension, count) in (0..).zip(counts) {
            for _ in 0..count {
                let mut line = lines.expect("an entity")?;
                let tag = line.int("the tag of an entity")?;
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    line.float("a bound")?;
                }
                let groups = line.int("the number of physical groups")?;
                let physical = if groups > 0 { line.int("a physical group")? } else { tag };
                fallible::push(&mut self.entities, Entity { dimension, tag, physical })?;
            }
        }
        self.entities.sort_unstable();
        Ok(())
    }

    /// What an entity's elements are marked with.
    fn group(&self, dimension: i64, tag: i64) -> i64 {
        let at = self.entities.partition_point(|x| (x.dimension, x.tag) < (dimension, tag));
        let found = self.entities.get(at).filter(|x| (x.dimension, x.tag) == (dimension, tag));
        found.map_or(tag, |entity| entity.physical)
    }

    fn nodes(&mut self, lines: &mut Lines) -> Result<(), Error> {
        let mut line = lines.expect("the number of blocks of nodes")?;
        let blocks = line.count("the number of blocks", 4, lines.remaining().len())?;
        for _ in 0..blocks {
            let mut line = lines.expect("a block of nodes")?;
            for what in ["the dimension", "the tag of an entity", "whether there are parameters"] {
                line.int(what)?;
            }
            let count = line.count("the number of nodes", 8, lines.remaining().len())?;
            let first = self.nodes.len();
            for _ in 0..count {
                let mut line = lines.expect("the tag of a node")?;
                let tag = line.int("the tag of a node")?;
                let place = self.nodes.len() as u32;
                fallible::push(&mut self.nodes, (tag, place))?;
            }
            for _ in first..self.nodes.len() {
                // Parameters on a surface or curve may follow.
                let point = lines.expect("a node")?.point()?;
                fallible::push(&mut self.built.file.arrays.points, point)?;
            }
        }
        self.sort(lines.number())
    }

    fn legacy_nodes(&mut self, lines: &mut Lines) -> Result<(), Error> {
        let mut line = lines.expect("the number of nodes")?;
        for _ in 0..line.count("the number of nodes", 8, lines.remaining().len())? {
            let mut line = lines.expect("a node")?;
            let (tag, place) = (line.int("the number of a node")?, self.nodes.len() as u32);
            fallible::push(&mut self.nodes, (tag, place))?;
            fallible::push(&mut self.built.file.arrays.points, line.point()?)?;
        }
        self.sort(lines.number())
    }

    /// Sorts the nodes by tag.
    fn sort(&mut self, line: usize) -> Result<(), Error> {
        self.nodes.sort_unstable();
        match self.nodes.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            Some(pair) => Err(bad(line, format_args!("node {} comes twice", pair[0].0))),
            None => Ok(()),
        }
    }

    fn elements(&mut self, lines: &mut Lines) -> Result<(), Error> {
        let mut line = lines.expect("the number of blocks of elements")?;
        let blocks = line.count("the number of blocks", 4, lines.remaining().len())?;
        for _ in 0..blocks {
            let mut line = lines.expect("a block of elements")?;
            let dimension = line.int("the dimension")?;
            let group = self.group(dimension, line.int("the tag of an entity")?);
            let kind = line.int("the type of elements")?;
            let shape = shape(kind, line.number())?;
            for _ in 0..line.count("the number of elements", 4, lines.remaining().len())? {
                let mut line = lines.expect("an element")?;
                line.int("the tag of an element")?;
                self.element(&mut line, shape, group)?;
            }
        }
        Ok(())
    }

    fn legacy_elements(&mut self, lines: &mut Lines) -> Result<(), Error> {
        let mut line = lines.expect("the number of elements")?;
        for _ in 0..line.count("the number of elements", 6, lines.remaining().len())? {
            let mut line = lines.expect("an element")?;
            line.int("the number of an element")?;
            let kind = line.int("the type of an element")?;
            let shape = shape(kind, line.number())?;
            let tags = line.int("the number of tags")?;
            let mut group = 0;
            for i in 0..tags {
                let tag = line.int("a tag")?;
                // The physical group, or if there is none the entity.
                if i == 0 || i == 1 && group == 0 {
                    group = tag;
                }
            }
            self.element(&mut line, shape, group)?;
        }
        Ok(())
    }

    fn element(&mut self, line: &mut Line, shape: Shape, group: i64) -> Result<(), Error> {
        let mut list = [0u32; 10];
        for node in list.iter_mut().take(shape.nodes) {
            let token = line.expect("a node")?;
            let tag = int(token).ok_or_else(|| {
                bad(line.number(), format_args!("a node expected, found '{}'", shown(token)))
            })?;
            let at = self.nodes.partition_point(|x| x.0 < tag);
            match self.nodes.get(at).filter(|x| x.0 == tag) {
                Some(&(_, place)) => *node = place,
                None => return Err(self.built.no_such_node(line.number(), shape.corners, tag)),
            }
        }
        let marker = i32::try_from(group)
            .map_err(|_| bad(line.number(), format_args!("tag {group} does not fit 32 bits")))?;
        self.built.add(&list[..shape.nodes], shape.corners, f64::from(marker))
    }
}
