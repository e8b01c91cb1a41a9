//! Render hair and scalps through the C ABI: the numbers of the Rust functions, for any workers, into strided memory; guides from a solver; roots
//! from a scalp that deforms.
#![allow(unsafe_code)] // calls of the C ABI

use std::ffi::c_void;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicU32, Ordering};

use superhelix::internals::capi::base::errors::{SHX_ERROR_INVALID_ARGUMENT, SHX_OK};
use superhelix::internals::capi::base::guard::shx_solver;
use superhelix::internals::capi::base::parallel::shx_range_fn;
use superhelix::internals::capi::base::types::*;
use superhelix::internals::capi::groom::scalp::*;
use superhelix::internals::capi::hair::roots::shx_solver_set_root_frames;
use superhelix::internals::capi::hair::strand_def::{shx_strand_def, shx_strand_def_init};
use superhelix::internals::capi::hair::strands::shx_solver_add_strands;
use superhelix::internals::capi::render::render_def::*;
use superhelix::internals::capi::render::render_hair::*;
use superhelix::internals::capi::scene::bodies::shx_solver_add_bodies;
use superhelix::internals::capi::scene::body_def::{SHX_SHAPE_SPHERE, shx_body_def, shx_body_def_init};
use superhelix::internals::capi::simulation::solver::{shx_solver_create, shx_solver_destroy};
use superhelix::internals::capi::simulation::step::shx_solver_step;

/// What an `_init` function fills.
fn filled<T>(init: unsafe extern "C" fn(*mut T, usize) -> i32) -> T {
    let mut made = MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(init(made.as_mut_ptr(), size_of::<T>()), SHX_OK);
        made.assume_init()
    }
}

fn input<T>(data: &[T], count: usize, format: u32) -> shx_input {
    shx_input { data: data.as_ptr().cast(), stride: 0, count, format, reserved: 0 }
}

fn output<T>(data: &mut [T], count: usize, format: u32) -> shx_output {
    shx_output { data: data.as_mut_ptr().cast(), stride: 0, count, format, reserved: 0 }
}

const POINTS: usize = 11;

/// Guides that lean and bend, of 11 points each, in rows and columns.
fn curves() -> Vec<[f64; 3]> {
    (0..30 * POINTS)
        .map(|item| {
            let (guide, s) = (item / POINTS, (item % POINTS) as f64 / (POINTS - 1) as f64);
            let (x, y) = ((guide % 6) as f64 * 0.01, (guide / 6) as f64 * 0.01);
            [x + 0.1 * s * s * x / 0.06, y + 0.03 * (3.0 * s + x * 20.0).sin() - 0.03 * (x * 20.0).sin(), 0.15 * s]
        })
        .collect()
}

fn places(count: usize) -> Vec<[f32; 3]> {
    (0..count).map(|k| [(k % 29) as f32 * 0.0017, (k % 23) as f32 * 0.0018, 0.0]).collect()
}

struct Made {
    hair: *mut shx_render_hair,
    pose: *mut shx_render_pose,
}

impl Made {
    fn new(settings: &shx_render_settings, guides: &shx_render_guides, roots: &[[f32; 3]]) -> Self {
        let mut made = Self { hair: null_mut(), pose: null_mut() };
        let roots = input(roots, roots.len(), SHX_FORMAT_F32X3);
        // SAFETY: living structures and places for handles.
        unsafe {
            assert_eq!(shx_render_hair_create(settings, guides, &roots, &raw mut made.hair), SHX_OK);
            assert_eq!(shx_render_pose_create(made.hair, &raw mut made.pose), SHX_OK);
            assert_eq!(shx_render_pose_set_guides(made.pose, guides), SHX_OK);
        }
        made
    }

    fn points(&self, view: *const shx_render_view, strands: usize) -> Vec<[f32; 4]> {
        let mut points = vec![[f32::NAN; 4]; strands * POINTS];
        let place = output(&mut points, strands * POINTS, SHX_FORMAT_F32X4);
        // SAFETY: a living pose and memory of the size that is stated.
        unsafe { assert_eq!(shx_render_pose_evaluate(self.pose, view, &place, null(), null()), SHX_OK) };
        points
    }
}

