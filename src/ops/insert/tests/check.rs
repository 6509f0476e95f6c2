//! What must hold after every step, and in the end.
use super::state::{constrained, Patches, Piece, State};
use crate::control::Control;
use crate::delaunay::Construction;
use crate::facets::fill::Half;
use crate::facets::gift_wrap::gift_wrap;
use crate::kernel::tables::{EDGE, FACE};
use crate::kernel::{edge_key, face_key, Mesh, GHOST, NONE};
use crate::ops::check::check_domain;
use crate::predicates::Sign;
use crate::segments::recovery::Segments;
use std::collections::{BTreeMap, BTreeSet};

/// All that happened.
#[derive(Debug, Default)]
pub(super) struct Count {
    pub(super) inserted: [u32; 3],
    pub(super) implicit: [u32; 3],
    pub(super) blocked: u32,
    pub(super) refuted: u32,
    pub(super) squeezed: u32,
    pub(super) occupied: u32,
    pub(super) steiner: u32,
    pub(super) compared: u32,
    pub(super) wrapped: u32,
    pub(super) cases: u32,
}

fn flagged(mesh: &Mesh) -> BTreeSet<[u32; 2]> {
    let live = mesh.all().filter(|&t| mesh.is_live(t));
    live.flat_map(|t| mesh.subsegments(t).map(|[a, b]| edge_key(a, b)).collect::<Vec<_>>()).collect()
}

pub(super) fn tetrahedra(mesh: &Mesh) -> BTreeSet<[u32; 4]> {
    let live = mesh.all().filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t));
    live.map(|t| {
        let mut v = mesh.verts(t);
        v.sort_unstable();
        v
    })
    .collect()
}

