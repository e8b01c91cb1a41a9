//! Line parsing of Wavefront OBJ that the readers of curves and meshes share.

/// First words of lines without meaning for points.
pub(super) const LEFT: [&str; 5] = ["o", "g", "s", "usemtl", "mtllib"];

/// Whether to skip a line with this first word.
pub(super) fn is_left(word: &str) -> bool {
    LEFT.contains(&word) || word.starts_with('#')
}

/// The index of a vertex that a line names, of `known` above it: numbers count from 1, or backwards from -1.
pub(super) fn vertex_index(word: &str, known: usize) -> Option<usize> {
    let index = word.parse::<i64>().ok()?;
    let index = if index < 0 { (known as i64).checked_add(index)? } else { index - 1 };
    usize::try_from(index).ok().filter(|index| *index < known)
}
