//! The point store: explicit points, and Steiner points `a + t (b − a)` on segments that doubles cannot represent.
//!
//! Invariants: explicit coordinates are in the exact range (see `range`); `xyz` holds the nearest doubles of implicit
//! points; the static bounds hold for all differences between stored points; the segment ends of an implicit point are explicit. Source:
//! implicit points as in Diazzi, Panozzo, Vaxman & Attene 2023, but with a double as the parameter t, so that no coordinate has a
//! denominator: coordinates are sums of two doubles in nearly all cases, and integers on a common grid. If segments run so close to each
//! other that a double is too coarse, t is the sum of several.

use crate::error::Error;
use crate::predicates::big::Big;
use crate::predicates::expansion::{two_product, two_sum, Expansion};
use crate::predicates::filter::{larger, Spread};
use crate::predicates::range;
use crate::predicates::range::in_range;
use crate::predicates::wide;
use crate::predicates::wide::Differences;
use crate::predicates::Sign;

/// An implicit point.
#[derive(Clone, Debug)]
struct Implicit {
    a: u32,
    b: u32,
    t: f64,
    /// The components of the parameter beyond the nearest double `t`, smallest first. Usually empty.
    low: Box<[f64]>,
    /// The nearest doubles of `exact − nearest double`.
    rest: [f64; 3],
    /// Whether the nearest double plus `rest` is exact in all coordinates.
    two_doubles: bool,
    /// Whether a coordinate has bits below the exact range: filters could underflow.
    fine: bool,
}

impl Implicit {
    fn parameter(&self) -> Expansion {
        if self.low.is_empty() {
            return Expansion::from(self.t);
        }
        self.low.iter().fold(Expansion::from(self.t), |sum, &x| sum.sum(&Expansion::from(x)))
    }
}

/// All points of a triangulation, with exact predicates on them by index.
#[derive(Clone, Debug)]
pub struct Points {
    xyz: Vec<[f64; 3]>,
    /// The first implicit point; `u32::MAX` if there is none.
    first_implicit: u32,
    /// For points from `first_implicit` on: index into `implicit`, or `u32::MAX` for explicit ones.
    slots: Vec<u32>,
    implicit: Vec<Implicit>,
    min: [f64; 3],
    max: [f64; 3],
    /// The power of two that divides all explicit coordinates.
    grid: f64,
    pub(super) orient3d_bound: f64,
    pub(super) insphere_bound: f64,
    /// Bounds for circles, by the axis that the projection drops.
    pub(super) incircle_bounds: [f64; 3],
}

