//! TressFX `.tfx`, versions 2, 3 and 4: real files and every way in which one can be wrong.

use superhelix::Error;
use superhelix::io::{Curves, CurvesFormat, Extras, TfxVersion, tfx};

fn data(name: &str) -> String {
    format!("{}/tests/data/grooms/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn real_files_have_the_known_counts_and_extents() {
    // Counts and extents were worked out by other software and rounded to three decimals.
    let known = [
        ("amd_ponytail_tail.tfx", CurvesFormat::TfxV3, 474, 16, [-4.493, -3.118, 45.218], [12.32, 83.247, 77.995]),
        ("amd_ponytail_back.tfx", CurvesFormat::TfxV3, 517, 16, [-22.589, 62.431, 17.484], [20.694, 103.921, 44.547]),
        ("sintel_hair_001.tfx", CurvesFormat::TfxV4, 228, 32, [-10.617, 20.716, -12.952], [9.827, 47.686, 11.656]),
        ("fibermesh_1k.tfx", CurvesFormat::TfxV2Text, 1000, 6, [-94.778, -141.695, -108.083], [87.404, 83.957, 105.261]),
    ];
    for (name, format, strands, points_each, low, high) in known {
        let curves = Curves::read(data(name)).unwrap();
        assert_eq!((curves.format(), curves.strand_count()), (format, strands), "{name}");
        assert!(curves.counts().iter().all(|count| *count == points_each), "{name}");
        assert_eq!(curves.point_count(), strands * points_each as usize);
        let (found_low, found_high) = curves.bounding_box();
        for axis in 0..3 {
            assert!((found_low[axis] - low[axis]).abs() <= 0.00051, "{name} {found_low:?} {low:?}");
            assert!((found_high[axis] - high[axis]).abs() <= 0.00051, "{name} {found_high:?} {high:?}");
        }
    }
}

#[test]
fn points_are_those_of_the_file() {
    // The first numbers, as a dump of the files shows them.
    let text = tfx::read(data("fibermesh_1k.tfx")).unwrap();
    assert_eq!(text.strand(0)[1], [-3.505894, 11.699733, 61.550755]);
    assert_eq!(text.strand(1)[5], [8.800199, -3.367098, 85.12934]);
    assert_eq!(text.strand(999)[5], [-1.739297, -50.01851, -85.74585]);
    let tail = tfx::read(data("amd_ponytail_tail.tfx")).unwrap();
    let bits = |point: [f32; 3]| point.map(f32::to_bits);
    assert_eq!(bits(tail.strand(0)[0]), [0xbdea9540, 0x4299e03c, 0x4235ab47]);
    let sintel = tfx::read(data("sintel_hair_001.tfx")).unwrap();
    assert_eq!(bits(sintel.strand(0)[1]), [0xc10636bb, 0x420afc1a, 0xc0363968]);
}

#[test]
fn held_points_are_kept() {
    let back = tfx::read(data("amd_ponytail_back.tfx")).unwrap();
    let held = back.extras().held.as_ref().unwrap();
    for strand in 0..back.strand_count() {
        let range = back.strand_range(strand);
        let expected: Vec<bool> = (0..16).map(|index| !(2..14).contains(&index)).collect();
        assert_eq!(held[range], expected);
    }
    assert_eq!(tfx::read(data("amd_ponytail_tail.tfx")).unwrap().extras().held, None);
    // Sintel: the root of each strand.
    let sintel = tfx::read(data("sintel_hair_001.tfx")).unwrap();
    let held = sintel.extras().held.as_ref().unwrap();
    assert!((0..sintel.point_count()).all(|index| held[index] == (index % 32 == 0)));
}

/// A version 4 file of three strands of four points with every section, in an order of its own and with a gap.
fn version_4() -> Vec<u8> {
    let mut bytes = 4.0_f32.to_le_bytes().to_vec();
    let (strands, points) = (3_u32, 12);
    let uvs = 160 + 16 * points + 8;
    let point_uvs = uvs + 8 * strands;
    let thickness = point_uvs + 8 * points;
    let colors = thickness + 4 * strands;
    for number in [strands, 4, 160, uvs, point_uvs, thickness, colors] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.resize(160, 0);
    let mut next = 0.0_f32;
    let mut floats = |count: u32| -> Vec<u8> {
        (0..count)
            .flat_map(|_| {
                next += 1.0;
                next.to_le_bytes()
            })
            .collect()
    };
    let mut section = floats(4 * points);
    for point in 0..points as usize {
        section[16 * point + 12..16 * point + 16].copy_from_slice(&(if point % 4 == 0 { 0.0_f32 } else { 1.0 }).to_le_bytes());
    }
    bytes.extend(section);
    bytes.extend([0xaa; 8]);
    for count in [2 * strands, 2 * points, strands, 4 * points] {
        bytes.extend(floats(count));
    }
    bytes
}

/// A version 3 file of two strands of three points with every section.
fn version_3() -> Vec<u8> {
    let mut bytes = 3.0_f32.to_le_bytes().to_vec();
    let (strands, points) = (2_u32, 6);
    for number in [strands, 3, 4, 0xcdcdcd00] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.resize(144, 0);
    let widths = [12 * points, 4 * strands, 8 * strands, 16 * points, 4 * strands, 8 * points];
    let mut offset = 296_u32;
    for width in widths {
        bytes.extend(offset.to_le_bytes());
        offset += width;
    }
    bytes.resize(296, 0);
    for number in 0..(offset - 296) / 4 {
        bytes.extend((number as f32).to_le_bytes());
    }
    bytes
}

#[test]
fn every_section_is_read() {
    let curves = tfx::read_from_bytes("4.tfx", &version_4()).unwrap();
    assert_eq!(curves.strand(1)[0], [17.0, 18.0, 19.0]);
    let extras = curves.extras();
    assert_eq!(extras.held.as_ref().unwrap()[3..6], [false, true, false]);
    assert_eq!(extras.strand_uvs.as_ref().unwrap()[1], [51.0, 52.0]);
    assert_eq!(extras.strand_thickness.as_ref().unwrap()[..], [79.0, 80.0, 81.0]);
    assert_eq!(extras.colors.as_ref().unwrap()[1], [86.0, 87.0, 88.0]);

    let curves = tfx::read_from_bytes("3.tfx", &version_3()).unwrap();
    assert_eq!(curves.strand(1)[2], [15.0, 16.0, 17.0]);
    let extras = curves.extras();
    assert_eq!(extras.held, None);
    assert_eq!(extras.strand_thickness.as_ref().unwrap()[..], [18.0, 19.0]);
    assert_eq!(extras.strand_uvs.as_ref().unwrap()[1], [22.0, 23.0]);
    assert_eq!(extras.colors.as_ref().unwrap()[0], [24.0, 25.0, 26.0]);
    // The same without any of them.
    let mut bare = version_3();
    bare[148..168].fill(0);
    bare.truncate(296 + 72);
    assert_eq!(tfx::read_from_bytes("3.tfx", &bare).unwrap().extras().strand_uvs, None);
}

/// The reason of the error that reading these bytes gives.
fn reason(bytes: &[u8]) -> String {
    match tfx::read_from_bytes("wrong.tfx", bytes) {
        Err(Error::File { path, reason }) => {
            assert_eq!(path, "wrong.tfx");
            reason
        }
        other => panic!("{other:?}"),
    }
}

fn assert_says(said: &str, parts: &[&str]) {
    for part in parts {
        assert!(said.contains(part), "{said:?} should say {part:?}");
    }
}

#[test]
fn a_binary_file_cut_anywhere_is_truncated_and_a_longer_one_oversized() {
    for bytes in [version_3(), version_4()] {
        for length in 0..bytes.len() {
            assert_says(&reason(&bytes[..length]), &["truncated"]);
        }
        // Sections are aligned to eight bytes, so seven may follow.
        assert!(tfx::read_from_bytes("padded.tfx", &[&bytes[..], &[0; 7]].concat()).is_ok());
        assert_says(&reason(&[&bytes[..], &[0; 8]].concat()), &["oversized", &bytes.len().to_string()]);
    }
    for name in ["amd_ponytail_tail.tfx", "sintel_hair_001.tfx"] {
        let real = std::fs::read(data(name)).unwrap();
        for length in [0, 1, 3, 4, 5, 12, 159, 160, 161, 295, 296, 297, real.len() / 2, real.len() - 1] {
            assert_says(&reason(&real[..length]), &["truncated"]);
        }
    }
}

#[test]
fn nonsense_in_a_binary_file_is_refused_with_place_and_value() {
    let with = |mut bytes: Vec<u8>, at: usize, with: [u8; 4]| {
        bytes[at..at + 4].copy_from_slice(&with);
        reason(&bytes)
    };
    let word = u32::to_le_bytes;
    let float = f32::to_le_bytes;
    let (three, four) = (version_3, version_4);
    for version in [2.0, 3.5, 5.0, f32::NAN, -3.0] {
        assert_says(&with(three(), 0, float(version)), &["version at byte 0", &version.to_string()]);
    }
    assert_says(&with(four(), 4, word(0)), &["byte 4", "strands", "0"]);
    assert_says(&with(four(), 4, word(u32::MAX)), &["truncated", "17179869180 points"]);
    assert_says(&with(four(), 8, word(1)), &["byte 8", "is 1"]);
    assert_says(&with(four(), 8, word(0)), &["byte 8", "is 0"]);
    assert_says(&with(four(), 8, word(u32::MAX)), &["truncated"]);
    assert_says(&with(four(), 12, word(0)), &["byte 12", "has none"]);
    assert_says(&with(four(), 12, word(159)), &["points", "byte 159", "inside the head"]);
    assert_says(&with(four(), 12, word(u32::MAX)), &["truncated", "byte 4294967295"]);
    assert_says(&with(four(), 16, word(168)), &["texture coordinates", "168", "overlap the points"]);
    assert_says(&with(four(), 28, word(u32::MAX)), &["truncated", "colours"]);
    assert_says(&with(four(), 160, float(f32::NAN)), &["number 0 of point 0", "byte 160", "NaN"]);
    assert_says(&with(four(), 160 + 16 + 12, float(f32::INFINITY)), &["number 3 of point 1", "byte 188", "inf"]);
    assert_says(&with(three(), 296 + 12 * 5 + 8, float(f32::NEG_INFINITY)), &["number 2 of point 5", "byte 364", "-inf"]);
    assert_says(&with(three(), 16, word(2)), &["byte 16 is 2"]);
    assert_says(&with(three(), 148, word(300)), &["thicknesses", "overlap"]);
    assert_says(&with(three(), 4, word(0)), &["byte 4"]);
    // A strand fewer than there are leaves bytes over.
    assert_says(&with(std::fs::read(data("amd_ponytail_tail.tfx")).unwrap(), 4, word(473)), &["oversized"]);
}

const TEXT: &str = "version 2.0\nscale 1.0\nrotation 0 0 0\ntranslation 0 0 0\nbothEndsImmovable 1\nmaxNumVerticesInStrand 5\n\
    numFollowHairsPerGuideHair 4\nmaxRadiusAroundGuideHair 1.5\nnumStrands 2\nis sorted 1\n\
    strand 0 numVerts 2 texcoord 0.25 0.5\n1, 2, 3\n4 5 6\nstrand 1 numVerts 5 texcoord 0 0\n0,0,0\n0,0,1\n0,0,2\n0,0,3\n0,0,4\n";

#[test]
fn text_with_other_blanks_reads_the_same() {
    let curves = tfx::read_from_bytes("2.tfx", TEXT.as_bytes()).unwrap();
    assert_eq!((curves.counts(), curves.strand(0)), (&[2, 5][..], &[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]][..]));
    assert_eq!(curves.extras().strand_uvs.as_ref().unwrap()[0], [0.25, 0.5]);
    assert_eq!(curves.extras().held.as_ref().unwrap()[..], [true, true, true, true, false, true, true]);
    let windows = TEXT.replace('\n', "\r\n").replace(',', ", ");
    assert_eq!(tfx::read_from_bytes("2.tfx", windows.as_bytes()).unwrap(), curves);
    assert_eq!(Curves::read_from_bytes("2", TEXT.trim_end().as_bytes()).unwrap(), curves);
}

