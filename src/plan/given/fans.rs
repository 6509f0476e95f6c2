//! Around an edge: tetrahedra form a closed ring, or fans between two boundary faces each.
//!
//! A ring must go round once, and fans must be apart. Both are decided by the sides of half-planes at the edge: a tetrahedron takes less
//! than half a turn, so two exact signs tell whether a half-plane is in it. Fans are sorted by angle. Where one ends and the next one
//! begins, only void is between them: the kernel needs to know that.
//!
//! If each ring goes round once, neighbourhoods of inner edges are embedded, hence those of inner vertices: their link covers the sphere
//! without branching, and the sphere has no other covering.
use crate::control::Control;
use crate::error::{DefectKind, Element, Error};
use crate::fallible;
use crate::kernel::edge_key;
use crate::kernel::given::Beside;
use crate::kernel::tables::{EDGE, EDGE_OF, FACE, OTHERS};
use crate::kernel::NONE;
use crate::plan::given::faults::Faults;
use crate::predicates::{Points, Sign};
use std::cmp::Ordering;

/// A tetrahedron at an edge (a, b): `(a, b, from, to)` is positive.
#[derive(Clone, Copy)]
struct Wedge {
    t: u32,
    /// Slots of the edge's ends.
    edge: [u8; 2],
    /// Slots of the other two corners.
    from: u8,
    to: u8,
}

/// The tetrahedra between two boundary faces.
struct Fan {
    /// Where it begins and ends: a corner of each of these faces, and the codes of the faces.
    from: u32,
    to: u32,
    codes: [u32; 2],
    /// Its first tetrahedron's other corner.
    next: u32,
}

/// A boundary face at an edge.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Rim {
    edge: [u32; 2],
    code: u32,
}

struct Around<'a> {
    points: &'a Points,
    tets: &'a [[u32; 4]],
    across: &'a [[u32; 4]],
    /// By tetrahedron, the edges that have been gone round, one bit each.
    done: Vec<u8>,
}

/// Goes round all edges. Returns which boundary faces have only void between them, if there are no faults.
///
/// # Errors
/// `OutOfMemory`, and what ends the run.
pub(super) fn fans(
    points: &Points,
    tets: &[[u32; 4]],
    across: &[[u32; 4]],
    faults: &mut Faults,
    control: &Control,
) -> Result<Vec<Beside>, Error> {
    let mut rims: Vec<Rim> = Vec::new();
    for (t, beyond) in (0..).zip(across) {
        for f in (0..4).filter(|&f| beyond[f as usize] == NONE) {
            let [x, y, z] = FACE[f as usize].map(|k| tets[t as usize][k as usize]);
            let code = 4 * t + f;
            let rim = |(a, b)| Rim { edge: edge_key(a, b), code };
            fallible::extend(&mut rims, [(x, y), (y, z), (z, x)].map(rim))?;
        }
    }
    control.sort(&mut rims)?;
    let mut around = Around { points, tets, across, done: fallible::filled(0, tets.len())? };
    let mut beside = fallible::reserved(rims.len() / 2)?;
    let mut found: Vec<Fan> = Vec::new();
    for run in rims.chunk_by(|x, y| x.edge == y.edge) {
        control.step()?;
        found.clear();
        for rim in run {
            if let Some(fan) = around.fan(*rim, faults, control)? {
                fallible::push(&mut found, fan)?;
            }
        }
        around.order(run[0].edge, &mut found, faults, control)?;
        for (i, fan) in found.iter().enumerate() {
            let next = &found[(i + 1) % found.len()];
            fallible::push(&mut beside, Beside { edge: run[0].edge, codes: [fan.codes[1], next.codes[0]] })?;
        }
    }
    around.rings(&rims, faults, control)?;
    Ok(beside)
}

