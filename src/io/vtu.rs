//! VTK XML unstructured grids: a header, then the arrays in raw binary behind it, little endian, plain or zlib-compressed. Source:
//! VTK User's Guide, "VTK File Formats", XML formats.
//!
//! Cells carry `region` (the attribute) and `min_dihedral` (degrees), and on request further measures of quality; points the input's attributes and markers and whether
//! they are Steiner points. The second file's cells are the subfaces with `facet` and `marker`. Arrays of one component do not state that
//! number, since some readers turn arrays that do into columns.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::io::model::{Model, Nodes};
use crate::io::output_files::{ended, Out};
use crate::io::quality::{corners, dihedrals};
use crate::io::tags::attribute_of;
use crate::query::{NodeOrder, TetQuality};
use crate::INVALID;
use std::fmt;
use std::io;

type Sink<'s> = &'s mut dyn FnMut(&[u8]) -> io::Result<()>;

/// What an array holds.
#[derive(Clone, Copy)]
enum Content {
    Points,
    Connectivity,
    Offsets,
    Types,
    Attribute(usize),
    PointMarker,
    Steiner,
    Region,
    MinDihedral,
    /// A measure of tetrahedra and its name.
    Quality(&'static str, fn(&TetQuality) -> f64),
    MeshPoint,
    Facet,
    FacetMarker,
}

/// What [`WriteOptions::quality_data`](crate::WriteOptions::quality_data) adds to the smallest dihedral angle.
const QUALITY_DATA: [Content; 4] = [
    Content::Quality("max_dihedral", TetQuality::max_dihedral),
    Content::Quality("radius_edge", |quality| quality.radius_edge),
    Content::Quality("eta", |quality| quality.eta),
    Content::Quality("volume", |quality| quality.volume),
];

/// One array: what the header says of it.
#[derive(Clone, Copy)]
struct Array {
    content: Content,
    kind: &'static str,
    components: usize,
    /// Bytes per item.
    size: u64,
    count: usize,
}

impl Array {
    fn new(content: Content, kind: &'static str, count: usize) -> Array {
        let size = match kind {
            "UInt8" => 1,
            "Float64" | "Int64" => 8,
            _ => 4,
        };
        Array { content, kind, components: 1, size, count }
    }

    fn bytes(&self) -> u64 {
        self.size * self.count as u64
    }
}

impl fmt::Display for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Content::Attribute(k) => return write!(f, "attribute_{k}"),
            Content::Points => "Points",
            Content::Connectivity => "connectivity",
            Content::Offsets => "offsets",
            Content::Types => "types",
            Content::PointMarker | Content::FacetMarker => "marker",
            Content::Steiner => "steiner",
            Content::Region => "region",
            Content::MinDihedral => "min_dihedral",
            Content::Quality(name, _) => name,
            Content::MeshPoint => "point",
            Content::Facet => "facet",
        })
    }
}

/// A grid of one kind of cell: the tetrahedra, or the subfaces with the nodes that they use.
pub(super) struct Grid<'a> {
    model: &'a Model<'a>,
    /// For each node of the grid its node in the mesh, and the reverse; `None` if the grid has all nodes unchanged.
    used: Option<(Vec<u32>, Vec<u32>)>,
    nodes: usize,
    cells: usize,
    /// Nodes per cell.
    width: usize,
    vtk_type: u8,
}

impl<'a> Grid<'a> {
    /// The tetrahedra.
    pub fn tets(model: &'a Model<'a>) -> Self {
        let (width, vtk_type) = if model.options.second_order { (10, 24) } else { (4, 10) };
        Grid { model, used: None, nodes: model.node_count(), cells: model.mesh.tets.len(), width, vtk_type }
    }

    /// The subfaces.
    pub fn subfaces(model: &'a Model<'a>) -> Result<Self, Error> {
        let mut new_index = fallible::filled(INVALID, model.node_count())?;
        let mut used: Vec<u32> = Vec::new();
        let cells = model.mesh.subfaces.len();
        for face in 0..cells {
            for &node in model.face(face).iter() {
                let Some(index) = new_index.get_mut(node as usize) else { continue };
                if *index == INVALID {
                    *index = used.len() as u32;
                    fallible::push(&mut used, node)?;
                }
            }
        }
        let (width, vtk_type) = if model.options.second_order { (6, 22) } else { (3, 5) };
        Ok(Grid { model, nodes: used.len(), used: Some((used, new_index)), cells, width, vtk_type })
    }

