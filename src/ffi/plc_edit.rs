//! Building and changing a PLC: the safe code behind the functions of `plc`. A call that fails changes nothing.
use crate::error::{Defect, DefectKind, Element, Error, Message, Status};
use crate::fallible;
use crate::ffi::error::c_text;
use crate::ffi::guard::invalid;
use crate::ffi::plc::DelotetPlc;
use crate::ffi::view::DelotetRegionSeed;
use crate::plc::{name_line, Facet, Plc, RegionSeed, Segment, Sizes};
use crate::INVALID;

impl DelotetPlc {
    /// A handle for a PLC.
    pub(super) fn new(plc: Plc) -> Result<DelotetPlc, Error> {
        let seeds = fallible::collect(plc.regions.iter().map(DelotetRegionSeed::from))?;
        let mut names = fallible::reserved(plc.names.len())?;
        for name in &plc.names {
            fallible::push(&mut names, c_text(&name.name)?)?;
        }
        Ok(DelotetPlc { plc, seeds, names })
    }

    pub(super) fn set_marker_name(&mut self, marker: i32, name: &str) -> Result<(), Error> {
        let text = c_text(name_line(name))?;
        self.names.try_reserve(1)?;
        let place = |plc: &Plc| plc.names.binary_search_by_key(&marker, |name| name.marker);
        let before = place(&self.plc);
        self.plc.set_marker_name(marker, name)?;
        match (before, place(&self.plc)) {
            (Ok(at), Ok(_)) => self.names[at] = text,
            (Ok(at), Err(_)) => drop(self.names.remove(at)),
            (Err(_), Ok(at)) => fallible::insert_at(&mut self.names, at, text)?,
            (Err(_), Err(_)) => {}
        }
        Ok(())
    }

    /// The first corner that refers to no point, as an error.
    fn check_corners(&self, corners: &[u32], element: impl Fn(usize) -> Element) -> Result<(), Error> {
        let points = self.plc.points.len();
        match corners.iter().position(|&corner| corner as usize >= points) {
            None => Ok(()),
            Some(place) => Err(Error::with_defect(
                Status::IndexOutOfRange,
                match corners[place] {
                    INVALID => Message::from(format_args!(
                        "{} has a corner that is negative or no 32-bit index; the PLC has {points} points",
                        element(place)
                    )),
                    corner => Message::from(format_args!(
                        "point {corner} does not exist: the PLC has {points} points"
                    )),
                },
                Defect {
                    kind: DefectKind::IndexOutOfRange,
                    first: element(place),
                    second: Some(Element::Point(corners[place])),
                    point: None,
                },
            )),
        }
    }

    fn check_room(&self, count: usize, present: usize) -> Result<(), Error> {
        match present.checked_add(count).is_some_and(|sum| sum < INVALID as usize) {
            true => Ok(()),
            false => Err(Error::new(Status::TooLarge, "more elements than 32-bit indices can address")),
        }
    }

    /// Appends points; their attributes, markers and weights are 0, if the points have any, and there is no wish for their sizes.
    pub(super) fn add_points(&mut self, points: &[[f64; 3]]) -> Result<(), Error> {
        self.check_room(points.len(), self.plc.points.len())?;
        let count = self.plc.points.len() + points.len();
        let plc = &mut self.plc;
        let width = plc.point_attribute_count;
        plc.points.try_reserve(points.len())?;
        plc.point_attributes.try_reserve(times(points.len(), width)?)?;
        let sized = if plc.sizes.points.is_empty() { 0 } else { points.len() };
        plc.sizes.points.try_reserve(sized)?;
        if !plc.point_markers.is_empty() {
            fallible::resize(&mut plc.point_markers, count, 0)?;
        }
        if let Some(values) = plc.lift.values_mut() {
            values.try_reserve(points.len())?;
        }
        if sized > 0 {
            fallible::resize(&mut plc.sizes.points, count, f64::INFINITY)?;
        }
        fallible::append(&mut plc.points, points)?;
        fallible::resize(&mut plc.point_attributes, count * width, 0.0)?;
        if let Some(values) = plc.lift.values_mut() {
            fallible::resize(values, count, 0.0)?;
        }
        Ok(())
    }

    pub(super) fn add_region(&mut self, seed: RegionSeed) -> Result<(), Error> {
        self.plc.regions.try_reserve(1)?;
        fallible::push(&mut self.seeds, DelotetRegionSeed::from(&seed))?;
        Ok(fallible::push(&mut self.plc.regions, seed)?)
    }

    /// One size per point; none takes them all back.
    pub(super) fn set_point_sizes(&mut self, sizes: &[f64]) -> Result<(), Error> {
        let wanted = Sizes { points: fallible::copied(sizes)?, ..Sizes::default() };
        wanted.check(self.plc.points.len())?;
        self.plc.sizes.points = wanted.points;
        Ok(())
    }

