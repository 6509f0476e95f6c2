//! The element of the surface nearest to a point: only for messages, in floating-point arithmetic.
use crate::control::Control;
use crate::error::{Element, Error};
use crate::plc::surface::Surface;
use crate::vector::{cross, dot, sub};
use crate::INVALID;

/// The element that a point belongs to, which does not count as near.
#[derive(Clone, Copy, Debug)]
pub enum Home {
    /// The edge between two points.
    Edge([u32; 2]),
    /// A facet.
    Facet(u32),
}

impl Surface {
    /// The element that a segment of the surface belongs to: an input segment, or a facet with this edge.
    pub fn element_of_edge(&self, [a, b]: [u32; 2]) -> Element {
        let key = [a.min(b), a.max(b)];
        let parent = self.segments.binary_search(&key).map_or(INVALID, |s| self.segment_parent[s]);
        let facet = || self.triangles.iter().position(|t| t.contains(&a) && t.contains(&b));
        match (parent, parent == INVALID) {
            (_, true) => facet().map_or(Element::Point(a), |t| Element::Facet(self.triangle_facet[t])),
            (parent, false) => Element::Segment(parent),
        }
    }

    /// The facet, segment or point nearest to a point, other than its home or a part of that; `None` if there is none.
    ///
    /// # Errors
    /// What ends the run.
    pub fn nearest_element(
        &self,
        at: &[f64; 3],
        home: Home,
        control: &Control,
    ) -> Result<Option<Element>, Error> {
        let corner = |v: u32| &self.points[v as usize];
        let mut best: Option<(f64, Element)> = None;
        let mut consider = |distance: f64, element: Element| {
            if best.is_none_or(|b| distance < b.0) {
                best = Some((distance, element));
            }
        };
        let own_triangle = |t: usize| match home {
            Home::Edge(ends) => ends.iter().all(|v| self.triangles[t].contains(v)),
            Home::Facet(facet) => self.triangle_facet[t] == facet,
        };
        // An edge may come too close to another element anywhere along it, while the point lies elsewhere on it.
        let apart = |others: &[u32]| match home {
            Home::Edge(ends) if !others.iter().any(|v| ends.contains(v)) => Some(ends.map(|v| *corner(v))),
            _ => None,
        };
        let patch = match home {
            Home::Facet(facet) => self.triangle_facet.iter().position(|&f| f == facet),
            Home::Edge(_) => None,
        };
        let patch = patch.map(|t| self.triangle_patch[t]);
        for (t, corners) in self.triangles.iter().enumerate() {
            control.step()?;
            if !own_triangle(t) && Some(self.triangle_patch[t]) != patch {
                let triangle = corners.map(|v| *corner(v));
                let mut distance = to_triangle(at, triangle);
                if let Some([a, b]) = apart(corners) {
                    let [x, y, z] = triangle;
                    distance = distance.min(to_triangle(&a, triangle)).min(to_triangle(&b, triangle));
                    for other in [[x, y], [y, z], [z, x]] {
                        distance = distance.min(between_edges([a, b], other));
                    }
                }
                consider(distance, Element::Facet(self.triangle_facet[t]));
            }
        }
        let own_point = |v: u32| match home {
            Home::Edge(ends) => ends.contains(&v),
            Home::Facet(facet) => {
                let mut triangles = self.triangles.iter().zip(&self.triangle_facet);
                triangles.any(|(t, &f)| f == facet && t.contains(&v))
            }
        };
        let own_edge = |ends: [u32; 2]| ends.iter().all(|&v| own_point(v));
        for (&ends, &parent) in self.segments.iter().zip(&self.segment_parent) {
            if parent != INVALID {
                control.look()?;
            }
            if parent != INVALID && !own_edge(ends) {
                let other = ends.map(|v| *corner(v));
                let whole = apart(&ends).map_or(f64::INFINITY, |own| between_edges(own, other));
                consider(whole.min(to_edge(at, &other[0], &other[1])), Element::Segment(parent));
            }
        }
        for (v, p) in (0..).zip(&self.points) {
            control.step()?;
            let d = sub(p, at);
            let distance = dot(&d, &d).sqrt();
            let first = self.alias.get(v as usize).is_none_or(|&a| a == v);
            if first && best.is_none_or(|b| distance < b.0) && !own_point(v) {
                best = Some((distance, Element::Point(v)));
            }
        }
        Ok(best.map(|b| b.1))
    }
}

