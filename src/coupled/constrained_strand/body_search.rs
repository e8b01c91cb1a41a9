//! A strand's search for its contacts with bodies.

use std::sync::PoisonError;

use super::{ConstrainedStrand, Meets, path_of};
use crate::contact::body_at::BodyAt;
use crate::contact::contact_point::ContactPoint;
use crate::contact::narrow_phase::strand_body::{self, Span};
use crate::contact::options::StrandContact;
use crate::coupled::detection::SearchFor;

/// Contacts closer than this along a strand, m, with normals within this cosine, are one.
const ONE_PLACE: f64 = 1e-6;
const ONE_SIDE: f64 = 0.99;

/// A contact nearer to the root than this many radii is the root's: so short a piece is as stiff as what holds it, and no force moves it. A strand
/// that leaves a surface at 15 degrees overlaps with it as far.
const AT_ROOT: f64 = 4.0;

impl ConstrainedStrand {
    /// Finds the contacts with bodies that are nearer than `within` (m) at the present iterate, for `what` they are wanted. Passes over elements
    /// that have moved by no more than `unseen` (m) since the last search. Returns the cost, nanoseconds or so.
    pub fn find_bodies(&mut self, bodies: &[BodyAt], what: SearchFor, within: f64, unseen: f64) -> u64 {
        if self.meets == Meets::Nothing {
            return 0;
        }
        let mut path = path_of(self.index, &self.step, self.permitted_overlap.as_deref());
        if what == SearchFor::OverlapsInPlace {
            path.start = path.now;
        }
        let scratch = self.scratch.get_mut().unwrap_or_else(PoisonError::into_inner);
        self.bounds.update(&path);
        let StrandContact { exempt_length: exempt, radius, groups, mask, .. } = self.contact;
        let all = self.step.gone.is_infinite();
        self.unmoved.clear();
        self.unmoved.extend(self.step.gone_by_element.iter().map(|gone| !all && *gone <= unseen));
        let unmoved = &self.unmoved;
        let (mut work, mut other) = (0, None);
        for (index, mut body) in bodies.iter().enumerate().filter(|(_, body)| body.meets(groups, mask)) {
            if let Some(motion) = self.body_motions.get(index) {
                body = other.insert(body.with_motion(*motion));
            }
            let span = Span { exempt, unmoved };
            work += strand_body::contacts(&path, &self.bounds, span, radius, body, within, scratch, &mut self.found);
        }
        if self.unmoved.first() != Some(&true) {
            self.root_gap = f64::INFINITY;
        }
        let root_gap = &mut self.root_gap;
        self.found.retain(|contact| {
            let at_root = contact.point.element == 0 && contact.point.s <= AT_ROOT * radius;
            *root_gap = if at_root { root_gap.min(contact.gap) } else { *root_gap };
            !at_root
        });
        // Where two elements meet both may report one contact.
        let along = |contact: &ContactPoint| path.now.along(contact.point.element as usize, contact.point.s);
        self.found.dedup_by(|next, last| {
            next.partner == last.partner
                && (along(next) - along(last)).abs() <= ONE_PLACE
                && next.normal.dot(&last.normal) > ONE_SIDE
        });
        work
    }
}
