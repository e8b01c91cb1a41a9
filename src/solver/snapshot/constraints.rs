//! Constraints in a snapshot: definitions, motions of their targets, last results.

use nalgebra::Vector3;

use super::bytes::{Reader, Writer, bad};
use crate::error::Result;
use crate::math::frame::pose_motion::PoseMotion;
use crate::solver::constraints::{Constraint, ConstraintDef, ConstraintState, ConstraintStatus, Hold};
use crate::solver::id::{ConstraintId, SlotMap, StrandId};
use crate::solver::strands::strand::Strand;

impl Writer {
    /// All constraints, their strands by index; `id` writes the end of each.
    pub fn constraints(&mut self, constraints: &[Constraint], strands: &SlotMap<StrandId>, id: impl Fn(&mut Self, &Constraint)) {
        self.u64(constraints.len() as u64);
        for constraint in constraints {
            self.constraint(constraint, strands);
            id(self, constraint);
        }
    }

    fn constraint(&mut self, constraint: &Constraint, strands: &SlotMap<StrandId>) {
        let Constraint { def, motion, state, forces, .. } = constraint;
        // A constraint is removed with its strands: there is always an index.
        let index = |id: StrandId| strands.index(id).unwrap_or(usize::MAX) as u64;
        self.u64(index(def.strand));
        self.f64(def.arclength);
        match def.hold {
            Hold::Point => self.u32(1),
            Hold::Direction => self.u32(2),
            Hold::Frame => self.u32(3),
            Hold::Ring { friction } => {
                self.u32(4);
                self.friction(friction);
            }
            Hold::Tie { other, arclength } => {
                self.u32(5);
                self.u64(index(other));
                self.f64(arclength);
            }
        }
        self.frame(&def.target);
        self.f64(def.compliance);
        self.frame(&motion.pose);
        self.pose_move(motion.going.as_ref());
        self.vector(state.force);
        self.vector(state.torque);
        self.f64(state.error);
        self.f64(state.arclength);
        self.u32(match state.status {
            ConstraintStatus::Holds => 1,
            ConstraintStatus::Dependent => 2,
            ConstraintStatus::Violated => 3,
            ConstraintStatus::Released => 4,
        });
        self.vectors(forces);
    }
}

impl Reader<'_> {
    /// All constraints; `slots` are their identifiers'.
    pub fn constraints(&mut self, slots: &SlotMap<ConstraintId>, strands: &[Strand]) -> Result<Vec<Constraint>> {
        let count = self.count(4 + 30 * 8)?;
        (0..count)
            .map(|index| {
                let constraint = self.constraint(strands)?;
                Ok(Constraint { id: self.id("constraint", slots, index)?, user_data: self.u64()?, ..constraint })
            })
            .collect()
    }

    /// A strand by its index.
    fn held<'a>(&mut self, strands: &'a [Strand]) -> Result<&'a Strand> {
        let index = self.u64()?;
        let strand = usize::try_from(index).ok().and_then(|index| strands.get(index));
        strand.ok_or_else(|| bad(format!("a constraint is on strand {index} of {}", strands.len())))
    }

    /// An arclength of a strand.
    fn arclength(&mut self, strand: &Strand) -> Result<f64> {
        let (arclength, length) = (self.f64()?, strand.model.length());
        if (0.0..=length * (1.0 + 1e-9)).contains(&arclength) {
            Ok(arclength)
        } else {
            Err(bad(format!("a constraint is {arclength} m along a strand of {length} m")))
        }
    }

    fn constraint(&mut self, strands: &[Strand]) -> Result<Constraint> {
        let strand = self.held(strands)?;
        let arclength = self.arclength(strand)?;
        let hold = match self.u32()? {
            1 => Hold::Point,
            2 => Hold::Direction,
            3 => Hold::Frame,
            4 => {
                let friction = self.friction()?;
                friction.check("friction").map_err(|error| super::bytes::of_part("a ring", &error))?;
                Hold::Ring { friction }
            }
            5 => {
                let other = self.held(strands)?;
                Hold::Tie { other: other.id, arclength: self.arclength(other)? }
            }
            other => return Err(bad(format!("a constraint has type {other}"))),
        };
        let target = self.finite_frame("a constraint's target")?;
        let compliance = self.finite("a compliance")?;
        if compliance < 0.0 {
            return Err(bad(format!("a compliance is {compliance}")));
        }
        let motion =
            PoseMotion { pose: self.finite_frame("a constraint's target")?, going: self.finite_pose_move("a target's motion")? };
        let state = ConstraintState {
            force: self.vector()?,
            torque: self.vector()?,
            error: self.f64()?,
            arclength: self.arclength(strand)?,
            status: match self.u32()? {
                1 => ConstraintStatus::Holds,
                2 => ConstraintStatus::Dependent,
                3 => ConstraintStatus::Violated,
                4 => ConstraintStatus::Released,
                other => return Err(bad(format!("a constraint's status is {other}"))),
            },
        };
        let mut forces = [Vector3::zeros(); 3];
        for force in &mut forces {
            *force = self.finite_vector("a constraint's force")?;
        }
        let def = ConstraintDef { strand: strand.id, arclength, hold, target, compliance };
        Ok(Constraint {
            id: ConstraintId::from_bits(0),
            def,
            motion,
            state,
            forces,
            parts: 0,
            held_at: Vector3::zeros(),
            user_data: 0,
        })
    }
}
