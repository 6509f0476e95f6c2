//! Finds the facets of a mesh's faces if a file does not record them: TetGen's `.face` has only markers.
//!
//! A `.parents` file names them, so only the sides remain to be found. Without it they are found only for meshes without Steiner points on
//! the surface, where the corners of a face are corners of its facet. (The checker does not judge the facets of other meshes, since it
//! cannot know where such points lie.)
use delotet::query::are_coplanar;
use delotet::{Error, Plc, Region, Status, Subface, TetMesh, INVALID};
use std::collections::{HashMap, HashSet};

/// Sets facet and sides of every subface of a mesh whose added points are all said to lie inside; drops the subfaces of any other mesh, or
/// if that turns out to be wrong.
///
/// # Errors
/// [`Status::Unsupported`] if a face cannot be attributed to one facet.
pub fn attribute_subfaces(plc: &Plc, mesh: &mut TetMesh) -> Result<(), Error> {
    let points = mesh.points.len();
    let named = !mesh.subfaces.is_empty() && mesh.subfaces.iter().all(|face| face.facet != INVALID);
    if named && mesh.steiner.len() + plc.points.len() == points {
        let sides = sides_of_faces(mesh);
        mesh.subfaces.iter_mut().for_each(|face| face.tets = sides_of(face, &sides));
        separate_regions(mesh, &sides);
        attribute_regions(plc, mesh);
        order_unknown(mesh);
        return Ok(());
    }
    let known = mesh.steiner.len() == points.saturating_sub(plc.points.len());
    let on_input = |face: &Subface| face.corners.iter().all(|&v| (v as usize) < plc.points.len());
    if !known
        || !mesh.subfaces.iter().all(on_input)
        || mesh.tets.iter().flatten().any(|&v| v as usize >= points)
    {
        mesh.subfaces.clear();
        mesh.unmeshed_subfaces.clear();
        mesh.unmeshed_subsegments.clear();
        return Ok(());
    }
    let alias = aliases(plc);
    let facets_at = facets_at_points(plc, &alias);
    let sides = sides_of_faces(mesh);
    let attribute = |&region: &u32| mesh.regions.get(region as usize).map_or(0.0, |r| r.attribute);
    let attributes: Vec<f64> = mesh.tet_region.iter().map(attribute).collect();
    for face in &mut mesh.subfaces {
        let [a, b, c] = face.corners.map(|v| &facets_at[alias[v as usize] as usize]);
        let mut candidates = a.iter().filter(|f| b.contains(f) && c.contains(f)).copied();
        let fits = |f: &u32| plc.facet_marker(*f as usize) == face.marker;
        let (first, second) = (candidates.find(fits), candidates.find(fits));
        // No facet has all three corners of a face that straddles coplanar facets: any facet in its plane represents them, since the
        // checker treats them as one.
        let first = first.or_else(|| {
            a.iter().chain(b).chain(c).copied().find(|f| fits(f) && is_in_plane(plc, *f, face.corners))
        });
        let (Some(facet), None) = (first, second) else {
            let [a, b, c] = face.corners;
            let message =
                format!("face ({a}, {b}, {c}) of the mesh cannot be attributed to one facet of the input");
            return Err(Error::new(Status::Unsupported, message));
        };
        *face = ordered(Subface { facet, tets: sides_of(face, &sides), ..*face }, &attributes);
    }
    Ok(())
}

/// Makes a region of every part that subfaces bound: files do not tell regions of equal attributes apart.
fn separate_regions(mesh: &mut TetMesh, sides: &Sides) {
    fn root(parent: &mut [u32], mut t: u32) -> u32 {
        while parent[t as usize] != t {
            parent[t as usize] = parent[parent[t as usize] as usize];
            t = parent[t as usize];
        }
        t
    }
    let walls: HashSet<[u32; 3]> = mesh.subfaces.iter().map(|face| sorted(face.corners).0).collect();
    let mut parent: Vec<u32> = (0..mesh.tets.len() as u32).collect();
    for (_, &[s, t]) in sides.iter().filter(|(face, [s, t])| *s.max(t) != INVALID && !walls.contains(*face)) {
        // Whether the region may change there is left to the check.
        if mesh.tet_region[s as usize] == mesh.tet_region[t as usize] {
            let (s, t) = (root(&mut parent, s), root(&mut parent, t));
            parent[s.max(t) as usize] = s.min(t);
        }
    }
    let mut regions: Vec<Region> = Vec::new();
    let mut number = vec![0; parent.len()];
    for t in 0..parent.len() as u32 {
        let first = root(&mut parent, t);
        if first == t {
            number[t as usize] = regions.len() as u32;
            regions.push(mesh.regions[mesh.tet_region[t as usize] as usize]);
        }
        number[t as usize] = number[first as usize];
    }
    (mesh.tet_region, mesh.regions) = (number, regions);
}

