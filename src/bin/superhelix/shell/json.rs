//! JSON as people write it: comments allowed, and every complaint names the key by its full path, with the value that stands there.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error as _, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};

/// What is wrong with a document: the key's full path (empty for the document itself) and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Complaint {
    /// `strands[2].radius[0]`, or empty.
    pub key: String,
    /// The value and what was expected, or what else is wrong.
    pub reason: String,
}

impl Complaint {
    /// A complaint about a key.
    pub fn new(key: impl Into<String>, reason: impl Into<String>) -> Self {
        Self { key: key.into(), reason: reason.into() }
    }

    /// The usual one: a value that is not what was expected.
    pub fn value(key: impl Into<String>, value: impl fmt::Display, expected: impl fmt::Display) -> Self {
        Self::new(key, format!("is {value}; expected {expected}"))
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.key.is_empty() { write!(f, "{}", self.reason) } else { write!(f, "{} {}", self.key, self.reason) }
    }
}

/// Parses JSON with `//` and `/* */` comments. A key that stands twice in an object is an error.
pub fn parse(text: &str) -> Result<Value, Complaint> {
    let plain = blank_comments(text)?;
    let path = RefCell::new(String::new());
    let mut deserializer = serde_json::Deserializer::from_str(&plain);
    let value = Tree { path: &path }.deserialize(&mut deserializer).and_then(|value| deserializer.end().map(|()| value));
    value.map_err(|error| {
        let key = path.borrow().clone();
        let near = plain.lines().nth(error.line().saturating_sub(1)).unwrap_or("").trim();
        let near: String = near.chars().take(80).collect();
        // Syntax errors are reported with the place: the key is the last one that was begun, the value is in the line shown.
        Complaint::new(key, format!("cannot be read: {error}, near `{near}`"))
    })
}

/// The same text with every comment turned into spaces, so that line and column numbers stay true.
fn blank_comments(text: &str) -> Result<String, Complaint> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut plain = String::with_capacity(text.len());
    let mut characters = text.chars().peekable();
    let mut line = 1;
    while let Some(character) = characters.next() {
        match (character, characters.peek()) {
            ('"', _) => {
                plain.push('"');
                while let Some(inner) = characters.next() {
                    plain.push(inner);
                    line += usize::from(inner == '\n');
                    match inner {
                        '\\' => plain.extend(characters.next()),
                        '"' => break,
                        _ => {}
                    }
                }
            }
            ('/', Some('/')) => {
                plain.push(' ');
                while let Some(&inner) = characters.peek() {
                    if inner == '\n' {
                        break;
                    }
                    plain.push(' ');
                    characters.next();
                }
            }
            ('/', Some('*')) => {
                let begun = line;
                characters.next();
                plain.push_str("  ");
                let mut previous = ' ';
                loop {
                    let Some(inner) = characters.next() else {
                        return Err(Complaint::new("", format!("a comment begun with /* on line {begun} is never closed")));
                    };
                    line += usize::from(inner == '\n');
                    plain.push(if inner == '\n' { '\n' } else { ' ' });
                    if previous == '*' && inner == '/' {
                        break;
                    }
                    previous = inner;
                }
            }
            _ => {
                line += usize::from(character == '\n');
                plain.push(character);
            }
        }
    }
    Ok(plain)
}

/// Builds a [`Value`] and notes where it is: serde_json by itself keeps the last of two equal keys.
struct Tree<'a> {
    path: &'a RefCell<String>,
}

impl Tree<'_> {
    /// Runs `inner` with `part` on the path; after an error the path stays as it was there.
    fn within<T, E>(&self, part: &str, inner: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
        let length = self.path.borrow().len();
        self.path.borrow_mut().push_str(part);
        let value = inner()?;
        self.path.borrow_mut().truncate(length);
        Ok(value)
    }
}

