//! Insertion of a vertex into a constrained Delaunay tetrahedralization (CDT), which stays one: in the interior, on a facet, on a segment.
//!
//! Bowyer 1981 and Watson 1981; with constraints Shewchuk 1998, Si 2008 and 2015. The tetrahedra whose perturbed circumsphere contains the
//! vertex p, reached from p without crossing a wall, make room for those that join p to their boundary. On a facet or a segment, p also
//! splits *sheets*: walls at p, each sheet in one plane and on one side of the segment. The walls of a sheet whose circumcircle contains p,
//! reached without crossing a subsegment, make room for triangles at p; where the domain ends at them, so do the ghosts beyond.
//!
//! Why it works:
//! 1. *Circles and spheres agree.* If p is in the plane of a wall, the perturbed spheres of both its tetrahedra contain p exactly if its
//!    perturbed circle does. So a sphere is the test for a wall too, and both sides of it give the same answer.
//! 2. *What p sees in conflict is connected.* On a ray from p the lifted tetrahedra are a convex function up to the first wall, so all
//!    before one in conflict are in conflict: the search finds each one of which p sees a part.
//! 3. *If there is a CDT with p, the cavity is right.* Its tetrahedra without p are constrained Delaunay without p as well, hence in the
//!    mesh; those that it lacks are what p sees in conflict. So p sees every face of the cavity strictly from inside, and no subsegment is
//!    in the cavity's interior. (There is one if all subsegments are edges of the perturbed Delaunay tetrahedralization: Shewchuk 1998.)
//! 4. *If the cavity passes these tests, the result is a CDT, but for new faces at subsegments.* Let faces f and g of the cavity share an
//!    edge e that is no subsegment. If the angle inside at e is at most 180°, the old tetrahedra round e from f to g are a convex chain
//!    above the plane of p f. If it is larger, those outside are one: no wall is among them, since walls at e are two, in one plane or of
//!    the convex hull, which leave no such angle inside. Either way the new face p e is locally Delaunay. At subsegments it is tested.
//! 5. *A smaller cavity is always possible.* Tetrahedra with a face that p does not see from inside leave, again and again; likewise one at
//!    a subsegment or vertex that has only tetrahedra of the cavity round it. Those that contain p never do. What remains is star-shaped:
//!    a part that p is not in has faces turned away from p.
//!
//! So a test fails only where a subsegment is in the way. Then the vertex is [`Outcome::Blocked`] and nothing changes, or it is
//! [`Outcome::Squeezed`] in with a smaller cavity. The latter is needed since two subsegments can block each other's vertices.
//!
//! The vertex may have any kind of position: every decision is an exact sign by its number. So what lies on a facet or a segment that doubles
//! miss (`push_on_facet`, `push_in_triangle` and `push_on_segment` of [`Points`]) is inserted there, and what is near it is not.
//!
//! Only the replacement at the end changes the mesh: a vertex that is refused, and a run that ends before, leave it as it was.
mod opening;
mod scene;

use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::EdgeRing;
use crate::kernel::replace::{Replace, Sector};
use crate::kernel::visited::Visited;
use crate::kernel::{Mesh, GHOST, NONE};
use crate::predicates::{orient3d, Points, Sign};
use opening::Beside;
pub use opening::Face;
use scene::{Rim, Scene, Split};

/// How many tetrahedra may be looked at for refused vertices: these, and so many for each that came with a vertex. With 30 a model
/// (bracket) has 31,000 tetrahedra instead of 55,000, in 2.2 s instead of 5.2 s; others stay the same (measured
/// before the number of points for a shape was bounded by the input).
const LEAST_WASTE: u64 = 1_000_000;
const WASTE: u64 = 100;

/// What became of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It is in the mesh, which is constrained Delaunay if it was before.
    Inserted,
    /// It is in the mesh, but faces near this subsegment may not be locally Delaunay.
    Squeezed([u32; 2]),
    /// Nothing has changed: there is no CDT with it, unless this subsegment, or one near it, is split.
    Blocked([u32; 2]),
    /// Nothing has changed: this vertex is there already.
    Occupied(u32),
}

