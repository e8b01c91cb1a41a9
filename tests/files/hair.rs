//! Cem Yuksel's `.hair`: real files, valid headers, and every way in which a file can be wrong.

use superhelix::Error;
use superhelix::io::{Curves, CurvesFormat, Extras, HairHeader, hair};

fn data(name: &str) -> String {
    format!("{}/tests/data/grooms/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// Checks a bounding box against figures that were rounded to three decimals by other software.
fn assert_box(curves: &Curves, low: [f32; 3], high: [f32; 3]) {
    let (found_low, found_high) = curves.bounding_box();
    for axis in 0..3 {
        assert!((found_low[axis] - low[axis]).abs() <= 0.00051, "{found_low:?} {low:?}");
        assert!((found_high[axis] - high[axis]).abs() <= 0.00051, "{found_high:?} {high:?}");
    }
}

#[test]
fn real_files_have_the_known_counts_and_extents() {
    let wavy = Curves::read(data("blender_wavy.hair")).unwrap();
    assert_eq!((wavy.format(), wavy.strand_count(), wavy.point_count()), (CurvesFormat::Hair, 1644, 52608));
    assert!(wavy.counts().iter().all(|count| *count == 32));
    assert_box(&wavy, [-0.098, 0.012, -0.109], [0.099, 0.387, 0.226]);

    let curly = Curves::read(data("blender_curly.hair")).unwrap();
    assert_eq!((curly.strand_count(), curly.point_count()), (1234, 49316));
    assert_eq!((curly.counts().iter().min(), curly.counts().iter().max()), (Some(&7), Some(&128)));
    assert_box(&curly, [-0.098, 0.003, -0.116], [0.106, 0.387, 0.236]);
    // Known lengths, in metres: minimum 0.018, median 0.088, maximum 0.333.
    let mut lengths: Vec<f64> = (0..curly.strand_count()).map(|strand| curly.strand_length(strand)).collect();
    lengths.sort_by(f64::total_cmp);
    for (length, known) in [(lengths[0], 0.018), (lengths[lengths.len() / 2], 0.088), (lengths[lengths.len() - 1], 0.333)] {
        assert!((length - known).abs() < 0.00051, "{length} {known}");
    }
    // Strands are the points in order, none left out.
    assert_eq!(curly.strands().flatten().count(), curly.point_count());
    assert_eq!(curly.strand(1233).last(), curly.points().last());
}

#[test]
fn writing_what_was_read_gives_the_same_bytes() {
    for name in ["blender_wavy.hair", "blender_curly.hair"] {
        let bytes = std::fs::read(data(name)).unwrap();
        let curves = hair::read(data(name)).unwrap();
        assert!(hair::write_to_bytes(name, &curves).unwrap() == bytes, "{name}");
    }
    for bytes in all_variants() {
        let curves = hair::read_from_bytes("variant.hair", &bytes).unwrap();
        assert_eq!(hair::write_to_bytes("variant.hair", &curves).unwrap(), bytes);
        assert_eq!(hair::read_from_bytes("variant.hair", &hair::write_to_bytes("", &curves).unwrap()).unwrap(), curves);
    }
}

/// Two strands of two and three points, or of three and three, with every choice of optional sections.
fn all_variants() -> Vec<Vec<u8>> {
    (0..32_u32).filter(|mask| mask & 2 != 0).map(|mask| sample(mask, if mask & 1 != 0 { &[1, 2] } else { &[2, 2] })).collect()
}

fn sample(mask: u32, segments: &[u16]) -> Vec<u8> {
    let points: u32 = segments.iter().map(|count| u32::from(*count) + 1).sum();
    let mut bytes = b"HAIR".to_vec();
    let default = if mask & 1 != 0 { 77 } else { u32::from(segments[0]) };
    for number in [segments.len() as u32, points, mask, default] {
        bytes.extend(number.to_le_bytes());
    }
    for number in [0.5_f32, 0.25, 0.1, 0.2, 0.3] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend((0..88).map(|byte| byte + 1));
    if mask & 1 != 0 {
        segments.iter().for_each(|count| bytes.extend(count.to_le_bytes()));
    }
    for (bit, floats) in [(2, 3), (4, 1), (8, 1), (16, 3)] {
        if mask & bit != 0 {
            (0..points * floats).for_each(|number| bytes.extend((bit as f32 + number as f32 / 7.0).to_le_bytes()));
        }
    }
    bytes
}

#[test]
fn the_optional_sections_are_kept() {
    let curves = hair::read_from_bytes("all.hair", &sample(31, &[1, 2])).unwrap();
    assert_eq!(curves.counts(), [2, 3]);
    assert_eq!(curves.strand(1)[0], [2.0 + 6.0 / 7.0, 2.0 + 7.0 / 7.0, 2.0 + 8.0 / 7.0]);
    let extras = curves.extras();
    assert_eq!(extras.thickness.as_ref().unwrap()[4], 4.0 + 4.0 / 7.0);
    assert_eq!(extras.transparency.as_ref().unwrap()[1], 8.0 + 1.0 / 7.0);
    assert_eq!(extras.colors.as_ref().unwrap()[0], [16.0, 16.0 + 1.0 / 7.0, 16.0 + 2.0 / 7.0]);
    let header = extras.hair_header.unwrap();
    assert_eq!((header.default_segments, header.lists_segments, header.thickness), (77, true, 0.5));
    assert_eq!((header.transparency, header.color, header.info[87]), (0.25, [0.1, 0.2, 0.3], 88));
    assert_eq!((&extras.held, &extras.strand_uvs, &extras.strand_thickness), (&None, &None, &None));
}

/// The reason of the error that reading these bytes gives.
fn reason(bytes: &[u8]) -> String {
    match hair::read_from_bytes("wrong.hair", bytes) {
        Err(Error::File { path, reason }) => {
            assert_eq!(path, "wrong.hair");
            reason
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_file_cut_anywhere_is_truncated_and_a_longer_one_oversized() {
    for bytes in all_variants() {
        for length in 0..bytes.len() {
            assert!(reason(&bytes[..length]).contains("truncated"), "{length} of {}", bytes.len());
        }
        let longer = [&bytes[..], &[0]].concat();
        let said = reason(&longer);
        assert!(said.contains("oversized") && said.contains(&bytes.len().to_string()), "{said}");
    }
    let real = std::fs::read(data("blender_curly.hair")).unwrap();
    for length in [0, 3, 4, 127, 128, 129, 128 + 2 * 1234 - 1, 128 + 2 * 1234, 128 + 2 * 1234 + 1, real.len() - 1] {
        assert!(reason(&real[..length]).contains("truncated"), "{length}");
    }
}

#[test]
fn nonsense_is_refused_with_place_and_value() {
    let good = sample(31, &[1, 2]);
    let with = |at: usize, with: &[u8]| {
        let mut bytes = good.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        reason(&bytes)
    };
    let nan = f32::NAN.to_le_bytes();
    let infinite = f32::INFINITY.to_le_bytes();
    for (said, parts) in [
        (with(0, b"hair"), &["HAIR"][..]),
        (with(4, &0_u32.to_le_bytes()), &["byte 4", "strands", " 0"]),
        (with(4, &u32::MAX.to_le_bytes()), &["truncated", "4294967295", "byte 128"]),
        (with(8, &u32::MAX.to_le_bytes()), &["truncated", "4294967295 points", "byte 132"]),
        (with(12, &29_u32.to_le_bytes()), &["byte 12", "bit 1"]),
        (with(12, &63_u32.to_le_bytes()), &["byte 12", "0x3f"]),
        (with(20, &nan), &["byte 20", "thickness", "NaN"]),
        (with(36, &infinite), &["byte 36", "blue", "inf"]),
        (with(128, &0_u16.to_le_bytes()), &["strand 0", "0 segments", "byte 128"]),
        (with(130, &3_u16.to_le_bytes()), &["make 6 points", "is 5"]),
        (with(132, &nan), &["point 0", "byte 132", "NaN"]),
        (with(132 + 4 * 14, &infinite), &["point 4", "byte 188", "inf"]),
        (with(132 + 60, &nan), &["thickness 0", "byte 192"]),
        (with(132 + 60 + 16, &nan), &["thickness 4", "byte 208"]),
        (with(132 + 80 + 16, &nan), &["transparency 4", "byte 228"]),
        (with(132 + 100, &nan), &["colour 0", "byte 232"]),
    ] {
        for part in parts {
            assert!(said.contains(part), "{said:?} should say {part:?}");
        }
    }
    let uniform = |default: u32| {
        let mut bytes = sample(2, &[2, 2]);
        bytes[16..20].copy_from_slice(&default.to_le_bytes());
        reason(&bytes)
    };
    assert!(uniform(0).contains("byte 16 is 0"));
    assert!(uniform(3).contains("8 points") && uniform(3).contains("is 6"));
    assert!(uniform(u32::MAX).contains("8589934592 points"));
}

#[test]
fn files_that_cannot_be_read_say_so() {
    for path in [data("none.hair"), data(""), "/dev/null/x.hair".to_owned()] {
        let Err(Error::File { path: named, reason }) = Curves::read(&path) else { panic!("{path}") };
        assert_eq!(named, path);
        assert!(reason.contains("cannot be read") || reason.contains("is a directory"), "{reason}");
    }
    // A device has no size and no end.
    #[cfg(unix)]
    assert!(matches!(Curves::read("/dev/zero"), Err(Error::File { reason, .. }) if reason.contains("neither a file nor a pipe")));
}

/// A shell's `<(zcat groom.hair.gz)`: a pipe, which has no size.
#[cfg(target_os = "linux")]
#[test]
fn a_pipe_is_read_to_its_end() {
    use std::io::Write;
    use std::os::fd::AsRawFd;
    let (reader, mut writer) = std::io::pipe().unwrap();
    let path = format!("/proc/self/fd/{}", reader.as_raw_fd());
    let bytes = std::fs::read(data("blender_curly.hair")).unwrap();
    let sent = bytes.clone();
    let sender = std::thread::spawn(move || writer.write_all(&sent).unwrap());
    let curves = Curves::read(path).unwrap();
    sender.join().unwrap();
    assert_eq!(curves, Curves::read(data("blender_curly.hair")).unwrap());
}

#[test]
fn content_decides_before_the_name_does() {
    let bytes = sample(2, &[2, 2]);
    assert_eq!(Curves::read_from_bytes("groom", &bytes).unwrap().format(), CurvesFormat::Hair);
    assert_eq!(Curves::read_from_bytes("groom.tfx", &bytes).unwrap().format(), CurvesFormat::Hair);
    for (name, bytes, said) in [
        ("groom", &b"nothing"[..], "not a known groom format"),
        ("a.hair", b"\x1f\x8b\x08", "gzip"),
        ("a.HAIR", b"HAI", "truncated"),
    ] {
        assert!(
            matches!(Curves::read_from_bytes(name, bytes), Err(Error::File { reason, .. }) if reason.contains(said)),
            "{name}"
        );
    }
}

#[test]
fn curves_from_memory_can_be_written_and_read_back() {
    let curves = Curves::from_strands(&[vec![[0.0; 3], [1e-30, -0.0, 3.0]], vec![[1.0; 3], [2.0; 3], [3.5; 3]]]).unwrap();
    assert_eq!(curves.format(), CurvesFormat::Memory);
    let again = hair::read_from_bytes("m.hair", &hair::write_to_bytes("m.hair", &curves).unwrap()).unwrap();
    assert_eq!((again.counts(), again.points()), (curves.counts(), curves.points()));
    assert_eq!(again.extras().hair_header.unwrap().thickness, HairHeader::default().thickness);

    let thick = curves.clone().with_extras(Extras { thickness: Some(vec![0.1; 5]), ..Extras::default() }).unwrap();
    let again = hair::read_from_bytes("m.hair", &hair::write_to_bytes("m.hair", &thick).unwrap()).unwrap();
    assert_eq!(again.extras().thickness, thick.extras().thickness);
    let too_few = Extras { thickness: Some(vec![0.1; 4]), ..Extras::default() };
    let not_finite = Extras { colors: Some(vec![[0.0, f32::NAN, 0.0]; 5]), ..Extras::default() };
    for (extras, argument) in [(too_few, "extras.thickness"), (not_finite, "extras.colors[0]")] {
        assert!(
            matches!(curves.clone().with_extras(extras), Err(Error::InvalidArgument { argument: said, .. }) if said == argument)
        );
    }

    // 65536 points fit where strands differ; one more does not. Where all are alike the head can say it.
    let long = vec![[0.0; 3]; 65536];
    let longer = vec![[0.0; 3]; 65537];
    let short = vec![[0.0; 3]; 2];
    let write = |strands: &[&Vec<[f32; 3]>]| hair::write_to_bytes("m.hair", &Curves::from_strands(strands).unwrap());
    assert!(write(&[&long, &short]).is_ok() && write(&[&longer, &longer]).is_ok());
    assert!(matches!(write(&[&short, &longer]), Err(Error::File { reason, .. }) if reason.contains("strand 1 has 65537 points")));
}

#[test]
fn bad_curves_are_refused() {
    let point = [0.0; 3];
    for (counts, points, said) in [
        (vec![], vec![], "counts"),
        (vec![2, 1], vec![point; 3], "counts[1]"),
        (vec![2, 2], vec![point; 5], "points"),
        (vec![u32::MAX, u32::MAX], vec![point; 5], "points"),
        (vec![2], vec![point, [0.0, f32::NAN, 0.0]], "points[1]"),
    ] {
        let result = Curves::from_counts(counts, points);
        assert!(matches!(&result, Err(Error::InvalidArgument { argument, .. }) if argument == said), "{result:?}");
    }
    assert!(Curves::from_strands::<Vec<[f32; 3]>>(&[]).is_err());
}

#[test]
fn scaling_and_turning() {
    let curves = hair::read_from_bytes("all.hair", &sample(31, &[1, 2])).unwrap();
    let scaled = curves.scaled(0.5).unwrap();
    assert_eq!(scaled.points()[3], curves.points()[3].map(|value| 0.5 * value));
    assert_eq!(scaled.extras().thickness.as_ref().unwrap()[2], 0.5 * curves.extras().thickness.as_ref().unwrap()[2]);
    assert_eq!(scaled.extras().hair_header.unwrap().thickness, 0.25);
    assert_eq!(scaled.extras().colors, curves.extras().colors);
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
        assert!(
            matches!(curves.scaled(factor), Err(Error::InvalidArgument { argument, .. }) if argument == "factor"),
            "{factor}"
        );
    }
    let turned = Curves::from_strands(&[[[1.0, 2.0, 3.0], [0.0, 1.0, 0.0]]]).unwrap().to_z_up();
    assert_eq!(turned.points(), [[1.0, -3.0, 2.0], [0.0, 0.0, 1.0]]);
}
