//! `groups`: names for the groups of what touches, a bit each.

use crate::shell::json::{Complaint, Entries, Node};

/// Most groups.
const MOST: usize = 32;

/// The names of a scene's groups, in the order of their bits.
#[derive(Debug, Default)]
pub struct Groups(Vec<String>);

impl Groups {
    /// Reads the list of a scene.
    pub fn read(scene: &Entries) -> Result<Self, Complaint> {
        let Some(list) = scene.get("groups") else { return Ok(Self::default()) };
        let mut names: Vec<String> = Vec::new();
        for item in list.list()? {
            let name = item.value.as_str().filter(|name| !name.is_empty()).ok_or_else(|| item.complain("a name"))?;
            if names.iter().any(|other| other == name) {
                return Err(item.complain("each name once"));
            }
            if names.len() == MOST {
                return Err(item.complain(format!("at most {MOST} names")));
            }
            names.push(name.to_owned());
        }
        Ok(Self(names))
    }

    /// Bits as a number, by the name of a group, or by a list of names.
    pub fn bits(&self, node: &Node) -> Result<u32, Complaint> {
        if node.value.is_string() {
            return self.bit(node);
        }
        if node.value.is_array() {
            return node.list()?.iter().try_fold(0, |bits, item| Ok(bits | self.bit(item)?));
        }
        let bits = node.whole(0..=u64::from(u32::MAX));
        Ok(bits.map_err(|_| node.complain("0 to 4294967295, the name of a group, or a list of names"))? as u32)
    }

    fn bit(&self, node: &Node) -> Result<u32, Complaint> {
        let found = node.value.as_str().and_then(|name| self.0.iter().position(|other| other == name));
        found.map(|place| 1 << place).ok_or_else(|| {
            node.complain(match &self.0[..] {
                [] => "the name of a group; the scene has no \"groups\"".to_owned(),
                names => format!("the name of a group: {}", names.join(", ")),
            })
        })
    }
}
