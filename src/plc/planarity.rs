//! How far polygons are from planar, for warnings: they are triangulated anyway.
use crate::plc::{Facet, Plc};
use crate::vector::{cross, dot, sub};

/// Corners farther out of plane than this fraction of the facet's extent are worth a warning: coordinates with four significant digits are
/// rounded by less. A lower value would warn of rounding, a higher one hide walls that lean visibly.
pub const NOTABLE: f64 = 1e-3;

/// The corner of a facet that is farthest from the facet's plane, and its distance as a fraction of the facet's extent. The plane is
/// Newell's: its normal is the area vector of the first ring, and it passes through the mean of the ring's corners.
pub fn farthest_corner(plc: &Plc, facet: &Facet) -> Option<(u32, f64)> {
    let ring = facet.polygons.iter().find(|ring| ring.len() >= 3)?;
    let corners = || facet.polygons.iter().flatten();
    let point = |v: &u32| plc.points.get(*v as usize).copied().filter(|p| p.iter().all(|x| x.is_finite()));
    if corners().count() == 3 || corners().any(|v| point(v).is_none()) {
        return None;
    }
    let point = |v: &u32| plc.points.get(*v as usize).copied().unwrap_or_default();
    // Coordinates are relative to the box's centre, in units of its longest side, so that no product overflows.
    let (mut low, mut high) = (point(&ring[0]), point(&ring[0]));
    for p in corners().map(point) {
        low = std::array::from_fn(|i| low[i].min(p[i]));
        high = std::array::from_fn(|i| high[i].max(p[i]));
    }
    let half: [f64; 3] = std::array::from_fn(|i| 0.5 * high[i] - 0.5 * low[i]);
    let size = half.iter().fold(0.0f64, |size, x| size.max(*x));
    if !size.is_normal() {
        return None;
    }
    let unit = |v: &u32| {
        let p = point(v);
        std::array::from_fn::<f64, 3, _>(|i| ((0.5 * p[i] - 0.5 * low[i]) - 0.5 * half[i]) / size)
    };
    let weight = 1.0 / ring.len() as f64;
    let (mut normal, mut middle) = ([0.0; 3], [0.0; 3]);
    for (i, v) in ring.iter().enumerate() {
        let (a, b) = (unit(v), unit(&ring[(i + 1) % ring.len()]));
        let area = cross(&a, &b);
        normal = std::array::from_fn(|k| normal[k] + area[k]);
        middle = std::array::from_fn(|k| middle[k] + weight * a[k]);
    }
    let length = dot(&normal, &normal).sqrt();
    if !length.is_normal() {
        return None;
    }
    let far = |v: &u32| (dot(&normal, &sub(&unit(v), &middle)) / length).abs();
    corners().map(|v| (*v, far(v))).max_by(|x, y| x.1.total_cmp(&y.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(z: f64, scale: f64) -> Option<(u32, f64)> {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, z], [0.0, 1.0, 0.0]];
        let plc = Plc { points: points.map(|p| p.map(|x| x * scale)).to_vec(), ..Plc::default() };
        farthest_corner(&plc, &Facet { polygons: vec![vec![0, 1, 2, 3]], ..Facet::default() })
    }

    #[test]
    fn a_lifted_corner_is_a_quarter_of_it_out_of_plane() {
        assert_eq!(square(0.0, 1.0).map(|x| x.1), Some(0.0));
        for scale in [1.0, 1e-200, 1e200, f64::MAX] {
            let (_, far) = square(0.4, scale).unwrap();
            assert!((far - 0.1).abs() < 0.02, "{far} at {scale}");
        }
        assert_eq!(square(0.4, 0.0), None);
    }
}
