//! Positions in doubles for points that stay on internal segments.
//!
//! Each goes to the doubles nearest to it, or a few units in the last place away, where it sees all faces of its star; the others are where
//! they were moved before, or still exactly on their segments. So every tetrahedron is positive after every step, and positive in doubles
//! when all are settled.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::ops::place::{sees_all, step};
use crate::predicates::{in_range, Points};
use crate::segments::recovery::Segments;

/// Farthest neighbour tried, in units in the last place: the number of neighbours grows with its cube. 1 and 6 change nothing on one model.
const FARTHEST: i32 = 3;

/// A point that stays on its segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settled {
    /// Vertex id.
    pub v: u32,
    /// Its doubles are exactly where the parameter says.
    pub exact: bool,
    /// Its nearest doubles were not valid.
    pub moved: bool,
}

/// Settles the points, or none of them: returns them, and those without a valid position.
pub fn settle(
    mesh: &mut Mesh,
    points: &mut Points,
    segments: &Segments,
    list: &[u32],
    control: &Control,
) -> Result<(Vec<Settled>, Vec<u32>), Error> {
    let mut search = StarSearch::default();
    let mut link = Vec::new();
    let (mut settled, mut crowded) = (Vec::new(), Vec::new());
    settled.try_reserve(list.len())?;
    for &v in list {
        control.look()?;
        if mesh.vertex_tet[v as usize] == NONE {
            continue;
        }
        search.link(mesh, v, &mut link)?;
        let exact = points.is_explicit(v);
        let steps = if exact { Some(0) } else { find_doubles(points, v, &link)? };
        let Some(steps) = steps else {
            unsettle(points, segments, v)?;
            fallible::push(&mut crowded, v)?;
            continue;
        };
        fallible::push(&mut settled, Settled { v, exact, moved: steps > 0 })?;
    }
    if !crowded.is_empty() {
        for point in settled.drain(..).filter(|point| !point.exact) {
            unsettle(points, segments, point.v)?;
        }
    }
    Ok((settled, crowded))
}

/// Puts a point back on its segment.
fn unsettle(points: &mut Points, segments: &Segments, v: u32) -> Result<(), Error> {
    let segment = segments.steiner_segment[(v - segments.first_steiner) as usize];
    points.move_on_segment(v, segments.ends[segment as usize], &segments.parameter(segment, v))
}

/// Moves a point to the nearest doubles that see its link; returns how many units in the last place they are off, if there are any.
fn find_doubles(points: &mut Points, v: u32, link: &[[u32; 3]]) -> Result<Option<i32>, Error> {
    let from = *points.xyz(v);
    for reach in 0..=FARTHEST {
        for dx in -reach..=reach {
            for dy in -reach..=reach {
                for dz in -reach..=reach {
                    let at = [step(from[0], dx), step(from[1], dy), step(from[2], dz)];
                    let shell = [dx, dy, dz].iter().any(|d| d.abs() == reach);
                    if !shell || !at.iter().all(|&x| in_range(x)) {
                        continue;
                    }
                    points.settle(v, at)?;
                    if sees_all(points, v, link) {
                        return Ok(Some(reach));
                    }
                }
            }
        }
    }
    Ok(None)
}
