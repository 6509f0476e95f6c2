//! Optimisation of a large mesh in [`blocks`](crate::blocks), by several threads: the same steps, in each block the worst first.
//!
//! In the first round everything is tried; in later ones only what has a vertex that was on a border in every round before, and what is bad and
//! so near to one that its cavities were cut. Nothing gets worse in a block, so nothing does in the mesh. Points of the surface that slide stay
//! in blocks; the whole mesh is done after them where something is bad at such points.
use super::{aim, Aims, Extent, Most, Optimise, Request, Settled, Subject, LARGEST_EFFORT, LEVELS};
use crate::blocks::{on_each, Crew, Model, Piece, Rounds};
use crate::control::Part;
use crate::error::Error;
use crate::fallible;
use crate::kernel::budget::Budget;
use crate::kernel::{edge_key, Mesh, NONE};
use crate::output::OptimizeStatistics;
use crate::progress::Phase;
use crate::size::Bounds;
use rustc_hash::FxHashSet;
use std::time::{Duration, Instant};

/// Tetrahedra of a block. 2^14 take a third longer on the model spot with 434,000, 2^15 a sixth, these a thirtieth; larger ones serve fewer threads.
/// (Tests have smaller ones, so that small meshes have several.)
const EACH: usize = if cfg!(test) { 1 << 9 } else { 1 << 16 };
/// A mesh with fewer is one block, without the detours.
const FEWEST: usize = 2 * EACH;

/// The share of progress of the blocks, where points slide after them.
const BEFORE_SLIDES: f64 = 0.9;
/// Layers of tetrahedra that cavities reach. Without them, the worst angle of the model spot with 435,000 is 4° or 5° less, that of a single one.
const CAVITY: usize = 2;

/// Whether a mesh is large enough for blocks.
pub(super) fn serves(subject: &Subject) -> bool {
    subject.mesh.live_count() >= FEWEST
        && (0..subject.points.len() as u32).all(|v| subject.points.is_explicit(v))
}

/// What is done in every block.
#[derive(Clone, Copy)]
struct Orders {
    aims: Aims,
    start: Instant,
    time: Option<Duration>,
    /// How many more there may be in each.
    room: Most,
}

/// Optimises a mesh in blocks.
///
/// # Errors
/// As [`optimise`](super::optimise).
pub(super) fn optimise(
    mut subject: Subject,
    request: Request,
    crew: Crew,
) -> Result<OptimizeStatistics, Error> {
    let Subject { mesh, points, inside, slides, bounds, .. } = subject.again();
    let (start, part, mut steps) = (Instant::now(), crew.part, OptimizeStatistics::default());
    let seconds = match request.extent {
        Extent::Seconds(seconds) => Some(Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)),
        Extent::Effort(_) => None,
    };
    // Within seconds all blocks get better a little before any gets as good as it can.
    let (efforts, count) = match request.extent {
        Extent::Effort(effort) => ([effort.min(LARGEST_EFFORT), 0, 0], 1),
        Extent::Seconds(_) => ([1, 2, LARGEST_EFFORT], 3),
    };
    // Where points slide, the whole mesh is done after its blocks.
    let share = if slides.is_some() { BEFORE_SLIDES } else { 1.0 } / count as f64;
    for (i, &effort) in efforts[..count].iter().enumerate() {
        let part = part.part(i as f64 * share, (i + 1) as f64 * share);
        let mut rounds = Rounds::new(points)?;
        let mut tets = Budget::default();
        tets.check(mesh, &part)?;
        let mut from = 0.0;
        while let Some(shares) = rounds.next(mesh, points, EACH, &part)? {
            if seconds.is_some_and(|time| start.elapsed() >= time) {
                break;
            }
            let to = 0.5 + 0.5 * from;
            let blocks = shares.count().max(1);
            let steiner = part.steiner_limit(usize::MAX / 200).saturating_sub(inside.total());
            let room = Most { tets: tets.room(mesh) / blocks, points: steiner / blocks as u64 };
            let sine = if i + 1 == count { request.sine } else { 0.0 };
            let orders = Orders { aims: Aims { effort, sine }, start, time: seconds, room };
            let work = |_: usize, piece: &mut Piece, part: Part| {
                optimise_block(piece, bounds, orders, &rounds, part)
            };
            let mut landed = |done: OptimizeStatistics, _: &[u32]| {
                steps.add(&done);
                Ok(())
            };
            let mut model = Model { mesh, points, inside };
            let crew = Crew { part: part.part(from, to), ..crew };
            on_each(&mut model, &shares, crew, Phase::Optimize, &work, &mut landed)?;
            tets.check(mesh, &part)?;
            from = to;
        }
    }
    inside.sweep(mesh);
    if let Some(slides) = slides {
        let none = fallible::filled(false, points.len())?;
        let mut near = fallible::filled(false, points.len())?;
        slides.list().iter().for_each(|slider| near[slider.v as usize] = true);
        let aims = Aims { effort: efforts[count - 1], sine: request.sine };
        let prepare = |optimise: &mut Optimise| {
            (optimise.start, optimise.time) = (start, seconds);
            optimise.settle(&none, &near, bad(aims))?;
            // Those that slide are not settled.
            optimise.left.copy_from_slice(&near);
            Ok(())
        };
        steps.add(&aim(subject, aims, part.part(BEFORE_SLIDES, 1.0), &prepare)?);
    }
    part.progress(1.0)?;
    Ok(steps)
}

