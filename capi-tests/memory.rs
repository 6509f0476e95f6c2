//! Failing allocations: whichever allocation fails, a call through the C API returns DELOTET_STATUS_OUT_OF_MEMORY or succeeds without that
//! memory, and never brings the host down.
//!
//! The allocator of this program refuses the n-th request, or all from the n-th on. Each job (making a mesh in some mode, reading or
//! writing a format, queries, checks) is run for every n up to the number of its requests, or, if there are too many, for some n spread
//! over them; DELOTET_MEMORY_ALL=1 runs all of them. The runs are made by child processes, so that an abort is an observation: it is
//! reported with the innermost module of the library on the stack of the refused request. None may end the process.
//!
//! A run that succeeds must give the same result as one with enough memory, and all runs must free everything they allocated.
//!
//! On Linux the same is asked of a process whose address space is limited: in every mode, the limit is raised step by step from what the
//! process has when it begins to what the run needs, and each run must end with a mesh or with DELOTET_STATUS_OUT_OF_MEMORY.
//! DELOTET_MEMORY_STEPS and DELOTET_MEMORY_POINTS set the number of steps and of points.
#![allow(unsafe_code)]
use std::alloc::{GlobalAlloc, Layout, System};
use std::collections::BTreeMap;
use std::ffi::CString;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, AtomicUsize, Ordering::SeqCst};
use std::sync::Mutex;

use delotet::ffi::{
    error::*, file::*, given::*, mesh::*, options::*, plc::*, plc_view::*, quality::*, query::*, run::*,
    sizes::*, skinny::*, status::*, view::*, voronoi::*, weights::*, write::*,
};

/// At most about this many requests of a job are refused, one run each, unless all are requested, since meshing takes long.
const RUNS_PER_MESH: u64 = 16;
const RUNS_PER_SMALL_MESH: u64 = 80;
const RUNS_PER_JOB: u64 = 250;

struct Failing;

#[global_allocator]
static ALLOCATOR: Failing = Failing;

/// Requests are counted and refused.
static ARMED: AtomicBool = AtomicBool::new(false);
static COUNT: AtomicU64 = AtomicU64::new(0);
/// The first request that is refused, from 1.
static REFUSED: AtomicU64 = AtomicU64::new(0);
/// All later ones are refused as well.
static ON: AtomicBool = AtomicBool::new(false);
/// The request whose stack is printed.
static TRACED: AtomicU64 = AtomicU64::new(0);
/// Before the number of a refused request.
const MARK: u8 = b'#';
/// Blocks handed out and not given back.
static LIVE: AtomicI64 = AtomicI64::new(0);

/// Writes the number of a refused request to standard error, without allocating or locking.
fn announce(number: u64) {
    let mut line = [b'\n'; 24];
    line[1] = MARK;
    let digits = number.checked_ilog10().unwrap_or(0) as usize + 1;
    let mut rest = number;
    for place in (2..2 + digits).rev() {
        line[place] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    // SAFETY: a buffer of this size.
    unsafe { libc::write(2, line.as_ptr().cast(), digits + 3) };
}

fn refuse() -> bool {
    if !ARMED.load(SeqCst) {
        return false;
    }
    let number = COUNT.fetch_add(1, SeqCst) + 1;
    let first = REFUSED.load(SeqCst);
    let refused = number == first || number > first && ON.load(SeqCst);
    if refused && ON.load(SeqCst) {
        announce(number);
    }
    if number == TRACED.load(SeqCst) {
        ARMED.store(false, SeqCst);
        eprintln!("{}", std::backtrace::Backtrace::force_capture());
        ARMED.store(true, SeqCst);
    }
    refused
}

// SAFETY: all memory is the system allocator's.
unsafe impl GlobalAlloc for Failing {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if refuse() {
            return null_mut();
        }
        LIVE.fetch_add(1, SeqCst);
        // SAFETY: the caller's promise is the same.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        LIVE.fetch_sub(1, SeqCst);
        // SAFETY: the caller's promise is the same.
        unsafe { System.dealloc(block, layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if refuse() {
            return null_mut();
        }
        // SAFETY: the caller's promise is the same.
        unsafe { System.realloc(block, layout, size) }
    }
}

/// The outcome of a run: its status and a hash of its result.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Outcome {
    status: DelotetStatus,
    hash: u64,
}

/// A hash of plain arrays (FNV-1a), without allocating.
struct Hash(u64);

impl Hash {
    fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
    }

    fn view<T>(&mut self, data: *const T, count: usize, width: usize) {
        if count > 0 {
            // SAFETY: views of plain numbers, `count` rows of `width`.
            self.bytes(unsafe {
                std::slice::from_raw_parts(data.cast(), count * width * std::mem::size_of::<T>())
            });
        }
    }
}

/// One job to run with too little memory. Its input is prepared with enough memory.
struct Job {
    name: String,
    prepare: fn(&Job) -> Box<dyn Fn() -> Outcome>,
    model: &'static str,
    mode: DelotetMode,
    change: fn(*mut DelotetOptions),
    file: &'static str,
    /// At most about so many requests are refused.
    runs: u64,
    /// Compressed, if it is a file that can be.
    compress: bool,
    /// Its status with enough memory.
    expected: DelotetStatus,
}

impl Job {
    fn new(name: impl Into<String>, prepare: fn(&Job) -> Box<dyn Fn() -> Outcome>) -> Job {
        Job {
            name: name.into(),
            prepare,
            model: "schoenhardt.off",
            mode: DELOTET_MODE_CONSTRAINED,
            change: |_| {},
            file: "",
            runs: RUNS_PER_JOB,
            compress: false,
            expected: DelotetStatus::Ok,
        }
    }
}

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("capi-tests/data").join(name)
}

