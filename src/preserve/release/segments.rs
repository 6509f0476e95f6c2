//! Removal of boundary points: Si & Gärtner 2011, section 8, for points on segments.
//!
//! Without the point its walls are retriangulated and its sectors filled by small polyhedron reconnection; if this works for all sectors,
//! the point is *deleted*. A sector for which it does not gets a point inside instead, which sees all of the sector's faces; the point is
//! then *relocated*. Such a position exists by the half-ball argument (section 8.1): the faces opposite the point are seen from all
//! positions near it, and the walls from those between their planes.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::edge_key;
use crate::kernel::ghosts::ghost_at;
use crate::kernel::replace::{Replace, Sector};
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::ops::hollow::{Growth, Hollow, Start};
use crate::ops::polygon::Polygons;
use crate::ops::reconnect::{Polyhedron, Reconnect};
use crate::ops::widen::Widen;
use crate::predicates::{Points, Sign};
use crate::preserve::inside::Inside;
use crate::preserve::star::{Star, Wall};
use crate::vector::{by_size, cross, dot, sub};
use rustc_hash::{FxHashMap, FxHashSet};

/// The tetrahedra of a filled sector, or none where the search has failed.
type Filling = Option<Vec<[u32; 4]>>;

/// Most fillings tried for one point: bounds the time for a point that resists. 24 and 96 change nothing on three models: it only bounds
/// the work on worse ones.
const MOST_FILLS: usize = 48;
/// Most combinations of wall triangulations looked at for one point. 128 and 512 change nothing on three models: it only bounds the work on
/// worse ones.
const MOST_CHOICES: usize = 256;

/// How hard to try.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Steps per search.
    pub budget: u32,
    /// Triangulations per wall.
    pub walls: usize,
    /// Let sectors that cannot be filled grow.
    pub growth: Option<Growth>,
    /// Use points inside where sectors cannot be filled.
    pub relocate: bool,
}

/// What became of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It was deleted.
    Deleted,
    /// It was replaced by points inside.
    Relocated,
    /// It is still in the mesh.
    Kept,
}

/// Removes boundary points.
pub struct Unsplit<'a> {
    /// The mesh.
    pub mesh: &'a mut Mesh,
    /// The vertices.
    pub points: &'a mut Points,
    /// Edges of the input's triangles, in order: walls get them where they can.
    pub wanted: &'a [[u32; 2]],
    /// Pieces of segments on no facet: what is filled must keep them.
    pub isolated: &'a mut FxHashSet<[u32; 2]>,
    /// Points inside made so far.
    pub inside: &'a mut Inside,
    pub(super) reconnect: Reconnect<'a>,
    pub(super) control: &'a Control<'a>,
    replace: Replace,
    hollow: Hollow,
    pub(super) widen: Widen,
    /// Points inside that cavities of the current attempt swallow.
    pub(super) swallowed: Vec<u32>,
    polygons: Polygons,
    pub(super) star: Star,
    /// Triangulations of each wall, and the chosen ones.
    options: Vec<Vec<Vec<[u32; 3]>>>,
    filled: FxHashMap<(usize, [usize; 2]), Filling>,
    fills: usize,
    pub(super) faces: Vec<[u32; 3]>,
    /// All tetrahedra that the last attempt looked at, with repetitions: while they stay, it would end the same way.
    pub read: Vec<u32>,
}

impl<'a> Unsplit<'a> {
    /// Nothing is done yet.
    pub fn new(
        mesh: &'a mut Mesh,
        points: &'a mut Points,
        wanted: &'a [[u32; 2]],
        isolated: &'a mut FxHashSet<[u32; 2]>,
        inside: &'a mut Inside,
        control: &'a Control<'a>,
    ) -> Self {
        Unsplit {
            mesh,
            points,
            wanted,
            isolated,
            inside,
            reconnect: Reconnect::new(control),
            control,
            replace: Replace::default(),
            hollow: Hollow::default(),
            widen: Widen::default(),
            swallowed: Vec::new(),
            polygons: Polygons::default(),
            star: Star::default(),
            options: Vec::new(),
            filled: FxHashMap::default(),
            fills: 0,
            faces: Vec::new(),
            read: Vec::new(),
        }
    }

