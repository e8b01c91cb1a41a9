//! `only` of an item: which strands of its groom, or which of its follicles, it stands for.

use std::ops::RangeInclusive;

use nalgebra::Vector3;

use crate::scene::strands::root_values::{self, Item, Sources, Values};
use crate::shell::json::{Complaint, Entries, Node};

/// Conditions that all hold for the strands of an item.
#[derive(Debug)]
pub struct Only<'a> {
    key: String,
    conditions: Vec<Condition<'a>>,
}

#[derive(Debug)]
enum Condition<'a> {
    /// Numbers in the file, or of follicles.
    Indices(Vec<RangeInclusive<usize>>),
    /// Values at the roots.
    Values { key: String, sources: Box<Sources<'a>>, values: Values, among: Among },
}

/// Numbers that are wanted.
#[derive(Debug)]
struct Among {
    one_of: Option<Vec<f64>>,
    none_of: Option<Vec<f64>>,
    at_least: Option<f64>,
    below: Option<f64>,
}

impl<'a> Only<'a> {
    /// Reads `only` of an item: a condition or a list of them.
    pub fn read(node: &Node, item: &'a Item<'a>) -> Result<Self, Complaint> {
        let nodes = if node.value.is_array() { node.list()? } else { vec![node.clone()] };
        if nodes.is_empty() {
            return Err(node.complain("a condition, or a list of conditions"));
        }
        let conditions = nodes.iter().map(|node| Condition::read(node, item));
        Ok(Self { key: node.key.clone(), conditions: conditions.collect::<Result<_, _>>()? })
    }

    /// The numbers of the strands, among `all`, that the conditions hold for: `root` says where the root of each is. `count`: how many there
    /// are in the file.
    pub fn among(
        &self,
        all: impl Iterator<Item = usize>,
        count: usize,
        root: impl Fn(usize) -> Vector3<f64>,
    ) -> Result<Vec<usize>, Complaint> {
        let last = |condition: &Condition<'_>| match condition {
            Condition::Indices(ranges) => ranges.iter().map(|range| *range.end()).max(),
            Condition::Values { .. } => None,
        };
        if let Some(index) = self.conditions.iter().filter_map(last).max().filter(|index| *index >= count) {
            let reason = format!("has {index}; expected numbers below {count}, as many as there are strands");
            return Err(Complaint::new(format!("{}.indices", self.key), reason));
        }
        let all: Vec<usize> = all.collect();
        let chosen: Vec<usize> = all.iter().copied().filter(|strand| self.holds(*strand, &root(*strand))).collect();
        if chosen.is_empty() {
            let (of, ranges) = (all.len(), self.ranges(&all, root));
            return Err(Complaint::new(&self.key, format!("selects none of {of} strands{ranges}")));
        }
        Ok(chosen)
    }

    fn holds(&self, strand: usize, root: &Vector3<f64>) -> bool {
        self.conditions.iter().all(|condition| match condition {
            Condition::Indices(ranges) => ranges.iter().any(|range| range.contains(&strand)),
            Condition::Values { sources, values, among, .. } => among.has(sources.value(values, &sources.root(root, strand))),
        })
    }

    /// In words, between which numbers the values of conditions are.
    fn ranges(&self, all: &[usize], root: impl Fn(usize) -> Vector3<f64>) -> String {
        let mut words = String::new();
        for condition in &self.conditions {
            let Condition::Values { key, sources, values, .. } = condition else { continue };
            let value = |strand: &usize| sources.value(values, &sources.root(&root(*strand), *strand));
            let numbers = all.iter().map(value).filter(|value| value.is_finite());
            let (low, high) =
                numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
            if low <= high {
                words += &format!("; values of {key} are {low} to {high}");
            }
        }
        words
    }
}

impl<'a> Condition<'a> {
    fn read(node: &Node, item: &'a Item<'a>) -> Result<Self, Complaint> {
        const TESTS: [&str; 4] = ["is", "is_not", "at_least", "below"];
        let entries = node.object(&[&["mesh", "indices"][..], &root_values::KEYS, &TESTS].concat())?;
        if let Some(indices) = entries.get("indices") {
            let others = ["mesh"].iter().chain(&root_values::KEYS).chain(&TESTS);
            if let Some(other) = others.filter_map(|key| entries.get(key)).next() {
                return Err(other.complain("no such key beside indices"));
            }
            return Ok(Self::Indices(indices.list()?.iter().map(read_indices).collect::<Result<_, _>>()?));
        }
        let sources = Box::new(Sources::read(entries.get_unless_null("mesh"), item)?);
        let values = sources.values(&entries, &entries.path("mesh"), Some([0.0, 1.0]))?;
        if TESTS.iter().all(|test| entries.get(test).is_none()) {
            return Err(node.complain("is, is_not, at_least or below, which say which values are meant"));
        }
        Ok(Self::Values { key: node.key.clone(), sources, values, among: Among::read(&entries)? })
    }
}

/// A number, or the first and the last.
fn read_indices(node: &Node) -> Result<RangeInclusive<usize>, Complaint> {
    const MOST: u64 = u32::MAX as u64;
    if !node.value.is_array() {
        let index = node.whole(0..=MOST).map_err(|_| node.complain("a number of a strand, or [first, last]"))? as usize;
        return Ok(index..=index);
    }
    match &node.list()?[..] {
        [first, last] => {
            let first = first.whole(0..=MOST)?;
            Ok(first as usize..=last.whole(first..=MOST)? as usize)
        }
        _ => Err(node.complain("a number of a strand, or [first, last]")),
    }
}

impl Among {
    fn read(entries: &Entries) -> Result<Self, Complaint> {
        let numbers = |key: &str| {
            let read = |node: &Node| match node.value.is_array() {
                true => node.list()?.iter().map(Node::number).collect::<Result<Vec<_>, _>>(),
                false => Ok(vec![node.number().map_err(|_| node.complain("a number, or a list of numbers"))?]),
            };
            entries.get(key).map(read).transpose()
        };
        let number = |key: &str| entries.get(key).map(Node::number).transpose();
        Ok(Self { one_of: numbers("is")?, none_of: numbers("is_not")?, at_least: number("at_least")?, below: number("below")? })
    }

    /// Whether a value is meant. One that is not a number is not any number, so that `is_not` alone holds for it.
    fn has(&self, value: f64) -> bool {
        self.one_of.as_ref().is_none_or(|numbers| numbers.contains(&value))
            && self.none_of.as_ref().is_none_or(|numbers| !numbers.contains(&value))
            && self.at_least.is_none_or(|least| value >= least)
            && self.below.is_none_or(|below| value < below)
    }
}
