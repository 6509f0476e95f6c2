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
//! Arrows point at what is imported; `capi-tests/architecture.rs` enforces them.
//!
//! ```text
//! ffi ──► tetrahedralize ──► region ──► constrain ──► delaunay ──► mesh ──► (nothing)
//!  │            │               │           │             └──────► predicates ──► (robust)
//!  │            ├──► output     └───────────┴──► plc ──► predicates, output
//!  │            └──► check ──► output, plc, predicates
//!  └──► plc, options, output, check, io, mesh_query ──► output, plc, predicates
//! io ──► mesh_query, plc, output
//! main (the command line) ──► everything above through the public API
//! doc: pages of text
//! elementary, error, fallible, options, panics, progress, warning: leaves, imported anywhere
//! vector: floating-point arithmetic, below plc, constrain, rounding, reconnect, preserve, io
//! ```
//!
//! # Conventions
//!
//! * A tetrahedron `(a, b, c, d)` is *positive* when `det(b − a, c − a, d − a) > 0`: the unit corner (origin, x, y, z) is
//!   positive, as in VTK, Gmsh and MEDIT.
//! * Face `i` of a tetrahedron is opposite its vertex `i`. Indices are 0-based `u32`; [`INVALID`] means "none".
#![warn(clippy::all)]

pub mod check;
pub mod constrain;
pub mod delaunay;
#[cfg(any(doc, doctest))]
pub mod doc;
mod elementary;
pub mod error;
mod fallible;
pub mod ffi;
#[cfg(feature = "io")]
pub mod io;
pub mod mesh;
pub mod mesh_query;
pub mod options;
pub mod output;
mod panics;
pub mod plc;
pub mod predicates;
pub mod preserve;
pub mod progress;
pub mod reconnect;
pub mod region;
pub mod rounding;
pub mod tetrahedralize;
mod vector;
pub mod warning;

pub use check::{check_guarantee, check_mesh, check_preserved, check_preserved_outer};
pub use error::{Defect, DefectKind, Element, Error, Status};
pub use options::{Mode, MshVersion, Options, Preserve, RegionName, WriteOptions};
pub use output::{
    Dropped, FacetFlip, Guarantee, PreserveStatistics, Region, Statistics, SteinerPoint, SteinerTerm,
    Subface, Subsegment, TetMesh,
};
pub use plc::{Facet, Interior, MarkerName, Plc, RegionSeed, Segment};
pub use progress::{Observer, Phase, Silent};
pub use tetrahedralize::tetrahedralize;
pub use warning::{Warning, WarningKind, Warnings};

/// The index that means "none": no neighbour, no parent.
pub const INVALID: u32 = u32::MAX;
