//! Scatters follicles over a scalp as blue noise of a given density.
//!
//! The distance of two places is their straight distance d, lengthened by how the scalp's normals n₁, n₂ turn along the direction
//! v between them (Bowers, Wang, Wei and Maletz 2010): d (asin c₁ − asin c₂)/(c₁ − c₂), cᵢ = nᵢ·v; on a sphere that is the length
//! of the arc. Places whose normals are more than a right angle apart (the two sides of an ear) are not neighbours. With a
//! density of ρ, relative to the largest, distances count times √ρ of the denser place of the two.

use nalgebra::Vector3;

use super::density::Density;
use super::elimination::{Neighbours, Until, survivors};
use super::frames::Field;
use super::{Follicle, Scalp, double_area};
use crate::error::{Error, Result, check_positive};
use crate::math::point_tree::PointTree;
use crate::math::random::Seeded;
use crate::math::rotation::arc_tangent;

/// Most follicles per call.
pub const MAX_FOLLICLES: usize = 10_000_000;
/// Candidates per follicle.
const CANDIDATES: f64 = 5.0;
/// Attempts per candidate before the density is rejected.
const TRIES: u64 = 2000;
/// Yuksel's limit of weights: r_min = β r_max (1 − (N/M)^γ).
const BETA: f64 = 0.65;

/// How many follicles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// This many, as far from each other as possible.
    Count(usize),
    /// As many as fit (of those tried) without two being closer to each other than this, m; farther where the density is lower.
    Spacing(f64),
}

/// Options of scattering.
///
/// ```
/// use superhelix::hair::{Amount, Density, Scalp, ScatterOptions};
/// use superhelix::nalgebra::Vector3;
///
/// // A square of 10 cm, and 300 follicles on it, denser towards x = 0.
/// let corners = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)].map(|(x, y)| Vector3::new(x, y, 0.0));
/// let scalp = Scalp::new(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]], None, Vector3::x())?;
///
/// let density = Density::Vertices(vec![1.0, 0.2, 0.2, 1.0]);
/// let scattered = scalp.scatter(&ScatterOptions { amount: Amount::Count(300), density, seed: 1 })?;
/// assert_eq!(scattered.follicles.len(), 300);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ScatterOptions {
    /// How many.
    pub amount: Amount,
    /// Relative density.
    pub density: Density,
    /// Seed.
    pub seed: u64,
}

/// Scattered follicles.
#[derive(Debug, Clone, PartialEq)]
pub struct Scattered {
    /// In no particular order.
    pub follicles: Vec<Follicle>,
    /// The least distance of two of them, in this module's measure (where the density is the largest: the distance along the
    /// scalp), m; infinite if no two are neighbours.
    pub least_distance: f64,
}

/// The lower 21 bits, each followed by two zeros: three such numbers make a Morton code.
fn spread(number: u64) -> u64 {
    let mut bits = number & 0x1f_ffff;
    for (shift, mask) in [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ] {
        bits = (bits | bits << shift) & mask;
    }
    bits
}

/// Candidates, and the data for their distances.
struct Candidates {
    follicles: Vec<Follicle>,
    places: Vec<Vector3<f64>>,
    normals: Vec<Vector3<f64>>,
    /// √ρ.
    roots: Vec<f64>,
    /// The original index of each.
    numbers: Vec<u32>,
    /// The fraction of random places that the density accepted.
    passed: f64,
}

