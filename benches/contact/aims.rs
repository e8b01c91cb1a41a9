//! All that was asked of the performance of contact, in one run: the body near and not touched, the walking head, the shaken head, the soak's
//! tangle, the comb at 1 kHz, and the level of detail.

use std::fmt::Write as _;

use superhelix::{ContactModel, Precision};

use crate::ball::{BALL_BY_PENALTIES, BALL_HARD, BALL_NEAR, Turned, turned};
use crate::comb::combed;
use crate::tangle::{self, tangled};
use crate::walk::Walked;
use crate::{Outcome, Shaken, quantile};

/// A row of the table.
struct Row {
    what: String,
    unit: &'static str,
    asked: &'static str,
    /// What it was when that was asked.
    when_asked: &'static str,
    /// The median.
    measured: f64,
    /// Over the step of the same strands without contact.
    over_free: Option<f64>,
    /// The worst step; of the comb, what 99.9 % of its steps take at most.
    worst: Option<f64>,
    note: String,
}

impl Row {
    fn csv(&self) -> String {
        let Self { what, unit, asked, when_asked, note, .. } = self;
        let optional = |value: Option<f64>| value.map(digits).unwrap_or_default();
        let (measured, over_free, worst) = (digits(self.measured), optional(self.over_free), optional(self.worst));
        format!("\"{what}\",\"{unit}\",\"{asked}\",\"{when_asked}\",{measured},{over_free},{worst},\"{note}\"")
    }
}

/// Three digits of a number, but no fraction of a hundred and more.
fn digits(value: f64) -> String {
    let decimals = match value {
        ..1.0 => 3,
        ..10.0 => 2,
        ..100.0 => 1,
        _ => 0,
    };
    format!("{value:.decimals$}")
}

/// A case of the walk for which something was asked.
struct Walk {
    name: &'static str,
    precision: Precision,
    /// The case of the same guides without contact.
    free: &'static str,
    asked: &'static str,
    when_asked: &'static str,
}

const WALKS: [Walk; 5] = [
    Walk { name: "free", precision: Precision::F64, free: "free", asked: "", when_asked: "22" },
    Walk { name: "hard", precision: Precision::F64, free: "free", asked: "60", when_asked: "500 (reckoned)" },
    Walk { name: "at points, 1 iteration", precision: Precision::F64, free: "free", asked: "45", when_asked: "" },
    Walk { name: "free, 1 iteration", precision: Precision::F32, free: "free, 1 iteration", asked: "", when_asked: "41" },
    Walk { name: "at points, 1 iteration", precision: Precision::F32, free: "free, 1 iteration", asked: "100", when_asked: "" },
];

/// Whether something was asked for a case of the walk.
pub fn has_walk(name: &str, precision: Precision) -> bool {
    WALKS.iter().any(|walk| walk.name == name && walk.precision == precision)
}

/// A model on the shaken head for which something was asked.
struct Shake {
    name: &'static str,
    asked: &'static str,
    when_asked: &'static str,
}

const SHAKES: [Shake; 3] = [
    Shake { name: "at points, 1 iteration", asked: "35, with Coulomb friction; 0.5 mm deep", when_asked: "75, without" },
    Shake {
        name: "coulomb",
        asked: "100; worst: twice the median; 20 of 30000 strand steps unconverged; 0.1 mm deep",
        when_asked: "219 to 231",
    },
    Shake { name: "coulomb, residual 1e-6", asked: "180; the rest as above", when_asked: "466" },
];

/// Whether something was asked for a model on the shaken head.
pub fn has_shake(name: &str) -> bool {
    SHAKES.iter().any(|shake| shake.name == name)
}

/// The ball's calm steps, the steps in which it turns, and the fraction of the strands that take part.
fn of_ball(quick: bool) -> ((usize, usize), f64) {
    if quick { ((20, 4), 0.1) } else { ((60, 60), 1.0) }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    quantile(&values, 0.5)
}

