//! A solver's strands as guides of render hair, and its bodies as obstacles.

use std::sync::Mutex;

use nalgebra::{UnitQuaternion, Vector3};

use super::bulk_sampling::{SampleSink, Tile, Wanted};
use crate::error::Result;
use crate::groom::render_hair::{GuideSamples, RenderBody, RenderHair, RenderPose, RenderSettings};
use crate::math::frame::Frame;
use crate::math::rotation::from_rotation_vector;
use crate::solver::Solver;
use crate::solver::id::StrandId;

/// Samples of strands as guides.
#[derive(Debug, Clone, Default)]
pub struct SolverGuides {
    points: Vec<Vector3<f64>>,
    roots: Vec<UnitQuaternion<f64>>,
    velocities: Option<Vec<Vector3<f64>>>,
    spins: Option<Vec<Vector3<f64>>>,
}

impl SolverGuides {
    /// The samples, to bind or pose render hair.
    pub fn samples(&self) -> GuideSamples<'_> {
        GuideSamples {
            points: &self.points,
            roots: Some(&self.roots),
            velocities: self.velocities.as_deref(),
            root_angular_velocities: self.spins.as_deref(),
        }
    }
}

struct Room {
    points: Vec<Vector3<f64>>,
    velocities: Option<Vec<Vector3<f64>>>,
}

struct Sink {
    per_strand: usize,
    room: Mutex<Room>,
}

impl SampleSink<f64> for Sink {
    fn take(&self, tile: &Tile<f64>) {
        let mut room = self.room.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        for (lane, strand) in tile.strands.iter().enumerate() {
            let first = *strand as usize * self.per_strand + tile.first;
            for k in 0..tile.count {
                room.points[first + k] = Vector3::from([0, 1, 2].map(|axis| tile.positions[k][axis][lane]));
                if let Some(velocities) = &mut room.velocities {
                    velocities[first + k] = Vector3::from([0, 1, 2].map(|axis| tile.velocities[k][axis][lane]));
                }
            }
        }
    }
}

impl Solver {
    /// Samples strands as guides of `points_per_strand` points each, with their follicles' frames, and with velocities on
    /// request.
    ///
    /// # Errors
    /// As [`Solver::sample_tiles`].
    pub fn render_guides(&self, ids: &[StrandId], points_per_strand: usize, velocities: bool) -> Result<SolverGuides> {
        let wanted = Wanted { points_per_strand, origin: Vector3::zeros(), positions: true, rotations: false, velocities };
        // All identifiers are checked before memory is allocated.
        let states: Vec<_> = self.indices(ids)?.into_iter().map(|index| &self.strands[index].state).collect();
        let count = ids.len() * points_per_strand;
        let room = Room { points: vec![Vector3::zeros(); count], velocities: velocities.then(|| vec![Vector3::zeros(); count]) };
        let sink = Sink { per_strand: points_per_strand, room: Mutex::new(room) };
        self.sample_tiles::<f64>(ids, &wanted, &sink)?;
        let room = sink.room.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
        Ok(SolverGuides {
            points: room.points,
            roots: states.iter().map(|state| state.root.rotation).collect(),
            velocities: room.velocities,
            spins: velocities.then(|| states.iter().map(|state| state.root_angular_velocity).collect()),
        })
    }

    /// Render hair with these strands as guides in their current state, which is its rest pose.
    ///
    /// # Errors
    /// As [`Solver::render_guides`] and [`RenderHair::bind`].
    pub fn bind_render_hair(&self, ids: &[StrandId], settings: &RenderSettings, roots: &[Vector3<f64>]) -> Result<RenderHair> {
        settings.check("settings.")?;
        RenderHair::bind(settings, &self.render_guides(ids, settings.points_per_strand, false)?.samples(), roots)
    }

    /// Sets a pose from the strands of its guides, in the order of binding, with velocities on request.
    ///
    /// # Errors
    /// As [`Solver::render_guides`] and [`RenderPose::set`].
    pub fn pose_render_hair(&self, ids: &[StrandId], velocities: bool, pose: &mut RenderPose) -> Result<()> {
        let points = pose.hair().settings().points_per_strand;
        pose.set(&self.render_guides(ids, points, velocities)?.samples())
    }

    /// The bodies at their current poses, as obstacles of render strands
    /// ([`View::bodies`](crate::groom::render_hair::View::bodies)); those whose group or mask is 0 are left out. Their earlier
    /// poses, `seconds` ago, follow from their velocities.
    pub fn render_bodies(&self, seconds: f64) -> Vec<RenderBody<'_>> {
        let bodies = self.bodies.iter().map(|body| &body.body).filter(|body| body.def().group != 0 && body.def().mask != 0);
        bodies
            .map(|body| {
                let (def, (velocity, spin)) = (body.def(), body.motion.velocity());
                let before = Frame {
                    origin: def.pose.origin - velocity * seconds,
                    rotation: from_rotation_vector(spin * -seconds) * def.pose.rotation,
                };
                RenderBody { shape: &def.shape, pose: def.pose, pose_before: before, thickness: def.thickness }
            })
            .collect()
    }
}
