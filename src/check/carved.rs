//! Pieces outside the mesh: pieces of segments and facets on no tetrahedron because everything around them was carved.
//!
//! They are listed separately from the others (together, they tile their facets), since they are not faces and edges of the mesh. Whether a
//! piece is outside is tested where it begins: pieces of a valid PLC do not cross the facets that bound the mesh, so a piece that starts
//! outside is entirely outside. This holds at a corner that is no vertex of the mesh (the point check covers that corner).
use crate::check::context::Context;
use crate::error::Error;
use crate::fallible;
use crate::output::Subface;
use crate::predicates::Sign;
use crate::INVALID;

/// Whether the open edge `ab`, which is no edge of the mesh, starts outside all closed tetrahedra at `a`.
pub(super) fn edge_outside(context: &Context, a: u32, b: u32) -> bool {
    if a == b || !context.stars.used(a) || !context.stars.used(b) {
        return a != b;
    }
    let tets = &context.mesh.tets;
    context.stars.of(a).iter().all(|&t| !cone_holds(context, cone_at(tets[t as usize], a), b))
}

/// Whether the open triangle, which is no face of the mesh, starts outside all closed tetrahedra at its first corner.
pub(super) fn face_outside(context: &Context, [a, b, c]: [u32; 3]) -> bool {
    if a == b || b == c || c == a {
        return false;
    }
    if [a, b, c].iter().any(|&v| !context.stars.used(v)) {
        return true;
    }
    let tets = &context.mesh.tets;
    context.stars.of(a).iter().all(|&t| !cone_meets(context, cone_at(tets[t as usize], a), b, c))
}

/// The positive tetrahedron, permuted evenly so that `a` comes first.
fn cone_at([v0, v1, v2, v3]: [u32; 4], a: u32) -> [u32; 4] {
    // Even permutations keep the orientation.
    match a {
        _ if a == v0 => [v0, v1, v2, v3],
        _ if a == v1 => [v1, v0, v3, v2],
        _ if a == v2 => [v2, v3, v0, v1],
        _ => [v3, v2, v1, v0],
    }
}

/// Signs of `x` against the three planes of a cone: all non-negative inside.
fn sides(context: &Context, [a, p, q, r]: [u32; 4], x: u32) -> [Sign; 3] {
    [[a, x, q, r], [a, p, x, r], [a, p, q, x]].map(|tet| {
        let repeated = (0..4).any(|i| (i + 1..4).any(|j| tet[i] == tet[j]));
        if repeated {
            Sign::Zero
        } else {
            context.geometry.orient3d(tet)
        }
    })
}

/// Whether the ray from the cone's apex through `x` lies in the closed cone.
fn cone_holds(context: &Context, cone: [u32; 4], x: u32) -> bool {
    sides(context, cone, x).iter().all(|&s| s != Sign::Negative)
}

/// Whether the open sector between the rays through `b` and `c` meets the closed cone: seen from the apex, an open arc of less
/// than half a circle and a triangle.
fn cone_meets(context: &Context, cone: [u32; 4], b: u32, c: u32) -> bool {
    let (at_b, at_c) = (sides(context, cone, b), sides(context, cone, c));
    // The arc leaves the cone at once, or never reaches it, if both ends are on the outer side of one plane (one may be on the plane).
    let apart = |s: Sign, t: Sign| s.min(t) == Sign::Negative && s.max(t) != Sign::Positive;
    if (0..3).any(|i| apart(at_b[i], at_c[i])) {
        return false;
    }
    let inside = |s: [Sign; 3]| s.iter().all(|&x| x != Sign::Negative);
    if inside(at_b) || inside(at_c) {
        return true;
    }
    // Both ends are outside, and none of the three planes separates: the arc meets the cone unless the whole cone is strictly on one side
    // of the arc's plane, or the arc passes on the opposite side. It enters through a face of the cone or not at all.
    let [a, p, q, r] = cone;
    let of_arc = |x: u32| if x == b || x == c { Sign::Zero } else { context.geometry.orient3d([a, b, c, x]) };
    let (sp, sq, sr) = (of_arc(p), of_arc(q), of_arc(r));
    // Face i is spanned by the two edges other than i; the signs of the arc's ends relative to it are at_b[i] and at_c[i].
    [(0, sq, sr), (1, sr, sp), (2, sp, sq)].into_iter().any(|(i, from, to)| {
        let enters = at_b[i] == Sign::Negative && at_c[i] == Sign::Positive;
        let leaves = at_b[i] == Sign::Positive && at_c[i] == Sign::Negative;
        // Crossing inwards, the arc has the face's edges on its two sides in a fixed order; outwards in the other.
        enters && from != Sign::Negative && to != Sign::Positive
            || leaves && from != Sign::Positive && to != Sign::Negative
    })
}

/// The edges of carved pieces in both directions, sorted: those of listed carved pieces that are outside.
pub(super) fn carved_edges(context: &Context) -> Result<Vec<[u32; 2]>, Error> {
    let mesh = context.mesh;
    let mut edges: Vec<[u32; 2]> = Vec::new();
    fallible::extend(&mut edges, mesh.unmeshed_subsegments.iter().map(|s| s.ends))?;
    for face in mesh.unmeshed_subfaces.iter().filter(|face| is_carved(context, face)) {
        let [a, b, c] = face.corners;
        fallible::extend(&mut edges, [[a, b], [b, c], [c, a]])?;
    }
    for edge in &mut edges {
        edge.sort_unstable();
    }
    edges.sort_unstable();
    edges.dedup();
    edges.retain(|&[a, b]| !context.stars.has_edge(&mesh.tets, a, b) && edge_outside(context, a, b));
    for i in 0..edges.len() {
        let [a, b] = edges[i];
        fallible::push(&mut edges, [b, a])?;
    }
    edges.sort_unstable();
    Ok(edges)
}

/// Whether a subface is marked as unmeshed and is outside.
pub(super) fn is_carved(context: &Context, face: &Subface) -> bool {
    face.tets == [INVALID; 2]
        && context.faces.find(face.corners).is_empty()
        && face_outside(context, face.corners)
}
