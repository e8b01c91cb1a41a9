//! The numbers of a pack's strands in lanes, and their transfer into them and back.
//!
//! In f32 every strand has its own units, powers of two near its length, its mass and the step, so that its numbers are of order
//! one: f32 has too few exponents for the product of a hair's stiffness and a short step's square. Curvatures are transferred as
//! a rounded part and a remainder, so that small changes add up over many steps.

use super::members::Pack;
use super::targets::TargetLanes;
use crate::math::frame::Frame;
use crate::math::lane::{Lane, MAX_LANES, Precision};
use crate::math::vector::{Mat3, Vec3};
use crate::rod::strand::StrandModel;
use crate::step::Surroundings;
use crate::step::state::{StrandState, rotation_matrix};

/// The units of a lane's numbers in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// m.
    pub length: f64,
    /// s.
    pub time: f64,
    /// kg.
    pub mass: f64,
}

impl Units {
    /// Metre, second, kilogram.
    pub const SI: Self = Self { length: 1.0, time: 1.0, mass: 1.0 };

    /// The units for a strand and a step of `h` seconds.
    #[inline(always)]
    fn of(precision: Precision, model: &StrandModel, h: f64) -> Self {
        match precision {
            Precision::F64 => Self::SI,
            Precision::F32 => {
                let length = model.length();
                Self { length: power_of_two(length), time: power_of_two(h), mass: power_of_two(length * model.linear_density) }
            }
        }
    }

    /// N.
    #[inline(always)]
    pub fn force(&self) -> f64 {
        self.mass * self.length / (self.time * self.time)
    }

    /// J, N·m.
    #[inline(always)]
    pub fn energy(&self) -> f64 {
        self.force() * self.length
    }

    /// m/s.
    #[inline(always)]
    pub fn speed(&self) -> f64 {
        self.length / self.time
    }
}

/// The power of two at or below a positive number.
fn power_of_two(value: f64) -> f64 {
    // The exponent's bits alone; a subnormal number becomes the smallest normal one.
    f64::from_bits(value.to_bits() & 0x7ff0_0000_0000_0000).max(f64::MIN_POSITIVE)
}

/// The numbers of a step's strands, in lanes; lanes without a strand repeat the first.
#[derive(Debug, Clone)]
pub struct Loaded<T> {
    /// How many lanes have a strand.
    pub count: usize,
    /// Units of each lane.
    pub units: [Units; MAX_LANES],
    /// Element lengths.
    pub lengths: Vec<T>,
    /// κⁿ.
    pub natural: Vec<[T; 3]>,
    /// EIᵢ.
    pub stiffness: [T; 3],
    /// γ + μ EIᵢ.
    pub dissipation: [T; 3],
    /// μ EIᵢ.
    pub viscosity: [T; 3],
    /// ρS.
    pub linear_density: T,
    /// ν.
    pub air_drag: T,
    /// Whether any strand feels drag, and whether any has internal friction along an axis.
    pub has_drag: bool,
    /// See `has_drag`.
    pub has_dissipation: [bool; 3],
    /// Gravity.
    pub gravity: Vec3<T>,
    /// Wind.
    pub wind: Vec3<T>,
    /// Whether the air's velocity is another at every point: then it is that of `air`.
    pub has_air: bool,
    /// Velocities of the air at the points.
    pub air: Vec<Vec3<T>>,
    /// What draws the points to targets.
    pub targets: TargetLanes<T>,
    /// κ.
    pub curvatures: Vec<[T; 3]>,
    /// κ̇.
    pub rates: Vec<[T; 3]>,
    /// v.
    pub velocities: Vec<Vec3<T>>,
    /// The root's rotation.
    pub rotation: Mat3<T>,
    /// Rounding error of κ in the lane (f32 only).
    pub compensation: Vec<[T; 3]>,
    /// κ at the start of the last step.
    pub past_curvatures: Vec<[T; 3]>,
    /// Rounding error of that (f32 only).
    pub past_compensation: Vec<[T; 3]>,
    /// v at the start of the last step.
    pub past_velocities: Vec<Vec3<T>>,
    /// The root's rotation at the start of the last step.
    pub past_rotation: Mat3<T>,
    /// The root's origin at the start of the last step, relative to the current one.
    pub past_offset: Vec3<T>,
    /// Seconds of the last step.
    pub past_step: T,
    /// Seconds of this step.
    pub step: T,
}

