//! `superhelix place`: follicles scattered over a mesh.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use nalgebra::Vector3;
use serde_json::json;
use superhelix::files::curves::Curves;
use superhelix::files::obj_mesh;
use superhelix::groom::scalp::{Amount, Density, Follicle, Scalp, ScatterOptions, Scattered};

use crate::atomic_file::AtomicFile;
use crate::failure::Failure;
use crate::simulate::positive;

/// Scatters follicles over a mesh, evenly or as densely as a map says, and writes their frames.
#[derive(Debug, Args)]
#[command(group(ArgGroup::new("amount").required(true).args(["count", "spacing"])))]
pub struct PlaceArguments {
    /// The mesh: .obj with faces, wound anticlockwise seen from outside.
    #[arg(value_name = "MESH.obj")]
    mesh: PathBuf,
    /// That many follicles, as far from each other as they come.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    count: Option<u32>,
    /// As many as fit without two nearer to each other than this, m.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    spacing: Option<f64>,
    /// Metres a unit of the mesh.
    #[arg(long, value_name = "METRES", default_value_t = 1.0, value_parser = positive)]
    scale: f64,
    #[command(flatten)]
    region: RegionArguments,
    /// Seed.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Where the follicles go: a line each, with triangle, shares of its second and third corner, position (m) and rotation (quaternion).
    #[arg(long, short, value_name = "FOLLICLES.csv")]
    out: PathBuf,
    /// The answer as JSON.
    #[arg(long)]
    json: bool,
}

/// Where on a mesh follicles stand.
#[derive(Debug, Args)]
pub struct RegionArguments {
    /// Relative densities: a text file with a number of 0 or above for each vertex of the mesh.
    #[arg(long, value_name = "NUMBERS.txt")]
    density: Option<PathBuf>,
    /// Only near the roots of this groom, which is in the mesh's units.
    #[arg(long, value_name = "GROOM", requires = "within")]
    near: Option<PathBuf>,
    /// How near to one of those roots, m.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    within: Option<f64>,
}

/// A mesh as a scalp, m.
pub fn read_scalp(path: &Path, scale: f64) -> Result<Scalp, Failure> {
    let mesh = obj_mesh::read(path)?;
    let vertices = mesh.vertices.iter().map(|vertex| vertex * scale).collect();
    Scalp::new(vertices, mesh.triangles, None, Vector3::x()).map_err(|error| Failure::file(path, error))
}

/// Follicles on a scalp, near some of the places where there are any. Names of what is wrong are those of the command line.
pub fn scatter(
    scalp: &Scalp,
    amount: Amount,
    density: Option<&Path>,
    near: Option<(&[Vector3<f64>], f64)>,
    seed: u64,
) -> Result<Scattered, Failure> {
    let mut map = None;
    if let Some(path) = density {
        let text = std::fs::read_to_string(path).map_err(|error| Failure::file(path, format!("cannot be read: {error}")))?;
        let numbers: Result<Vec<f64>, _> = text.split_ascii_whitespace().map(str::parse).collect();
        map = Some(numbers.map_err(|error| Failure::file(path, format!("{error}: expected a number for each vertex")))?);
    }
    if let Some((places, within)) = near {
        let nearness = |vertex: &Vector3<f64>| {
            let nearest = places.iter().map(|place| (place - vertex).norm_squared()).fold(f64::INFINITY, f64::min).sqrt();
            // Full up to the distance, none from twice it on: the mesh's vertices may be coarse.
            (2.0 - nearest / within).clamp(0.0, 1.0)
        };
        let region = scalp.vertices().iter().map(nearness);
        map = Some(match map {
            Some(map) => map.iter().zip(region).map(|(density, nearness)| density * nearness).collect(),
            None => region.collect(),
        });
    }
    let density = map.map_or(Density::Uniform, Density::Vertices);
    scalp.scatter(&ScatterOptions { amount, density, seed }).map_err(|error| Failure::Other(format!("--{error}")))
}

/// The roots of a groom's strands, m.
pub fn groom_roots(path: &Path, scale: f64) -> Result<Vec<Vector3<f64>>, Failure> {
    Ok(Curves::read(path)?.strands().map(|strand| Vector3::from(strand[0].map(f64::from)) * scale).collect())
}

/// Runs the command.
pub fn run(arguments: &PlaceArguments) -> Result<(), Failure> {
    let mut out = AtomicFile::create(&arguments.out)?;
    let scalp = read_scalp(&arguments.mesh, arguments.scale)?;
    let amount = match (arguments.count, arguments.spacing) {
        (Some(count), _) => Amount::Count(count as usize),
        (None, spacing) => Amount::Spacing(spacing.unwrap_or_default()),
    };
    let roots = arguments.region.near.as_deref().map(|path| groom_roots(path, arguments.scale)).transpose()?;
    let near = roots.as_deref().zip(arguments.region.within);
    let scattered = scatter(&scalp, amount, arguments.region.density.as_deref(), near, arguments.seed)?;
    let text = table(&scalp, &scattered.follicles)?;
    std::io::Write::write_all(&mut out, text.as_bytes())
        .map_err(|error| Failure::file(&arguments.out, format!("cannot be written: {error}")))?;
    out.commit()?;
    let least = scattered.least_distance.is_finite().then_some(scattered.least_distance);
    let count = scattered.follicles.len();
    let answer = json!({ "follicles": count, "least_distance": least, "area": scalp.area() });
    crate::print_line(&if arguments.json {
        serde_json::to_string_pretty(&answer).map_err(|error| Failure::Other(error.to_string()))?
    } else {
        let apart = least.map_or_else(String::new, |least| format!(", at least {:.3} mm apart", 1e3 * least));
        format!("{}: {count} follicles{apart}", arguments.out.display())
    })
}

fn table(scalp: &Scalp, follicles: &[Follicle]) -> Result<String, Failure> {
    let mut text = "triangle,share_b,share_c,x_m,y_m,z_m,qx,qy,qz,qw\n".to_string();
    for (follicle, frame) in follicles.iter().zip(scalp.frames(scalp.vertices(), follicles)?) {
        let ([b, c], [x, y, z, w], p) = (follicle.shares, frame.rotation_xyzw(), frame.origin);
        let _ = writeln!(text, "{},{b},{c},{},{},{},{x},{y},{z},{w}", follicle.triangle, p.x, p.y, p.z);
    }
    Ok(text)
}
