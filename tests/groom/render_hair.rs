//! Render hair against what the scheme promises: at the root a strand is where interpolation has it, at the tip where its wisp is; weights sum
//! to one and change smoothly; guides that part are not mixed; what moves rigidly is moved rigidly, with the velocities of that; curls that are
//! out of step keep their size when curvatures are mixed; nothing depends on who works.

use std::sync::{Arc, Mutex};

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::io::Curves;
use superhelix::render::{
    GuideSamples, Motion, RenderHair, RenderPose, RenderSettings, Space, StrandPoints, StrandSink, View, measured_curliness,
    resampled,
};
use superhelix::{Error, InstructionSet, Workers};

/// A strand's points.
#[derive(Debug, Clone, PartialEq)]
pub struct Taken {
    pub points: Vec<Vector3<f64>>,
    rotations: Vec<[f32; 4]>,
    pub velocities: Vec<Vector3<f64>>,
    radii: Vec<f32>,
}

struct Collect {
    first: usize,
    strands: Mutex<Vec<Option<Taken>>>,
}

impl StrandSink for Collect {
    fn take(&self, points: &StrandPoints) {
        let count = points.positions[0].len();
        let vectors = |rows: [&[f32]; 3]| {
            (0..rows[0].len()).map(|k| Vector3::new(rows[0][k], rows[1][k], rows[2][k]).map(f64::from)).collect::<Vec<_>>()
        };
        let rotations = (0..points.rotations[0].len()).map(|k| points.rotations.map(|row| row[k])).collect();
        let taken = Taken {
            points: vectors(points.positions),
            rotations,
            velocities: vectors(points.velocities),
            radii: points.radii[..count].iter().map(|radius| radius * points.radius_factor).collect(),
        };
        let mut strands = self.strands.lock().expect("no panic");
        let place = &mut strands[points.strand - self.first];
        assert!(place.is_none(), "strand {} came twice", points.strand);
        *place = Some(taken);
    }
}

/// Mixing alone: no gathering, cutting or respacing.
pub fn plain() -> RenderSettings {
    RenderSettings {
        curliness: 0.0,
        wisps_per_guide: 1,
        flyaways: 0.0,
        length_variation: 0.0,
        preserve_length: false,
        ..RenderSettings::default()
    }
}

pub fn whole(pose: &RenderPose) -> View<'static> {
    View::whole(pose.hair())
}

pub fn evaluate(pose: &RenderPose, view: &View) -> Vec<Taken> {
    let sink = Collect { first: view.first, strands: Mutex::new(vec![None; view.count]) };
    pose.evaluate(view, &sink).expect("an evaluation");
    sink.strands.into_inner().expect("no panic").into_iter().map(|taken| taken.expect("every strand")).collect()
}

pub fn bind(settings: &RenderSettings, guides: &GuideSamples, roots: &[Vector3<f64>]) -> RenderPose {
    let mut pose = RenderPose::new(Arc::new(RenderHair::bind(settings, guides, roots).expect("a map")));
    pose.set(guides).expect("a pose");
    pose
}

/// A real groom: guides of 16 points each, m, y up.
pub fn groom(name: &str, scale: f64, every: usize, points: usize) -> Vec<Vector3<f64>> {
    let path = format!("{}/tests/data/grooms/{name}", env!("CARGO_MANIFEST_DIR"));
    let curves = Curves::read(path).expect("a groom");
    let strands: Vec<_> = curves.strands().step_by(every).collect();
    let counts: Vec<u32> = strands.iter().map(|strand| strand.len() as u32).collect();
    let all: Vec<_> = strands.iter().flat_map(|strand| strand.iter()).map(|p| Vector3::from(p.map(f64::from)) * scale).collect();
    resampled(&all, &counts, None, points).expect("curves").points
}

pub fn sintel() -> Vec<Vector3<f64>> {
    groom("sintel_hair_001.tfx", 0.01, 1, 16)
}

/// Numbers in [0, 1).
pub fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64
}

/// Roots among those of the guides: each between one and its next two.
pub fn roots_among(guides: &[Vector3<f64>], points: usize, count: usize) -> Vec<Vector3<f64>> {
    let roots: Vec<_> = guides.iter().step_by(points).copied().collect();
    let mut seed = 5;
    (0..count)
        .map(|_| {
            let one = roots[(noise(&mut seed) * roots.len() as f64) as usize];
            let mut near = roots.clone();
            near.sort_by(|a, b| (a - one).norm().total_cmp(&(b - one).norm()));
            let (a, b) = (noise(&mut seed), noise(&mut seed));
            let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
            one + (near[1] - one) * a + (near[2] - one) * b
        })
        .collect()
}

