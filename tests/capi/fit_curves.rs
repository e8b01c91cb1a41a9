//! The bulk fit and splines through the C ABI: the numbers of the Rust functions, for any workers.
#![allow(unsafe_code)] // calls of the C ABI

use std::ffi::c_void;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicU32, Ordering};

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::{ElementLengths, FitCurve, FitOptions, FitRoot, FitScratch, fit_curve};
use superhelix::internals::capi::base::errors::{SHX_ERROR_INVALID_ARGUMENT, SHX_OK};
use superhelix::internals::capi::base::parallel::shx_range_fn;
use superhelix::internals::capi::base::types::{SHX_FORMAT_F32X3, SHX_FORMAT_F64X3, SHX_FORMAT_F64X4, shx_input, shx_output};
use superhelix::internals::capi::groom::fit_curves::{
    SHX_FIT_LENGTHS_EQUAL, shx_fit_input, shx_fit_input_init, shx_fit_options, shx_fit_options_init, shx_fit_strands,
    shx_fitted_strand, shx_strand_def_set_fit,
};
use superhelix::internals::capi::groom::spline::{
    SHX_SPLINE_BSPLINE, SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_PINNED, shx_spline_def, shx_spline_def_init, shx_spline_points,
};
use superhelix::internals::capi::hair::strand_def::{shx_strand_def, shx_strand_def_init};
use superhelix::splines::{Spline, SplineEnds, SplineKind};

const ELEMENTS: usize = 4;

fn options() -> shx_fit_options {
    let mut options = MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_fit_options_init(options.as_mut_ptr(), size_of::<shx_fit_options>()), SHX_OK);
        shx_fit_options { element_count: ELEMENTS as u32, ..options.assume_init() }
    }
}

fn curves() -> shx_fit_input {
    let mut curves = MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_fit_input_init(curves.as_mut_ptr(), size_of::<shx_fit_input>()), SHX_OK);
        curves.assume_init()
    }
}

fn input<T>(data: &[T], count: usize, format: u32) -> shx_input {
    shx_input { data: data.as_ptr().cast(), stride: 0, count, format, reserved: 0 }
}

struct Fitted {
    strands: Vec<shx_fitted_strand>,
    lengths: Vec<f64>,
    rows: Vec<[f64; 3]>,
}

fn fit(options: &shx_fit_options, curves: &shx_fit_input) -> Fitted {
    let count = curves.curve_count;
    let mut strands: Vec<MaybeUninit<shx_fitted_strand>> = vec![MaybeUninit::uninit(); count];
    let (mut lengths, mut rows) = (vec![-1.0; count * ELEMENTS + 1], vec![[-1.0; 3]; count * ELEMENTS + 1]);
    // SAFETY: memory for all that is written; the curves are the caller's.
    let strands = unsafe {
        let result = shx_fit_strands(
            options,
            curves,
            strands.as_mut_ptr().cast(),
            0,
            lengths.as_mut_ptr(),
            rows.as_mut_ptr().cast(),
            count * ELEMENTS,
        );
        assert_eq!(result, SHX_OK);
        strands.iter().map(|strand| strand.assume_init()).collect()
    };
    // Nothing is written beyond what was given.
    assert_eq!((lengths.pop(), rows.pop()), (Some(-1.0), Some([-1.0; 3])));
    Fitted { strands, lengths, rows }
}

/// Thirty curls of 3 to 32 points, the eleventh without length; points and their counts.
fn groom() -> (Vec<[f64; 3]>, Vec<u32>) {
    let (mut points, mut counts) = (Vec::new(), Vec::new());
    for strand in 0..30_u32 {
        let count = 3 + strand;
        counts.push(count);
        points.extend((0..count).map(|k| {
            let t = f64::from(k) * 0.02 * if strand == 10 { 0.0 } else { 1.0 };
            let rate = 20.0 + f64::from(strand);
            [0.01 * (rate * t).cos() + 0.1 * f64::from(strand), 0.01 * (rate * t).sin(), -t]
        }));
    }
    (points, counts)
}

unsafe extern "C" fn backwards(user: *mut c_void, count: u32, _: u32, function: shx_range_fn, task: *mut c_void) {
    let function = function.expect("the engine's function");
    // SAFETY: the test's number, and the engine's task as its type says.
    unsafe {
        (*user.cast::<AtomicU32>()).fetch_add(count, Ordering::Relaxed);
        for index in (0..count).rev() {
            function(task, index, index + 1, 0);
        }
    }
}

