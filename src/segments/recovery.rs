//! Segment recovery (D0 → D1): Si & Gärtner 2011, section 5.
//!
//! As long as a subsegment is not an edge, a Steiner point is added on it and inserted by Bowyer–Watson. Flags in the tetrahedra tell which
//! existing subsegments an insertion destroys, so only those are tested again.
//!
//! Missing pieces are processed longest first: splitting a long piece early often saves short ones next to it. On our hard models this
//! takes 10 to 40 % fewer points than first come, first served; shortest first takes the most.
//!
//! Invariant: every live subsegment is flagged around its edge in the mesh, or is in the queue.
use crate::control::Control;
use crate::delaunay::insert::Inserter;
use crate::delaunay::locate::locate;
use crate::error::{Element, Error};
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::edge_key;
use crate::kernel::tables::{EDGE_OF, FACE};
use crate::kernel::{Mesh, GHOST, NONE};
use crate::predicates::{Expansion, Points, Sign};
use crate::progress::Phase;
use crate::segments::close::{relative_distance, Beside};
use crate::segments::crossing;
use crate::segments::placement::{choose, distance, round_parameter, Context, OwnSegment, Subsegment};
use rustc_hash::FxHashMap;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// Number of parameters tried on each side of the chosen one for a point near a double: time in placement for work of rounding. On 15
/// models with 23,337 Steiner points 2 takes 0.9 % fewer (−5 to +6 % on single ones), 8 0.9 % fewer (−8 to +7 % on single ones).
const KIND_TRIES: i32 = 4;
/// Their spacing relative to the piece: negligible to the placement, but each rounds differently. On 15 models with 23,337 Steiner points
/// half takes 0.8 % fewer (−8 to +3 % on single ones), double 0.2 % fewer (−11 to +12 % on single ones).
const KIND_STEP: f64 = 1.0 / (1u64 << 30) as f64;
/// The same on segments where rounding failed. None of the models measured reaches it.
const CAREFUL_TRIES: i32 = 256;
/// The spacing there. None of the models measured reaches it.
const CAREFUL_STEP: f64 = 1.0 / (1u64 << 24) as f64;
/// The spacing where it failed again, around one of these fractions of the piece. None of the models measured reaches it.
const FAR_STEP: f64 = 1.0 / (1u64 << 11) as f64;
/// The fractions, in turn. None of the models measured reaches it.
const FAR_CENTERS: [f64; 4] = [0.5, 0.8, 0.2, 0.65];

/// Parameters are precise to this fraction of their piece; closer points get parameters of several doubles. Half of it and double change
/// nothing on 15 models: nothing measurable depends on it.
const USUAL_PRECISION: f64 = 1.0 / (1u64 << 36) as f64;

/// The subsegments of all segments.
#[derive(Default)]
pub struct Segments {
    /// Ends of every segment (vertex ids).
    pub ends: Vec<[u32; 2]>,
    /// Pieces; a split one is replaced by its first half, the second is appended.
    pub pieces: Vec<Subsegment>,
    /// Piece with the given ends.
    pub piece_of: FxHashMap<[u32; 2], u32>,
    /// Segment of each Steiner point, in order of insertion; `NONE` for points that refinement put elsewhere.
    pub steiner_segment: Vec<u32>,
    /// Parameter of each Steiner point, or the double nearest to it.
    pub steiner_t: Vec<f64>,
    /// Parameters that one double cannot hold, by index of the Steiner point.
    pub fine: FxHashMap<u32, Expansion>,
    /// Id of the first Steiner point.
    pub first_steiner: u32,
    /// Segments that were not edges at the start.
    pub missing: u64,
    /// How often rounding to doubles failed on each segment: its points are then chosen with more care.
    pub careful: Vec<u8>,
    /// Which segments must not be split (none if empty).
    pub deferred: Vec<bool>,
    /// Deferred segments found missing at some time.
    pub waiting: Vec<u32>,
    /// Vertices at which two segments meet at less than 90°, computed on demand.
    acute: Vec<bool>,
    /// Pieces that may be missing; `None` if all may be.
    doubtful: Option<Vec<u32>>,
    exact_bits: Vec<u8>,
    /// All pairs of ends, sorted; computed on demand.
    sorted: Vec<[u32; 2]>,
}