impl Drop for Made {
    fn drop(&mut self) {
        // SAFETY: handles of this test; the pose outlives the hair for a moment, as it may.
        unsafe {
            shx_render_hair_destroy(self.hair);
            shx_render_pose_destroy(self.pose);
        }
    }
}

/// Mixing alone.
fn plain() -> shx_render_settings {
    shx_render_settings {
        points_per_strand: POINTS as u32,
        curliness: 0.0,
        flyaway_fraction: 0.0,
        length_variation: 0.0,
        preserve_length: 0,
        ..filled(shx_render_settings_init)
    }
}

fn settings(space: u32) -> shx_render_settings {
    let base = filled(shx_render_settings_init);
    shx_render_settings {
        points_per_strand: POINTS as u32,
        interpolation: space,
        curliness: 0.4,
        frizz: 0.002,
        wisps_per_guide: 2,
        ..base
    }
}

fn guides(points: &[[f64; 3]]) -> shx_render_guides {
    let base = filled(shx_render_guides_init);
    shx_render_guides { guide_count: 30, points: input(points, points.len(), SHX_FORMAT_F64X3), ..base }
}

#[test]
fn any_number_of_threads_writes_the_same_bits_into_any_stride() {
    static CALLS: AtomicU32 = AtomicU32::new(0);
    unsafe extern "C" fn backwards(_: *mut c_void, count: u32, _: u32, function: shx_range_fn, task: *mut c_void) {
        let function = function.expect("the engine's function");
        CALLS.fetch_add(1, Ordering::Relaxed);
        for item in (0..count).rev() {
            // SAFETY: called as the contract says.
            unsafe { function(task, item, item + 1, 0) };
        }
    }
    let (points, roots) = (curves(), places(1000));
    let guides = guides(&points);
    for space in [SHX_INTERPOLATION_POSITION, SHX_INTERPOLATION_CURVATURE] {
        let one = Made::new(&settings(space), &guides, &roots);
        let expected = one.points(null(), 1000);
        assert!(expected.iter().flatten().all(|value| value.is_finite()));
        for (root, strand) in roots.iter().zip(expected.chunks(POINTS)) {
            assert!((0..3).all(|axis| (root[axis] - strand[0][axis]).abs() < 1e-6), "{root:?} {:?}", strand[0]);
            assert!(strand[0][3] > strand[POINTS - 1][3] && strand[POINTS - 1][3] > 1e-5);
        }
        let pool = Made::new(&shx_render_settings { worker_count: 2, ..settings(space) }, &guides, &roots);
        assert!(pool.points(null(), 1000) == expected);
        let host = Made::new(&shx_render_settings { parallel_for: Some(backwards), ..settings(space) }, &guides, &roots);
        let before = CALLS.load(Ordering::Relaxed);
        assert!(host.points(null(), 1000) == expected);
        assert!(CALLS.load(Ordering::Relaxed) > before);
        // The host's own threads, a part each, at the same time.
        let mut parts = vec![[f32::NAN; 4]; 1000 * POINTS];
        struct Pose(*mut shx_render_pose);
        // SAFETY: evaluating may run beside itself.
        unsafe impl Sync for Pose {}
        let pose = Pose(one.pose);
        std::thread::scope(|scope| {
            for (index, part) in parts.chunks_mut(250 * POINTS).enumerate() {
                let pose = &pose;
                scope.spawn(move || {
                    let view = shx_render_view { first_strand: 250 * index, strand_count: 250, ..filled(shx_render_view_init) };
                    let place = output(part, 250 * POINTS, SHX_FORMAT_F32X4);
                    // SAFETY: a living pose and memory of the size that is stated.
                    unsafe { assert_eq!(shx_render_pose_evaluate(pose.0, &view, &place, null(), null()), SHX_OK) };
                });
            }
        });
        assert!(parts == expected);
        // Three floats of every nine words; the words between are left alone.
        let mut wide = vec![7.0_f32; 9 * 1000 * POINTS];
        let place = shx_output { stride: 36, ..output(&mut wide, 1000 * POINTS, SHX_FORMAT_F32X3) };
        // SAFETY: the same.
        unsafe { assert_eq!(shx_render_pose_evaluate(one.pose, null(), &place, null(), null()), SHX_OK) };
        for (item, point) in wide.chunks(9).zip(&expected) {
            assert!(item[..3] == point[..3] && item[3..] == [7.0; 6]);
        }
        let (mut firsts, mut wisps) = (vec![9_u32; 1000], vec![9_u32; 1000]);
        // SAFETY: places for 1000 numbers each.
        unsafe { assert_eq!(shx_render_hair_wisps(one.hair, 0, 1000, firsts.as_mut_ptr(), wisps.as_mut_ptr()), SHX_OK) };
        assert!(firsts.iter().all(|guide| *guide < 30) && wisps.iter().all(|wisp| *wisp < 2) && wisps.contains(&1));
    }
}

