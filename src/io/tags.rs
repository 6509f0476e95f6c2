//! Integer tags for formats that have no real attributes, and elements grouped by them.
use crate::output::TetMesh;
use crate::INVALID;
use std::collections::BTreeSet;

/// The value as a positive 32-bit integer, if it is one.
fn positive(value: f64) -> Option<i32> {
    (value >= 1.0 && value <= f64::from(i32::MAX) && value.fract() == 0.0).then_some(value as i32)
}

/// A positive tag for each value: the value itself where it is a positive integer, else the lowest tag that no other value
/// has. Equal values have equal tags.
pub(super) fn positive_tags(values: &[f64]) -> Vec<i32> {
    let mut used: BTreeSet<i32> = values.iter().copied().filter_map(positive).collect();
    let mut others: Vec<(u64, i32)> = Vec::new();
    let mut next = 1;
    let mut tag_of = |value: f64| {
        if let Some(tag) = positive(value) {
            return tag;
        }
        if let Some(&(_, tag)) = others.iter().find(|(bits, _)| *bits == value.to_bits()) {
            return tag;
        }
        while used.contains(&next) {
            next += 1;
        }
        used.insert(next);
        others.push((value.to_bits(), next));
        next
    };
    values.iter().map(|&value| tag_of(value)).collect()
}

/// The tag of each region: from its attribute; one region where the mesh names none.
pub(super) fn region_tags(mesh: &TetMesh) -> Vec<i32> {
    let attributes: Vec<f64> = mesh.regions.iter().map(|r| r.attribute).collect();
    if attributes.is_empty() {
        return vec![1];
    }
    positive_tags(&attributes)
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
pub(super) fn segment_pieces(mesh: &TetMesh) -> Vec<u32> {
    let on_segment = |i: &u32| mesh.subsegments.get(*i as usize).is_some_and(|s| s.segment != INVALID);
    (0..mesh.subsegments.len() as u32).filter(on_segment).collect()
}

/// Elements in groups of equal key, keys ascending, elements of a group in order.
pub(super) fn group_by_key<K: Ord + Copy>(elements: Vec<u32>, key: impl Fn(u32) -> K) -> Vec<(K, Vec<u32>)> {
    let mut groups: std::collections::BTreeMap<K, Vec<u32>> = std::collections::BTreeMap::new();
    for element in elements {
        groups.entry(key(element)).or_default().push(element);
    }
    groups.into_iter().collect()
}
