//! `hair` of a strand: a measured kind, sliders and variation, from which what the strand does not say itself is taken.

use superhelix::hair::{CurlFormula, HairParameters, HairType, Sliders, Variation, VariedStrand};

use crate::scene::words::in_words_of_the_scene;
use crate::shell::json::{Complaint, Node};

/// Hair of a kind, and which strand of it.
#[derive(Debug)]
pub struct SceneHair {
    parameters: HairParameters,
    strand: u64,
    key: String,
}

/// Reads `hair`.
pub fn read(node: &Node) -> Result<SceneHair, Complaint> {
    let hair = node.object(&[
        "type",
        "curl",
        "mean_radius",
        "ellipticity",
        "helix_radius",
        "helix_step",
        "youngs_modulus",
        "poisson_ratio",
        "density",
        "internal_friction",
        "air_drag",
        "sliders",
        "variation",
        "strand",
    ])?;
    let names = HairType::ALL.map(|kind| (kind.name(), kind));
    let mut measured = hair.require("type")?.choice(&names)?.measured();
    for (name, place) in [
        ("mean_radius", &mut measured.mean_radius),
        ("ellipticity", &mut measured.ellipticity),
        ("helix_radius", &mut measured.helix_radius),
        ("helix_step", &mut measured.helix_step),
        ("youngs_modulus", &mut measured.youngs_modulus),
        ("poisson_ratio", &mut measured.poisson_ratio),
        ("density", &mut measured.density),
        ("internal_friction", &mut measured.internal_friction),
        ("air_drag", &mut measured.air_drag),
    ] {
        *place = hair.or(name, *place, Node::number)?;
    }
    measured.check(&node.key).map_err(in_words_of_the_scene)?;
    let formulas = [("exact", CurlFormula::Exact), ("paper", CurlFormula::Paper)];
    let formula = hair.or("curl", CurlFormula::Exact, |node| node.choice(&formulas))?;
    let mut parameters = measured.parameters(formula).map_err(in_words_of_the_scene)?;
    if let Some(variation) = hair.get("variation") {
        parameters.variation = read_variation(variation)?;
        parameters.variation.check(&variation.key).map_err(in_words_of_the_scene)?;
    }
    if let Some(node) = hair.get("sliders") {
        let sliders = read_sliders(node)?;
        sliders.check(&node.key).map_err(in_words_of_the_scene)?;
        parameters = parameters.with_sliders(&sliders).map_err(in_words_of_the_scene)?;
    }
    let strand = hair.or("strand", 0, |node| node.whole(0..=u64::from(u32::MAX)))?;
    Ok(SceneHair { parameters, strand, key: node.key.clone() })
}

fn read_sliders(node: &Node) -> Result<Sliders, Complaint> {
    let entries = node.object(&["curliness", "stiffness", "discipline", "weight", "combing_ease"])?;
    let slider = |name: &str| entries.or(name, 0.0, Node::number);
    Ok(Sliders {
        curliness: slider("curliness")?,
        stiffness: slider("stiffness")?,
        discipline: slider("discipline")?,
        weight: slider("weight")?,
        combing_ease: slider("combing_ease")?,
    })
}

fn read_variation(node: &Node) -> Result<Variation, Complaint> {
    let entries = node.object(&["between", "along", "thickness", "frizz", "period", "root_turn", "seed"])?;
    let none = Variation::none();
    Ok(Variation {
        between: entries.or("between", none.between, Node::number)?,
        along: entries.or("along", none.along, Node::number)?,
        thickness: entries.or("thickness", none.thickness, Node::number)?,
        frizz: entries.or("frizz", none.frizz, Node::number)?,
        period: entries.or("period", none.period, Node::number)?,
        root_turn: entries.or("root_turn", none.root_turn, Node::number)?,
        seed: entries.or("seed", 0, |node| node.whole(0..=u64::from(u32::MAX)))?,
    })
}

impl SceneHair {
    /// The strand with elements of these lengths, so many after the one that the scene names.
    pub fn strand(&self, after: u64, element_lengths: &[f64]) -> Result<VariedStrand, Complaint> {
        let made = self.parameters.strand(self.strand + after, element_lengths);
        made.map_err(|error| Complaint::new(&self.key, error.to_string()))
    }
}
