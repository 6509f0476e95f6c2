//! Random soups on small grids against an oracle in exact rationals.
//!
//! The oracle clips one element against the half-spaces that bound the other and judges the common set itself; it shares no code
//! and no case analysis with the tested module.
use crate::error::{DefectKind, Element};
use crate::plc::intersect::tests::{Model, Random};
use crate::plc::intersect::Intersections;
use num_rational::Ratio;
use num_traits::{Signed, Zero};
use std::collections::BTreeSet;

type Q = Ratio<i128>;
type P = [Q; 3];

fn exact(p: &[f64; 3]) -> P {
    p.map(|x| Q::from_integer(x as i128))
}

fn sub(a: &P, b: &P) -> P {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: &P, b: &P) -> P {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: &P, b: &P) -> Q {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn is_zero(a: &P) -> bool {
    a.iter().all(Q::is_zero)
}

/// The part of a convex polygon (also of two corners or one) where `normal · (x − origin) ≥ 0`.
fn clip(polygon: &[P], origin: &P, normal: &P) -> Vec<P> {
    let height = |p: &P| dot(normal, &sub(p, origin));
    let mut kept = Vec::new();
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (hp, hq) = (height(p), height(q));
        if !hp.is_negative() {
            kept.push(*p);
        }
        if (hp * hq).is_negative() {
            let t = hp / (hp - hq);
            kept.push(std::array::from_fn(|k| p[k] + t * (q[k] - p[k])));
        }
    }
    kept
}

/// The distinct corners of the part of `polygon` on triangle `t`.
fn common_part(polygon: &[P], t: &[P; 3]) -> Vec<P> {
    let normal = cross(&sub(&t[1], &t[0]), &sub(&t[2], &t[0]));
    let mut part = clip(polygon, &t[0], &normal);
    part = clip(&part, &t[0], &normal.map(|x| -x));
    for k in 0..3 {
        let inward = cross(&normal, &sub(&t[(k + 1) % 3], &t[k]));
        part = clip(&part, &t[k], &inward);
    }
    part.sort();
    part.dedup();
    part
}

/// Whether `p` is on the closed segment.
fn on_segment(p: &P, a: &P, b: &P) -> bool {
    is_zero(&cross(&sub(b, a), &sub(p, a))) && !dot(&sub(p, a), &sub(p, b)).is_positive()
}

fn inside_segment(p: &P, a: &P, b: &P) -> bool {
    p != a && p != b && on_segment(p, a, b)
}

fn collinear(part: &[P]) -> bool {
    part.iter().all(|p| is_zero(&cross(&sub(&part[1], &part[0]), &sub(p, &part[0]))))
}

fn in_an_edge(part: &[P], t: &[P; 3]) -> bool {
    edge_with(part, t).is_some()
}

fn edge_with(part: &[P], t: &[P; 3]) -> Option<usize> {
    (0..3).find(|k| part.iter().all(|p| on_segment(p, &t[*k], &t[(k + 1) % 3])))
}

/// The edge of one of two triangles that runs through the other's interior, in its plane: which triangle, which edge.
fn edge_inside(a: &[P; 3], b: &[P; 3]) -> Option<(usize, usize)> {
    let part = common_part(a, b);
    if part.len() < 2 || !collinear(&part) {
        return None;
    }
    match (edge_with(&part, a), edge_with(&part, b)) {
        (Some(k), None) => Some((0, k)),
        (None, Some(k)) => Some((1, k)),
        _ => None,
    }
}

/// The defect of two triangles, if any, from their common set.
fn judge_triangles(a: &[P; 3], b: &[P; 3]) -> Option<DefectKind> {
    let part = common_part(a, b);
    match part.len() {
        0 => None,
        1 => (!a.contains(&part[0]) && !b.contains(&part[0])).then_some(DefectKind::FacetFacet),
        _ if collinear(&part) => {
            (!in_an_edge(&part, a) && !in_an_edge(&part, b)).then_some(DefectKind::FacetFacet)
        }
        _ if a.iter().all(|p| b.contains(p)) => Some(DefectKind::DuplicateFacet),
        _ => Some(DefectKind::Overlap),
    }
}

