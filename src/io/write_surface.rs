//! Surface files: OFF, STL, OBJ, PLY and TetGen's `.node`, `.poly`, `.smesh`. What a format cannot express is an error, not dropped.
//! Sources: see the readers of the formats.
use crate::error::{Defect, DefectKind, Element, Error, Status};
use crate::fallible;
use crate::io::output_files::{Out, OutputFiles};
use crate::io::{Format, WriteOptions};
use crate::plc::{Facet, Interior, Plc};
use crate::warning::{Warning, WarningKind, Warnings};
use std::io;
use std::path::Path;

/// Writes a PLC in the format of the path.
pub(super) fn write(files: &mut OutputFiles, path: &Path, plc: &Plc) -> Result<(), Error> {
    check_finite(plc)?;
    let refuse = |what: &str| Error::new(Status::Unsupported, format_args!("{}: {what}", path.display()));
    let simple = |f: &Facet| f.polygons.len() == 1 && f.holes.is_empty();
    let seeds = !plc.holes.is_empty() || !plc.regions.is_empty();
    match Format::of(path)? {
        Format::Poly if plc.facets.iter().all(|f| simple(f) || f.interior == Interior::Seeds) => {
            files.write(path, |out| poly(out, plc))
        }
        Format::Poly => Err(refuse("facets with inner rings need a point in each hole to be written")),
        Format::Node => files.write(path, |out| nodes(out, plc)),
        Format::Smesh if plc.facets.iter().all(simple) && plc.segments.is_empty() => {
            files.write(path, |out| smesh(out, plc))
        }
        Format::Smesh => Err(refuse("a .smesh holds neither segments nor facets of several polygons")),
        format if format.is_mesh() => Err(refuse("not a surface format")),
        _ if seeds => Err(refuse("the format has no hole or region seeds; .poly has")),
        _ if !plc.facets.iter().all(simple) => {
            Err(refuse("the format has no facets of several polygons; .poly has"))
        }
        Format::Off => files.write(path, |out| off(out, plc)),
        Format::Obj => files.write(path, |out| obj(out, plc)),
        Format::Ply => files.write(path, |out| ply(out, plc)),
        _ if plc.facets.iter().any(|f| f.polygons[0].len() != 3) || !plc.segments.is_empty() => {
            Err(refuse("an STL file holds triangles only"))
        }
        _ => files.write(path, |out| stl(out, plc)),
    }
}

/// Warnings about values of a PLC that the format cannot hold.
pub(super) fn lost(format: Format, plc: &Plc) -> Result<Warnings, Error> {
    let mut warnings = Warnings::default();
    let mut lose = |first: Element| {
        let warning = Warning { kind: WarningKind::LostValue, first, second: None, point: None };
        warnings.push(warning, WriteOptions::default().max_warnings);
    };
    if format == Format::Stl {
        let mut used = fallible::filled(false, plc.points.len())?;
        for &corner in rings(plc).flat_map(|(ring, _)| ring) {
            if let Some(used) = used.get_mut(corner as usize) {
                *used = true;
            }
        }
        let plain = is_plain(plc);
        let rounded = |p: &[f64; 3]| plain && p.iter().any(|&x| f64::from(x as f32) != x);
        for (i, (point, used)) in plc.points.iter().zip(used).enumerate() {
            if !used || rounded(point) {
                lose(Element::Point(i as u32));
            }
        }
    }
    if !matches!(format, Format::Poly | Format::Smesh | Format::Node) {
        let width = plc.point_attribute_count.max(1);
        let attribute = plc.point_attributes.iter().position(|&x| x != 0.0).map(|i| i / width);
        let marker = plc.point_markers.iter().position(|&m| m != 0);
        attribute.into_iter().chain(marker).for_each(|i| lose(Element::Point(i as u32)));
    }
    if format == Format::Node {
        (plc.facet_count() > 0).then(|| lose(Element::Facet(0)));
        (!plc.segments.is_empty()).then(|| lose(Element::Segment(0)));
    }
    Ok(warnings)
}