impl<'de> DeserializeSeed<'de> for Tree<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Tree<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(Value::from(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(Value::from(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(Value::from(value))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(Value::from(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(Value::from(value))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        loop {
            let item = self.within(&format!("[{}]", list.len()), || items.next_element_seed(Tree { path: self.path }))?;
            match item {
                Some(item) => list.push(item),
                None => return Ok(Value::Array(list)),
            }
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some(key) = entries.next_key::<String>()? {
            let part = if self.path.borrow().is_empty() { key.clone() } else { format!(".{key}") };
            let twice = object.contains_key(&key);
            let value = self.within(&part, || {
                let value = entries.next_value_seed(Tree { path: self.path })?;
                if twice { Err(A::Error::custom(format!("the key stands twice, here with {value}"))) } else { Ok(value) }
            })?;
            object.insert(key, value);
        }
        Ok(Value::Object(object))
    }
}

/// A value and its place in the document.
#[derive(Debug, Clone)]
pub struct Node<'a> {
    /// Full path of the key.
    pub key: String,
    /// What stands there.
    pub value: &'a Value,
}

impl<'a> Node<'a> {
    /// The document itself.
    pub fn root(value: &'a Value) -> Self {
        Self { key: String::new(), value }
    }

    /// A complaint about this value.
    pub fn complain(&self, expected: impl fmt::Display) -> Complaint {
        let mut shown = self.value.to_string();
        if shown.chars().count() > 120 {
            shown = shown.chars().take(117).collect::<String>() + "...";
        }
        Complaint::value(if self.key.is_empty() { "the document" } else { &self.key }, shown, expected)
    }

    /// This object's entries; one whose key is not among `known` is an error.
    pub fn object(&self, known: &[&str]) -> Result<Entries<'a>, Complaint> {
        let Value::Object(map) = self.value else { return Err(self.complain("an object")) };
        let mut entries = BTreeMap::new();
        for (name, value) in map {
            let key = if self.key.is_empty() { name.clone() } else { format!("{}.{name}", self.key) };
            let node = Node { key, value };
            if !known.contains(&name.as_str()) {
                let complaint = node.complain("");
                let value = complaint.reason.trim_start_matches("is ").trim_end_matches("; expected ").to_string();
                let reason = format!("(value {value}) is not a known key; known here: {}", known.join(", "));
                return Err(Complaint::new(node.key, reason));
            }
            entries.insert(name.clone(), node);
        }
        Ok(Entries { key: self.key.clone(), entries })
    }

    /// This list's items.
    pub fn list(&self) -> Result<Vec<Node<'a>>, Complaint> {
        let Value::Array(items) = self.value else { return Err(self.complain("a list")) };
        Ok(items.iter().enumerate().map(|(index, value)| Node { key: format!("{}[{index}]", self.key), value }).collect())
    }

    /// A number (JSON numbers are finite).
    pub fn number(&self) -> Result<f64, Complaint> {
        match self.value.as_f64() {
            Some(number) if number.is_finite() => Ok(number),
            _ => Err(self.complain("a number")),
        }
    }

    /// A number that is zero or above.
    pub fn not_negative(&self) -> Result<f64, Complaint> {
        let value = self.number()?;
        if value >= 0.0 { Ok(value) } else { Err(self.complain("a number of 0 or more")) }
    }

    /// A number above zero.
    pub fn positive(&self) -> Result<f64, Complaint> {
        let number = self.number()?;
        if number > 0.0 { Ok(number) } else { Err(self.complain("a number above zero")) }
    }

    /// A whole number within `range`. 5.0 counts as whole: JSON makes no difference.
    pub fn whole(&self, range: std::ops::RangeInclusive<u64>) -> Result<u64, Complaint> {
        let expected = || self.complain(format!("a whole number, {} to {}", range.start(), range.end()));
        let number = self.value.as_f64().ok_or_else(expected)?;
        // Whole numbers up to 9e15 are exact in f64.
        let whole = self.value.as_u64().or((number.fract() == 0.0 && (0.0..9e15).contains(&number)).then_some(number as u64));
        whole.filter(|whole| range.contains(whole)).ok_or_else(expected)
    }

    /// true or false.
    pub fn truth(&self) -> Result<bool, Complaint> {
        self.value.as_bool().ok_or_else(|| self.complain("true or false"))
    }

    /// A list of exactly `N` numbers.
    pub fn numbers<const N: usize>(&self) -> Result<[f64; N], Complaint> {
        let items = self.list().map_err(|_| self.complain(format!("a list of {N} numbers")))?;
        if items.len() != N {
            return Err(self.complain(format!("a list of {N} numbers")));
        }
        let mut numbers = [0.0; N];
        for (number, item) in numbers.iter_mut().zip(&items) {
            *number = item.number()?;
        }
        Ok(numbers)
    }

    /// One of some names.
    pub fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T, Complaint> {
        let found = self.value.as_str().and_then(|name| choices.iter().find(|(candidate, _)| *candidate == name));
        found.map(|(_, choice)| *choice).ok_or_else(|| {
            let names: Vec<String> = choices.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            self.complain(format!("one of {}", names.join(", ")))
        })
    }
}

/// An object's entries by name.
#[derive(Debug)]
pub struct Entries<'a> {
    key: String,
    entries: BTreeMap<String, Node<'a>>,
}

impl<'a> Entries<'a> {
    /// The entry, if there.
    pub fn get(&self, name: &str) -> Option<&Node<'a>> {
        self.entries.get(name)
    }

    /// The entry, if there and not null: for keys whose null means "none".
    pub fn get_unless_null(&self, name: &str) -> Option<&Node<'a>> {
        self.entries.get(name).filter(|node| !node.value.is_null())
    }

    /// The entry, which must be there.
    pub fn require(&self, name: &str) -> Result<&Node<'a>, Complaint> {
        self.entries.get(name).ok_or_else(|| Complaint::new(self.path(name), "is missing"))
    }

    /// Reads the entry, or takes `default`.
    pub fn or<T>(&self, name: &str, default: T, read: impl FnOnce(&Node<'a>) -> Result<T, Complaint>) -> Result<T, Complaint> {
        self.get(name).map_or(Ok(default), read)
    }

    /// The full path of an entry.
    pub fn path(&self, name: &str) -> String {
        if self.key.is_empty() { name.to_string() } else { format!("{}.{name}", self.key) }
    }
}