impl Candidates {
    fn new(scalp: &Scalp, density: &Density, seed: u64, count: usize) -> Result<Self> {
        let numbers = [5, 6, 7, 8].map(|purpose| Seeded::new(seed, purpose));
        let mut areas = Vec::with_capacity(scalp.triangles.len());
        let mut area = 0.0;
        for triangle in &scalp.triangles {
            area += double_area(&scalp.vertices, triangle).norm();
            areas.push(area);
        }
        let field = Field::new(scalp, &scalp.vertices);
        let most = density.most();
        let mut made = Self {
            follicles: Vec::new(),
            places: Vec::new(),
            normals: Vec::new(),
            roots: Vec::new(),
            numbers: Vec::new(),
            passed: 1.0,
        };
        let mut tries = 0;
        while made.follicles.len() < count {
            // If nothing is found, no more attempts are made for many follicles than for few.
            let wanted = if made.follicles.is_empty() { 0 } else { count as u64 };
            if tries >= TRIES * (wanted + 100) {
                let value = format!("above zero on less than {:.0e} of the scalp", 1.0 / TRIES as f64);
                return Err(Error::invalid("density", value, "a density that is above zero on more of it"));
            }
            let [at, first, second, chance] = numbers.map(|numbers| numbers.unit(tries));
            tries += 1;
            let triangle = areas.partition_point(|sum| *sum <= at * area).min(areas.len() - 1);
            // Uniform over the triangle (Turk 1990).
            let root = first.sqrt();
            let follicle = Follicle { triangle: triangle as u32, shares: [root * (1.0 - second), root * second] };
            let fraction = density.at(scalp, &follicle) / most;
            if fraction <= chance {
                continue;
            }
            made.places.push(scalp.place(&follicle));
            made.normals.push(field.normal(scalp, &scalp.vertices, &follicle));
            made.roots.push(fraction.sqrt());
            made.numbers.push(made.follicles.len() as u32);
            made.follicles.push(follicle);
        }
        if tries > 0 {
            made.passed = count as f64 / tries as f64;
        }
        Ok(made.near_by_near())
    }

    /// Sorted so that neighbours on the scalp are neighbours in memory: the neighbour lists are far larger than the caches.
    fn near_by_near(&self) -> Self {
        let mut low = Vector3::repeat(f64::INFINITY);
        let mut high = -low;
        for place in &self.places {
            (low, high) = (low.inf(place), high.sup(place));
        }
        let scale = f64::from(1_u32 << 21) * (1.0 - f64::EPSILON) / (high - low).amax().max(f64::MIN_POSITIVE);
        let code =
            |place: &Vector3<f64>| (0..3).fold(0, |code, axis| code | spread(((place[axis] - low[axis]) * scale) as u64) << axis);
        let mut order: Vec<(u64, usize)> = self.places.iter().enumerate().map(|(index, place)| (code(place), index)).collect();
        order.sort_unstable();
        let order: Vec<usize> = order.into_iter().map(|(_, index)| index).collect();
        self.these(&order)
    }

    /// Some of them, in this order.
    fn these(&self, indices: &[usize]) -> Self {
        fn of<T: Copy>(list: &[T], indices: &[usize]) -> Vec<T> {
            indices.iter().map(|index| list[*index]).collect()
        }
        Self {
            follicles: of(&self.follicles, indices),
            places: of(&self.places, indices),
            normals: of(&self.normals, indices),
            roots: of(&self.roots, indices),
            numbers: of(&self.numbers, indices),
            passed: self.passed,
        }
    }

    /// Those that stay.
    fn only(&self, stays: &[bool]) -> Self {
        let indices: Vec<usize> = (0..stays.len()).filter(|index| stays[*index]).collect();
        self.these(&indices)
    }

    /// The distance of two candidates along the scalp; `None` if they are on different sides of it.
    fn distance(&self, a: usize, b: usize) -> Option<f64> {
        if self.normals[a].dot(&self.normals[b]) < 0.0 {
            return None;
        }
        let offset = self.places[b] - self.places[a];
        let straight = offset.norm();
        if straight <= 0.0 {
            return Some(0.0);
        }
        let [c1, c2] = [a, b].map(|index| (self.normals[index].dot(&offset) / straight).clamp(-1.0, 1.0));
        let cosine = |sine: f64| (1.0 - sine * sine).max(0.0).sqrt();
        let arc_sine = |sine: f64| {
            let angle = arc_tangent(sine.abs(), cosine(sine));
            if sine < 0.0 { -angle } else { angle }
        };
        let factor = if (c1 - c2).abs() < 1e-4 {
            // The limit for a path of constant slope.
            1.0 / cosine(0.5 * (c1 + c2)).max(1e-3)
        } else {
            (arc_sine(c1) - arc_sine(c2)) / (c1 - c2)
        };
        Some(straight * factor)
    }

