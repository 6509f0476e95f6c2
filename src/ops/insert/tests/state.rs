//! A mesh and what it must have: built from a model, changed by insertions.
use super::check::Count;
use super::model::Model;
use crate::control::Control;
use crate::delaunay::insert::Inserter;
use crate::delaunay::Construction;
use crate::domain::{components, label, Seeds};
use crate::facets::recovery::FacetRecovery;
use crate::facets::subface::{Subfaces, Triangles};
use crate::kernel::around::EdgeRing;
use crate::kernel::tables::EDGE;
use crate::kernel::{edge_key, Mesh, NONE};
use crate::ops::insert::{Insert, Outcome};
use crate::predicates::{Points, Sign};
use crate::preserve::carve;
use crate::segments::recovery::{Recovery, Segments};
use std::collections::{BTreeMap, BTreeSet};

/// A piece of a segment, with its parameters there, as far as doubles tell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) segment: [u32; 2],
    pub(super) ends: [u32; 2],
    pub(super) t: [f64; 2],
}

/// Where a vertex is.
#[derive(Clone, Copy, Debug)]
pub(super) enum Place {
    Outside,
    At(u32),
    Inside(u32),
    Facet(u32),
    Segment([u32; 2], u32),
}

/// A mesh, and what it must have.
pub(super) struct State {
    pub(super) points: Points,
    pub(super) mesh: Mesh,
    pub(super) insert: Insert,
    pub(super) pieces: Vec<Piece>,
    /// The subfaces, not necessarily Delaunay, and their patches.
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) patch: Vec<u32>,
    pub(super) patches: usize,
    pub(super) keep_hull: bool,
    pub(super) volumes: BTreeMap<u32, f64>,
    /// Whether the mesh has to be constrained Delaunay.
    pub(super) exact: bool,
}

/// The triangles of a surface, and the patch of each.
pub(super) struct Patches<'a> {
    pub(super) triangles: &'a [[u32; 3]],
    pub(super) patch: &'a [u32],
    pub(super) count: usize,
}

/// The constrained mesh of a domain, with flags of its subsegments.
pub(super) fn constrained(
    points: &mut Points,
    segments: &mut Segments,
    surface: Patches,
    keep_hull: bool,
) -> (Mesh, Subfaces) {
    let control = &Control::free();
    let (mut mesh, mut inserter) = (Construction::of(points), Inserter::default());
    assert!(Recovery::new(&mut mesh, &mut inserter, points, segments, control).run().unwrap());
    let facet = vec![0; surface.triangles.len()];
    let triangles = Triangles {
        corners: surface.triangles,
        facet: &facet,
        patch: surface.patch,
        patch_count: surface.count,
    };
    let subfaces = Subfaces::build(points, &triangles, segments, control).unwrap();
    FacetRecovery::new(&mut mesh, points, &subfaces, control).unwrap().run().unwrap();
    let parts = components(&mesh, control).unwrap();
    let seeds = Seeds { holes: &[], regions: &[], exponent: 0 };
    let regions = label(&mesh, points, &parts, &seeds, keep_hull, control).unwrap();
    mesh.set_regions(|t| regions.of_component[parts.of[t as usize] as usize]).unwrap();
    carve(&mut mesh, points.len(), &subfaces, control).unwrap();
    let pieces: BTreeSet<[u32; 2]> = segments.pieces.iter().map(|p| edge_key(p.ends[0], p.ends[1])).collect();
    let bits = |v: &[u32; 4]| {
        let is = |&(_, [i, j]): &(usize, [u8; 2])| pieces.contains(&edge_key(v[i as usize], v[j as usize]));
        Ok(EDGE.into_iter().enumerate().filter(is).map(|(e, _)| 1 << e).sum())
    };
    mesh.mark_subsegments(bits).unwrap();
    (mesh, subfaces)
}

