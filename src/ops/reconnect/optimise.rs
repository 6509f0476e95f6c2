//! The best filling of a polyhedron that the search finds: branch and bound (Marot, Verhetsel & Remacle 2020).
//!
//! Like the search for any filling, but every tetrahedron must be better than a bound. A filling raises the bound to its worst tetrahedron,
//! and the search continues from before that one.
use crate::error::Error;
use crate::fallible;
use crate::ops::reconnect::face::{take_lowest, Face};
use crate::ops::reconnect::search::{Budget, Search};
use crate::ops::shape::{Goal, Shape};
use crate::predicates::Points;

impl Search {
    /// Searches; appends the best filling found that reaches the goal, or the first one.
    pub fn optimise(
        &mut self,
        points: &Points,
        goal: Goal,
        first: bool,
        budget: Budget,
        tets: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        self.qualities.clear(self.signs.count())?;
        self.best.clear();
        let mut bound = goal.above;
        let mut steps = 0;
        if !self.descend_above(points, &goal, bound)? {
            return Ok(false);
        }
        // Invariant: level `depth − 1` has a face, and none of its apexes is applied.
        while self.depth > 0 {
            let level = self.depth - 1;
            let face = self.levels[level].face;
            let Some(apex) = self.levels[level].apexes.pop() else {
                self.retreat();
                continue;
            };
            steps += 1;
            if steps > budget.steps {
                break;
            }
            budget.control.step()?;
            // The bound may have risen since.
            if self.quality_with(points, &goal, apex, face) <= bound || !self.apply(level, face, apex)? {
                continue;
            }
            if self.front.faces.is_empty() && self.complete() {
                bound = self.keep(points, &goal)?;
                if first {
                    break;
                }
                self.undo(level);
                while (0..self.tets.len()).any(|i| self.quality_of(points, &goal, i) <= bound) {
                    self.retreat();
                }
            } else if self.front.faces.is_empty() || !self.descend_above(points, &goal, bound)? {
                self.undo(level);
            }
        }
        tets.try_reserve(self.best.len())?;
        let Search { best, signs, .. } = self;
        fallible::extend(tets, best.iter().map(|t| t.map(|i| signs.vertices[i as usize])))?;
        Ok(!best.is_empty())
    }

    /// Keeps the current filling; returns the quality of its worst tetrahedron.
    fn keep(&mut self, points: &Points, goal: &Goal) -> Result<f64, Error> {
        self.best.clear();
        fallible::append(&mut self.best, &self.tets)?;
        Ok((0..self.tets.len()).map(|i| self.quality_of(points, goal, i)).fold(f64::INFINITY, f64::min))
    }

    fn quality_of(&mut self, points: &Points, goal: &Goal, i: usize) -> f64 {
        let [w, x, y, z] = self.tets[i];
        self.quality_at(points, goal, [w, x, y, z])
    }

    /// The quality of the positive tetrahedron of an apex and a face.
    fn quality_with(&mut self, points: &Points, goal: &Goal, w: u8, face: Face) -> f64 {
        let [x, y, z] = face.corners();
        self.quality_at(points, goal, [w, x, y, z])
    }

    fn quality_at(&mut self, points: &Points, goal: &Goal, tet: [u8; 4]) -> f64 {
        let id = |i: u8| self.signs.vertices[i as usize];
        self.qualities.of(tet, || goal.quality(Shape::of(points, tet.map(id))))
    }

    /// Pushes the front face with the fewest apexes above the bound; returns false if one has none.
    fn descend_above(&mut self, points: &Points, goal: &Goal, bound: f64) -> Result<bool, Error> {
        let on_front = self.vertices_on_front();
        let mut fewest: Option<(u32, usize, u64)> = None;
        for i in 0..self.front.faces.len() {
            let face = self.front.faces[i];
            let mut set = on_front & self.front_sides(points, i).ahead;
            let mut rest = set;
            while let Some(w) = take_lowest(&mut rest) {
                if self.quality_with(points, goal, w, face) <= bound {
                    set &= !(1 << w);
                }
            }
            let count = set.count_ones();
            if count == 0 {
                return Ok(false);
            }
            if fewest.is_none_or(|f| count < f.0) {
                fewest = Some((count, i, set));
            }
        }
        let Some((count, index, mut rest)) = fewest else { return Ok(false) };
        let face = self.front.faces[index];
        self.front.collect_neighbours(&mut self.neighbours);
        self.apexes.clear();
        self.apexes.try_reserve(count as usize)?;
        while let Some(w) = take_lowest(&mut rest) {
            if self.is_free(points, w, face, on_front) {
                let quality = self.quality_with(points, goal, w, face);
                fallible::push(&mut self.apexes, (quality, w))?;
            }
        }
        self.push_level(face)
    }
}
