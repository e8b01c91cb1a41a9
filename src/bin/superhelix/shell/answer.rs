//! What a command prints: lines, and answers as JSON or in words.

use std::io::Write;

use super::failure::Failure;

/// Prints a command's answer. A reader that has gone away is no failure of ours.
pub fn print_line(text: &str) -> Result<(), Failure> {
    match writeln!(std::io::stdout(), "{text}") {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::Other(format!("standard output cannot be written: {error}")))
        }
        _ => Ok(()),
    }
}

/// Prints a command's answer as JSON, or in words.
pub fn print_answer(json: bool, answer: &impl serde::Serialize, in_words: impl FnOnce() -> String) -> Result<(), Failure> {
    if !json {
        return print_line(&in_words());
    }
    let text = serde_json::to_string_pretty(answer).map_err(|error| Failure::Other(error.to_string()))?;
    print_line(&text)
}
