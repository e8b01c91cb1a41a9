//! `maps` of a strand: parameters that vary from root to root.

use nalgebra::Vector3;
use superhelix::{Material, StrandDef};

use crate::scene::strands::root_values::{self, Item, Sources, Values};
use crate::shell::json::{Complaint, Node};

/// What a map can say.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Parameter {
    Radius,
    Density,
    YoungsModulus,
    PoissonRatio,
    InternalFriction,
    Viscosity,
    AirDrag,
    Length,
    Curl,
    Friction,
    WispRadius,
}

const PARAMETERS: [(&str, Parameter); 11] = [
    ("radius", Parameter::Radius),
    ("density", Parameter::Density),
    ("youngs_modulus", Parameter::YoungsModulus),
    ("poisson_ratio", Parameter::PoissonRatio),
    ("internal_friction", Parameter::InternalFriction),
    ("viscosity", Parameter::Viscosity),
    ("air_drag", Parameter::AirDrag),
    ("length", Parameter::Length),
    ("curl", Parameter::Curl),
    ("friction", Parameter::Friction),
    ("wisp_radius", Parameter::WispRadius),
];

/// The maps of an item of strands.
#[derive(Debug)]
pub struct Maps<'a> {
    sources: Sources<'a>,
    /// With the keys of the values.
    maps: Vec<(Parameter, String, Values)>,
}

/// What maps say at a root.
#[derive(Debug, Clone, Default)]
pub struct Mapped(Vec<(Parameter, f64)>);

/// What maps say of a strand's contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MappedContact {
    /// Coulomb's coefficient against colliders, whatever the direction.
    pub friction: Option<f64>,
    /// The radius against other strands, m.
    pub wisp_radius: Option<f64>,
}

impl<'a> Maps<'a> {
    /// Reads `maps` of an item. Neither length nor curl can be mapped of strands that have their shapes from a file.
    pub fn read(node: &Node, item: &'a Item<'a>) -> Result<Self, Complaint> {
        let names: Vec<&str> = ["mesh"].into_iter().chain(PARAMETERS.map(|(name, _)| name)).collect();
        let entries = node.object(&names)?;
        let sources = Sources::read(entries.get_unless_null("mesh"), item)?;
        let mut maps = Vec::new();
        for (name, parameter) in PARAMETERS {
            let Some(map) = entries.get_unless_null(name) else { continue };
            if item.is_groom() && matches!(parameter, Parameter::Length | Parameter::Curl) {
                return Err(map.complain("no such map for strands that have their shapes from a file"));
            }
            let values = sources.values(&map.object(&root_values::KEYS)?, &entries.path("mesh"), None)?;
            maps.push((parameter, map.key.clone(), values));
        }
        Ok(Self { sources, maps })
    }

    /// What they say at the root (m, in the frame in which the mesh has its pose) of a strand that has that number in its file.
    pub fn at(&self, root: &Vector3<f64>, strand: usize) -> Result<Mapped, Complaint> {
        let root = self.sources.root(root, strand);
        let value = |(parameter, key, values): &(Parameter, String, Values)| match self.sources.value(values, &root) {
            value if value.is_finite() => Ok((*parameter, value)),
            _ => Err(Complaint::new(key, format!("has no number for strand {strand}"))),
        };
        Ok(Mapped(self.maps.iter().map(value).collect::<Result<_, _>>()?))
    }
}

impl Mapped {
    fn get(&self, parameter: Parameter) -> Option<f64> {
        self.0.iter().find(|(other, _)| *other == parameter).map(|(_, value)| *value)
    }

    /// A material with what they say of it.
    pub fn material(&self, material: Material) -> Material {
        let get = |parameter, otherwise| self.get(parameter).unwrap_or(otherwise);
        let wider = self.get(Parameter::Radius).map_or(1.0, |mean| mean / material.mean_radius());
        Material {
            radius: material.radius.map(|radius| radius * wider),
            density: get(Parameter::Density, material.density),
            youngs_modulus: get(Parameter::YoungsModulus, material.youngs_modulus),
            poisson_ratio: get(Parameter::PoissonRatio, material.poisson_ratio),
            internal_friction: get(Parameter::InternalFriction, material.internal_friction),
            viscosity: get(Parameter::Viscosity, material.viscosity),
            air_drag: get(Parameter::AirDrag, material.air_drag),
        }
    }

    /// Lengths of elements with what they say of the whole, m.
    pub fn lengths(&self, lengths: &[f64]) -> Vec<f64> {
        let all: f64 = lengths.iter().sum();
        let longer = self.get(Parameter::Length).map_or(1.0, |length| length / all);
        lengths.iter().map(|length| length * longer).collect()
    }

    /// Gives a strand's natural and initial shapes the curl that they say.
    pub fn curl(&self, definition: &mut StrandDef) {
        let Some(curl) = self.get(Parameter::Curl) else { return };
        let rows = definition.natural.iter_mut().chain(definition.initial.iter_mut().flatten());
        rows.flatten().for_each(|curvature| *curvature *= curl);
    }

    /// What they say of contact.
    pub fn contact(&self) -> MappedContact {
        MappedContact { friction: self.get(Parameter::Friction), wisp_radius: self.get(Parameter::WispRadius) }
    }
}

impl MappedContact {
    /// Checks that nothing is below zero; `key` names the maps.
    pub fn check(&self, key: &str) -> Result<(), Complaint> {
        for (name, value) in [("friction", self.friction), ("wisp_radius", self.wisp_radius)] {
            if let Some(value) = value.filter(|value| *value < 0.0) {
                return Err(Complaint::new(format!("{key}.{name}"), format!("gives {value}; expected numbers of 0 or more")));
            }
        }
        Ok(())
    }
}
