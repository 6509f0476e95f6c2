//! A background mesh: a mesh with a size at each of its points, wanted where another mesh is made. In each tetrahedron it is linear.
use crate::error::{Error, Status};
use crate::fallible;
use crate::options::SizeFunction;
use crate::query::Locator;
use crate::{TetMesh, INVALID};
use std::sync::atomic::{AtomicU32, Ordering};

/// From here on a size is no wish: what follows from several must not overflow.
const LARGEST: f64 = 1e300;

/// A background mesh.
#[derive(Debug)]
pub(crate) struct Background {
    /// Points and tetrahedra alone.
    mesh: TetMesh,
    sizes: Vec<f64>,
    locator: Locator,
    /// Where the last point was. A hint, which changes no result: threads may overwrite it.
    last: AtomicU32,
}

impl Background {
    /// Copies what is needed of a mesh and of the sizes at its points.
    ///
    /// # Errors
    /// As [`SizeFunction::of_mesh`].
    pub fn new(mesh: &TetMesh, sizes: &[f64]) -> Result<Background, Error> {
        let refuse = |status, what: std::fmt::Arguments| Err(Error::new(status, what));
        let (given, count) = (sizes.len(), mesh.points.len());
        if given != count {
            return refuse(
                Status::InvalidArgument,
                format_args!("{given} sizes for {count} points of the background mesh: one each is needed"),
            );
        }
        if let Some((i, size)) = sizes.iter().enumerate().find(|x| x.1.is_nan() || *x.1 <= 0.0) {
            return refuse(
                Status::InvalidArgument,
                format_args!("the size {size} of point {i} of the background mesh is not positive"),
            );
        }
        // Only callers can have made such meshes.
        if let Some(i) = mesh.points.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            return refuse(
                Status::NonFinitePoint,
                format_args!("point {i} of the background mesh is not finite"),
            );
        }
        if let Some(t) = mesh.tets.iter().position(|v| !v.iter().all(|&v| (v as usize) < count)) {
            return refuse(
                Status::IndexOutOfRange,
                format_args!("tetrahedron {t} of the background mesh has a corner that is no point"),
            );
        }
        let (points, tets) = (fallible::copied(&mesh.points)?, fallible::copied(&mesh.tets)?);
        let mesh = TetMesh { points, tets, ..TetMesh::default() };
        let locator = Locator::new(&mesh)?;
        Ok(Background { mesh, sizes: fallible::copied(sizes)?, locator, last: AtomicU32::new(INVALID) })
    }

    /// The sizes at the points.
    pub fn sizes(&self) -> &[f64] {
        &self.sizes
    }

    /// The size wanted at a place; infinite outside.
    pub fn at(&self, point: [f64; 3]) -> f64 {
        let last = self.last.load(Ordering::Relaxed);
        let Some((tet, weights)) = self.locator.locate_one(&self.mesh, &point, last) else {
            return f64::INFINITY;
        };
        self.last.store(tet, Ordering::Relaxed);
        let (mut sum, mut least) = (0.0, f64::INFINITY);
        for (v, weight) in self.mesh.tets[tet as usize].into_iter().zip(weights) {
            let size = self.sizes[v as usize];
            if weight > 0.0 {
                if size > LARGEST {
                    return f64::INFINITY;
                }
                sum += weight * size;
                least = least.min(size);
            }
        }
        // Small ones may vanish in products.
        sum.max(least)
    }
}

