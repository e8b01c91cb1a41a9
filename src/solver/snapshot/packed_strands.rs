//! Strands as images hold them: what a strand shares with the one before it, or says twice itself, is written once.

use super::bytes::{Reader, Writer, bad, of_part};
use super::strands::FROZEN;
use crate::contact::options::StrandContact;
use crate::error::Result;
use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::rotation::PoseMove;
use crate::math::vector::Vec3;
use crate::rod::freedoms::Freedoms;
use crate::rod::material::Material;
use crate::rod::strand::StrandModel;
use crate::solver::id::StrandId;
use crate::solver::report::Energies;
use crate::solver::shaping::freezing::Frozen;
use crate::solver::strands::sections::Sections;
use crate::solver::strands::strand::{Constrained, Strand, SubstepResult};
use crate::step::state::{History, StrandState};

/// What a strand's first word says.
mod flag {
    /// Material and freedoms are those of the strand before.
    pub const SAME_SECTION: u32 = 1;
    /// What it is to contact is what the strand before is.
    pub const SAME_CONTACT: u32 = 1 << 1;
    pub const HAS_CONTACT: u32 = 1 << 2;
    /// All elements are as long as the first.
    pub const EQUAL_LENGTHS: u32 = 1 << 3;
    pub const HAS_USER_DATA: u32 = 1 << 4;
    pub const IN_CONTACT: u32 = 1 << 5;
    pub const CONVERGED: u32 = 1 << 6;
    pub const QUARANTINED: u32 = 1 << 7;
    pub const HAS_PAST: u32 = 1 << 8;
    /// The last step was as long as that of the strand before.
    pub const SAME_STEP: u32 = 1 << 9;
    pub const HAS_ROOT_MOVE: u32 = 1 << 10;
    /// The root's way takes as long, and is as far, as that of the strand before.
    pub const SAME_TIMES: u32 = 1 << 11;
    pub const HAS_AUTHORED: u32 = 1 << 12;
    pub const HAS_PERMITTED_OVERLAP: u32 = 1 << 13;
    /// Something is kept of it where a substep has not brought it through, or it stands still.
    pub const HAS_DIVERGENCE: u32 = 1 << 14;
    /// Where the root's way begins is where the root is, or where it was a step ago; where it ends likewise.
    pub const FROM_ROOT: u32 = 1 << 15;
    pub const FROM_PAST: u32 = 1 << 16;
    pub const TO_ROOT: u32 = 1 << 17;
    pub const TO_PAST: u32 = 1 << 18;
    pub const HAS_TARGET: u32 = 1 << 19;
    pub const ALL: u32 = (1 << 20) - 1;
}

/// Bits of numbers: equal only where a restored number is the same to the bit.
fn bits<const COUNT: usize>(numbers: [f64; COUNT]) -> [u64; COUNT] {
    numbers.map(f64::to_bits)
}

fn frame_bits(frame: &Frame) -> [u64; 7] {
    let ([x, y, z], [i, j, k, w]) = (frame.origin.into(), frame.rotation_xyzw());
    bits([x, y, z, i, j, k, w])
}

fn contact_bits(contact: Option<&StrandContact>) -> Option<([u64; 9], [u32; 2])> {
    contact.map(|contact| {
        let StrandContact { radius, wisp_radius, friction, hair_friction, viscous_friction, exempt_length, groups, mask } =
            *contact;
        let frictions = [friction, hair_friction, viscous_friction].map(|friction| [friction.along, friction.against]);
        let [[a, b], [c, d], [e, f]] = frictions;
        (bits([radius, wisp_radius, a, b, c, d, e, f, exempt_length]), [groups, mask])
    })
}

/// Which of two poses a pose is.
fn repeats(pose: &Frame, root: &Frame, history: Option<&Frame>, of_root: u32, of_past: u32) -> u32 {
    if frame_bits(pose) == frame_bits(root) {
        of_root
    } else if history.is_some_and(|history| frame_bits(pose) == frame_bits(history)) {
        of_past
    } else {
        0
    }
}