#[test]
fn nonsense_in_a_text_file_is_refused_with_line_and_value() {
    let with = |from: &str, to: &str| {
        assert!(TEXT.contains(from));
        reason(TEXT.replacen(from, to, 1).as_bytes())
    };
    assert_says(&with("version 2.0", "version 1.0"), &["line 1", "version 1.0"]);
    assert_says(&with("version 2.0\n", "version 2.0\nnonsense\n"), &["line 2", "nonsense"]);
    assert_says(&with("scale 1.0", "scale 2.0"), &["line 2", "scale 2.0", "scale 1.0"]);
    assert_says(&with("translation 0 0 0", "translation 0 0"), &["line 4"]);
    assert_says(&with("bothEndsImmovable 1", "bothEndsImmovable maybe"), &["line 5", "maybe"]);
    assert_says(&with("numStrands 2\n", ""), &["numStrands"]);
    assert_says(&with("numStrands 2", "numStrands two"), &["line 9", "two"]);
    assert_says(&with("numStrands 2", "numStrands 3"), &["line 9", "numStrands is 3", "2 strands"]);
    assert_says(&with("numStrands 2", "numStrands 1"), &["line 9", "numStrands is 1", "2 strands"]);
    assert_says(&with("strand 1", "strand 7"), &["line 14", "index is 7", "1"]);
    assert_says(&with("numVerts 5", "numVerts 1"), &["line 14", "strand 1 has 1 points"]);
    assert_says(&with("numVerts 5", "numVerts 4294967295"), &["line 14", "4294967295", "bytes are left"]);
    assert_says(&with("numVerts 5", "numVerts 4"), &["line 19", "0,0,4"]);
    assert_says(&with("numVerts 2", "numVerts 3"), &["line 14", "expected a point"]);
    assert_says(&with("0.25 0.5", "0.25"), &["line 11"]);
    assert_says(&with("0.25 0.5", "0.25 0.5 0.5"), &["line 11"]);
    assert_says(&with("4 5 6", "4 5"), &["line 13", "4 5"]);
    assert_says(&with("4 5 6", "4 5 6 7"), &["line 13"]);
    assert_says(&with("4 5 6", "4 5 nan"), &["line 13", "nan"]);
    assert_says(&with("4 5 6", "4 5 1e39"), &["line 13", "1e39"]);
    let mut bytes = TEXT.as_bytes().to_vec();
    let at = TEXT.find("4 5 6").unwrap();
    bytes[at] = 0xff;
    assert_says(&reason(&bytes), &["line 13", "UTF-8"]);
    // A quoted line does not fill the screen.
    assert!(with("4 5 6", &"x".repeat(100_000)).len() < 200);
    assert_says(&reason(b"version 2.0\nnumStrands 0\n"), &["line 2", "0"]);
    assert_says(&reason(b"version 2.0\n"), &["numStrands"]);
}

