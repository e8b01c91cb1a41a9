//! Errors that the caller can act on: each names the argument and the value.

use std::fmt;

/// An error of the engine. The call that returns it changed nothing.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A required pointer was null (C ABI only).
    NullArgument {
        /// The argument's name.
        argument: String,
    },
    /// A value is out of range: NaN, negative where that makes no sense, not an enumerated value, a wrong count.
    InvalidArgument {
        /// The argument's name, with an index if it is in a list: `strands[3].length`.
        argument: String,
        /// The value as passed.
        value: String,
        /// What is valid.
        expected: String,
    },
    /// An identifier that this solver never issued, or whose strand was removed.
    InvalidId {
        /// The argument's name.
        argument: String,
        /// The identifier's bits.
        bits: u64,
    },
    /// A structure's size field is not one that this library knows (C ABI only).
    StructSize {
        /// The argument's name.
        argument: String,
        /// The size in that field.
        value: usize,
    },
    /// A caller's buffer is too short.
    BufferTooSmall {
        /// The argument's name.
        argument: String,
        /// How many items it can hold.
        capacity: usize,
        /// How many are needed.
        needed: usize,
        /// The unit of both: "items" or "bytes".
        unit: &'static str,
    },
    /// The solver is in use: it was called again from one of its own callbacks.
    Busy,
    /// A snapshot is invalid, truncated, or of another version.
    Snapshot {
        /// What is wrong with it.
        reason: String,
    },
    /// Out of memory.
    OutOfMemory {
        /// How many bytes were asked for.
        bytes: usize,
    },
    /// This build does not support the request.
    Unsupported {
        /// The argument's name.
        argument: String,
        /// The value as passed.
        value: String,
        /// What to use instead.
        hint: String,
    },
    /// A file could not be read, written or understood.
    File {
        /// The file's path.
        path: String,
        /// What is wrong with it, and where.
        reason: String,
    },
    /// The interface caught a bug of the library; the solver is poisoned.
    Panic {
        /// The panic's message.
        message: String,
    },
    /// An earlier panic left this solver in an unknown state: destroy it.
    Poisoned,
}

/// The engine's result type.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// An [`Error::InvalidArgument`] from anything that prints.
    pub fn invalid(argument: impl Into<String>, value: impl fmt::Display, expected: impl Into<String>) -> Self {
        Error::InvalidArgument { argument: argument.into(), value: value.to_string(), expected: expected.into() }
    }

    /// The same error for a field of an argument: puts `outer` before its name.
    pub fn inside(self, outer: &str) -> Self {
        match self {
            Error::InvalidArgument { argument, value, expected } => {
                Error::InvalidArgument { argument: format!("{outer}.{argument}"), value, expected }
            }
            Error::NullArgument { argument } => Error::NullArgument { argument: format!("{outer}.{argument}") },
            other => other,
        }
    }

    /// The same error with the argument's leading `old` replaced by `name`.
    pub(crate) fn renamed(self, old: &str, name: &str) -> Self {
        self.with_argument(|argument| match argument.strip_prefix(old) {
            Some(rest) => format!("{name}{rest}"),
            None => argument,
        })
    }

    /// The same error with every `old` in the argument's name replaced by `name`.
    pub(crate) fn renamed_in(self, old: &str, name: &str) -> Self {
        self.with_argument(|argument| argument.replace(old, name))
    }

    /// The same error with fields renamed: each pair is the old name and the new one.
    pub(crate) fn with_fields(self, names: &[(&str, &str)]) -> Self {
        let rename = |segment: &str| {
            let (name, index) = segment.split_at(segment.find('[').unwrap_or(segment.len()));
            let name = names.iter().find(|(old, _)| *old == name).map_or(name, |(_, new)| new);
            format!("{name}{index}")
        };
        self.with_argument(|argument| argument.split('.').map(rename).collect::<Vec<_>>().join("."))
    }

    fn with_argument(self, change: impl FnOnce(String) -> String) -> Self {
        match self {
            Error::InvalidArgument { argument, value, expected } => {
                Error::InvalidArgument { argument: change(argument), value, expected }
            }
            Error::NullArgument { argument } => Error::NullArgument { argument: change(argument) },
            Error::InvalidId { argument, bits } => Error::InvalidId { argument: change(argument), bits },
            Error::Unsupported { argument, value, hint } => Error::Unsupported { argument: change(argument), value, hint },
            other => other,
        }
    }

    /// An [`Error::File`] for a path.
    pub fn file(path: impl AsRef<std::path::Path>, reason: impl fmt::Display) -> Self {
        Error::File { path: path.as_ref().display().to_string(), reason: reason.to_string() }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::NullArgument { argument } => write!(f, "{argument} is null"),
            Error::InvalidArgument { argument, value, expected } => {
                write!(f, "{argument} is {value}; expected {expected}")
            }
            Error::InvalidId { argument, bits } => {
                write!(
                    f,
                    "{argument} is 0x{bits:016x}, which names nothing in this solver (it was removed, or belongs to another solver)"
                )
            }
            Error::StructSize { argument, value } => {
                write!(f, "{argument}.struct_size is {value}; fill the structure with its _init function")
            }
            Error::BufferTooSmall { argument, capacity, needed, unit } => {
                write!(f, "{argument} holds {capacity} {unit}; {needed} are needed")
            }
            Error::Busy => write!(f, "the solver is in use: it was called again from one of its own callbacks"),
            Error::Snapshot { reason } => write!(f, "snapshot: {reason}"),
            Error::OutOfMemory { bytes } => write!(f, "could not allocate {bytes} bytes"),
            Error::Unsupported { argument, value, hint } => write!(f, "{argument} is {value}, which is not supported: {hint}"),
            Error::File { path, reason } => write!(f, "{path}: {reason}"),
            Error::Panic { message } => write!(f, "internal error: {message}; the solver is poisoned"),
            Error::Poisoned => write!(f, "an earlier internal error poisoned this solver: destroy it"),
        }
    }
}

impl std::error::Error for Error {}

/// Checks that a number is finite; the error names the argument.
pub(crate) fn check_finite(argument: impl FnOnce() -> String, value: f64) -> Result<()> {
    if value.is_finite() { Ok(()) } else { Err(Error::invalid(argument(), value, "a finite number")) }
}

/// Checks that a number is finite and above zero.
pub(crate) fn check_positive(argument: impl FnOnce() -> String, value: f64) -> Result<()> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(Error::invalid(argument(), value, "a finite number above zero")) }
}

/// Checks that a number is finite and not negative.
pub(crate) fn check_not_negative(argument: impl FnOnce() -> String, value: f64) -> Result<()> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(Error::invalid(argument(), value, "a finite number, zero or above"))
    }
}
