//! Living strands posed: dragged by a point, brushed, an element changed (`groom/pose.rs`).

use super::Solver;
use super::id::StrandId;
use super::strand::Strand;
use crate::contact::body::BodyAt;
use crate::contact::options::StrandContact;
use crate::error::{Error, Result};
use crate::groom::pose::{
    Brush, Brushed, DragTarget, Dragged, ElementChange, PoseOptions, PoseScratch, StrandShape, Surroundings, check_applied,
    check_brush, check_target,
};
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;

/// Strands that a worker takes at a time, at least and at most.
const LEAST: usize = 4;
const MOST: usize = 64;

/// A strand on its way to another shape.
struct Posed<T> {
    index: usize,
    /// Where its elements begin among those of the call.
    first: usize,
    rows: Vec<[f64; 3]>,
    found: Option<T>,
}

impl Solver {
    /// The shape that a strand has now.
    ///
    /// # Errors
    /// [`Error::InvalidId`].
    pub fn shape(&self, id: StrandId) -> Result<StrandShape> {
        Ok(shape_of(self.strand("id", id)?))
    }

    /// Drags a point of each strand to its target, roots held: among the shapes that bring it there one near the present shape, or the
    /// natural one ([`PoseOptions::natural_pull`]), bent as the strand's stiffness bends it. What comes of each is told in the order of `ids`;
    /// the strands are at rest then, relative to their roots, and quarantines are cleared. Bodies that a strand's contact names are kept out
    /// of (strands without: all bodies, from the section's larger semi-axis on); other strands, constraints, gravity and natural shapes are
    /// not looked at: [`Solver::take_rest_shapes`] makes the pose one that stays.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming `targets[i]`, a field of `options`, an identifier given twice,
    /// or for counts that differ. Then nothing has changed.
    pub fn drag(&mut self, ids: &[StrandId], targets: &[DragTarget], options: &PoseOptions) -> Result<Vec<Dragged>> {
        if targets.len() != ids.len() {
            return Err(Error::invalid("targets (count)", targets.len(), format!("{}, one a strand", ids.len())));
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

    /// Moves a brush over strands, roots held: the points that lie in it follow ([`Brush`]), the strands bend. Strands with no point in the brush
    /// are left alone to the bit, velocities included; the others are at rest then, as after [`Solver::drag`], which says what is kept out
    /// of. What comes of each is told in the order of `ids`.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming a field of `brush` or `options`, or an identifier given twice.
    /// Then nothing has changed.
    pub fn brush(&mut self, ids: &[StrandId], brush: &Brush, options: &PoseOptions) -> Result<Vec<Brushed>> {
        check_brush("brush", brush)?;
        let indices = self.indices(ids)?;
        self.pose(ids, indices, options, |_, shape, movable, surroundings, scratch| {
            let found = shape.brush_checked(brush, options, movable, surroundings, scratch);
            found.touched.then_some(found)
        })
        .map(|found| found.into_iter().map(Option::unwrap_or_default).collect())
    }

    /// Poses strands by several workers: each call of `one` sees its own strand alone. A strand of which nothing is found is left.
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
        self.crew.for_each_task(&mut posed, LEAST, MOST, |posed, _| {
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

    /// That no strand is named twice.
    pub(super) fn check_once(&self, ids: &[StrandId], indices: &[usize]) -> Result<()> {
        let mut seen = vec![false; self.strands.len()];
        for (k, index) in indices.iter().enumerate() {
            if std::mem::replace(&mut seen[*index], true) {
                return Err(Error::invalid(format!("ids[{k}]"), format!("0x{:016x}", ids[k].bits()), "each strand once"));
            }
        }
        Ok(())
    }

    /// Changes one element of each strand: twists, bends and lengthens it; what lies beyond goes along. Twist and bending act on the present
    /// shape, the length on the natural one as well, whose element keeps curvatures or angles alike. The strands are at rest then, relative
    /// to their roots; where a length changes, what [`Solver::set_element_count`] remembers is forgotten.
    ///
    /// # Errors
    /// [`Error::InvalidId`] naming `ids[i]`; [`Error::InvalidArgument`] naming `elements[i]`, `changes[i]`, an identifier given twice, a frozen
    /// freedom that would change, or for counts that differ; also where a constraint would hold a point that is no longer there. Then nothing
    /// has changed.
    pub fn change_elements(&mut self, ids: &[StrandId], elements: &[usize], changes: &[ElementChange]) -> Result<()> {
        for (argument, count) in [("elements", elements.len()), ("changes", changes.len())] {
            if count != ids.len() {
                return Err(Error::invalid(format!("{argument} (count)"), count, format!("{}, one a strand", ids.len())));
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
                self.holding.forget();
            }
            self.put_with(index, rows, None, &mut kinematics);
        }
        Ok(())
    }
}

/// Names of a change's parts.
const FIELDS: [&str; 3] = ["twist", "bend[0]", "bend[1]"];

fn shape_of(strand: &Strand) -> StrandShape {
    StrandShape {
        root: strand.state.root,
        element_lengths: strand.model.lengths.to_vec(),
        curvatures: strand.state.curvatures.clone(),
    }
}

/// What is about a strand of which these bodies are looked at.
fn surroundings<'a>(strand: &'a Strand, bodies: &'a [BodyAt<'a>]) -> Surroundings<'a> {
    let Strand { model, contact, .. } = strand;
    let [a1, a2] = model.material.radius;
    let (radius, exempt) = contact.as_ref().map_or((a1.max(a2), 0.0), |contact| (contact.radius, contact.exempt_length));
    // In units of the softest of the stiffnesses, so that what is damped is damped alike in all strands.
    let least = model.stiffness.into_iter().fold(f64::INFINITY, f64::min);
    let charge = model.stiffness.map(|stiffness| stiffness / least);
    Surroundings { bodies, radius, exempt, natural: Some(&model.natural), freedoms: model.freedoms, charge }
}

/// Whether a strand is kept out of a body.
fn meets(contact: Option<&StrandContact>, body: &BodyAt) -> bool {
    contact.is_none_or(|contact| body.meets(contact.groups, contact.mask))
}