impl Around<'_> {
    fn vertex(&self, wedge: Wedge, slot: u8) -> u32 {
        self.tets[wedge.t as usize][slot as usize]
    }

    /// A tetrahedron at its edge between these slots.
    fn wedge(t: u32, edge: [u8; 2]) -> Wedge {
        let [from, to] = OTHERS[edge[0] as usize][edge[1] as usize];
        Wedge { t, edge, from, to }
    }

    /// The next tetrahedron around the edge; `None` at the boundary. Marks the one left as done.
    fn turn(&mut self, wedge: Wedge) -> Option<Wedge> {
        let [i, j] = wedge.edge;
        self.done[wedge.t as usize] |= 1 << EDGE_OF[i as usize][j as usize];
        let code = self.across[wedge.t as usize][wedge.from as usize];
        if code == NONE {
            return None;
        }
        let other = &self.tets[(code >> 2) as usize];
        let slot = |s: u8| other.iter().position(|&v| v == self.vertex(wedge, s)).map(|k| k as u8);
        Some(Self::wedge(code >> 2, [slot(i)?, slot(j)?]))
    }

    /// Whether a half-plane at the edge, through `v`, is in a tetrahedron or bounds it.
    fn holds(&self, wedge: Wedge, v: u32) -> bool {
        let [a, b] = wedge.edge.map(|s| self.vertex(wedge, s));
        let [from, to] = [wedge.from, wedge.to].map(|s| self.vertex(wedge, s));
        self.points.orient3d(a, b, from, v) != Sign::Negative
            && self.points.orient3d(a, b, v, to) != Sign::Negative
    }

    /// The fan that begins at a boundary face; `None` if one ends there.
    fn fan(&mut self, rim: Rim, faults: &mut Faults, control: &Control) -> Result<Option<Fan>, Error> {
        let tet = &self.tets[(rim.code >> 2) as usize];
        let slot = |v: u32| tet.iter().position(|&w| w == v).map_or(0, |k| k as u8);
        let mut wedge = Self::wedge(rim.code >> 2, rim.edge.map(slot));
        if u32::from(wedge.to) != rim.code & 3 {
            return Ok(None);
        }
        let (first, from, next) = (wedge.t, self.vertex(wedge, wedge.from), self.vertex(wedge, wedge.to));
        let mut is_good = true;
        while let Some(other) = self.turn(wedge) {
            control.step()?;
            wedge = other;
            is_good &= !self.holds(wedge, from);
        }
        if !is_good {
            let (kind, second) = (DefectKind::NotConforming, Some(Element::Tet(wedge.t)));
            faults.add(kind, Element::Tet(first), second, rim.edge[0]);
        }
        let codes = [rim.code, 4 * wedge.t + u32::from(wedge.from)];
        Ok(Some(Fan { from, to: self.vertex(wedge, wedge.to), codes, next }))
    }

    /// Sorts the fans at an edge by angle, and finds those that overlap.
    fn order(
        &self,
        [a, b]: [u32; 2],
        fans: &mut Vec<Fan>,
        faults: &mut Faults,
        control: &Control,
    ) -> Result<(), Error> {
        if fans.len() < 2 {
            return Ok(());
        }
        let (from, next) = (fans[0].from, fans[0].next);
        let side = |v, w| self.points.orient3d(a, b, v, w);
        // Half-planes from the first one on: itself, those within half a turn, the opposite one, the others.
        let sector = |v: u32| match side(from, v) {
            Sign::Positive => 1,
            Sign::Negative => 3,
            Sign::Zero if side(v, next) == Sign::Positive => 0,
            Sign::Zero => 2,
        };
        let by_angle = |v: u32, w: u32| {
            let sectors = [sector(v), sector(w)];
            if sectors[0] != sectors[1] || sectors[0] % 2 == 0 {
                return sectors[0].cmp(&sectors[1]);
            }
            match side(v, w) {
                Sign::Positive => Ordering::Less,
                Sign::Negative => Ordering::Greater,
                Sign::Zero => Ordering::Equal,
            }
        };
        let mut list = fallible::collect(std::mem::take(fans))?;
        control.sort_by(&mut list, |x, y| by_angle(x.from, y.from).then(x.codes[0].cmp(&y.codes[0])))?;
        for pair in list.windows(2) {
            control.step()?;
            // Each ends strictly before the next one begins, and none comes back to the first half-plane.
            let [x, y] = pair else { continue };
            let good = by_angle(x.from, x.to) == Ordering::Less && by_angle(x.to, y.from) == Ordering::Less;
            if !good {
                let (first, second) = (Element::Tet(x.codes[0] >> 2), Element::Tet(y.codes[0] >> 2));
                faults.add(DefectKind::NotConforming, first, Some(second), a);
            }
        }
        let closes = list.last().is_some_and(|last| by_angle(last.from, last.to) == Ordering::Less);
        if let (false, [first, .., last]) = (closes, &list[..]) {
            let (first, second) = (Element::Tet(last.codes[0] >> 2), Element::Tet(first.codes[0] >> 2));
            faults.add(DefectKind::NotConforming, first, Some(second), a);
        }
        *fans = list;
        Ok(())
    }

    /// Goes round the edges that are not on the boundary.
    fn rings(&mut self, rims: &[Rim], faults: &mut Faults, control: &Control) -> Result<(), Error> {
        let mut rings: Vec<([u32; 2], u32)> = Vec::new();
        for t in 0..self.tets.len() as u32 {
            control.step()?;
            for (e, &edge) in EDGE.iter().enumerate() {
                if self.done[t as usize] >> e & 1 != 0 {
                    continue;
                }
                let start = Self::wedge(t, edge);
                let [a, b] = edge.map(|s| self.vertex(start, s));
                fallible::push(&mut rings, (edge_key(a, b), t))?;
                let from = self.vertex(start, start.from);
                let mut wedge = start;
                while let Some(next) = self.turn(wedge).filter(|next| next.t != t) {
                    control.step()?;
                    // The last one ends there.
                    if self.vertex(next, next.to) != from && self.holds(next, from) {
                        let (kind, second) = (DefectKind::NotConforming, Some(Element::Tet(next.t)));
                        faults.add(kind, Element::Tet(t), second, a);
                    }
                    wedge = next;
                }
            }
        }
        // A ring leaves no room for another, nor for a fan.
        control.sort(&mut rings)?;
        for pair in rings.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            let (first, second) = (Element::Tet(pair[0].1), Element::Tet(pair[1].1));
            faults.add(DefectKind::NotConforming, first, Some(second), pair[0].0[0]);
        }
        let mut rings = rings.into_iter().peekable();
        for rim in rims {
            while rings.next_if(|ring| ring.0 < rim.edge).is_some() {}
            if let Some((edge, t)) = rings.next_if(|ring| ring.0 == rim.edge) {
                let second = Some(Element::Tet(rim.code >> 2));
                faults.add(DefectKind::NotConforming, Element::Tet(t), second, edge[0]);
            }
        }
        Ok(())
    }
}
