//! The cost of accuracy: errors against nearly exact trajectories, and processor time, over integrator, step, elements, iteration
//! cap, tolerance and freedoms, in six scenes with four types of hair. The tables and figures of docs/notebook/tradeoff.md.
//!
//! `cargo run --profile demo --example tradeoff -- sweep docs/figures 1` measures everything: `tradeoff.csv` and
//! `tradeoff_truth.csv` (about a quarter of an hour of processor time; times are those of the thread, so two threads may work on
//! it). `presets docs/figures 1` measures the presets again. `check docs/figures` compares the trajectories with those of the
//! reference integrator: `tradeoff_check.csv`. `table docs/figures` writes src/analysis/measured.rs from `tradeoff.csv`.

mod hair;
mod measure;
mod path;
mod reference;
mod scene;
mod setting;
mod table;
mod walk;

use std::collections::HashMap;
use std::path::Path as FilePath;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use hair::Hair;
use measure::{Measured, measure};
use nalgebra::Vector3;
use reference::Truth;
use scene::Scene;
use setting::{Setting, integrator_name};
use superhelix::settings::HairShape;
use walk::Walk;

fn cases() -> impl Iterator<Item = (Scene, Hair)> {
    Scene::ALL.into_iter().flat_map(|scene| Hair::ALL.into_iter().map(move |hair| (scene, hair)))
}

fn write(directory: &FilePath, name: &str, text: &str) {
    let path = directory.join(name);
    std::fs::write(&path, text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    println!("written: {}", path.display());
}

/// Three digits are significant.
fn short(value: f64) -> String {
    format!("{value:.2e}").replace("e0", "")
}

fn line(scene: Scene, hair: Hair, setting: &Setting, measured: &Measured) -> String {
    let errors = measured.error.map_or(",,".to_string(), |error| [error.tip, error.tip_most, error.shape].map(short).join(","));
    format!(
        "{},{},{},{},{},{},{},{:e},{:e},{},{errors},{},{:.2},{:.3},{}\n",
        scene.name(),
        hair.name(),
        setting.preset.map_or("", |preset| preset.name()),
        integrator_name(setting.integrator),
        setting.rate,
        setting.elements,
        setting.cap,
        setting.tolerance,
        setting.error_tolerance,
        setting.freedoms_name(),
        short(measured.cost),
        measured.iterations,
        measured.unconverged,
        measured.blown_up.map_or(String::new(), |time| format!("{time:.3}")),
    )
}

/// One scene and hair: its rows of both tables.
fn price(scene: Scene, hair: Hair, walk: &Walk, wanted: fn(&Setting) -> bool) -> (String, String) {
    let began = Instant::now();
    let truth = Truth::of(scene, hair, walk);
    let length = scene.length(hair.length());
    let row = format!(
        "{},{},{},{},{},{},{}\n",
        scene.name(),
        hair.name(),
        reference::elements(hair),
        truth.frames,
        short(truth.uncertainty.tip),
        short(truth.uncertainty.shape),
        short(truth.steps.tip),
    );
    let (prepared, mut strands, mut rows) = (began.elapsed().as_secs_f64(), HashMap::new(), String::new());
    let shape = HairShape { curvature: Vector3::from(hair.natural()).norm(), length };
    for setting in Setting::all(&shape).into_iter().filter(wanted) {
        let def = strands
            .entry((setting.elements, setting.freedoms))
            .or_insert_with(|| reference::strand(scene, hair, walk, setting.elements as usize, setting.freedoms));
        rows += &line(scene, hair, &setting, &measure(scene, walk, &setting, def, &truth));
    }
    let seconds = began.elapsed().as_secs_f64() - prepared;
    println!(
        "{:14} {:9} {} frames, trajectories {prepared:.1} s, settings {seconds:.1} s",
        scene.name(),
        hair.name(),
        truth.frames
    );
    (rows, row)
}

/// All cases in their order, on several threads.
fn price_all(threads: usize, wanted: fn(&Setting) -> bool) -> Vec<(Scene, Hair, String, String)> {
    let walk = Walk::read();
    let cases: Vec<_> = cases().collect();
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<_>> = Mutex::default();
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some((scene, hair)) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let (rows, truth) = price(*scene, *hair, &walk, wanted);
                    done.lock().expect("no panic").push((*scene, *hair, rows, truth));
                }
            });
        }
    });
    let mut done = done.into_inner().expect("no panic");
    done.sort_by_key(|(scene, hair, ..)| (*scene as usize, *hair as usize));
    done
}

const HEAD: &str = "scene,hair,preset,integrator,rate,elements,cap,tolerance,error_tolerance,freedoms,tip,tip_most,shape,us_per_second,iterations,unconverged,blown_up_s\n";

/// Everything.
fn sweep(directory: &FilePath, threads: usize) {
    let mut csv = HEAD.to_string();
    let mut truths = String::from("scene,hair,elements,frames,tip_uncertainty,shape_uncertainty,step_halving\n");
    for (_, _, rows, truth) in price_all(threads, |_| true) {
        csv += &rows;
        truths += &truth;
    }
    write(directory, "tradeoff.csv", &csv);
    write(directory, "tradeoff_truth.csv", &truths);
}

/// Only the presets, replacing those in `tradeoff.csv`.
fn presets(directory: &FilePath, threads: usize) {
    let path = directory.join("tradeoff.csv");
    let old = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert!(old.starts_with(HEAD), "{} has other columns: measure everything", path.display());
    let mut csv = HEAD.to_string();
    for (scene, hair, rows, _) in price_all(threads, |setting| setting.preset.is_some()) {
        let kept = format!("{},{},,", scene.name(), hair.name());
        csv.extend(old.lines().filter(|line| line.starts_with(&kept)).map(|line| format!("{line}\n")));
        csv += &rows;
    }
    write(directory, "tradeoff.csv", &csv);
}

/// The reference integrator beside the trajectories that replace it, with as many elements as dense matrices permit.
fn check(directory: &FilePath) {
    let walk = Walk::read();
    let mut csv = String::from("scene,hair,elements,tolerance,tip,tip_most,shape,reference_s,extrapolated_s\n");
    for (scene, hair) in cases() {
        for elements in reference::checked_elements(scene, hair) {
            let tolerance = 1e-5;
            let began = Instant::now();
            let exact = reference::radau(scene, hair, &walk, elements, tolerance);
            let reference_s = began.elapsed().as_secs_f64();
            let (path, _) = reference::extrapolated(scene, hair, &walk, elements, reference::RATE);
            let extrapolated_s = began.elapsed().as_secs_f64() - reference_s;
            let apart = path.distance(&exact, exact.frames.len(), scene.length(hair.length()));
            let numbers = [apart.tip, apart.tip_most, apart.shape].map(short).join(",");
            let row = format!(
                "{},{},{elements},{tolerance:e},{numbers},{reference_s:.1},{extrapolated_s:.1}",
                scene.name(),
                hair.name()
            );
            println!("{row}");
            csv += &(row + "\n");
            write(directory, "tradeoff_check.csv", &csv);
        }
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["sweep", directory, threads] => sweep(FilePath::new(directory), threads.parse().expect("a number of threads")),
        ["presets", directory, threads] => presets(FilePath::new(directory), threads.parse().expect("a number of threads")),
        ["check", directory] => check(FilePath::new(directory)),
        ["table", directory] => table::write(FilePath::new(directory)),
        _ => {
            eprintln!("usage: tradeoff sweep|presets DIRECTORY THREADS, or check|table DIRECTORY");
            std::process::exit(2);
        }
    }
}
