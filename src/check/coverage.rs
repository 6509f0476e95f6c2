//! Coverage: the subfaces of each group of facets tile exactly the group's union.
//!
//! Take every subface counter-clockwise in the group's plane. If each edge is used at most twice, and then in both directions, and the
//! edges used once are exactly the boundary (modulo 2) of the union of the input polygons, then the number of subfaces over a point of the
//! plane changes by one at that boundary and nowhere else, and is 0 far away. So it is even outside the union and odd inside. Distinct
//! faces of a valid complex do not overlap, so it is 0 and 1.
use crate::check::chains::Chains;
use crate::check::context::Context;
use crate::check::facets::{Facet, Piece};
use crate::check::report::Report;
use crate::error::{DefectKind, Element, Error};
use crate::fallible;
use crate::predicates::Sign;

/// One use of a mesh edge by a subface: the ends ascending, whether it runs from the larger to the smaller, and the subface.
type Use = ([u32; 2], bool, u32);

/// A group of facets and the subfaces that name one of them.
struct Group<'a> {
    context: &'a Context<'a>,
    facets: &'a [Facet],
    /// Facets of the group, ascending.
    members: Vec<u32>,
    /// Indices of subfaces.
    subfaces: Vec<u32>,
    /// Edge pieces of the members, sorted.
    pieces: Vec<Piece>,
    planar: bool,
}

/// Reports facets that are not covered exactly.
pub(super) fn check_coverage<'a>(
    context: &'a Context<'a>,
    facets: &'a [Facet],
    pieces: &[Piece],
    group: &[u32],
    report: &mut Report,
) -> Result<(), Error> {
    // Counting sorts would be faster, but these lists are small compared with the tetrahedra.
    let mut members: Vec<(u32, u32)> =
        fallible::collect(group.iter().enumerate().map(|(facet, &g)| (g, facet as u32)))?;
    members.sort_unstable();
    let mut subfaces: Vec<(u32, u32)> = fallible::reserved(context.subfaces.len())?;
    let numbered = context.subfaces.iter().enumerate();
    fallible::extend(&mut subfaces, numbered.map(|(i, face)| (group[face.facet as usize], i as u32)))?;
    subfaces.sort_unstable();
    let mut edges: Vec<(u32, Piece)> =
        fallible::collect(pieces.iter().map(|p| (group[p.facet as usize], *p)))?;
    edges.sort_unstable();
    let (mut s, mut e) = (0, 0);
    for run in members.chunk_by(|x, y| x.0 == y.0) {
        let g = run[0].0;
        let (s0, e0) = (s, e);
        s += subfaces[s..].partition_point(|x| x.0 == g);
        e += edges[e..].partition_point(|x| x.0 == g);
        let group = Group {
            context,
            facets,
            members: fallible::collect(run.iter().map(|x| x.1))?,
            subfaces: fallible::collect(subfaces[s0..s].iter().map(|x| x.1))?,
            pieces: fallible::collect(edges[e0..e].iter().map(|x| x.1))?,
            planar: run.iter().all(|x| facets[x.1 as usize].planar),
        };
        group.check(report)?;
    }
    Ok(())
}

