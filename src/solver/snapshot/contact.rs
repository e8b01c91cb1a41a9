//! Contact in a snapshot, beside bodies: options, contact parameters of strands, and the warm start of the next substep.

use std::sync::Arc;

use nalgebra::Matrix3;

use super::bytes::{Reader, Writer, bad, of_part};
use crate::contact::broad_phase::hair_pairs::PairMemory;
use crate::contact::broad_phase::pieces::{Piece, Wisp};
use crate::contact::options::{ContactModel, ContactOptions, Friction, StrandContact};
use crate::contact::permitted_overlap::PermittedOverlap;
use crate::coupled::detection::{ContactMemory, NearStrands, WarmStartForce, With};
use crate::error::Result;

/// Says that contacts are with a strand, beside their number.
const STRAND: u32 = 1 << 31;

impl Writer {
    /// Contact options.
    pub fn contact_options(&mut self, options: &ContactOptions) {
        self.u32(options.model as u32);
        self.flag(options.hair);
        for value in [
            options.stiffness,
            options.damping,
            options.regularisation_depth,
            options.tolerance,
            options.residual,
            options.separation_speed,
        ] {
            self.f64(value);
        }
        self.u32(options.max_iterations);
        self.u32(options.max_sweeps);
    }

    /// Contact parameters of a strand.
    pub fn strand_contact(&mut self, contact: Option<&StrandContact>) {
        self.flag(contact.is_some());
        if let Some(contact) = contact {
            self.f64(contact.radius);
            self.f64(contact.wisp_radius);
            for friction in [contact.friction, contact.hair_friction, contact.viscous_friction] {
                self.friction(friction);
            }
            self.f64(contact.exempt_length);
            self.u32(contact.groups);
            self.u32(contact.mask);
        }
    }

    /// The permitted overlap of a strand.
    pub fn permitted_overlap(&mut self, permitted_overlap: Option<&PermittedOverlap>) {
        self.u64(permitted_overlap.map_or(0, |permitted_overlap| permitted_overlap.along.len() as u64));
        for list in permitted_overlap
            .iter()
            .flat_map(|permitted_overlap| [&permitted_overlap.along, &permitted_overlap.wisp_fractions, &permitted_overlap.sunk])
        {
            list.iter().for_each(|x| self.f64(*x));
        }
    }

    /// Friction by direction.
    pub fn friction(&mut self, friction: Friction) {
        self.f64(friction.along);
        self.f64(friction.against);
    }

    /// What the last substep left, for images: touches by what they are with.
    pub fn packed_contacts(&mut self, memory: &ContactMemory) {
        self.u64(memory.warm_start.len() as u64);
        for group in memory.warm_start.chunk_by(|a, b| (a.strand, a.with) == (b.strand, b.with)) {
            let (sort, index) = match group[0].with {
                With::Body(body) => (0, body),
                With::Strand(strand) => (STRAND, strand),
            };
            self.u32(group[0].strand);
            self.u32(index);
            self.u32(sort | group.len() as u32);
            for seen in group {
                self.f64(seen.along);
                self.vector(seen.force);
            }
        }
        self.near_strands(memory);
    }

    /// What the last substep left, for hashes.
    pub fn contacts(&mut self, memory: &ContactMemory) {
        self.u64(memory.warm_start.len() as u64);
        for seen in &memory.warm_start {
            let (sort, index) = match seen.with {
                With::Body(body) => (0, body),
                With::Strand(strand) => (1, strand),
            };
            self.u32(seen.strand);
            self.u32(sort);
            self.u32(index);
            self.f64(seen.along);
            self.vector(seen.force);
        }
        self.near_strands(memory);
    }

    fn near_strands(&mut self, memory: &ContactMemory) {
        self.flag(memory.pairs.is_some());
        if let Some(NearStrands { of, memory }) = &memory.pairs {
            self.pairs(of, memory);
        }
    }

    fn pairs(&mut self, of: &[u32], memory: &PairMemory) {
        self.f64(memory.activation);
        self.f64(memory.margin);
        self.u64(of.len() as u64);
        for (strand, wisp) in of.iter().zip(&memory.wisps) {
            self.u32(*strand);
            self.f64(wisp.radius);
            self.f64(wisp.exempt);
            self.u32(wisp.group);
            self.u32(wisp.mask);
            self.flag(wisp.meets_itself);
        }
        self.u64(memory.roots.len() as u64);
        for (origin, frame) in &memory.roots {
            self.vector(*origin);
            frame.iter().for_each(|x| self.f64(*x));
        }
        self.u64(memory.pieces.len() as u64);
        for (piece, sagitta) in memory.pieces.iter().zip(&memory.sagittas) {
            self.u32(piece.strand);
            self.u32(piece.element);
            self.f64(piece.s[0]);
            self.f64(piece.s[1]);
            self.f64(piece.along);
            self.u32(piece.node);
            self.u32(piece.chords);
            self.flag(piece.continued[0]);
            self.flag(piece.continued[1]);
            self.f64(*sagitta);
        }
        self.u64(memory.nodes.len() as u64);
        self.vectors(&memory.nodes);
        self.u64(memory.candidates.len() as u64);
        for (i, j) in &memory.candidates {
            self.u32(*i);
            self.u32(*j);
        }
    }
}

