//! What the surface readers fill: points, polygons in file order, and the joining of equal points.
use crate::control::Control;
use crate::error::{Defect, DefectKind, Element, Error, Status};
use crate::fallible;
use crate::io::groups::{Groups, Single};
use crate::plc::{Facet, Interior, Plc, Segment};

/// Points, polygons with markers, and segments, in file order.
pub(super) struct Surface<'a> {
    control: &'a Control<'a>,
    /// The points.
    pub points: Vec<[f64; 3]>,
    /// Segments.
    pub segments: Vec<Segment>,
    corners: Vec<u32>,
    ends: Vec<usize>,
    markers: Vec<i32>,
}

impl<'a> Surface<'a> {
    /// Without elements.
    pub fn new(control: &'a Control<'a>) -> Self {
        Surface {
            control,
            points: Vec::new(),
            segments: Vec::new(),
            corners: Vec::new(),
            ends: Vec::new(),
            markers: Vec::new(),
        }
    }

    /// Room for what the header announces.
    pub fn reserve(&mut self, points: usize, polygons: usize, corners: usize) -> Result<(), Error> {
        self.points.try_reserve_exact(points)?;
        self.ends.try_reserve_exact(polygons)?;
        self.markers.try_reserve_exact(polygons)?;
        self.corners.try_reserve_exact(corners)?;
        Ok(())
    }

    /// Adds a point.
    pub fn point(&mut self, point: [f64; 3]) -> Result<(), Error> {
        if self.points.len() >= u32::MAX as usize - 1 {
            return Err(Error::new(Status::TooLarge, "more points than 32-bit indices can address"));
        }
        fallible::push(&mut self.points, point)?;
        self.control.step()
    }

    /// What a polygon of so many corners will be when it ends.
    pub fn next_element(&self, corners: i64) -> Element {
        match corners {
            2 => Element::Segment(self.segments.len() as u32),
            _ => Element::Facet(self.ends.len() as u32),
        }
    }

    /// Adds a corner to the polygon under construction. What is no index of a point is refused by [`Surface::finish`].
    pub fn corner(&mut self, corner: i64) -> Result<(), Error> {
        fallible::push(&mut self.corners, u32::try_from(corner).unwrap_or(u32::MAX))?;
        Ok(())
    }

    /// Ends the polygon under construction; one of two corners becomes a segment.
    pub fn end_polygon(&mut self, marker: i32) -> Result<(), Error> {
        let start = self.ends.last().copied().unwrap_or(0);
        if let [a, b] = self.corners[start..] {
            fallible::push(&mut self.segments, Segment { ends: [a, b], marker })?;
            self.corners.truncate(start);
            return Ok(());
        }
        if self.ends.len() >= u32::MAX as usize - 1 {
            return Err(Error::new(Status::TooLarge, "more facets than 32-bit indices can address"));
        }
        fallible::push(&mut self.ends, self.corners.len())?;
        fallible::push(&mut self.markers, marker)?;
        self.control.step()
    }

    /// As [`Surface::finish`], where the markers so far are numbers of groups.
    pub fn finish_groups(mut self, join: bool, groups: &Groups, single: Single) -> Result<Plc, Error> {
        let mut named = Plc::default();
        let first = self.markers.first().copied().unwrap_or(0);
        let divided = self.markers.iter().any(|&m| m != first);
        let single = if divided { Single::Counts } else { single };
        let markers = groups.markers(single, &mut named)?;
        let marker_of = |number: i32| markers.get(number as usize).copied().unwrap_or(0);
        self.markers.iter_mut().for_each(|m| *m = marker_of(*m));
        self.segments.iter_mut().for_each(|s| s.marker = marker_of(s.marker));
        Ok(Plc { names: named.names, ..self.finish(join)? })
    }