fn check_finite(plc: &Plc) -> Result<(), Error> {
    match plc.points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        None => Ok(()),
        Some(i) => {
            let first = Element::Point(i as u32);
            let defect = Defect { kind: DefectKind::NonFinite, first, second: None, point: None };
            Err(Error::with_defect(
                Status::NonFinitePoint,
                format_args!("{first} has a coordinate that is not finite"),
                defect,
            ))
        }
    }
}

/// The rings of all facets in order, with markers (simple facets only).
fn rings(plc: &Plc) -> impl Iterator<Item = (&[u32], i32)> {
    let triangles = plc.triangles.iter().enumerate().map(|(i, t)| (&t[..], plc.facet_marker(i)));
    triangles.chain(plc.facets.iter().map(|f| (f.polygons.first().map_or(&[][..], |p| &p[..]), f.marker)))
}

fn points(out: &mut Out, plc: &Plc, prefix: &str) -> io::Result<()> {
    plc.points.iter().try_for_each(|point| {
        out.put(prefix)?;
        out.point(point)?;
        out.put("\n")
    })
}

/// Comments that name the markers: a line `# marker K NAME` each, for `groups::names_in_comments`.
fn names(out: &mut Out, plc: &Plc, comment: &str) -> io::Result<()> {
    for name in &plc.names {
        out.put(comment)?;
        out.put(" marker ")?;
        out.int(name.marker)?;
        out.put(" ")?;
        out.put(one_line(&name.name))?;
        out.put("\n")?;
    }
    Ok(())
}

/// The first line of a name, for files in which a line ends it.
fn one_line(name: &str) -> &str {
    name.lines().next().unwrap_or_default()
}

fn off(out: &mut Out, plc: &Plc) -> io::Result<()> {
    out.put("OFF\n")?;
    names(out, plc, "#")?;
    out.format(format_args!("{} {} 0\n", plc.points.len(), plc.facet_count() + plc.segments.len()))?;
    points(out, plc, "")?;
    // Where there are markers, all are written: a reader may want one colour index per face.
    let marked = rings(plc).any(|(_, marker)| marker != 0) || plc.segments.iter().any(|s| s.marker != 0);
    let segments = plc.segments.iter().map(|s| (&s.ends[..], s.marker));
    for (ring, marker) in rings(plc).chain(segments) {
        polygon(out, ring)?;
        if marked {
            out.blank_int(marker)?;
        }
        out.put("\n")?;
    }
    Ok(())
}

/// A count and the corners.
fn polygon(out: &mut Out, corners: &[u32]) -> io::Result<()> {
    out.int(corners.len())?;
    corners.iter().try_for_each(|&c| out.blank_int(c))
}

fn obj(out: &mut Out, plc: &Plc) -> io::Result<()> {
    points(out, plc, "v ")?;
    let mut current = 0;
    let facets = rings(plc).map(|(ring, marker)| ("f", ring, marker));
    let segments = plc.segments.iter().map(|s| ("l", &s.ends[..], s.marker));
    let mut first = plc.marker_name(0).is_some();
    for (keyword, corners, marker) in facets.chain(segments) {
        if marker != current || first {
            out.put("g ")?;
            group_name(out, plc, marker)?;
            out.put("\n")?;
            (current, first) = (marker, false);
        }
        out.put(keyword)?;
        corners.iter().try_for_each(|&c| out.blank_int(u64::from(c) + 1))?;
        out.put("\n")?;
    }
    Ok(())
}

/// `marker_K`, and the marker's name: a group that states its marker.
fn group_name(out: &mut Out, plc: &Plc, marker: i32) -> io::Result<()> {
    out.put("marker_")?;
    out.int(marker)?;
    match plc.marker_name(marker) {
        None => Ok(()),
        Some(name) => {
            out.put(" ")?;
            out.put(one_line(name))
        }
    }
}

