//! Where Steiner points are put on segments.
use crate::control::Control;
use crate::predicates::{Expansion, Points};
use crate::segments::placement::{round_parameter, OwnSegment};

#[test]
fn parameters_keep_to_the_exact_grid_where_it_is_fine() {
    // 2^-30 is far below the piece: the parameter is a multiple of it. 2^-3 is not: it is rounded elsewhere.
    let t = round_parameter(1.0 / 3.0, 0.0, 1.0, 30).unwrap();
    assert_eq!((t * (1u64 << 30) as f64).fract(), 0.0);
    let t = round_parameter(1.0 / 3.0, 0.0, 1.0, 3).unwrap();
    assert_ne!((t * 8.0).fract(), 0.0);
    assert!((t - 1.0 / 3.0).abs() < 1e-9);
    // There is no double between neighbours.
    assert_eq!(round_parameter(0.5, 0.5, 0.5f64.next_up(), 0), None);
}

#[test]
fn steiner_points_move_to_other_lists_of_segments() {
    use crate::segments::recovery::Segments;
    let mut points = Points::new(vec![[0.0; 3], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0], [0.0, 0.0, 8.0]]);
    let mut old = Segments::new(&points, vec![[0, 1], [2, 3], [1, 2]], &Control::free()).unwrap();
    for (segment, ends, t) in [(0, [0, 1], 0.5), (2, [1, 2], 0.25), (0, [0, 1], 0.25)] {
        points.push_on_segment(ends[0], ends[1], &Expansion::from(t)).unwrap();
        old.steiner_segment.push(segment);
        old.steiner_t.push(t);
    }
    let new = old.exchange(&points, vec![[1, 2], [0, 3], [0, 1]], &Control::free()).unwrap();
    assert_eq!(new.first_steiner, 4);
    assert_eq!(new.steiner_segment, [2, 0, 2]);
    let mut pieces: Vec<_> = new.pieces.iter().map(|p| (p.segment, p.ends, p.t)).collect();
    pieces.sort_by(|x, y| x.0.cmp(&y.0).then(x.2[0].total_cmp(&y.2[0])));
    let expected = [
        (0, [1, 5], [0.0, 0.25]),
        (0, [5, 2], [0.25, 1.0]),
        (1, [0, 3], [0.0, 1.0]),
        (2, [0, 6], [0.0, 0.25]),
        (2, [6, 4], [0.25, 0.5]),
        (2, [4, 1], [0.5, 1.0]),
    ];
    assert_eq!(pieces, expected);
    for (id, piece) in (0..).zip(&new.pieces) {
        let [a, b] = piece.ends;
        assert_eq!(new.piece_of[&[a.min(b), a.max(b)]], id);
    }
    assert_eq!(new.piece_of.len(), 6);
    // A segment with points must stay.
    assert!(new.exchange(&points, vec![[1, 2], [0, 3]], &Control::free()).is_err());
}

/// Equal radii around a common vertex are kept even very near the end of a piece, since otherwise strips of slivers get row after row of
/// Steiner points; the foot of a perpendicular there is not, since otherwise the piece is split again and again.
#[test]
fn radii_are_kept_where_feet_are_not() {
    use crate::segments::placement::{choose, Context, Subsegment};
    let points = Points::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.001, 1e-5, 0.0], [0.25, 1e-3, 0.0]]);
    let sub = Subsegment { segment: 0, ends: [0, 1], t: [0.0, 1.0] };
    let split = |own, reference| {
        choose(&points, &sub, &Context { ends: [0, 1], acute: [false; 2], own }, Some(reference))
    };
    assert!((split(OwnSegment::Shares(0), 2) - 0.001).abs() < 1e-6);
    assert_eq!(split(OwnSegment::Unknown, 2), 0.5);
    assert!((split(OwnSegment::Shares(1), 3) - 0.25).abs() < 1e-5);
    assert_eq!(split(OwnSegment::Unknown, 3), 0.25);
}

/// Two segments an ulp apart whose lines are nearest to each other at the middle of both, turned by 2 arctan(k/8).
fn nearly_crossing(k: i32, apart: f64) -> (Points, [u32; 2], [u32; 2]) {
    // Rational directions of equal length, since 64 − k² and 16 k are legs of 64 + k².
    let [c, s] = [f64::from(64 - k * k), f64::from(16 * k)];
    let length = f64::from(64 + k * k);
    let ends = [[-length, 0.0, 0.0], [length, 0.0, 0.0], [-c, -s, apart], [c, s, apart]];
    (Points::new(ends.to_vec()), [0, 1], [2, 3])
}

/// The two then are in no diametric ball of the other's pieces, and stop splitting each other.
#[test]
fn segments_without_a_common_end_are_split_at_equal_distances() {
    use crate::segments::close::Beside;
    use crate::segments::placement::{choose, Context, Subsegment};
    for k in 1..8 {
        let (mut points, ends, other) = nearly_crossing(k, f64::EPSILON);
        for x in [-0.25, -0.125, 0.0625, 0.25] {
            let p = points.push_on_segment(other[0], other[1], &Expansion::from(0.5 + x)).unwrap();
            let sub = Subsegment { segment: 0, ends, t: [0.0, 1.0] };
            let own = OwnSegment::Apart(other);
            let t = choose(&points, &sub, &Context { ends, acute: [false; 2], own }, Some(p));
            assert!((t - 0.5 - x).abs() < 1e-12, "{k} {x} {t}");
            // Precisely: where they all but cross, as long as that is inside the piece; then at equal distances.
            let [from, to] = if x < 0.0 { [0.0, 0.5] } else { [0.5, 1.0] };
            let mut beside = Beside { ends, t: [0.0, 1.0].map(Expansion::from), reference: p, own };
            assert_eq!(beside.matched(&points).unwrap().nearest(), 0.5);
            beside.t = [from, to].map(Expansion::from);
            let t = beside.matched(&points).unwrap();
            let apart = t.difference(&Expansion::from(0.5 + x)).approximate();
            assert!(apart.abs() < 1e-24, "{k} {x} {apart}");
        }
    }
}

/// Where the plane of equal distances misses the piece, the piece is split where the lines are nearest to each other.
#[test]
fn a_piece_is_split_where_it_all_but_crosses_another() {
    use crate::segments::placement::{choose, Context, Subsegment};
    let (mut points, ends, other) = nearly_crossing(2, 1e-3);
    let p = points.push_on_segment(other[0], other[1], &Expansion::from(0.25)).unwrap();
    let sub = Subsegment { segment: 0, ends, t: [0.25, 1.0] };
    let context = Context { ends, acute: [false; 2], own: OwnSegment::Apart(other) };
    let t = choose(&points, &sub, &context, Some(p));
    assert!((t - 0.5).abs() < 1e-12, "{t}");
    // Parallel ones are nowhere nearest: the foot of the perpendicular.
    let points =
        Points::new(vec![[0.0; 3], [4.0, 0.0, 0.0], [0.0, 1.0, 0.0], [4.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    let context = Context { ends: [0, 1], acute: [false; 2], own: OwnSegment::Apart([3, 2]) };
    let sub = Subsegment { segment: 0, ends: [0, 1], t: [0.0, 1.0] };
    assert_eq!(choose(&points, &sub, &context, Some(4)), 0.25);
}
