//! Random small piecewise linear complexes.
use crate::kernel::edge_key;

pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self, count: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (((self.0 >> 32) * u64::from(count)) >> 32) as u32
    }

    pub(super) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Corners of boxes are on a grid of this size.
pub(super) const SIZE: u32 = 4;

/// A piecewise linear complex.
#[derive(Default)]
pub(super) struct Model {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) patch: Vec<u32>,
    pub(super) patches: u32,
    /// Segments on no facet.
    pub(super) isolated: Vec<[u32; 2]>,
    pub(super) keep_hull: bool,
}

impl Model {
    fn point(&mut self, p: [f64; 3]) -> u32 {
        let known = self.points.iter().position(|q| *q == p);
        known.unwrap_or_else(|| {
            self.points.push(p);
            self.points.len() - 1
        }) as u32
    }

    pub(super) fn facet(&mut self, polygon: &[[f64; 3]]) {
        let v: Vec<u32> = polygon.iter().map(|&p| self.point(p)).collect();
        for k in 1..v.len() - 1 {
            self.triangles.push([v[0], v[k], v[k + 1]]);
            self.patch.push(self.patches);
        }
        self.patches += 1;
    }

    /// The six sides of a box, each divided in two at `wall` if it crosses that plane normal to x.
    pub(super) fn cuboid(&mut self, low: [f64; 3], high: [f64; 3], wall: Option<f64>) {
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for side in [low[axis], high[axis]] {
                let corner = |i: usize, j: usize, x: [f64; 2]| {
                    let mut p = [side; 3];
                    p[u] = [low[u], high[u]][i];
                    p[v] = [low[v], high[v]][j];
                    p[0] = if axis == 0 { side } else { x[usize::from(p[0] != low[0])] };
                    p
                };
                let cuts = match wall {
                    Some(wall) if axis != 0 => vec![[low[0], wall], [wall, high[0]]],
                    _ => vec![[low[0], high[0]]],
                };
                for x in cuts {
                    self.facet(&[(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| corner(i, j, x)));
                }
            }
        }
    }

    pub(super) fn segments(&self) -> Vec<[u32; 2]> {
        let mut uses: Vec<([u32; 2], u32)> = Vec::new();
        for (&[a, b, c], &patch) in self.triangles.iter().zip(&self.patch) {
            uses.extend([(a, b), (b, c), (c, a)].map(|(x, y)| (edge_key(x, y), patch)));
        }
        uses.sort_unstable();
        let on_facets = uses
            .chunk_by(|x, y| x.0 == y.0)
            .filter(|group| group.len() != 2 || group[0].1 != group[1].1)
            .map(|group| group[0].0);
        let mut all: Vec<[u32; 2]> = on_facets.chain(self.isolated.iter().copied()).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// One of the models that the test is about; `grid` are coordinates of the grid's planes.
    pub(super) fn random(random: &mut Random, grid: &[[f64; SIZE as usize + 1]; 3]) -> Model {
        let at = |p: [u32; 3]| [0, 1, 2].map(|k| grid[k][p[k] as usize]);
        let mut model = Model::default();
        let (low, high) = (at([0; 3]), at([SIZE; 3]));
        let kind = random.next(7);
        match kind {
            // A box with an inner wall: coplanar patches, subsegments with three facets.
            0 => {
                let x = grid[0][1 + random.next(3) as usize];
                model.cuboid(low, high, Some(x));
                model.facet(
                    &[[0, 0], [0, 1], [1, 1], [1, 0]]
                        .map(|[j, k]| [x, [low[1], high[1]][j], [low[2], high[2]][k]]),
                );
            }
            // A box in a box.
            1 => {
                model.cuboid(low, high, None);
                let from = [0; 3].map(|_| 1 + random.next(2));
                let to = [0, 1, 2].map(|k| from[k] + 1 + random.next(3 - from[k]));
                model.cuboid(at(from), at(to), None);
            }
            // A dangling facet.
            2 => {
                model.cuboid(low, high, None);
                let z = 1 + random.next(3);
                let corners = [[1, 1], [3, 1], [3, 3], [1, 3]].map(|[x, y]| at([x, y, z]));
                model.facet(&corners[..3 + random.next(2) as usize]);
            }
            // A fan of facets round a segment, at small angles.
            3 => {
                model.cuboid(low, high, None);
                let (a, b) = (at([1, 2, 1]), at([1, 2, 3]));
                let step = 0.5f64.powi(2 + random.next(9) as i32) * (grid[1][3] - grid[1][2]);
                for k in 0..2 + random.next(4) {
                    model.facet(&[a, b, [grid[0][3], grid[1][2] + f64::from(k) * step, grid[2][2]]]);
                }
            }
            // Isolated segments: in layers, so that they do not cross.
            4 => {
                model.cuboid(low, high, None);
                for z in 1..SIZE {
                    let [a, b] = [0; 2].map(|_| at([1 + random.next(3), 1 + random.next(3), z]));
                    if a != b {
                        let edge = [a, b].map(|p| model.point(p));
                        model.isolated.push(edge);
                    }
                }
            }
            // Slanted facets that meet in one edge, in the hull of their points or in a box.
            5 => {
                model.keep_hull = random.next(2) == 0;
                if !model.keep_hull {
                    model.cuboid(low, high, None);
                }
                let (a, b) = (at([1, 1, 1]), at([3, 3, 2]));
                model.facet(&[a, b, at([3, 1, 3])]);
                model.facet(&[a, b, at([1, 3, 1])]);
                model.facet(&[a, b, at([1, 3, 3])]);
            }
            // Nothing but points, a segment and a facet: the hull is a wall without subfaces.
            _ => {
                model.keep_hull = true;
                for i in 0..8 {
                    model.point(at([0, 1, 2].map(|k| SIZE * (i >> k & 1))));
                }
                model.facet(&[at([1, 1, 1]), at([3, 1, 1]), at([1, 3, 1])]);
                let edge = [at([1, 1, 2]), at([3, 3, 3])].map(|p| model.point(p));
                model.isolated.push(edge);
            }
        }
        if random.next(2) == 0 {
            model.crowd(random, low, high);
        }
        model
    }

    /// Adds vertices close to segments, so that these need Steiner points.
    fn crowd(&mut self, random: &mut Random, low: [f64; 3], high: [f64; 3]) {
        let segments = self.segments();
        for _ in 0..1 + random.next(6) {
            let [a, b] =
                segments[random.next(segments.len() as u32) as usize].map(|v| self.points[v as usize]);
            let (t, far) = (random.unit(), 0.5f64.powi(random.next(8) as i32));
            self.points.push([0, 1, 2].map(|k| {
                let x = a[k] + t * (b[k] - a[k]) + far * (random.unit() - 0.5);
                x.clamp(low[k] + 0.015625 * random.unit(), high[k] - 0.015625 * random.unit())
            }));
        }
    }
}

/// A number in one coordinate's range: often on the grid or between its planes, so that much is coplanar and cospherical.
pub(super) fn coordinate(random: &mut Random, grid: &[f64; SIZE as usize + 1]) -> f64 {
    let k = random.next(SIZE) as usize;
    let fraction = [0.0, 0.5, 0.25, random.unit()][random.next(4) as usize];
    grid[k] + fraction * (grid[k + 1] - grid[k])
}
