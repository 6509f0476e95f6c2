//! The measures of one tetrahedron.
//!
//! With edges `u`, `v`, `w` from one corner, `det = u · (v × w)` is six times the volume. The dihedral angle θ at an edge of length `l`
//! between the faces opposite corners `k` and `m`, with inner normals `n` as long as twice the faces' areas, has
//! `cos θ = −n_k · n_m / (|n_k| |n_m|)` and `sin θ = det l / (|n_k| |n_m|)`; both are used, so that angles near 0 and 180 degrees are as
//! accurate as others. The circumradius is `|u² (v × w) + v² (w × u) + w² (u × v)| / (2 det)`.
//!
//! Corners are sorted by their coordinates first, which makes the result independent of their order, and scaled by powers of two, so
//! that nothing that matters over- or underflows. Flat tetrahedra, where differences of products cancel, are computed with exact sums: the
//! measures of all others lose at most 20 of their 53 bits.
use crate::elementary::{angle_in_degrees, cube_root, exponent, power_of_two, quotient};
use crate::predicates::{scale, Expansion};
use crate::query::quality::Measure;
use crate::query::EDGE_ENDS;
use crate::vector::{cross, dot, sub};
use crate::TetMesh;

/// Six times the volume over the cube of the size (largest difference of coordinates, rounded down to a power of two): below, sums are
/// exact.
pub(super) const FLAT: f64 = 1.0 / 1_048_576.0;

/// The edge between two corners, as an index into [`EDGE_ENDS`].
const EDGE_BETWEEN: [[usize; 4]; 4] = [[6, 0, 1, 2], [0, 6, 3, 4], [1, 3, 6, 5], [2, 4, 5, 6]];

/// The measures of a tetrahedron. One that is not positive counts as flat.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct TetQuality {
    /// The dihedral angles in degrees at the edges 01 02 03 12 13 23; 0 0 0 180 180 180 if it is not positive.
    pub dihedrals: [f64; 6],
    /// The circumradius over the length of the shortest edge; infinite if it is not positive.
    pub radius_edge: f64,
    /// The mean ratio `12 (3 V)^(2/3) / (sum of the squared edge lengths)`; 0 if it is not positive.
    pub eta: f64,
    /// The volume, with the sign of `det(b − a, c − a, d − a)`. Beyond the range of doubles it is the largest or smallest of them, or zero.
    pub volume: f64,
}

/// A tetrahedron in units of about its own size.
struct Scaled {
    /// From corner to corner, as in [`EDGE_ENDS`].
    edges: [[f64; 3]; 6],
    /// Normals of the faces opposite the corners, as long as twice their areas, all to the inside or all to the outside.
    normals: [[f64; 3]; 4],
    det: f64,
    /// The vector from the first corner to the centre of the circumsphere, times twice `det`.
    to_centre: [f64; 3],
    /// The power of two that is the unit of length.
    unit: i32,
}

impl TetQuality {
    /// Of a tetrahedron that is not positive.
    const NONE: TetQuality = TetQuality {
        dihedrals: [0.0, 0.0, 0.0, 180.0, 180.0, 180.0],
        radius_edge: f64::INFINITY,
        eta: 0.0,
        volume: 0.0,
    };

    /// The measures of the tetrahedron with these corners.
    pub fn of(corners: [[f64; 3]; 4]) -> TetQuality {
        let (places, odd) = order_of(&corners);
        let mut sorted = corners;
        places.iter().zip(&corners).for_each(|(&place, corner)| sorted[place] = *corner);
        let Some(shape) = Scaled::new(&sorted) else { return TetQuality::NONE };
        let det = if odd { -shape.det } else { shape.det };
        let volume = in_units(det / 6.0, 3 * shape.unit);
        if det <= 0.0 {
            return TetQuality { volume, ..TetQuality::NONE };
        }
        let Some(dihedrals) = shape.dihedrals() else { return TetQuality { volume, ..TetQuality::NONE } };
        let dihedrals = EDGE_ENDS.map(|[i, j]| dihedrals[EDGE_BETWEEN[places[i]][places[j]]]);
        TetQuality { dihedrals, radius_edge: shape.radius_edge(), eta: shape.eta(), volume }
    }

