//! How a command can fail, and the exit status that says so.

use std::fmt;
use std::path::Path;
use std::process::ExitCode;

use crate::shell::json::Complaint;

/// What went wrong, in words for people.
#[derive(Debug, Clone, PartialEq)]
pub enum Failure {
    /// The scene is bad: exit status 2.
    BadScene(String),
    /// Anything else: exit status 1.
    Other(String),
}

impl Failure {
    /// A scene's complaint, with its file.
    pub fn scene(path: &Path, complaint: &Complaint) -> Self {
        Failure::BadScene(format!("{}: {complaint}", path.display()))
    }

    /// A file that cannot be read or written.
    pub fn file(path: &Path, reason: impl fmt::Display) -> Self {
        Failure::Other(format!("{}: {reason}", path.display()))
    }

    /// The exit status.
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Failure::BadScene(_) => ExitCode::from(2),
            Failure::Other(_) => ExitCode::from(1),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::BadScene(text) | Failure::Other(text) => write!(f, "{text}"),
        }
    }
}

impl From<superhelix::Error> for Failure {
    fn from(error: superhelix::Error) -> Self {
        Failure::Other(error.to_string())
    }
}
