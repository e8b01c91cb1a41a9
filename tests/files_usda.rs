//! USD as text: real files of other programs, what a layer may say, and every way in which one can be wrong.

use std::path::PathBuf;

use nalgebra::Vector3;
use superhelix::error::Error;
use superhelix::files::curve_cache::{CurveCache, CurveCacheWriter};
use superhelix::files::curves::{Curves, CurvesFormat, Extras, UpAxis};
use superhelix::files::usda;
use superhelix::math::nurbs::Nurbs;

fn data(name: &str) -> String {
    format!("{}/tests/data/grooms/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn probe() {
    for name in std::fs::read_dir("/tmp/usdt").unwrap() {
        let path = name.unwrap().path();
        if path.extension().is_some_and(|e| e == "usda" || e == "usdc") {
            let t = std::time::Instant::now();
            match CurveCache::read(&path).and_then(|c| Ok((c.times().to_vec(), c.frame(0)?))) {
                Ok((times, curves)) => println!("{path:?} {times:?} {} {} box {:?} {:?}", curves.strand_count(), curves.point_count(), curves.bounding_box(), t.elapsed()),
                Err(e) => println!("{path:?} {e}"),
            }
        }
    }
}
