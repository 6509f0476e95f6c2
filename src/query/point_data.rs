//! Attributes and markers of the mesh's points: the input's, extended to the Steiner points.
use crate::error::Error;
use crate::fallible;
use crate::plc::attributes::{as_meshed, continue_attributes};
use crate::query::Locator;
use crate::{Plc, TetMesh, INVALID};

/// Attributes and markers of all points of a mesh.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointData {
    /// The number of attributes per point.
    pub attribute_count: usize,
    /// `attribute_count` numbers per point. Those of Steiner points are interpolated linearly between the ends of the input edge, or in a
    /// tetrahedron of surrounding points.
    pub attributes: Vec<f64>,
    /// One per point, or empty if the input has none. A Steiner point has the marker of its segment, or 0 if it lies on no segment.
    pub markers: Vec<i32>,
}

impl PointData {
    /// Extends the data of `plc` to the Steiner points of `mesh`. Fails if memory runs out.
    pub fn new(plc: &Plc, mesh: &TetMesh) -> Result<PointData, Error> {
        let plc = &*as_meshed(plc, mesh)?;
        let width = plc.point_attribute_count;
        let mut data = PointData { attribute_count: width, ..PointData::default() };
        if width > 0 && !plc.point_attributes.is_empty() {
            data.attributes.try_reserve_exact(width * mesh.points.len())?;
            fallible::append(&mut data.attributes, &plc.point_attributes)?;
            fallible::extend(&mut data.attributes, continue_attributes(plc, mesh)?)?;
        }
        if !plc.point_markers.is_empty() {
            data.markers.try_reserve_exact(mesh.points.len())?;
            fallible::append(&mut data.markers, &plc.point_markers)?;
            fallible::extend(
                &mut data.markers,
                mesh.steiner.iter().map(|steiner| match steiner.segment {
                    INVALID => 0,
                    segment => plc.segments.get(segment as usize).map_or(0, |segment| segment.marker),
                }),
            )?;
        }
        Ok(data)
    }

    /// The data of a mesh for another one that was made of it by refining or improving: points that have stayed keep theirs, others get
    /// attributes by linear interpolation in the old mesh.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
    pub fn continued(&self, before: &TetMesh, after: &TetMesh) -> Result<PointData, Error> {
        let (inputs, width) = (before.input_point_count as usize, self.attribute_count);
        let has_attributes = width > 0 && self.attributes.len() == width * before.points.len();
        let mut data =
            PointData { attribute_count: if has_attributes { width } else { 0 }, ..PointData::default() };
        // Input points, and those on edges of the input, have come first and in their order.
        let stayed = |mesh: &TetMesh, i: usize| {
            i.checked_sub(inputs).is_none_or(|i| mesh.steiner.get(i).is_some_and(|point| !point.is_inside()))
        };
        let mut old = (0..before.points.len()).filter(|&i| stayed(before, i));
        let others = fallible::collect((0..after.points.len()).filter(|&i| !stayed(after, i)))?;
        let places = fallible::collect(others.iter().map(|&i| after.points[i]))?;
        let mut tets = fallible::filled(INVALID, places.len())?;
        let mut weights = fallible::filled([0.0; 4], places.len())?;
        if has_attributes && !places.is_empty() {
            Locator::new(before)?.locate(before, &places, &mut tets, Some(&mut weights));
        }
        data.attributes.try_reserve_exact(data.attribute_count * after.points.len())?;
        data.markers.try_reserve_exact(if self.markers.is_empty() { 0 } else { after.points.len() })?;
        let mut found = tets.iter().zip(&weights);
        for i in 0..after.points.len() {
            let from = if stayed(after, i) { old.next() } else { None };
            if !self.markers.is_empty() {
                let marker = from.and_then(|i| self.markers.get(i)).copied().unwrap_or(0);
                fallible::push(&mut data.markers, marker)?;
            }
            if !has_attributes {
                continue;
            }
            if let Some(from) = from {
                fallible::append(&mut data.attributes, &self.attributes[from * width..(from + 1) * width])?;
                continue;
            }
            let (corners, weights) = match found.next() {
                Some((&t, weights)) if t != INVALID => (before.tets[t as usize], *weights),
                _ => ([0; 4], [0.0; 4]),
            };
            for k in 0..width {
                let value = |v: u32| self.attributes[v as usize * width + k];
                let sum = corners.iter().zip(weights).map(|(&v, weight)| weight * value(v)).sum();
                fallible::push(&mut data.attributes, sum)?;
            }
        }
        Ok(data)
    }
}