pub fn length(points: &[Vector3<f64>]) -> f64 {
    points.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum()
}

/// f32 on coordinates of up to a few metres.
const ROUNDING: f64 = 2e-6;

#[test]
fn a_strand_begins_at_its_root_and_on_a_guide_it_is_the_guide() {
    let guides = sintel();
    let roots = roots_among(&guides, 16, 500);
    for space in [Space::Position, Space::Curvature] {
        for curliness in [0.0, 0.5, 1.0] {
            let settings = RenderSettings { space, curliness, frizz: 0.01, ..plain() };
            for (strand, root) in evaluate_all(&settings, &guides, &roots).iter().zip(&roots) {
                assert!((strand.points[0] - root).norm() < ROUNDING, "{:?} {root}", strand.points[0]);
            }
            let settings = RenderSettings { space, curliness, ..plain() };
            let own: Vec<_> = guides.iter().step_by(16).copied().collect();
            for (strand, guide) in evaluate_all(&settings, &guides, &own).iter().zip(guides.chunks(16)) {
                for (point, wanted) in strand.points.iter().zip(guide) {
                    // Bends in f32 over 14 points: some 1e-6 rad each at the root's end of 0.2 m.
                    assert!((point - wanted).norm() < 5e-6, "{point} {wanted}");
                }
            }
        }
    }
}

pub fn evaluate_all(settings: &RenderSettings, guides: &[Vector3<f64>], roots: &[Vector3<f64>]) -> Vec<Taken> {
    let pose = bind(settings, &GuideSamples::at_rest(guides), roots);
    evaluate(&pose, &whole(&pose))
}

#[test]
fn without_curls_a_strand_is_its_guides_mean_carried_to_its_root() {
    let guides = sintel();
    let roots = roots_among(&guides, 16, 400);
    let pose = bind(&plain(), &GuideSamples::at_rest(&guides), &roots);
    let mut mixed = 0;
    for (index, strand) in evaluate(&pose, &whole(&pose)).iter().enumerate() {
        let weights: Vec<_> = pose.hair().guides_of(index).expect("a strand").collect();
        let sum: f64 = weights.iter().map(|(_, weight)| f64::from(*weight)).sum();
        assert!((sum - 1.0).abs() < 3e-7, "{sum}");
        assert!(weights.iter().all(|(_, weight)| (-0.2501..=1.7501).contains(weight)));
        mixed += usize::from(weights.len() > 1 && weights[0].1 < 0.9);
        for k in 0..16 {
            let mean: Vector3<f64> = weights
                .iter()
                .map(|(guide, weight)| f64::from(*weight) * (guides[*guide as usize * 16 + k] - guides[*guide as usize * 16]))
                .sum();
            assert!((strand.points[k] - (roots[index] + mean)).norm() < ROUNDING);
        }
    }
    assert!(mixed > 200, "{mixed} strands are mixed of several guides");
}

#[test]
fn tips_of_a_wisp_are_its_section_drawn_together() {
    let guides = sintel();
    let roots = roots_among(&guides, 16, 3000);
    for space in [Space::Position, Space::Curvature] {
        for (curliness, wisps) in [(0.5, 1), (1.0, 1), (1.0, 4)] {
            let settings = RenderSettings { space, curliness, wisps_per_guide: wisps, wisp_profile: [1.0, 0.7, 0.3], ..plain() };
            let pose = bind(&settings, &GuideSamples::at_rest(&guides), &roots);
            let strands = evaluate(&pose, &whole(&pose));
            let mut members = std::collections::HashMap::<(u32, u32), Vec<usize>>::new();
            for index in 0..roots.len() {
                let (guide, _) = pose.hair().guides_of(index).expect("a strand").next().expect("a guide");
                members.entry((guide, pose.hair().wisp_of(index).expect("a strand"))).or_default().push(index);
            }
            assert_eq!(members.keys().any(|(_, wisp)| *wisp > 0), wisps > 1);
            let mut shares = Vec::new();
            for ((guide, _), members) in &members {
                let guide = &guides[*guide as usize * 16..][..16];
                // Strands that are short beside their wisp do not blend into it completely.
                if members.len() < 8 || length(guide) < 0.1 {
                    continue;
                }
                let spread = |of: &dyn Fn(usize) -> Vector3<f64>| {
                    let middle = members.iter().map(|index| of(*index)).sum::<Vector3<f64>>() / members.len() as f64;
                    let squares: f64 = members.iter().map(|index| (of(*index) - middle).norm_squared()).sum();
                    (squares / members.len() as f64).sqrt()
                };
                shares.push(spread(&|index| strands[index].points[15]) / spread(&|index| roots[index]));
                // Sections are carried along the guide, so that they stand across it.
                let last = (guide[15] - guide[14]).normalize();
                for index in members {
                    let tip = strands[*index].points[15] - guide[15];
                    assert!(tip.dot(&last).abs() < 1e-5, "{}", tip.dot(&last));
                }
            }
            // The depth of a curved patch of scalp is not part of its section.
            assert!(shares.len() > 40 && shares.iter().all(|share| *share < 0.3001), "{shares:?}");
            let mean = shares.iter().sum::<f64>() / shares.len() as f64;
            assert!(mean > 0.27, "{mean}");
        }
    }
}

