//! A groom as it was drawn: curves in metres, and the strands that rest as these curves are.

use std::borrow::Cow;
use std::path::Path;

use nalgebra::Vector3;

use super::outside::{BroughtOut, bring_out};
use crate::contact::shape::Shape;
use crate::error::{Error, Result, check_finite, check_not_negative, check_positive};
use crate::files::curves::Curves;
use crate::groom::fit::bulk::fit_each;
use crate::groom::fit::{Fit, FitCurve, FitOptions, FitScratch, fit_curve, natural_under_gravity_with};
use crate::groom::hair::hair_parameters::curled_shape;
use crate::groom::hair::variation::Variation;
use crate::groom::hair::wisp::Wisp;
use crate::groom::stability::{Stability, Stiffening, check_margin, stability_under_gravity};
use crate::math::quadrature;
use crate::rod::definition::StrandDef;
use crate::rod::material::Material;
use crate::rod::turning::{LARGEST_TURN, largest_turn};
use crate::workers::Workers;

/// Most elements that refinement gives a strand.
const MAX_ELEMENTS: usize = 100;
/// How often a strand is fitted again with more elements: a finer fit follows curls that a coarser one cut short.
const REFITS: usize = 12;

/// A curve of a groom, in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnCurve {
    /// Its index in the file or list that it comes from.
    pub index: usize,
    /// Points, m, root first.
    pub points: Vec<Vector3<f64>>,
    /// How far along the curve each point lies, m, where that is known better than by the sum of the edges.
    pub arclengths: Option<Vec<f64>>,
}

impl DrawnCurve {
    /// The curve of that index of a file. `metres_per_unit` is the length of the file's unit.
    pub fn of(curves: &Curves, index: usize, metres_per_unit: f64) -> Self {
        let points = in_metres(curves.strand(index), metres_per_unit);
        let arclengths = curves.extras().arclengths.as_ref().map(|all| {
            let stated = all[curves.strand_range(index)].iter().map(|arclength| f64::from(*arclength) * metres_per_unit);
            let (mut last, mut before) = (0.0, points[0]);
            // Floats of long strands may be too coarse for short edges: those count as they are.
            let along = stated.zip(&points).enumerate().map(|(point, (stated, at))| {
                last = if point == 0 { 0.0 } else { stated.max(last + (at - before).norm()) };
                before = *at;
                last
            });
            along.collect()
        });
        Self { index, points, arclengths }
    }

    /// The curve as the fit takes it.
    pub fn fit_curve(&self) -> FitCurve<'_> {
        FitCurve { arclengths: self.arclengths.as_deref(), ..FitCurve::polyline(&self.points) }
    }
}

/// Points of a file in metres.
pub fn in_metres(points: &[[f32; 3]], metres_per_unit: f64) -> Vec<Vector3<f64>> {
    points.iter().map(|point| Vector3::from(point.map(f64::from)) * metres_per_unit).collect()
}

/// The curves of a groom, in metres, which [`Groom::strands`] makes into strands.
///
/// ```
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Groom, GroomOptions, Material, Solver, SolverOptions, Wisp, Workers};
///
/// // A guide that leaves upwards, bends over and hangs down; m.
/// let guide = (0..24).map(|k| f64::from(k) / 23.0).map(|t| Vector3::new(0.09 * t, 0.0, 0.05 * (3.0 * t).sin() - 0.06 * t * t));
/// let groom = Groom::from_points(vec![guide.collect()]);
///
/// // Each curve stands for 200 hairs, which hold to their style.
/// let hair = Material { air_drag: 5e-6, ..Material::default() };
/// let options = GroomOptions::wisps(&hair, &Wisp::default())?;
/// let mut definitions = Vec::new();
/// for strand in groom.strands(&options, &Workers::Serial)? {
///     let strand = strand?; // an error here concerns this curve alone
///     assert!(strand.fit_error.1 < 1e-3); // m
///     definitions.push(strand.definition);
/// }
///
/// // The strands rest as they were drawn.
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&definitions)?;
/// let before = solver.curvatures(ids[0])?.to_vec();
/// solver.step(1.0, 60)?;
/// for (now, then) in solver.curvatures(ids[0])?.iter().zip(&before) {
///     assert!((0..3).all(|axis| (now[axis] - then[axis]).abs() < 1e-6)); // rad/m
/// }
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Groom {
    curves: Vec<DrawnCurve>,
}

impl Groom {
    /// Reads a groom from a file, see [`Curves::read`]. `metres_per_unit` is the length of the file's unit; `None`: as the file states it
    /// (only `.usda` does). The axes stay as they are in the file.
    ///
    /// # Errors
    /// As [`Curves::read`] and [`Groom::from_curves`].
    pub fn read(path: impl AsRef<Path>, metres_per_unit: Option<f64>) -> Result<Self> {
        Self::from_curves(&Curves::read(path)?, metres_per_unit)
    }