    /// The measures of a tetrahedron of a mesh.
    pub fn of_tet(mesh: &TetMesh, tet: &[u32; 4]) -> TetQuality {
        TetQuality::of(corners_of(mesh, tet))
    }

    /// The smallest dihedral angle in degrees.
    pub fn min_dihedral(&self) -> f64 {
        self.dihedrals.iter().fold(180.0, |least, &angle| if angle < least { angle } else { least })
    }

    /// The largest dihedral angle in degrees.
    pub fn max_dihedral(&self) -> f64 {
        self.dihedrals.iter().fold(0.0, |most, &angle| if angle > most { angle } else { most })
    }

    /// One of the measures.
    pub fn by(&self, measure: Measure) -> f64 {
        match measure {
            Measure::MinDihedral => self.min_dihedral(),
            Measure::MaxDihedral => self.max_dihedral(),
            Measure::RadiusEdge => self.radius_edge,
            Measure::Eta => self.eta,
        }
    }

    /// The angle at the edge between two corners (numbers from 0 to 3).
    pub(super) fn at_edge(&self, [i, j]: [usize; 2]) -> f64 {
        self.dihedrals.get(EDGE_BETWEEN[i][j]).copied().unwrap_or(0.0)
    }
}

/// The corners of a tetrahedron of a mesh.
pub(super) fn corners_of(mesh: &TetMesh, tet: &[u32; 4]) -> [[f64; 3]; 4] {
    tet.map(|corner| mesh.points.get(corner as usize).copied().unwrap_or_default())
}

/// The place of each corner in the order of their coordinates, and whether that is an odd permutation.
fn order_of(corners: &[[f64; 3]; 4]) -> ([usize; 4], bool) {
    let mut sorted = [0, 1, 2, 3];
    let mut odd = false;
    for (i, j) in [(0, 1), (2, 3), (0, 2), (1, 3), (1, 2)] {
        let [p, q] = [corners[sorted[i]], corners[sorted[j]]];
        if (0..3)
            .map(|k| p[k].total_cmp(&q[k]))
            .find(|order| order.is_ne())
            .is_some_and(|order| order.is_gt())
        {
            sorted.swap(i, j);
            odd = !odd;
        }
    }
    let mut places = [0; 4];
    sorted.iter().enumerate().for_each(|(place, &corner)| places[corner] = place);
    (places, odd)
}

impl Scaled {
    /// `None` if all corners are equal, or a coordinate is not finite.
    fn new(corners: &[[f64; 3]; 4]) -> Option<Scaled> {
        if !corners.iter().flatten().all(|x| x.is_finite()) {
            return None;
        }
        let (factor, large) = to_one(corners.as_flattened())?;
        let corners = corners.map(|p| p.map(|x| x * factor));
        let between = |[i, j]: [usize; 2]| sub(&corners[j], &corners[i]);
        let edges = EDGE_ENDS.map(between);
        let (factor, size) = to_one(edges.as_flattened())?;
        let edges = edges.map(|e| e.map(|x| x * factor));
        let [u, v, w, vu, wu, _] = &edges;
        let normals = [cross(wu, vu), cross(v, w), cross(w, u), cross(u, v)];
        let [_, vw, wu, uv] = &normals;
        let det = dot(u, vw);
        let unit = large + size;
        if det.abs() < FLAT {
            return Some(Scaled { edges, unit, ..Scaled::exact(&corners.map(|p| p.map(|x| x * factor))) });
        }
        let [uu, vv, ww] = [dot(u, u), dot(v, v), dot(w, w)];
        let to_centre = [0, 1, 2].map(|k| uu * vw[k] + vv * wu[k] + ww * uv[k]);
        Some(Scaled { edges, normals, det, to_centre, unit })
    }

    /// The same with exact sums, each rounded once; `edges` and `unit` are left open.
    #[cold]
    fn exact([a, b, c, d]: &[[f64; 3]; 4]) -> Scaled {
        let minus = |p: &[f64; 3], q: &[f64; 3]| [0, 1, 2].map(|k| Expansion::of_difference(p[k], q[k]));
        let [u, v, w] = [minus(b, a), minus(c, a), minus(d, a)];
        let far = cross_exactly(&minus(d, b), &minus(c, b));
        let [vw, wu, uv] = [cross_exactly(&v, &w), cross_exactly(&w, &u), cross_exactly(&u, &v)];
        let [uu, vv, ww] = [&u, &v, &w].map(|e| dot_exactly(e, e));
        let to_centre = [0, 1, 2].map(|k| {
            uu.product(&vw[k]).sum(&vv.product(&wu[k])).sum(&ww.product(&uv[k])).compressed().nearest()
        });
        let det = dot_exactly(&u, &vw).nearest();
        let normals = [&far, &vw, &wu, &uv].map(|n| [n[0].nearest(), n[1].nearest(), n[2].nearest()]);
        Scaled { edges: [[0.0; 3]; 6], normals, det, to_centre, unit: 0 }
    }

