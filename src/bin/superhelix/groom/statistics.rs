//! Numbers about a groom: lengths, turning, what is degenerate, and what its unit may be.

use serde::Serialize;
use superhelix::io::Curves;

/// How some quantity is spread over the strands.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// Smallest.
    pub min: f64,
    /// A tenth lies below.
    pub p10: f64,
    /// Half lies below.
    pub median: f64,
    /// Nine tenths lie below.
    pub p90: f64,
    /// Ninety-nine of a hundred lie below.
    pub p99: f64,
    /// Largest.
    pub max: f64,
}

/// The value below which such a share of ascending values lies, by nearest rank; of at least one.
pub fn ranked(ascending: &[f64], share: f64) -> f64 {
    ascending[((ascending.len() - 1) as f64 * share).round() as usize]
}

impl Spread {
    /// Of at least one value; by nearest rank.
    pub fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let at = |share: f64| ranked(&values, share);
        let (min, max) = (*values.first()?, *values.last()?);
        Some(Self { min, p10: at(0.1), median: at(0.5), p90: at(0.9), p99: at(0.99), max })
    }
}

/// A guess of what a unit of the file is. Files do not say; this looks at sizes only.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScaleGuess {
    /// Metres a unit.
    pub metres_per_unit: f64,
    /// Why.
    pub because: String,
}

/// What can be said about a groom.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GroomStatistics {
    /// Number of strands.
    pub strands: usize,
    /// Number of points.
    pub points: usize,
    /// Points a strand.
    pub points_per_strand: Option<Spread>,
    /// Length a strand, file units.
    pub length: Option<Spread>,
    /// Sum of the angles between successive edges of a strand, degrees; edges without length are passed over.
    pub turning_degrees: Option<Spread>,
    /// Smallest coordinates, file units.
    pub box_min: Option<[f32; 3]>,
    /// Largest coordinates, file units.
    pub box_max: Option<[f32; 3]>,
    /// Strands whose points all coincide: nothing can be fitted to them.
    pub strands_without_length: usize,
    /// Strands shorter than a thousandth of the median length.
    pub strands_very_short: usize,
    /// Edges between two equal points.
    pub edges_without_length: usize,
    /// A guess, not a fact.
    pub scale_guess: Option<ScaleGuess>,
}

/// The edges of a strand.
fn edges(strand: &[[f32; 3]]) -> impl Iterator<Item = nalgebra::Vector3<f64>> + '_ {
    strand
        .windows(2)
        .map(|pair| nalgebra::Vector3::from(pair[1].map(f64::from)) - nalgebra::Vector3::from(pair[0].map(f64::from)))
}

/// Sum of the angles between successive edges, degrees.
fn turning(strand: &[[f32; 3]]) -> f64 {
    let edges: Vec<_> = edges(strand).filter(|edge| edge.norm() > 0.0).collect();
    edges.windows(2).map(|pair| pair[0].angle(&pair[1]).to_degrees()).sum()
}

impl GroomStatistics {
    /// Of a groom as it was read.
    pub fn of(curves: &Curves) -> Self {
        let lengths: Vec<f64> = curves.strands().map(|strand| edges(strand).map(|edge| edge.norm()).sum()).collect();
        let length = Spread::of(lengths.clone());
        let short = length.map_or(0.0, |length| length.median / 1000.0);
        let bounds = (curves.point_count() > 0).then(|| curves.bounding_box());
        Self {
            strands: curves.strand_count(),
            points: curves.point_count(),
            points_per_strand: Spread::of(curves.counts().iter().map(|count| f64::from(*count)).collect()),
            length,
            turning_degrees: Spread::of(curves.strands().map(turning).collect()),
            box_min: bounds.map(|bounds| bounds.0),
            box_max: bounds.map(|bounds| bounds.1),
            strands_without_length: lengths.iter().filter(|length| **length == 0.0).count(),
            strands_very_short: lengths.iter().filter(|length| **length > 0.0 && **length < short).count(),
            edges_without_length: curves.strands().map(|strand| edges(strand).filter(|edge| edge.norm() == 0.0).count()).sum(),
            scale_guess: length.and_then(|length| guess_scale(curves, length)),
        }
    }
}

