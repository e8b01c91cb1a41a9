//! `name` of items of `strands`, by which other keys say which strands they mean.

use std::sync::Arc;

use crate::scene::SceneStrand;
use crate::shell::json::{Complaint, Node};

/// Reads the name of an item, if it has one.
pub fn read(item: &Node) -> Result<Option<Arc<str>>, Complaint> {
    // Whether the item has other keys than it may was looked at before.
    let Some(value) = item.value.get("name").filter(|name| !name.is_null()) else { return Ok(None) };
    let node = Node { key: format!("{}.name", item.key), value };
    let name = value.as_str().filter(|name| !name.is_empty()).ok_or_else(|| node.complain("a name"))?;
    Ok(Some(name.into()))
}

/// The strands of all items of a name.
pub fn of_name(node: &Node, strands: &[SceneStrand]) -> Result<Vec<usize>, Complaint> {
    let name = node.value.as_str().ok_or_else(|| node.complain("a name"))?;
    let found: Vec<usize> = (0..strands.len()).filter(|index| strands[*index].name.as_deref() == Some(name)).collect();
    if !found.is_empty() {
        return Ok(found);
    }
    let mut names: Vec<&str> = strands.iter().filter_map(|strand| strand.name.as_deref()).collect();
    names.dedup();
    Err(node.complain(match &names[..] {
        [] => "the name of strands; none of the scene have a \"name\"".to_owned(),
        names => format!("the name of strands: {}", names.join(", ")),
    }))
}

/// The strands of an item by its number, of a name, or of a list of these; each once, in the scene's order.
pub fn of_items(node: &Node, strands: &[SceneStrand]) -> Result<Vec<usize>, Complaint> {
    if node.value.is_array() {
        let mut all = Vec::new();
        for part in node.list()? {
            all.extend(of_items(&part, strands)?);
        }
        all.sort_unstable();
        all.dedup();
        return if all.is_empty() { Err(node.complain("at least one item")) } else { Ok(all) };
    }
    if node.value.is_string() {
        return of_name(node, strands);
    }
    let Some(last) = strands.last().map(|strand| strand.item as u64) else {
        return Err(node.complain("none: there are no strands"));
    };
    let wanted = node.whole(0..=last)? as usize;
    Ok((0..strands.len()).filter(|index| strands[*index].item == wanted).collect())
}
