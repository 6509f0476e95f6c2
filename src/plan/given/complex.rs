//! Given tetrahedra as a complex: what is across each face and around each edge, by exact signs.
//!
//! In order, and each only if the one before has found nothing: indices; no tetrahedron is flat, and all are turned positive; a face belongs
//! to at most two, on opposite sides of it; around an edge nothing overlaps ([`fans`]). So tetrahedra with a common edge do not overlap.
//! Those without one may: finding that takes more than local tests.
//!
//! Equal points are one, as everywhere: the first of them.
use crate::control::Control;
use crate::error::{DefectKind, Element, Error, Status};
use crate::fallible;
use crate::kernel::given::{Beside, Given};
use crate::kernel::tables::FACE;
use crate::kernel::{face_key, Mesh, MAX_TETS, NONE};
use crate::plan::given::fans;
use crate::plan::given::faults::Faults;
use crate::plc::duplicates::first_equal;
use crate::predicates::{range_scale, scale, Points, Sign};

/// A face of a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    /// Its corners in ascending order.
    pub(super) key: [u32; 3],
    /// Its corner code.
    pub(super) code: u32,
}

/// A valid complex.
pub(super) struct Complex {
    /// All points, scaled.
    pub(super) points: Points,
    /// The coordinates are the caller's times two to this power.
    pub(super) exponent: i32,
    /// The first point equal to each.
    pub(super) alias: Vec<u32>,
    /// The tetrahedra, positive, in the given order.
    pub(super) tets: Vec<[u32; 4]>,
    /// The corner code beyond each face; `NONE` at the boundary.
    pub(super) across: Vec<[u32; 4]>,
    /// What is beyond boundary faces.
    pub(super) beside: Vec<Beside>,
    /// All faces of tetrahedra, sorted.
    pub(super) sides: Vec<Side>,
}

const NO_MESH: &str = "these tetrahedra are no mesh";

impl Complex {
    /// Checks and connects tetrahedra.
    ///
    /// # Errors
    /// `NonFinitePoint`, `CoordinateRange`, `IndexOutOfRange`, `TooLarge`; `InvalidArgument` without tetrahedra; `CheckFailed` for what is
    /// no mesh; `OutOfMemory`, and what ends the run.
    pub(super) fn new(
        given: &[[f64; 3]],
        tets: &[[u32; 4]],
        most: usize,
        control: &Control,
    ) -> Result<Complex, Error> {
        if tets.is_empty() {
            return Err(Error::new(Status::InvalidArgument, "the mesh has no tetrahedra"));
        }
        if given.len() >= MAX_TETS || tets.len() >= MAX_TETS / 2 {
            return Err(Error::new(
                Status::TooLarge,
                "the mesh has more points or tetrahedra than can be numbered",
            ));
        }
        check_numbers(given, tets, most, control)?;
        let exponent = range_scale(given).map_err(|i| {
            Error::new(
                Status::CoordinateRange,
                format_args!("point {i} is out of range: the coordinates span too many orders of magnitude"),
            )
        })?;
        control.room(size_of_val(given) + size_of_val(tets) * 6)?;
        let alias = first_equal(given, control)?;
        let points = Points::new(fallible::collect(given.iter().map(|p| p.map(|x| scale(x, exponent))))?);
        let tets = turned(given, tets, &points, &alias, most, control)?;
        let (sides, across) = faces(given, &tets, most, control)?;
        let mut faults = Faults::new(given, most);
        let beside = fans::fans(&points, &tets, &across, &mut faults, control)?;
        faults.finish(Status::CheckFailed, NO_MESH)?;
        Ok(Complex { points, exponent, alias, tets, across, beside, sides })
    }

    /// The mesh of the complex.
    pub(super) fn mesh(&self, control: &Control) -> Result<Mesh, Error> {
        let given = Given { tets: &self.tets, across: &self.across, beside: &self.beside };
        Mesh::of_domain(given, self.points.len(), control)
    }

    /// The corners of a face, seen from the opposite corner as in the kernel.
    pub(super) fn face(&self, code: u32) -> [u32; 3] {
        corners(&self.tets, code)
    }

    /// A corner code of a face, if it is one.
    pub(super) fn find(&self, face: [u32; 3]) -> Option<u32> {
        let key = face_key(face.map(|v| self.alias.get(v as usize).copied().unwrap_or(NONE)));
        let at = self.sides.partition_point(|side| side.key < key);
        self.sides.get(at).filter(|side| side.key == key).map(|side| side.code)
    }
}