/// Tangents are the first axes of the frames, in the world and in a mirrored space in centimetres, where they stay of unit length.
#[test]
fn frames_are_given_by_their_tangents_too() {
    const STRANDS: usize = 200;
    let (points, roots) = (curves(), places(STRANDS));
    let guides = guides(&points);
    let made = Made::new(&settings(SHX_INTERPOLATION_POSITION), &guides, &roots);
    let world = filled(shx_render_view_init);
    let host = shx_render_view { x_axis: [100.0, 0.0, 0.0], y_axis: [0.0, 0.0, 100.0], z_axis: [0.0, 100.0, 0.0], ..world };
    for view in [&world, &host] {
        let (mut turns, mut tangents) = (vec![[0.0_f32; 4]; STRANDS * POINTS], vec![[0.0_f32; 3]; STRANDS * POINTS]);
        let frames = output(&mut turns, STRANDS * POINTS, SHX_FORMAT_F32X4);
        let along = output(&mut tangents, STRANDS * POINTS, SHX_FORMAT_F32X3);
        // SAFETY: a living pose and memory of the sizes that are stated.
        unsafe {
            assert_eq!(shx_render_pose_evaluate(made.pose, view, null(), &frames, null()), SHX_OK);
            assert_eq!(shx_render_pose_evaluate(made.pose, view, null(), &along, null()), SHX_OK);
        }
        let drawn = made.points(view, STRANDS);
        for item in 0..STRANDS * POINTS {
            let [x, y, z, w] = turns[item].map(f64::from);
            let turn = nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z));
            let tangent = nalgebra::Vector3::from(tangents[item].map(f64::from));
            assert!((tangent - turn * nalgebra::Vector3::x()).norm() < 2e-7, "{item}");
            assert!((tangent.norm() - 1.0).abs() < 2e-7, "{item}: {tangent}");
            // Towards the tip: with the edges beside it.
            if item % POINTS + 1 < POINTS {
                let [from, to] = [drawn[item], drawn[item + 1]].map(|[x, y, z, _]| nalgebra::Vector3::new(x, y, z).cast::<f64>());
                assert!((to - from).normalize().dot(&tangent) > 0.7, "{item}");
            }
        }
    }
}

#[test]
fn curves_of_any_number_of_points_are_sampled() {
    // Straight guides: their points uniform, and the same lines with points anywhere, some of them doubled, another number on each.
    let line = |guide: usize, s: f64| {
        let (x, y) = ((guide % 6) as f64 * 0.01, (guide / 6) as f64 * 0.01);
        [x + 0.05 * s * x / 0.06, y - 0.02 * s, (0.1 + 0.001 * guide as f64) * s]
    };
    let roots = places(200);
    let straight: Vec<_> =
        (0..30 * POINTS).map(|item| line(item / POINTS, (item % POINTS) as f64 / (POINTS - 1) as f64)).collect();
    let even = Made::new(&settings(SHX_INTERPOLATION_POSITION), &guides(&straight), &roots);
    let (mut uneven, mut counts) = (Vec::new(), Vec::new());
    for guide in 0..30 {
        let count = 4 + guide % 7;
        counts.push(count as u32 + 1);
        uneven.extend((0..count).map(|k| line(guide, (k as f64 / (count - 1) as f64).powi(2))));
        uneven.push(line(guide, 1.0));
    }
    let given = shx_render_guides { point_counts: counts.as_ptr(), ..guides(&uneven) };
    let sampled = Made::new(&settings(SHX_INTERPOLATION_POSITION), &given, &roots);
    for (a, b) in even.points(null(), 200).iter().zip(sampled.points(null(), 200)) {
        assert!((0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-6), "{a:?} {b:?}");
    }
}

