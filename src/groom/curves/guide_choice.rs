//! Chooses a few curves of a groom as guides: those from which the others can best be interpolated, as measured.
//!
//! Several ways are tried: at random, as far from each other as possible, and the middles of groups of similar curves (Lloyd's
//! iteration on roots and shapes, with different weights of the roots). The way with the least distance between curves and render
//! strands at their roots is improved by exchanging guides that serve few curves for curves that are served worst.

use std::sync::{Arc, Mutex};

use nalgebra::Vector3;

use crate::error::{Error, Result};
use crate::groom::render_hair::{GuideSamples, RenderHair, RenderPose, RenderSettings, StrandPoints, StrandSink, View};
use crate::math::random::Seeded;
use crate::workers::{WorkerSet, Workers};

/// Points at which curves are compared, the root left out; a divisor of the points of a curve less one.
const STATIONS: usize = 5;
/// Numbers that describe a curve: its root, and those points relative to it.
const FEATURES: usize = 3 * (STATIONS + 1);
/// Rounds of Lloyd's iteration, and of exchanges.
const ROUNDS: usize = 12;
const EXCHANGES: usize = 24;
/// The part of the guides that is exchanged at first.
const EXCHANGED: f64 = 0.1;
/// How much roots count, relative to the mean square of the shapes' points.
const ROOT_WEIGHTS: [f64; 3] = [0.5, 1.0, 3.0];

/// How guides were chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ChoiceWay {
    /// At random.
    Random,
    /// Each as far from the others as possible.
    Farthest,
    /// Middles of groups of similar curves.
    Groups,
    /// The best of these, improved by exchanges.
    Exchanged,
}

impl ChoiceWay {
    /// A short name: "random", "farthest", "groups", "exchanged".
    pub fn name(self) -> &'static str {
        match self {
            ChoiceWay::Random => "random",
            ChoiceWay::Farthest => "farthest",
            ChoiceWay::Groups => "groups",
            ChoiceWay::Exchanged => "exchanged",
        }
    }
}

/// How far curves are from render strands that grow at their roots, guides left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Represented {
    /// Root mean square over all points of all curves, m.
    pub rms: f64,
    /// The root mean square distance of a curve that 95 of 100 do not exceed, m.
    pub p95: f64,
    /// That of the curve that is served worst, m.
    pub worst: f64,
}

/// Guides of a groom.
#[derive(Debug, Clone, PartialEq)]
pub struct GuideChoice {
    /// Indices of the curves, ascending.
    pub guides: Vec<usize>,
    /// How they were chosen.
    pub way: ChoiceWay,
    /// How well they represent the others.
    pub represented: Represented,
    /// What each way came to.
    pub tried: Vec<(ChoiceWay, Represented)>,
}

/// The curves of a groom, to choose guides among.
#[derive(Debug)]
pub struct GuideCandidates<'a> {
    points: &'a [Vector3<f64>],
    settings: RenderSettings,
    features: Vec<[f32; FEATURES]>,
}

/// Receives the points of render strands.
struct Points {
    per_strand: usize,
    points: Mutex<Vec<[f32; 3]>>,
}

impl StrandSink for Points {
    fn take(&self, strand: &StrandPoints<'_>) {
        let [x, y, z] = strand.positions;
        if let Ok(mut points) = self.points.lock() {
            let places = &mut points[strand.strand * self.per_strand..][..self.per_strand];
            places.iter_mut().enumerate().for_each(|(k, place)| *place = [x[k], y[k], z[k]]);
        }
    }
}

/// The settings under which render strands are interpolated from their guides alone: without wisps, straying and cut tips.
pub fn interpolated_alone(points_per_strand: usize, workers: Workers) -> RenderSettings {
    RenderSettings {
        points_per_strand,
        curliness: 0.0,
        wisps_per_guide: 1,
        flyaways: 0.0,
        frizz: 0.0,
        length_variation: 0.0,
        workers,
        ..RenderSettings::default()
    }
}