#[test]
fn strands_are_those_of_the_rust_functions_with_any_number_of_threads() {
    let (points, counts) = groom();
    let curves = shx_fit_input {
        curve_count: counts.len(),
        points: input(&points, points.len(), SHX_FORMAT_F64X3),
        point_counts: counts.as_ptr(),
        ..curves()
    };
    let serial = fit(&options(), &curves);
    let (mut first, mut scratch) = (0, FitScratch::default());
    for (index, count) in counts.iter().enumerate() {
        let own: Vec<Vector3<f64>> = points[first..first + *count as usize].iter().map(|point| Vector3::from(*point)).collect();
        first += *count as usize;
        let strand = &serial.strands[index];
        let range = index * ELEMENTS..(index + 1) * ELEMENTS;
        match fit_curve(&FitCurve::polyline(&own), &FitOptions::elements(ELEMENTS), &mut scratch) {
            Ok(fit) => {
                assert_eq!((strand.result, strand.element_count as usize), (SHX_OK, ELEMENTS));
                assert_eq!(serial.lengths[range.clone()], fit.element_lengths);
                assert_eq!(serial.rows[range], fit.curvatures);
                assert_eq!(
                    (strand.rms_error, strand.max_error, strand.max_distance),
                    (fit.rms_error, fit.max_error, fit.max_distance)
                );
                assert_eq!((strand.root.rotation, strand.frame_error, strand.radius), (fit.root.rotation_xyzw(), 0.0, 0.0));
                assert_eq!(Vector3::from(strand.root.origin), own[0]);
            }
            Err(_) => {
                assert_eq!((index, strand.result, strand.element_count), (10, SHX_ERROR_INVALID_ARGUMENT, 0));
                assert!(serial.lengths[range.clone()].iter().all(|length| *length == 0.0) && strand.length == 0.0);
            }
        }
    }
    // A pool, and a host that goes backwards: the same bits.
    let calls = AtomicU32::new(0);
    let host = shx_fit_options {
        parallel_for: Some(backwards),
        parallel_for_user: std::ptr::from_ref(&calls).cast_mut().cast(),
        ..options()
    };
    for others in [fit(&shx_fit_options { worker_count: 3, ..options() }, &curves), fit(&host, &curves)] {
        assert_eq!((&others.lengths, &others.rows), (&serial.lengths, &serial.rows));
        for (a, b) in others.strands.iter().zip(&serial.strands) {
            assert_eq!((a.result, a.rms_error.to_bits(), a.root.rotation), (b.result, b.rms_error.to_bits(), b.root.rotation));
        }
    }
    assert!(calls.load(Ordering::Relaxed) > 0);
    // No curves, no options: nothing to do.
    // SAFETY: nothing is written.
    unsafe {
        let none = shx_fit_input { curve_count: 0, points: shx_input { count: 0, ..curves.points }, ..curves };
        assert_eq!(shx_fit_strands(null(), &raw const none, null_mut(), 0, null_mut(), null_mut(), 0), SHX_OK);
    }
}

