//! A scene that was run: strands out of its result, bodies out of the scene.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::picture::moment::Moment;
use crate::scene;
use crate::scene::Scene;
use crate::shell::failure::Failure;

/// A result and its scene.
pub struct Replay {
    path: PathBuf,
    scene: Scene,
    result: Value,
    times: Vec<f64>,
    /// Draw each so many-th strand.
    every: usize,
}

impl Replay {
    /// Reads the result of a scene that asked for `points`.
    pub fn read(result: &Path, scene: &Path, every: usize) -> Result<Self, Failure> {
        let scene = scene::load(scene)?;
        let text = fs::read_to_string(result).map_err(|error| Failure::file(result, format!("cannot be read: {error}")))?;
        let mut replay = Self { path: result.to_owned(), scene, result: Value::Null, times: Vec::new(), every };
        replay.result = serde_json::from_str(&text).map_err(|error| replay.bad(&error.to_string()))?;
        replay.times = list(&replay.result["times"]).iter().filter_map(Value::as_f64).collect();
        let (strands, times) = (list(&replay.result["strands"]).len(), replay.times.len());
        if strands == 0 || times == 0 || strands != replay.scene.strands.len() {
            let expected = replay.scene.strands.len();
            return Err(replay.bad(&format!("{times} times, {strands} strands of the scene's {expected}")));
        }
        Ok(replay)
    }

    fn bad(&self, reason: &str) -> Failure {
        Failure::file(&self.path, format!("is no result of a scene that asks for points: {reason}"))
    }

    /// When states were written, s; at least one.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The state at one of the times, m.
    pub fn moment(&self, index: usize) -> Result<Moment, Failure> {
        let points = |strand: &Value| -> Option<Vec<[f32; 3]>> {
            let points = strand["points"].as_array()?.get(index)?.as_array()?;
            let point = |value: &Value| {
                let numbers: Option<Vec<f32>> = value.as_array()?.iter().map(|number| Some(number.as_f64()? as f32)).collect();
                <[f32; 3]>::try_from(numbers?).ok()
            };
            points.iter().map(point).collect::<Option<Vec<_>>>().filter(|points| points.len() > 1)
        };
        let time = self.times[index];
        let shown = list(&self.result["strands"]).iter().step_by(self.every).map(points).collect::<Option<Vec<_>>>();
        let strands = shown.ok_or_else(|| self.bad(&format!("no points at {time} s")))?;
        let bodies = self.scene.colliders.iter().map(|collider| collider.surface_at(time)).collect();
        Ok(Moment { label: format!("{time:.2} s"), strands, bodies })
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}
