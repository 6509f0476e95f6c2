//! Every way in which a run ends, and progress that never falls.
use super::*;
use crate::options::{Mode, Options};
use crate::{tetrahedralize, Plc};

/// Records everything reported, and checks it.
#[derive(Default)]
struct Witness(Vec<(Phase, f64)>);

impl Observer for Witness {
    fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
        assert!((0.0..=1.0).contains(&fraction));
        if let Some(&(last, reached)) = self.0.last() {
            assert!(phase.place() >= last.place(), "{last:?}, then {phase:?}");
            assert!(phase != last || fraction >= reached, "{phase:?} falls to {fraction}");
            assert!(phase == last || reached == 1.0, "{last:?} ends at {reached}");
            assert!(phase.overall(fraction) >= last.overall(reached));
        }
        self.0.push((phase, fraction));
        ControlFlow::Continue(())
    }
}

#[test]
fn work_that_is_done_again_shows_as_no_progress() {
    let mut witness = Witness::default();
    controlled(Limits::default(), &mut witness, |control| {
        for (phase, fraction) in [
            (Phase::Validate, 0.0),
            (Phase::Delaunay, 0.5),
            (Phase::Validate, 1.0),
            (Phase::Delaunay, 0.25),
            (Phase::Segments, 0.75),
            (Phase::Delaunay, 1.0),
            (Phase::Round, 0.5),
            (Phase::Preserve, 0.1),
            (Phase::Audit, 1.0),
        ] {
            control.progress(phase, fraction).unwrap();
        }
    });
    assert_eq!(witness.0.first(), Some(&(Phase::Validate, 0.0)));
    assert_eq!(witness.0.last(), Some(&(Phase::Audit, 1.0)));
    let phases: std::collections::BTreeSet<Phase> = witness.0.iter().map(|seen| seen.0).collect();
    assert_eq!(phases.len(), 5, "preserve comes too late and is not seen");
}

/// Every mode, with merging, over models that need several attempts and those that need none.
#[test]
fn phases_come_in_order_and_fractions_never_fall_on_every_path() {
    let points = vec![
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 4.0, 0.0],
        [4.0, 4.0, 0.5],
        [0.0, 0.0, 4.0],
        [4.0, 0.0, 4.0],
        [0.0, 4.0, 4.0],
        [4.0, 4.0, 3.0],
        [1.0, 1.9, 2.0],
        [3.0, 2.0, 2.1],
    ];
    let triangles = vec![
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    let segments = vec![crate::Segment { ends: [8, 9], marker: 1 }];
    let plc = Plc { points, triangles, segments, ..Plc::default() };
    for mode in [Mode::Delaunay, Mode::Constrained, Mode::Preserve] {
        for merge_facets in [None, Some(170.0)] {
            let options = Options { mode, merge_facets, ..Options::default() };
            let mut witness = Witness::default();
            tetrahedralize(&plc, &options, &mut witness).unwrap();
            assert_eq!(witness.0.last(), Some(&(Phase::Audit, 1.0)), "{mode:?}");
            assert!(witness.0.iter().any(|seen| seen.0 == Phase::Delaunay));
            let preserve = witness.0.iter().any(|seen| seen.0 == Phase::Preserve);
            assert_eq!(preserve, mode == Mode::Preserve);
        }
    }
}

/// Steps until something ends the run.
fn work(control: &Control) -> Error {
    loop {
        if let Err(error) = control.step() {
            return error;
        }
    }
}

#[test]
fn a_token_cancels_from_another_thread() {
    let token = CancelToken::new();
    let other = token.clone();
    assert!(token == other && token != CancelToken::new());
    let limits = Limits { cancel: Some(token.flag()), ..Limits::default() };
    std::thread::scope(|scope| {
        controlled(limits, &mut Silent, |control| {
            control.look().unwrap();
            scope.spawn(|| other.cancel());
            assert_eq!(work(control).status, Status::Cancelled);
            token.reset();
            // The run has seen it.
            assert_eq!(control.look().unwrap_err().status, Status::Cancelled);
        });
    });
    assert!(!other.is_cancelled());
    controlled(limits, &mut Silent, |control| control.look().unwrap());
}

#[test]
fn time_ends_the_run_and_the_message_says_where() {
    // On a busy machine the time may be over before the stage begins: then with twice as much.
    let mut milliseconds = 32;
    let begun = |milliseconds| {
        let limits = Limits { time: Some(Duration::from_millis(milliseconds)), ..Limits::default() };
        controlled(limits, &mut Silent, |control| {
            if control.progress(Phase::Facets, 0.5).is_err() {
                return false;
            }
            let error = work(control);
            assert_eq!(error.status, Status::TimeLimit);
            let limit = format!("{} s", milliseconds as f64 / 1e3);
            assert!(error.message.contains(&limit) && error.message.contains("facets"), "{error}");
            assert_eq!(control.progress(Phase::Audit, 0.0).unwrap_err().status, Status::TimeLimit);
            true
        })
    };
    while !begun(milliseconds) {
        milliseconds *= 2;
    }
}

#[test]
fn memory_is_refused_before_it_is_taken() {
    // Far more than tests that run beside this one take.
    let limits = Limits { memory: Some(1 << 40), ..Limits::default() };
    controlled(limits, &mut Silent, |control| {
        control.room(10 << 20).unwrap();
        let error = control.room(1 << 41).unwrap_err();
        assert_eq!(error.status, Status::MemoryLimit);
        assert!(error.message.contains("1099511.6 MB"), "{error}");
        assert_eq!(control.look().unwrap_err().status, Status::MemoryLimit);
    });
    controlled(Limits::default(), &mut Silent, |control| control.room(usize::MAX).unwrap());
}

