//! Adds mirror images of strands.

use crate::error::{Error, Result};
use crate::groom::pose::{Plane, mirrored};
use crate::math::vector::Vec3;
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;
use crate::solver::Solver;
use crate::solver::id::{self, StrandId};
use crate::solver::strands::strand::{Authored, Constrained, Strand};
use crate::step::state::{Earlier, History, StrandState};

impl Solver {
    /// Adds the mirror images of strands in their current state: shape, natural shape, velocities; curls wind the other way.
    /// Material, contact and the host's number are copied. The images' roots stay in place until they are moved. Returns the
    /// identifiers in the order of `ids`.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::OutOfMemory`] when all identifiers are in use.
    pub fn add_mirrored(&mut self, ids: &[StrandId], plane: &Plane) -> Result<Vec<StrandId>> {
        let indices = self.indices(ids)?;
        if self.strands.len() + indices.len() > id::MAX_SLOTS {
            return Err(Error::OutOfMemory { bytes: indices.len().saturating_mul(size_of::<Strand>()) });
        }
        let mut made = Vec::with_capacity(indices.len());
        for index in indices {
            let Some(id) = self.slots.insert(self.strands.len() + made.len()) else {
                made.iter().for_each(|made: &Strand| self.slots.remove(made.id));
                return Err(Error::OutOfMemory { bytes: size_of::<Strand>() });
            };
            made.push(image(&self.strands[index], id, plane));
        }
        let (gravity, mut kinematics) = (self.options.gravity, Kinematics::default());
        self.make_room(made.len())?;
        let mut out = Vec::with_capacity(made.len());
        for mut strand in made {
            strand.update_energies(gravity, &self.rules, &mut kinematics);
            out.push(strand.id);
            self.strands.push(strand);
        }
        self.constrained_substep.forget_pairs();
        Ok(out)
    }
}

fn rows(rows: &[[f64; 3]]) -> Vec<[f64; 3]> {
    rows.iter().copied().map(mirrored).collect()
}

fn image(strand: &Strand, id: StrandId, plane: &Plane) -> Strand {
    let Strand { model, state, user_data, authored, energies, last, contact, permitted_overlap, .. } = strand;
    let velocities = |list: &[Vec3<f64>]| list.iter().map(|v| Vec3::from(plane.direction((*v).into()))).collect::<Vec<_>>();
    let mut history = History::default();
    if state.history.step > 0.0 {
        let earlier = Earlier {
            curvatures: rows(&state.history.curvatures),
            velocities: velocities(&state.history.velocities),
            root: plane.frame(&state.history.root),
        };
        history = History::new(state.history.step, earlier);
    }
    let state = StrandState {
        root: plane.frame(&state.root),
        curvatures: rows(&state.curvatures),
        velocities: velocities(&state.velocities),
        rule: state.rule,
        rates: rows(&state.rates),
        root_velocity: plane.direction(state.root_velocity),
        root_angular_velocity: plane.spin(state.root_angular_velocity),
        wrench_force: plane.direction(state.wrench_force.into()).into(),
        wrench_torque: plane.spin(state.wrench_torque.into()).into(),
        history,
        subdivision: state.subdivision,
        air: None,
    };
    let authored = authored.as_deref().map(|authored| {
        Box::new(Authored { lengths: authored.lengths.clone(), natural: rows(&authored.natural).into_boxed_slice() })
    });
    Strand {
        model: StrandModel::of_section(model.lengths.to_vec(), rows(&model.natural), model.section().clone()),
        state,
        id,
        user_data: *user_data,
        authored,
        root_move: None,
        energies: *energies,
        last: *last,
        constrained: Constrained::No,
        touched: false,
        contact: contact.clone(),
        permitted_overlap: permitted_overlap.clone(),
        divergence: None,
        frozen: None,
        target: None,
    }
}
