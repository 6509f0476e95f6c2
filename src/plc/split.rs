//! Making the facets' triangles conform to vertices that lie in them or on their edges, and to segments that lie in them.
//!
//! A triangle with vertices inside it or on its edges is retriangulated like a facet; all triangles at an edge see the same vertices on it,
//! so they stay conforming. If a segment crosses the flat edge between two triangles, both are retriangulated as one region, without that
//! edge.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::intersect::Intersections;
use crate::plc::patch::{are_flat, FixedEdge, Patches};
use crate::plc::polygon::{project, Role, Triangulator};
use crate::plc::surface::Surface;
use crate::plc::Interior;
use crate::predicates::{orient2d, Sign};

/// A segment that crosses an edge that must stay: the index of the segment among the fixed edges, and a triangle at the edge.
pub type Crossing = (u32, u32);

/// Splits fixed edges and triangles at the vertices found on them. `may_join` says whether the edge between triangles of two exactly
/// coplanar facets may be removed. If segments cross edges that may not, these segments are returned and nothing is split.
pub fn split(
    surface: &mut Surface,
    fixed: &mut Vec<FixedEdge>,
    found: &Intersections,
    may_join: impl Fn(u32, u32) -> bool,
    control: &Control,
) -> Result<Vec<Crossing>, Error> {
    let pieces = Pieces::new(&surface.points, fixed, &found.vertex_on_segment, control)?;
    if !found.vertex_on_edge.is_empty()
        || !found.vertex_in_triangle.is_empty()
        || !found.segment_in_facet.is_empty()
    {
        let mut groups = Groups::new(surface.triangles.len())?;
        let crossings = groups.join_crossed(surface, fixed, found, may_join, control)?;
        if !crossings.is_empty() {
            return Ok(crossings);
        }
        groups.collect(surface, found, control)?;
        Splitter::new(surface, found, &groups, &pieces, control)?.run()?;
    }
    *fixed = pieces.list;
    Ok(Vec::new())
}

/// The pieces of all fixed edges.
struct Pieces {
    list: Vec<FixedEdge>,
    /// Where the pieces of each fixed edge begin.
    begin: Vec<u32>,
}

impl Pieces {
    fn new(
        points: &[[f64; 3]],
        fixed: &[FixedEdge],
        inside: &[(u32, u32)],
        control: &Control,
    ) -> Result<Self, Error> {
        let mut pieces = Pieces { list: Vec::new(), begin: Vec::new() };
        pieces.list.try_reserve_exact(fixed.len() + inside.len())?;
        pieces.begin.try_reserve_exact(fixed.len() + 1)?;
        let mut on: Vec<u32> = Vec::new();
        let mut rest = inside;
        for (i, &FixedEdge { ends: [a, b], parent }) in fixed.iter().enumerate() {
            control.step()?;
            let (mine, others) = rest.split_at(rest.iter().take_while(|s| s.0 == i as u32).count());
            rest = others;
            on.clear();
            fallible::extend(&mut on, mine.iter().map(|s| s.1))?;
            sort_along(points, a, b, &mut on);
            fallible::push(&mut pieces.begin, pieces.list.len() as u32)?;
            let mut from = a;
            for &to in on.iter().chain([&b]) {
                fallible::push(&mut pieces.list, FixedEdge { ends: [from, to], parent })?;
                from = to;
            }
        }
        fallible::push(&mut pieces.begin, pieces.list.len() as u32)?;
        Ok(pieces)
    }

    fn of(&self, edge: u32) -> &[FixedEdge] {
        &self.list[self.begin[edge as usize] as usize..self.begin[edge as usize + 1] as usize]
    }
}

/// Sorts points on the line through `a` and `b` in that direction, exactly: by a coordinate in which the ends differ.
fn sort_along(points: &[[f64; 3]], a: u32, b: u32, on: &mut [u32]) {
    let (p, q) = (points[a as usize], points[b as usize]);
    let Some(k) = (0..3).find(|&k| p[k] != q[k]) else { return };
    on.sort_unstable_by(|&u, &v| {
        let order = points[u as usize][k].total_cmp(&points[v as usize][k]);
        if p[k] < q[k] {
            order
        } else {
            order.reverse()
        }
    });
}

