//! Divisions of tetrahedra into blocks: compact ones, about equally large, by recursive coordinate bisection of the vertices (Berger & Bokhari
//! 1987). A tetrahedron is in the first of its vertices' blocks.
//!
//! Each round bisects along other directions, so that its borders meet those of the round before in lines. Coordinates choose, and any
//! choice is valid; it does not depend on the number of threads.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::block::Shares;
use crate::kernel::{Mesh, NONE};
use crate::predicates::Points;
use crate::vector::dot;

/// Orthogonal directions of equal lengths, by round.
const DIRECTIONS: [[[f64; 3]; 3]; 3] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[2.0, 2.0, 1.0], [-2.0, 1.0, 2.0], [1.0, -2.0, 2.0]],
    [[6.0, 2.0, 3.0], [-3.0, 6.0, 2.0], [2.0, 3.0, -6.0]],
];

/// Some vertices, to be divided into blocks with consecutive numbers.
#[derive(Clone, Copy)]
struct Piece {
    from: usize,
    to: usize,
    first: u32,
    count: u32,
}

/// Divides the tetrahedra that are chosen into blocks of about so many.
///
/// # Errors
/// `OutOfMemory`, and what ends the run.
pub fn divide(
    mesh: &Mesh,
    points: &Points,
    chosen: impl Fn(u32) -> bool,
    round: usize,
    each: usize,
    control: &Control,
) -> Result<Shares, Error> {
    let mut owner = fallible::filled(NONE, points.len())?;
    let (mut vertices, mut tets) = (Vec::new(), 0);
    for t in mesh.all() {
        control.steps(u32::from(t % 16 == 0))?;
        if chosen(t) {
            tets += 1;
            for v in mesh.verts(t) {
                if owner[v as usize] == NONE {
                    owner[v as usize] = 0;
                    fallible::push(&mut vertices, v)?;
                }
            }
        }
    }
    let count = (tets / each.max(1)).max(1) as u32;
    bisect(points, &mut vertices, count, &DIRECTIONS[round % DIRECTIONS.len()], &mut owner, control)?;
    let block_of = |t: u32| mesh.verts(t).map(|v| owner[v as usize]).into_iter().min().unwrap_or(NONE);
    let mut starts = fallible::filled(0, count as usize + 1)?;
    for t in mesh.all().filter(|&t| chosen(t)) {
        control.steps(u32::from(t % 16 == 0))?;
        starts[block_of(t) as usize + 1] += 1;
    }
    for i in 1..starts.len() {
        starts[i] += starts[i - 1];
    }
    let mut next = fallible::copied(&starts)?;
    let mut slots = fallible::filled(NONE, tets)?;
    let mut rank = fallible::filled(NONE, mesh.slot_count())?;
    for t in mesh.all().filter(|&t| chosen(t)) {
        control.steps(u32::from(t % 16 == 0))?;
        let next = &mut next[block_of(t) as usize];
        slots[*next] = t;
        rank[t as usize] = *next as u32;
        *next += 1;
    }
    Ok(Shares { slots, starts, rank })
}

/// Writes the block of each vertex.
fn bisect(
    points: &Points,
    vertices: &mut [u32],
    count: u32,
    directions: &[[f64; 3]; 3],
    owner: &mut [u32],
    control: &Control,
) -> Result<(), Error> {
    let mut open = Vec::new();
    fallible::push(&mut open, Piece { from: 0, to: vertices.len(), first: 0, count })?;
    while let Some(Piece { from, to, first, count }) = open.pop() {
        control.look()?;
        let part = &mut vertices[from..to];
        if count < 2 || part.len() < 2 {
            part.iter().for_each(|&v| owner[v as usize] = first);
            continue;
        }
        let along = |v: u32, k: usize| dot(points.xyz(v), &directions[k]);
        let extent = |k: usize| {
            let ends = part.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| {
                let x = along(v, k);
                [low.min(x), high.max(x)]
            });
            ends[1] - ends[0]
        };
        let extents = [0, 1, 2].map(extent);
        let longest = (0..3).fold(0, |best, k| if extents[k] > extents[best] { k } else { best });
        let half = count / 2;
        let middle = (part.len() as u64 * u64::from(half) / u64::from(count)) as usize;
        part.select_nth_unstable_by(middle, |&v, &w| {
            along(v, longest).total_cmp(&along(w, longest)).then(v.cmp(&w))
        });
        fallible::push(&mut open, Piece { from, to: from + middle, first, count: half })?;
        fallible::push(
            &mut open,
            Piece { from: from + middle, to, first: first + half, count: count - half },
        )?;
    }
    Ok(())
}
