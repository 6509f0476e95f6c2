//! All faces of all tetrahedra, by their corners; and the star of every vertex.
//!
//! Counting sort by the smallest corner, then small sorts: linear in practice, no hashing, no order that depends on
//! anything but the mesh.
use crate::error::Error;
use crate::fallible;

/// Corners of face `i` (opposite vertex `i`), ordered so that the tetrahedron (face, vertex `i`) is positive if the whole one is.
pub(super) const FACE: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// One face of one tetrahedron.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    /// The corners except the smallest, which is the bucket's number, in ascending order.
    rest: [u32; 2],
    /// `4 * tet + face`.
    pub(super) handle: u32,
}

/// Faces sorted by corners. Invariant: `offsets[v]..offsets[v + 1]` are the faces with smallest corner `v`.
pub(super) struct FaceTable {
    offsets: Vec<u32>,
    entries: Vec<Entry>,
}

/// Three indices in ascending order, and whether sorting took an odd permutation.
pub(super) fn sorted(mut c: [u32; 3]) -> ([u32; 3], bool) {
    let mut odd = false;
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        if c[i] > c[j] {
            c.swap(i, j);
            odd = !odd;
        }
    }
    (c, odd)
}

/// The corners of a face, with the tetrahedron's fourth vertex on the positive side.
pub(super) fn face_corners(tet: [u32; 4], face: usize) -> [u32; 3] {
    FACE[face].map(|k| tet[k])
}

impl FaceTable {
    /// The faces of `tets`, whose corners are less than `points`.
    pub(super) fn new(tets: &[[u32; 4]], points: usize) -> Result<Self, Error> {
        let mut offsets = fallible::filled(0u32, points + 2)?;
        let key = |tet: &[u32; 4], face: usize| sorted(face_corners(*tet, face)).0;
        for tet in tets {
            for face in 0..4 {
                offsets[key(tet, face)[0] as usize + 2] += 1;
            }
        }
        for v in 2..points + 2 {
            offsets[v] += offsets[v - 1];
        }
        let mut entries = fallible::filled(Entry { rest: [0; 2], handle: 0 }, 4 * tets.len())?;
        for (t, tet) in tets.iter().enumerate() {
            for face in 0..4 {
                let [a, b, c] = key(tet, face);
                let slot = &mut offsets[a as usize + 1];
                entries[*slot as usize] = Entry { rest: [b, c], handle: (4 * t + face) as u32 };
                *slot += 1;
            }
        }
        offsets.pop();
        for v in 0..points {
            entries[offsets[v] as usize..offsets[v + 1] as usize]
                .sort_unstable_by_key(|e| (e.rest, e.handle));
        }
        Ok(FaceTable { offsets, entries })
    }

    /// Runs of equal faces: the ascending corners and the entries with them.
    pub(super) fn runs(&self) -> impl Iterator<Item = ([u32; 3], &[Entry])> {
        (0..self.offsets.len().saturating_sub(1)).flat_map(move |v| {
            let bucket = &self.entries[self.offsets[v] as usize..self.offsets[v + 1] as usize];
            bucket
                .chunk_by(|a, b| a.rest == b.rest)
                .map(move |run| ([v as u32, run[0].rest[0], run[0].rest[1]], run))
        })
    }

    /// The faces with these corners, in any order.
    pub(super) fn find(&self, corners: [u32; 3]) -> &[Entry] {
        let ([a, b, c], _) = sorted(corners);
        let bucket = match (self.offsets.get(a as usize), self.offsets.get(a as usize + 1)) {
            (Some(&from), Some(&to)) => &self.entries[from as usize..to as usize],
            _ => return &[],
        };
        let from = bucket.partition_point(|e| e.rest < [b, c]);
        let to = bucket.partition_point(|e| e.rest <= [b, c]);
        &bucket[from..to]
    }
}

/// The tetrahedra at each vertex.
pub(super) struct Stars {
    offsets: Vec<u32>,
    tets: Vec<u32>,
}

impl Stars {
    /// The stars of vertices less than `points`.
    pub(super) fn new(tets: &[[u32; 4]], points: usize) -> Result<Self, Error> {
        let mut offsets = fallible::filled(0u32, points + 2)?;
        for &v in tets.iter().flatten() {
            offsets[v as usize + 2] += 1;
        }
        for v in 2..points + 2 {
            offsets[v] += offsets[v - 1];
        }
        let mut list = fallible::filled(0u32, 4 * tets.len())?;
        for (t, tet) in tets.iter().enumerate() {
            for &v in tet {
                let slot = &mut offsets[v as usize + 1];
                list[*slot as usize] = t as u32;
                *slot += 1;
            }
        }
        offsets.pop();
        Ok(Stars { offsets, tets: list })
    }

    /// The tetrahedra at `v`.
    pub(super) fn of(&self, v: u32) -> &[u32] {
        &self.tets[self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize]
    }

    /// Whether `v` is a vertex of the mesh.
    pub(super) fn used(&self, v: u32) -> bool {
        !self.of(v).is_empty()
    }

    /// Whether `ab` is an edge of the mesh; searches the smaller star.
    pub(super) fn has_edge(&self, tets: &[[u32; 4]], a: u32, b: u32) -> bool {
        let (from, to) = if self.of(a).len() <= self.of(b).len() { (a, b) } else { (b, a) };
        a != b && self.of(from).iter().any(|&t| tets[t as usize].contains(&to))
    }
}
