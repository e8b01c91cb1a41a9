//! What depends on the place along a strand and not on the guides: how far strands have gone over to their wisp, a wisp's radius, frizz
//! and taper, as rows of numbers for the places of a strand's points.

use super::settings::RenderSettings;
use crate::math::random::Seeded;
use crate::math::trigonometry::sine_cosine;

/// Frizz curves that strands choose from, each turned and scaled in its own way.
pub(super) const FRIZZ_CURVES: usize = 64;
/// Waves that a frizz curve is the sum of, in each direction.
const HARMONICS: usize = 3;

/// S(x) = 3x² − 2x³ from 0 to 1, held outside.
fn smooth_step(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// How far hair of that curliness has gone over to its wisp at s; see [`RenderSettings::curliness`].
pub(super) fn gathered(curliness: f64, s: f64) -> f64 {
    let end = (2.0 - 2.0 * curliness).clamp(0.1, 1.0);
    (2.0 * curliness).min(1.0) * smooth_step(s / end)
}

/// Rows of `stride` floats, of which those of a strand's points count.
#[derive(Debug)]
pub(super) struct Profiles {
    /// A wisp's radius as a share.
    pub wisp: Vec<f32>,
    /// Radius of a strand, m.
    pub radius: Vec<f32>,
    /// Frizz along n1 and n2, m, two rows a curve; empty without frizz.
    pub frizz: Vec<f32>,
}

impl Profiles {
    pub fn new(settings: &RenderSettings, stride: usize) -> Self {
        let points = settings.points_per_strand;
        let place = |k: usize| k as f64 / (points - 1) as f64;
        let row = |value: &dyn Fn(f64) -> f64| {
            (0..stride).map(|k| if k < points { value(place(k)) as f32 } else { 0.0 }).collect::<Vec<f32>>()
        };
        let [root, middle, tip] = settings.wisp_profile;
        let wisp = row(&|s| {
            if s < 0.5 {
                root + (middle - root) * smooth_step(2.0 * s)
            } else {
                middle + (tip - middle) * smooth_step(2.0 * s - 1.0)
            }
        });
        let radius = row(&|s| {
            let share = ((s - settings.taper_from) / (1.0 - settings.taper_from)).max(0.0);
            settings.radius + (settings.tip_radius - settings.radius) * share
        });
        let mut frizz = Vec::new();
        if settings.frizz > 0.0 {
            let numbers = Seeded::new(settings.seed, 1);
            for curve in 0..FRIZZ_CURVES as u64 {
                for axis in 0..2 {
                    let first = (curve * 2 + axis) * 2 * HARMONICS as u64;
                    // The mean square of a sine is a half, and the two directions share the whole.
                    let amplitude = settings.frizz / (HARMONICS as f64).sqrt();
                    frizz.extend(row(&|s| {
                        let waves = (0..HARMONICS as u64).map(|harmonic| {
                            let number = |k: u64| numbers.unit(first + 2 * harmonic + k);
                            let frequency = settings.frizz_waves * (0.5 + number(0));
                            sine_cosine(std::f64::consts::TAU * (frequency * s + number(1))).0
                        });
                        amplitude * s * s * waves.sum::<f64>()
                    }));
                }
            }
        }
        Self { wisp, radius, frizz }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curliness_gathers_monotonely_from_none_at_the_root() {
        for k in 0..=100 {
            let s = f64::from(k) / 100.0;
            assert_eq!(gathered(0.0, s), 0.0);
            assert_eq!(gathered(0.5, s), smooth_step(s));
            for u in 0..100 {
                let (less, more) = (f64::from(u) / 100.0, f64::from(u + 1) / 100.0);
                assert!(gathered(less, s) <= gathered(more, s) + 1e-15);
            }
        }
        assert_eq!(gathered(1.0, 0.0), 0.0);
        assert_eq!(gathered(1.0, 0.1), 1.0);
    }

    #[test]
    fn frizz_has_the_deviation_that_was_asked_for_and_none_at_the_root() {
        let settings = RenderSettings { points_per_strand: 33, frizz: 0.003, frizz_waves: 7.0, ..RenderSettings::default() };
        let profiles = Profiles::new(&settings, 40);
        let (mut square, mut count) = (0.0, 0);
        for curve in profiles.frizz.chunks(80) {
            assert_eq!((curve[0], curve[40]), (0.0, 0.0));
            square += f64::from(curve[32]).powi(2) + f64::from(curve[72]).powi(2);
            count += 1;
        }
        assert_eq!(count, FRIZZ_CURVES);
        // 64 curves of six sines each: the mean square is known to 1/sqrt(2·64·3), 5 %; the root to half of that.
        let deviation = (square / f64::from(count as u32)).sqrt();
        assert!((deviation / 0.003 - 1.0).abs() < 0.1, "{deviation}");
    }
}
