//! Gmsh's MSH 4.1 and 2.2, in text. Source: Gmsh Reference Manual, sections "MSH file format" and "MSH file format version 2
//! (Legacy)".
//!
//! One volume per region, one surface per facet marker, one curve per segment marker, each a physical group with tag and name of
//! its own (see `tags`). Every entity is in a group, since readers require all or none. Version 2.2 numbers elementary entities by their
//! place among those of their dimension, as 4.1 does.
use crate::fallible;
use crate::io::model::{Model, Nodes};
use crate::io::output_files::Out;
use crate::io::tags::{Group, Groups};
use crate::query::NodeOrder;
use std::io;

/// Entities of one dimension with Gmsh's number for their elements.
struct Dimension<'a> {
    dimension: usize,
    kind: u32,
    groups: &'a [Group],
}

fn dimensions<'a>(model: &Model<'_>, groups: &'a Groups) -> [Dimension<'a>; 3] {
    // 1 line, 2 triangle, 4 tetrahedron; 8, 9, 11 with nodes on their edges.
    let kinds = if model.options.second_order { [8, 9, 11] } else { [1, 2, 4] };
    let lists = [&groups.curves[..], &groups.surfaces[..], &groups.volumes[..]];
    std::array::from_fn(|i| Dimension { dimension: i + 1, kind: kinds[i], groups: lists[i] })
}

/// Writes a mesh in version 4.1.
pub(super) fn write(out: &mut Out, model: &Model<'_>, groups: &Groups) -> io::Result<()> {
    let dimensions = dimensions(model, groups);
    out.put("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")?;
    write_names(out, &dimensions)?;
    write_entities(out, model, &dimensions)?;
    write_nodes(out, model)?;
    write_elements(out, model, &dimensions)
}

/// Writes a mesh in version 2.2.
pub(super) fn write_legacy(out: &mut Out, model: &Model<'_>, groups: &Groups) -> io::Result<()> {
    let dimensions = dimensions(model, groups);
    out.put("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")?;
    write_names(out, &dimensions)?;
    out.format(format_args!("$Nodes\n{}\n", model.node_count()))?;
    for node in 0..model.node_count() {
        out.int(node + 1)?;
        out.put(" ")?;
        out.point(&model.node(node))?;
        out.put("\n")?;
    }
    let count: usize = all_groups(&dimensions).map(|g| g.elements.len()).sum();
    out.format(format_args!("$EndNodes\n$Elements\n{count}\n"))?;
    let mut number = 0u64;
    for Dimension { dimension, kind, groups } in &dimensions {
        for (i, group) in groups.iter().enumerate() {
            for &element in &group.elements {
                number += 1;
                out.int(number)?;
                // Two tags: the physical group and the elementary entity.
                out.format(format_args!(" {kind} 2 {} {}", group.tag, i + 1))?;
                nodes(model, *dimension, element)
                    .iter()
                    .try_for_each(|&n| out.blank_int(u64::from(n) + 1))?;
                out.put("\n")?;
            }
        }
    }
    out.put("$EndElements\n")
}

fn all_groups<'a>(dimensions: &[Dimension<'a>; 3]) -> impl Iterator<Item = &'a Group> {
    let [curves, surfaces, volumes] = dimensions.each_ref().map(|d| d.groups);
    curves.iter().chain(surfaces).chain(volumes)
}

/// The names of physical groups, by dimension and tag. Groups with the same tag (regions with the same attribute) are one.
fn write_names(out: &mut Out, dimensions: &[Dimension<'_>; 3]) -> io::Result<()> {
    let mut names: Vec<(usize, i32, &str)> = Vec::new();
    for d in dimensions {
        fallible::extend(&mut names, d.groups.iter().map(|g| (d.dimension, g.tag, g.name())))?;
    }
    names.sort_unstable();
    names.dedup_by_key(|n| (n.0, n.1));
    out.format(format_args!("$PhysicalNames\n{}\n", names.len()))?;
    for (dimension, tag, name) in names {
        out.format(format_args!("{dimension} {tag} \""))?;
        // A quotation mark would end the name.
        name.split('"').enumerate().try_for_each(|(i, part)| {
            out.put(if i > 0 { "'" } else { "" })?;
            out.put(part)
        })?;
        out.put("\"\n")?;
    }
    out.put("$EndPhysicalNames\n")
}

fn write_entities(out: &mut Out, model: &Model<'_>, dimensions: &[Dimension<'_>; 3]) -> io::Result<()> {
    let [curves, surfaces, volumes] = dimensions.each_ref().map(|d| d.groups.len());
    out.format(format_args!("$Entities\n0 {curves} {surfaces} {volumes}\n"))?;
    for Dimension { dimension, groups, .. } in dimensions {
        for (i, group) in groups.iter().enumerate() {
            out.int(i + 1)?;
            for x in bounds(model, *dimension, group).iter().flatten() {
                out.blank_float(*x)?;
            }
            // No bounding entities are listed.
            out.format(format_args!(" 1 {} 0\n", group.tag))?;
        }
    }
    out.put("$EndEntities\n")
}

/// The nodes of an element of a dimension.
fn nodes(model: &Model<'_>, dimension: usize, element: u32) -> Nodes {
    match dimension {
        1 => model.piece(element as usize),
        2 => model.face(element as usize),
        _ => model.tet(element as usize, NodeOrder::Gmsh),
    }
}

fn bounds(model: &Model<'_>, dimension: usize, group: &Group) -> [[f64; 3]; 2] {
    let mut range: Option<[[f64; 3]; 2]> = None;
    for &element in &group.elements {
        // Middles of edges lie between the corners.
        for &corner in nodes(model, dimension, element).iter().take(dimension + 1) {
            let p = model.node(corner as usize);
            let [low, high] = range.unwrap_or([p, p]);
            range =
                Some([std::array::from_fn(|i| low[i].min(p[i])), std::array::from_fn(|i| high[i].max(p[i]))]);
        }
    }
    // Adding 0 makes -0 a plain 0.
    range.unwrap_or_default().map(|corner| corner.map(|x| x + 0.0))
}

fn write_nodes(out: &mut Out, model: &Model<'_>) -> io::Result<()> {
    let count = model.node_count();
    out.format(format_args!("$Nodes\n1 {count} 1 {count}\n3 1 0 {count}\n"))?;
    for tag in 1..=count {
        out.int(tag)?;
        out.put("\n")?;
    }
    for node in 0..count {
        out.point(&model.node(node))?;
        out.put("\n")?;
    }
    out.put("$EndNodes\n")
}

fn write_elements(out: &mut Out, model: &Model<'_>, dimensions: &[Dimension<'_>; 3]) -> io::Result<()> {
    let blocks = all_groups(dimensions).filter(|g| !g.elements.is_empty()).count();
    let count: usize = all_groups(dimensions).map(|g| g.elements.len()).sum();
    out.format(format_args!("$Elements\n{blocks} {count} {} {count}\n", count.min(1)))?;
    let mut tag = 0u64;
    for Dimension { dimension, kind, groups } in dimensions {
        for (i, group) in groups.iter().enumerate().filter(|(_, g)| !g.elements.is_empty()) {
            out.format(format_args!("{dimension} {} {kind} {}\n", i + 1, group.elements.len()))?;
            for &element in &group.elements {
                tag += 1;
                out.int(tag)?;
                nodes(model, *dimension, element)
                    .iter()
                    .try_for_each(|&n| out.blank_int(u64::from(n) + 1))?;
                out.put("\n")?;
            }
        }
    }
    out.put("$EndElements\n")
}
