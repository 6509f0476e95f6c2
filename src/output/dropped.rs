//! Dropping the points that belong to no tetrahedron, and the way back, which a check against the input needs.
use crate::error::{Error, Status};
use crate::fallible;
use crate::output::{Lift, SteinerPoint, SteinerTerm, Subface, Subsegment, TetMesh};
use crate::INVALID;

/// What was dropped with the points that belong to no tetrahedron
/// ([`Options::drop_unmeshed_points`](crate::Options::drop_unmeshed_points)): the map from old to new point indices, and everything that
/// the mesh can no longer refer to.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dropped {
    /// For each old point (the input points, then the Steiner points) its new index, or that of the earlier point that it equals;
    /// [`INVALID`](crate::INVALID) if it was dropped.
    pub new_index: Vec<u32>,
    /// The number of these that are input points.
    pub input_point_count: u32,
    /// The coordinates of the dropped Steiner points, in order.
    pub points: Vec<[f64; 3]>,
    /// The same Steiner points; the ends of their edges are old indices.
    pub steiner: Vec<SteinerPoint>,
    /// Terms of their parameters; the field `steiner` is an index into these points.
    pub steiner_terms: Vec<SteinerTerm>,
    /// Pieces of facets that bound no tetrahedron, with old indices.
    pub subfaces: Vec<Subface>,
    /// Pieces of edges that belong to no tetrahedron, with old indices.
    pub subsegments: Vec<Subsegment>,
}

impl Dropped {
    /// The part of the map for input points.
    pub fn inputs(&self) -> &[u32] {
        self.new_index.get(..self.input_point_count as usize).unwrap_or_default()
    }

    /// The remaining input points, as ascending indices into the input: those whose new index is the next one.
    pub fn kept_inputs(&self) -> impl Iterator<Item = u32> + '_ {
        self.kept().filter(|&old| old < self.input_point_count)
    }

    /// A copy; unlike `clone` it returns an error if memory runs out.
    pub(crate) fn try_clone(&self) -> Result<Dropped, Error> {
        // By name, so that a new field cannot be forgotten here.
        let Dropped { new_index, input_point_count, points, steiner, steiner_terms, subfaces, subsegments } =
            self;
        Ok(Dropped {
            new_index: fallible::copied(new_index)?,
            input_point_count: *input_point_count,
            points: fallible::copied(points)?,
            steiner: fallible::copied(steiner)?,
            steiner_terms: fallible::copied(steiner_terms)?,
            subfaces: fallible::copied(subfaces)?,
            subsegments: fallible::copied(subsegments)?,
        })
    }

    /// All remaining points, by their old indices.
    fn kept(&self) -> impl Iterator<Item = u32> + '_ {
        let mut next = 0;
        (0..).zip(&self.new_index).filter_map(move |(old, &new)| {
            let kept = new == next;
            next += u32::from(kept);
            kept.then_some(old)
        })
    }
}

impl TetMesh {
    /// Drops every point that belongs to no tetrahedron and is no end of a remaining Steiner point's edge, nor of its facet's frame, together
    /// with the unmeshed pieces.
    pub(crate) fn drop_unmeshed_points(&mut self) -> Result<(), Error> {
        let (count, inputs) = (self.points.len(), self.input_point_count as usize);
        let mut keep = fallible::filled(false, count)?;
        for &v in self.tets.iter().flatten() {
            keep[v as usize] = true;
        }
        for (i, point) in self.steiner.iter().enumerate() {
            if keep[inputs + i] {
                point.parents().for_each(|v| keep[v as usize] = true);
            }
        }
        for (i, _) in self.point_alias.iter().enumerate().filter(|&(i, &alias)| i != alias as usize) {
            keep[i] = false;
        }
        let mut dropped = Dropped { input_point_count: self.input_point_count, ..Dropped::default() };
        let mut new_index: Vec<u32> = fallible::reserved(count)?;
        let mut left = 0;
        for (old, &kept) in keep.iter().enumerate() {
            let alias = self.point_alias.get(old).map_or(old, |&alias| alias as usize);
            let new = match new_index.get(alias) {
                Some(&earlier) => earlier,
                None if kept => left,
                None => INVALID,
            };
            fallible::push(&mut new_index, new)?;
            left += u32::from(kept);
        }
        self.split_steiner(&keep, &new_index, &mut dropped)?;
        let now = |v: &mut u32| *v = new_index[*v as usize];
        self.tets.iter_mut().flatten().for_each(now);
        self.subfaces.iter_mut().for_each(|face| face.corners.iter_mut().for_each(now));
        self.subsegments.iter_mut().for_each(|edge| edge.ends.iter_mut().for_each(now));
        self.crowded.retain(|&v| keep[v as usize]);
        self.crowded.iter_mut().for_each(now);
        let mut kept = keep.iter();
        self.points.retain(|_| kept.next().is_some_and(|&kept| kept));
        if let Some(values) = self.lift.values_mut() {
            let mut kept = keep.iter();
            values.retain(|_| kept.next().is_some_and(|&kept| kept));
        }
        self.input_point_count = keep[..inputs].iter().filter(|&&kept| kept).count() as u32;
        self.point_alias.clear();
        fallible::extend(&mut self.point_alias, 0..self.input_point_count)?;
        self.unmeshed_points.retain(|&v| keep[v as usize]);
        self.unmeshed_points.iter_mut().for_each(now);
        self.hidden_points.clear();
        dropped.subfaces = std::mem::take(&mut self.unmeshed_subfaces);
        dropped.subsegments = std::mem::take(&mut self.unmeshed_subsegments);
        dropped.new_index = new_index;
        self.dropped = Some(dropped);
        Ok(())
    }

