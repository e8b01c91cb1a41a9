//! The operations of `posing` done to a scene's strands.

use superhelix::editing::{DragTarget, PoseOptions};
use superhelix::{Error, Result, Solver, StrandDef, StrandId};

use crate::scene::Scene;
use crate::scene::SceneStrand;
use crate::scene::posing::{Action, How, Operation};
use crate::shell::json::Complaint;

/// Does the operations one after the other, in a solver of the scene's strands, colliders and attachments at its start; strands, their
/// materials and images are the scene's then.
pub fn apply(scene: &mut Scene, operations: &[Operation]) -> std::result::Result<(), Complaint> {
    if operations.is_empty() {
        return Ok(());
    }
    let complain = |error: Error| Complaint::new("posing", error.to_string());
    let mut posing = Posing::new(scene).map_err(complain)?;
    for operation in operations {
        let strands = posing.strands(operation)?;
        posing.act(&strands, &operation.action).map_err(|error| in_words(&operation.key, error))?;
    }
    posing.take_back(scene).map_err(complain)
}

/// The engine's own names of what an operation has other names for.
fn in_words(key: &str, error: Error) -> Complaint {
    let Error::InvalidArgument { argument, value, expected } = error else { return Complaint::new(key, error.to_string()) };
    let (part, inner) = argument.split_once('.').map_or((argument.as_str(), ""), |(part, inner)| (part, inner));
    let name = match part.split('[').next().unwrap_or(part) {
        "ids" => "strands".to_string(),
        "arclengths" => "arclength".to_string(),
        "elements" => "element".to_string(),
        "changes" if inner.is_empty() => return Complaint::value(key, value, expected),
        _ => inner.to_string(),
    };
    let key = if name.is_empty() { key.to_string() } else { format!("{key}.{name}") };
    Complaint::value(key, value, expected)
}

/// The scene's strands while they are posed.
struct Posing {
    solver: Solver,
    ids: Vec<StrandId>,
    /// Of the images: whose they are.
    images: Vec<usize>,
}

impl Posing {
    fn new(scene: &Scene) -> Result<Self> {
        let mut solver = Solver::new(scene.options.clone())?;
        let definitions: Vec<StrandDef> = scene.strands.iter().map(|strand| strand.definition.clone()).collect();
        let ids = solver.add_strands(&definitions)?;
        solver.add_bodies(scene.colliders.iter().map(|collider| collider.definition.clone()).collect())?;
        for (strand, id) in scene.strands.iter().zip(&ids) {
            solver.set_contact(&[*id], strand.contact.as_ref())?;
        }
        let constraints = scene.attachments.iter().map(|attachment| attachment.constraint(&solver, &ids));
        let constraints = constraints.collect::<Result<Vec<_>>>()?;
        solver.add_constraints(&constraints)?;
        Ok(Self { solver, ids, images: Vec::new() })
    }

    /// The strands that an operation is for.
    fn strands(&self, operation: &Operation) -> std::result::Result<Vec<usize>, Complaint> {
        let Some(strands) = &operation.strands else { return Ok((0..self.ids.len()).collect()) };
        let (key, count) = (format!("{}.strands", operation.key), self.ids.len());
        match strands.iter().position(|strand| *strand >= count) {
            Some(at) if count == 0 => Err(Complaint::value(format!("{key}[{at}]"), strands[at], "none: there are no strands")),
            Some(at) => Err(Complaint::value(format!("{key}[{at}]"), strands[at], format!("0 to {}", count - 1))),
            None => Ok(strands.clone()),
        }
    }