type Found = BTreeSet<(DefectKind, Element, Element)>;

/// The point inside both of two segments that are not collinear.
fn proper_crossing(a: &P, b: &P, c: &P, d: &P) -> Option<P> {
    let (u, v) = (sub(b, a), sub(d, c));
    let normal = cross(&u, &v);
    if is_zero(&normal) || !dot(&normal, &sub(c, a)).is_zero() {
        return None;
    }
    let t = dot(&cross(&sub(c, a), &v), &normal) / dot(&normal, &normal);
    let x = std::array::from_fn(|k| a[k] + t * u[k]);
    (inside_segment(&x, a, b) && inside_segment(&x, c, d)).then_some(x)
}

/// Everything that `find` must report about a model with integer coordinates.
fn expected(model: &Model) -> (Found, Intersections) {
    let points: Vec<P> = model.points.iter().map(exact).collect();
    let triangles: Vec<[P; 3]> = model.triangles.iter().map(|t| t.map(|v| points[v as usize])).collect();
    let segments: Vec<[P; 2]> = model.segments.iter().map(|s| s.map(|v| points[v as usize])).collect();
    let (mut defects, mut lists) = (Found::new(), Intersections::default());
    for (i, a) in triangles.iter().enumerate() {
        for (j, b) in triangles.iter().enumerate().skip(i + 1) {
            if let Some(kind) = judge_triangles(a, b) {
                defects.insert((kind, Element::Facet(i as u32), Element::Facet(j as u32)));
            }
            if let Some((which, k)) = edge_inside(a, b) {
                let t = [i, j][which];
                let mut edge = [model.triangles[t][k], model.triangles[t][(k + 1) % 3]];
                edge.sort();
                lists.edge_in_facet.push((edge, t as u32));
            }
        }
        for (v, p) in points.iter().enumerate() {
            if common_part(&[*p], a).is_empty() || a.contains(p) {
                continue;
            }
            match (0..3).find(|&k| on_segment(p, &a[k], &a[(k + 1) % 3])) {
                None => lists.vertex_in_triangle.push((i as u32, v as u32)),
                Some(k) => {
                    let mut edge = [model.triangles[i][k], model.triangles[i][(k + 1) % 3]];
                    edge.sort();
                    lists.vertex_on_edge.push((edge, v as u32));
                }
            }
        }
    }
    lists.edge_in_facet.sort();
    lists.edge_in_facet.dedup_by_key(|x| x.0);
    lists.vertex_on_edge.sort();
    lists.vertex_on_edge.dedup();
    for (i, s) in segments.iter().enumerate() {
        expect_segment(model, &points, &triangles, &segments, i, s, &mut defects, &mut lists);
    }
    (defects, lists)
}

#[allow(clippy::too_many_arguments)]
fn expect_segment(
    model: &Model,
    points: &[P],
    triangles: &[[P; 3]],
    segments: &[[P; 2]],
    i: usize,
    s: &[P; 2],
    defects: &mut Found,
    lists: &mut Intersections,
) {
    let id = Element::Segment(i as u32);
    for (v, p) in points.iter().enumerate() {
        if inside_segment(p, &s[0], &s[1]) {
            lists.vertex_on_segment.push((i as u32, v as u32));
        }
    }
    for (j, t) in segments.iter().enumerate().skip(i + 1) {
        if proper_crossing(&s[0], &s[1], &t[0], &t[1]).is_some_and(|x| !points.contains(&x)) {
            defects.insert((DefectKind::SegmentSegment, id, Element::Segment(j as u32)));
        }
    }
    for (j, t) in triangles.iter().enumerate() {
        let part = common_part(s, t);
        if part.len() == 2 && !in_an_edge(&part, t) {
            lists.segment_in_facet.push((i as u32, j as u32));
        }
        if part.len() == 1 && !points.contains(&part[0]) && !in_an_edge(&part, t) {
            defects.insert((DefectKind::SegmentFacet, id, Element::Facet(j as u32)));
        }
        for k in 0..3 {
            if proper_crossing(&s[0], &s[1], &t[k], &t[(k + 1) % 3]).is_none_or(|x| points.contains(&x)) {
                continue;
            }
            let ends = [model.triangles[j][k], model.triangles[j][(k + 1) % 3]];
            let around: Vec<usize> = (0..triangles.len())
                .filter(|&n| ends.iter().all(|v| model.triangles[n].contains(v)))
                .collect();
            let coplanar = |n: &usize| {
                let t = &triangles[*n];
                let normal = cross(&sub(&t[1], &t[0]), &sub(&t[2], &t[0]));
                s.iter().all(|p| dot(&normal, &sub(p, &t[0])).is_zero())
            };
            if around.len() < 2 || !around.iter().all(coplanar) {
                defects.insert((DefectKind::SegmentSegment, id, Element::Facet(around[0] as u32)));
            }
        }
    }
}