    /// The remaining Steiner points and the dropped ones.
    fn split_steiner(
        &mut self,
        keep: &[bool],
        new_index: &[u32],
        dropped: &mut Dropped,
    ) -> Result<(), Error> {
        let inputs = self.input_point_count as usize;
        let (mut steiner, mut terms) =
            (fallible::reserved(self.steiner.len())?, fallible::reserved(self.steiner_terms.len())?);
        let mut all_terms = self.steiner_terms.iter().peekable();
        for (i, point) in self.steiner.iter().enumerate() {
            let (points, of) = match keep[inputs + i] {
                true => (&mut steiner, &mut terms),
                false => (&mut dropped.steiner, &mut dropped.steiner_terms),
            };
            while let Some(term) = all_terms.next_if(|term| term.steiner as usize == i) {
                fallible::push(of, SteinerTerm { steiner: points.len() as u32, ..*term })?;
            }
            fallible::push(points, *point)?;
            if !keep[inputs + i] {
                fallible::push(&mut dropped.points, self.points[inputs + i])?;
            }
        }
        for v in steiner.iter_mut().flat_map(SteinerPoint::parents_mut) {
            *v = new_index[*v as usize];
        }
        (self.steiner, self.steiner_terms) = (steiner, terms);
        Ok(())
    }

    /// The mesh as it was before points were dropped, with the indices of the input; `inputs` are the input points.
    ///
    /// # Errors
    /// [`Status::CheckFailed`] if the map does not fit the mesh and the input; [`Status::OutOfMemory`].
    pub fn with_dropped(&self, inputs: &[[f64; 3]]) -> Result<TetMesh, Error> {
        let Some(dropped) = &self.dropped else { return self.try_clone() };
        let misfit = || {
            Error::new(Status::CheckFailed, "the map of dropped points does not match the mesh and the input")
        };
        let before = dropped.new_index.len();
        let mut old_index: Vec<u32> = fallible::reserved(self.points.len())?;
        fallible::extend(&mut old_index, dropped.kept())?;
        let steiner_count = before.checked_sub(inputs.len()).ok_or_else(misfit)?;
        let kept_steiner = old_index.len().checked_sub(dropped.kept_inputs().count()).ok_or_else(misfit)?;
        if inputs.len() != dropped.input_point_count as usize
            || old_index.len() != self.points.len()
            || kept_steiner != self.steiner.len()
            || steiner_count != kept_steiner + dropped.steiner.len()
            || dropped.points.len() != dropped.steiner.len()
        {
            return Err(misfit());
        }
        let mut mesh = self.try_clone()?;
        mesh.dropped = None;
        mesh.input_point_count = dropped.input_point_count;
        mesh.point_alias.clear();
        // Those of dropped points are only in the input.
        mesh.lift = Lift::Plain;
        mesh.points = fallible::reserved(before)?;
        fallible::append(&mut mesh.points, inputs)?;
        mesh.steiner = fallible::reserved(steiner_count)?;
        mesh.steiner_terms.clear();
        let (mut ours, mut theirs) = (0, 0);
        let mut kept = old_index.iter().peekable();
        for old in 0..before {
            let is_kept = kept.next_if(|&&k| k as usize == old).is_some();
            let Some(number) = old.checked_sub(inputs.len()) else {
                if is_kept {
                    mesh.points[old] = self.points[ours];
                    ours += 1;
                }
                continue;
            };
            let (mut point, at, terms, index) = match is_kept {
                true => {
                    let index = ours - (self.points.len() - kept_steiner);
                    (self.steiner[index], self.points[ours], &self.steiner_terms, index)
                }
                false => (dropped.steiner[theirs], dropped.points[theirs], &dropped.steiner_terms, theirs),
            };
            if is_kept {
                for v in point.parents_mut() {
                    *v = old_index.get(*v as usize).copied().ok_or_else(misfit)?;
                }
            }
            ours += usize::from(is_kept);
            theirs += usize::from(!is_kept);
            fallible::push(&mut mesh.points, at)?;
            fallible::push(&mut mesh.steiner, point)?;
            let from = terms.partition_point(|term| (term.steiner as usize) < index);
            for term in terms[from..].iter().take_while(|term| term.steiner as usize == index) {
                fallible::push(&mut mesh.steiner_terms, SteinerTerm { steiner: number as u32, ..*term })?;
            }
        }
        // An invalid index stays invalid: the check reports it.
        let back = |v: &mut u32| *v = old_index.get(*v as usize).copied().unwrap_or(INVALID);
        mesh.tets.iter_mut().flatten().for_each(back);
        mesh.subfaces.iter_mut().for_each(|face| face.corners.iter_mut().for_each(back));
        mesh.subsegments.iter_mut().for_each(|edge| edge.ends.iter_mut().for_each(back));
        mesh.crowded.iter_mut().for_each(back);
        mesh.unmeshed_points.clear();
        mesh.unmeshed_subfaces = fallible::copied(&dropped.subfaces)?;
        mesh.unmeshed_subsegments = fallible::copied(&dropped.subsegments)?;
        Ok(mesh)
    }
}
