//! How a hair scatters light: Marschner et al. 2003 ("Light scattering from human hair fibers") in the closed form of Karis 2016 ("Physically
//! based hair shading in Unreal", SIGGRAPH course). Light is reflected (R), goes through (TT), or is reflected inside (TRT); what many hairs
//! scatter on is one broad term.

use std::f32::consts::{FRAC_1_PI, TAU};

use nalgebra::Vector3;

/// Refractive index of hair.
const INDEX: f32 = 1.55;
/// How far scales tilt the lobes, rad.
const TILT: f32 = 0.035;
/// Width of the longitudinal lobe of R, as a share of the sine.
const WIDTH: f32 = 0.16;

/// What reaches the viewer of light from one direction, a unit of irradiance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scattered {
    /// By this hair alone: red, green, blue.
    pub single: [f32; 3],
    /// By many, before their colour.
    pub multiple: f32,
}

/// A hair's colour, and how its scales differ from those of others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fibre {
    /// What is left of light that went through once, 0 to 1.
    pub colour: [f32; 3],
    /// Added to the scales' tilt, rad.
    pub tilt: f32,
}

fn gaussian(width: f32, offset: f32) -> f32 {
    (-0.5 * offset * offset / (width * width)).exp() / (TAU.sqrt() * width)
}

/// Schlick's form of Fresnel's reflectance.
fn fresnel(cosine: f32) -> f32 {
    let normal = ((1.0 - INDEX) / (1.0 + INDEX)).powi(2);
    normal + (1.0 - normal) * (1.0 - cosine).powi(5)
}

/// Light from `light` that a hair along `along` sends to the viewer, who looks from +z. Both are of length 1.
pub fn scatter(along: Vector3<f32>, light: Vector3<f32>, fibre: &Fibre) -> Scattered {
    let viewer = Vector3::z();
    let (sin_in, sin_out) = (along.dot(&light).clamp(-1.0, 1.0), along.z.clamp(-1.0, 1.0));
    let (across_in, across_out) = (light - along * sin_in, viewer - along * sin_out);
    let lengths = (across_in.norm_squared() * across_out.norm_squared()).sqrt().max(1e-6);
    let cos_around = (across_in.dot(&across_out) / lengths).clamp(-1.0, 1.0);
    let cos_half = (0.5 + 0.5 * cos_around).sqrt();
    let cos_difference = (0.5 * (sin_out.asin() - sin_in.asin())).cos().max(1e-3);
    let tilt = TILT + fibre.tilt;
    let sum = sin_in + sin_out;

    let shift = -2.0 * tilt;
    let turned = 2.0 * shift.sin() * (shift.cos() * cos_half * (1.0 - sin_out * sin_out).sqrt() + shift.sin() * sin_out);
    let mirrored = gaussian(WIDTH * std::f32::consts::SQRT_2 * cos_half.max(0.05), sum - turned)
        * 0.25
        * cos_half
        * fresnel((0.5 + 0.5 * light.z).clamp(0.0, 1.0).sqrt());

    let index = 1.19 / cos_difference + 0.36 * cos_difference;
    let bent = 1.0 / index;
    let height = (cos_half * (1.0 + bent * (0.6 - 0.8 * cos_around))).clamp(-1.0, 1.0);
    let passed = (1.0 - fresnel(cos_difference * (1.0 - height * height).sqrt())).powi(2);
    let through = gaussian(0.5 * WIDTH, sum - tilt) * passed * (-3.65 * cos_around - 3.98).exp();
    let way = 0.5 * (1.0 - (height * bent).powi(2)).max(0.0).sqrt() / cos_difference;

    let inside = fresnel(0.5 * cos_difference);
    let returned = gaussian(2.0 * WIDTH, sum - 4.0 * tilt) * (1.0 - inside).powi(2) * inside * (17.0 * cos_around - 16.78).exp();
    let way_back = 0.8 / cos_difference;

    let single = fibre.colour.map(|colour| {
        let log = colour.max(1e-4).ln();
        mirrored + through * (log * way).exp() + returned * (log * way_back).exp()
    });
    // Karis' mixture of a wrapped lambertian about the normal that faces the viewer and of Kajiya and Kay's (1989) sine.
    let facing = across_out.try_normalize(1e-6).map_or(0.0, |normal| normal.dot(&light));
    let wrapped = ((facing + 1.0) / 4.0).clamp(0.0, 1.0);
    let sine = (1.0 - sin_in * sin_in).max(0.0).sqrt();
    Scattered { single, multiple: FRAC_1_PI * (wrapped + 0.33 * (sine - wrapped)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BROWN: Fibre = Fibre { colour: [0.3, 0.17, 0.1], tilt: 0.0 };

    #[test]
    fn the_highlight_lies_where_the_light_is_mirrored_and_moves_with_the_scales() {
        // The hair stands in the plane of light and viewer, and leans until it glints.
        let glint = |tilt: f32, light: Vector3<f32>| {
            let at = |step: i32| {
                let lean = step as f32 * 0.005;
                let along = Vector3::new(0.0, lean.cos(), lean.sin());
                (scatter(along, light, &Fibre { tilt, ..BROWN }).single[2], lean)
            };
            (-120..=120).map(at).fold((0.0, 0.0), |best, here| if here.0 > best.0 { here } else { best }).1
        };
        let light = Vector3::new(0.0, 0.6, 0.8);
        // Half way between light and viewer lies the normal.
        let half = -(0.6f32).atan2(1.8);
        let found = glint(-TILT, light);
        assert!((found - half).abs() < 0.03, "{found} for {half}");
        assert!((glint(0.05, light) - found).abs() > 0.05);
    }

    #[test]
    fn light_from_behind_goes_through_in_the_hairs_colour() {
        let behind = scatter(Vector3::x(), -Vector3::z(), &BROWN).single;
        let beside = scatter(Vector3::x(), Vector3::y(), &BROWN).single;
        assert!(behind[0] > 3.0 * beside[0], "{behind:?} {beside:?}");
        assert!(behind[0] > behind[1] && behind[1] > behind[2]);
    }

    #[test]
    fn no_direction_gives_anything_but_finite_light() {
        let directions: Vec<Vector3<f32>> = (0..27)
            .filter_map(|k| Vector3::new((k % 3) as f32 - 1.0, (k / 3 % 3) as f32 - 1.0, (k / 9) as f32 - 1.0).try_normalize(0.1))
            .collect();
        for along in &directions {
            for light in &directions {
                let scattered = scatter(*along, *light, &BROWN);
                let all = [scattered.single[0], scattered.single[1], scattered.single[2], scattered.multiple];
                assert!(all.iter().all(|value| value.is_finite() && *value >= 0.0), "{along} {light} {scattered:?}");
            }
        }
    }
}
