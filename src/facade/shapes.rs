//! Shapes of bodies: primitives, hulls, triangle meshes, signed distance grids.
//!
//! A [`Shape`](crate::Shape) stands in its body's own axes, in metres, and is shared by an [`Arc`](std::sync::Arc): many bodies may have the
//! same one.
//!
//! ```
//! use std::sync::Arc;
//!
//! use superhelix::nalgebra::Vector3;
//! use superhelix::shapes::{DistanceGrid, Mesh, Sides};
//! use superhelix::{BodyDef, Shape};
//!
//! // A tetrahedron, its triangles counter-clockwise as seen from outside.
//! let corners = [(0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.1)];
//! let vertices: Vec<_> = corners.iter().map(|&(x, y, z)| Vector3::new(x, y, z)).collect();
//! let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
//! let solid = Shape::new_mesh(vertices.clone(), triangles.clone(), Sides::Solid)?;
//! let body = BodyDef { thickness: 1e-3, ..BodyDef::new(Arc::new(solid)) };
//!
//! // The same as a grid of distances: cells of 5 mm, exact to 20 mm from the surface. Queries cost the same for any number of triangles.
//! let grid = DistanceGrid::bake(&Mesh::for_baking(vertices, triangles)?, 5e-3, 0.02)?;
//! let surface = Shape::new_grid(grid).closest(Vector3::new(0.03, 0.03, -0.01), 0.02).expect("a surface within 20 mm");
//! assert!((surface.distance - 0.01).abs() < 1e-3);
//! # assert_eq!(body.friction, 1.0);
//! # Ok::<(), superhelix::Error>(())
//! ```

pub use crate::contact::shape::{Bounds, DistanceGrid, Mesh, Sides, Surface};
