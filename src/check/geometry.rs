//! The coordinates for the checks: the exact positions (input points, and Steiner points as `a + t (b − a)` or
//! `a + t (b − a) + u (c − a)`), and the output doubles.
//!
//! Both are scaled by one power of two into the range in which all signs are exact. Points without parents (in meshes from files) are taken
//! to lie at their doubles.
use crate::error::{Defect, DefectKind, Element, Error, Status};
use crate::fallible;
use crate::output::TetMesh;
use crate::plc::lift::lifts;
use crate::plc::Plc;
use crate::predicates;
use crate::predicates::{Expansion, Points, Sign};
use crate::INVALID;
use std::cmp::Ordering;

/// Coordinates of all vertices of the mesh.
pub(super) struct Geometry {
    exact: Points,
    rounded: Vec<[f64; 3]>,
    inputs: usize,
}

impl Geometry {
    /// The coordinates of a mesh whose indices and finiteness have been checked. Steiner points must be given for all points beyond the
    /// input's, or for none.
    pub(super) fn new(plc: &Plc, mesh: &TetMesh, alias: &[u32]) -> Result<Self, Error> {
        let k = predicates::range_scale(&mesh.points).map_err(|i| out_of_range(mesh, i))?;
        let rounded = fallible::collect(mesh.points.iter().map(|p| p.map(|x| predicates::scale(x, k))))?;
        let explicit = mesh.points.len() - mesh.steiner.len();
        let mut xyz = fallible::reserved(mesh.points.len())?;
        fallible::append(&mut xyz, &rounded[..explicit])?;
        let mut exact = Points::new(xyz);
        for ((s, t), at) in mesh.steiner.iter().zip(parameters(mesh)).zip(&rounded[explicit..]) {
            match s.ends {
                [INVALID, INVALID] => exact.push(*at)?,
                [o, a] if s.third != INVALID => exact.push_on_facet([o, a, s.third], [s.t, s.u])?,
                [a, b] => exact.push_on_segment(a, b, &t)?,
            };
        }
        if !plc.lift.is_plain() {
            let mut lift = plc.lift.try_clone()?;
            lift.merge(alias);
            exact.lift(lifts(&lift, 0..mesh.points.len() as u32, k, &mesh.points)?);
        }
        Ok(Geometry { exact, rounded, inputs: plc.points.len() })
    }

    /// Whether the output doubles are the exact position.
    pub(super) fn is_exact(&self, v: u32) -> bool {
        (v as usize) < self.inputs
            || self.exact.is_explicit(v) && *self.exact.xyz(v) == self.rounded[v as usize]
    }

    /// The doubles nearest to the exact position (scaled).
    pub(super) fn nearest(&self, v: u32) -> &[f64; 3] {
        self.exact.xyz(v)
    }

    /// The orientation of the exact positions.
    pub(super) fn orient3d(&self, [a, b, c, d]: [u32; 4]) -> Sign {
        self.exact.orient3d(a, b, c, d)
    }

    /// The orientation of the output doubles.
    pub(super) fn orient3d_rounded(&self, tet: [u32; 4]) -> Sign {
        let [a, b, c, d] = tet.map(|v| &self.rounded[v as usize]);
        predicates::orient3d(a, b, c, d)
    }

    /// Positive when `e` is inside the circumsphere of the positive tetrahedron, or its power with respect to the tetrahedron's weighted
    /// points is negative; exact positions.
    pub(super) fn in_conflict(&self, tet: [u32; 4], e: u32) -> Sign {
        self.exact.power(tet, e)
    }

    /// The orientation of a triangle projected along `axis`; exact positions.
    pub(super) fn orient_in_plane(&self, axis: usize, [a, b, c]: [u32; 3]) -> Sign {
        self.exact.orient_in_plane(axis, a, b, c)
    }

    /// Whether three exact positions lie on one line.
    pub(super) fn collinear(&self, [a, b, c]: [u32; 3]) -> bool {
        self.exact.collinear(a, b, c)
    }

    /// The order of two points of the line `ab` in the direction from `a` to `b`; exact positions.
    pub(super) fn compare_along(&self, [a, b]: [u32; 2], v: u32, w: u32) -> Ordering {
        let order = self.exact.compare_lex(v, w);
        if self.exact.compare_lex(a, b) == Ordering::Greater {
            order.reverse()
        } else {
            order
        }
    }

    /// Whether `v` lies on the open segment `ab`; exact positions.
    pub(super) fn strictly_between(&self, v: u32, a: u32, b: u32) -> bool {
        if v == a || v == b || !self.exact.collinear(a, b, v) {
            return false;
        }
        let (before, after) = (self.exact.compare_lex(a, v), self.exact.compare_lex(v, b));
        before == after && before != Ordering::Equal
    }
}

/// The exact parameters of the Steiner points, whose terms must be sorted.
pub(super) fn parameters(mesh: &TetMesh) -> impl Iterator<Item = Expansion> + '_ {
    let mut next = 0;
    mesh.steiner.iter().enumerate().map(move |(i, s)| {
        let mut t = Expansion::from(s.t);
        while next < mesh.steiner_terms.len() && mesh.steiner_terms[next].steiner as usize == i {
            t = t.sum(&Expansion::from(mesh.steiner_terms[next].value));
            next += 1;
        }
        t.compressed()
    })
}

fn out_of_range(mesh: &TetMesh, i: usize) -> Error {
    let defect = Defect {
        kind: DefectKind::CoordinateRange,
        first: Element::Point(i as u32),
        second: None,
        point: mesh.points.get(i).copied(),
    };
    Error::with_defect(Status::CoordinateRange, "the coordinates span too many orders of magnitude", defect)
}
