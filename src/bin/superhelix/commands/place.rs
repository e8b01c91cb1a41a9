//! `superhelix place`: follicles scattered over a mesh, or put where texture coordinates say.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use serde_json::json;
use superhelix::hair::{Amount, Follicle, GuideRoots, Jitter, RootRegion, Scalp, Scattered};

use crate::shell::argument_values::{not_negative, positive};
use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;
use crate::surfaces::region::{DensityArguments, Mesh, Placement, groom_roots, in_flags};

/// Scatters follicles over a mesh, evenly or as densely as maps say, or puts them at texture coordinates, and writes their frames.
#[derive(Debug, Args)]
#[command(group(ArgGroup::new("amount").required(true).args(["count", "spacing", "uvs"])))]
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
    /// Follicles at these texture coordinates of the mesh: a text file with two numbers for each, u and v.
    #[arg(long, value_name = "UVS.txt", conflicts_with_all = ["density", "density_picture", "near"])]
    uvs: Option<PathBuf>,
    /// With --uvs: offsets each follicle at random by up to so much in u and in v.
    #[arg(long, value_name = "UV", value_parser = not_negative)]
    jitter: Option<f64>,
    /// Metres a unit of the mesh.
    #[arg(long, value_name = "METRES", default_value_t = 1.0, value_parser = positive)]
    scale: f64,
    #[command(flatten)]
    density: DensityArguments,
    /// Only near the roots of this groom, which is in the mesh's units.
    #[arg(long, value_name = "GROOM", requires = "within")]
    near: Option<PathBuf>,
    /// With --near: how near to one of those roots, m.
    #[arg(long, value_name = "METRES", value_parser = positive, requires = "near")]
    within: Option<f64>,
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

/// Runs the command.
pub fn run(arguments: &PlaceArguments) -> Result<(), Failure> {
    if arguments.jitter.is_some() && arguments.uvs.is_none() {
        return Err(Failure::Other("--jitter is of --uvs: scattered follicles stand in no rows".into()));
    }
    let mut out = AtomicFile::create(&arguments.out)?;
    let mesh = Mesh::read(&arguments.mesh, Placement::scaled(arguments.scale))?;
    let scattered = match (&arguments.uvs, arguments.count, arguments.spacing) {
        (Some(path), ..) => at_coordinates(&mesh, path, arguments)?,
        (None, Some(count), _) => scatter(&mesh, Amount::Count(count as usize), arguments)?,
        (None, None, spacing) => scatter(&mesh, Amount::Spacing(spacing.unwrap_or_default()), arguments)?,
    };
    let text = table(&mesh.scalp, &scattered.follicles)?;
    std::io::Write::write_all(&mut out, text.as_bytes())
        .map_err(|error| Failure::file(&arguments.out, format!("cannot be written: {error}")))?;
    out.commit()?;
    let least = scattered.least_distance.is_finite().then_some(scattered.least_distance);
    let count = scattered.follicles.len();
    let answer = json!({ "follicles": count, "least_distance": least, "area": mesh.scalp.area() });
    crate::shell::answer::print_answer(arguments.json, &answer, || {
        let apart = least.map_or_else(String::new, |least| format!(", at least {:.3} mm apart", 1e3 * least));
        format!("{}: {count} follicles{apart}", arguments.out.display())
    })
}

fn scatter(mesh: &Mesh, amount: Amount, arguments: &PlaceArguments) -> Result<Scattered, Failure> {
    let roots = arguments.near.as_deref().map(|path| groom_roots(path, arguments.scale)).transpose()?;
    let roots = roots.map(GuideRoots::new).transpose()?;
    let maps = arguments.density.read(mesh)?;
    let near = roots.zip(arguments.within.map(RootRegion::Within));
    mesh.scatter(amount, maps, near, arguments.seed).map_err(in_flags)
}

/// Follicles where a file of texture coordinates says. How far they are apart is not looked at.
fn at_coordinates(mesh: &Mesh, path: &Path, arguments: &PlaceArguments) -> Result<Scattered, Failure> {
    mesh.check_textured("--uvs")?;
    let text = std::fs::read_to_string(path).map_err(|error| Failure::file(path, format!("cannot be read: {error}")))?;
    let numbers: Result<Vec<f64>, _> =
        text.split(|c: char| c == ',' || c.is_ascii_whitespace()).filter(|w| !w.is_empty()).map(str::parse).collect();
    let numbers = numbers.map_err(|error| Failure::file(path, format!("{error}: expected two numbers for each follicle")))?;
    let (pairs, []) = numbers.as_chunks::<2>() else {
        return Err(Failure::file(path, format!("{} numbers; expected two for each follicle", numbers.len())));
    };
    let jitter = Jitter { amplitude: arguments.jitter.unwrap_or(0.0), seed: arguments.seed };
    let follicles = mesh.scalp.follicles_at(pairs, jitter).map_err(|error| Failure::file(path, error))?;
    Ok(Scattered { follicles, least_distance: f64::INFINITY })
}

fn table(scalp: &Scalp, follicles: &[Follicle]) -> Result<String, Failure> {
    let mut text = "triangle,share_b,share_c,x_m,y_m,z_m,qx,qy,qz,qw\n".to_string();
    for (follicle, frame) in follicles.iter().zip(scalp.frames(scalp.vertices(), follicles)?) {
        let ([b, c], [x, y, z, w], p) = (follicle.shares, frame.rotation_xyzw(), frame.origin);
        let _ = writeln!(text, "{},{b},{c},{},{},{},{x},{y},{z},{w}", follicle.triangle, p.x, p.y, p.z);
    }
    Ok(text)
}
