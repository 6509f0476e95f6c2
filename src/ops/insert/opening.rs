//! The cavity of a vertex: what is in conflict with it, less what it does not see; whether new tetrahedra may take its place.
//!
//! Invariants: `tets` has the cavity in the order in which it was found, `inside` the same as a set. Every tetrahedron that contains the
//! vertex stays in it, or the vertex is not where it should be.
use crate::error::Error;
use crate::fallible;
use crate::ops::insert::scene::Scene;
use crate::ops::insert::{misplaced, Insert, Outcome};
use crate::predicates::Sign;

/// A face of the cavity's boundary as seen from inside, and its tetrahedron.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// Its vertices.
    pub corners: [u32; 3],
    /// The tetrahedron of the cavity.
    pub tet: u32,
}

/// A face of the cavity at a subsegment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Beside {
    /// The subsegment.
    key: u64,
    /// The number of the face.
    face: u32,
    /// Its vertex opposite.
    apex: u32,
}

impl Insert {
    /// Adds a tetrahedron to the cavity.
    pub(super) fn seed(&mut self, t: u32) -> Result<(), Error> {
        self.met.insert(t)?;
        if self.inside.insert(t)? {
            fallible::push(&mut self.tets, t)?;
        }
        Ok(())
    }

    /// Grows the cavity, bounds it, and decides.
    pub(super) fn open(&mut self, scene: Scene) -> Result<Outcome, Error> {
        self.grow(scene)?;
        let mut obstacle = None;
        // Every turn but the last takes a tetrahedron out.
        loop {
            let mut found = self.bound(scene, obstacle.is_none())?;
            if self.bad.is_empty() {
                self.find_rim(scene)?;
                found = self.examine(scene)?;
            }
            obstacle = obstacle.or(found);
            match obstacle {
                Some(edge) if !self.squeeze => return Ok(Outcome::Blocked(edge)),
                _ if self.bad.is_empty() => break,
                _ => self.shrink(scene)?,
            }
        }
        Ok(obstacle.map_or(Outcome::Inserted, Outcome::Squeezed))
    }

    /// Adds all tetrahedra in conflict that are reached without crossing a wall.
    fn grow(&mut self, scene: Scene) -> Result<(), Error> {
        let mesh = scene.mesh;
        let mut next = 0;
        while next < self.tets.len() {
            scene.control.step()?;
            let t = self.tets[next];
            next += 1;
            for code in 4 * t..4 * t + 4 {
                let n = mesh.across(code) >> 2;
                if !mesh.is_wall(code) && self.met.insert(n)? && scene.conflict(n) {
                    self.inside.insert(n)?;
                    fallible::push(&mut self.tets, n)?;
                }
            }
        }
        Ok(())
    }

    /// Collects the faces of the cavity, and its tetrahedra with faces that the vertex does not see; returns the subsegment in the way if it
    /// is asked for.
    fn bound(&mut self, scene: Scene, seek: bool) -> Result<Option<[u32; 2]>, Error> {
        let mesh = scene.mesh;
        self.faces.clear();
        self.bad.clear();
        for &t in &self.tets {
            scene.control.step()?;
            let mut good = true;
            for code in 4 * t..4 * t + 4 {
                let n = mesh.across(code) >> 2;
                let passed = if mesh.is_wall(code) {
                    self.wall_codes.contains(code) && (mesh.is_ghost(n) || self.inside.contains(n))
                } else {
                    self.inside.contains(n)
                };
                if !passed {
                    let corners = mesh.face(code);
                    good &= scene.side(corners) == Sign::Positive;
                    fallible::push(&mut self.faces, Face { corners, tet: t })?;
                }
            }
            if !good {
                fallible::push(&mut self.bad, t)?;
            }
        }
        if self.bad.is_empty() || !seek {
            return Ok(None);
        }
        match scene.widest(&self.bad)? {
            None => scene.widest(&self.tets),
            found => Ok(found),
        }
    }

