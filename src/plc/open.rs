//! Edges where a surface is open, and parts that certainly enclose nothing.
//!
//! A triangle with an edge that no other triangle has bounds no volume: one can pass from one side to the other around that edge. Removing
//! it may leave others open. If all triangles can be removed this way (a collapse, Whitehead 1939), nothing is enclosed. The converse does
//! not hold, but surfaces without open edges that enclose nothing (Bing's house with two rooms) are curiosities.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::surface::Surface;
use crate::predicates::scale;

/// An edge of only one triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpenEdge {
    /// The ends, ascending: input points.
    pub ends: [u32; 2],
    /// The triangle, by its index in the surface.
    pub triangle: u32,
}

impl OpenEdge {
    /// The midpoint of the edge in the caller's coordinates, rounded.
    pub fn middle(&self, surface: &Surface) -> Option<[f64; 3]> {
        let [a, b] = self.ends.map(|v| surface.points.get(v as usize));
        let (a, b) = (a?, b?);
        Some([0, 1, 2].map(|k| scale(a[k] / 2.0 + b[k] / 2.0, -surface.scale)))
    }
}

/// The edges of the surface's triangles with their triangles, sorted.
fn uses(surface: &Surface, control: &Control) -> Result<Vec<([u32; 2], u32)>, Error> {
    control.look()?;
    let mut uses = fallible::reserved(3 * surface.triangles.len())?;
    for (t, &[a, b, c]) in (0..).zip(&surface.triangles) {
        fallible::extend(&mut uses, [[a, b], [b, c], [c, a]].map(|[a, b]| ([a.min(b), a.max(b)], t)))?;
    }
    control.sort(&mut uses)?;
    Ok(uses)
}

/// All open edges, in order of their ends.
///
/// # Errors
/// What ends the run, [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn open_edges(surface: &Surface, control: &Control) -> Result<Vec<OpenEdge>, Error> {
    let uses = uses(surface, control)?;
    let mut open = Vec::new();
    for run in uses.chunk_by(|x, y| x.0 == y.0) {
        if let [(ends, triangle)] = *run {
            fallible::push(&mut open, OpenEdge { ends, triangle })?;
        }
    }
    Ok(open)
}

/// Open edges of the shells (parts of the surface connected through edges) that certainly enclose nothing, and whether that holds for all
/// shells.
///
/// # Errors
/// What ends the run, [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn open_shells(surface: &Surface, control: &Control) -> Result<(Vec<OpenEdge>, bool), Error> {
    let uses = uses(surface, control)?;
    let count = surface.triangles.len();
    // For each edge its range of uses and the number of its remaining triangles; for each triangle its edges.
    let mut edges: Vec<[u32; 3]> = fallible::reserved(uses.len())?;
    let mut edges_of = fallible::filled([0u32; 3], count)?;
    let mut known = fallible::filled(0u8, count)?;
    let mut open = Vec::new();
    let mut from = 0;
    for run in uses.chunk_by(|x, y| x.0 == y.0) {
        for &(_, t) in run {
            edges_of[t as usize][usize::from(known[t as usize])] = edges.len() as u32;
            known[t as usize] += 1;
        }
        fallible::push(&mut edges, [from, from + run.len() as u32, run.len() as u32])?;
        from += run.len() as u32;
        if let [(ends, triangle)] = *run {
            fallible::push(&mut open, OpenEdge { ends, triangle })?;
        }
    }
    // Every triangle is removed at most once.
    let mut gone = fallible::filled(false, count)?;
    let mut stack: Vec<u32> = fallible::reserved(count)?;
    for edge in &open {
        if !std::mem::replace(&mut gone[edge.triangle as usize], true) {
            fallible::push(&mut stack, edge.triangle)?;
        }
    }
    while let Some(t) = stack.pop() {
        control.step()?;
        for e in edges_of[t as usize] {
            let [from, to, left] = &mut edges[e as usize];
            *left -= 1;
            if *left == 1 {
                let others = uses[*from as usize..*to as usize].iter().map(|x| x.1);
                for other in others {
                    if !std::mem::replace(&mut gone[other as usize], true) {
                        fallible::push(&mut stack, other)?;
                    }
                }
            }
        }
    }
    let all = gone.iter().all(|&gone| gone);
    // Shells with a remaining triangle may enclose something.
    let mut closed = gone;
    closed.iter_mut().for_each(|x| *x = !*x);
    fallible::extend(&mut stack, (0..count as u32).filter(|&t| closed[t as usize]))?;
    while let Some(t) = stack.pop() {
        control.step()?;
        for e in edges_of[t as usize] {
            let [from, to, _] = edges[e as usize];
            for &(_, other) in &uses[from as usize..to as usize] {
                if !std::mem::replace(&mut closed[other as usize], true) {
                    fallible::push(&mut stack, other)?;
                }
            }
        }
    }
    open.retain(|edge| !closed[edge.triangle as usize]);
    Ok((open, all))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(triangles: &[[u32; 3]]) -> Surface {
        let points = (0..20).map(|i| [f64::from(i), f64::from(i * i), 1.0]).collect();
        Surface { points, triangles: triangles.to_vec(), ..Surface::default() }
    }

    const TET: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

    #[test]
    fn closed_surfaces_have_no_open_edge() {
        let closed = surface(&TET);
        assert_eq!(open_edges(&closed, &Control::free()).unwrap(), []);
        assert_eq!(open_shells(&closed, &Control::free()).unwrap(), (vec![], false));
        assert_eq!(open_shells(&surface(&[]), &Control::free()).unwrap(), (vec![], true));
    }

    #[test]
    fn a_missing_triangle_opens_its_three_edges() {
        let leaky = surface(&TET[1..]);
        let (open, all) = open_shells(&leaky, &Control::free()).unwrap();
        assert!(all);
        assert_eq!(open.iter().map(|e| e.ends).collect::<Vec<_>>(), [[0, 1], [0, 2], [1, 2]]);
        assert_eq!(open, open_edges(&leaky, &Control::free()).unwrap());
        assert_eq!(open[0].middle(&leaky), Some([0.5, 0.5, 1.0]));
    }

    #[test]
    fn a_fin_on_a_closed_shell_is_no_shell_of_its_own() {
        let mut triangles = TET.to_vec();
        triangles.push([0, 1, 10]);
        triangles.push([11, 12, 13]);
        triangles.push([12, 13, 14]);
        let (open, all) = open_shells(&surface(&triangles), &Control::free()).unwrap();
        assert!(!all);
        let ends: Vec<_> = open.iter().map(|e| e.ends).collect();
        assert_eq!(ends, [[11, 12], [11, 13], [12, 14], [13, 14]]);
        assert_eq!(open_edges(&surface(&triangles), &Control::free()).unwrap().len(), 6);
    }
}
