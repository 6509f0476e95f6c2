//! VTK XML unstructured grids (`.vtu`), arrays appended in raw binary, zlib-compressed on request. Source: VTK User's Guide,
//! "VTK File Formats", XML formats.
//!
//! Cells carry `region` (the attribute) and `min_dihedral` (degrees), points the input's attributes and markers and whether
//! they are Steiner points. The second file's cells are the subfaces with `facet` and `marker`.
use super::output_files::Out;
use super::quality::{corners, dihedrals};
use super::tags::attribute_of;
use crate::output::TetMesh;
use crate::plc::Plc;
use crate::INVALID;
use flate2::{Compress, Compression, FlushCompress};
use std::io::{self, Write};

type Sink<'s> = &'s mut dyn FnMut(&[u8]) -> io::Result<()>;

/// One array: what the header says of it, and how its bytes come.
struct Array<'a> {
    name: String,
    kind: &'static str,
    components: usize,
    bytes: u64,
    fill: Box<dyn Fn(Sink<'_>) -> io::Result<()> + 'a>,
}

/// A grid of one kind of cell.
struct Grid<'a> {
    point_count: usize,
    cell_count: usize,
    point_data: Vec<Array<'a>>,
    cell_data: Vec<Array<'a>>,
    points: Array<'a>,
    cells: Vec<Array<'a>>,
}

/// Writes the tetrahedra of a mesh; `added` are the attributes of the points after the input's.
pub(super) fn write(
    out: &mut Out,
    mesh: &TetMesh,
    plc: &Plc,
    added: &[f64],
    compress: bool,
) -> io::Result<()> {
    let grid = Grid {
        point_count: mesh.points.len(),
        cell_count: mesh.tets.len(),
        point_data: point_data(mesh, plc, added),
        cell_data: vec![
            array("region", "Float64", 1, 8, mesh.tets.len(), |i, sink| {
                sink(&attribute_of(mesh, i).to_le_bytes())
            }),
            array("min_dihedral", "Float32", 1, 4, mesh.tets.len(), |i, sink| {
                sink(&(dihedrals(corners(mesh, &mesh.tets[i]))[0] as f32).to_le_bytes())
            }),
        ],
        points: array("Points", "Float64", 3, 24, mesh.points.len(), |i, sink| {
            sink(&flat(mesh.points[i].map(f64::to_le_bytes)))
        }),
        cells: cells::<4, 16>(mesh.tets.len(), 10, |i| mesh.tets[i]),
    };
    write_grid(out, &grid, compress)
}

/// Writes the subfaces of a mesh, with the points that they use.
pub(super) fn write_subfaces(out: &mut Out, mesh: &TetMesh, compress: bool) -> io::Result<()> {
    let mut new_index = vec![INVALID; mesh.points.len()];
    let mut used: Vec<u32> = Vec::new();
    for &corner in mesh.subfaces.iter().flat_map(|face| &face.corners) {
        let Some(index) = new_index.get_mut(corner as usize) else { continue };
        if *index == INVALID {
            *index = used.len() as u32;
            used.push(corner);
        }
    }
    let count = mesh.subfaces.len();
    let grid = Grid {
        point_count: used.len(),
        cell_count: count,
        point_data: vec![array("point", "UInt32", 1, 4, used.len(), |i, sink| sink(&used[i].to_le_bytes()))],
        cell_data: vec![
            array("facet", "UInt32", 1, 4, count, |i, sink| sink(&mesh.subfaces[i].facet.to_le_bytes())),
            array("marker", "Int32", 1, 4, count, |i, sink| sink(&mesh.subfaces[i].marker.to_le_bytes())),
        ],
        points: array("Points", "Float64", 3, 24, used.len(), |i, sink| {
            sink(&flat(mesh.points[used[i] as usize].map(f64::to_le_bytes)))
        }),
        cells: cells::<3, 12>(count, 5, |i| {
            mesh.subfaces[i].corners.map(|c| new_index.get(c as usize).copied().unwrap_or(0))
        }),
    };
    write_grid(out, &grid, compress)
}

/// An array of `count` items of `size` bytes.
fn array<'a>(
    name: impl Into<String>,
    kind: &'static str,
    components: usize,
    size: u64,
    count: usize,
    item: impl Fn(usize, Sink<'_>) -> io::Result<()> + 'a,
) -> Array<'a> {
    let fill = move |sink: Sink<'_>| (0..count).try_for_each(|i| item(i, sink));
    Array { name: name.into(), kind, components, bytes: size * count as u64, fill: Box::new(fill) }
}

fn flat(words: [[u8; 8]; 3]) -> [u8; 24] {
    let mut bytes = [0; 24];
    bytes.chunks_exact_mut(8).zip(words).for_each(|(to, word)| to.copy_from_slice(&word));
    bytes
}