impl Reader<'_> {
    /// Contact options.
    pub fn contact_options(&mut self) -> Result<ContactOptions> {
        let model = self.u32()?;
        let options = ContactOptions {
            model: ContactModel::from_u32(model).ok_or_else(|| bad(format!("its model of contact is {model}")))?,
            hair: self.flag()?,
            stiffness: self.f64()?,
            damping: self.f64()?,
            regularisation_depth: self.f64()?,
            tolerance: self.f64()?,
            residual: self.f64()?,
            separation_speed: self.f64()?,
            max_iterations: self.u32()?,
            max_sweeps: self.u32()?,
        };
        options.check("contact").map_err(|error| of_part("its options", &error))?;
        Ok(options)
    }

    /// Contact parameters of a strand.
    pub fn strand_contact(&mut self) -> Result<Option<Box<StrandContact>>> {
        if !self.flag()? {
            return Ok(None);
        }
        let contact = StrandContact {
            radius: self.f64()?,
            wisp_radius: self.f64()?,
            friction: self.friction()?,
            hair_friction: self.friction()?,
            viscous_friction: self.friction()?,
            exempt_length: self.f64()?,
            groups: self.u32()?,
            mask: self.u32()?,
        };
        contact.check("contact").map_err(|error| of_part("a strand", &error))?;
        Ok(Some(Box::new(contact)))
    }

    /// The permitted overlap of a strand.
    pub fn permitted_overlap(&mut self) -> Result<Option<Arc<PermittedOverlap>>> {
        let count = self.count(3 * 8)?;
        if count == 0 {
            return Ok(None);
        }
        let mut list = || (0..count).map(|_| self.f64()).collect::<Result<Vec<f64>>>();
        let permitted_overlap = PermittedOverlap { along: list()?, wisp_fractions: list()?, sunk: list()? };
        permitted_overlap.check("permitted overlap").map_err(|error| of_part("a strand", &error))?;
        Ok(Some(Arc::new(permitted_overlap)))
    }

    /// Friction by direction.
    pub fn friction(&mut self) -> Result<Friction> {
        Ok(Friction { along: self.f64()?, against: self.f64()? })
    }

    /// The warm start from the last substep; checked against the scene where it is used.
    pub fn contacts(&mut self) -> Result<ContactMemory> {
        let mut memory = ContactMemory::default();
        let mut left = self.count(4 * 8)?;
        while left > 0 {
            let (strand, index, word) = (self.u32()?, self.u32()?, self.u32()?);
            let with = if word & STRAND != 0 { With::Strand(index) } else { With::Body(index) };
            let count = (word & !STRAND) as usize;
            if count == 0 || count > left {
                return Err(bad(format!("a strand has {count} contacts with one partner where {left} are left")));
            }
            for _ in 0..count {
                memory.warm_start.push(WarmStartForce { strand, with, along: self.f64()?, force: self.vector()? });
            }
            left -= count;
        }
        if self.flag()? {
            memory.pairs = Some(self.pairs()?);
        }
        Ok(memory)
    }

    fn pairs(&mut self) -> Result<NearStrands> {
        let (activation, margin) = (self.f64()?, self.f64()?);
        let mut memory = PairMemory { activation, margin, ..PairMemory::default() };
        let mut of = Vec::new();
        for _ in 0..self.count(4 + 2 * 8 + 3 * 4)? {
            of.push(self.u32()?);
            memory.wisps.push(Wisp {
                radius: self.f64()?,
                exempt: self.f64()?,
                group: self.u32()?,
                mask: self.u32()?,
                meets_itself: self.flag()?,
            });
        }
        for _ in 0..self.count(12 * 8)? {
            let origin = self.finite_vector("a root's earlier position")?;
            let mut frame = Matrix3::zeros();
            for x in frame.iter_mut() {
                *x = self.finite("a root's earlier rotation")?;
            }
            memory.roots.push((origin, frame));
        }
        for _ in 0..self.count(6 * 4 + 4 * 8)? {
            memory.pieces.push(Piece {
                strand: self.u32()?,
                element: self.u32()?,
                s: [self.f64()?, self.f64()?],
                along: self.f64()?,
                node: self.u32()?,
                chords: self.u32()?,
                continued: [self.flag()?, self.flag()?],
            });
            memory.sagittas.push(self.finite("a piece's sagitta")?);
        }
        for _ in 0..self.count(3 * 8)? {
            memory.nodes.push(self.finite_vector("the end of a chord")?);
        }
        for _ in 0..self.count(2 * 4)? {
            memory.candidates.push((self.u32()?, self.u32()?));
        }
        Ok(NearStrands { of, memory })
    }
}
