//! Edge lengths, and areas of facets, wanted in parts of the input. They are wishes for filling and refinement; the smallest of all counts.
use crate::error::{Error, Status};
use crate::fallible;

/// The edge length wanted on facets or segments with a marker, or the area wanted on facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerSize {
    /// The marker.
    pub marker: i32,
    /// The length, in a list of areas the area: positive and finite.
    pub size: f64,
}

/// The edge length wanted in regions with an attribute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegionSize {
    /// The attribute.
    pub attribute: f64,
    /// The length: positive and finite.
    pub size: f64,
}

/// All such lengths.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Sizes {
    /// One length per point, or empty; infinite where a point has no wish.
    pub points: Vec<f64>,
    /// By the marker of facets, at most one per marker, in the order of markers ([`Sizes::set_facets`] maintains this).
    pub facets: Vec<MarkerSize>,
    /// The largest area wanted of a subface, by the marker of facets, likewise. As a length it is the edge of the equilateral triangle of this
    /// area; of length and area the smaller counts. Where the surface is refined, subfaces are split until none is above it; only segments
    /// that are close to each other for their length, and so in each other's way, may keep some larger.
    pub facet_areas: Vec<MarkerSize>,
    /// By the marker of segments, likewise.
    pub segments: Vec<MarkerSize>,
    /// By the attribute of regions, at most one per attribute.
    pub regions: Vec<RegionSize>,
}

impl Sizes {
    /// Whether nothing is wanted.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
            && self.facets.is_empty()
            && self.facet_areas.is_empty()
            && self.segments.is_empty()
            && self.regions.is_empty()
    }

    pub(super) fn try_clone(&self) -> Result<Sizes, Error> {
        let Sizes { points, facets, facet_areas, segments, regions } = self;
        Ok(Sizes {
            points: fallible::copied(points)?,
            facets: fallible::copied(facets)?,
            facet_areas: fallible::copied(facet_areas)?,
            segments: fallible::copied(segments)?,
            regions: fallible::copied(regions)?,
        })
    }

    /// Sets the length wanted on facets with a marker; an infinite one is no wish.
    ///
    /// # Errors
    /// [`Status::InvalidArgument`] unless the length is positive, [`Status::OutOfMemory`].
    pub fn set_facets(&mut self, marker: i32, size: f64) -> Result<(), Error> {
        set_marker(&mut self.facets, marker, size)
    }

    /// Sets the largest area wanted of a subface of facets with a marker; an infinite one is no wish.
    ///
    /// # Errors
    /// As [`Sizes::set_facets`].
    pub fn set_facet_areas(&mut self, marker: i32, area: f64) -> Result<(), Error> {
        set_marker(&mut self.facet_areas, marker, area)
    }

    /// Sets the length wanted on segments with a marker; an infinite one is no wish.
    ///
    /// # Errors
    /// As [`Sizes::set_facets`].
    pub fn set_segments(&mut self, marker: i32, size: f64) -> Result<(), Error> {
        set_marker(&mut self.segments, marker, size)
    }

    /// Sets the length wanted in regions with an attribute; an infinite one is no wish.
    ///
    /// # Errors
    /// As [`Sizes::set_facets`]; also for an attribute that is no number.
    pub fn set_regions(&mut self, attribute: f64, size: f64) -> Result<(), Error> {
        positive(size)?;
        if attribute.is_nan() {
            return Err(Error::new(
                Status::InvalidArgument,
                format_args!("the attribute of a region is NaN"),
            ));
        }
        let known = self.regions.iter().position(|r| r.attribute == attribute);
        match known {
            Some(at) if size.is_infinite() => drop(self.regions.remove(at)),
            Some(at) => self.regions[at].size = size,
            None if size.is_infinite() => {}
            None => fallible::push(&mut self.regions, RegionSize { attribute, size })?,
        }
        Ok(())
    }

    /// Whether all lengths are positive, and points have none or one each.
    ///
    /// # Errors
    /// [`Status::InvalidArgument`], with the place.
    pub(crate) fn check(&self, points: usize) -> Result<(), Error> {
        if !self.points.is_empty() && self.points.len() != points {
            let given = self.points.len();
            return Err(Error::new(
                Status::InvalidArgument,
                format_args!("{given} sizes for {points} points: one each is needed, or none"),
            ));
        }
        if let Some((i, size)) = self.points.iter().enumerate().find(|x| x.1.is_nan() || *x.1 <= 0.0) {
            return Err(Error::new(
                Status::InvalidArgument,
                format_args!("the size {size} of point {i} is not positive"),
            ));
        }
        let lists = [("facets", &self.facets), ("facets", &self.facet_areas), ("segments", &self.segments)];
        for (what, list) in lists {
            if !list.is_sorted_by(|x, y| x.marker < y.marker) {
                return Err(Error::new(
                    Status::InvalidArgument,
                    format_args!("the sizes of {what} are not in the order of their markers, one each"),
                ));
            }
        }
        let markers = self.facets.iter().chain(&self.facet_areas).chain(&self.segments).map(|s| s.size);
        markers.chain(self.regions.iter().map(|s| s.size)).try_for_each(positive)
    }

    /// The length wanted on facets with a marker.
    pub(crate) fn of_facet(&self, marker: i32) -> Option<f64> {
        of_marker(&self.facets, marker)
    }

    /// The area wanted on facets with a marker.
    pub(crate) fn area_of_facet(&self, marker: i32) -> Option<f64> {
        of_marker(&self.facet_areas, marker)
    }

    /// The smaller of the length wanted on facets with a marker and the edge of the area.
    pub(crate) fn edge_of_facet(&self, marker: i32) -> Option<f64> {
        let edge = self.area_of_facet(marker).map(edge_of_area);
        self.of_facet(marker).into_iter().chain(edge).reduce(f64::min)
    }

    /// Whether anything is wanted on facets.
    pub(crate) fn on_facets(&self) -> bool {
        !self.facets.is_empty() || !self.facet_areas.is_empty()
    }

    /// The length wanted on segments with a marker.
    pub(crate) fn of_segment(&self, marker: i32) -> Option<f64> {
        of_marker(&self.segments, marker)
    }
}