/// An edge, and a tetrahedron that has it.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Its ends.
    pub edge: [u32; 2],
    /// No ghost.
    pub start: u32,
}

/// What a vertex is to be inserted into.
#[derive(Clone, Copy)]
pub struct Opening<'a> {
    /// The mesh before.
    pub mesh: &'a Mesh,
    /// With the vertex.
    pub points: &'a Points,
    /// What bounds the cavity.
    pub faces: &'a [Face],
    /// See [`Opening::subsegments`].
    subsegments: &'a [u64],
    rim: &'a [Rim],
}

impl Opening<'_> {
    /// The subsegments of the cavity's tetrahedra but for the one that is split, by their keys.
    pub fn subsegments(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.subsegments.iter().map(|&key| opening::unpacked(key))
    }

    /// The vertices that bound what is split of walls; some come twice.
    pub fn rim_vertices(&self) -> impl Iterator<Item = u32> + '_ {
        self.rim.iter().flat_map(|rim| rim.edge)
    }

    /// The faces that are walls: their corners' codes inside, and their vertices.
    pub fn walls(&self) -> impl Iterator<Item = (u32, [u32; 3])> + '_ {
        self.faces.iter().filter_map(|face| {
            let mut codes = 4 * face.tet..4 * face.tet + 4;
            let code = codes.find(|&code| !face.corners.contains(&self.mesh.apex(code)))?;
            self.mesh.is_wall(code).then_some((code, face.corners))
        })
    }
}

/// Inserts vertices; keeps its scratch space.
///
/// The tetrahedra and corners that callers give are live ones of the mesh.
#[derive(Default)]
pub struct Insert {
    /// Insert also where a subsegment is in the way.
    pub squeeze: bool,
    /// Insert only where what comes is positive at the nearest doubles too: then rounding has nothing to mend there.
    pub rounded: bool,
    /// The tetrahedra of all cavities of vertices that were blocked or not accepted, and those that came with the others.
    wasted: u64,
    made: u64,
    /// The cavity, without ghosts.
    tets: Vec<u32>,
    inside: Visited,
    /// Those tested and those in the cavity.
    met: Visited,
    /// The walls that go, and the corner codes of both sides.
    walls: Vec<Split>,
    wall_codes: Visited,
    /// What bounds the cavity, and its tetrahedra with faces that the vertex does not see.
    faces: Vec<Face>,
    bad: Vec<u32>,
    rim: Vec<Rim>,
    corners: Visited,
    /// The edge that the vertex is to split.
    edge: Option<[u32; 2]>,
    /// Subsegments of the cavity, sorted, and the faces at them.
    subsegments: Vec<u64>,
    beside: Vec<Beside>,
    /// Voids, then regions; how many are in use.
    sectors: Vec<Sector>,
    used: usize,
    replace: Replace,
}

impl Insert {
    /// One that inserts also where a subsegment is in the way, or the mesh is not constrained Delaunay.
    pub fn squeezing() -> Insert {
        Insert { squeeze: true, ..Insert::default() }
    }

    /// One that inserts only where what comes is positive at the nearest doubles too.
    pub fn rounding() -> Insert {
        Insert { rounded: true, ..Insert::default() }
    }

    /// Inserts `p`, which must be in tetrahedron `start` (or on its boundary) and on no wall or subsegment.
    ///
    /// # Errors
    /// `Internal` if it is not, `OutOfMemory`, `TooLarge`, and what ends the run.
    #[cfg(test)]
    pub fn interior(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        p: u32,
        start: u32,
        control: &Control,
    ) -> Result<Outcome, Error> {
        let outcome = self.open_interior(mesh, points, p, start, control)?;
        if let Outcome::Occupied(_) = outcome {
            return Ok(outcome);
        }
        self.fill(mesh, p, outcome, control)
    }

