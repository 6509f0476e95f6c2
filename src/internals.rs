//! What benchmarks and tests outside the crate need of the engine. No part of the interface: it changes without notice.
pub use crate::control::Part;
pub use crate::delaunay::order::{insertion_order, Order};
pub use crate::delaunay::Construction;
pub use crate::kernel::Mesh;
pub use crate::predicates::{Points, Sign};