impl State {
    pub(super) fn region_volumes(&self) -> BTreeMap<u32, f64> {
        let mesh = &self.mesh;
        let mut volumes = BTreeMap::new();
        for t in mesh.all().filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)) {
            let [a, b, c, d] = mesh.verts(t).map(|v| *self.points.xyz(v));
            let [u, v, w] = [b, c, d].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
            let det = u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                + u[2] * (v[0] * w[1] - v[1] * w[0]);
            *volumes.entry(mesh.region(t)).or_insert(0.0) += det;
        }
        volumes
    }

    /// The edges of a patch's triangles with an odd number of them.
    fn boundaries<'a>(
        &self,
        triangles: impl Iterator<Item = ([u32; 3], u32)> + 'a,
    ) -> BTreeSet<(u32, [u32; 2])> {
        let mut odd = BTreeSet::new();
        for ([a, b, c], patch) in triangles {
            for edge in [[a, b], [b, c], [c, a]] {
                let entry = (patch, edge_key(edge[0], edge[1]));
                if !odd.remove(&entry) {
                    odd.insert(entry);
                }
            }
        }
        odd
    }

    pub(super) fn check(&self) -> Result<(), String> {
        let (mesh, points) = (&self.mesh, &self.points);
        check_domain(mesh, points)?;
        for t in mesh.all().filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)) {
            let [a, b, c, d] = mesh.verts(t);
            for code in 4 * t..4 * t + 4 {
                let apex = mesh.apex(mesh.across(code));
                let free = self.exact && apex != GHOST && !mesh.is_subface(code);
                if free && points.insphere_perturbed(a, b, c, d, apex) == Sign::Positive {
                    return Err(format!("face {:?} is not locally Delaunay", mesh.face(code)));
                }
            }
        }
        self.check_subfaces()?;
        let pieces: BTreeSet<_> = self.pieces.iter().map(|p| edge_key(p.ends[0], p.ends[1])).collect();
        let there = flagged(mesh);
        if there != pieces {
            return Err(format!("subsegments {:?}", there.symmetric_difference(&pieces).collect::<Vec<_>>()));
        }
        for t in mesh.all().filter(|&t| mesh.is_live(t)) {
            for [i, j] in EDGE {
                let edge = [mesh.vertex(t, u32::from(i)), mesh.vertex(t, u32::from(j))];
                if pieces.contains(&edge_key(edge[0], edge[1])) != mesh.is_subsegment(t, edge) {
                    return Err(format!("edge {edge:?} of tetrahedron {t} has the wrong flag"));
                }
            }
        }
        if let Some(v) = (0..points.len()).find(|&v| mesh.vertex_tet[v] == NONE) {
            return Err(format!("vertex {v} is lost"));
        }
        for (region, volume) in self.region_volumes() {
            let before = self.volumes.get(&region).copied().unwrap_or(0.0);
            if (volume - before).abs() > 1e-12 * before.max(1.0) && !self.volumes.is_empty() {
                return Err(format!("region {region} had volume {before}, has {volume}"));
            }
        }
        Ok(())
    }

    /// Each patch covers what it did, and its subfaces are locally Delaunay in its plane.
    fn check_subfaces(&self) -> Result<(), String> {
        let (mesh, points) = (&self.mesh, &self.points);
        let there = self.boundaries(mesh.subfaces().map(|code| (mesh.face(code), mesh.subface(code))));
        let wanted = self.boundaries(self.triangles.iter().copied().zip(self.patch.iter().copied()));
        if there != wanted {
            let apart: Vec<_> = there.symmetric_difference(&wanted).collect();
            return Err(format!("the patches have other boundaries: {apart:?}"));
        }
        if mesh.subfaces().count() != self.triangles.len() {
            return Err(format!("{} subfaces, not {}", mesh.subfaces().count(), self.triangles.len()));
        }
        for code in mesh.subfaces() {
            let code = if mesh.is_ghost(code >> 2) { mesh.across(code) } else { code };
            let [a, b, c] = mesh.face(code);
            let axis = (0..3).find(|&k| points.orient_in_plane(k, a, b, c) != Sign::Zero).unwrap();
            let turn = |p, q, r| match points.orient_in_plane(axis, a, b, c) {
                Sign::Positive => points.orient_in_plane(axis, p, q, r),
                _ => -points.orient_in_plane(axis, p, q, r),
            };
            for [x, y, z] in [[a, b, c], [b, c, a], [c, a, b]] {
                if mesh.is_subsegment(code >> 2, [x, y]) {
                    continue;
                }
                let next = mesh.next_wall(code, [x, y]).ok_or("a subface ends")?;
                let d = mesh.face(next).into_iter().find(|&v| v != x && v != y).unwrap();
                let fine = mesh.subface(next) == mesh.subface(code)
                    && points.orient3d(a, b, c, d) == Sign::Zero
                    && turn(y, x, d) == Sign::Positive;
                if !fine {
                    return Err(format!("subface {:?} does not continue {:?}", mesh.face(next), [a, b, c]));
                }
                let inside = match points.orient_in_plane(axis, x, y, z) {
                    Sign::Positive => points.incircle_in_plane(axis, x, y, z, d),
                    _ => points.incircle_in_plane(axis, y, x, z, d),
                };
                if self.exact && inside == Sign::Positive {
                    return Err(format!("edge {:?} is not locally Delaunay in its patch", [x, y]));
                }
            }
        }
        Ok(())
    }

    /// Whether all these are edges of the Delaunay tetrahedralization of all points.
    pub(super) fn all_are_edges(&self, pieces: &[Piece]) -> bool {
        let mesh = Construction::of(&self.points);
        let tets = mesh.all().filter(|&t| mesh.is_live(t)).map(|t| mesh.verts(t));
        let edges: BTreeSet<[u32; 2]> =
            tets.flat_map(|v| EDGE.map(|[i, j]| edge_key(v[i as usize], v[j as usize]))).collect();
        pieces.iter().all(|piece| edges.contains(&edge_key(piece.ends[0], piece.ends[1])))
    }

    /// The same tetrahedra must come out if all is built at once.
    pub(super) fn compare(&self, count: &mut Count) {
        count.cases += 1;
        let there = tetrahedra(&self.mesh);
        if self.all_are_edges(&self.pieces) {
            count.compared += 1;
            let mut points = self.points.copied().unwrap();
            let ends = self.pieces.iter().map(|piece| piece.ends).collect();
            let mut segments = Segments::new(&points, ends, &Control::free()).unwrap();
            let surface = Patches { triangles: &self.triangles, patch: &self.patch, count: self.patches };
            let (at_once, _) = constrained(&mut points, &mut segments, surface, self.keep_hull);
            assert_eq!(points.len(), self.points.len());
            assert_eq!(there, tetrahedra(&at_once));
        }
        if self.is_wrappable() {
            count.wrapped += 1;
            let mut wrapped = self.wrap().unwrap();
            assert!(self.is_constrained_delaunay(&wrapped));
            wrapped.iter_mut().for_each(|v| v.sort_unstable());
            assert_eq!(there, wrapped.into_iter().collect());
        }
    }

    /// Gift wrapping needs no edges of segments on facets, and does not see others.
    pub(super) fn is_wrappable(&self) -> bool {
        let edges = self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let edges: BTreeSet<[u32; 2]> = edges.map(|[x, y]| edge_key(x, y)).collect();
        self.pieces.iter().all(|piece| edges.contains(&edge_key(piece.ends[0], piece.ends[1])))
    }

    fn walls(&self) -> Vec<[u32; 3]> {
        let mesh = &self.mesh;
        let codes =
            mesh.all().filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)).flat_map(|t| 4 * t..4 * t + 4);
        codes.filter(|&code| mesh.is_wall(code)).map(|code| mesh.face(code)).collect()
    }

    /// The tetrahedra of all points between the walls, by gift wrapping.
    pub(super) fn wrap(&self) -> Option<Vec<[u32; 4]>> {
        let half = Half { faces: self.walls(), vertices: (0..self.points.len() as u32).collect() };
        let mut tets = Vec::new();
        gift_wrap(&self.points, &half, &mut tets, &Control::free()).ok().map(|()| tets)
    }

    pub(super) fn is_constrained_delaunay(&self, tets: &[[u32; 4]]) -> bool {
        let walls: BTreeSet<[u32; 3]> = self.walls().into_iter().map(face_key).collect();
        let mut apexes: BTreeMap<[u32; 3], Vec<u32>> = BTreeMap::new();
        let faces = |v: [u32; 4]| FACE.map(|face| face_key(face.map(|k| v[k as usize])));
        for &v in tets {
            faces(v).into_iter().zip(v).for_each(|(face, apex)| apexes.entry(face).or_default().push(apex));
        }
        let inside =
            |[a, b, c, d]: [u32; 4], e| self.points.insphere_perturbed(a, b, c, d, e) == Sign::Positive;
        tets.iter().all(|&v| {
            let mut free = faces(v).into_iter().filter(|face| !walls.contains(face));
            self.points.orient3d(v[0], v[1], v[2], v[3]) == Sign::Positive
                && free.all(|face| {
                    apexes[&face].len() == 2 && apexes[&face].iter().all(|&e| v.contains(&e) || !inside(v, e))
                })
        })
    }
}
