//! Sections that strands share: a new strand equal to one of the last few gets the same one.

use std::sync::Arc;

use crate::rod::freedoms::Freedoms;
use crate::rod::material::Material;
use crate::rod::section::Section;

/// The number of recent sections: hosts add strands of few types, type after type or mixed; with many types (every radius
/// different) each strand has its own.
const KINDS: usize = 16;

/// The most recent sections.
#[derive(Debug, Default)]
pub(in crate::solver) struct Sections {
    recent: Vec<Arc<Section>>,
    next: usize,
}

impl Sections {
    /// The section of this material and freedoms.
    pub fn of(&mut self, material: &Material, freedoms: Freedoms) -> Arc<Section> {
        let known = self.recent.iter().find(|section| section.material == *material && section.freedoms == freedoms);
        if let Some(section) = known {
            return section.clone();
        }
        let section = Arc::new(Section::new(*material, freedoms));
        if self.recent.len() < KINDS {
            self.recent.push(section.clone());
        } else {
            self.recent[self.next] = section.clone();
            self.next = (self.next + 1) % KINDS;
        }
        section
    }

    /// Bytes on the heap: the list, and this holder's fraction of each section.
    pub fn heap_bytes(&self) -> f64 {
        let list = self.recent.capacity() * size_of::<Arc<Section>>();
        self.recent.iter().map(fraction).sum::<f64>() + list as f64
    }
}

/// A holder's fraction of a section's bytes: over all holders they sum to the whole.
pub(super) fn fraction(section: &Arc<Section>) -> f64 {
    // An Arc stores two counts before the value.
    (2 * size_of::<usize>() + size_of::<Section>()) as f64 / Arc::strong_count(section) as f64
}