/// A scene's steps over those of the free hair that took its steps in turn with it.
fn over_free(turned: &Turned, free: &Turned) -> f64 {
    median(turned.milliseconds.iter().zip(&free.milliseconds).map(|(one, other)| one / other))
}

fn note_of(turned: &Turned) -> String {
    let Turned { contacts, iterations, unconverged, penetration, .. } = turned;
    let deepest = 1e3 * penetration;
    format!("{contacts:.0} contacts; {iterations:.2} iterations; {unconverged} strand steps unconverged; {deepest:.3} mm deep")
}

/// Hair on a ball: near and not touched, and touched.
fn near(quick: bool) -> Outcome<Vec<Row>> {
    let (steps, scale) = of_ball(quick);
    let strands = (2000.0 * scale) as usize;
    // These two by themselves: dear steps between theirs would empty the caches.
    let near = turned(strands, 10, &[None, Some(BALL_NEAR)], steps)?;
    let touched = turned(strands, 10, &[None, Some(BALL_BY_PENALTIES), Some(BALL_HARD)], steps)?;
    let of_strand = |milliseconds: f64| 1e3 * milliseconds / strands as f64;
    let row = |turned: &Turned, free: &Turned, what: &str, asked: &'static str, when_asked: &'static str| Row {
        what: format!("{strands} strands x 10 on a ball: {what}"),
        unit: "us a strand",
        asked,
        when_asked,
        measured: of_strand(median(turned.milliseconds.iter().copied())),
        over_free: Some(over_free(turned, free)),
        worst: Some(of_strand(turned.milliseconds.iter().copied().fold(0.0, f64::max))),
        note: note_of(turned),
    };
    Ok(vec![
        row(&near[0], &near[0], "free", "", "3.6"),
        row(&near[1], &near[0], "a ball near and not touched", "1.25 times free", "45.6 (12.7 times)"),
        row(&touched[1], &touched[0], "penalty, 2 iterations", "", "38"),
        row(&touched[2], &touched[0], "hard", "", "53.5"),
    ])
}

/// The walking head, of the cases that were measured.
fn walking(walked: &[Walked]) -> Vec<Row> {
    let find = |name: &str, precision: Precision| {
        walked.iter().find(|walked| walked.case.name == name && walked.case.precision == precision)
    };
    let row = |walk: &Walk| {
        let walked = find(walk.name, walk.precision)?;
        let mut note = format!("{:.2} iterations", walked.iterations);
        if let Some((model, _)) = walked.case.contact {
            write!(note, "; {:.2} % of the strands somewhere deeper than 0.5 mm", 100.0 * walked.deep[0]).ok()?;
            if model == ContactModel::Coulomb {
                write!(note, "; {} strand steps unconverged", walked.unconverged).ok()?;
            }
        }
        let of_free = find(walk.free, walk.precision);
        Some(Row {
            what: format!(
                "{} guides x {} on a walking head, {}: {}",
                walked.case.guides,
                walked.case.elements,
                format!("{:?}", walk.precision).to_lowercase(),
                walk.name
            ),
            unit: "ms",
            asked: walk.asked,
            when_asked: walk.when_asked,
            measured: walked.at(0.5),
            over_free: of_free.map(|free| walked.at(0.5) / free.at(0.5)),
            worst: Some(walked.at(1.0)),
            note,
        })
    };
    WALKS.iter().filter_map(row).collect()
}

/// The shaken head, of the models that were measured.
fn shaken(shaken: &[Shaken]) -> Vec<Row> {
    let row = |shake: &Shake| {
        let shaken = shaken.iter().find(|shaken| shaken.model == shake.name)?;
        let Shaken { unconverged, strand_steps, iterations, overlap, .. } = shaken;
        Some(Row {
            what: format!("shaken head, hair on hair: {}", shake.name),
            unit: "ms",
            asked: shake.asked,
            when_asked: shake.when_asked,
            measured: quantile(&shaken.milliseconds, 0.5),
            over_free: None,
            worst: Some(quantile(&shaken.milliseconds, 1.0)),
            note: format!(
                "{unconverged} of {strand_steps} strand steps unconverged; {:.3} mm deep; {iterations:.2} iterations",
                1e3 * overlap
            ),
        })
    };
    SHAKES.iter().filter_map(row).collect()
}

