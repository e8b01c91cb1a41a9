//! Render hair: a hundred thousand strands that follow the simulated ones.
//!
//! A [`RenderHair`] binds strands to guides once; a [`RenderPose`] holds the guides of a frame, and
//! [`RenderPose::evaluate`] writes the points of every strand into a [`StrandSink`]. The scheme is that of Bertails et al. 2006, section 4.1.
//! The guide page [render hair](https://docs.rs/crate/superhelix/latest/source/docs/guide/render-hair.md) explains the settings.

pub use crate::groom::render_hair::{
    GuideSamples, MAX_GUIDES, MAX_POINTS, MAX_WISPS, Motion, RENDER_HAIR_VERSION, RenderBody, RenderHair, RenderPose,
    RenderSettings, Resampled, RootsAt, Space, StrandPoints, StrandSink, VELOCITY_STEP, View, measured_curliness, resampled,
};
