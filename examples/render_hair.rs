//! How well render strands replace real ones: some strands of a groom become guides, render strands grow at the roots of the
//! others, and both are compared: the length, the turning and the size of the curls that remain, and the distance of the two.
//!
//! `cargo run --profile demo --example render_hair -- OUT.csv`

use std::fmt::Write as _;
use std::sync::{Arc, Mutex};

use nalgebra::Vector3;
use superhelix::io::Curves;
use superhelix::render::{
    GuideSamples, RenderHair, RenderPose, RenderSettings, Space, StrandPoints, StrandSink, View, resampled,
};

/// Points per strand: a dozen per curl of the curliest groom.
const POINTS: usize = 64;

type Strand = Vec<Vector3<f64>>;

struct Collect(Mutex<Vec<Strand>>);

impl StrandSink for Collect {
    fn take(&self, strand: &StrandPoints) {
        let [x, y, z] = strand.positions;
        let points = (0..x.len()).map(|k| Vector3::new(x[k], y[k], z[k]).map(f64::from)).collect();
        self.0.lock().expect("no panic")[strand.strand] = points;
    }
}

fn length(points: &[Vector3<f64>]) -> f64 {
    points.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum()
}

fn turning(points: &[Vector3<f64>]) -> f64 {
    let edges: Vec<_> = points.windows(2).map(|edge| edge[1] - edge[0]).collect();
    edges.windows(2).map(|pair| pair[0].angle(&pair[1])).sum()
}

/// Root mean square distance from the curve with its curls smoothed away, by means over a sixth of it.
fn amplitude(points: &[Vector3<f64>]) -> f64 {
    let half = POINTS / 12;
    let inner = half..POINTS - half;
    let count = inner.len() as f64;
    let squares: f64 = inner
        .map(|k| {
            let mean = points[k - half..=k + half].iter().sum::<Vector3<f64>>() / (2 * half + 1) as f64;
            (points[k] - mean).norm_squared()
        })
        .sum();
    (squares / count).sqrt()
}

fn made(settings: &RenderSettings, guides: &[Vector3<f64>], roots: &[Vector3<f64>]) -> Vec<Strand> {
    let samples = GuideSamples::at_rest(guides);
    let hair = RenderHair::bind(settings, &samples, roots).expect("a map");
    let mut pose = RenderPose::new(Arc::new(hair));
    pose.set(&samples).expect("a pose");
    let sink = Collect(Mutex::new(vec![Vec::new(); roots.len()]));
    pose.evaluate(&View::whole(pose.hair()), &sink).expect("strands");
    sink.0.into_inner().expect("no panic")
}

fn main() {
    let out = std::env::args().nth(1).expect("where the table goes");
    let mut csv = "groom,guides,strands,mixed,length_kept,turning_kept,curls_kept,apart_median\n".to_string();
    let grooms = [
        ("amd_ponytail_tail.tfx", "ponytail, straight"),
        ("sintel_hair_001.tfx", "Sintel, wavy"),
        ("blender_wavy.hair", "Blender, wavy"),
        ("blender_curly.hair", "Blender, curly"),
    ];
    for (file, name) in grooms {
        let curves = Curves::read(format!("{}/tests/data/grooms/{file}", env!("CARGO_MANIFEST_DIR"))).expect("a groom");
        let points: Vec<_> = curves.points().iter().map(|point| Vector3::from(point.map(f64::from))).collect();
        let all = resampled(&points, curves.counts(), None, POINTS).expect("curves").points;
        for every in [5, 20] {
            let (mut guides, mut others) = (Vec::new(), Vec::new());
            for (index, strand) in all.chunks(POINTS).enumerate() {
                if index % every == 0 {
                    guides.extend_from_slice(strand);
                } else {
                    others.push(strand);
                }
            }
            let roots: Vec<_> = others.iter().map(|strand| strand[0]).collect();
            for (guides_per_strand, space, mixed) in
                [(1, Space::Position, "nearest guide"), (4, Space::Position, "positions"), (4, Space::Curvature, "curvatures")]
            {
                let settings = RenderSettings {
                    points_per_strand: POINTS,
                    guides_per_strand,
                    space,
                    curliness: 0.0,
                    flyaways: 0.0,
                    length_variation: 0.0,
                    ..RenderSettings::default()
                };
                let strands = made(&settings, &guides, &roots);
                let kept = |value: &dyn Fn(&[Vector3<f64>]) -> f64| {
                    strands.iter().map(|strand| value(strand)).sum::<f64>()
                        / others.iter().map(|strand| value(strand)).sum::<f64>()
                };
                let mut apart: Vec<f64> = strands
                    .iter()
                    .zip(&others)
                    .map(|(strand, other)| {
                        let squares: f64 = strand.iter().zip(*other).map(|(a, b)| (a - b).norm_squared()).sum();
                        (squares / POINTS as f64).sqrt() / length(other)
                    })
                    .collect();
                apart.sort_by(f64::total_cmp);
                let line = format!(
                    "\"{name}\",{},{},{mixed},{:.4},{:.4},{:.4},{:.4}",
                    guides.len() / POINTS,
                    others.len(),
                    kept(&length),
                    kept(&turning),
                    kept(&amplitude),
                    apart[apart.len() / 2]
                );
                println!("{line}");
                let _ = writeln!(csv, "{line}");
            }
        }
    }
    std::fs::write(out, csv).expect("a file");
}
