//! The engine's table of errors and costs is the measured one; presets and suggestions keep its promises; the engine still errs by
//! what was measured.

#[path = "../../examples/tradeoff/hair.rs"]
#[allow(dead_code)]
mod hair;
#[path = "../../examples/tradeoff/measure.rs"]
#[allow(dead_code)]
mod measure;
#[path = "../../examples/tradeoff/path.rs"]
#[allow(dead_code)]
mod path;
#[path = "../../examples/tradeoff/reference.rs"]
#[allow(dead_code)]
mod reference;
#[path = "../../examples/tradeoff/scene.rs"]
#[allow(dead_code)]
mod scene;
#[path = "../../examples/tradeoff/setting.rs"]
#[allow(dead_code)]
mod setting;
#[path = "../../examples/tradeoff/walk.rs"]
#[allow(dead_code)]
mod walk;

use std::collections::HashMap;

use hair::Hair;
use scene::Scene;
use setting::Setting;
use superhelix::Error;
use superhelix::internals::analysis::measured;
use superhelix::internals::analysis::measured::{ELEMENTS, RATES};
use superhelix::settings::{HairShape, Preset, Scenes, suggest_settings};

/// A row of the measured table by the names of its columns.
type Row = HashMap<&'static str, &'static str>;

fn csv() -> Vec<Row> {
    let text = include_str!("../../docs/figures/tradeoff.csv");
    let mut lines = text.lines();
    let names: Vec<_> = lines.next().unwrap().split(',').collect();
    lines.map(|line| names.iter().copied().zip(line.split(',')).collect()).collect()
}

fn price(row: &Row) -> (f32, f32) {
    (row["shape"].parse().unwrap(), row["us_per_second"].parse().unwrap())
}

fn is_plain_second_order(row: &Row) -> bool {
    row["integrator"] == "second_order"
        && row["preset"].is_empty()
        && row["cap"] == "50"
        && row["tolerance"].parse() == Ok(measured::TOLERANCE)
        && row["error_tolerance"] == "0e0"
        && row["freedoms"] == "all"
}

/// The plain rows of second order of a type of hair: rate, elements, scene, error.
fn product(hair: Hair) -> Vec<(u32, u32, usize, f64)> {
    let rows = csv().into_iter().filter(|row| is_plain_second_order(row) && row["hair"] == hair.name());
    let scene = |row: &Row| Scene::ALL.iter().position(|scene| scene.name() == row["scene"]).unwrap();
    rows.map(|row| (row["rate"].parse().unwrap(), row["elements"].parse().unwrap(), scene(&row), row["shape"].parse().unwrap()))
        .collect()
}

fn shape(hair: Hair) -> HairShape {
    HairShape { curvature: measured::CURVATURES[hair as usize], length: measured::LENGTHS[hair as usize] }
}

#[test]
fn the_engines_table_is_the_measured_one() {
    let csv = csv();
    let (mut plain, mut named) = (0, 0);
    for row in &csv {
        let hair = Hair::ALL.iter().position(|hair| hair.name() == row["hair"]).unwrap();
        let scene = Scene::ALL.iter().position(|scene| scene.name() == row["scene"]).unwrap();
        if let Some(preset) = Preset::ALL.iter().position(|preset| preset.name() == row["preset"]) {
            assert_eq!(measured::PRESETS[preset][hair][scene], price(row), "{row:?}");
            named += 1;
        } else if is_plain_second_order(row) {
            let rate = RATES.iter().position(|rate| rate.to_string() == row["rate"]).unwrap();
            let elements = ELEMENTS.iter().position(|elements| elements.to_string() == row["elements"]).unwrap();
            assert_eq!(measured::SECOND_ORDER[hair][scene][rate][elements], price(row), "{row:?}");
            plain += 1;
        }
    }
    assert_eq!((plain, named), (4 * 6 * RATES.len() * ELEMENTS.len(), 4 * 6 * 3));
    for hair in Hair::ALL {
        let curvature = hair.natural().iter().map(|k| k * k).sum::<f64>().sqrt();
        assert!((measured::CURVATURES[hair as usize] - curvature).abs() < 0.1);
        assert_eq!(measured::LENGTHS[hair as usize], hair.length());
    }
    assert_eq!(Scenes::NAMES, Scene::ALL.map(Scene::name));
}

