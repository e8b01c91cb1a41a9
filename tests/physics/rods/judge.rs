//! Error against the number of elements: printed as a row of `docs/theory/validation_physics.md`, checked, and recorded for the figures.

use std::collections::BTreeSet;
use std::panic::Location;
use std::path::Path;
use std::sync::Mutex;

static RECORDED: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

/// Whether the figures' numbers are asked for.
pub fn recording() -> bool {
    std::env::var("VALIDATION_CSV").is_ok()
}

/// Adds a row to a file of comma-separated values, `validation_<module of the caller>_<table>.csv`, if the environment asks for it
/// (`VALIDATION_CSV`, a folder): `make figures` does.
#[track_caller]
pub fn record(table: &str, header: &str, row: String) {
    let Ok(folder) = std::env::var("VALIDATION_CSV") else { return };
    let module = Path::new(Location::caller().file()).file_stem().unwrap().to_str().unwrap();
    let file = format!("validation_{module}_{table}.csv");
    let mut rows = RECORDED.lock().unwrap();
    rows.insert(format!("{file}\t{row}"));
    let mut text = format!("{header}\n");
    for row in rows.iter().filter_map(|row| row.strip_prefix(&format!("{file}\t"))) {
        text += row;
        text.push('\n');
    }
    std::fs::write(Path::new(&folder).join(file), text).unwrap();
}

/// Prints one line of the table and checks the error at the last count and the order over the last doubling.
#[track_caller]
pub fn judge(section: &str, name: &str, counts: &[usize], errors: &[f64], bound: f64) {
    let order = (errors[errors.len() - 2] / errors[errors.len() - 1]).log2();
    let constant = errors[errors.len() - 1] * (counts[counts.len() - 1] as f64).powi(2);
    let needed = |share: f64| (constant / share).sqrt().ceil();
    let shown: Vec<String> = errors.iter().map(|e| format!("{e:.1e}")).collect();
    println!("| {name} | {} | {order:.2} | {} | {} |", shown.join(" | "), needed(1e-2), needed(1e-3));
    for (count, error) in counts.iter().zip(errors) {
        record("elements", "section,case,elements,error", format!("{section},\"{name}\",{count},{error:.6e}"));
    }
    assert!(errors[errors.len() - 1] < bound, "{name}: {errors:?}");
    // Below 1e-7 the reference's own digits count.
    assert!((1.8..2.3).contains(&order) || errors[errors.len() - 1] < 1e-7, "{name}: order {order}, {errors:?}");
}