fn ply(out: &mut Out, plc: &Plc) -> io::Result<()> {
    let marked = rings(plc).any(|(_, marker)| marker != 0);
    out.put("ply\nformat binary_little_endian 1.0\n")?;
    names(out, plc, "comment")?;
    out.format(format_args!(
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
        plc.points.len()
    ))?;
    let wide = rings(plc).any(|(ring, _)| ring.len() > 255);
    let count_type = if wide { "uint" } else { "uchar" };
    out.format(format_args!(
        "element face {}\nproperty list {count_type} uint vertex_indices\n",
        plc.facet_count()
    ))?;
    if marked {
        out.put("property int marker\n")?;
    }
    if !plc.segments.is_empty() {
        let count = plc.segments.len();
        out.format(format_args!(
            "element edge {count}\nproperty uint vertex1\nproperty uint vertex2\nproperty int marker\n"
        ))?;
    }
    out.put("end_header\n")?;
    for x in plc.points.iter().flatten() {
        out.put(x.to_le_bytes())?;
    }
    for (ring, marker) in rings(plc) {
        if wide {
            out.put((ring.len() as u32).to_le_bytes())?;
        } else {
            out.put([ring.len() as u8])?;
        }
        ring.iter().try_for_each(|c| out.put(c.to_le_bytes()))?;
        if marked {
            out.put(marker.to_le_bytes())?;
        }
    }
    for segment in &plc.segments {
        segment.ends.iter().try_for_each(|c| out.put(c.to_le_bytes()))?;
        out.put(segment.marker.to_le_bytes())?;
    }
    Ok(())
}

fn stl(out: &mut Out, plc: &Plc) -> io::Result<()> {
    if is_plain(plc) {
        stl_binary(out, plc)
    } else {
        stl_text(out, plc)
    }
}

/// Nothing is marked or named, and no coordinate is beyond single precision: a binary file holds all but the last bits.
fn is_plain(plc: &Plc) -> bool {
    plc.names.is_empty()
        && rings(plc).all(|(_, marker)| marker == 0)
        && plc.points.iter().flatten().all(|x| x.abs() <= f64::from(f32::MAX))
}

/// A solid for each run of triangles of one marker, named by it: programs that divide a surface by its solids see the same
/// parts, and the order of the triangles stays.
fn stl_text(out: &mut Out, plc: &Plc) -> io::Result<()> {
    let end = |out: &mut Out, marker: i32| {
        out.put("endsolid ")?;
        group_name(out, plc, marker)?;
        out.put("\n")
    };
    let mut current = None;
    for (ring, marker) in rings(plc) {
        if current != Some(marker) {
            if let Some(last) = current.replace(marker) {
                end(out, last)?;
            }
            out.put("solid ")?;
            group_name(out, plc, marker)?;
            out.put("\n")?;
        }
        let [a, b, c] = triangle(plc, ring);
        out.put("facet normal ")?;
        out.point(&normal(a, b, c))?;
        out.put("\nouter loop\n")?;
        for corner in [a, b, c] {
            out.put("vertex ")?;
            out.point(&corner)?;
            out.put("\n")?;
        }
        out.put("endloop\nendfacet\n")?;
    }
    current.map_or(Ok(()), |last| end(out, last))
}

/// The corners of a triangle.
fn triangle(plc: &Plc, ring: &[u32]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| {
        ring.get(i).and_then(|&c| plc.points.get(c as usize)).copied().unwrap_or_default()
    })
}

fn stl_binary(out: &mut Out, plc: &Plc) -> io::Result<()> {
    let mut header = [b' '; 80];
    header[..7].copy_from_slice(b"delotet");
    out.put(header)?;
    out.put((plc.facet_count() as u32).to_le_bytes())?;
    for (ring, _) in rings(plc) {
        let [a, b, c] = triangle(plc, ring);
        for point in [normal(a, b, c), a, b, c] {
            point.iter().try_for_each(|&x| out.put((x as f32).to_le_bytes()))?;
        }
        out.put([0, 0])?;
    }
    Ok(())
}

