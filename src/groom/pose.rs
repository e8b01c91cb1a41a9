//! Posing strands by hand: drag a point, brush, bend and turn elements, cut, grow, mirror (`docs/theory/posing.md`).
//!
//! A pose is a strand's root, element lengths and curvatures. Every operation keeps it a Super-Helix: elements stretch only on
//! request, and frames stay proper.
//!
//! Files:
//!
//! - `brush.rs`: A brush that carries the strands inside it along.
//! - `drag.rs`: Drags one strand by a point: Bergbom 2007, section 4.3, with a linear-time Jacobian.
//! - `element.rs`: Bends, twists and lengthens one element.
//! - `elimination.rs`: The Levenberg–Marquardt step on one strand's curvatures, in linear time.
//! - `mirror.rs`: Mirrors strands across a plane.
//! - `search.rs`: The Levenberg–Marquardt search on a strand's curvatures.
//! - `springs.rs`: Springs on places of a strand during posing.
//! - `trim.rs`: Cuts strands and lets them grow.

mod brush;
mod drag;
mod element;
mod elimination;
mod mirror;
mod search;
mod springs;
mod trim;

use nalgebra::Vector3;

pub use brush::{Brush, Brushed};
pub use drag::{DragTarget, Dragged, PoseScratch};
pub use element::ElementChange;
pub use mirror::{Plane, mirrored};
pub use trim::Growth;

pub(crate) use brush::check_brush;
pub(crate) use drag::check_target;
pub(crate) use element::check_applied;
pub(crate) use trim::{check_cut, cut_lengths};

use crate::contact::body_at::BodyAt;
use crate::contact::narrow_phase::strand_body::Span;
use crate::error::{Error, Result, check_finite, check_not_negative, check_positive};
use crate::math::frame::Frame;
use crate::math::vector::Vec3;
use crate::rod::definition::{MAX_ELEMENTS, check_lengths, check_rows};
use crate::rod::freedoms::Freedoms;
use crate::rod::kinematics::{ElementState, element_state};
use crate::rod::segment;
use crate::step::state::rotation_matrix;

/// A strand's shape: the root's pose, the elements' lengths and curvatures.
///
/// ```
/// use superhelix::editing::{Growth, StrandShape};
/// use superhelix::Frame;
///
/// let mut shape = StrandShape {
///     root: Frame::default(),
///     element_lengths: vec![0.05; 4],
///     curvatures: vec![[0.0, 5.0, 0.0]; 4],
/// };
/// shape.cut(0.12)?;
/// shape.grow(&Growth { length: 0.03, elements: 1, curvatures: None })?;
/// assert!((shape.length() - 0.15).abs() < 1e-12);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct StrandShape {
    /// The root's pose in the world.
    pub root: Frame,
    /// Lengths from root to tip, m; at least one, each above zero.
    pub element_lengths: Vec<f64>,
    /// Curvatures (twist, κ1, κ2), rad/m, one row per element.
    pub curvatures: Vec<[f64; 3]>,
}

/// Options of posing.
///
/// ```
/// use superhelix::editing::PoseOptions;
///
/// // Only the outer half of eight elements moves, and stays out of bodies.
/// let movable = (0..8).map(|element| element >= 4).collect();
/// let options = PoseOptions { movable: Some(movable), keep_out: true, ..PoseOptions::default() };
/// options.check("options", 8)?;
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PoseOptions {
    /// Which elements may change: one flag per element, strand after strand for several strands; `None` for all. The others keep
    /// their curvatures to the bit.
    pub movable: Option<Vec<bool>>,
    /// The preferred shape: 0 for the current one, 1 for the natural one, a mixture in between. 0 to 1.
    pub natural_pull: f64,
    /// Whether the strand keeps its direction at the tip.
    pub keep_tip_direction: bool,
    /// Whether the strand stays outside bodies; one that starts inside is taken out.
    pub keep_out: bool,
    /// Distance of strands from bodies beyond both thicknesses, m; zero or above.
    pub clearance: f64,
}

impl Default for PoseOptions {
    fn default() -> Self {
        Self { movable: None, natural_pull: 0.0, keep_tip_direction: false, keep_out: true, clearance: 0.0 }
    }
}

impl PoseOptions {
    /// Checks every value for strands with `elements` elements in total; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str, elements: usize) -> Result<()> {
        // For several strands: all elements together.
        if let Some(movable) = &self.movable
            && movable.len() != elements
        {
            return Err(Error::invalid(
                format!("{argument}.movable (count)"),
                movable.len(),
                format!("{elements}, one per element"),
            ));
        }
        if !(0.0..=1.0).contains(&self.natural_pull) {
            return Err(Error::invalid(format!("{argument}.natural_pull"), self.natural_pull, "0 to 1"));
        }
        check_not_negative(|| format!("{argument}.clearance"), self.clearance)
    }
}

