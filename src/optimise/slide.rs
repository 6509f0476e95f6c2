//! Vertices of a surface that may be refined: they slide along their segment, or in the plane of their facet.
//!
//! Beside the doubles, in which tetrahedra are measured and tested, such a vertex has an exact position with few bits in its parameters:
//! `a + t (b − a)` on a segment, `o + u (a − o) + v (b − o)` on a facet. A new one is chosen near a wanted place; its nearest doubles are the
//! vertex's, as in rounding. (Such positions: Diazzi, Panozzo, Vaxman & Attene 2023; Shewchuk & Si 2014.)
//!
//! Invariants: the vertices of a segment keep their order along it; at exact positions every wall keeps its orientation in its own plane, so
//! a point on a facet stays strictly inside its link there and the walls of a facet still tile it; no wall or tetrahedron that was within
//! its bound is above it.
use crate::elementary::{exponent, power_of_two, quotient};
use crate::error::Error;
use crate::fallible;
use crate::kernel::Mesh;
use crate::optimise::descend::Freedom;
use crate::optimise::Optimise;
use crate::predicates::{surviving, Placed, Points, Sign};
use crate::size::{distance, volume, Bounds};
use crate::vector::{cross, dot, sub};

/// Bits of a parameter on a segment below its room there: a position is off by a thousandth of that at most.
const BITS: i32 = 9;
/// Finer parameters are out of range (see `predicates`).
const MOST_BITS: i32 = 800;

/// Where a vertex may go.
#[derive(Clone, Copy, Debug)]
pub enum Track {
    /// Along a segment.
    Segment {
        /// The ends of the segment.
        ends: [u32; 2],
        /// The vertices before it and after it.
        between: [u32; 2],
        /// Where it is.
        t: f64,
    },
    /// In the plane of a facet.
    Facet {
        /// Three points of the plane.
        frame: [u32; 3],
        /// The name of its walls.
        patch: u32,
    },
}

/// A vertex that may slide.
#[derive(Clone, Copy, Debug)]
pub struct Slider {
    /// The vertex.
    pub v: u32,
    /// Where it may go.
    pub track: Track,
    /// Whether it has gone anywhere.
    pub moved: bool,
}

/// What the walls of a patch may be at most; infinite without a bound.
#[derive(Clone, Copy, Debug)]
pub struct Largest {
    /// The area.
    pub area: f64,
    /// The circumradius.
    pub radius: f64,
}

impl Largest {
    const NONE: Largest = Largest { area: f64::INFINITY, radius: f64::INFINITY };

    /// How many times its bound a triangle is.
    fn excess(&self, [x, y, z]: [&[f64; 3]; 3]) -> f64 {
        if self.area.is_infinite() && self.radius.is_infinite() {
            return 0.0;
        }
        let n = cross(&sub(y, x), &sub(z, x));
        let area = 0.5 * dot(&n, &n).sqrt();
        let edges = distance(x, y) * distance(y, z) * distance(z, x);
        let over = |x: f64, most: f64| quotient(x, most).unwrap_or(f64::INFINITY);
        over(area, self.area).max(over(over(edges, 4.0 * area), self.radius))
    }
}

/// All vertices that may slide, at their exact positions.
///
/// They are known by their numbers in the whole mesh: blocks with numbers of their own leave them where they are, and a run on the whole mesh
/// moves them.
#[derive(Debug)]
pub struct Slides {
    exact: Points,
    /// By vertex, ascending.
    list: Vec<Slider>,
    /// By patch; none beyond.
    largest: Vec<Largest>,
    /// Coordinates are the caller's times two to this power.
    exponent: i32,
    walls: Vec<Wall>,
    limits: Vec<Limit>,
}

/// An edge opposite a sliding vertex in a wall.
#[derive(Clone, Copy, Debug)]
struct Wall {
    edge: [u32; 2],
    /// A projection of the wall that is not flat, and its orientation there.
    axis: usize,
    turn: Sign,
    largest: Largest,
    excess: f64,
}

/// The largest volume of the tetrahedron from a sliding vertex to a face.
#[derive(Clone, Copy, Debug)]
struct Limit {
    face: [u32; 3],
    volume: f64,
}