impl Segments {
    /// All segments in one piece each.
    pub fn new(points: &Points, ends: Vec<[u32; 2]>, control: &Control) -> Result<Self, Error> {
        let mut pieces = fallible::reserved(ends.len())?;
        let mut piece_of = FxHashMap::default();
        piece_of.try_reserve(ends.len())?;
        for (i, &e) in ends.iter().enumerate() {
            control.step()?;
            fallible::push(&mut pieces, Subsegment { segment: i as u32, ends: e, t: [0.0, 1.0] })?;
            fallible::insert(&mut piece_of, edge_key(e[0], e[1]), i as u32)?;
        }
        Ok(Segments { ends, pieces, piece_of, first_steiner: points.len() as u32, ..Self::default() })
    }

    /// The Steiner points of each segment in order from its first end: a list of segments and parameters sorted by both.
    ///
    /// # Errors
    /// `OutOfMemory`, and what ends the run.
    pub fn steiner_by_segment(&self, control: &Control) -> Result<Vec<(u32, f64, u32)>, Error> {
        let points = self.steiner_segment.iter().zip(&self.steiner_t).zip(self.first_steiner..);
        let points = points.map(|((&s, &t), v)| (s, t, v)).filter(|x| x.0 != NONE);
        let mut list = fallible::reserved(self.steiner_t.len())?;
        fallible::extend(&mut list, points)?;
        let order = |x: &(u32, f64, u32), y: &(u32, f64, u32)| {
            x.0.cmp(&y.0).then_with(|| self.order(x.0, [x.2, y.2], [x.1, y.1]))
        };
        control.sort_by(&mut list, order)?;
        Ok(list)
    }

    /// The exact parameter of a vertex on a segment.
    pub fn parameter(&self, segment: u32, v: u32) -> Expansion {
        let Some(index) = v.checked_sub(self.first_steiner) else {
            return Expansion::from(f64::from(u8::from(v == self.ends[segment as usize][1])));
        };
        self.fine.get(&index).copied().unwrap_or_else(|| Expansion::from(self.steiner_t[index as usize]))
    }

    /// Order of two pieces or points of one segment by exact parameters, given the nearest doubles.
    pub fn order(&self, segment: u32, [v, w]: [u32; 2], [t, u]: [f64; 2]) -> Ordering {
        t.total_cmp(&u).then_with(|| {
            let apart = self.parameter(segment, v).difference(&self.parameter(segment, w));
            apart.sign().cmp(&Sign::Zero)
        })
    }

    /// Whether a segment joins the two vertices.
    fn joins(&mut self, a: u32, b: u32, control: &Control) -> Result<bool, Error> {
        if self.sorted.is_empty() {
            self.sorted.try_reserve_exact(self.ends.len())?;
            fallible::extend(&mut self.sorted, self.ends.iter().map(|e| edge_key(e[0], e[1])))?;
            control.sort(&mut self.sorted)?;
        }
        Ok(self.sorted.binary_search(&edge_key(a, b)).is_ok())
    }

    /// The parameters of a Steiner point's neighbours on its segment.
    pub fn neighbors_on_segment(&self, v: u32) -> Option<[f64; 2]> {
        let index = v.checked_sub(self.first_steiner)? as usize;
        let (segment, t) = (*self.steiner_segment.get(index)?, self.steiner_t[index]);
        if segment == NONE {
            return None;
        }
        let mut room = [0.0f64, 1.0];
        for (&s, &other) in self.steiner_segment.iter().zip(&self.steiner_t) {
            if s == segment && other < t {
                room[0] = room[0].max(other);
            } else if s == segment && other > t {
                room[1] = room[1].min(other);
            }
        }
        Some(room)
    }

