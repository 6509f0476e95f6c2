//! Filling of a large mesh in [`blocks`](crate::blocks), by several threads.
//!
//! Before, everything is split that is more than [`COARSE`] times too large or too thin: most points are still missing, and tetrahedra are small
//! compared with blocks. In a block, points come as in a whole mesh. One whose cavity reaches a seam does not come: the tetrahedron that it
//! was for is left to the next round, whose seams are elsewhere, and after the last one to the whole mesh.
use super::{bounding_box, Fill, Shape};
use crate::blocks::divide::divide;
use crate::blocks::{on_each, Crew, Model, Piece};
use crate::control::Part;
use crate::error::Error;
use crate::fallible;
use crate::kernel::NONE;
use crate::output::RefineStatistics;
use crate::progress::Phase;
use crate::size::{Size, Wanted};

/// What is more than so many times too large or too thin is split in the whole mesh.
pub(super) const COARSE: f64 = 2.0;
/// Tetrahedra of a block before it is filled: then there are up to eight times as many.
/// (Tests have smaller ones, so that small meshes have several.)
const EACH: usize = if cfg!(test) { 1 << 9 } else { 1 << 13 };
/// With fewer tetrahedra to be split, the mesh is one block.
const FEWEST: usize = 2 * EACH;
/// Rounds of blocks.
const ROUNDS: usize = 2;

/// Whether so much is to be done that it is worth the detours.
pub(super) fn serve(left: usize) -> bool {
    left >= FEWEST
}

/// What has come in a block.
struct Filled {
    /// What is wanted at each new point.
    wanted: Vec<Wanted>,
    /// How many points there were before.
    came: usize,
    /// By vertex, whether a seam was in the way.
    open: Vec<bool>,
    counts: RefineStatistics,
}

/// Fills a mesh in blocks; returns by vertex whether there is something to do at it that seams were in the way of.
///
/// # Errors
/// As [`fill`](super::fill).
pub(super) fn fill(
    mut model: Model,
    size: &mut Size,
    shape: Shape,
    crew: Crew,
    counts: &mut RefineStatistics,
) -> Result<Vec<bool>, Error> {
    let mut open = fallible::filled(true, model.points.len())?;
    // A function of the caller need not be ready for several threads.
    let threads = if size.has_function() { 1 } else { crew.threads };
    let corners = bounding_box(model.points);
    for round in 0..ROUNDS {
        let inside = |t: u32| model.mesh.is_live(t) && model.mesh.region(t) != NONE;
        let shares = divide(model.mesh, model.points, inside, round, EACH, &crew.part)?;
        let [from, to] = [round, round + 1].map(|i| i as f64 / ROUNDS as f64);
        let crew = Crew { threads, part: crew.part.part(from, to) };
        let mut next = fallible::filled(false, model.points.len())?;
        let mut news: Vec<(u32, Wanted)> = Vec::new();
        let before = Before { size, shape, corners, open: &open };
        let work = |_: usize, piece: &mut Piece, part: Part| fill_block(piece, &before, part);
        let mut landed = |filled: Filled, vertices: &[u32]| {
            counts.add(&filled.counts);
            let count =
                vertices.iter().filter(|&&v| v != NONE).fold(next.len(), |most, &v| most.max(v as usize + 1));
            fallible::resize(&mut next, count, false)?;
            for (&v, _) in vertices.iter().zip(&filled.open).filter(|x| *x.1) {
                next[v as usize] = true;
            }
            let new = vertices[filled.came..].iter().zip(&filled.wanted).filter(|x| *x.0 != NONE);
            Ok(fallible::extend(&mut news, new.map(|(&v, &wanted)| (v, wanted)))?)
        };
        on_each(&mut model, &shares, crew, Phase::Refine, &work, &mut landed)?;
        for (v, wanted) in news {
            size.set(v, wanted)?;
        }
        open = next;
    }
    Ok(open)
}

/// What a block is to know of the whole mesh.
struct Before<'a, 'b> {
    size: &'a Size<'b>,
    shape: Shape,
    /// Of its box.
    corners: [[f64; 3]; 2],
    /// By vertex, whether there is something to do at it.
    open: &'a [bool],
}

fn fill_block(piece: &mut Piece, before: &Before, part: Part) -> Result<Filled, Error> {
    let Piece { block, points, inside, .. } = piece;
    let block = block.parts();
    let mut size = before.size.part(block.vertices)?;
    let came = points.len();
    let mut fill = Fill::new(block.mesh, points, inside, &mut size, part).shaped(before.shape);
    fill.corners = before.corners;
    fill.seams = Some(block.seams);
    fill.push_all(|v| before.open.get(block.vertices[v as usize] as usize) == Some(&true))?;
    fill.run(1.0)?;
    fill.give_back();
    let (open, counts) = (std::mem::take(&mut fill.open), fill.counts);
    let wanted = fallible::collect((came as u32..points.len() as u32).map(|v| size.noted(v)))?;
    Ok(Filled { wanted, came, open, counts })
}