impl SizeFunction {
    /// The sizes at the points of a mesh, linear in each of its tetrahedra; outside of the mesh there is no wish. A size is positive; an infinite
    /// one is no wish in all tetrahedra with this point. What is needed is copied. Of several functions the smaller counts in
    /// `SizeFunction::new(move |p| Ok(a.at(p)?.min(b.at(p)?)))`.
    ///
    /// # Errors
    /// [`Status::InvalidArgument`]: another number of sizes than of points, or a size that is NaN or not positive, with the point.
    /// [`Status::NonFinitePoint`], [`Status::IndexOutOfRange`], [`Status::OutOfMemory`].
    pub fn of_mesh(mesh: &TetMesh, sizes: &[f64]) -> Result<SizeFunction, Error> {
        let background = Background::new(mesh, sizes)?;
        Ok(SizeFunction::new(move |point| Ok(background.at(point))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::{Mode, Options};
    use crate::progress::Silent;
    use crate::refine::tests::cuboid;
    use crate::size::distance;
    use crate::{check_guarantee, tetrahedralize, Plc};

    fn block(low: [f64; 3], high: [f64; 3], options: &Options) -> (Plc, TetMesh) {
        let mut plc = Plc::default();
        cuboid(&mut plc, low, high);
        let mesh = tetrahedralize(&plc, options, &mut Silent).unwrap();
        (plc, mesh)
    }

    fn linear([x, y, z]: [f64; 3]) -> f64 {
        0.3 + 0.05 * x + 0.01 * y - 0.02 * z
    }

    fn background() -> TetMesh {
        let options = Options { size: Some(1.0), ..Options::default() };
        block([-1.0; 3], [9.0, 3.0, 3.0], &options).1
    }

    #[test]
    fn a_linear_field_is_found_everywhere_in_the_mesh() {
        let mesh = background();
        let sizes: Vec<f64> = mesh.points.iter().map(|&p| linear(p)).collect();
        let function = SizeFunction::of_mesh(&mesh, &sizes).unwrap();
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        for _ in 0..2000 {
            let p = [9.99 * next() - 1.0, 3.99 * next() - 1.0, 3.99 * next() - 1.0];
            assert!((function.at(p).unwrap() - linear(p)).abs() < 1e-13, "{p:?}");
        }
        for (&p, &size) in mesh.points.iter().zip(&sizes) {
            assert_eq!(function.at(p).unwrap(), size);
        }
        for p in [[-1.1, 0.0, 0.0], [0.0, 3.1, 0.0], [1e300, 0.0, 0.0], [4.0, 1.0, 3.0f64.next_up()]] {
            assert_eq!(function.at(p).unwrap(), f64::INFINITY);
        }
    }

    #[test]
    fn a_filled_mesh_follows_the_sizes() {
        let mesh = background();
        let sizes: Vec<f64> = mesh.points.iter().map(|&p| linear(p)).collect();
        for mode in [Mode::Constrained, Mode::Preserve] {
            let function = SizeFunction::of_mesh(&mesh, &sizes).unwrap();
            // In mode preserve the surface must be about as fine.
            let fine = Options { size: Some(0.5), ..Options::default() };
            let (mut plc, surface) = block([0.0; 3], [8.0, 2.0, 2.0], &fine);
            if mode == Mode::Preserve {
                let triangles = surface.subfaces.iter().map(|face| face.corners).collect();
                plc = Plc { points: surface.points.clone(), triangles, ..Plc::default() };
                plc.points.truncate(1 + *plc.triangles.iter().flatten().max().unwrap() as usize);
            }
            let options = Options { mode, size_function: Some(function), ..Options::default() };
            let made = tetrahedralize(&plc, &options, &mut Silent).unwrap();
            check_guarantee(&plc, &made, 10).unwrap();
            // The mean of edges over the size wanted, in four slices.
            let mut slices = [(0.0, 0.0); 4];
            for t in &made.tets {
                for i in 0..4 {
                    for j in 0..i {
                        let [p, q] = [t[i], t[j]].map(|v| &made.points[v as usize]);
                        let middle = [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
                        let (sum, count) = &mut slices[(middle[0] / 2.0).min(3.0) as usize];
                        *sum += distance(p, q) / linear(middle);
                        *count += 1.0;
                    }
                }
            }
            let means = slices.map(|(sum, count)| sum / count);
            assert!(means.iter().all(|&mean| mean > 0.75 && mean < 1.35), "{mode:?} {means:?}");
            let [least, most] = [f64::min, f64::max].map(|of| means.into_iter().reduce(of).unwrap());
            // The sizes themselves grow by a factor of two.
            assert!(mode == Mode::Preserve || most < 1.2 * least, "{mode:?} {means:?}");
        }
    }

    #[test]
    fn sizes_that_are_none_are_refused_with_the_point() {
        let mesh = background();
        let count = mesh.points.len();
        let refused = |sizes: Vec<f64>| {
            let error = SizeFunction::of_mesh(&mesh, &sizes).unwrap_err();
            assert_eq!(error.status, Status::InvalidArgument);
            error.message.to_string()
        };
        for size in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            let mut sizes = vec![1.0; count];
            sizes[7] = size;
            assert!(refused(sizes).contains("of point 7 of the background mesh"));
        }
        assert!(refused(vec![1.0; count - 1]).contains("one each is needed"));
        let status = |mesh: &TetMesh| {
            SizeFunction::of_mesh(mesh, &vec![1.0; mesh.points.len()]).map(|_| ()).unwrap_err().status
        };
        let mut broken = mesh.clone();
        broken.tets[3][1] = count as u32;
        assert_eq!(status(&broken), Status::IndexOutOfRange);
        broken = mesh.clone();
        broken.points[2][1] = f64::NAN;
        assert_eq!(status(&broken), Status::NonFinitePoint);
    }

    #[test]
    fn infinite_sizes_are_no_wish_in_their_tetrahedra() {
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mesh = TetMesh { points, tets: vec![[0, 1, 2, 3]], ..TetMesh::default() };
        let at = |sizes: &[f64], p: [f64; 3]| SizeFunction::of_mesh(&mesh, sizes).unwrap().at(p).unwrap();
        assert_eq!(at(&[1.0, 2.0, 3.0, f64::INFINITY], [0.5, 0.5, 0.0]), 2.5);
        assert_eq!(at(&[1.0, 2.0, 3.0, f64::INFINITY], [0.25, 0.25, 0.25]), f64::INFINITY);
        assert_eq!(at(&[f64::MAX; 4], [0.25, 0.25, 0.25]), f64::INFINITY);
        // The smallest sizes there are do not vanish.
        assert_eq!(at(&[f64::from_bits(1); 4], [0.25, 0.25, 0.25]), f64::from_bits(1));
        let flat = TetMesh {
            points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]],
            ..mesh.clone()
        };
        let function = SizeFunction::of_mesh(&flat, &[2.0; 4]).unwrap();
        assert_eq!(function.at([0.5, 0.5, 0.0]).unwrap(), 2.0);
    }
}
