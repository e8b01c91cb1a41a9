//! Options of contact: the model, its tolerances, and the contact properties of strands.

use crate::contact::broad_phase::pieces::Wisp;
use crate::error::{Error, Result, check_not_negative, check_positive};

/// The unit of [`ContactOptions::residual`] for velocities, m/s.
pub const SPEED: f64 = 0.01;
/// The acceleration in its unit of weight, m/s²: the earth's, whatever the scene's is.
pub const GRAVITY: f64 = 9.81;

/// Models of contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u32)]
pub enum ContactModel {
    /// The penalty method: a spring and a damper along the normal, viscous friction along the surface (Bertails et al. 2006,
    /// section 5). The cheap model: iterated to 2e-3 rad, one search for contacts, and surfaces that sink into each other by
    /// their force over [`ContactOptions::stiffness`].
    Penalty = 1,
    /// The same with a spring that begins softly (Bergbom 2007, section 4.2.10): k d²/(2 d_reg) down to the depth d_reg, then k
    /// (d − d_reg/2).
    RegularisedPenalty = 2,
    /// Signorini's and Coulomb's laws: surfaces do not pass through each other (to [`ContactOptions::tolerance`] at the end of every step), and
    /// friction is Coulomb's, all contacts as one complementarity problem solved to [`ContactOptions::residual`] (Daviet et al. 2011).
    #[default]
    Coulomb = 4,
    /// For games and previews: contact with bodies at the strands' integration points (four or more an element), halfway between them and at
    /// the tip, with Coulomb's friction, as part of each strand's own minimisation: side by side with free strands, and in single precision too. Springs are a hundred
    /// times as stiff as what a point's inertia and the strand's bending put against them in the step, so that by default most surfaces sink
    /// into each other by tenths of a millimetre at most. Two to four iterations leave some strands a centimetre deep where a body moves fast. Strands
    /// pass and pierce what is thinner than their points are apart. Strands that collide with others or
    /// have constraints are stepped as with [`ContactModel::Penalty`], but with Coulomb's friction.
    AtPoints = 5,
}

impl ContactModel {
    /// The model with this number, as in the C ABI and in snapshots. (3 was the number of the same law at a coarser tolerance.)
    pub fn from_u32(value: u32) -> Option<Self> {
        match value {
            1 => Some(Self::Penalty),
            2 => Some(Self::RegularisedPenalty),
            3 | 4 => Some(Self::Coulomb),
            5 => Some(Self::AtPoints),
            _ => None,
        }
    }

    /// Whether surfaces may sink into each other.
    pub fn is_soft(self) -> bool {
        matches!(self, Self::Penalty | Self::RegularisedPenalty | Self::AtPoints)
    }

    /// Whether strands are held apart by springs whose force is proportional to the depth.
    pub(crate) fn has_linear_springs(self) -> bool {
        matches!(self, Self::Penalty | Self::AtPoints)
    }

    /// Whether friction is proportional to the velocity instead of Coulomb's.
    pub(crate) fn has_viscous_friction(self) -> bool {
        matches!(self, Self::Penalty | Self::RegularisedPenalty)
    }
}

