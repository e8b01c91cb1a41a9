//! Parts of strands, and whole ones for hashes.

use super::bytes::{Reader, Writer, bad};
use crate::error::Result;
use crate::math::vector::Vec3;
use crate::solver::id::BodyId;
use crate::solver::shaping::freezing::Known;
use crate::solver::stepping::divergence::{Divergence, DivergenceState};
use crate::solver::strands::strand::{Authored, Strand};
use crate::step::state::{Earlier, History};

/// Marks a frozen strand.
pub const FROZEN: u32 = 5;

impl Writer {
    /// The original natural shape, if it has other elements. Separate from the strand: no step depends on it.
    pub fn authored(&mut self, authored: Option<&Authored>) {
        self.u64(authored.map_or(0, |authored| authored.lengths.len() as u64));
        if let Some(authored) = authored {
            authored.lengths.iter().for_each(|length| self.f64(*length));
            self.rows(&authored.natural);
        }
    }

    /// The record of a diverged strand.
    pub fn divergence(&mut self, divergence: Option<&Divergence>) {
        let Some(Divergence { bodies, lag, state }) = divergence else { return self.u32(0) };
        match state {
            DivergenceState::Carried { seconds } => {
                self.u32(1);
                self.f64(*seconds);
            }
            DivergenceState::RolledBack { seconds } => {
                self.u32(2);
                self.f64(*seconds);
            }
            DivergenceState::Behind { seconds } => {
                self.u32(4);
                self.f64(*seconds);
            }
            DivergenceState::Returning { seconds, from } => {
                self.u32(3);
                self.f64(*seconds);
                self.rows(from);
            }
        }
        self.f64(*lag);
        self.u64(bodies.len() as u64);
        bodies.iter().for_each(|body| self.frame(body));
    }

    /// A frozen strand, in place of the record of a diverged one.
    pub fn frozen(&mut self, bodies: &[Known]) {
        self.u32(FROZEN);
        self.u64(bodies.len() as u64);
        for Known { body, place, gap } in bodies {
            self.u64(body.bits());
            self.frame(place);
            self.f64(*gap);
        }
    }

    pub fn velocities(&mut self, velocities: &[Vec3<f64>]) {
        if !self.only_counts(size_of_val(velocities)) {
            velocities.iter().for_each(|v| v.0.iter().for_each(|x| self.f64(*x)));
        }
    }

    /// A strand's constants and state, for hashes; without the identifier.
    pub fn strand(&mut self, strand: &Strand) {
        let (model, state) = (&strand.model, &strand.state);
        self.u64(strand.user_data);
        self.u64(model.element_count() as u64);
        model.lengths.iter().for_each(|length| self.f64(*length));
        self.rows(&model.natural);
        model.material.values().into_iter().for_each(|value| self.f64(value));
        self.u32(model.freedoms.bits());
        self.rows(&state.curvatures);
        self.rows(&state.rates);
        self.u32(state.rule as u32);
        self.velocities(&state.velocities);
        self.frame(&state.root);
        self.vector(state.root_velocity);
        self.vector(state.root_angular_velocity);
        self.vector(state.wrench_force.into());
        self.vector(state.wrench_torque.into());
        self.u32(state.subdivision);
        self.f64(state.history.step);
        if state.history.step > 0.0 {
            self.rows(&state.history.curvatures);
            self.velocities(&state.history.velocities);
            self.frame(&state.history.root);
        }
        self.pose_move(strand.root_move.as_deref());
        self.u32(strand.last.iterations);
        self.u32(u32::from(strand.last.converged));
        self.u32(u32::from(strand.last.quarantined));
        match strand.frozen.as_deref() {
            Some(frozen) => self.frozen(&frozen.bodies),
            None => self.divergence(strand.divergence.as_deref()),
        }
        self.f64(strand.energies.kinetic);
        self.f64(strand.energies.elastic);
        self.f64(strand.energies.gravity);
    }
}

impl Reader<'_> {
    /// The bodies near a frozen strand.
    pub fn frozen(&mut self) -> Result<Vec<Known>> {
        let count = self.count(8 * 9)?;
        let known = |reader: &mut Self| {
            let (body, place) = (BodyId::from_bits(reader.u64()?), reader.finite_frame("a body's pose for a frozen strand")?);
            let gap = reader.f64()?;
            if gap.is_nan() {
                Err(bad("a body's distance from a strand is not a number"))
            } else {
                Ok(Known { body, place, gap })
            }
        };
        (0..count).map(|_| known(self)).collect()
    }

    pub fn divergence(&mut self, tag: u32, elements: usize) -> Result<Option<Box<Divergence>>> {
        let state = match tag {
            0 => return Ok(None),
            1 => DivergenceState::Carried { seconds: self.finite("a strand's time carried along")? },
            2 => DivergenceState::RolledBack { seconds: self.finite("a strand's time rolled back")? },
            3 => {
                let seconds = self.finite("a strand's time of return")?;
                let from = self.rows(elements)?;
                if !from.iter().flatten().all(|x| x.is_finite()) {
                    return Err(bad("a strand returns from a shape that is not finite"));
                }
                DivergenceState::Returning { seconds, from: from.into() }
            }
            4 => DivergenceState::Behind { seconds: self.finite("a strand's time behind a body")? },
            other => return Err(bad(format!("a strand has state {other}"))),
        };
        let lag = self.finite("a strand's time with bodies that follow")?;
        let count = self.count(8 * 7)?;
        let bodies = (0..count).map(|_| self.finite_frame("a body's pose for a strand")).collect::<Result<Vec<_>>>()?;
        Ok(Some(Box::new(Divergence { bodies, lag, state })))
    }

    /// The strand `step` seconds ago.
    pub fn history(&mut self, step: f64, elements: usize, points: usize) -> Result<History> {
        if !(step.is_finite() && step > 0.0) {
            return Err(bad(format!("a strand's last step took {step} s")));
        }
        let curvatures = self.rows(elements)?;
        let velocities = self.rows(points)?;
        if !curvatures.iter().chain(&velocities).flatten().all(|x| x.is_finite()) {
            return Err(bad("a strand's history has a number that is not finite"));
        }
        let velocities = velocities.into_iter().map(Vec3).collect();
        Ok(History::new(step, Earlier { curvatures, velocities, root: self.frame()? }))
    }

    /// The original natural shape of a strand of this length.
    pub fn authored(&mut self, length: f64) -> Result<Option<Box<Authored>>> {
        let count = self.count(8 * 4)?;
        if count == 0 {
            return Ok(None);
        }
        let lengths = (0..count).map(|_| self.f64()).collect::<Result<Vec<f64>>>()?;
        let natural = self.rows(count)?;
        let good = lengths.iter().all(|length| length.is_finite() && *length > 0.0)
            && (lengths.iter().sum::<f64>() - length).abs() <= 1e-6 * length
            && natural.iter().flatten().all(|x| x.is_finite());
        if !good {
            return Err(bad("a strand's original natural shape does not have its length"));
        }
        Ok(Some(Box::new(Authored { lengths: lengths.into(), natural: natural.into() })))
    }
}