impl Slides {
    /// Vertices from the first added one on, sorted, with all points at their exact positions.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn new(
        mut exact: Points,
        first: u32,
        list: Vec<Slider>,
        largest: Vec<Largest>,
        exponent: i32,
    ) -> Result<Slides, Error> {
        exact.allow_implicit(first)?;
        Ok(Slides { exact, list, largest, exponent, walls: Vec::new(), limits: Vec::new() })
    }

    /// A copy.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn copied(&self) -> Result<Slides, Error> {
        Ok(Slides {
            exact: self.exact.copied()?,
            list: fallible::copied(&self.list)?,
            largest: fallible::copied(&self.largest)?,
            exponent: self.exponent,
            walls: Vec::new(),
            limits: Vec::new(),
        })
    }

    /// All points at their exact positions.
    pub fn exact(&self) -> &Points {
        &self.exact
    }

    /// The vertices, ascending.
    pub fn list(&self) -> &[Slider] {
        &self.list
    }

    /// Where a vertex may go; `None` if it stays.
    pub fn of(&self, v: u32) -> Option<&Slider> {
        self.list.get(self.find(v)?)
    }

    fn find(&self, v: u32) -> Option<usize> {
        self.list.binary_search_by_key(&v, |slider| slider.v).ok()
    }

    /// The parameter of a vertex of a segment that slides, or of one of its ends.
    fn parameter(&self, v: u32, ends: [u32; 2]) -> Option<f64> {
        match self.of(v).map(|slider| slider.track) {
            Some(Track::Segment { t, .. }) => Some(t),
            _ if v == ends[0] => Some(0.0),
            _ => (v == ends[1]).then_some(1.0),
        }
    }
}

impl Optimise<'_> {
    /// Slides a vertex whose star and link are at hand; returns the worst sine before and after.
    pub(super) fn slide(&mut self, v: u32, enough: f64) -> Result<(f64, f64), Error> {
        let Optimise { mesh, points, slides, search, bounds, descend, link, .. } = self;
        let around = Around { mesh, star: &search.tets, bounds };
        match slides.as_mut().and_then(|slides| Rail::new(slides, points, v, around)) {
            Some(mut rail) => descend.smooth_within(points, v, link, enough, &mut rail),
            None => Ok((0.0, 0.0)),
        }
    }
}

/// What is around a vertex.
#[derive(Clone, Copy)]
struct Around<'a> {
    mesh: &'a Mesh,
    star: &'a [u32],
    bounds: &'a Bounds,
}

/// The way of a vertex.
struct Rail<'a> {
    exact: &'a mut Points,
    slider: &'a mut Slider,
    around: Around<'a>,
    largest: &'a [Largest],
    exponent: i32,
    /// What it must keep to, collected once there is somewhere to go; whether it was, and whether that can be kept.
    walls: &'a mut Vec<Wall>,
    limits: &'a mut Vec<Limit>,
    collected: Option<bool>,
    /// Along the segment, or normal to the facet; of length one.
    axis: [f64; 3],
    /// The segment's vector over its square.
    per_length: [f64; 3],
    /// The parameters of the neighbours on the segment.
    room: [f64; 2],
    /// Where the vertex is, in doubles.
    at: [f64; 3],
    /// Where it may go next.
    next: Option<Next>,
}

/// A place that was found good.
struct Next {
    placed: Placed,
    /// Its doubles.
    at: [f64; 3],
    /// The parameter on the segment.
    t: f64,
}

