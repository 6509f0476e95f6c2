//! Attributes and markers of the mesh's points: the input's, extended to the Steiner points.
use crate::error::Error;
use crate::fallible;
use crate::plc::attributes::{as_meshed, continue_attributes};
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
}
