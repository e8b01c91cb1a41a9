//! From linear light to a screen.

use tiny_skia::PremultipliedColorU8;

/// The ground: light grey, a little darker below; as a screen has it.
const ABOVE: [f32; 3] = [0.80, 0.81, 0.825];
const BELOW: [f32; 3] = [0.585, 0.595, 0.615];

/// How bright the room is to the film.
const EXPOSURE: f32 = 1.0;

/// The ground's light, `down` from 0 above to 1 below.
pub fn ground(down: f32) -> [f32; 3] {
    [0, 1, 2].map(|channel| {
        let value = ABOVE[channel] + (BELOW[channel] - ABOVE[channel]) * down;
        developed_from(decoded(value))
    })
}

/// A pixel of such light.
pub fn shown(light: [f32; 3]) -> PremultipliedColorU8 {
    let [red, green, blue] = light.map(|value| (255.0 * encoded(developed(value)) + 0.5) as u8);
    PremultipliedColorU8::from_rgba(red, green, blue, 255).unwrap_or(PremultipliedColorU8::TRANSPARENT)
}

/// Highlights are compressed as film does: linear up to a half, then towards 1 without an end.
fn developed(light: f32) -> f32 {
    let value = (EXPOSURE * light).max(0.0);
    if value <= 0.5 { value } else { 1.0 - 0.25 / value }
}

/// What [`developed`] makes this of; less than 1.
fn developed_from(value: f32) -> f32 {
    (if value <= 0.5 { value } else { 0.25 / (1.0 - value) }) / EXPOSURE
}

/// sRGB's curve (IEC 61966-2-1).
fn encoded(value: f32) -> f32 {
    if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}

fn decoded(value: f32) -> f32 {
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ground_is_shown_as_it_is_meant() {
        for (down, meant) in [(0.0, ABOVE), (1.0, BELOW)] {
            let pixel = shown(ground(down));
            for (shown, meant) in [pixel.red(), pixel.green(), pixel.blue()].into_iter().zip(meant) {
                assert!((f32::from(shown) / 255.0 - meant).abs() < 0.003);
            }
        }
        assert_eq!(shown([f32::INFINITY, 0.0, -1.0]), PremultipliedColorU8::from_rgba(255, 0, 0, 255).unwrap());
    }

    #[test]
    fn brighter_light_is_shown_brighter() {
        let values: Vec<f32> = (0..200).map(|k| developed(k as f32 * 0.05)).collect();
        assert!(values.windows(2).all(|pair| pair[1] > pair[0]) && values[199] < 1.0);
        assert!((developed(0.5) - 0.5).abs() < 1e-6 && (developed(0.500_01) - 0.5).abs() < 1e-4);
    }
}
