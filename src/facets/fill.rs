//! Filling one half of a cavity with its constrained Delaunay tetrahedralization.
//!
//! First the Delaunay tetrahedralization of the half's vertices, under the same perturbation: if it has all boundary faces, the tetrahedra
//! inside are the result (Si & Gärtner 2011, section 6). Their lemma 8 does not cover a boundary face whose circumspheres contain a vertex
//! of the half that a facet hides; constrained gift wrapping then decides by visibility.
use crate::control::Control;
use crate::delaunay::Construction;
use crate::error::Error;
use crate::facets::gift_wrap::gift_wrap;
use crate::fallible;
use crate::kernel::face_key;
use crate::kernel::visited::Visited;
use crate::predicates::Points;
use rustc_hash::FxHashMap;

/// The boundary of a polyhedron to fill.
#[derive(Debug, Default)]
pub struct Half {
    /// Triangles `(x, y, z)` such that `(p, x, y, z)` is positive for `p` inside. A triangle with the inside on both sides is listed twice,
    /// once per orientation.
    pub faces: Vec<[u32; 3]>,
    /// All vertices, including inner ones on no face. Repetitions are allowed.
    pub vertices: Vec<u32>,
}

/// Scratch space for filling.
#[derive(Default)]
pub struct Filler {
    local: Construction,
    order: Vec<u32>,
    face_codes: FxHashMap<[u32; 3], u32>,
    inner: Vec<u32>,
    inside: Vec<u32>,
    visited: Visited,
    /// Number of halves that needed gift wrapping.
    pub wrapped: u64,
}

impl Filler {
    /// Appends the tetrahedra of the half to `tets`.
    pub fn fill(
        &mut self,
        points: &Points,
        mut half: Half,
        tets: &mut Vec<[u32; 4]>,
        control: &Control,
    ) -> Result<(), Error> {
        half.vertices.sort_unstable();
        half.vertices.dedup();
        if let ([a, b, c, d], 4) = (&half.vertices[..], half.faces.len()) {
            let apex = [*a, *b, *c, *d].into_iter().find(|v| !half.faces[0].contains(v));
            if let Some(apex) = apex {
                let [x, y, z] = half.faces[0];
                fallible::push(tets, [apex, x, y, z])?;
                return Ok(());
            }
        }
        if self.fill_by_delaunay(points, &half, tets, control)? {
            return Ok(());
        }
        self.wrapped += 1;
        gift_wrap(points, &half, tets, control)
    }

    /// Fills by the Delaunay tetrahedralization of the vertices; returns false and appends nothing if a boundary face is missing from it.
    fn fill_by_delaunay(
        &mut self,
        points: &Points,
        half: &Half,
        tets: &mut Vec<[u32; 4]>,
        control: &Control,
    ) -> Result<bool, Error> {
        self.order.clear();
        fallible::append(&mut self.order, &half.vertices)?;
        self.local.build(points, &mut self.order, control)?;
        self.find_faces(half, control)?;
        if self.inner.len() < half.faces.len() {
            return Ok(false);
        }
        let mesh = &mut self.local.mesh;
        for &code in &self.inner {
            mesh.set_subface(code);
        }
        self.inside.clear();
        self.visited.begin();
        self.inside.try_reserve(self.inner.len())?;
        for &code in &self.inner {
            if self.visited.insert(code >> 2)? {
                fallible::push(&mut self.inside, code >> 2)?;
            }
        }
        let mut next = 0;
        while next < self.inside.len() {
            let t = self.inside[next];
            next += 1;
            control.step()?;
            if mesh.is_ghost(t) {
                return Ok(false);
            }
            for f in 0..4u32 {
                if mesh.is_subface(4 * t + f) {
                    continue;
                }
                let n = mesh.beyond(t, f);
                if self.visited.insert(n)? {
                    fallible::push(&mut self.inside, n)?;
                }
            }
        }
        // The far side of a boundary face is inside only if the face is listed in both orientations.
        self.inner.sort_unstable();
        for &code in &self.inner {
            let other = mesh.across(code);
            if self.visited.contains(other >> 2) && self.inner.binary_search(&other).is_err() {
                return Ok(false);
            }
        }
        fallible::extend(tets, self.inside.iter().map(|&t| mesh.verts(t)))?;
        Ok(true)
    }

    /// Sets `inner` to the corner codes of the half's faces as seen from inside, as far as they exist.
    fn find_faces(&mut self, half: &Half, control: &Control) -> Result<(), Error> {
        self.face_codes.clear();
        self.inner.clear();
        self.inner.try_reserve(half.faces.len())?;
        let mesh = &self.local.mesh;
        for t in 0..mesh.slot_count() as u32 {
            control.step()?;
            if mesh.is_live(t) && !mesh.is_ghost(t) {
                for f in 0..4 {
                    let code = 4 * t + f;
                    fallible::insert(&mut self.face_codes, face_key(mesh.face(code)), code)?;
                }
            }
        }
        for face in &half.faces {
            let Some(&code) = self.face_codes.get(&face_key(*face)) else { return Ok(()) };
            let found = mesh.face(code);
            let same = (0..3).any(|k| found[0] == face[k] && found[1] == face[(k + 1) % 3]);
            fallible::push(&mut self.inner, if same { code } else { mesh.across(code) })?;
        }
        Ok(())
    }
}
