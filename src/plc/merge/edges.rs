//! The edges of a surface's triangles during flipping, and the users of each.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::patch::FixedEdge;
use crate::INVALID;
use rustc_hash::FxHashMap;

/// The users of an edge.
#[derive(Clone, Copy, Debug)]
struct Users {
    /// Two of the triangles, or `INVALID`.
    triangles: [u32; 2],
    /// How many triangles use the edge.
    count: u32,
    /// Whether it constrains by itself.
    fixed: bool,
    /// The flip that made it, or `INVALID` if it is the input's.
    maker: u32,
}

/// All edges, by their ends. Only looked up, never iterated, so the order of the table decides nothing.
pub(super) struct Edges {
    users: FxHashMap<[u32; 2], Users>,
    /// The last flip that removed an edge, if any.
    removers: FxHashMap<[u32; 2], u32>,
}

fn key([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The edges of a triangle.
pub(super) fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

impl Edges {
    pub(super) fn new(
        triangles: &[[u32; 3]],
        fixed: &[FixedEdge],
        control: &Control,
    ) -> Result<Edges, Error> {
        let mut users: FxHashMap<[u32; 2], Users> = FxHashMap::default();
        users.try_reserve(triangles.len() / 2 * 3 + fixed.len() + 16)?;
        let mut edges = Edges { users, removers: FxHashMap::default() };
        for (t, &corners) in (0..).zip(triangles) {
            control.step()?;
            for side in sides(corners) {
                edges.add(side, t)?;
            }
        }
        for edge in fixed {
            control.step()?;
            edges.entry(edge.ends)?.fixed = true;
        }
        Ok(edges)
    }

    fn entry(&mut self, ends: [u32; 2]) -> Result<&mut Users, Error> {
        let none = Users { triangles: [INVALID; 2], count: 0, fixed: false, maker: INVALID };
        Ok(fallible::entry(&mut self.users, key(ends))?.or_insert(none))
    }

    fn add(&mut self, ends: [u32; 2], triangle: u32) -> Result<(), Error> {
        let users = self.entry(ends)?;
        if let Some(slot) = users.triangles.get_mut(users.count as usize) {
            *slot = triangle;
        }
        users.count += 1;
        Ok(())
    }

    /// Fixes an edge, so that it is never flipped.
    pub(super) fn fix(&mut self, ends: [u32; 2]) {
        if let Some(users) = self.users.get_mut(&key(ends)) {
            users.fixed = true;
        }
    }

    /// Whether an element has this edge.
    pub(super) fn contains(&self, ends: [u32; 2]) -> bool {
        self.users.contains_key(&key(ends))
    }

    /// Whether a triangle has this edge.
    pub(super) fn in_triangle(&self, ends: [u32; 2]) -> bool {
        self.users.get(&key(ends)).is_some_and(|users| users.count > 0)
    }

    /// The two triangles of an edge that nothing else uses; `None` for other edges.
    pub(super) fn pair(&self, ends: [u32; 2]) -> Option<[u32; 2]> {
        let users = self.users.get(&key(ends))?;
        (users.count == 2 && !users.fixed).then_some(users.triangles)
    }

    /// The flip that made an edge; `None` for the input's edges.
    pub(super) fn maker(&self, ends: [u32; 2]) -> Option<u32> {
        self.users.get(&key(ends)).map(|users| users.maker).filter(|&maker| maker != INVALID)
    }

    /// The last flip that removed an edge, if any.
    pub(super) fn remover(&self, ends: [u32; 2]) -> Option<u32> {
        self.removers.get(&key(ends)).copied()
    }

    /// Records that `old`, between triangles `t` and `u`, became `new` by flip `number`, and that `given` went from `t` to `u` and `taken`
    /// from `u` to `t`. `maker` is recorded as the maker of `new`.
    pub(super) fn flip(
        &mut self,
        [old, new]: [[u32; 2]; 2],
        [t, u]: [u32; 2],
        [given, taken]: [[u32; 2]; 2],
        maker: u32,
        number: u32,
    ) -> Result<(), Error> {
        self.users.remove(&key(old));
        fallible::insert(&mut self.removers, key(old), number)?;
        self.add(new, t)?;
        self.add(new, u)?;
        self.entry(new)?.maker = maker;
        for (ends, from, to) in [(given, t, u), (taken, u, t)] {
            let users = self.entry(ends)?;
            if let Some(slot) = users.triangles.iter_mut().find(|slot| **slot == from) {
                *slot = to;
            }
        }
        Ok(())
    }
}
