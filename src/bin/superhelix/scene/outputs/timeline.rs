//! When states are written and which steps lead there.

use superhelix::reading::SHORTEST_STEP;

/// More steps than this in one run are taken for a mistake.
pub const MAX_STEPS: f64 = 1e9;

/// More written states than this in one run are taken for a mistake.
pub const MAX_OUTPUTS: f64 = 1e7;

/// A remainder below this fraction of a step (or of an interval) is rounding, not time.
const ROUNDING: f64 = 1e-9;

/// The times at which states are written: 0, every `interval`, and `duration`, each exactly.
pub fn output_times(duration: f64, interval: f64) -> Vec<f64> {
    let whole = (duration / interval + ROUNDING).floor() as u64;
    let mut times: Vec<f64> = (0..=whole).map(|index| index as f64 * interval).collect();
    let last = whole as f64 * interval;
    if duration - last > (ROUNDING * interval).max(SHORTEST_STEP) {
        times.push(duration);
    } else if whole > 0 {
        times[whole as usize] = duration;
    }
    times
}

/// The steps from one written time to the next: as many whole ones as fit, then a shorter one for what is left. A rest too short
/// for the engine lengthens the last whole step. Each is (end of the step, length of the step).
pub fn steps_between(from: f64, to: f64, time_step: f64) -> impl Iterator<Item = (f64, f64)> {
    let whole = ((to - from) / time_step + ROUNDING).floor() as u64;
    let rest = to - (from + whole as f64 * time_step);
    let shorter = whole == 0 || rest > (ROUNDING * time_step).max(SHORTEST_STEP);
    let count = whole + u64::from(shorter);
    let last_length = match (shorter, rest > ROUNDING * time_step) {
        (true, _) => rest,
        (false, true) => time_step + rest,
        (false, false) => time_step,
    };
    (1..=count).map(move |index| if index == count { (to, last_length) } else { (from + index as f64 * time_step, time_step) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listed(from: f64, to: f64, time_step: f64) -> Vec<(f64, f64)> {
        steps_between(from, to, time_step).collect()
    }

    #[test]
    fn a_step_that_divides_gives_equal_steps() {
        assert_eq!(output_times(0.5, 0.25), [0.0, 0.25, 0.5]);
        assert_eq!(listed(0.25, 0.5, 0.125), [(0.375, 0.125), (0.5, 0.125)]);
        // 0.1 is not a binary fraction: ten of them are still one second, without an eleventh step of 1e-17 s.
        assert_eq!(listed(0.0, 1.0, 0.1).len(), 10);
        assert_eq!(output_times(1.0, 0.1).len(), 11);
        assert_eq!(*output_times(1.0, 0.1).last().unwrap(), 1.0);
    }

    #[test]
    fn a_step_that_does_not_divide_ends_with_a_shorter_one() {
        let steps = listed(0.0, 0.25, 0.1);
        assert_eq!(steps.len(), 3);
        assert_eq!(steps[2].0, 0.25);
        assert!((steps[2].1 - 0.05).abs() < 1e-15);
        assert_eq!(output_times(1.0, 0.4), [0.0, 0.4, 0.8, 1.0]);
        assert_eq!(listed(0.0, 0.01, 0.1), [(0.01, 0.01)]);
    }

    #[test]
    fn every_interval_is_covered_exactly() {
        for (duration, interval, step) in
            [(1.0, 0.016666, 0.016666), (0.7, 0.3, 0.011), (1e-3, 5.0, 1e-4), (3.0, 1.0 / 30.0, 1.0 / 240.0)]
        {
            let times = output_times(duration, interval);
            assert_eq!(*times.last().unwrap(), duration);
            for pair in times.windows(2) {
                let steps = listed(pair[0], pair[1], step);
                let sum: f64 = steps.iter().map(|(_, length)| length).sum();
                assert!((sum - (pair[1] - pair[0])).abs() < 2e-9 * step, "{duration} {interval} {step}");
                assert_eq!(steps.last().unwrap().0, pair[1]);
                assert!(steps.iter().all(|(_, length)| *length > 0.0 && *length <= step));
            }
        }
    }

    #[test]
    fn no_step_is_shorter_than_the_engine_takes() {
        assert_eq!(output_times(0.1 + 5e-10, 0.1), [0.0, 0.1 + 5e-10]);
        let steps = listed(0.0, 1.5e-9, 1e-9);
        assert_eq!(steps.len(), 1);
        assert!((steps[0].1 - 1.5e-9).abs() < 1e-20);
        assert_eq!(listed(0.0, 0.2 + 5e-10, 0.1).len(), 2);
    }

    #[test]
    fn no_time_at_all_is_one_state() {
        assert_eq!(output_times(0.0, 0.1), [0.0]);
    }
}
