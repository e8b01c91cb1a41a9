//! `superhelix lock`: a lock of hair of a kind, as a scene.

use std::f64::consts::FRAC_PI_2;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::largest_turn;
use superhelix::hair::{CurlFormula, HairParameters, Variation};
use superhelix::internals::groom::curves::drawn::check_length;
use superhelix::{Frame, StrandDef};

use crate::groom::material_arguments::{MaterialArguments, in_words_of_flags};
use crate::scene::strands::written as fit_scene;
use crate::shell::argument_values::{not_negative, positive, triple};
use crate::shell::failure::Failure;
use crate::shell::up::Up;

/// Elements a strand where it is not said how many there are, unless a stretch of it turns them by more than a quarter turn; and the most then.
const USUAL_ELEMENTS: u32 = 40;
const MAX_ELEMENTS: usize = 1000;

/// Makes a lock of hair of a kind as a scene: strands side by side with the natural curl that was measured, and what varies between and along
/// them.
#[derive(Debug, Args)]
pub struct LockArguments {
    /// Strands.
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    strands: u32,
    /// Their length, m.
    #[arg(long, value_name = "METRES", default_value_t = 0.2, value_parser = positive)]
    length: f64,
    /// Helical elements a strand. Default: 40, more for each strand whose sharpest stretch needs them.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    elements: Option<u32>,
    /// Distance of neighbouring roots, m.
    #[arg(long, value_name = "METRES", default_value_t = 1e-3, value_parser = not_negative)]
    spacing: f64,
    /// The direction in which strands leave their roots.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, default_value = "0,0,-1", value_parser = triple)]
    direction: Vector3<f64>,
    /// How natural curvatures follow from the measured helix.
    #[arg(long, value_enum, default_value_t = Formula::Exact)]
    curl: Formula,
    /// No variation between and along strands (but for what --discipline below 0 adds).
    #[arg(long)]
    alike: bool,
    /// The axis that points up; gravity points the other way.
    #[arg(long, value_enum, value_name = "AXIS", default_value_t = Up::Z)]
    up: Up,
    #[command(flatten)]
    material: MaterialArguments,
    /// Where the scene goes.
    #[arg(long, short, value_name = "SCENE.json")]
    out: PathBuf,
}

/// See [`CurlFormula`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Formula {
    /// The helix itself.
    Exact,
    /// Bertails et al. 2006, section 4.2: for steps much shorter than the radius.
    Paper,
}

/// Runs the command.
pub fn run(arguments: &LockArguments) -> Result<(), Failure> {
    let formula = match arguments.curl {
        Formula::Exact => CurlFormula::Exact,
        Formula::Paper => CurlFormula::Paper,
    };
    let variation = if arguments.alike { Variation::none() } else { Variation::natural() };
    let hair = arguments.material.parameters(formula, variation)?;
    check_length(arguments.length, &hair.material).map_err(in_words_of_flags)?;
    let Some(direction) = arguments.direction.try_normalize(1e-12) else {
        return Err(Failure::Other("--direction is no direction; expected three numbers that are not all zero".into()));
    };
    // Straight back is a half turn about any axis across.
    let frame = UnitQuaternion::rotation_between(&Vector3::x(), &direction)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI));
    let strands = (0..arguments.strands).map(|index| strand(arguments, &hair, &frame, index));
    let strands = strands.collect::<Result<Vec<_>, Failure>>()?;
    fit_scene::write(&arguments.out, &strands, arguments.up.gravity())?;
    let [a1, a2] = hair.material.radius.map(|radius| radius * 1e6);
    let [twist, first, second] = hair.natural;
    let counts = strands.iter().map(|strand| strand.element_lengths.len());
    let (least, most) = (counts.clone().min().unwrap_or(0), counts.max().unwrap_or(0));
    let more = if most > least { format!(" to {most}") } else { String::new() };
    crate::shell::answer::print_line(&format!(
        "{}: {} strands of {least}{more} elements, {} m; semi-axes {a1:.1} and {a2:.1} um, natural twist {twist:.1}, curvatures {first:.1} and {second:.1} rad/m",
        arguments.out.display(),
        strands.len(),
        arguments.length
    ))
}

fn strand(
    arguments: &LockArguments,
    hair: &HairParameters,
    frame: &UnitQuaternion<f64>,
    index: u32,
) -> Result<StrandDef, Failure> {
    let mut count = arguments.elements.unwrap_or(USUAL_ELEMENTS) as usize;
    let (lengths, varied) = loop {
        let lengths = vec![arguments.length / count as f64; count];
        let varied = hair.strand(u64::from(index), &lengths).map_err(in_words_of_flags)?;
        let turn = largest_turn(&lengths, &varied.natural);
        if arguments.elements.is_some() || turn <= FRAC_PI_2 || count >= MAX_ELEMENTS {
            break (lengths, varied);
        }
        count = ((count as f64 * turn / FRAC_PI_2).ceil() as usize).clamp(count + 1, MAX_ELEMENTS);
    };
    // Roots on a spiral, by the golden angle: evenly, and as many as one likes.
    let (radius, angle) = (arguments.spacing * f64::from(index).sqrt() * 0.6, 2.399_963_229_728_653 * f64::from(index));
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), varied.root_turn);
    Ok(StrandDef {
        element_lengths: lengths,
        material: varied.material,
        natural: varied.natural,
        root: Frame { origin: frame * Vector3::new(0.0, radius * angle.cos(), radius * angle.sin()), rotation: frame * turn },
        ..StrandDef::straight(1.0, 1)
    })
}