/// Turns subfaces between regions as the check expects them where files do not tell whether the regions had seeds, and in which order.
fn order_unknown(mesh: &mut TetMesh) {
    let region = |t: u32| mesh.tet_region.get(t as usize).and_then(|&r| mesh.regions.get(r as usize));
    let attributes: Vec<f64> =
        (0..mesh.tets.len() as u32).map(|t| region(t).map_or(0.0, |r| r.attribute)).collect();
    for face in &mut mesh.subfaces {
        let [Some(r), Some(q)] = face.tets.map(region) else { continue };
        if r.seed == INVALID && q.seed == INVALID && r.attribute != q.attribute {
            *face = ordered(*face, &attributes);
        }
    }
}

/// Assigns to every region the seed with its attribute, if only one seed and only this region has it.
fn attribute_regions(plc: &Plc, mesh: &mut TetMesh) {
    let mut counts: HashMap<u64, u32> = HashMap::new();
    let key = |region: &Region| (region.attribute + 0.0).to_bits();
    mesh.regions.iter().for_each(|region| *counts.entry(key(region)).or_default() += 1);
    let mut seeds: Vec<(f64, u32)> = plc.regions.iter().map(|seed| seed.attribute + 0.0).zip(0..).collect();
    seeds.sort_unstable_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    for region in mesh.regions.iter_mut().filter(|region| counts[&key(region)] == 1) {
        let attribute = region.attribute + 0.0;
        let from = seeds.partition_point(|x| x.0.total_cmp(&attribute).is_lt());
        let mut equal = seeds[from..].iter().take_while(|x| x.0 == attribute);
        if let (Some(only), None) = (equal.next(), equal.next()) {
            region.seed = only.1;
        }
    }
}

/// Orients a face from another program, which may point either way, like ours: away from the region with the lower attribute.
fn ordered(face: Subface, attributes: &[f64]) -> Subface {
    let attribute = |t: u32| attributes.get(t as usize).copied().unwrap_or(0.0);
    let ([a, b, c], [s, t]) = (face.corners, face.tets);
    let order = attribute(s).total_cmp(&attribute(t)).then(s.cmp(&t));
    match t == INVALID || s != INVALID && order.is_le() {
        true => face,
        false => Subface { corners: [a, c, b], tets: [t, s], ..face },
    }
}

/// Whether all corners of a facet lie exactly in the plane of three points.
fn is_in_plane(plc: &Plc, facet: u32, corners: [u32; 3]) -> bool {
    let [a, b, c] = corners.map(|v| &plc.points[v as usize]);
    let flat = |v: &u32| plc.points.get(*v as usize).is_some_and(|p| are_coplanar([a, b, c, p]));
    match (facet as usize).checked_sub(plc.triangles.len()) {
        None => plc.triangles[facet as usize].iter().all(flat),
        Some(general) => plc.facets[general].polygons.iter().flatten().all(flat),
    }
}

/// For each point the first point equal to it.
fn aliases(plc: &Plc) -> Vec<u32> {
    let mut first = HashMap::new();
    let key = |p: &[f64; 3]| p.map(|x| (x + 0.0).to_bits());
    plc.points.iter().enumerate().map(|(i, p)| *first.entry(key(p)).or_insert(i as u32)).collect()
}

/// For each point the facets that it is a corner of, in ascending order.
fn facets_at_points(plc: &Plc, alias: &[u32]) -> Vec<Vec<u32>> {
    let mut facets_at = vec![Vec::new(); plc.points.len()];
    let triangles = plc.triangles.iter().map(|t| vec![&t[..]]);
    let general = plc.facets.iter().map(|f| f.polygons.iter().map(|p| &p[..]).collect());
    for (facet, rings) in (0u32..).zip(triangles.chain(general)) {
        for &corner in rings.into_iter().flatten() {
            let Some(&point) = alias.get(corner as usize) else { continue };
            if facets_at[point as usize].last() != Some(&facet) {
                facets_at[point as usize].push(facet);
            }
        }
    }
    facets_at
}

type Sides = HashMap<[u32; 3], [u32; 2]>;

/// Sorted corners, and whether sorting was an odd permutation.
fn sorted(corners: [u32; 3]) -> ([u32; 3], bool) {
    let [a, b, c] = corners;
    let odd = (a > b) ^ (a > c) ^ (b > c);
    let mut sorted = corners;
    sorted.sort_unstable();
    (sorted, odd)
}

/// For each face the tetrahedra on the negative and the positive side of its sorted corners.
fn sides_of_faces(mesh: &TetMesh) -> Sides {
    let mut sides = Sides::new();
    for (t, &[a, b, c, d]) in (0u32..).zip(&mesh.tets) {
        // Each face ordered so that it and the opposite vertex form an even permutation of the tetrahedron.
        for face in [[b, d, c], [a, c, d], [a, d, b], [a, b, c]] {
            let (key, odd) = sorted(face);
            sides.entry(key).or_insert([INVALID; 2])[usize::from(!odd)] = t;
        }
    }
    sides
}

fn sides_of(face: &Subface, sides: &Sides) -> [u32; 2] {
    let (key, odd) = sorted(face.corners);
    let [negative, positive] = sides.get(&key).copied().unwrap_or([INVALID; 2]);
    if odd {
        [positive, negative]
    } else {
        [negative, positive]
    }
}
