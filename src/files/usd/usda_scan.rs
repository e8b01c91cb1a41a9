//! The scanner of USD text files: numbers, names, strings, brackets, and values to skip.
//!
//! Line ends have no meaning here: a reader that does not take everything can do without them. Nothing recurses, so no nesting is
//! too deep.

use std::fmt;

use crate::error::{Error, Result};
use crate::files::io::text::{Quote, line_error};

/// The position in a file.
#[derive(Clone)]
pub(in crate::files) struct Scan<'a> {
    name: &'a str,
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Scan<'a> {
    pub fn new(name: &'a str, bytes: &'a [u8]) -> Self {
        Self { name, bytes, at: 0 }
    }

    /// The current line, from 1. Computed on demand: only errors need it.
    fn line(&self) -> usize {
        self.line_at(self.at)
    }

    /// The line of a position, from 1.
    pub fn line_at(&self, place: usize) -> usize {
        1 + self.bytes[..place.min(self.bytes.len())].iter().filter(|byte| **byte == b'\n').count()
    }

    /// An error at the current position.
    pub fn error(&self, reason: impl fmt::Display) -> Error {
        line_error(self.name, self.line(), reason)
    }

    /// The current position, in bytes.
    pub fn place(&self) -> usize {
        self.at
    }

    /// Skips blanks, semicolons and comments.
    fn skip_blanks(&mut self) {
        loop {
            match self.bytes[self.at..] {
                [b';', ..] => self.at += 1,
                [byte, ..] if byte.is_ascii_whitespace() => self.at += 1,
                [b'#', ..] | [b'/', b'/', ..] => {
                    let rest = &self.bytes[self.at..];
                    self.at += rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
                }
                [b'/', b'*', ..] => {
                    let rest = &self.bytes[self.at + 2..];
                    self.at += rest.windows(2).position(|pair| pair == b"*/").map_or(rest.len() + 2, |found| found + 4);
                }
                _ => return,
            }
        }
    }

    /// The next significant byte; `None` at the end of the file.
    pub fn peek(&mut self) -> Option<u8> {
        self.skip_blanks();
        self.bytes.get(self.at).copied()
    }

    /// Takes this byte if it is the next.
    pub fn accept(&mut self, wanted: u8) -> bool {
        let found = self.peek() == Some(wanted);
        self.at += usize::from(found);
        found
    }

    /// Takes this byte; an error if it is not the next.
    pub fn expect(&mut self, wanted: u8, what: impl fmt::Display) -> Result<()> {
        if self.accept(wanted) {
            return Ok(());
        }
        Err(self.unexpected(format_args!("{:?} {what}", char::from(wanted))))
    }

    /// The error that something unexpected is here.
    pub fn unexpected(&mut self, expected: impl fmt::Display) -> Error {
        match self.peek() {
            Some(_) => {
                let rest = &self.bytes[self.at..self.bytes.len().min(self.at + 60)];
                let line = rest.split(|byte| *byte == b'\n').next().unwrap_or_default();
                self.error(format_args!("{}; expected {expected}", Quote(&String::from_utf8_lossy(line))))
            }
            None => self.error(format_args!("the file ends; expected {expected}")),
        }
    }

    /// Everything up to a blank, bracket, comma, colon, equals sign or quote; `stops` end it too, `joins` do not.
    fn run(&mut self, joins: &[u8]) -> &'a [u8] {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let ends = |byte: &u8| !joins.contains(byte) && (byte.is_ascii_whitespace() || b"()[]{},:=;\"'@<>#".contains(byte));
        let length = rest.iter().position(ends).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// A name such as `def`, `primvars:displayColor` or `points.timeSamples`; empty if there is none here.
    pub fn word(&mut self) -> Result<&'a str> {
        let bytes = self.run(b":");
        self.text(bytes)
    }

    /// Whether brackets follow the first word of a type such as `point3f[]`.
    pub fn brackets(&mut self) -> bool {
        let found = self.bytes[self.at..].starts_with(b"[]");
        self.at += if found { 2 } else { 0 };
        found
    }

    fn text(&self, bytes: &'a [u8]) -> Result<&'a str> {
        std::str::from_utf8(bytes)
            .map_err(|error| self.error(format_args!("not text (byte {} is not UTF-8)", error.valid_up_to())))
    }

    /// A string in single, double or triple quotes, unprocessed.
    pub fn string(&mut self) -> Result<&'a str> {
        let quote = match self.peek() {
            Some(quote @ (b'"' | b'\'')) => quote,
            _ => return Err(self.unexpected("a string")),
        };
        let triple = self.bytes[self.at..].starts_with(&[quote; 3]);
        let begin = self.at + if triple { 3 } else { 1 };
        let mut at = begin;
        loop {
            match self.bytes.get(at) {
                None => return Err(self.error("this string does not end")),
                Some(b'\\') => at += 2,
                Some(byte) if *byte == quote && (!triple || self.bytes[at..].starts_with(&[quote; 3])) => break,
                Some(b'\n') if !triple => return Err(self.error("this string does not end on its line")),
                Some(_) => at += 1,
            }
        }
        let text = self.text(&self.bytes[begin..at])?;
        self.at = at + if triple { 3 } else { 1 };
        Ok(text)
    }

    /// A whole or decimal number, unparsed.
    fn digits(&mut self, what: &str) -> Result<&'a str> {
        let before = self.at;
        let bytes = self.run(b"");
        if bytes.is_empty() {
            self.at = before;
            return Err(self.unexpected(format_args!("a number ({what})")));
        }
        self.text(bytes)
    }

    /// A finite number.
    pub fn double(&mut self, what: &str) -> Result<f64> {
        let word = self.digits(what)?;
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.error(format_args!("{what} is {}; expected a finite number", Quote(word)))),
        }
    }

    /// A number rounded once to single precision, and finite there.
    pub fn single(&mut self, what: &str) -> Result<f32> {
        let word = self.digits(what)?;
        match word.parse::<f32>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.error(format_args!("{what} is {}; expected a finite number below 3.4e38", Quote(word)))),
        }
    }

    /// A count or an index.
    pub fn count(&mut self, what: &str) -> Result<u32> {
        let word = self.digits(what)?;
        // Exporters write counts as signed numbers; none is negative.
        word.parse()
            .map_err(|_| self.error(format_args!("{what} is {}; expected a whole number from 0 to 4294967295", Quote(word))))
    }

    /// Whether the value here is `None`. Takes the word if so.
    pub fn accept_none(&mut self) -> bool {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let found = rest.starts_with(b"None") && !rest.get(4).is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
        self.at += if found { 4 } else { 0 };
        found
    }

    /// Skips a value of any type: a word, a string, a path, or everything between a bracket and its partner.
    pub fn skip_value(&mut self) -> Result<()> {
        let mut open: Vec<(u8, usize)> = Vec::new();
        loop {
            let begin = self.at;
            match self.peek() {
                None => {
                    if let Some((bracket, place)) = open.last() {
                        self.at = *place;
                        return Err(self.error(format_args!("this {:?} is not closed", char::from(*bracket))));
                    }
                    return Err(self.unexpected("a value"));
                }
                Some(bracket @ (b'(' | b'[' | b'{')) => {
                    open.push((bracket, self.at));
                    self.at += 1;
                }
                Some(bracket @ (b')' | b']' | b'}')) => {
                    let partner = match bracket {
                        b')' => b'(',
                        b']' => b'[',
                        _ => b'{',
                    };
                    if open.pop().is_none_or(|(open, _)| open != partner) {
                        return Err(self.unexpected("a value"));
                    }
                    self.at += 1;
                }
                Some(b'"' | b'\'') => {
                    self.string()?;
                }
                Some(b'@') => self.skip_asset()?,
                Some(b'<') => {
                    let rest = &self.bytes[self.at..];
                    let Some(length) = rest.iter().position(|byte| *byte == b'>') else {
                        return Err(self.error("this path does not end"));
                    };
                    self.at += length + 1;
                }
                Some(b',' | b':' | b'=' | b'>') if !open.is_empty() => self.at += 1,
                Some(_) => {
                    self.run(b":");
                    if self.at == begin || self.bytes[begin..self.at].trim_ascii().is_empty() {
                        return Err(self.unexpected("a value"));
                    }
                }
            }
            if open.is_empty() {
                return Ok(());
            }
        }
    }

    /// Skips `@file@` or `@@@file@@@`.
    fn skip_asset(&mut self) -> Result<()> {
        let rest = &self.bytes[self.at..];
        let mark: &[u8] = if rest.starts_with(b"@@@") { b"@@@" } else { b"@" };
        match rest[mark.len()..].windows(mark.len()).position(|window| window == mark) {
            Some(length) => {
                self.at += length + 2 * mark.len();
                Ok(())
            }
            None => Err(self.error("this asset path does not end")),
        }
    }
}
