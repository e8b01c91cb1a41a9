//! A hair engine to build into other programs.
//!
//! Strands are Super-Helices (Bertails et al. 2006): inextensible rods made of helical elements, with bending, twist and every inertial term,
//! straight or curly, simulated at second order at the time steps that animation uses.
//!
//! # Example
//!
//! A strand hangs from a head that turns, and stays outside of it:
//!
//! ```
//! use std::sync::Arc;
//!
//! use superhelix::nalgebra::{UnitQuaternion, Vector3};
//! use superhelix::{
//!     BodyDef, Frame, Material, Shape, Solver, SolverOptions, StrandContact, StrandDef,
//! };
//!
//! // All defaults: SI units, gravity along -z.
//! let mut solver = Solver::new(SolverOptions::default())?;
//!
//! // A head of 9 cm, and a strand of 20 cm that leaves it along +x.
//! let head = solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_sphere(0.09)?))])?[0];
//! let root = Frame { origin: Vector3::new(0.0905, 0.0, 0.0), ..Frame::default() };
//! let strand = StrandDef {
//!     root,
//!     material: Material { air_drag: 5e-6, ..Material::default() },
//!     ..StrandDef::straight(0.2, 5)
//! };
//! let strand = solver.add_strands(&[strand])?[0];
//! solver.set_contact(&[strand], Some(&StrandContact::default()))?;
//!
//! // A second of animation: the head turns about z, and takes the root along.
//! for frame in 1..=60 {
//!     let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.01 * f64::from(frame));
//!     let pose = Frame { rotation: turn, ..Frame::default() };
//!     solver.set_body_frames(&[head], &[pose], 1.0 / 60.0)?;
//!     solver.set_root_frames(&[strand], &[pose.compose(&root)], 1.0 / 60.0)?;
//!     let report = solver.step(1.0 / 60.0, 1)?;
//!     assert_eq!(report.quarantined, 0);
//! }
//!
//! // Where the tip is now.
//! let mut tip = Vector3::zeros();
//! solver.sample_at(strand, &[0.2], |_, sample| tip = sample.position)?;
//! assert!(tip.norm() > 0.09 && tip.z < -0.05);
//! # Ok::<(), superhelix::Error>(())
//! ```
//!
//! # Where to look
//!
//! | for | see |
//! |---|---|
//! | strands, bodies, contact, constraints, time steps | [`Solver`] and this level |
//! | a file of guides made into strands that rest as drawn | [`Groom`], [`GroomOptions`], [`Wisp`] |
//! | kinds of hair, fits, scalps | [`hair`] |
//! | a hundred thousand hairs that follow the strands | [`render`] |
//! | grooms, meshes, motions, caches | [`io`] |
//! | shapes of bodies | [`shapes`] |
//! | cutting, posing, heating, settling, clips | [`editing`] |
//! | points in bulk, contact events, snapshots | [`reading`] |
//! | combs, brushes, hot plates; a tool in a hand | [`tools`], [`haptic`] |
//! | settings by the error that may be made | [`settings`] |
//! | friction from a recording, combing force, buckling | [`experiments`] |
//!
//! # Conventions
//!
//! - Lengths are in metres, masses in kilograms, times in seconds, angles in radians. Vectors, quaternions and rotations are those of
//!   [`nalgebra`], which this crate re-exports.
//! - A [`Frame`] maps local axes to the world's. The first axis of a root's frame is the direction in which the strand leaves.
//! - Curvature rows are (twist κ0, κ1, κ2) in rad/m, one for each element.
//! - A call that returns an [`Error`] has changed nothing. The error names the argument and its value.
//! - Results are the same to the bit for any number of threads and any vector instructions. [`Solver`] is `Send` and `Sync`: it is read
//!   from several threads at once, and changed by one.
//!
//! The crate is also a C library with bindings for C++, C# and Python. Its guide, with theory and validation, is in the folder `docs` of the
//! package.

// Files:
//
// - `error.rs`: Errors that the caller can act on: each names the argument and the value.
// - `memory.rs`: Fallible allocation: memory that grows with a host's numbers is reserved in advance, so that its lack is an error and not an abort.
// - `meter.rs`: The budget of a substep: work, which is counted and the same on every machine; a deadline; and a flag with which the host cancels.
// - `platform.rs`: Platform features: clock, threads, process ids.
// - `workers.rs`: Runs work on many strands: on the calling thread, in a private pool, or by the host's task system.
// - `analysis/`: Analysis of strands, on top of the solver: settings by error, elements by need, friction from recordings, combing force, equilibria that buckle.
// - `capi/`: The C ABI: opaque handles, definitions that can grow, result codes, and one guard on every entry point.
// - `chain/`: The linear systems of one strand: the linear-time elimination from tip to root, and the dense reference it is tested against.
// - `contact/`: Contact and bilateral constraints: bodies and hair against hair.
// - `coupled/`: The step of coupled strands: strands that contacts and bilateral constraints act on, in islands of those that constraints couple.
// - `energy/`: The terms of the incremental potential, one file per term.
// - `facade/`: What Rust programs see: the public names, gathered from the modules that define them.
// - `files/`: Files: grooms, motions and caches, read and written.
// - `groom/`: From measured and modelled hair to strands.
// - `haptics/`: Force feedback: a tool in a hand, through a haptic device, in simulated hair.
// - `math/`: Numbers: lanes, entire functions, small vectors and matrices, quadrature, splines, rigid poses and their motion.
// - `rod/`: One strand by itself: material, freedoms, kinematics.
// - `solver/`: The scene: strands, their roots, the step, and everything a host reads back.
// - `step/`: Time integration of one strand.
// - `styling/`: Styling by hand: bodies of tools, and combs whose teeth hold the strands that they meet until these are combed.

mod analysis;
mod capi;
mod chain;
mod contact;
mod coupled;
mod energy;
mod error;
mod facade;
mod files;
mod groom;
mod haptics;
mod math;
mod memory;
mod meter;
mod platform;
mod rod;
mod solver;
mod step;
mod styling;
mod workers;

pub use facade::*;
pub use nalgebra;

/// Everything, for the tests, benches, examples and the command line of this repository. No part of the interface: it changes without notice.
#[doc(hidden)]
pub mod internals {
    macro_rules! expose {
        ($($module:ident)*) => {
            $(pub mod $module {
                pub use crate::$module::*;
            })*
        };
    }

    expose! { analysis capi chain contact coupled energy error files groom haptics math meter rod solver step styling workers }
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    /// Files below a folder.
    fn files(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).expect("sources") {
            let path = entry.expect("an entry").path();
            if path.is_dir() { files(&path, found) } else { found.push(path) }
        }
    }

    /// `unsafe_code` is denied to the crate (`Cargo.toml`); these modules alone allow it to themselves.
    #[test]
    fn unsafe_code_is_in_the_c_interface_and_the_vector_registers_alone() {
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut all = Vec::new();
        files(&source, &mut all);
        let allows = |path: &PathBuf| std::fs::read_to_string(path).expect("text").contains(concat!("allow(unsafe", "_code"));
        let mut allowed: Vec<String> = all
            .iter()
            .filter(|path| allows(path))
            .map(|path| path.strip_prefix(&source).expect("a source").to_string_lossy().replace('\\', "/"))
            .collect();
        allowed.sort();
        let expected = ["capi/mod.rs", "math/lanes/neon.rs", "math/lanes/simd128.rs", "math/lanes/x86.rs", "math/prefetch.rs"];
        assert_eq!(allowed, expected);
    }
}