impl Rail<'_> {
    fn new<'a>(slides: &'a mut Slides, points: &Points, v: u32, around: Around<'a>) -> Option<Rail<'a>> {
        let index = slides.find(v)?;
        let xyz = |v: u32| slides.exact.xyz(v);
        let (way, room) = match slides.list[index].track {
            Track::Segment { ends, between, .. } => {
                let [from, to] = between.map(|v| slides.parameter(v, ends));
                (sub(xyz(ends[1]), xyz(ends[0])), [from?, to?])
            }
            Track::Facet { frame: [o, a, b], .. } => {
                (cross(&sub(xyz(a), xyz(o)), &sub(xyz(b), xyz(o))), [0.0; 2])
            }
        };
        let square = dot(&way, &way);
        let [one, over] = [quotient(1.0, square.sqrt())?, quotient(1.0, square)?];
        Some(Rail {
            exact: &mut slides.exact,
            slider: &mut slides.list[index],
            around,
            largest: &slides.largest,
            exponent: slides.exponent,
            walls: &mut slides.walls,
            limits: &mut slides.limits,
            collected: None,
            axis: way.map(|x| one * x),
            per_length: way.map(|x| over * x),
            room,
            at: *points.xyz(v),
            next: None,
        })
    }

    /// Collects the walls and the limits of what is around the vertex; false if it must stay.
    fn collect(&mut self, points: &Points) -> Result<bool, Error> {
        let Around { mesh, star, bounds } = self.around;
        let v = self.slider.v;
        let named = match self.slider.track {
            Track::Segment { .. } => None,
            Track::Facet { patch, .. } => Some(patch),
        };
        self.walls.clear();
        self.limits.clear();
        for &t in star.iter().filter(|&&t| !mesh.is_ghost(t)) {
            let Some(slot) = mesh.slot_of(t, v) else { continue };
            let face = mesh.face(4 * t + slot);
            let bound = bounds.of(mesh.region(t));
            if bound.is_finite() {
                let [x, y, z] = face.map(|w| points.xyz(w));
                let volume = volume([&self.at, x, y, z]).max(bound);
                fallible::push(self.limits, Limit { face, volume })?;
            }
            for code in (4 * t..4 * t + 4).filter(|code| code & 3 != slot && mesh.is_wall(*code)) {
                let across = mesh.across(code);
                if across < code && !mesh.is_ghost(across >> 2) {
                    // It was seen from the other side.
                    continue;
                }
                let patch = mesh.subface(code);
                if named.is_some_and(|named| named != patch) {
                    return Ok(false);
                }
                let Some(wall) = self.wall(points, mesh.face(code), patch) else { return Ok(false) };
                fallible::push(self.walls, wall)?;
            }
        }
        Ok(named.is_none() || !self.walls.is_empty())
    }

    /// A wall at the vertex; `None` if it is flat.
    fn wall(&self, points: &Points, corners: [u32; 3], patch: u32) -> Option<Wall> {
        let v = self.slider.v;
        let k = corners.iter().position(|&w| w == v)?;
        let edge @ [x, y] = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
        let turn = |axis| (axis, self.exact.orient_in_plane(axis, v, x, y));
        let (axis, turn) = (0..3).map(turn).find(|x| x.1 != Sign::Zero)?;
        let largest = self.largest.get(patch as usize).copied().unwrap_or(Largest::NONE);
        let excess = largest.excess([&self.at, points.xyz(x), points.xyz(y)]).max(1.0);
        Some(Wall { edge, axis, turn, largest, excess })
    }

    /// The exact position for a wanted place, and its parameter on the segment.
    fn placed(&self, wanted: &[f64; 3]) -> Result<Option<(Placed, f64)>, Error> {
        match self.slider.track {
            Track::Segment { ends, t, .. } => {
                let [from, to] = self.room;
                let bits = BITS - exponent(to - from);
                if !(0..=MOST_BITS).contains(&bits) {
                    return Ok(None);
                }
                let unit = power_of_two(bits);
                let t = ((t + dot(&sub(wanted, &self.at), &self.per_length)) * unit).round() / unit;
                if t > from && t < to {
                    return Ok(Some((self.exact.place_on_segment(ends, t)?, t)));
                }
                Ok(None)
            }
            Track::Facet { frame, .. } => {
                let Some([x, y]) = self.walls.first().map(|wall| wall.edge) else { return Ok(None) };
                let placed = self.exact.place_in_plane(frame, [self.slider.v, x, y], wanted);
                Ok(placed.map(|placed| (placed, 0.0)))
            }
        }
    }

    /// Whether walls keep their orientation, and walls and tetrahedra their bounds.
    fn holds(&self, points: &Points, next: &Next) -> bool {
        let limit = |limit: &Limit| {
            let [x, y, z] = limit.face.map(|v| points.xyz(v));
            volume([&next.at, x, y, z]) <= limit.volume
        };
        let wall = |wall: &Wall| {
            let [x, y] = wall.edge;
            wall.largest.excess([&next.at, points.xyz(x), points.xyz(y)]) <= wall.excess
                && self.exact.orient_placed(wall.axis, &next.placed, x, y) == wall.turn
        };
        self.limits.iter().all(limit) && self.walls.iter().all(wall)
    }
}

impl Freedom for Rail<'_> {
    fn along(&self, way: [f64; 3]) -> [f64; 3] {
        let part = dot(&way, &self.axis);
        match self.slider.track {
            Track::Segment { .. } => self.axis.map(|x| part * x),
            Track::Facet { .. } => [0, 1, 2].map(|k| way[k] - part * self.axis[k]),
        }
    }

    fn place(&mut self, points: &Points, wanted: [f64; 3]) -> Result<Option<[f64; 3]>, Error> {
        let collected = match self.collected {
            Some(collected) => collected,
            None => self.collect(points)?,
        };
        self.collected = Some(collected);
        let placed = if collected { self.placed(&wanted)? } else { None };
        let Some((placed, t)) = placed else { return Ok(None) };
        let at = placed.xyz().map(|x| surviving(x, self.exponent));
        // A position at doubles that the caller's scale cannot hold would be none.
        if placed.is_explicit() && at != *placed.xyz() {
            return Ok(None);
        }
        self.next = Some(Next { placed, at, t }).filter(|next| self.holds(points, next));
        Ok(self.next.as_ref().map(|next| next.at))
    }

    fn take(&mut self) -> Result<(), Error> {
        let Some(next) = self.next.take() else { return Ok(()) };
        self.exact.take(self.slider.v, next.placed)?;
        self.at = next.at;
        self.slider.moved = true;
        if let Track::Segment { t, .. } = &mut self.slider.track {
            *t = next.t;
        }
        Ok(())
    }
}