const NONE: u32 = u32::MAX;

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

    /// Recomputes the static bounds from the box.
    fn update_bounds(&mut self) {
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
        self.orient3d_bound = spread.orient3d_bound();
        self.insphere_bound = spread.insphere_bound();
        self.incircle_bounds = [0, 1, 2].map(|axis| spread.incircle_bound((axis + 1) % 3, (axis + 2) % 3));
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

    /// `(a, b, t)` of an implicit point `a + t (b − a)`; `None` for an explicit one.
    pub fn implicit_parameters(&self, i: u32) -> Option<(u32, u32, Expansion)> {
        self.implicit(i).map(|p| (p.a, p.b, p.parameter()))
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
        self.xyz.try_reserve(1)?;
        self.slots.try_reserve(1)?;
        self.implicit.try_reserve(1)?;
        self.xyz.push(p);
        if let Some(implicit) = implicit {
            if self.first_implicit == NONE {
                self.first_implicit = id as u32;
            }
            self.slots.push(self.implicit.len() as u32);
            self.implicit.push(implicit);
            if self.implicit.len() == 1 {
                self.update_bounds();
            }
        } else if self.first_implicit != NONE {
            self.slots.push(NONE);
        }
        Ok(id as u32)
    }

    /// Appends the point `a + t (b − a)`: explicit if every coordinate is exactly a double, implicit otherwise.
    ///
    /// # Errors
    /// `Internal` unless `a` and `b` are explicit, `0 < t < 1` and t is a multiple of `2^-800`; `OutOfMemory`, `TooLarge`.
    pub fn push_on_segment(&mut self, a: u32, b: u32, t: &Expansion) -> Result<u32, Error> {
        match self.on_segment(a, b, t)? {
            (p, None) => self.push(p),
            (p, implicit) => self.append(p, implicit),
        }
    }

    /// The nearest doubles of `a + t (b − a)`, and the implicit point if they are not exact.
    fn on_segment(&self, a: u32, b: u32, t: &Expansion) -> Result<([f64; 3], Option<Implicit>), Error> {
        let known = |i: u32| (i as usize) < self.xyz.len() && self.is_explicit(i);
        if !known(a) || !known(b) || !range::is_parameter(t) {
            return Err(Error::internal(format_args!(
                "invalid Steiner point: {a}, {b}, {}",
                t.approximate()
            )));
        }
        let exact = on_segment(self.xyz(a), self.xyz(b), t);
        let lowest = exact.iter().filter_map(|e| range::lowest_exponent(*e.components().first()?)).min();
        let fine = lowest.is_some_and(|e| e < range::LOWEST_EXPONENT);
        let p = [0, 1, 2].map(|i| exact[i].nearest());
        if !fine && exact.iter().all(|e| e.components().len() <= 1) {
            return Ok((p, None));
        }
        let beyond = [0, 1, 2].map(|i| exact[i].difference(&Expansion::from(p[i])).compressed());
        let two_doubles = beyond.iter().all(|e| e.components().len() <= 1);
        let rest = [0, 1, 2].map(|i| beyond[i].nearest());
        let nearest = t.nearest();
        let low = match t.components() {
            [_] => Box::default(),
            _ => t.difference(&Expansion::from(nearest)).compressed().components().into(),
        };
        Ok((p, Some(Implicit { a, b, t: nearest, low, rest, two_doubles, fine })))
    }

    /// Approximate square of the distance between `a + t (b − a)` and its nearest double point; hardly ever zero unless the point is
    /// exactly a double. Twice the precision of doubles suffices for comparing candidates.
    pub fn rounding_error(&self, a: u32, b: u32, t: f64) -> f64 {
        let (a, b) = (self.xyz(a), self.xyz(b));
        let error = |axis: usize| {
            let (high, low) = two_sum(b[axis], -a[axis]);
            let (product, rest) = two_product(high, t);
            let (sum, beyond) = two_sum(a[axis], product);
            let rest = beyond + (rest + low * t);
            rest - ((sum + rest) - sum)
        };
        (0..3).map(|axis| error(axis) * error(axis)).sum()
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
                self.implicit.try_reserve(1)?;
                self.implicit.push(implicit);
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
    fn take_explicit(&mut self, p: [f64; 3]) {
        let lowest = p.iter().filter_map(|&x| range::lowest_exponent(x)).min().unwrap_or(1000);
        self.grid = self.grid.min(range::scale(1.0, lowest));
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
        (0..3).map(|i| exact_bits_1d(a[i], b[i])).min().unwrap_or(0)
    }

    /// The exact coordinates as expansions (components smallest first; their sum is the coordinate).
    pub fn exact_coordinates(&self, i: u32) -> [Expansion; 3] {
        match self.implicit(i) {
            None => self.xyz(i).map(Expansion::from),
            Some(p) => on_segment(self.xyz(p.a), self.xyz(p.b), &p.parameter()),
        }
    }

    /// The differences of these points to the last one as integers, if they fit.
    #[inline(always)]
    pub(super) fn differences<const N: usize>(&self, ids: [u32; N]) -> Option<Differences<N>> {
        let mut coordinates = [[[0.0; 2]; 3]; N];
        for (to, &i) in coordinates.iter_mut().zip(&ids) {
            let p = self.xyz(i);
            let rest = match self.implicit(i) {
                None => [0.0; 3],
                Some(implicit) if implicit.two_doubles => implicit.rest,
                Some(_) => return None,
            };
            for axis in 0..3 {
                to[axis] = [p[axis], rest[axis]];
            }
        }
        Differences::new(&coordinates)
    }

    /// The insphere sign from the leading bits of the differences, if they decide.
    pub(super) fn insphere_leading(&self, ids: [u32; 5]) -> Option<Sign> {
        let mut coordinates = [[[0.0; 2]; 3]; 5];
        let mut lost = 0.0f64;
        for (to, &i) in coordinates.iter_mut().zip(&ids) {
            let (p, implicit) = (self.xyz(i), self.implicit(i));
            for axis in 0..3 {
                let rest = implicit.map_or(0.0, |implicit| implicit.rest[axis]);
                to[axis] = [p[axis], rest];
                if implicit.is_some_and(|implicit| !implicit.two_doubles) {
                    // Rounded to nearest; the smallest double where that underflows.
                    lost = lost.max(rest.abs() * f64::EPSILON + range::scale(1.0, -1074));
                }
            }
        }
        wide::insphere_leading(&coordinates, lost)
    }

    /// Exact coordinates as big integers.
    pub(super) fn big<const N: usize>(&self, ids: [u32; N]) -> [[Big; 3]; N] {
        Big::rows(&ids.map(|i| self.exact_coordinates(i)))
    }

    /// Whether a point among these is implicit.
    #[inline(always)]
    pub(super) fn any_implicit(&self, ids: &[u32]) -> bool {
        self.first_implicit != NONE && ids.iter().any(|&i| !self.is_explicit(i))
    }

    /// Whether three of the points lie on one segment, recognized from an implicit one among them.
    pub(super) fn three_on_a_segment(&self, ids: [u32; 4]) -> bool {
        let ends = |i: u32| self.implicit(i).map(|p| [p.a, p.b]);
        ids.iter().filter_map(|&i| ends(i)).any(|[a, b]| {
            let on = |&&i: &&u32| i == a || i == b || ends(i) == Some([a, b]);
            ids.iter().filter(on).count() >= 3
        })
    }

    /// Whether a point among these needs big integers.
    pub(super) fn any_fine(&self, ids: &[u32]) -> bool {
        self.first_implicit != NONE && ids.iter().any(|&i| self.implicit(i).is_some_and(|p| p.fine))
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
            // The rest is rounded itself.
            let bound = |x: f64| x.abs() * (1.0 + 2.0 * f64::EPSILON);
            let of = |i: u32| self.implicit(i).map_or([0.0; 3], |p| p.rest.map(bound));
            for &i in &ids[..N - 1] {
                for (worst, e) in spread.error.iter_mut().zip(of(i)) {
                    *worst = larger(*worst, e);
                }
            }
            for (axis, e) in of(ids[N - 1]).into_iter().enumerate() {
                spread.error[axis] += e;
                spread.size[axis] += spread.error[axis];
            }
        }
        spread
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

/// The exact `a + t (b − a)`.
fn on_segment(a: &[f64; 3], b: &[f64; 3], t: &Expansion) -> [Expansion; 3] {
    [0, 1, 2].map(|i| {
        let d = Expansion::of_difference(b[i], a[i]);
        let along = if let [t] = t.components() { d.scale(*t) } else { d.product(t) };
        along.sum(&Expansion::from(a[i])).compressed()
    })
}

/// [`Points::exact_bits`] for one coordinate.
///
/// Let d = b − a and g = 2^(low(d) − n), low the exponent of the lowest set bit. Even k belong to smaller n. For odd k and
/// low(d) − n < low(a) the lowest bit of v = a + k d / 2^n is g exactly, so v is a double if and only if |v| <= 2^53 g;
/// |v| is largest at k = 1 or k = 2^n − 1. Otherwise all v are multiples of 2^min(low(a), low(b)) no larger than the
/// ends, and so doubles. Hence all points up to level n are doubles if the two outermost points of every level up to n are. |a|, |b| <=
/// 2^53 g is sufficient; beyond that, test level by level.
fn exact_bits_1d(a: f64, b: f64) -> u32 {
    const MOST: u32 = 52;
    let d = Expansion::of_difference(b, a);
    let Some(low) = d.components().first().and_then(|&x| range::lowest_exponent(x)) else {
        return MOST;
    };
    let high = range::highest_exponent(a).max(range::highest_exponent(b)).unwrap_or(low);
    // |a|, |b| < 2^(high + 1) <= 2^53 g.
    let mut n = (low + 52 - high).clamp(0, MOST as i32) as u32;
    let is_double =
        |from: f64, step: f64| d.scale(step).sum(&Expansion::from(from)).compressed().components().len() <= 1;
    while n < MOST {
        let step = range::scale(1.0, -(n as i32) - 1);
        if !is_double(a, step) || !is_double(b, -step) {
            break;
        }
        n += 1;
    }
    n
}
