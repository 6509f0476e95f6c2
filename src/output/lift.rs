//! Weights of points.
use crate::error::Error;
use crate::fallible;

/// Weights of points: what makes a Delaunay tetrahedralization a weighted (regular) one, and a Voronoi diagram a power diagram.
///
/// A point p with weight w is a sphere of squared radius w; of two points the one with the smaller power distance `|x − p|² − w` is the
/// nearer one to x. Its lift, in a fourth coordinate, has the height `|p|² − w`; the tetrahedralization is the lower hull of the lifts.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Lift {
    /// No weights: the height is `|p|²`.
    #[default]
    Plain,
    /// A weight per point, of any sign, in the square of the unit of coordinates.
    Weights(Vec<f64>),
    /// The height of each lift itself, which stands for the weight `|p|²` minus it, exactly.
    Heights(Vec<f64>),
}

impl Lift {
    /// The weights or heights, one per point; empty without.
    pub fn values(&self) -> &[f64] {
        match self {
            Lift::Plain => &[],
            Lift::Weights(values) | Lift::Heights(values) => values,
        }
    }

    /// Whether there are none.
    pub fn is_plain(&self) -> bool {
        matches!(self, Lift::Plain)
    }

    /// The same list, to be changed.
    pub(crate) fn values_mut(&mut self) -> Option<&mut Vec<f64>> {
        match self {
            Lift::Plain => None,
            Lift::Weights(values) | Lift::Heights(values) => Some(values),
        }
    }

    /// Gives the first of equal points the value that counts; `alias` has for each point the first equal one.
    pub(crate) fn merge(&mut self, alias: &[u32]) {
        let is_height = matches!(self, Lift::Heights(_));
        let Some(values) = self.values_mut() else { return };
        for (i, &first) in alias.iter().enumerate() {
            let (value, counts) = (values[i], values[first as usize]);
            if (is_height && value < counts) || (!is_height && value > counts) {
                values[first as usize] = value;
            }
        }
    }

    /// What the lift of a point has beside the square of its distance from the origin (with weights), or instead of it.
    pub(crate) fn offset(&self, value: f64) -> f64 {
        match self {
            Lift::Weights(_) => -value,
            Lift::Plain | Lift::Heights(_) => value,
        }
    }

    /// A copy; unlike `clone` it returns an error if memory runs out.
    pub(crate) fn try_clone(&self) -> Result<Lift, Error> {
        Ok(match self {
            Lift::Plain => Lift::Plain,
            Lift::Weights(values) => Lift::Weights(fallible::copied(values)?),
            Lift::Heights(values) => Lift::Heights(fallible::copied(values)?),
        })
    }
}