#[test]
fn a_text_file_cut_at_any_line_is_refused() {
    let ends: Vec<usize> = TEXT.match_indices('\n').map(|(at, _)| at + 1).collect();
    for end in &ends[..ends.len() - 1] {
        reason(&TEXT.as_bytes()[..*end]);
    }
    let real = std::fs::read(data("fibermesh_1k.tfx")).unwrap();
    let ends: Vec<usize> = real.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(at, _)| at + 1).collect();
    for end in ends[..ends.len() - 1].iter().step_by(97) {
        reason(&real[..*end]);
    }
    // A file cut inside the last number looks complete; cut anywhere else in the last line it does not.
    let last = TEXT.len() - "0,0,4\n".len();
    for length in last..TEXT.len() - 2 {
        reason(&TEXT.as_bytes()[..length]);
    }
}

/// Version 3 files with every choice of sections, in the head's order and without gaps.
fn version_3_variants() -> Vec<Vec<u8>> {
    (0..16_u32)
        .map(|mask| {
            let mut bytes = 3.0_f32.to_le_bytes().to_vec();
            for number in [2_u32, 5] {
                bytes.extend(number.to_le_bytes());
            }
            bytes.resize(296, 0);
            bytes[16] = (mask & 1) as u8;
            let sections = [(144, 3 * 10, true), (148, 2, mask & 2 != 0), (152, 4, mask & 4 != 0), (156, 4 * 10, mask & 8 != 0)];
            for (at, floats, there) in sections {
                if there {
                    let offset = bytes.len() as u32;
                    bytes[at..at + 4].copy_from_slice(&offset.to_le_bytes());
                    // The fourth number of a colour is not kept: 1.
                    let number = |index: u32| if at == 156 && index % 4 == 3 { 1.0 } else { at as f32 + index as f32 / 7.0 };
                    (0..floats).for_each(|index| bytes.extend(number(index).to_le_bytes()));
                }
            }
            bytes
        })
        .collect()
}

