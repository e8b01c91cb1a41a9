//! Bodies: nearest points of shapes against dense sampling, meshes refitted against meshes built anew, grids against the meshes that they
//! were baked from, touches along strands against dense sampling of arclength, and sweeps against dense sampling of time.

mod contact_bodies {
    pub mod detection;
    pub mod grids;
    pub mod meshes;
    pub mod motion;
    pub mod scene;
    pub mod shapes;
    pub mod sweeps;
}
