//! A bounding volume hierarchy over axis-parallel boxes, which finds all pairs of boxes that meet.
//!
//! Boxes are sorted along a Morton curve and cut into leaves of equal size; the hierarchy above is a complete binary tree in
//! an array (node `i` has children `2i + 1` and `2i + 2`), so neither building nor traversing recurses (linear BVH:
//! Lauterbach et al. 2009). Pairs come from a traversal of the tree against itself.
//!
//! Boxes that belong to fans come first, fan by fan; their pairs are also separated by directions (see [`fans`](crate::plc::intersect::fans)).
//!
//! Boxes are in single precision, rounded so that no pair that meets is missed (see [`Frame`]).
use crate::control::Control;
use crate::elementary::quotient;
use crate::error::Error;
use crate::fallible;
use crate::plc::intersect::fans::{Fans, Member};
use crate::plc::radix::sort_keyed;
use std::ops::Range;

/// Turns of a traversal that make a step.
const TURNS_PER_STEP: u32 = 32;

/// Boxes per leaf.
const LEAF: usize = 8;

/// An axis-parallel box in the coordinates of a [`Frame`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    low: [f32; 3],
    high: [f32; 3],
}

/// Maps coordinates to single precision, the common box to about the unit cube. Each step is monotone even when rounded: boxes that are
/// apart here are apart in space, and boxes that touch in space meet here.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    half_low: [f64; 3],
    scale: f64,
}

impl Frame {
    /// The frame for the box from `low` with edges of up to `extent`.
    pub(super) const fn new(low: [f64; 3], extent: f64) -> Frame {
        // Halves, so that no finite extent overflows.
        Frame { half_low: [0.5 * low[0], 0.5 * low[1], 0.5 * low[2]], scale: 2.0 / extent }
    }

    /// The frame for all given points.
    pub(super) fn of<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> Frame {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in points {
            for k in 0..3 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        // Halves, so that no finite extent overflows.
        let low = low.map(|x| 0.5 * x);
        let extent = (0..3).map(|k| 0.5 * high[k] - low[k]).fold(0.0, f64::max);
        Frame { half_low: low, scale: quotient(1.0, extent).unwrap_or(f64::MAX) }
    }

    /// The smallest box around points.
    pub(super) fn bounds<'a>(&self, points: impl Iterator<Item = &'a [f64; 3]>) -> Bounds {
        points.fold(Bounds::EMPTY, |bounds, p| {
            let q = std::array::from_fn(|k| ((0.5 * p[k] - self.half_low[k]) * self.scale) as f32);
            bounds.union(&Bounds { low: q, high: q })
        })
    }
}

