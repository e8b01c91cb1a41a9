//! Moments of a scene that was run: strands out of its result, bodies out of the scene.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::sheet::Moment;
use super::spread;
use crate::failure::Failure;
use crate::scene;
use crate::surface::Surface;

/// `count` moments of the result of a scene that asked for `points`, every `every`-th strand.
pub fn moments(result: &Path, scene: &Path, count: usize, every: usize) -> Result<Vec<Moment>, Failure> {
    let scene = scene::load(scene)?;
    let bad = |reason: &str| Failure::file(result, format!("is no result of a scene that asks for points: {reason}"));
    let text = fs::read_to_string(result).map_err(|error| Failure::file(result, format!("cannot be read: {error}")))?;
    let document: Value = serde_json::from_str(&text).map_err(|error| bad(&error.to_string()))?;
    let times: Vec<f64> = list(&document["times"]).iter().filter_map(Value::as_f64).collect();
    let strands = list(&document["strands"]);
    if strands.is_empty() || times.is_empty() || strands.len() != scene.strands.len() {
        return Err(bad(&format!("{} times, {} strands of the scene's {}", times.len(), strands.len(), scene.strands.len())));
    }
    let mut moments = Vec::new();
    for index in spread(times.len(), count) {
        let points = |strand: &Value| -> Option<Vec<[f32; 3]>> {
            let points = strand["points"].as_array()?.get(index)?.as_array()?;
            let point = |value: &Value| {
                let numbers: Option<Vec<f32>> = value.as_array()?.iter().map(|number| Some(number.as_f64()? as f32)).collect();
                <[f32; 3]>::try_from(numbers?).ok()
            };
            points.iter().map(point).collect::<Option<Vec<_>>>().filter(|points| points.len() > 1)
        };
        let shown = strands.iter().step_by(every).map(points).collect::<Option<Vec<_>>>();
        let strands = shown.ok_or_else(|| bad(&format!("no points at {} s", times[index])))?;
        let bodies = scene.colliders.iter().map(|collider| collider.surface_at(times[index])).collect::<Vec<Surface>>();
        moments.push(Moment { label: format!("{:.2} s", times[index]), strands, bodies });
    }
    Ok(moments)
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}
