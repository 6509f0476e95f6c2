//! The error for places where doubles are too coarse: it names the elements that are too close together.
use crate::control::Control;
use crate::error::{Defect, DefectKind, Element, Error, Message, Status};
use crate::fallible;
use crate::plc::near::Home;
use crate::plc::surface::Surface;
use crate::predicates::scale;

/// The error that names what the places belong to and what is nearest to it, with `hint` at the end of its message. Places are in the
/// surface's coordinates.
pub(super) fn crowding(
    surface: &Surface,
    places: &[(Home, [f64; 3])],
    hint: &str,
    max_defects: usize,
    control: &Control,
) -> Error {
    let mut defects: Vec<Defect> = Vec::new();
    for &(home, at) in places {
        if defects.len() == max_defects.max(1) {
            break;
        }
        let first = match home {
            Home::Edge(ends) => surface.element_of_edge(ends),
            Home::Facet(facet) => Element::Facet(facet),
        };
        let second = match surface.nearest_element(&at, home, control) {
            Ok(second) => second,
            Err(ended) => return ended,
        };
        if defects.iter().any(|old| (old.first, old.second) == (first, second)) {
            continue;
        }
        let point = Some(at.map(|x| scale(x, -surface.scale)));
        if let Err(short) =
            fallible::push(&mut defects, Defect { kind: DefectKind::Rounding, first, second, point })
        {
            return Error::from(short);
        }
    }
    let count = defects.len();
    let message = match defects.first() {
        Some(Defect { first, second: Some(second), .. }) => Message::from(format_args!(
            "{first} and {second} are too close to each other: a point is needed between them and has no position in doubles{hint}"
        )),
        _ => Message::from(format_args!("a point is needed and has no position in doubles{hint}")),
    };
    defects.truncate(max_defects);
    Error::with_defects(Status::Rounding, message, defects, count)
}
