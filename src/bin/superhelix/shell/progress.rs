//! Progress of long work on standard error: a bar on a terminal, a line now and then where there is none.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Between two lines where there is no terminal.
const BETWEEN_LINES: Duration = Duration::from_secs(10);

/// How far work has come.
pub struct Progress {
    bar: ProgressBar,
    /// Where there is no terminal, and somebody wants to know: what is counted, and when that was last said.
    lines: Option<Mutex<Lines>>,
}

/// What is said in lines.
struct Lines {
    unit: String,
    begun: Instant,
    said: Instant,
    done: u64,
    of: u64,
}

/// Progress over `length` things called `unit`; not shown when `quiet`.
pub fn bar(length: u64, unit: &str, quiet: bool) -> Progress {
    if quiet || !std::io::stderr().is_terminal() {
        let now = Instant::now();
        let lines = Lines { unit: unit.to_string(), begun: now, said: now, done: 0, of: length };
        return Progress { bar: ProgressBar::hidden(), lines: (!quiet).then(|| Mutex::new(lines)) };
    }
    let template = format!("{{wide_bar:.cyan/blue}} {{pos}}/{{len}} {unit}  {{elapsed}} gone, {{eta}} to go");
    let bar = ProgressBar::new(length);
    bar.set_style(ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar()));
    Progress { bar, lines: None }
}

impl Progress {
    /// So many more are done. From any thread.
    pub fn inc(&self, more: u64) {
        self.bar.inc(more);
        let Some(mut lines) = self.lines.as_ref().and_then(|lines| lines.lock().ok()) else { return };
        lines.done += more;
        if lines.said.elapsed() >= BETWEEN_LINES && lines.done < lines.of {
            lines.said = Instant::now();
            eprintln!("{} of {} {} after {:.0} s", lines.done, lines.of, lines.unit, lines.begun.elapsed().as_secs_f64());
        }
    }

    /// The work is over.
    pub fn finish_and_clear(&self) {
        self.bar.finish_and_clear();
    }
}