impl<T: Lane> Default for Loaded<T> {
    fn default() -> Self {
        Self {
            count: 0,
            units: [Units::SI; MAX_LANES],
            lengths: Vec::new(),
            natural: Vec::new(),
            stiffness: [T::zero(); 3],
            dissipation: [T::zero(); 3],
            viscosity: [T::zero(); 3],
            linear_density: T::zero(),
            air_drag: T::zero(),
            has_drag: false,
            has_dissipation: [false; 3],
            gravity: Vec3::zero(),
            wind: Vec3::zero(),
            has_air: false,
            air: Vec::new(),
            targets: TargetLanes::default(),
            curvatures: Vec::new(),
            rates: Vec::new(),
            velocities: Vec::new(),
            rotation: Mat3::zero(),
            compensation: Vec::new(),
            past_curvatures: Vec::new(),
            past_compensation: Vec::new(),
            past_velocities: Vec::new(),
            past_rotation: Mat3::zero(),
            past_offset: Vec3::zero(),
            past_step: T::zero(),
            step: T::zero(),
        }
    }
}

/// One lane of a vector, in the given unit.
#[inline(always)]
pub fn lane_of<T: Lane>(vector: &Vec3<T>, lane: usize, unit: f64) -> Vec3<f64> {
    Vec3([vector.0[0].lane(lane) * unit, vector.0[1].lane(lane) * unit, vector.0[2].lane(lane) * unit])
}

/// One lane of three numbers, times a factor.
#[inline(always)]
pub fn put<T: Lane>(to: &mut [T; 3], lane: usize, from: &[f64; 3], factor: f64) {
    for axis in 0..3 {
        to[axis].set_lane(lane, from[axis] * factor);
    }
}

#[inline(always)]
fn put_rows<T: Lane>(to: &mut [[T; 3]], lane: usize, from: &[[f64; 3]], factor: f64) {
    for (to, from) in to.iter_mut().zip(from) {
        put(to, lane, from, factor);
    }
}

/// Rounding errors of rows that were put into a lane.
#[inline(always)]
fn put_compensation<T: Lane>(to: &mut [[T; 3]], lane: usize, from: &[[f64; 3]], factor: f64, rounded: &[[T; 3]]) {
    for ((to, from), rounded) in to.iter_mut().zip(from).zip(rounded) {
        for axis in 0..3 {
            to[axis].set_lane(lane, from[axis] * factor - rounded[axis].lane(lane));
        }
    }
}

#[inline(always)]
fn put_vectors<T: Lane>(to: &mut [Vec3<T>], lane: usize, from: &[Vec3<f64>], factor: f64) {
    for (to, from) in to.iter_mut().zip(from) {
        put(&mut to.0, lane, &from.0, factor);
    }
}

/// One lane of a rotation.
#[inline(always)]
pub fn put_rotation<T: Lane>(to: &mut Mat3<T>, lane: usize, from: &Frame) {
    let matrix = rotation_matrix(from);
    for row in 0..3 {
        put(&mut to.0[row], lane, &matrix.0[row], 1.0);
    }
}

/// One lane of the vector from one origin to another.
#[inline(always)]
pub fn put_offset<T: Lane>(to: &mut Vec3<T>, lane: usize, from: &Frame, until: &Frame, units: &Units) {
    let offset = until.origin - from.origin;
    put(&mut to.0, lane, &[offset.x, offset.y, offset.z], 1.0 / units.length);
}

/// What a step reads of a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reads {
    /// The points' velocities.
    pub velocities: bool,
    /// The last step.
    pub history: bool,
}

impl<T: Lane> Loaded<T> {
    /// The strand whose numbers are in a lane.
    #[inline(always)]
    pub fn member(&self, lane: usize) -> usize {
        if lane < self.count { lane } else { 0 }
    }