fn past_root(strand: &Strand) -> Option<&Frame> {
    (strand.state.history.step > 0.0).then(|| &strand.state.history.root)
}

/// The first word of a strand after another one.
fn flags_of(strand: &Strand, before: Option<&Strand>) -> u32 {
    let (model, state) = (&strand.model, &strand.state);
    let mut flags = 0;
    let mut set = |flag: u32, is: bool| flags |= if is { flag } else { 0 };
    let section = |strand: &Strand| (bits(strand.model.material.values()), strand.model.freedoms);
    let same = |is: &dyn Fn(&Strand) -> bool| before.is_some_and(is);
    set(flag::SAME_SECTION, same(&|before| section(before) == section(strand)));
    let contact = contact_bits(strand.contact.as_deref());
    set(flag::SAME_CONTACT, same(&|before| contact_bits(before.contact.as_deref()) == contact));
    set(flag::HAS_CONTACT, contact.is_some());
    set(flag::EQUAL_LENGTHS, model.lengths.iter().all(|length| length.to_bits() == model.lengths[0].to_bits()));
    set(flag::HAS_USER_DATA, strand.user_data != 0);
    set(flag::IN_CONTACT, strand.touched);
    set(flag::CONVERGED, strand.last.converged);
    set(flag::QUARANTINED, strand.last.quarantined);
    set(flag::HAS_PAST, state.history.step > 0.0);
    set(
        flag::SAME_STEP,
        state.history.step > 0.0 && same(&|before| before.state.history.step.to_bits() == state.history.step.to_bits()),
    );
    let times = |strand: &Strand| strand.root_move.as_deref().map(|(motion, elapsed)| bits([motion.duration, *elapsed]));
    set(flag::HAS_ROOT_MOVE, strand.root_move.is_some());
    set(flag::SAME_TIMES, strand.root_move.is_some() && same(&|before| times(before) == times(strand)));
    set(flag::HAS_AUTHORED, strand.authored.is_some());
    set(flag::HAS_PERMITTED_OVERLAP, strand.permitted_overlap.is_some());
    set(flag::HAS_DIVERGENCE, strand.divergence.is_some() || strand.frozen.is_some());
    set(flag::HAS_TARGET, strand.target.is_some());
    if let Some((motion, _)) = strand.root_move.as_deref() {
        flags |= repeats(&motion.from, &state.root, past_root(strand), flag::FROM_ROOT, flag::FROM_PAST);
        flags |= repeats(&motion.to, &state.root, past_root(strand), flag::TO_ROOT, flag::TO_PAST);
    }
    flags
}