    /// The dihedral angles at the edges; `None` if a face or an edge vanishes in doubles.
    fn dihedrals(&self) -> Option<[f64; 6]> {
        let det = self.det.abs();
        let lengths = self.edges.map(|edge| length(&edge));
        let areas = self.normals.map(|normal| length(&normal));
        let mut units = self.normals;
        for normal in &mut units {
            *normal = unit_vector(normal)?;
        }
        let mut angles = [0.0; 6];
        for (edge, angle) in angles.iter_mut().enumerate() {
            // The faces that meet there are opposite the ends of the opposite edge.
            let [k, m] = EDGE_ENDS[5 - edge];
            // The height of corner k over its face, and that of the same corner over the edge in the other face: their ratio is the
            // sine.
            let rise = quotient(det, areas[k])?;
            let slope = quotient(areas[m], lengths[edge])?;
            *angle = angle_in_degrees(-slope * dot(&units[k], &units[m]), rise);
        }
        Some(angles)
    }

    fn radius_edge(&self) -> f64 {
        let shortest = self.edges.iter().map(length).fold(f64::INFINITY, f64::min);
        let ratio = quotient(length(&self.to_centre), 2.0 * self.det.abs());
        ratio.and_then(|radius| quotient(radius, shortest)).unwrap_or(f64::INFINITY)
    }

    fn eta(&self) -> f64 {
        let squares: f64 = self.edges.iter().map(|e| dot(e, e)).sum();
        let root = cube_root(0.5 * self.det.abs());
        (12.0 * root * root / squares).min(1.0)
    }
}

/// The power of two that brings the largest of these numbers to between 1 and 2, and the exponent of its reciprocal; `None` if all are
/// zero. Numbers at the ends of the range are brought only nearly there, so that the power and its product with others stay in it.
pub(super) fn to_one(numbers: &[f64]) -> Option<(f64, i32)> {
    let largest = numbers.iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
    let exponent = exponent(largest).clamp(-1000, 1022);
    (largest > 0.0).then(|| (power_of_two(-exponent), exponent))
}

/// `x 2^k`; the largest double of its sign if it is beyond the range.
fn in_units(x: f64, k: i32) -> f64 {
    if x != 0.0 && exponent(x.abs()) + k > 1022 {
        return f64::MAX.copysign(x);
    }
    scale(x, k)
}

/// The length of a vector, also if its squares underflow.
pub(super) fn length(v: &[f64; 3]) -> f64 {
    let square = dot(v, v);
    if square > 1e-280 {
        return square.sqrt();
    }
    let Some((factor, exponent)) = to_one(v) else { return 0.0 };
    let v = v.map(|x| x * factor);
    scale(dot(&v, &v).sqrt(), exponent)
}

/// A vector of length one in the same direction; `None` for zero.
fn unit_vector(v: &[f64; 3]) -> Option<[f64; 3]> {
    // Brought to about one first, so that neither its square nor its reciprocal leaves the range.
    let v = match dot(v, v) > 1e-280 {
        true => *v,
        false => {
            let (factor, _) = to_one(v)?;
            v.map(|x| x * factor)
        }
    };
    let reciprocal = 1.0 / dot(&v, &v).sqrt();
    Some(v.map(|x| x * reciprocal))
}

fn dot_exactly(a: &[Expansion; 3], b: &[Expansion; 3]) -> Expansion {
    a[0].product(&b[0]).sum(&a[1].product(&b[1])).sum(&a[2].product(&b[2])).compressed()
}

fn cross_exactly(a: &[Expansion; 3], b: &[Expansion; 3]) -> [Expansion; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i].product(&b[j]).difference(&a[j].product(&b[i])).compressed())
}