#[test]
fn a_strand_depends_smoothly_on_its_root() {
    let guides = sintel();
    let own: Vec<_> = guides.iter().step_by(16).copied().collect();
    // Across the scalp from one guide's root to another; without the criterion on tips, and interpolated all along.
    let settings = RenderSettings { max_tip_ratio: f64::INFINITY, ..plain() };
    let largest = |count: usize| {
        let line: Vec<_> = (0..=count).map(|k| own[0] + (own[120] - own[0]) * (k as f64 / count as f64)).collect();
        let strands = evaluate_all(&settings, &guides, &line);
        strands.windows(2).map(|pair| (pair[1].points[15] - pair[0].points[15]).norm()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (largest(2000), largest(16_000));
    // An eighth as far apart, strands differ by an eighth; a jump would stay. (The largest is where weights change fastest: some slack.)
    assert!(fine < 0.25 * coarse && coarse > 1e-5, "{coarse} {fine}");
}

#[test]
fn guides_whose_tips_part_are_not_mixed() {
    // A parting along y at x = 0: guides of 0.3 m go to the left and to the right.
    let mut guides = Vec::new();
    for row in 0..20 {
        for (column, side) in [(-1.5, -1.0), (-0.5, -1.0), (0.5, 1.0), (1.5, 1.0)] {
            let root = Vector3::new(0.01 * column, 0.01 * f64::from(row), 0.0);
            guides.extend((0..16).map(|k| root + Vector3::new(side, 0.0, 0.2) * (0.02 * f64::from(k))));
        }
    }
    let roots: Vec<_> =
        (0..400).map(|k| Vector3::new(0.04 * f64::from(k % 20) / 19.0 - 0.02, 0.19 * f64::from(k / 20) / 19.0, 0.0)).collect();
    let reach = |settings: &RenderSettings| {
        let strands = evaluate_all(settings, &guides, &roots);
        strands.iter().map(|strand| (strand.points[15] - strand.points[0]).x.abs()).fold(f64::INFINITY, f64::min)
    };
    let none = RenderSettings { max_tip_ratio: f64::INFINITY, ..plain() };
    // Mixed across the parting there are strands on neither side; otherwise all go completely to one side.
    assert!(reach(&none) < 0.2, "{}", reach(&none));
    for settings in [plain(), RenderSettings { max_tip_distance: 0.2, max_tip_ratio: f64::INFINITY, ..plain() }] {
        assert!((reach(&settings) - 0.3).abs() < ROUNDING, "{}", reach(&settings));
    }
}

#[test]
fn what_moves_rigidly_is_moved_rigidly() {
    let guides = sintel();
    let roots = roots_among(&guides, 16, 300);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -1.9, 0.3));
    let shift = Vector3::new(0.3, -0.2, 1.0);
    let there: Vec<_> = guides.iter().map(|p| turn * p + shift).collect();
    let mut seed = 3;
    let frames: Vec<_> = (0..guides.len() / 16)
        .map(|_| UnitQuaternion::from_scaled_axis(Vector3::from_fn(|_, _| 3.0 * noise(&mut seed) - 1.5)))
        .collect();
    let frames_there: Vec<_> = frames.iter().map(|frame| turn * frame).collect();
    for space in [Space::Position, Space::Curvature] {
        for given in [false, true] {
            let settings = RenderSettings { space, curliness: 0.4, wisps_per_guide: 3, frizz: 0.004, ..plain() };
            let samples = GuideSamples { roots: given.then_some(&frames[..]), ..GuideSamples::at_rest(&guides) };
            let mut pose = bind(&settings, &samples, &roots);
            let view = View { rotations: true, ..whole(&pose) };
            let here = evaluate(&pose, &view);
            pose.set(&GuideSamples { roots: given.then_some(&frames_there[..]), ..GuideSamples::at_rest(&there) })
                .expect("a pose");
            for (before, after) in here.iter().zip(evaluate(&pose, &view)) {
                for k in 0..16 {
                    assert!((turn * before.points[k] + shift - after.points[k]).norm() < 1e-5);
                    let [x, y, z, w] = before.rotations[k].map(f64::from);
                    let [a, b, c, d] = after.rotations[k].map(f64::from);
                    let before = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z));
                    let after = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(d, a, b, c));
                    // Tangents are differences of points a few millimetres apart.
                    assert!((turn * before).angle_to(&after) < 3e-3, "{}", (turn * before).angle_to(&after));
                }
            }
        }
    }
}

