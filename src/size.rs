//! The size field: which edge length is wanted where.
//!
//! There are two fields. The surface's *own*: each of its vertices wants the mean length of its walls' edges, and what hangs on no wall
//! wants what is around it. And what is *wished*: lengths at points, on facets and segments, in regions, by a function, or one for all. Both
//! are graded, |h(x) − h(y)| <= g |x − y|: on vertices by one pass from the smallest outwards over the edges of the mesh (Dijkstra 1959),
//! elsewhere as the lower envelope of the cones of the vertices around. (Not linear in the tetrahedron: a tetrahedron between two far sides
//! of a coarse mesh would never see that sizes grow inwards.)
//!
//! The smaller of the two counts, also next to a kept surface that is coarser: that no apex comes too near to a large triangle is what filling
//! itself looks after. (Letting sizes fall inwards by the slope left 968 tetrahedra above the bound of one size on the clean models of
//! `quality_figures.py`, and a smallest angle of 9.9°; now they are 25, and it is 12.9°.)
//!
//! A function is asked at vertices and at places inside; since a vertex keeps what was wanted there, its growth is bounded from where it has been
//! asked. A small spot of it between those places is seen once sizes around it are about as small.
//!
//! All of this is floating-point arithmetic: it chooses points and decides nothing.
use crate::control::Control;
use crate::elementary::{self, quotient};
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::{Mesh, GHOST, NONE};
use crate::options::SizeFunction;
use crate::predicates::{scale, Points};
use crate::vector::{cross, dot, sub};
use rustc_hash::FxHashSet;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// What is wished, in the engine's lengths.
#[derive(Debug, Default)]
pub struct Given<'a> {
    /// The largest edge length anywhere.
    pub length: Option<f64>,
    /// That of each region.
    pub of_region: Vec<Option<f64>>,
    /// That of vertices, infinite where there is none; may be shorter than the list of vertices.
    pub at_vertices: Vec<f64>,
    /// A function of the caller's coordinates.
    pub function: Option<&'a SizeFunction>,
    /// The engine's coordinates are the caller's times two to this power.
    pub exponent: i32,
}

impl Given<'_> {
    /// The largest length at a place of a region, as far as places and regions tell.
    fn at(&self, at: &[f64; 3], region: u32) -> Result<f64, Error> {
        let own = self.of_region.get(region as usize).copied().flatten();
        let least = own.into_iter().chain(self.length).fold(f64::INFINITY, f64::min);
        match self.function {
            None => Ok(least),
            Some(function) => {
                let wanted = function.at(at.map(|x| scale(x, -self.exponent)))?;
                Ok(least.min(scaled(wanted, self.exponent)))
            }
        }
    }
}

/// Wanted edge lengths.
#[derive(Debug)]
pub struct Size<'a> {
    /// By vertex, of the surface; infinite for what is no vertex of the mesh.
    own: Vec<f64>,
    /// By vertex, what is wished; empty if nothing is wished at vertices.
    wished: Vec<f64>,
    grading: f64,
    given: Given<'a>,
}