    /// The PLC: triangles if all polygons are, else general facets in file order. With `join` equal points become one
    /// (the first; all others keep their order).
    pub fn finish(mut self, join: bool) -> Result<Plc, Error> {
        self.check_indices()?;
        if join {
            let map = join_points(&mut self.points, self.control)?;
            self.corners.iter_mut().for_each(|c| *c = map[*c as usize]);
            self.segments.iter_mut().for_each(|s| s.ends = s.ends.map(|c| map[c as usize]));
        }
        let mut plc = Plc { points: self.points, segments: self.segments, ..Plc::default() };
        let marked = self.markers.iter().any(|&m| m != 0);
        if self.ends.iter().enumerate().all(|(i, &end)| end == 3 * (i + 1)) {
            plc.triangles.try_reserve_exact(self.ends.len())?;
            fallible::extend(&mut plc.triangles, self.corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]))?;
            plc.triangle_markers = if marked { self.markers } else { Vec::new() };
            return Ok(plc);
        }
        plc.facets.try_reserve_exact(self.ends.len())?;
        let mut start = 0;
        for (&end, &marker) in self.ends.iter().zip(&self.markers) {
            self.control.step()?;
            let mut ring = fallible::reserved(end - start)?;
            fallible::append(&mut ring, &self.corners[start..end])?;
            let polygons = fallible::collect([ring])?;
            fallible::push(
                &mut plc.facets,
                Facet { polygons, holes: Vec::new(), interior: Interior::FirstMinusOthers, marker },
            )?;
            start = end;
        }
        Ok(plc)
    }

    fn check_indices(&self) -> Result<(), Error> {
        let count = self.points.len();
        if let Some(at) = self.corners.iter().position(|&c| c as usize >= count) {
            let facet = self.ends.partition_point(|&end| end <= at);
            return Err(out_of_range(Element::Facet(facet as u32), count));
        }
        match self.segments.iter().position(|s| s.ends.iter().any(|&c| c as usize >= count)) {
            Some(at) => Err(out_of_range(Element::Segment(at as u32), count)),
            None => Ok(()),
        }
    }
}

/// The error for an element that refers to a point that does not exist.
pub(super) fn out_of_range(element: Element, count: usize) -> Error {
    let what = format_args!("{element} refers to a point that does not exist (there are {count} points)");
    no_such_point(element, what)
}

/// As [`out_of_range`], in words of the file's format.
pub(super) fn no_such_point(element: Element, what: std::fmt::Arguments<'_>) -> Error {
    let defect = Defect { kind: DefectKind::IndexOutOfRange, first: element, second: None, point: None };
    Error::with_defect(Status::IndexOutOfRange, what, defect)
}

/// Removes every point that equals an earlier one (0 and -0 are equal) and returns the new index of each.
///
/// An open-addressing table of indices; a NaN equals only itself, bit for bit.
pub(super) fn join_points(points: &mut Vec<[f64; 3]>, control: &Control) -> Result<Vec<u32>, Error> {
    const FREE: u32 = u32::MAX;
    let bits = |p: &[f64; 3]| p.map(|x| if x == 0.0 { 0 } else { x.to_bits() });
    let mut map = fallible::reserved(points.len())?;
    let mut table: Vec<u32> = Vec::new();
    let mut kept = 0usize;
    for i in 0..points.len() {
        control.step()?;
        if 2 * (kept + 1) > table.len() {
            let size = (4 * table.len()).max(1 << 10);
            table.clear();
            table.try_reserve_exact(size)?;
            fallible::resize(&mut table, size, FREE)?;
            for (k, point) in points[..kept].iter().enumerate() {
                let mut slot = hash(bits(point)) & (size - 1);
                while table[slot] != FREE {
                    slot = (slot + 1) & (size - 1);
                }
                table[slot] = k as u32;
            }
        }
        let mask = table.len() - 1;
        let key = bits(&points[i]);
        let mut slot = hash(key) & mask;
        while table[slot] != FREE && bits(&points[table[slot] as usize]) != key {
            slot = (slot + 1) & mask;
        }
        if table[slot] == FREE {
            table[slot] = kept as u32;
            points[kept] = points[i];
            kept += 1;
        }
        fallible::push(&mut map, table[slot])?;
    }
    points.truncate(kept);
    Ok(map)
}

/// Mixes the bits of three coordinates (multiply and rotate, then a final avalanche of the upper bits).
fn hash(key: [u64; 3]) -> usize {
    let mut h = 0u64;
    for word in key {
        h = (h.rotate_left(23) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        h ^= h >> 32;
    }
    h = h.wrapping_mul(0xd6e8_feb8_6659_fd93);
    (h ^ (h >> 32)) as usize
}
