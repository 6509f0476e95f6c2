//! Carving and regions: flooding between subfaces.
//!
//! Tetrahedra connected through faces that are not subfaces form a component. The component of the ghosts is the outside, those with a hole
//! seed are holes, the others are regions.
use crate::control::Control;
use crate::error::{Defect, DefectKind, Element, Error, Message, Status};
use crate::fallible;
use crate::kernel::{Mesh, NONE};
use crate::output::Region;
use crate::plc::RegionSeed;
use crate::predicates::Points;
use seeds::{locate, Place};

mod seeds;
#[cfg(test)]
mod tests;

/// The components of a constrained mesh.
#[derive(Debug, Default)]
pub struct Components {
    /// Component of each slot; NONE for free slots.
    pub of: Vec<u32>,
    /// The number of components. Component 0 contains the ghosts and everything connected to them.
    pub count: u32,
}

/// Finds the components by flood fill.
pub fn components(mesh: &Mesh, control: &Control) -> Result<Components, Error> {
    let mut of: Vec<u32> = fallible::filled(NONE, mesh.slot_count())?;
    let mut stack: Vec<u32> = Vec::new();
    let mut count = 0;
    let slots = || 0..mesh.slot_count() as u32;
    let ghosts_first = slots().filter(|&t| mesh.is_ghost(t)).chain(slots());
    for seed in ghosts_first {
        if !mesh.is_live(seed) || of[seed as usize] != NONE {
            continue;
        }
        // All ghosts form one component, even if a closed surface is the hull itself.
        let label = if mesh.is_ghost(seed) { 0 } else { count };
        of[seed as usize] = label;
        count = count.max(label + 1);
        fallible::push(&mut stack, seed)?;
        while let Some(t) = stack.pop() {
            control.step()?;
            for f in 0..4 {
                if mesh.is_subface(4 * t + f) {
                    continue;
                }
                let n = mesh.beyond(t, f);
                if of[n as usize] == NONE {
                    of[n as usize] = label;
                    fallible::push(&mut stack, n)?;
                }
            }
        }
    }
    Ok(Components { of, count })
}

/// Which components stay, and the region of each.
#[derive(Debug, Default)]
pub struct Domain {
    /// Region of each component; NONE if carved.
    pub of_component: Vec<u32>,
    /// The regions.
    pub regions: Vec<Region>,
    /// Hole seeds that carve nothing, since they lie outside.
    pub holes_outside: Vec<u32>,
    /// Region seeds in a region that already has a seed, each with that seed.
    pub repeated_seeds: Vec<[u32; 2]>,
}

/// The caller's seeds.
pub struct Seeds<'a> {
    /// Hole seeds.
    pub holes: &'a [[f64; 3]],
    /// Region seeds.
    pub regions: &'a [RegionSeed],
    /// The coordinates of the mesh are the caller's times two to this power.
    pub exponent: i32,
}

impl Seeds<'_> {
    /// The components of all seeds: the holes, then the regions. Fails if one lies on a facet.
    fn locate(
        &self,
        mesh: &Mesh,
        points: &mut Points,
        components: &Components,
        control: &Control,
    ) -> Result<Vec<Option<u32>>, Error> {
        let (count, holes) = (self.holes.len() + self.regions.len(), self.holes.len());
        let mut all = fallible::reserved(count)?;
        fallible::append(&mut all, self.holes)?;
        fallible::extend(&mut all, self.regions.iter().map(|seed| seed.point))?;
        let mut component = fallible::reserved(count)?;
        for (i, place) in
            locate(mesh, points, components, &all, self.exponent, control)?.into_iter().enumerate()
        {
            let element = match i.checked_sub(holes) {
                None => Element::Hole(i as u32),
                Some(region) => Element::Region(region as u32),
            };
            let inside = match place {
                Place::Outside => None,
                Place::In(component) => Some(component),
                Place::OnFacet => {
                    return Err(seed_error(
                        DefectKind::SeedOnFacet,
                        element,
                        all[i],
                        Message::from(format_args!("{element} lies exactly on a facet")),
                    ));
                }
            };
            fallible::push(&mut component, inside)?;
        }
        Ok(component)
    }
}

fn seed_error(kind: DefectKind, element: Element, at: [f64; 3], message: Message) -> Error {
    let defect = Defect { kind, first: element, second: None, point: Some(at) };
    Error::with_defect(Status::SeedOutside, message, defect)
}

/// Decides what is carved and labels the rest. Fails if nothing is left, a seed is on a facet, or a region seed is outside.
pub fn label(
    mesh: &Mesh,
    points: &mut Points,
    components: &Components,
    seeds: &Seeds,
    keep_hull: bool,
    control: &Control,
) -> Result<Domain, Error> {
    let count = components.count as usize;
    let mut carved = fallible::filled(false, count)?;
    carved[0] = !keep_hull;
    let component_of = seeds.locate(mesh, points, components, control)?;
    let (of_holes, of_seeds) = component_of.split_at(seeds.holes.len());
    let mut found = Domain::default();
    for (i, component) in (0..).zip(of_holes) {
        match component {
            Some(component) if *component != 0 || keep_hull => carved[*component as usize] = true,
            _ => {
                fallible::push(&mut found.holes_outside, i)?;
            }
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
    let Domain { of_component, regions, repeated_seeds, .. } = &mut found;
    of_component.try_reserve_exact(count)?;
    fallible::resize(of_component, count, NONE)?;
    regions.try_reserve(seeds.regions.len())?;
    for ((i, seed), component) in (0..).zip(seeds.regions).zip(of_seeds) {
        let element = Element::Region(i);
        let Some(component) = component.filter(|&c| !carved[c as usize]) else {
            return Err(seed_error(
                DefectKind::SeedOutside,
                element,
                seed.point,
                Message::from(format_args!("{element} lies outside the domain")),
            ));
        };
        match of_component[component as usize] {
            NONE => {
                of_component[component as usize] = regions.len() as u32;
                let region = Region { attribute: seed.attribute, seed: i, max_volume: seed.max_volume };
                fallible::push(regions, region)?;
            }
            first => fallible::push(repeated_seeds, [i, regions[first as usize].seed])?,
        }
    }
    number_unseeded(mesh, components, &carved, seeds.regions, &mut found)?;
    Ok(found)
}

/// Gives every remaining component its own region, with the smallest attributes 1, 2, … that no seed has.
fn number_unseeded(
    mesh: &Mesh,
    components: &Components,
    carved: &[bool],
    seeds: &[RegionSeed],
    found: &mut Domain,
) -> Result<(), Error> {
    let mut used: Vec<f64> = fallible::reserved(seeds.len())?;
    fallible::extend(&mut used, seeds.iter().map(|seed| seed.attribute).filter(|&a| a >= 1.0))?;
    used.sort_unstable_by(f64::total_cmp);
    let mut used = used.into_iter().peekable();
    let mut next = 0.0;
    for t in 0..mesh.slot_count() as u32 {
        if !mesh.is_live(t) || mesh.is_ghost(t) {
            continue;
        }
        let c = components.of[t as usize] as usize;
        if carved[c] || found.of_component[c] != NONE {
            continue;
        }
        next += 1.0;
        while let Some(attribute) = used.next_if(|&a| a <= next) {
            next += f64::from(attribute == next);
        }
        found.of_component[c] = found.regions.len() as u32;
        fallible::push(&mut found.regions, Region { attribute: next, seed: NONE, max_volume: None })?;
    }
    Ok(())
}