#[test]
fn velocities_are_those_of_the_motion() {
    let guides = sintel();
    let roots = roots_among(&guides, 16, 200);
    let (linear, angular) = (Vector3::new(1.0, -0.5, 0.25), Vector3::new(2.0, 5.0, -3.0));
    let field = |p: &Vector3<f64>| linear + angular.cross(p);
    let velocities: Vec<_> = guides.iter().map(field).collect();
    let spins = vec![angular; guides.len() / 16];
    for space in [Space::Position, Space::Curvature] {
        let settings = RenderSettings { space, curliness: 0.5, ..plain() };
        for spins in [None, Some(&spins[..])] {
            let mut pose = bind(&settings, &GuideSamples::at_rest(&guides), &roots);
            let samples =
                GuideSamples { velocities: Some(&velocities), root_angular_velocities: spins, ..GuideSamples::at_rest(&guides) };
            pose.set(&samples).expect("a pose");
            let view = View { motion: Motion::Guides, ..whole(&pose) };
            for strand in evaluate(&pose, &view) {
                for (point, velocity) in strand.points.iter().zip(&strand.velocities) {
                    let wanted = field(point);
                    // A difference over a millisecond: half of ω × v dt, and rounding of f32 over it.
                    assert!((velocity - wanted).norm() < 0.02, "{velocity} {wanted}");
                }
            }
        }
        // From one moment to another, a translation: exact to rounding; with the host's roots too.
        let before = bind(&settings, &GuideSamples::at_rest(&guides), &roots);
        let mut now = before.clone();
        let there: Vec<_> = guides.iter().map(|p| p + linear * 0.04).collect();
        now.set(&GuideSamples::at_rest(&there)).expect("a pose");
        let (from, to) = (|index: usize| roots[index], |index: usize| roots[index] + linear * 0.04);
        for given in [false, true] {
            let motion = Motion::Since { before: &before, seconds: 0.04, roots: if given { Some(&from) } else { None } };
            let view = View { motion, roots: if given { Some(&to) } else { None }, ..whole(&now) };
            for strand in evaluate(&now, &view) {
                assert!(strand.velocities.iter().all(|velocity| (velocity - linear).norm() < 1e-4));
            }
        }
    }
}

#[test]
fn the_bits_depend_neither_on_threads_nor_on_batches_nor_on_the_machine() {
    let guides = sintel();
    let roots = roots_among(&guides, 16, 1000);
    for space in [Space::Position, Space::Curvature] {
        let settings = RenderSettings {
            space,
            frizz: 0.01,
            clump_noise: 0.003,
            wisps_per_guide: 2,
            curliness: 0.4,
            ..RenderSettings::default()
        };
        let one = evaluate_all(&settings, &guides, &roots);
        for threads in [2, 3] {
            let several = RenderSettings { workers: Workers::Pool(threads), ..settings.clone() };
            assert!(evaluate_all(&several, &guides, &roots) == one);
        }
        for set in [InstructionSet::Scalar, InstructionSet::Avx2, InstructionSet::Avx512] {
            if set <= InstructionSet::detected() {
                let narrow = RenderSettings { instruction_set: Some(set), ..settings.clone() };
                assert!(evaluate_all(&narrow, &guides, &roots) == one, "{set:?}");
            }
        }
        let pose = bind(&settings, &GuideSamples::at_rest(&guides), &roots);
        for (first, count) in [(0, 1), (7, 45), (128, 300), (999, 1), (1000, 0)] {
            let part = evaluate(&pose, &View { first, count, ..whole(&pose) });
            assert!(part == one[first..first + count]);
        }
        let other = RenderSettings { seed: 1, ..settings.clone() };
        assert!(evaluate_all(&other, &guides, &roots) != one);
    }
}