impl Writer {
    /// A strand after another one; the identifier stands apart.
    pub fn packed_strand(&mut self, strand: &Strand, before: Option<&Strand>) {
        let (model, state) = (&strand.model, &strand.state);
        let flags = flags_of(strand, before);
        let has = |flag: u32| flags & flag != 0;
        self.u32(flags);
        self.u32(model.element_count() as u32);
        if has(flag::HAS_USER_DATA) {
            self.u64(strand.user_data);
        }
        let lengths = if has(flag::EQUAL_LENGTHS) { &model.lengths[..1] } else { &model.lengths };
        lengths.iter().for_each(|length| self.f64(*length));
        self.rows(&model.natural);
        if !has(flag::SAME_SECTION) {
            model.material.values().iter().for_each(|number| self.f64(*number));
            self.u32(model.freedoms.bits());
        }
        self.u32((state.rule as u32) << 16 | state.subdivision);
        self.rows(&state.curvatures);
        self.rows(&state.rates);
        self.velocities(&state.velocities);
        self.frame(&state.root);
        self.vector(state.root_velocity);
        self.vector(state.root_angular_velocity);
        self.vector(state.wrench_force.into());
        self.vector(state.wrench_torque.into());
        if has(flag::HAS_PAST) {
            if !has(flag::SAME_STEP) {
                self.f64(state.history.step);
            }
            self.rows(&state.history.curvatures);
            self.velocities(&state.history.velocities);
            self.frame(&state.history.root);
        }
        if let Some((motion, elapsed)) = strand.root_move.as_deref() {
            if !has(flag::FROM_ROOT) && !has(flag::FROM_PAST) {
                self.frame(&motion.from);
            }
            if !has(flag::TO_ROOT) && !has(flag::TO_PAST) {
                self.frame(&motion.to);
            }
            self.vector(motion.velocity);
            self.vector(motion.angular_velocity);
            if !has(flag::SAME_TIMES) {
                self.f64(motion.duration);
                self.f64(*elapsed);
            }
        }
        self.u32(strand.last.iterations);
        match strand.frozen.as_deref() {
            Some(frozen) => self.frozen(&frozen.bodies),
            None if has(flag::HAS_DIVERGENCE) => self.divergence(strand.divergence.as_deref()),
            None => {}
        }
        self.f64(strand.energies.kinetic);
        self.f64(strand.energies.elastic);
        self.f64(strand.energies.gravity);
        if has(flag::HAS_AUTHORED) {
            self.authored(strand.authored.as_deref());
        }
        if !has(flag::SAME_CONTACT) && has(flag::HAS_CONTACT) {
            self.strand_contact(strand.contact.as_deref());
        }
        if has(flag::HAS_PERMITTED_OVERLAP) {
            self.permitted_overlap(strand.permitted_overlap.as_deref());
        }
        if let Some(target) = strand.target.as_deref() {
            self.target(target);
        }
    }
}

