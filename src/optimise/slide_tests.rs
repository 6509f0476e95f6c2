use super::slide::{Largest, Slider, Slides, Track};
use super::{optimise, Extent, Request, Subject};
use crate::blocks::Crew;
use crate::control::Control;
use crate::kernel::Mesh;
use crate::ops::shape::sine;
use crate::predicates::{orient3d, Points, Sign};
use crate::preserve::inside::Inside;
use crate::progress::Phase;
use crate::size::{distance, volume, Bounds};
use crate::vector::{cross, dot, sub};
use rustc_hash::FxHashSet;

const CORNERS: [[f64; 3]; 4] = [[0.1, 0.2, 0.3], [1.1, 0.3, 0.2], [0.5, 1.1, 0.35], [0.55, 0.6, 1.2]];
const NO_BOUND: Largest = Largest { area: f64::INFINITY, radius: f64::INFINITY };

/// A tetrahedron with vertices on its edge from corner 0 to corner 1, or on its face 0 1 2.
struct Scene {
    mesh: Mesh,
    points: Points,
    slides: Slides,
}

impl Scene {
    /// The hull has one name, and this bound.
    fn new(exact: Points, list: Vec<Slider>, tets: &[[u32; 4]], largest: Largest) -> Scene {
        let points = Points::new(exact.coordinates().to_vec());
        let positive = |&[a, b, c, d]: &[u32; 4]| match points.orient3d(a, b, c, d) {
            Sign::Positive => [a, b, c, d],
            _ => [b, a, c, d],
        };
        let tets: Vec<_> = tets.iter().map(positive).collect();
        let mut mesh = Mesh::of_tetrahedra(&tets, points.len()).unwrap();
        mesh.set_regions(|_| 0).unwrap();
        for code in 0..4 * tets.len() as u32 {
            if mesh.is_ghost(mesh.across(code) >> 2) {
                mesh.set_subface(code);
            }
        }
        mesh.name_subfaces(|_, _| Some(0), &Control::free()).unwrap();
        mesh.track();
        let slides = Slides::new(exact, 4, list, vec![largest], 0).unwrap();
        Scene { mesh, points, slides }
    }

    fn on_edge<const N: usize>(parameters: [f64; N], largest: Largest) -> Scene {
        let mut exact = Points::new(CORNERS.to_vec());
        let added = parameters.map(|t| exact.push_on_segment(0, 1, &t.into()).unwrap());
        let chain: Vec<u32> = [0].into_iter().chain(added).chain([1]).collect();
        let slider = |(w, t): (&[u32], f64)| {
            let track = Track::Segment { ends: [0, 1], between: [w[0], w[2]], t };
            Slider { v: w[1], track, moved: false }
        };
        let list = chain.windows(3).zip(parameters).map(slider).collect();
        let tets: Vec<_> = chain.windows(2).map(|w| [w[0], w[1], 2, 3]).collect();
        Scene::new(exact, list, &tets, largest)
    }

    fn on_face(parameters: [f64; 2], largest: Largest) -> Scene {
        let mut exact = Points::new(CORNERS.to_vec());
        let v = exact.push_on_facet([0, 1, 2], parameters).unwrap();
        let track = Track::Facet { frame: [0, 1, 2], patch: 0 };
        let list = vec![Slider { v, track, moved: false }];
        Scene::new(exact, list, &[[0, 1, v, 3], [1, 2, v, 3], [2, 0, v, 3]], largest)
    }

    /// Optimises; returns the smallest sine. What comes is positive, sliding vertices are at the doubles nearest to their positions, and walls
    /// keep their orientations at these.
    fn run(&mut self, bounds: &Bounds, may_slide: bool) -> f64 {
        let walls: Vec<_> = self.mesh.subfaces().map(|code| self.mesh.face(code)).collect();
        let turns = |slides: &Slides| -> Vec<_> {
            let of =
                |&[x, y, z]: &[u32; 3]| [0, 1, 2].map(|axis| slides.exact().orient_in_plane(axis, x, y, z));
            walls.iter().map(of).collect()
        };
        let (before, free, isolated) = (turns(&self.slides), Control::free(), FxHashSet::default());
        let request = Request { extent: Extent::Effort(1), sine: 0.0 };
        let slides = may_slide.then_some(&mut self.slides);
        let (mesh, points, inside) = (&mut self.mesh, &mut self.points, &mut Inside::default());
        let subject = Subject { mesh, points, inside, isolated: &isolated, slides, bounds };
        optimise(subject, request, Crew { threads: 1, part: free.whole(Phase::Optimize) }).unwrap();
        assert_eq!(before, turns(&self.slides));
        for slider in self.slides.list().iter().filter(|slider| slider.moved) {
            assert_eq!(self.slides.exact().xyz(slider.v), self.points.xyz(slider.v));
        }
        let mut least = f64::INFINITY;
        for t in self.mesh.all().filter(|&t| self.mesh.is_live(t) && !self.mesh.is_ghost(t)) {
            let [a, b, c, d] = self.mesh.verts(t).map(|v| self.points.xyz(v));
            assert_eq!(orient3d(a, b, c, d), Sign::Positive);
            least = least.min(sine([a, b, c, d]));
        }
        least
    }

