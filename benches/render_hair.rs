//! The cost of render hair: 150,000 strands of 16 points from the 1000 guides of a real groom, through the C ABI into the
//! caller's floats; and as many from 228 guides on their bust, kept out of it.
//!
//! Each round evaluates every type of output once, so that other programs affect all alike; the figures are the least and the
//! median over the rounds.
//!
//! `cargo bench --profile demo --bench render_hair -- [--csv FILE] [--rounds 15] [--strands 150000]`
#![allow(unsafe_code)] // calls of the C ABI

use std::fmt::Write as _;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};
use std::time::Instant;

use superhelix::internals::capi::base::errors::SHX_OK;
use superhelix::internals::capi::base::types::*;
use superhelix::internals::capi::render::render_def::*;
use superhelix::internals::capi::render::render_hair::*;
use superhelix::internals::capi::scene::bodies::shx_solver_add_bodies;
use superhelix::internals::capi::scene::body_def::{SHX_SHAPE_GRID, shx_body_def, shx_body_def_init};
use superhelix::internals::capi::simulation::solver::{shx_solver_create, shx_solver_destroy};
use superhelix::io::{Curves, distance_grid, obj_mesh};
use superhelix::shapes::{DistanceGrid, Mesh};

const POINTS: usize = 16;

fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64
}

fn settings() -> shx_render_settings {
    let mut settings = MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_render_settings_init(settings.as_mut_ptr(), size_of::<shx_render_settings>()), SHX_OK);
        shx_render_settings { points_per_strand: POINTS as u32, ..settings.assume_init() }
    }
}

fn guides() -> shx_render_guides {
    let mut guides = MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_render_guides_init(guides.as_mut_ptr(), size_of::<shx_render_guides>()), SHX_OK);
        guides.assume_init()
    }
}

fn view() -> shx_render_view {
    let mut view = MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_render_view_init(view.as_mut_ptr(), size_of::<shx_render_view>()), SHX_OK);
        view.assume_init()
    }
}

fn input<T>(data: &[T], count: usize, format: u32) -> shx_input {
    shx_input { data: data.as_ptr().cast(), stride: 0, count, format, reserved: 0 }
}

fn output<T>(data: &mut [T], count: usize, format: u32) -> shx_output {
    shx_output { data: data.as_mut_ptr().cast(), stride: 0, count, format, reserved: 0 }
}

/// A mesh as a distance grid, with the usual cells of a baked head.
fn head(path: &str) -> Vec<u8> {
    let mut mesh = obj_mesh::read(path).expect("a mesh");
    mesh.vertices.iter_mut().for_each(|vertex| *vertex *= 0.01);
    let mesh = Mesh::for_baking(mesh.vertices, mesh.triangles).expect("a mesh");
    let grid = DistanceGrid::bake(&mesh, 0.005, 0.035).expect("a grid");
    println!("head: {} nodes", grid.values().len());
    distance_grid::write_to_bytes(&grid).expect("room")
}

/// A solver with that one body.
fn solver_with(grid: &[u8]) -> *mut superhelix::internals::capi::base::guard::shx_solver {
    let (mut solver, mut def, mut id) = (null_mut(), MaybeUninit::uninit(), MaybeUninit::uninit());
    // SAFETY: living structures and places for handles.
    unsafe {
        assert_eq!(shx_solver_create(null(), &raw mut solver), SHX_OK);
        assert_eq!(shx_body_def_init(def.as_mut_ptr(), size_of::<shx_body_def>()), SHX_OK);
        let def = shx_body_def { shape: SHX_SHAPE_GRID, grid: grid.as_ptr().cast(), grid_size: grid.len(), ..def.assume_init() };
        assert_eq!(shx_solver_add_bodies(solver, &def, size_of::<shx_body_def>(), 1, id.as_mut_ptr()), SHX_OK);
    }
    solver
}

/// The least and the median, ms.
fn figures(times: &mut [f64]) -> [f64; 2] {
    times.sort_by(f64::total_cmp);
    [times[0], times[times.len() / 2]]
}

fn time(work: impl FnOnce()) -> f64 {
    let begun = Instant::now();
    work();
    begun.elapsed().as_secs_f64() * 1e3
}

/// A groom's guides, and roots of strands among them.
struct Groom {
    counts: Vec<u32>,
    points: Vec<[f32; 3]>,
    velocities: Vec<[f32; 3]>,
    roots: Vec<[f64; 3]>,
}

