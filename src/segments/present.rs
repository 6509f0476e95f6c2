//! Finds the pieces of segments that are edges of the mesh, and flags them there.
//!
//! At the start this takes one pass over all tetrahedra, which looks up each edge among the pieces at its smaller end: vertices are
//! numbered along a curve, so lookups stay local. Later, when flips of the surface have changed a few segments, the star of a vertex is
//! searched.
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::EdgeRing;
use crate::kernel::edge_key;
use crate::kernel::lookup::Lookup;
use crate::kernel::tables::{EDGE, EDGE_OF};
use crate::kernel::GHOST;
use crate::segments::placement::Subsegment;
use crate::segments::recovery::Recovery;

impl Recovery<'_> {
    /// Flags the mesh edges that are pieces, and returns for each piece whether it is an edge.
    ///
    /// Takes one pass over the mesh: most surfaces have more segments than a tenth of the number of tetrahedra, and only this finds each
    /// piece in constant time.
    pub(super) fn mark_present(&mut self) -> Result<Vec<bool>, Error> {
        let keyed = |(piece, i): (&Subsegment, u32)| {
            let [a, b] = edge_key(piece.ends[0], piece.ends[1]);
            (a, [b], i)
        };
        let pieces = || self.segments.pieces.iter().zip(0..).map(keyed);
        let control = self.control;
        let piece_of = Lookup::new(self.points.len(), pieces, control)?;
        let mut present = fallible::filled(false, self.segments.pieces.len())?;
        self.mesh.mark_subsegments(|v| {
            control.step()?;
            let mut bits = 0;
            for (e, [i, j]) in EDGE.into_iter().enumerate() {
                let [low, high] = edge_key(v[i as usize], v[j as usize]);
                if high == GHOST {
                    continue;
                }
                if let Some(piece) = piece_of.get(low, [high]) {
                    bits |= 1 << e;
                    present[piece as usize] = true;
                }
            }
            Ok(bits)
        })?;
        Ok(present)
    }

    /// Flags an edge in the mesh, if it exists; returns whether it does.
    pub(super) fn mark_edge(&mut self, [a, b]: [u32; 2]) -> Result<bool, Error> {
        let mesh = &mut *self.mesh;
        let found = self.search.find_edge(mesh, a, b, mesh.vertex_tet[a as usize])?;
        self.control.worked(self.search.tets.len());
        let Some(t) = found else { return Ok(false) };
        self.ring.clear();
        for (t, i, j, _, _) in EdgeRing::new(mesh, t, a, b) {
            fallible::push(&mut self.ring, (t, EDGE_OF[i as usize][j as usize]))?;
        }
        for &(t, e) in &self.ring {
            mesh.set_subsegment(t, e);
        }
        Ok(true)
    }
}
