//! `.data` files: made-up ones, good and bad.

use superhelix::io::{Curves, CurvesFormat, strand_data};

/// Strands as such a file has them.
fn file(strands: &[&[[f32; 3]]]) -> Vec<u8> {
    let mut bytes = (strands.len() as u32).to_le_bytes().to_vec();
    for strand in strands {
        bytes.extend((strand.len() as u32).to_le_bytes());
        bytes.extend(strand.iter().flatten().flat_map(|x| x.to_le_bytes()));
    }
    bytes
}

const LONG: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.5, -2.0, 0.25], [2.0, -4.0, 1e-3], [2.0, -4.0, 1e-3]];
const SHORT: [[f32; 3]; 2] = [[-1.0, 7.0, 3.5e8], [0.0, 1.0, 2.0]];

#[test]
fn all_points_are_read_bit_for_bit() {
    let curves = Curves::read_from_bytes("made_up.data", &file(&[&LONG, &SHORT, &LONG])).unwrap();
    assert_eq!((curves.format(), curves.format().name()), (CurvesFormat::StrandData, "data"));
    assert_eq!(curves.counts(), [4, 2, 4]);
    assert_eq!((curves.strand(0), curves.strand(1), curves.strand(2)), (&LONG[..], &SHORT[..], &LONG[..]));
    let path = std::env::temp_dir().join(format!("superhelix_{}.DATA", std::process::id()));
    std::fs::write(&path, file(&[&SHORT])).unwrap();
    let read = Curves::read(&path);
    std::fs::remove_file(&path).unwrap();
    assert_eq!(read.unwrap().points(), SHORT);
}

#[test]
fn bad_files_are_explained() {
    let good = file(&[&LONG, &SHORT]);
    for length in 0..good.len() {
        let error = strand_data::read_from_bytes("a.data", &good[..length]).unwrap_err().to_string();
        assert!(error.contains("a.data") && error.contains("truncated"), "{length}: {error}");
    }
    let changed = |at: usize, word: [u8; 4]| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&word);
        strand_data::read_from_bytes("a.data", &bytes).unwrap_err().to_string()
    };
    for (error, said) in [
        (changed(0, 0_u32.to_le_bytes()), "number of strands at byte 0 is 0"),
        (changed(0, 1_u32.to_le_bytes()), "oversized: 1 strands end at byte 56"),
        (changed(0, u32::MAX.to_le_bytes()), "truncated"),
        (changed(4, u32::MAX.to_le_bytes()), "truncated: 4294967295 points"),
        (changed(4, 1_u32.to_le_bytes()), "strand 0 has 1 points (at byte 4)"),
        (changed(56, 0_u32.to_le_bytes()), "strand 1 has 0 points (at byte 56)"),
        (changed(12, f32::NAN.to_le_bytes()), "number 1 of point 0 at byte 12 is NaN"),
        (changed(60, f32::INFINITY.to_le_bytes()), "number 0 of point 0 at byte 60 is inf"),
    ] {
        assert!(error.contains(said), "{error}");
    }
}