/// Which triangles are retriangulated, and which of them together.
struct Groups {
    sets: Patches,
    /// Edges that segments cross, sorted.
    crossed: Vec<[u32; 2]>,
    /// (first triangle of the group, triangle), sorted.
    members: Vec<(u32, u32)>,
}

impl Groups {
    fn new(count: usize) -> Result<Self, Error> {
        Ok(Groups { sets: Patches::new(count)?, crossed: Vec::new(), members: Vec::new() })
    }

    /// Joins triangles across edges that a segment crosses.
    fn join_crossed(
        &mut self,
        surface: &Surface,
        fixed: &[FixedEdge],
        found: &Intersections,
        may_join: impl Fn(u32, u32) -> bool,
        control: &Control,
    ) -> Result<Vec<Crossing>, Error> {
        let mut crossings = Vec::new();
        let mut edges: Vec<([u32; 2], u32)> = Vec::new();
        for run in found.segment_in_facet.chunk_by(|x, y| x.0 == y.0) {
            let segment = fixed[run[0].0 as usize].ends;
            edges.clear();
            fallible::extend(
                &mut edges,
                run.iter().flat_map(|&(_, t)| sides(surface.triangles[t as usize]).map(|e| (sorted(e), t))),
            )?;
            control.sort(&mut edges)?;
            for pair in edges.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
                control.step()?;
                let ([(edge, t), (_, u)], points) = ([pair[0], pair[1]], &surface.points);
                let apex = |t: u32| {
                    surface.triangles[t as usize].into_iter().find(|v| !edge.contains(v)).unwrap_or(edge[0])
                };
                if !are_flat(points, edge, apex(t), apex(u)) || !cross(points, edge, segment, apex(t)) {
                    continue;
                }
                if may_join(surface.triangle_facet[t as usize], surface.triangle_facet[u as usize]) {
                    self.sets.join(t, u);
                    fallible::push(&mut self.crossed, edge)?;
                } else if !found.meet_in_vertex(run[0].0, edge) {
                    fallible::push(&mut crossings, (run[0].0, t))?;
                }
            }
        }
        self.crossed.sort_unstable();
        self.crossed.dedup();
        Ok(crossings)
    }

    /// Lists the triangles of all groups that change.
    fn collect(&mut self, surface: &Surface, found: &Intersections, control: &Control) -> Result<(), Error> {
        let mut changed: Vec<bool> = fallible::filled(false, surface.triangles.len())?;
        for &(_, t) in &found.segment_in_facet {
            changed[self.sets.find(t) as usize] = true;
        }
        for &(t, _) in &found.vertex_in_triangle {
            changed[self.sets.find(t) as usize] = true;
        }
        let mut at_edge: Vec<bool> = fallible::filled(false, surface.points.len())?;
        found.vertex_on_edge.iter().for_each(|(edge, _)| at_edge[edge[0] as usize] = true);
        for (t, &corners) in surface.triangles.iter().enumerate() {
            control.step()?;
            let hit = |e: [u32; 2]| at_edge[sorted(e)[0] as usize] && !on_edge(found, e).is_empty();
            if sides(corners).into_iter().any(hit) {
                changed[self.sets.find(t as u32) as usize] = true;
            }
        }
        control.look()?;
        for t in 0..surface.triangles.len() as u32 {
            let root = self.sets.find(t);
            if changed[root as usize] {
                fallible::push(&mut self.members, (root, t))?;
            }
        }
        control.sort(&mut self.members)
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// The vertices found on an edge of triangles.
fn on_edge(found: &Intersections, edge: [u32; 2]) -> &[([u32; 2], u32)] {
    let edge = sorted(edge);
    let begin = found.vertex_on_edge.partition_point(|x| x.0 < edge);
    let rest = &found.vertex_on_edge[begin..];
    &rest[..rest.partition_point(|x| x.0 == edge)]
}

/// The part of a sorted list whose key is `key`.
fn of_key(list: &[(u32, u32)], key: u32) -> &[(u32, u32)] {
    let rest = &list[list.partition_point(|x| x.0 < key)..];
    &rest[..rest.partition_point(|x| x.0 == key)]
}

/// An axis along which three points do not project onto a line, and the turn they make.
fn axis_of(points: &[[f64; 3]], [a, b, c]: [u32; 3]) -> (usize, Sign) {
    (0..3)
        .map(|axis| (axis, turn(points, axis, a, b, c)))
        .find(|x| x.1 != Sign::Zero)
        .unwrap_or((0, Sign::Zero))
}

fn turn(points: &[[f64; 3]], axis: usize, a: u32, b: u32, c: u32) -> Sign {
    let at = |v: u32| project(&points[v as usize], axis);
    orient2d(at(a), at(b), at(c))
}

/// Whether an edge and a segment in the plane of the edge and `apex` cross at an inner point of both.
fn cross(points: &[[f64; 3]], [a, b]: [u32; 2], [p, q]: [u32; 2], apex: u32) -> bool {
    let (axis, _) = axis_of(points, [a, b, apex]);
    let opposite = |a, b, p, q| {
        let side = turn(points, axis, a, b, p);
        side != Sign::Zero && turn(points, axis, a, b, q) == -side
    };
    opposite(a, b, p, q) && opposite(p, q, a, b)
}

/// Retriangulates the groups.
struct Splitter<'a> {
    surface: &'a mut Surface,
    found: &'a Intersections,
    groups: &'a Groups,
    pieces: &'a Pieces,
    /// (triangle, segment), sorted.
    segments: Vec<(u32, u32)>,
    triangulator: Triangulator,
    is_vertex: Vec<bool>,
    /// Ends of all pieces, sorted; filled only if edges are crossed.
    piece_ends: Vec<[u32; 2]>,
    control: &'a Control<'a>,
}

