//! Groom files, caches and hair types through the C ABI: the results equal those of the library in Rust.
#![allow(unsafe_code)] // calls through the C ABI

use std::ffi::CString;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use superhelix::hair::{CurlFormula, HairParameters, HairType, Sliders, Variation};
use superhelix::internals::capi::base::errors::SHX_OK;
use superhelix::internals::capi::base::types::{SHX_FORMAT_F32X3, SHX_FORMAT_F64X3, shx_input, shx_output};
use superhelix::internals::capi::groom::curve_cache::*;
use superhelix::internals::capi::groom::curve_data::*;
use superhelix::internals::capi::groom::curves::*;
use superhelix::internals::capi::groom::hair_type::*;
use superhelix::io::{Curves, Extras, UpAxis};

fn made<T>(fill: impl FnOnce(*mut T) -> i32) -> T {
    let mut made = MaybeUninit::uninit();
    assert_eq!(fill(made.as_mut_ptr()), SHX_OK);
    // SAFETY: the call went well, so it filled the structure.
    unsafe { made.assume_init() }
}

fn input<T>(items: &[T], format: u32) -> shx_input {
    shx_input { data: items.as_ptr().cast(), stride: 0, count: items.len(), format, reserved: 0 }
}

const COUNTS: [u32; 2] = [2, 3];
const POINTS: [[f32; 3]; 5] = [[0.0, 0.1, 0.2], [1.0 / 3.0, 1.0, 1.0], [2.0; 3], [3.0; 3], [-1e-7, 4.0, 5.0]];
const VELOCITIES: [[f64; 3]; 5] = [[0.5, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3], [0.0, 0.0, 2.0], [-1.0, 0.0, 0.25]];
const THICKNESS: [f32; 5] = [0.1, 0.2, 0.3, 0.4, 0.5];
const HELD: [u8; 5] = [1, 0, 9, 0, 0];

fn data() -> shx_curve_data {
    shx_curve_data {
        up_axis: SHX_UP_AXIS_Z,
        strand_count: 2,
        point_counts: COUNTS.as_ptr(),
        points: input(&POINTS, SHX_FORMAT_F32X3),
        velocities: input(&VELOCITIES, SHX_FORMAT_F64X3),
        thickness: THICKNESS.as_ptr(),
        pinned: HELD.as_ptr(),
        metres_per_unit: 0.01,
        // SAFETY: room for one structure.
        ..made(|data| unsafe { shx_curve_data_init(data, size_of::<shx_curve_data>()) })
    }
}

fn path(name: &str) -> (std::path::PathBuf, CString) {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("capi_{name}"));
    let text = CString::new(path.to_str().unwrap()).unwrap();
    (path, text)
}

/// All numbers of a kind.
fn numbers(curves: *const shx_curves, what: u32) -> Vec<f32> {
    let mut count = 0;
    // SAFETY: a living handle, and room for as many numbers as it says.
    unsafe {
        assert_eq!(shx_curves_attribute(curves, what, null_mut(), 0, &raw mut count), SHX_OK);
        let mut numbers = vec![0.0; count];
        assert_eq!(shx_curves_attribute(curves, what, numbers.as_mut_ptr(), count, &raw mut count), SHX_OK);
        numbers
    }
}