    /// The same if `accept` agrees, which is shown the tetrahedra that would go and what bounds them; `None` if it does not. It may move the
    /// vertex to where it sees all faces.
    ///
    /// # Errors
    /// As [`Insert::interior`], and those of `accept`.
    pub fn interior_if(
        &mut self,
        mesh: &mut Mesh,
        points: &mut Points,
        p: u32,
        start: u32,
        control: &Control,
        accept: impl FnOnce(&Mesh, &mut Points, &[u32], &[Face]) -> Result<bool, Error>,
    ) -> Result<Option<Outcome>, Error> {
        let outcome = self.open_interior(mesh, points, p, start, control)?;
        let there = matches!(outcome, Outcome::Inserted | Outcome::Squeezed(_));
        if there && accept(mesh, points, &self.tets, &self.faces)? && self.stays_positive(points, p) {
            return self.fill(mesh, p, outcome, control).map(Some);
        }
        self.wasted += self.tets.len() as u64;
        Ok((!there).then_some(outcome))
    }

    /// As [`Insert::interior_if`], where `accept` only looks on: what became of the vertex, `None` if it does not agree.
    ///
    /// # Errors
    /// As [`Insert::interior_if`].
    pub fn interior_after(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        p: u32,
        start: u32,
        control: &Control,
        accept: impl FnOnce(Opening) -> Result<bool, Error>,
    ) -> Result<Option<Outcome>, Error> {
        let outcome = self.open_interior(mesh, points, p, start, control)?;
        self.fill_if(mesh, points, p, outcome, control, accept)
    }

    /// Whether most work was for vertices that were blocked or not accepted: the next ones will hardly fare better.
    pub fn is_wasting(&self) -> bool {
        self.wasted > LEAST_WASTE + WASTE * self.made
    }

    /// The tetrahedra that came with the last vertex.
    pub fn fresh(&self) -> &[u32] {
        &self.replace.fresh
    }

    /// The cavity of a vertex inside.
    fn open_interior(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        p: u32,
        start: u32,
        control: &Control,
    ) -> Result<Outcome, Error> {
        let scene = Scene { mesh, points, p, edge: None, control };
        if mesh.is_ghost(start) {
            return Err(misplaced());
        }
        if let Some(v) = scene.occupied(&mesh.verts(start)) {
            return Ok(Outcome::Occupied(v));
        }
        let on_wall = |code| mesh.is_wall(code) && scene.side(mesh.face(code)) == Sign::Zero;
        if !scene.contains(start) || (4 * start..4 * start + 4).any(on_wall) {
            return Err(misplaced());
        }
        self.begin();
        self.seed(start)?;
        self.open(scene)
    }

    /// Inserts `p`, which must be on the wall `code` (a subface, or a face of the domain's boundary) and on no subsegment.
    ///
    /// # Errors
    /// `Internal` if it is not, `OutOfMemory`, `TooLarge`, and what ends the run.
    #[cfg(test)]
    pub fn on_facet(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        p: u32,
        code: u32,
        control: &Control,
    ) -> Result<Outcome, Error> {
        let outcome = self.open_facet(mesh, points, p, code, control)?;
        if let Outcome::Occupied(_) = outcome {
            return Ok(outcome);
        }
        self.fill(mesh, p, outcome, control)
    }

    /// Inserts `p`, which must be on the wall `code` and on no subsegment, if `accept` agrees, which is shown what would go and what bounds
    /// it; `None` if it does not.
    ///
    /// # Errors
    /// `Internal` if it is not there, `OutOfMemory`, `TooLarge`, those of `accept`, and what ends the run.
    pub fn on_facet_after(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        p: u32,
        code: u32,
        control: &Control,
        accept: impl FnOnce(Opening) -> Result<bool, Error>,
    ) -> Result<Option<Outcome>, Error> {
        let outcome = self.open_facet(mesh, points, p, code, control)?;
        self.fill_if(mesh, points, p, outcome, control, accept)
    }