/// How contact is answered in a solver.
///
/// ```
/// use superhelix::{ContactModel, ContactOptions, Solver, SolverOptions};
///
/// // Hair on hair and on bodies, by the cheap model: two iterations of penalties.
/// let contact = ContactOptions { model: ContactModel::Penalty, hair: true, max_iterations: 2, ..ContactOptions::default() };
/// let solver = Solver::new(SolverOptions { contact, ..SolverOptions::default() })?;
/// assert!(solver.options().contact.hair);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactOptions {
    /// The model.
    pub model: ContactModel,
    /// Whether strands collide with each other. False: only with bodies, and costs nothing.
    pub hair: bool,
    /// Penalty: k of one contact, N/m; above zero. At points: the same for strands that collide with others or have constraints.
    pub stiffness: f64,
    /// Penalty: the factor of k that damps approach and separation, s; zero or above. At points: where `stiffness` counts.
    pub damping: f64,
    /// Regularised penalty: d_reg, m; above zero.
    pub regularisation_depth: f64,
    /// Coulomb: the largest depth of overlap at the end of a step, m; above zero. At points: friction grows with the overlap up to twice this.
    pub tolerance: f64,
    /// Coulomb: the error of the laws of contact and friction at which a step is reported as converged; 1e-12 to 1. At every
    /// contact they hold exactly for some force within `residual` times the force (or the lightest strand's weight, where that
    /// is more) of the one that acts, and some velocity within `residual` times [`SPEED`] of the actual one: 1e-4 is a
    /// ten-thousandth of the force and a micrometre per second. (Strands converge to the solver's Newton tolerance.)
    pub residual: f64,
    /// Coulomb, at points: the speed at which surfaces that overlap when a step begins (as in a groom that was drawn so) are separated,
    /// m/s; above zero.
    pub separation_speed: f64,
    /// The limit of Newton iterations that strands take together in a step; 1 to 10000. With the soft models up to ten are a
    /// choice of what to pay for a step (`docs/notebook/contact.md` has prices of one, two and four): what springs have not
    /// pushed out by then they do in the next steps, and strands that have not converged are reported. (Those left deep in bodies
    /// go on by themselves, up to four times, with six more or this many if that is more.) More, and any number with the other
    /// models, are a limit: what has not converged by then is repeated with constraints that yield.
    pub max_iterations: u32,
    /// The limit of sweeps of the contact problem's solver in each of them; 1 to 1000000.
    pub max_sweeps: u32,
}

/// With penalties, limits up to this many iterations are a choice: what springs have not pushed out in this step they do in the
/// next.
pub const MAX_CHOSEN_ITERATIONS: u32 = 10;

impl Default for ContactOptions {
    fn default() -> Self {
        Self {
            model: ContactModel::default(),
            hair: false,
            stiffness: 10.0,
            damping: 1e-3,
            regularisation_depth: 1e-4,
            tolerance: 5e-5,
            residual: 1e-4,
            separation_speed: 0.1,
            max_iterations: 50,
            max_sweeps: 500,
        }
    }
}

impl ContactOptions {
    /// The depth of overlap that the model tolerates, m: none with springs, whose depth is their force.
    pub(crate) fn tolerated_depth(&self) -> f64 {
        if self.model.is_soft() { 0.0 } else { self.tolerance }
    }

    /// The depth in a body from which on a root counts as inside, m. A root on the surface is as deep as its strand's radius, by default the
    /// tolerance: rounding must not decide.
    pub(crate) fn deepest_root(&self) -> f64 {
        self.tolerance * (1.0 + 1e-3)
    }

    /// Checks every value; `argument` is the name put before the field in the message.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        check_positive(|| format!("{argument}.stiffness"), self.stiffness)?;
        check_not_negative(|| format!("{argument}.damping"), self.damping)?;
        check_positive(|| format!("{argument}.regularisation_depth"), self.regularisation_depth)?;
        check_positive(|| format!("{argument}.tolerance"), self.tolerance)?;
        check_positive(|| format!("{argument}.separation_speed"), self.separation_speed)?;
        if !(1e-12..=1.0).contains(&self.residual) {
            return Err(Error::invalid(format!("{argument}.residual"), self.residual, "1e-12 to 1"));
        }
        if !(1..=10_000).contains(&self.max_iterations) {
            return Err(Error::invalid(format!("{argument}.max_iterations"), self.max_iterations, "1 to 10000"));
        }
        if !(1..=1_000_000).contains(&self.max_sweeps) {
            return Err(Error::invalid(format!("{argument}.max_sweeps"), self.max_sweeps, "1 to 1000000"));
        }
        Ok(())
    }
}