    /// The arrays of the four sections, in order.
    fn sections(&self) -> Result<[(&'static str, Vec<Array>); 4], Error> {
        let array = Array::new;
        let (mut point_data, mut cell_data) = (Vec::new(), Vec::new());
        if self.used.is_some() {
            fallible::push(&mut point_data, array(Content::MeshPoint, "UInt32", self.nodes))?;
            fallible::push(&mut cell_data, array(Content::Facet, "UInt32", self.cells))?;
            fallible::push(&mut cell_data, array(Content::FacetMarker, "Int32", self.cells))?;
        } else {
            for k in 0..self.model.attribute_count() {
                fallible::push(&mut point_data, array(Content::Attribute(k), "Float64", self.nodes))?;
            }
            if self.model.is_marked() {
                fallible::push(&mut point_data, array(Content::PointMarker, "Int32", self.nodes))?;
            }
            fallible::push(&mut point_data, array(Content::Steiner, "UInt8", self.nodes))?;
            fallible::push(&mut cell_data, array(Content::Region, "Float64", self.cells))?;
            fallible::push(&mut cell_data, array(Content::MinDihedral, "Float32", self.cells))?;
            if self.model.options.quality_data {
                for content in QUALITY_DATA {
                    fallible::push(&mut cell_data, array(content, "Float64", self.cells))?;
                }
            }
        }
        let points = Array { components: 3, size: 24, ..array(Content::Points, "Float64", self.nodes) };
        let kind = if self.is_wide() { "Int64" } else { "Int32" };
        let connectivity = array(Content::Connectivity, kind, self.width * self.cells);
        let cells = [
            connectivity,
            array(Content::Offsets, kind, self.cells),
            array(Content::Types, "UInt8", self.cells),
        ];
        Ok([
            ("PointData", point_data),
            ("CellData", cell_data),
            ("Points", fallible::copied(&[points])?),
            ("Cells", fallible::copied(&cells)?),
        ])
    }

    /// Whether 32 bits are too few for the cells' arrays.
    fn is_wide(&self) -> bool {
        self.width as u64 * self.cells as u64 > i32::MAX as u64
    }

    /// The mesh's node of one of ours.
    fn mesh_node(&self, node: usize) -> usize {
        self.used.as_ref().map_or(node, |(used, _)| used.get(node).map_or(0, |&n| n as usize))
    }

    fn cell(&self, cell: usize) -> Nodes {
        match &self.used {
            None => self.model.tet(cell, NodeOrder::Vtk),
            Some((_, new)) => self.model.face(cell).map(|n| new.get(n as usize).copied().unwrap_or(0)),
        }
    }

    /// Hands the bytes of an array to `sink`.
    fn fill(&self, array: &Array, sink: Sink<'_>) -> io::Result<()> {
        let mesh = self.model.mesh;
        let index = |value: u64, sink: Sink<'_>| match self.is_wide() {
            true => sink(&value.to_le_bytes()),
            false => sink(&(value as u32).to_le_bytes()),
        };
        if let Content::Connectivity = array.content {
            return (0..self.cells)
                .try_for_each(|i| self.cell(i).iter().try_for_each(|&n| index(u64::from(n), &mut *sink)));
        }
        for i in 0..array.count {
            match array.content {
                Content::Points => {
                    let mut bytes = [0; 24];
                    let node = self.model.node(self.mesh_node(i));
                    bytes
                        .chunks_exact_mut(8)
                        .zip(node)
                        .for_each(|(to, x)| to.copy_from_slice(&x.to_le_bytes()));
                    sink(&bytes)
                }
                Content::Offsets => index((self.width * (i + 1)) as u64, &mut *sink),
                Content::Types => sink(&[self.vtk_type]),
                Content::Attribute(k) => sink(&self.model.attribute(i, k).to_le_bytes()),
                Content::PointMarker => sink(&self.model.marker(i).to_le_bytes()),
                Content::Steiner => {
                    let added = mesh.input_point_count as usize..mesh.points.len();
                    sink(&[u8::from(added.contains(&i))])
                }
                Content::Region => sink(&attribute_of(mesh, i).to_le_bytes()),
                Content::MinDihedral => {
                    sink(&(dihedrals(corners(mesh, &mesh.tets[i]))[0] as f32).to_le_bytes())
                }
                Content::Quality(_, measure) => {
                    sink(&measure(&TetQuality::of_tet(mesh, &mesh.tets[i])).to_le_bytes())
                }
                Content::MeshPoint => sink(&(self.mesh_node(i) as u32).to_le_bytes()),
                Content::Facet => sink(&mesh.subfaces[i].facet.to_le_bytes()),
                Content::FacetMarker => sink(&mesh.subfaces[i].marker.to_le_bytes()),
                Content::Connectivity => Ok(()),
            }?;
        }
        Ok(())
    }

