//! The figures of docs/notebook/haptics.md: measurements of a tool in a hand (scripts/haptics.sh).
#![allow(missing_docs)]

#[path = "../../tests/haptics/agreement.rs"]
mod agreement;
mod cost;
mod groom;
mod minute;
mod rates;
#[path = "../../tests/haptics/scene.rs"]
#[allow(dead_code)]
mod scene;
#[path = "../../tests/haptics/typed_hair.rs"]
mod typed_hair;
mod types;

const USAGE: &str = "usage: haptics cost OUT.csv | cost-once STRANDS FRAMES | minute OUT.csv HISTOGRAM.csv SECONDS RATE THREADS
       | rates OUT.csv CURVES.csv | types OUT.csv SUMMARY.csv";

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let number = |word: &str| -> f64 { word.parse().expect("a number") };
    match words[..] {
        ["cost", out] => cost::table(out),
        ["cost-once", strands, frames] => cost::once(number(strands) as usize, number(frames) as usize),
        ["minute", out, histogram, seconds, rate, threads] => {
            minute::measure(out, histogram, number(seconds), number(rate), number(threads) as usize);
        }
        ["rates", out, curves] => rates::table(out, curves),
        ["types", out, summary] => types::table(out, summary),
        _ => {
            eprintln!("{USAGE}");
            std::process::exit(2);
        }
    }
}