/// Other tests take and give back memory meanwhile, so the limit may come early or late.
#[cfg(target_os = "linux")]
#[test]
fn memory_that_was_taken_ends_the_run() {
    let limits = Limits { memory: Some(64 << 20), ..Limits::default() };
    controlled(limits, &mut Silent, |control| {
        let mut taken: Vec<Vec<u8>> = Vec::new();
        let error = loop {
            match control.look() {
                Ok(()) => taken.push(vec![1; 1 << 20]),
                Err(error) => break error,
            }
            // As long as reading the size may be put off.
            std::thread::sleep(Duration::from_millis(2));
            assert!(taken.len() < 4096, "{} MB taken", taken.len());
        };
        assert_eq!(error.status, Status::MemoryLimit, "{error}");
    });
}

/// Without a system that tells, the tables count.
#[test]
fn tables_count_where_the_system_tells_nothing() {
    let memory = Memory::default();
    memory.tables(1000);
    assert_eq!(memory.growth(Duration::ZERO, true), 1000);
}

#[test]
fn steiner_points_and_tetrahedra_have_limits_of_their_own() {
    let limits = Limits { steiner: Some(7), ..Limits::default() };
    controlled(limits, &mut Silent, |control| {
        control.steiner(7, 0).unwrap();
        let error = control.steiner(8, 1 << 20).unwrap_err();
        assert_eq!(error.status, Status::SteinerLimit);
        assert!(error.message.contains("limit of 7 Steiner points"), "{error}");
        // Another way to the mesh may take fewer.
        control.look().unwrap();
    });
    let limits = Limits { tetrahedra: Some(7), ..Limits::default() };
    controlled(limits, &mut Silent, |control| {
        control.tetrahedra(7).unwrap();
        let error = control.tetrahedra(8).unwrap_err();
        assert_eq!(error.status, Status::TetrahedraLimit);
        assert!(error.message.contains("limit of 7 tetrahedra was reached in phase start"), "{error}");
    });
    Control::free().tetrahedra(usize::MAX).unwrap();
    Control::free().steiner(100_000, 0).unwrap();
    assert_eq!(Control::free().steiner(100_201, 2).unwrap_err().status, Status::SteinerLimit);
}

/// While a stage only steps, the observer is called again, and its `Break` counts.
#[test]
fn the_observer_is_called_while_no_progress_is_made() {
    struct Patient(u32);
    impl Observer for Patient {
        fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
            assert_eq!((phase, fraction), (Phase::Round, 0.25));
            self.0 -= 1;
            if self.0 == 0 {
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        }
    }
    let mut patient = Patient(4);
    controlled(Limits::default(), &mut patient, |control| {
        control.progress(Phase::Round, 0.25).unwrap();
        assert_eq!(work(control).status, Status::Cancelled);
    });
    assert_eq!(patient.0, 0);
}

#[test]
fn parts_of_parts_are_where_they_should_be() {
    let mut witness = Witness::default();
    controlled(Limits::default(), &mut witness, |control| {
        let second = control.whole(Phase::Validate).part(0.5, 1.0);
        second.part(0.0, 0.5).progress(0.5).unwrap();
        second.part(0.5, 1.0).progress(2.0).unwrap();
        second.step().unwrap();
    });
    // The heartbeat may say the same again.
    witness.0.dedup();
    assert_eq!(witness.0, [(Phase::Validate, 0.625), (Phase::Validate, 1.0)]);
}

#[test]
fn what_is_muted_is_neither_seen_nor_heard_but_can_be_ended() {
    struct Deaf(Vec<(Phase, f64)>);
    impl Observer for Deaf {
        fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
            self.0.push((phase, fraction));
            ControlFlow::Continue(())
        }
        fn log(&mut self, message: &str) {
            assert_eq!(message, "said");
        }
    }
    let token = CancelToken::new();
    let mut deaf = Deaf(Vec::new());
    controlled(Limits { cancel: Some(token.flag()), ..Limits::default() }, &mut deaf, |control| {
        control.progress(Phase::Preserve, 0.5).unwrap();
        control.muted(|| {
            control.progress(Phase::Audit, 1.0).unwrap();
            control.log("not said");
            token.cancel();
            assert_eq!(control.progress(Phase::Audit, 1.0).unwrap_err().status, Status::Cancelled);
        });
        control.log("said");
    });
    assert_eq!(deaf.0, [(Phase::Preserve, 0.5); 2]);
}

#[test]
fn long_lists_are_sorted_in_parts_that_may_be_ended() {
    let mut list: Vec<u32> = (0..700_000u32).map(|i| i.wrapping_mul(2_654_435_769) >> 12).collect();
    let (mut by, mut expected) = (list.clone(), list.clone());
    expected.sort_unstable();
    Control::free().sort(&mut list).unwrap();
    assert!(list == expected);
    Control::free().sort_by(&mut by, |x, y| y.cmp(x)).unwrap();
    expected.reverse();
    assert!(by == expected);
    let token = CancelToken::new();
    token.cancel();
    let limits = Limits { cancel: Some(token.flag()), ..Limits::default() };
    let ended = controlled(limits, &mut Silent, |control| control.sort(&mut list));
    assert_eq!(ended.unwrap_err().status, Status::Cancelled);
}

#[test]
fn an_ended_run_ends_at_the_next_step_even_if_the_error_was_not_heeded() {
    let token = CancelToken::new();
    let limits = Limits { cancel: Some(token.flag()), ..Limits::default() };
    controlled(limits, &mut Silent, |control| {
        control.step().unwrap();
        token.cancel();
        assert!(control.look().is_err());
        token.reset();
        assert_eq!(control.step().unwrap_err().status, Status::Cancelled);
        assert!(control.steps(1).is_err());
    });
}