impl<'a> GuideCandidates<'a> {
    /// From curves of `points_per_strand` points each (m, curve after curve, root first, equal arclengths apart).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for numbers of points that do not go together, fewer than 6 points per strand, or a number of
    /// workers out of range.
    pub fn new(points: &'a [Vector3<f64>], points_per_strand: usize, workers: Workers) -> Result<Self> {
        if points_per_strand <= STATIONS {
            return Err(Error::invalid("points_per_strand", points_per_strand, format!("{} or more", STATIONS + 1)));
        }
        if points.is_empty() || !points.len().is_multiple_of(points_per_strand) {
            let expected = format!("{points_per_strand} for each of at least one curve");
            return Err(Error::invalid("points (count)", points.len(), expected));
        }
        workers.check("workers")?;
        let settings = interpolated_alone(points_per_strand, workers);
        let feature = |curve: &[Vector3<f64>]| {
            let mut numbers = [0.0; FEATURES];
            for station in 0..=STATIONS {
                let point = curve[station * (points_per_strand - 1) / STATIONS];
                let place = if station == 0 { point } else { point - curve[0] };
                for axis in 0..3 {
                    numbers[3 * station + axis] = place[axis] as f32;
                }
            }
            numbers
        };
        Ok(Self { points, settings, features: points.chunks_exact(points_per_strand).map(feature).collect() })
    }

    /// Number of curves.
    pub fn count(&self) -> usize {
        self.features.len()
    }

    /// How well these guides represent the other curves. If all are guides, every distance is 0.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for no guides, an index out of range, or points that are not finite.
    pub fn represented(&self, guides: &[usize]) -> Result<Represented> {
        Ok(self.distances(guides)?.1)
    }

    /// Render strands at the roots of all curves, interpolated from these guides: as many points as the curves have, m.
    ///
    /// # Errors
    /// As [`GuideCandidates::represented`].
    pub fn interpolated(&self, guides: &[usize]) -> Result<Vec<[f32; 3]>> {
        let per_strand = self.settings.points_per_strand;
        if let Some(guide) = guides.iter().find(|guide| **guide >= self.count()) {
            return Err(Error::invalid("guides", guide, format!("indices below {}", self.count())));
        }
        let rest: Vec<_> = guides.iter().flat_map(|guide| &self.points[guide * per_strand..][..per_strand]).copied().collect();
        let roots: Vec<_> = self.points.iter().step_by(per_strand).copied().collect();
        let samples = GuideSamples::at_rest(&rest);
        let hair = Arc::new(RenderHair::bind(&self.settings, &samples, &roots)?);
        let mut pose = RenderPose::new(hair.clone());
        pose.set(&samples)?;
        let sink = Points { per_strand, points: Mutex::new(vec![[0.0; 3]; self.points.len()]) };
        pose.evaluate(&View::whole(&hair), &sink)?;
        Ok(sink.points.into_inner().unwrap_or_default())
    }

    /// Mean square distance of each curve, and what they come to.
    fn distances(&self, guides: &[usize]) -> Result<(Vec<f64>, Represented)> {
        let per_strand = self.settings.points_per_strand;
        let made = self.interpolated(guides)?;
        let square = |(made, drawn): (&[[f32; 3]], &[Vector3<f64>])| {
            let squares = made.iter().zip(drawn).map(|(made, drawn)| (Vector3::from(made.map(f64::from)) - drawn).norm_squared());
            squares.sum::<f64>() / per_strand as f64
        };
        let mut squares: Vec<f64> = made.chunks_exact(per_strand).zip(self.points.chunks_exact(per_strand)).map(square).collect();
        for guide in guides {
            squares[*guide] = 0.0;
        }
        let others = (self.count() - guides.len()).max(1);
        let mut sorted = squares.clone();
        sorted.sort_by(f64::total_cmp);
        // Guides have 0 and come first.
        let served = &sorted[sorted.len() - others.min(sorted.len())..];
        let represented = Represented {
            rms: (served.iter().sum::<f64>() / others as f64).sqrt(),
            p95: served[(served.len() - 1) * 95 / 100].sqrt(),
            worst: served[served.len() - 1].sqrt(),
        };
        Ok((squares, represented))
    }

