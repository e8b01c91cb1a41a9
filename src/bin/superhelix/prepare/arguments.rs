//! The flags of `superhelix prepare`.

use std::path::PathBuf;

use clap::Args;

use crate::groom::material_arguments::MaterialArguments;
use crate::groom::wisp_arguments::WispArguments;
use crate::shell::argument_values::{not_negative, png, positive, share};
use crate::shell::up::Up;
use crate::stepping::motion_arguments::MotionArguments;

/// Makes strands of a reconstruction ready to be simulated: a scene for `superhelix run`, its files, a report, a picture.
///
/// Strands that cannot be used are dropped and listed, those that begin at the tip turned, roots put on the scalp, strands taken out of the
/// head, guides chosen that represent the others best, kept apart, fitted, made to rest as drawn; and all other strands bound to them.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct PrepareArguments {
    /// The strands: .ply points of strands, .npz, .npy, .data, .hair, .tfx, .obj with lines, .usda, .abc; root first.
    #[arg(value_name = "STRANDS")]
    pub strands: PathBuf,
    /// The head: a mesh that keeps strands out and carries their roots, .obj with faces, in the strands' axes. Closed but for its neck, best.
    #[arg(long, value_name = "MESH.obj")]
    pub head: Option<PathBuf>,
    /// The scalp: a mesh that carries the roots, where it is not the head. It keeps nothing out.
    #[arg(long, value_name = "MESH.obj")]
    pub scalp: Option<PathBuf>,
    /// Metres a unit of the strands. Default: what the file says (.usda), else 1, refused when hair of that size could not be.
    #[arg(long, visible_alias = "unit", value_name = "METRES", value_parser = positive)]
    pub scale: Option<f64>,
    /// Metres a unit of the meshes. Default: that of the strands.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    pub head_scale: Option<f64>,
    /// The axis that points up; gravity points the other way.
    #[arg(long, value_enum, value_name = "AXIS", default_value_t = Up::Y)]
    pub up: Up,
    /// Points a strand of a .ply that does not say it. Default: found by colours or by jumps.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..))]
    pub points_per_strand: Option<u32>,
    /// How many strands are simulated.
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub guides: u32,
    /// Strands whose roots are farther than this from the scalp are dropped, m.
    #[arg(long, value_name = "METRES", default_value_t = 0.01, value_parser = positive)]
    pub reach: f64,
    /// Strands that are nowhere farther than this from another are dropped, m; 0: only the very same.
    #[arg(long, value_name = "METRES", default_value_t = 1e-4, value_parser = not_negative)]
    pub near: f64,
    /// Strands no longer than this are dropped, m.
    #[arg(long, value_name = "METRES", default_value_t = 0.002, value_parser = not_negative)]
    pub least_length: f64,
    /// Strands are dropped of which more than this share of the length is deeper in the head than --reach.
    #[arg(long, value_name = "SHARE", default_value_t = 0.5, value_parser = share)]
    pub most_inside: f64,
    /// Guides touch each other in the scene, too, and not only the head.
    #[arg(long)]
    pub hair_contact: bool,
    #[command(flatten)]
    pub wisps: WispArguments,
    #[command(flatten)]
    pub material: MaterialArguments,
    #[command(flatten)]
    pub head_motion: MotionArguments,
    /// Length of the scene, s. Default: to the motion's end, else 2.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub duration: Option<f64>,
    /// Frames a second of the scene.
    #[arg(long, default_value_t = 30.0, value_parser = positive)]
    pub fps: f64,
    /// Points a render strand of the scene.
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u32).range(2..=4096))]
    pub points: u32,
    /// Directory of the scene and its files.
    #[arg(long, short, value_name = "DIR", required_unless_present = "dry_run")]
    pub out: Option<PathBuf>,
    /// Replace a scene that the directory already holds.
    #[arg(long)]
    pub overwrite: bool,
    /// A picture: the strands as read, as prepared, and as grown from the guides.
    #[arg(long, value_name = "FILE.png", value_parser = png)]
    pub picture: Option<PathBuf>,
    /// Does everything and writes nothing but the report on standard output, and the picture.
    #[arg(long)]
    pub dry_run: bool,
    /// Threads.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=256))]
    pub threads: u32,
    /// The report as JSON on standard output.
    #[arg(long)]
    pub json: bool,
    /// Neither progress nor warnings.
    #[arg(long, short)]
    pub quiet: bool,
}