fn optimise_block(
    piece: &mut Piece,
    bounds: &Bounds,
    orders: Orders,
    rounds: &Rounds,
    part: Part,
) -> Result<OptimizeStatistics, Error> {
    let isolated = edges(&piece.block.mesh)?;
    let count = piece.len();
    let Piece { block, points, inside, .. } = piece;
    let Orders { aims, start, time, room } = orders;
    let most =
        Most { tets: count.saturating_add(room.tets), points: inside.total().saturating_add(room.points) };
    let unsettled = |&v: &u32| rounds.is_unsettled(v);
    let (mut left, mut near) = (Vec::new(), Vec::new());
    if !rounds.is_first() {
        left = fallible::collect(block.vertices.iter().map(unsettled))?;
        near = widened(&block.mesh, &left)?;
    }
    let prepare = |optimise: &mut Optimise| {
        (optimise.start, optimise.time, optimise.most) = (start, time, most);
        match left.is_empty() {
            true => Ok(()),
            false => optimise.settle(&left, &near, bad(aims)),
        }
    };
    let subject =
        Subject { mesh: &mut block.mesh, points, inside, isolated: &isolated, slides: None, bounds };
    aim(subject, aims, part, &prepare)
}

/// The sine below which something is done.
fn bad(aims: Aims) -> f64 {
    LEVELS[aims.effort.clamp(1, LEVELS.len() as u32) as usize - 1].bad.max(aims.sine)
}

/// Whether a tetrahedron has a vertex of a list.
fn touches(mesh: &Mesh, list: &[bool], t: u32) -> bool {
    mesh.verts(t).into_iter().any(|v| list[v as usize])
}

/// The vertices of a list, and those from which cavities reach them.
fn widened(mesh: &Mesh, list: &[bool]) -> Result<Vec<bool>, Error> {
    let mut near = fallible::copied(list)?;
    for _ in 0..CAVITY {
        let mut wider = fallible::copied(&near)?;
        let counts = |&t: &u32| mesh.is_live(t) && mesh.region(t) != NONE;
        for t in mesh.all().filter(counts).filter(|&t| touches(mesh, &near, t)) {
            mesh.verts(t).into_iter().for_each(|v| wider[v as usize] = true);
        }
        near = wider;
    }
    Ok(near)
}

impl Optimise<'_> {
    /// Only what has a vertex that is left is to be done, and what is bad and has one that is near.
    fn settle(&mut self, left: &[bool], near: &[bool], bad: f64) -> Result<(), Error> {
        let (mut busy, mut all) = (0, 0);
        self.stuck.fill(1);
        self.moved.fill(1);
        // Since then, something has changed there.
        self.clock = 2;
        (0..left.len()).filter(|&v| left[v]).for_each(|v| self.moved[v] = 2);
        for t in self.mesh.all().filter(|&t| self.mesh.is_live(t) && self.mesh.region(t) != NONE) {
            self.part.steps(u32::from(t % 16 == 0))?;
            all += 1;
            busy += usize::from(touches(self.mesh, left, t));
            if touches(self.mesh, near, t) && self.sine(t) < bad {
                self.mesh.verts(t).into_iter().for_each(|v| self.moved[v as usize] = 2);
            }
        }
        self.settled = Some(Settled { left: busy, all });
        self.left = fallible::copied(left)?;
        Ok(())
    }
}

/// The edges that are subsegments: those on no wall that stay.
fn edges(mesh: &Mesh) -> Result<FxHashSet<[u32; 2]>, Error> {
    let mut edges = FxHashSet::default();
    for t in mesh.all().filter(|&t| mesh.is_live(t) && mesh.subsegment_bits(t) != 0) {
        for [a, b] in mesh.subsegments(t) {
            fallible::add(&mut edges, edge_key(a, b))?;
        }
    }
    Ok(edges)
}