/// The distance of a point from a polyline.
fn from_polyline(point: &Vector3<f64>, line: &[Vector3<f64>]) -> f64 {
    let from_edge = |edge: &[Vector3<f64>]| {
        let way = edge[1] - edge[0];
        let share = ((point - edge[0]).dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
        (edge[0] + way * share - point).norm()
    };
    line.windows(2).map(from_edge).fold(f64::INFINITY, f64::min)
}

#[test]
fn strands_are_shortened_by_seeded_fractions_and_stay_on_their_path() {
    let guides = sintel();
    let roots = roots_among(&guides, 16, 600);
    let shift = Vector3::new(0.4, -0.3, 0.2);
    for space in [Space::Position, Space::Curvature] {
        let whole_settings = RenderSettings { space, curliness: 0.5, ..plain() };
        let settings = RenderSettings { length_variation: 0.5, ..whole_settings.clone() };
        let uncut = evaluate_all(&whole_settings, &guides, &roots);
        let before = bind(&settings, &GuideSamples::at_rest(&guides), &roots);
        let mut pose = before.clone();
        let there: Vec<_> = guides.iter().map(|p| p + shift * 0.04).collect();
        pose.set(&GuideSamples::at_rest(&there)).expect("a pose");
        let motion = Motion::Since { before: &before, seconds: 0.04, roots: None };
        let moved = evaluate(&pose, &View { motion, rotations: true, ..whole(&pose) });
        let cut = evaluate(&before, &View { rotations: true, ..whole(&before) });
        let mut shares = Vec::new();
        for ((strand, long), later) in cut.iter().zip(&uncut).zip(&moved) {
            assert!(strand.points[0] == long.points[0] && strand.radii == long.radii);
            let edge = length(&long.points) / 15.0;
            for point in &strand.points {
                // A spline through the points lies off their chords by an eighth of an edge times its turn; the sharpest corners turn by a radian.
                let away = from_polyline(point, &long.points);
                assert!(away < 0.13 * edge, "{away} of {edge}");
            }
            shares.push(length(&strand.points) / length(&long.points));
            assert!(later.velocities.iter().all(|velocity| (velocity - shift).norm() < 2e-4));
            for (point, [x, y, z, w]) in strand.points.iter().zip(&strand.rotations) {
                assert!((x * x + y * y + z * z + w * w - 1.0).abs() < 1e-5 && point.x.is_finite());
            }
        }
        // Uniform between a half and one: the largest distance of the distributions is below 1.63/sqrt(600) = 0.067 in 99 of 100 cases; that
        // points are evenly spaced only nearly takes another 0.03.
        shares.sort_by(f64::total_cmp);
        let expected = |share: f64| ((share - 0.5) / 0.5).clamp(0.0, 1.0);
        let off = shares.iter().enumerate().map(|(k, share)| (expected(*share) - (k as f64 + 0.5) / 600.0).abs());
        let off = off.fold(0.0, f64::max);
        assert!(off < 0.1, "{off}");
        assert!(shares[0] > 0.48 && shares[599] < 1.02, "{} {}", shares[0], shares[599]);
        // Another seed cuts other strands; the same on any number of threads.
        let again = RenderSettings { workers: Workers::Pool(2), ..settings.clone() };
        let plain = evaluate_all(&settings, &guides, &roots);
        assert!(evaluate_all(&again, &guides, &roots) == plain);
        assert!(evaluate_all(&RenderSettings { seed: 9, ..settings.clone() }, &guides, &roots) != plain);
    }
}

/// Helices about lines along −z, of radius `radius` and `turns` turns over 0.2 m, a phase each.
fn curls(phases: &[f64], radius: f64, turns: f64, points: usize) -> Vec<Vector3<f64>> {
    let mut out = Vec::new();
    for (index, phase) in phases.iter().enumerate() {
        let axis = Vector3::new(0.01 * index as f64, 0.0, 0.0);
        for k in 0..points {
            let s = k as f64 / (points - 1) as f64;
            let angle = std::f64::consts::TAU * turns * s + phase;
            out.push(axis + Vector3::new(radius * angle.cos(), radius * angle.sin(), -0.2 * s));
        }
    }
    out
}

/// Root mean square distance from the straight line that fits a curve best (through its middle, along its principal axis).
fn amplitude(points: &[Vector3<f64>]) -> f64 {
    let middle = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let mut spread = nalgebra::Matrix3::zeros();
    points.iter().for_each(|p| spread += (p - middle) * (p - middle).transpose());
    let mut values: Vec<f64> = spread.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    ((values[0] + values[1]) / points.len() as f64).sqrt()
}

#[test]
fn curvatures_keep_the_curls_that_positions_lose() {
    // A third of a turn out of step: mixed half and half positions keep cos(60°) = a half of the radius.
    let guides = curls(&[0.0, 2.0 * std::f64::consts::FRAC_PI_3], 0.006, 5.0, 64);
    let roots = [0.5 * (guides[0] + guides[64])];
    let curl = amplitude(&guides[..64]);
    let settings = |space| RenderSettings { space, points_per_strand: 64, max_tip_ratio: f64::INFINITY, ..plain() };
    let position = &evaluate_all(&settings(Space::Position), &guides, &roots)[0];
    let curvature = &evaluate_all(&settings(Space::Curvature), &guides, &roots)[0];
    assert!((amplitude(&position.points) / curl - 0.5).abs() < 0.02, "{}", amplitude(&position.points) / curl);
    assert!((amplitude(&curvature.points) / curl - 1.0).abs() < 0.03, "{}", amplitude(&curvature.points) / curl);
    let long = length(&guides[..64]);
    // Its course is changed for that of the mixed positions by a cubic, which costs little.
    assert!((length(&curvature.points) / long - 1.0).abs() < 0.01, "{}", length(&curvature.points) / long);
    assert!(length(&position.points) / long < 0.85, "{}", length(&position.points) / long);
    // And the curl's own phase lies in between: a sixth of a turn.
    let k = 20;
    let seen = curvature.points[k] - curvature.points[k + 6];
    let between: Vec<_> = curls(&[std::f64::consts::FRAC_PI_3], 0.006, 5.0, 64);
    let wanted = between[k] - between[k + 6];
    assert!(seen.angle(&wanted) < 0.15, "{}", seen.angle(&wanted));
}

#[test]
fn straight_guides_mixed_in_curvatures_are_no_worse_than_in_positions() {
    // Arcs that bend alike, their follicles' frames turned anyhow: the mean bends as they do.
    let mut guides = Vec::new();
    let mut frames = Vec::new();
    let mut seed = 9;
    for guide in 0..3 {
        let axis = Vector3::new(0.01 * f64::from(guide % 2), 0.01 * f64::from(guide / 2), 0.0);
        guides.extend((0..24).map(|k| {
            let angle = 1.2 * f64::from(k) / 23.0;
            axis + Vector3::new(1.0 - angle.cos(), 0.0, angle.sin()) * 0.2
        }));
        frames.push(UnitQuaternion::from_scaled_axis(Vector3::from_fn(|_, _| 4.0 * noise(&mut seed) - 2.0)));
    }
    let settings = RenderSettings { space: Space::Curvature, points_per_strand: 24, ..plain() };
    let samples = GuideSamples { roots: Some(&frames), ..GuideSamples::at_rest(&guides) };
    let root = Vector3::new(0.004, 0.003, 0.0);
    let pose = bind(&settings, &samples, &[root]);
    for (point, guide) in evaluate(&pose, &whole(&pose))[0].points.iter().zip(&guides) {
        assert!((point - (guide + root)).norm() < 1e-5, "{point} {guide}");
    }
}

#[test]
fn real_curls_are_kept_in_curvatures() {
    // Guides of a curly groom at the roots of every tenth, its strands at the others: the length and the size of the curls against the truth.
    let points = 48;
    let all = groom("blender_curly.hair", 1.0, 2, points);
    let strand = |k: usize| &all[k * points..(k + 1) * points];
    let count = all.len() / points;
    let guides: Vec<_> = (0..count).filter(|k| k % 3 == 0).flat_map(|k| strand(k).to_vec()).collect();
    let others: Vec<usize> = (0..count).filter(|k| k % 3 != 0).collect();
    let roots: Vec<_> = others.iter().map(|k| strand(*k)[0]).collect();
    let kept = |space| {
        let settings = RenderSettings { space, points_per_strand: points, ..plain() };
        let strands = evaluate_all(&settings, &guides, &roots);
        let turning = |points: &[Vector3<f64>]| -> f64 {
            let edges: Vec<_> = points.windows(2).map(|edge| edge[1] - edge[0]).collect();
            edges.windows(2).map(|pair| pair[0].angle(&pair[1])).sum()
        };
        let sum = |value: &dyn Fn(&[Vector3<f64>]) -> f64| {
            let made: f64 = strands.iter().map(|strand| value(&strand.points)).sum();
            made / others.iter().map(|k| value(strand(*k))).sum::<f64>()
        };
        (sum(&|points| length(points)), sum(&turning))
    };
    let (position, curvature) = (kept(Space::Position), kept(Space::Curvature));
    println!("length and turning kept: positions {position:?}, curvatures {curvature:?}");
    assert!(curvature.0 > 0.97 && curvature.0 < 1.05 && curvature.1 > 0.85, "{curvature:?}");
    assert!(position.0 < curvature.0 - 0.03 && position.1 < curvature.1 - 0.01, "{position:?} {curvature:?}");
}

#[test]
fn frames_are_orthonormal_and_along_the_strand() {
    let guides = sintel();
    let roots = roots_among(&guides, 16, 300);
    let settings = RenderSettings { curliness: 0.5, ..plain() };
    let pose = bind(&settings, &GuideSamples::at_rest(&guides), &roots);
    for strand in evaluate(&pose, &View { rotations: true, ..whole(&pose) }) {
        let mut last: Option<Vector3<f64>> = None;
        for k in 0..16 {
            let [x, y, z, w] = strand.rotations[k].map(f64::from);
            let q = nalgebra::Quaternion::new(w, x, y, z);
            assert!((q.norm() - 1.0).abs() < 1e-5);
            let rotation = UnitQuaternion::new_normalize(q);
            let way = strand.points[(k + 1).min(15)] - strand.points[k.max(1) - 1];
            assert!((rotation * Vector3::x()).angle(&way) < 2e-3);
            let n1 = rotation * Vector3::y();
            if let Some(last) = last {
                // Carried along: n1 turns no more than the strand does, plus some for the guide.
                assert!(n1.angle(&last) < 1.3, "{}", n1.angle(&last));
            }
            last = Some(n1);
        }
        assert!(strand.radii[0] > strand.radii[15] && strand.radii[15] > 0.0);
    }
}

#[test]
fn roots_go_where_the_host_says() {
    let guides = sintel();
    let roots = roots_among(&guides, 16, 100);
    let moved = |index: usize| roots[index] + Vector3::new(0.002, 0.001, index as f64 * 1e-5);
    for space in [Space::Position, Space::Curvature] {
        let settings = RenderSettings { space, ..plain() };
        let pose = bind(&settings, &GuideSamples::at_rest(&guides), &roots);
        let plain = evaluate(&pose, &whole(&pose));
        let origin = Vector3::new(0.5, 0.25, -1.0);
        let given = evaluate(&pose, &View { roots: Some(&moved), origin, ..whole(&pose) });
        for (index, (strand, plain)) in given.iter().zip(&plain).enumerate() {
            assert!((strand.points[0] + origin - moved(index)).norm() < ROUNDING);
            // The rest goes along, without curls all of it alike.
            let tip = strand.points[15] + origin - plain.points[15];
            assert!((tip - (moved(index) - roots[index])).norm() < 2.0 * ROUNDING);
        }
    }
}

#[test]
fn curves_are_resampled_uniformly_and_their_curls_measured() {
    let corner = [Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0), Vector3::new(1.0, 2.0, 0.0)];
    let values: Vec<_> = corner.iter().map(|p| p * 2.0).collect();
    let uniform = resampled(&corner, &[4], Some(&values), 7).expect("a curve");
    for (k, point) in uniform.points.iter().enumerate() {
        let s = 0.5 * k as f64;
        let wanted = if s < 1.0 { Vector3::new(s, 0.0, 0.0) } else { Vector3::new(1.0, s - 1.0, 0.0) };
        assert!((point - wanted).norm() < 1e-15);
        assert!((uniform.values.as_ref().expect("values")[k] - 2.0 * wanted).norm() < 1e-15);
    }
    let still = resampled(&[Vector3::x(); 3], &[3], None, 4).expect("a curve without length").points;
    assert_eq!(still, [Vector3::x(); 4]);
    assert_eq!(measured_curliness(&[Vector3::zeros(), Vector3::x(), Vector3::x() * 3.0]), 0.0);
    assert_eq!(measured_curliness(&curls(&[0.0], 0.01, 4.0, 64)), 1.0);
}

