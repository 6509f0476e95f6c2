//! Improvement: flat tetrahedra, and those with short edges and large circumspheres, are reconnected away as far as their
//! surroundings allow.
//!
//! Hill climbing, the worst tetrahedron first (Freitag & Ollivier-Gooch 1997; Klingner & Shewchuk 2007), by steps of
//! [`reshape`](crate::ops::reshape). Every step replaces tetrahedra by better ones, by one measure, so a stage ends: when nothing bad is left,
//! or when too many tetrahedra could not be improved. The stages take turns between the smallest dihedral angle and the
//! radius-edge ratio; the last ones try harder for the few worst.

use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::Mesh;
use crate::kernel::{face_key, NONE};
use crate::ops::reshape::{shape, Aim, Effort, Reshape};
use crate::ops::shape::{needle, Measure, Shape};
use crate::predicates::Points;
use rustc_hash::FxHashSet;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Tetrahedra below are improved: a dihedral angle of less than a degree, a circumradius of more than twenty edges. Higher values take time
/// for more tetrahedra. On eleven models with 22 points inside half of the angle changes four meshes, double five meshes, but never their
/// number. There half of the ratio changes four meshes, double two meshes, but never their number.
const BAD: Shape = Shape { angle: 0.0175, ratio: 0.05, dihedral: 0.0, volume: 0.0 };

/// Above this, one measure may be lowered to improve the other. On eleven models with 22 points inside half of the angle changes two
/// meshes, double one mesh, but never their number. Half of the ratio and double change nothing on eleven models: nothing measurable
/// depends on that.
const ENOUGH: Shape = Shape { angle: 0.02, ratio: 0.25, dihedral: 0.0, volume: 0.0 };

/// One stage of the improvement.
struct Stage {
    measure: Measure,
    effort: Effort,
    /// It ends when this many tetrahedra could not be improved, plus one per this many tetrahedra of the mesh.
    failures: [usize; 2],
}

/// The effort for many tetrahedra: small cavities and few steps. On eleven models with 22 points inside two vertices less changes six
/// meshes, two more five meshes, but never their number. There half of the steps changes three meshes, double none, but never their number.
const QUICK: Effort = Effort { cavities: &[(9, 30), (12, 100)], thorough: false };
/// The effort for the worst that remain: larger cavities, more steps, and other apexes for walls. On eleven models with 22 points inside
/// three vertices less changes five meshes, three more six meshes, but never their number. Half of the steps and double change nothing on
/// eleven models: it only bounds the work on worse ones. Two models take up to 14 % less time with three vertices less, up to 15 % more
/// with three more.
const HARD: Effort = Effort { cavities: &[(12, 500), (18, 1500)], thorough: true };
/// One after the other; failures allowed trade time for better tetrahedra. On eleven models with 22 points inside half of them in quick
/// stages changes eight meshes, double two meshes, but never their number. There half of them in hard stages changes six meshes, double
/// eight meshes, but never their number.
const STAGES: [Stage; 4] = [
    Stage { measure: Measure::Angle, effort: QUICK, failures: [30, 800] },
    Stage { measure: Measure::Ratio, effort: QUICK, failures: [30, 800] },
    Stage { measure: Measure::Angle, effort: HARD, failures: [6, usize::MAX] },
    Stage { measure: Measure::Ratio, effort: HARD, failures: [6, usize::MAX] },
];

/// A tetrahedron to improve: the bits of its quality, its slot, and after which change it came.
type Entry = (u64, u32, u64);

/// What is bad by one measure.
#[derive(Default)]
struct Bad {
    /// The worst on top.
    queue: BinaryHeap<Reverse<Entry>>,
    /// Could not be improved.
    stuck: Vec<Entry>,
}

/// Improves a mesh.
struct Improve<'a> {
    control: &'a Control<'a>,
    reshape: Reshape<'a>,
    by_angle: Bad,
    by_ratio: Bad,
    /// The worst of the mesh at first.
    worst: Shape,
}