#[test]
fn saved_curves_are_read_with_all_their_data() {
    let data = data();
    let (rust, text) = path("groom.usda");
    // SAFETY: all that is pointed to is there; handles are freed once.
    unsafe {
        assert_eq!(shx_curve_data_write(text.as_ptr(), &raw const data), SHX_OK);
        let curves = made(|curves| shx_curves_read(text.as_ptr(), curves));
        let mut points = [[0.0_f32; 3]; 5];
        let output = shx_output { data: points.as_mut_ptr().cast(), stride: 0, count: 5, format: SHX_FORMAT_F32X3, reserved: 0 };
        assert_eq!(shx_curves_points(curves, 0, 2, 1.0, &raw const output), SHX_OK);
        assert_eq!(points, POINTS);
        assert_eq!(numbers(curves, SHX_CURVE_ATTRIBUTE_THICKNESS), THICKNESS);
        assert_eq!(
            numbers(curves, SHX_CURVE_ATTRIBUTE_VELOCITY),
            VELOCITIES.as_flattened().iter().map(|value| *value as f32).collect::<Vec<_>>()
        );
        assert_eq!(numbers(curves, SHX_CURVE_ATTRIBUTE_PINNED), [1.0, 0.0, 1.0, 0.0, 0.0]);
        for what in [
            SHX_CURVE_ATTRIBUTE_TRANSPARENCY,
            SHX_CURVE_ATTRIBUTE_COLOR,
            SHX_CURVE_ATTRIBUTE_STRAND_THICKNESS,
            SHX_CURVE_ATTRIBUTE_STRAND_UV,
            SHX_CURVE_ATTRIBUTE_ARCLENGTH,
        ] {
            assert!(numbers(curves, what).is_empty());
        }
        let (mut metres, mut up) = (0.0, 0);
        assert_eq!(shx_curves_units(curves, &raw mut metres, &raw mut up), SHX_OK);
        assert_eq!((metres, up), (0.01, SHX_UP_AXIS_Z));
        shx_curves_destroy(curves);
    }
    let read = Curves::read(rust).unwrap();
    let expected = Extras {
        thickness: Some(THICKNESS.to_vec()),
        velocities: Some(VELOCITIES.iter().map(|v| v.map(|value| value as f32)).collect()),
        held: Some(HELD.iter().map(|held| *held != 0).collect()),
        metres_per_unit: Some(0.01),
        up: Some(UpAxis::Z),
        ..Extras::default()
    };
    assert_eq!(read.extras(), &expected);
    // Other formats by their names; a version of .tfx that was asked for.
    for (name, version, format) in
        [("groom.tfx", 2, "tfx 2 (text)"), ("groom.hair", 0, "hair"), ("groom.obj", 0, "obj"), ("b.tfx", 0, "tfx 2 (text)")]
    {
        let (rust, text) = path(name);
        let data = shx_curve_data { tfx_version: version, ..data };
        // SAFETY: the same.
        assert_eq!(unsafe { shx_curve_data_write(text.as_ptr(), &raw const data) }, SHX_OK);
        let read = Curves::read(rust).unwrap();
        assert_eq!((read.format().name(), read.points()), (format, &POINTS[..]));
    }
}

#[test]
fn a_cache_is_written_and_read_frame_by_frame() {
    let (rust, text) = path("cache.usda");
    let data = data();
    let at = |time: f32| POINTS.map(|point| point.map(|value| value + time));
    // SAFETY: all that is pointed to is there; handles are ended or freed once.
    unsafe {
        let writer = made(|writer| shx_curve_cache_writer_create(text.as_ptr(), &raw const data, 24.0, writer));
        for time in [0.0_f32, 0.5, 1.0] {
            let (points, velocities) = (at(time), input(&VELOCITIES, SHX_FORMAT_F64X3));
            let points = input(&points, SHX_FORMAT_F32X3);
            assert_eq!(shx_curve_cache_writer_write(writer, f64::from(time), &raw const points, &raw const velocities), SHX_OK);
        }
        assert!(!rust.exists());
        assert_eq!(shx_curve_cache_writer_finish(writer), SHX_OK);
        let cache = made(|cache| shx_curve_cache_read(text.as_ptr(), cache));
        let (mut times, mut count) = ([0.0; 3], 0);
        assert_eq!(shx_curve_cache_times(cache, null_mut(), 0, &raw mut count), SHX_OK);
        assert_eq!(count, 3);
        assert_eq!(shx_curve_cache_times(cache, times.as_mut_ptr(), 3, &raw mut count), SHX_OK);
        assert_eq!(times, [0.0, 0.5, 1.0]);
        let curves = made(|curves| shx_curve_cache_sample(cache, 0.5, curves));
        assert_eq!(numbers(curves, SHX_CURVE_ATTRIBUTE_VELOCITY).len(), 15);
        shx_curves_destroy(curves);
        shx_curve_cache_destroy(cache);
        let given_up = made(|writer| shx_curve_cache_writer_create(path("none.usda").1.as_ptr(), &raw const data, 24.0, writer));
        shx_curve_cache_writer_abandon(given_up);
    }
    let cache = superhelix::io::CurveCache::read(&rust).unwrap();
    assert_eq!(cache.frame(1).unwrap().points(), at(0.5));
    std::fs::remove_file(rust).unwrap();
    assert!(!path("none.usda").0.exists());
}