/// Distance of a point from the line between two others.
fn to_edge(p: &[f64; 3], a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let (u, w) = (sub(b, a), sub(p, a));
    let t = (dot(&u, &w) / dot(&u, &u).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let d: [f64; 3] = std::array::from_fn(|k| w[k] - t * u[k]);
    dot(&d, &d).sqrt()
}

/// Distance between two edges.
fn between_edges([a, b]: [[f64; 3]; 2], [c, d]: [[f64; 3]; 2]) -> f64 {
    let ends = to_edge(&a, &c, &d).min(to_edge(&b, &c, &d)).min(to_edge(&c, &a, &b)).min(to_edge(&d, &a, &b));
    let (ab, cd, ac) = (sub(&b, &a), sub(&d, &c), sub(&c, &a));
    let n = cross(&ab, &cd);
    let size = dot(&n, &n);
    if size < f64::MIN_POSITIVE {
        // Parallel edges are nearest to each other at an end.
        return ends;
    }
    // a + s ab and c + t cd are nearest to each other.
    let (s, t) = (dot(&cross(&ac, &cd), &n) / size, dot(&cross(&ac, &ab), &n) / size);
    let crosses = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
    match crosses {
        true => ends.min(dot(&ac, &n).abs() / size.sqrt()),
        false => ends,
    }
}

/// Distance of a point from a triangle.
fn to_triangle(p: &[f64; 3], [a, b, c]: [[f64; 3]; 3]) -> f64 {
    let n = cross(&sub(&b, &a), &sub(&c, &a));
    let inside =
        [[&a, &b], [&b, &c], [&c, &a]].iter().all(|[x, y]| dot(&cross(&sub(y, x), &sub(p, x)), &n) >= 0.0);
    let size = dot(&n, &n).sqrt();
    if inside && size > 0.0 {
        return (dot(&sub(p, &a), &n) / size).abs();
    }
    to_edge(p, &a, &b).min(to_edge(p, &b, &c)).min(to_edge(p, &c, &a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_other_of_two_sheets_is_nearest() {
        let nearest = |surface: &Surface, at: [f64; 3], home| {
            surface.nearest_element(&at, home, &Control::free()).unwrap()
        };
        let surface = Surface {
            points: vec![
                [0.0, 0.0, 0.0],
                [4.0, 0.0, 0.0],
                [0.0, 4.0, 0.0],
                [0.0, 0.0, 1.0],
                [4.0, 0.0, 1.0],
                [0.0, 4.0, 1.0],
                [0.5, 0.5, -2.0],
            ],
            segments: vec![[0, 1], [0, 2], [1, 2], [3, 4], [3, 5], [4, 5]],
            segment_parent: vec![INVALID, INVALID, 7, INVALID, INVALID, INVALID],
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            triangle_facet: vec![5, 6],
            triangle_patch: vec![0, 1],
            patch_count: 2,
            ..Surface::default()
        };
        assert_eq!(nearest(&surface, [1.0, 1.0, 0.25], Home::Facet(5)), Some(Element::Facet(6)));
        assert_eq!(nearest(&surface, [2.0, 0.0, 0.0], Home::Edge([0, 1])), Some(Element::Facet(6)));
        assert_eq!(nearest(&surface, [0.5, 0.5, -1.5], Home::Facet(5)), Some(Element::Point(6)));
        assert_eq!(nearest(&surface, [1.9, 1.9, 0.5], Home::Edge([3, 4])), Some(Element::Facet(5)));
        assert_eq!(nearest(&surface, [2.0, 2.0, 0.0], Home::Edge([0, 2])), Some(Element::Segment(7)));
        // Edges that pass close by count, wherever on them the point is.
        let mut crossing = surface;
        crossing.points[6] = [-1.0, 2.0, 0.125];
        crossing.points.extend([[1.0, 2.0, 0.125], [0.0, 2.0, 2.0]]);
        crossing.triangles.push([6, 7, 8]);
        crossing.triangle_facet.push(9);
        crossing.triangle_patch.push(2);
        assert_eq!(nearest(&crossing, [0.0, 0.25, 0.0], Home::Edge([0, 2])), Some(Element::Facet(9)));
        let surface = crossing;
        assert_eq!(surface.element_of_edge([1, 2]), Element::Segment(7));
        assert_eq!(surface.element_of_edge([4, 3]), Element::Facet(6));
    }
}
