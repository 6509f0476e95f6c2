//! The input: a piecewise linear complex (PLC). Pure data.
//!
//! Si & Gärtner 2011, section 2: a PLC is a set of vertices, segments and facets such that the intersection of any two is a union of other
//! elements of the set. Input may be more lenient: a vertex exactly on a segment or facet splits it.

pub mod attributes;
pub mod duplicates;
pub mod intersect;
pub(crate) mod lift;
pub mod merge;
pub mod near;
pub mod open;
pub mod patch;
pub mod planarity;
pub mod polygon;
pub mod prepare;
mod radix;
pub mod sizes;
pub mod split;
pub mod surface;

use crate::error::Error;
use crate::fallible;
use crate::output::Lift;
pub use prepare::{check, check_and_split, check_with, prepare, Prepared};
pub use sizes::{MarkerSize, RegionSize, Sizes};
#[cfg(test)]
mod tests;

/// How the polygons of a facet bound its interior.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Interior {
    /// The first ring is the outer boundary, all further rings (three corners or more) are holes in it.
    #[default]
    FirstMinusOthers,
    /// TetGen's rule: the facet is everything that cannot be reached from outside without crossing a polygon's edge, except what can be
    /// reached from one of its hole seeds. Inner polygons and 2-point polygons only constrain the mesh.
    Seeds,
}

/// A facet: a planar polygonal region, given by corner indices.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Facet {
    /// Polygons: corner indices in order, not repeated at the end. One or two corners: an isolated vertex or edge in the facet.
    pub polygons: Vec<Vec<u32>>,
    /// Points in holes of the facet (used with [`Interior::Seeds`]).
    pub holes: Vec<[f64; 3]>,
    /// What is inside.
    pub interior: Interior,
    /// The caller's marker (facets with different markers are never merged).
    pub marker: i32,
}

/// A segment between two points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Segment {
    /// The ends.
    pub ends: [u32; 2],
    /// The caller's marker.
    pub marker: i32,
}

/// A region seed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegionSeed {
    /// A point inside the region.
    pub point: [f64; 3],
    /// The attribute given to its tetrahedra.
    pub attribute: f64,
    /// Bound on the volume of a tetrahedron there, once the mesh is filled; no bound if not positive.
    pub max_volume: Option<f64>,
}

/// The name of a facet marker: that of the group, solid, material or colour of a file that the marker stands for, or one set by the caller.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MarkerName {
    /// The marker.
    pub marker: i32,
    /// Its name: one line, not empty.
    pub name: String,
}

/// A piecewise linear complex, as given.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Plc {
    /// The points: x, y, z.
    pub points: Vec<[f64; 3]>,
    /// The number of attributes of each point.
    pub point_attribute_count: usize,
    /// `point_attribute_count` numbers per point.
    pub point_attributes: Vec<f64>,
    /// One marker per point, or empty.
    pub point_markers: Vec<i32>,
    /// Weights of points, which [`Mode::Delaunay`](crate::Mode::Delaunay) counts; not offered with facets and segments.
    pub lift: Lift,
    /// Segments that are not (only) edges of facets, or that carry a marker.
    pub segments: Vec<Segment>,
    /// Triangular facets: three corners each. They come first in the numbering of facets.
    pub triangles: Vec<[u32; 3]>,
    /// One marker per triangle, or empty (all 0).
    pub triangle_markers: Vec<i32>,
    /// General facets, numbered after the triangles: facet `i` here is facet `triangles.len() + i`.
    pub facets: Vec<Facet>,
    /// Hole seeds.
    pub holes: Vec<[f64; 3]>,
    /// Region seeds.
    pub regions: Vec<RegionSeed>,
    /// Edge lengths wanted at points, facets, segments and regions.
    pub sizes: Sizes,
    /// Names of facet markers, sorted by marker, at most one per marker ([`Plc::set_marker_name`] maintains this). Readers fill it from the
    /// groups of a file, writers use it to name groups; meshing ignores it.
    pub names: Vec<MarkerName>,
}

impl Plc {
    /// The name of a facet marker, if it has one.
    pub fn marker_name(&self, marker: i32) -> Option<&str> {
        let found = self.names.binary_search_by_key(&marker, |n| n.marker).ok()?;
        self.names.get(found).map(|n| n.name.as_str())
    }

    /// Names a facet marker; an empty name removes its name. Only the first line of a name is kept, without surrounding blanks.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
    pub fn set_marker_name(&mut self, marker: i32, name: &str) -> Result<(), Error> {
        let line = name_line(name);
        let kept = fallible::copied_text(line)?;
        match (self.names.binary_search_by_key(&marker, |n| n.marker), kept.is_empty()) {
            (Ok(at), true) => drop(self.names.remove(at)),
            (Ok(at), false) => self.names[at].name = kept,
            (Err(_), true) => {}
            (Err(at), false) => {
                fallible::insert_at(&mut self.names, at, MarkerName { marker, name: kept })?;
            }
        }
        Ok(())
    }

    /// The number of facets, triangles and general ones.
    pub fn facet_count(&self) -> usize {
        self.triangles.len() + self.facets.len()
    }

    /// A copy; unlike `clone` it returns an error if memory runs out.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
    pub fn try_clone(&self) -> Result<Plc, Error> {
        // By name, so that a new field cannot be forgotten here.
        let Plc {
            points,
            point_attribute_count,
            point_attributes,
            point_markers,
            lift,
            segments,
            triangles,
            triangle_markers,
            facets,
            holes,
            regions,
            sizes,
            names,
        } = self;
        Ok(Plc {
            points: fallible::copied(points)?,
            point_attribute_count: *point_attribute_count,
            point_attributes: fallible::copied(point_attributes)?,
            point_markers: fallible::copied(point_markers)?,
            lift: lift.try_clone()?,
            segments: fallible::copied(segments)?,
            triangles: fallible::copied(triangles)?,
            triangle_markers: fallible::copied(triangle_markers)?,
            facets: fallible::each(facets, Facet::try_clone)?,
            holes: fallible::copied(holes)?,
            regions: fallible::copied(regions)?,
            sizes: sizes.try_clone()?,
            names: fallible::each(names, MarkerName::try_clone)?,
        })
    }

    /// The marker of a facet (general numbering).
    pub fn facet_marker(&self, facet: usize) -> i32 {
        match facet.checked_sub(self.triangles.len()) {
            None => self.triangle_markers.get(facet).copied().unwrap_or(0),
            Some(general) => self.facets[general].marker,
        }
    }
}

/// The part of a name that is kept.
pub(crate) fn name_line(name: &str) -> &str {
    name.trim().lines().next().unwrap_or_default().trim_end()
}

impl MarkerName {
    fn try_clone(&self) -> Result<MarkerName, Error> {
        Ok(MarkerName { marker: self.marker, name: fallible::copied_text(&self.name)? })
    }
}

impl Facet {
    fn try_clone(&self) -> Result<Facet, Error> {
        let Facet { polygons, holes, interior, marker } = self;
        let polygons = fallible::each(polygons, |polygon| fallible::copied(polygon))?;
        Ok(Facet { polygons, holes: fallible::copied(holes)?, interior: *interior, marker: *marker })
    }
}
