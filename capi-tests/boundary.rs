//! The cost of the C API compared with the Rust API, on a mesh of a million tetrahedra (in debug builds a small one, without timing): the
//! same bytes, one copy of the input, none of the output. `cargo test --release --test boundary -- --nocapture` prints figures.
#![cfg(unix)]
#![allow(unsafe_code)]
use delotet::ffi::{mesh, options, plc, run, status::DelotetStatus};
use delotet::{Mode, Options, Plc, Silent, TetMesh};
use std::ptr::{null_mut, slice_from_raw_parts};

/// What this thread has worked, in seconds: other load does not count.
fn worked() -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the structure is ours.
    assert_eq!(unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut time) }, 0);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// In the unit cube, the same in every run.
fn points(count: usize) -> Vec<[f64; 3]> {
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..count).map(|_| [next(), next(), next()]).collect()
}

/// The caller's work in Rust: from an array to arrays.
fn through_rust(points: &[[f64; 3]]) -> TetMesh {
    let plc = Plc { points: points.to_vec(), ..Plc::default() };
    let options = Options { mode: Mode::Delaunay, ..Options::default() };
    delotet::tetrahedralize(&plc, &options, &mut Silent).expect("a mesh")
}

/// The same through C; the mesh is the caller's.
fn through_c(points: &[[f64; 3]]) -> *mut mesh::DelotetMesh {
    let (mut plc, mut mesh) = (null_mut(), null_mut());
    // SAFETY: the array has that many rows, the out-parameters are valid, and every handle is freed once.
    unsafe {
        assert_eq!(
            plc::delotet_plc_new(points.as_ptr().cast(), points.len(), &mut plc, null_mut()),
            DelotetStatus::Ok
        );
        let options = options::delotet_options_new();
        assert_eq!(
            options::delotet_options_set_mode(options, options::DELOTET_MODE_DELAUNAY, null_mut()),
            DelotetStatus::Ok
        );
        assert_eq!(run::delotet_tetrahedralize(plc, options, &mut mesh, null_mut()), DelotetStatus::Ok);
        plc::delotet_plc_free(plc);
        options::delotet_options_free(options);
    }
    mesh
}

#[test]
fn the_boundary_is_thin() {
    let points = points(if cfg!(debug_assertions) { 2_000 } else { 150_000 });
    let (mut rust, mut c) = (f64::INFINITY, f64::INFINITY);
    // At least some turns, and more while other load hides that the bound holds.
    for turn in 0..if cfg!(debug_assertions) { 1 } else { 20 } {
        if turn >= 5 && c < 1.15 * rust {
            break;
        }
        let start = worked();
        let by_rust = through_rust(&points);
        rust = rust.min(worked() - start);
        let start = worked();
        let by_c = through_c(&points);
        c = c.min(worked() - start);
        // SAFETY: the mesh is alive until it is freed, and its views are as long as they say.
        unsafe {
            let start = worked();
            let tets = mesh::delotet_mesh_tets(by_c);
            let views = worked() - start;
            let list = &*slice_from_raw_parts(tets.data.cast::<[u32; 4]>(), tets.count);
            assert!(list == by_rust.tets);
            assert_eq!(mesh::delotet_mesh_tets(by_c).data, tets.data);
            println!("{} tetrahedra: Rust {rust:.3} s, C {c:.3} s, a view {views:.9} s", tets.count);
            mesh::delotet_mesh_free(by_c);
        }
    }
    println!("C / Rust = {:.4}", c / rust);
    // The aim is 1.02; the bound leaves room for a busy machine.
    assert!(cfg!(debug_assertions) || c < 1.15 * rust);
}
