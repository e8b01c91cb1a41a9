//! The start of every case of the table: a solver with strands, ids that name nothing, a groom, and memory for outputs.

use std::ffi::{CString, c_void};
use std::ptr::{null, null_mut};

use superhelix::internals::capi::base::errors::SHX_OK;
use superhelix::internals::capi::base::guard::shx_solver;
use superhelix::internals::capi::base::types::{
    SHX_FORMAT_F64X3, SHX_FORMAT_FRAME, shx_body_id, shx_constraint_id, shx_frame, shx_input, shx_output, shx_strand_id,
};
use superhelix::internals::capi::groom::curves::{shx_curves, shx_curves_read};
use superhelix::internals::capi::hair::strand_def::{shx_strand_def, shx_strand_def_init};
use superhelix::internals::capi::hair::strands::{shx_solver_add_strands, shx_solver_remove_strands};
use superhelix::internals::capi::scene::bodies::{shx_solver_add_bodies, shx_solver_remove_bodies};
use superhelix::internals::capi::scene::body_def::{SHX_SHAPE_MESH, SHX_SHAPE_SPHERE, shx_body_def, shx_body_def_init};
use superhelix::internals::capi::scene::constraints::{
    shx_constraint_def, shx_constraint_def_init, shx_solver_add_constraints, shx_solver_remove_constraints,
};
use superhelix::internals::capi::scene::contact::{shx_solver_set_strand_contact, shx_strand_contact, shx_strand_contact_init};
use superhelix::internals::capi::scene::contacts::shx_solver_contact_count;
use superhelix::internals::capi::simulation::solver::{shx_solver_create, shx_solver_destroy};
use superhelix::internals::capi::simulation::state::shx_solver_state_hash;
use superhelix::internals::capi::simulation::step::shx_solver_step;

/// What outputs are filled with; it must still be there after an error.
pub const UNTOUCHED: u8 = 0xa5;

/// Elements of each strand.
pub const ELEMENTS: usize = 3;

/// Corners and triangles of a closed mesh.
pub const CORNERS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0, 0.0, 0.01]];
pub const TRIANGLES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

pub struct Scene {
    pub solver: *mut shx_solver,
    pub ids: [shx_strand_id; 2],
    pub stale: [shx_strand_id; 1],
    pub foreign: [shx_strand_id; 1],
    /// A sphere, which the first strand touches, and a mesh.
    pub bodies: [shx_body_id; 2],
    pub stale_body: shx_body_id,
    pub foreign_body: shx_body_id,
    /// Pins of the second strand's tip and root.
    pub constraints: [shx_constraint_id; 2],
    pub stale_constraint: shx_constraint_id,
    pub foreign_constraint: shx_constraint_id,
    pub other: *mut shx_solver,
    pub curves: *mut shx_curves,
    pub groom: CString,
    pub rows: [[f64; 3]; ELEMENTS],
    pub frames: [shx_frame; 2],
    pub points: [[f64; 3]; 4],
    memory: Box<[u64; 1024]>,
    hash: u64,
}

pub fn strand() -> shx_strand_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one definition, which the call fills.
    unsafe {
        assert_eq!(shx_strand_def_init(def.as_mut_ptr(), size_of::<shx_strand_def>()), SHX_OK);
        let mut def = def.assume_init();
        def.length = 0.1;
        def.element_count = ELEMENTS as u32;
        def
    }
}

/// The output of a call.
fn filled<T>(fill: impl FnOnce(*mut T) -> i32) -> T {
    let mut made = std::mem::MaybeUninit::uninit();
    assert_eq!(fill(made.as_mut_ptr()), SHX_OK);
    // SAFETY: the call went well, so it filled the structure.
    unsafe { made.assume_init() }
}

/// A sphere.
pub fn body() -> shx_body_def {
    // SAFETY: room for one definition.
    let def = filled(|def| unsafe { shx_body_def_init(def, size_of::<shx_body_def>()) });
    let pose = shx_frame { origin: [0.05, 0.0, -0.0201], rotation: [0.0, 0.0, 0.0, 1.0] };
    shx_body_def { shape: SHX_SHAPE_SPHERE, radius: 0.02, pose, ..def }
}

