//! Motions through poses by the C ABI: the numbers of the Rust spline, and what of them a caller asks for.
#![allow(unsafe_code)] // calls of the C ABI

use std::ptr::null;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::Frame;
use superhelix::internals::capi::base::errors::SHX_OK;
use superhelix::internals::capi::base::types::{
    SHX_FORMAT_F32X3, SHX_FORMAT_F64X3, SHX_FORMAT_F64X4, SHX_FORMAT_FRAME, shx_input, shx_output,
};
use superhelix::internals::capi::hair::motion::shx_sample_motion;
use superhelix::splines::PoseSpline;

const POSE_TIMES: [f64; 5] = [1.0, 1.1, 1.25, 1.3, 1.5];
/// Before, at the first, between, at a middle one, between, at the last, after.
const TIMES: [f64; 7] = [0.5, 1.0, 1.17, 1.3, 1.4999, 1.5, 9.0];

fn poses() -> Vec<Frame> {
    let pose = |time: &f64| Frame {
        origin: Vector3::new(time * time, 0.3 * (5.0 * time).sin(), -time),
        rotation: UnitQuaternion::from_euler_angles(2.0 * time, (3.0 * time).cos(), 0.4),
    };
    POSE_TIMES.iter().map(pose).collect()
}

fn rows(poses: &[Frame]) -> Vec<[f64; 7]> {
    let row = |pose: &Frame| {
        let ([x, y, z], [i, j, k, w]) = (pose.origin.into(), pose.rotation_xyzw());
        [x, y, z, i, j, k, w]
    };
    poses.iter().map(row).collect()
}

fn output<T>(items: &mut [T], format: u32) -> shx_output {
    shx_output { data: items.as_mut_ptr().cast(), stride: 0, count: items.len(), format, reserved: 0 }
}

#[test]
fn frames_and_velocities_are_those_of_the_spline() {
    let rows_in = rows(&poses());
    let input = shx_input { data: rows_in.as_ptr().cast(), stride: 0, count: 5, format: SHX_FORMAT_FRAME, reserved: 0 };
    let (mut frames, mut linear, mut angular) = ([[9.0_f64; 7]; 7], [[9.0_f64; 3]; 7], [[9.0_f64; 3]; 7]);
    // SAFETY: five poses with their times, seven times, and room for seven of each output.
    let result = unsafe {
        shx_sample_motion(
            POSE_TIMES.as_ptr(),
            &raw const input,
            TIMES.as_ptr(),
            7,
            &output(&mut frames, SHX_FORMAT_FRAME),
            &output(&mut linear, SHX_FORMAT_F64X3),
            &output(&mut angular, SHX_FORMAT_F64X3),
        )
    };
    assert_eq!(result, SHX_OK);
    let read = |row: &[f64; 7]| Frame::from_arrays("a row", [row[0], row[1], row[2]], [row[3], row[4], row[5], row[6]]).unwrap();
    let spline = PoseSpline::new(POSE_TIMES.to_vec(), rows_in.iter().map(read).collect()).unwrap();
    for (index, time) in TIMES.iter().enumerate() {
        assert_eq!(frames[index], rows(&[spline.at(*time)])[0], "{time}");
        let (expected, spin) = spline.velocity(*time);
        assert_eq!((Vector3::from(linear[index]), Vector3::from(angular[index])), (expected, spin), "{time}");
    }
    // The two outside stand still, the two at the ends move.
    assert!(linear[0] == [0.0; 3] && linear[6] == [0.0; 3] && angular[0] == [0.0; 3] && angular[6] == [0.0; 3]);
    assert!(Vector3::from(linear[1]).norm() > 0.5 && Vector3::from(angular[5]).norm() > 0.5);
}

#[test]
fn a_caller_gets_what_it_asks_for() {
    let rows_in = rows(&poses());
    let input = shx_input { data: rows_in.as_ptr().cast(), stride: 0, count: 5, format: SHX_FORMAT_FRAME, reserved: 0 };
    let (mut frames, mut linear) = ([[9.0_f64; 7]; 7], [[9.0_f64; 3]; 7]);
    let (mut turns, mut singles) = ([[9.0_f64; 4]; 7], [[9.0_f32; 3]; 7]);
    let sample = |frames: Option<shx_output>, linear: Option<shx_output>| {
        let pointer = |output: &Option<shx_output>| output.as_ref().map_or(null(), std::ptr::from_ref);
        // SAFETY: five poses with their times, seven times, and room for seven of each output.
        unsafe {
            shx_sample_motion(
                POSE_TIMES.as_ptr(),
                &raw const input,
                TIMES.as_ptr(),
                7,
                pointer(&frames),
                pointer(&linear),
                null(),
            )
        }
    };
    assert_eq!(sample(Some(output(&mut frames, SHX_FORMAT_FRAME)), None), SHX_OK);
    assert_eq!(sample(None, Some(output(&mut linear, SHX_FORMAT_F64X3))), SHX_OK);
    assert_eq!(sample(Some(output(&mut turns, SHX_FORMAT_F64X4)), Some(output(&mut singles, SHX_FORMAT_F32X3))), SHX_OK);
    for index in 0..TIMES.len() {
        assert_eq!(turns[index], frames[index][3..]);
        assert_eq!(singles[index], linear[index].map(|value| value as f32));
    }
}