#[test]
fn what_was_read_is_written_again_byte_for_byte() {
    for name in ["amd_ponytail_tail.tfx", "amd_ponytail_back.tfx", "sintel_hair_001.tfx"] {
        let curves = tfx::read(data(name)).unwrap();
        let bytes = tfx::write_to_bytes(name, &curves, TfxVersion::of(&curves)).unwrap();
        assert!(bytes == std::fs::read(data(name)).unwrap(), "{name}");
        assert!(curves.lost_in(curves.format()).is_empty(), "{name}");
    }
    for bytes in version_3_variants() {
        let curves = tfx::read_from_bytes("v.tfx", &bytes).unwrap();
        assert_eq!(tfx::write_to_bytes("v.tfx", &curves, TfxVersion::V3).unwrap(), bytes);
    }
    // Text has many ways to write a number: the numbers are the same, and written once more so are the bytes.
    let curves = tfx::read(data("fibermesh_1k.tfx")).unwrap();
    let text = tfx::write_to_bytes("t.tfx", &curves, TfxVersion::of(&curves)).unwrap();
    let again = tfx::read_from_bytes("t.tfx", &text).unwrap();
    assert_eq!(again, curves);
    assert_eq!(tfx::write_to_bytes("t.tfx", &again, TfxVersion::V2).unwrap(), text);
}

