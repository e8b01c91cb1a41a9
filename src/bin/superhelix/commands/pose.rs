//! `superhelix pose`: a scene whose strands are posed, as a scene.
//!
//! Files:
//!
//! - `rest_arguments.rs`: Shapes taken as natural or rest shapes, on the command line.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::{Map, Value, json};

use crate::scene;
use crate::scene::posing::rest_arguments::RestArguments;
use crate::scene::strands::written as fit_scene;
use crate::scene::{Scene, SceneStrand, posing};
use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;
use crate::shell::json;
use crate::shell::json::Node;

/// Poses the strands of a scene: drags, brushes, bends, cuts, grows and mirrors them, changes their material, takes their shapes as natural or
/// rest shapes; and writes the scene with the strands that came of it.
///
/// The operations are those of the scene's key "posing", then those of --operations (docs/reference/scene_format.md), then those of the flags.
/// Exit status: 0 when the scene is written, 2 for a bad scene or bad operations, 1 for anything else.
#[derive(Debug, Args)]
pub struct PoseArguments {
    /// The scene: JSON; // and /* */ comments are allowed.
    #[arg(value_name = "SCENE.json")]
    scene: PathBuf,
    /// More operations: a JSON list as the scene's key "posing".
    #[arg(long, value_name = "OPERATIONS.json")]
    operations: Option<PathBuf>,
    #[command(flatten)]
    rest: RestArguments,
    /// Where the posed scene goes. Written whole or not at all; files that the scene names are named alike, so it should lie beside it.
    #[arg(long, short, value_name = "POSED.json")]
    out: PathBuf,
}

/// Runs the command.
pub fn run(arguments: &PoseArguments) -> Result<(), Failure> {
    let path = &arguments.scene;
    let mut scene = scene::load(path)?;
    if let Some(file) = &arguments.operations {
        let document = json::parse(&scene::read_text(file)?).map_err(|complaint| Failure::scene(file, &complaint))?;
        // Named as they would be in a scene.
        let node = Node { key: "posing".into(), value: &document };
        let operations = posing::read(&node, &scene.strands).map_err(|complaint| Failure::scene(file, &complaint))?;
        scene::do_posing(&mut scene, &operations).map_err(|complaint| Failure::scene(file, &complaint))?;
    }
    arguments.rest.apply(&mut scene, path)?;
    let document = json::parse(&scene::read_text(path)?).map_err(|complaint| Failure::scene(path, &complaint))?;
    write(&arguments.out, document, &scene)?;
    let images = scene.strands.iter().filter(|strand| strand.image_of.is_some()).count();
    crate::shell::answer::print_line(&format!(
        "{}: {} strands, {images} of them images",
        arguments.out.display(),
        scene.strands.len()
    ))
}

/// Keys of a strand that stand in place of others, or from which what is written here was made.
const REPLACED: [&str; 7] = ["elements", "length", "groom", "hair", "follicles", "only", "maps"];

/// Writes the document with the scene's strands.
fn write(path: &Path, mut document: Value, scene: &Scene) -> Result<(), Failure> {
    let given = document["strands"].as_array().cloned().unwrap_or_default();
    let strands: Vec<Value> = scene.strands.iter().map(|strand| one(&given, strand)).collect();
    if let Value::Object(map) = &mut document {
        map.insert("strands".into(), Value::Array(strands));
        map.remove("posing");
        // Each strand is an item now, and images are not drawn.
        if let Some(targets) = map.get_mut("targets").and_then(Value::as_array_mut) {
            for (target, made) in targets.iter_mut().zip(&scene.targets) {
                target["strands"] = json!(made.strands());
            }
        }
    }
    let mut file = AtomicFile::create(path)?;
    let text = serde_json::to_string_pretty(&document).map_err(|error| Failure::Other(error.to_string()))?;
    file.write_all(text.as_bytes())
        .and_then(|()| file.write_all(b"\n"))
        .map_err(|error| Failure::file(path, format!("cannot be written: {error}")))?;
    file.commit()
}

/// A strand as the file has it, with what may have changed.
fn one(given: &[Value], strand: &SceneStrand) -> Value {
    let mut map = match given.get(strand.item) {
        Some(Value::Object(map)) => map.clone(),
        _ => Map::new(),
    };
    REPLACED.iter().for_each(|key| {
        map.remove(*key);
    });
    if strand.image_of.is_some() {
        map.remove("root_motion");
    }
    for (name, value) in [("friction", strand.mapped.friction), ("wisp_radius", strand.mapped.wisp_radius)] {
        if let (Some(value), false) = (value, map.get("contact") == Some(&Value::Bool(false))) {
            let contact = map.entry("contact").or_insert(Value::Null);
            if !contact.is_object() {
                *contact = json!({});
            }
            contact[name] = json!(value);
        }
    }
    let Value::Object(made) = fit_scene::one(&strand.definition) else { return Value::Object(map) };
    // Where a root moves its motion says where it is.
    let moves = map.get("root_motion").is_some_and(|motion| !motion.is_null());
    if let (true, Some(motion)) = (moves, &strand.motion) {
        let [x, y, z]: [f64; 3] = motion.local.origin.into();
        map["root_motion"]["local"] = json!({ "origin": [x, y, z], "rotation": motion.local.rotation_xyzw() });
    }
    for (key, value) in made {
        if !(moves && key == "root") {
            map.insert(key, value);
        }
    }
    map.insert("initial_curvatures".into(), json!(strand.definition.initial));
    map.insert("initial_rates".into(), json!(strand.definition.initial_rates));
    Value::Object(map)
}
