//! Random strands from the whole space of parameters: nothing turns non-finite, nothing hangs, every strand keeps its length and its
//! frames. `EXTREMES_CASES` says how many draws; `make soak` makes many.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::math::frame::Frame;
use superhelix::rod::freedoms::Freedoms;
use superhelix::rod::material::Material;
use superhelix::solver::Solver;
use superhelix::solver::definition::{SolverOptions, StrandDef};
use superhelix::step::options::Integrator;

/// Marsaglia's xorshift: the same draws everywhere.
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    /// Evenly in the logarithm.
    fn over(&mut self, low: f64, high: f64) -> f64 {
        (low.ln() + (high / low).ln() * self.unit()).exp()
    }
    /// Zero half of the time.
    fn or_zero(&mut self, low: f64, high: f64) -> f64 {
        if self.unit() < 0.5 { 0.0 } else { self.over(low, high) }
    }
    fn direction(&mut self) -> Vector3<f64> {
        Vector3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0)) + Vector3::new(1e-3, 0.0, 0.0)
    }
}

fn strand(draw: &mut Draw) -> StrandDef {
    let count = draw.over(1.0, 60.0) as usize;
    let length = draw.over(1e-3, 3.0);
    let mut lengths: Vec<f64> =
        if draw.unit() < 0.7 { vec![1.0; count] } else { (0..count).map(|_| draw.over(1e-3, 1.0)).collect() };
    let sum: f64 = lengths.iter().sum();
    lengths.iter_mut().for_each(|x| *x *= length / sum);
    let mut def = StrandDef::straight(length, count);
    let radius = draw.over(1e-6, 5e-3);
    let aspect = draw.over(1.0, 50.0);
    def.material = Material {
        radius: if draw.unit() < 0.5 { [radius * aspect.sqrt(), radius / aspect.sqrt()] } else { [radius, radius] },
        density: draw.over(1.0, 2e4),
        youngs_modulus: draw.over(1e3, 1e12),
        poisson_ratio: draw.between(-0.5, 0.5),
        internal_friction: draw.or_zero(1e-14, 1e-2),
        viscosity: draw.or_zero(1e-6, 1.0),
        air_drag: draw.or_zero(1e-8, 10.0),
    };
    def.freedoms = Freedoms::from_bits("freedoms", 1 + (draw.unit() * 7.0) as u32 % 7).unwrap();
    let angle = draw.or_zero(1e-3, 100.0);
    def.natural = lengths
        .iter()
        .map(|length| {
            let d = draw.direction();
            (d * (angle / d.norm() / length)).into()
        })
        .collect();
    def.element_lengths = lengths;
    def.root.rotation = UnitQuaternion::from_scaled_axis(draw.direction() * 3.0);
    def
}

#[test]
fn random_strands_stay_finite_whole_and_honest() {
    let cases: u64 = std::env::var("EXTREMES_CASES").map_or(400, |text| text.parse().unwrap());
    let mut tally = [[0_u64; 4]; 2];
    for case in 0..cases {
        let mut draw = Draw(0x9e37_79b9_7f4a_7c15 ^ (case + 1).wrapping_mul(0xd129_0b26_88cc_f16b));
        draw.unit();
        let def = strand(&mut draw);
        let integrator = if draw.unit() < 0.5 { Integrator::ImplicitEuler } else { Integrator::SecondOrder };
        let mut options = SolverOptions::default();
        options.step.integrator = integrator;
        options.step.max_iterations = 100;
        if draw.unit() < 0.3 {
            options.wind = draw.direction() * 100.0;
        }
        let mut solver = Solver::new(options).unwrap();
        let id = solver.add_strands(std::slice::from_ref(&def)).unwrap()[0];
        let row = &mut tally[usize::from(integrator == Integrator::SecondOrder)];
        let h = draw.over(1e-6, 0.25);
        let (sway, spin) = (draw.direction() * 1000.0, draw.direction() * (50.0 * std::f64::consts::TAU * draw.unit()));
        let mut time = 0.0;
        for step in 0..12 {
            time += h;
            match (draw.unit() * 8.0) as u32 {
                0 => {
                    let frame =
                        Frame { origin: draw.direction() * 10.0, rotation: UnitQuaternion::from_scaled_axis(draw.direction()) };
                    solver.teleport_roots(&[id], &[frame]).unwrap();
                }
                1 => solver.set_gravity(draw.direction() * 20.0).unwrap(),
                2 => {}
                _ => {
                    let origin = sway * (0.5 * time * time);
                    let rotation = UnitQuaternion::from_scaled_axis(spin * h) * solver.root_frame(id).unwrap().rotation;
                    solver.set_root_frames(&[id], &[Frame { origin, rotation }], h).unwrap();
                }
            }
            let report = solver.step(h, 1).unwrap();
            row[0] += 1;
            row[1] += u64::from(report.unconverged);
            row[2] += u64::from(report.quarantined);
            if report.quarantined > 0 {
                println!("case {case} step {step} {integrator:?} h {h:e} quarantined: {def:?}");
            }
            row[3] += u64::from(report.max_iterations);
            assert!(report.energies.kinetic.is_finite() && report.energies.elastic.is_finite());
            let count = 60;
            let mut samples = Vec::new();
            solver.sample_strands(&[id], count, |_, _, sample| samples.push(*sample)).unwrap();
            let length = def.length();
            for pair in samples.windows(2) {
                let chord = (pair[1].position - pair[0].position).norm();
                assert!(
                    chord <= (pair[1].arclength - pair[0].arclength) * (1.0 + 1e-9) + 1e-12 * (length + pair[0].position.norm())
                );
                let n0 = pair[0].rotation * Vector3::x();
                assert!((n0.norm() - 1.0).abs() < 1e-9 && pair[0].velocity.norm().is_finite());
            }
        }
    }
    for (name, row) in ["implicit Euler", "second order"].iter().zip(tally) {
        println!(
            "{name}: {} steps, {} unconverged, {} quarantined, {:.1} iterations a step",
            row[0],
            row[1],
            row[2],
            row[3] as f64 / row[0].max(1) as f64
        );
        assert_eq!(row[2], 0, "{name}: a state turned non-finite");
    }
}
