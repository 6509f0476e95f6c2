//! Choosing a position on a facet: near a wanted one, strictly inside a triangle or anywhere in its plane, with parameters of few bits.
//!
//! Where a Steiner point lies on its facet is free within a region, in which triangle it lies is not. So the position is found in
//! floating-point arithmetic, as weights of the triangle's corners, and its parameters `u`, `v` are rounded to the coarsest powers of two
//! that change no weight by more than a small part; exact signs then tell whether the point is inside. If it is not (the triangle is so thin
//! that rounding errors matter), its exact distance from where it should be corrects the parameters, and they take more bits.
//!
//! The nearest doubles of the point may lie in the facet's plane themselves, and always do if the plane is normal to an axis. Then they are
//! the position, and there is nothing to round later.
//!
//! Source: the correction is the iterative refinement of a linear system's solution by its residual (Wilkinson 1963).

use crate::elementary::{power_of_two, quotient};
use crate::error::Error;
use crate::predicates::located::Located;
use crate::predicates::placed::Placed;
use crate::predicates::{orient3d, range, Points, Sign};

/// The least weight that a corner gets, before the three are scaled to a sum of one: a wanted position nearer to an edge, or beyond it, moves
/// inwards. A larger one moves more points; a smaller one needs a smaller `LARGEST_CHANGE`.
const LEAST_WEIGHT: f64 = 1.0 / 32.0;
/// The most that rounding of the parameters may change a weight: less than half of the least weight after scaling, `LEAST_WEIGHT / (2 +
/// LEAST_WEIGHT)`. Halving it costs a bit of each parameter. Measured on random triangles as their own frames, wanted positions anywhere
/// inside (least weight, largest change: bits of both parameters, mean of the largest change of a weight): 1/16, 1/32: 5.5, 0.026; 1/16,
/// 1/64: 7.1, 0.021; 1/32, 1/128: 8.9, 0.008; 1/64, 1/256: 10.8, 0.003.
const LARGEST_CHANGE: f64 = 1.0 / 128.0;
/// Bits beyond those that should do, for one attempt after the other. Together with the corrections they find a position in 300 of 300 triangles
/// of 2^-46 times the size of frames of heights from 1 to 2^-30 times their length; without corrections in 299 to none of 300, the
/// fewer the thinner the frame.
const MORE_BITS: [i32; 4] = [0, 4, 16, 40];

/// The second and third weight of the middle of a triangle.
const MIDDLE: [f64; 2] = [1.0 / 3.0; 2];

/// Two directions in a projection.
struct Basis([[f64; 2]; 2]);

impl Basis {
    /// The coordinates of a vector; `None` if the directions are as good as parallel.
    fn coordinates(&self, d: [f64; 2]) -> Option<[f64; 2]> {
        let cross = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
        let [e, f] = self.0;
        let det = cross(e, f);
        Some([quotient(cross(d, f), det)?, quotient(cross(e, d), det)?])
    }
}

/// A triangle in a facet, in the projection that drops `axis`; the frame is the facet's.
struct Place<'a> {
    points: &'a Points,
    frame: [u32; 3],
    triangle: [u32; 3],
    axis: usize,
    /// The orientation of the triangle in the projection.
    turn: Sign,
}

