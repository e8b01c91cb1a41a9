//! `superhelix bench`: the format of the card. Only values that hold on any machine are checked.

use crate::support::{errors, superhelix};
use serde_json::Value;
use superhelix::InstructionSet;

#[test]
fn the_card_has_a_row_for_every_kind() {
    let output = superhelix(&["bench", "--seconds", "1e-6", "--threads", "2", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let card: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(card["instruction_set"], InstructionSet::detected().name());
    assert_eq!(card["threads"], 2);
    let rows = card["steps"].as_array().unwrap();
    let mut kinds: Vec<_> = rows
        .iter()
        .map(|row| {
            let number = |key: &str| row[key].as_f64().unwrap_or_else(|| panic!("{key} of {row}"));
            assert!(number("iterations") >= 1.0 && number("unconverged_share") < 0.05, "{row}");
            // A strand's steps fill a frame as often as they go into it.
            let strands = 1e6 / 60.0 / number("microseconds_per_strand_and_step");
            assert!((number("strands_in_real_time") / strands - 1.0).abs() < 1e-12, "{row}");
            (row["threads"].as_u64().unwrap(), row["elements"].as_u64().unwrap(), row["precision"].as_str().unwrap().to_owned())
        })
        .collect();
    kinds.sort_unstable();
    let expected: Vec<_> = [1, 2]
        .iter()
        .flat_map(|threads| [5, 10, 20].map(|elements| (*threads, elements)))
        .flat_map(|(threads, elements)| ["f32", "f64"].map(|precision| (threads, elements, precision.to_owned())))
        .collect();
    assert_eq!(kinds, expected);
    assert_eq!(card["sampling"]["points_per_strand"], 16);
    assert!(card["sampling"]["million_points_per_second"].as_f64().unwrap() > 0.0);
}

#[test]
fn the_card_in_words_has_a_line_a_row() {
    let output = superhelix(&["bench", "--seconds", "1e-6", "--threads", "1"]);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with(&format!("superhelix {}, ", env!("CARGO_PKG_VERSION"))), "{text}");
    // Elements, precision, threads and three numbers.
    let rows = text.lines().filter(|line| {
        let cells: Vec<_> = line.split_whitespace().collect();
        cells.len() == 6
            && (cells[1] == "f64" || cells[1] == "f32")
            && cells[2] == "1"
            && cells[3..].iter().all(|cell| cell.parse::<f64>().is_ok())
    });
    assert_eq!(rows.count(), 6, "{text}");
    assert!(text.contains("million points a second"), "{text}");
}

#[test]
fn bad_flags_are_errors() {
    for arguments in [["--seconds", "0"], ["--seconds", "-1"], ["--threads", "0"], ["--threads", "257"]] {
        let output = superhelix(&["bench", arguments[0], arguments[1]]);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(errors(&output).contains(arguments[1]), "{arguments:?}: {}", errors(&output));
    }
}