    /// A groom of curves that are in memory.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a unit that is not above zero, or for none where the curves do not state one.
    pub fn from_curves(curves: &Curves, metres_per_unit: Option<f64>) -> Result<Self> {
        let Some(unit) = metres_per_unit.or(curves.extras().metres_per_unit) else {
            return Err(Error::invalid("metres_per_unit", "not given", "a number: the file does not state its unit"));
        };
        check_positive(|| "metres_per_unit".into(), unit)?;
        Ok(Self { curves: (0..curves.strand_count()).map(|index| DrawnCurve::of(curves, index, unit)).collect() })
    }

    /// A groom of polylines, m, root first.
    pub fn from_points(polylines: Vec<Vec<Vector3<f64>>>) -> Self {
        let curve = |(index, points)| DrawnCurve { index, points, arclengths: None };
        Self { curves: polylines.into_iter().enumerate().map(curve).collect() }
    }

    /// The curves.
    pub fn curves(&self) -> &[DrawnCurve] {
        &self.curves
    }

    /// Makes a strand of each curve. The results are in the curves' order and are the same for any number of workers. A curve that cannot be
    /// made into a strand (real grooms have curves without length) has its own error.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for options or a number of workers out of range, [`Error::Unsupported`] where threads cannot be started.
    pub fn strands(&self, options: &GroomOptions<'_>, workers: &Workers) -> Result<Vec<Result<GroomStrand>>> {
        strands_of(&self.curves, options, workers, || {})
    }
}

/// What a strand's natural shape is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NaturalShape {
    /// The one with which the strand hangs under gravity as it was drawn.
    #[default]
    SagFree,
    /// The drawn shape: the strand sags from it.
    AsDrawn,
}

/// How curves are made into strands. [`GroomOptions::wisps`] chooses everything by what a curve stands for.
#[derive(Debug, Clone, Copy)]
pub struct GroomOptions<'a> {
    /// How strands are fitted to their curves.
    pub fit: FitOptions,
    /// Whether a strand gets more elements, up to 100 and to four for each point of its curve, until none of them turns by more than a quarter turn.
    pub refine: bool,
    /// Section and material of all strands.
    pub material: Material,
    /// Makes the strands' own natural curvatures curlier: −1 (straight) to 1, see [`Sliders::curliness`](crate::groom::hair::hair_parameters::Sliders).
    pub curliness: f64,
    /// How natural shapes vary: by default not at all.
    pub variation: Variation,
    /// The natural shape.
    pub natural: NaturalShape,
    /// What makes strands stiffer that would rest unstably, and the margin of stability, 0 to less than 1. Only sag-free strands are made stiffer.
    pub stiffening: Option<(Stiffening, f64)>,
    /// The scene's gravity, m/s².
    pub gravity: Vector3<f64>,
    /// That of the solver ([`StepOptions`](crate::step::options::StepOptions)), so that strands rest exactly there.
    pub quadrature_tolerance: f64,
    /// The shape (in the curves' own axes) that curves drawn inside of it are brought out of, and the distance from its surface, m.
    pub outside: Option<(&'a Shape, f64)>,
}