impl State {
    pub(super) fn new(model: &Model) -> State {
        let mut points = Points::new(model.points.clone());
        let mut segments = Segments::new(&points, model.segments(), &Control::free()).unwrap();
        let surface =
            Patches { triangles: &model.triangles, patch: &model.patch, count: model.patches as usize };
        let (mesh, subfaces) = constrained(&mut points, &mut segments, surface, model.keep_hull);
        let pieces = segments.pieces.iter();
        let pieces =
            pieces.map(|p| Piece { segment: segments.ends[p.segment as usize], ends: p.ends, t: p.t });
        let mut state = State {
            pieces: pieces.collect(),
            triangles: subfaces.verts.clone(),
            patch: subfaces.patch.clone(),
            patches: model.patches as usize,
            keep_hull: model.keep_hull,
            volumes: BTreeMap::new(),
            exact: true,
            insert: Insert::default(),
            points,
            mesh,
        };
        state.volumes = state.region_volumes();
        state.check().unwrap();
        state
    }

    /// Looks at all tetrahedra.
    pub(super) fn locate(&self, p: u32) -> Place {
        let (mesh, points) = (&self.mesh, &self.points);
        for t in mesh.all().filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)) {
            let v = mesh.verts(t);
            let sides = [0, 1, 2, 3].map(|f| {
                let [x, y, z] = mesh.face(4 * t + f);
                points.orient3d(p, x, y, z)
            });
            if sides.contains(&Sign::Negative) {
                continue;
            }
            // The vertices that span what has the point.
            let span: Vec<u32> = (0..4).filter(|&i| sides[i] == Sign::Positive).map(|i| v[i]).collect();
            match span[..] {
                [v] => return Place::At(v),
                [a, b] if mesh.is_subsegment(t, [a, b]) => return Place::Segment([a, b], t),
                [a, b] => {
                    let ring = EdgeRing::new(mesh, t, a, b).map(|(t, _, _, k, _)| 4 * t + k);
                    let walls: Vec<u32> = ring.filter(|&code| mesh.is_wall(code)).collect();
                    return match walls[..] {
                        [] => Place::Inside(t),
                        [x, y] => {
                            // An edge of the hull that is no subsegment.
                            let [u, v, w] = mesh.face(x);
                            let flat =
                                mesh.face(y).iter().all(|&z| points.orient3d(u, v, w, z) == Sign::Zero);
                            if flat {
                                Place::Facet(x)
                            } else {
                                Place::Segment([a, b], t)
                            }
                        }
                        _ => panic!("walls end in an edge that is no subsegment"),
                    };
                }
                [_, _, _] => {
                    let code = 4 * t + (0..4).find(|&f| sides[f as usize] == Sign::Zero).unwrap();
                    return if mesh.is_wall(code) { Place::Facet(code) } else { Place::Inside(t) };
                }
                _ => return Place::Inside(t),
            }
        }
        Place::Outside
    }

    /// The pieces of segments once `p` is in its place.
    fn pieces_with(&self, place: Place, p: u32) -> Vec<Piece> {
        let mut pieces = self.pieces.clone();
        let Place::Segment([a, b], _) = place else { return pieces };
        let Some(i) = pieces.iter().position(|x| edge_key(x.ends[0], x.ends[1]) == edge_key(a, b)) else {
            return pieces;
        };
        let piece = pieces[i];
        let [from, to] = piece.segment.map(|v| *self.points.xyz(v));
        let axis =
            (0..3).max_by(|&x, &y| (to[x] - from[x]).abs().total_cmp(&(to[y] - from[y]).abs())).unwrap();
        let t = (self.points.xyz(p)[axis] - from[axis]) / (to[axis] - from[axis]);
        pieces[i] = Piece { ends: [piece.ends[0], p], t: [piece.t[0], t], ..piece };
        pieces.push(Piece { ends: [p, piece.ends[1]], t: [t, piece.t[1]], ..piece });
        pieces
    }

    /// Inserts the last point; takes it back unless it is in the mesh then. Returns the subsegment in the way.
    pub(super) fn add(&mut self, count: &mut Count) -> Option<[u32; 2]> {
        let p = self.points.len() as u32 - 1;
        let place = self.locate(p);
        let name = if let Place::Facet(code) = place { self.mesh.subface(code) } else { NONE };
        let before = (self.mesh.slots_as_they_are(), self.mesh.free().to_vec());
        let State { mesh, points, insert, .. } = self;
        let control = &Control::free();
        let (kind, outcome) = match place {
            Place::Outside => {
                self.points.truncate(p as usize);
                return None;
            }
            Place::At(v) => (0, insert.interior(mesh, points, p, mesh.vertex_tet[v as usize], control)),
            Place::Inside(t) => (0, insert.interior(mesh, points, p, t, control)),
            Place::Facet(code) => (1, insert.on_facet(mesh, points, p, code, control)),
            Place::Segment(edge, t) => (2, insert.on_segment(mesh, points, p, edge, t, control)),
        };
        let outcome = outcome.unwrap();
        if let Outcome::Blocked(_) | Outcome::Occupied(_) = outcome {
            assert!(before == (self.mesh.slots_as_they_are(), self.mesh.free().to_vec()));
        }
        let pieces = self.pieces_with(place, p);
        match outcome {
            Outcome::Occupied(v) => {
                assert!(matches!(place, Place::At(w) if v == w), "{place:?} {v}");
                count.occupied += 1;
                self.points.truncate(p as usize);
                return None;
            }
            Outcome::Blocked(edge) => {
                assert!(!self.exact || !self.all_are_edges(&pieces), "blocked by {edge:?}");
                if kind == 0 && self.exact && self.is_wrappable() {
                    // Either it ends nowhere, or what it makes is not constrained Delaunay.
                    let wrapped = self.wrap();
                    assert!(!wrapped.is_some_and(|tets| self.is_constrained_delaunay(&tets)), "{edge:?}");
                    count.refuted += 1;
                }
                count.blocked += 1;
                self.points.truncate(p as usize);
                return Some(edge);
            }
            Outcome::Squeezed(edge) => {
                assert!(!self.exact || !self.all_are_edges(&pieces), "squeezed by {edge:?}");
                count.squeezed += 1;
                self.exact = false;
            }
            Outcome::Inserted => {}
        }
        count.inserted[kind] += 1;
        count.implicit[kind] += u32::from(!self.points.is_explicit(p));
        self.pieces = pieces;
        self.split_triangles(place, name, p);
        if let Err(error) = self.check() {
            panic!("{error} after vertex {p}, {place:?}");
        }
        None
    }

    /// Splits the triangles that have the vertex.
    fn split_triangles(&mut self, place: Place, name: u32, p: u32) {
        for i in 0..self.triangles.len() {
            let [a, b, c] = self.triangles[i];
            let points = &self.points;
            let zero: Vec<[u32; 3]> = match place {
                Place::Segment([u, v], _) => {
                    let is = |x: &[u32; 3]| edge_key(x[0], x[1]) == edge_key(u, v);
                    [[a, b, c], [b, c, a], [c, a, b]].into_iter().filter(is).collect()
                }
                Place::Facet(_) if self.patch[i] == name => {
                    let axis = (0..3).find(|&k| points.orient_in_plane(k, a, b, c) != Sign::Zero).unwrap();
                    let turn = points.orient_in_plane(axis, a, b, c);
                    let side = |x: u32, y: u32| points.orient_in_plane(axis, x, y, p);
                    if [(a, b), (b, c), (c, a)].iter().any(|&(x, y)| side(x, y) == -turn) {
                        continue;
                    }
                    let is = |x: &[u32; 3]| side(x[0], x[1]) == Sign::Zero;
                    let on_edge: Vec<_> = [[a, b, c], [b, c, a], [c, a, b]].into_iter().filter(is).collect();
                    if on_edge.is_empty() {
                        self.triangles[i] = [a, b, p];
                        self.triangles.extend([[b, c, p], [c, a, p]]);
                        self.patch.extend([name; 2]);
                    }
                    on_edge
                }
                _ => continue,
            };
            if let [[x, y, z]] = zero[..] {
                self.triangles[i] = [x, p, z];
                self.triangles.push([p, y, z]);
                self.patch.push(self.patch[i]);
            }
        }
    }

    /// Adds a point on a piece, if there is room.
    pub(super) fn split_piece(&mut self, i: usize, fraction: f64, count: &mut Count) -> Option<[u32; 2]> {
        let Piece { segment: [a, b], ends, t } = self.pieces[i];
        let t = t[0] + fraction * (t[1] - t[0]);
        let Ok(p) = self.points.push_on_segment(a, b, &t.into()) else { return None };
        if self.points.dot_sign(p, ends[0], ends[1]) != Sign::Negative {
            self.points.truncate(p as usize);
            return None;
        }
        self.add(count)
    }
}