impl Group<'_> {
    fn check(&self, report: &mut Report) -> Result<(), Error> {
        self.check_corners(report)?;
        // One projection of a plane keeps all orientations; a folded polygon must match in one of the three.
        let axes = match self.members.iter().find_map(|&f| self.facets[f as usize].plane) {
            Some(plane) if self.planar => {
                let sees = |&axis: &usize| self.context.geometry.orient_in_plane(axis, plane) != Sign::Zero;
                (0..3).find(sees).map_or(0..0, |axis| axis..axis + 1)
            }
            _ => 0..3,
        };
        let mut best: Option<Vec<(u32, [u32; 2])>> = None;
        for axis in axes {
            let wrong = self.mismatches(axis)?;
            if best.as_ref().is_none_or(|b| wrong.len() < b.len()) {
                best = Some(wrong);
            }
        }
        for (facet, [a, b]) in best.unwrap_or_default() {
            let at = self.context.position(a);
            report.add(DefectKind::FacetMissing, Element::Facet(facet), Some(Element::Point(b)), at);
        }
        Ok(())
    }

    /// Edges where subfaces and polygons disagree in projection along `axis`, each with a facet.
    fn mismatches(&self, axis: usize) -> Result<Vec<(u32, [u32; 2])>, Error> {
        let mut wrong = Vec::new();
        let uses = self.uses(axis, &mut wrong)?;
        let any_enclosed = self.members.iter().any(|&f| self.facets[f as usize].enclosed);
        let any_seeded = self.members.iter().any(|&f| self.facets[f as usize].seeded);
        let mut pieces = self.pieces.chunk_by(|x, y| x.ends == y.ends).peekable();
        let mut runs = uses.chunk_by(|x, y| x.0 == y.0).peekable();
        loop {
            let next = match (pieces.peek(), runs.peek()) {
                (None, None) => return Ok(wrong),
                (Some(p), None) => p[0].ends,
                (None, Some(u)) => u[0].0,
                (Some(p), Some(u)) => p[0].ends.min(u[0].0),
            };
            let p = pieces.next_if(|p| p[0].ends == next).unwrap_or(&[]);
            let u = runs.next_if(|u| u[0].0 == next).unwrap_or(&[]);
            let good = if any_enclosed {
                // With seeds, single edges do not tell inside from outside: the boundary may be anywhere on the polygons.
                (u.len() != 1 || !p.is_empty()) && (any_seeded || p.is_empty() || !u.is_empty())
            } else {
                p.len() % 2 == u.len() % 2
            };
            let opposite = u.len() < 2 || u.len() == 2 && u[0].1 != u[1].1;
            if !good || !opposite {
                let facet = match u.first() {
                    Some(edge) => self.context.subfaces[edge.2 as usize].facet,
                    None => p[0].facet,
                };
                fallible::push(&mut wrong, (facet, next))?;
            }
        }
    }

    /// The edges of all subfaces, taken counter-clockwise along `axis`; flat ones go to `wrong`.
    fn uses(&self, axis: usize, wrong: &mut Vec<(u32, [u32; 2])>) -> Result<Vec<Use>, Error> {
        let mut uses = fallible::reserved(3 * self.subfaces.len())?;
        for &i in &self.subfaces {
            let face = &self.context.subfaces[i as usize];
            let corners = face.corners;
            let sign = self.context.geometry.orient_in_plane(axis, corners);
            if sign == Sign::Zero {
                fallible::push(wrong, (face.facet, [corners[0], corners[1]]))?;
            }
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                fallible::push(&mut uses, ([a.min(b), a.max(b)], (a > b) != (sign == Sign::Negative), i))?;
            }
        }
        uses.sort_unstable();
        Ok(uses)
    }

    /// Checks that corners of subfaces lie on the group: exactly in its plane; or, if it has none, at corners of its polygons, on lines
    /// between two of them, or where the subfaces are flat or bent along only one line.
    fn check_corners(&self, report: &mut Report) -> Result<(), Error> {
        let mut known = fallible::collect(self.pieces.iter().flat_map(|p| p.ends))?;
        for &f in &self.members {
            fallible::extend(&mut known, self.facets[f as usize].corners.iter().copied())?;
        }
        known.sort_unstable();
        known.dedup();
        let knows = |v: u32| known.binary_search(&v).is_ok();
        let plane = self.members.iter().find_map(|&f| self.facets[f as usize].plane);
        for &i in &self.subfaces {
            let face = &self.context.subfaces[i as usize];
            for &v in &face.corners {
                let on = knows(v)
                    || self.context.ends(v).is_some_and(|ends| ends.iter().all(|&e| knows(e)))
                    || self.planar
                        && plane.is_some_and(|[a, b, c]| {
                            self.context.geometry.orient3d([a, b, c, v]) == Sign::Zero
                        })
                    || !self.planar && self.is_even(v)?;
                if !on {
                    let at = self.context.position(v);
                    report.add(
                        DefectKind::FacetMissing,
                        Element::Facet(face.facet),
                        Some(Element::Point(v)),
                        at,
                    );
                }
            }
        }
        Ok(())
    }
}

impl Group<'_> {
    /// Whether the subfaces around a vertex, no corner of a non-planar facet, lie in one plane, or in two that meet in a line through it:
    /// then it lies on the triangles that its neighbours span.
    fn is_even(&self, v: u32) -> Result<bool, Error> {
        let geometry = &self.context.geometry;
        let corners = |&i: &u32| self.context.subfaces[i as usize].corners;
        let star = fallible::collect(self.subfaces.iter().map(corners).filter(|c| c.contains(&v)))?;
        let in_plane = |[x, y, z]: [u32; 3], corners: &[u32; 3]| {
            corners.iter().all(|w| [x, y, z].contains(w) || geometry.orient3d([x, y, z, *w]) == Sign::Zero)
        };
        let Some(&first) = star.first() else { return Ok(false) };
        let Some(&second) = star.iter().find(|c| !in_plane(first, c)) else { return Ok(true) };
        let two_planes = star.iter().all(|c| in_plane(first, c) || in_plane(second, c));
        let mut around = fallible::collect(star.iter().flatten().copied().filter(|&w| w != v))?;
        around.sort_unstable();
        around.dedup();
        let mut pairs =
            around.iter().enumerate().flat_map(|(i, &a)| around[i + 1..].iter().map(move |&b| (a, b)));
        Ok(two_planes && pairs.any(|(a, b)| geometry.strictly_between(v, a, b)))
    }
}

/// Checks that edges given inside facets (polygons of two corners) are chains of mesh edges.
pub(super) fn check_inner_edges(
    context: &Context,
    facets: &[Facet],
    chains: &Chains,
    report: &mut Report,
) -> Result<(), Error> {
    let mut chain = Vec::new();
    for (i, facet) in facets.iter().enumerate() {
        for &[a, b] in &facet.inner_edges {
            if a != b && !chains.find(a, b, &mut chain)? {
                let at = context.position(a);
                report.add(DefectKind::SegmentMissing, Element::Facet(i as u32), Some(Element::Point(a)), at);
            }
        }
    }
    Ok(())
}
