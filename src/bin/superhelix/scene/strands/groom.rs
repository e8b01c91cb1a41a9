//! `groom` of a strand: a file of curves, in whose place stands a strand for each of them, fitted.

use std::path::Path;

use nalgebra::Vector3;
use superhelix::editing::Stiffening;
use superhelix::hair::{DrawnCurve, Fit, FitCurve, FitOptions, NaturalShape, fit_curves};
use superhelix::io::Curves;
use superhelix::{Frame, GroomOptions, MAX_ELEMENTS, Material, Result as Outcome, SolverOptions, StrandDef, Wisp};

use crate::groom::unit;
use crate::scene::colliders::{file_complaint, path_of};
use crate::scene::pose::read_pose;
use crate::scene::strands::maps::{MappedContact, Maps};
use crate::scene::strands::only::Only;
use crate::scene::words::in_words_of_the_scene;
use crate::shell::json::{Complaint, Node};

/// What each strand stands for; null: one bare hair.
fn read_wisp(node: &Node) -> Result<Wisp, Complaint> {
    if node.value.is_null() {
        return Ok(Wisp::bare());
    }
    let (usual, wisp) = (Wisp::default(), node.object(&["hairs", "hold"])?);
    let wisp = Wisp { hairs: wisp.or("hairs", usual.hairs, Node::number)?, hold: wisp.or("hold", usual.hold, Node::number)? };
    wisp.check(&node.key).map_err(in_words_of_the_scene)?;
    Ok(wisp)
}

/// Reads `groom`: the strands, wisps of such hairs, or what `maps` say of them, that hang, or are drawn, as the file's curves, or `only` some
/// of them, under the gravity of `options`.
pub fn read(
    node: &Node,
    hair: Material,
    maps: Option<&Maps>,
    only: Option<&Only>,
    options: &SolverOptions,
    directory: &Path,
) -> Result<Vec<(StrandDef, MappedContact)>, Complaint> {
    let groom = node.object(&["file", "metres_per_unit", "pose", "every", "elements", "tolerance", "natural", "wisp"])?;
    let file = groom.require("file")?;
    let curves = Curves::read(path_of(file, directory)?).map_err(|error| file_complaint(file, &error))?;
    let flag = groom.get("metres_per_unit").map(Node::positive).transpose()?;
    let missing = || Complaint::new(groom.path("metres_per_unit"), "is missing, and the file does not say its unit");
    let scale = unit::stated(flag, &curves).ok_or_else(missing)?;
    let pose = groom.or("pose", Frame::default(), read_pose)?;
    let every = groom.or("every", 1, |node| node.whole(1..=u64::from(u32::MAX)))? as usize;
    let tolerance = groom.get_unless_null("tolerance").map(Node::positive).transpose()?;
    let usual = if tolerance.is_some() { 100 } else { 10 };
    let elements = groom.or("elements", usual, |node| Ok(node.whole(1..=MAX_ELEMENTS as u64)? as usize))?;
    let shapes = [("sag_free", NaturalShape::SagFree), ("as_drawn", NaturalShape::AsDrawn)];
    let natural = groom.or("natural", NaturalShape::SagFree, |node| node.choice(&shapes))?;
    let wisp = groom.or("wisp", Wisp::default(), read_wisp)?;
    let material = wisp.material(&hair).map_err(in_words_of_the_scene)?;
    let margin = wisp.margin().filter(|_| natural == NaturalShape::SagFree);

    let place = |point: &Vector3<f64>| pose.origin + pose.rotation * point;
    let mut polylines = unit::drawn(&curves, every, scale);
    if let Some(only) = only {
        let all = polylines.iter().map(|curve| curve.index);
        let chosen = only.among(all, curves.strand_count(), |index| place(&polylines[index / every].points[0]))?;
        polylines.retain(|curve| chosen.binary_search(&curve.index).is_ok());
    }
    let inputs: Vec<FitCurve<'_>> = polylines.iter().map(DrawnCurve::fit_curve).collect();
    let fits = fit_curves(&inputs, &FitOptions { tolerance, ..FitOptions::elements(elements) }, &options.workers)
        .map_err(in_words_of_the_scene)?;
    let recipe = GroomOptions {
        natural,
        stiffening: margin.map(|margin| (Stiffening::YoungsModulus, margin)),
        gravity: options.gravity,
        quadrature_tolerance: options.step.quadrature_tolerance,
        ..GroomOptions::of(material)
    };
    let strand = |(DrawnCurve { index, .. }, fit): (&DrawnCurve, Outcome<Fit>)| {
        let refused =
            |because: superhelix::Error| Complaint::new(&file.key, format!("is {}; its strand {index}: {because}", file.value));
        let fit = fit.map_err(refused)?;
        let root = pose.compose(&fit.root);
        let mapped = maps.map(|maps| maps.at(&root.origin, *index)).transpose()?.unwrap_or_default();
        let material = wisp.material(&mapped.material(hair)).map_err(refused)?;
        let recipe = GroomOptions { material, ..recipe };
        let (definition, _) = recipe.definition(*index, Fit { root, ..fit }).map_err(refused)?;
        Ok((definition, mapped.contact()))
    };
    polylines.iter().zip(fits).map(strand).collect()
}