impl Reader<'_> {
    /// A strand after another one.
    pub fn packed_strand(
        &mut self,
        id: StrandId,
        before: Option<&Strand>,
        rules: &Rules,
        sections: &mut Sections,
    ) -> Result<Strand> {
        let flags = self.u32()?;
        if flags & !flag::ALL != 0 {
            return Err(bad(format!("a strand's first word is {flags:#x}")));
        }
        let has = |flag: u32| flags & flag != 0;
        let earlier = || before.ok_or_else(|| bad("the first strand is like the one before it"));
        let count = self.u32()? as usize;
        // An element takes a natural, a present and a changing curvature and a velocity at least.
        if count == 0 || count > self.left.len() / 96 {
            return Err(bad(format!("a strand has {count} elements where {} bytes are left", self.left.len())));
        }
        let user_data = if has(flag::HAS_USER_DATA) { self.u64()? } else { 0 };
        let lengths = if has(flag::EQUAL_LENGTHS) {
            vec![self.f64()?; count]
        } else {
            (0..count).map(|_| self.f64()).collect::<Result<Vec<f64>>>()?
        };
        let natural = self.rows(count)?;
        let (material, freedoms) = if has(flag::SAME_SECTION) {
            let model = &earlier()?.model;
            (model.material, model.freedoms)
        } else {
            self.section()?
        };
        let word = self.u32()?;
        let (rule, subdivision) = ((word >> 16) as usize, word & 0xffff);
        if rule >= rules.count() {
            return Err(bad(format!("a strand's quadrature rule is {rule}")));
        }
        let points = count * rules.rule(rule).len();
        let mut state = StrandState {
            curvatures: self.rows(count)?,
            rates: self.rows(count)?,
            velocities: self.rows(points)?.into_iter().map(Vec3).collect(),
            rule,
            root: self.frame()?,
            root_velocity: self.vector()?,
            root_angular_velocity: self.vector()?,
            wrench_force: self.vector()?.into(),
            wrench_torque: self.vector()?.into(),
            subdivision,
            history: History::default(),
            air: None,
        };
        if has(flag::HAS_PAST) {
            let step = if has(flag::SAME_STEP) { earlier()?.state.history.step } else { self.f64()? };
            state.history = self.history(step, count, points)?;
        }
        let lengths_are_right = lengths.iter().all(|length| length.is_finite() && *length > 0.0);
        if !(state.is_finite() && lengths_are_right && natural.iter().flatten().all(|x| x.is_finite())) {
            return Err(bad("a strand holds a number that is not finite, or a length not above zero"));
        }
        let root_move = if has(flag::HAS_ROOT_MOVE) { Some(Box::new(self.root_motion(flags, &state, before)?)) } else { None };
        let last =
            SubstepResult { iterations: self.u32()?, converged: has(flag::CONVERGED), quarantined: has(flag::QUARANTINED) };
        let (mut divergence, mut known) = (None, None);
        if has(flag::HAS_DIVERGENCE) {
            match self.u32()? {
                FROZEN => known = Some(self.frozen()?),
                tag => divergence = self.divergence(tag, count)?,
            }
        }
        let energies = Energies { kinetic: self.f64()?, elastic: self.f64()?, gravity: self.f64()? };
        let model = StrandModel::of_section(lengths, natural, sections.of(&material, freedoms));
        let authored = if has(flag::HAS_AUTHORED) { self.authored(model.length())? } else { None };
        let contact = match (has(flag::SAME_CONTACT), has(flag::HAS_CONTACT)) {
            (true, _) => earlier()?.contact.clone(),
            (false, true) => self.strand_contact()?,
            (false, false) => None,
        };
        let permitted_overlap = if has(flag::HAS_PERMITTED_OVERLAP) { self.permitted_overlap()? } else { None };
        let target = if has(flag::HAS_TARGET) { Some(Box::new(self.target()?)) } else { None };
        let mut strand = Strand {
            model,
            state,
            id,
            user_data,
            authored,
            root_move,
            energies,
            last,
            constrained: Constrained::No,
            touched: has(flag::IN_CONTACT),
            contact,
            permitted_overlap,
            divergence,
            frozen: None,
            target,
        };
        strand.shrink();
        strand.frozen = known.map(|known| Box::new(Frozen::new(&strand, known)));
        Ok(strand)
    }

    fn section(&mut self) -> Result<(Material, Freedoms)> {
        let mut values = [0.0; 8];
        for value in &mut values {
            *value = self.f64()?;
        }
        let material = Material::of_values(values);
        material.check("material").map_err(|error| of_part("a strand", &error))?;
        let freedoms = Freedoms::from_bits("freedoms", self.u32()?).map_err(|error| of_part("a strand", &error))?;
        Ok((material, freedoms))
    }

    /// The root's way, and how many seconds of it are done.
    fn root_motion(&mut self, flags: u32, state: &StrandState, before: Option<&Strand>) -> Result<(PoseMove, f64)> {
        let mut pose = |of_root: u32, of_past: u32| match (flags & of_root != 0, flags & of_past != 0) {
            (true, false) => Ok(state.root),
            (false, true) if state.history.step > 0.0 => Ok(state.history.root),
            (false, false) => self.frame(),
            _ => Err(bad("a root's motion repeats a pose that there is not")),
        };
        let (from, to) = (pose(flag::FROM_ROOT, flag::FROM_PAST)?, pose(flag::TO_ROOT, flag::TO_PAST)?);
        let (velocity, angular_velocity) = (self.vector()?, self.vector()?);
        let (duration, elapsed) = if flags & flag::SAME_TIMES != 0 {
            let motion = before.and_then(|before| before.root_move.as_deref());
            let (motion, elapsed) = motion.ok_or_else(|| bad("a root's motion takes as long as one that there is not"))?;
            (motion.duration, *elapsed)
        } else {
            (self.f64()?, self.f64()?)
        };
        Ok((PoseMove { from, to, velocity, angular_velocity, duration }, elapsed))
    }
}