#[test]
fn optional_data_of_curves_is_read() {
    let (points, counts) = groom();
    let (points, counts) = (&points[..7], &counts[..2]);
    let narrow: Vec<[f32; 3]> = points.iter().map(|point| point.map(|number| number as f32)).collect();
    let arclengths = [0.0, 0.03, 0.05, 0.0, 0.02, 0.05, 0.08];
    let widths = [1e-4; 7];
    let turned = UnitQuaternion::from_euler_angles(0.2, 1.0, 0.1);
    let quaternion: [f64; 4] = turned.coords.into();
    let frames = [quaternion; 7];
    let directions = [[0.0, 0.0, -3.0], [0.0, 1e-3, -1e-3]];
    let all = shx_fit_input {
        curve_count: 2,
        points: input(&narrow, 7, SHX_FORMAT_F32X3),
        point_counts: counts.as_ptr(),
        arclengths: arclengths.as_ptr(),
        widths: widths.as_ptr(),
        frames: input(&frames, 7, SHX_FORMAT_F64X4),
        roots: input(&directions, 2, SHX_FORMAT_F64X3),
        ..curves()
    };
    let equal = shx_fit_options { length_mode: SHX_FIT_LENGTHS_EQUAL, frame_weight: 1e-2, ..options() };
    let fitted = fit(&equal, &all);
    let wide: Vec<Vector3<f64>> = narrow.iter().map(|point| Vector3::from(point.map(f64::from))).collect();
    let rotations = [turned; 7];
    let rust = FitOptions { lengths: ElementLengths::Equal, frame_weight: 1e-2, ..FitOptions::elements(ELEMENTS) };
    for (index, range) in [0..3, 3..7].into_iter().enumerate() {
        let curve = FitCurve {
            points: &wide[range.clone()],
            arclengths: Some(&arclengths[range.clone()]),
            frames: Some(&rotations[range.clone()]),
            widths: Some(&widths[range]),
            root: FitRoot::Direction(directions[index].into()),
        };
        let expected = fit_curve(&curve, &rust, &mut FitScratch::default()).unwrap();
        assert_eq!(fitted.rows[index * ELEMENTS..(index + 1) * ELEMENTS], expected.curvatures);
        let strand = &fitted.strands[index];
        assert!((strand.radius - 5e-5).abs() < 1e-18 && strand.frame_error == expected.frame_error && strand.frame_error > 0.0);
        assert!((strand.length - arclengths[if index == 0 { 2 } else { 6 }]).abs() < 1e-16);
    }
    // Into a definition, and from there into a solver: the strand is there, with its radius, its root and its shape.
    let mut def = MaybeUninit::<shx_strand_def>::uninit();
    // SAFETY: room for a definition, and the fitted strand's own lengths and rows.
    let def = unsafe {
        assert_eq!(shx_strand_def_init(def.as_mut_ptr(), size_of::<shx_strand_def>()), SHX_OK);
        (*def.as_mut_ptr()).density = 1000.0;
        let (lengths, rows) = (fitted.lengths[ELEMENTS..].as_ptr(), fitted.rows[ELEMENTS..].as_ptr());
        assert_eq!(shx_strand_def_set_fit(def.as_mut_ptr(), &raw const fitted.strands[1], lengths, rows.cast()), SHX_OK);
        def.assume_init()
    };
    assert_eq!((def.element_count as usize, def.length, def.density), (ELEMENTS, fitted.strands[1].length, 1000.0));
    assert_eq!((def.root.origin, def.root.rotation), (fitted.strands[1].root.origin, fitted.strands[1].root.rotation));
    assert_eq!((def.radius, def.initial_curvatures), ([fitted.strands[1].radius; 2], null()));
    // SAFETY: what the definition points to is there.
    let (lengths, rows) = unsafe {
        let rows = std::slice::from_raw_parts(def.natural_curvatures.cast::<[f64; 3]>(), ELEMENTS);
        (std::slice::from_raw_parts(def.element_lengths, ELEMENTS), rows)
    };
    assert_eq!((lengths, rows), (&fitted.lengths[ELEMENTS..], &fitted.rows[ELEMENTS..]));
    // Quaternions in place of directions are frames.
    let framed = fit(&equal, &shx_fit_input { roots: input(&frames, 2, SHX_FORMAT_F64X4), ..all });
    for strand in framed.strands {
        assert!(strand.root.rotation.iter().zip(quaternion).all(|(a, b)| (a - b).abs() < 1e-15));
    }
}

#[test]
fn spline_points_are_counted_and_written() {
    let controls = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.1, 0.1, 0.0], [0.0, 0.1, 0.1], [0.0, 0.0, 0.2]];
    let mut count = 0;
    let mut points = [[0.0; 3]; 17];
    let mut arclengths = [-1.0; 17];
    let output = shx_output { data: points.as_mut_ptr().cast(), stride: 0, count: 17, format: SHX_FORMAT_F64X3, reserved: 0 };
    // SAFETY: a definition, and memory for 17 points.
    unsafe {
        let mut def = std::mem::MaybeUninit::<shx_spline_def>::uninit();
        assert_eq!(shx_spline_def_init(def.as_mut_ptr(), size_of::<shx_spline_def>()), SHX_OK);
        let mut def = def.assume_init();
        assert_eq!((def.kind, def.ends, def.points_per_span), (SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_PINNED, 8));
        (def.kind, def.points_per_span, def.controls) = (SHX_SPLINE_BSPLINE, 4, input(&controls, 5, SHX_FORMAT_F64X3));
        let ask = shx_spline_points(&raw const def, null(), null_mut(), &raw mut count);
        assert_eq!((ask, count), (SHX_OK, 17));
        let made = shx_spline_points(&raw const def, &raw const output, arclengths.as_mut_ptr(), &raw mut count);
        assert_eq!((made, count), (SHX_OK, 17));
    }
    let controls: Vec<Vector3<f64>> = controls.into_iter().map(Vector3::from).collect();
    let (expected, lengths) = Spline::new(SplineKind::BSpline, SplineEnds::Pinned, 5).unwrap().points(&controls, 4).unwrap();
    assert!(points.iter().zip(&expected).all(|(a, b)| Vector3::from(*a) == *b) && arclengths[..] == lengths[..]);
}