    fn parameters(&self) -> Vec<f64> {
        let of = |slider: &Slider| match slider.track {
            Track::Segment { t, .. } => t,
            Track::Facet { .. } => f64::NAN,
        };
        self.slides.list().iter().map(of).collect()
    }
}

/// No vertex is inside, no flip is possible, and a point inside would make it worse.
#[test]
fn a_vertex_slides_along_its_segment_where_nothing_else_helps() {
    let stays = Scene::on_edge([1.0 / 16.0], NO_BOUND).run(&Bounds::default(), false);
    let mut scene = Scene::on_edge([1.0 / 16.0], NO_BOUND);
    let slides = scene.run(&Bounds::default(), true);
    assert!(slides > 3.0 * stays, "{stays} {slides}");
    assert!((0.3..0.7).contains(&scene.parameters()[0]), "{:?}", scene.parameters());
    assert!(scene.slides.list()[0].moved);
}

#[test]
fn vertices_keep_their_order_along_a_segment() {
    let worst = |may_slide| {
        let mut scene = Scene::on_edge([1.0 / 16.0, 1.0 / 8.0, 3.0 / 16.0], NO_BOUND);
        let worst = scene.run(&Bounds::default(), may_slide);
        let t = scene.parameters();
        assert!(0.0 < t[0] && t[0] < t[1] && t[1] < t[2] && t[2] < 1.0, "{t:?}");
        worst
    };
    let (stays, slides) = (worst(false), worst(true));
    assert!(slides > 2.0 * stays, "{stays} {slides}");
}

/// Its exact position is in the plane by construction; its doubles are off it by their rounding at most.
#[test]
fn a_vertex_slides_in_the_plane_of_its_facet() {
    let stays = Scene::on_face([1.0 / 16.0, 1.0 / 32.0], NO_BOUND).run(&Bounds::default(), false);
    let mut scene = Scene::on_face([1.0 / 16.0, 1.0 / 32.0], NO_BOUND);
    let slides = scene.run(&Bounds::default(), true);
    assert!(slides > 3.0 * stays, "{stays} {slides}");
    assert_eq!(scene.slides.exact().orient3d(0, 1, 2, 4), Sign::Zero);
    let off = volume([0, 1, 2, 4].map(|v| scene.points.xyz(v)));
    assert!(off.abs() < 1e-16, "{off}");
}

/// The smaller tetrahedron, or triangle, grows up to the bound; the larger one was above it.
#[test]
fn bounds_on_volumes_and_areas_hold() {
    let whole = volume(CORNERS.each_ref()).abs();
    let bounds = Bounds { all: Some(whole / 8.0), of_region: Vec::new() };
    let mut scene = Scene::on_edge([1.0 / 16.0], NO_BOUND);
    scene.run(&bounds, true);
    assert!(scene.parameters()[0] > 1.0 / 16.0 && scene.parameters()[0] < 1.0 / 8.0);
    let area = |corners: [usize; 3]| {
        let [x, y, z] = corners.map(|i| &CORNERS[i]);
        let n = cross(&sub(y, x), &sub(z, x));
        0.5 * dot(&n, &n).sqrt()
    };
    let largest = Largest { area: area([0, 1, 2]).max(area([0, 1, 3])) / 8.0, radius: f64::INFINITY };
    let mut scene = Scene::on_edge([1.0 / 16.0], largest);
    scene.run(&Bounds::default(), true);
    assert!(scene.parameters()[0] > 1.0 / 16.0 && scene.parameters()[0] <= 1.0 / 8.0);
    // All circles are larger, so none grows: those through the vertex and a corner 2 or 3 are as large as it is far from that.
    let largest = Largest { area: f64::INFINITY, radius: 0.1 };
    let mut scene = Scene::on_edge([1.0 / 16.0], largest);
    let far = |scene: &Scene| [2, 3].map(|i| distance(scene.points.xyz(4), &CORNERS[i]));
    let before = far(&scene);
    scene.run(&Bounds::default(), true);
    let after = far(&scene);
    assert!(after[0] <= before[0] && after[1] <= before[1], "{before:?} {after:?}");
}
