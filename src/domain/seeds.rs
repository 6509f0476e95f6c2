//! Finds the component in which each seed lies.
//!
//! First a walk (Devillers, Pion & Teillaud 2002, "Walking in a triangulation") from the tetrahedron of the last seed, in the order of
//! a k-d tree (Bentley 1975), so that the next one is near. It ends strictly inside a tetrahedron, outside the hull, or undecided: walks
//! may cycle, since constraints break the Delaunay property, and a seed may lie on a face, edge or vertex. For the remaining seeds, one
//! pass over the tetrahedra queries the tree for the seeds in each one's box: a few comparisons per tetrahedron regardless of the number of
//! seeds. A seed strictly inside a tetrahedron is done and removed from the tree; others wait for all tetrahedra there. Memory is
//! proportional to the number of seeds.
use crate::control::Control;
use crate::domain::Components;
use crate::error::Error;
use crate::fallible;
use crate::kernel::{Mesh, NONE};
use crate::predicates::{in_range, scale, Points, Sign};

/// Where a seed lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Outside the convex hull.
    Outside,
    /// In a component, or on a facet that has it on both sides.
    In(u32),
    /// On a facet between two components.
    OnFacet,
}

/// Seeds in a leaf. Fewer make the tree larger, more make leaves slower; from 4 to 16 there is no measurable difference.
const LEAF: usize = 8;

/// Limit on the steps of a walk. A straight walk through 10^6 tetrahedra takes about 150; more steps only delay the final pass. 500 and
/// 2,000 change nothing on two models.
const MOST_STEPS: u32 = 1000;

struct Node {
    low: [f64; 3],
    high: [f64; 3],
    /// Range of the node's seeds in the order of the tree.
    seeds: [u32; 2],
    /// Number of seeds that are not done.
    waiting: u32,
    /// The right child; 0 in a leaf. The left one is the next node.
    right: u32,
    /// The parent; the root is its own.
    parent: u32,
}

impl Node {
    fn meets(&self, low: &[f64; 3], high: &[f64; 3]) -> bool {
        (0..3).all(|k| self.low[k] <= high[k] && low[k] <= self.high[k])
    }
}

/// A k-d tree of points that are removed one by one.
struct Tree {
    nodes: Vec<Node>,
    /// Indices of the points, ordered so that those of each node form a range.
    order: Vec<u32>,
    /// For each point its leaf; the root once it is removed.
    leaf: Vec<u32>,
    stack: Vec<u32>,
}

impl Tree {
    fn new(points: &[[f64; 3]]) -> Result<Tree, Error> {
        let count = points.len();
        let mut order: Vec<u32> = fallible::collect(0..count as u32)?;
        let mut leaf: Vec<u32> = fallible::filled(0, count)?;
        // Halving ends with more than LEAF / 2 points per leaf. A path down has no more than 64 pending halves.
        let mut nodes: Vec<Node> = fallible::reserved(4 * count / LEAF + 2)?;
        let stack = fallible::reserved(64)?;
        // Ranges that become nodes, with the parent and whether it is a right half; right halves wait.
        let mut pending: Vec<(usize, usize, u32, bool)> = fallible::reserved(64)?;
        fallible::push(&mut pending, (0, count, 0, false))?;
        while let Some((from, to, parent, is_right)) = pending.pop() {
            let node = nodes.len() as u32;
            if is_right {
                nodes[parent as usize].right = node;
            }
            let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
            for &i in &order[from..to] {
                for k in 0..3 {
                    low[k] = low[k].min(points[i as usize][k]);
                    high[k] = high[k].max(points[i as usize][k]);
                }
            }
            let seeds = [from as u32, to as u32];
            fallible::push(
                &mut nodes,
                Node { low, high, seeds, waiting: (to - from) as u32, right: 0, parent },
            )?;
            if to - from <= LEAF {
                order[from..to].iter().for_each(|&i| leaf[i as usize] = node);
                continue;
            }
            // Split into halves by count, so that equal points make no long path.
            let width = |k: usize| high[k] / 2.0 - low[k] / 2.0;
            let axis = (1..3).fold(0, |best, k| if width(k) > width(best) { k } else { best });
            let middle = (to - from) / 2;
            order[from..to].select_nth_unstable_by(middle, |&i, &j| {
                let x = |i: u32| points[i as usize][axis];
                x(i).total_cmp(&x(j)).then(i.cmp(&j))
            });
            fallible::push(&mut pending, (from + middle, to, node, true))?;
            fallible::push(&mut pending, (from, from + middle, node, false))?;
        }
        Ok(Tree { nodes, order, leaf, stack })
    }