    /// So many guides, all curves if there are no more. `seed` decides what is random. The result does not depend on the number of
    /// workers. Costs some 60 evaluations of the render hair, and Lloyd's iteration: the number of curves times that of guides.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for no guides or points that are not finite.
    pub fn choose(&self, guides: usize, seed: u64) -> Result<GuideChoice> {
        if guides == 0 {
            return Err(Error::invalid("guides", guides, "one or more"));
        }
        let count = self.count();
        if guides >= count {
            let all: Vec<usize> = (0..count).collect();
            let represented = self.represented(&all)?;
            return Ok(GuideChoice { guides: all, way: ChoiceWay::Random, represented, tried: Vec::new() });
        }
        let mut found = vec![(ChoiceWay::Random, self.at_random(guides, seed)), (ChoiceWay::Farthest, self.farthest(guides))];
        for weight in ROOT_WEIGHTS {
            found.push((ChoiceWay::Groups, self.groups(guides, weight, seed)?));
        }
        let mut tried = Vec::new();
        let mut best: Option<GuideChoice> = None;
        for (way, guides) in found {
            let represented = self.represented(&guides)?;
            tried.push((way, represented));
            if best.as_ref().is_none_or(|best| represented.rms < best.represented.rms) {
                best = Some(GuideChoice { guides, way, represented, tried: Vec::new() });
            }
        }
        let Some(mut best) = best else { return Err(Error::invalid("guides", guides, "one or more")) };
        self.exchange(&mut best)?;
        if best.way == ChoiceWay::Exchanged {
            tried.push((ChoiceWay::Exchanged, best.represented));
        }
        Ok(GuideChoice { tried, ..best })
    }

    /// Different curves, at random.
    fn at_random(&self, guides: usize, seed: u64) -> Vec<usize> {
        let numbers = Seeded::new(seed, 31);
        let mut order: Vec<usize> = (0..self.count()).collect();
        order.sort_by_key(|index| (numbers.bits(*index as u64), *index));
        order.truncate(guides);
        order.sort_unstable();
        order
    }

    /// Curves as far from each other as possible, roots and shapes counted alike (Gonzalez 1985).
    fn farthest(&self, guides: usize) -> Vec<usize> {
        let mut nearest = vec![f32::INFINITY; self.count()];
        let mut chosen = vec![0];
        while chosen.len() < guides {
            let last = self.features[chosen[chosen.len() - 1]];
            let mut far = (0, -1.0);
            for (index, (nearest, feature)) in nearest.iter_mut().zip(&self.features).enumerate() {
                *nearest = nearest.min(squared(feature, &last, 1.0));
                if *nearest > far.1 {
                    far = (index, *nearest);
                }
            }
            // Where all others are curves that are chosen already, the next one of them.
            chosen.push(if far.1 > 0.0 { far.0 } else { (0..self.count()).find(|index| !chosen.contains(index)).unwrap_or(0) });
        }
        chosen.sort_unstable();
        chosen.dedup();
        chosen
    }