fn point_data<'a>(mesh: &'a TetMesh, plc: &'a Plc, added: &'a [f64]) -> Vec<Array<'a>> {
    let count = mesh.points.len();
    let mut arrays = Vec::new();
    for k in 0..plc.point_attribute_count {
        arrays.push(array(format!("attribute_{k}"), "Float64", 1, 8, count, move |i, sink| {
            sink(&super::write_tetgen::attribute(plc, added, i, k).to_le_bytes())
        }));
    }
    if !plc.point_markers.is_empty() {
        arrays.push(array("marker", "Int32", 1, 4, count, |i, sink| {
            sink(&plc.point_markers.get(i).copied().unwrap_or(0).to_le_bytes())
        }));
    }
    let inputs = mesh.input_point_count as usize;
    arrays.push(array("steiner", "UInt8", 1, 1, count, move |i, sink| sink(&[u8::from(i >= inputs)])));
    arrays
}

/// Connectivity, offsets and types of `count` cells of `N` corners; 32-bit where that suffices.
fn cells<'a, const N: usize, const BYTES: usize>(
    count: usize,
    vtk_type: u8,
    corners_of: impl Fn(usize) -> [u32; N] + 'a,
) -> Vec<Array<'a>> {
    let wide = (N as u64) * (count as u64) > i32::MAX as u64;
    let (kind, size) = if wide { ("Int64", 8) } else { ("Int32", 4) };
    let connectivity = array("connectivity", kind, 1, size * N as u64, count, move |i, sink| {
        if wide {
            return corners_of(i).iter().try_for_each(|&c| sink(&u64::from(c).to_le_bytes()));
        }
        let mut bytes = [0; BYTES];
        bytes.chunks_exact_mut(4).zip(corners_of(i)).for_each(|(to, c)| to.copy_from_slice(&c.to_le_bytes()));
        sink(&bytes)
    });
    let offsets = array("offsets", kind, 1, size, count, move |i, sink| {
        let end = (N * (i + 1)) as u64;
        sink(&end.to_le_bytes()[..size as usize])
    });
    vec![connectivity, offsets, array("types", "UInt8", 1, 1, count, move |_, sink| sink(&[vtk_type]))]
}

fn write_grid(out: &mut Out, grid: &Grid<'_>, compress: bool) -> io::Result<()> {
    let sections: [(&str, &[Array<'_>]); 4] = [
        ("PointData", &grid.point_data),
        ("CellData", &grid.cell_data),
        ("Points", std::slice::from_ref(&grid.points)),
        ("Cells", &grid.cells),
    ];
    let mut packed: Vec<Vec<u8>> = Vec::new();
    if compress {
        for array in sections.iter().flat_map(|(_, arrays)| *arrays) {
            packed.push(compressed(array)?);
        }
    }
    let compressor = if compress { " compressor=\"vtkZLibDataCompressor\"" } else { "" };
    out.format(format_args!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\"{compressor}>\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        grid.point_count, grid.cell_count
    ))?;
    let (mut offset, mut number) = (0, 0);
    for (section, arrays) in &sections {
        out.format(format_args!("<{section}>\n"))?;
        for array in *arrays {
            out.format(format_args!(
                "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{offset}\"/>\n",
                array.kind, array.name, array.components
            ))?;
            offset += packed.get(number).map_or(8 + array.bytes, |p| p.len() as u64);
            number += 1;
        }
        out.format(format_args!("</{section}>\n"))?;
    }
    out.put("</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_")?;
    if compress {
        packed.iter().try_for_each(|bytes| out.put(bytes))?;
    } else {
        for array in sections.iter().flat_map(|(_, arrays)| *arrays) {
            out.put(array.bytes.to_le_bytes())?;
            (array.fill)(&mut |bytes| out.put(bytes))?;
        }
    }
    out.put("\n</AppendedData>\n</VTKFile>\n")
}

/// An array as VTK's zlib compressor lays it out: the number of blocks, their size, the size of a last partial one, the
/// compressed sizes (64 bits each), then the blocks.
fn compressed(array: &Array<'_>) -> io::Result<Vec<u8>> {
    const BLOCK: usize = 1 << 17;
    let mut block = Vec::with_capacity(BLOCK + 32);
    let mut sizes: Vec<u64> = Vec::new();
    let mut data = Vec::new();
    (array.fill)(&mut |bytes| {
        block.write_all(bytes)?;
        if block.len() >= BLOCK {
            sizes.push(deflate(&block[..BLOCK], &mut data)?);
            block.drain(..BLOCK);
        }
        Ok(())
    })?;
    let partial = block.len() as u64;
    if partial > 0 {
        sizes.push(deflate(&block, &mut data)?);
    }
    let header = [sizes.len() as u64, BLOCK as u64, partial];
    let mut packed = Vec::with_capacity(8 * (3 + sizes.len()) + data.len());
    header.iter().chain(&sizes).for_each(|word| packed.extend_from_slice(&word.to_le_bytes()));
    packed.extend_from_slice(&data);
    Ok(packed)
}

/// Appends one zlib stream and returns its size.
fn deflate(block: &[u8], data: &mut Vec<u8>) -> io::Result<u64> {
    let start = data.len();
    // zlib's bound for incompressible data, so that one call does it.
    data.reserve(block.len() + block.len() / 1000 + 64);
    Compress::new(Compression::fast(), true)
        .compress_vec(block, data, FlushCompress::Finish)
        .map_err(io::Error::other)?;
    Ok((data.len() - start) as u64)
}
