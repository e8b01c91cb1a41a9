//! Frames in numbered files: which files of a directory they are, and in which order.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::failure::Failure;

/// The frames: those of a directory in the order of their numbers, or the files as given.
pub fn list_frames(inputs: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    match inputs {
        [directory] if directory.is_dir() => list_directory(directory),
        files => {
            if let Some(directory) = files.iter().find(|file| file.is_dir()) {
                return Err(Failure::file(directory, "is a directory: give one directory, or files"));
            }
            Ok(files.to_vec())
        }
    }
}

fn list_directory(directory: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut sequences: BTreeMap<(String, String), Vec<(u64, PathBuf)>> = BTreeMap::new();
    let entries = fs::read_dir(directory).map_err(|error| Failure::file(directory, format!("cannot be read: {error}")))?;
    for entry in entries {
        let path = entry.map_err(|error| Failure::file(directory, format!("cannot be read: {error}")))?.path();
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default();
        if !matches!(extension.as_str(), "obj" | "hair") {
            continue;
        }
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let name = stem.trim_end_matches(|character: char| character.is_ascii_digit()).to_string();
        if let Some(number) = frame_number(&path) {
            sequences.entry((name, extension)).or_default().push((number, path));
        }
    }
    let names: Vec<String> = sequences.keys().map(|(name, extension)| format!("{name}*.{extension}")).collect();
    let mut sequences = sequences.into_values();
    match (sequences.next(), sequences.next()) {
        (Some(mut frames), None) => {
            frames.sort();
            Ok(frames.into_iter().map(|(_, path)| path).collect())
        }
        (None, _) => Err(Failure::file(directory, "holds no numbered .obj or .hair frames")),
        _ => Err(Failure::file(directory, format!("holds several sequences ({}): give the files of one", names.join(", ")))),
    }
}

/// The number at the end of a file's name, before its extension.
pub fn frame_number(path: &Path) -> Option<u64> {
    let stem = path.file_stem()?.to_str()?;
    stem[stem.trim_end_matches(|character: char| character.is_ascii_digit()).len()..].parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_numbers_are_read_from_the_end_of_the_name() {
        assert_eq!(frame_number(Path::new("a2/hair.0012.obj")), Some(12));
        assert_eq!(frame_number(Path::new("hair_7.hair")), Some(7));
        assert_eq!(frame_number(Path::new("hair.obj")), None);
    }
}
