//! Natural shapes that hold a strand in its drawn shape: equilibrium is K(q − qⁿ) = f(q), hence qⁿ = q − K⁻¹ f(q).

use nalgebra::Vector3;

use crate::chain::force::generalised;
use crate::error::{Result, check_finite};
use crate::math::frame::Frame;
use crate::math::quadrature::{self, Rule, Rules};
use crate::math::vector::Vec3;
use crate::rod::definition::{StrandDef, check_rows};
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;
use crate::step::state::rotation_matrix;

/// The natural curvatures with which a strand of this definition is in equilibrium under gravity (m/s²) in the shape
/// `curvatures`, one row per element. Frozen freedoms carry no moment of their own: their natural value is the curvature itself.
///
/// The balance is exact to rounding in a solver of the default
/// [`StepOptions::quadrature_tolerance`](crate::step::options::StepOptions::quadrature_tolerance), and to that tolerance in
/// others, for which there is [`natural_under_gravity_with`]. Whether the equilibrium is stable is another question, which
/// [`stability_under_gravity`](super::stability::stability_under_gravity) answers: a limp strand drawn upright is held exactly,
/// and falls at a touch.
///
/// # Errors
/// [`crate::error::Error::InvalidArgument`] for an invalid definition or rows.
pub fn natural_under_gravity(strand: &StrandDef, curvatures: &[[f64; 3]], gravity: Vector3<f64>) -> Result<Vec<[f64; 3]>> {
    natural_under_gravity_with(strand, curvatures, gravity, quadrature::DEFAULT_TOLERANCE)
}

/// The same for a solver of this `quadrature_tolerance`.
///
/// # Errors
/// [`crate::error::Error::InvalidArgument`] for an invalid definition, rows or tolerance (1e-12 to 1e-2).
pub fn natural_under_gravity_with(
    strand: &StrandDef,
    curvatures: &[[f64; 3]],
    gravity: Vector3<f64>,
    quadrature_tolerance: f64,
) -> Result<Vec<[f64; 3]>> {
    quadrature::check_tolerance("quadrature_tolerance", quadrature_tolerance)?;
    strand.check("strand")?;
    check_rows("curvatures", curvatures, strand.element_lengths.len())?;
    for axis in 0..3 {
        check_finite(|| format!("gravity[{axis}]"), gravity[axis])?;
    }
    let model = StrandModel::new(strand.element_lengths.clone(), strand.natural.clone(), strand.material, strand.freedoms);
    // The rule that a step will use: the balance is then exact to rounding.
    let rules = Rules::new(quadrature_tolerance);
    let rule = rules.rule(rules.next_for_angle(0, model.largest_angle(curvatures)));
    Ok(held_up(&model, &strand.root, curvatures, gravity, rule, &mut Kinematics::default()))
}

/// The same for a simulated strand's constants, on the quadrature rule of its steps; `kinematics` is scratch memory.
pub(crate) fn held_up(
    model: &StrandModel,
    root: &Frame,
    curvatures: &[[f64; 3]],
    gravity: Vector3<f64>,
    rule: &Rule,
    kinematics: &mut Kinematics<f64>,
) -> Vec<[f64; 3]> {
    kinematics.update(&rotation_matrix(root), &model.lengths, curvatures, rule);
    let weight = Vec3::from(gravity * model.linear_density);
    let forces = generalised(kinematics, |p| weight.scale(rule.weights[p % rule.len()] * model.lengths[p / rule.len()]));
    let mut natural = curvatures.to_vec();
    for (element, row) in natural.iter_mut().enumerate() {
        for axis in 0..3 {
            if model.freedoms.contains(axis) {
                row[axis] -= forces[element][axis] / (model.stiffness[axis] * model.lengths[element]);
            }
        }
    }
    natural
}