impl GroomOptions<'_> {
    /// Options for curves that each stand for a wisp of such hairs: sag-free, as stiff as the wisp's hold makes them, ten elements or as many as
    /// curls need, gravity along −z. [`Wisp::bare`] makes single hairs.
    ///
    /// # Errors
    /// As [`Wisp::material`].
    pub fn wisps(hair: &Material, wisp: &Wisp) -> Result<Self> {
        Ok(Self {
            refine: true,
            stiffening: wisp.margin().map(|margin| (Stiffening::YoungsModulus, margin)),
            ..Self::of(wisp.material(hair)?)
        })
    }

    /// Options for strands of that material: sag-free, without more stiffness, ten elements, gravity along −z.
    pub fn of(material: Material) -> Self {
        Self {
            fit: FitOptions::default(),
            refine: false,
            material,
            curliness: 0.0,
            variation: Variation::none(),
            natural: NaturalShape::SagFree,
            stiffening: None,
            gravity: Vector3::new(0.0, 0.0, -9.81),
            quadrature_tolerance: quadrature::DEFAULT_TOLERANCE,
            outside: None,
        }
    }

    /// Whether natural shapes are others than the groom's.
    pub fn reshapes(&self) -> bool {
        self.curliness != 0.0 || self.variation.frizz > 0.0
    }

    /// The definition of the strand that was fitted to the curve of that index, and how stably it would have rested without stiffening. The
    /// strand begins as it was drawn.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a strand that is not longer than wide, or options out of range.
    pub fn definition(&self, index: usize, fit: Fit) -> Result<(StrandDef, Option<Stability>)> {
        self.check_length(fit.element_lengths.iter().sum())?;
        let mut stability = None;
        let mut definition = StrandDef {
            element_lengths: fit.element_lengths,
            material: self.material,
            root: fit.root,
            natural: fit.curvatures.clone(),
            ..StrandDef::straight(1.0, 1)
        };
        if self.natural == NaturalShape::SagFree {
            let found = stability_under_gravity(&definition, &fit.curvatures, self.gravity)?;
            stability = Some(found);
            if let Some((by, margin)) = self.stiffening {
                definition.material = by.applied(&definition.material, by.scale(&found, margin)?);
            }
            definition.natural =
                natural_under_gravity_with(&definition, &fit.curvatures, self.gravity, self.quadrature_tolerance)?;
        }
        if self.natural == NaturalShape::SagFree || self.reshapes() {
            definition.initial = Some(fit.curvatures);
        }
        if self.reshapes() {
            let curled = curled_shape(&definition.element_lengths, &definition.natural, self.curliness)?;
            definition.natural = self.variation.of_shape(index as u64, &definition.element_lengths, &curled)?;
            stability = None;
        }
        Ok((definition, stability))
    }

    /// Checks every value that all strands share; `argument` is the name put before the field in the message.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        self.fit.check(&format!("{argument}.fit."))?;
        self.material.check(&format!("{argument}.material"))?;
        if !(-1.0..=1.0).contains(&self.curliness) {
            return Err(Error::invalid(format!("{argument}.curliness"), self.curliness, "a number from -1 to 1"));
        }
        self.variation.check(&format!("{argument}.variation"))?;
        if let Some((_, margin)) = self.stiffening {
            check_margin(margin).map_err(|error| error.inside(&format!("{argument}.stiffening")))?;
        }
        for axis in 0..3 {
            check_finite(|| format!("{argument}.gravity[{axis}]"), self.gravity[axis])?;
        }
        quadrature::check_tolerance(&format!("{argument}.quadrature_tolerance"), self.quadrature_tolerance)?;
        self.outside.map_or(Ok(()), |(_, clearance)| check_not_negative(|| format!("{argument}.outside"), clearance))
    }

    /// Checks that a strand of that length (m) is longer than wide.
    fn check_length(&self, length: f64) -> Result<()> {
        check_length(length, &self.material)
    }

    fn strand(&self, curve: &DrawnCurve, scratch: &mut FitScratch) -> Result<GroomStrand> {
        let index = curve.index;
        self.check_length(curve.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum())?;
        let mut points = Cow::Borrowed(&curve.points[..]);
        let mut brought_out = BroughtOut::default();
        if let Some((shape, clearance)) = self.outside {
            // Edges keep their lengths, and so do the pieces of curve that they stand for.
            brought_out = bring_out(points.to_mut(), shape, clearance)?;
        }
        let fit = self.fit(&FitCurve { points: &points, ..curve.fit_curve() }, scratch)?;
        let fit_error = (fit.rms_error, fit.max_error);
        let (definition, stability) = self.definition(index, fit)?;
        Ok(GroomStrand { index, definition, fit_error, stability, brought_out })
    }

    fn fit(&self, curve: &FitCurve<'_>, scratch: &mut FitScratch) -> Result<Fit> {
        let mut by = |element_count| fit_curve(curve, &FitOptions { element_count, ..self.fit }, scratch);
        let mut fit = by(self.fit.element_count)?;
        let most = (4 * curve.points.len()).min(MAX_ELEMENTS);
        for _ in 0..REFITS {
            let (elements, turn) = (fit.element_lengths.len(), largest_turn(&fit.element_lengths, &fit.curvatures));
            if !self.refine || turn <= LARGEST_TURN || elements >= most {
                break;
            }
            fit = by(((elements as f64 * turn / LARGEST_TURN).ceil() as usize).clamp(elements + 1, most))?;
        }
        Ok(fit)
    }
}

/// Checks that a strand of that length (m) and material is longer than wide.
pub fn check_length(length: f64, material: &Material) -> Result<()> {
    let width = 2.0 * material.radius[0].max(material.radius[1]);
    if length > width {
        return Ok(());
    }
    Err(Error::invalid("length", format!("{length:.3e} m"), format!("more than the strand's width of {width:.3e} m")))
}

/// A strand made of a curve.
#[derive(Debug, Clone)]
pub struct GroomStrand {
    /// The curve's index.
    pub index: usize,
    /// What a solver makes the strand from.
    pub definition: StrandDef,
    /// Distance between the curve and the centreline at equal arclength, m: root mean square and largest.
    pub fit_error: (f64, f64),
    /// How stably the strand would rest as drawn with the material of the options; `None` where it is not to rest so.
    pub stability: Option<Stability>,
    /// What was brought out of [`GroomOptions::outside`].
    pub brought_out: BroughtOut,
}

/// Makes a strand of each curve, as [`Groom::strands`] does. Calls `done` after each, on any thread.
///
/// # Errors
/// As [`Groom::strands`].
pub fn strands_of(
    curves: &[DrawnCurve],
    options: &GroomOptions<'_>,
    workers: &Workers,
    done: impl Fn() + Sync,
) -> Result<Vec<Result<GroomStrand>>> {
    options.check("options")?;
    let mut strands = Vec::with_capacity(curves.len());
    let one = |index: usize, scratch: &mut FitScratch| {
        let strand = options.strand(&curves[index], scratch);
        done();
        strand
    };
    fit_each(curves.len(), &options.fit, workers, one, |_, strand| strands.push(strand))?;
    Ok(strands)
}
