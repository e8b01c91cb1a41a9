//! What `superhelix prepare` writes: a scene, its guides and bust, and the strands that are bound to the guides.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use nalgebra::Vector3;
use serde::Serialize;
use serde_json::{Value, json};
use superhelix::hair::DrawnCurve;
use superhelix::io::{Curves, Extras, UpAxis, distance_grid};
use superhelix::{ContactOptions, Frame, Friction, StrandContact};

use super::arguments::PrepareArguments;
use super::guides::Guides;
use super::head::Body;
use crate::scene::strands::written;
use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;
use crate::shell::up::Up;
use crate::stepping::head::Head;
use crate::surfaces::surface::Surface;

/// Samples of a head's motion a second.
const MOTION_RATE: f64 = 120.0;
/// Samples beyond the end, so that the motion does not stop there.
const BEYOND: u32 = 4;
/// Steps a second, at least.
const STEPS: f64 = 60.0;
/// Newton's tolerance, rad.
const TOLERANCE: f64 = 1e-4;

/// Names of the files.
const SCENE: &str = "scene.json";
const GUIDES: &str = "guides.usda";
const STRANDS: &str = "strands.hair";
const GRID: &str = "head.shxgrid";
const MESH: &str = "head.obj";
const RENDER: &str = "render";
const REPORT: &str = "report.json";

/// The files that were written.
#[derive(Debug, Clone, Serialize)]
pub struct Files {
    /// For `superhelix run`.
    pub scene: PathBuf,
    /// The guides as fitted.
    pub guides: PathBuf,
    /// All strands, m: their roots are those of the render hair.
    pub strands: PathBuf,
    /// The head as the scene has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub head: Option<PathBuf>,
    /// The head's mesh, m, for pictures.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<PathBuf>,
    /// The report.
    pub report: PathBuf,
}

/// How long the scene is, and what it moves by.
pub struct Motion {
    /// The head, if it moves.
    pub head: Option<Head>,
    /// Length of the scene, s.
    pub duration: f64,
}

impl Files {
    /// The files in a directory.
    pub fn in_directory(directory: &Path, body: Option<&Body>) -> Self {
        let grid = body.map(|body| body.grid().is_some());
        Self {
            scene: directory.join(SCENE),
            guides: directory.join(GUIDES),
            strands: directory.join(STRANDS),
            head: grid.map(|grid| directory.join(if grid { GRID } else { MESH })),
            mesh: grid.map(|_| directory.join(MESH)),
            report: directory.join(REPORT),
        }
    }

    /// Makes the directory, and refuses one that holds a scene unless it is to be replaced.
    pub fn begin(&self, directory: &Path, overwrite: bool) -> Result<(), Failure> {
        fs::create_dir_all(directory).map_err(|error| Failure::file(directory, format!("cannot be made: {error}")))?;
        let all = [&self.scene, &self.guides, &self.strands, &self.report];
        match all.into_iter().chain(&self.head).chain(&self.mesh).find(|path| path.exists() && !overwrite) {
            Some(path) => Err(Failure::file(path, "is there already: give --overwrite to replace it")),
            None => Ok(()),
        }
    }

    /// Writes all but the report.
    pub fn write(
        &self,
        arguments: &PrepareArguments,
        curves: &[DrawnCurve],
        guides: &Guides,
        body: Option<&Body>,
        motion: &Motion,
    ) -> Result<(), Failure> {
        write_strands(&self.strands, curves)?;
        write_guides(&self.guides, guides, arguments.up)?;
        if let (Some(body), Some(mesh)) = (body, &self.mesh) {
            write_mesh(mesh, &body.surface)?;
            if let (Some(grid), Some(path)) = (body.grid(), &self.head) {
                distance_grid::write(path, grid)?;
            }
        }
        write_scene(&self.scene, arguments, guides, body, motion)
    }
}

fn narrowed(point: &Vector3<f64>) -> [f32; 3] {
    point.map(|value| value as f32).into()
}

/// All strands, m.
fn write_strands(path: &Path, curves: &[DrawnCurve]) -> Result<(), Failure> {
    let strands: Vec<Vec<[f32; 3]>> = curves.iter().map(|curve| curve.points.iter().map(narrowed).collect()).collect();
    Ok(Curves::from_strands(&strands)?.write(path)?)
}

/// The guides' centrelines, m.
fn write_guides(path: &Path, guides: &Guides, up: Up) -> Result<(), Failure> {
    const SAMPLES: usize = 33;
    let mut solver = superhelix::Solver::new(superhelix::SolverOptions::default())?;
    let definitions: Vec<_> = guides.strands.iter().map(|strand| strand.definition.clone()).collect();
    let ids = solver.add_strands(&definitions)?;
    let mut points = vec![[0.0; 3]; ids.len() * SAMPLES];
    solver
        .sample_strands(&ids, SAMPLES, |strand, point, sample| points[strand * SAMPLES + point] = narrowed(&sample.position))?;
    let extras =
        Extras { metres_per_unit: Some(1.0), up: Some(if up == Up::Y { UpAxis::Y } else { UpAxis::Z }), ..Extras::default() };
    Ok(Curves::from_counts(vec![SAMPLES as u32; ids.len()], points)?.with_extras(extras)?.write(path)?)
}

