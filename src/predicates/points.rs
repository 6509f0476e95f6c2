//! The point store: explicit points, and Steiner points on segments and facets that doubles cannot represent.
//!
//! Invariants: explicit coordinates are in the exact range (see `range`); `xyz` holds the nearest doubles of implicit
//! points, which lie in the box; the static bounds hold for all differences between stored points; the points that an implicit one refers
//! to are explicit. All kinds of positions (see `position`) share this store, and predicates take any mixture of them by index.

use crate::elementary::{exponent_above, power_of_two};
use crate::error::Error;
use crate::fallible;
use crate::predicates::big::Big;
use crate::predicates::exact::One;
use crate::predicates::expansion::{Expansion, Short};
use crate::predicates::filter::Spread;
use crate::predicates::located::{Implicit, Located};
use crate::predicates::position::{Parameter, Position};
use crate::predicates::power::Lifts;
use crate::predicates::range::in_range;
use crate::predicates::{located, position, range};

/// All points of a triangulation, with exact predicates on them by index.
#[derive(Debug)]
pub struct Points {
    pub(super) xyz: Vec<[f64; 3]>,
    /// The first implicit point; `u32::MAX` if there is none.
    pub(super) first_implicit: u32,
    /// For points from `first_implicit` on: index into `implicit`, or `u32::MAX` for explicit ones.
    pub(super) slots: Vec<u32>,
    pub(super) implicit: Vec<Implicit>,
    min: [f64; 3],
    max: [f64; 3],
    /// The power of two that divides all explicit coordinates.
    grid: f64,
    pub(super) orient3d_bound: f64,
    pub(super) insphere_bound: f64,
    /// Bounds for circles, by the axis that the projection drops.
    pub(super) incircle_bounds: [f64; 3],
    /// The lifts of weighted points, all of them explicit.
    pub(super) lifts: Option<Lifts>,
}

pub(super) const NONE: u32 = u32::MAX;

impl Points {
    /// A store of explicit points. All must be finite and in the exact range (see [`range_scale`](crate::predicates::range_scale)).
    pub fn new(xyz: Vec<[f64; 3]>) -> Points {
        debug_assert!(xyz.iter().flatten().all(|&x| in_range(x)));
        let mut points = Points {
            xyz: Vec::new(),
            first_implicit: NONE,
            slots: Vec::new(),
            implicit: Vec::new(),
            min: [f64::INFINITY; 3],
            max: [f64::NEG_INFINITY; 3],
            grid: f64::MAX,
            orient3d_bound: f64::INFINITY,
            insphere_bound: f64::INFINITY,
            incircle_bounds: [f64::INFINITY; 3],
            lifts: None,
        };
        let mut lowest = i32::MAX;
        for p in &xyz {
            for (axis, &x) in p.iter().enumerate() {
                points.min[axis] = points.min[axis].min(x);
                points.max[axis] = points.max[axis].max(x);
                lowest = lowest.min(range::lowest_exponent(x).unwrap_or(i32::MAX));
            }
        }
        points.grid = range::scale(1.0, lowest.min(1000));
        points.xyz = xyz;
        points.update_bounds();
        points
    }

