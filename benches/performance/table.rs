//! Tables: printed line by line during measurement, and written as csv files.

use std::path::PathBuf;

/// One table.
pub struct Table {
    name: &'static str,
    header: Vec<&'static str>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with this name and these columns; prints its title.
    pub fn new(name: &'static str, title: &str, header: &[&'static str]) -> Self {
        println!("\n{title}");
        let header_cells: Vec<_> = header.iter().map(|text| (*text).to_owned()).collect();
        print(&header_cells);
        Self { name, header: header.to_vec(), rows: Vec::new() }
    }

    /// Adds and prints a row.
    pub fn row(&mut self, cells: Vec<String>) {
        assert_eq!(cells.len(), self.header.len(), "{}", self.name);
        print(&cells);
        self.rows.push(cells);
    }

    /// Writes `performance_NAME.csv` into the directory, if there is one.
    pub fn write(&self, directory: Option<&PathBuf>) {
        let Some(directory) = directory else { return };
        let quoted = |cells: Vec<&str>| {
            let cells: Vec<_> =
                cells.iter().map(|text| if text.contains(',') { format!("\"{text}\"") } else { (*text).into() }).collect();
            cells.join(",") + "\n"
        };
        let mut text = quoted(self.header.clone());
        for row in &self.rows {
            text += &quoted(row.iter().map(String::as_str).collect());
        }
        let path = directory.join(format!("performance_{}.csv", self.name));
        std::fs::write(&path, text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
}

/// A line on the terminal: the measured quantity on the left, numbers and notes on the right.
fn print(cells: &[String]) {
    let line: String =
        cells.iter().enumerate().map(|(k, text)| if k == 0 { format!("{text:56}") } else { format!("{text:>17}") }).collect();
    println!("{}", line.trim_end());
}

/// Three significant digits, without an exponent.
pub fn digits(value: f64) -> String {
    if !value.is_finite() {
        return String::new();
    }
    if value == 0.0 {
        return "0".into();
    }
    let before = value.abs().log10().floor() as i32;
    format!("{value:.*}", (2 - before).clamp(0, 12) as usize)
}