/// A solver with strands that hang from the corners of a lattice.
fn solver(ids: &mut [shx_strand_id]) -> *mut shx_solver {
    let mut solver = null_mut();
    let defs: Vec<shx_strand_def> = (0..ids.len())
        .map(|index| {
            let mut def = filled(shx_strand_def_init);
            (def.length, def.element_count) = (0.1, 4);
            def.root.origin = [(index % 3) as f64 * 0.01, (index / 3) as f64 * 0.01, 0.0];
            def
        })
        .collect();
    // SAFETY: living structures and places for handles.
    unsafe {
        assert_eq!(shx_solver_create(null(), &raw mut solver), SHX_OK);
        assert_eq!(
            shx_solver_add_strands(solver, defs.as_ptr(), size_of::<shx_strand_def>(), ids.len(), ids.as_mut_ptr()),
            SHX_OK
        );
    }
    solver
}

#[test]
fn a_solvers_strands_carry_render_hair_with_them() {
    let mut ids = [shx_strand_id { bits: 0 }; 9];
    let solver = solver(&mut ids);
    let settings = plain();
    let roots: Vec<[f32; 3]> = (0..50).map(|k| [0.0004 * k as f32, 0.013, 0.001]).collect();
    let place = input(&roots, 50, SHX_FORMAT_F32X3);
    let mut made = Made { hair: null_mut(), pose: null_mut() };
    // SAFETY: living handles, structures and memory of the sizes that are stated.
    unsafe {
        assert_eq!(shx_solver_create_render_hair(solver, ids.as_ptr(), 9, &settings, &place, &raw mut made.hair), SHX_OK);
        assert_eq!(shx_render_pose_create(made.hair, &raw mut made.pose), SHX_OK);
        assert_eq!(shx_solver_set_render_pose(solver, ids.as_ptr(), 9, 0, made.pose), SHX_OK);
        // All strands are alike: render strands are as they are.
        let rest = made.points(null(), 50);
        for (root, strand) in roots.iter().zip(rest.chunks(POINTS)) {
            for k in 0..POINTS {
                let wanted = [root[0] + 0.01 * k as f32, root[1], root[2]];
                assert!((0..3).all(|axis| (strand[k][axis] - wanted[axis]).abs() < 1e-6), "{:?} {wanted:?}", strand[k]);
            }
        }
        // The head turns a quarter about z and moves while the strands fall: roots go with it, and velocities are the guides'.
        let frames: Vec<shx_frame> = (0..9)
            .map(|index| {
                let (x, y) = ((index % 3) as f64 * 0.01, (index / 3) as f64 * 0.01);
                let half = std::f64::consts::FRAC_1_SQRT_2;
                shx_frame { origin: [-y + 0.05, x, 0.2], rotation: [0.0, 0.0, half, half] }
            })
            .collect();
        let poses = input(&frames, 9, SHX_FORMAT_FRAME);
        assert_eq!(shx_solver_set_root_frames(solver, ids.as_ptr(), 9, &poses, 0.1), SHX_OK);
        assert_eq!(shx_solver_step(solver, 0.0999, 10, null_mut()), SHX_OK);
        assert_eq!(shx_solver_set_render_pose(solver, ids.as_ptr(), 9, 0, made.pose), SHX_OK);
        let earlier = made.points(null(), 50);
        assert_eq!(shx_solver_step(solver, 1e-4, 1, null_mut()), SHX_OK);
        assert_eq!(shx_solver_set_render_pose(solver, ids.as_ptr(), 9, 1, made.pose), SHX_OK);
        let (mut points, mut speeds) = (vec![[0.0_f32; 3]; 50 * POINTS], vec![[0.0_f32; 3]; 50 * POINTS]);
        let (at, moving) =
            (output(&mut points, 50 * POINTS, SHX_FORMAT_F32X3), output(&mut speeds, 50 * POINTS, SHX_FORMAT_F32X3));
        assert_eq!(shx_render_pose_evaluate(made.pose, null(), &at, null(), &moving), SHX_OK);
        for (root, strand) in roots.iter().zip(points.chunks(POINTS)) {
            let wanted = [-root[1] + 0.05, root[0], root[2] + 0.2];
            assert!((0..3).all(|axis| (strand[0][axis] - wanted[axis]).abs() < 2e-6), "{:?} {wanted:?}", strand[0]);
        }
        // Velocities, against where the strands were 0.1 ms before.
        let mut fastest = 0.0_f32;
        for (index, (point, before)) in points.iter().zip(&earlier).enumerate() {
            for axis in 0..3 {
                let speed = (point[axis] - before[axis]) / 1e-4;
                fastest = fastest.max(speed.abs());
                // f32 over 0.1 ms: 2e-8/1e-4; half of the acceleration over it, some 200 m/s².
                assert!((speed - speeds[index][axis]).abs() < 0.1, "{} {speed} {}", index % POINTS, speeds[index][axis]);
            }
        }
        assert!(fastest > 0.5, "{fastest}");
        shx_solver_destroy(solver);
    }
}

