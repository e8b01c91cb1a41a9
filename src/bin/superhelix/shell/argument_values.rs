//! Values of flags, read for clap.

use std::path::PathBuf;

use nalgebra::Vector3;
use superhelix::settings::Preset;

/// A finite number.
fn finite(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| "expected a finite number".to_string())
}

/// A number above zero.
pub fn positive(text: &str) -> Result<f64, String> {
    finite(text).ok().filter(|value| *value > 0.0).ok_or_else(|| "expected a finite number above zero".to_string())
}

/// Three numbers with commas between.
pub fn triple(text: &str) -> Result<Vector3<f64>, String> {
    let numbers: Result<Vec<f64>, String> = text.split(',').map(|number| finite(number.trim())).collect();
    match numbers.as_deref() {
        Ok([x, y, z]) => Ok(Vector3::new(*x, *y, *z)),
        _ => Err("expected three finite numbers with commas between".to_string()),
    }
}

/// A number, zero or above.
pub fn not_negative(text: &str) -> Result<f64, String> {
    finite(text).ok().filter(|value| *value >= 0.0).ok_or_else(|| "expected a finite number, zero or above".to_string())
}

/// A path that a picture is written to: what is written is PNG, whatever the name says.
pub fn png(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("png"));
    if is_png { Ok(path) } else { Err("expected a name that ends in .png".to_string()) }
}

/// A path that an animated PNG is written to.
pub fn animation_name(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let fits = |end: &std::ffi::OsStr| end.eq_ignore_ascii_case("png") || end.eq_ignore_ascii_case("apng");
    if path.extension().is_some_and(fits) { Ok(path) } else { Err("expected a name that ends in .png or .apng".to_string()) }
}

/// One of some names.
pub fn named<T: Copy>(text: &str, choices: &[(&str, T)]) -> Result<T, String> {
    let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
    let found = choices.iter().find(|(name, _)| *name == text).map(|(_, choice)| *choice);
    found.ok_or_else(|| format!("expected one of {}", names.join(", ")))
}

/// A share, 0 to 1.
pub fn share(text: &str) -> Result<f64, String> {
    finite(text).ok().filter(|value| (0.0..=1.0).contains(value)).ok_or_else(|| "expected a number from 0 to 1".to_string())
}

/// A preset by its name, for clap.
pub fn preset(text: &str) -> Result<Preset, String> {
    let names = Preset::ALL.map(Preset::name);
    Preset::ALL.into_iter().find(|preset| preset.name() == text).ok_or_else(|| format!("expected one of {}", names.join(", ")))
}