    fn act(&mut self, strands: &[usize], action: &Action) -> Result<()> {
        let ids: Vec<StrandId> = strands.iter().map(|strand| self.ids[*strand]).collect();
        let solver = &mut self.solver;
        match action {
            Action::Drag { arclength, target, how } => {
                let mut targets = Vec::with_capacity(ids.len());
                for id in &ids {
                    let length = solver.element_lengths(*id)?.iter().sum();
                    targets.push(DragTarget { arclength: arclength.unwrap_or(length), position: *target });
                }
                solver.drag(&ids, &targets, &options(solver, &ids, how)?)?;
            }
            Action::Brush(brush, how) => {
                solver.brush(&ids, brush, &options(solver, &ids, how)?)?;
            }
            Action::Element(element, change) => {
                solver.change_elements(&ids, &vec![*element; ids.len()], &vec![*change; ids.len()])?;
            }
            Action::Cut(arclength) => {
                // Those that are shorter stay.
                let mut places = Vec::with_capacity(ids.len());
                for id in &ids {
                    places.push(arclength.min(solver.element_lengths(*id)?.iter().sum()));
                }
                solver.cut(&ids, &places)?;
            }
            Action::Grow(growth) => solver.grow(&ids, growth)?,
            Action::Mirror(plane) => {
                self.ids.extend(solver.add_mirrored(&ids, plane)?);
                // An image of an image is one of the first strand.
                let first = self.ids.len() - ids.len() - self.images.len();
                let of = strands.iter().map(|strand| if *strand < first { *strand } else { self.images[*strand - first] });
                let of: Vec<usize> = of.collect();
                self.images.extend(of);
            }
            Action::Material(change) => {
                let mut materials = Vec::with_capacity(ids.len());
                for id in &ids {
                    materials.push(change.applied(solver.material(*id)?));
                }
                if !ids.is_empty() {
                    solver.set_materials(&ids, &materials)?;
                }
            }
            Action::TakeNatural => solver.take_natural_shapes(&ids)?,
            Action::TakeRest(None) => solver.take_rest_shapes(&ids)?,
            Action::TakeRest(Some((by, margin))) => {
                solver.stiffen(&ids, *by, *margin)?;
            }
        }
        Ok(())
    }

    /// Makes the scene's strands those of the solver.
    fn take_back(self, scene: &mut Scene) -> Result<()> {
        let Self { solver, ids, images } = self;
        for of in images {
            let SceneStrand { definition, contact, mapped, item, name, .. } = &scene.strands[of];
            let definition = StrandDef {
                root_velocity: nalgebra::Vector3::zeros(),
                root_angular_velocity: nalgebra::Vector3::zeros(),
                ..definition.clone()
            };
            let name = name.clone();
            scene.strands.push(SceneStrand {
                definition,
                name,
                motion: None,
                item: *item,
                contact: *contact,
                mapped: *mapped,
                image_of: Some(of),
            });
        }
        for (strand, id) in scene.strands.iter_mut().zip(ids) {
            let definition = &mut strand.definition;
            definition.root = solver.root_frame(id)?;
            definition.material = *solver.material(id)?;
            definition.element_lengths = solver.element_lengths(id)?.to_vec();
            definition.natural = solver.natural_curvatures(id)?.to_vec();
            let (rows, rates) = (solver.curvatures(id)?, solver.rates(id)?);
            definition.initial = (rows != definition.natural).then(|| rows.to_vec());
            definition.initial_rates = rates.iter().flatten().any(|rate| *rate != 0.0).then(|| rates.to_vec());
        }
        Ok(())
    }
}

/// The options of a drag or a brush for these strands.
fn options(solver: &Solver, ids: &[StrandId], how: &How) -> Result<PoseOptions> {
    let How { elements, natural_pull, keep_tip_direction, keep_out, clearance } = *how;
    let mut movable = None;
    if let Some([first, last]) = elements {
        let mut all = Vec::new();
        for id in ids {
            all.extend((0..solver.element_lengths(*id)?.len()).map(|element| (first..=last).contains(&element)));
        }
        movable = Some(all);
    }
    Ok(PoseOptions { movable, natural_pull, keep_tip_direction, keep_out, clearance })
}