/// The edge of the equilateral triangle of an area.
fn edge_of_area(area: f64) -> f64 {
    // 4 times a large one would overflow.
    2.0 / 3f64.sqrt().sqrt() * area.sqrt()
}

fn positive(size: f64) -> Result<(), Error> {
    if size > 0.0 {
        return Ok(());
    }
    Err(Error::new(Status::InvalidArgument, format_args!("the size {size} is not positive")))
}

fn set_marker(list: &mut Vec<MarkerSize>, marker: i32, size: f64) -> Result<(), Error> {
    positive(size)?;
    match (list.binary_search_by_key(&marker, |s| s.marker), size.is_infinite()) {
        (Ok(at), true) => drop(list.remove(at)),
        (Ok(at), false) => list[at].size = size,
        (Err(_), true) => {}
        (Err(at), false) => fallible::insert_at(list, at, MarkerSize { marker, size })?,
    }
    Ok(())
}

fn of_marker(list: &[MarkerSize], marker: i32) -> Option<f64> {
    let at = list.binary_search_by_key(&marker, |s| s.marker).ok()?;
    Some(list[at].size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_length_set_counts_and_infinity_takes_it_back() {
        let mut sizes = Sizes::default();
        for (marker, size) in [(5, 2.0), (-1, 1.0), (5, 0.5), (3, 1.0), (3, f64::INFINITY)] {
            sizes.set_facets(marker, size).unwrap();
            sizes.set_segments(marker, 2.0 * size).unwrap();
            sizes.set_regions(f64::from(marker), size).unwrap();
        }
        assert_eq!([5, -1, 3].map(|m| sizes.of_facet(m)), [Some(0.5), Some(1.0), None]);
        assert_eq!(sizes.of_segment(5), Some(1.0));
        assert_eq!(sizes.regions.len(), 2);
        assert!(!sizes.is_empty() && Sizes::default().is_empty());
        sizes.check(7).unwrap();
    }

    #[test]
    fn of_length_and_area_the_smaller_counts() {
        let mut sizes = Sizes::default();
        let edge = 3f64.sqrt() / 4.0;
        sizes.set_facet_areas(2, 4.0 * edge).unwrap();
        assert_eq!((sizes.of_facet(2), sizes.area_of_facet(2)), (None, Some(4.0 * edge)));
        assert!((sizes.edge_of_facet(2).unwrap() - 2.0).abs() < 1e-15 && sizes.on_facets());
        sizes.set_facets(2, 1.5).unwrap();
        assert_eq!(sizes.edge_of_facet(2), Some(1.5));
        sizes.set_facet_areas(2, edge).unwrap();
        assert!((sizes.edge_of_facet(2).unwrap() - 1.0).abs() < 1e-15);
        for area in [0.0, -1.0, f64::NAN] {
            assert_eq!(sizes.set_facet_areas(2, area).unwrap_err().status, Status::InvalidArgument);
        }
        sizes.set_facet_areas(2, f64::MAX).unwrap();
        assert_eq!(sizes.edge_of_facet(2), Some(1.5));
        assert_eq!(sizes.edge_of_facet(3), None);
        sizes.facet_areas[0].size = -1.0;
        assert!(sizes.check(0).is_err());
    }

    #[test]
    fn what_is_no_length_is_refused() {
        let mut sizes = Sizes::default();
        for size in [0.0, -1.0, f64::NAN] {
            assert_eq!(sizes.set_facets(1, size).unwrap_err().status, Status::InvalidArgument);
            assert_eq!(sizes.set_regions(1.0, size).unwrap_err().status, Status::InvalidArgument);
        }
        assert!(sizes.set_regions(f64::NAN, 1.0).is_err() && sizes.is_empty());
        sizes.points = vec![1.0, f64::INFINITY];
        sizes.check(2).unwrap();
        assert!(sizes.check(3).is_err());
        sizes.facets = [2, 1].map(|marker| MarkerSize { marker, size: 1.0 }).to_vec();
        assert!(sizes.check(2).unwrap_err().message.contains("order"));
        sizes.facets.clear();
        sizes.points[0] = -0.0;
        assert!(sizes.check(2).unwrap_err().message.contains("point 0"));
    }
}
