//! Chains: the mesh edges that an input edge consists of.
//!
//! An input edge is subdivided by its Steiner points (known by parents and parameter) and by input vertices that lie exactly on
//! it. The former are looked up in order. If two consecutive ones are not joined by a mesh edge, the chain is walked in the mesh: from a
//! vertex on the input edge to the nearest neighbour on it. There is at most one if tetrahedra are positive at the exact positions; a
//! replaced tetrahedron need not be, and may have an edge that skips a point.
use crate::check::context::Context;
use crate::error::Error;
use crate::fallible;

/// The Steiner points of every input edge, ordered along it.
pub(super) struct Chains<'a, 'b> {
    context: &'a Context<'b>,
    /// Sorted by edge, and along each edge from its smaller end.
    steiner: Vec<OnEdge>,
}

/// A Steiner point on an input edge.
struct OnEdge {
    /// The ends, which are representatives; the smaller first.
    ends: [u32; 2],
    vertex: u32,
}

impl<'a, 'b> Chains<'a, 'b> {
    pub(super) fn new(context: &'a Context<'b>) -> Result<Self, Error> {
        let inputs = context.plc.points.len();
        let mut steiner = fallible::reserved(context.mesh.steiner.len())?;
        for (i, s) in context.mesh.steiner.iter().enumerate().filter(|(_, s)| s.is_on_edge()) {
            let mut ends = s.ends.map(|v| context.alias(v));
            ends.sort_unstable();
            fallible::push(&mut steiner, OnEdge { ends, vertex: (inputs + i) as u32 })?;
        }
        let along = |x: &OnEdge, y: &OnEdge| context.geometry.compare_along(x.ends, x.vertex, y.vertex);
        steiner.sort_unstable_by(|x, y| {
            x.ends.cmp(&y.ends).then_with(|| along(x, y)).then(x.vertex.cmp(&y.vertex))
        });
        Ok(Chains { context, steiner })
    }

    /// Steiner points of the edge `ab` (representatives, `a < b`), from `a` to `b`.
    fn of_edge(&self, a: u32, b: u32) -> impl Iterator<Item = u32> + '_ {
        let from = self.steiner.partition_point(|s| s.ends < [a, b]);
        self.steiner[from..].iter().take_while(move |s| s.ends == [a, b]).map(|s| s.vertex)
    }

    /// Sets `chain` to the vertices from `a` to `b` (representatives) along mesh edges; returns false if there is no such chain.
    pub(super) fn find(&self, a: u32, b: u32, chain: &mut Vec<u32>) -> Result<bool, Error> {
        chain.clear();
        let (low, high) = (a.min(b), a.max(b));
        fallible::push(chain, low)?;
        let mut joined = true;
        for s in self.of_edge(low, high) {
            joined &= self.context.has_edge(chain[chain.len() - 1], s);
            fallible::push(chain, s)?;
        }
        joined &= self.context.has_edge(chain[chain.len() - 1], high);
        if joined {
            fallible::push(chain, high)?;
        } else {
            chain.truncate(1);
            if !self.walk(high, chain)? {
                return Ok(false);
            }
        }
        if a != low {
            chain.reverse();
        }
        Ok(true)
    }

    /// Extends `chain` (of one vertex) to `end` along mesh edges on the line; each step gets nearer to `end`. Returns false if there is no
    /// such chain.
    fn walk(&self, end: u32, chain: &mut Vec<u32>) -> Result<bool, Error> {
        let context = self.context;
        let mut current = chain[0];
        while current != end {
            let mut next = None;
            for v in context.neighbors(current) {
                let to = next.unwrap_or(end);
                if v != to && context.geometry.strictly_between(v, current, to) {
                    next = Some(v);
                }
            }
            if next.is_none() && context.has_edge(current, end) {
                next = Some(end);
            }
            match next {
                Some(v) => current = v,
                None => return Ok(false),
            }
            fallible::push(chain, current)?;
        }
        Ok(true)
    }
}