    /// A copy.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn copied(&self) -> Result<Points, Error> {
        Ok(Points {
            xyz: fallible::copied(&self.xyz)?,
            slots: fallible::copied(&self.slots)?,
            implicit: fallible::each(&self.implicit, Implicit::copied)?,
            lifts: self.lifts.as_ref().map(Lifts::copied).transpose()?,
            ..*self
        })
    }

    /// Some of the points, numbered in the order of the list, which ascends and has all points that its implicit ones refer to.
    ///
    /// # Errors
    /// `Internal` if it has not, `OutOfMemory`.
    pub fn excerpt(&self, list: &[u32]) -> Result<Points, Error> {
        if list.iter().all(|&i| self.is_explicit(i)) {
            return Ok(Points::new(fallible::collect(list.iter().map(|&i| *self.xyz(i)))?));
        }
        let number = |i: u32| match list.binary_search(&i) {
            Ok(at) => Ok(at as u32),
            Err(_) => Err(Error::internal("a part of the points lacks one that another refers to")),
        };
        let mut part = Points::new(Vec::new());
        for &i in list {
            match self.implicit(i) {
                None => part.push(*self.xyz(i))?,
                Some(implicit) => {
                    let mut copy = implicit.copied()?;
                    match &mut copy.position {
                        Position::Explicit => {}
                        Position::OnSegment { a, b, .. } => [*a, *b] = [number(*a)?, number(*b)?],
                        Position::OnFacet { o, a, b, .. } => {
                            [*o, *a, *b] = [number(*o)?, number(*a)?, number(*b)?];
                        }
                    }
                    part.push_rounded(*self.xyz(i), Some(copy))?
                }
            };
        }
        Ok(part)
    }

    /// The points that an implicit point refers to, filled up with `u32::MAX`.
    pub fn parents(&self, i: u32) -> [u32; 3] {
        match *self.position(i) {
            Position::Explicit => [NONE; 3],
            Position::OnSegment { a, b, .. } => [a, b, NONE],
            Position::OnFacet { o, a, b, .. } => [o, a, b],
        }
    }

    /// Recomputes the static bounds from the box.
    pub(super) fn update_bounds(&mut self) {
        if self.xyz.is_empty() {
            return;
        }
        let mut spread = Spread { size: [0.0; 3], error: [0.0; 3] };
        for axis in 0..3 {
            if !self.implicit.is_empty() {
                // Two points, each off by at most half an ulp.
                spread.error[axis] = f64::EPSILON * self.min[axis].abs().max(self.max[axis].abs());
            }
            spread.size[axis] = self.max[axis] - self.min[axis] + spread.error[axis];
        }
        // In units of the largest no product overflows, even of factors that a compiler pairs in lanes nobody reads: hosts may trap that.
        let largest = spread.max();
        let k = if largest > 0.0 { exponent_above(largest) } else { 0 };
        spread.size = spread.size.map(|x| x * power_of_two(-k));
        spread.error = spread.error.map(|x| x * power_of_two(-k));
        // What underflows there counts in full: bounds may only be too large.
        let whole = |bound: f64, degree: i32| bound * power_of_two(degree * k) + f64::MIN_POSITIVE;
        self.orient3d_bound = whole(spread.orient3d_bound(), 3);
        self.insphere_bound = whole(spread.insphere_bound(), 5);
        self.incircle_bounds =
            [0, 1, 2].map(|axis| whole(spread.incircle_bound((axis + 1) % 3, (axis + 2) % 3), 4));
        if let Some(lifts) = &mut self.lifts {
            lifts.bound = whole(spread.power_bound(lifts.size * power_of_two(-2 * k), lifts.squares), 5);
        }
    }

    /// The number of points.
    #[inline]
    pub fn len(&self) -> usize {
        self.xyz.len()
    }

    /// The coordinates of point `i`: exact if it is explicit, the nearest doubles otherwise.
    #[inline(always)]
    pub fn xyz(&self, i: u32) -> &[f64; 3] {
        &self.xyz[i as usize]
    }

    /// All points, as given by [`xyz`](Points::xyz).
    #[inline]
    pub fn coordinates(&self) -> &[[f64; 3]] {
        &self.xyz
    }

    #[inline]
    fn implicit(&self, i: u32) -> Option<&Implicit> {
        if i < self.first_implicit {
            return None;
        }
        let slot = *self.slots.get((i - self.first_implicit) as usize)?;
        self.implicit.get(slot as usize)
    }

    /// Whether [`xyz`](Points::xyz) is exact.
    #[inline]
    pub fn is_explicit(&self, i: u32) -> bool {
        self.implicit(i).is_none()
    }

    /// The kind of a point's position, and what determines it.
    pub fn position(&self, i: u32) -> &Position {
        self.implicit(i).map_or(&Position::Explicit, |p| &p.position)
    }

    /// `(a, b, t)` of an implicit point `a + t (b − a)`; `None` for points of other kinds.
    pub fn implicit_parameters(&self, i: u32) -> Option<(u32, u32, Expansion)> {
        match self.position(i) {
            Position::OnSegment { a, b, t } => Some((*a, *b, t.value())),
            _ => None,
        }
    }

    /// Appends an explicit point.
    ///
    /// # Errors
    /// `Internal` if a coordinate is not finite or outside the exact range, `OutOfMemory`, `TooLarge`.
    pub fn push(&mut self, p: [f64; 3]) -> Result<u32, Error> {
        if !p.iter().all(|&x| in_range(x)) {
            return Err(Error::internal("a Steiner point is outside the exact range of coordinates"));
        }
        let id = self.append(p, None)?;
        self.take_explicit(p);
        Ok(id)
    }

    fn append(&mut self, p: [f64; 3], implicit: Option<Implicit>) -> Result<u32, Error> {
        let id = self.xyz.len();
        if id >= NONE as usize {
            return Err(Error::new(
                crate::error::Status::TooLarge,
                "more points than 32-bit indices can address",
            ));
        }
        fallible::push(&mut self.xyz, p)?;
        if let Some(implicit) = implicit {
            if self.first_implicit == NONE {
                self.first_implicit = id as u32;
            }
            fallible::push(&mut self.slots, self.implicit.len() as u32)?;
            fallible::push(&mut self.implicit, implicit)?;
            if self.implicit.len() == 1 {
                self.update_bounds();
            }
        } else if self.first_implicit != NONE {
            fallible::push(&mut self.slots, NONE)?;
        }
        Ok(id as u32)
    }

    /// Appends the point `a + t (b − a)`: explicit if every coordinate is exactly a double, implicit otherwise.
    ///
    /// # Errors
    /// `Internal` unless `a` and `b` are explicit, `0 < t < 1` and t is a multiple of `2^-800`; `OutOfMemory`, `TooLarge`.
    pub fn push_on_segment(&mut self, a: u32, b: u32, t: &Expansion) -> Result<u32, Error> {
        let (p, implicit) = self.on_segment(a, b, t)?;
        self.push_rounded(p, implicit)
    }

    /// Appends a point with these nearest doubles; explicit if they are exact.
    pub(super) fn push_rounded(&mut self, p: [f64; 3], implicit: Option<Implicit>) -> Result<u32, Error> {
        if implicit.is_none() {
            return self.push(p);
        }
        // A point on a facet may lie outside the box of all others.
        self.cover(&p);
        self.append(p, implicit)
    }

    /// The nearest doubles of `a + t (b − a)`, and the implicit point if they are not exact.
    pub(super) fn on_segment(
        &self,
        a: u32,
        b: u32,
        t: &Expansion,
    ) -> Result<([f64; 3], Option<Implicit>), Error> {
        if !self.known(a) || !self.known(b) || !range::is_parameter(t) {
            return Err(Error::internal(format_args!(
                "invalid Steiner point: {a}, {b}, {}",
                t.approximate()
            )));
        }
        let ends = [self.xyz(a), self.xyz(b)];
        let (p, beyond) = match *t.components() {
            [t] => position::round(&position::on_segment(ends, &Short::from(t))),
            _ => position::round(&position::on_segment(ends, t)),
        };
        let Some(beyond) = beyond else {
            return Ok((p, None));
        };
        let t = Parameter::new(t)?;
        Ok((p, Some(Implicit { position: Position::OnSegment { a, b, t }, beyond })))
    }

    /// Whether there is such a point and it is explicit.
    fn known(&self, i: u32) -> bool {
        (i as usize) < self.xyz.len() && self.is_explicit(i)
    }

    /// Appends the point `o + u (a − o) + v (b − o)` of the plane through the points `[o, a, b]`: explicit if every coordinate is exactly a
    /// double, implicit otherwise.
    ///
    /// # Errors
    /// `Internal` unless the three points are explicit and not collinear, the parameters `[u, v]` are multiples of `2^-800` of magnitudes
    /// up to `2^415`, and the point is in the exact range; `OutOfMemory`, `TooLarge`.
    pub fn push_on_facet(&mut self, frame: [u32; 3], parameters: [f64; 2]) -> Result<u32, Error> {
        let place = self.is_frame(frame).then(|| self.on_facet(frame, parameters)).flatten();
        let Some((p, implicit)) = place else {
            return Err(Error::internal(format_args!("invalid point on a facet: {frame:?}, {parameters:?}")));
        };
        self.push_rounded(p, implicit)
    }

    /// Whether these points exist, are explicit and span a plane.
    pub(super) fn is_frame(&self, [o, a, b]: [u32; 3]) -> bool {
        [o, a, b].iter().all(|&i| self.known(i)) && !self.collinear(o, a, b)
    }

    /// The nearest doubles of a point on a facet, and the implicit point if they are not exact; `None` if the parameters or the point are
    /// out of range. The points of the frame must be explicit.
    pub(super) fn on_facet(
        &self,
        frame: [u32; 3],
        parameters: [f64; 2],
    ) -> Option<([f64; 3], Option<Implicit>)> {
        if !parameters.iter().all(|&x| range::is_facet_parameter(x)) {
            return None;
        }
        let (p, beyond) = position::round(&position::on_facet(frame.map(|i| self.xyz(i)), parameters));
        if !p.iter().all(|&x| range::in_box(x)) {
            return None;
        }
        let ([o, a, b], [u, v]) = (frame, parameters);
        Some((p, beyond.map(|beyond| Implicit { position: Position::OnFacet { o, a, b, u, v }, beyond })))
    }

    /// Approximate square of the distance between `a + t (b − a)` and its nearest double point; hardly ever zero unless the point is
    /// exactly a double. Twice the precision of doubles suffices for comparing candidates.
    pub fn rounding_error(&self, a: u32, b: u32, t: f64) -> f64 {
        position::rounding_error(self.xyz(a), self.xyz(b), t)
    }

    /// Moves an implicit point along its segment, to parameter `t`; it becomes explicit if possible.
    ///
    /// # Errors
    /// `Internal` if `i` was never implicit or `t` is out of range.
    pub fn move_on_segment(&mut self, i: u32, ends: [u32; 2], t: &Expansion) -> Result<(), Error> {
        let (p, implicit) = self.on_segment(ends[0], ends[1], t)?;
        let slot = i.checked_sub(self.first_implicit).and_then(|k| self.slots.get_mut(k as usize));
        let Some(slot) = slot else {
            return Err(Error::internal("a point that was never implicit cannot move"));
        };
        match implicit {
            None => {
                *slot = NONE;
                let lowest = p.iter().filter_map(|&x| range::lowest_exponent(x)).min().unwrap_or(1000);
                self.grid = self.grid.min(range::scale(1.0, lowest));
            }
            Some(implicit) => {
                *slot = self.implicit.len() as u32;
                fallible::push(&mut self.implicit, implicit)?;
            }
        }
        self.xyz[i as usize] = p;
        Ok(())
    }

    /// Moves an explicit point.
    ///
    /// # Errors
    /// `Internal` if the point is implicit, or a coordinate is not finite or outside the exact range.
    pub fn move_to(&mut self, i: u32, p: [f64; 3]) -> Result<(), Error> {
        if !self.is_explicit(i) || !p.iter().all(|&x| in_range(x)) {
            return Err(Error::internal("a point cannot be moved there"));
        }
        self.xyz[i as usize] = p;
        self.take_explicit(p);
        Ok(())
    }

    /// Moves a point, implicit or not, to these doubles; it is then explicit.
    ///
    /// # Errors
    /// `Internal` if a coordinate is not finite or outside the exact range.
    pub fn settle(&mut self, i: u32, p: [f64; 3]) -> Result<(), Error> {
        if !p.iter().all(|&x| in_range(x)) {
            return Err(Error::internal("a point cannot be settled there"));
        }
        let slot = i.checked_sub(self.first_implicit).and_then(|k| self.slots.get_mut(k as usize));
        if let Some(slot) = slot {
            *slot = NONE;
        }
        self.move_to(i, p)
    }

    /// Updates grid, box and bounds for a new explicit point.
    pub(super) fn take_explicit(&mut self, p: [f64; 3]) {
        let lowest = p.iter().filter_map(|&x| range::lowest_exponent(x)).min().unwrap_or(1000);
        self.grid = self.grid.min(range::scale(1.0, lowest));
        self.cover(&p);
    }

    /// Enlarges the box, and with it the bounds, to contain these doubles.
    pub(super) fn cover(&mut self, p: &[f64; 3]) {
        if (0..3).any(|i| p[i] < self.min[i] || p[i] > self.max[i]) {
            for (i, &x) in p.iter().enumerate() {
                self.min[i] = self.min[i].min(x);
                self.max[i] = self.max[i].max(x);
            }
            self.update_bounds();
        }
    }

    /// The largest `n <= 52` such that `a + t (b − a)` is exactly a double for every `t = k / 2^n`; 0 if there is none.
    /// Both ends must be explicit (0 otherwise).
    pub fn exact_bits(&self, a: u32, b: u32) -> u32 {
        if !self.is_explicit(a) || !self.is_explicit(b) {
            return 0;
        }
        let (a, b) = (self.xyz(a), self.xyz(b));
        (0..3).map(|i| position::exact_bits(a[i], b[i])).min().unwrap_or(0)
    }

    /// The exact coordinates as expansions (components smallest first; their sum is the coordinate).
    pub fn exact_coordinates(&self, i: u32) -> [Expansion; 3] {
        self.exact_of(&self.located([i])[0])
    }

    /// The exact coordinates of a point that need not be in the store.
    fn exact_of(&self, p: &Located) -> [Expansion; 3] {
        match p.implicit.map(|p| &p.position) {
            None | Some(Position::Explicit) => p.xyz.map(Expansion::from),
            Some(Position::OnSegment { a, b, t }) => {
                position::on_segment([self.xyz(*a), self.xyz(*b)], &t.value())
            }
            Some(&Position::OnFacet { o, a, b, u, v }) => {
                position::on_facet([o, a, b].map(|i| self.xyz(i)), [u, v]).map(|x| x.widened())
            }
        }
    }

    /// These points as the signs see them.
    #[inline(always)]
    pub(super) fn located<const N: usize>(&self, ids: [u32; N]) -> [Located<'_>; N] {
        ids.map(|i| Located { xyz: self.xyz(i), implicit: self.implicit(i) })
    }

    /// The exact coordinates of a point if they are short: all but those of parameters of several doubles, and of points on facets whose
    /// parameters have many bits.
    fn short_of(&self, p: &Located) -> Option<[Short; 3]> {
        match p.implicit.map(|p| &p.position) {
            None | Some(Position::Explicit) => Some(p.xyz.map(Short::from)),
            Some(Position::OnSegment { a, b, t }) => {
                Some(position::on_segment([self.xyz(*a), self.xyz(*b)], &Short::from(t.one()?)))
            }
            Some(&Position::OnFacet { o, a, b, u, v }) => {
                let [x, y, z] = position::on_facet([o, a, b].map(|i| self.xyz(i)), [u, v]);
                Some([x.shortened()?, y.shortened()?, z.shortened()?])
            }
        }
    }

    /// The exact coordinates of these points if all are short.
    pub(super) fn short_coordinates<const N: usize>(&self, points: &[Located; N]) -> Option<[[Short; 3]; N]> {
        let mut all = [[Short::default(); 3]; N];
        for (to, p) in all.iter_mut().zip(points) {
            *to = self.short_of(p)?;
        }
        Some(all)
    }

    /// Exact coordinates as big integers.
    #[cold]
    #[inline(never)]
    pub(super) fn big<const N: usize>(&self, points: [Located; N]) -> [[One; 3]; N] {
        match self.short_coordinates(&points) {
            Some(points) => Big::rows(&points),
            None => Big::rows(&points.map(|p| self.exact_of(&p))),
        }
    }

    /// Whether a point among these is implicit.
    #[inline(always)]
    pub(super) fn any_implicit(&self, ids: &[u32]) -> bool {
        self.first_implicit != NONE && ids.iter().any(|&i| !self.is_explicit(i))
    }

    /// Whether three of the points lie on one segment or all on one facet, recognized from an implicit one among them.
    pub(super) fn coplanar_by_position(&self, ids: [u32; 4]) -> bool {
        let count = |on: &dyn Fn(u32) -> bool| ids.iter().filter(|&&i| on(i)).count();
        ids.iter().any(|&i| match *self.position(i) {
            Position::Explicit => false,
            Position::OnSegment { a, b, .. } => count(&|i| self.is_on_segment(i, [a, b])) >= 3,
            Position::OnFacet { o, a, b, .. } => count(&|i| self.is_on_facet(i, [o, a, b])) == 4,
        })
    }

    /// Whether a point is an end of this segment or positioned on it.
    fn is_on_segment(&self, i: u32, ends: [u32; 2]) -> bool {
        ends.contains(&i) || matches!(self.position(i), Position::OnSegment { a, b, .. } if [*a, *b] == ends)
    }

    /// Whether a point is in this frame, on a segment between two of its points, or positioned by it.
    fn is_on_facet(&self, i: u32, frame: [u32; 3]) -> bool {
        match *self.position(i) {
            Position::Explicit => frame.contains(&i),
            Position::OnSegment { a, b, .. } => frame.contains(&a) && frame.contains(&b),
            Position::OnFacet { o, a, b, .. } => [o, a, b].iter().all(|p| frame.contains(p)),
        }
    }

    /// Whether a point among these needs big integers.
    pub(super) fn any_fine(&self, ids: &[u32]) -> bool {
        self.first_implicit != NONE && ids.iter().any(|&i| self.implicit(i).is_some_and(|p| p.beyond.fine))
    }

    /// The power of two that divides all explicit coordinates.
    #[inline(always)]
    pub(super) fn grid(&self) -> f64 {
        self.grid
    }

    /// Bounds on the differences of these points to the last one; `explicit` says whether all of them are.
    #[inline(always)]
    pub(super) fn spread<const N: usize>(&self, ids: [u32; N], explicit: bool) -> Spread {
        let mut spread = Spread::of(ids.map(|i| self.xyz(i)));
        if !explicit {
            located::widen(&mut spread, &self.located(ids));
        }
        spread
    }

    /// Removes the last point.
    pub fn pop(&mut self) {
        if self.xyz.pop().is_none() || self.xyz.len() < self.first_implicit as usize {
            return;
        }
        if let Some(slot) = self.slots.pop().filter(|&slot| slot != NONE) {
            // Positions that no point has any more may stay behind others.
            if slot as usize + 1 == self.implicit.len() {
                self.implicit.pop();
            }
        }
        if self.slots.is_empty() {
            self.first_implicit = NONE;
            self.implicit.clear();
        }
    }

    /// Removes all points but the first `n`. (The static bounds stay valid, though they could be tighter.)
    pub fn truncate(&mut self, n: usize) {
        self.xyz.truncate(n);
        if self.first_implicit == NONE {
            return;
        }
        self.slots.truncate(n.saturating_sub(self.first_implicit as usize));
        let kept =
            self.slots.iter().filter(|&&slot| slot != NONE).map(|&slot| slot as usize + 1).max().unwrap_or(0);
        self.implicit.truncate(kept);
        if kept == 0 {
            self.first_implicit = NONE;
            self.slots.clear();
            self.update_bounds();
        }
    }
}
