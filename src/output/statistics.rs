//! Counts of what filling, refinement and optimisation did. They depend on the input and the options alone.

/// Counts of what it took to fill and refine a mesh ([`Options::size`](crate::Options::size), [`quality`](crate::Options::quality) and so on);
/// all zero if nothing was. The points on segments, on facets and inside are those for sizes and those for shapes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RefineStatistics {
    /// Points that came on segments and facet edges.
    pub on_segments: u64,
    /// Points that came on facets.
    pub on_facets: u64,
    /// Points that came inside.
    pub inside: u64,
    /// Points that came for a length, an area or a volume.
    pub for_sizes: u64,
    /// Points that came for a radius-edge ratio.
    pub for_shapes: u64,
    /// Places refused since a vertex was too near.
    pub too_near: u64,
    /// Places refused since the tetrahedron between them and a wall would have been too flat (filling alone).
    pub too_flat: u64,
    /// Places put off since they were in the sphere of a piece of the surface, which came first (refinement of surfaces alone).
    pub encroaching: u64,
    /// Places refused since a piece of the surface was in the way.
    pub blocked: u64,
    /// Places refused for other reasons: out of range, not found, on an edge or face that they may not be on, where the surface stays as it
    /// is, or known to be refused.
    pub elsewhere: u64,
    /// Tetrahedra and pieces of facets above the ratio that were left since no more points may come for shapes: 0 if these were enough.
    pub over_budget: u64,
}

impl RefineStatistics {
    /// The number of points that came.
    pub fn points(&self) -> u64 {
        self.on_segments + self.on_facets + self.inside
    }

    /// Adds what another part of the run did.
    pub(crate) fn add(&mut self, other: &RefineStatistics) {
        // By name, so that a new field cannot be forgotten here.
        let RefineStatistics {
            on_segments,
            on_facets,
            inside,
            for_sizes,
            for_shapes,
            too_near,
            too_flat,
            encroaching,
            blocked,
            elsewhere,
            over_budget,
        } = other;
        self.on_segments += on_segments;
        self.on_facets += on_facets;
        self.inside += inside;
        self.for_sizes += for_sizes;
        self.for_shapes += for_shapes;
        self.too_near += too_near;
        self.too_flat += too_flat;
        self.encroaching += encroaching;
        self.blocked += blocked;
        self.elsewhere += elsewhere;
        self.over_budget += over_budget;
    }

    /// Counts a point for a size, or for a shape.
    pub(crate) fn came(&mut self, for_size: bool) {
        match for_size {
            true => self.for_sizes += 1,
            false => self.for_shapes += 1,
        }
    }
}

/// Counts of what optimisation did ([`Options::optimize`](crate::Options::optimize) and so on); all zero if there was none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OptimizeStatistics {
    /// Passes over the bad tetrahedra.
    pub passes: u64,
    /// Moves of points; one may move more than once.
    pub moves: u64,
    /// Edges removed.
    pub edges_removed: u64,
    /// Removals of faces, of one or more at a time.
    pub faces_removed: u64,
    /// Cavities filled anew.
    pub reconnected: u64,
    /// Points that came.
    pub points_added: u64,
    /// Points that went into a neighbour.
    pub points_removed: u64,
    /// The worst dihedral angle before, in degrees: the least of all angles, and of what is missing of them to 180°.
    pub worst_before: f64,
    /// The same after it.
    pub worst_after: f64,
}

impl OptimizeStatistics {
    /// Adds what was done in another part of the mesh.
    pub(crate) fn add(&mut self, other: &OptimizeStatistics) {
        let least = |x: f64, y: f64| if self.passes == 0 || y < x { y } else { x };
        let (before, after) =
            (least(self.worst_before, other.worst_before), least(self.worst_after, other.worst_after));
        if other.passes > 0 {
            (self.worst_before, self.worst_after) = (before, after);
        }
        let OptimizeStatistics {
            passes,
            moves,
            edges_removed,
            faces_removed,
            reconnected,
            points_added,
            points_removed,
            worst_before: _,
            worst_after: _,
        } = other;
        self.passes += passes;
        self.moves += moves;
        self.edges_removed += edges_removed;
        self.faces_removed += faces_removed;
        self.reconnected += reconnected;
        self.points_added += points_added;
        self.points_removed += points_removed;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_add_up() {
        let part = OptimizeStatistics {
            passes: 2,
            moves: 5,
            worst_before: 3.0,
            worst_after: 10.0,
            ..OptimizeStatistics::default()
        };
        let other = OptimizeStatistics { worst_before: 4.0, worst_after: 9.0, points_added: 1, ..part };
        let mut sum = OptimizeStatistics::default();
        sum.add(&part);
        assert_eq!(sum, part);
        sum.add(&other);
        assert_eq!((sum.passes, sum.moves, sum.points_added), (4, 10, 1));
        assert_eq!((sum.worst_before, sum.worst_after), (3.0, 9.0));
        let known = sum;
        sum.add(&OptimizeStatistics::default());
        assert_eq!(sum, known);
        let one = RefineStatistics { inside: 2, for_sizes: 1, for_shapes: 1, ..RefineStatistics::default() };
        let mut sum = one;
        sum.add(&one);
        sum.came(true);
        assert_eq!((sum.points(), sum.for_sizes, sum.for_shapes), (4, 3, 2));
    }
}
