//! The pipeline of [`Mode::Preserve`](crate::Mode::Preserve).
use super::{Engine, Run};
use crate::constrain::edge_key;
use crate::constrain::segment::Segments;
use crate::constrain::subface::{Subfaces, Triangles};
use crate::error::{Error, Status};
use crate::options::Options;
use crate::output::TetMesh;
use crate::plc::surface::Surface;
use crate::plc::{Plc, Prepared};
use crate::plc::patch::Patches;
use crate::preserve::recover::Recovery;
use rustc_hash::FxHashMap;
use crate::progress::{report, Phase};

impl Run<'_> {
    /// Recovers edges and faces inside a box, so that nothing of the surface lies on the hull.
    pub(super) fn preserve(
        &mut self,
        plc: &Plc,
        options: &Options,
        prepared: Prepared,
    ) -> Result<TetMesh, Error> {
        let mut engine = Engine::new(prepared.surface(), options)?;
        let count = engine.points.len() as u32;
        for corner in surrounding_box(engine.points.coordinates()) {
            engine.points.push(corner)?;
        }
        let surface = prepared.connect(plc, options, None, self.observer)?;
        self.lap(Phase::Validate);
        let mut order: Vec<u32> = (count..count + 8).chain(0..count).collect();
        let total = order.len() as f64;
        let observer = &mut *self.observer;
        engine.delaunay.build(&engine.points, &mut order, &mut |done| {
            report(observer, Phase::Delaunay, done as f64 / total)
        })?;
        engine.delaunay.index_vertices(engine.points.len())?;
        self.lap(Phase::Delaunay);
        let all_edges = edges_of(&surface)?;
        let edges = engine.map(&all_edges)?;
        let corners = engine.map(&surface.triangles)?;
        let Engine { delaunay, points, .. } = &mut engine;
        let mut recovery = Recovery::new(delaunay, points);
        let missing = recovery.edges(&edges, &mut |_| Ok(()))?;
        let relaxed = relax(&surface, &all_edges, &missing)?;
        let kept: Vec<[u32; 2]> = edges.iter().zip(&relaxed.keep).filter(|(_, k)| **k).map(|(e, _)| *e).collect();
        let mut segments = Segments::new(recovery.points, kept)?;
        let ok = recovery.split_missing(&mut segments, &mut |_| Ok(()))?;
        eprintln!("edges {} missing {} recovered {} relaxed {} split {} points {} ok {ok}", edges.len(), recovery.missing_edges, recovery.recovered, edges.len() - segments.ends.len(), recovery.split, segments.steiner_t.len());
        self.lap(Phase::Segments);
        let triangles = Triangles { corners: &corners, facet: &surface.triangle_facet, patch: &relaxed.patch, patch_count: relaxed.patch_count };
        let mut subfaces = Subfaces::build(recovery.points, &triangles, &segments)?;
        recovery.recovered = 0;
        let ok = ok && recovery.faces(&mut subfaces, &mut |_| Ok(()))?;
        eprintln!("faces {} missing {} recovered {} {}", subfaces.verts.len(), recovery.missing_faces, recovery.recovered, if ok {"GOOD"} else {"BAD"});
        drop(recovery);
        self.lap(Phase::Facets);
        crate::mesh::check::check_topology(&engine.delaunay.mesh).map_err(Error::internal)?;
        let mesh = &engine.delaunay.mesh;
        for t in 0..mesh.slot_count() as u32 {
            if mesh.is_live(t) && !mesh.is_ghost(t) {
                let [a, b, c, d] = mesh.verts[t as usize];
                if engine.points.orient3d(a, b, c, d) != crate::predicates::Sign::Positive { return Err(Error::internal("neg")); }
            }
        }
        self.lap(Phase::Segments);
        eprintln!("seconds {:?}", self.statistics.seconds);
        Err(Error::new(Status::Unsupported, "not offered yet"))
    }
}

/// Which edges are kept, and the patches between them.
struct Relaxed {
    /// Per edge whether it is a segment.
    keep: Vec<bool>,
    /// Per triangle its patch.
    patch: Vec<u32>,
    patch_count: usize,
}

/// Gives up missing flat edges: the triangles on both sides become one patch.
fn relax(surface: &Surface, edges: &[[u32; 2]], missing: &[u32]) -> Result<Relaxed, Error> {
    let mut keep = Vec::new();
    keep.try_reserve(edges.len())?;
    keep.resize(edges.len(), true);
    for &edge in missing {
        keep[edge as usize] = surface.segments.binary_search(&edges[edge as usize]).is_ok();
    }
    let mut patches = Patches::new(surface.triangles.len())?;
    let mut first: FxHashMap<[u32; 2], u32> = FxHashMap::default();
    for (t, &[a, b, c]) in surface.triangles.iter().enumerate() {
        for key in [edge_key(a, b), edge_key(b, c), edge_key(c, a)] {
            if let Ok(edge) = edges.binary_search(&key) {
                if !keep[edge] {
                    let other = *first.entry(key).or_insert(t as u32);
                    patches.join(other, t as u32);
                }
            }
        }
    }
    let mut patch = Vec::new();
    let patch_count = patches.number(&mut patch)? as usize;
    Ok(Relaxed { keep, patch, patch_count })
}

/// All edges of triangles, and the other segments.
fn edges_of(surface: &Surface) -> Result<Vec<[u32; 2]>, Error> {
    let mut edges = Vec::new();
    edges.try_reserve(3 * surface.triangles.len() + surface.segments.len())?;
    for &[a, b, c] in &surface.triangles {
        edges.extend([edge_key(a, b), edge_key(b, c), edge_key(c, a)]);
    }
    edges.extend(surface.segments.iter().map(|&[a, b]| edge_key(a, b)));
    edges.sort_unstable();
    edges.dedup();
    Ok(edges)
}

/// Corners of an uneven box well around all points: hardly anything is coplanar with them. On a coarse grid: short numbers keep the
/// arithmetic short.
fn surrounding_box(points: &[[f64; 3]]) -> [[f64; 3]; 8] {
    /// Odd multiples of a 64th, all different.
    const UNEVEN: [[f64; 3]; 8] = [
        [1.0, 19.0, 7.0],
        [29.0, 3.0, 11.0],
        [13.0, 23.0, 31.0],
        [5.0, 17.0, 27.0],
        [21.0, 9.0, 15.0],
        [25.0, 33.0, 37.0],
        [35.0, 39.0, 43.0],
        [41.0, 47.0, 45.0],
    ];
    let fold = |k: usize, f: fn(f64, f64) -> f64, from: f64| points.iter().map(|p| p[k]).fold(from, f);
    let low = [0, 1, 2].map(|k| fold(k, f64::min, f64::INFINITY));
    let high = [0, 1, 2].map(|k| fold(k, f64::max, f64::NEG_INFINITY));
    let side = (0..3).map(|k| high[k] - low[k]).fold(f64::MIN_POSITIVE, f64::max);
    let unit = side.log2().ceil().exp2();
    std::array::from_fn(|i| {
        std::array::from_fn(|k| {
            let beyond = unit * (1.0 + UNEVEN[i][k] / 64.0);
            if i >> k & 1 == 0 {
                (low[k] / unit).floor() * unit - beyond
            } else {
                (high[k] / unit).ceil() * unit + beyond
            }
        })
    })
}
