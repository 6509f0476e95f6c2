//! The smallest displacement that lifts a point off the planes it is too close to.
//!
//! Near a Steiner point the positions that keep its star positive form a wedge between almost parallel planes. Its corner is
//! found by trying all sets of up to three planes as active (a linear program in three variables, Seidel 1991 would be
//! the large-scale way). Everything here is approximate: the caller tests the result exactly.

use crate::vector::{cross, dot};

/// A plane, given by its unit normal into the allowed side and the signed distance of the point.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// Unit normal.
    pub normal: [f64; 3],
    /// Signed distance of the point.
    pub height: f64,
}

/// Most planes considered: there are n³/6 corners to try. 12 and 48 change nothing on the only model measured whose points have to move.
pub const MOST: usize = 24;

/// For unit normals, far below the rounding errors of products that are zero: smaller values are meaningless as divisors. None of the
/// models measured reaches it.
const PARALLEL: f64 = 1e-60;

/// The shortest `d` with `height + normal · d >= margin` for all planes, if a corner of up to three planes gives one.
pub fn escape(planes: &[Plane], margin: f64) -> Option<[f64; 3]> {
    let planes = &planes[..planes.len().min(MOST)];
    let mut best: Option<([f64; 3], f64)> = None;
    let mut consider = |d: [f64; 3]| {
        let size = dot(&d, &d);
        let holds = planes.iter().all(|p| p.height + dot(&p.normal, &d) >= 0.5 * margin);
        if holds && best.as_ref().is_none_or(|b| size < b.1) {
            best = Some((d, size));
        }
    };
    let lack = |p: &Plane| margin - p.height;
    for (i, p) in planes.iter().enumerate() {
        consider(p.normal.map(|x| x * lack(p)));
        for (j, q) in planes[..i].iter().enumerate() {
            // The point of the line of both planes that is nearest.
            let line = cross(&p.normal, &q.normal);
            let size = dot(&line, &line);
            let (u, v) = (cross(&q.normal, &line), cross(&line, &p.normal));
            // Parallel planes have none.
            if size >= PARALLEL {
                consider(std::array::from_fn(|k| (u[k] * lack(p) + v[k] * lack(q)) / size));
            }
            for r in &planes[..j] {
                let volume = dot(&line, &r.normal);
                let (u, v) = (cross(&q.normal, &r.normal), cross(&r.normal, &p.normal));
                if volume.abs() >= PARALLEL {
                    consider(std::array::from_fn(|k| {
                        (u[k] * lack(p) + v[k] * lack(q) + line[k] * lack(r)) / volume
                    }));
                }
            }
        }
    }
    best.map(|b| b.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes_from_a_thin_wedge() {
        // Two planes at an angle of 10⁻³ with the allowed side between them, towards +x.
        let tilt = 1e-3f64;
        let planes = [
            Plane { normal: [0.0, 0.0, 1.0], height: -1e-15 },
            Plane { normal: [tilt.sin(), 0.0, -tilt.cos()], height: 0.0 },
        ];
        let d = escape(&planes, 1e-14).unwrap();
        for p in &planes {
            assert!(p.height + dot(&p.normal, &d) > 0.0);
        }
        assert!(d[0] > 0.0 && dot(&d, &d).sqrt() < 1e-10);
        assert_eq!(escape(&[planes[0], Plane { normal: [0.0, 0.0, -1.0], height: 0.0 }], 1e-14), None);
    }
}
