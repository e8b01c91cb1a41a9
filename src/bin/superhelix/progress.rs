//! A progress bar for long work: on standard error, and only when that is a terminal.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over `length` things called `unit`. Hidden when `quiet` or when nobody watches.
pub fn bar(length: u64, unit: &str, quiet: bool) -> ProgressBar {
    if quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let template = format!("{{wide_bar:.cyan/blue}} {{pos}}/{{len}} {unit}  {{elapsed}} gone, {{eta}} to go");
    let bar = ProgressBar::new(length);
    bar.set_style(ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}
