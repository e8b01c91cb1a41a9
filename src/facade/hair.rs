//! From measured and drawn hair to strands: kinds of hair, wisps, fits, scalps.
//!
//! [`Groom`](crate::Groom) and [`GroomOptions`](crate::GroomOptions) do the usual: a file of guides made into strands. This module has the
//! parts.
//!
//! ```
//! use superhelix::hair::{CurlFormula, HairType, Sliders, Variation};
//! use superhelix::{Solver, SolverOptions, StrandDef};
//!
//! // Measured curly hair, made a little straighter; every strand differs from the others.
//! let mut hair = HairType::Caucasian2.measured().parameters(CurlFormula::Exact)?;
//! hair.variation = Variation::natural();
//! let hair = hair.with_sliders(&Sliders { curliness: -0.25, ..Sliders::default() })?;
//!
//! let lengths = vec![0.01; 20]; // m
//! let strands: Vec<StrandDef> = (0..3)
//!     .map(|index| {
//!         let varied = hair.strand(index, &lengths)?;
//!         Ok(StrandDef { material: varied.material, natural: varied.natural, ..StrandDef::straight(0.2, 20) })
//!     })
//!     .collect::<superhelix::Result<_>>()?;
//! let mut solver = Solver::new(SolverOptions::default())?;
//! let ids = solver.add_strands(&strands)?;
//! solver.set_contact(&ids, Some(&hair.contact()))?;
//! assert!(solver.largest_turn(ids[0])? > 0.5); // rad an element: curls
//! # Ok::<(), superhelix::Error>(())
//! ```

pub use crate::groom::curves::apart::{MovedApart, move_apart};
pub use crate::groom::curves::drawn::{DrawnCurve, GroomStrand, NaturalShape};
pub use crate::groom::curves::guide_choice::{ChoiceWay, GuideCandidates, GuideChoice, Represented};
pub use crate::groom::curves::guide_roots::GuideRoots;
pub use crate::groom::curves::outside::{BroughtOut, bring_out};
pub use crate::groom::curves::rooting::{Rooted, root_on};
pub use crate::groom::curves::usable::{LeftOut, Unusable, remove_duplicates, turn_around, usable_curves};
pub use crate::groom::fit::bulk::{fit_curves, fit_each};
pub use crate::groom::fit::{
    ElementLengths, Fit, FitCurve, FitOptions, FitRoot, FitScratch, MAX_STARTS, fit_curve, fit_polyline,
};
pub use crate::groom::hair::hair_handle::HairHandle;
pub use crate::groom::hair::hair_parameters::{CurlFormula, HairParameters, Sliders, curled_shape};
pub use crate::groom::hair::hair_type::{DISCIPLINED_DRAG, FUZZY_DRAG, HairType, MeasuredHair, youngs_modulus_from_bending};
pub use crate::groom::hair::variation::{Variation, VariedStrand};
pub use crate::groom::rest_shape::{natural_under_gravity, natural_under_gravity_with};
pub use crate::groom::scalp::{Amount, Density, Follicle, Jitter, MAX_FOLLICLES, RootRegion, Scalp, ScatterOptions, Scattered};
