//! Data shared by all checks: the mesh, its exact coordinates, its faces and stars, and the representatives of equal points.
use crate::check::carved::carved_edges;
use crate::check::faces::{FaceTable, Stars};
use crate::check::geometry::Geometry;
use crate::error::Error;
use crate::fallible;
use crate::output::{Guarantee, Subface, Subsegment, TetMesh};
use crate::plc::Plc;
use crate::INVALID;
use std::borrow::Cow;

/// Shared, read-only tables. Built only after the arrays have passed their check.
pub(super) struct Context<'a> {
    pub(super) plc: &'a Plc,
    pub(super) mesh: &'a TetMesh,
    pub(super) geometry: Geometry,
    pub(super) faces: FaceTable,
    pub(super) stars: Stars,
    /// For each input point the first one equal to it.
    pub(super) alias: Vec<u32>,
    /// Whether the input edge and parameter of every added point are known. False for meshes from files with added points: conformity is
    /// then checked only where all corners are input points.
    pub(super) parents_known: bool,
    /// The subfaces of the mesh, then the unmeshed ones.
    pub(super) subfaces: Cow<'a, [Subface]>,
    /// The same for subsegments.
    pub(super) subsegments: Cow<'a, [Subsegment]>,
    /// Edges of carved pieces, in both directions, sorted.
    carved: Vec<[u32; 2]>,
}

impl<'a> Context<'a> {
    pub(super) fn new(plc: &'a Plc, mesh: &'a TetMesh) -> Result<Self, Error> {
        let alias = first_equal(&plc.points)?;
        let mut context = Context {
            geometry: Geometry::new(plc, mesh, &alias)?,
            faces: FaceTable::new(&mesh.tets, mesh.points.len())?,
            stars: Stars::new(&mesh.tets, mesh.points.len())?,
            parents_known: mesh.steiner.len() == mesh.points.len() - plc.points.len(),
            subfaces: joined(&mesh.subfaces, &mesh.unmeshed_subfaces)?,
            subsegments: joined(&mesh.subsegments, &mesh.unmeshed_subsegments)?,
            alias,
            plc,
            mesh,
            carved: Vec::new(),
        };
        if context.parents_known {
            context.carved = carved_edges(&context)?;
        }
        Ok(context)
    }

    /// Whether the mesh was made with weights that are not known.
    pub(super) fn weights_unknown(&self) -> bool {
        self.mesh.guarantee == Guarantee::WeightedDelaunay && self.plc.lift.is_plain()
    }

    /// Whether the tetrahedron replaces one that no doubles made positive: it is then positive in doubles, not at the exact positions.
    pub(super) fn is_replaced(&self, t: u32) -> bool {
        self.mesh.replaced.binary_search(&t).is_ok()
    }

    /// The representative of a vertex: the first input point equal to it, or itself.
    pub(super) fn alias(&self, v: u32) -> u32 {
        self.alias.get(v as usize).copied().unwrap_or(v)
    }

    pub(super) fn is_input(&self, v: u32) -> bool {
        (v as usize) < self.plc.points.len()
    }

    /// Whether `ab` is an edge of the mesh or of a carved piece.
    pub(super) fn has_edge(&self, a: u32, b: u32) -> bool {
        self.stars.has_edge(&self.mesh.tets, a, b) || self.carved.binary_search(&[a, b]).is_ok()
    }

    /// All vertices joined to `a` by such an edge, some repeated.
    pub(super) fn neighbors(&self, a: u32) -> impl Iterator<Item = u32> + '_ {
        let carved = &self.carved[self.carved.partition_point(|e| e[0] < a)..];
        let star = self.stars.of(a).iter().flat_map(|&t| self.mesh.tets[t as usize]);
        star.chain(carved.iter().take_while(move |e| e[0] == a).map(|e| e[1]))
    }

    /// Whether the mesh names the facets of its subfaces. One that lists none says that no face lies on a facet.
    pub(super) fn subfaces_known(&self) -> bool {
        self.parents_known && self.subfaces.iter().all(|face| face.facet != INVALID)
    }

    /// The ends of the input edge that a Steiner point lies on; `None` for a point inside.
    pub(super) fn ends(&self, v: u32) -> Option<[u32; 2]> {
        let steiner = self.mesh.steiner.get((v as usize).checked_sub(self.plc.points.len())?)?;
        steiner.is_on_edge().then(|| steiner.ends.map(|end| self.alias(end)))
    }

    pub(super) fn position(&self, v: u32) -> Option<[f64; 3]> {
        self.mesh.points.get(v as usize).copied()
    }
}

/// Two lists joined; fails if memory runs out.
fn joined<'a, T: Copy>(first: &'a [T], second: &[T]) -> Result<Cow<'a, [T]>, Error> {
    if second.is_empty() {
        return Ok(Cow::Borrowed(first));
    }
    let mut all = fallible::reserved(first.len() + second.len())?;
    fallible::append(&mut all, first)?;
    fallible::append(&mut all, second)?;
    Ok(Cow::Owned(all))
}

/// For each point the first one with equal coordinates (0 and −0 are equal).
fn first_equal(points: &[[f64; 3]]) -> Result<Vec<u32>, Error> {
    let key = |i: u32| points[i as usize].map(|x| (x + 0.0).to_bits());
    let mut order: Vec<u32> = fallible::collect(0..points.len() as u32)?;
    order.sort_unstable_by_key(|&i| (key(i), i));
    let mut alias = fallible::filled(0, points.len())?;
    for run in order.chunk_by(|&i, &j| key(i) == key(j)) {
        for &i in run {
            alias[i as usize] = run[0];
        }
    }
    Ok(alias)
}
