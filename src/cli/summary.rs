//! What the program prints on success.
use super::page::Page;
use super::quality::Quality;
use delotet::{Phase, Plc, TetMesh};
use std::collections::HashMap;
use std::path::Path;

/// Prints the counts and properties of a mesh.
pub fn describe_mesh(page: &mut Page, output: &Path, mesh: &TetMesh, quality: &Quality, total: f64) {
    let s = &mesh.statistics;
    let duplicates = match s.duplicate_points {
        0 => String::new(),
        n => format!(", {} of them equal to an earlier one", grouped(n)),
    };
    page.line(
        "points",
        format_args!(
            "{} in{duplicates}, {} out",
            grouped(mesh.input_point_count.into()),
            grouped(mesh.points.len() as u64)
        ),
    );
    page.line("Steiner points", steiner(mesh));
    if !mesh.facet_flips.is_empty() {
        page.line("facet flips", grouped(mesh.facet_flips.len() as u64));
    }
    page.line("tetrahedra", grouped(mesh.tets.len() as u64));
    let volumes = volumes(mesh);
    const LISTED: usize = 12;
    for (i, (region, volume)) in mesh.regions.iter().zip(&volumes).enumerate().take(LISTED) {
        let (count, volume) = volume;
        page.line(
            if i == 0 { "regions" } else { "" },
            format_args!(
                "attribute {}: {} tetrahedra, volume {volume:.6}",
                region.attribute,
                grouped(*count)
            ),
        );
    }
    if volumes.len() > LISTED {
        page.line("", format_args!("… and {} more", volumes.len() - LISTED));
    }
    quality.describe(page);
    page.line("time", times(&s.seconds, total));
    if let Some(peak) = delotet::ffi::memory::peak_resident() {
        page.line("memory", format_args!("{} MB at peak", grouped(peak.div_ceil(1_000_000))));
    }
    page.line("written", output.display());
}

/// How many points were added, and where.
fn steiner(mesh: &TetMesh) -> String {
    let inside = mesh.steiner.iter().filter(|point| point.is_inside()).count();
    let on_edges = mesh.steiner.iter().filter(|point| point.is_on_edge()).count();
    let on_facets = mesh.steiner.len() - inside - on_edges;
    if on_facets > 0 {
        let [edges, facets, inside] = [on_edges, on_facets, inside].map(|n| grouped(n as u64));
        return format!("{edges} on edges of the input, {facets} on its facets, {inside} inside");
    }
    match (on_edges, inside) {
        (0, 0) => "none: the boundary is exactly the input's".to_string(),
        (0, n) => format!("{} inside; the boundary is exactly the input's", grouped(n as u64)),
        (n, inside) => {
            let exact = grouped(mesh.statistics.steiner_exact);
            let more = match inside {
                0 => String::new(),
                n => format!("; {} inside", grouped(n as u64)),
            };
            format!("{} on edges of the input, {exact} of them exact in doubles{more}", grouped(n as u64))
        }
    }
}

/// Tetrahedra and volume per region.
fn volumes(mesh: &TetMesh) -> Vec<(u64, f64)> {
    let mut sums = vec![(0u64, 0.0f64); mesh.regions.len()];
    for (tet, &region) in mesh.tets.iter().zip(&mesh.tet_region) {
        let Some(sum) = sums.get_mut(region as usize) else { continue };
        let [a, b, c, d] = tet.map(|v| mesh.points.get(v as usize).copied().unwrap_or_default());
        *sum = (sum.0 + 1, sum.1 + volume(a, b, c, d));
    }
    sums
}

fn volume(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> f64 {
    let [u, v, w] = [b, c, d].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
    let cross = [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]];
    (u[0] * cross[0] + u[1] * cross[1] + u[2] * cross[2]) / 6.0
}

fn times(seconds: &[f64; Phase::COUNT], total: f64) -> String {
    let parts: Vec<String> = Phase::ALL
        .iter()
        .filter(|&&p| seconds[p as usize] >= 0.0005)
        .map(|&p| format!("{} {:.3}", p.name(), seconds[p as usize]))
        .collect();
    match parts.is_empty() {
        true => format!("{total:.3} s"),
        false => format!("{total:.3} s ({})", parts.join(", ")),
    }
}

/// A number with a separator between groups of three digits.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i) % 3 == 0 {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// Prints what is in a PLC.
pub fn describe_plc(page: &mut Page, input: &Path, plc: &Plc) {
    page.line("file", input.display());
    page.line("points", grouped(plc.points.len() as u64));
    let polygons = match plc.facets.len() {
        0 => String::new(),
        n => format!(", {} of them general polygons", grouped(n as u64)),
    };
    page.line("facets", format_args!("{}{polygons}", grouped(plc.facet_count() as u64)));
    for (label, count) in
        [("segments", plc.segments.len()), ("holes", plc.holes.len()), ("regions", plc.regions.len())]
    {
        if count > 0 {
            page.line(label, grouped(count as u64));
        }
    }
    if let Some((low, high)) = bounds(plc) {
        page.line(
            "box",
            format_args!("({}, {}, {}) to ({}, {}, {})", low[0], low[1], low[2], high[0], high[1], high[2]),
        );
    }
    if plc.facet_count() > 0 {
        page.line("surface", edges(plc));
    }
}

fn bounds(plc: &Plc) -> Option<([f64; 3], [f64; 3])> {
    let first = *plc.points.first()?;
    Some(plc.points.iter().fold((first, first), |(low, high), p| {
        (std::array::from_fn(|i| low[i].min(p[i])), std::array::from_fn(|i| high[i].max(p[i])))
    }))
}

/// How the facets meet: open edges, edges of more than two facets. Equal points count as one.
fn edges(plc: &Plc) -> String {
    let mut first: HashMap<[u64; 3], u32> = HashMap::new();
    let same: Vec<u32> = plc
        .points
        .iter()
        .enumerate()
        .map(|(i, p)| *first.entry(p.map(|x| (x + 0.0).to_bits())).or_insert(i as u32))
        .collect();
    let mut uses: HashMap<(u32, u32), u32> = HashMap::new();
    let triangles = plc.triangles.iter().map(|t| &t[..]);
    let polygons = plc.facets.iter().flat_map(|f| f.polygons.iter().map(|p| &p[..])).filter(|p| p.len() > 2);
    for ring in triangles.chain(polygons) {
        for (i, &a) in ring.iter().enumerate() {
            let b = ring[(i + 1) % ring.len()];
            let (Some(&a), Some(&b)) = (same.get(a as usize), same.get(b as usize)) else { continue };
            if a != b {
                *uses.entry((a.min(b), a.max(b))).or_insert(0) += 1;
            }
        }
    }
    let open = uses.values().filter(|&&n| n == 1).count();
    let multiple = uses.values().filter(|&&n| n > 2).count();
    let mut text = match open {
        0 => "closed".to_string(),
        n => format!("{} open edges", grouped(n as u64)),
    };
    if multiple > 0 {
        text += &format!(", {} edges of more than two facets", grouped(multiple as u64));
    }
    text
}