impl<'a> Size<'a> {
    /// The sizes that the surface of a mesh states, and what is given; `isolated` are edges on no facet that count as its edges do.
    ///
    /// # Errors
    /// `OutOfMemory`, what the size function returns, and what ends the run.
    pub fn new(
        mesh: &Mesh,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        mut given: Given<'a>,
        grading: f64,
        control: &Control,
    ) -> Result<Size<'a>, Error> {
        let own = of_surface(mesh, points, isolated, control)?;
        let mut wished = std::mem::take(&mut given.at_vertices);
        if given.function.is_some() {
            fallible::resize(&mut wished, points.len(), f64::INFINITY)?;
            for (v, wish) in (0u32..).zip(&mut wished) {
                control.step()?;
                if mesh.vertex_tet.get(v as usize).is_some_and(|&t| t != NONE) {
                    *wish = wish.min(given.at(points.xyz(v), NONE)?);
                }
            }
        }
        let mut size = Size { own, wished, grading, given };
        graded(&mut size.own, mesh, points, grading, control)?;
        graded(&mut size.wished, mesh, points, grading, control)?;
        Ok(size)
    }

    /// Notes what is wanted at a new vertex.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn set(&mut self, v: u32, wanted: Wanted) -> Result<(), Error> {
        let count = v as usize + 1;
        if self.own.len() < count {
            fallible::resize(&mut self.own, count, f64::INFINITY)?;
        }
        self.own[v as usize] = wanted.length;
        if wanted.wish.is_finite() || !self.wished.is_empty() {
            if self.wished.len() < count {
                fallible::resize(&mut self.wished, count, f64::INFINITY)?;
            }
            self.wished[v as usize] = wanted.wish;
        }
        Ok(())
    }

    /// The same for some vertices, numbered anew.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn part(&self, vertices: &[u32]) -> Result<Size<'a>, Error> {
        let of = |list: &[f64]| fallible::collect(vertices.iter().map(|&v| at_vertex(list, v)));
        let Given { length, function, exponent, .. } = self.given;
        Ok(Size {
            own: of(&self.own)?,
            wished: if self.wished.is_empty() { Vec::new() } else { of(&self.wished)? },
            grading: self.grading,
            given: Given {
                length,
                of_region: fallible::copied(&self.given.of_region)?,
                at_vertices: Vec::new(),
                function,
                exponent,
            },
        })
    }

    /// What is noted of a vertex.
    pub fn noted(&self, v: u32) -> Wanted {
        Wanted { length: self.of(v), wish: at_vertex(&self.wished, v) }
    }

    /// Whether a function of the caller is asked.
    pub fn has_function(&self) -> bool {
        self.given.function.is_some()
    }

    /// The length of the surface at a vertex; infinite where it states none.
    pub fn of(&self, v: u32) -> f64 {
        at_vertex(&self.own, v)
    }

    /// What is wanted at a place of a region that has these vertices around it.
    ///
    /// # Errors
    /// What the size function returns.
    pub fn at(&self, points: &Points, at: &[f64; 3], region: u32, around: &[u32]) -> Result<Wanted, Error> {
        let mut most = f64::INFINITY;
        let mut wish = self.given.at(at, region)?;
        for &v in around {
            let (own, far) = (self.of(v), self.grading * distance(points.xyz(v), at));
            most = most.min(own + far);
            wish = wish.min(at_vertex(&self.wished, v) + far);
        }
        Ok(Wanted { length: most.min(wish), wish })
    }
}

/// What is wanted at a place.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// The edge length.
    pub length: f64,
    /// What is wished there, without regard to the surface; infinite if nothing is.
    pub wish: f64,
}

fn at_vertex(list: &[f64], v: u32) -> f64 {
    list.get(v as usize).copied().unwrap_or(f64::INFINITY)
}

/// The mean length of the walls' edges, by vertex; infinite where there is none.
fn of_surface(
    mesh: &Mesh,
    points: &Points,
    isolated: &FxHashSet<[u32; 2]>,
    control: &Control,
) -> Result<Vec<f64>, Error> {
    let mut sums = fallible::filled((0.0, 0.0), points.len())?;
    let mut add = |[a, b]: [u32; 2]| {
        let length = distance(points.xyz(a), points.xyz(b));
        for v in [a, b] {
            let (sum, count) = &mut sums[v as usize];
            *sum += length;
            *count += 1.0;
        }
    };
    for t in mesh.all().filter(|&t| mesh.is_live(t)) {
        control.step()?;
        for code in (4 * t..4 * t + 4).filter(|&code| code < mesh.across(code) && mesh.is_wall(code)) {
            let [a, b, c] = mesh.face(code);
            // Each edge of a closed surface comes twice.
            [[a, b], [b, c], [c, a]].into_iter().for_each(&mut add);
        }
    }
    let mut edges = fallible::collect(isolated.iter().copied())?;
    control.sort(&mut edges)?;
    edges.into_iter().for_each(&mut add);
    // Vectors divide before they choose: 0 / 0 would trap where the caller traps it.
    let mean = |&(sum, count): &(f64, f64)| if count > 0.0 { sum / count.max(1.0) } else { f64::INFINITY };
    Ok(fallible::collect(sums.iter().map(mean))?)
}

