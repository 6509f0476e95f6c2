//! Edges of the facets' triangles: which of them constrain, and the patches between those.
//!
//! An edge is *flat*, and constrains nothing, when exactly two triangles meet there, of one facet or of facets with equal
//! markers, exactly coplanar and on opposite sides of it, and nothing else requires the edge. Every other edge is a segment; those that
//! only divide a polygon are recorded as its diagonals, since others would do as well.
//! Edges are grouped by a counting sort on their smaller end, so the segments come out sorted.
use crate::control::{blocks, Control};
use crate::error::{Error, Status};
use crate::fallible;
use crate::plc::polygon::project;
use crate::plc::surface::Surface;
use crate::predicates::{orient2d, orient3d, Sign};
use crate::INVALID;

/// An edge that constrains regardless of its triangles, and its input segment or `INVALID`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedEdge {
    /// The ends, in any order.
    pub ends: [u32; 2],
    /// The input segment it lies on.
    pub parent: u32,
}

/// One use of an edge: the larger end, and the triangle or (from the number of triangles on) the fixed edge.
type Use = (u32, u32);

/// Sets the surface's segments and patches from its triangles.
pub fn connect(
    surface: &mut Surface,
    fixed: &[FixedEdge],
    marker: impl Fn(u32) -> i32,
    control: &Control,
) -> Result<(), Error> {
    let count = surface.triangles.len();
    if 3 * count + fixed.len() >= INVALID as usize {
        return Err(Error::new(
            Status::TooLarge,
            "the facets have more triangles than 32-bit indices can address",
        ));
    }
    let (begin, uses) = group_uses(surface, fixed, control)?;
    let mut patches = Patches::new(count)?;
    surface.segments.clear();
    surface.segment_parent.clear();
    surface.diagonals.clear();
    for low in 0..surface.points.len() {
        let mut rest = &uses[begin[low] as usize..begin[low + 1] as usize];
        while let Some(&(high, _)) = rest.first() {
            control.step()?;
            let (edge, others) = rest.split_at(rest.iter().take_while(|u| u.0 == high).count());
            rest = others;
            if let [(_, t), (_, u)] = *edge {
                if (u as usize) < count && is_flat(surface, [low as u32, high], t, u, &marker) {
                    patches.join(t, u);
                    continue;
                }
                let facet =
                    |t: u32| surface.triangle_facet.get(t as usize).filter(|f| **f >= surface.first_polygon);
                if let (Some(&f), Some(&g)) = (facet(t), facet(u)) {
                    if f == g {
                        fallible::push(&mut surface.diagonals, (surface.segments.len() as u32, f))?;
                    }
                }
            }
            fallible::push(&mut surface.segments, [low as u32, high])?;
            let parents =
                edge.iter().filter_map(|&(_, u)| Some(fixed.get((u as usize).checked_sub(count)?)?.parent));
            fallible::push(&mut surface.segment_parent, parents.min().unwrap_or(INVALID))?;
        }
    }
    surface.patch_count = patches.number(&mut surface.triangle_patch)?;
    Ok(())
}

/// All uses of edges, grouped by the smaller end and sorted within each group, and the beginning of each group.
fn group_uses(
    surface: &Surface,
    fixed: &[FixedEdge],
    control: &Control,
) -> Result<(Vec<u32>, Vec<Use>), Error> {
    let each = |f: &mut dyn FnMut(u32, u32, u32)| {
        for (t, &[a, b, c]) in surface.triangles.iter().enumerate() {
            for (u, v) in [(a, b), (b, c), (c, a)] {
                f(u.min(v), u.max(v), t as u32);
            }
        }
        for (i, edge) in fixed.iter().enumerate() {
            let [u, v] = edge.ends;
            f(u.min(v), u.max(v), (surface.triangles.len() + i) as u32);
        }
    };
    let total = 3 * surface.triangles.len() + fixed.len();
    let mut begin: Vec<u32> = fallible::filled(0, surface.points.len() + 2)?;
    control.look()?;
    each(&mut |low, _, _| begin[low as usize + 2] += 1);
    control.look()?;
    for i in 2..begin.len() {
        begin[i] += begin[i - 1];
    }
    let mut uses: Vec<Use> = fallible::filled((0, 0), total)?;
    each(&mut |low, high, user| {
        let place = &mut begin[low as usize + 1];
        uses[*place as usize] = (high, user);
        *place += 1;
    });
    begin.pop();
    for block in blocks(surface.points.len()) {
        control.step()?;
        block.for_each(|i| uses[begin[i] as usize..begin[i + 1] as usize].sort_unstable());
    }
    Ok((begin, uses))
}

/// Whether the edge between two triangles constrains nothing.
fn is_flat(surface: &Surface, [a, b]: [u32; 2], t: u32, u: u32, marker: impl Fn(u32) -> i32) -> bool {
    let (f, g) = (surface.triangle_facet[t as usize], surface.triangle_facet[u as usize]);
    if f != g && marker(f) != marker(g) {
        return false;
    }
    let apex = |t: u32| surface.triangles[t as usize].into_iter().find(|&v| v != a && v != b).unwrap_or(a);
    are_flat(&surface.points, [a, b], apex(t), apex(u))
}

/// Whether the triangles from an edge to two vertices are exactly coplanar, on opposite sides of the edge.
pub fn are_flat(points: &[[f64; 3]], [a, b]: [u32; 2], c: u32, d: u32) -> bool {
    let at = |v: u32| &points[v as usize];
    if orient3d(at(a), at(b), at(c), at(d)) != Sign::Zero {
        return false;
    }
    let turn =
        |axis: usize, x: u32| orient2d(project(at(a), axis), project(at(b), axis), project(at(x), axis));
    (0..3)
        .map(|axis| (turn(axis, c), axis))
        .find(|s| s.0 != Sign::Zero)
        .is_some_and(|(sign, axis)| turn(axis, d) == -sign)
}

/// Disjoint sets of triangles (Tarjan): the smallest member represents each set.
pub struct Patches {
    parent: Vec<u32>,
}

impl Patches {
    /// Every triangle alone.
    pub fn new(count: usize) -> Result<Self, Error> {
        let parent = fallible::collect(0..count as u32)?;
        Ok(Patches { parent })
    }

    /// The smallest member of the set of `t`.
    pub fn find(&mut self, mut t: u32) -> u32 {
        while self.parent[t as usize] != t {
            let up = self.parent[self.parent[t as usize] as usize];
            self.parent[t as usize] = up;
            t = up;
        }
        t
    }

    /// Joins two sets.
    pub fn join(&mut self, t: u32, u: u32) {
        let (a, b) = (self.find(t), self.find(u));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// Numbers the sets in the order of their first members; returns the number of sets.
    pub fn number(mut self, patch: &mut Vec<u32>) -> Result<u32, Error> {
        patch.clear();
        patch.try_reserve_exact(self.parent.len())?;
        let mut count = 0;
        for t in 0..self.parent.len() as u32 {
            let root = self.find(t);
            let number = if root == t { count } else { patch[root as usize] };
            count += u32::from(root == t);
            fallible::push(patch, number)?;
        }
        Ok(count)
    }
}
