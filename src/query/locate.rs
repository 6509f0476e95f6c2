//! Finds the tetrahedron that contains a point, and its barycentric coordinates.
//!
//! A tree of bounding boxes over the tetrahedra (median splits of the centres) yields candidates; exact orientation signs
//! decide. A point on a shared face, edge or vertex belongs to the tetrahedron with the smallest index, so the result does not depend on
//! the order of the queries. Non-convex meshes and meshes of several parts need no special treatment.
use crate::elementary::{exponent, power_of_two};
use crate::error::Error;
use crate::fallible;
use crate::predicates::{orient3d, Sign};
use crate::query::FACE_CORNERS;
use crate::{TetMesh, INVALID};

/// Tetrahedra per leaf: few enough to test one by one.
const LEAF: usize = 4;

/// An axis-parallel box.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: [f64; 3],
    high: [f64; 3],
}

impl Bounds {
    const EMPTY: Bounds = Bounds { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    fn add(&mut self, point: &[f64; 3]) {
        for (axis, &x) in point.iter().enumerate() {
            self.low[axis] = self.low[axis].min(x);
            self.high[axis] = self.high[axis].max(x);
        }
    }

    fn contains(&self, point: &[f64; 3]) -> bool {
        (0..3).all(|axis| self.low[axis] <= point[axis] && point[axis] <= self.high[axis])
    }
}

/// A node of the tree: tetrahedra `order[start..end]`; the left child follows the node, `right` is the other (0: a leaf).
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    start: u32,
    end: u32,
    right: u32,
}

/// Finds the tetrahedra that contain points, in one mesh.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug)]
pub struct Locator {
    nodes: Vec<Node>,
    order: Vec<u32>,
    /// A power of two that scales the mesh to about unit size, where the predicates are exact.
    scale: f64,
}

/// The location of a point: a tetrahedron, and the sign of the point relative to each of its faces (all non-negative).
struct Hit {
    tet: u32,
    signs: [Sign; 4],
}

/// A tetrahedron to be inserted into the tree.
#[derive(Clone, Copy)]
struct Entry {
    /// Approximate centroid. It need not be exact: any split gives a valid tree.
    centre: [f32; 3],
    tet: u32,
}

impl Locator {
    /// Builds the tree in O(n log n) time and about 40 bytes per tetrahedron. Fails if memory runs out.
    pub fn new(mesh: &TetMesh) -> Result<Locator, Error> {
        let mut locator = Locator { nodes: Vec::new(), order: Vec::new(), scale: scale_of(&mesh.points) };
        let mut entries = fallible::collect(mesh.tets.iter().enumerate().map(|(tet, corners)| {
            let quarter =
                |corner: u32, axis: usize| 0.25 * locator.scale * mesh.points[corner as usize][axis];
            let centre =
                |axis: usize| corners.iter().map(|&corner| quarter(corner, axis)).sum::<f64>() as f32;
            Entry { centre: [centre(0), centre(1), centre(2)], tet: tet as u32 }
        }))?;
        locator.split(&mut entries)?;
        locator.order.try_reserve_exact(entries.len())?;
        fallible::extend(&mut locator.order, entries.iter().map(|entry| entry.tet))?;
        locator.bound(mesh);
        Ok(locator)
    }

    /// Makes the nodes, without bounds, and distributes the entries to their leaves.
    fn split(&mut self, entries: &mut [Entry]) -> Result<(), Error> {
        self.nodes.try_reserve(entries.len() / 2 + 1)?;
        // Ranges still to be split, each with the node whose right child it is (INVALID: none).
        let mut pending = Vec::new();
        fallible::push(&mut pending, (0, entries.len(), INVALID))?;
        while let Some((start, end, parent)) = pending.pop() {
            let index = self.nodes.len() as u32;
            if parent != INVALID {
                self.nodes[parent as usize].right = index;
            }
            fallible::push(
                &mut self.nodes,
                Node { bounds: Bounds::EMPTY, start: start as u32, end: end as u32, right: 0 },
            )?;
            if end - start > LEAF {
                let range = &mut entries[start..end];
                let axis = longest_axis(range);
                let middle = range.len() / 2;
                range.select_nth_unstable_by(middle, |a, b| {
                    a.centre[axis].total_cmp(&b.centre[axis]).then(a.tet.cmp(&b.tet))
                });
                // The left half is popped first and so becomes the next node.
                fallible::push(&mut pending, (start + middle, end, index))?;
                fallible::push(&mut pending, (start, start + middle, INVALID))?;
            }
        }
        Ok(())
    }

    /// Computes the bounds of all nodes, children (which come later) first.
    fn bound(&mut self, mesh: &TetMesh) {
        for index in (0..self.nodes.len()).rev() {
            let node = self.nodes[index];
            let mut bounds = Bounds::EMPTY;
            if node.right != 0 {
                for child in [index + 1, node.right as usize] {
                    bounds.add(&self.nodes[child].bounds.low);
                    bounds.add(&self.nodes[child].bounds.high);
                }
            } else {
                for &tet in &self.order[node.start as usize..node.end as usize] {
                    mesh.tets[tet as usize].iter().for_each(|&c| bounds.add(&mesh.points[c as usize]));
                }
            }
            self.nodes[index].bounds = bounds;
        }
    }

