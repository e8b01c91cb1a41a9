//! Crowds: strands of one solver whose steps are timed.

use std::time::Instant;

use rustix::time::{ClockId, clock_gettime};
use superhelix::{InstructionSet, Integrator, Precision, Solver, SolverOptions, StrandId, Workers};

use crate::scene::{GRAVITY, Hair, STEP, Scene, Stage};

/// Processor seconds of this thread.
pub fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// Processor seconds of all threads of this process.
fn processor_seconds_of_all() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// A crowd with fewer strands than this is small.
const FEW: usize = 16;

/// The setting of a crowd.
#[derive(Debug, Clone)]
pub struct Setting {
    /// The scene.
    pub scene: Scene,
    /// The strands.
    pub hair: Hair,
    /// How many.
    pub strands: usize,
    /// The solver.
    pub options: SolverOptions,
}

impl Setting {
    /// The calm scene, with as many strands of this many elements as make about 2000 elements, but at least enough to fill the
    /// widest pack twice; the solver's defaults on one thread.
    pub fn new(elements: usize) -> Self {
        let strands = (2000 / elements).div_ceil(32).max(1) * 32;
        Self {
            scene: Scene::Sway,
            hair: Hair::of(elements),
            strands,
            options: SolverOptions { gravity: GRAVITY, ..SolverOptions::default() },
        }
    }

    /// In another scene.
    pub fn scene(mut self, scene: Scene) -> Self {
        self.scene = scene;
        self
    }

    /// With other hair.
    pub fn hair(mut self, hair: Hair) -> Self {
        self.hair = hair;
        self
    }

    /// With this many strands.
    pub fn strands(mut self, strands: usize) -> Self {
        self.strands = strands;
        self
    }

    /// In this precision.
    pub fn precision(mut self, precision: Precision) -> Self {
        self.options.step.precision = precision;
        self
    }

    /// With this integrator.
    pub fn integrator(mut self, integrator: Integrator) -> Self {
        self.options.step.integrator = integrator;
        self
    }

    /// With these instructions.
    pub fn instructions(mut self, set: InstructionSet) -> Self {
        self.options.instruction_set = Some(set);
        self
    }

    /// With the exact Hessian, or Gauss–Newton.
    pub fn exact(mut self, exact: bool) -> Self {
        self.options.step.exact_hessian = exact;
        self
    }

    /// On this many threads.
    pub fn threads(mut self, threads: usize) -> Self {
        self.options.workers = if threads > 1 { Workers::Pool(threads) } else { Workers::Serial };
        self
    }

    /// Exactly this many iterations per step: the tolerance cannot be met, and no step is subdivided.
    pub fn iterations(mut self, iterations: u32) -> Self {
        self.options.step.max_iterations = iterations;
        self.options.step.tolerance = f64::MIN_POSITIVE;
        self.options.step.max_subdivisions = 0;
        self
    }
}

/// One timed step, or several.
#[derive(Debug, Clone, Copy, Default)]
pub struct Timed {
    /// Seconds per step: processor time on one thread, wall-clock time on several. For small crowds it includes the time of the
    /// roots.
    pub seconds: f64,
    /// Iterations per strand and step.
    pub iterations: f64,
    /// Fraction of strand-steps that did not converge or were rolled back.
    pub failed: f64,
    /// Seconds per step for setting the roots.
    pub roots: f64,
    /// Processor seconds per step, all threads together.
    pub processor: f64,
}

/// Moving strands.
pub struct Crowd {
    /// What it was made from.
    pub setting: Setting,
    /// The solver.
    pub solver: Solver,
    ids: Vec<StrandId>,
    stage: Stage,
    steps: u32,
}

impl Crowd {
    /// The strands at the scene's start.
    pub fn new(setting: &Setting) -> Self {
        let stage = Stage::new(setting.scene, setting.strands);
        let mut solver = Solver::new(setting.options.clone()).expect("a solver");
        let ids = solver.add_strands(&stage.strands(&setting.hair)).expect("strands");
        Self { setting: setting.clone(), solver, ids, stage, steps: 0 }
    }

    /// The same after some steps: all memory touched, the motion under way.
    pub fn warm(setting: &Setting, steps: u32) -> Self {
        let mut crowd = Self::new(setting);
        crowd.take(steps);
        crowd
    }

    /// Elements of all strands.
    pub fn elements(&self) -> usize {
        self.setting.strands * self.setting.hair.elements
    }

    /// Takes steps between two readings of the clock: reading the processor time takes as long as a part of a strand's step.
    fn take_together(&mut self, steps: u32) -> Timed {
        let roots: Vec<_> = (1..=steps).map(|step| self.stage.roots(STEP * f64::from(self.steps + step))).collect();
        self.steps += steps;
        let (mut iterations, mut failed) = (0.0, 0);
        let started = processor_seconds();
        for roots in &roots {
            self.solver.set_root_frames(&self.ids, roots, STEP).expect("roots");
            let report = self.solver.step(STEP, 1).expect("a step");
            iterations += report.mean_iterations;
            failed += report.unconverged + report.quarantined;
        }
        let (seconds, share) = (processor_seconds() - started, 1.0 / f64::from(steps.max(1)));
        let failed = f64::from(failed) / self.setting.strands as f64;
        Timed {
            seconds: seconds * share,
            iterations: iterations * share,
            failed: failed * share,
            roots: 0.0,
            processor: seconds * share,
        }
    }

    /// Takes steps without reading a clock (rustix's does not run under valgrind); returns a strand's total iterations.
    pub fn take_untimed(&mut self, steps: u32) -> f64 {
        let mut iterations = 0.0;
        for _ in 0..steps {
            self.steps += 1;
            let roots = self.stage.roots(STEP * f64::from(self.steps));
            self.solver.set_root_frames(&self.ids, &roots, STEP).expect("roots");
            iterations += self.solver.step(STEP, 1).expect("a step").mean_iterations;
        }
        iterations
    }

    /// Takes steps; returns the mean.
    pub fn take(&mut self, steps: u32) -> Timed {
        let mut sum = Timed::default();
        let serial = matches!(self.setting.options.workers, Workers::Serial);
        if serial && self.setting.strands < FEW {
            return self.take_together(steps);
        }
        for _ in 0..steps {
            self.steps += 1;
            let roots = self.stage.roots(STEP * f64::from(self.steps));
            let started = processor_seconds();
            self.solver.set_root_frames(&self.ids, &roots, STEP).expect("roots");
            sum.roots += processor_seconds() - started;
            let (processor, wall) = (processor_seconds_of_all(), Instant::now());
            let report = self.solver.step(STEP, 1).expect("a step");
            let (wall, processor) = (wall.elapsed().as_secs_f64(), processor_seconds_of_all() - processor);
            sum.processor += processor;
            sum.seconds += if serial { processor } else { wall };
            sum.iterations += report.mean_iterations;
            sum.failed += f64::from(report.unconverged + report.quarantined) / self.setting.strands as f64;
        }
        let share = 1.0 / f64::from(steps.max(1));
        Timed {
            seconds: sum.seconds * share,
            iterations: sum.iterations * share,
            failed: sum.failed * share,
            roots: sum.roots * share,
            processor: sum.processor * share,
        }
    }
}