impl Bounds {
    pub(super) const EMPTY: Bounds = Bounds { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    #[inline(always)]
    pub(super) fn union(&self, other: &Bounds) -> Bounds {
        // Plain comparisons: there are no NaNs, and these become single instructions.
        let min = |a: f32, b: f32| if a < b { a } else { b };
        let max = |a: f32, b: f32| if a > b { a } else { b };
        Bounds {
            low: std::array::from_fn(|k| min(self.low[k], other.low[k])),
            high: std::array::from_fn(|k| max(self.high[k], other.high[k])),
        }
    }

    /// The lower and the upper corner.
    pub(super) fn corners(&self) -> ([f64; 3], [f64; 3]) {
        (self.low.map(f64::from), self.high.map(f64::from))
    }

    /// Whether two closed boxes have a point in common.
    #[inline(always)]
    pub(super) fn meets(&self, other: &Bounds) -> bool {
        // Without short circuits: six comparisons are cheaper than mispredicted branches.
        (self.low[0] <= other.high[0])
            & (other.low[0] <= self.high[0])
            & (self.low[1] <= other.high[1])
            & (other.low[1] <= self.high[1])
            & (self.low[2] <= other.high[2])
            & (other.low[2] <= self.high[2])
    }
}

/// The hierarchy.
pub(super) struct BoxTree {
    /// Input index of each box, in the order of the curve.
    order: Vec<u32>,
    /// The boxes in that order.
    bounds: Vec<Bounds>,
    /// Boxes of the tree's nodes: `leaves − 1` inner nodes, then `leaves` (a power of two) leaves.
    nodes: Vec<Bounds>,
    /// Number of leaves.
    leaves: usize,
    /// The boxes that belong to fans: the first ones.
    members: Vec<Member>,
    /// The fan members of the nodes; empty if there are no fans.
    node_members: Vec<Member>,
}

impl BoxTree {
    /// Builds the tree over `bounds`, some of which belong to fans.
    pub(super) fn new(bounds: &[Bounds], fans: Fans, control: &Control) -> Result<BoxTree, Error> {
        control.look()?;
        let mut keyed =
            fallible::collect((0u32..).zip(bounds).map(|(i, b)| (AFTER_FANS | morton_code(b), i)))?;
        (0..).zip(&fans.elements).for_each(|(k, &i)| keyed[i as usize].0 = k);
        sort_keyed(&mut keyed, control)?;
        control.look()?;
        let (mut order, mut sorted, mut nodes) = (Vec::new(), Vec::new(), Vec::new());
        order.try_reserve_exact(bounds.len())?;
        sorted.try_reserve_exact(bounds.len())?;
        fallible::extend(&mut order, keyed.iter().map(|&(_, i)| i))?;
        fallible::extend(&mut sorted, order.iter().map(|&i| bounds[i as usize]))?;
        control.look()?;
        let leaves = bounds.len().div_ceil(LEAF).next_power_of_two();
        nodes.try_reserve_exact(2 * leaves)?;
        fallible::resize(&mut nodes, 2 * leaves - 1, Bounds::EMPTY)?;
        for (leaf, chunk) in sorted.chunks(LEAF).enumerate() {
            nodes[leaves - 1 + leaf] = chunk.iter().fold(Bounds::EMPTY, |all, b| all.union(b));
        }
        for i in (0..leaves - 1).rev() {
            nodes[i] = nodes[2 * i + 1].union(&nodes[2 * i + 2]);
        }
        let node_members = node_members(&fans.members, leaves)?;
        Ok(BoxTree { order, bounds: sorted, nodes, leaves, members: fans.members, node_members })
    }

    /// Whether two elements, given by their places, or any elements of two nodes, belong to fans and have at most their apex in common.
    #[inline]
    fn apart(members: &[Member], x: usize, y: usize) -> bool {
        x.max(y) < members.len() && members[x].apart(&members[y])
    }

    /// Whether two elements, given by their places, may meet.
    #[inline(always)]
    fn may_meet(&self, i: usize, j: usize) -> bool {
        self.bounds[i].meets(&self.bounds[j]) && !BoxTree::apart(&self.members, i, j)
    }

    /// The input index of each box in the order of the curve.
    pub(super) fn order(&self) -> &[u32] {
        &self.order
    }

    /// Sets new bounds for the box at a place in the curve's order.
    pub(super) fn replace(&mut self, place: usize, bounds: Bounds) {
        self.bounds[place] = bounds;
        let leaf = place / LEAF;
        let range = self.leaf(leaf);
        let mut node = self.leaves - 1 + leaf;
        self.nodes[node] = self.bounds[range].iter().fold(Bounds::EMPTY, |all, b| all.union(b));
        while node > 0 {
            node = (node - 1) / 2;
            let both = self.nodes[2 * node + 1].union(&self.nodes[2 * node + 2]);
            if both == self.nodes[node] {
                break;
            }
            self.nodes[node] = both;
        }
    }