/// Lowers what is too large for its neighbours, the smallest first.
///
/// # Errors
/// `OutOfMemory`, and what ends the run.
pub fn graded(
    sizes: &mut [f64],
    mesh: &Mesh,
    points: &Points,
    grading: f64,
    control: &Control,
) -> Result<(), Error> {
    let mut queue: BinaryHeap<Reverse<(u64, u32)>> = BinaryHeap::new();
    // Lengths are positive: their bits are in their order.
    for (v, size) in (0u32..).zip(&*sizes).filter(|x| x.1.is_finite()) {
        fallible::push_heap(&mut queue, Reverse((size.to_bits(), v)))?;
    }
    let mut search = StarSearch::default();
    while let Some(Reverse((bits, v))) = queue.pop() {
        let (size, start) = (f64::from_bits(bits), mesh.vertex_tet.get(v as usize).copied());
        let Some(start) = start.filter(|&t| t != NONE && size <= sizes[v as usize]) else { continue };
        search.vertex_star(mesh, v, start)?;
        control.worked(search.tets.len());
        control.step()?;
        for w in search.tets.iter().flat_map(|&t| mesh.verts(t)).filter(|&w| w != GHOST && w != v) {
            let Some(other) = sizes.get_mut(w as usize) else { continue };
            let most = size + grading * distance(points.xyz(v), points.xyz(w));
            if most < *other {
                *other = most;
                fallible::push_heap(&mut queue, Reverse((most.to_bits(), w)))?;
            }
        }
    }
    Ok(())
}

/// The largest volumes, in the engine's lengths, and the edges of regular tetrahedra of these volumes.
#[derive(Debug, Default)]
pub struct Bounds {
    /// Anywhere.
    pub all: Option<f64>,
    /// In each region.
    pub of_region: Vec<Option<f64>>,
}

/// What is wanted is below two to this power, so sums of a few do not overflow. Coordinates are far below.
const LARGEST_EXPONENT: i32 = 1000;
/// Rounding of the caller's own calculation of a volume or area stays below this.
pub const BELOW: f64 = 1.0 - 1e-9;

impl Bounds {
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.all.is_none() && self.of_region.iter().all(Option::is_none)
    }

    /// That of a region; infinite if there is none.
    pub fn of(&self, region: u32) -> f64 {
        let own = self.of_region.get(region as usize).copied().flatten();
        BELOW * own.into_iter().chain(self.all).fold(f64::INFINITY, f64::min)
    }

    /// How many times its bound a tetrahedron is.
    pub fn excess(&self, mesh: &Mesh, points: &Points, t: u32) -> f64 {
        let volume = volume(mesh.verts(t).map(|v| points.xyz(v)));
        quotient(volume, self.of(mesh.region(t))).unwrap_or(f64::INFINITY)
    }
}

/// A length or volume that is wanted, times two to this power; infinite, which asks for nothing, where that would overflow.
pub fn scaled(wanted: f64, exponent: i32) -> f64 {
    if elementary::exponent(wanted).saturating_add(exponent) > LARGEST_EXPONENT {
        return f64::INFINITY;
    }
    scale(wanted, exponent)
}

/// Of a tetrahedron.
pub fn volume([o, p, q, r]: [&[f64; 3]; 4]) -> f64 {
    dot(&sub(p, o), &cross(&sub(q, o), &sub(r, o))) / 6.0
}