    /// All pairs closer than `reach` in the measure of densities, with their distances relative to it.
    fn pairs(&self, reach: f64) -> Vec<(u32, u32, f32)> {
        let tree = PointTree::new(&self.places);
        let mut pairs = Vec::new();
        for a in 0..self.places.len() {
            let denser = (self.roots[a], a);
            tree.within(self.places[a], reach / self.roots[a], |b, _| {
                let b = b as usize;
                // Each pair from its denser candidate, whose reach is the shorter.
                if (self.roots[b], b) >= denser {
                    return;
                }
                if let Some(distance) = self.distance(a, b)
                    && distance * self.roots[a] < reach
                {
                    pairs.push((a as u32, b as u32, (distance * self.roots[a] / reach) as f32));
                }
            });
        }
        pairs
    }
}

impl Scalp {
    /// Scatters follicles over the scalp at rest. The same seed gives the same follicles. Takes some 20 µs per follicle, 30 µs
    /// for a hundred and fifty thousand or with a spacing.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a density that does not match the scalp, is negative, or is zero nearly everywhere; a
    /// spacing that is not above zero; or more than [`MAX_FOLLICLES`].
    pub fn scatter(&self, options: &ScatterOptions) -> Result<Scattered> {
        options.density.check(self)?;
        let area = self.area();
        // A plane is packed closest by N disks of radius r = sqrt(A / (2 sqrt(3) N)).
        let packing = 2.0 * 3.0_f64.sqrt();
        let (count, wanted) = match options.amount {
            Amount::Count(count) => ((CANDIDATES * count as f64).ceil(), count),
            Amount::Spacing(spacing) => {
                check_positive(|| "spacing".into(), spacing)?;
                ((CANDIDATES * area / (packing * (0.5 * spacing).powi(2))).ceil().max(100.0), 0)
            }
        };
        if count > CANDIDATES * MAX_FOLLICLES as f64 {
            let (argument, value) = match options.amount {
                Amount::Count(count) => ("count", count as f64),
                Amount::Spacing(spacing) => ("spacing", spacing),
            };
            return Err(Error::invalid(argument, value, format!("what gives at most {MAX_FOLLICLES} follicles")));
        }
        let candidates = Candidates::new(self, &options.density, options.seed, count as usize)?;
        let (reach, until, least) = match options.amount {
            Amount::Count(0) => return Ok(Scattered { follicles: Vec::new(), least_distance: f64::INFINITY }),
            Amount::Count(wanted) => {
                let radius = (candidates.passed * area / (packing * wanted as f64)).sqrt();
                // γ = 1.5 of Yuksel's N/M = 1/5.
                let ratio: f64 = 1.0 / CANDIDATES;
                (2.0 * radius, Until::Left(wanted), BETA * (1.0 - ratio * ratio.sqrt()))
            }
            Amount::Spacing(spacing) => (spacing, Until::Apart, 0.0),
        };
        let pairs = candidates.pairs(reach);
        let stays = survivors(&Neighbours::new(candidates.follicles.len(), &pairs), until, least);
        debug_assert!(wanted == 0 || stays.iter().filter(|stays| **stays).count() == wanted);
        let left = candidates.only(&stays);
        // The remaining ones may be farther apart than the distances that decided.
        let reach = 2.0 * reach;
        let nearest = left.pairs(reach).iter().map(|(_, _, distance)| f64::from(*distance)).fold(f64::INFINITY, f64::min);
        let least_distance = if nearest.is_finite() { nearest * reach } else { f64::INFINITY };
        let mut follicles: Vec<(u32, Follicle)> = left.numbers.iter().copied().zip(left.follicles).collect();
        follicles.sort_unstable_by_key(|(number, _)| *number);
        Ok(Scattered { follicles: follicles.into_iter().map(|(_, follicle)| follicle).collect(), least_distance })
    }
}
