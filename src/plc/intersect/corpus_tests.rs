//! Real models: valid ones have no defect, invalid ones the recorded number. Reads OFF files of the corpus next to the project, if present.
use super::*;
use crate::control::Control;
use crate::progress::Phase;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

fn corpus() -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/corpus");
    if path.join("index.tsv").exists() {
        return Some(path);
    }
    eprintln!("no corpus next to the project: real models are not tested");
    None
}

/// Points with equal ones merged, and triangles without degenerate ones.
struct Surface {
    points: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// Reads an OFF file with one element per line, polygons as fans; colours and normals are skipped. `None` if it is no such file.
fn read_off(path: &Path) -> Option<Surface> {
    let text = std::fs::read_to_string(path).ok()?;
    let mut lines =
        text.lines().map(|line| line.split('#').next().unwrap_or("").trim()).filter(|l| !l.is_empty());
    let (keyword, rest) = lines.next()?.split_once("OFF")?;
    if !["", "C", "N", "CN"].contains(&keyword) {
        return None;
    }
    // The counts may stand on the first line.
    let header = if rest.is_empty() { lines.next()? } else { rest };
    let mut counts = header.split_whitespace().map(|word| word.parse::<usize>().unwrap_or(0));
    let (count, faces) = (counts.next()?, counts.next()?);
    let mut merged = BTreeMap::new();
    let (mut points, mut map) = (Vec::new(), Vec::new());
    for line in lines.by_ref().take(count) {
        let mut words = line.split_whitespace().map(|word| word.parse::<f64>().ok());
        let p = [words.next()??, words.next()??, words.next()??];
        let key = p.map(|x| (x + 0.0).to_bits());
        map.push(*merged.entry(key).or_insert_with(|| {
            points.push(p);
            points.len() as u32 - 1
        }));
    }
    let mut triangles = Vec::new();
    for line in lines.take(faces) {
        let mut words = line.split_whitespace().map_while(|word| word.parse::<usize>().ok());
        let n = words.next()?;
        let ring = words.take(n).map(|v| map.get(v).copied()).collect::<Option<Vec<u32>>>()?;
        triangles.extend((2..ring.len()).map(|i| [ring[0], ring[i - 1], ring[i]]));
    }
    triangles.retain(|t: &[u32; 3]| {
        let corners = t.map(|v| points[v as usize]);
        !locate_point::collinear(&corners[0], &corners[1], &corners[2])
    });
    Some(Surface { points, triangles })
}

fn find(surface: &Surface) -> (Intersections, f64) {
    let vertices: Vec<u32> = (0..surface.points.len() as u32).collect();
    let facets: Vec<u32> = (0..surface.triangles.len() as u32).collect();
    let input = IntersectInput {
        points: &surface.points,
        vertices: &vertices,
        triangles: &surface.triangles,
        triangle_facet: &facets,
        segments: &[],
    };
    let start = Instant::now();
    let found = find_intersections(&input, 100, Control::free().whole(Phase::Validate)).unwrap();
    (found, start.elapsed().as_secs_f64() * 1e3)
}

fn describe(name: &str, surface: &Surface, found: &Intersections, ms: f64) {
    eprintln!(
        "{name}: {} triangles, {ms:.1} ms, {} defects, vertices: {} on edges, {} in triangles",
        surface.triangles.len(),
        found.defect_count,
        found.vertex_on_edge.len(),
        found.vertex_in_triangle.len(),
    );
}

/// Too slow without optimization: all models in optimized builds, a few small ones in a debug build.
fn names(corpus: &Path, list: &str) -> Vec<String> {
    let text = std::fs::read_to_string(corpus.join(list)).unwrap();
    let all = text.lines().filter_map(|line| line.split_whitespace().next());
    let off =
        all.filter(|name| name.ends_with(".off") && !name.contains("bad_fmt") && !name.contains("bad_made"));
    let small = |name: &&str| {
        !cfg!(debug_assertions) || std::fs::metadata(corpus.join(name)).is_ok_and(|m| m.len() < 200_000)
    };
    off.filter(small).map(String::from).collect()
}

#[test]
fn valid_models_have_no_defects() {
    let Some(corpus) = corpus() else { return };
    let mut wrong = Vec::new();
    for name in names(&corpus, "public.txt") {
        let Some(surface) = read_off(&corpus.join(&name)) else {
            wrong.push(format!("{name}: cannot be read"));
            continue;
        };
        let (found, ms) = find(&surface);
        describe(&name, &surface, &found, ms);
        if found.defect_count > 0 {
            wrong.push(format!("{name}: {:?}", found.defects));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// How many pairs of triangles are legal only because a vertex or an edge of one lies on the other.
fn touching_pairs(surface: &Surface) -> usize {
    let facets: Vec<u32> = (0..surface.triangles.len() as u32).collect();
    let (points, triangles) = (&surface.points, &surface.triangles);
    let input = IntersectInput { points, vertices: &[], triangles, triangle_facet: &facets, segments: &[] };
    let (elements, bounds, fans) = list_elements(&input, &Control::free()).unwrap();
    let tree = BoxTree::new(&bounds, fans, &Control::free()).unwrap();
    let scene = Scene::new(&input, &elements, tree.order(), &Control::free()).unwrap();
    let mut count = 0;
    let visited = tree.for_each_pair(&Control::free(), |i, j, _| {
        let mut collector = Collector::new(Names::NONE, 1);
        scene.classify(i, j, &mut collector)?;
        let found = collector.finish(&Control::free())?;
        let touches =
            found.vertex_on_edge.len() + found.vertex_in_triangle.len() + found.edge_in_facet.len() > 0;
        count += usize::from(touches && found.defect_count == 0);
        Ok(())
    });
    visited.unwrap();
    count
}

/// The recorded numbers count every pair that meets outside common vertices and edges, so also those that touch in a vertex
/// or along an edge of one.
#[test]
fn invalid_models_have_the_recorded_number_of_intersecting_pairs() {
    let Some(corpus) = corpus() else { return };
    let notes = std::fs::read_to_string(corpus.join("invalid.txt")).unwrap();
    let mut wrong = Vec::new();
    for name in names(&corpus, "invalid.txt") {
        let Some(surface) = read_off(&corpus.join(&name)) else {
            wrong.push(format!("{name}: cannot be read"));
            continue;
        };
        let note = notes.lines().find(|line| line.starts_with(&name)).unwrap_or("");
        let recorded = note
            .split(';')
            .find_map(|part| part.trim().strip_suffix(" intersecting facet pairs")?.parse::<usize>().ok())
            .unwrap_or(0);
        let (found, ms) = find(&surface);
        describe(&name, &surface, &found, ms);
        let touching = if found.defect_count == recorded { 0 } else { touching_pairs(&surface) };
        if found.defect_count + touching != recorded {
            wrong.push(format!("{name}: {} + {touching} found, {recorded} recorded", found.defect_count));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