#[test]
fn suggestions_keep_the_error_in_every_scene_that_was_asked_for() {
    let mut found = 0;
    for hair in Hair::ALL {
        let product = product(hair);
        for (bits, target) in [(63, 0.3), (63, 0.1), (63, 0.03), (1, 0.01), (3, 0.03), (16, 1e-3), (62, 0.05), (32, 0.02)] {
            let scenes = Scenes::from_bits("scenes", bits).unwrap();
            // A frame that every rate divides: substeps identify the rate.
            let chosen = suggest_settings(target, scenes, &shape(hair), 1.0 / 6.0);
            let keeps = |rate: u32, elements: u32| {
                let rows = product.iter().filter(|row| row.0 == rate && row.1 == elements && bits & (1 << row.2) != 0);
                rows.map(|row| row.3).fold(0.0, f64::max) <= target
            };
            match chosen {
                Ok(chosen) => {
                    found += 1;
                    assert!(keeps(6 * chosen.substeps, chosen.elements), "{hair:?} {bits} {target}: {chosen:?}");
                    assert!(chosen.error.unwrap() <= target * 1.000_001 && chosen.cost.unwrap() > 0.0);
                    // Finer settings keep it as well.
                    for (rate, elements) in RATES.into_iter().flat_map(|rate| ELEMENTS.map(|elements| (rate, elements))) {
                        if rate >= 6 * chosen.substeps && elements >= chosen.elements {
                            assert!(keeps(rate, elements), "{hair:?} {bits} {target}: {rate} {elements} beside {chosen:?}");
                        }
                    }
                    let double = suggest_settings(2.0 * target, scenes, &shape(hair), 1.0 / 6.0).unwrap();
                    assert!(double.cost <= chosen.cost, "twice the error may not be dearer");
                    // Twice the length: twice the elements. Frames that do not divide: steps no longer.
                    let long = HairShape { length: 2.0 * shape(hair).length, ..shape(hair) };
                    assert_eq!(suggest_settings(target, scenes, &long, 1.0 / 6.0).unwrap().elements, 2 * chosen.elements);
                    let odd = suggest_settings(target, scenes, &shape(hair), 1.0 / 7.0).unwrap();
                    assert!(keeps(RATES.into_iter().filter(|rate| *rate <= 7 * odd.substeps).max().unwrap(), odd.elements));
                }
                Err(Error::InvalidArgument { argument, expected, .. }) => {
                    assert_eq!(argument, "target_error");
                    assert!(!keeps(960, 50), "{hair:?} {bits} {target}: {expected}");
                    // Every offered accuracy is attainable.
                    let least: f64 = expected.split(' ').next().unwrap().parse().unwrap();
                    suggest_settings(1.01 * least, scenes, &shape(hair), 1.0 / 6.0).unwrap();
                }
                Err(other) => panic!("{other}"),
            }
        }
    }
    assert!(found >= 16, "only {found} suggestions");
    // Between two types the more curled one counts.
    let between = HairShape { curvature: 40.0, length: 0.2 };
    let wavy = suggest_settings(0.1, Scenes::WALK, &shape(Hair::Wavy), 1.0 / 30.0).unwrap();
    assert_eq!(suggest_settings(0.1, Scenes::WALK, &between, 1.0 / 30.0).unwrap(), wavy);
}

#[test]
fn presets_say_what_they_were_measured_to_be() {
    let csv = csv();
    for preset in Preset::ALL {
        for hair in Hair::ALL {
            let rows = csv.iter().filter(|row| row["preset"] == preset.name() && row["hair"] == hair.name());
            let (error, cost) =
                rows.clone().map(price).fold((0.0, 0.0), |(e, c): (f32, f32), (error, cost)| (e.max(error), c.max(cost)));
            let frame = preset.recipe().longest_step;
            let settings = preset.settings(&shape(hair), 4.0 * frame).unwrap();
            assert_eq!((settings.error, settings.substeps), (Some(f64::from(error)), 4));
            assert!((settings.cost.unwrap() / f64::from(cost) - 1.0).abs() < 1e-6);
            let walking = rows.into_iter().find(|row| row["scene"] == "walk").unwrap();
            assert_eq!(settings.elements.to_string(), walking["elements"]);
            // Half as long again a frame needs more steps, and costs the more.
            let longer = preset.settings(&shape(hair), 4.5 * frame).unwrap();
            assert_eq!(longer.substeps, 5);
            assert!((longer.cost.unwrap() / settings.cost.unwrap() - 5.0 / 4.5).abs() < 1e-6);
        }
        let tight = HairShape { curvature: 2000.0, length: 0.2 };
        let settings = preset.settings(&tight, 1.0 / 30.0).unwrap();
        assert_eq!((settings.error, settings.cost), (None, None), "not measured");
    }
}

#[test]
fn the_engine_still_errs_by_what_was_measured() {
    let walk = walk::Walk::read();
    let csv = csv();
    for (scene, hair) in
        [(Scene::CurlyBounce, Hair::Straight), (Scene::StiffBristle, Hair::Wavy), (Scene::WindGust, Hair::Straight)]
    {
        // A lighter trajectory than the price list's: it is off by less than a tenth of what is measured here.
        let (path, _) = reference::extrapolated(scene, hair, &walk, 32, 480);
        let frames = path.frames.len();
        let distance = path::Distance { tip: 0.0, tip_most: 0.0, shape: 0.0 };
        let truth = reference::Truth { path, frames, uncertainty: distance, steps: distance };
        let hair_shape = HairShape { curvature: measured::CURVATURES[hair as usize], length: scene.length(hair.length()) };
        for setting in Setting::all(&hair_shape).into_iter().filter(|setting| setting.preset == Some(Preset::Balanced)) {
            let def = reference::strand(scene, hair, &walk, setting.elements as usize, setting.freedoms);
            let now = measure::measure(scene, &walk, &setting, &def, &truth).error.expect("no blow-up").shape;
            let of = |row: &&Row| row["scene"] == scene.name() && row["hair"] == hair.name() && row["preset"] == "balanced";
            let then = f64::from(price(csv.iter().find(of).unwrap()).0);
            println!("{} {}: {now:.3e}, measured {then:.3e}", scene.name(), hair.name());
            assert!((now / then - 1.0).abs() < 0.15, "{} {}: {now:e}, measured {then:e}", scene.name(), hair.name());
        }
    }
}