    /// Tries to remove `v`; `ends` are its neighbours on its segment.
    pub fn remove(&mut self, v: u32, ends: [u32; 2], effort: Effort) -> Result<Outcome, Error> {
        if self.mesh.vertex_tet[v as usize] == NONE {
            return Ok(Outcome::Deleted);
        }
        self.star.read(self.mesh, v, ends)?;
        self.read.clear();
        for sector in &self.star.sectors {
            fallible::append(&mut self.read, &sector.tets)?;
        }
        if !self.triangulate_walls(effort.walls)? {
            return Ok(Outcome::Kept);
        }
        self.filled.clear();
        self.fills = 0;
        let Some((choice, failed)) = self.choose(ends, effort)? else { return Ok(Outcome::Kept) };
        if failed > 0 && !effort.relocate && effort.growth.is_none() {
            return Ok(Outcome::Kept);
        }
        let before = self.inside.list.len();
        self.swallowed.clear();
        let mut sectors = fallible::reserved(self.star.sectors.len())?;
        for s in 0..self.star.sectors.len() {
            let Some(sector) = self.fill_or_place(v, s, &choice, ends, effort, &sectors)? else {
                self.discard(before);
                return Ok(Outcome::Kept);
            };
            fallible::push(&mut sectors, sector)?;
        }
        let mut subfaces: Vec<([u32; 3], u32)> = Vec::new();
        for (wall, (options, &c)) in self.star.walls.iter().zip(self.options.iter().zip(&choice)) {
            if wall.patch == NONE {
                continue;
            }
            fallible::extend(&mut subfaces, options[c].iter().map(|&triangle| (triangle, wall.patch)))?;
        }
        self.replace.sectors(self.mesh, &sectors, &subfaces, &[])?;
        self.mesh.vertex_tet[v as usize] = NONE;
        for &p in &self.swallowed {
            self.mesh.vertex_tet[p as usize] = NONE;
        }
        if self.isolated.remove(&edge_key(ends[0], v)) {
            self.isolated.remove(&edge_key(v, ends[1]));
            fallible::add(self.isolated, edge_key(ends[0], ends[1]))?;
        }
        Ok(if self.inside.list.len() == before { Outcome::Deleted } else { Outcome::Relocated })
    }

    /// Finds triangulations of all walls; false if one has none.
    fn triangulate_walls(&mut self, most: usize) -> Result<bool, Error> {
        self.options.clear();
        self.options.try_reserve(self.star.walls.len())?;
        let wanted = self.wanted;
        for wall in &self.star.walls {
            let Some(axis) = axis_of(self.points, &wall.polygon) else { return Ok(false) };
            let mut list = self.polygons.triangulations(self.points, axis, &wall.polygon, &|a, b| {
                wanted.binary_search(&edge_key(a, b)).is_ok()
            })?;
            list.truncate(most);
            if list.is_empty() {
                return Ok(false);
            }
            fallible::push(&mut self.options, list)?;
        }
        Ok(true)
    }

    /// The first combination of wall triangulations, by increasing cost, with which all sectors can be filled; or the one with the fewest
    /// failures. Returns it and the number of failures.
    fn choose(&mut self, ends: [u32; 2], effort: Effort) -> Result<Option<(Vec<usize>, usize)>, Error> {
        let walls = self.star.walls.len();
        let mut best: Option<(Vec<usize>, usize)> = None;
        let mut seen = 0;
        let most: usize = self.options.iter().map(|o| o.len() - 1).sum();
        let mut choice = fallible::filled(0usize, walls)?;
        for total in 0..=most {
            first_of(total, &self.options, &mut choice);
            loop {
                self.control.step()?;
                let mut failed = 0;
                for s in 0..self.star.sectors.len() {
                    let limit = best.as_ref().map_or(usize::MAX, |b| b.1);
                    if failed >= limit {
                        break;
                    }
                    failed += usize::from(!self.try_fill(s, &choice, ends, effort.budget)?);
                }
                if best.as_ref().is_none_or(|b| failed < b.1) {
                    best = Some((fallible::copied(&choice)?, failed));
                }
                seen += 1;
                if failed == 0 || seen >= MOST_CHOICES || self.fills >= MOST_FILLS {
                    return Ok(best);
                }
                if !next_of(total, &self.options, &mut choice) {
                    break;
                }
            }
        }
        Ok(best)
    }

    /// The chosen triangulations of the walls at a sector: at most two.
    fn key_of(&self, s: usize, choice: &[usize]) -> (usize, [usize; 2]) {
        let mut key = [usize::MAX; 2];
        let mut at = 0;
        for (w, wall) in self.star.walls.iter().enumerate() {
            for side in &wall.sides {
                if side.0 == s && at < 2 {
                    key[at] = choice[w];
                    at += 1;
                }
            }
        }
        (s, key)
    }

    /// Collects the faces of a sector without the point.
    fn collect_faces(&mut self, s: usize, choice: &[usize]) -> Result<(), Error> {
        let mut faces = std::mem::take(&mut self.faces);
        faces.clear();
        fallible::append(&mut faces, &self.star.sectors[s].link)?;
        let options = &self.options;
        self.star.wall_faces(s, &|w| Some(&options[w][choice[w]]), &mut faces)?;
        self.faces = faces;
        Ok(())
    }