/// Improves the tetrahedra of a mesh; `isolated` are edges on no facet that must stay.
///
/// # Errors
/// [`OutOfMemory`](crate::error::Status::OutOfMemory), and what ends the run.
pub fn improve(
    mesh: &mut Mesh,
    points: &Points,
    isolated: &FxHashSet<[u32; 2]>,
    control: &Control,
) -> Result<(), Error> {
    let mut improve = Improve {
        control,
        reshape: Reshape::new(control),
        by_angle: Bad::default(),
        by_ratio: Bad::default(),
        worst: Shape::BEST,
    };
    for t in 0..mesh.slot_count() as u32 {
        control.step()?;
        if mesh.region(t) != NONE && mesh.is_live(t) {
            let shape = shape(mesh, points, t);
            improve.worst = improve.worst.worse(shape);
            improve.push_shape(mesh, t, shape)?;
        }
    }
    // A needle on the surface forces the ratio of its tetrahedra.
    let mut forced = ENOUGH.ratio;
    for code in mesh.subfaces() {
        control.step()?;
        forced = forced.min(needle(face_key(mesh.face(code)).map(|v| points.xyz(v))));
    }
    let enough = Shape { ratio: forced, ..ENOUGH };
    for stage in STAGES {
        let least = improve.worst(mesh)?;
        improve.run(
            mesh,
            points,
            isolated,
            &stage,
            Aim { measure: stage.measure, enough, least, largest: f64::INFINITY },
        )?;
    }
    Ok(())
}

impl Improve<'_> {
    fn bad(&mut self, measure: Measure) -> &mut Bad {
        match measure {
            Measure::Angle | Measure::Dihedral => &mut self.by_angle,
            Measure::Ratio => &mut self.by_ratio,
        }
    }

    /// Takes note of a tetrahedron if it is bad.
    fn push(&mut self, mesh: &Mesh, points: &Points, t: u32) -> Result<(), Error> {
        self.push_shape(mesh, t, shape(mesh, points, t))
    }

    /// As [`Improve::push`], for a tetrahedron whose shape is known.
    fn push_shape(&mut self, mesh: &Mesh, t: u32, shape: Shape) -> Result<(), Error> {
        for measure in [Measure::Angle, Measure::Ratio] {
            if shape.by(measure) < BAD.by(measure) {
                let queue = &mut self.bad(measure).queue;
                fallible::push_heap(queue, Reverse((shape.by(measure).to_bits(), t, mesh.changed(t))))?;
            }
        }
        Ok(())
    }

    /// The worst of the mesh by either measure. What could not be improved is to be tried again.
    fn worst(&mut self, mesh: &Mesh) -> Result<Shape, Error> {
        let first = self.worst;
        let mut of = |measure: Measure| {
            let Bad { queue, stuck } = self.bad(measure);
            for entry in stuck.drain(..) {
                fallible::push_heap(queue, Reverse(entry))?;
            }
            while queue.peek().is_some_and(|top| !is_there(mesh, &top.0)) {
                queue.pop();
            }
            let good = first.by(measure).max(BAD.by(measure));
            Ok::<f64, Error>(queue.peek().map_or(good, |top| f64::from_bits(top.0 .0)))
        };
        Ok(Shape { angle: of(Measure::Angle)?, ratio: of(Measure::Ratio)?, ..Shape::default() })
    }

    /// One stage.
    fn run(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        stage: &Stage,
        aim: Aim,
    ) -> Result<(), Error> {
        let mut left = stage.failures[0] + mesh.live_count() / stage.failures[1];
        let mut last = None;
        while left > 0 {
            let Some(Reverse(entry)) = self.bad(stage.measure).queue.pop() else { break };
            self.control.step()?;
            if last == Some(entry) || !is_there(mesh, &entry) {
                continue;
            }
            last = Some(entry);
            self.control.look()?;
            if !self.reshape.improve(mesh, points, isolated, entry.1, &aim, stage.effort)? {
                left -= 1;
                let stuck = &mut self.bad(stage.measure).stuck;
                fallible::push(stuck, entry)?;
                continue;
            }
            // Neighbours that failed before may succeed now.
            for i in 0..self.reshape.replace.fresh.len() {
                let t = self.reshape.replace.fresh[i];
                self.push(mesh, points, t)?;
                for code in 4 * t..4 * t + 4 {
                    let n = mesh.across(code) >> 2;
                    if mesh.region(n) != NONE && mesh.changed(n) != mesh.changes() {
                        self.push(mesh, points, n)?;
                    }
                }
            }
        }
        Ok(())
    }
}

/// Whether a tetrahedron is still there.
fn is_there(mesh: &Mesh, &(_, t, since): &Entry) -> bool {
    mesh.changed(t) == since && mesh.is_live(t)
}
