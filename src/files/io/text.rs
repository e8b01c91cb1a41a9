//! Lines and words of text files, with line numbers for errors.

use std::fmt;

use crate::error::{Error, Result};

/// Reads a text file line by line or word by word.
#[derive(Clone)]
pub(in crate::files) struct Text<'a> {
    name: &'a str,
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl<'a> Text<'a> {
    pub fn new(name: &'a str, bytes: &'a [u8]) -> Self {
        Self { name, bytes, at: 0, line: 1 }
    }

    /// Unread bytes.
    pub fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The next line and its number (from 1), without its end (`\n` or `\r\n`); `None` at the end of the file.
    pub fn next_line(&mut self) -> Result<Option<(usize, &'a str)>> {
        let rest = &self.bytes[self.at..];
        if rest.is_empty() {
            return Ok(None);
        }
        let length = rest.iter().position(|byte| *byte == b'\n');
        let line = &rest[..length.unwrap_or(rest.len())];
        let number = self.line;
        self.at += length.map_or(rest.len(), |length| length + 1);
        self.line += 1;
        Ok(Some((number, self.utf8(number, line.strip_suffix(b"\r").unwrap_or(line))?)))
    }

    /// The next line that is not blank.
    pub fn next_full_line(&mut self) -> Result<Option<(usize, &'a str)>> {
        while let Some((number, line)) = self.next_line()? {
            if !line.trim().is_empty() {
                return Ok(Some((number, line)));
            }
        }
        Ok(None)
    }

    /// The next word (delimited by whitespace) and its line; `None` at the end of the file.
    pub fn next_word(&mut self) -> Result<Option<(usize, &'a str)>> {
        while let Some(byte) = self.bytes.get(self.at)
            && byte.is_ascii_whitespace()
        {
            self.line += usize::from(*byte == b'\n');
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        if rest.is_empty() {
            return Ok(None);
        }
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += length;
        Ok(Some((self.line, self.utf8(self.line, &rest[..length])?)))
    }

    /// The next word, or the error that the file ends where `expected` should be.
    pub fn word(&mut self, expected: &str) -> Result<(usize, &'a str)> {
        match self.next_word()? {
            Some(word) => Ok(word),
            None => Err(self.error(self.line, format_args!("the file ends; expected {expected}"))),
        }
    }

    /// The current line.
    pub fn line(&self) -> usize {
        self.line
    }

    /// An error about a line.
    pub fn error(&self, line: usize, reason: impl fmt::Display) -> Error {
        line_error(self.name, line, reason)
    }

    fn utf8(&self, line: usize, bytes: &'a [u8]) -> Result<&'a str> {
        std::str::from_utf8(bytes).map_err(|error| {
            self.error(line, format_args!("not text (byte {} of the line or word is not UTF-8)", error.valid_up_to()))
        })
    }
}

/// An error about a line of a file.
pub(in crate::files) fn line_error(name: &str, line: usize, reason: impl fmt::Display) -> Error {
    Error::file(name, format_args!("line {line}: {reason}"))
}

/// A piece of a file as an error quotes it: in quotes, and of readable length.
pub(in crate::files) struct Quote<'a>(pub &'a str);

impl fmt::Display for Quote<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.char_indices().nth(40) {
            Some((end, _)) => write!(f, "{:?}...", &self.0[..end]),
            None => write!(f, "{:?}", self.0),
        }
    }
}

/// A finite number from a word, or an error that says what it should be.
pub(in crate::files) fn number(text: &Text<'_>, line: usize, what: &str, word: &str) -> Result<f64> {
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(text.error(line, format_args!("{what} is {}; expected a finite number", Quote(word)))),
    }
}

/// Like [`number`], rounded once to single precision, and finite there.
pub(in crate::files) fn single(text: &Text<'_>, line: usize, what: &str, word: &str) -> Result<f32> {
    match word.parse::<f32>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(text.error(line, format_args!("{what} is {}; expected a finite number below 3.4e38", Quote(word)))),
    }
}

/// A count or index from a word, or an error that says what it should be.
pub(in crate::files) fn count(text: &Text<'_>, line: usize, what: &str, word: &str) -> Result<u32> {
    word.parse()
        .map_err(|_| text.error(line, format_args!("{what} is {}; expected a whole number from 0 to 4294967295", Quote(word))))
}
