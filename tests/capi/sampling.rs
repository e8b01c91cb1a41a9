//! Rule 9 of the C ABI: bulk calls into the caller's memory with strides and formats; and agreement of the outputs between formats,
//! between bulk and single calls, and between a snapshot and its restore.
#![allow(unsafe_code)] // calls of the C ABI

use std::ptr::{null, null_mut};

use superhelix::internals::capi::base::errors::SHX_OK;
use superhelix::internals::capi::base::guard::shx_solver;
use superhelix::internals::capi::base::types::*;
use superhelix::internals::capi::hair::roots::*;
use superhelix::internals::capi::hair::strand_def::*;
use superhelix::internals::capi::hair::strands::*;
use superhelix::internals::capi::reading::sampling::*;
use superhelix::internals::capi::simulation::solver::*;
use superhelix::internals::capi::simulation::state::*;
use superhelix::internals::capi::simulation::step::shx_solver_step;

const STRANDS: usize = 3;
const POINTS: usize = 5;

struct Scene {
    solver: *mut shx_solver,
    ids: [shx_strand_id; STRANDS],
}

impl Scene {
    fn new() -> Self {
        let mut solver = null_mut();
        let mut ids = [shx_strand_id { bits: 0 }; STRANDS];
        let natural = [[5.0, 30.0, 2.0]; 4];
        // SAFETY: handles, definitions and ids of the right sizes.
        unsafe {
            assert_eq!(shx_solver_create(null(), &raw mut solver), SHX_OK);
            let mut def = std::mem::MaybeUninit::<shx_strand_def>::uninit();
            assert_eq!(shx_strand_def_init(def.as_mut_ptr(), size_of::<shx_strand_def>()), SHX_OK);
            let mut defs = [def.assume_init(); STRANDS];
            for (index, def) in defs.iter_mut().enumerate() {
                def.length = 0.1 + 0.05 * index as f64;
                def.element_count = 4;
                def.natural_curvatures = natural.as_ptr().cast();
                def.radius = [4e-5, 9e-5];
                def.root.origin = [100.0, index as f64, 0.0];
            }
            assert_eq!(
                shx_solver_add_strands(solver, defs.as_ptr(), size_of::<shx_strand_def>(), STRANDS, ids.as_mut_ptr()),
                SHX_OK
            );
            assert_eq!(shx_solver_step(solver, 0.02, 2, null_mut()), SHX_OK);
        }
        Self { solver, ids }
    }

    fn sample(&self, origin: [f64; 3], points: Option<shx_output>, frames: Option<shx_output>, velocities: Option<shx_output>) {
        self.sample_by(&shx_sample_def { origin, ..sample_def() }, points, frames, velocities);
    }

    fn sample_by(
        &self,
        def: &shx_sample_def,
        points: Option<shx_output>,
        frames: Option<shx_output>,
        velocities: Option<shx_output>,
    ) {
        let pointer = |output: &Option<shx_output>| output.as_ref().map_or(null(), std::ptr::from_ref);
        // SAFETY: outputs over memory of the test.
        let result = unsafe {
            shx_solver_sample_strands(
                self.solver,
                self.ids.as_ptr(),
                STRANDS,
                def,
                pointer(&points),
                pointer(&frames),
                pointer(&velocities),
            )
        };
        assert_eq!(result, SHX_OK);
    }
}

/// The defaults, with few points.
fn sample_def() -> shx_sample_def {
    let mut def = std::mem::MaybeUninit::<shx_sample_def>::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_sample_def_init(def.as_mut_ptr(), size_of::<shx_sample_def>()), SHX_OK);
        shx_sample_def { points_per_strand: POINTS as u32, ..def.assume_init() }
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: this scene's handle.
        unsafe { shx_solver_destroy(self.solver) };
    }
}

fn output<T>(memory: &mut [T], format: u32) -> shx_output {
    shx_output { data: memory.as_mut_ptr().cast(), stride: 0, count: memory.len(), format, reserved: 0 }
}

