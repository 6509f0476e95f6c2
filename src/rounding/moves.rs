//! Moves of single points that lower the number of tetrahedra that are not positive in their stars.
use crate::error::Error;
use crate::fallible;
use crate::predicates::{orient3d, Expansion, Sign};
use crate::rounding::candidates::{lattice, Candidate};
use crate::rounding::wedge::{escape, Plane, MOST};
use crate::rounding::{is_kept, is_positive, surviving, work, Repair};

impl Repair<'_> {
    /// Tries to make a tetrahedron positive by moving one of its implicit vertices; with `far`, also by more than a few units in the
    /// last place.
    pub(super) fn mend(&mut self, t: u32, far: bool) -> Result<(), Error> {
        if is_positive(self.mesh, self.points, self.xyz, t) {
            return Ok(());
        }
        let verts = self.mesh.verts(t);
        for stage in 0..3 + i32::from(far) {
            for v in verts {
                if self.points.is_explicit(v) {
                    continue;
                }
                let start = self.mesh.vertex_tet[v as usize];
                self.search.vertex_star(self.mesh, v, start)?;
                let moved = match stage {
                    0 => self.try_exact(v)?,
                    1 => self.try_lattice(v)?,
                    2 => self.try_parameters(v)?,
                    _ => self.try_wedge(v)?,
                };
                if self.work.is_done() && !moved {
                    return Ok(());
                }
                if moved {
                    fallible::append(&mut self.touched, &self.search.tets)?;
                }
                if moved && is_positive(self.mesh, self.points, self.xyz, t) {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// How many kept tetrahedra of the star are not positive with `v` at `at`, counting no further than `limit`.
    fn bad_in_star(&self, v: u32, at: [f64; 3], limit: usize) -> usize {
        let mesh = &self.mesh;
        let mut count = 0;
        let mut tests = 1;
        for &t in &self.search.tets {
            if count >= limit {
                break;
            }
            if !is_kept(self.mesh, t) {
                continue;
            }
            let [a, b, c, d] = mesh.verts(t).map(|w| if w == v { at } else { self.xyz[w as usize] });
            count += (orient3d(&a, &b, &c, &d) != Sign::Positive) as usize;
            tests += 1;
        }
        self.work.spend(tests);
        count
    }

    /// Moves `v` in doubles only, to the nearest lattice point that is better.
    fn try_lattice(&mut self, v: u32) -> Result<bool, Error> {
        let bad = self.bad_in_star(v, self.xyz[v as usize], usize::MAX);
        let mut best = (bad, self.xyz[v as usize]);
        for step in lattice() {
            if self.work.is_done() {
                break;
            }
            let Some(at) = self.step_from(v, step) else { continue };
            let count = self.bad_in_star(v, at, best.0);
            if count < best.0 {
                best = (count, at);
                if count == 0 {
                    break;
                }
            }
        }
        if best.0 < bad {
            self.xyz[v as usize] = best.1;
            self.note_move(v)?;
        }
        Ok(best.0 < bad)
    }

    /// Moves `v` in doubles only, into the wedge between the planes of the faces of its link that it is closest to.
    fn try_wedge(&mut self, v: u32) -> Result<bool, Error> {
        let old = self.xyz[v as usize];
        let bad = self.bad_in_star(v, old, usize::MAX);
        let unit = old.iter().fold(0.0f64, |m, x| m.max(x.abs())) * f64::EPSILON;
        let planes = self.planes(v, 1024.0 * unit)?;
        for power in 0..10 {
            let Some(d) = escape(&planes, unit * f64::from(1u32 << power)) else { continue };
            let at: [f64; 3] = std::array::from_fn(|k| surviving(old[k] + d[k], self.scale_exponent));
            if self.bad_in_star(v, at, bad) < bad {
                self.xyz[v as usize] = at;
                self.note_move(v)?;
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Planes of the link's faces nearer to `v` than `reach`, nearest first.
    pub(super) fn planes(&self, v: u32, reach: f64) -> Result<Vec<Plane>, Error> {
        let mesh = &self.mesh;
        let p = self.xyz[v as usize];
        let mut planes = Vec::new();
        for &t in self.search.tets.iter().filter(|&&t| is_kept(self.mesh, t)) {
            let Some(slot) = mesh.slot_of(t, v) else { continue };
            let [a, b, c] = mesh.face(4 * t + slot).map(|w| {
                let q = self.xyz[w as usize];
                [q[0] - p[0], q[1] - p[1], q[2] - p[2]]
            });
            // (v, a, b, c) is positive where det(a, b, c) > 0; that grows when v moves against (b − a) × (c − a).
            let (u, w) = ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
            let n = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
            let size = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
            let height = (a[0] * n[0] + a[1] * n[1] + a[2] * n[2]) / size;
            if height.abs() < reach {
                fallible::push(&mut planes, Plane { normal: n.map(|x| -x / size), height })?;
            }
        }
        fallible::stable_sort_by(&mut planes, |x, y| x.height.total_cmp(&y.height))?;
        planes.truncate(MOST);
        Ok(planes)
    }

    /// The nearest double of `v`, some units in the last place away, if the caller's scale can hold it.
    fn step_from(&self, v: u32, step: [i8; 3]) -> Option<[f64; 3]> {
        let p = self.points.xyz(v);
        let at: [f64; 3] = std::array::from_fn(|k| {
            let mut x = p[k];
            for _ in 0..step[k].unsigned_abs() {
                x = if step[k] < 0 { x.next_down() } else { x.next_up() };
            }
            x
        });
        let survives = |x: f64| surviving(x, self.scale_exponent) == x;
        at.iter().all(|&x| survives(x)).then_some(at)
    }

    /// Moves `v` along its segment to where it is an exact double.
    fn try_exact(&mut self, v: u32) -> Result<bool, Error> {
        if self.exact.is_some() {
            return Ok(false);
        }
        let Some(candidate) = Candidate::of(self.points, self.segments, v) else { return Ok(false) };
        for t in candidate.exact_parameters(self.points)? {
            if self.try_parameter(v, &candidate, t)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Moves `v` along its segment to where its rounding is better.
    fn try_parameters(&mut self, v: u32) -> Result<bool, Error> {
        if self.exact.is_some() {
            return Ok(false);
        }
        let Some(candidate) = Candidate::of(self.points, self.segments, v) else { return Ok(false) };
        for t in candidate.nearby_parameters()? {
            if self.work.is_done() {
                break;
            }
            if self.try_parameter(v, &candidate, t)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Moves `v` to parameter `t` if the exact mesh stays valid and the rounded one gets better.
    fn try_parameter(&mut self, v: u32, candidate: &Candidate, t: f64) -> Result<bool, Error> {
        let old = self.xyz[v as usize];
        let bad = self.bad_in_star(v, old, usize::MAX);
        self.work.spend(work::MOVE);
        self.points.move_on_segment(v, candidate.ends, &Expansion::from(t))?;
        let at = self.points.xyz(v).map(|x| surviving(x, self.scale_exponent));
        if self.bad_in_star(v, at, bad) < bad && self.star_is_valid() {
            self.xyz[v as usize] = at;
            self.segments.move_steiner(v, t);
            self.note_move(v)?;
            return Ok(true);
        }
        self.points.move_on_segment(v, candidate.ends, &Expansion::from(candidate.t))?;
        Ok(false)
    }

    /// The star of `v` is positive and constrained Delaunay in exact positions.
    pub(super) fn star_is_valid(&self) -> bool {
        let mesh = &self.mesh;
        self.search.tets.iter().all(|&t| {
            if mesh.is_ghost(t) {
                return true;
            }
            self.work.spend(work::EXACT_TET);
            let [a, b, c, d] = mesh.verts(t);
            if self.points.orient3d(a, b, c, d) != Sign::Positive {
                return false;
            }
            (0..4u32).all(|f| {
                let other = mesh.across(4 * t + f);
                mesh.is_subface(4 * t + f)
                    || mesh.is_ghost(other >> 2)
                    || self.points.insphere(a, b, c, d, mesh.apex(other)) != Sign::Positive
            })
        })
    }
}