/// A closed mesh, far away.
pub fn mesh() -> shx_body_def {
    shx_body_def {
        shape: SHX_SHAPE_MESH,
        pose: shx_frame { origin: [1.0, 0.0, 0.0], rotation: [0.0, 0.0, 0.0, 1.0] },
        vertices: input(CORNERS.as_ptr().cast(), 4, SHX_FORMAT_F64X3),
        triangles: TRIANGLES.as_ptr().cast(),
        triangle_count: 4,
        ..body()
    }
}

/// A pin of a strand's tip where it is when it hangs straight.
pub fn pin(strand: shx_strand_id) -> shx_constraint_def {
    // SAFETY: room for one definition.
    let def = filled(|def| unsafe { shx_constraint_def_init(def, size_of::<shx_constraint_def>()) });
    let target = shx_frame { origin: [0.09, 0.0, 0.0], rotation: [0.0, 0.0, 0.0, 1.0] };
    shx_constraint_def { strand, arclength: 0.1, target, ..def }
}

pub fn strand_contact() -> shx_strand_contact {
    // SAFETY: room for one structure.
    filled(|contact| unsafe { shx_strand_contact_init(contact, size_of::<shx_strand_contact>()) })
}

impl Scene {
    pub fn new() -> Self {
        let (mut solver, mut other, mut curves) = (null_mut(), null_mut(), null_mut());
        let none = shx_strand_id { bits: 0 };
        let (mut ids, mut gone, mut foreign) = ([none; 2], [none; 1], [none; 1]);
        let (mut bodies, mut foreign_body) = ([shx_body_id { bits: 0 }; 3], shx_body_id { bits: 0 });
        let (mut constraints, mut foreign_constraint) = ([shx_constraint_id { bits: 0 }; 3], shx_constraint_id { bits: 0 });
        let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("bad_input_{}.obj", std::process::id()));
        std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 0 0 1\nv 1 0 1\nl 1 2 3\nl 4 5\n").expect("a groom");
        let groom = CString::new(path.to_str().expect("UTF-8")).expect("a path");
        let def = [strand(); 2];
        let size = size_of::<shx_strand_def>();
        // SAFETY: all pointers refer to memory of the right size.
        unsafe {
            assert_eq!(shx_solver_create(null(), &raw mut solver), SHX_OK);
            assert_eq!(shx_solver_create(null(), &raw mut other), SHX_OK);
            assert_eq!(shx_solver_add_strands(solver, def.as_ptr(), size, 2, ids.as_mut_ptr()), SHX_OK);
            assert_eq!(shx_solver_add_strands(solver, def.as_ptr(), size, 1, gone.as_mut_ptr()), SHX_OK);
            assert_eq!(shx_solver_remove_strands(solver, gone.as_ptr(), 1), SHX_OK);
            assert_eq!(shx_solver_add_strands(other, def.as_ptr(), size, 1, foreign.as_mut_ptr()), SHX_OK);
            let (contact, sphere, size) = (strand_contact(), [body(), mesh(), body()], size_of::<shx_body_def>());
            assert_eq!(shx_solver_set_strand_contact(solver, ids.as_ptr(), 1, &raw const contact, 0), SHX_OK);
            assert_eq!(shx_solver_add_bodies(solver, sphere.as_ptr(), size, 3, bodies.as_mut_ptr()), SHX_OK);
            assert_eq!(shx_solver_remove_bodies(solver, &raw const bodies[2], 1), SHX_OK);
            assert_eq!(shx_solver_add_bodies(other, sphere.as_ptr(), size, 1, &raw mut foreign_body), SHX_OK);
            let (pins, size) = ([pin(ids[1]), pin(ids[1]), pin(ids[1])], size_of::<shx_constraint_def>());
            assert_eq!(shx_solver_add_constraints(solver, pins.as_ptr(), size, 3, constraints.as_mut_ptr()), SHX_OK);
            assert_eq!(shx_solver_remove_constraints(solver, &raw const constraints[2], 1), SHX_OK);
            let theirs = pin(foreign[0]);
            assert_eq!(shx_solver_add_constraints(other, &raw const theirs, size, 1, &raw mut foreign_constraint), SHX_OK);
            assert_eq!(shx_solver_step(solver, 0.01, 1, null_mut()), SHX_OK);
            let mut touching = 0;
            assert_eq!(shx_solver_contact_count(solver, &raw mut touching), SHX_OK);
            assert!(touching > 0, "the first strand lies on the sphere");
            assert_eq!(shx_curves_read(groom.as_ptr(), &raw mut curves), SHX_OK);
        }
        let frame = shx_frame { origin: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0] };
        let mut scene = Self {
            solver,
            ids,
            stale: gone,
            foreign,
            bodies: [bodies[0], bodies[1]],
            stale_body: bodies[2],
            foreign_body,
            constraints: [constraints[0], constraints[1]],
            stale_constraint: constraints[2],
            foreign_constraint,
            other,
            curves,
            groom,
            rows: [[1.0, 2.0, 3.0]; ELEMENTS],
            frames: [frame; 2],
            points: [[0.0; 3], [0.01, 0.0, 0.0], [0.02, 0.01, 0.0], [0.03, 0.01, 0.0]],
            memory: Box::new([u64::from_ne_bytes([UNTOUCHED; 8]); 1024]),
            hash: 0,
        };
        scene.hash = scene.state_hash();
        scene
    }

    fn state_hash(&self) -> u64 {
        let mut hash = 0;
        // SAFETY: a living solver and place for a number.
        unsafe { assert_eq!(shx_solver_state_hash(self.solver, &raw mut hash), SHX_OK) };
        hash
    }

    /// Memory for an output; two different places.
    pub fn out<T>(&mut self) -> *mut T {
        self.memory.as_mut_ptr().cast()
    }

    pub fn out2<T>(&mut self) -> *mut T {
        self.memory[512..].as_mut_ptr().cast()
    }

    pub fn out3<T>(&mut self) -> *mut T {
        self.memory[768..].as_mut_ptr().cast()
    }

    /// A good output of vectors over the memory.
    pub fn output(&mut self, count: usize) -> shx_output {
        shx_output { data: self.out(), stride: 0, count, format: SHX_FORMAT_F64X3, reserved: 0 }
    }

    /// A good output of frames.
    pub fn frame_output(&mut self, count: usize) -> shx_output {
        shx_output { format: SHX_FORMAT_FRAME, ..self.output(count) }
    }

    /// A good input of frames.
    pub fn frame_input(&self) -> shx_input {
        input(self.frames.as_ptr().cast(), 2, SHX_FORMAT_FRAME)
    }

    /// A good input of points.
    pub fn point_input(&self) -> shx_input {
        input(self.points.as_ptr().cast(), 4, SHX_FORMAT_F64X3)
    }

    /// That a failed call changed nothing and wrote nothing.
    pub fn check_untouched(&self, what: &str) {
        assert_eq!(self.state_hash(), self.hash, "{what}: the solver's state has changed");
        let untouched = u64::from_ne_bytes([UNTOUCHED; 8]);
        assert!(self.memory.iter().all(|word| *word == untouched), "{what}: an output was written");
    }
}

pub fn input(data: *const c_void, count: usize, format: u32) -> shx_input {
    shx_input { data, stride: 0, count, format, reserved: 0 }
}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: handles that this scene made.
        unsafe {
            shx_solver_destroy(self.solver);
            shx_solver_destroy(self.other);
            superhelix::internals::capi::groom::curves::shx_curves_destroy(self.curves);
        }
        let _ = std::fs::remove_file(self.groom.to_str().expect("UTF-8"));
    }
}