    /// Records that a Steiner point moved along its segment, between its neighbours.
    pub fn move_steiner(&mut self, v: u32, t: f64) {
        let index = (v - self.first_steiner) as usize;
        let segment = self.steiner_segment[index];
        self.steiner_t[index] = t;
        for piece in self.pieces.iter_mut().filter(|piece| piece.segment == segment) {
            for end in 0..2 {
                if piece.ends[end] == v {
                    piece.t[end] = t;
                }
            }
        }
    }

    /// Moves the Steiner points to a new set of segments, which must include all segments with points; the others may be missing. All but
    /// the deferred ones must be recovered.
    ///
    /// # Errors
    /// `Internal` if a segment with points is missing; `OutOfMemory`.
    pub fn exchange(
        mut self,
        points: &Points,
        ends: Vec<[u32; 2]>,
        control: &Control,
    ) -> Result<Self, Error> {
        let mut new = Segments::new(points, ends, control)?;
        new.first_steiner = self.first_steiner;
        new.missing = self.missing;
        for &segment in &self.steiner_segment {
            control.step()?;
            let [a, b] = self.ends[segment as usize];
            let heir = new.piece_of.get(&edge_key(a, b)).copied();
            let heir = heir.ok_or_else(|| Error::internal("a segment with Steiner points is missing"))?;
            fallible::push(&mut new.steiner_segment, heir)?;
        }
        self.waiting.sort_unstable();
        let mut doubtful = Vec::new();
        for (i, &[a, b]) in (0..).zip(&new.ends) {
            control.step()?;
            let known = self.piece_of.get(&edge_key(a, b)).map(|&piece| self.pieces[piece as usize].segment);
            if known.is_none_or(|s| self.waiting.binary_search(&s).is_ok()) {
                fallible::push(&mut doubtful, i)?;
            }
        }
        new.doubtful = Some(doubtful);
        new.steiner_t = self.steiner_t;
        new.fine = self.fine;
        new.split_pieces(control)?;
        Ok(new)
    }

    /// Gives up segments: they have no points and no longer have pieces.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn give_up(&mut self, gone: &[bool], control: &Control) -> Result<(), Error> {
        self.pieces.retain(|piece| gone.get(piece.segment as usize) != Some(&true));
        self.piece_of.clear();
        for (i, piece) in (0..).zip(&self.pieces) {
            control.step()?;
            fallible::insert(&mut self.piece_of, edge_key(piece.ends[0], piece.ends[1]), i)?;
        }
        Ok(())
    }

    /// Makes the pieces from the Steiner points.
    fn split_pieces(&mut self, control: &Control) -> Result<(), Error> {
        let list = self.steiner_by_segment(control)?;
        self.pieces.try_reserve(list.len())?;
        self.piece_of.try_reserve(list.len())?;
        for chain in list.chunk_by(|x, y| x.0 == y.0) {
            control.step()?;
            let segment = chain[0].0;
            let [first, last] = self.ends[segment as usize];
            self.piece_of.remove(&edge_key(first, last));
            let (mut from, mut t) = (first, 0.0);
            let mut slot = segment as usize;
            for (to, end) in chain.iter().map(|x| (x.2, x.1)).chain([(last, 1.0)]) {
                let piece = Subsegment { segment, ends: [from, to], t: [t, end] };
                match self.pieces.get_mut(slot) {
                    Some(whole) => *whole = piece,
                    None => fallible::push(&mut self.pieces, piece)?,
                }
                fallible::insert(&mut self.piece_of, edge_key(from, to), slot as u32)?;
                (from, t) = (to, end);
                slot = self.pieces.len();
            }
        }
        Ok(())
    }

    /// Adds a Steiner point on a piece: the piece becomes its first half, the second half is appended.
    pub fn add_steiner(&mut self, piece: u32, v: u32, t: f64) -> Result<(), Error> {
        let sub = self.pieces[piece as usize];
        let second = self.pieces.len() as u32;
        // Points between are on no segment.
        let index = (v - self.first_steiner) as usize;
        fallible::resize(&mut self.steiner_segment, index, NONE)?;
        fallible::resize(&mut self.steiner_t, index, 0.0)?;
        fallible::push(&mut self.steiner_segment, sub.segment)?;
        fallible::push(&mut self.steiner_t, t)?;
        self.piece_of.remove(&edge_key(sub.ends[0], sub.ends[1]));
        self.pieces[piece as usize] = Subsegment { ends: [sub.ends[0], v], t: [sub.t[0], t], ..sub };
        fallible::push(&mut self.pieces, Subsegment { ends: [v, sub.ends[1]], t: [t, sub.t[1]], ..sub })?;
        fallible::insert(&mut self.piece_of, edge_key(sub.ends[0], v), piece)?;
        fallible::insert(&mut self.piece_of, edge_key(v, sub.ends[1]), second)?;
        Ok(())
    }

    /// The largest n such that all multiples of 2^-n are parameters of points in doubles; at most 60.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn bits(&mut self, points: &Points, segment: u32) -> Result<u32, Error> {
        if self.exact_bits.is_empty() {
            fallible::resize(&mut self.exact_bits, self.ends.len(), u8::MAX)?;
        }
        let cached = &mut self.exact_bits[segment as usize];
        if *cached == u8::MAX {
            let [a, b] = self.ends[segment as usize];
            *cached = points.exact_bits(a, b).min(60) as u8;
        }
        Ok(u32::from(*cached))
    }
}