/// The unit normal, zero where it cannot be computed.
fn normal(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [f64; 3] {
    let u: [f64; 3] = std::array::from_fn(|i| b[i] - a[i]);
    let v: [f64; 3] = std::array::from_fn(|i| c[i] - a[i]);
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    // Selects the divisor, not the quotient: compilers may divide before selecting, which would trap if the host enables traps.
    let (n, divisor) = if length.is_normal() { (n, length) } else { ([0.0; 3], 1.0) };
    n.map(|x| x / divisor)
}

fn nodes(out: &mut Out, plc: &Plc) -> io::Result<()> {
    let attributes = plc.point_attribute_count;
    let marked = !plc.point_markers.is_empty();
    out.format(format_args!("{}  3  {attributes}  {}\n", plc.points.len(), u8::from(marked)))?;
    for (i, point) in plc.points.iter().enumerate() {
        out.int(i)?;
        out.put(" ")?;
        out.point(point)?;
        for k in 0..attributes {
            out.blank_float(plc.point_attributes.get(i * attributes + k).copied().unwrap_or(0.0))?;
        }
        if marked {
            out.blank_int(plc.point_markers.get(i).copied().unwrap_or(0))?;
        }
        out.put("\n")?;
    }
    Ok(())
}

fn smesh(out: &mut Out, plc: &Plc) -> io::Result<()> {
    names(out, plc, "#")?;
    nodes(out, plc)?;
    out.format(format_args!("{}  1\n", plc.facet_count()))?;
    for (ring, marker) in rings(plc) {
        polygon(out, ring)?;
        out.put("  ")?;
        out.int(marker)?;
        out.put("\n")?;
    }
    seeds(out, plc)
}

fn poly(out: &mut Out, plc: &Plc) -> io::Result<()> {
    names(out, plc, "#")?;
    nodes(out, plc)?;
    out.format(format_args!("{}  1\n", plc.facet_count() + plc.segments.len()))?;
    for (i, triangle) in plc.triangles.iter().enumerate() {
        out.put("1 0 ")?;
        out.int(plc.facet_marker(i))?;
        out.put("\n")?;
        polygon(out, triangle)?;
        out.put("\n")?;
    }
    for facet in &plc.facets {
        out.format(format_args!("{} {} {}\n", facet.polygons.len(), facet.holes.len(), facet.marker))?;
        for ring in &facet.polygons {
            polygon(out, ring)?;
            out.put("\n")?;
        }
        numbered(out, &facet.holes)?;
    }
    for segment in &plc.segments {
        out.format(format_args!("1 0 {}\n", segment.marker))?;
        polygon(out, &segment.ends)?;
        out.put("\n")?;
    }
    seeds(out, plc)
}

/// Points with their numbers.
fn numbered(out: &mut Out, points: &[[f64; 3]]) -> io::Result<()> {
    for (i, point) in points.iter().enumerate() {
        out.int(i)?;
        out.put(" ")?;
        out.point(point)?;
        out.put("\n")?;
    }
    Ok(())
}

/// The hole and region sections.
fn seeds(out: &mut Out, plc: &Plc) -> io::Result<()> {
    out.format(format_args!("{}\n", plc.holes.len()))?;
    numbered(out, &plc.holes)?;
    out.format(format_args!("{}\n", plc.regions.len()))?;
    for (i, region) in plc.regions.iter().enumerate() {
        out.int(i)?;
        out.put(" ")?;
        out.point(&region.point)?;
        out.blank_float(region.attribute)?;
        if let Some(volume) = region.max_volume {
            out.blank_float(volume)?;
        }
        out.put("\n")?;
    }
    Ok(())
}