impl Place<'_> {
    /// In the projection that shrinks the facet least, of those that keep the triangle.
    fn of(points: &Points, frame: [u32; 3], triangle: [u32; 3]) -> Option<Place<'_>> {
        let [x, y, z] = triangle;
        let [o, a, b] = frame.map(|i| points.xyz(i));
        let normal: [f64; 3] = std::array::from_fn(|axis| {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            ((a[u] - o[u]) * (b[v] - o[v]) - (a[v] - o[v]) * (b[u] - o[u])).abs()
        });
        let mut axes = [0, 1, 2];
        axes.sort_unstable_by(|&i, &j| normal[j].total_cmp(&normal[i]).then(i.cmp(&j)));
        axes.into_iter().find_map(|axis| {
            let turn = points.orient_in_plane(axis, x, y, z);
            (turn != Sign::Zero).then_some(Place { points, frame, triangle, axis, turn })
        })
    }

    fn difference(&self, to: &Located, from: &Located) -> [f64; 2] {
        [1, 2].map(|k| to.minus(from, (self.axis + k) % 3))
    }

    /// The triangle's edges from its first corner.
    fn edges(&self) -> Basis {
        let [x, y, z] = self.points.located(self.triangle);
        Basis([self.difference(&y, &x), self.difference(&z, &x)])
    }

    /// The second and third weight of a place.
    fn weights_of(&self, place: &Located) -> Option<[f64; 2]> {
        let [x, ..] = self.points.located(self.triangle);
        self.edges().coordinates(self.difference(place, &x))
    }

    /// Strictly inside the triangle.
    fn choose(&self, wanted: &[f64; 3]) -> Option<Placed> {
        let wanted = Located { xyz: wanted, implicit: None };
        let weights = inner_weights(self.weights_of(&wanted).unwrap_or(MIDDLE));
        let chosen = self.approach(weights, |chosen| self.contains(&chosen.located()))?;
        let in_doubles = self.in_doubles(&chosen).filter(|doubles| self.contains(&doubles.located()));
        Some(in_doubles.unwrap_or(chosen))
    }

    /// Anywhere in the plane.
    fn choose_near(&self, wanted: &[f64; 3]) -> Option<Placed> {
        let [second, third] = self.weights_of(&Located { xyz: wanted, implicit: None })?;
        let is_near = |chosen: &Placed| {
            let found = self.weights_of(&chosen.located());
            found.is_some_and(|w| (w[0] - second).abs().max((w[1] - third).abs()) <= 2.0 * LARGEST_CHANGE)
        };
        let chosen = self.approach([1.0 - second - third, second, third], is_near)?;
        Some(self.in_doubles(&chosen).unwrap_or(chosen))
    }

    /// Approaches the position with these weights until it is good.
    fn approach(&self, weights: [f64; 3], is_good: impl Fn(&Placed) -> bool) -> Option<Placed> {
        let [o, a, b] = self.points.located(self.frame);
        let [x, ..] = self.points.located(self.triangle);
        let edges = self.edges();
        let axes = Basis([self.difference(&a, &o), self.difference(&b, &o)]);
        let [first, second] = axes.0;
        let steps = [step(edges.coordinates(first)?)?, step(edges.coordinates(second)?)?];
        // From a point to the one with these weights.
        let way = |from: &Located| {
            let (d, [e, f]) = (self.difference(&x, from), edges.0);
            [0, 1].map(|k| d[k] + weights[1] * e[k] + weights[2] * f[k])
        };
        let mut parameters = axes.coordinates(way(&o))?;
        for more in MORE_BITS {
            for (parameter, step) in parameters.iter_mut().zip(steps) {
                let step = power_of_two((step - more).clamp(-1000, 1000));
                *parameter = quotient(*parameter, step)?.round() * step;
            }
            let chosen = self.at(parameters)?;
            if is_good(&chosen) {
                return Some(chosen);
            }
            let correction = axes.coordinates(way(&chosen.located()))?;
            parameters = [0, 1].map(|k| parameters[k] + correction[k]);
        }
        None
    }

    fn at(&self, parameters: [f64; 2]) -> Option<Placed> {
        let (xyz, implicit) = self.points.on_facet(self.frame, parameters)?;
        Some(Placed { xyz, implicit })
    }

    /// The nearest doubles instead, if they lie in the plane themselves.
    fn in_doubles(&self, chosen: &Placed) -> Option<Placed> {
        let [o, a, b] = self.frame.map(|i| self.points.xyz(i));
        let is_in_plane = chosen.implicit.is_some()
            && chosen.xyz.iter().all(|&x| range::in_range(x))
            && orient3d(o, a, b, &chosen.xyz) == Sign::Zero;
        is_in_plane.then_some(Placed { xyz: chosen.xyz, implicit: None })
    }

    /// Whether a point of the facet is strictly inside the triangle.
    fn contains(&self, p: &Located) -> bool {
        let [x, y, z] = self.points.located(self.triangle);
        let left = |from, to| self.points.orient_in_plane_of(self.axis, [from, to, *p]) == self.turn;
        left(x, y) && left(y, z) && left(z, x)
    }
}

/// Weights of a triangle's corners, none of them small, from those of its second and third corner.
fn inner_weights([second, third]: [f64; 2]) -> [f64; 3] {
    let inner = |w: f64| w.clamp(LEAST_WEIGHT, 1.0);
    let weights = [inner(1.0 - second - third), inner(second), inner(third)];
    let sum: f64 = weights.iter().sum();
    weights.map(|w| w / sum)
}

/// The exponent of the largest power of two to whose multiples a parameter may be rounded, from what the weights of the second and third corner change by
/// with it. (Rounding changes a parameter by half of that at most, and there are two.)
fn step([second, third]: [f64; 2]) -> Option<i32> {
    let change = second.abs().max(third.abs()).max((second + third).abs());
    range::highest_exponent(quotient(LARGEST_CHANGE, change)?)
}

impl Points {
    /// Appends a point strictly inside a triangle of a facet: near the wanted doubles as far as that allows, which are projected along
    /// an axis to the facet's plane. The frame `[o, a, b]` gives this plane; the triangle's corners, of any kind, must lie in it. The
    /// point is explicit where doubles in the plane are near enough, otherwise `o + u (a − o) + v (b − o)` with few bits in u and v.
    ///
    /// `None` if the triangle is flat, or so thin or small compared to the frame that no parameters were found. The better the frame's shape
    /// and the nearer its size is to the triangle's, the finer a triangle may be: down to `2^-46` of any frame if both are not thin.
    ///
    /// # Errors
    /// `Internal` unless the frame's points are explicit and not collinear and there is such a triangle in its plane; `OutOfMemory`,
    /// `TooLarge`.
    pub fn push_in_triangle(
        &mut self,
        frame: [u32; 3],
        triangle: [u32; 3],
        wanted: &[f64; 3],
    ) -> Result<Option<u32>, Error> {
        let [o, a, b] = frame;
        let in_plane = |x: u32| (x as usize) < self.len() && self.orient3d(o, a, b, x) == Sign::Zero;
        if !self.is_frame(frame) || !triangle.iter().all(|&x| in_plane(x)) {
            return Err(Error::internal(format_args!("no triangle of the facet {frame:?}: {triangle:?}")));
        }
        let chosen = Place::of(self, frame, triangle).and_then(|place| place.choose(wanted));
        match chosen {
            None => Ok(None),
            Some(Placed { xyz, implicit }) => self.push_rounded(xyz, implicit).map(Some),
        }
    }

    /// A position in the plane of a facet, near the wanted doubles: nearer than a small part of the triangle's size. The triangle, whose
    /// corners must lie in the plane, tells how near, and so how many bits the parameters have; the position may be outside of it.
    ///
    /// `None` if none was found.
    pub fn place_in_plane(&self, frame: [u32; 3], triangle: [u32; 3], wanted: &[f64; 3]) -> Option<Placed> {
        Place::of(self, frame, triangle)?.choose_near(wanted)
    }
}