/// Vertices at which two segments meet at less than 90°. Among seven directions two always do, so seven are enough.
fn acute_vertices(points: &Points, ends: &[[u32; 2]], control: &Control) -> Result<Vec<bool>, Error> {
    let mut incident: Vec<[u32; 2]> = fallible::reserved(2 * ends.len())?;
    for &[a, b] in ends {
        fallible::push(&mut incident, [a, b])?;
        fallible::push(&mut incident, [b, a])?;
    }
    control.sort(&mut incident)?;
    let mut acute = fallible::filled(false, points.len())?;
    for group in incident.chunk_by(|x, y| x[0] == y[0]) {
        control.step()?;
        let v = group[0][0];
        let others = &group[..group.len().min(7)];
        acute[v as usize] = others
            .iter()
            .enumerate()
            .any(|(i, x)| others[..i].iter().any(|y| points.dot_sign(v, x[1], y[1]) == Sign::Positive));
    }
    Ok(acute)
}

/// The state of a recovery.
pub struct Recovery<'a> {
    /// The mesh.
    pub mesh: &'a mut Mesh,
    /// Inserts the points.
    pub inserter: &'a mut Inserter,
    /// The vertices.
    pub points: &'a mut Points,
    /// The segments.
    pub segments: &'a mut Segments,
    /// What may end the recovery.
    pub(super) control: &'a Control<'a>,
    /// Recovery ends early once it is certain to take at least this many Steiner points.
    pub enough: Option<u64>,
    /// Missing pieces by length (the bits of non-negative doubles sort like their values), then by index.
    queue: BinaryHeap<(u64, Reverse<u32>)>,
    /// Scratch space of [`present`](crate::segments::present).
    pub(super) search: StarSearch,
    pub(super) ring: Vec<(u32, u8)>,
}

impl<'a> Recovery<'a> {
    /// Prepares a recovery; `mesh.vertex_tet` must be up to date.
    pub fn new(
        mesh: &'a mut Mesh,
        inserter: &'a mut Inserter,
        points: &'a mut Points,
        segments: &'a mut Segments,
        control: &'a Control<'a>,
    ) -> Self {
        Recovery {
            mesh,
            inserter,
            points,
            segments,
            control,
            enough: None,
            queue: Default::default(),
            search: StarSearch::default(),
            ring: Vec::new(),
        }
    }

