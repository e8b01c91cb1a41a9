//! `motions`: poses over time that have a name, so that roots, colliders and targets share them.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde_json::Value;
use superhelix::splines::PoseSpline;

use crate::scene::pose::read_spline;
use crate::shell::json::{Complaint, Entries, Node};

/// The motions of a scene by their names.
#[derive(Debug, Default)]
pub struct Motions(BTreeMap<String, Arc<PoseSpline>>);

impl Motions {
    /// Reads the object.
    pub fn read(node: &Node) -> Result<Self, Complaint> {
        let Some(map) = node.value.as_object() else { return Err(node.complain("an object: a motion for each name")) };
        let one = |(name, value): (&String, &Value)| {
            let motion = Node { key: format!("{}.{name}", node.key), value };
            let entries = motion.object(&["times", "frames"])?;
            Ok((name.clone(), Arc::new(read_spline(&motion, &entries)?)))
        };
        map.iter().map(one).collect::<Result<_, _>>().map(Self)
    }

    /// The motion whose name stands there.
    fn named(&self, node: &Node) -> Result<Arc<PoseSpline>, Complaint> {
        let found = node.value.as_str().and_then(|name| self.0.get(name));
        found.cloned().ok_or_else(|| {
            let names: Vec<&str> = self.0.keys().map(String::as_str).collect();
            node.complain(if names.is_empty() {
                "the name of a motion; the scene has no \"motions\"".to_owned()
            } else {
                format!("the name of a motion: {}", names.join(", "))
            })
        })
    }

    /// A motion by its name, or of its own: an object with `times` and `frames`.
    pub fn named_or_own(&self, node: &Node) -> Result<Arc<PoseSpline>, Complaint> {
        if node.value.is_string() {
            return self.named(node);
        }
        Ok(Arc::new(read_spline(node, &node.object(&["times", "frames"])?)?))
    }

    /// The motion of an object that has either the name of one (`motion`) or its own `times` and `frames`.
    pub fn of(&self, node: &Node, entries: &Entries) -> Result<Arc<PoseSpline>, Complaint> {
        let Some(name) = entries.get("motion") else { return Ok(Arc::new(read_spline(node, entries)?)) };
        match entries.get("times").or_else(|| entries.get("frames")) {
            Some(other) => Err(other.complain("no such key beside motion, which names one")),
            None => self.named(name),
        }
    }
}