    /// The middles of groups of similar curves: of each group, the curve nearest to its mean.
    fn groups(&self, guides: usize, weight: f64, seed: u64) -> Result<Vec<usize>> {
        let weight = (STATIONS as f64 * weight) as f32;
        let workers = WorkerSet::<()>::new(&self.settings.workers)?;
        let mut means: Vec<[f32; FEATURES]> = self.at_random(guides, seed).iter().map(|guide| self.features[*guide]).collect();
        let mut groups: Vec<(usize, u32, f32)> = (0..self.count()).map(|index| (index, 0, 0.0)).collect();
        for _ in 0..ROUNDS {
            workers.for_each(&mut groups, |(index, group, distance), ()| {
                (*group, *distance) = nearest(&self.features[*index], &means, weight);
            });
            let mut sums = vec![([0.0_f64; FEATURES], 0_u32); guides];
            for (index, group, _) in &groups {
                let (sum, count) = &mut sums[*group as usize];
                sum.iter_mut().zip(&self.features[*index]).for_each(|(sum, number)| *sum += f64::from(*number));
                *count += 1;
            }
            // An empty group takes the curve that is farthest from its own mean.
            let mut far: Vec<(f32, usize)> = groups.iter().map(|(index, _, distance)| (*distance, *index)).collect();
            far.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            let mut far = far.into_iter();
            for (mean, (sum, count)) in means.iter_mut().zip(sums) {
                match (count, far.as_slice().first()) {
                    (0, Some((_, index))) => {
                        *mean = self.features[*index];
                        far.next();
                    }
                    _ => *mean = sum.map(|sum| (sum / f64::from(count.max(1))) as f32),
                }
            }
        }
        workers.for_each(&mut groups, |(index, group, distance), ()| {
            (*group, *distance) = nearest(&self.features[*index], &means, weight);
        });
        let mut middles: Vec<Option<(f32, usize)>> = vec![None; guides];
        for (index, group, distance) in &groups {
            let middle = &mut middles[*group as usize];
            if middle.is_none_or(|(nearest, _)| *distance < nearest) {
                *middle = Some((*distance, *index));
            }
        }
        let mut chosen: Vec<usize> = middles.into_iter().flatten().map(|(_, index)| index).collect();
        // Groups that are empty in the end leave room for curves that are far from the means.
        groups.sort_by(|a, b| b.2.total_cmp(&a.2).then(a.0.cmp(&b.0)));
        let mut taken = vec![false; self.count()];
        chosen.iter().for_each(|index| taken[*index] = true);
        chosen.extend(groups.iter().map(|(index, _, _)| *index).filter(|index| !taken[*index]).take(guides - chosen.len()));
        chosen.sort_unstable();
        Ok(chosen)
    }

    /// Exchanges guides that serve little for curves that are served badly, as long as that helps.
    fn exchange(&self, choice: &mut GuideChoice) -> Result<()> {
        let guides = choice.guides.len();
        let mut number = ((guides as f64 * EXCHANGED) as usize).clamp(1, guides);
        let mut squares = self.distances(&choice.guides)?.0;
        for _ in 0..EXCHANGES {
            let next = self.exchanged(&choice.guides, &squares, number);
            let (next_squares, represented) = self.distances(&next)?;
            if represented.rms < choice.represented.rms {
                (choice.guides, choice.represented, choice.way) = (next, represented, ChoiceWay::Exchanged);
                squares = next_squares;
            } else if number == 1 {
                break;
            } else {
                number = number.div_ceil(2).min(number - 1);
            }
        }
        Ok(())
    }

    /// The guides with `number` of them exchanged.
    fn exchanged(&self, guides: &[usize], squares: &[f64], number: usize) -> Vec<usize> {
        // What a guide serves: the curves nearest to it, and how much worse the guide next to it would serve it.
        let means: Vec<[f32; FEATURES]> = guides.iter().map(|guide| self.features[*guide]).collect();
        let mut worth: Vec<(f64, usize)> = guides.iter().map(|guide| (0.0, *guide)).collect();
        let groups: Vec<usize> = self.features.iter().map(|feature| nearest(feature, &means, 1.0).0 as usize).collect();
        for group in &groups {
            worth[*group].0 += 1.0;
        }
        for (own, (worth, _)) in worth.iter_mut().enumerate() {
            let others = means.iter().enumerate().filter(|(other, _)| *other != own);
            let next = others.map(|(_, mean)| squared(mean, &means[own], 1.0)).fold(f32::INFINITY, f32::min);
            *worth *= f64::from(next);
        }
        worth.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let leaving: Vec<usize> = worth.iter().take(number).map(|(_, guide)| *guide).collect();
        // What comes: curves served worst, each of another group.
        let mut worst: Vec<usize> = (0..squares.len()).collect();
        worst.sort_by(|a, b| squares[*b].total_cmp(&squares[*a]).then(a.cmp(b)));
        let mut used = vec![false; guides.len()];
        let mut next: Vec<usize> = guides.iter().copied().filter(|guide| !leaving.contains(guide)).collect();
        for index in worst {
            if next.len() == guides.len() {
                break;
            }
            if !used[groups[index]] && squares[index] > 0.0 {
                used[groups[index]] = true;
                next.push(index);
            }
        }
        next.extend(leaving.into_iter().take(guides.len() - next.len()));
        next.sort_unstable();
        next.dedup();
        next
    }
}

