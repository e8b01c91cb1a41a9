//! Whether a groom lies still if its strands carry their weight in the drawn shape: rest shapes, ten seconds, the largest motion
//! of a strand.

use std::io::Write;

use nalgebra::Vector3;
use superhelix::editing::Stiffening;
use superhelix::hair::{FitCurve, FitOptions, fit_curves};
use superhelix::io::{Curves, UpAxis};
use superhelix::{Solver, SolverOptions, StrandDef, StrandId, Workers};

use crate::Answer;

/// The columns of the table.
pub const HEAD: &str =
    "groom,metres_per_unit,known,strands,elements,unstable,stiffening95,stiffening100,moved,unconverged,quarantined,seconds";

/// Grooms whose size is known or follows from their head, metres per unit. Files with a unit use that; others are scaled so that
/// half of their strands are longer than `MEDIAN`.
const SCALES: [(&str, f64); 13] = [
    ("amd_ponytail", 0.0031),
    ("amd_bear", 0.01),
    ("amd_ratboy", 1.0),
    ("sintel", 0.01),
    ("fibermesh", 0.0012),
    ("yuksel", 0.0037),
    ("digitalsalon", 0.01),
    ("blender", 1.0),
    ("arnold_hair_test", 0.06),
    ("arnold_groom_sphere", 0.1),
    ("arnold_curly_torus", 0.01),
    ("arnold_motion", 0.03),
    ("tinyusdz_hair", 0.04),
];
/// Among those without an up axis these have z up; all others y.
const Z_UP: [&str; 1] = ["yuksel"];
/// m.
const MEDIAN: f64 = 0.1;
/// Grooms with at least this turning (median, degrees) get ten elements, others five.
const CURLY: f64 = 300.0;
/// Unstable strands are stiffened to this smallest eigenvalue.
const STABLE: f64 = 0.05;
const POINTS: usize = 9;

/// Fits the groom's strands, gives them rest shapes (unstable ones are stiffened as much as that takes), and leaves them alone
/// for ten seconds in steps of 1/60 s.
pub fn measure(name: &str, curves: &Curves, turning: f64, workers: &Workers, out: &mut impl Write) -> Answer<()> {
    let listed = SCALES.iter().find(|(known, _)| name.starts_with(known)).map(|(_, scale)| *scale);
    let known = listed.or(curves.extras().metres_per_unit);
    let mut lengths: Vec<f64> = (0..curves.strand_count()).map(|strand| curves.strand_length(strand)).collect();
    let scale = known.unwrap_or_else(|| MEDIAN / crate::at(&mut lengths, 0.5));
    let points: Vec<Vec<Vector3<f64>>> =
        curves.strands().map(|strand| strand.iter().map(|point| Vector3::from(point.map(f64::from)) * scale).collect()).collect();
    let inputs: Vec<FitCurve<'_>> = points.iter().map(|points| FitCurve::polyline(points)).collect();
    let elements = if turning < CURLY { 5 } else { 10 };
    let fits = fit_curves(&inputs, &FitOptions::elements(elements), workers)?;
    let defs = fits.into_iter().flatten().map(|fit| StrandDef {
        element_lengths: fit.element_lengths,
        root: fit.root,
        natural: fit.curvatures,
        ..StrandDef::straight(1.0, 1)
    });
    let z_up = curves.extras().up.map_or(Z_UP.iter().any(|known| name.starts_with(known)), |up| up == UpAxis::Z);
    let gravity = if z_up { -Vector3::z() } else { -Vector3::y() } * 9.81;
    let mut solver = Solver::new(SolverOptions { gravity, workers: workers.clone(), ..SolverOptions::default() })?;
    let ids = solver.add_strands(&defs.collect::<Vec<_>>())?;
    let unstable = solver.shape_stability(&ids)?.iter().filter(|found| !found.is_stable()).count();
    let mut stiffening = solver.stiffen(&ids, Stiffening::YoungsModulus, STABLE)?;
    let before = places(&solver, &ids)?;
    let (mut moved, mut unconverged, mut quarantined) = (0.0_f64, 0, 0);
    let mut seconds = 0.0;
    for step in 1..=600 {
        let report = solver.step(1.0 / 60.0, 1)?;
        unconverged += report.unconverged;
        quarantined += report.quarantined;
        seconds += report.seconds;
        if step % 30 == 0 {
            let now = places(&solver, &ids)?;
            for (k, (now, before)) in now.chunks(POINTS).zip(before.chunks(POINTS)).enumerate() {
                let furthest = now.iter().zip(before).map(|(now, before)| (now - before).norm()).fold(0.0, f64::max);
                moved = moved.max(furthest / solver.element_lengths(ids[k])?.iter().sum::<f64>());
            }
        }
    }
    let [s95, s100] = [0.95, 1.0].map(|share| crate::at(&mut stiffening, share));
    writeln!(
        out,
        "{name},{scale:.4e},{},{},{elements},{unstable},{s95:.3},{s100:.3},{moved:.3e},{unconverged},{quarantined},{seconds:.1}",
        u32::from(known.is_some()),
        ids.len()
    )?;
    out.flush()?;
    println!("{name}, N = {elements}: {unstable} of {} unstable as drawn; sag-free it moves {moved:.1e} L in 10 s", ids.len());
    Ok(())
}

/// Points along all strands.
fn places(solver: &Solver, ids: &[StrandId]) -> Answer<Vec<Vector3<f64>>> {
    let mut places = Vec::with_capacity(POINTS * ids.len());
    solver.sample_strands(ids, POINTS, |_, _, sample| places.push(sample.position))?;
    Ok(places)
}