    /// Finds for each point the tetrahedron that contains it, including its boundary, or [`INVALID`] outside; and, if requested, its
    /// barycentric coordinates there: non-negative numbers, one per corner, with sum 1 (all NaN outside). `tets` and `barycentric` must
    /// have one entry per point; further points are ignored.
    pub fn locate(
        &self,
        mesh: &TetMesh,
        points: &[[f64; 3]],
        tets: &mut [u32],
        barycentric: Option<&mut [[f64; 4]]>,
    ) {
        let mut barycentric = barycentric;
        let mut last = INVALID;
        for (index, (point, tet)) in points.iter().zip(tets.iter_mut()).enumerate() {
            let hit = self.find(mesh, point, last);
            *tet = hit.as_ref().map_or(INVALID, |hit| hit.tet);
            if *tet != INVALID {
                last = *tet;
            }
            if let Some(slot) = barycentric.as_deref_mut().and_then(|list| list.get_mut(index)) {
                *slot = hit.map_or([f64::NAN; 4], |hit| self.weights(mesh, point, &hit));
            }
        }
    }

    /// The tetrahedron that contains one point, and its barycentric coordinates there. `last`: where the point before was, or [`INVALID`].
    pub(crate) fn locate_one(&self, mesh: &TetMesh, point: &[f64; 3], last: u32) -> Option<(u32, [f64; 4])> {
        self.find(mesh, point, last).map(|hit| (hit.tet, self.weights(mesh, point, &hit)))
    }

    fn find(&self, mesh: &TetMesh, point: &[f64; 3], last: u32) -> Option<Hit> {
        // Consecutive points often share a tetrahedron; if a point is strictly inside, no other tetrahedron contains it.
        if last != INVALID {
            if let Some(hit) = self.test(mesh, last, point) {
                if hit.signs == [Sign::Positive; 4] {
                    return Some(hit);
                }
            }
        }
        let mut best: Option<Hit> = None;
        // Median splits halve 2³² tetrahedra at most 32 times: two entries per level are enough.
        let mut stack = [0u32; 72];
        let mut depth = usize::from(!self.nodes.is_empty());
        while depth > 0 {
            depth -= 1;
            let index = stack[depth];
            let node = &self.nodes[index as usize];
            if !node.bounds.contains(point) {
                continue;
            }
            if node.right != 0 {
                stack[depth] = node.right;
                stack[depth + 1] = index + 1;
                depth += 2;
                continue;
            }
            for &tet in &self.order[node.start as usize..node.end as usize] {
                if best.as_ref().is_none_or(|best| tet < best.tet) {
                    best = self.test(mesh, tet, point).or(best);
                }
            }
            if best.as_ref().is_some_and(|best| best.signs == [Sign::Positive; 4]) {
                return best;
            }
        }
        best
    }

    fn test(&self, mesh: &TetMesh, tet: u32, point: &[f64; 3]) -> Option<Hit> {
        let corners = mesh.tets[tet as usize].map(|corner| mesh.points[corner as usize]);
        // This rejects most candidates.
        let apart = |axis: usize| {
            let x = corners.map(|corner| corner[axis]);
            x.iter().all(|&x| x < point[axis]) || x.iter().all(|&x| x > point[axis])
        };
        if apart(0) || apart(1) || apart(2) {
            return None;
        }
        let scaled = |point: [f64; 3]| point.map(|x| x * self.scale);
        let (corners, point) = (corners.map(scaled), scaled(*point));
        let mut signs = [Sign::Zero; 4];
        for (sign, [a, b, c]) in signs.iter_mut().zip(FACE_CORNERS) {
            // Seen from inside, the outward face has the opposite orientation.
            *sign = -orient3d(&corners[a], &corners[b], &corners[c], &point);
            if *sign == Sign::Negative {
                return None;
            }
        }
        Some(Hit { tet, signs })
    }

    /// Barycentric coordinates in doubles; the exact signs say which are zero.
    fn weights(&self, mesh: &TetMesh, point: &[f64; 3], hit: &Hit) -> [f64; 4] {
        let corners = mesh.tets[hit.tet as usize].map(|corner| {
            let corner = &mesh.points[corner as usize];
            [0, 1, 2].map(|axis| corner[axis] * self.scale - point[axis] * self.scale)
        });
        let mut weights = [0.0; 4];
        for (corner, [a, b, c]) in FACE_CORNERS.into_iter().enumerate() {
            if hit.signs[corner] == Sign::Positive {
                weights[corner] = determinant(&corners[a], &corners[b], &corners[c]).max(f64::MIN_POSITIVE);
            }
        }
        let sum: f64 = weights.iter().sum();
        if sum == 0.0 {
            // The tetrahedron is flat: its mesh has no valid doubles.
            return [0.25; 4];
        }
        weights.map(|weight| weight / sum)
    }
}

/// The power of two that scales the largest coordinate into [1, 2).
fn scale_of(points: &[[f64; 3]]) -> f64 {
    let largest = points.iter().flatten().fold(0.0f64, |largest, x| largest.max(x.abs()));
    let power = exponent(largest);
    match power {
        // In this range nothing can overflow or lose its last bits.
        -100..=100 => 1.0,
        _ => power_of_two((-power).clamp(-1000, 1000)),
    }
}

/// The axis along which the centres spread most.
fn longest_axis(entries: &[Entry]) -> usize {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for entry in entries {
        for (axis, &x) in entry.centre.iter().enumerate() {
            low[axis] = low[axis].min(x);
            high[axis] = high[axis].max(x);
        }
    }
    let extent = |axis: usize| high[axis] - low[axis];
    (1..3).fold(0, |best, axis| if extent(axis) > extent(best) { axis } else { best })
}

fn determinant(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}
