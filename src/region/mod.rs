//! Carving and regions: flooding between subfaces.
//!
//! Tetrahedra connected through faces that are no subfaces form a component. The component of the ghosts is outside, those
//! with a hole seed are holes; the others are regions.
use crate::error::{Defect, DefectKind, Element, Error, Status};
use crate::mesh::{flag, Tetrahedra, NONE};
use crate::output::Region;
use crate::plc::RegionSeed;
use crate::predicates::{Points, Sign};

/// The components of a constrained mesh.
#[derive(Clone, Debug, Default)]
pub struct Components {
    /// Component of each slot; NONE for free slots.
    pub of: Vec<u32>,
    /// How many there are. Component 0 holds the ghosts (and what is connected to them).
    pub count: u32,
}

/// Floods the mesh.
pub fn components(mesh: &Tetrahedra) -> Result<Components, Error> {
    let mut of: Vec<u32> = Vec::new();
    of.try_reserve(mesh.slot_count())?;
    of.resize(mesh.slot_count(), NONE);
    let mut stack: Vec<u32> = Vec::new();
    let mut count = 0;
    let slots = 0..mesh.slot_count() as u32;
    let ghosts_first = slots.clone().filter(|&t| mesh.is_ghost(t)).chain(slots);
    for seed in ghosts_first {
        if !mesh.is_live(seed) || of[seed as usize] != NONE {
            continue;
        }
        // All ghosts belong together, also where a closed surface is the hull itself.
        let label = if mesh.is_ghost(seed) { 0 } else { count };
        of[seed as usize] = label;
        count = count.max(label + 1);
        stack.push(seed);
        while let Some(t) = stack.pop() {
            stack.try_reserve(4)?;
            for f in 0..4 {
                if mesh.flags[t as usize] & (flag::FACE << f) != 0 {
                    continue;
                }
                let n = mesh.adj[t as usize][f] >> 2;
                if of[n as usize] == NONE {
                    of[n as usize] = label;
                    stack.push(n);
                }
            }
        }
    }
    Ok(Components { of, count })
}

/// The component that contains a point: None outside the hull; an error if the point lies on a subface between two.
fn component_at(
    mesh: &Tetrahedra,
    points: &mut Points,
    components: &Components,
    seed: [f64; 3],
    element: Element,
) -> Result<Option<u32>, Error> {
    let mut found: Option<u32> = None;
    let mut ambiguous = false;
    let mark = points.len();
    let mut pushed: Option<u32> = None;
    for t in 0..mesh.slot_count() as u32 {
        if !mesh.is_live(t) || mesh.is_ghost(t) {
            continue;
        }
        let v = mesh.verts[t as usize];
        let outside_box = (0..3).any(|k| {
            let low = v.iter().map(|&w| points.xyz(w)[k]).fold(f64::INFINITY, f64::min).next_down();
            let high = v.iter().map(|&w| points.xyz(w)[k]).fold(f64::NEG_INFINITY, f64::max).next_up();
            seed[k] < low || seed[k] > high
        });
        if outside_box {
            continue;
        }
        // Only a seed inside the box of the mesh becomes a point: the filters' bounds hold there.
        let p = match pushed {
            Some(p) => p,
            None => *pushed.insert(points.push(seed)?),
        };
        let inside = (0..4).all(|f| {
            let [x, y, z] = mesh.face(4 * t + f);
            points.orient3d(p, x, y, z) != Sign::Negative
        });
        if inside {
            let component = components.of[t as usize];
            ambiguous |= found.is_some_and(|other| other != component);
            found = Some(component);
        }
    }
    points.truncate(mark);
    if ambiguous {
        let defect =
            Defect { kind: DefectKind::SeedOnFacet, first: element, second: None, point: Some(seed) };
        return Err(Error::with_defect(
            Status::SeedOutside,
            format!("{element} lies exactly on a facet"),
            defect,
        ));
    }
    Ok(found)
}

/// Which components stay, and what region each is.
#[derive(Clone, Debug, Default)]
pub struct Regions {
    /// Region of each component; NONE: carved.
    pub of_component: Vec<u32>,
    /// The regions.
    pub regions: Vec<Region>,
}

/// Seeds in the engine's scale.
pub struct Seeds<'a> {
    /// Hole seeds.
    pub holes: &'a [[f64; 3]],
    /// Region seeds.
    pub regions: &'a [RegionSeed],
}

/// Decides what is carved and labels the rest. Fails if nothing is left, or a seed is on a facet or outside.
pub fn label(
    mesh: &Tetrahedra,
    points: &mut Points,
    components: &Components,
    seeds: &Seeds,
    keep_hull: bool,
) -> Result<Regions, Error> {
    let count = components.count as usize;
    let mut carved = vec![false; count];
    carved[0] = !keep_hull;
    for (i, &hole) in seeds.holes.iter().enumerate() {
        if let Some(component) = component_at(mesh, points, components, hole, Element::Hole(i as u32))? {
            carved[component as usize] = true;
        }
    }
    let any_left = (0..mesh.slot_count() as u32)
        .any(|t| mesh.is_live(t) && !mesh.is_ghost(t) && !carved[components.of[t as usize] as usize]);
    if !any_left {
        return Err(Error::new(
            Status::NothingEnclosed,
            "the surface encloses nothing (keep the convex hull to mesh around it)",
        ));
    }
    let mut of_component = vec![NONE; count];
    let mut regions: Vec<Region> = Vec::new();
    for (i, seed) in seeds.regions.iter().enumerate() {
        let element = Element::Region(i as u32);
        let component = component_at(mesh, points, components, seed.point, element)?;
        let Some(component) = component.filter(|&c| !carved[c as usize]) else {
            let defect = Defect {
                kind: DefectKind::SeedOutside,
                first: element,
                second: None,
                point: Some(seed.point),
            };
            return Err(Error::with_defect(
                Status::SeedOutside,
                format!("{element} lies outside the domain"),
                defect,
            ));
        };
        if of_component[component as usize] == NONE {
            of_component[component as usize] = regions.len() as u32;
            regions.push(Region { attribute: seed.attribute, seed: i as u32, max_volume: seed.max_volume });
        }
    }
    number_unseeded(mesh, components, &carved, &mut of_component, &mut regions);
    Ok(Regions { of_component, regions })
}

/// Gives every remaining component a region of its own, with the smallest attributes 1, 2, … that no seed uses.
fn number_unseeded(
    mesh: &Tetrahedra,
    components: &Components,
    carved: &[bool],
    of_component: &mut [u32],
    regions: &mut Vec<Region>,
) {
    let used: Vec<f64> = regions.iter().map(|r| r.attribute).collect();
    let mut next = 0.0;
    for t in 0..mesh.slot_count() as u32 {
        if !mesh.is_live(t) || mesh.is_ghost(t) {
            continue;
        }
        let c = components.of[t as usize] as usize;
        if carved[c] || of_component[c] != NONE {
            continue;
        }
        next += 1.0;
        while used.contains(&next) {
            next += 1.0;
        }
        of_component[c] = regions.len() as u32;
        regions.push(Region { attribute: next, seed: NONE, max_volume: None });
    }
}