/// A folder for this job alone: jobs run concurrently, as may the tests of the other profile.
fn scratch(job: &Job) -> PathBuf {
    let name = job.name.replace(|c: char| !c.is_alphanumeric(), "_");
    let profile = if cfg!(debug_assertions) { "debug" } else { "release" };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("memory").join(profile).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn c_path(path: &Path) -> CString {
    CString::new(path.to_str().unwrap()).unwrap()
}

/// Checks and frees an error object.
unsafe fn finish(status: DelotetStatus, error: *mut DelotetError) -> DelotetStatus {
    // SAFETY: the error is null or alive.
    unsafe {
        assert_eq!(delotet_error_status(error), status);
        assert!(error.is_null() || *delotet_error_message(error) != 0);
        delotet_error_free(error);
    }
    status
}

fn read(path: &CString) -> (DelotetStatus, *mut DelotetPlc) {
    let (mut plc, mut error) = (null_mut(), null_mut());
    // SAFETY: a path and two out-parameters.
    let status = unsafe { finish(delotet_plc_read(path.as_ptr(), &mut plc, &mut error), error) };
    assert_eq!(plc.is_null(), status != DelotetStatus::Ok);
    (status, plc)
}

fn plc_of(job: &Job) -> *mut DelotetPlc {
    let (status, plc) = read(&c_path(&data(job.model)));
    assert_eq!(status, DelotetStatus::Ok, "{}", job.model);
    plc
}

/// A PLC of points and triangles.
fn plc_of_arrays(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> *mut DelotetPlc {
    let mut plc = null_mut();
    // SAFETY: arrays of these sizes.
    unsafe {
        let status = delotet_plc_new(points.as_ptr().cast(), points.len(), &mut plc, null_mut());
        assert_eq!(status, DelotetStatus::Ok);
        let corners = triangles.as_ptr().cast();
        let status = delotet_plc_add_triangles(plc, corners, null(), triangles.len(), null_mut());
        assert_eq!(status, DelotetStatus::Ok);
    }
    plc
}

fn mesh_hash(mesh: *const DelotetMesh) -> u64 {
    let mut hash = Hash(0xcbf2_9ce4_8422_2325);
    // SAFETY: the mesh is alive.
    unsafe {
        let points = delotet_mesh_points(mesh);
        hash.view(points.data, points.count, 3);
        let tets = delotet_mesh_tets(mesh);
        hash.view(tets.data, tets.count, 4);
        let regions = delotet_mesh_tet_regions(mesh);
        hash.view(regions.data, regions.count, 1);
    }
    hash.0
}

/// Makes options and a mesh, and frees everything.
fn make_mesh(
    plc: *const DelotetPlc,
    mode: DelotetMode,
    change: fn(*mut DelotetOptions),
) -> (DelotetStatus, *mut DelotetMesh) {
    let (mut mesh, mut error) = (null_mut(), null_mut());
    // SAFETY: handles are alive as long as they are used.
    unsafe {
        let options = delotet_options_new();
        if options.is_null() {
            return (DelotetStatus::OutOfMemory, mesh);
        }
        assert_eq!(delotet_options_set_mode(options, mode, null_mut()), DelotetStatus::Ok);
        change(options);
        let status = finish(delotet_tetrahedralize(plc, options, &mut mesh, &mut error), error);
        delotet_options_free(options);
        assert_eq!(mesh.is_null(), status != DelotetStatus::Ok);
        (status, mesh)
    }
}

fn meshing(job: &Job) -> Box<dyn Fn() -> Outcome> {
    meshing_of(plc_of(job), job)
}

/// Enough points that threads are started.
fn meshing_many_points(job: &Job) -> Box<dyn Fn() -> Outcome> {
    let golden = |i: u32, step: f64| (f64::from(i) * step).fract();
    let points: Vec<[f64; 3]> =
        (0..40_000).map(|i| [0.618_034, 0.754_878, 0.569_84].map(|s| golden(i, s))).collect();
    meshing_of(plc_of_arrays(&points, &[]), job)
}

fn meshing_of(plc: *mut DelotetPlc, job: &Job) -> Box<dyn Fn() -> Outcome> {
    let (mode, change) = (job.mode, job.change);
    Box::new(move || {
        let (status, mesh) = make_mesh(plc, mode, change);
        let hash = mesh_hash(mesh);
        // SAFETY: the mesh is ours.
        unsafe { delotet_mesh_free(mesh) };
        Outcome { status, hash }
    })
}

fn reading(job: &Job) -> Box<dyn Fn() -> Outcome> {
    let path = match job.file {
        "" => data(job.model),
        // The same model in another format.
        file => {
            let plc = delotet::io::read(&data(job.model)).unwrap();
            let path = scratch(job).join(file);
            delotet::io::write_surface(&path, &plc).unwrap();
            path
        }
    };
    let path = c_path(&path);
    Box::new(move || {
        let (status, plc) = read(&path);
        let mut hash = Hash(1);
        // SAFETY: the PLC is null or alive.
        unsafe {
            let points = delotet_plc_points(plc);
            hash.view(points.data, points.count, 3);
            hash.bytes(&delotet_plc_facet_count(plc).to_le_bytes());
            delotet_plc_free(plc);
        }
        Outcome { status, hash: hash.0 }
    })
}

/// Reads the file of a mesh.
fn reading_a_mesh(job: &Job) -> Box<dyn Fn() -> Outcome> {
    let path = c_path(&scratch(job).join(job.file));
    let plc = plc_of(job);
    let (status, mesh) = make_mesh(plc, job.mode, job.change);
    assert_eq!(status, DelotetStatus::Ok);
    // SAFETY: handles and path are alive.
    unsafe {
        let options = delotet_write_options_new();
        assert_eq!(delotet_write_options_set_compress(options, true, null_mut()), DelotetStatus::Ok);
        assert_eq!(delotet_write_options_set_subfaces(options, true, null_mut()), DelotetStatus::Ok);
        let status = delotet_mesh_write_with(mesh, plc, path.as_ptr(), options, null_mut());
        assert_eq!(status, DelotetStatus::Ok);
        delotet_write_options_free(options);
    }
    Box::new(move || {
        let (mut mesh, mut error) = (null_mut(), null_mut());
        // SAFETY: the path is alive, the mesh is ours.
        unsafe {
            let status = finish(delotet_mesh_read(path.as_ptr(), null(), &mut mesh, &mut error), error);
            let hash = mesh_hash(mesh);
            delotet_mesh_free(mesh);
            Outcome { status, hash }
        }
    })
}

/// Makes a mesh of the arrays of another one, refines it with sizes, and improves the result.
fn changing_a_mesh(job: &Job) -> Box<dyn Fn() -> Outcome> {
    let (status, mesh) = make_mesh(plc_of(job), job.mode, job.change);
    assert_eq!(status, DelotetStatus::Ok);
    Box::new(move || {
        let mut made = [null_mut(); 3];
        // SAFETY: all handles are ours.
        unsafe {
            let sizes = delotet_mesh_sizes_new();
            let status = change(mesh, sizes, &mut made);
            let hash = mesh_hash(made[2]);
            made.iter().for_each(|&mesh| delotet_mesh_free(mesh));
            delotet_mesh_sizes_free(sizes);
            let status = status.err().unwrap_or(DelotetStatus::Ok);
            // Without memory there are no sizes to be set.
            Outcome { status: if sizes.is_null() { DelotetStatus::OutOfMemory } else { status }, hash }
        }
    })
}

/// # Safety
/// The handles are alive, `sizes` may be null.
unsafe fn change(
    mesh: *const DelotetMesh,
    sizes: *mut DelotetMeshSizes,
    made: &mut [*mut DelotetMesh; 3],
) -> Result<(), DelotetStatus> {
    let done = |status, error| match unsafe { finish(status, error) } {
        DelotetStatus::Ok => Ok(()),
        status => Err(status),
    };
    let mut error = null_mut();
    // SAFETY: the caller's promise; views are used while their mesh lives.
    unsafe {
        let (points, tets) = (delotet_mesh_points(mesh), delotet_mesh_tets(mesh));
        let (no_numbers, no_corners) = (null(), null());
        let status = delotet_mesh_from_arrays(
            points.data,
            points.count,
            points.count,
            tets.data,
            tets.count,
            null(),
            no_corners,
            0,
            no_numbers,
            tets.data,
            1,
            no_numbers,
            null(),
            &mut made[0],
            &mut error,
        );
        done(status, error)?;
        let status = delotet_mesh_sizes_set_region(sizes, 1.0, 0.7, &mut error);
        done(status, error)?;
        let options = delotet_options_new();
        if options.is_null() {
            return Err(DelotetStatus::OutOfMemory);
        }
        let lengths = [0.7; 4096];
        assert!(points.count <= lengths.len());
        let status =
            delotet_options_set_background(options, made[0], lengths.as_ptr(), points.count, &mut error);
        let refined = done(status, error).and_then(|()| {
            let mut error = null_mut();
            let status = delotet_mesh_refine(made[0], sizes, options, &mut made[1], &mut error);
            done(status, error)
        });
        delotet_options_free(options);
        refined?;
        let status = delotet_mesh_improve(made[1], null(), &mut made[2], &mut error);
        done(status, error)
    }
}

fn writing(job: &Job) -> Box<dyn Fn() -> Outcome> {
    let plc = plc_of(job);
    let (status, mesh) = make_mesh(plc, job.mode, job.change);
    assert_eq!(status, DelotetStatus::Ok);
    let path = c_path(&scratch(job).join(job.file));
    Box::new(move || {
        let mut error = null_mut();
        // SAFETY: handles and path are alive.
        let status = unsafe { finish(delotet_mesh_write(mesh, plc, path.as_ptr(), &mut error), error) };
        Outcome { status, hash: 0 }
    })
}

/// With a choice of options of writers.
fn writing_with(job: &Job) -> Box<dyn Fn() -> Outcome> {
    let plc = plc_of(job);
    let (status, mesh) = make_mesh(plc, job.mode, job.change);
    assert_eq!(status, DelotetStatus::Ok);
    let path = c_path(&scratch(job).join(job.file));
    let compress = job.compress;
    Box::new(move || {
        let mut error = null_mut();
        // SAFETY: handles and path are alive; the options are ours.
        let status = unsafe {
            let options = delotet_write_options_new();
            if options.is_null() {
                return Outcome { status: DelotetStatus::OutOfMemory, hash: 0 };
            }
            let mut status = delotet_write_options_set_second_order(options, true, &mut error);
            if status == DelotetStatus::Ok {
                status = delotet_write_options_set_region_name(options, 0.0, c"water".as_ptr(), &mut error);
            }
            if status == DelotetStatus::Ok {
                assert_eq!(delotet_write_options_set_subfaces(options, true, null_mut()), DelotetStatus::Ok);
                assert_eq!(
                    delotet_write_options_set_compress(options, compress, null_mut()),
                    DelotetStatus::Ok
                );
                status = delotet_mesh_write_with(mesh, plc, path.as_ptr(), options, &mut error);
            }
            delotet_write_options_free(options);
            finish(status, error)
        };
        Outcome { status, hash: 0 }
    })
}

/// Somebody listens.
unsafe extern "C" fn line(_: *mut std::ffi::c_void, _: *const std::ffi::c_char) {}

/// A size function without a wish.
unsafe extern "C" fn no_wish(_: *mut std::ffi::c_void, _: *const f64, _: *mut f64) -> i32 {
    0
}

/// The input in a surface format, with words on what it cannot hold and what has no effect.
fn writing_input(job: &Job) -> Box<dyn Fn() -> Outcome> {
    let plc = plc_of(job);
    let path = c_path(&scratch(job).join(job.file));
    let options = delotet_write_options_new();
    // SAFETY: the options are alive and nothing else uses them.
    unsafe {
        assert_eq!(delotet_write_options_set_compress(options, true, null_mut()), DelotetStatus::Ok);
        let status = delotet_write_options_set_log(options, Some(line), null_mut(), null_mut());
        assert_eq!(status, DelotetStatus::Ok);
    }
    Box::new(move || {
        let (mut copy, mut error) = (null_mut(), null_mut());
        // SAFETY: the handles and the path are alive.
        let status = unsafe {
            let mut status = delotet_plc_clone(plc, &mut copy, &mut error);
            if status == DelotetStatus::Ok {
                status = delotet_plc_write_with(copy, path.as_ptr(), options, &mut error);
                delotet_plc_free(copy);
            }
            finish(status, error)
        };
        Outcome { status, hash: 0 }
    })
}

fn checking(job: &Job) -> Box<dyn Fn() -> Outcome> {
    let plc = plc_of(job);
    let (status, mesh) = make_mesh(plc, job.mode, job.change);
    assert_eq!(status, DelotetStatus::Ok);
    let preserved = job.mode == DELOTET_MODE_PRESERVE;
    Box::new(move || {
        let mut error = null_mut();
        // SAFETY: the handles are alive.
        let status = unsafe {
            match preserved {
                true => delotet_mesh_check_preserved(mesh, plc, 10, &mut error),
                false => delotet_mesh_check(mesh, plc, true, 10, &mut error),
            }
        };
        // SAFETY: the error is null or alive.
        Outcome { status: unsafe { finish(status, error) }, hash: 0 }
    })
}

fn checking_input(job: &Job) -> Box<dyn Fn() -> Outcome> {
    let plc = plc_of(job);
    Box::new(move || {
        let mut error = null_mut();
        // SAFETY: the handle is alive.
        let status = unsafe { finish(delotet_plc_check(plc, null(), &mut error), error) };
        Outcome { status, hash: 0 }
    })
}

/// A mesh, then everything that is derived from it on first use.
fn queries(job: &Job) -> Box<dyn Fn() -> Outcome> {
    let (plc, mode) = (plc_of(job), job.mode);
    Box::new(move || {
        ARMED.store(false, SeqCst);
        let (_, mesh) = make_mesh(plc, mode, |_| {});
        ARMED.store(true, SeqCst);
        let mut hash = Hash(2);
        let status = ask(mesh, &mut hash).err().unwrap_or(DelotetStatus::Ok);
        // SAFETY: the mesh is ours.
        unsafe { delotet_mesh_free(mesh) };
        Outcome { status, hash: hash.0 }
    })
}

fn ask(mesh: *const DelotetMesh, hash: &mut Hash) -> Result<(), DelotetStatus> {
    let mut error = null_mut();
    let ok = |status: DelotetStatus, error: &mut *mut DelotetError| {
        // SAFETY: the error is null or alive.
        match unsafe { finish(status, std::mem::replace(error, null_mut())) } {
            DelotetStatus::Ok => Ok(()),
            status => Err(status),
        }
    };
    // SAFETY: the mesh is alive; out-parameters are valid; all views are plain old data.
    unsafe {
        let mut faces: DelotetFacesView = std::mem::zeroed();
        let status = delotet_mesh_faces(mesh, &mut faces, &mut error);
        ok(status, &mut error)?;
        hash.bytes(&faces.count.to_le_bytes());
        let mut edges: DelotetEdgesView = std::mem::zeroed();
        let status = delotet_mesh_edges(mesh, &mut edges, &mut error);
        ok(status, &mut error)?;
        hash.bytes(&edges.count.to_le_bytes());
        let mut nodes: DelotetSecondOrderView = std::mem::zeroed();
        let status = delotet_mesh_second_order(mesh, DELOTET_NODE_ORDER_VTK, &mut nodes, &mut error);
        ok(status, &mut error)?;
        hash.view(nodes.tets, nodes.tet_count, 10);
        let mut list: DelotetIndicesView = std::mem::zeroed();
        let status = delotet_mesh_point_tets(mesh, &mut list, &mut error);
        ok(status, &mut error)?;
        let mut attributes: DelotetDoublesView = std::mem::zeroed();
        let status = delotet_mesh_tet_attributes(mesh, &mut attributes, &mut error);
        ok(status, &mut error)?;
        let mut qualities: DelotetTetQualitiesView = std::mem::zeroed();
        let status = delotet_mesh_quality(mesh, &mut qualities, &mut error);
        ok(status, &mut error)?;
        hash.view(qualities.first, qualities.count, 1);
        let mut summary: DelotetQualitySummary = std::mem::zeroed();
        summary.struct_size = std::mem::size_of::<DelotetQualitySummary>();
        let status = delotet_mesh_quality_summary(mesh, &mut summary, &mut error);
        ok(status, &mut error)?;
        hash.view(&summary, 1, 1);
        let mut worst = [0u32; 3];
        let status =
            delotet_mesh_worst_tets(mesh, DELOTET_QUALITY_ETA, true, worst.as_mut_ptr(), 3, &mut error);
        ok(status, &mut error)?;
        hash.view(worst.as_ptr(), 3, 1);
        let mut skinny = null_mut();
        let status = delotet_skinny_tets_new(mesh, 0.7, &mut skinny, &mut error);
        ok(status, &mut error)?;
        let list = delotet_skinny_tets_view(skinny);
        hash.view(list.first, list.count, 1);
        delotet_skinny_tets_free(skinny);
        let (mut tet, mut weights) = ([0u32], [0.0f64; 4]);
        let status = delotet_mesh_locate(
            mesh,
            [0.01, 0.02, 0.03].as_ptr(),
            1,
            tet.as_mut_ptr(),
            weights.as_mut_ptr(),
            &mut error,
        );
        ok(status, &mut error)?;
        hash.bytes(&tet[0].to_le_bytes());
    }
    Ok(())
}

/// Sets weights, makes a weighted mesh, some of whose points are hidden, and its power diagram.
fn weighted(_: &Job) -> Box<dyn Fn() -> Outcome> {
    let golden = |i: u32, step: f64| (f64::from(i) * step).fract();
    let points: Vec<[f64; 3]> =
        (0..200).map(|i| [0.618_034, 0.754_878, 0.569_84].map(|s| golden(i, s))).collect();
    let plc = plc_of_arrays(&points, &[]);
    Box::new(move || {
        let mut hash = Hash(4);
        let status = power_diagram(plc, &mut hash).err().unwrap_or(DelotetStatus::Ok);
        Outcome { status, hash: hash.0 }
    })
}

fn power_diagram(plc: *mut DelotetPlc, hash: &mut Hash) -> Result<(), DelotetStatus> {
    let weights: [f64; 200] = std::array::from_fn(|i| (i * 7 % 10) as f64 * 0.02);
    let (mut voronoi, mut error) = (null_mut(), null_mut());
    // SAFETY: handles are alive as long as they are used.
    unsafe {
        let status = delotet_plc_set_point_weights(plc, weights.as_ptr(), weights.len(), &mut error);
        let status = finish(status, std::mem::replace(&mut error, null_mut()));
        if status != DelotetStatus::Ok {
            return Err(status);
        }
        let (status, mesh) = make_mesh(plc, DELOTET_MODE_DELAUNAY, |_| {});
        if status != DelotetStatus::Ok {
            return Err(status);
        }
        let hidden = delotet_mesh_hidden_points(mesh);
        assert!(hidden.count > 0);
        hash.view(hidden.data, hidden.count, 1);
        let status = finish(delotet_voronoi_new(mesh, null(), &mut voronoi, &mut error), error);
        let vertices = delotet_voronoi_vertices(voronoi);
        hash.view(vertices.data, vertices.count, 3);
        let edges = delotet_voronoi_facet_edges(voronoi);
        hash.view(edges.data, edges.count, 1);
        delotet_voronoi_free(voronoi);
        delotet_mesh_free(mesh);
        if status == DelotetStatus::Ok {
            Ok(())
        } else {
            Err(status)
        }
    }
}

/// A PLC by calls: points with attributes and markers, all kinds of facets, segments and seeds.
fn building(_: &Job) -> Box<dyn Fn() -> Outcome> {
    Box::new(|| {
        let mut hash = Hash(3);
        let mut plc = null_mut();
        let status = build(&mut plc, &mut hash).err().unwrap_or(DelotetStatus::Ok);
        // SAFETY: the PLC is null or ours.
        unsafe { delotet_plc_free(plc) };
        Outcome { status, hash: hash.0 }
    })
}

fn build(plc: &mut *mut DelotetPlc, hash: &mut Hash) -> Result<(), DelotetStatus> {
    let cube: [[f64; 3]; 8] = std::array::from_fn(|i| [(i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64]);
    let sides: [[u32; 4]; 5] = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4]];
    let ends: [usize; 5] = std::array::from_fn(|i| 4 * (i + 1));
    let mut error = null_mut();
    let step = |status: DelotetStatus, error: &mut *mut DelotetError| {
        // SAFETY: the error is null or alive.
        match unsafe { finish(status, std::mem::replace(error, null_mut())) } {
            DelotetStatus::Ok => Ok(()),
            status => Err(status),
        }
    };
    // SAFETY: arrays of these sizes, handles that are alive.
    unsafe {
        let status = delotet_plc_new(cube.as_ptr().cast(), 8, plc, &mut error);
        step(status, &mut error)?;
        let plc = *plc;
        let status = delotet_plc_set_point_attributes(plc, cube.as_ptr().cast(), 3, &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_set_point_markers(plc, [7; 8].as_ptr(), &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_add_triangles(plc, [1, 3, 7].as_ptr(), null(), 1, &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_add_polygons(
            plc,
            sides.as_ptr().cast(),
            ends.as_ptr(),
            [1, 2, 3, 4, 5].as_ptr(),
            5,
            &mut error,
        );
        step(status, &mut error)?;
        let status = delotet_plc_add_triangles(plc, [1, 7, 5].as_ptr(), null(), 1, &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_add_segment(plc, 0, 7, 9, &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_add_region(plc, [0.5, 0.25, 0.4].as_ptr(), 3.0, 0.1, &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_add_hole(plc, [2.0, 2.0, 2.0].as_ptr(), &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_set_point_sizes(plc, [0.5; 8].as_ptr(), 8, &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_set_facet_size(plc, 3, 0.25, &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_set_facet_area(plc, 3, 0.25, &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_set_segment_size(plc, 9, 0.25, &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_set_region_size(plc, 3.0, 0.25, &mut error);
        step(status, &mut error)?;
        let status = delotet_plc_add_points(plc, [0.5; 3].as_ptr(), 1, null_mut(), &mut error);
        step(status, &mut error)?;
        hash.bytes(&delotet_plc_facet_count(plc).to_le_bytes());
    }
    Ok(())
}

/// A call with wrong arguments: its error needs memory as well.
fn misuse(_: &Job) -> Box<dyn Fn() -> Outcome> {
    Box::new(|| {
        let mut error = null_mut();
        let mut plc = null_mut();
        // SAFETY: a null array with a count is refused.
        let status = unsafe { finish(delotet_plc_new(null(), 5, &mut plc, &mut error), error) };
        Outcome { status, hash: 0 }
    })
}

fn jobs() -> Vec<Job> {
    let mut jobs = vec![Job::new("build", building), Job::new("weights", weighted)];
    jobs.push(Job { expected: DelotetStatus::InvalidArgument, ..Job::new("misuse", misuse) });
    let modes = [
        ("delaunay", DELOTET_MODE_DELAUNAY),
        ("cdt", DELOTET_MODE_CONSTRAINED),
        ("preserve", DELOTET_MODE_PRESERVE),
    ];
    // Those that take a few hundredths of a second.
    let models = ["schoenhardt.off", "fins_in_box.poly", "internal.smesh"];
    for (mode_name, mode) in modes {
        for model in models {
            let runs = match (model, mode_name) {
                ("schoenhardt.off", "delaunay" | "cdt") => u64::MAX,
                (_, "cdt") => RUNS_PER_SMALL_MESH,
                _ => RUNS_PER_MESH,
            };
            jobs.push(Job { model, mode, runs, ..Job::new(format!("mesh {model}, {mode_name}"), meshing) });
        }
    }
    for model in ["chazelle.off", "layers.poly", "combs.smesh"] {
        let runs = RUNS_PER_MESH;
        jobs.push(Job { model, runs, ..Job::new(format!("mesh {model}, cdt"), meshing) });
    }
    type Change = (&'static str, fn(*mut DelotetOptions));
    // SAFETY: the options are alive and nothing else uses them.
    let changes: [Change; 7] = unsafe {
        [
            ("hull kept", |o| {
                assert_eq!(delotet_options_set_keep_hull(o, true, null_mut()), DelotetStatus::Ok)
            }),
            ("merged", |o| {
                assert_eq!(delotet_options_set_merge_facets(o, 175.0, null_mut()), DelotetStatus::Ok)
            }),
            ("not validated", |o| {
                assert_eq!(delotet_options_set_validate(o, false, null_mut()), DelotetStatus::Ok)
            }),
            ("exact form", |o| {
                assert_eq!(delotet_options_set_exact_form(o, true, null_mut()), DelotetStatus::Ok)
            }),
            ("points sorted", |o| {
                assert_eq!(delotet_options_set_points_sorted(o, true, null_mut()), DelotetStatus::Ok)
            }),
            ("two threads", |o| assert_eq!(delotet_options_set_threads(o, 2, null_mut()), DelotetStatus::Ok)),
            ("outer", |o| {
                assert_eq!(
                    delotet_options_set_preserve(o, DELOTET_PRESERVE_OUTER, null_mut()),
                    DelotetStatus::Ok
                )
            }),
        ]
    };
    for (what, change) in changes {
        for (mode_name, mode) in &modes[1..] {
            let model = "internal.smesh";
            let name = format!("mesh {model}, {mode_name}, {what}");
            let (mode, runs) = (*mode, RUNS_PER_MESH);
            jobs.push(Job { model, mode, change, runs, ..Job::new(name, meshing) });
        }
    }
    jobs.push(Job {
        model: "internal.smesh",
        mode: DELOTET_MODE_PRESERVE,
        // SAFETY: the options are alive and nothing else uses them.
        change: |o| unsafe {
            assert_eq!(delotet_options_set_quality(o, 2.0, null_mut()), DelotetStatus::Ok);
            assert_eq!(delotet_options_set_optimize(o, 1, null_mut()), DelotetStatus::Ok);
            let status = delotet_options_set_size_function(o, Some(no_wish), null_mut(), null_mut());
            assert_eq!(status, DelotetStatus::Ok);
        },
        runs: RUNS_PER_MESH,
        ..Job::new("mesh internal.smesh, preserve, filled and optimised", meshing)
    });
    jobs.push(Job {
        model: "internal.smesh",
        mode: DELOTET_MODE_CONSTRAINED,
        // SAFETY: the options are alive and nothing else uses them.
        change: |o| unsafe {
            assert_eq!(delotet_options_set_quality(o, 1.414, null_mut()), DelotetStatus::Ok);
            assert_eq!(delotet_options_set_min_angle(o, 50.0, null_mut()), DelotetStatus::Ok);
        },
        runs: RUNS_PER_MESH,
        ..Job::new("mesh internal.smesh, cdt, refined for an angle", meshing)
    });
    jobs.push(Job {
        mode: DELOTET_MODE_DELAUNAY,
        // SAFETY: the options are alive and nothing else uses them.
        change: |o| {
            assert_eq!(unsafe { delotet_options_set_threads(o, 4, null_mut()) }, DelotetStatus::Ok);
        },
        runs: RUNS_PER_MESH,
        ..Job::new("mesh many points, delaunay, four threads", meshing_many_points)
    });
    for (model, expected) in [
        ("invalid/crossing.off", DelotetStatus::SelfIntersection),
        ("invalid/degenerate.off", DelotetStatus::DegenerateFacet),
        ("invalid/open.off", DelotetStatus::NothingEnclosed),
    ] {
        jobs.push(Job { model, expected, ..Job::new(format!("mesh {model}"), meshing) });
    }
    for model in ["internal.smesh", "fins_in_box.poly"] {
        jobs.push(Job { model, ..Job::new(format!("check the input {model}"), checking_input) });
        jobs.push(Job { model, ..Job::new(format!("check the mesh of {model}"), checking) });
        let mode = DELOTET_MODE_PRESERVE;
        jobs.push(Job { model, mode, ..Job::new(format!("check the kept surface of {model}"), checking) });
        jobs.push(Job { model, ..Job::new(format!("queries, {model}"), queries) });
    }
    for file in ["", "m.off", "m.stl", "m.obj", "m.ply", "m.poly", "m.smesh", "m.node"] {
        jobs.push(Job { file, ..Job::new(format!("read schoenhardt {file}"), reading) });
    }
    for model in ["fins_in_box.poly", "internal.smesh", "text.obj"] {
        jobs.push(Job { model, ..Job::new(format!("read {model}"), reading) });
    }
    for file in ["g.ele", "g.vtu", "g.msh", "g.mesh"] {
        let model = "internal.smesh";
        jobs.push(Job { model, file, ..Job::new(format!("read the mesh {file}"), reading_a_mesh) });
    }
    for model in ["internal.smesh", "fins_in_box.poly"] {
        let (name, runs) = (format!("given mesh of {model}"), 4 * RUNS_PER_MESH);
        jobs.push(Job { model, runs, ..Job::new(name, changing_a_mesh) });
    }
    for (model, expected) in [
        ("invalid/truncated.off", DelotetStatus::Format),
        ("invalid/index.off", DelotetStatus::IndexOutOfRange),
        ("no such file.off", DelotetStatus::File),
        ("no_format.xyz", DelotetStatus::Unsupported),
    ] {
        jobs.push(Job { model, expected, ..Job::new(format!("read {model}"), reading) });
    }
    let model = "fins_in_box.poly";
    for file in ["w.ele", "w.vtu", "w.vtk", "w.msh", "w.mesh", "w.inp"] {
        jobs.push(Job { model, file, ..Job::new(format!("write {file}"), writing) });
    }
    for file in ["o.ele", "o.vtu", "o.vtk", "o.msh", "o.inp"] {
        jobs.push(Job { model, file, ..Job::new(format!("write {file}, with options"), writing_with) });
    }
    let compressed = Job::new("write c.vtu, compressed", writing_with);
    jobs.push(Job { model, file: "c.vtu", compress: true, ..compressed });
    for file in ["s.off", "s.stl", "s.obj", "s.ply", "s.poly", "s.smesh", "s.node"] {
        jobs.push(Job { model: "chazelle.off", file, ..Job::new(format!("write {file}"), writing_input) });
    }
    for file in ["t.ply", "t.poly", "t.obj"] {
        let name = format!("write {file} of polygons");
        jobs.push(Job { model: "internal.smesh", file, ..Job::new(name, writing_input) });
    }
    jobs.push(Job {
        file: "no such folder/w.vtu",
        expected: DelotetStatus::File,
        ..Job::new("write into nothing", writing)
    });
    jobs
}

/// Runs the body with the n-th request refused (0: none), and with `on` all later ones. Also returns the number of requests.
fn run(body: &dyn Fn() -> Outcome, n: u64, on: bool) -> (Outcome, u64) {
    COUNT.store(0, SeqCst);
    REFUSED.store(if n == 0 { u64::MAX } else { n }, SeqCst);
    ON.store(on, SeqCst);
    ARMED.store(true, SeqCst);
    let outcome = body();
    ARMED.store(false, SeqCst);
    (outcome, COUNT.load(SeqCst))
}

/// A child: runs a job from the n-th request on, and says so before each run. Arguments: job, `on`, first n, the request to trace or 0.
fn child(arguments: &[String]) {
    let job = &jobs()[arguments[0].parse::<usize>().unwrap()];
    let on = arguments[1] == "on";
    let first: u64 = arguments[2].parse().unwrap();
    let traced: u64 = arguments[3].parse().unwrap();
    // Reporting a failed assertion gets all the memory it needs.
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        ARMED.store(false, SeqCst);
        report(info);
    }));
    let body = (job.prepare)(job);
    // Twice, so that everything set up once per process exists, including the buffer of standard output.
    say(format_args!("0 0 0"));
    let (reference, _) = run(&*body, 0, false);
    let live = LIVE.load(SeqCst);
    let (again, requests) = run(&*body, 0, false);
    assert_eq!(reference, again);
    assert_eq!(LIVE.load(SeqCst), live, "{}: memory leaks", job.name);
    assert_eq!(reference.status, job.expected, "{}", job.name);
    let stride = match std::env::var_os("DELOTET_MEMORY_ALL") {
        Some(_) => 1,
        None => requests.div_ceil(job.runs).max(1),
    };
    let mut n = first;
    while n <= requests && requests > 0 {
        say(format_args!("{n} {stride} {requests}"));
        TRACED.store(traced, SeqCst);
        let (outcome, _) = run(&*body, n, on);
        let fine = outcome == reference || outcome.status == DelotetStatus::OutOfMemory;
        assert!(fine, "{}, request {n}{}: {outcome:?}", job.name, if on { " and all after it" } else { "" });
        let now = LIVE.load(SeqCst);
        assert_eq!(now, live, "{}, request {n}: memory leaks", job.name);
        if traced > 0 {
            return;
        }
        n += stride;
    }
    say(format_args!("done {requests}"));
}

fn say(line: std::fmt::Arguments<'_>) {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{line}").unwrap();
    out.flush().unwrap();
}

/// Runs a child process for a job; returns its output lines, whether it succeeded, and its errors.
fn start(job: usize, on: bool, first: u64, traced: u64) -> (Vec<String>, bool, String) {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--child", &job.to_string(), if on { "on" } else { "once" }, &first.to_string()]);
    command.arg(traced.to_string());
    // The standard library's own backtrace of a failed request would allocate too.
    command.env("RUST_BACKTRACE", "0");
    let mut process = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let (out, err) = (process.stdout.take().unwrap(), process.stderr.take().unwrap());
    let errors = std::thread::spawn(move || std::io::read_to_string(err).unwrap_or_default());
    let lines = BufReader::new(out).lines().map(Result::unwrap).collect();
    (lines, process.wait().unwrap().success(), errors.join().unwrap())
}

/// The innermost module of the library in a stack of calls, to two levels: by the names of functions, as there may be no line numbers.
fn site(trace: &str) -> String {
    let own = |line: &str| {
        // Not a function of the standard library with a type of ours.
        let (_, name) = line.trim_start().split_once(": ")?;
        let path = name.trim_start_matches('<').strip_prefix("delotet::")?;
        let path = path.split(['<', '>', ' ', '{', '(']).next().unwrap_or(path);
        let mut parts = path.split("::").filter(|part| part.starts_with(|c: char| c.is_ascii_lowercase()));
        let (first, second) = (parts.next()?, parts.next().unwrap_or_default());
        (first != "fallible" && !first.is_empty()).then(|| format!("{first}::{second}"))
    };
    trace.lines().find_map(own).unwrap_or_else(|| "unknown".into())
}

#[derive(Default)]
struct Tally {
    runs: u64,
    aborts: u64,
    sites: BTreeMap<String, u64>,
    faults: Vec<String>,
}

impl Tally {
    fn add(&mut self, other: Tally) {
        self.runs += other.runs;
        self.aborts += other.aborts;
        for (site, count) in other.sites {
            *self.sites.entry(site).or_default() += count;
        }
        self.faults.extend(other.faults);
    }
}

fn sweep(job: usize, name: &str, on: bool, tally: &mut Tally) {
    let mut first = 1;
    loop {
        let (lines, well, errors) = start(job, on, first, 0);
        let steps: Vec<&String> = lines.iter().filter(|line| !line.starts_with(['d', '0'])).collect();
        tally.runs += steps.len() as u64;
        if well {
            return;
        }
        let aborted = errors.contains("memory allocation of");
        let Some(last) = steps.last().filter(|_| aborted) else {
            tally.faults.push(format!("{name}: {errors}"));
            return;
        };
        let mut numbers = last.split(' ').map(|number| number.parse::<u64>().unwrap());
        let (n, stride) = (numbers.next().unwrap(), numbers.next().unwrap());
        tally.aborts += 1;
        // Among all refused requests it is the last one before the abort message.
        let before = errors.split("memory allocation of").next().unwrap_or_default();
        let last =
            before.rsplit(char::from(MARK)).next().filter(|_| on).and_then(|rest| rest.trim().parse().ok());
        let (_, _, trace) = start(job, on, n, last.unwrap_or(n));
        // Optimized builds lack full names of inlined functions: there only the kind of job is known.
        let site = match (cfg!(debug_assertions), name) {
            (true, _) => site(&trace),
            (false, name) => name.into(),
        };
        if site == "unknown" || std::env::var_os("DELOTET_MEMORY_SHOW").is_some() {
            eprintln!("{name}, request {n}:\n{trace}");
        }
        *tally.sites.entry(site).or_default() += 1;
        first = n + stride;
    }
}

/// What is done for each number below a count, in their order, by as many threads as there are processors: they wait for children.
fn concurrently<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let (next, results) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
    let take = || loop {
        let number = next.fetch_add(1, SeqCst);
        if number >= count {
            break;
        }
        let result = work(number);
        results.lock().unwrap().insert(number, result);
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(take);
        }
    });
    results.into_inner().unwrap().into_values().collect()
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.first().is_some_and(|first| first == "--child") {
        return child(&arguments[1..]);
    }
    #[cfg(target_os = "linux")]
    if arguments.first().is_some_and(|first| first == "--limited") {
        return limits::child(&arguments[1..]);
    }
    // Like the standard harness: a filter by name.
    let filter = arguments.iter().find(|argument| !argument.starts_with('-')).cloned();
    let wanted = |name: &str| filter.as_ref().is_none_or(|filter| name.contains(filter.as_str()));
    let names: Vec<String> = jobs().into_iter().map(|job| job.name).collect();
    let chosen: Vec<usize> = (0..names.len()).filter(|&job| wanted(&names[job])).collect();
    let tallies = concurrently(chosen.len(), |number| {
        let (job, name) = (chosen[number], &names[chosen[number]]);
        let mut tally = Tally::default();
        sweep(job, name, false, &mut tally);
        sweep(job, name, true, &mut tally);
        tally
    });
    let mut tally = Tally::default();
    for (job, of_job) in chosen.into_iter().zip(tallies) {
        println!("{}: {} runs, {} aborts", names[job], of_job.runs, of_job.aborts);
        tally.add(of_job);
    }
    println!("{} runs, {} aborts at {:#?}", tally.runs, tally.aborts, tally.sites);
    for site in tally.sites.keys() {
        tally.faults.push(format!("a refused request in {site} ends the process"));
    }
    #[cfg(target_os = "linux")]
    limits::step_all(filter.as_deref(), &mut tally.faults);
    assert!(tally.faults.is_empty(), "\n{}\n", tally.faults.join("\n"));
}

/// Runs in a limited address space.
#[cfg(target_os = "linux")]
mod limits {
    use super::*;

    const STEPS: u64 = 12;
    const POINTS: usize = 30_000;
    const MODES: [(&str, DelotetMode); 3] = [
        ("delaunay", DELOTET_MODE_DELAUNAY),
        ("cdt", DELOTET_MODE_CONSTRAINED),
        ("preserve", DELOTET_MODE_PRESERVE),
    ];

    fn from_environment<T: std::str::FromStr>(name: &str, otherwise: T) -> T {
        std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(otherwise)
    }

    /// Numbers from 0 to 1, always the same (splitmix64).
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let x = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((x ^ x >> 31) >> 11) as f64 / (1u64 << 53) as f64
        }
    }

    /// A rough torus of about so many points.
    fn surface(count: usize) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let around = (count as f64).sqrt() as usize;
        let mut random = Random(1);
        let mut points = Vec::new();
        let mut triangles = Vec::new();
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / around as f64;
        for i in 0..around {
            for j in 0..around {
                let tube = 1.0 + 2.0 / around as f64 * random.next();
                let ring = 3.0 + tube * angle(j).cos();
                points.push([ring * angle(i).cos(), ring * angle(i).sin(), tube * angle(j).sin()]);
                let at = |i: usize, j: usize| (i % around * around + j % around) as u32;
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        (points, triangles)
    }

    fn input(mode: DelotetMode, count: usize) -> *mut DelotetPlc {
        let (points, triangles) = match mode {
            DELOTET_MODE_DELAUNAY => {
                let mut random = Random(2);
                ((0..count).map(|_| [random.next(), random.next(), random.next()]).collect(), Vec::new())
            }
            _ => surface(count),
        };
        super::plc_of_arrays(&points, &triangles)
    }

    /// The address space of this process now, and at most so far.
    fn address_space() -> [u64; 2] {
        let status = std::fs::read_to_string("/proc/self/status").unwrap();
        ["VmSize:", "VmPeak:"].map(|name| {
            let line = status.lines().find_map(|line| line.strip_prefix(name)).unwrap();
            1024 * line.split_whitespace().next().unwrap().parse::<u64>().unwrap()
        })
    }

    /// A child: a mesh in some mode with so many more bytes of address space (0: all there is). Prints the status and what it took.
    pub(super) fn child(arguments: &[String]) {
        let mode = MODES[arguments[0].parse::<usize>().unwrap()].1;
        let [count, more]: [u64; 2] = [1, 2].map(|i| arguments[i].parse().unwrap());
        let plc = input(mode, count as usize);
        let [before, _] = address_space();
        if more > 0 {
            let limit = libc::rlimit { rlim_cur: before + more, rlim_max: libc::RLIM_INFINITY };
            // SAFETY: a limit to read.
            assert_eq!(unsafe { libc::setrlimit(libc::RLIMIT_AS, &limit) }, 0);
        }
        let two_threads = |o| {
            // SAFETY: the options are alive and nothing else uses them.
            assert_eq!(unsafe { delotet_options_set_threads(o, 2, null_mut()) }, DelotetStatus::Ok);
        };
        let (status, mesh) = make_mesh(plc, mode, two_threads);
        // SAFETY: both are ours.
        unsafe {
            delotet_mesh_free(mesh);
            delotet_plc_free(plc);
            let limit = libc::rlimit { rlim_cur: libc::RLIM_INFINITY, rlim_max: libc::RLIM_INFINITY };
            libc::setrlimit(libc::RLIMIT_AS, &limit);
        }
        say(format_args!("{} {}", status as i32, address_space()[1] - before));
    }

    /// The status of a child and the address space it took; or what it said last.
    fn run(mode: usize, count: usize, more: u64) -> Result<(i32, u64), String> {
        let mut command = Command::new(std::env::current_exe().unwrap());
        command.args(["--limited", &mode.to_string(), &count.to_string(), &more.to_string()]);
        let output = command.env("RUST_BACKTRACE", "0").output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let mut numbers = text.split_whitespace().map(str::parse::<i64>);
        match (output.status.success(), numbers.next(), numbers.next()) {
            (true, Some(Ok(status)), Some(Ok(taken))) => Ok((status as i32, taken as u64)),
            _ => Err(format!("{:?}: {}", output.status, String::from_utf8_lossy(&output.stderr))),
        }
    }

    /// Steps through the limits in all modes.
    pub(super) fn step_all(filter: Option<&str>, faults: &mut Vec<String>) {
        let steps: u64 = from_environment("DELOTET_MEMORY_STEPS", STEPS);
        let count: usize = from_environment("DELOTET_MEMORY_POINTS", POINTS);
        for (number, (mode, _)) in MODES.into_iter().enumerate() {
            let name = format!("limits, {mode}");
            if filter.is_some_and(|filter| !name.contains(filter)) {
                continue;
            }
            let (status, most) = match run(number, count, 0) {
                Ok(end) => end,
                Err(error) => {
                    faults.push(format!("{name}, without a limit: {error}"));
                    continue;
                }
            };
            assert_eq!(status, DelotetStatus::Ok as i32, "{name}");
            let mut ends = [0; 2];
            // The last limits are above what the run took.
            let limit = |step: usize| most * 21 / 20 * (step as u64 + 1) / steps;
            for (step, end) in
                concurrently(steps as usize, |step| run(number, count, limit(step))).into_iter().enumerate()
            {
                let more = limit(step);
                match end {
                    Ok((status, _)) if status == DelotetStatus::Ok as i32 => ends[0] += 1,
                    Ok((status, _)) if status == DelotetStatus::OutOfMemory as i32 => ends[1] += 1,
                    Ok((status, _)) => faults.push(format!("{name}, {more} bytes: status {status}")),
                    Err(error) => faults.push(format!("{name}, {more} bytes: {error}")),
                }
            }
            let [meshes, short] = ends;
            println!(
                "{name}: {count} points, {most} bytes; {steps} limits: {meshes} meshes, {short} times out of memory, {} faults",
                steps - meshes - short
            );
            assert!(meshes > 0 && short > 0, "{name}: {meshes} meshes, {short} times out of memory");
        }
    }
}
