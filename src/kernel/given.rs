//! The mesh of given tetrahedra, whatever domain they fill.
//!
//! Which faces are the same is known by then, and also which boundary faces follow each other around an edge with only void between: where
//! domains touch along an edge, that depends on positions, which the kernel does not know. So a boundary edge is closed as in
//! [`ghosts`](crate::kernel::ghosts): a ring around it passes every domain at it.
//!
//! Slot `t` has tetrahedron `t`, and then come the ghosts.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::{Mesh, GHOST, NONE};

/// Two boundary faces at an edge between which there is only void: around the edge, nothing else lies between them.
#[derive(Clone, Copy, Debug)]
pub struct Beside {
    /// The edge.
    pub edge: [u32; 2],
    /// Their corner codes.
    pub codes: [u32; 2],
}

/// The tetrahedra of a domain.
#[derive(Clone, Copy, Debug)]
pub struct Given<'a> {
    /// Corners, positive.
    pub tets: &'a [[u32; 4]],
    /// The corner code beyond each face; `NONE` at the boundary.
    pub across: &'a [[u32; 4]],
    /// Each boundary face once for each of its edges.
    pub beside: &'a [Beside],
}

impl Mesh {
    /// The mesh of these tetrahedra; vertices are below `vertex_count`.
    ///
    /// # Errors
    /// `Internal` if the boundary is not closed, `OutOfMemory`, `TooLarge`, and what ends the run.
    pub fn of_domain(given: Given, vertex_count: usize, control: &Control) -> Result<Mesh, Error> {
        let Given { tets, across, beside } = given;
        let sides = || (0u32..).zip(across.iter().flatten());
        let mut boundary: Vec<u32> = Vec::new();
        fallible::extend(&mut boundary, sides().filter(|x| *x.1 == NONE).map(|x| x.0))?;
        let mut mesh = Mesh::default();
        mesh.reserve(tets.len() + boundary.len())?;
        for &corners in tets {
            control.step()?;
            mesh.allocate(corners)?;
        }
        for (code, &other) in sides().filter(|x| *x.1 != NONE) {
            mesh.link(code, other);
        }
        for &code in &boundary {
            control.step()?;
            let [x, y, z] = mesh.face(code);
            let ghost = mesh.allocate([x, y, z, GHOST])?;
            mesh.adj[ghost as usize] = [NONE; 4];
            mesh.link(code, 4 * ghost + 3);
        }
        let ghost_of = |code: u32| Some((tets.len() + boundary.binary_search(&code).ok()?) as u32);
        for Beside { edge, codes } in beside {
            control.step()?;
            let [Some(g), Some(h)] = codes.map(ghost_of) else {
                return Err(Error::internal("a face beside the void is not on the boundary"));
            };
            let slot = |ghost: u32| (0..3).find(|&i| !edge.contains(&mesh.vertex(ghost, i)));
            let (Some(i), Some(j)) = (slot(g), slot(h)) else {
                return Err(Error::internal("a boundary face lacks its edge"));
            };
            mesh.link(4 * g + i, 4 * h + j);
        }
        if mesh.adj[tets.len()..].iter().flatten().any(|&code| code == NONE) {
            return Err(Error::internal("the boundary of the given tetrahedra is not closed"));
        }
        mesh.index_vertices(vertex_count)?;
        Ok(mesh)
    }
}