#[test]
fn roots_follow_a_scalp_that_deforms() {
    let corners: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [0.05, 0.0, 0.0], [0.05, 0.05, 0.0], [0.0, 0.05, 0.0]];
    let triangles = [[0_u32, 1, 2], [0, 2, 3]];
    let base = filled(shx_scalp_def_init);
    let def = shx_scalp_def {
        vertices: input(&corners, 4, SHX_FORMAT_F64X3),
        triangles: triangles.as_ptr().cast(),
        triangle_count: 2,
        ..base
    };
    let scatter = shx_scatter_def { count: 300, seed: 4, ..filled(shx_scatter_def_init) };
    let mut scalp = null_mut();
    let mut follicles = vec![shx_follicle { triangle: 9, reserved: 9, barycentric: [9.0; 2] }; 301];
    let (mut count, mut least) = (0, 0.0);
    let frame = shx_frame { origin: [0.0; 3], rotation: [0.0; 4] };
    let (mut rest, mut bent) = (vec![frame; 300], vec![frame; 300]);
    // SAFETY: living handles, structures and memory of the sizes that are stated.
    unsafe {
        assert_eq!(shx_scalp_create(&def, &raw mut scalp), SHX_OK);
        assert_eq!(shx_scalp_scatter(scalp, &scatter, null_mut(), 0, &raw mut count, null_mut()), SHX_OK);
        assert_eq!(count, 300);
        assert_eq!(shx_scalp_scatter(scalp, &scatter, follicles.as_mut_ptr(), 300, &raw mut count, &raw mut least), SHX_OK);
        assert!(follicles[300].triangle == 9 && least > 0.6 * 0.05 * (2.0 / (3.0_f64.sqrt() * 300.0)).sqrt(), "{least}");
        assert_eq!(
            shx_scalp_root_frames(scalp, null(), follicles.as_ptr(), 300, &output(&mut rest, 300, SHX_FORMAT_FRAME)),
            SHX_OK
        );
        assert!(rest.iter().all(|frame| frame.origin[2] == 0.0));
        // A corner is lifted; the render strands stand on the scalp before and after.
        let lifted: Vec<[f64; 3]> = corners.iter().map(|p| [p[0], p[1], 8.0 * p[0] * p[1]]).collect();
        let moved = input(&lifted, 4, SHX_FORMAT_F64X3);
        assert_eq!(
            shx_scalp_root_frames(scalp, &moved, follicles.as_ptr(), 300, &output(&mut bent, 300, SHX_FORMAT_FRAME)),
            SHX_OK
        );
        let roots: Vec<[f32; 3]> = rest.iter().map(|frame| frame.origin.map(|value| value as f32)).collect();
        let points = curves();
        let made = Made::new(&settings(SHX_INTERPOLATION_POSITION), &guides(&points), &roots);
        let view = shx_render_view { roots: input(&bent, 300, SHX_FORMAT_FRAME), ..filled(shx_render_view_init) };
        let strands = made.points(&view, 300);
        let mut highest = 0.0_f64;
        for (frame, strand) in bent.iter().zip(strands.chunks(POINTS)) {
            assert!((0..3).all(|axis| (frame.origin[axis] - f64::from(strand[0][axis])).abs() < 1e-7));
            highest = highest.max(frame.origin[2]);
        }
        assert!(highest > 0.01);
        shx_scalp_destroy(scalp);
    }
}

