//! A saved map is the map, damage is found, and a map works on without some of its guides.

use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::render::{GuideSamples, RENDER_HAIR_VERSION, RenderHair, RenderPose, RenderSettings, Space};
use superhelix::{Error, Workers};

use crate::render_hair::{Taken, evaluate, roots_among, sintel, whole};

const POINTS: usize = 16;

fn strands(hair: RenderHair, guides: &[Vector3<f64>]) -> Vec<Taken> {
    let mut pose = RenderPose::new(Arc::new(hair));
    pose.set(&GuideSamples::at_rest(guides)).expect("a pose");
    evaluate(&pose, &whole(&pose))
}

fn settings(space: Space) -> RenderSettings {
    let max_tip_distance = f64::INFINITY;
    RenderSettings {
        space,
        frizz: 0.002,
        clump_noise: 0.003,
        flyaways: 0.1,
        max_tip_distance,
        seed: 7,
        ..RenderSettings::default()
    }
}

#[test]
fn a_map_of_bytes_makes_the_same_strands() {
    let guides = sintel();
    let roots = roots_among(&guides, POINTS, 300);
    let moved: Vec<_> = guides.iter().map(|p| p * 1.01 + Vector3::new(0.1, 0.0, 0.02 * (40.0 * p.y).sin())).collect();
    for space in [Space::Position, Space::Curvature] {
        let hair = RenderHair::bind(&settings(space), &GuideSamples::at_rest(&guides), &roots).expect("a map");
        let image = hair.to_bytes();
        let again = RenderHair::from_bytes(&image, Workers::Pool(2)).expect("a map");
        assert!(again.to_bytes() == image);
        assert!(strands(again, &moved) == strands(hair, &moved));
    }
}

#[test]
fn damage_is_found() {
    let guides = &sintel()[..4 * POINTS];
    let roots = roots_among(guides, POINTS, 9);
    for space in [Space::Position, Space::Curvature] {
        let hair = RenderHair::bind(&settings(space), &GuideSamples::at_rest(guides), &roots).expect("a map");
        let image = hair.to_bytes();
        let refused = |image: &[u8]| matches!(RenderHair::from_bytes(image, Workers::Serial), Err(Error::Snapshot { .. }));
        assert!((0..image.len()).all(|length| refused(&image[..length])));
        let mut image = image;
        for byte in 0..image.len() {
            image[byte] ^= 0x10;
            assert!(refused(&image), "{byte}");
            image[byte] ^= 0x10;
        }
        image.push(0);
        assert!(refused(&image));
        image.pop();
        image[8..12].copy_from_slice(&(RENDER_HAIR_VERSION + 1).to_le_bytes());
        let Err(error) = RenderHair::from_bytes(&image, Workers::Serial) else { panic!("another version is read") };
        assert!(error.to_string().contains(&format!("version {}", RENDER_HAIR_VERSION + 1)), "{error}");
        // A body whose numbers do not fit, with the checksum that belongs to it.
        image[8..12].copy_from_slice(&RENDER_HAIR_VERSION.to_le_bytes());
        let (head, end) = (20, image.len() - 8);
        let fnv = |bytes: &[u8]| {
            bytes
                .iter()
                .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
        };
        for at in (head..end).step_by(4) {
            let kept: [u8; 4] = image[at..at + 4].try_into().expect("four bytes");
            for wrong in [u32::MAX, 0x7fc0_0000, 0] {
                image[at..at + 4].copy_from_slice(&wrong.to_le_bytes());
                let hash = fnv(&image[head..end]).to_le_bytes();
                image[end..].copy_from_slice(&hash);
                // Whatever is read is a map that can be evaluated.
                if let Ok(hair) = RenderHair::from_bytes(&image, Workers::Serial)
                    && hair.guide_count() == 4
                    && hair.settings().points_per_strand == POINTS
                {
                    strands(hair, guides);
                }
            }
            image[at..at + 4].copy_from_slice(&kept);
        }
    }
}

#[test]
fn a_map_lives_on_without_some_guides() {
    let guides = sintel();
    let roots = roots_among(&guides, POINTS, 3000);
    let gone = [5_u32, 120, 17];
    let left: Vec<_> =
        guides.chunks(POINTS).enumerate().filter(|(g, _)| !gone.contains(&(*g as u32))).flat_map(|(_, p)| p.to_vec()).collect();
    for space in [Space::Position, Space::Curvature] {
        let bound =
            |guides: &[Vector3<f64>]| RenderHair::bind(&settings(space), &GuideSamples::at_rest(guides), &roots).expect("a map");
        let whole_map = bound(&guides);
        let fewer = whole_map.without_guides(&gone).expect("a map");
        assert_eq!((fewer.guide_count(), fewer.strand_count()), (guides.len() / POINTS - 3, 3000));
        let follows = |index: usize| whole_map.guides_of(index).expect("a strand").any(|(guide, _)| gone.contains(&guide));
        let lost: Vec<bool> = (0..3000).map(follows).collect();
        assert!(lost.iter().filter(|lost| **lost).count() > 30);
        // As if bound to those that are left: the same guides, the same weights.
        let anew = bound(&left);
        for index in 0..3000 {
            let of = |hair: &RenderHair| hair.guides_of(index).expect("a strand").collect::<Vec<_>>();
            if lost[index] {
                assert!(of(&fewer).iter().zip(of(&anew)).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-4), "{index}");
            }
        }
        let image = fewer.to_bytes();
        let (before, after) = (strands(whole_map, &guides), strands(fewer, &left));
        for (index, lost) in lost.iter().enumerate() {
            assert!((after[index].points[0] - roots[index]).norm() < 2e-6);
            assert!(*lost || after[index] == before[index], "{index}");
        }
        assert!(strands(RenderHair::from_bytes(&image, Workers::Serial).expect("a map"), &left) == after);
    }
    let hair = RenderHair::bind(&settings(Space::Position), &GuideSamples::at_rest(&guides), &roots[..5]).expect("a map");
    let all: Vec<u32> = (0..hair.guide_count() as u32).collect();
    for (gone, name) in [(&[228_u32][..], "gone[0]"), (&[3, 3], "gone[1]"), (&all, "gone (count)")] {
        let Err(Error::InvalidArgument { argument, .. }) = hair.without_guides(gone) else { panic!("{name} is taken") };
        assert_eq!(argument, name);
    }
}