/// The squared distance of curves: mean over the points of their shapes, and the roots so many times.
fn squared(a: &[f32; FEATURES], b: &[f32; FEATURES], weight: f32) -> f32 {
    let mut sums = [0.0; 2];
    for (k, (a, b)) in a.iter().zip(b).enumerate() {
        sums[usize::from(k >= 3)] += (a - b) * (a - b);
    }
    weight * sums[0] + sums[1]
}

/// The nearest of some curves.
fn nearest(feature: &[f32; FEATURES], means: &[[f32; FEATURES]], weight: f32) -> (u32, f32) {
    let mut best = (0, f32::INFINITY);
    for (index, mean) in means.iter().enumerate() {
        let distance = squared(feature, mean, weight);
        if distance < best.1 {
            best = (index as u32, distance);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: usize = 16;

    /// Curves on a patch of 10 cm: left of a parting they hang to the left, right of it to the right; a tuft stands up.
    fn groom() -> Vec<Vector3<f64>> {
        let numbers = Seeded::new(5, 1);
        let curve = |k: u64| {
            let root = Vector3::new(0.1 * numbers.unit(3 * k) - 0.05, 0.1 * numbers.unit(3 * k + 1), 0.0);
            let length = 0.08 + 0.02 * numbers.unit(3 * k + 2);
            let side = if root.x < 0.0 { -1.0 } else { 1.0 };
            let tuft = (root - Vector3::new(0.02, 0.07, 0.0)).norm() < 0.008;
            (0..POINTS).map(move |p| {
                let s = length * p as f64 / (POINTS - 1) as f64;
                root + if tuft { Vector3::z() * s } else { Vector3::new(side * s * 0.8, 0.2 * s, -0.56 * s) }
            })
        };
        (0..800).flat_map(curve).collect()
    }

    #[test]
    fn chosen_guides_represent_better_than_random_ones_and_more_better_than_few() {
        let points = groom();
        let candidates = GuideCandidates::new(&points, POINTS, Workers::Serial).expect("curves");
        let mut before = f64::INFINITY;
        for guides in [10, 40, 160] {
            let choice = candidates.choose(guides, 7).expect("guides");
            assert_eq!(choice.guides.len(), guides);
            assert!(choice.guides.is_sorted_by(|a, b| a < b));
            let (way, random) = choice.tried[0];
            assert_eq!(way, ChoiceWay::Random);
            println!("{guides}: {} {:.3e}, random {:.3e}", choice.way.name(), choice.represented.rms, random.rms);
            assert!(choice.represented.rms < 0.8 * random.rms && choice.represented.rms < before);
            assert_eq!(choice.represented, candidates.represented(&choice.guides).expect("guides"));
            before = choice.represented.rms;
        }
    }

    #[test]
    fn the_choice_does_not_depend_on_workers_and_bad_numbers_are_refused() {
        let points = groom();
        let choose = |workers| GuideCandidates::new(&points, POINTS, workers).expect("curves").choose(30, 1).expect("guides");
        assert_eq!(choose(Workers::Serial), choose(Workers::Pool(3)));
        let candidates = GuideCandidates::new(&points, POINTS, Workers::Serial).expect("curves");
        assert!(candidates.choose(0, 0).is_err() && candidates.represented(&[800]).is_err());
        assert_eq!(candidates.choose(5000, 0).expect("guides").guides.len(), 800);
        assert!(GuideCandidates::new(&points[..17], POINTS, Workers::Serial).is_err());
        assert!(GuideCandidates::new(&points, 5, Workers::Serial).is_err());
    }

    #[test]
    fn curves_that_are_all_alike_give_as_many_guides_as_asked_for() {
        let one = groom()[..POINTS].to_vec();
        let points: Vec<_> = (0..20).flat_map(|_| one.clone()).collect();
        let candidates = GuideCandidates::new(&points, POINTS, Workers::Serial).expect("curves");
        let choice = candidates.choose(6, 0).expect("guides");
        assert_eq!(choice.guides.len(), 6);
        assert!(choice.represented.worst < 1e-6);
    }
}
