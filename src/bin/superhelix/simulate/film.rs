//! The frames of `superhelix simulate` on their way out: to the cache, and some of them to the picture.

use std::path::Path;

use nalgebra::Vector3;
use superhelix::hair::GroomStrand;
use superhelix::{Solver, StrandId};

use crate::picture;
use crate::picture::facing::face_of;
use crate::picture::grown::Grown;
use crate::picture::moment::Moment;
use crate::picture::sheet::SheetOptions;
use crate::picture::view::{Stand, View};
use crate::picture::{HairColour, Manner, grown, sheet, spread};
use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;
use crate::simulate::arguments::SimulateArguments;
use crate::simulate::cache::Cache;
use crate::stepping::sampled_frame::SampledFrame;
use crate::surfaces::moving_scalp::{ScalpFiles, ScalpRequest};
use crate::surfaces::surface::Surface;

/// A film of a simulation.
pub struct Film {
    cache: Option<Cache>,
    picture: Option<AtomicFile>,
    moments: Vec<Moment>,
    chosen: Vec<usize>,
    fps: f64,
    elements: u32,
    units_a_metre: f64,
    frame: SampledFrame,
}

impl Film {
    /// Opens what will be written, so that a directory that cannot be written to is found out before the work.
    pub fn create(
        arguments: &SimulateArguments,
        scale: f64,
        strands: usize,
        frame_count: usize,
        elements: u32,
    ) -> Result<Self, Failure> {
        let cache = arguments.out.as_deref().map(|directory| Cache::create(arguments, directory, scale, strands)).transpose()?;
        let picture = arguments.picture.as_deref().map(AtomicFile::create).transpose()?;
        let chosen = if picture.is_some() { spread(frame_count, arguments.moments as usize) } else { Vec::new() };
        Ok(Self {
            cache,
            picture,
            moments: Vec::new(),
            chosen,
            fps: arguments.fps,
            elements,
            units_a_metre: 1.0 / scale,
            frame: SampledFrame::new(arguments.samples as usize, 1.0 / scale),
        })
    }

    /// Takes the solver's present state as frame number `frame` (from 0).
    pub fn take(
        &mut self,
        solver: &Solver,
        ids: &[StrandId],
        frame: usize,
        body: impl FnOnce() -> Option<Surface>,
    ) -> Result<(), Failure> {
        let pictured = self.chosen.contains(&frame);
        if self.cache.is_none() && !pictured {
            return Ok(());
        }
        self.frame.take(solver, ids)?;
        let SampledFrame { points, velocities, samples, .. } = &self.frame;
        if let Some(cache) = &mut self.cache {
            cache.write(frame as f64 / self.fps, &vec![*samples as u32; ids.len()], points, velocities)?;
        }
        if pictured {
            let strands = points.chunks_exact(*samples).map(<[_]>::to_vec).collect();
            let mut body = body();
            for vertex in body.iter_mut().flat_map(|body| &mut body.vertices) {
                *vertex *= self.units_a_metre;
            }
            let bodies = body.into_iter().collect();
            self.moments.push(Moment { label: format!("{:.2} s", frame as f64 / self.fps), strands, bodies });
        }
        Ok(())
    }

    /// Draws the picture; how many frames the cache has and where the picture is.
    pub fn finish<'a>(
        mut self,
        arguments: &'a SimulateArguments,
        strands: &[GroomStrand],
        scale: f64,
    ) -> Result<(u32, Option<&'a Path>), Failure> {
        let cache_frames = self.cache.take().map_or(Ok(0), Cache::finish)?;
        if let (Some(mut file), Some(path)) = (self.picture, &arguments.picture) {
            let name = |path: &Path| path.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
            let title = format!(
                "{}   {}   {} strands of {} elements",
                name(&arguments.groom),
                arguments.head_motion.motion.as_deref().map_or_else(|| "still head".to_string(), name),
                strands.len(),
                self.elements
            );
            let options = SheetOptions {
                title: Some(title),
                views: views(arguments, &self.moments)?,
                manner: Manner::Hair,
                hair: HairColour::Brown,
                cell_width: 340,
                metres_per_unit: Some(scale),
            };
            picture::with_threads(arguments.threads, || {
                grow(&mut self.moments, arguments, scale)?;
                picture::write_png(&mut file, path, &sheet::draw(&self.moments, &options, || ())?)
            })?;
            file.commit()?;
        }
        Ok((cache_frames, arguments.picture.as_deref()))
    }
}

fn views(arguments: &SimulateArguments, moments: &[Moment]) -> Result<Vec<View>, Failure> {
    let bare = moments.first().and_then(|first| {
        let roots: Vec<Vector3<f64>> = first.strands.iter().map(|strand| Vector3::from(strand[0].map(f64::from))).collect();
        face_of(&roots, first.bodies.first()?, arguments.up)
    });
    let face = arguments.face.or(bare);
    [Stand::Front, Stand::Side].iter().map(|stand| View::new(*stand, arguments.up, face)).collect()
}

/// Grows hair among the strands where they are guides, on the body where there is one. The first moment is that of the start.
fn grow(moments: &mut [Moment], arguments: &SimulateArguments, scale: f64) -> Result<(), Failure> {
    let Some(first) = moments.first() else { return Ok(()) };
    if !(grown::LEAST_GUIDES..grown::MAX_GUIDES).contains(&first.strands.len()) {
        return Ok(());
    }
    let scalp = arguments.bodies.path().map(|path| {
        let still = ScalpRequest { path, scale: None, otherwise: scale, pose: None, up: None, times: &[] };
        ScalpFiles::read(&still).map(|scalp| (scalp, path))
    });
    let threads = arguments.threads as usize;
    let mut hair = Grown::bind(&first.strands, scale, grown::USUAL, scalp.transpose()?, threads)?;
    for (index, moment) in moments.iter_mut().enumerate() {
        moment.strands = hair.strands(index, &moment.strands)?;
    }
    Ok(())
}