#[test]
fn bad_input_is_named() {
    let guides = sintel();
    let roots = roots_among(&guides, 16, 10);
    let samples = GuideSamples::at_rest(&guides);
    let refused = |result: Result<(), Error>, name: &str| match result {
        Err(Error::InvalidArgument { argument, .. }) => assert!(argument.contains(name), "{argument} in place of {name}"),
        other => panic!("{name}: {other:?}"),
    };
    type Change = fn(&mut RenderSettings);
    let changes: [(&str, Change); 26] = [
        ("points_per_strand", |s| s.points_per_strand = 1),
        ("guides_per_strand", |s| s.guides_per_strand = 5),
        ("guides_per_strand", |s| s.guides_per_strand = 0),
        ("curliness", |s| s.curliness = 1.5),
        ("curliness", |s| s.curliness = f64::NAN),
        ("max_tip_distance", |s| s.max_tip_distance = 0.0),
        ("max_tip_ratio", |s| s.max_tip_ratio = f64::NAN),
        ("wisps_per_guide", |s| s.wisps_per_guide = 0),
        ("wisp_profile[1]", |s| s.wisp_profile[1] = -1.0),
        ("frizz", |s| s.frizz = f64::INFINITY),
        ("frizz_waves", |s| s.frizz_waves = 0.0),
        ("radius", |s| s.radius = -1e-5),
        ("taper_from", |s| s.taper_from = 1.0),
        ("length_variation", |s| s.length_variation = 1.0),
        ("length_variation", |s| s.length_variation = -0.1),
        ("flatness", |s| s.flatness = 1.1),
        ("clump_noise", |s| s.clump_noise = -1.0),
        ("clump_noise_waves", |s| s.clump_noise_waves = 1001.0),
        ("flyaways", |s| s.flyaways = -0.1),
        ("flyaways", |s| s.flyaways = f64::NAN),
        ("flyaway_distance", |s| s.flyaway_distance = f64::INFINITY),
        ("taper_shape", |s| s.taper_shape = 1.0),
        ("taper_shape", |s| s.taper_shape = -1.0),
        ("clearance", |s| s.clearance = 0.0),
        ("clearance", |s| s.clearance = f64::NAN),
        ("worker_count", |s| s.workers = Workers::Pool(1)),
    ];
    for (name, change) in changes {
        let mut settings = plain();
        change(&mut settings);
        refused(RenderHair::bind(&settings, &samples, &roots).map(|_| ()), name);
    }
    let settings = plain();
    refused(RenderHair::bind(&settings, &GuideSamples::at_rest(&guides[1..]), &roots).map(|_| ()), "points (count)");
    refused(RenderHair::bind(&settings, &GuideSamples::at_rest(&[]), &roots).map(|_| ()), "points (count)");
    let mut bad = guides.clone();
    bad[17].y = f64::NAN;
    refused(RenderHair::bind(&settings, &GuideSamples::at_rest(&bad), &roots).map(|_| ()), "guides.points[17][1]");
    refused(RenderHair::bind(&settings, &samples, &[Vector3::new(0.0, 0.0, f64::INFINITY)]).map(|_| ()), "roots[0][2]");
    let frames = vec![UnitQuaternion::identity(); guides.len() / 16];
    let framed = GuideSamples { roots: Some(&frames[1..]), ..samples };
    refused(RenderHair::bind(&settings, &framed, &roots).map(|_| ()), "guides.roots (count)");

    let hair = Arc::new(RenderHair::bind(&settings, &samples, &roots).expect("a map"));
    let mut pose = RenderPose::new(hair.clone());
    let collect = |count: usize| Collect { first: 0, strands: Mutex::new(vec![None; count]) };
    refused(pose.evaluate(&whole(&pose), &collect(10)), "pose");
    refused(pose.set(&GuideSamples { roots: Some(&frames), ..samples }), "guides.roots");
    refused(pose.set(&GuideSamples::at_rest(&guides[..16])), "points (count)");
    pose.set(&samples).expect("a pose");
    refused(pose.evaluate(&View { first: 11, ..whole(&pose) }, &collect(10)), "first");
    refused(pose.evaluate(&View { first: 1, ..whole(&pose) }, &collect(10)), "count");
    refused(pose.evaluate(&View { origin: Vector3::repeat(f64::NAN), ..whole(&pose) }, &collect(10)), "origin[0]");
    refused(pose.evaluate(&View { motion: Motion::Guides, ..whole(&pose) }, &collect(10)), "pose");
    let nowhere = |_: usize| Vector3::repeat(f64::NAN);
    refused(pose.evaluate(&View { roots: Some(&nowhere), ..whole(&pose) }, &collect(10)), "roots[0]");
    let since = |before, seconds| Motion::Since { before, seconds, roots: None };
    refused(pose.evaluate(&View { motion: since(&pose, 0.0), ..whole(&pose) }, &collect(10)), "seconds");
    let other = RenderPose::new(Arc::new(RenderHair::bind(&settings, &samples, &roots).expect("a map")));
    refused(pose.evaluate(&View { motion: since(&other, 0.1), ..whole(&pose) }, &collect(10)), "before");
    let unset = RenderPose::new(hair);
    refused(pose.evaluate(&View { motion: since(&unset, 0.1), ..whole(&pose) }, &collect(10)), "before");
}