impl<'a> Splitter<'a> {
    fn new(
        surface: &'a mut Surface,
        found: &'a Intersections,
        groups: &'a Groups,
        pieces: &'a Pieces,
        control: &'a Control,
    ) -> Result<Self, Error> {
        let triangulator = Triangulator::new(surface.points.len())?;
        let mut segments: Vec<(u32, u32)> =
            fallible::collect(found.segment_in_facet.iter().map(|&(s, t)| (t, s)))?;
        control.sort(&mut segments)?;
        let is_vertex = fallible::filled(false, surface.points.len())?;
        let mut piece_ends = Vec::new();
        if !groups.crossed.is_empty() {
            piece_ends.try_reserve_exact(pieces.list.len())?;
            fallible::extend(&mut piece_ends, pieces.list.iter().map(|piece| sorted(piece.ends)))?;
            control.sort(&mut piece_ends)?;
        }
        Ok(Splitter {
            surface,
            found,
            groups,
            pieces,
            segments,
            triangulator,
            is_vertex,
            piece_ends,
            control,
        })
    }

    fn run(mut self) -> Result<(), Error> {
        let mut in_triangle: Vec<(u32, u32)> = fallible::copied(&self.found.vertex_in_triangle)?;
        self.control.sort(&mut in_triangle)?;
        for group in self.groups.members.chunk_by(|x, y| x.0 == y.0) {
            self.gather(group, &in_triangle)?;
            let interior = Interior::FirstMinusOthers;
            let result = self.triangulator.triangulate(&self.surface.points, interior, &[], self.control)?;
            if result.is_err() {
                return Err(Error::internal("a facet cannot be triangulated with the vertices found in it"));
            }
            self.replace(group)?;
        }
        Ok(())
    }

    /// Passes the group's region to the triangulator.
    fn gather(&mut self, group: &[(u32, u32)], in_triangle: &[(u32, u32)]) -> Result<(), Error> {
        self.triangulator.clear();
        let ring = self.triangulator.add_polygon(Role::Outer)?;
        let (axis, sense) = axis_of(&self.surface.points, self.surface.triangles[group[0].1 as usize]);
        let mut segments: Vec<u32> = Vec::new();
        for &(_, t) in group {
            self.control.step()?;
            let [a, b, c] = self.surface.triangles[t as usize];
            let same = turn(&self.surface.points, axis, a, b, c) == sense;
            for [u, v] in sides(if same { [a, b, c] } else { [a, c, b] }) {
                self.triangulator.add_vertex(u)?;
                if self.groups.crossed.binary_search(&sorted([u, v])).is_err() {
                    self.triangulator.add_edge(ring, u, v)?;
                } else {
                    self.keep_pieces(ring, [u, v])?;
                }
                for &(_, w) in on_edge(self.found, [u, v]) {
                    self.triangulator.add_vertex(w)?;
                }
            }
            for &(_, w) in of_key(in_triangle, t) {
                self.triangulator.add_vertex(w)?;
            }
            let mine = of_key(&self.segments, t);
            fallible::extend(&mut segments, mine.iter().map(|s| s.1))?;
        }
        segments.sort_unstable();
        segments.dedup();
        self.add_segments(&segments)
    }

