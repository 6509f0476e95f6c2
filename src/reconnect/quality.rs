//! The quality of a tetrahedron in plain arithmetic: it orders searches and chooses among valid fillings.

/// The volume over the cube of the mean edge length, up to a factor; not negative.
pub fn quality([o, p, q, r]: [&[f64; 3]; 4]) -> f64 {
    let sub = |a: &[f64; 3], b: &[f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let square = |a: [f64; 3]| a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    let u = [sub(p, o), sub(q, o), sub(r, o)];
    let sum =
        square(sub(p, q)) + square(sub(q, r)) + square(sub(r, p)) + u.iter().map(|&x| square(x)).sum::<f64>();
    let volume = u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1])
        - u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0])
        + u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
    volume.abs() / (sum * sum.sqrt()).max(f64::MIN_POSITIVE)
}