#[test]
fn strands_are_kept_out_of_a_solvers_bodies() {
    let mut ids = [shx_strand_id { bits: 0 }; 9];
    let solver = solver(&mut ids);
    let roots: Vec<[f32; 3]> = (0..80).map(|k| [0.0, 0.00025 * k as f32, 0.0]).collect();
    let place = input(&roots, 80, SHX_FORMAT_F32X3);
    let settings = shx_render_settings { preserve_length: 1, ..plain() };
    let mut made = Made { hair: null_mut(), pose: null_mut() };
    // Strands along x; a ball of 2 cm in their path at x = 6 cm, and one beside it that touches nothing.
    let mut bodies = [filled(shx_body_def_init), filled(shx_body_def_init)];
    for body in &mut bodies {
        (body.shape, body.radius) = (SHX_SHAPE_SPHERE, 0.02);
        body.pose.origin = [0.06, 0.01, 0.005];
    }
    bodies[1].pose.origin = [0.09, 0.01, 0.0];
    bodies[1].mask = 0;
    let mut body_ids = [shx_body_id { bits: 0 }; 2];
    // SAFETY: living handles, structures and memory of the sizes that are stated.
    unsafe {
        assert_eq!(shx_solver_create_render_hair(solver, ids.as_ptr(), 9, &settings, &place, &raw mut made.hair), SHX_OK);
        assert_eq!(shx_render_pose_create(made.hair, &raw mut made.pose), SHX_OK);
        assert_eq!(shx_solver_set_render_pose(solver, ids.as_ptr(), 9, 1, made.pose), SHX_OK);
        assert_eq!(shx_solver_add_bodies(solver, bodies.as_ptr(), size_of::<shx_body_def>(), 2, body_ids.as_mut_ptr()), SHX_OK);
        let depth = |points: &[[f32; 4]]| {
            let of = |p: &[f32; 4]| {
                let away = [f64::from(p[0]) - 0.06, f64::from(p[1]) - 0.01, f64::from(p[2]) - 0.005];
                0.02 - away.iter().map(|value| value * value).sum::<f64>().sqrt()
            };
            points.iter().map(of).fold(f64::NEG_INFINITY, f64::max)
        };
        let free = made.points(null(), 80);
        let (mut kept, mut speeds) = (vec![[f32::NAN; 4]; 80 * POINTS], vec![[f32::NAN; 3]; 80 * POINTS]);
        let at = output(&mut kept, 80 * POINTS, SHX_FORMAT_F32X4);
        let moving = output(&mut speeds, 80 * POINTS, SHX_FORMAT_F32X3);
        assert_eq!(shx_solver_evaluate_render_pose(solver, made.pose, null(), &at, null(), &moving), SHX_OK);
        // Edges are half as long as the ball's radius: points that slide along the spline between them cut corners.
        assert!(depth(&free) > 0.01 && depth(&kept) < 2e-3, "{} {}", depth(&free), depth(&kept));
        let length = |strand: &[[f32; 4]]| {
            let edge = |e: &[[f32; 4]]| (0..3).map(|k| (e[1][k] - e[0][k]).powi(2)).sum::<f32>().sqrt();
            strand.windows(2).map(edge).sum::<f32>()
        };
        for (before, after) in free.chunks(POINTS).zip(kept.chunks(POINTS)) {
            assert!((length(after) / length(before) - 1.0).abs() < 0.05, "{} {}", length(after), length(before));
            assert!(before[0] == after[0] && (before[3][0] - after[3][0]).abs() < 0.01);
        }
        // All stands still.
        assert!(speeds.iter().flatten().all(|speed| speed.abs() < 1e-3));
        shx_solver_destroy(solver);
    }
}