    /// Whether all points have been removed.
    fn is_empty(&self) -> bool {
        self.nodes[0].waiting == 0
    }

    /// Sets `found` to the leaves that may contain points in the box.
    fn leaves(&mut self, low: &[f64; 3], high: &[f64; 3], found: &mut Vec<u32>) -> Result<(), Error> {
        found.clear();
        fallible::push(&mut self.stack, 0)?;
        while let Some(n) = self.stack.pop() {
            let node = &self.nodes[n as usize];
            if node.waiting == 0 || !node.meets(low, high) {
                continue;
            }
            if node.right == 0 {
                fallible::push(found, n)?;
            } else {
                fallible::extend(&mut self.stack, [node.right, n + 1])?;
            }
        }
        Ok(())
    }

    fn take_out(&mut self, point: u32) {
        let mut n = std::mem::replace(&mut self.leaf[point as usize], u32::MAX);
        if n == u32::MAX {
            return;
        }
        loop {
            self.nodes[n as usize].waiting -= 1;
            if n == 0 {
                return;
            }
            n = self.nodes[n as usize].parent;
        }
    }
}

/// Finds the component of every seed. The coordinates of the mesh are the caller's times 2^`exponent`. Seeds may have any finite
/// coordinates.
pub(super) fn locate(
    mesh: &Mesh,
    points: &mut Points,
    components: &Components,
    seeds: &[[f64; 3]],
    exponent: i32,
    control: &Control,
) -> Result<Vec<Place>, Error> {
    let mut places = fallible::filled(Place::Outside, seeds.len())?;
    if seeds.is_empty() {
        return Ok(places);
    }
    // Rounded if they are no doubles. Rounding is monotone: what is outside a box afterwards was outside before.
    let scaled: Vec<[f64; 3]> = fallible::collect(seeds.iter().map(|p| p.map(|x| scale(x, exponent))))?;
    let mark = points.len();
    let found =
        Search { mesh, points, components, exponent, seeds, scaled: &scaled, control }.run(&mut places);
    points.truncate(mark);
    found.map(|()| places)
}

struct Search<'a> {
    mesh: &'a Mesh,
    points: &'a mut Points,
    components: &'a Components,
    exponent: i32,
    seeds: &'a [[f64; 3]],
    scaled: &'a [[f64; 3]],
    control: &'a Control<'a>,
}