/// A mesh, m.
fn write_mesh(path: &Path, surface: &Surface) -> Result<(), Failure> {
    let mut file = AtomicFile::create(path)?;
    let fail = |error: std::io::Error| Failure::file(path, format!("cannot be written: {error}"));
    for vertex in &surface.vertices {
        writeln!(file, "v {} {} {}", vertex.x, vertex.y, vertex.z).map_err(fail)?;
    }
    for triangle in &surface.triangles {
        let [a, b, c] = triangle.map(|vertex| vertex + 1);
        writeln!(file, "f {a} {b} {c}").map_err(fail)?;
    }
    file.commit()
}

/// The head's motion: its frame is the world's at the start.
fn motion_of(head: &Head, duration: f64) -> Value {
    let count = (duration * MOTION_RATE).ceil() as u32 + BEYOND;
    let (mut times, mut frames, mut now) = (Vec::new(), Vec::new(), Vec::new());
    for sample in 0..=count {
        let time = f64::from(sample) / MOTION_RATE;
        head.roots(time, &[Frame::default()], &mut now);
        let ([x, y, z], [qx, qy, qz, qw]): ([f64; 3], [f64; 4]) = (now[0].origin.into(), now[0].rotation_xyzw());
        times.push(time);
        frames.push([x, y, z, qx, qy, qz, qw]);
    }
    json!({ "times": times, "frames": frames })
}

fn friction(friction: Friction) -> Value {
    json!({ "along": friction.along, "against": friction.against })
}

/// The scene but for its strands.
fn scene_of(arguments: &PrepareArguments, contact: &StrandContact, body: Option<&Body>, motion: &Motion) -> Value {
    let [x, y, z]: [f64; 3] = arguments.up.gravity().into();
    let frame = 1.0 / arguments.fps;
    let substeps = (STEPS * frame).ceil().max(1.0);
    let mut scene = json!({
        "version": 1,
        "gravity": [x, y, z],
        "time_step": frame / substeps,
        "duration": motion.duration,
        "output_interval": frame,
        "threads": arguments.threads,
        "newton": { "max_iterations": 50, "tolerance": TOLERANCE },
        "output": [{ "kind": "points", "samples": 17 }],
        "render_hair": {
            "out": RENDER,
            "overwrite": true,
            "roots": { "file": STRANDS, "metres_per_unit": 1.0, "shapes": true },
            "points": arguments.points,
            "curliness": 0.0,
            "wisps": 1,
            "flyaways": 0.0,
            "length_variation": 0.0,
        },
    });
    let moves = motion.head.as_ref().map(|head| motion_of(head, motion.duration));
    if let Some(body) = body {
        let mut collider = match body.grid() {
            Some(_) => json!({ "shape": "grid", "file": GRID }),
            None => json!({ "shape": "mesh", "file": MESH, "sides": "front", "depth": 0.02 }),
        };
        if moves.is_some() {
            collider["motion"] = json!("head");
        }
        scene["colliders"] = json!([collider]);
    }
    if body.is_some() || arguments.hair_contact {
        scene["contact"] = json!({
            "model": "coulomb",
            "tolerance": ContactOptions::default().tolerance,
            "allow_overlaps": true,
            "strands": {
                "radius": contact.radius,
                "friction": friction(contact.friction),
                "viscous_friction": friction(contact.viscous_friction),
            },
        });
    }
    if arguments.hair_contact {
        scene["hair_contact"] = json!({ "wisp_radius": contact.wisp_radius, "friction": friction(contact.hair_friction) });
    }
    if let Some(moves) = moves {
        scene["motions"] = json!({ "head": moves });
    }
    scene
}

/// The scene, one strand a line.
fn write_scene(
    path: &Path,
    arguments: &PrepareArguments,
    guides: &Guides,
    body: Option<&Body>,
    motion: &Motion,
) -> Result<(), Failure> {
    let mut file = AtomicFile::create(path)?;
    let fail = |error: std::io::Error| Failure::file(path, format!("cannot be written: {error}"));
    let scene = scene_of(arguments, &guides.contact, body, motion);
    file.write_all(b"{").map_err(fail)?;
    for (key, value) in scene.as_object().into_iter().flatten() {
        write!(file, "\n  {}: {value},", Value::from(key.as_str())).map_err(fail)?;
    }
    file.write_all(b"\n  \"strands\": [").map_err(fail)?;
    for (index, strand) in guides.strands.iter().enumerate() {
        let mut value = written::one(&strand.definition);
        if motion.head.is_some() {
            let local = value["root"].take();
            value["root_motion"] = json!({ "motion": "head", "local": local });
            value.as_object_mut().map(|map| map.remove("root"));
        }
        let separator = if index == 0 { "\n    " } else { ",\n    " };
        write!(file, "{separator}{value}").map_err(fail)?;
    }
    file.write_all(b"\n  ]\n}\n").map_err(fail)?;
    file.commit()
}