/// Whether a strand of this length in metres could grow on a head or a body.
pub fn is_plausible_length(metres: f64) -> bool {
    (0.005..=1.2).contains(&metres)
}

/// Roots of a head of hair spread over about this length, m: the diagonal of their box on the heads of real grooms.
const HEAD_SPREAD: f64 = 0.28;

/// Units that people model in, metres each.
const USUAL_UNITS: [(f64, &str); 4] = [(1.0, "a metre"), (0.01, "a centimetre"), (0.0254, "an inch"), (0.001, "a millimetre")];

/// A usual unit at which roots and strands have the sizes of a head of hair; metres before all others, since that is what
/// careful tools write; else the unit that makes the roots spread as on a head; else the usual unit that is least absurd.
fn guess_scale(curves: &Curves, length: Spread) -> Option<ScaleGuess> {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for strand in curves.strands() {
        for axis in 0..3 {
            low[axis] = low[axis].min(f64::from(strand[0][axis]));
            high[axis] = high[axis].max(f64::from(strand[0][axis]));
        }
    }
    let spread = (0..3).map(|axis| (high[axis] - low[axis]).powi(2)).sum::<f64>().sqrt();
    let fits = |metres: f64| is_plausible_length(length.median * metres) && length.max * metres <= 2.0;
    let like_a_head = |metres: f64| (0.6..=1.7).contains(&(spread * metres / HEAD_SPREAD));
    let guess = |metres: f64, unit: &str| ScaleGuess {
        metres_per_unit: metres,
        because: format!(
            "with a unit of {unit} the median strand is {:.3} m long and the roots spread over {:.3} m",
            length.median * metres,
            spread * metres
        ),
    };
    if fits(1.0) && spread <= 1.5 {
        return Some(guess(1.0, "a metre"));
    }
    if let Some((metres, name)) = USUAL_UNITS.iter().find(|(metres, _)| fits(*metres) && like_a_head(*metres)) {
        return Some(guess(*metres, name));
    }
    let by_head = HEAD_SPREAD / spread;
    if by_head.is_finite() && fits(by_head) {
        let decade = 10f64.powf(by_head.log10().floor() - 1.0);
        let rounded = (by_head / decade).round() * decade;
        let rounded = format!("{rounded:.2e}").parse().unwrap_or(rounded);
        return Some(guess(rounded, &format!("{rounded} m")));
    }
    USUAL_UNITS.iter().find(|(metres, _)| fits(*metres)).map(|(metres, name)| guess(*metres, name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_a_small_groom() {
        let square = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let point = vec![[5.0f32, 5.0, 5.0]; 2];
        let statistics = GroomStatistics::of(&Curves::from_strands(&[square, point]).unwrap());
        assert_eq!((statistics.strands, statistics.points), (2, 7));
        assert_eq!((statistics.strands_without_length, statistics.edges_without_length), (1, 2));
        assert_eq!(statistics.length.unwrap().max, 3.0);
        assert!((statistics.turning_degrees.unwrap().max - 180.0).abs() < 1e-9);
        assert_eq!(statistics.box_max, Some([5.0, 5.0, 5.0]));
    }

    #[test]
    fn a_head_in_centimetres_is_guessed_as_one() {
        let strands: Vec<Vec<[f32; 3]>> = (0..50)
            .map(|index| {
                let (sin, cos) = (index as f32 * 0.7).sin_cos();
                vec![[8.0 * cos, 160.0, 8.0 * sin], [10.0 * cos, 140.0, 10.0 * sin]]
            })
            .collect();
        let guess = GroomStatistics::of(&Curves::from_strands(&strands).unwrap()).scale_guess.unwrap();
        assert_eq!(guess.metres_per_unit, 0.01);
    }
}
