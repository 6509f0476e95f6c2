//! Voronoi cells as VTK polyhedra: a `.vtu` file in text, with the bounded cells and for each the index of its point. Source: VTK User's
//! Guide, "VTK File Formats", XML formats; face streams.
//!
//! A cell with a vertex beyond the range of doubles counts as unbounded.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::io::output_files::{Out, OutputFiles};
use crate::io::Format;
use crate::query::{Voronoi, VoronoiCell, VoronoiFacet};
use crate::INVALID;
use std::io;
use std::path::Path;

/// VTK's type of polyhedra.
const POLYHEDRON: &[u8] = b"42\n";

/// Writes the bounded cells of a diagram to a `.vtu` file.
///
/// # Errors
/// [`Status::Unsupported`]: another extension. [`Status::File`]: cannot be written; then nothing is left behind.
/// [`Status::OutOfMemory`], those of [`Control::step`].
pub fn write_voronoi(path: &Path, diagram: &Voronoi, control: &Control) -> Result<(), Error> {
    if Format::of(path)? != Format::Vtu {
        let text = format_args!("{}: Voronoi cells are written to .vtu files only", path.display());
        return Err(Error::new(Status::Unsupported, text));
    }
    let cells = fallible::collect((0u32..).zip(&diagram.cells).filter(|x| is_finite(diagram, x.1)))?;
    let mut files = OutputFiles::new(control);
    files.write(path, |out| Cells { diagram, cells: &cells, corners: Vec::new() }.write(out))?;
    files.commit()
}

/// Whether a cell is bounded by vertices in doubles.
fn is_finite(diagram: &Voronoi, cell: &VoronoiCell) -> bool {
    let facets = diagram.facets_of(cell).iter().filter_map(|&f| diagram.facets.get(f as usize));
    let mut edges = facets.flat_map(|facet| diagram.edges_of(facet));
    let in_doubles =
        |v: u32| diagram.vertices.get(v as usize).is_some_and(|p| p.iter().all(|x| x.is_finite()));
    let edge =
        |e: u32| diagram.edges.get(e as usize).is_some_and(|edge| edge.vertices.into_iter().all(in_doubles));
    cell.bounded && edges.all(|&e| edge(e))
}

struct Cells<'a> {
    diagram: &'a Voronoi,
    /// The cells to be written, by the indices of their points.
    cells: &'a [(u32, &'a VoronoiCell)],
    /// Scratch space: corners of a facet or vertices of a cell.
    corners: Vec<u32>,
}

impl Cells<'_> {
    fn facets<'d>(diagram: &'d Voronoi, cell: &VoronoiCell) -> impl Iterator<Item = &'d VoronoiFacet> {
        diagram.facets_of(cell).iter().filter_map(|&f| diagram.facets.get(f as usize))
    }

    fn write(&mut self, out: &mut Out) -> io::Result<()> {
        let (diagram, cells) = (self.diagram, self.cells);
        out.format(format_args!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
             <UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<CellData>\n",
            diagram.vertices.len(),
            cells.len()
        ))?;
        array(out, "UInt32", "point")?;
        cells.iter().try_for_each(|&(point, _)| line(out, point as usize))?;
        out.put("</DataArray>\n</CellData>\n<Points>\n")?;
        out.put("<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n")?;
        for at in &diagram.vertices {
            // No written cell has the others.
            out.point(if at.iter().all(|x| x.is_finite()) { at } else { &[0.0; 3] })?;
            out.put(b"\n")?;
        }
        out.put("</DataArray>\n</Points>\n<Cells>\n")?;
        array(out, "Int64", "connectivity")?;
        for &(_, cell) in cells {
            self.collect_vertices(cell)?;
            row(out, &self.corners)?;
        }
        out.put("</DataArray>\n")?;
        array(out, "Int64", "offsets")?;
        let mut offset = 0;
        for &(_, cell) in cells {
            self.collect_vertices(cell)?;
            offset += self.corners.len();
            line(out, offset)?;
        }
        out.put("</DataArray>\n")?;
        array(out, "UInt8", "types")?;
        cells.iter().try_for_each(|_| out.put(POLYHEDRON))?;
        out.put("</DataArray>\n")?;
        self.write_faces(out)?;
        out.put("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")
    }

    fn write_faces(&mut self, out: &mut Out) -> io::Result<()> {
        let (diagram, cells) = (self.diagram, self.cells);
        array(out, "Int64", "faces")?;
        for &(_, cell) in cells {
            line(out, cell.count as usize)?;
            for facet in Self::facets(diagram, cell) {
                self.collect_corners(facet)?;
                out.int(facet.count)?;
                out.put(b" ")?;
                row(out, &self.corners)?;
            }
        }
        out.put("</DataArray>\n")?;
        array(out, "Int64", "faceoffsets")?;
        let mut offset = 0;
        for &(_, cell) in cells {
            offset += 1 + Self::facets(diagram, cell).map(|facet| 1 + facet.count as usize).sum::<usize>();
            line(out, offset)?;
        }
        out.put("</DataArray>\n")
    }

    /// The corners of a bounded facet, in order: what consecutive edges share.
    fn collect_corners(&mut self, facet: &VoronoiFacet) -> io::Result<()> {
        let ring = self.diagram.edges_of(facet);
        self.corners.clear();
        let ends = |e: u32| self.diagram.edges.get(e as usize).map_or([INVALID; 2], |edge| edge.vertices);
        for (&edge, &next) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let next = ends(next);
            let shared = ends(edge).into_iter().find(|v| next.contains(v)).unwrap_or(0);
            fallible::push(&mut self.corners, shared).map_err(|_| io::ErrorKind::OutOfMemory)?;
        }
        Ok(())
    }

    /// The vertices of a cell, ascending.
    fn collect_vertices(&mut self, cell: &VoronoiCell) -> io::Result<()> {
        let diagram = self.diagram;
        self.corners.clear();
        for facet in Self::facets(diagram, cell) {
            for &e in diagram.edges_of(facet) {
                let ends = diagram.edges.get(e as usize).map_or([0; 2], |edge| edge.vertices);
                fallible::append(&mut self.corners, &ends).map_err(|_| io::ErrorKind::OutOfMemory)?;
            }
        }
        self.corners.sort_unstable();
        self.corners.dedup();
        Ok(())
    }
}

fn array(out: &mut Out, kind: &str, name: &str) -> io::Result<()> {
    out.format(format_args!("<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">\n"))
}

fn line(out: &mut Out, number: usize) -> io::Result<()> {
    out.format(format_args!("{number}\n"))
}

fn row(out: &mut Out, list: &[u32]) -> io::Result<()> {
    for (i, &v) in list.iter().enumerate() {
        if i > 0 {
            out.put(b" ")?;
        }
        out.int(v)?;
    }
    out.put(b"\n")
}
