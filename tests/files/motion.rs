//! Head motion from tables and from motion capture.

use nalgebra::Vector3;
use superhelix::io::{Motion, MotionOptions};
use superhelix::{Error, Frame};

fn data(name: &str) -> String {
    format!("{}/tests/data/grooms/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn in_metres(scale: f64) -> MotionOptions {
    MotionOptions { metres_per_unit: Some(scale), ..MotionOptions::default() }
}

/// The largest differences of the first samples in time (s), position (m) and angle (rad).
fn difference(a: &Motion, b: &Motion) -> (f64, f64, f64) {
    let pairs = || a.frames().iter().zip(b.frames());
    let times = a.times().iter().zip(b.times()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let positions = pairs().map(|(a, b)| (a.origin - b.origin).amax()).fold(0.0, f64::max);
    (times, positions, pairs().map(|(a, b)| a.rotation.angle_to(&b.rotation)).fold(0.0, f64::max))
}

#[test]
fn motion_capture_agrees_with_other_software() {
    // The tables are rounded to a micrometre and 1e-7 in the quaternion. The two takes differ in the order of their rotations,
    // in units and in whether the root has an offset.
    for (bvh, csv, scale, samples) in [
        ("cmu_jumping_jacks.bvh", "cmu_jumping_jacks_head.csv", 0.0564, 125),
        ("walk_figure8_first240.bvh", "walk_figure8_head.csv", 0.02849, 240),
    ] {
        let captured = Motion::read_with(data(bvh), &in_metres(scale)).unwrap();
        let table = Motion::read(data(csv), None).unwrap();
        assert_eq!(captured.times().len(), samples);
        let (times, positions, angles) = difference(&captured, &table);
        assert!(times < 1e-9 && positions < 6e-7 && angles < 3e-7, "{bvh}: {times} s, {positions} m, {angles} rad");
    }
}

#[test]
fn a_table_is_read_as_it_stands() {
    let motion = Motion::read(data("walk_figure8_head.csv"), None).unwrap();
    assert_eq!((motion.times().len(), motion.times()[1]), (1064, 0.008333));
    assert_eq!(motion.duration(), 8.857979);
    assert_eq!(motion.frames()[0].origin, Vector3::new(-0.189741, 1.644857, -4.589726));
    let q = motion.frames()[0].rotation_xyzw();
    for (found, written) in q.iter().zip([0.0074238, 0.1468738, 0.0100229, -0.9890766]) {
        assert!((found - written).abs() < 1e-7, "{q:?}");
    }
    // Known of this take from other software: top speed 2.4 m/s, fastest turn 7.6 rad/s.
    let velocities: Vec<_> = motion.times().iter().map(|time| motion.velocity(*time)).collect();
    let top = velocities.iter().map(|(linear, _)| linear.norm()).fold(0.0, f64::max);
    assert!((top - 2.4).abs() < 0.06, "{top}");
    let spin = velocities.iter().map(|(_, angular)| angular.norm()).fold(0.0, f64::max);
    assert!((spin - 7.6).abs() < 0.06, "{spin}");
}

#[test]
fn quaternions_do_not_jump() {
    let rows = "0,0,0,0,1,0,0,0\n1,0,0,0,-0.9807853,0.1950903,0,0\n2,0,0,0,0.9238795,-0.3826834,0,0\n";
    let table = format!("time_s,px_m,py_m,pz_m,qw,qx,qy,qz\n{rows}");
    let motion = Motion::read_from_bytes("m.csv", table.as_bytes(), &MotionOptions::default()).unwrap();
    for pair in motion.frames().windows(2) {
        assert!(pair[0].rotation.coords.dot(&pair[1].rotation.coords) > 0.9);
    }
    // Halfway the head is turned halfway, about minus x.
    let turn = motion.at(0.5).rotation.scaled_axis();
    assert!((turn - Vector3::new(-std::f64::consts::PI / 16.0, 0.0, 0.0)).norm() < 1e-6, "{turn}");
}

/// A tree with rotations in two orders, positions on a joint that is not the root, a twice-turned axis, and a name with a blank.
const TREE: &str = "HIERARCHY\nROOT Hips\n{\n  OFFSET 1 2 3\n  CHANNELS 6 Zposition Xposition Yposition Yrotation Xrotation Zrotation\n  \
    JOINT Upper neck {\n    OFFSET 0 10 0\n    CHANNELS 4 Xposition Zrotation Xrotation Zrotation\n    JOINT theHEAD\n    {\n      \
    OFFSET 0 5 0\n      CHANNELS 0\n      End Site\n      {\n        OFFSET 0 1 0\n      }\n    }\n  }\n  JOINT Tail\n  {\n    \
    OFFSET 0 0 -1\n    CHANNELS 1 Xrotation\n  }\n}\nMOTION\nFrames: 2\nFrame Time: 0.5\n30 10 20 90 0 0 0 0 0 0 5\n\
    0 0 0 90 90 0 2 30 90 -30 6\n";

fn read(text: &str, joint: Option<&str>) -> Result<Motion, Error> {
    let options = MotionOptions { joint: joint.map(str::to_owned), metres_per_unit: None };
    Motion::read_from_bytes("m.bvh", text.as_bytes(), &options)
}

#[test]
fn a_tree_is_composed_in_the_order_of_its_channels() {
    let close = |found: Vector3<f64>, x: f64, y: f64, z: f64| {
        assert!((found - Vector3::new(x, y, z)).norm() < 1e-12, "{found} is not {x} {y} {z}");
    };
    let head = read(TREE, None).unwrap();
    assert_eq!(head.times(), [0.0, 0.5]);
    // Frame 0: the root's position channels replace its offset; a quarter turn about y takes z to x.
    close(head.frames()[0].origin, 10.0, 20.0 + 15.0, 30.0);
    close(head.frames()[0].rotation * Vector3::z(), 1.0, 0.0, 0.0);
    // Frame 1: first about y, then about the turned x: the neck (2, 10, 0) goes by x to (2, 0, 10), by y to (10, 0, -2).
    let neck = read(TREE, Some("Upper neck")).unwrap();
    close(neck.frames()[1].origin, 10.0, 0.0, -2.0);
    // Turns by 30 about z, 90 about x and -30 about z are one by 90 about x turned 30 about z: (cos 30, sin 30, 0).
    let local = read(TREE, Some("Hips")).unwrap().frames()[1].rotation.inverse() * neck.frames()[1].rotation;
    let axis = local.scaled_axis() / std::f64::consts::FRAC_PI_2;
    close(axis, 3.0_f64.sqrt() / 2.0, 0.5, 0.0);
    close(
        head.frames()[1].origin - neck.frames()[1].origin - neck.frames()[1].rotation * Vector3::new(0.0, 5.0, 0.0),
        0.0,
        0.0,
        0.0,
    );
    close(read(TREE, Some("Tail")).unwrap().frames()[0].origin, 10.0 - 1.0, 20.0, 30.0);
    // Units are scaled, turns are not; where lines end is left to the file.
    let options = MotionOptions { joint: Some("theHEAD".to_owned()), metres_per_unit: Some(0.01) };
    let small = Motion::read_from_bytes("x", TREE.replace('\n', " \r\n").as_bytes(), &options).unwrap();
    close(small.frames()[0].origin, 0.1, 0.35, 0.3);
    assert_eq!(small.frames()[1].rotation, head.frames()[1].rotation);
}

fn reason(result: Result<Motion, Error>) -> String {
    match result {
        Err(Error::File { path, reason }) => {
            assert!(path.starts_with("m."), "{path}");
            reason
        }
        other => panic!("{other:?}"),
    }
}

fn assert_says(said: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(said.contains(part), "{said:?} should say {part:?}"));
}

#[test]
fn nonsense_in_motion_capture_is_refused_with_line_and_value() {
    let with = |from: &str, to: &str| {
        assert!(TREE.contains(from), "{from}");
        reason(read(&TREE.replacen(from, to, 1), None))
    };
    assert_says(&with("HIERARCHY", "HIERARCHIES"), &["line 1", "HIERARCHIES", "expected HIERARCHY"]);
    assert_says(&with("ROOT", "JOINT"), &["line 2", "expected ROOT"]);
    assert_says(&with("OFFSET 1 2 3", "OFFSET 1 2"), &["line 5", "CHANNELS"]);
    assert_says(&with("OFFSET 1 2 3", "OFFSET 1 inf 3"), &["line 4", "inf"]);
    assert_says(&with("  OFFSET 1 2 3\n", ""), &["joint \"Hips\" has no OFFSET"]);
    assert_says(&with("OFFSET 1 2 3", "OFFSET 1 2 3 OFFSET 1 2 3"), &["line 4", "second OFFSET"]);
    assert_says(&with("Zposition Xposition", "Zposition Zposition"), &["line 5", "Zposition", "second time"]);
    assert_says(&with("Yrotation", "Wrotation"), &["line 5", "Wrotation"]);
    assert_says(&with("CHANNELS 6", "CHANNELS six"), &["line 5", "six"]);
    assert_says(&with("CHANNELS 6", "CHANNELS 4294967295"), &["line 6", "JOINT"]);
    assert_says(&with("CHANNELS 6", "CHANNELS 5"), &["line 5", "Zrotation"]);
    assert_says(&with("theHEAD", "neck"), &["no joint", "head", "Hips, Upper neck, neck, Tail"]);
    assert_says(&with("Frames: 2", "Frames: 0"), &["line 26", "0"]);
    assert_says(&with("Frames: 2", "Frames: -1"), &["line 26", "-1"]);
    assert_says(&with("Frames: 2", "Frames: 4294967295"), &["line 26", "4294967295 frames of 11", "bytes are left"]);
    assert_says(&with("Frames: 2", "Frames: 1"), &["line 29", "follows the last"]);
    assert_says(&with("Frames: 2", "Frames: 3"), &["3 frames", "left"]);
    assert_says(&with("0.5", "0"), &["line 27", "time of a frame is 0"]);
    assert_says(&with("0.5", "-0.5"), &["line 27", "-0.5"]);
    assert_says(&with("0.5", "nan"), &["line 27", "nan"]);
    assert_says(&with("30 10 20", "30 ten 20"), &["line 28", "ten"]);
    assert_says(&with("30 10 20", "30 1e308 20"), &["frames[0]", "velocity"]);
    assert_says(&with("-30 6\n", "-30"), &["the file ends"]);
    assert_says(&with("\nMOTION", "\n}\nMOTION"), &["line 25", "expected ROOT or MOTION"]);
    let no_channels = "HIERARCHY\nROOT head\n{\nOFFSET 0 0 0\nCHANNELS 0\n}\nMOTION\nFrames: 1\nFrame Time: 1\n";
    assert_says(&reason(read(no_channels, None)), &["line 7", "no motion"]);
    assert_says(&reason(read(TREE, Some("Head"))), &["no joint \"Head\""]);
    // Cut at any line, it is not whole.
    for (at, _) in TREE.match_indices('\n').filter(|(at, _)| at + 1 < TREE.len()) {
        reason(read(&TREE[..at], None));
    }
}

#[test]
fn nonsense_in_a_table_is_refused_with_line_and_value() {
    let header = "time_s,px_m,py_m,pz_m,qw,qx,qy,qz\n";
    let read = |text: String| reason(Motion::read_from_bytes("m.csv", text.as_bytes(), &MotionOptions::default()));
    assert_says(&read(String::new()), &["empty"]);
    assert_says(&read(header.to_owned()), &["no samples"]);
    assert_says(&read("t,x,y,z\n0,0,0,0\n".to_owned()), &["line 1", "t,x,y,z", "time_s"]);
    for (row, parts) in [
        ("1,0,0,0,1,0,0\n", &["line 3", "7 numbers", "8"][..]),
        ("1,0,0,0,1,0,0,0,0\n", &["line 3", "9 numbers"]),
        ("1,0,zero,0,1,0,0,0\n", &["line 3", "py_m", "zero"]),
        ("1,0,NaN,0,1,0,0,0\n", &["line 3", "py_m", "NaN"]),
        ("0,0,0,0,1,0,0,0\n", &["line 3", "time_s is 0"]),
        ("-1,0,0,0,1,0,0,0\n", &["line 3", "time_s is -1"]),
        ("\n1,0,0,0,1,1,0,0\n", &["line 4", "rotation", "unit quaternion"]),
        ("1,0,0,0,0,0,0,0\n", &["line 3", "rotation"]),
    ] {
        assert_says(&read(format!("{header}0,0,0,0,1,0,0,0\n{row}")), parts);
    }
}

#[test]
fn options_that_make_no_sense_are_refused() {
    let argument = |name: &str, options: MotionOptions| match Motion::read_with(data(name), &options) {
        Err(Error::InvalidArgument { argument, .. }) => argument,
        other => panic!("{other:?}"),
    };
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(argument("cmu_jumping_jacks.bvh", in_metres(scale)), "metres_per_unit");
    }
    // A table states metres and has one motion: options that it cannot obey are not passed over.
    assert_eq!(argument("walk_figure8_head.csv", in_metres(0.01)), "metres_per_unit");
    let joint = MotionOptions { joint: Some("Head".to_owned()), metres_per_unit: None };
    assert_eq!(argument("walk_figure8_head.csv", joint), "joint");
    assert!(
        matches!(Motion::read(data("README.md"), None), Err(Error::File { reason, .. }) if reason.contains("not a known motion"))
    );
    assert!(matches!(Motion::read(data("none.bvh"), None), Err(Error::File { reason, .. }) if reason.contains("cannot be read")));
}

#[test]
fn y_up_becomes_z_up() {
    let motion = Motion::read(data("cmu_jumping_jacks_head.csv"), None).unwrap();
    let turned = motion.to_z_up();
    let change = |v: Vector3<f64>| Vector3::new(v.x, -v.z, v.y);
    assert_eq!(change(Vector3::y()), Vector3::z());
    for time in [0.0, 0.5, 1.234567, 4.0] {
        let (before, after) = (motion.at(time), turned.at(time));
        assert!((change(before.origin) - after.origin).norm() < 1e-15);
        // A point of the head, turned along with the axes, comes out where the turned point was.
        let point = Vector3::new(0.1, -0.2, 0.3);
        assert!((change(before.rotation * point) - after.rotation * change(point)).norm() < 1e-14);
        let ((v, w), (turned_v, turned_w)) = (motion.velocity(time), turned.velocity(time));
        assert!((change(v) - turned_v).norm() < 1e-13 && (change(w) - turned_w).norm() < 1e-13);
    }
    let still = Motion::from_samples(vec![0.0], vec![Frame::default()]).unwrap();
    assert_eq!(still.to_z_up(), still);
    assert_eq!(still.duration(), 0.0);
}