    /// Makes every segment a union of edges. Returns false if it ended early.
    pub fn run(&mut self) -> Result<bool, Error> {
        if let Some(doubtful) = self.segments.doubtful.take() {
            for piece in doubtful {
                self.control.step()?;
                if !self.mark_edge(self.segments.pieces[piece as usize].ends)? {
                    self.enqueue(piece)?;
                }
            }
        } else {
            let present = self.mark_present()?;
            for piece in (0..self.segments.pieces.len()).filter(|&piece| !present[piece]) {
                self.control.step()?;
                self.enqueue(piece as u32)?;
            }
        }
        let missing = (self.queue.len() + self.segments.waiting.len()) as u64;
        self.segments.missing = self.segments.missing.max(missing);
        let mut steps = 0usize;
        loop {
            // A missing piece stays missing until it is split, so each takes at least one point.
            let certain = self.segments.steiner_t.len() + self.queue.len();
            if self.enough.is_some_and(|enough| certain as u64 >= enough) {
                return Ok(false);
            }
            let Some((_, Reverse(piece))) = self.queue.pop() else { return Ok(true) };
            steps += 1;
            if steps % 1024 == 0 {
                let known = steps + self.queue.len();
                self.control.progress(Phase::Segments, steps as f64 / known as f64)?;
            }
            // A split may take a millisecond.
            self.control.look()?;
            // A missing edge stays missing: every sphere through its ends contains some vertex.
            self.split(piece)?;
        }
    }

    /// Inserts a missing piece into the queue.
    fn enqueue(&mut self, piece: u32) -> Result<(), Error> {
        let Subsegment { segment, ends: [a, b], .. } = self.segments.pieces[piece as usize];
        if self.segments.deferred.get(segment as usize) == Some(&true) {
            fallible::push(&mut self.segments.waiting, segment)?;
            return Ok(());
        }
        let length = distance(self.points.xyz(a), self.points.xyz(b));
        Ok(fallible::push_heap(&mut self.queue, (length.to_bits(), Reverse(piece)))?)
    }

    /// Splits a missing piece in two with a Steiner point.
    fn split(&mut self, piece: u32) -> Result<(), Error> {
        let sub = self.segments.pieces[piece as usize];
        self.control.steiner(self.segments.steiner_t.len() as u64 + 1, self.segments.ends.len())?;
        let (reference, near) = self.find_reference(&sub);
        let context = self.context(&sub, reference)?;
        let place = match self.close_parameter(&sub, &context, reference)? {
            Some(place) => place,
            None => self.usual_parameter(&sub, &context, reference)?,
        };
        let t = place.nearest();
        let [a, b] = context.ends;
        let p = self.points.push_on_segment(a, b, &place)?;
        if place.components().len() > 1 {
            fallible::insert(&mut self.segments.fine, p - self.segments.first_steiner, place)?;
        }
        self.inserter.prepare(p as usize + 1)?;
        fallible::push(&mut self.mesh.vertex_tet, NONE)?;
        fallible::push(&mut self.segments.steiner_segment, sub.segment)?;
        fallible::push(&mut self.segments.steiner_t, t)?;
        let at = locate(self.mesh, self.points, p, near)?;
        let touched = self.mesh.verts(at);
        if touched.iter().any(|&v| v != GHOST && self.points.same_position(v, p)) {
            return Err(crossing("a vertex lies on a segment", Element::Segment(sub.segment), None));
        }
        self.inserter.insert::<true, false>(self.mesh, self.points, p, at, self.control)?;
        self.register(piece, sub, p, t)
    }

    /// A parameter in one double if that has enough bits, otherwise the midpoint.
    fn usual_parameter(
        &mut self,
        sub: &Subsegment,
        context: &Context,
        reference: Option<u32>,
    ) -> Result<Expansion, Error> {
        let bits = self.segments.bits(self.points, sub.segment)?;
        let chosen = choose(self.points, sub, context, reference);
        let t = round_parameter(chosen, sub.t[0], sub.t[1], bits)
            .or_else(|| round_parameter(0.5 * (sub.t[0] + sub.t[1]), sub.t[0], sub.t[1], 0));
        if let Some(t) = t {
            return Ok(Expansion::from(self.kindest_parameter(sub, t)));
        }
        let beside = self.beside(sub, context, reference.unwrap_or(sub.ends[0]), OwnSegment::Unknown);
        beside.middle().ok_or_else(|| {
            let segment = Element::Segment(sub.segment);
            crossing("a segment cannot be separated from what it touches", segment, None)
        })
    }

