//! A groom's polylines made into strands: fitted, given a material and a natural shape.

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

use clap::ValueEnum;
use nalgebra::Vector3;
use rayon::prelude::*;
use serde::Serialize;
use superhelix::contact::shape::Shape;
use superhelix::error::Error;
use superhelix::groom::fit::{Fit, FitCurve, FitOptions, FitScratch, fit_curve, natural_under_gravity_with};
use superhelix::groom::hair_parameters::curled_shape;
use superhelix::groom::outside::{BroughtOut, bring_out};
use superhelix::groom::stability::{Stability, stability_under_gravity};
use superhelix::rod::material::Material;
use superhelix::rod::turning::largest_turn;
use superhelix::solver::Stiffening;
use superhelix::solver::definition::StrandDef;

use crate::failure::Failure;
use crate::material_arguments::{GroomHair, MaterialArguments};
use crate::rest_arguments::StiffeningArguments;
use crate::unit::Polyline;

/// Most elements of a strand where it is not said how many there are.
const MOST_ELEMENTS: usize = 100;
/// How often a strand is fitted again by more: a finer fit follows curls that a coarser one cut short.
const REFITS: usize = 12;

/// What a strand's natural shape is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum NaturalShape {
    /// Such that the strand hangs under gravity as the groom has it.
    SagFree,
    /// The groom's shape itself: the strand sags from it.
    AsDrawn,
}

/// How strands are made.
#[derive(Debug, Clone, Copy)]
pub struct StrandRecipe<'a> {
    /// Helical elements a strand.
    pub elements: usize,
    /// Whether a strand with a sharper stretch than these can follow has more.
    pub refine: bool,
    /// Section, material, and what the sliders do to natural shapes.
    pub hair: GroomHair,
    /// Natural shape.
    pub natural: NaturalShape,
    /// By what strands that hang unstably are made stiffer, and how far from the border they are to be then; for sag-free ones.
    pub stiffening: Option<(Stiffening, f64)>,
    /// Gravity, m/s².
    pub gravity: Vector3<f64>,
    /// That of the solver, so that the balance is exact there.
    pub quadrature_tolerance: f64,
    /// What strands drawn inside of it are brought out of, and how far from its surface, m.
    pub outside: Option<(&'a Shape, f64)>,
}

/// A strand of the groom that is not simulated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Skipped {
    /// Its index in the file.
    pub strand: usize,
    /// Why.
    pub because: String,
}

/// A strand that is.
#[derive(Debug, Clone)]
pub struct GroomStrand {
    /// Its index in the file.
    pub index: usize,
    /// What the solver makes it from.
    pub definition: StrandDef,
    /// Distance between polyline and centreline at equal arclength, m: root mean square and largest.
    pub fit_error: (f64, f64),
    /// How firmly it rests as drawn by its own stiffness, where it is to.
    pub stability: Option<Stability>,
    /// What was brought out of the body.
    pub brought_out: BroughtOut,
}

/// Makes strands from polylines. `done` is called after each, from any thread.
pub fn make(
    polylines: &[Polyline],
    recipe: &StrandRecipe<'_>,
    threads: usize,
    done: impl Fn() + Sync,
) -> Result<(Vec<GroomStrand>, Vec<Skipped>), Failure> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Failure::Other(format!("{threads} threads cannot be had: {error}")))?;
    let made: Vec<Result<GroomStrand, Skipped>> = pool.install(|| {
        polylines
            .par_iter()
            .map(|polyline| {
                let strand = make_one(polyline, recipe);
                done();
                strand.map_err(|because| Skipped { strand: polyline.index, because })
            })
            .collect()
    });
    let (mut strands, mut skipped) = (Vec::new(), Vec::new());
    for strand in made {
        match strand {
            Ok(strand) => strands.push(strand),
            Err(reason) => skipped.push(reason),
        }
    }
    Ok((strands, skipped))
}

fn make_one(polyline: &Polyline, recipe: &StrandRecipe<'_>) -> Result<GroomStrand, String> {
    let index = polyline.index;
    let length: f64 = polyline.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    check_length(length, &recipe.hair.material)?;
    let mut outside = Cow::Borrowed(&polyline.points[..]);
    let mut brought_out = BroughtOut::default();
    if let Some((body, clearance)) = recipe.outside {
        // Edges keep their lengths, and so do the pieces of curve that they stand for.
        brought_out = bring_out(outside.to_mut(), body, clearance).map_err(|error| error.to_string())?;
    }
    let fit = fit(&FitCurve { points: &outside, ..polyline.curve() }, recipe)?;
    let fit_error = (fit.rms_error, fit.max_error);
    let (definition, stability) = definition(index, fit, recipe).map_err(|error| error.to_string())?;
    Ok(GroomStrand { index, definition, fit_error, stability, brought_out })
}