    /// Fills a sector, unless it was tried with these walls.
    fn try_fill(&mut self, s: usize, choice: &[usize], ends: [u32; 2], budget: u32) -> Result<bool, Error> {
        let key = self.key_of(s, choice);
        if let Some(known) = self.filled.get(&key) {
            return Ok(known.is_some());
        }
        self.collect_faces(s, choice)?;
        let mut new = Vec::new();
        let found = if self.star.sectors[s].void {
            fallible::extend(&mut new, self.faces.iter().map(|&f| ghost_at(f)))?;
            true
        } else {
            self.fills += 1;
            let walled = self.star.walls.iter().any(|w| w.sides.iter().any(|side| side.0 == s));
            let edges: &[[u32; 2]] = if walled { &[] } else { &[ends] };
            let polyhedron = Polyhedron { faces: &self.faces, edges, ..Polyhedron::default() };
            self.reconnect.fill(self.points, &polyhedron, budget, &mut new)?
        };
        fallible::insert(&mut self.filled, key, found.then_some(new))?;
        Ok(found)
    }

    /// A sector without the point: as filled, or grown and filled, or with points inside; `taken` are those done before.
    fn fill_or_place(
        &mut self,
        v: u32,
        s: usize,
        choice: &[usize],
        ends: [u32; 2],
        effort: Effort,
        taken: &[Sector],
    ) -> Result<Option<Sector>, Error> {
        let region = self.star.sectors[s].region;
        let old = fallible::copied(&self.star.sectors[s].tets)?;
        if self.try_fill(s, choice, ends, effort.budget)? {
            let new = self.filled.remove(&self.key_of(s, choice)).flatten();
            return Ok(new.map(|new| Sector { old, new, region }));
        }
        self.collect_faces(s, choice)?;
        if let Some(growth) = effort.growth {
            if let Some(new) = self.grow(v, s, ends, taken, growth)? {
                return Ok(Some(Sector { old: std::mem::take(&mut self.hollow.cavity.tets), new, region }));
            }
        }
        if !effort.relocate {
            return Ok(None);
        }
        self.place_inside(v, s, ends, taken, effort)
    }

    /// Fills a sector that has grown.
    fn grow(
        &mut self,
        v: u32,
        s: usize,
        ends: [u32; 2],
        taken: &[Sector],
        growth: Growth,
    ) -> Result<Option<Vec<[u32; 4]>>, Error> {
        let [gone, walls] = self.walls_of(s)?;
        let start = Start {
            tets: &self.star.sectors[s].tets,
            gone: &gone,
            walls: &walls,
            without: v,
            edge: gone.is_empty().then_some(ends),
            avoid: [v; 2],
            taken,
        };
        let grown =
            self.hollow.grow(self.mesh, self.points, &mut self.reconnect, &start, self.isolated, growth)?;
        fallible::append(&mut self.read, &self.hollow.read)?;
        Ok(grown)
    }

    /// The faces of the walls at a sector now, and those with the chosen triangulations, turned inward.
    pub(super) fn walls_of(&self, s: usize) -> Result<[Vec<[u32; 3]>; 2], Error> {
        let touches = |wall: &&Wall| wall.sides.iter().any(|side| side.0 == s);
        let gone = self.star.walls.iter().filter(touches).flat_map(|w| w.faces.iter().copied());
        Ok([fallible::collect(gone)?, fallible::copied(&self.faces[self.star.sectors[s].link.len()..])?])
    }
}

/// The first combination, in lexicographic order, whose numbers add up to `total`.
fn first_of(total: usize, options: &[Vec<Vec<[u32; 3]>>], choice: &mut [usize]) {
    let mut left = total;
    for (c, o) in choice.iter_mut().zip(options).rev() {
        *c = left.min(o.len() - 1);
        left -= *c;
    }
}

/// The next combination with the same sum; false after the last.
fn next_of(total: usize, options: &[Vec<Vec<[u32; 3]>>], choice: &mut [usize]) -> bool {
    // Raise the last number that can be raised while the rest can still make up the sum.
    for i in (0..choice.len()).rev() {
        let fixed: usize = choice[..=i].iter().sum::<usize>() + 1;
        if choice[i] + 1 < options[i].len() && fixed <= total {
            let rest = total - fixed;
            let room: usize = options[i + 1..].iter().map(|o| o.len() - 1).sum();
            if rest <= room {
                choice[i] += 1;
                first_of(rest, &options[i + 1..], &mut choice[i + 1..]);
                return true;
            }
        }
    }
    false
}

/// An axis along which the polygon's projection is no line.
pub fn axis_of(points: &Points, polygon: &[u32]) -> Option<usize> {
    let (a, u, b) = (polygon[0], polygon[1], polygon[polygon.len() - 1]);
    let n = cross(&sub(points.xyz(u), points.xyz(a)), &sub(points.xyz(b), points.xyz(a)));
    by_size(&n, [0, 1, 2]).into_iter().find(|&k| points.orient_in_plane(k, a, u, b) != Sign::Zero)
}

/// Of length one, or zero.
pub fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(&a, &a).sqrt();
    if length > 0.0 {
        a.map(|x| x / length)
    } else {
        a
    }
}
