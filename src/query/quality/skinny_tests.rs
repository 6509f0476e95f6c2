//! Tetrahedra above a ratio: all of them, and what forces them.
use super::*;
use crate::query::quality::forced_tets;
use crate::{tetrahedralize, Facet, Mode, Options, Plc, Silent, INVALID};

fn box_plc() -> Plc {
    let points = (0..8).map(|i| [f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1)]).collect();
    let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let facet = |corners: &[u32; 4]| Facet { polygons: vec![corners.to_vec()], ..Facet::default() };
    Plc { points, facets: squares.iter().map(facet).collect(), ..Plc::default() }
}

/// A box with a triangle inside, facet 0, that has an angle of some degrees at point 8.
fn box_with_blade(degrees: f64) -> Plc {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let mut plc = box_plc();
    plc.points.extend([[0.2, 0.2, 0.5], [0.8, 0.2, 0.5], [0.2 + 0.6 * cosine, 0.2 + 0.6 * sine, 0.5]]);
    plc.triangles.push([8, 9, 10]);
    plc
}

fn made(plc: &Plc, options: Options) -> TetMesh {
    tetrahedralize(plc, &options, &mut Silent).unwrap()
}

fn skinny(mesh: &TetMesh, ratio: Option<f64>) -> SkinnyTets {
    skinny_tets(mesh, ratio, &forced_tets(mesh).unwrap()).unwrap()
}

/// Whether the list has exactly what is above its ratio, and says of what is beside something forced that it is.
fn check(mesh: &TetMesh, tets: &SkinnyTets) {
    let above = |tet: &[u32; 4]| TetQuality::of_tet(mesh, tet).radius_edge > tets.ratio;
    let expected: Vec<u32> = (0..).zip(&mesh.tets).filter(|x| above(x.1)).map(|x| x.0).collect();
    assert_eq!(tets.list.iter().map(|tet| tet.tet).collect::<Vec<_>>(), expected);
    assert_eq!(SkinnyCause::ALL.iter().map(|&cause| tets.count(cause)).sum::<usize>(), tets.list.len());
    let corners = |tet: u32| mesh.tets[tet as usize];
    let forced: Vec<u32> = forced_tets(mesh).unwrap().iter().map(|tet| tet.tet).collect();
    let listed = tets.list.iter().filter(|tet| tet.cause.is_forced()).map(|tet| tet.tet);
    let all: Vec<u32> = forced.iter().copied().chain(listed).collect();
    for tet in &tets.list {
        assert_eq!(tet.cause == SkinnyCause::Wedge, forced.contains(&tet.tet), "{tet:?}");
        assert_eq!(tet.cause == SkinnyCause::Other, tet.facets == [INVALID; 2], "{tet:?}");
        if !tet.cause.is_forced() {
            let near = all.iter().any(|&other| corners(other).iter().any(|v| corners(tet.tet).contains(v)));
            assert_eq!(near, tet.cause == SkinnyCause::Beside, "{tet:?}");
        }
    }
}

#[test]
fn narrow_corners_force_what_is_at_them() {
    for degrees in [2.0, 10.0, 16.0] {
        let plc = box_with_blade(degrees);
        let bound = 0.5 / degrees.to_radians().sin();
        for quality in [None, Some(1.414)] {
            let mesh = made(&plc, Options { quality, ..Options::default() });
            assert_eq!(mesh.ratio, quality);
            let tets = skinny(&mesh, Some(1.414));
            check(&mesh, &tets);
            let of_corner: Vec<&SkinnyTet> =
                tets.list.iter().filter(|tet| tet.cause == SkinnyCause::Corner).collect();
            assert!(of_corner.len() >= 2, "{degrees} {quality:?}");
            for tet in of_corner {
                assert!(tet.radius_edge > bound * (1.0 - 1e-9) && tet.facets == [0, 0], "{tet:?}");
                assert!(mesh.tets[tet.tet as usize].contains(&8), "{tet:?}");
            }
            // What is asked for may be larger than what the corner forces.
            assert_eq!(skinny(&mesh, Some(1.001 * bound)).count(SkinnyCause::Corner), 0);
        }
    }
    let mesh = made(&box_with_blade(25.0), Options { quality: Some(1.414), ..Options::default() });
    let tets = skinny(&mesh, None);
    check(&mesh, &tets);
    assert!(tets.ratio == 1.414 && tets.count(SkinnyCause::Corner) == 0);
}

#[test]
fn tetrahedra_in_wedges_are_forced_by_their_facets() {
    let mut plc = box_plc();
    // The top gets a ridge along one side, which meets the bottom at 11 degrees.
    plc.points.iter_mut().for_each(|p| p[2] *= 0.2 * p[0]);
    plc.points.remove(4);
    plc.points.remove(5);
    let number = [0u32, 1, 2, 3, 0, 4, 2, 5];
    for facet in &mut plc.facets {
        for ring in &mut facet.polygons {
            ring.iter_mut().for_each(|v| *v = number[*v as usize]);
            ring.dedup();
            if ring.first() == ring.last() {
                ring.pop();
            }
        }
    }
    plc.facets.retain(|facet| facet.polygons[0].len() > 2);
    for quality in [None, Some(1.414)] {
        let mesh = made(&plc, Options { quality, ..Options::default() });
        let forced = forced_tets(&mesh).unwrap();
        assert!(!forced.is_empty() && forced.iter().all(|tet| tet.facets == [0, 1]));
        let tets = skinny(&mesh, Some(1.0));
        check(&mesh, &tets);
        assert!(tets.count(SkinnyCause::Wedge) > 0);
    }
}

#[test]
fn kept_triangles_force_what_is_at_them() {
    let mut plc = box_plc();
    plc.points.push([0.5, 0.05, 1.0]);
    plc.facets.remove(1);
    plc.triangles.extend([[4, 5, 8], [5, 7, 8], [7, 6, 8], [6, 4, 8]]);
    let kept = made(&plc, Options { mode: Mode::Preserve, ..Options::default() });
    let tets = skinny(&kept, None);
    check(&kept, &tets);
    let faces: Vec<&SkinnyTet> = tets.list.iter().filter(|tet| tet.cause == SkinnyCause::Face).collect();
    assert!(faces.len() == 1 && faces[0].facets == [0, 0], "{faces:?}");
    // Where the surface may be split, it is no reason.
    let split = made(&plc, Options { quality: Some(2.0), ..Options::default() });
    check(&split, &skinny(&split, None));
    assert_eq!(skinny(&split, None).count(SkinnyCause::Face), 0);
}

#[test]
fn nonsense_is_refused_and_inconsistent_meshes_are_survived() {
    let mut mesh = made(&box_with_blade(10.0), Options::default());
    for ratio in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = skinny_tets(&mesh, Some(ratio), &[]).unwrap_err();
        assert_eq!(refused.status, Status::InvalidArgument);
    }
    assert_eq!(skinny(&mesh, None).ratio, Options::USUAL_RATIO);
    mesh.neighbors.clear();
    mesh.subsegments.clear();
    assert_eq!(skinny(&mesh, None).count(SkinnyCause::Corner), 0);
    mesh.points[8] = [f64::NAN; 3];
    mesh.tets[0][1] = 12_345;
    mesh.subfaces[0].corners = [7, 7, 99_999];
    mesh.subfaces[1].tets = [55_555, INVALID];
    skinny(&mesh, None);
    assert_eq!(skinny(&TetMesh::default(), None).list, []);
}