    /// Whether `hit` is true for a box that meets `bounds`, given by its place in the curve's order. `stack` is working storage.
    pub(super) fn any(
        &self,
        bounds: &Bounds,
        stack: &mut Vec<usize>,
        mut hit: impl FnMut(usize) -> Result<bool, Error>,
    ) -> Result<bool, Error> {
        let first_leaf = self.leaves - 1;
        stack.clear();
        fallible::push(stack, 0)?;
        while let Some(node) = stack.pop() {
            if !self.nodes[node].meets(bounds) {
                continue;
            }
            if node < first_leaf {
                fallible::extend(stack, [2 * node + 2, 2 * node + 1])?;
                continue;
            }
            for place in self.leaf(node - first_leaf) {
                if self.bounds[place].meets(bounds) && hit(place)? {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Calls `visit(i, j, done)` once for each pair of boxes that meet, given by their places in the curve's order, until it fails;
    /// `done` grows from 0 to 1. Pairs of fans that are known to have at most their apex in common are left out.
    pub(super) fn for_each_pair(
        &self,
        control: &Control,
        mut visit: impl FnMut(usize, usize, f64) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let first_leaf = self.leaves - 1;
        let (mut finished, mut turns) = (0usize, 0u32);
        let mut stack: Vec<(usize, usize)> = Vec::new();
        fallible::push(&mut stack, (0, 0))?;
        while let Some((x, y)) = stack.pop() {
            turns = turns.wrapping_add(1);
            if turns % TURNS_PER_STEP == 0 {
                control.step()?;
            }
            if x == y {
                if x >= first_leaf {
                    finished += 1;
                    self.pairs_in_leaf(x - first_leaf, finished as f64 / self.leaves as f64, &mut visit)?;
                } else {
                    // The pair of different children is done between the two, near both in memory.
                    fallible::extend(
                        &mut stack,
                        [(2 * x + 2, 2 * x + 2), (2 * x + 1, 2 * x + 2), (2 * x + 1, 2 * x + 1)],
                    )?;
                }
            } else if self.nodes[x].meets(&self.nodes[y]) && !BoxTree::apart(&self.node_members, x, y) {
                if x >= first_leaf {
                    let done = finished as f64 / self.leaves as f64;
                    self.pairs_of_leaves(x - first_leaf, y - first_leaf, done, &mut visit)?;
                } else {
                    // x and y are always on one level: the tree is complete.
                    let (a, b) = (2 * x + 1, 2 * y + 1);
                    fallible::extend(&mut stack, [(a, b), (a, b + 1), (a + 1, b), (a + 1, b + 1)])?;
                }
            }
        }
        Ok(())
    }

    fn leaf(&self, leaf: usize) -> Range<usize> {
        let start = (leaf * LEAF).min(self.order.len());
        start..(start + LEAF).min(self.order.len())
    }

    fn pairs_in_leaf(
        &self,
        leaf: usize,
        done: f64,
        visit: &mut impl FnMut(usize, usize, f64) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let Range { start, end } = self.leaf(leaf);
        for i in start..end {
            for j in i + 1..end {
                if self.may_meet(i, j) {
                    visit(i, j, done)?;
                }
            }
        }
        Ok(())
    }

    fn pairs_of_leaves(
        &self,
        x: usize,
        y: usize,
        done: f64,
        visit: &mut impl FnMut(usize, usize, f64) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let other = &self.nodes[self.leaves - 1 + y];
        for i in self.leaf(x) {
            let bounds = &self.bounds[i];
            if !bounds.meets(other) {
                continue;
            }
            for j in self.leaf(y) {
                if self.may_meet(i, j) {
                    visit(i, j, done)?;
                }
            }
        }
        Ok(())
    }
}

/// Keys of boxes that belong to no fan have this bit, which Morton codes leave free.
const AFTER_FANS: u64 = 1 << 63;

/// The fan members of a tree's nodes, empty if there are no fans; the first boxes are `members`.
fn node_members(members: &[Member], leaves: usize) -> Result<Vec<Member>, Error> {
    let mut nodes = Vec::new();
    if members.is_empty() {
        return Ok(nodes);
    }
    nodes.try_reserve_exact(2 * leaves - 1)?;
    fallible::resize(&mut nodes, 2 * leaves - 1, Member::MIXED)?;
    // A leaf only partly filled by members is mixed.
    for (leaf, chunk) in members.chunks_exact(LEAF).enumerate() {
        nodes[leaves - 1 + leaf] = chunk[1..].iter().fold(chunk[0], |all, m| all.union(m));
    }
    for i in (0..leaves - 1).rev() {
        nodes[i] = nodes[2 * i + 1].union(&nodes[2 * i + 2]);
    }
    Ok(nodes)
}

/// The position of a box's centre on a Morton curve of 21 bits per axis. Any value would be valid: it only affects speed.
pub(super) fn morton_code(bounds: &Bounds) -> u64 {
    (0..3).fold(0, |code, k| {
        let centre = 0.5 * (bounds.low[k] + bounds.high[k]);
        // The cast saturates.
        let cell = (centre * 2_097_152.0) as u64;
        code | spread_bits(cell.min(2_097_151)) << k
    })
}

/// Moves bit `i` to bit `3i`, for 21 bits.
fn spread_bits(mut bits: u64) -> u64 {
    bits = (bits | bits << 32) & 0x001f_0000_0000_ffff;
    bits = (bits | bits << 16) & 0x001f_0000_ff00_00ff;
    bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
    bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}
