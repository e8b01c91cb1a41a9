//! A `.usda` file and the times of its samples: shared by the readers of curves and of meshes over time.

use super::usda;
use super::usda_layer::{Layer, Wanted};
use crate::error::{Error, Result, check_finite};

/// A layer with its times.
#[derive(Debug)]
pub(in crate::files) struct SampledLayer {
    /// Replaces the path in errors.
    pub name: String,
    pub layer: Layer,
    /// Time codes of the samples, ascending; at least one.
    pub codes: Vec<f64>,
    /// The same in seconds.
    pub times: Vec<f64>,
}

impl SampledLayer {
    /// Reads a file's bytes; `codes_of` returns the time codes of the layer's samples, none for static data.
    pub fn read(name: &str, bytes: &[u8], wanted: Wanted, codes_of: impl FnOnce(&Layer) -> Vec<f64>) -> Result<Self> {
        if let Some(what) = usda::other_scene_format(bytes) {
            return Err(Error::file(name, what));
        }
        let layer = Layer::read(name, bytes, wanted)?;
        let mut codes = codes_of(&layer);
        if codes.is_empty() {
            codes.push(0.0);
        }
        let times: Vec<f64> = codes.iter().map(|code| code / layer.time_codes_per_second).collect();
        if let Some((_, code)) = times.iter().zip(&codes).find(|(time, _)| !time.is_finite()) {
            return Err(Error::file(name, format_args!("time code {code} is not a time")));
        }
        Ok(Self { name: name.to_owned(), layer, codes, times })
    }

    /// The time code of a time, s. A sample's own time gives exactly that sample, whatever the division rounded it to.
    pub fn code_at(&self, time: f64) -> Result<f64> {
        check_finite(|| "time".to_owned(), time)?;
        let found = self.times.partition_point(|sample| *sample <= time);
        Ok(match found.checked_sub(1) {
            Some(before) if self.times[before] == time => self.codes[before],
            _ => time * self.layer.time_codes_per_second,
        })
    }
}