/// Friction of a surface that is rougher one way than the other, as hair is by its scales: `along` for what goes over it from root to tip,
/// `against` from tip to root; between them by the cosine of the direction (Bertails et al. 2006, section 5).
///
/// ```
/// use superhelix::Friction;
///
/// let hair = Friction { along: 0.2, against: 0.3 };
/// assert_ne!(hair, Friction::uniform(0.2));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// Coefficient for sliding over the strand from root to tip, zero or above.
    pub along: f64,
    /// Coefficient from tip to root, zero or above.
    pub against: f64,
}

impl Friction {
    /// The same in all directions.
    pub fn uniform(value: f64) -> Self {
        Self { along: value, against: value }
    }

    pub(crate) fn check(&self, argument: &str) -> Result<()> {
        check_not_negative(|| format!("{argument}.along"), self.along)?;
        check_not_negative(|| format!("{argument}.against"), self.against)
    }
}

/// What a strand is to contact. Strands have none unless it is given to them.
///
/// ```
/// use superhelix::{Friction, Solver, SolverOptions, StrandContact, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 5)])?;
/// // A wisp of 2 mm whose first centimetre touches nothing.
/// let contact = StrandContact {
///     wisp_radius: 2e-3,
///     exempt_length: 0.01,
///     friction: Friction::uniform(0.3),
///     ..StrandContact::default()
/// };
/// solver.set_contact(&ids, Some(&contact))?;
/// assert_eq!(solver.contact(ids[0])?, Some(&contact));
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrandContact {
    /// Distance of the strand's surface from its centreline for bodies, m; zero or above. The radius of its section by default.
    pub radius: f64,
    /// The same for other strands: the radius of the wisp for which it stands, m; zero: it collides with no strand. Strands whose roots
    /// are closer than the sum of their radii touch only beyond that length from their roots: no force parts them there.
    pub wisp_radius: f64,
    /// Coulomb's coefficient against bodies, multiplied by the body's (Coulomb, at points).
    pub friction: Friction,
    /// Coulomb's coefficient against strands: the mean of both (Coulomb, at points).
    pub hair_friction: Friction,
    /// Viscous friction of a contact, N·s/m (penalty models), against bodies (multiplied by the body's) and strands (the mean of both).
    pub viscous_friction: Friction,
    /// Length from the follicle without contact, m; zero or above.
    pub exempt_length: f64,
    /// Bits of the groups to which the strand belongs.
    pub groups: u32,
    /// Bits of the groups with which it collides: two things collide if each is in a group of the other's mask.
    pub mask: u32,
}

impl Default for StrandContact {
    fn default() -> Self {
        Self {
            radius: 50e-6,
            wisp_radius: 0.0,
            friction: Friction { along: 0.2, against: 0.3 },
            hair_friction: Friction { along: 0.2, against: 0.3 },
            viscous_friction: Friction { along: 1e-4, against: 1.5e-4 },
            exempt_length: 0.0,
            groups: 1,
            mask: u32::MAX,
        }
    }
}

impl StrandContact {
    /// Its properties for contact with other strands.
    pub(crate) fn wisp(&self) -> Wisp {
        let Self { wisp_radius: radius, exempt_length: exempt, groups: group, mask, .. } = *self;
        Wisp { radius, exempt, group, mask, meets_itself: false }
    }

    /// Checks every value; `argument` is the name put before the field in the message.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        check_not_negative(|| format!("{argument}.radius"), self.radius)?;
        check_not_negative(|| format!("{argument}.wisp_radius"), self.wisp_radius)?;
        check_not_negative(|| format!("{argument}.exempt_length"), self.exempt_length)?;
        self.friction.check(&format!("{argument}.friction"))?;
        self.hair_friction.check(&format!("{argument}.hair_friction"))?;
        self.viscous_friction.check(&format!("{argument}.viscous_friction"))
    }
}