#[test]
fn strands_of_a_kind_are_those_of_the_library() {
    // SAFETY: all that is pointed to is there.
    unsafe {
        let mut hair: shx_hair_type = made(|hair| shx_hair_type_init(hair, size_of::<shx_hair_type>()));
        assert_eq!(shx_hair_type_from_name(c"african".as_ptr(), &raw mut hair), SHX_OK);
        assert_eq!((hair.helix_pitch, hair.youngs_modulus), (0.01, 0.5e9));
        (hair.variation_between, hair.variation_along, hair.frizz, hair.root_turn, hair.seed) = (0.1, 0.05, 4.0, 0.5, 11);
        let mut sliders: shx_hair_sliders = made(|sliders| shx_hair_sliders_init(sliders, size_of::<shx_hair_sliders>()));
        (sliders.stiffness, sliders.discipline) = (0.5, -0.25);
        let (counts, lengths) = ([3_u32, 2], [0.01, 0.02, 0.03, 0.05, 0.04]);
        let mut strands: [shx_hair_strand; 2] = [made(|strand| {
            std::ptr::write_bytes(strand, 0, 1);
            SHX_OK
        }); 2];
        let mut natural = [[0.0_f64; 3]; 5];
        let make = |sliders: *const shx_hair_sliders, strands: &mut [shx_hair_strand; 2], natural: &mut [[f64; 3]; 5]| {
            let out = (strands.as_mut_ptr(), natural.as_mut_ptr().cast());
            let mut def: shx_hair_strands_def = made(|def| shx_hair_strands_def_init(def, size_of::<shx_hair_strands_def>()));
            (def.hair_type, def.sliders, def.first_strand, def.strand_count) = (&raw const hair, sliders, 7, 2);
            (def.element_counts, def.element_lengths) = (counts.as_ptr(), lengths.as_ptr());
            shx_hair_strands(&raw const def, out.0, 0, out.1, 5)
        };
        let variation = Variation { between: 0.1, along: 0.05, frizz: 4.0, root_turn: 0.5, seed: 11, ..Variation::none() };
        let own = HairParameters { variation, ..HairType::African.measured().parameters(CurlFormula::Exact).unwrap() };
        let moved = own.with_sliders(&Sliders { stiffness: 0.5, discipline: -0.25, ..Sliders::default() }).unwrap();
        for (sliders, expected) in [(null(), own), (&raw const sliders, moved)] {
            assert_eq!(make(sliders, &mut strands, &mut natural), SHX_OK);
            for (index, range) in [(0, 0..3), (1, 3..5)] {
                let strand = expected.strand(7 + index as u64, &lengths[range.clone()]).unwrap();
                assert_eq!(natural[range], strand.natural[..]);
                let made = strands[index];
                assert_eq!(
                    (made.radius, made.youngs_modulus, made.root_turn),
                    (strand.material.radius, strand.material.youngs_modulus, strand.root_turn)
                );
                assert_eq!(
                    (made.air_drag, made.friction_along),
                    (strand.material.air_drag, expected.contact().hair_friction.along)
                );
            }
        }
    }
}

/// A Bézier curve along the x axis from 0 to 3, its control points evenly spaced: four chords, arclengths 0 to 3.
#[test]
fn arclengths_of_splines_are_read() {
    let (rust, text) = path("line.usda");
    let line = "#usda 1.0\ndef BasisCurves \"l\" {\nuniform token basis = \"bezier\"\nint[] curveVertexCounts = [4]\n\
        point3f[] points = [(0,0,0),(1,0,0),(2,0,0),(3,0,0)]\n}\n";
    std::fs::write(rust, line).unwrap();
    // SAFETY: all that is pointed to is there; handles are freed once.
    unsafe {
        let curves = made(|curves| shx_curves_read(text.as_ptr(), curves));
        let along = numbers(curves, SHX_CURVE_ATTRIBUTE_ARCLENGTH);
        assert!(along.len() == 5 && (0..5).all(|k| (along[k] - 0.75 * k as f32).abs() < 1e-6), "{along:?}");
        shx_curves_destroy(curves);
    }
}
