//! What Newton's iteration of a stage begins with: its two starts, and the terms of all points and curvatures.

use crate::energy::{CurvatureQuadratic, PointQuadratic, drag, elastic, friction, gravity, inertia, target};
use crate::math::lane::{Lane, Precision};
use crate::math::vector::Vec3;
use crate::rod::freedoms::Freedoms;
use crate::step::newton::iterate::Iterate;
use crate::step::pack::loaded::Loaded;
use crate::step::workspace::Stage;

/// Newton's two starts: the current state and, on trial, the one to which the rates lead. Frozen curvatures are natural.
#[inline(always)]
pub fn lead<T: Lane>(span: T, freedoms: Freedoms, loaded: &Loaded<T>, before: Option<&Stage<T>>, iterate: &mut Iterate<T>) {
    let rates = before.map_or(&loaded.rates, |stage| &stage.rates);
    let Iterate { curvatures, trial_curvatures, compensation, trial_compensation, .. } = iterate;
    trial_curvatures.resize(curvatures.len(), [T::zero(); 3]);
    if T::PRECISION == Precision::F32 && before.is_none() {
        compensation.clone_from(&loaded.compensation);
    }
    trial_compensation.clone_from(compensation);
    for (element, row) in curvatures.iter_mut().enumerate() {
        for axis in 0..3 {
            if freedoms.contains(axis) {
                let change = span * rates[element][axis];
                if T::PRECISION == Precision::F32 {
                    let change = change + compensation[element][axis];
                    (trial_curvatures[element][axis], trial_compensation[element][axis]) = row[axis].two_sum(change);
                } else {
                    trial_curvatures[element][axis] = row[axis] + change;
                }
            } else {
                // Its remainder is that of the start, unless a host changed it.
                row[axis] = loaded.natural[element][axis];
                trial_curvatures[element][axis] = row[axis];
            }
        }
    }
}

/// Sums the terms of every point and curvature into a stiffness and a target.
#[inline(always)]
pub fn assemble_terms<T: Lane>(
    k: T,
    offset: Vec3<T>,
    weights: &[f64],
    loaded: &Loaded<T>,
    stage: &Stage<T>,
    iterate: &mut Iterate<T>,
) {
    let Iterate { system, point_base, point_target, curvature_target, .. } = iterate;
    let points = stage.start_displacements.len();
    system.resize(loaded.lengths.len(), points);
    point_target.resize(points, Vec3::zero());
    curvature_target.resize(loaded.lengths.len(), [T::zero(); 3]);
    let per_element = weights.len();
    // Points differ only in the pulls of inertia and drag, and stiffnesses only by the weight: shared parts are summed once.
    // Pulls are relative to kṽ, where the velocity leads.
    let mut shared = PointQuadratic::zero();
    inertia::add(&mut shared, loaded.linear_density, k, Vec3::zero());
    gravity::add(&mut shared, loaded.linear_density, loaded.gravity);
    if loaded.has_drag {
        // A field's pull comes to each point's own.
        let wind = if loaded.has_air { Vec3::zero() } else { loaded.wind };
        drag::add(&mut shared, loaded.air_drag, k, wind);
    }
    let inverse = T::one() / shared.stiffness;
    for (element, length) in loaded.lengths.iter().enumerate() {
        for (node, weight) in weights.iter().enumerate() {
            let p = element * per_element + node;
            let start = stage.start_velocities[p];
            let mut pull = shared.pull;
            if loaded.has_drag {
                if loaded.has_air {
                    pull += drag::of_wind(loaded.air[p], loaded.air_drag);
                }
                pull -= drag::of_start(start, loaded.air_drag);
            }
            let (mut stiffness, mut inverse) = (shared.stiffness, inverse);
            if loaded.targets.are_present {
                let mut own = PointQuadratic { stiffness, pull };
                let leads_to = point_base[p] + (stage.start_displacements[p] + start.scale(k));
                let (place, velocity) = (loaded.targets.positions[p], loaded.targets.velocities[p]);
                target::add(&mut own, loaded.linear_density, k, loaded.targets.rates[p], place - leads_to, velocity - start);
                (stiffness, pull, inverse) = (own.stiffness, own.pull, T::one() / own.stiffness);
            }
            system.point_stiffness[p] = stiffness * (T::splat(*weight) * *length);
            point_target[p] = stage.start_displacements[p] + (start.scale(k) + (pull.scale(inverse) - offset));
        }
        for axis in 0..3 {
            let start = stage.start_changes[element][axis];
            let natural = loaded.natural[element][axis] - loaded.curvatures[element][axis];
            let mut quadratic = CurvatureQuadratic::zero();
            elastic::add(&mut quadratic, loaded.stiffness[axis], natural, start);
            if loaded.has_dissipation[axis] {
                friction::add(&mut quadratic, loaded.dissipation[axis], k);
            }
            system.curvature_stiffness[element][axis] = quadratic.stiffness * *length;
            curvature_target[element][axis] = start + quadratic.pull / quadratic.stiffness;
        }
    }
}