fn tangles(quick: bool) -> Outcome<Vec<Row>> {
    let row = |case: u64| -> Outcome<Row> {
        let tangled = tangled(case, if quick { 4 } else { u32::MAX })?;
        Ok(Row {
            what: format!("a tangle of the soak, {}", tangled.scene),
            unit: "s",
            asked: "worst: 2",
            when_asked: "worst: 18",
            measured: quantile(&tangled.seconds, 0.5),
            over_free: None,
            worst: Some(quantile(&tangled.seconds, 1.0)),
            note: format!(
                "up to {} contacts; {} strand steps unconverged, {} of them left within the usual work; {:.2} mm deep",
                tangled.most_contacts,
                tangled.unconverged,
                tangled.left,
                1e3 * tangled.penetration
            ),
        })
    };
    tangle::CASES.into_iter().map(row).collect()
}

fn comb(quick: bool) -> Outcome<Row> {
    let combed = combed(if quick { 1000 } else { 6000 })?;
    Ok(Row {
        what: "100 strands x 5 at 1 kHz under a comb of seven teeth, hard, one thread".into(),
        unit: "ms",
        asked: "0.25; 99.9 %: 0.5",
        when_asked: "0.76; 1.13",
        measured: quantile(&combed.milliseconds, 0.5),
        over_free: None,
        worst: Some(quantile(&combed.milliseconds, 0.999)),
        note: format!(
            "up to {} contacts; {:.2} iterations; {} strand steps unconverged; {:.3} mm deep; the comb feels up to {:.2} mN",
            combed.most_contacts,
            combed.iterations,
            combed.unconverged,
            1e3 * combed.penetration,
            1e3 * combed.force
        ),
    })
}

/// Fewer elements a strand, on the ball that hair lies on.
fn detail(quick: bool) -> Outcome<Vec<Row>> {
    let (steps, scale) = of_ball(quick);
    let when = [(16, "27.5 (free 2.8)"), (8, "17 (free 1.5)"), (4, "13.5 (free 0.86)"), (2, "12.2 (free 0.62)")];
    let mut rows = Vec::new();
    for count in [400.0, 1000.0] {
        for (elements, when_asked) in when {
            let strands = (count * scale) as usize;
            let all = turned(strands, elements, &[None, Some(BALL_HARD)], steps)?;
            let [free, hard] = [&all[0], &all[1]].map(|turned| median(turned.milliseconds.iter().copied()));
            rows.push(Row {
                what: format!("{strands} strands x {elements} on a ball: hard"),
                unit: "ms",
                asked: "in proportion to free",
                when_asked,
                measured: hard,
                over_free: Some(over_free(&all[1], &all[0])),
                worst: Some(all[1].milliseconds.iter().copied().fold(0.0, f64::max)),
                note: format!("free {} ms; {}", digits(free), note_of(&all[1])),
            });
        }
    }
    Ok(rows)
}

/// The table, `contact_aims.csv`, which is also printed. The shaken and the walking head are taken from what was measured of them in this run.
pub fn table(of_shake: &[Shaken], of_walk: &[Walked], quick: bool) -> Outcome<String> {
    let mut rows = near(quick)?;
    rows.extend(walking(of_walk));
    rows.extend(shaken(of_shake));
    rows.extend(tangles(quick)?);
    rows.push(comb(quick)?);
    rows.extend(detail(quick)?);
    let mut csv = String::from("what,unit,asked,when_asked,measured,ratio_to_free,worst,note\n");
    for row in rows {
        writeln!(csv, "{}", row.csv())?;
    }
    print!("{csv}");
    Ok(csv)
}
