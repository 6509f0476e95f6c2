//! Exact three-dimensional constrained Delaunay tetrahedralization.
//!
//! A [`Plc`] (piecewise linear complex: points, segments, facets, holes, regions) goes in, a [`TetMesh`] comes out
//! whose boundary is exactly the input's. Every topological decision follows an exact sign: there is no tolerance, and no valid input
//! fails. The same input and options give the same bytes.
//!
//! [`doc`] is the guide for users: installation, options, formats, guarantees, figures.
//!
//! # Module graph
//!
//! The folders are the stages of the paper (Si & Gärtner 2011) in their order, each made of those below it. What a line names on the
//! right it may import; `capi-tests/architecture.rs` enforces it.
//!
//! ```text
//! rim       ffi  cli  io  query  check       the C interface, the program, files, queries and audits of finished meshes
//! plan                                       the pipeline and its retries: the only place that knows the order
//! stages    fill  optimise                   points inside by size; better angles
//!           blocks                           parts of a mesh as meshes of their own, for several threads
//!           preserve  rounding               the surface as it was (recover/, release/, settle); doubles for implicit points
//!           domain                           carving, holes, regions
//!           facets                           D1 → D2: every facet a union of faces
//!           segments                         D0 → D1: every segment a union of edges
//!           delaunay                         D0: the Delaunay tetrahedralization of the points
//!           plc                              the input: validation, polygons, merging → Surface
//! size                                       which edge length is wanted where
//! ops                                        local operations on a few tetrahedra: reconnection, sheets, insertion, positions
//! kernel                                     tetrahedra and their adjacency: topology alone, no coordinates
//! predicates                                 signs
//! leaves    control  elementary  error  fallible  options  output  panics  progress  threads  vector  warning  workers
//! ```
//!
//! What is below the rim is private to the crate.
//!
//! # Conventions
//!
//! * A tetrahedron `(a, b, c, d)` is *positive* when `det(b − a, c − a, d − a) > 0`: the unit corner (origin, x, y, z) is
//!   positive, as in VTK, Gmsh and MEDIT.
//! * Face `i` of a tetrahedron is opposite its vertex `i`. Indices are 0-based `u32`; [`INVALID`] means "none".
#![warn(clippy::all)]
#![cfg_attr(not(test), warn(clippy::disallowed_macros, clippy::disallowed_methods))]
#![cfg_attr(test, allow(clippy::disallowed_macros, clippy::disallowed_methods))]

mod blocks;
pub mod check;
mod control;
mod delaunay;
#[cfg(any(doc, doctest))]
pub mod doc;
mod domain;
mod elementary;
pub mod error;
mod facets;
mod fallible;
pub mod ffi;
mod fill;
#[cfg(feature = "internals")]
#[doc(hidden)]
pub mod internals;
#[cfg(feature = "io")]
pub mod io;
mod kernel;
mod ops;
mod optimise;
pub mod options;
pub mod output;
mod panics;
mod plan;
pub mod plc;
mod predicates;
mod preserve;
pub mod progress;
pub mod query;
mod refine;
mod rounding;
mod segments;
mod size;
mod threads;
mod vector;
pub mod warning;
mod workers;

pub use check::{check_guarantee, check_mesh, check_preserved, check_preserved_outer};
pub use control::{controlled, CancelToken, Control, Limits};
pub use error::{Defect, DefectKind, Element, Error, Status};
pub use options::{Mode, MshVersion, Options, Preserve, RegionName, SizeFunction, WriteOptions};
pub use output::{
    Dropped, FacetFlip, Guarantee, Lift, MeshArrays, OptimizeStatistics, PreserveStatistics,
    RefineStatistics, Region, Statistics, SteinerPoint, SteinerTerm, Subface, Subsegment, TetMesh,
};
pub use plan::given::{
    improve, improve_with, mesh_from_arrays, mesh_from_arrays_with, refine, refine_with, MeshSizes,
};
pub use plan::{tetrahedralize, tetrahedralize_with};
pub use plc::{Facet, Interior, MarkerName, MarkerSize, Plc, RegionSeed, RegionSize, Segment, Sizes};
pub use progress::{Observer, Phase, Silent};
pub use warning::{Warning, WarningKind, Warnings};

/// The index that means "none": no neighbour, no parent.
pub const INVALID: u32 = u32::MAX;
