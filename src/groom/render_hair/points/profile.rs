//! Profiles along a strand that do not depend on the guides: the blend into wisps, a wisp's radius, frizz and taper, as rows of
//! numbers for a strand's points.

use crate::groom::render_hair::settings::RenderSettings;
use crate::math::functions::trigonometry::sine_cosine;
use crate::math::random::Seeded;

/// Random curves that strands and wisps choose from, each turned and scaled differently.
pub(in crate::groom::render_hair) const CURVES: usize = 64;
/// Waves that a frizz curve sums, in each direction.
const HARMONICS: usize = 3;

/// S(x) = 3x² − 2x³ from 0 to 1, constant outside.
fn smooth_step(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// The most that a strand moves sideways into its wisp, per metre along it.
const STEEPEST: f64 = 0.5;

/// How far strands of this curliness blend into their wisp, and at which fraction of their length they are done: see
/// [`RenderSettings::curliness`]. A strand that is `length` long and starts `gap` (m) beside its wisp's start blends more slowly,
/// or less far, so that its root has no kink.
pub(in crate::groom::render_hair) fn gather(curliness: f64, gap: f64, length: f64) -> (f64, f64) {
    let end = (2.0 - 2.0 * curliness).clamp(0.1, 1.0);
    // S is steepest, 3/2, in its middle.
    let needed = if length > 0.0 { 1.5 * gap / (STEEPEST * length) } else { 1.0 };
    ((2.0 * curliness).min(1.0) / needed.max(1.0), end.max(needed.min(1.0)))
}

/// Schlick's bias (1994): from 0 to 1, straight at `shape` 0, bulging above, pinched below.
fn bias(t: f64, shape: f64) -> f64 {
    let slant = 2.0 / (1.0 + shape) - 2.0;
    t / (slant * (1.0 - t) + 1.0)
}

/// Rows of `stride` floats, of which the first ones belong to a strand's points.
#[derive(Debug)]
pub(in crate::groom::render_hair) struct Profiles {
    /// The position along a strand, 0 to 1.
    pub place: Vec<f32>,
    /// A wisp's relative radius.
    pub wisp: Vec<f32>,
    /// Radius of a strand, m.
    pub radius: Vec<f32>,
    /// Random curves for strands, relative to the distance at the tip, along n1 and n2, two rows each; empty without frizz.
    pub frizz: Vec<f32>,
    /// The same for wisps.
    pub clumps: Vec<f32>,
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
            let left = 1.0 - ((s - settings.taper_from) / (1.0 - settings.taper_from)).max(0.0);
            settings.tip_radius + (settings.radius - settings.tip_radius) * bias(left, settings.taper_shape)
        });
        let curves = |purpose: u64, waves: f64| {
            let numbers = Seeded::new(settings.seed, purpose);
            let mut rows = Vec::new();
            for curve in 0..CURVES as u64 {
                for axis in 0..2 {
                    let first = (curve * 2 + axis) * 2 * HARMONICS as u64;
                    // The mean square of a sine is a half, and the two directions share the whole.
                    let amplitude = 1.0 / (HARMONICS as f64).sqrt();
                    rows.extend(row(&|s| {
                        let sines = (0..HARMONICS as u64).map(|harmonic| {
                            let number = |k: u64| numbers.unit(first + 2 * harmonic + k);
                            let frequency = waves * (0.5 + number(0));
                            sine_cosine(std::f64::consts::TAU * (frequency * s + number(1))).0
                        });
                        amplitude * s * s * sines.sum::<f64>()
                    }));
                }
            }
            rows
        };
        let strays = settings.frizz > 0.0 || (settings.flyaways > 0.0 && settings.flyaway_distance > 0.0);
        let frizz = if strays { curves(1, settings.frizz_waves) } else { Vec::new() };
        let clumps = if settings.clump_noise > 0.0 { curves(16, settings.clump_noise_waves) } else { Vec::new() };
        Self { place: row(&|s| s), wisp, radius, frizz, clumps }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curliness_gathers_monotonely_and_never_kinks() {
        let fraction = |u: f64, s: f64| {
            let (most, end) = gather(u, 0.0, 0.2);
            most * smooth_step(s / end)
        };
        for k in 0..=100 {
            let s = f64::from(k) / 100.0;
            assert_eq!(fraction(0.0, s), 0.0);
            assert_eq!(fraction(0.5, s), smooth_step(s));
            for u in 0..100 {
                let (less, more) = (f64::from(u) / 100.0, f64::from(u + 1) / 100.0);
                assert!(fraction(less, s) <= fraction(more, s) + 1e-15);
            }
        }
        assert_eq!(fraction(1.0, 0.0), 0.0);
        assert_eq!(fraction(1.0, 0.1), 1.0);
        // The steepest slope of most·gap·S(s/end) over the length is 3/2 of most·gap/(end·length).
        for (gap, length) in [(0.0, 0.1), (0.001, 0.2), (0.01, 0.2), (0.01, 0.02), (0.05, 0.001), (0.01, 0.0)] {
            let (most, end) = gather(1.0, gap, length);
            assert!((0.1..=1.0).contains(&end) && (0.0..=1.0).contains(&most));
            assert!(1.5 * most * gap <= STEEPEST * end * length + 1e-15 || length == 0.0, "{gap} {length}: {most} {end}");
        }
    }

    #[test]
    fn taper_is_linear_bulging_or_pinched() {
        let radii = |taper_shape: f64| {
            let settings = RenderSettings { points_per_strand: 9, taper_from: 0.0, taper_shape, ..RenderSettings::default() };
            Profiles::new(&settings, 16).radius[..9].to_vec()
        };
        let (thin, even, thick) = (radii(-0.5), radii(0.0), radii(0.5));
        for k in 0..9 {
            assert!((f64::from(even[k]) - (40e-6 - 25e-6 * k as f64 / 8.0)).abs() < 1e-11);
            let ends = k == 0 || k == 8;
            assert!(if ends { (thin[k] - thick[k]).abs() < 1e-11 } else { thin[k] < even[k] && even[k] < thick[k] });
        }
    }

    #[test]
    fn frizz_has_the_requested_deviation_and_none_at_the_root() {
        let settings = RenderSettings { points_per_strand: 33, frizz: 0.003, frizz_waves: 7.0, ..RenderSettings::default() };
        let profiles = Profiles::new(&settings, 40);
        let (mut square, mut count) = (0.0, 0);
        for curve in profiles.frizz.chunks(80) {
            assert_eq!((curve[0], curve[40]), (0.0, 0.0));
            square += f64::from(curve[32]).powi(2) + f64::from(curve[72]).powi(2);
            count += 1;
        }
        assert_eq!(count, CURVES);
        // 64 curves of six sines each: the mean square is known to 1/sqrt(2·64·3), 5 %; the root to half of that.
        let deviation = (square / f64::from(count as u32)).sqrt();
        assert!((deviation - 1.0).abs() < 0.1, "{deviation}");
    }
}
