//! Index tables of a tetrahedron. Faces are opposite the vertex of the same number; edges are 01 02 03 12 13 23.

/// `FACE[i]`: the vertices of face `i`, ordered so that `(i, FACE[i])` is an even permutation of `(0, 1, 2, 3)`: seen from the opposite
/// vertex the face turns the same way for every `i`.
pub const FACE: [[u8; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// `EDGE[e]`: the two vertices of edge `e`.
pub const EDGE: [[u8; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// `EDGE_OF[i][j]`: the number of the edge between vertices `i` and `j` (0 on the diagonal, where there is none).
pub const EDGE_OF: [[u8; 4]; 4] = [[0, 0, 1, 2], [0, 0, 3, 4], [1, 3, 0, 5], [2, 4, 5, 0]];

/// `OTHERS[i][j]`: for `i != j` the two remaining vertices `k`, `l`, such that `(i, j, k, l)` is an even permutation.
pub const OTHERS: [[[u8; 2]; 4]; 4] = [
    [[0, 0], [2, 3], [3, 1], [1, 2]],
    [[3, 2], [0, 0], [0, 3], [2, 0]],
    [[1, 3], [3, 0], [0, 0], [0, 1]],
    [[2, 1], [0, 2], [1, 0], [0, 0]],
];

#[cfg(test)]
mod tests {
    use super::*;

    fn even(p: [u8; 4]) -> bool {
        let mut inversions = 0;
        for i in 0..4 {
            for j in i + 1..4 {
                inversions += (p[i] > p[j]) as u32;
            }
        }
        inversions % 2 == 0
    }

    #[test]
    fn tables_are_even_permutations() {
        for i in 0..4u8 {
            let f = FACE[i as usize];
            assert!(even([i, f[0], f[1], f[2]]));
            for j in 0..4u8 {
                if i != j {
                    let o = OTHERS[i as usize][j as usize];
                    assert!(even([i, j, o[0], o[1]]), "{i} {j}");
                    let e = EDGE[EDGE_OF[i as usize][j as usize] as usize];
                    assert_eq!([e[0], e[1]], [i.min(j), i.max(j)]);
                }
            }
        }
    }
}
