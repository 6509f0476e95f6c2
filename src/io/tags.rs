//! Groups of elements for formats that divide a mesh by integers and names: one per region, facet marker and segment marker.
//!
//! A group's tag is the attribute or marker itself if that is a positive integer, otherwise the lowest free positive one, since physical
//! tags must be positive.
use crate::error::{Element, Error};
use crate::fallible;
use crate::io::model::{lose, Model};
use crate::output::TetMesh;
use crate::warning::Warnings;
use crate::INVALID;
use rustc_hash::FxHashMap;

/// Elements that share a marker or a region.
pub(super) struct Group {
    /// Indices of subsegments, subfaces or tetrahedra, ascending.
    pub elements: Vec<u32>,
    /// A positive tag.
    pub tag: i32,
    /// The marker's or region's own name, if it has one: one line.
    pub named: Option<String>,
    /// `marker K` or `region A`.
    pub plain: String,
}

impl Group {
    /// The name, or else what the group stands for.
    pub fn name(&self) -> &str {
        self.named.as_deref().unwrap_or(&self.plain)
    }
}

/// All groups of a mesh, by dimension: 1, 2, 3.
pub(super) struct Groups {
    /// Pieces of segments by marker.
    pub curves: Vec<Group>,
    /// Subfaces by marker.
    pub surfaces: Vec<Group>,
    /// Tetrahedra by region; regions with the same attribute have the same tag.
    pub volumes: Vec<Group>,
}

impl Groups {
    /// Divides a mesh into groups. Warns of attributes and markers that are not positive integers; of marker 0 only if there are other
    /// markers, since otherwise nothing is marked.
    pub fn new(model: &Model<'_>, warnings: &mut Warnings) -> Result<Self, Error> {
        let mesh = model.mesh;
        let curves = by_marker(segment_pieces(mesh)?, |i| mesh.subsegments[i as usize].marker)?;
        let faces = fallible::collect(0..mesh.subfaces.len() as u32)?;
        let surfaces = by_marker(faces, |i| mesh.subfaces[i as usize].marker)?;
        let lost = |group: &&(i32, Group), groups: &[(i32, Group)]| {
            group.0 < 0 || (group.0 == 0 && groups.len() > 1)
        };
        for (_, group) in curves.iter().filter(|g| lost(g, &curves)) {
            let first = group.elements.first().map_or(INVALID, |&i| mesh.subsegments[i as usize].segment);
            lose(warnings, model.options, Element::Segment(first));
        }
        for (_, group) in surfaces.iter().filter(|g| lost(g, &surfaces)) {
            let first = group.elements.first().map_or(INVALID, |&i| mesh.subfaces[i as usize].facet);
            lose(warnings, model.options, Element::Facet(first));
        }
        let volumes = volumes(model, warnings)?;
        let groups = |list: Vec<(i32, Group)>| fallible::collect(list.into_iter().map(|(_, group)| group));
        let mut surfaces = groups(surfaces)?;
        for group in &mut surfaces {
            // Only facets have names by marker.
            let marker = group.elements.first().map_or(0, |&i| mesh.subfaces[i as usize].marker);
            if let Some(name) = model.plc.marker_name(marker) {
                group.named = Some(fallible::text(format_args!("{}", one_line(name)))?);
            }
        }
        Ok(Groups { curves: groups(curves)?, surfaces, volumes })
    }
}

/// The first line of a name, for files in which a line ends it.
pub(super) fn one_line(name: &str) -> &str {
    name.lines().next().unwrap_or_default()
}

/// Elements in groups of equal marker, markers ascending.
fn by_marker(mut elements: Vec<u32>, marker: impl Fn(u32) -> i32) -> Result<Vec<(i32, Group)>, Error> {
    elements.sort_unstable_by_key(|&element| (marker(element), element));
    let mut groups = Vec::new();
    let mut values = Vec::new();
    for same in elements.chunk_by(|&a, &b| marker(a) == marker(b)) {
        let marker = marker(same[0]);
        fallible::push(&mut values, f64::from(marker))?;
        let plain = fallible::text(format_args!("marker {marker}"))?;
        let group = Group { elements: fallible::copied(same)?, tag: 0, named: None, plain };
        fallible::push(&mut groups, (marker, group))?;
    }
    for ((_, group), tag) in groups.iter_mut().zip(positive_tags(&values)?) {
        group.tag = tag;
    }
    Ok(groups)
}

