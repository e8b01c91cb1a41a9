//! What is absent from a scene costs nothing: strands with fewer freedoms, without drag, without friction. Beside the time stands
//! the number of arithmetic operations, which other programs cannot disturb.

use superhelix::{Freedoms, Precision};

use crate::counted;
use crate::crowd::{Crowd, Setting};
use crate::marginal::Marginal;
use crate::scene::Hair;
use crate::statistics::Summary;
use crate::table::{Table, digits};

/// Elements per strand.
const COUNT: usize = 10;

/// The operations of an iteration by part.
pub fn parts() -> Table {
    let mut table = Table::new(
        "parts",
        "Operations an element of an iteration's parts, N = 10",
        &["part", "f64", "f32", "f64, two freedoms"],
    );
    let two = Hair { freedoms: Freedoms::BEND1.union(Freedoms::BEND2), ..Hair::of(COUNT) };
    let settings = [Setting::new(COUNT), Setting::new(COUNT).precision(Precision::F32), Setting::new(COUNT).hair(two)];
    let parts = settings.each_ref().map(counted::parts);
    for k in 0..parts[0].len() {
        let mut cells = vec![parts[0][k].0.to_owned()];
        cells.extend(parts.iter().map(|parts| format!("{:.0}", parts[k].1)));
        table.row(cells);
    }
    let mut cells = vec!["an iteration, all".to_owned()];
    cells.extend(settings.iter().map(|setting| format!("{:.0}", counted::iteration(setting))));
    table.row(cells);
    table
}

/// Measures.
pub fn measure(rounds: usize) -> Table {
    let header = [
        "without",
        "precision",
        "operations_step",
        "operations_iter",
        "us_element_step",
        "us_element_iter",
        "step_ratio",
        "iter_ratio",
        "spread",
    ];
    let mut table =
        Table::new("absent", "Freedoms and terms left out: calm scene, second order, N = 10; ratios to the first row", &header);
    let all = Hair::of(COUNT);
    let kinds = [
        ("nothing", all),
        ("twist", Hair { freedoms: Freedoms::BEND1.union(Freedoms::BEND2), ..all }),
        ("twist and bend2", Hair { freedoms: Freedoms::BEND1, ..all }),
        ("drag", Hair { air_drag: 0.0, ..all }),
        ("friction", Hair { internal_friction: 0.0, ..all }),
        ("drag and friction", Hair { air_drag: 0.0, internal_friction: 0.0, ..all }),
    ];
    for precision in [Precision::F64, Precision::F32] {
        // Two iterations, so that all do the same work per step.
        let settings = kinds.map(|(_, hair)| Setting::new(COUNT).hair(hair).precision(precision));
        let mut contests = settings
            .clone()
            .map(|setting| (Crowd::warm(&setting.clone().iterations(2), 12), Marginal::new(&setting, 2), Vec::new()));
        for _ in 0..rounds {
            for (crowd, marginal, steps) in &mut contests {
                steps.push(crowd.take(2).seconds / crowd.elements() as f64);
                marginal.take();
            }
        }
        for (k, (name, _)) in kinds.iter().enumerate() {
            let (_, marginal, steps) = &contests[k];
            // Ratios within a round.
            let ratio =
                |mine: &[f64], first: &[f64]| Summary::of(&mine.iter().zip(first).map(|(a, b)| a / b).collect::<Vec<_>>());
            let (step, iteration) = (ratio(steps, &contests[0].2), ratio(&marginal.samples, &contests[0].1.samples));
            let (operations, _) = counted::step(&settings[k].clone().iterations(2));
            table.row(vec![
                (*name).to_owned(),
                format!("{precision:?}").to_lowercase(),
                format!("{:.0}", operations / COUNT as f64),
                format!("{:.0}", counted::iteration(&settings[k])),
                digits(1e6 * Summary::of(steps).median),
                digits(1e6 * Summary::of(&marginal.samples).median),
                format!("{:.3}", step.median),
                format!("{:.3}", iteration.median),
                format!("{:.3}", step.spread),
            ]);
        }
    }
    table
}