impl Search<'_> {
    fn run(&mut self, places: &mut [Place]) -> Result<(), Error> {
        let mut tree = Tree::new(self.scaled)?;
        // The seeds' vertices. An array of plain numbers: optimizers move the comparison of an enum's contents before that of its kind, which
        // memory checkers report.
        let mut vertices = fallible::filled(NONE, self.seeds.len())?;
        let order = fallible::copied(&tree.order)?;
        let (low, high) = self.whole_box();
        let mut from = (0..self.mesh.slot_count() as u32).find(|&t| self.is_solid(t));
        for seed in order {
            let Some(start) = from else { break };
            self.control.look()?;
            // Only a seed inside the box of the mesh becomes a vertex, since the bounds of the filters hold there.
            let at = self.scaled[seed as usize];
            if (0..3).any(|k| at[k] < low[k] || at[k] > high[k]) {
                tree.take_out(seed);
                continue;
            }
            let p = self.vertex(seed)?;
            if p == NONE {
                continue;
            }
            vertices[seed as usize] = p;
            let (end, place) = self.walk(start, p);
            from = Some(end);
            if let Some(place) = place {
                places[seed as usize] = place;
                tree.take_out(seed);
            }
        }
        let mut leaves = Vec::new();
        for t in 0..self.mesh.slot_count() as u32 {
            if tree.is_empty() {
                break;
            }
            if !self.is_solid(t) {
                continue;
            }
            self.control.step()?;
            let (low, high) = self.box_of(t);
            tree.leaves(&low, &high, &mut leaves)?;
            for &leaf in &leaves {
                let [from, to] = tree.nodes[leaf as usize].seeds;
                for k in from..to {
                    let seed = tree.order[k as usize];
                    let p = self.scaled[seed as usize];
                    let outside = (0..3).any(|k| p[k] < low[k] || p[k] > high[k]);
                    if outside || tree.leaf[seed as usize] == u32::MAX {
                        continue;
                    }
                    if self.visit(t, seed, vertices[seed as usize], &mut places[seed as usize]) {
                        tree.take_out(seed);
                    }
                }
            }
        }
        Ok(())
    }

    /// The box of all points; Steiner points are within an ulp of their doubles.
    fn whole_box(&self) -> ([f64; 3], [f64; 3]) {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in self.points.coordinates() {
            for k in 0..3 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        (low.map(f64::next_down), high.map(f64::next_up))
    }

    fn is_solid(&self, t: u32) -> bool {
        self.mesh.is_live(t) && !self.mesh.is_ghost(t)
    }

    /// Walks to a vertex of the store that is no vertex of the mesh, always through a face with the vertex strictly beyond it. Returns the
    /// last tetrahedron, and the place if it is decided.
    fn walk(&self, start: u32, p: u32) -> (u32, Option<Place>) {
        let (mut t, mut entered) = (start, u32::MAX);
        for _ in 0..MOST_STEPS {
            let mut strictly = true;
            let mut next = None;
            for code in (4 * t..4 * t + 4).filter(|&code| code != entered) {
                let [x, y, z] = self.mesh.face(code);
                match self.points.orient3d(p, x, y, z) {
                    Sign::Negative => {
                        next = Some(self.mesh.across(code));
                        break;
                    }
                    Sign::Zero => strictly = false,
                    Sign::Positive => {}
                }
            }
            match next {
                None if strictly => return (t, Some(Place::In(self.components.of[t as usize]))),
                None => return (t, None),
                // The hull is convex, so strictly beyond one of its faces is outside.
                Some(code) if self.mesh.is_ghost(code >> 2) => return (t, Some(Place::Outside)),
                Some(code) => (t, entered) = (code >> 2, code),
            }
        }
        (t, None)
    }

    /// The box of a tetrahedron; Steiner points are within an ulp of their doubles.
    fn box_of(&self, t: u32) -> ([f64; 3], [f64; 3]) {
        let corners = self.mesh.verts(t).map(|v| self.points.xyz(v));
        let low = |k: usize| corners.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min).next_down();
        let high = |k: usize| corners.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max).next_up();
        ([0, 1, 2].map(low), [0, 1, 2].map(high))
    }

    /// A vertex of the store where the seed is; [`NONE`] if that is outside the exact range.
    fn vertex(&mut self, seed: u32) -> Result<u32, Error> {
        let (given, p) = (self.seeds[seed as usize], self.scaled[seed as usize]);
        let exact = p.map(|x| scale(x, -self.exponent)) == given;
        if exact && p.iter().all(|&x| in_range(x)) {
            return self.points.push(p);
        }
        Ok(NONE)
    }

    /// Tests whether the closed tetrahedron contains the seed; returns true if the seed is done.
    fn visit(&self, t: u32, seed: u32, vertex: u32, place: &mut Place) -> bool {
        let own = self.components.of[t as usize];
        let mut strictly = true;
        let mut on_facet = false;
        for code in 4 * t..4 * t + 4 {
            let [x, y, z] = self.mesh.face(code);
            let sign = match vertex {
                NONE => self.points.orient3d_of(&self.seeds[seed as usize], self.exponent, [x, y, z]),
                p => self.points.orient3d(p, x, y, z),
            };
            match sign {
                Sign::Negative => return false,
                Sign::Zero => {
                    strictly = false;
                    let beyond = self.components.of[(self.mesh.across(code) >> 2) as usize];
                    on_facet |= self.mesh.is_subface(code) && beyond != own;
                }
                Sign::Positive => {}
            }
        }
        match *place {
            Place::In(other) if other != own => *place = Place::OnFacet,
            Place::Outside => *place = Place::In(own),
            _ => {}
        }
        if on_facet {
            *place = Place::OnFacet;
        }
        strictly || *place == Place::OnFacet
    }
}
