//! Where single precision is no longer good enough: the same strands stepped in f64 and in f32, over the number of elements,
//! stiffness, curl and step. The table and the figure of docs/notebook/lanes.md.
//!
//! Beside it stands the motion's own growth of any small error: a second run in f64 whose stiffness differs by 2⁻²⁴ of itself, as
//! if rounded once to f32, and whose first curvatures differ by 2⁻²⁴ of a radian per length.
//!
//! `cargo run --release --example single_precision -- docs/figures/single_precision.csv [study]`

mod hair;
mod motion;
mod run;

use std::fmt::Write as _;

use hair::Hair;
use motion::Motion;
use run::{Way, apart, run};
use superhelix::{Integrator, Precision};

const SECONDS: f64 = 3.0;
const ROUNDING: f64 = 1.0 / 16_777_216.0;

struct Table {
    csv: String,
}

impl Table {
    fn write(&mut self, line: &str) {
        println!("{line}");
        writeln!(self.csv, "{line}").expect("a string");
    }

    /// A motion in both precisions.
    fn motion(&mut self, study: &str, hair: &Hair, elements: usize, way: &Way) {
        let def = hair.strand(elements, true);
        let mut nudged = def.clone();
        nudged.material.youngs_modulus *= 1.0 + ROUNDING;
        let nudge = ROUNDING / hair.length;
        nudged.initial = Some(def.natural.iter().map(|row| row.map(|k| k * (1.0 + ROUNDING) + nudge)).collect());
        let double = run(&def, way, Precision::F64, false);
        let single = run(&def, way, Precision::F32, false);
        let (apart32, _) = apart(&double, &single);
        let (sensitive, _) = apart(&double, &run(&nudged, way, Precision::F64, false));
        self.line(study, hair, elements, way, [apart32, sensitive], [&double, &single]);
    }

    /// A strand at rest: how far it moves, in f32 and in f64.
    fn rest(&mut self, hair: &Hair, elements: usize, rate: u32) {
        let way = Way { motion: &Motion::Rest, rate, seconds: 6.0, integrator: Integrator::SecondOrder };
        let def = hair.strand(elements, true);
        let [double, single] = [Precision::F64, Precision::F32].map(|precision| run(&def, &way, precision, true));
        let [gone64, gone32] = [&double, &single].map(|course| {
            let still = run::Course { frames: vec![course.frames[0]; course.frames.len()], ..Default::default() };
            apart(&still, course).0
        });
        self.line("rest", hair, elements, &way, [gone32, gone64], [&double, &single]);
    }

    /// An undamped strand that is let go: the final error of its energy relative to the fall, in f32 and in f64.
    fn energy(&mut self, hair: &Hair, elements: usize, rate: u32) {
        let way = Way { motion: &Motion::Rest, rate, seconds: 1.0, integrator: Integrator::SecondOrder };
        let def = hair.strand(elements, false);
        let [double, single] = [Precision::F64, Precision::F32].map(|precision| run(&def, &way, precision, false));
        let weight = def.material.linear_density() * 9.81 * hair.length * hair.length;
        let [off64, off32] =
            [&double, &single].map(|course| (course.energies[course.energies.len() - 1] - course.energies[0]) / weight);
        self.line("energy", hair, elements, &way, [off32 * hair.length, off64 * hair.length], [&double, &single]);
    }

    fn line(
        &mut self,
        study: &str,
        hair: &Hair,
        elements: usize,
        way: &Way,
        values: [f64; 2],
        [double, single]: [&run::Course; 2],
    ) {
        let [a, b] = values.map(|value| value / hair.length);
        let [unconverged, subdivided, quarantined] = single.failures;
        let line = format!(
            "{study},{},{:.0},{},{elements},{},{},{a:.3e},{b:.3e},{:.3},{:.3},{},{},{unconverged},{subdivided},{quarantined},{:.2e}",
            hair.name,
            hair.gamma(),
            way.motion.name(),
            way.rate,
            (way.seconds * f64::from(way.rate)).round(),
            double.iterations,
            single.iterations,
            double.failures[0],
            double.failures[1],
            single.residual,
        );
        self.write(&line);
    }
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next();
    let only = arguments.next();
    let wanted = |study: &str| only.as_deref().is_none_or(|only| only == study);
    let motions = [Motion::Shake, Motion::walk()];
    let mut table = Table { csv: String::new() };
    table.write(
        "study,hair,gamma,motion,elements,rate,steps,f32,f64,iterations64,iterations32,unconverged64,subdivided64,unconverged32,subdivided32,quarantined32,residual32",
    );
    for hair in &hair::ALL {
        for motion in &motions {
            for elements in [5, 10, 20, 50, 100, 200].into_iter().filter(|_| wanted("elements")) {
                let way = Way { motion, rate: 60, seconds: SECONDS, integrator: Integrator::SecondOrder };
                table.motion("elements", hair, elements, &way);
            }
            for rate in [30, 60, 120, 240, 480, 990].into_iter().filter(|_| wanted("rate")) {
                let way = Way { motion, rate, seconds: SECONDS, integrator: Integrator::SecondOrder };
                table.motion("rate", hair, 10, &way);
            }
            for rate in [60, 240].into_iter().filter(|_| wanted("euler")) {
                let way = Way { motion, rate, seconds: SECONDS, integrator: Integrator::ImplicitEuler };
                table.motion("euler", hair, 10, &way);
            }
        }
        for (elements, rate) in [(10, 60), (10, 240), (10, 990), (50, 60), (50, 240), (200, 60)] {
            if wanted("rest") {
                table.rest(hair, elements, rate);
            }
        }
        for rate in [60, 240, 990].into_iter().filter(|_| wanted("energy")) {
            table.energy(hair, 10, rate);
        }
    }
    if let Some(path) = path {
        std::fs::write(&path, &table.csv).unwrap_or_else(|error| panic!("{path}: {error}"));
        println!("written: {path}");
    }
}
