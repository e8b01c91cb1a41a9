//! Wind as a field: a host's function of place and time, looked up once before every substep.

use std::sync::Arc;

use nalgebra::Vector3;

use crate::math::vector::Vec3;
use crate::solver::Solver;
use crate::solver::strands::strand::Strand;
use crate::step::state::rotation_matrix;

/// Most points of one call of a field.
pub const WIND_BATCH: usize = 1024;

/// A field of wind. [`Solver::set_wind_field`] takes one. Functions of time and place are fields.
///
/// ```
/// use std::sync::Arc;
///
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let mut strand = StrandDef::straight(0.2, 5);
/// strand.material.air_drag = 2e-5;
/// solver.add_strands(&[strand])?;
/// let gusts = |seconds: f64, position: Vector3<f64>| Vector3::new(0.0, (8.0 * position.x + 20.0 * seconds).sin(), 0.0);
/// solver.set_wind_field(Some(Arc::new(gusts)));
/// solver.step(1.0 / 60.0, 2)?;
/// # Ok::<(), superhelix::Error>(())
/// ```
pub trait WindField: Send + Sync {
    /// The air's velocities (m/s, world) at positions (m, world), `seconds` after the call of [`Solver::step`] began. As many of one as of the
    /// other, at most [`WIND_BATCH`]; `velocities` come filled with zeros.
    fn velocities(&self, seconds: f64, positions: &[[f64; 3]], velocities: &mut [[f64; 3]]);
}

impl Solver {
    /// Adds a field to the uniform wind, in place of the field that there was; `None`: none, which costs nothing.
    ///
    /// Before every substep the field is called, on the thread that steps, for the quadrature points of all strands with air drag that are awake: in
    /// the order of the strands, from root to tip, in batches, so that a step gives the same bits for any number of workers. Points are where they
    /// will be at the substep's end if they keep their velocities, and the time is that of the substep's end; so the second order in the step remains.
    /// A strand whose substep is subdivided keeps these velocities in all pieces. A velocity that is not finite makes its strand non-finite: it is
    /// rolled back and quarantined.
    ///
    /// The field is the host's: it is in no snapshot, and [`Solver::restore`] leaves it as it is. [`Solver::settle`] does not feel it, and
    /// [`Integrator::Reference`](crate::step::options::Integrator::Reference) refuses it, since its error control cannot see it.
    pub fn set_wind_field(&mut self, field: Option<Arc<dyn WindField>>) {
        self.wind_field = field;
        for strand in &mut self.strands {
            strand.state.air = None;
        }
    }

    /// Looks up the field for a substep of `h` seconds that begins `from` seconds after the call's start.
    pub(super) fn look_up_wind(&mut self, from: f64, h: f64) {
        let Some(field) = self.wind_field.clone() else { return };
        let rules = &self.rules;
        self.workers.for_each(&mut self.strands, |strand, scratch| {
            let Strand { model, state, frozen, .. } = strand;
            if model.material.air_drag == 0.0 || frozen.is_some() {
                state.air = None;
                return;
            }
            let kinematics = &mut scratch.step.one.workspace.iterate.kinematics;
            kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rules.rule(state.rule));
            let origin = Vec3::from(state.root.origin);
            let ends = kinematics.points.iter().zip(&state.velocities).map(|(point, v)| origin + point.position + v.scale(h));
            let air = &mut state.air.get_or_insert_default().velocities;
            air.clear();
            air.extend(ends);
        });
        let wind = Vec3::from(self.options.wind);
        let mut batch = Batch { field: &*field, seconds: from + h, wind, positions: Vec::new(), velocities: Vec::new() };
        let airs = self.strands.iter_mut().filter_map(|strand| strand.state.air.as_deref_mut());
        let mut points = airs.flat_map(|air| air.velocities.iter_mut());
        let mut places = Vec::with_capacity(WIND_BATCH);
        loop {
            places.clear();
            places.extend(points.by_ref().take(WIND_BATCH));
            if places.is_empty() {
                break;
            }
            batch.replace(&mut places);
        }
    }
}

/// Room for a call of a field.
struct Batch<'a> {
    field: &'a dyn WindField,
    seconds: f64,
    wind: Vec3<f64>,
    positions: Vec<[f64; 3]>,
    velocities: Vec<[f64; 3]>,
}

impl Batch<'_> {
    /// Puts the air's velocities where the positions are.
    fn replace(&mut self, places: &mut [&mut Vec3<f64>]) {
        self.positions.clear();
        self.positions.extend(places.iter().map(|place| place.0));
        self.velocities.clear();
        self.velocities.resize(places.len(), [0.0; 3]);
        self.field.velocities(self.seconds, &self.positions, &mut self.velocities);
        for (place, velocity) in places.iter_mut().zip(&self.velocities) {
            **place = self.wind + Vec3(*velocity);
        }
    }
}

/// A field from a function of place and time.
impl<F: Fn(f64, Vector3<f64>) -> Vector3<f64> + Send + Sync> WindField for F {
    fn velocities(&self, seconds: f64, positions: &[[f64; 3]], velocities: &mut [[f64; 3]]) {
        for (velocity, position) in velocities.iter_mut().zip(positions) {
            *velocity = self(seconds, Vector3::from(*position)).into();
        }
    }
}