    /// Writes the grid.
    pub fn write(&self, out: &mut Out) -> io::Result<()> {
        let sections = self.sections().map_err(|_| io::ErrorKind::OutOfMemory)?;
        let compress = self.model.options.compress;
        let mut packed: Vec<Vec<u8>> = Vec::new();
        if compress {
            for array in sections.iter().flat_map(|(_, arrays)| arrays) {
                let bytes = self.compressed(array, out.control())?;
                fallible::push(&mut packed, bytes).map_err(|_| io::ErrorKind::OutOfMemory)?;
            }
        }
        let compressor = if compress { " compressor=\"vtkZLibDataCompressor\"" } else { "" };
        out.format(format_args!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\"{compressor}>\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
            self.nodes, self.cells
        ))?;
        let (mut offset, mut number) = (0, 0);
        for (section, arrays) in &sections {
            out.format(format_args!("<{section}>\n"))?;
            for array in arrays {
                out.format(format_args!("<DataArray type=\"{}\" Name=\"{}\"", array.kind, array.content))?;
                if array.components > 1 {
                    out.format(format_args!(" NumberOfComponents=\"{}\"", array.components))?;
                }
                out.format(format_args!(" format=\"appended\" offset=\"{offset}\"/>\n"))?;
                offset += packed.get(number).map_or(8 + array.bytes(), |p| p.len() as u64);
                number += 1;
            }
            out.format(format_args!("</{section}>\n"))?;
        }
        out.put("</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_")?;
        if compress {
            packed.iter().try_for_each(|bytes| out.put(bytes))?;
        } else {
            for array in sections.iter().flat_map(|(_, arrays)| arrays) {
                out.put(array.bytes().to_le_bytes())?;
                self.fill(array, &mut |bytes| out.put(bytes))?;
            }
        }
        out.put("\n</AppendedData>\n</VTKFile>\n")
    }

    /// An array as VTK's zlib compressor lays it out: the number of blocks, their size, the size of a last partial one, the
    /// compressed sizes (64 bits each), then the blocks.
    fn compressed(&self, array: &Array, control: &Control) -> io::Result<Vec<u8>> {
        const BLOCK: usize = 1 << 17;
        let mut block = fallible::reserved(BLOCK + 32)?;
        let mut sizes: Vec<u64> = Vec::new();
        let mut data = Vec::new();
        self.fill(array, &mut |bytes| {
            fallible::append(&mut block, bytes)?;
            if block.len() >= BLOCK {
                ended(control)?;
                let size = deflate(&block[..BLOCK], &mut data)?;
                fallible::push(&mut sizes, size)?;
                block.drain(..BLOCK);
            }
            Ok(())
        })?;
        let partial = block.len() as u64;
        if partial > 0 {
            let size = deflate(&block, &mut data)?;
            fallible::push(&mut sizes, size)?;
        }
        let header = [sizes.len() as u64, BLOCK as u64, partial];
        let mut packed = fallible::reserved(8 * (3 + sizes.len()) + data.len())?;
        for word in header.iter().chain(&sizes) {
            fallible::append(&mut packed, &word.to_le_bytes())?;
        }
        fallible::append(&mut packed, &data)?;
        Ok(packed)
    }
}

/// The least effort that adapts the code to the data.
const LEVEL: i32 = 2;

/// Appends one zlib stream and returns its size. Memory for its state is asked for by zlib, which says so if there is none.
fn deflate(block: &[u8], data: &mut Vec<u8>) -> io::Result<u64> {
    let start = data.len();
    let bound = zlib_rs::compress_bound(block.len());
    fallible::resize(data, start + bound, 0)?;
    let (stream, code) =
        zlib_rs::compress_slice(&mut data[start..], block, zlib_rs::DeflateConfig::new(LEVEL));
    let size = stream.len();
    data.truncate(start + size);
    match code {
        zlib_rs::ReturnCode::Ok => Ok(size as u64),
        zlib_rs::ReturnCode::MemError => Err(io::Error::from(io::ErrorKind::OutOfMemory)),
        // More than its own bound, or a fault of its state: neither happens.
        _ => Err(io::Error::from(io::ErrorKind::Other)),
    }
}
