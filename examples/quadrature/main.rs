//! Quadrature errors: the largest turn of an element for each rule and tolerance (`angles`, the table in
//! src/math/quadrature/quadrature_limits.rs), and what a tolerance adds to the error of motions (`motions`). The tables of
//! docs/theory/mathematics.md.
//!
//! `cargo run --release --example quadrature -- angles docs/figures/quadrature_angles.csv`
//! `cargo run --release --example quadrature -- motions docs/figures/quadrature_motions.csv` (a minute)
//! `… -- cost TOLERANCE STEPS` takes steps for scripts/quadrature_cost.sh to count the instructions of.

mod angles;
mod cost;
#[path = "../tradeoff/hair.rs"]
#[allow(dead_code)]
mod hair;
#[path = "../tradeoff/path.rs"]
#[allow(dead_code)]
mod path;
#[path = "../tradeoff/reference.rs"]
#[allow(dead_code)]
mod reference;
#[path = "../tradeoff/scene.rs"]
#[allow(dead_code)]
mod scene;
mod trajectories;
#[path = "../tradeoff/walk.rs"]
mod walk;

use std::fmt::Write as _;

use hair::Hair;
use reference::Truth;
use scene::Scene;
use superhelix::Freedoms;
use superhelix::internals::math::quadrature::{Rule, Rules};
use walk::Walk;

/// Tolerances of the motions.
const TOLERANCES: [f64; 6] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8];

/// The largest turn for each rule and tolerances 1e-2 to 1e-12.
fn angles() -> String {
    let known = Rules::default();
    let sizes: Vec<usize> = (0..known.count()).map(|index| known.rule(index).len()).collect();
    let rules: Vec<Rule> = sizes.iter().map(|size| Rule::gauss_legendre(*size)).collect();
    let found = angles::largest_turns(&rules);
    let mut csv = String::from("points,tolerance,largest_turn\n");
    for (size, row) in sizes.iter().zip(found) {
        for (exponent, turn) in (2..=12).zip(row) {
            writeln!(csv, "{size},1e-{exponent},{turn:.4e}").expect("a string");
        }
    }
    csv
}

/// What tolerances add to the errors of motions.
fn motions() -> String {
    let walk = Walk::read();
    let mut csv = String::from("scene,hair,elements,rate,tolerance,points,added,error,velocity_added,velocity_error\n");
    for scene in [Scene::HeadShake, Scene::Walk] {
        for hair in [Hair::Straight, Hair::Wavy, Hair::Curly] {
            let truth = Truth::of(scene, hair, &walk);
            let length = scene.length(hair.length());
            // Velocities are compared with a run as fine as the trajectory's, without extrapolation.
            let fine = reference::strand(scene, hair, &walk, reference::elements(hair), Freedoms::ALL);
            let fine = trajectories::exact(scene, &walk, &fine, 960);
            println!("{} {}: {} frames, {:?}", scene.name(), hair.name(), truth.frames, truth.uncertainty);
            for elements in [5, 10, 20] {
                let def = reference::strand(scene, hair, &walk, elements, Freedoms::ALL);
                for rate in [120, 480] {
                    let exact = trajectories::exact(scene, &walk, &def, rate);
                    let error = exact.path.distance(&truth.path, truth.frames, length).shape;
                    let velocity_error = exact.velocity_distance(&fine, truth.frames);
                    for tolerance in TOLERANCES {
                        let run = trajectories::run(scene, &walk, &def, rate, tolerance);
                        let added = run.path.distance(&exact.path, truth.frames, length).shape;
                        let velocity_added = run.velocity_distance(&exact, truth.frames);
                        let row = format!(
                            "{},{},{elements},{rate},{tolerance:e},{:.2},{added:.3e},{error:.3e},{velocity_added:.3e},{velocity_error:.3e}",
                            scene.name(),
                            hair.name(),
                            run.points
                        );
                        println!("{row}: {:.1e}, {:.1e} of the error", added / error, velocity_added / velocity_error);
                        csv += &(row + "\n");
                    }
                }
            }
        }
    }
    csv
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (csv, path) = match words[..] {
        ["cost", tolerance, steps] => {
            let (points, iterations, element_steps) =
                cost::run(tolerance.parse().expect("a tolerance"), steps.parse().expect("a number of steps"));
            println!("{points} {iterations:.4} {element_steps}");
            return;
        }
        ["angles", path] => (angles(), path),
        ["motions", path] => (motions(), path),
        _ => {
            eprintln!("usage: quadrature angles|motions FILE.csv, or cost TOLERANCE STEPS");
            std::process::exit(2);
        }
    };
    std::fs::write(path, csv).unwrap_or_else(|error| panic!("{path}: {error}"));
    println!("written: {path}");
}
