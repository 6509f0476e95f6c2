//! The C ABI: an adapter over the Rust API, and the only unsafe code in the library.
//!
//! Conventions of every file here:
//!
//! * Exported functions are named `delotet_<noun>_<verb>`; their comments are written for C readers, since cbindgen copies
//!   them into `include/delotet/delotet.h`.
//! * Every body goes through [`guard`]: a panic becomes `DELOTET_STATUS_INTERNAL`, a null handle or array
//!   `DELOTET_STATUS_INVALID_ARGUMENT`. Bodies stay at 15 lines or fewer; real work is in safe modules.
//! * Values that C passes in are integers, never Rust enums: an unknown value must be an error, not undefined behaviour.
//! * Output arrays are views into the handle: pointer and count, valid until the handle is freed.
//!
//! Layers: imports `tetrahedralize`, `plc`, `control`, `options`, `output`, `check`, `io`, `mesh_query`, `error`, `progress`, `warning`.
#![allow(unsafe_code)]
#![allow(clippy::missing_safety_doc)]
#![deny(clippy::undocumented_unsafe_blocks)]

pub mod error;
pub mod file;
pub mod given;
mod guard;
pub mod limits;
pub mod memory;
pub mod mesh;
pub mod options;
pub mod plc;
mod plc_edit;
pub mod plc_view;
pub mod quality;
pub mod query;
pub mod run;
pub mod sizes;
pub mod skinny;
mod slice;
pub mod status;
pub mod version;
pub mod view;
pub mod voronoi;
pub mod warning;
pub mod weights;
pub mod write;

#[cfg(test)]
mod tests;