    /// The parameter that matches a reference point so close to the piece that a double is too coarse (see [`close`](crate::segments::close)).
    fn close_parameter(
        &mut self,
        sub: &Subsegment,
        context: &Context,
        reference: Option<u32>,
    ) -> Result<Option<Expansion>, Error> {
        let Some(reference) = reference else { return Ok(None) };
        let span = sub.t[1] - sub.t[0];
        let apart = relative_distance(self.points, context.ends, reference) / span;
        let precision = (f64::EPSILON * sub.t[1] / span).max(USUAL_PRECISION);
        if apart * apart > 16.0 * precision {
            return Ok(None);
        }
        let mut own = context.own;
        for k in 0..2 {
            if own == OwnSegment::Unknown && self.segments.joins(context.ends[k], reference, self.control)? {
                own = OwnSegment::Shares(k);
            }
        }
        Ok(self.beside(sub, context, reference, own).matched(self.points))
    }

    fn beside(&self, sub: &Subsegment, context: &Context, reference: u32, own: OwnSegment) -> Beside {
        let t = sub.ends.map(|v| self.segments.parameter(sub.segment, v));
        Beside { ends: context.ends, t, reference, own }
    }

    /// Among parameters that differ by a negligible amount, the one whose point is nearest to a double: this saves most of the work of
    /// rounding. On segments where rounding failed the search goes further, finally to both ends of the piece: the best position for
    /// rounding depends on planes a fraction of a unit apart.
    fn kindest_parameter(&self, sub: &Subsegment, t: f64) -> f64 {
        let careful = self.segments.careful.get(sub.segment as usize).copied().unwrap_or(0);
        let span = sub.t[1] - sub.t[0];
        let (center, step, tries) = match careful {
            0 => (t, KIND_STEP, KIND_TRIES),
            1 => (t, CAREFUL_STEP, CAREFUL_TRIES),
            level => (sub.t[0] + span * FAR_CENTERS[level as usize % 4], FAR_STEP, CAREFUL_TRIES),
        };
        let [a, b] = self.segments.ends[sub.segment as usize];
        let mut best = (self.points.rounding_error(a, b, t), t);
        if careful > 1 {
            best.0 = f64::INFINITY;
        }
        for k in -tries..=tries {
            if best.0 == 0.0 {
                break;
            }
            let other = center + step * span * k as f64;
            if other > sub.t[0] && other < sub.t[1] {
                let error = self.points.rounding_error(a, b, other);
                if error < best.0 {
                    best = (error, other);
                }
            }
        }
        best.1
    }

    /// Replaces the split piece by its halves and queues the pieces that the insertion destroyed.
    fn register(&mut self, piece: u32, sub: Subsegment, p: u32, t: f64) -> Result<(), Error> {
        let segments = &mut *self.segments;
        segments.piece_of.remove(&edge_key(sub.ends[0], sub.ends[1]));
        let second = segments.pieces.len() as u32;
        segments.pieces[piece as usize] = Subsegment { ends: [sub.ends[0], p], t: [sub.t[0], t], ..sub };
        fallible::push(&mut segments.pieces, Subsegment { ends: [p, sub.ends[1]], t: [t, sub.t[1]], ..sub })?;
        fallible::insert(&mut segments.piece_of, edge_key(sub.ends[0], p), piece)?;
        fallible::insert(&mut segments.piece_of, edge_key(p, sub.ends[1]), second)?;
        for (id, end) in [(piece, sub.ends[0]), (second, sub.ends[1])] {
            if !self.mark_in_fresh(end) {
                self.enqueue(id)?;
            }
        }
        for i in 0..self.inserter.lost_edges.len() {
            let edge = self.inserter.lost_edges[i];
            if let Some(&id) = self.segments.piece_of.get(&edge) {
                self.enqueue(id)?;
            }
        }
        Ok(())
    }