    /// The cavity of a vertex on a wall.
    fn open_facet(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        p: u32,
        code: u32,
        control: &Control,
    ) -> Result<Outcome, Error> {
        let scene = Scene { mesh, points, p, edge: None, control };
        let wall = Split::new(mesh, code, 0);
        let (face, t) = (mesh.face(wall.code), wall.code >> 2);
        if !mesh.is_wall(code) || mesh.is_ghost(t) {
            return Err(misplaced());
        }
        if let Some(v) = scene.occupied(&face) {
            return Ok(Outcome::Occupied(v));
        }
        if scene.side(face) != Sign::Zero || !scene.contains(t) {
            return Err(misplaced());
        }
        self.begin();
        self.split_sheet(scene, wall)?;
        self.open(scene)
    }

    /// Inserts `p`, which must be inside the edge `edge` of tetrahedron `start`: a subsegment, or an edge of the domain's boundary.
    ///
    /// # Errors
    /// `Internal` if it is not, `OutOfMemory`, `TooLarge`, and what ends the run.
    #[cfg(test)]
    pub fn on_segment(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        p: u32,
        edge: [u32; 2],
        start: u32,
        control: &Control,
    ) -> Result<Outcome, Error> {
        let outcome = self.open_segment(mesh, points, p, Place { edge, start }, control)?;
        if let Outcome::Occupied(_) = outcome {
            return Ok(outcome);
        }
        self.fill(mesh, p, outcome, control)
    }

    /// Inserts `p`, which must be inside an edge that is a subsegment or on the domain's boundary, if `accept` agrees, which is shown what
    /// would go and what bounds it; `None` if it does not.
    ///
    /// # Errors
    /// `Internal` if it is not there, `OutOfMemory`, `TooLarge`, those of `accept`, and what ends the run.
    pub fn on_segment_after(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        p: u32,
        place: Place,
        control: &Control,
        accept: impl FnOnce(Opening) -> Result<bool, Error>,
    ) -> Result<Option<Outcome>, Error> {
        let outcome = self.open_segment(mesh, points, p, place, control)?;
        self.fill_if(mesh, points, p, outcome, control, accept)
    }

    /// The cavity of a vertex on an edge.
    fn open_segment(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        p: u32,
        Place { edge, start }: Place,
        control: &Control,
    ) -> Result<Outcome, Error> {
        let [a, b] = edge;
        let scene = Scene { mesh, points, p, edge: Some(edge), control };
        if mesh.is_ghost(start) || edge.iter().any(|&v| mesh.slot_of(start, v).is_none()) {
            return Err(misplaced());
        }
        if let Some(v) = scene.occupied(&edge) {
            return Ok(Outcome::Occupied(v));
        }
        if !points.collinear(a, b, p) || points.dot_sign(p, a, b) != Sign::Negative {
            return Err(misplaced());
        }
        self.begin();
        self.edge = Some(edge);
        // The ring begins in the domain, so every void is entered before it is left.
        let mut void = 0;
        for (t, _, _, k, _) in EdgeRing::new(mesh, start, a, b) {
            control.step()?;
            let (code, ghost) = (4 * t + k, mesh.is_ghost(t));
            if !ghost {
                self.seed(t)?;
            }
            if mesh.is_wall(code) {
                let wall = Split::new(mesh, code, void);
                self.split_sheet(scene, wall)?;
                void += u32::from(ghost);
            }
        }
        self.open(scene)
    }

    /// [`Insert::fill`] if the vertex can be inserted and `accept` agrees.
    fn fill_if(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        p: u32,
        outcome: Outcome,
        control: &Control,
        accept: impl FnOnce(Opening) -> Result<bool, Error>,
    ) -> Result<Option<Outcome>, Error> {
        if let Outcome::Occupied(_) | Outcome::Blocked(_) = outcome {
            self.wasted += self.tets.len() as u64;
            return Ok(Some(outcome));
        }
        let (faces, subsegments) = (&self.faces, &self.subsegments);
        let accepted = accept(Opening { mesh, points, faces, subsegments, rim: &self.rim })?;
        if !accepted || !self.stays_positive(points, p) {
            self.wasted += self.tets.len() as u64;
            return Ok(None);
        }
        self.fill(mesh, p, outcome, control).map(Some)
    }