    /// Keeps the pieces of segments that lie along a crossed edge (it is crossed at a vertex then). The edge comes once from each
    /// side, so the windings cancel.
    fn keep_pieces(&mut self, ring: u32, [u, v]: [u32; 2]) -> Result<(), Error> {
        let on = on_edge(self.found, [u, v]);
        let mut line: Vec<u32> = fallible::reserved(on.len() + 2)?;
        fallible::push(&mut line, u)?;
        fallible::extend(&mut line, on.iter().map(|x| x.1))?;
        fallible::push(&mut line, v)?;
        sort_along(&self.surface.points, u, v, &mut line);
        for pair in line.windows(2) {
            if self.piece_ends.binary_search(&sorted([pair[0], pair[1]])).is_ok() {
                self.triangulator.add_edge(ring, pair[0], pair[1])?;
            }
        }
        Ok(())
    }

    /// Adds the pieces of segments that lie in the group's region.
    fn add_segments(&mut self, segments: &[u32]) -> Result<(), Error> {
        if segments.is_empty() {
            return Ok(());
        }
        let polygon = self.triangulator.add_polygon(Role::Edge)?;
        self.triangulator.vertices().iter().for_each(|&v| self.is_vertex[v as usize] = true);
        for piece in segments.iter().flat_map(|&s| self.pieces.of(s)) {
            let [u, v] = piece.ends;
            if self.is_vertex[u as usize] && self.is_vertex[v as usize] {
                self.triangulator.add_edge(polygon, u, v)?;
            }
        }
        self.triangulator.vertices().iter().for_each(|&v| self.is_vertex[v as usize] = false);
        Ok(())
    }

    /// Replaces the group's triangles by the new ones.
    fn replace(&mut self, group: &[(u32, u32)]) -> Result<(), Error> {
        let surface = &mut *self.surface;
        let first = group[0].1;
        let (axis, sense) = axis_of(&surface.points, surface.triangles[first as usize]);
        let facet = surface.triangle_facet[first as usize];
        // The old triangles give facet and orientation. Approximate location suffices, since the facets joined here are coplanar and have
        // one marker.
        let old: Vec<([u32; 3], u32, bool)> = fallible::collect(group.iter().map(|&(_, t)| {
            let [a, b, c] = surface.triangles[t as usize];
            let same = turn(&surface.points, axis, a, b, c) == sense;
            (if same { [a, b, c] } else { [a, c, b] }, surface.triangle_facet[t as usize], same)
        }))?;
        let uniform = old.iter().all(|o| o.1 == facet && o.2);
        for (k, &[a, b, c]) in self.triangulator.triangles.iter().enumerate() {
            // Finding the parent may take a look at every old triangle.
            self.control.steps(if uniform { 1 } else { old.len() as u32 })?;
            let (parent, same) = if uniform {
                (facet, true)
            } else {
                parent_of(&surface.points, axis, sense, &old, [a, b, c])
            };
            let corners = if same { [a, b, c] } else { [a, c, b] };
            match group.get(k) {
                Some(&(_, t)) => {
                    surface.triangles[t as usize] = corners;
                    surface.triangle_facet[t as usize] = parent;
                }
                None => {
                    fallible::push(&mut surface.triangles, corners)?;
                    fallible::push(&mut surface.triangle_facet, parent)?;
                }
            }
        }
        Ok(())
    }
}

/// Facet and orientation of the old triangle that contains the centroid of a new one.
fn parent_of(
    points: &[[f64; 3]],
    axis: usize,
    sense: Sign,
    old: &[([u32; 3], u32, bool)],
    corners: [u32; 3],
) -> (u32, bool) {
    let at = |v: u32| project(&points[v as usize], axis);
    let [p, q, r] = corners.map(at);
    let middle = [0, 1].map(|k| (p[k] + q[k] + r[k]) / 3.0);
    let holds = |t: &[u32; 3]| sides(*t).into_iter().all(|[u, v]| orient2d(at(u), at(v), middle) != -sense);
    old.iter().find(|o| holds(&o.0)).or(old.first()).map_or((0, true), |o| (o.1, o.2))
}
