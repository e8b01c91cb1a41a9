//! Writes src/analysis/measured.rs from tradeoff.csv.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;

use superhelix::settings::Preset;

use crate::hair::Hair;
use crate::scene::Scene;
use crate::setting::{ELEMENTS, RATES, TOLERANCE};

/// The subject of a row, and its error and cost as written in the csv.
type Prices = HashMap<(String, String, String), (String, String)>;

/// Rows of second order without caps or frozen freedoms, by "rate elements", and the presets, by name.
fn prices(directory: &Path) -> Prices {
    let path = directory.join("tradeoff.csv");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let mut prices = Prices::new();
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        let field = |name: &str| fields[names.iter().position(|known| *known == name).expect("a column")];
        let plain = field("integrator") == "second_order"
            && field("cap") == "50"
            && field("tolerance") == format!("{TOLERANCE:e}")
            && field("error_tolerance") == "0e0"
            && field("freedoms") == "all";
        let key = match field("preset") {
            "" if plain => format!("{} {}", field("rate"), field("elements")),
            "" => continue,
            preset => preset.to_string(),
        };
        let what = (field("hair").to_string(), field("scene").to_string(), key);
        prices.insert(what, (field("shape").to_string(), field("us_per_second").to_string()));
    }
    prices
}

/// Writes the table.
pub fn write(directory: &Path) {
    let prices = prices(directory);
    let price = |hair: Hair, scene: Scene, key: &str| {
        let what = (hair.name().to_string(), scene.name().to_string(), key.to_string());
        let (error, cost) = prices.get(&what).unwrap_or_else(|| panic!("no row for {what:?}"));
        format!("({error}, {cost})")
    };
    let lengths = Hair::ALL.map(|hair| hair.length().to_string()).join(", ");
    let curvatures =
        Hair::ALL.map(|hair| hair.natural().iter().map(|k| k * k).sum::<f64>().sqrt()).map(|k| format!("{k:.1}")).join(", ");
    let mut text = format!(
        "//! Errors and costs as `make tradeoff` measured them; made by it from docs/figures/tradeoff.csv. Types of hair: straight, wavy, curly,
//! fuzzy, those of Bertails et al. 2006, appendix B. Scenes: the bits of [`Scenes`](super::suggestion::Scenes). `docs/notebook/tradeoff.md` says how.

/// Root mean square distance of a strand's points from where they should be, in units of its length; and processor time a strand and
/// simulated second, µs.
pub type Price = (f32, f32);

/// Natural curvatures of the types, rad/m.
pub const CURVATURES: [f64; 4] = [{curvatures}];
/// Their lengths, m, where they are not cut short.
pub const LENGTHS: [f64; 4] = [{lengths}];
/// Steps a second.
pub const RATES: [u32; {}] = {RATES:?};
/// Elements a strand.
pub const ELEMENTS: [u32; {}] = {ELEMENTS:?};
/// Newton's tolerance, rad.
pub const TOLERANCE: f64 = {TOLERANCE:e};
",
        RATES.len(),
        ELEMENTS.len()
    );
    write!(
        text,
        "
/// Second order: by type, scene, steps a second and elements.
#[rustfmt::skip]
pub static SECOND_ORDER: [[[[Price; {}]; {}]; 6]; 4] = [
",
        ELEMENTS.len(),
        RATES.len()
    )
    .expect("a string");
    for hair in Hair::ALL {
        writeln!(text, "    [ // {}", hair.name()).expect("a string");
        for scene in Scene::ALL {
            writeln!(text, "        [ // {}", scene.name()).expect("a string");
            for rate in RATES {
                let row = ELEMENTS.map(|elements| price(hair, scene, &format!("{rate} {elements}"))).join(", ");
                writeln!(text, "            [{row}],").expect("a string");
            }
            text += "        ],\n";
        }
        text += "    ],\n";
    }
    text += "];

/// The presets: by preset, type and scene.
#[rustfmt::skip]
pub static PRESETS: [[[Price; 6]; 4]; 3] = [
";
    for preset in Preset::ALL {
        writeln!(text, "    [ // {}", preset.name()).expect("a string");
        for hair in Hair::ALL {
            let row = Scene::ALL.map(|scene| price(hair, scene, preset.name())).join(", ");
            writeln!(text, "        [{row}],").expect("a string");
        }
        text += "    ],\n";
    }
    text += "];\n";
    crate::write(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src/analysis")), "measured.rs", &text);
}
