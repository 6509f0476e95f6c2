//! A point on a segment: in the middle of a piece, at a parameter of few bits.
//!
//! At an end where segments meet at less than 60° it is at a power of two from that end instead (Ruppert 1995, concentric shells): pieces of
//! equal length do not encroach upon each other.
use super::{nearest, Attempt, Need, Refine, Target, What};
use crate::control::Control;
use crate::elementary::{exponent, power_of_two, quotient};
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::EdgeRing;
use crate::kernel::{edge_key, NONE};
use crate::ops::insert::{Opening, Outcome, Place};
use crate::predicates::{Expansion, Points};
use crate::segments::placement::{round_parameter, Subsegment};
use crate::segments::recovery::Segments;
use crate::size::distance;
use crate::vector::{dot, sub};

/// The directions at a vertex that are compared with each other: at most this many, since among thirteen two always meet at less than 60°.
const DIRECTIONS: usize = 13;

/// By input vertex, whether two segments meet there at less than 60°.
pub(super) fn acute(points: &Points, segments: &Segments, control: &Control) -> Result<Vec<bool>, Error> {
    let mut incident: Vec<[u32; 2]> = fallible::reserved(2 * segments.ends.len())?;
    for &[a, b] in &segments.ends {
        fallible::push(&mut incident, [a, b])?;
        fallible::push(&mut incident, [b, a])?;
    }
    control.sort(&mut incident)?;
    let mut acute = fallible::filled(false, segments.first_steiner as usize)?;
    for group in incident.chunk_by(|x, y| x[0] == y[0]) {
        control.step()?;
        let v = group[0][0];
        let others = &group[..group.len().min(DIRECTIONS)];
        let narrow = |x: u32, y: u32| {
            let [d, e] = [x, y].map(|w| sub(points.xyz(w), points.xyz(v)));
            dot(&d, &e) > 0.5 * (dot(&d, &d) * dot(&e, &e)).sqrt()
        };
        acute[v as usize] =
            others.iter().enumerate().any(|(i, x)| others[..i].iter().any(|y| narrow(x[1], y[1])));
    }
    Ok(acute)
}

impl Refine<'_, '_> {
    /// Tries to split a subsegment.
    pub(super) fn attempt_on_edge(&mut self, edge: [u32; 2], need: Need) -> Result<Attempt, Error> {
        let Some(&piece) = self.segments.piece_of.get(&edge_key(edge[0], edge[1])) else {
            return Ok(Attempt::Refused);
        };
        let sub = self.segments.pieces[piece as usize];
        let [a, b] = sub.ends;
        let (p, q) = (*self.points.xyz(a), *self.points.xyz(b));
        let half = [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
        // Half of the piece is the most that there can be.
        let too_short = 0.5 * distance(&p, &q) < if need.large { need.on_segment } else { need.least };
        let known = !need.large && self.near.pieces.contains(&piece);
        if too_short {
            return Ok(Attempt::TooNear);
        }
        if known || sub.is_deep() || self.is_kept(&half) {
            return Ok(Attempt::Refused);
        }
        let Some(t) = self.parameter(&sub)? else { return Ok(Attempt::Refused) };
        let start = self.mesh.vertex_tet[a as usize];
        if start == NONE {
            return Ok(Attempt::Refused);
        }
        let found = self.search.find_edge(self.mesh, a, b, start)?;
        let ring = found.into_iter().flat_map(|t| EdgeRing::new(self.mesh, t, a, b));
        let Some(start) = ring.map(|x| x.0).find(|&t| !self.mesh.is_ghost(t)) else {
            return Ok(Attempt::Refused);
        };
        let ring = EdgeRing::new(self.mesh, start, a, b).map(|x| self.mesh.changed(x.0));
        let since = ring.fold(0, u64::max);
        let known = self.near.blocked.get(&piece).filter(|&&(_, then)| then == since);
        if let Some(&(other, _)) = known {
            return Ok(Attempt::Instead(Target::Edge(other)));
        }
        let [first, last] = self.segments.ends[sub.segment as usize];
        let v = self.points.push_on_segment(first, last, &Expansion::from(t))?;
        let mut crowded = false;
        let attempt = self.insert_on_edge(v, Place { edge: sub.ends, start }, need, &mut crowded)?;
        match attempt {
            Attempt::Done => {
                self.segments.add_steiner(piece, v, t)?;
                self.near.pieces.remove(&piece);
                self.near.blocked.remove(&piece);
            }
            Attempt::Instead(Target::Edge(other)) => {
                fallible::insert(&mut self.near.blocked, piece, (other, since))?;
                self.points.pop();
            }
            _ => self.points.pop(),
        }
        if matches!(attempt, Attempt::TooNear) && crowded && self.what == What::Walls {
            fallible::add(&mut self.near.pieces, piece)?;
        }
        Ok(attempt)
    }

    /// Where a piece is split; `None` if there is no room between its ends.
    fn parameter(&mut self, sub: &Subsegment) -> Result<Option<f64>, Error> {
        let [first, last] = self.segments.ends[sub.segment as usize];
        let [t0, t1] = sub.t;
        let length = distance(self.points.xyz(first), self.points.xyz(last));
        let is_acute = |end: u32| self.acute.get(end as usize) == Some(&true);
        // Between a third and two thirds of the piece.
        let shell = power_of_two(exponent(2.0 / 3.0 * (t1 - t0) * length));
        let wanted = match (t0 == 0.0 && is_acute(first), t1 == 1.0 && is_acute(last)) {
            (true, false) => quotient(shell, length),
            (false, true) => quotient(shell, length).map(|x| 1.0 - x),
            _ => None,
        };
        let wanted = wanted.unwrap_or(0.5 * (t0 + t1));
        let bits = self.segments.bits(self.points, sub.segment)?;
        Ok(round_parameter(wanted, t0, t1, bits))
    }

    fn insert_on_edge(
        &mut self,
        p: u32,
        place: Place,
        need: Need,
        crowded: &mut bool,
    ) -> Result<Attempt, Error> {
        let at = *self.points.xyz(p);
        let Place { edge: ends, start } = place;
        let region = self.mesh.region(start);
        let wanted = self.size.at(self.points, &at, region, &ends)?;
        let floor = self.floor.at(self.points, &at, ends.into_iter());
        let others = self.least_from_others(need, floor);
        let Refine { mesh, points, insert, .. } = self;
        // What is in its sphere does not count: subsegments that meet at its ends would take turns.
        let accept = |opening: Opening| {
            if need.large {
                return Ok(ends.iter().all(|&v| distance(opening.points.xyz(v), &at) >= need.on_segment));
            }
            // Half of the piece was long enough.
            *crowded = nearest(&opening, &at) < others;
            Ok(!*crowded)
        };
        match insert.on_segment_after(mesh, points, p, place, &self.part, accept)? {
            Some(Outcome::Inserted | Outcome::Squeezed(_)) => {}
            Some(Outcome::Blocked(edge)) => return Ok(Attempt::Instead(Target::Edge(edge))),
            Some(_) => return Ok(Attempt::Refused),
            None => return Ok(Attempt::TooNear),
        }
        self.counts.on_segments += 1;
        self.size.set(p, wanted)?;
        self.floor.set(p, floor)?;
        self.count()?;
        Ok(Attempt::Done)
    }
}