impl Groom {
    /// Of a file in units of `scale` metres.
    fn read(name: &str, scale: f32, strands: usize) -> Self {
        let curves = Curves::read(format!("{DATA}/{name}")).expect("a groom");
        let points: Vec<[f32; 3]> = curves.points().iter().map(|point| point.map(|value| value * scale)).collect();
        let mut first = 0;
        let mut of_guides = Vec::new();
        for count in curves.counts() {
            of_guides.push(points[first]);
            first += *count as usize;
        }
        let mut seed = 1;
        let roots = (0..strands).map(|index| {
            let root = of_guides[index % of_guides.len()];
            root.map(|value| f64::from(value) + 0.01 * (noise(&mut seed) - 0.5))
        });
        let roots = roots.collect();
        Self { counts: curves.counts().to_vec(), velocities: vec![[0.1, 0.2, 0.3]; points.len()], points, roots }
    }
}

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms");

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let value = |name: &str| arguments.iter().position(|argument| argument == name).and_then(|at| arguments.get(at + 1));
    let number = |name: &str, default: usize| value(name).map_or(default, |text| text.parse().expect("a number"));
    let (rounds, strands) = (number("--rounds", 15), number("--strands", 150_000));

    let items = strands * POINTS;
    let mut positions = vec![0.0_f32; 4 * items];
    let mut frames = vec![0.0_f32; 4 * items];
    let mut speeds = vec![0.0_f32; 3 * items];
    let mut csv = "space,threads,output,least_ms,median_ms\n".to_string();
    println!("{strands} strands of {POINTS} points, milliseconds: least, median of {rounds}");
    let source = vec![1.0_f32; 3 * items];
    let mut copies: Vec<f64> = (0..rounds).map(|_| time(|| positions[..3 * items].copy_from_slice(&source))).collect();
    let [least, median] = figures(&mut copies);
    println!("copy of the positions' bytes           {least:8.2} {median:8.2}");
    let _ = writeln!(csv, "copy,1,positions,{least:.2},{median:.2}");

    let free = Groom::read("fibermesh_1k.tfx", 0.0012, strands);
    let on_bust = Groom::read("sintel_hair_001.tfx", 0.01, strands);
    let solver = solver_with(&head(&format!("{DATA}/sintel_bust.obj")));
    for (space, name) in [(SHX_INTERPOLATION_POSITION, "position"), (SHX_INTERPOLATION_CURVATURE, "curvature")] {
        for (threads, groom, has_head) in [(1, &free, false), (2, &free, false), (1, &on_bust, true), (2, &on_bust, true)] {
            let given = shx_render_guides {
                guide_count: groom.counts.len(),
                points: input(&groom.points, groom.points.len(), SHX_FORMAT_F32X3),
                point_counts: groom.counts.as_ptr(),
                velocities: input(&groom.velocities, groom.points.len(), SHX_FORMAT_F32X3),
                ..guides()
            };
            let settings = shx_render_settings { interpolation: space, worker_count: threads, ..settings() };
            let (mut hair, mut pose) = (null_mut(), null_mut());
            let input_of_roots = input(&groom.roots, strands, SHX_FORMAT_F64X3);
            // SAFETY: living structures and memory of the sizes that are stated.
            unsafe {
                let bind = time(|| {
                    assert_eq!(shx_render_hair_create(&settings, &given, &input_of_roots, &raw mut hair), SHX_OK);
                });
                assert_eq!(shx_render_pose_create(hair, &raw mut pose), SHX_OK);
                let mut set: Vec<f64> =
                    (0..rounds).map(|_| time(|| assert_eq!(shx_render_pose_set_guides(pose, &given), SHX_OK))).collect();
                let whole = view();
                let three = output(&mut positions, items, SHX_FORMAT_F32X3);
                let four = output(&mut positions, items, SHX_FORMAT_F32X4);
                let turned = output(&mut frames, items, SHX_FORMAT_F32X4);
                let moving = output(&mut speeds, items, SHX_FORMAT_F32X3);
                type Kind<'a> = (&'a str, bool, *const shx_output, *const shx_output, *const shx_output);
                let kinds: &[Kind] = if has_head {
                    &[
                        ("a bust's: positions and radii", false, &four, null(), null()),
                        ("a bust's: positions and radii, kept out of it", true, &four, null(), null()),
                        ("a bust's: positions, radii, velocities", false, &four, null(), &moving),
                        ("a bust's: positions, radii, velocities, kept out of it", true, &four, null(), &moving),
                    ]
                } else {
                    &[
                        ("positions", false, &three, null(), null()),
                        ("positions and radii", false, &four, null(), null()),
                        ("positions, radii, velocities", false, &four, null(), &moving),
                        ("positions, radii, velocities, frames", false, &four, &turned, &moving),
                    ]
                };
                let mut times = vec![Vec::new(); kinds.len()];
                for round in 0..rounds + 1 {
                    for (kind, times) in kinds.iter().zip(&mut times) {
                        let taken = time(|| {
                            let result = if kind.1 {
                                shx_solver_evaluate_render_pose(solver, pose, &whole, kind.2, kind.3, kind.4)
                            } else {
                                shx_render_pose_evaluate(pose, &whole, kind.2, kind.3, kind.4)
                            };
                            assert_eq!(result, SHX_OK);
                        });
                        if round > 0 {
                            times.push(taken);
                        }
                    }
                }
                for (kind, times) in kinds.iter().zip(&mut times) {
                    let [least, median] = figures(times);
                    println!("{name}, {threads} threads, {:<54} {least:8.2} {median:8.2}", kind.0);
                    let _ = writeln!(csv, "{name},{threads},\"{}\",{least:.2},{median:.2}", kind.0);
                }
                if !has_head {
                    let [least, median] = figures(&mut set);
                    println!("{name}, {threads} threads, pose set with velocities {least:8.2} {median:8.2}");
                    let _ = writeln!(csv, "{name},{threads},pose set (with velocities),{least:.2},{median:.2}");
                    println!("{name}, {threads} threads, map made {bind:8.2}");
                    let _ = writeln!(csv, "{name},{threads},map made,{bind:.2},{bind:.2}");
                }
                shx_render_pose_destroy(pose);
                shx_render_hair_destroy(hair);
            }
        }
    }
    // SAFETY: made above, used no more.
    unsafe { shx_solver_destroy(solver) };
    if let Some(path) = value("--csv") {
        std::fs::write(path, csv).expect("a file");
    }
}