    pub(super) fn set_facet_markers(&mut self, markers: Option<&[i32]>) -> Result<(), Error> {
        let plc = &mut self.plc;
        let marker = |facet: usize| markers.map_or(0, |markers| markers[facet]);
        let triangles = plc.triangles.len();
        plc.triangle_markers.try_reserve_exact(triangles.saturating_sub(plc.triangle_markers.len()))?;
        plc.triangle_markers.clear();
        fallible::extend(&mut plc.triangle_markers, (0..triangles).map(marker))?;
        for (index, facet) in plc.facets.iter_mut().enumerate() {
            facet.marker = marker(triangles + index);
        }
        Ok(())
    }

    pub(super) fn set_facet_marker(&mut self, facet: u32, marker: i32) -> Result<(), Error> {
        let (index, triangles) = (facet as usize, self.plc.triangles.len());
        if index >= self.plc.facet_count() {
            let count = self.plc.facet_count();
            return Err(Error::new(
                Status::IndexOutOfRange,
                format_args!("facet {facet} does not exist: the PLC has {count}"),
            ));
        }
        match index.checked_sub(triangles) {
            Some(general) => self.plc.facets[general].marker = marker,
            None => {
                let markers = &mut self.plc.triangle_markers;
                markers.try_reserve_exact(triangles.saturating_sub(markers.len()))?;
                fallible::resize(markers, triangles, 0)?;
                markers[index] = marker;
            }
        }
        Ok(())
    }

    pub(super) fn add_segments(&mut self, ends: &[u32], markers: Option<&[i32]>) -> Result<(), Error> {
        let first = self.plc.segments.len();
        self.check_room(ends.len() / 2, first)?;
        self.check_corners(ends, |place| Element::Segment((first + place / 2) as u32))?;
        self.plc.segments.try_reserve(ends.len() / 2)?;
        for (index, pair) in ends.chunks_exact(2).enumerate() {
            let marker = markers.map_or(0, |markers| markers[index]);
            fallible::push(&mut self.plc.segments, Segment { ends: [pair[0], pair[1]], marker })?;
        }
        Ok(())
    }

    /// Triangles stay in their compact list as long as no general facet precedes them: facets keep the order of addition.
    pub(super) fn add_triangles(&mut self, corners: &[u32], markers: Option<&[i32]>) -> Result<(), Error> {
        let (first, count) = (self.plc.facet_count(), corners.len() / 3);
        self.check_room(count, first)?;
        self.check_corners(corners, |place| Element::Facet((first + place / 3) as u32))?;
        if !self.plc.facets.is_empty() {
            let ends: Vec<usize> = fallible::collect((1..=count).map(|end| 3 * end))?;
            return self.add_polygons(corners, &ends, markers);
        }
        self.plc.triangles.try_reserve(count)?;
        let marked = markers.is_some() || !self.plc.triangle_markers.is_empty();
        if marked {
            self.plc.triangle_markers.try_reserve(first + count - self.plc.triangle_markers.len())?;
            fallible::resize(&mut self.plc.triangle_markers, first, 0)?;
        }
        fallible::extend(
            &mut self.plc.triangles,
            corners.chunks_exact(3).map(|corner| [corner[0], corner[1], corner[2]]),
        )?;
        match markers {
            Some(markers) => fallible::append(&mut self.plc.triangle_markers, markers)?,
            None if marked => fallible::resize(&mut self.plc.triangle_markers, first + count, 0)?,
            None => {}
        }
        Ok(())
    }

    /// One facet per polygon.
    pub(super) fn add_polygons(
        &mut self,
        corners: &[u32],
        ends: &[usize],
        markers: Option<&[i32]>,
    ) -> Result<(), Error> {
        let first = self.plc.facet_count();
        self.check_room(ends.len(), first)?;
        self.check_corners(corners, |place| {
            Element::Facet((first + ends.partition_point(|&end| end <= place)) as u32)
        })?;
        let mut facets = fallible::reserved(ends.len())?;
        let mut start = 0;
        for (index, &end) in ends.iter().enumerate() {
            let polygons = split(&corners[start..], &[end - start])?;
            start = end;
            let marker = markers.map_or(0, |markers| markers[index]);
            fallible::push(&mut facets, Facet { polygons, marker, ..Facet::default() })?;
        }
        Ok(fallible::extend(&mut self.plc.facets, facets)?)
    }

    pub(super) fn add_facet(&mut self, corners: &[u32], ends: &[usize], facet: Facet) -> Result<(), Error> {
        let index = self.plc.facet_count();
        self.check_room(1, index)?;
        self.check_corners(corners, |_| Element::Facet(index as u32))?;
        let polygons = split(corners, ends)?;
        Ok(fallible::push(&mut self.plc.facets, Facet { polygons, ..facet })?)
    }
}

/// Splits the corner list of a facet into its polygons.
fn split(corners: &[u32], ends: &[usize]) -> Result<Vec<Vec<u32>>, Error> {
    let mut polygons = fallible::reserved(ends.len())?;
    let mut start = 0;
    for &end in ends {
        fallible::push(&mut polygons, fallible::copied(&corners[start..end])?)?;
        start = end;
    }
    Ok(polygons)
}

/// `count` rows of `width`, or an error if that overflows.
pub(super) fn times(count: usize, width: usize) -> Result<usize, Error> {
    count.checked_mul(width).ok_or_else(|| invalid("the count does not fit into memory"))
}
