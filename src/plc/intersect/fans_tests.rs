//! Fans: nothing is missed compared with a test of all pairs, and the number of pairs does not grow quadratically.
use super::*;
use crate::control::Control;
use crate::plc::intersect::fans::Fans;
use crate::plc::intersect::tests::{Model, Random};

/// Calls `test` with the input of [`find_intersections`].
fn with_input<T>(model: &Model, test: impl FnOnce(&IntersectInput) -> T) -> T {
    let vertices: Vec<u32> = (0..model.points.len() as u32).collect();
    let facets: Vec<u32> = (0..model.triangles.len() as u32).collect();
    test(&IntersectInput {
        points: &model.points,
        vertices: &vertices,
        triangles: &model.triangles,
        triangle_facet: &facets,
        segments: &model.segments,
    })
}

/// All contacts, every element against every other.
fn by_brute_force(model: &Model) -> Intersections {
    with_input(model, |input| {
        let (elements, _, _) = list_elements(input, &Control::free()).unwrap();
        let order: Vec<u32> = (0..elements.len() as u32).collect();
        let scene = Scene::new(input, &elements, &order, &Control::free()).unwrap();
        let mut collector = Collector::new(Names::NONE, usize::MAX);
        for i in 0..elements.len() {
            for j in i + 1..elements.len() {
                scene.classify(i, j, &mut collector).unwrap();
            }
        }
        collector.finish(&Control::free()).unwrap()
    })
}

/// How many pairs are classified.
fn pairs(model: &Model) -> usize {
    with_input(model, |input| {
        let (_, bounds, fans) = list_elements(input, &Control::free()).unwrap();
        let mut count = 0;
        let visited = BoxTree::new(&bounds, fans, &Control::free()).unwrap().for_each_pair(
            &Control::free(),
            |_, _, _| {
                count += 1;
                Ok(())
            },
        );
        visited.unwrap();
        count
    })
}

fn is_degenerate(model: &Model, corners: &[u32; 3]) -> bool {
    let [a, b, c] = corners.map(|v| &model.points[v as usize]);
    locate_point::collinear(a, b, c)
}

/// Fans of segments and of triangles at a few points of a grid, and other elements, some with two such points.
fn random_fans(random: &mut Random, size: usize, apexes: usize, elements: usize) -> Model {
    let mut model = Model::default();
    // Steps of powers of two: directions that are far apart, and some that nearly agree.
    let step: [f64; 3] = std::array::from_fn(|_| [1.0, 3.0, 1048576.0][random.below(3)]);
    while model.points.len() < (size * size * size).min(40) {
        let p = std::array::from_fn(|k| random.below(size) as f64 * step[k]);
        if !model.points.contains(&p) {
            model.points.push(p);
        }
    }
    for _ in 0..elements {
        let count = model.points.len();
        let limit = if random.below(8) == 0 { count } else { apexes };
        let apex = random.below(limit) as u32;
        let [b, c] = [0; 2].map(|_| random.below(count) as u32);
        if b != apex && random.below(2) == 0 {
            model.segments.push([apex, b]);
        } else if !is_degenerate(&model, &[apex, b, c]) {
            model.triangles.push([[apex, b, c], [c, apex, b], [b, c, apex]][random.below(3)]);
        }
    }
    model
}

#[test]
fn random_fans_agree_with_a_test_of_all_pairs() {
    let mut random = Random(11);
    for round in 0..120 {
        let model = random_fans(&mut random, 2 + round % 5, 1 + round % 3, 150 + round);
        with_input(&model, |input| {
            assert!(!list_elements(input, &Control::free()).unwrap().2.elements.is_empty())
        });
        let (found, expected) = (model.find(), by_brute_force(&model));
        assert!(found.defect_count > 0 || round % 5 > 0);
        assert_eq!(found, expected, "{model:?}");
    }
}

#[test]
fn fans_without_contacts_agree_with_a_test_of_all_pairs() {
    // One element may touch another; most do not.
    let mut random = Random(12);
    for n in [40, 100, 300] {
        for model in [fan(&mut random, n), cone(n as u32), flat_fan(&mut random, n), closed_cone(n as u32)] {
            assert_eq!(model.find(), by_brute_force(&model));
        }
    }
}

/// Segments from the origin in all directions, of all lengths.
fn fan(random: &mut Random, n: usize) -> Model {
    let mut model = Model { points: vec![[0.0; 3]], ..Model::default() };
    for i in 1..=n {
        model.points.push(std::array::from_fn(|_| random.below(1 << 20) as f64 - 524287.5));
        model.segments.push([0, i as u32]);
    }
    model
}

/// The same in one plane perpendicular to no axis.
fn flat_fan(random: &mut Random, n: usize) -> Model {
    let mut model = fan(random, n);
    model.points.iter_mut().for_each(|p| p[2] = p[0] + 2.0 * p[1]);
    model
}

/// Triangles from the origin to the sides of a ring.
fn cone(n: u32) -> Model {
    let mut model = Model { points: vec![[0.0; 3]], ..Model::default() };
    for i in 0..n {
        let angle = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        model.points.push([angle.cos(), angle.sin(), 0.5]);
        model.triangles.push([0, 1 + i, 1 + (i + 1) % n]);
    }
    model
}

/// A cone with a fan as its base.
fn closed_cone(n: u32) -> Model {
    let mut model = cone(n);
    model.points.push([0.0, 0.0, 0.5]);
    model.triangles.extend((0..n).map(|i| [n + 1, 1 + (i + 1) % n, 1 + i]));
    // In general position.
    for [x, y, z] in &mut model.points {
        (*x, *y, *z) = (*x - 0.3 * *z + 0.1, *y + 0.2 * *x - 0.7 * *z, *z + 0.5 * *x + 0.25 * *y);
    }
    model
}

#[test]
fn pairs_of_a_fan_grow_like_its_elements() {
    let mut random = Random(13);
    for n in [1_000, 10_000] {
        let (solid, flat, cone) = (fan(&mut random, n), flat_fan(&mut random, n), cone(n as u32));
        // Hardly any two segments have directions whose boxes meet; triangles have two neighbours in the cone.
        assert!(pairs(&solid) < n, "{}", pairs(&solid));
        assert!(pairs(&flat) < n, "{}", pairs(&flat));
        assert!((n..4 * n).contains(&pairs(&cone)), "{}", pairs(&cone));
        // Two neighbours in each fan, three triangles of the other one.
        let closed = closed_cone(n as u32);
        assert!((5 * n..9 * n).contains(&pairs(&closed)), "{}", pairs(&closed));
        // Other elements at the apex and around do not spoil the fan.
        let mut inside = solid;
        inside.points.push([600_000.0; 3]);
        let last = inside.points.len() as u32 - 1;
        inside.triangles = (0..100).map(|i| [1 + i, 200 + i, last]).collect();
        assert!(pairs(&inside) < 101 * (n + 100), "{}", pairs(&inside));
    }
}

#[test]
fn ordinary_surfaces_have_no_fans() {
    with_input(&cone(31), |input| {
        let fans: Fans = list_elements(input, &Control::free()).unwrap().2;
        assert!(fans.elements.is_empty() && fans.members.is_empty());
    });
}
