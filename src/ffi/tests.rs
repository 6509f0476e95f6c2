//! Tests of what C tests cannot reach: panics inside the guard, misaligned arrays, handles made from hand-built meshes.
use crate::error::{Defect, DefectKind, Element, Error, Status};
use crate::ffi::error::*;
use crate::ffi::guard::guard;
use crate::ffi::mesh::*;
use crate::ffi::options::{delotet_options_free, delotet_options_new, with_settings};
use crate::ffi::query::*;
use crate::ffi::sizes::delotet_options_set_size_function;
use crate::ffi::slice::{array, optional};
use crate::ffi::status::DelotetStatus;
use crate::query::tests::grid;
use crate::query::PointData;
use libc::c_void;
use std::ffi::CStr;
use std::ptr::{null, null_mut};

fn message(error: *const DelotetError) -> String {
    // SAFETY: the error is alive, its message ends with a zero byte.
    unsafe { CStr::from_ptr(delotet_error_message(error)) }.to_string_lossy().into_owned()
}

#[test]
fn a_panic_becomes_a_status_with_text_and_place() {
    let mut error = null_mut();
    // SAFETY: `error` is valid for a write.
    let status = unsafe { guard(&mut error, || panic!("corner {} is missing", 7)) };
    assert_eq!(status, DelotetStatus::Internal);
    let text = message(error);
    assert!(text.contains("corner 7 is missing") && text.contains("tests.rs"), "{text}");
    // SAFETY: the error is ours.
    unsafe { delotet_error_free(error) };
}

#[test]
fn panics_outside_of_calls_still_reach_the_previous_hook() {
    // SAFETY: null is allowed. This installs the hook of the guard over whatever is there.
    unsafe { guard(null_mut(), || Ok(())) };
    let result = std::panic::catch_unwind(|| panic!("outside"));
    assert_eq!(result.unwrap_err().downcast_ref::<&str>(), Some(&"outside"));
}

#[test]
fn defects_cross_with_all_their_parts() {
    let defect =
        |second, point| Defect { kind: DefectKind::FacetFacet, first: Element::Facet(3), second, point };
    let defects = vec![defect(Some(Element::Segment(9)), Some([1.0, 2.0, 3.0])), defect(None, None)];
    let mut error = null_mut();
    let failure =
        Error { status: Status::SelfIntersection, message: "two\0parts".into(), defects, defect_count: 12 };
    // SAFETY: `error` is valid for a write, and alive until it is freed.
    unsafe {
        assert_eq!(guard(&mut error, || Err(failure)), DelotetStatus::SelfIntersection);
        assert_eq!(delotet_error_status(error), DelotetStatus::SelfIntersection);
        assert_eq!(delotet_error_defect_count(error), 12);
        assert_eq!(message(error), "two parts");
        let view = delotet_error_defects(error);
        assert_eq!(view.stride, size_of::<DelotetDefect>());
        let defects = std::slice::from_raw_parts(view.first, view.count);
        assert_eq!(defects.len(), 2);
        assert_eq!((defects[0].first, defects[0].second, defects[0].has_point), (3, 9, 1));
        assert_eq!(defects[0].point, [1.0, 2.0, 3.0]);
        assert_eq!((defects[1].second, defects[1].has_point), (crate::INVALID, 0));
        delotet_error_free(error);
    }
}

#[test]
fn arrays_are_checked_before_use() {
    let data = [1.0f64, 2.0, 3.0];
    // SAFETY: null or misaligned pointers and impossible counts are refused before any read.
    unsafe {
        assert_eq!(array::<f64>(null(), 0, "x"), Ok(&[][..]));
        assert!(array::<f64>(null(), 1, "x").is_err());
        assert!(array(data.as_ptr(), usize::MAX / 8, "x").is_err());
        assert!(array(data.as_ptr().cast::<u8>().add(1).cast::<f64>(), 1, "x").is_err());
        assert_eq!(array(data.as_ptr(), 3, "x"), Ok(&data[..]));
        assert_eq!(optional::<f64>(null(), 7, "x"), Ok(None));
    }
}