fn volumes(model: &Model<'_>, warnings: &mut Warnings) -> Result<Vec<Group>, Error> {
    let mesh = model.mesh;
    let tags = region_tags(mesh)?;
    let mut counts = fallible::filled(0usize, tags.len())?;
    (0..mesh.tets.len()).for_each(|tet| counts[region_of(mesh, tet)] += 1);
    let mut volumes = Vec::new();
    for (i, (&tag, count)) in tags.iter().zip(counts).enumerate() {
        let attribute = mesh.regions.get(i).map_or(0.0, |r| r.attribute);
        let elements = fallible::reserved(count)?;
        let given = model.options.region_names.iter().find(|n| n.attribute == attribute);
        let named = match given.map(|n| one_line(&n.name)).filter(|name| !name.is_empty()) {
            Some(name) => Some(fallible::text(format_args!("{name}"))?),
            None => None,
        };
        let plain = fallible::text(format_args!("region {attribute}"))?;
        fallible::push(&mut volumes, Group { elements, tag, named, plain })?;
    }
    lose_attributes(model, &tags, warnings);
    for tet in 0..mesh.tets.len() {
        fallible::push(&mut volumes[region_of(mesh, tet)].elements, tet as u32)?;
    }
    Ok(volumes)
}

/// Warns of the regions whose attribute is not their tag.
pub(super) fn lose_attributes(model: &Model<'_>, tags: &[i32], warnings: &mut Warnings) {
    for (i, (region, &tag)) in (0..).zip(model.mesh.regions.iter().zip(tags)) {
        if region.attribute != f64::from(tag) {
            lose(warnings, model.options, Element::Region(region.seed.min(i)));
        }
    }
}

/// The value as a positive 32-bit integer, if it is one.
fn positive(value: f64) -> Option<i32> {
    (value >= 1.0 && value <= f64::from(i32::MAX) && value.fract() == 0.0).then_some(value as i32)
}

/// A positive tag for each value: the value itself where it is a positive integer, else the lowest tag that no other value
/// has. Equal values have equal tags.
fn positive_tags(values: &[f64]) -> Result<Vec<i32>, Error> {
    let mut used = fallible::collect(values.iter().copied().filter_map(positive))?;
    used.sort_unstable();
    let mut others: FxHashMap<u64, i32> = FxHashMap::default();
    let mut tags = fallible::reserved(values.len())?;
    let mut next = 1;
    for &value in values {
        let known = positive(value).or_else(|| others.get(&value.to_bits()).copied());
        fallible::push(
            &mut tags,
            match known {
                Some(tag) => tag,
                None => {
                    while used.binary_search(&next).is_ok() {
                        next += 1;
                    }
                    fallible::insert(&mut others, value.to_bits(), next)?;
                    next += 1;
                    next - 1
                }
            },
        )?;
    }
    Ok(tags)
}

/// The tag of each region: from its attribute; one region where the mesh names none.
pub(super) fn region_tags(mesh: &TetMesh) -> Result<Vec<i32>, Error> {
    match mesh.regions.is_empty() {
        true => Ok(fallible::copied(&[1])?),
        false => positive_tags(&fallible::collect(mesh.regions.iter().map(|r| r.attribute))?),
    }
}

/// The region of a tetrahedron, 0 where the mesh names none.
pub(super) fn region_of(mesh: &TetMesh, tet: usize) -> usize {
    mesh.tet_region.get(tet).map_or(0, |&r| (r as usize).min(mesh.regions.len().saturating_sub(1)))
}

/// The attribute of a tetrahedron's region, 0 where the mesh names none.
pub(super) fn attribute_of(mesh: &TetMesh, tet: usize) -> f64 {
    mesh.regions.get(region_of(mesh, tet)).map_or(0.0, |r| r.attribute)
}

/// Subsegments that lie on segments (edges of facets are none), by index.
pub(super) fn segment_pieces(mesh: &TetMesh) -> Result<Vec<u32>, Error> {
    let on_segment = |i: &u32| mesh.subsegments.get(*i as usize).is_some_and(|s| s.segment != INVALID);
    Ok(fallible::collect((0..mesh.subsegments.len() as u32).filter(on_segment))?)
}