fn corners(tets: &[[u32; 4]], code: u32) -> [u32; 3] {
    let tet = tets[(code >> 2) as usize];
    FACE[(code & 3) as usize].map(|k| tet[k as usize])
}

/// Refuses what is no number, and no point.
fn check_numbers(
    points: &[[f64; 3]],
    tets: &[[u32; 4]],
    most: usize,
    control: &Control,
) -> Result<(), Error> {
    let mut faults = Faults::new(points, most);
    for (v, p) in (0..).zip(points) {
        if p.iter().any(|x| !x.is_finite()) {
            faults.add(DefectKind::NonFinite, Element::Point(v), None, v);
        }
    }
    faults.finish(Status::NonFinitePoint, "a coordinate is NaN or infinite")?;
    control.look()?;
    let mut faults = Faults::new(points, most);
    for (t, tet) in (0..).zip(tets) {
        if let Some(&v) = tet.iter().find(|&&v| v as usize >= points.len()) {
            faults.add(DefectKind::IndexOutOfRange, Element::Tet(t), Some(Element::Point(v)), v);
        }
    }
    faults.finish(Status::IndexOutOfRange, "a tetrahedron has a corner that is no point")
}

/// The tetrahedra by the first of equal points, turned positive.
fn turned(
    given: &[[f64; 3]],
    tets: &[[u32; 4]],
    points: &Points,
    alias: &[u32],
    most: usize,
    control: &Control,
) -> Result<Vec<[u32; 4]>, Error> {
    let mut faults = Faults::new(given, most);
    let mut out = fallible::reserved(tets.len())?;
    for (t, tet) in (0..).zip(tets) {
        control.step()?;
        let [a, b, c, d] = tet.map(|v| alias[v as usize]);
        let repeated = a == b || a == c || a == d || b == c || b == d || c == d;
        let sign = if repeated { Sign::Zero } else { points.orient3d(a, b, c, d) };
        match sign {
            Sign::Positive => fallible::push(&mut out, [a, b, c, d])?,
            Sign::Negative => fallible::push(&mut out, [a, b, d, c])?,
            Sign::Zero => faults.add(DefectKind::NotPositive, Element::Tet(t), None, a),
        }
    }
    faults.finish(Status::CheckFailed, "a tetrahedron is flat")?;
    Ok(out)
}

/// All faces, sorted, and what is across each.
fn faces(
    given: &[[f64; 3]],
    tets: &[[u32; 4]],
    most: usize,
    control: &Control,
) -> Result<(Vec<Side>, Vec<[u32; 4]>), Error> {
    control.room(tets.len() * (4 * size_of::<Side>() + size_of::<[u32; 4]>()))?;
    let mut sides: Vec<Side> = fallible::reserved(4 * tets.len())?;
    for code in 0..4 * tets.len() as u32 {
        fallible::push(&mut sides, Side { key: face_key(corners(tets, code)), code })?;
    }
    control.sort(&mut sides)?;
    let mut across = fallible::filled([NONE; 4], tets.len())?;
    let mut faults = Faults::new(given, most);
    for run in sides.chunk_by(|x, y| x.key == y.key) {
        control.step()?;
        let [first, rest @ ..] = run else { continue };
        match rest {
            [] => {}
            // Positive tetrahedra on opposite sides see the face turn in opposite ways.
            [other] if is_odd(corners(tets, first.code)) != is_odd(corners(tets, other.code)) => {
                across[(first.code >> 2) as usize][(first.code & 3) as usize] = other.code;
                across[(other.code >> 2) as usize][(other.code & 3) as usize] = first.code;
            }
            _ => {
                for other in rest {
                    let second = Some(Element::Tet(other.code >> 2));
                    let kind = DefectKind::NotConforming;
                    faults.add(kind, Element::Tet(first.code >> 2), second, first.key[0]);
                }
            }
        }
    }
    faults.finish(Status::CheckFailed, NO_MESH)?;
    Ok((sides, across))
}

/// Whether it takes an odd number of exchanges to sort three different corners.
pub(super) fn is_odd([a, b, c]: [u32; 3]) -> bool {
    (a > b) ^ (b > c) ^ (a > c)
}