#[test]
fn hair_is_saved_and_outlives_a_guide() {
    let (points, roots) = (curves(), places(200));
    let whole = Made::new(&settings(SHX_INTERPOLATION_CURVATURE), &guides(&points), &roots);
    let expected = whole.points(null(), 200);
    // SAFETY: living handles, structures and memory of the sizes that are stated.
    unsafe {
        let mut size = 0;
        assert_eq!(shx_render_hair_save(whole.hair, null_mut(), 0, &raw mut size), SHX_OK);
        let mut image = vec![0_u8; size];
        assert_eq!(shx_render_hair_save(whole.hair, image.as_mut_ptr().cast(), size, &raw mut size), SHX_OK);
        for threads in [1, 2] {
            let settings = shx_render_settings { worker_count: threads, ..filled(shx_render_settings_init) };
            let mut again = Made { hair: null_mut(), pose: null_mut() };
            assert_eq!(shx_render_hair_load(image.as_ptr().cast(), size, &settings, &raw mut again.hair), SHX_OK);
            assert_eq!(shx_render_pose_create(again.hair, &raw mut again.pose), SHX_OK);
            assert_eq!(shx_render_pose_set_guides(again.pose, &guides(&points)), SHX_OK);
            assert!(again.points(null(), 200) == expected);
        }
        // Without guide 7 there are 29; strands that are elsewhere stay as they are.
        let mut fewer = Made { hair: null_mut(), pose: null_mut() };
        assert_eq!(shx_render_hair_without_guides(whole.hair, [7_u32].as_ptr(), 1, &raw mut fewer.hair), SHX_OK);
        assert_eq!(shx_render_pose_create(fewer.hair, &raw mut fewer.pose), SHX_OK);
        let left: Vec<_> = points.iter().enumerate().filter(|(item, _)| item / POINTS != 7).map(|(_, point)| *point).collect();
        let left = shx_render_guides { guide_count: 29, ..guides(&left) };
        assert_eq!(shx_render_pose_set_guides(fewer.pose, &left), SHX_OK);
        let found = fewer.points(null(), 200);
        let same = found.chunks(POINTS).zip(expected.chunks(POINTS)).filter(|(a, b)| a == b).count();
        assert!((80..199).contains(&same), "{same}");
        for (root, strand) in roots.iter().zip(found.chunks(POINTS)) {
            assert!((0..3).all(|axis| (root[axis] - strand[0][axis]).abs() < 1e-6), "{root:?} {:?}", strand[0]);
        }
    }
}

