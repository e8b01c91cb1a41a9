//! What the readers of Wavefront OBJ share: curves and meshes.

/// First words of lines that say nothing about points.
pub(super) const LEFT: [&str; 5] = ["o", "g", "s", "usemtl", "mtllib"];

/// Whether a line's first word is one that is read past.
pub(super) fn is_left(word: &str) -> bool {
    LEFT.contains(&word) || word.starts_with('#')
}

/// The place of a vertex that a line names, of `known` above it: from 1 on, or from -1 backwards.
pub(super) fn vertex_index(word: &str, known: usize) -> Option<usize> {
    let index = word.parse::<i64>().ok()?;
    let index = if index < 0 { (known as i64).checked_add(index)? } else { index - 1 };
    usize::try_from(index).ok().filter(|index| *index < known)
}