/// A fit by the recipe's elements, or by as many as keep each within a quarter turn, but no more than four a point of the polyline.
fn fit(curve: &FitCurve<'_>, recipe: &StrandRecipe<'_>) -> Result<Fit, String> {
    let mut scratch = FitScratch::default();
    let mut by =
        |elements: usize| fit_curve(curve, &FitOptions::elements(elements), &mut scratch).map_err(|error| error.to_string());
    let mut fit = by(recipe.elements)?;
    let most = (4 * curve.points.len()).min(MOST_ELEMENTS);
    for _ in 0..REFITS {
        let (elements, turn) = (fit.element_lengths.len(), largest_turn(&fit.element_lengths, &fit.curvatures));
        if !recipe.refine || turn <= FRAC_PI_2 || elements >= most {
            break;
        }
        fit = by(((elements as f64 * turn / FRAC_PI_2).ceil() as usize).clamp(elements + 1, most))?;
    }
    Ok(fit)
}

/// Strands whose natural shape is the drawn one hang in another, which is not known yet.
pub fn check_stiffening(
    natural: NaturalShape,
    stiffening: &StiffeningArguments,
    material: &MaterialArguments,
) -> Result<(), Failure> {
    if stiffening.stiffening().is_none() {
        return Ok(());
    }
    if natural == NaturalShape::AsDrawn {
        return Err(Failure::Other("--stiffen needs --natural sag-free: it is rest that takes stiffness".into()));
    }
    match material.reshaping() {
        Some(flag) => {
            Err(Failure::Other(format!("--stiffen with {flag}: strands would not rest in the shape that is stiffened")))
        }
        None => Ok(()),
    }
}

/// A strand that is not longer than wide cannot be simulated.
pub fn check_length(length: f64, material: &Material) -> Result<(), String> {
    let width = 2.0 * material.radius[0].max(material.radius[1]);
    if length <= width {
        return Err(format!("its length of {length:.3e} m is not more than its width of {width:.3e} m"));
    }
    Ok(())
}

/// A fitted strand, number `index` of its file, made into one that can be simulated; else why not.
pub fn of_fit(index: usize, fit: Fit, recipe: &StrandRecipe<'_>) -> Result<StrandDef, String> {
    check_length(fit.element_lengths.iter().sum(), &recipe.hair.material)?;
    definition(index, fit, recipe).map(|(definition, _)| definition).map_err(|error| error.to_string())
}

/// A fitted strand with a material and a natural shape, and how firmly that would have rested without stiffening. It begins as it was drawn.
fn definition(index: usize, fit: Fit, recipe: &StrandRecipe<'_>) -> Result<(StrandDef, Option<Stability>), Error> {
    let mut stability = None;
    let mut definition = StrandDef {
        element_lengths: fit.element_lengths,
        material: recipe.hair.material,
        root: fit.root,
        natural: fit.curvatures.clone(),
        ..StrandDef::straight(1.0, 1)
    };
    if recipe.natural == NaturalShape::SagFree {
        let found = stability_under_gravity(&definition, &fit.curvatures, recipe.gravity)?;
        stability = Some(found);
        if let Some((by, margin)) = recipe.stiffening {
            definition.material = by.applied(&definition.material, by.scale(&found, margin)?);
        }
        definition.natural =
            natural_under_gravity_with(&definition, &fit.curvatures, recipe.gravity, recipe.quadrature_tolerance)?;
    }
    if recipe.natural == NaturalShape::SagFree || recipe.hair.reshapes() {
        definition.initial = Some(fit.curvatures);
    }
    if recipe.hair.reshapes() {
        let GroomHair { curliness, variation, .. } = &recipe.hair;
        let curled = curled_shape(&definition.element_lengths, &definition.natural, *curliness)?;
        definition.natural = variation.of_shape(index as u64, &definition.element_lengths, &curled)?;
        stability = None;
    }
    Ok((definition, stability))
}