#[test]
fn every_version_keeps_what_it_can_hold() {
    let numbers = |count: usize| (0..count).map(|index| 0.1 + index as f32 / 3.0).collect::<Vec<f32>>();
    let points: Vec<[f32; 3]> = numbers(12).iter().map(|x| [*x, -x, x * 1e-20]).collect();
    let extras = Extras {
        colors: Some(points.clone()),
        held: Some((0..12).map(|index| index % 6 < 3).collect()),
        strand_thickness: Some(numbers(2)),
        strand_uvs: Some(vec![[0.1, 0.2], [0.3, 0.4]]),
        ..Extras::default()
    };
    let curves = Curves::from_counts(vec![6, 6], points).unwrap().with_extras(extras).unwrap();
    let through = |curves: &Curves, version| {
        tfx::read_from_bytes("v.tfx", &tfx::write_to_bytes("v.tfx", curves, version).unwrap()).unwrap()
    };
    let newest = through(&curves, TfxVersion::V4);
    assert_eq!((newest.points(), newest.extras()), (curves.points(), curves.extras()));
    assert!(curves.lost_in(CurvesFormat::TfxV4).is_empty());
    let third = through(&curves, TfxVersion::V3);
    assert_eq!(third.extras(), &Extras { held: None, ..curves.extras().clone() });
    assert_eq!(curves.lost_in(CurvesFormat::TfxV3), ["which points are held"]);
    let text = through(&curves, TfxVersion::V2);
    assert_eq!(text.extras(), &Extras { strand_uvs: curves.extras().strand_uvs.clone(), ..Extras::default() });
    assert_eq!(curves.lost_in(CurvesFormat::TfxV2Text).len(), 3);
    // Both ends held, both versions can say.
    let both = Extras { held: Some((0..12).map(|index| !(2..4).contains(&(index % 6))).collect()), ..Extras::default() };
    let held = Curves::from_counts(vec![6, 6], curves.points().to_vec()).unwrap().with_extras(both).unwrap();
    for version in [TfxVersion::V2, TfxVersion::V3, TfxVersion::V4] {
        assert_eq!(through(&held, version).extras().held, held.extras().held, "{version:?}");
    }
    // Where curves do not say, a version 4 file holds the roots.
    let plain = Curves::from_counts(vec![6, 6], curves.points().to_vec()).unwrap();
    let roots: Vec<bool> = (0..12).map(|index| index % 6 == 0).collect();
    assert_eq!(through(&plain, TfxVersion::V4).extras().held, Some(roots));

    let uneven = Curves::from_counts(vec![2, 3], vec![[0.0; 3]; 5]).unwrap();
    assert_eq!((TfxVersion::of(&uneven), TfxVersion::of(&plain)), (TfxVersion::V2, TfxVersion::V4));
    assert_eq!(through(&uneven, TfxVersion::V2).counts(), [2, 3]);
    for version in [TfxVersion::V3, TfxVersion::V4] {
        let result = tfx::write_to_bytes("u.tfx", &uneven, version);
        assert!(matches!(result, Err(Error::File { reason, .. }) if reason.contains("strand 1 has 3 points and strand 0 has 2")));
    }
}