    /// Whether what would come is positive at doubles, if it has to be.
    fn stays_positive(&self, points: &Points, p: u32) -> bool {
        let at = |v: u32| points.xyz(v);
        let positive = |&Face { corners: [x, y, z], .. }: &Face| {
            [p, x, y, z].iter().all(|&v| points.is_explicit(v))
                || orient3d(at(p), at(x), at(y), at(z)) == Sign::Positive
        };
        !self.rounded || self.faces.iter().all(positive)
    }

    fn begin(&mut self) {
        self.edge = None;
        self.tets.clear();
        self.walls.clear();
        self.inside.begin();
        self.met.begin();
        self.wall_codes.begin();
    }

    /// Replaces the cavity by the tetrahedra that join the vertex to its faces, unless the vertex is blocked.
    fn fill(
        &mut self,
        mesh: &mut Mesh,
        p: u32,
        outcome: Outcome,
        control: &Control,
    ) -> Result<Outcome, Error> {
        if let Outcome::Blocked(_) = outcome {
            return Ok(outcome);
        }
        for sector in &mut self.sectors {
            sector.old.clear();
            sector.new.clear();
        }
        self.used = 0;
        let mut subfaces = Vec::new();
        for &Split { code, void } in self.walls.iter().filter(|wall| wall.void != NONE) {
            control.step()?;
            self.used = self.used.max(void as usize + 1);
            let sector = sector(&mut self.sectors, void as usize, NONE)?;
            fallible::push(&mut sector.old, mesh.across(code) >> 2)?;
        }
        for &Rim { edge: [x, y], wall } in &self.rim {
            control.step()?;
            if wall.void != NONE {
                fallible::push(&mut self.sectors[wall.void as usize].new, [p, x, y, GHOST])?;
            }
            if mesh.is_subface(wall.code) {
                fallible::push(&mut subfaces, ([p, x, y], mesh.subface(wall.code)))?;
            }
        }
        let voids = self.used;
        for i in 0..self.tets.len() {
            control.step()?;
            let t = self.tets[i];
            fallible::push(&mut self.solid_sector(voids, mesh.region(t))?.old, t)?;
        }
        for i in 0..self.faces.len() {
            control.step()?;
            let Face { corners: [x, y, z], tet } = self.faces[i];
            fallible::push(&mut self.solid_sector(voids, mesh.region(tet))?.new, [p, x, y, z])?;
        }
        let split = self.edge.zip(self.tets.first()).filter(|&(edge, &t)| mesh.is_subsegment(t, edge));
        let halves = split.map(|([a, b], _)| [[a, p], [p, b]]);
        mesh.add_vertex(p)?;
        let subsegments = halves.as_ref().map_or(&[][..], |halves| &halves[..]);
        self.replace.sectors(mesh, &self.sectors[..self.used], &subfaces, subsegments)?;
        self.made += self.replace.fresh.len() as u64;
        Ok(outcome)
    }

    /// The sector of a region; sectors of voids come first.
    fn solid_sector(&mut self, voids: usize, region: u32) -> Result<&mut Sector, Error> {
        let known = (voids..self.used).find(|&i| self.sectors[i].region == region);
        let at = known.unwrap_or(self.used);
        self.used = self.used.max(at + 1);
        sector(&mut self.sectors, at, region)
    }
}

/// The sector with this number, which gets this region.
fn sector(sectors: &mut Vec<Sector>, at: usize, region: u32) -> Result<&mut Sector, Error> {
    while sectors.len() <= at {
        fallible::push(sectors, Sector::default())?;
    }
    sectors[at].region = region;
    Ok(&mut sectors[at])
}

fn misplaced() -> Error {
    Error::internal("a vertex to be inserted is not where it should be")
}

#[cfg(test)]
mod tests;
