//! The picture of `superhelix prepare`: strands as read, as prepared, and as grown from the guides.

use std::path::Path;

use nalgebra::Vector3;
use superhelix::hair::DrawnCurve;
use superhelix::io::RawStrands;

use super::arguments::PrepareArguments;
use super::guides::{COMPARED, Guides};
use super::head::Body;
use crate::picture::facing::face_of;
use crate::picture::moment::Moment;
use crate::picture::sheet::{self, SheetOptions};
use crate::picture::view::{Stand, View};
use crate::picture::{HairColour, Manner, with_threads, write_png};
use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;
use crate::surfaces::surface::Surface;

/// Most strands that are drawn of each.
const MOST: usize = 30_000;

/// Draws the picture.
pub fn draw(
    arguments: &PrepareArguments,
    path: &Path,
    raw: &RawStrands,
    scale: f64,
    curves: &[DrawnCurve],
    guides: &Guides,
    body: Option<&Body>,
) -> Result<(), Failure> {
    let mut file = AtomicFile::create(path)?;
    let narrowed = |point: &Vector3<f64>| -> [f32; 3] { point.map(|value| value as f32).into() };
    let finite = |strand: &&[[f32; 3]]| strand.len() > 1 && strand.iter().flatten().all(|number| number.is_finite());
    let read: Vec<&[[f32; 3]]> = raw.strands().filter(finite).collect();
    let in_metres =
        |strand: &&[[f32; 3]]| strand.iter().map(|point| point.map(|value| (f64::from(value) * scale) as f32)).collect();
    let read: Vec<Vec<[f32; 3]>> = read.iter().step_by(read.len().div_ceil(MOST).max(1)).map(in_metres).collect();
    let prepared = curves.iter().step_by(curves.len().div_ceil(MOST)).map(|curve| curve.points.iter().map(narrowed).collect());
    let grown = guides.grown.chunks_exact(COMPARED);
    let grown_step = grown.len().div_ceil(MOST).max(1);
    let simulated = |number: usize| format!("grown from {number} guides");
    let bodies: Vec<Surface> = body.map(|body| body.surface.clone()).into_iter().collect();
    let moment = |label: String, strands: Vec<Vec<[f32; 3]>>| Moment { label, strands, bodies: bodies.clone() };
    let moments = [
        moment(format!("as read: {} strands", raw.strand_count()), read),
        moment(format!("prepared: {}", curves.len()), prepared.collect()),
        moment(simulated(guides.strands.len()), grown.step_by(grown_step).map(<[_]>::to_vec).collect()),
    ];
    let roots: Vec<Vector3<f64>> = curves.iter().map(|curve| curve.points[0]).collect();
    let face = body.and_then(|body| face_of(&roots, &body.surface, arguments.up));
    let views = [Stand::Front, Stand::Side, Stand::Back].iter().map(|stand| View::new(*stand, arguments.up, face));
    let name = arguments.strands.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let options = SheetOptions {
        title: Some(name),
        views: views.collect::<Result<_, _>>()?,
        manner: Manner::Hair,
        hair: HairColour::Brown,
        cell_width: 420,
        metres_per_unit: Some(1.0),
    };
    with_threads(arguments.threads, || write_png(&mut file, path, &sheet::draw(&moments, &options, || ())?))?;
    file.commit()
}