/// The surroundings of a posed strand, and its properties.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// Bodies to stay out of.
    pub bodies: &'a [BodyAt<'a>],
    /// The strand's radius for contact with them, m; zero or above.
    pub radius: f64,
    /// The length from the root that may be inside bodies, m; zero or above.
    pub exempt: f64,
    /// Natural curvatures, one row per element, for [`PoseOptions::natural_pull`]; `None` for the current ones.
    pub natural: Option<&'a [[f64; 3]]>,
    /// The curvatures that may change.
    pub freedoms: Freedoms,
    /// The relative cost of changing twist, κ1 and κ2; above zero. A strand's stiffnesses bend it the way it would bend.
    pub charge: [f64; 3],
}

impl Default for Surroundings<'_> {
    fn default() -> Self {
        Self { bodies: &[], radius: 0.0, exempt: 0.0, natural: None, freedoms: Freedoms::ALL, charge: [1.0; 3] }
    }
}

impl<'a> Surroundings<'a> {
    fn check(&self, argument: &str, shape: &StrandShape) -> Result<()> {
        check_not_negative(|| format!("{argument}.radius"), self.radius)?;
        check_not_negative(|| format!("{argument}.exempt"), self.exempt)?;
        if let Some(natural) = self.natural {
            check_rows(format_args!("{argument}.natural"), natural, shape.curvatures.len())?;
        }
        (0..3).try_for_each(|axis| check_positive(|| format!("{argument}.charge[{axis}]"), self.charge[axis]))
    }

    fn obstacles(&self, options: &PoseOptions) -> Option<search::Obstacles<'a>> {
        let (bodies, distance, span) = (self.bodies, self.radius + options.clearance, Span { exempt: self.exempt, unmoved: &[] });
        (options.keep_out && !bodies.is_empty()).then_some(search::Obstacles { bodies, span, distance })
    }
}

impl StrandShape {
    /// Checks counts and numbers; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        let count = self.element_lengths.len();
        if count == 0 || count > MAX_ELEMENTS {
            return Err(Error::invalid(format!("{argument}.element_lengths (count)"), count, format!("1 to {MAX_ELEMENTS}")));
        }
        check_lengths(format_args!("{argument}.element_lengths"), &self.element_lengths)?;
        check_positive(|| format!("{argument}.length"), self.length())?;
        check_rows(format_args!("{argument}.curvatures"), &self.curvatures, count)?;
        (0..3).try_for_each(|axis| check_finite(|| format!("{argument}.root.origin[{axis}]"), self.root.origin[axis]))
    }

    /// The strand's length, m.
    pub fn length(&self) -> f64 {
        self.element_lengths.iter().sum()
    }

    /// The pose of the material cross-section at an arclength from the root, m; beyond the ends, the end elements continue.
    pub fn frame_at(&self, arclength: f64) -> Frame {
        let (index, s) = self.material_point(arclength);
        let (mut frame, mut origin) = (rotation_matrix(&self.root), Vec3::<f64>::zero());
        let state = |k: usize, frame, origin| element_state(Vec3(self.curvatures[k]), self.element_lengths[k], frame, origin);
        for k in 0..index {
            let element: ElementState<f64> = state(k, frame, origin);
            (frame, origin) = (element.frame_right(), element.origin_right());
        }
        let element = state(index, frame, origin);
        let s = if index + 1 == self.curvatures.len() {
            s.max(arclength - self.element_lengths[..index].iter().sum::<f64>())
        } else {
            s
        };
        let point = element.point(s);
        let theta = element.kappa.scale(s);
        let rotation = frame.mul(&segment::frame(theta, theta.norm_squared(), &point.c));
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(rotation.into());
        Frame {
            origin: self.root.origin + Vector3::from(point.position),
            rotation: nalgebra::UnitQuaternion::from_rotation_matrix(&rotation),
        }
    }

    /// The element that holds an arclength, and the arclength on it.
    fn material_point(&self, arclength: f64) -> (usize, f64) {
        let mut rest = arclength;
        let last = self.element_lengths.len() - 1;
        for (element, length) in self.element_lengths[..last].iter().enumerate() {
            if rest <= *length {
                return (element, rest);
            }
            rest -= length;
        }
        (last, rest.min(self.element_lengths[last]))
    }

    /// The unit tangent at the tip, world axes.
    fn tip_direction(&self) -> Vec3<f64> {
        (self.frame_at(self.length()).rotation * Vector3::x()).into()
    }
}
