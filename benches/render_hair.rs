//! What render hair costs: 150,000 strands of 16 points from the 1000 guides of a real groom, through the C ABI into the caller's floats.
//!
//! Each round evaluates every kind of output once, so that what else the machine does falls on all alike; the figures are the least and
//! the median over the rounds.
//!
//! `cargo bench --profile demo --bench render_hair -- [--csv FILE] [--rounds 15] [--strands 150000]`
#![allow(unsafe_code)] // calls of the C ABI

use std::fmt::Write as _;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};
use std::time::Instant;

use nalgebra::{DMatrix, DVector, Vector3};
use superhelix::capi::bodies::shx_solver_add_bodies;
use superhelix::capi::body_def::{SHX_SHAPE_GRID, shx_body_def, shx_body_def_init};
use superhelix::capi::errors::SHX_OK;
use superhelix::capi::render_def::*;
use superhelix::capi::render_hair::*;
use superhelix::capi::solver::{shx_solver_create, shx_solver_destroy};
use superhelix::capi::types::*;
use superhelix::contact::shape::DistanceGrid;
use superhelix::files::curves::Curves;
use superhelix::files::distance_grid;

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

/// The sphere through places as nearly as can be, as a distance grid in cells of a hundredth of its diameter, as heads are baked.
fn head(places: &[[f32; 3]]) -> Vec<u8> {
    let rows =
        DMatrix::from_fn(places.len(), 4, |row, column| if column < 3 { 2.0 * f64::from(places[row][column]) } else { 1.0 });
    let squares = DVector::from_fn(places.len(), |row, _| places[row].iter().map(|value| f64::from(*value).powi(2)).sum());
    let found = (rows.transpose() * &rows).try_inverse().expect("roots in space") * rows.transpose() * squares;
    let centre = Vector3::new(found[0], found[1], found[2]);
    let radius = (found[3] + centre.norm_squared()).sqrt();
    let (cell, band) = (0.02 * radius, 0.035);
    let count = (2.0 * (radius + band) / cell).ceil() as usize + 1;
    let low = centre - Vector3::repeat(0.5 * (count - 1) as f64 * cell);
    let at = |k: usize| Vector3::new((k % count) as f64, (k / count % count) as f64, (k / count / count) as f64) * cell + low;
    let values = (0..count * count * count).map(|k| ((at(k) - centre).norm() - radius) as f32).collect();
    let grid = DistanceGrid::from_parts(low, cell, band, [count as u32; 3], values).expect("a grid");
    println!("head: a sphere of {:.1} cm, {} nodes", 100.0 * radius, count * count * count);
    distance_grid::write_to_bytes(&grid).expect("room")
}

/// A solver with that one body.
fn solver_with(grid: &[u8]) -> *mut superhelix::capi::guard::shx_solver {
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

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let value = |name: &str| arguments.iter().position(|argument| argument == name).and_then(|at| arguments.get(at + 1));
    let number = |name: &str, default: usize| value(name).map_or(default, |text| text.parse().expect("a number"));
    let (rounds, strands) = (number("--rounds", 15), number("--strands", 150_000));

    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms/fibermesh_1k.tfx");
    let curves = Curves::read(path).expect("a groom");
    let points: Vec<[f32; 3]> = curves.points().iter().map(|point| point.map(|value| value * 0.0012)).collect();
    let roots_of_guides: Vec<[f32; 3]> = {
        let mut first = 0;
        curves
            .counts()
            .iter()
            .map(|count| {
                let root = points[first];
                first += *count as usize;
                root
            })
            .collect()
    };
    let mut seed = 1;
    let roots: Vec<[f64; 3]> = (0..strands)
        .map(|index| {
            let root = roots_of_guides[index % roots_of_guides.len()];
            root.map(|value| f64::from(value) + 0.01 * (noise(&mut seed) - 0.5))
        })
        .collect();
    let velocities = vec![[0.1_f32, 0.2, 0.3]; points.len()];
    let grid = head(&roots_of_guides);
    let solver = solver_with(&grid);

    let items = strands * POINTS;
    let mut positions = vec![0.0_f32; 4 * items];
    let mut frames = vec![0.0_f32; 4 * items];
    let mut speeds = vec![0.0_f32; 3 * items];
    let mut csv = "space,threads,output,least_ms,median_ms\n".to_string();
    println!("{strands} strands of {POINTS} points, {} guides, milliseconds: least, median of {rounds}", curves.strand_count());
    let source = vec![1.0_f32; 3 * items];
    let mut copies: Vec<f64> = (0..rounds).map(|_| time(|| positions[..3 * items].copy_from_slice(&source))).collect();
    let [least, median] = figures(&mut copies);
    println!("copy of the positions' bytes           {least:8.2} {median:8.2}");
    let _ = writeln!(csv, "copy,1,positions,{least:.2},{median:.2}");

    for (space, name) in [(SHX_INTERPOLATION_POSITION, "position"), (SHX_INTERPOLATION_CURVATURE, "curvature")] {
        for threads in [1, 2] {
            let given = shx_render_guides {
                guide_count: curves.strand_count(),
                points: input(&points, points.len(), SHX_FORMAT_F32X3),
                point_counts: curves.counts().as_ptr(),
                velocities: input(&velocities, points.len(), SHX_FORMAT_F32X3),
                ..guides()
            };
            let settings = shx_render_settings { interpolation: space, worker_count: threads, ..settings() };
            let (mut hair, mut pose) = (null_mut(), null_mut());
            let input_of_roots = input(&roots, strands, SHX_FORMAT_F64X3);
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
                let kinds: [Kind; 6] = [
                    ("positions", false, &three, null(), null()),
                    ("positions and radii", false, &four, null(), null()),
                    ("positions and radii, out of a head", true, &four, null(), null()),
                    ("positions, radii, velocities", false, &four, null(), &moving),
                    ("positions, radii, velocities, out of a head", true, &four, null(), &moving),
                    ("positions, radii, velocities, frames", false, &four, &turned, &moving),
                ];
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
                    println!("{name}, {threads} threads, {:<43} {least:8.2} {median:8.2}", kind.0);
                    let _ = writeln!(csv, "{name},{threads},\"{}\",{least:.2},{median:.2}", kind.0);
                }
                let [least, median] = figures(&mut set);
                println!("{name}, {threads} threads, pose set with velocities                     {least:8.2} {median:8.2}");
                let _ = writeln!(csv, "{name},{threads},pose set (with velocities),{least:.2},{median:.2}");
                println!("{name}, {threads} threads, map made                                     {bind:8.2}");
                let _ = writeln!(csv, "{name},{threads},map made,{bind:.2},{bind:.2}");
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