#[test]
fn strands_have_their_own_shapes_at_rest() {
    const STRANDS: usize = 30;
    let (points, roots) = (curves(), places(STRANDS));
    let whole = shx_render_settings { length_variation: 0.0, ..settings(SHX_INTERPOLATION_POSITION) };
    let plain = Made::new(&whole, &guides(&points), &roots);
    // Bent away from the guides, each in another way, on straight pieces of equal length.
    let shape = |strand: usize| {
        let (root, turn) = (roots[strand], 0.7 * strand as f64);
        let piece = [0.003 * turn.cos(), 0.003 * turn.sin(), -0.004];
        (0..POINTS).map(move |k| [0, 1, 2].map(|axis| f64::from(root[axis]) + piece[axis] * k as f64))
    };
    let shapes: Vec<[f64; 3]> = (0..STRANDS).flat_map(shape).collect();
    let ends: Vec<[f64; 3]> = shapes.chunks(POINTS).flat_map(|strand| [strand[0], strand[POINTS - 1]]).collect();
    let made = |points: &[[f64; 3]], counts: *const u32| {
        let input =
            shx_input { data: points.as_ptr().cast(), stride: 0, count: points.len(), format: SHX_FORMAT_F64X3, reserved: 0 };
        let mut own = Made { hair: null_mut(), pose: null_mut() };
        // SAFETY: living handles, and memory of the sizes that are stated.
        unsafe {
            assert_eq!(shx_render_hair_with_own_shapes(plain.hair, &input, counts, STRANDS, &raw mut own.hair), SHX_OK);
            assert_eq!(shx_render_pose_create(own.hair, &raw mut own.pose), SHX_OK);
            assert_eq!(shx_render_pose_set_guides(own.pose, &guides(&self::curves())), SHX_OK);
        }
        own
    };
    let before = plain.points(null(), STRANDS);
    // Two points that are resampled make the same straight strands.
    for own in [made(&shapes, null()), made(&ends, [2_u32; STRANDS].as_ptr())] {
        for (found, expected) in own.points(null(), STRANDS).iter().zip(&shapes) {
            assert!((0..3).all(|axis| (f64::from(found[axis]) - expected[axis]).abs() < 2e-6), "{found:?} {expected:?}");
        }
    }
    assert!(plain.points(null(), STRANDS) == before);
}

/// Render hair in a host's centimetres, y up and left-handed, against what the host would have made of the world's.
#[test]
fn render_hair_comes_in_the_host_s_units_and_axes() {
    let points = curves();
    let roots: Vec<[f32; 3]> = (0..40).map(|k| [0.01 + 2e-4 * k as f32, 0.012, 0.0]).collect();
    let made = Made::new(&settings(SHX_INTERPOLATION_POSITION), &guides(&points), &roots);
    let evaluate = |view: &shx_render_view| {
        let count = roots.len() * POINTS;
        let (mut points, mut frames) = (vec![[f32::NAN; 4]; count], vec![[f32::NAN; 4]; count]);
        let places = [output(&mut points, count, SHX_FORMAT_F32X4), output(&mut frames, count, SHX_FORMAT_F32X4)];
        // SAFETY: a living pose and memory of the size that is stated.
        unsafe { assert_eq!(shx_render_pose_evaluate(made.pose, view, &places[0], &places[1], null()), SHX_OK) };
        (points, frames)
    };
    let plain = filled(shx_render_view_init);
    let (world, world_frames) = evaluate(&plain);
    let host = shx_render_view {
        x_axis: [100.0, 0.0, 0.0],
        y_axis: [0.0, 0.0, 100.0],
        z_axis: [0.0, 100.0, 0.0],
        translation: [0.0, 5.0, 0.0],
        ..plain
    };
    let (points, frames) = evaluate(&host);
    let turned = |q: [f32; 4], axis: nalgebra::Vector3<f64>| {
        let [x, y, z, w] = q.map(f64::from);
        nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z)) * axis
    };
    for (k, (own, world)) in points.iter().zip(&world).enumerate() {
        let expected = [100.0 * world[0], 100.0 * world[2] + 5.0, 100.0 * world[1], 100.0 * world[3]];
        assert!(
            (0..4).all(|axis| (own[axis] - expected[axis]).abs() <= 2e-6 * (1.0 + expected[axis].abs())),
            "{own:?} {expected:?}"
        );
        for axis in [nalgebra::Vector3::x(), nalgebra::Vector3::y()] {
            let there = turned(world_frames[k], axis);
            let expected = nalgebra::Vector3::new(there.x, there.z, there.y);
            assert!((turned(frames[k], axis) - expected).norm() < 1e-5);
        }
    }
    let crooked = shx_render_view { y_axis: [0.0, 1.0, 1.0], ..plain };
    let mut out = vec![[0.0_f32; 4]; roots.len() * POINTS];
    let place = output(&mut out, roots.len() * POINTS, SHX_FORMAT_F32X4);
    // SAFETY: the same.
    unsafe {
        assert_eq!(shx_render_pose_evaluate(made.pose, &crooked, &place, null(), null()), SHX_ERROR_INVALID_ARGUMENT);
    }
}
