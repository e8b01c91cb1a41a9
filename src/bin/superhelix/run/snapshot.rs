//! Where a run of a scene was left, so that another can go on from there: "SHXRUN\0\0", format version (u32), hash of the scene's text (u64), the written
//! state that it is of (u64), the solver's snapshot. Little-endian.

use std::io::Write;
use std::path::{Path, PathBuf};

use superhelix::Solver;

use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;

const MAGIC: &[u8; 8] = b"SHXRUN\0\0";
const VERSION: u32 = 1;
const HEAD: usize = 8 + 4 + 8 + 8;

/// Where a run was left.
#[derive(Debug)]
pub struct RunSnapshot {
    /// The written state that it is of, counted from 0.
    pub state: usize,
    path: PathBuf,
    image: Vec<u8>,
}

impl RunSnapshot {
    /// Reads one, which must be of the scene of that text.
    pub fn read(path: &Path, scene: &str) -> Result<Self, Failure> {
        let bytes = std::fs::read(path).map_err(|error| Failure::file(path, format!("cannot be read: {error}")))?;
        let number = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap_or_default());
        if bytes.len() < HEAD || &bytes[..8] != MAGIC {
            return Err(Failure::file(path, "is no snapshot of `superhelix run`"));
        }
        let version = u32::from_le_bytes(bytes[8..12].try_into().unwrap_or_default());
        if version != VERSION {
            return Err(Failure::file(path, format!("is a snapshot of version {version}; this program reads {VERSION}")));
        }
        if number(12) != hash(scene) {
            return Err(Failure::file(path, "is a snapshot of another scene, or of this one before it was changed"));
        }
        let state = usize::try_from(number(20)).map_err(|_| Failure::file(path, "is damaged"))?;
        Ok(Self { state, path: path.to_path_buf(), image: bytes[HEAD..].to_vec() })
    }

    /// Takes a solver of the same scene to where the run was left.
    pub fn restore(&self, solver: &mut Solver) -> Result<(), Failure> {
        solver.restore(&self.image).map_err(|error| Failure::file(&self.path, error))
    }
}

/// A snapshot that will be written when the run has ended.
#[derive(Debug)]
pub struct SnapshotFile {
    file: AtomicFile,
}

impl SnapshotFile {
    /// Fails at once where it could not be written.
    pub fn create(path: &Path) -> Result<Self, Failure> {
        Ok(Self { file: AtomicFile::create(path)? })
    }

    /// Writes where the run was left.
    pub fn finish(mut self, path: &Path, scene: &str, state: usize, solver: &Solver) -> Result<(), Failure> {
        let head = [&MAGIC[..], &VERSION.to_le_bytes(), &hash(scene).to_le_bytes(), &(state as u64).to_le_bytes()].concat();
        let written = self.file.write_all(&head).and_then(|()| self.file.write_all(&solver.snapshot()));
        written.map_err(|error| Failure::file(path, format!("cannot be written: {error}")))?;
        self.file.commit()
    }
}

/// FNV-1a, 64 bits.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}
