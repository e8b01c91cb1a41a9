//! Poses simulated strands: drag a point, brush, change an element (`groom/pose.rs`).

use crate::contact::body_at::BodyAt;
use crate::contact::options::StrandContact;
use crate::error::{Error, Result};
use crate::groom::pose::{
    Brush, Brushed, DragTarget, Dragged, ElementChange, PoseOptions, PoseScratch, StrandShape, Surroundings, check_applied,
    check_brush, check_target,
};
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;
use crate::solver::Solver;
use crate::solver::id::StrandId;
use crate::solver::strands::strand::Strand;

/// Smallest and largest number of strands per task.
const MIN_STRANDS_PER_TASK: usize = 4;
const MAX_STRANDS_PER_TASK: usize = 64;

/// A strand on its way to another shape.
struct Posed<T> {
    index: usize,
    /// The first of its elements among those of the call.
    first: usize,
    rows: Vec<[f64; 3]>,
    found: Option<T>,
}

impl Solver {
    /// The current shape of a strand.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn shape(&self, id: StrandId) -> Result<StrandShape> {
        Ok(shape_of(self.strand("id", id)?))
    }

    /// Drags a point of each strand to its target, with fixed roots. Of the shapes that reach it, finds one near the current
    /// shape, or near the natural one ([`PoseOptions::natural_pull`]), bent by the strand's stiffness. Returns the results in the
    /// order of `ids`. The strands are then at rest relative to their roots, and quarantines are cleared. A strand stays outside
    /// the bodies that it collides with (a strand without contact: all bodies, with the section's larger semi-axis as its
    /// radius). Other strands, constraints, gravity and natural shapes are ignored: [`Solver::take_rest_shapes`] makes the pose
    /// permanent.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming `targets[i]`, a field of `options`, an identifier
    /// given twice, or for counts that differ. Nothing has then changed.
    pub fn drag(&mut self, ids: &[StrandId], targets: &[DragTarget], options: &PoseOptions) -> Result<Vec<Dragged>> {
        if targets.len() != ids.len() {
            return Err(Error::invalid("targets (count)", targets.len(), format!("{}, one per strand", ids.len())));
        }
        let indices = self.indices(ids)?;
        for (k, (target, index)) in targets.iter().zip(&indices).enumerate() {
            check_target(&format!("targets[{k}]"), target, self.strands[*index].model.length())?;
        }
        self.pose(ids, indices, options, |k, shape, movable, surroundings, scratch| {
            Some(shape.drag_checked(&targets[k], options, movable, surroundings, scratch))
        })
        .map(|found| found.into_iter().flatten().collect())
    }

    /// Moves a brush over strands with fixed roots: the points inside follow ([`Brush`]), and the strands bend. Strands without
    /// points in the brush stay the same to the bit, velocities included; the others are then at rest, as after [`Solver::drag`],
    /// which also describes the obstacles. Returns the results in the order of `ids`.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming a field of `brush` or `options`, or an identifier
    /// given twice. Nothing has then changed.
    pub fn brush(&mut self, ids: &[StrandId], brush: &Brush, options: &PoseOptions) -> Result<Vec<Brushed>> {
        check_brush("brush", brush)?;
        let indices = self.indices(ids)?;
        self.pose(ids, indices, options, |_, shape, movable, surroundings, scratch| {
            let found = shape.brush_checked(brush, options, movable, surroundings, scratch);
            found.touched.then_some(found)
        })
        .map(|found| found.into_iter().map(Option::unwrap_or_default).collect())
    }

    /// Poses strands with several workers: each call of `one` sees only its own strand. A strand without a result stays as it is.
    fn pose<T: Send>(
        &mut self,
        ids: &[StrandId],
        indices: Vec<usize>,
        options: &PoseOptions,
        one: impl Fn(usize, &mut StrandShape, Option<&[bool]>, &Surroundings, &mut PoseScratch) -> Option<T> + Sync,
    ) -> Result<Vec<Option<T>>> {
        self.check_once(ids, &indices)?;
        let mut all = 0;
        let mut posed: Vec<(usize, Posed<T>)> = Vec::with_capacity(indices.len());
        for (k, index) in indices.into_iter().enumerate() {
            posed.push((k, Posed { index, first: all, rows: Vec::new(), found: None }));
            all += self.strands[index].model.element_count();
        }
        options.check("options", all)?;
        for body in &mut self.bodies {
            body.body.rest();
        }
        let bodies: Vec<BodyAt> = if options.keep_out {
            self.bodies.iter().enumerate().map(|(k, scene)| scene.body.still(k as u32)).collect()
        } else {
            Vec::new()
        };
        let strands = &self.strands;
        self.workers.for_each_task(&mut posed, MIN_STRANDS_PER_TASK, MAX_STRANDS_PER_TASK, |posed, _| {
            let (mut scratch, mut near) = (PoseScratch::default(), Vec::new());
            for (k, posed) in posed {
                let strand = &strands[posed.index];
                let mut shape = shape_of(strand);
                let movable = options.movable.as_deref();
                let movable = movable.map(|movable| &movable[posed.first..posed.first + shape.curvatures.len()]);
                near.clear();
                near.extend(bodies.iter().filter(|body| meets(strand.contact.as_deref(), body)).copied());
                posed.found = one(*k, &mut shape, movable, &surroundings(strand, &near), &mut scratch);
                posed.rows = shape.curvatures;
            }
        });
        let mut kinematics = Kinematics::default();
        let mut found = Vec::with_capacity(posed.len());
        for (_, posed) in posed {
            if posed.found.is_some() {
                self.put_with(posed.index, posed.rows, None, &mut kinematics);
            }
            found.push(posed.found);
        }
        Ok(found)
    }

    /// Checks that no strand is named twice.
    pub(in crate::solver) fn check_once(&self, ids: &[StrandId], indices: &[usize]) -> Result<()> {
        let mut seen = vec![false; self.strands.len()];
        for (k, index) in indices.iter().enumerate() {
            if std::mem::replace(&mut seen[*index], true) {
                return Err(Error::invalid(format!("ids[{k}]"), format!("0x{:016x}", ids[k].bits()), "each strand once"));
            }
        }
        Ok(())
    }

    /// Changes one element of each strand: twists, bends and lengthens it; everything beyond moves along. Twist and bend apply to
    /// the current shape, the length to the natural one as well, whose element keeps curvatures or angles in the same way. The
    /// strands are then at rest relative to their roots. A changed length discards the shape that [`Solver::set_element_count`]
    /// keeps.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming `elements[i]`, `changes[i]`, an identifier given
    /// twice, a frozen freedom that would change, or for counts that differ; also where a constraint would hold a point that no
    /// longer exists. Nothing has then changed.
    pub fn change_elements(&mut self, ids: &[StrandId], elements: &[usize], changes: &[ElementChange]) -> Result<()> {
        for (argument, count) in [("elements", elements.len()), ("changes", changes.len())] {
            if count != ids.len() {
                return Err(Error::invalid(format!("{argument} (count)"), count, format!("{}, one per strand", ids.len())));
            }
        }
        let indices = self.indices(ids)?;
        self.check_once(ids, &indices)?;
        let mut made = Vec::with_capacity(indices.len());
        for (k, index) in indices.into_iter().enumerate() {
            let (element, change, name) = (elements[k], &changes[k], format!("changes[{k}]"));
            change.check(&name)?;
            let Strand { model, state, .. } = &self.strands[index];
            if element >= model.element_count() {
                let expected = format!("0 to {}", model.element_count() - 1);
                return Err(Error::invalid(format!("elements[{k}]"), element, expected));
            }
            for (axis, (more, field)) in [change.twist, change.bend[0], change.bend[1]].into_iter().zip(FIELDS).enumerate() {
                if more != 0.0 && !model.freedoms.contains(axis) {
                    return Err(Error::invalid(format!("{name}.{field}"), more, "0, since this freedom is frozen"));
                }
            }
            let (length, row) = change.applied(model.lengths[element], state.curvatures[element]);
            let only_length = ElementChange { twist: 0.0, bend: [0.0; 2], ..*change };
            let (_, natural) = only_length.applied(model.lengths[element], model.natural[element]);
            check_applied(&name, length, &row)?;
            check_applied(&name, length, &natural)?;
            let (mut lengths, mut rows) = (model.lengths.to_vec(), state.curvatures.clone());
            let mut naturals = model.natural.to_vec();
            (lengths[element], rows[element], naturals[element]) = (length, row, natural);
            self.check_held(&name, index, lengths.iter().sum())?;
            made.push((index, lengths, naturals, rows));
        }
        let mut kinematics = Kinematics::default();
        for (index, lengths, natural, rows) in made {
            let strand = &mut self.strands[index];
            if *lengths != *strand.model.lengths {
                strand.model = StrandModel::of_section(lengths, natural, strand.model.section().clone());
                strand.authored = None;
                self.constrained_substep.forget();
            }
            self.put_with(index, rows, None, &mut kinematics);
        }
        Ok(())
    }
}

