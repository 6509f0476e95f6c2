//! Gmsh's MSH 4.1, in text. Source: Gmsh Reference Manual, section "MSH file format".
//!
//! One volume per region, one surface per facet marker, one curve per segment marker. Physical groups: each region by its
//! tag (see `tags`), each marker by itself; a marker that is not positive by a free tag, for physical tags are positive.
//! The names tell attribute and marker. Every entity is in a group: readers want all or none.
use super::output_files::Out;
use super::tags;
use crate::output::TetMesh;
use std::io;

/// An entity: its elements (indices of subsegments, subfaces or tetrahedra), its physical tag and name.
struct Entity {
    elements: Vec<u32>,
    physical: i32,
    name: String,
}

/// Writes a mesh.
pub(super) fn write(out: &mut Out, mesh: &TetMesh) -> io::Result<()> {
    let curves = by_marker(tags::segment_pieces(mesh), |i| mesh.subsegments[i as usize].marker);
    let surfaces = by_marker((0..mesh.subfaces.len() as u32).collect(), |i| mesh.subfaces[i as usize].marker);
    let entities = [curves, surfaces, volumes(mesh)];
    out.put("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")?;
    write_names(out, &entities)?;
    write_entities(out, mesh, &entities)?;
    write_nodes(out, mesh)?;
    write_elements(out, mesh, &entities)
}

fn by_marker(elements: Vec<u32>, marker: impl Fn(u32) -> i32) -> Vec<Entity> {
    let groups = tags::group_by_key(elements, marker);
    let markers: Vec<f64> = groups.iter().map(|(marker, _)| f64::from(*marker)).collect();
    let physical = tags::positive_tags(&markers);
    groups
        .into_iter()
        .zip(physical)
        .map(|((marker, elements), tag)| Entity { elements, physical: tag, name: format!("marker {marker}") })
        .collect()
}

fn volumes(mesh: &TetMesh) -> Vec<Entity> {
    let physical = tags::region_tags(mesh);
    let mut volumes: Vec<Entity> = physical
        .iter()
        .enumerate()
        .map(|(i, &tag)| Entity {
            elements: Vec::new(),
            physical: tag,
            name: format!("region {}", mesh.regions.get(i).map_or(0.0, |r| r.attribute)),
        })
        .collect();
    for tet in 0..mesh.tets.len() {
        volumes[tags::region_of(mesh, tet)].elements.push(tet as u32);
    }
    volumes
}

fn write_names(out: &mut Out, entities: &[Vec<Entity>; 3]) -> io::Result<()> {
    let mut names: Vec<(usize, i32, &str)> = Vec::new();
    for (i, of_dimension) in entities.iter().enumerate() {
        names.extend(of_dimension.iter().map(|e| (i + 1, e.physical, e.name.as_str())));
    }
    names.sort_unstable();
    names.dedup_by_key(|n| (n.0, n.1));
    out.format(format_args!("$PhysicalNames\n{}\n", names.len()))?;
    for (dimension, tag, name) in names {
        out.format(format_args!("{dimension} {tag} \"{name}\"\n"))?;
    }
    out.put("$EndPhysicalNames\n")
}

fn write_entities(out: &mut Out, mesh: &TetMesh, entities: &[Vec<Entity>; 3]) -> io::Result<()> {
    let [curves, surfaces, volumes] = entities;
    out.format(format_args!("$Entities\n0 {} {} {}\n", curves.len(), surfaces.len(), volumes.len()))?;
    for (dimension, of_dimension) in (1..).zip(entities) {
        for (i, entity) in of_dimension.iter().enumerate() {
            out.int(i + 1)?;
            for x in bounds(mesh, dimension, entity).iter().flatten() {
                out.blank_float(*x)?;
            }
            out.format(format_args!(" 1 {}", entity.physical))?;
            // No bounding entities are listed.
            out.put(" 0\n")?;
        }
    }
    out.put("$EndEntities\n")
}

fn corners_of(mesh: &TetMesh, dimension: u32, element: u32) -> &[u32] {
    match dimension {
        1 => &mesh.subsegments[element as usize].ends,
        2 => &mesh.subfaces[element as usize].corners,
        _ => &mesh.tets[element as usize],
    }
}

fn bounds(mesh: &TetMesh, dimension: u32, entity: &Entity) -> [[f64; 3]; 2] {
    let mut range: Option<[[f64; 3]; 2]> = None;
    for &element in &entity.elements {
        for &corner in corners_of(mesh, dimension, element) {
            let p = mesh.points.get(corner as usize).copied().unwrap_or_default();
            let [low, high] = range.unwrap_or([p, p]);
            range =
                Some([std::array::from_fn(|i| low[i].min(p[i])), std::array::from_fn(|i| high[i].max(p[i]))]);
        }
    }
    // Adding 0 makes -0 a plain 0.
    range.unwrap_or_default().map(|corner| corner.map(|x| x + 0.0))
}

fn write_nodes(out: &mut Out, mesh: &TetMesh) -> io::Result<()> {
    let count = mesh.points.len();
    out.format(format_args!("$Nodes\n1 {count} 1 {count}\n3 1 0 {count}\n"))?;
    for tag in 1..=count {
        out.int(tag)?;
        out.put("\n")?;
    }
    for point in &mesh.points {
        out.point(point)?;
        out.put("\n")?;
    }
    out.put("$EndNodes\n")
}

fn write_elements(out: &mut Out, mesh: &TetMesh, entities: &[Vec<Entity>; 3]) -> io::Result<()> {
    let blocks = entities.iter().flatten().filter(|e| !e.elements.is_empty()).count();
    let count: usize = entities.iter().flatten().map(|e| e.elements.len()).sum();
    out.format(format_args!("$Elements\n{blocks} {count} {} {count}\n", count.min(1)))?;
    let mut tag = 0u64;
    // Gmsh's element types: 1 line, 2 triangle, 4 tetrahedron.
    for ((dimension, kind), of_dimension) in [(1, 1), (2, 2), (3, 4)].into_iter().zip(entities) {
        for (i, entity) in of_dimension.iter().enumerate().filter(|(_, e)| !e.elements.is_empty()) {
            out.format(format_args!("{dimension} {} {kind} {}\n", i + 1, entity.elements.len()))?;
            for &element in &entity.elements {
                tag += 1;
                out.int(tag)?;
                for &corner in corners_of(mesh, dimension, element) {
                    out.blank_int(u64::from(corner) + 1)?;
                }
                out.put("\n")?;
            }
        }
    }
    out.put("$EndElements\n")
}