#[test]
fn views_point_into_the_mesh() {
    let mesh = grid(2);
    let at = mesh.tets.as_ptr();
    let handle = DelotetMesh::new(mesh, PointData::default()).unwrap();
    // SAFETY: the handle is alive.
    unsafe {
        let tets = delotet_mesh_tets(&handle);
        assert_eq!((tets.data, tets.count), (at.cast(), 48));
        assert!(delotet_mesh_subfaces(&handle).first.is_null());
        let points = delotet_mesh_points(null());
        assert_eq!((points.data, points.count), (null(), 0));
    }
}

/// What a size function of a caller answers: a status and a length.
struct Answer {
    status: i32,
    size: Option<f64>,
    asked: Vec<[f64; 3]>,
}

unsafe extern "C" fn answer(user_data: *mut c_void, point: *const f64, size: *mut f64) -> i32 {
    // SAFETY: the pointer set with this function, three coordinates, and room for a length.
    unsafe {
        let answer = &mut *user_data.cast::<Answer>();
        answer.asked.push(*point.cast());
        assert_eq!(*size, f64::INFINITY);
        if let Some(wanted) = answer.size {
            *size = wanted;
        }
        answer.status
    }
}

#[test]
fn size_functions_answer_cancel_and_have_no_wish() {
    let mut data = Answer { status: 0, size: None, asked: Vec::new() };
    let user_data = std::ptr::from_mut(&mut data).cast::<c_void>();
    let options = delotet_options_new();
    // SAFETY: the options and the data of the function are alive, and nothing else uses them during a call.
    unsafe {
        let status = delotet_options_set_size_function(options, Some(answer), user_data, null_mut());
        assert_eq!(status, DelotetStatus::Ok);
        let ask = |status, size| {
            (*user_data.cast::<Answer>()).status = status;
            (*user_data.cast::<Answer>()).size = size;
            with_settings(options, |options, _| {
                let function = options.size_function.clone().expect("the function");
                function.at([1.0, 2.0, 3.0]).map_err(|error| error.status)
            })
        };
        assert_eq!(ask(0, None), Ok(f64::INFINITY));
        assert_eq!(ask(0, Some(0.5)), Ok(0.5));
        assert_eq!(ask(-7, Some(0.5)), Err(Status::Cancelled));
        for nonsense in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            assert_eq!(ask(0, Some(nonsense)), Err(Status::InvalidArgument));
        }
        assert_eq!((*user_data.cast::<Answer>()).asked, [[1.0, 2.0, 3.0]; 7]);
        let status = delotet_options_set_size_function(options, None, user_data, null_mut());
        assert_eq!(status, DelotetStatus::Ok);
        assert!(with_settings(options, |options, _| options.size_function.is_none()));
        delotet_options_free(options);
    }
}

#[test]
fn derived_arrays_are_made_once() {
    let handle = DelotetMesh::new(grid(2), PointData::default()).unwrap();
    let edges = || {
        let mut view = super::view::DelotetEdgesView { first: null(), count: 0, stride: 0 };
        // SAFETY: handle and view are alive.
        assert_eq!(unsafe { delotet_mesh_edges(&handle, &mut view, null_mut()) }, DelotetStatus::Ok);
        view.first as usize
    };
    let seen: Vec<usize> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(edges)).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert!(seen.iter().all(|&at| at == edges() && at != 0));
}

#[test]
fn locate_writes_what_was_asked_for() {
    let handle = DelotetMesh::new(grid(2), PointData::default()).unwrap();
    let points = [0.5, 0.4, 0.3, 9.0, 9.0, 9.0];
    let (mut tets, mut weights) = ([0; 2], [0.0; 8]);
    let mut error = null_mut();
    // SAFETY: arrays of two points.
    unsafe {
        let locate =
            |tets, weights, error| delotet_mesh_locate(&handle, points.as_ptr(), 2, tets, weights, error);
        assert_eq!(locate(tets.as_mut_ptr(), null_mut(), &mut error), DelotetStatus::Ok);
        assert!(error.is_null() && tets[0] < 48 && tets[1] == crate::INVALID);
        assert_eq!(locate(tets.as_mut_ptr(), weights.as_mut_ptr(), &mut error), DelotetStatus::Ok);
        assert!((weights[..4].iter().sum::<f64>() - 1.0).abs() < 1e-15 && weights[4].is_nan());
        assert_eq!(locate(null_mut(), null_mut(), &mut error), DelotetStatus::InvalidArgument);
        assert_eq!(message(error), "out_tets is null");
        delotet_error_free(error);
    }
}