    /// Loads every lane. A lane's unit of curvature is 1/length.
    #[inline(always)]
    pub fn load(&mut self, members: &dyn Pack, surroundings: &Surroundings, h: f64, reads: Reads) {
        let elements = members.model(0).element_count();
        let points = members.state(0).velocities.len();
        self.count = members.count();
        self.lengths.resize(elements, T::zero());
        self.natural.resize(elements, [T::zero(); 3]);
        self.curvatures.resize(elements, [T::zero(); 3]);
        self.rates.resize(elements, [T::zero(); 3]);
        if reads.velocities {
            self.velocities.resize(points, Vec3::zero());
        }
        if reads.history {
            self.past_curvatures.resize(elements, [T::zero(); 3]);
            self.past_velocities.resize(points, Vec3::zero());
        }
        if T::PRECISION == Precision::F32 {
            self.compensation.resize(elements, [T::zero(); 3]);
            if reads.history {
                self.past_compensation.resize(elements, [T::zero(); 3]);
            }
        }
        (self.has_drag, self.has_dissipation) = (false, [false; 3]);
        self.has_air = (0..self.count).any(|lane| members.state(lane).air.is_some());
        if self.has_air {
            self.air.resize(points, Vec3::zero());
        }
        self.targets.are_present = (0..self.count).any(|lane| members.target(lane).is_some());
        for lane in 0..T::LANES {
            let member = self.member(lane);
            self.load_lane(lane, members.model(member), members.state(member), surroundings, h, reads);
        }
    }

    #[inline(always)]
    fn load_lane(
        &mut self,
        lane: usize,
        model: &StrandModel,
        state: &StrandState,
        surroundings: &Surroundings,
        h: f64,
        reads: Reads,
    ) {
        let units = Units::of(T::PRECISION, model, h);
        let Units { length, time, mass } = units;
        self.units[lane] = units;
        for (to, from) in self.lengths.iter_mut().zip(&model.lengths) {
            to.set_lane(lane, from / length);
        }
        // Bending stiffness is energy × length.
        let bending = 1.0 / (units.energy() * length);
        for axis in 0..3 {
            self.stiffness[axis].set_lane(lane, model.stiffness[axis] * bending);
            self.dissipation[axis].set_lane(lane, model.dissipation[axis] * (bending / time));
            let viscosity = model.material.viscosity * model.stiffness[axis];
            self.viscosity[axis].set_lane(lane, viscosity * (bending / time));
            self.has_dissipation[axis] |= model.dissipation[axis] > 0.0;
        }
        self.linear_density.set_lane(lane, model.linear_density * (length / mass));
        self.air_drag.set_lane(lane, model.material.air_drag * (length * time / mass));
        self.has_drag |= model.material.air_drag > 0.0;
        put(&mut self.gravity.0, lane, &surroundings.gravity.0, time / units.speed());
        put(&mut self.wind.0, lane, &surroundings.wind.0, 1.0 / units.speed());
        if self.has_air {
            match state.air() {
                Some(air) => put_vectors(&mut self.air, lane, air, 1.0 / units.speed()),
                None => self.air.iter_mut().for_each(|to| put(&mut to.0, lane, &surroundings.wind.0, 1.0 / units.speed())),
            }
        }
        self.step.set_lane(lane, h / time);

        put_rows(&mut self.natural, lane, &model.natural, length);
        put_rows(&mut self.curvatures, lane, &state.curvatures, length);
        put_rows(&mut self.rates, lane, &state.rates, length * time);
        if T::PRECISION == Precision::F32 {
            put_compensation(&mut self.compensation, lane, &state.curvatures, length, &self.curvatures);
        }
        put_rotation(&mut self.rotation, lane, &state.root);
        if reads.velocities {
            put_vectors(&mut self.velocities, lane, &state.velocities, 1.0 / units.speed());
        }
        if reads.history {
            put_rows(&mut self.past_curvatures, lane, &state.history.curvatures, length);
            if T::PRECISION == Precision::F32 {
                put_compensation(&mut self.past_compensation, lane, &state.history.curvatures, length, &self.past_curvatures);
            }
            put_vectors(&mut self.past_velocities, lane, &state.history.velocities, 1.0 / units.speed());
            put_rotation(&mut self.past_rotation, lane, &state.history.root);
            put_offset(&mut self.past_offset, lane, &state.root, &state.history.root, &units);
            self.past_step.set_lane(lane, state.history.step / time);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_are_at_or_below() {
        for value in [1.0, 0.3, 1e-12, 5.9e3, 1.0 / 60.0, 1e-320] {
            let power = power_of_two(value);
            assert!(power.is_normal() && power.log2().fract() == 0.0);
            assert!(value < f64::MIN_POSITIVE || (power <= value && value < 2.0 * power), "{value} {power}");
        }
    }
}