#[test]
fn rule_9_formats_agree_and_bytes_between_items_are_left_alone() {
    let scene = Scene::new();
    let mut exact = [[0.0_f64; 3]; STRANDS * POINTS];
    let mut frames = [[0.0_f64; 7]; STRANDS * POINTS];
    let mut velocities = [[0.0_f64; 3]; STRANDS * POINTS];
    scene.sample(
        [0.0; 3],
        Some(output(&mut exact, SHX_FORMAT_F64X3)),
        Some(output(&mut frames, SHX_FORMAT_FRAME)),
        Some(output(&mut velocities, SHX_FORMAT_F64X3)),
    );
    assert_eq!((exact[0], exact[POINTS]), ([100.0, 0.0, 0.0], [100.0, 1.0, 0.0]));
    assert!(velocities[POINTS - 1][2] < 0.0, "it falls: {velocities:?}");

    // A vertex of a renderer: position and radius, with other data before and behind, in memory of no alignment.
    const STRIDE: usize = 29;
    let mut bytes = [0xa5_u8; 1 + STRIDE * STRANDS * POINTS];
    let vertices = shx_output {
        data: bytes[1..].as_mut_ptr().cast(),
        stride: STRIDE,
        count: STRANDS * POINTS,
        format: SHX_FORMAT_F32X4,
        reserved: 0,
    };
    let origin = [100.0, 0.5, 0.0];
    scene.sample(origin, Some(vertices), None, None);
    for (item, exact) in exact.iter().enumerate() {
        let vertex = &bytes[1 + item * STRIDE..1 + (item + 1) * STRIDE];
        let number = |at: usize| f32::from_ne_bytes(vertex[4 * at..4 * at + 4].try_into().expect("four bytes"));
        for axis in 0..3 {
            // Floats alone are worked out in single precision: good to 1e-6 of the strand's length, at most 0.2 m, and rounded once.
            let expected = exact[axis] - origin[axis];
            assert!((f64::from(number(axis)) - expected).abs() < 2e-7 + 6e-8 * expected.abs());
        }
        assert_eq!(number(3), 6e-5);
        assert!(vertex[16..].iter().all(|byte| *byte == 0xa5));
        assert_eq!(frames[item][..3], *exact);
        let norm: f64 = frames[item][3..].iter().map(|number| number * number).sum();
        assert!((norm - 1.0).abs() < 1e-12);
    }
    assert_eq!(bytes[0], 0xa5);

    // Quaternions alone.
    let mut quaternions = [[0.0_f32; 4]; STRANDS * POINTS];
    scene.sample([0.0; 3], None, Some(output(&mut quaternions, SHX_FORMAT_F32X4)), None);
    for (quaternion, frame) in quaternions.iter().zip(&frames) {
        for number in 0..4 {
            assert!((f64::from(quaternion[number]) - frame[3 + number]).abs() < 1e-6);
        }
    }

    // Tangents alone: the first axes of the frames, as floats and as doubles, of all strands and of one.
    let (mut floats, mut doubles) = ([[0.0_f32; 3]; STRANDS * POINTS], [[0.0_f64; 3]; STRANDS * POINTS]);
    scene.sample([0.0; 3], None, Some(output(&mut floats, SHX_FORMAT_F32X3)), None);
    scene.sample([0.0; 3], None, Some(output(&mut doubles, SHX_FORMAT_F64X3)), None);
    for (item, frame) in frames.iter().enumerate() {
        let expected = axes_of(&frame[3..])[0];
        assert!((nalgebra::Vector3::from(doubles[item]) - expected).norm() < 1e-14, "{item}: {:?} {expected}", doubles[item]);
        assert!((nalgebra::Vector3::from(floats[item].map(f64::from)) - expected).norm() < 2e-6, "{item}");
        assert!((nalgebra::Vector3::from(floats[item]).norm() - 1.0).abs() < 2e-7, "{item}");
    }
    let mut at = [[0.0_f64; 3]; 2];
    let tangents = output(&mut at, SHX_FORMAT_F64X3);
    // SAFETY: a living handle, two numbers, and room for two tangents.
    let result = unsafe {
        let (id, places) = (scene.ids[0], [0.0, 0.1]);
        shx_solver_sample_at(scene.solver, id, places.as_ptr(), 2, null(), null(), &raw const tangents, null())
    };
    assert_eq!(result, SHX_OK);
    for axis in 0..3 {
        let ends = [doubles[0][axis], doubles[POINTS - 1][axis]];
        assert!((at[0][axis] - ends[0]).abs() < 1e-12 && (at[1][axis] - ends[1]).abs() < 1e-12, "{at:?}");
    }
}