    /// Takes the bad tetrahedra, which are in the order of the cavity's, out of it.
    fn shrink(&mut self, scene: Scene) -> Result<(), Error> {
        let mut bad = self.bad.iter().peekable();
        self.tets.retain(|t| bad.next_if_eq(&t).is_none());
        self.inside.begin();
        for &t in &self.tets {
            scene.control.step()?;
            self.inside.insert(t)?;
        }
        self.walls.retain(|wall| self.inside.contains(wall.code >> 2));
        if self.tets.is_empty() || self.bad.iter().any(|&t| scene.contains(t)) {
            return Err(misplaced());
        }
        Ok(())
    }

    /// Tests what the faces that the vertex sees do not tell: that no vertex or subsegment gets lost, and that the new faces at subsegments
    /// are locally Delaunay. Where something would get lost the last tetrahedron at it that does not contain the vertex is bad.
    fn examine(&mut self, scene: Scene) -> Result<Option<[u32; 2]>, Error> {
        self.corners.begin();
        for face in &self.faces {
            scene.control.step()?;
            for v in face.corners {
                self.corners.insert(v)?;
            }
        }
        self.subsegments.clear();
        for &t in &self.tets {
            scene.control.step()?;
            if let Some(lost) = scene.mesh.verts(t).into_iter().find(|&v| !self.corners.contains(v)) {
                self.give_up(scene, &[lost])?;
                return scene.widest(&self.tets);
            }
            if scene.mesh.subsegment_bits(t) != 0 {
                fallible::extend(&mut self.subsegments, scene.subsegments(t).map(packed))?;
            }
        }
        if self.subsegments.is_empty() {
            return Ok(None);
        }
        scene.control.sort(&mut self.subsegments)?;
        self.subsegments.dedup();
        self.find_beside(scene)?;
        let mut groups = self.beside.chunk_by(|x, y| x.key == y.key).peekable();
        let mut obstacle = None;
        for &key in &self.subsegments {
            scene.control.step()?;
            let edge = unpacked(key);
            let Some(group) = groups.next_if(|group| group[0].key == key) else {
                self.give_up(scene, &edge)?;
                return Ok(Some(edge));
            };
            if let ([x, y], false) = (group, self.is_on_rim(edge)) {
                let [a, b, c] = self.faces[x.face as usize].corners;
                if scene.points.insphere_perturbed(scene.p, a, b, c, y.apex) == Sign::Positive {
                    obstacle = obstacle.or(Some(edge));
                }
            }
        }
        Ok(obstacle)
    }

    /// Finds the cavity's faces at its subsegments, in the order of these.
    fn find_beside(&mut self, scene: Scene) -> Result<(), Error> {
        self.beside.clear();
        for (face, &Face { corners, tet }) in (0..).zip(&self.faces) {
            scene.control.step()?;
            if scene.mesh.subsegment_bits(tet) == 0 {
                continue;
            }
            for [a, b] in scene.subsegments(tet) {
                let apex = corners.into_iter().find(|&v| v != a && v != b);
                if let (true, true, Some(apex)) = (corners.contains(&a), corners.contains(&b), apex) {
                    fallible::push(&mut self.beside, Beside { key: packed([a, b]), face, apex })?;
                }
            }
        }
        scene.control.sort(&mut self.beside)
    }

    /// The last tetrahedron with all these vertices that does not contain the vertex to be inserted becomes bad.
    fn give_up(&mut self, scene: Scene, lost: &[u32]) -> Result<(), Error> {
        let at = |&&t: &&u32| lost.iter().all(|&v| scene.mesh.slot_of(t, v).is_some()) && !scene.contains(t);
        let last = self.tets.iter().rev().find(at).ok_or_else(misplaced)?;
        Ok(fallible::push(&mut self.bad, *last)?)
    }
}

/// An edge's key as one number, in the same order: that sorts faster.
pub(super) fn packed([a, b]: [u32; 2]) -> u64 {
    u64::from(a) << 32 | u64::from(b)
}

/// The key again.
pub(super) fn unpacked(key: u64) -> [u32; 2] {
    [(key >> 32) as u32, key as u32]
}