/// Distinct grid points, and random non-degenerate elements on them.
fn soup(random: &mut Random, size: [usize; 3], points: usize, triangles: usize, segments: usize) -> Model {
    let mut chosen = BTreeSet::new();
    while chosen.len() < points {
        chosen.insert(size.map(|n| random.below(n)));
    }
    let mut model = Model::default();
    model.points.extend(chosen.iter().map(|p| p.map(|x| x as f64)));
    while model.triangles.len() < triangles {
        let t: [u32; 3] = std::array::from_fn(|_| random.below(points) as u32);
        let [a, b, c] = t.map(|v| exact(&model.points[v as usize]));
        if !is_zero(&cross(&sub(&b, &a), &sub(&c, &a))) {
            model.triangles.push(t);
        }
    }
    while model.segments.len() < segments {
        let s: [u32; 2] = std::array::from_fn(|_| random.below(points) as u32);
        if s[0] != s[1] {
            model.segments.push(s);
        }
    }
    model
}

fn compare(model: &Model) {
    let found = model.find();
    let (defects, lists) = expected(model);
    let seen: Found = found.defects.iter().map(|d| (d.kind, d.first, d.second.unwrap())).collect();
    assert_eq!(seen, defects, "{model:?}");
    assert_eq!(found.defect_count, defects.len(), "{model:?}");
    assert_eq!(found.vertex_on_segment, lists.vertex_on_segment, "{model:?}");
    assert_eq!(found.vertex_on_edge, lists.vertex_on_edge, "{model:?}");
    assert_eq!(found.vertex_in_triangle, lists.vertex_in_triangle, "{model:?}");
    assert_eq!(found.segment_in_facet, lists.segment_in_facet, "{model:?}");
    assert_eq!(found.edge_in_facet, lists.edge_in_facet, "{model:?}");
}

#[test]
fn random_soups_agree_with_the_oracle() {
    let mut random = Random(1);
    for _ in 0..60 {
        compare(&soup(&mut random, [3, 3, 3], 12, 8, 4));
        compare(&soup(&mut random, [5, 5, 5], 16, 10, 6));
        compare(&soup(&mut random, [4, 4, 2], 14, 8, 4));
        compare(&soup(&mut random, [5, 5, 1], 12, 6, 4));
    }
}

#[test]
fn pairs_of_triangles_agree_with_the_oracle() {
    let mut random = Random(2);
    for _ in 0..1500 {
        compare(&soup(&mut random, [3, 3, 2], 5, 2, 0));
        compare(&soup(&mut random, [4, 4, 4], 6, 2, 1));
    }
}

#[test]
fn a_large_soup_agrees_with_the_oracle() {
    // Deep enough for a tree of several levels, small triangles and a few large ones.
    let mut random = Random(3);
    let mut model = soup(&mut random, [12, 12, 12], 60, 5, 3);
    for _ in 0..70 {
        let near = [random.below(9), random.below(9), random.below(9)];
        let small = soup(&mut random, [3, 3, 3], 4, 1, 1);
        let mut add = |v: u32| -> u32 {
            let p = std::array::from_fn(|k| small.points[v as usize][k] + near[k] as f64);
            let position = model.points.iter().position(|q| *q == p);
            position.unwrap_or_else(|| {
                model.points.push(p);
                model.points.len() - 1
            }) as u32
        };
        let (t, s) = (small.triangles[0].map(&mut add), small.segments[0].map(&mut add));
        model.triangles.push(t);
        model.segments.push(s);
    }
    compare(&model);
}