/// The axes of a frame, from its quaternion x, y, z, w.
fn axes_of(q: &[f64]) -> [nalgebra::Vector3<f64>; 3] {
    let turn = nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(q[3], q[0], q[1], q[2]));
    [nalgebra::Vector3::x(), nalgebra::Vector3::y(), nalgebra::Vector3::z()].map(|axis| turn * axis)
}

#[test]
fn rule_9_single_and_bulk_calls_agree() {
    let scene = Scene::new();
    let mut bulk = [[0.0_f64; 4]; STRANDS * POINTS];
    scene.sample([0.0; 3], Some(output(&mut bulk, SHX_FORMAT_F64X4)), None, None);
    for (strand, id) in scene.ids.iter().enumerate() {
        let length = 0.1 + 0.05 * strand as f64;
        let arclengths: Vec<f64> = (0..POINTS).rev().map(|point| length * (point as f64 / (POINTS - 1) as f64)).collect();
        let mut single = [[0.0_f64; 4]; POINTS];
        let points = output(&mut single, SHX_FORMAT_F64X4);
        // SAFETY: arclengths and memory of the test.
        unsafe {
            let arclengths = arclengths.as_ptr();
            let result = shx_solver_sample_at(scene.solver, *id, arclengths, POINTS, null(), &raw const points, null(), null());
            assert_eq!(result, SHX_OK);
        }
        single.reverse();
        for point in 0..POINTS {
            for number in 0..4 {
                assert!((single[point][number] - bulk[strand * POINTS + point][number]).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn rule_9_roots_are_read_and_written_with_strides() {
    let scene = Scene::new();
    #[repr(C)]
    struct Bone {
        name: [u8; 20],
        frame: shx_frame,
    }
    let half = 0.5_f64.sqrt();
    let bones = [0, 1, 2].map(|index| Bone {
        name: [0; 20],
        frame: shx_frame { origin: [1.0, 2.0, f64::from(index)], rotation: [0.0, half, 0.0, half] },
    });
    assert!(bones.iter().all(|bone| bone.name[0] == 0));
    let frames = shx_input {
        data: (&raw const bones[0].frame).cast(),
        stride: size_of::<Bone>(),
        count: STRANDS,
        format: SHX_FORMAT_FRAME,
        reserved: 0,
    };
    let mut read = [[0.0_f64; 7]; STRANDS];
    let found = output(&mut read, SHX_FORMAT_FRAME);
    // SAFETY: ids and memory of the test.
    unsafe {
        let ids = scene.ids.as_ptr();
        assert_eq!(shx_solver_teleport_roots(scene.solver, ids, STRANDS, &raw const frames), SHX_OK);
        assert_eq!(shx_solver_get_root_frames(scene.solver, ids, STRANDS, &raw const found), SHX_OK);
        for (strand, frame) in read.iter().enumerate() {
            assert_eq!(frame[..3], [1.0, 2.0, strand as f64]);
            assert!((frame[4] - half).abs() < 1e-15 && (frame[6] - half).abs() < 1e-15);
        }
        // And smoothly, to be there after the time that was given.
        assert_eq!(
            shx_solver_set_root_frames(scene.solver, [scene.ids[1]].as_ptr(), 1, &shx_input { count: 1, ..frames }, 0.02),
            SHX_OK
        );
        assert_eq!(shx_solver_step(scene.solver, 0.02, 2, null_mut()), SHX_OK);
        assert_eq!(shx_solver_get_root_frames(scene.solver, ids, STRANDS, &raw const found), SHX_OK);
        assert!((read[1][2] - 0.0).abs() < 1e-12 && (read[0][2] - 0.0).abs() < 1e-12 && (read[2][2] - 2.0).abs() < 1e-12);
    }
}

#[test]
fn a_restored_solver_steps_to_the_same_bits() {
    let (scene, other) = (Scene::new(), Scene::new());
    // SAFETY: living handles and an image of the size that was asked for.
    unsafe {
        let mut size = 0;
        assert_eq!(shx_solver_snapshot(scene.solver, null_mut(), 0, &raw mut size), SHX_OK);
        let mut image = vec![0_u8; size];
        assert_eq!(shx_solver_snapshot(scene.solver, image.as_mut_ptr().cast(), size, &raw mut size), SHX_OK);
        let step_and_hash = |solver| {
            let mut hash = 0;
            assert_eq!(shx_solver_step(solver, 0.05, 4, null_mut()), SHX_OK);
            assert_eq!(shx_solver_state_hash(solver, &raw mut hash), SHX_OK);
            hash
        };
        let first = step_and_hash(scene.solver);
        assert_ne!(step_and_hash(scene.solver), first);
        assert_eq!(shx_solver_restore(scene.solver, image.as_ptr().cast(), size), SHX_OK);
        assert_eq!(step_and_hash(scene.solver), first);
        step_and_hash(other.solver);
        assert_eq!(shx_solver_restore(other.solver, image.as_ptr().cast(), size), SHX_OK);
        assert_eq!(step_and_hash(other.solver), first);
        // The ids of the image are those of the restored solver.
        assert!(shx_solver_has_strand(other.solver, scene.ids[2]));
    }
}

#[test]
fn the_force_on_a_follicle_at_rest_is_the_weight() {
    let mut solver = null_mut();
    let mut id = shx_strand_id { bits: 0 };
    // SAFETY: handles, definitions and outputs of the right sizes.
    unsafe {
        assert_eq!(shx_solver_create(null(), &raw mut solver), SHX_OK);
        let mut def = std::mem::MaybeUninit::<shx_strand_def>::uninit();
        assert_eq!(shx_strand_def_init(def.as_mut_ptr(), size_of::<shx_strand_def>()), SHX_OK);
        let mut def = def.assume_init();
        def.length = 0.2;
        def.element_count = 6;
        let half = 0.5_f64.sqrt();
        def.root.rotation = [0.0, half, 0.0, half]; // straight down
        assert_eq!(shx_solver_add_strands(solver, &raw const def, size_of::<shx_strand_def>(), 1, &raw mut id), SHX_OK);
        assert_eq!(shx_solver_step(solver, 0.01, 1, null_mut()), SHX_OK);
        let (mut force, mut torque) = ([[0.0_f64; 3]; 1], [[1.0_f32; 3]; 1]);
        let forces = output(&mut force, SHX_FORMAT_F64X3);
        let torques = output(&mut torque, SHX_FORMAT_F32X3);
        assert_eq!(shx_solver_root_wrenches(solver, &raw const id, 1, &raw const forces, &raw const torques), SHX_OK);
        let weight = 1300.0 * std::f64::consts::PI * 50e-6 * 50e-6 * 0.2 * 9.81;
        assert!((force[0][2] + weight).abs() < 1e-9 * weight, "{force:?} {weight}");
        assert!(torque[0].iter().all(|number| number.abs() < 1e-12), "{torque:?}");
        shx_solver_destroy(solver);
    }
}

/// A host in centimetres, y up, left-handed, somewhere else: what the library gives it is what the host would have made of the world's numbers.
#[test]
fn outputs_come_in_the_host_s_units_and_axes() {
    const COUNT: usize = STRANDS * POINTS;
    let scene = Scene::new();
    let origin = [99.0, -1.0, 0.5];
    let (mut points, mut frames, mut velocities) = ([[0.0_f64; 4]; COUNT], [[0.0_f64; 7]; COUNT], [[0.0_f64; 3]; COUNT]);
    let doubles = |points: &mut [[f64; 4]; COUNT], frames: &mut [[f64; 7]; COUNT], velocities: &mut [[f64; 3]; COUNT], def| {
        let places = (output(points, SHX_FORMAT_F64X4), output(frames, SHX_FORMAT_FRAME), output(velocities, SHX_FORMAT_F64X3));
        scene.sample_by(&def, Some(places.0), Some(places.1), Some(places.2));
    };
    doubles(&mut points, &mut frames, &mut velocities, shx_sample_def { origin, ..sample_def() });
    // World x becomes the host's x, z its y, and y its z: a mirror, since both are written right-handed. Then one that only turns.
    for (mirrored, y_axis) in [(true, [0.0, 0.0, 100.0]), (false, [0.0, 0.0, -100.0])] {
        let (x_axis, z_axis, translation) = ([100.0, 0.0, 0.0], [0.0, 100.0, 0.0], [7.0, -3.0, 1.0]);
        let def = shx_sample_def { origin, x_axis, y_axis, z_axis, translation, ..sample_def() };
        let side = if mirrored { 1.0 } else { -1.0 };
        let mapped = |v: &[f64]| [100.0 * v[0], 100.0 * v[2], 100.0 * side * v[1]];
        let (mut host_points, mut host_frames, mut host_velocities) = ([[0.0; 4]; COUNT], [[0.0; 7]; COUNT], [[0.0; 3]; COUNT]);
        doubles(&mut host_points, &mut host_frames, &mut host_velocities, def);
        let (mut singles, mut quaternions) = ([[0.0_f32; 4]; COUNT], [[0.0_f32; 4]; COUNT]);
        let places = (output(&mut singles, SHX_FORMAT_F32X4), output(&mut quaternions, SHX_FORMAT_F32X4));
        scene.sample_by(&def, Some(places.0), Some(places.1), None);
        let (mut tangents, mut single_tangents) = ([[0.0_f64; 3]; COUNT], [[0.0_f32; 3]; COUNT]);
        scene.sample_by(&def, None, Some(output(&mut tangents, SHX_FORMAT_F64X3)), None);
        scene.sample_by(&def, None, Some(output(&mut single_tangents, SHX_FORMAT_F32X3)), None);
        for item in 0..COUNT {
            let (position, velocity) = (mapped(&points[item]), mapped(&velocities[item]));
            for axis in 0..3 {
                let expected = position[axis] + translation[axis];
                assert!((host_points[item][axis] - expected).abs() < 1e-10, "{item} {axis}");
                assert!((f64::from(singles[item][axis]) - expected).abs() < 2e-5 + 6e-8 * expected.abs());
                assert_eq!(host_points[item][axis], host_frames[item][axis]);
                assert!((host_velocities[item][axis] - velocity[axis]).abs() < 1e-10 * (1.0 + velocity[axis].abs()));
            }
            assert!((host_points[item][3] - 100.0 * points[item][3]).abs() < 1e-15 && (singles[item][3] - 6e-3).abs() < 1e-9);
            // The host's frame has the mapped tangent and first normal, and is a rotation.
            let (own, host) = (axes_of(&frames[item][3..]), axes_of(&host_frames[item][3..]));
            for k in 0..3 {
                let sign = if mirrored && k == 2 { -1.0 } else { 1.0 };
                let expected = nalgebra::Vector3::from(mapped(own[k].as_slice())) * (sign / 100.0);
                assert!((host[k] - expected).norm() < 1e-12, "{item} axis {k}");
            }
            // Tangents turn along and stay of unit length.
            assert!((nalgebra::Vector3::from(tangents[item]) - host[0]).norm() < 1e-12, "{item}");
            assert!((nalgebra::Vector3::from(single_tangents[item].map(f64::from)) - host[0]).norm() < 2e-6, "{item}");
            for k in 0..4 {
                let (a, b) = (f64::from(quaternions[item][k]), host_frames[item][3 + k]);
                assert!((a - b).abs() < 1e-5 || (a + b).abs() < 1e-5);
            }
        }
        // One strand at arclengths, by the same axes.
        let mut at = [[0.0_f64; 3]; 2];
        let place = output(&mut at, SHX_FORMAT_F64X3);
        // SAFETY: a living handle, two numbers, a definition and room for two points.
        let result = unsafe {
            let (id, places) = (scene.ids[0], [0.0, 0.1]);
            shx_solver_sample_at_with(scene.solver, id, places.as_ptr(), 2, &raw const def, &raw const place, null(), null())
        };
        assert_eq!(result, SHX_OK);
        for axis in 0..3 {
            assert!(
                (at[0][axis] - host_points[0][axis]).abs() < 1e-10 && (at[1][axis] - host_points[POINTS - 1][axis]).abs() < 1e-10
            );
        }
    }
}
