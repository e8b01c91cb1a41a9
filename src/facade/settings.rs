//! Settings by the error that may be made: time steps, elements, tolerances that were measured to be good enough.
//!
//! ```
//! use superhelix::StrandDef;
//! use superhelix::settings::{HairShape, Scenes, suggest_settings};
//!
//! // The cheapest settings with a tip error of 2 % of the length on a walking head, at 24 frames a second.
//! let hair = HairShape::of(&StrandDef::straight(0.2, 1));
//! let settings = suggest_settings(0.02, Scenes::WALK, &hair, 1.0 / 24.0)?;
//! assert!(settings.substeps >= 1 && settings.elements >= 1);
//! # Ok::<(), superhelix::Error>(())
//! ```

pub use crate::analysis::elements::{Demand, RootMotion, Suggestion, suggest_elements};
pub use crate::analysis::presets::{Preset, Recipe};
pub use crate::analysis::settings::{HairShape, Settings};
pub use crate::analysis::suggestion::{Scenes, suggest_settings};