/// Names of a change's fields.
const FIELDS: [&str; 3] = ["twist", "bend[0]", "bend[1]"];

fn shape_of(strand: &Strand) -> StrandShape {
    StrandShape {
        root: strand.state.root,
        element_lengths: strand.model.lengths.to_vec(),
        curvatures: strand.state.curvatures.clone(),
    }
}

/// The surroundings of a strand, with these bodies.
fn surroundings<'a>(strand: &'a Strand, bodies: &'a [BodyAt<'a>]) -> Surroundings<'a> {
    let Strand { model, contact, .. } = strand;
    let [a1, a2] = model.material.radius;
    let (radius, exempt) = contact.as_ref().map_or((a1.max(a2), 0.0), |contact| (contact.radius, contact.exempt_length));
    // In units of the softest stiffness, so that damping acts alike on all strands.
    let least = model.stiffness.into_iter().fold(f64::INFINITY, f64::min);
    let charge = model.stiffness.map(|stiffness| stiffness / least);
    Surroundings { bodies, radius, exempt, natural: Some(&model.natural), freedoms: model.freedoms, charge }
}

/// Whether a strand stays outside a body.
fn meets(contact: Option<&StrandContact>, body: &BodyAt) -> bool {
    contact.is_none_or(|contact| body.meets(contact.groups, contact.mask))
}