    /// Flags the edge from the vertex just inserted (slot 0 of all new tetrahedra) to `end`; returns whether there is one.
    fn mark_in_fresh(&mut self, end: u32) -> bool {
        let mesh = &mut self.mesh;
        let mut present = false;
        for &t in &self.inserter.fresh {
            if let Some(slot) = mesh.slot_of(t, end) {
                mesh.set_subsegment(t, EDGE_OF[0][slot as usize]);
                present = true;
            }
        }
        present
    }

    /// The segment's ends, whether they are acute if that matters, and the segment of the reference point.
    fn context(&mut self, sub: &Subsegment, reference: Option<u32>) -> Result<Context, Error> {
        let ends = self.segments.ends[sub.segment as usize];
        let mut acute = [false; 2];
        if sub.is_deep() {
            if self.segments.acute.is_empty() {
                self.segments.acute = acute_vertices(self.points, &self.segments.ends, self.control)?;
            }
            acute = ends.map(|v| self.segments.acute[v as usize]);
        }
        let own = reference.and_then(|p| {
            let index = p.checked_sub(self.segments.first_steiner)?;
            Some(self.segments.ends[self.segments.steiner_segment[index as usize] as usize])
        });
        let own = own.map_or(OwnSegment::Unknown, |own| {
            (0..2).find(|&k| own.contains(&ends[k])).map_or(OwnSegment::Apart(own), OwnSegment::Shares)
        });
        Ok(Context { ends, acute, own })
    }

    /// The vertex that sees the piece under the largest angle among those met on a walk from its first end to its second, and the
    /// tetrahedron nearest to it. The walk may be approximate, since it only chooses a point.
    fn find_reference(&self, sub: &Subsegment) -> (Option<u32>, u32) {
        let mesh = &self.mesh;
        let (a, b) = (self.points.xyz(sub.ends[0]), self.points.xyz(sub.ends[1]));
        let mut t = self.mesh.vertex_tet[sub.ends[0] as usize];
        if mesh.is_ghost(t) {
            t = mesh.beyond(t, 3);
        }
        let mut best = (0.0f64, None, t);
        let mut entered = 4;
        for step in 0..1000u32 {
            let v = mesh.verts(t);
            for (slot, &w) in v.iter().enumerate() {
                // The others have already been met.
                let new = entered == 4 || slot == entered as usize;
                if new && !sub.ends.contains(&w) {
                    let angle = obtuse_cosine(self.points.xyz(w), a, b);
                    if angle < best.0 {
                        best = (angle, Some(w), t);
                    }
                }
            }
            if v.contains(&sub.ends[1]) {
                break;
            }
            let mut next = None;
            for i in 0..4u32 {
                let f = (i + step) & 3;
                if f == entered {
                    continue;
                }
                let [x, y, z] = FACE[f as usize].map(|k| self.points.xyz(v[k as usize]));
                if approximate_orient3d(b, x, y, z) < 0.0 {
                    next = Some(mesh.across(4 * t + f));
                    break;
                }
            }
            match next {
                Some(code) if !mesh.is_ghost(code >> 2) => {
                    t = code >> 2;
                    entered = code & 3;
                }
                _ => break,
            }
        }
        (best.1, best.2)
    }
}

/// The cosine of the angle under which `p` sees the segment `a b` if it exceeds 90°, otherwise zero.
fn obtuse_cosine(p: &[f64; 3], a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let u = [a[0] - p[0], a[1] - p[1], a[2] - p[2]];
    let v = [b[0] - p[0], b[1] - p[1], b[2] - p[2]];
    let dot = |x: &[f64; 3], y: &[f64; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    let product = dot(&u, &v);
    if product < 0.0 {
        product / (dot(&u, &u) * dot(&v, &v)).sqrt()
    } else {
        0.0
    }
}

/// The determinant of [`crate::predicates::orient3d`] in floating-point arithmetic.
fn approximate_orient3d(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3]) -> f64 {
    let u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let v = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    let w = [d[0] - a[0], d[1] - a[1], d[2] - a[2]];
    u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
}