/// The distance of two points.
pub fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let d = sub(a, b);
    dot(&d, &d).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan of tetrahedra along a line: two corners of each are on the line's next lattice points.
    fn strip(lengths: &[f64]) -> (Mesh, Points) {
        let mut xyz = vec![[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut x = 0.0;
        for step in lengths.iter().chain(&[0.0]) {
            xyz.push([x, 0.0, 0.0]);
            x += step;
        }
        let tets: Vec<[u32; 4]> = (0..lengths.len() as u32).map(|i| [2 + i, 3 + i, 0, 1]).collect();
        let mesh = Mesh::of_tetrahedra(&tets, xyz.len()).unwrap();
        (mesh, Points::new(xyz))
    }

    #[test]
    fn neighbours_differ_by_the_slope_at_most() {
        let (mesh, points) = strip(&[0.01, 0.02, 0.5, 3.0, 9.0]);
        let none = FxHashSet::default();
        let size = Size::new(&mesh, &points, &none, Given::default(), 0.3, &Control::free()).unwrap();
        for t in mesh.all().filter(|&t| !mesh.is_ghost(t)) {
            for (v, w) in mesh.verts(t).into_iter().flat_map(|v| mesh.verts(t).map(|w| (v, w))) {
                let most = 0.3 * distance(points.xyz(v), points.xyz(w)) + 1e-12;
                assert!((size.of(v) - size.of(w)).abs() <= most, "{v} {w}");
            }
        }
        assert!((0..points.len() as u32).all(|v| size.of(v) > 0.0));
    }

    #[test]
    fn the_smallest_length_counts() {
        let (mesh, points) = strip(&[1.0, 1.0]);
        let none = FxHashSet::default();
        let given = Given { length: Some(0.25), of_region: vec![None, Some(0.125)], ..Given::default() };
        let size = Size::new(&mesh, &points, &none, given, 0.3, &Control::free()).unwrap();
        let far = [0.0, 50.0, 50.0];
        let at = |at, region, around: &[u32]| size.at(&points, at, region, around).unwrap().length;
        assert_eq!(at(&far, 0, &[0, 1, 2, 3, 4]), 0.25);
        assert_eq!(at(&far, 1, &[0, 1, 2, 3, 4]), 0.125);
        assert_eq!(at(points.xyz(3), 0, &[3]), 0.25);
        let given = Given { length: Some(9.0), ..Given::default() };
        let size = Size::new(&mesh, &points, &none, given, 0.3, &Control::free()).unwrap();
        assert_eq!(size.at(&points, points.xyz(3), 0, &[3]).unwrap().length, size.of(3));
    }

    #[test]
    fn wishes_at_vertices_are_graded_and_a_function_is_asked() {
        let (mesh, points) = strip(&[1.0, 1.0, 1.0]);
        let none = FxHashSet::default();
        let mut at_vertices = vec![f64::INFINITY; points.len()];
        at_vertices[2] = 0.01;
        let given = Given { at_vertices, ..Given::default() };
        let size = Size::new(&mesh, &points, &none, given, 0.5, &Control::free()).unwrap();
        let wish = |v: u32| size.at(&points, points.xyz(v), NONE, &[v]).unwrap().wish;
        // The points of the strip are one apart.
        assert_eq!([wish(2), wish(3), wish(4)], [0.01, 0.51, 1.01]);
        let function = SizeFunction::new(|[x, _, _]| Ok(if x < 1.5 { 0.125 } else { f64::INFINITY }));
        let given = Given { function: Some(&function), exponent: 1, ..Given::default() };
        let size = Size::new(&mesh, &points, &none, given, 0.5, &Control::free()).unwrap();
        // The engine's coordinates are twice the caller's here.
        let wish = |x: f64| size.at(&points, &[x, 9.0, 9.0], NONE, &[]).unwrap().wish;
        assert_eq!([wish(2.9), wish(3.1)], [0.25, f64::INFINITY]);
        let fails = SizeFunction::new(|_| Ok(f64::NAN));
        let given = Given { function: Some(&fails), ..Given::default() };
        assert!(Size::new(&mesh, &points, &none, given, 0.5, &Control::free()).is_err());
    }
}
