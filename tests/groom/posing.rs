//! Strands posed by hand, as shapes: drags against geometry, cuts and mirrors to rounding. Simulated strands are in `posing_living.rs`.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::{Brush, DragTarget, ElementChange, Growth, Plane, PoseOptions, StrandShape};
use superhelix::internals::contact::body_at::BodyAt;
use superhelix::internals::groom::pose::{PoseScratch, Surroundings};
use superhelix::{Error, Frame, Freedoms, Shape};

/// Random numbers in [−1, 1).
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.next(), self.next(), self.next())
    }

    /// A curl of unequal elements whose root is anywhere.
    fn strand(&mut self, elements: usize, turn: f64) -> StrandShape {
        let element_lengths: Vec<f64> = (0..elements).map(|_| 0.25 / elements as f64 * (1.0 + 0.4 * self.next())).collect();
        let common = self.vector();
        let curvatures =
            element_lengths.iter().map(|length| (0.7 * common + 0.3 * self.vector()) * (turn / length)).map(Into::into).collect();
        let rotation = UnitQuaternion::from_euler_angles(3.0 * self.next(), 1.5 * self.next(), 3.0 * self.next());
        StrandShape { root: Frame { origin: 0.3 * self.vector(), rotation }, element_lengths, curvatures }
    }
}

fn straight(length: f64, elements: usize) -> StrandShape {
    StrandShape {
        root: Frame::default(),
        element_lengths: vec![length / elements as f64; elements],
        curvatures: vec![[0.0; 3]; elements],
    }
}

fn drag(shape: &mut StrandShape, arclength: f64, position: Vector3<f64>, options: &PoseOptions) -> superhelix::editing::Dragged {
    let target = DragTarget { arclength, position };
    shape.drag(&target, options, &Surroundings::default(), &mut PoseScratch::default()).unwrap()
}

/// Targets that are reachable, for they are where another shape of the same strand has the point.
#[test]
fn reachable_targets_are_reached() {
    let mut noise = Noise(1);
    let (mut worst, mut iterations, mut count) = (0.0_f64, 0, 0);
    for elements in [2, 3, 5, 10, 20] {
        for turn in [0.0, 0.1, 0.5] {
            for share in [1.0, 0.7] {
                for _ in 0..6 {
                    let mut shape = noise.strand(elements, turn);
                    let mut other = shape.clone();
                    for (row, length) in other.curvatures.iter_mut().zip(&shape.element_lengths) {
                        for value in row {
                            *value += 0.5 / length * noise.next();
                        }
                    }
                    let arclength = share * shape.length();
                    let target = other.frame_at(arclength).origin;
                    let (before, length) = (shape.clone(), shape.length());
                    let found = drag(&mut shape, arclength, target, &PoseOptions::default());
                    let off = (shape.frame_at(arclength).origin - target).norm();
                    println!(
                        "{elements} {turn} {share}: {off:.1e} {} from {:.2}",
                        found.iterations,
                        (before.frame_at(arclength).origin - target).norm() / length
                    );
                    assert!((off - found.distance).abs() < 1e-12);
                    worst = worst.max(off);
                    iterations += found.iterations;
                    count += 1;
                    assert_eq!((shape.root, &shape.element_lengths), (before.root, &before.element_lengths));
                }
            }
        }
    }
    println!("worst {worst:.1e} m, {} iterations a drag", iterations / count);
    assert!(worst < 1e-6, "{worst:e}");
}

/// A root that points at the target: the strand is pulled straight, to the last micrometre.
#[test]
fn a_target_out_of_reach_pulls_the_strand_straight_towards_it() {
    let mut noise = Noise(2);
    for elements in [1, 5, 10] {
        let mut shape = noise.strand(elements, 0.4);
        let length = shape.length();
        let direction = shape.root.rotation * Vector3::x();
        let target = shape.root.origin + direction * (1.5 * length);
        let found = drag(&mut shape, length, target, &PoseOptions::default());
        for share in [0.2, 0.5, 0.9, 1.0] {
            let frame = shape.frame_at(share * length);
            let off = (frame.origin - shape.root.origin - direction * (share * length)).norm();
            let angle = (frame.rotation * Vector3::x()).angle(&direction);
            println!("{elements} {share}: {off:.1e} m, {angle:.1e} rad, {} iterations", found.iterations);
            assert!(off < 1e-6 && angle < 1e-4, "{off:e} {angle:e}");
        }
        assert!((found.distance - 0.5 * length).abs() < 1e-6);
    }
}

/// A root that points elsewhere: the first elements turn, the rest points at the target, and no small change of any curvature brings the tip
/// nearer (the slope of the distance is zero, by finite differences).
#[test]
fn a_target_out_of_reach_is_approached_as_far_as_can_be() {
    let mut noise = Noise(3);
    for _ in 0..8 {
        let mut shape = noise.strand(8, 0.3);
        let length = shape.length();
        let away = shape.root.rotation * Vector3::new(0.5, 0.6, -0.7).normalize();
        let target = shape.root.origin + away * (3.0 * length);
        let found = drag(&mut shape, length, target, &PoseOptions::default());
        let reach = |shape: &StrandShape| (shape.frame_at(length).origin - target).norm();
        let mut steepest = 0.0_f64;
        for element in 0..8 {
            for axis in 0..3 {
                let turn = 1e-5 / shape.element_lengths[element];
                let at = |turn: f64| {
                    let mut other = shape.clone();
                    other.curvatures[element][axis] += turn;
                    reach(&other)
                };
                steepest = steepest.max(((at(turn) - at(-turn)) / 2e-5).abs() / length);
            }
        }
        let tip = shape.frame_at(length).rotation * Vector3::x();
        let angle = tip.angle(&(target - shape.frame_at(0.3 * length).origin));
        println!("{steepest:.1e} of L a radian, {angle:.1e} rad, {} iterations", found.iterations);
        // Half a millionth of the length a radian: rounding of the differences is 1e-11.
        assert!(steepest < 1e-6, "{steepest:e}");
        assert!(angle < 0.02, "{angle}");
    }
}

#[test]
fn a_straight_strand_that_is_pushed_along_itself_bends() {
    for share in [0.99, 0.8, 0.4, 0.1] {
        let mut shape = straight(0.2, 8);
        drag(&mut shape, 0.2, Vector3::new(share * 0.2, 0.0, 0.0), &PoseOptions::default());
        let off = (shape.frame_at(0.2).origin - Vector3::new(share * 0.2, 0.0, 0.0)).norm();
        assert!(off < 1e-6, "{share}: {off:e}");
    }
}

#[test]
fn elements_and_freedoms_that_may_not_change_keep_their_bits() {
    let mut noise = Noise(4);
    let shape = noise.strand(10, 0.3);
    let movable: Vec<bool> = (0..10).map(|k| k >= 3 && k != 6).collect();
    let surroundings = Surroundings { freedoms: Freedoms::BEND1.union(Freedoms::BEND2), ..Surroundings::default() };
    let options = PoseOptions { movable: Some(movable.clone()), ..PoseOptions::default() };
    let length = shape.length();
    let target = shape.frame_at(length).origin + 0.2 * length * Vector3::new(0.3, -0.5, 0.2);
    let mut dragged = shape.clone();
    let found = dragged
        .drag(&DragTarget { arclength: length, position: target }, &options, &surroundings, &mut PoseScratch::default())
        .unwrap();
    assert!(found.distance < 1e-6, "{}", found.distance);
    for (element, (before, after)) in shape.curvatures.iter().zip(&dragged.curvatures).enumerate() {
        assert_eq!(before[0].to_bits(), after[0].to_bits(), "twist of {element}");
        for axis in 1..3 {
            assert_eq!(before[axis].to_bits() == after[axis].to_bits(), !movable[element], "{element} {axis}");
        }
    }
    // Beyond the dragged point nothing has a reason to change.
    let mut middle = shape.clone();
    let at: f64 = shape.element_lengths[..5].iter().sum();
    drag(&mut middle, at, shape.frame_at(at).origin + Vector3::new(0.0, 0.0, 0.02), &PoseOptions::default());
    assert_eq!(middle.curvatures[5..], shape.curvatures[5..]);
    assert_ne!(middle.curvatures[..5], shape.curvatures[..5]);
}

#[test]
fn the_tips_direction_stays_where_asked_for() {
    let mut noise = Noise(5);
    let mut turned = 0.0_f64;
    for _ in 0..10 {
        let shape = noise.strand(8, 0.2);
        let length = shape.length();
        let before = shape.frame_at(length);
        let way = 0.15 * length * noise.vector();
        // Towards the root a little, so that it is in reach.
        let target = before.origin + way + 0.2 * (shape.root.origin - before.origin);
        let (mut free, mut kept) = (shape.clone(), shape.clone());
        drag(&mut free, length, target, &PoseOptions::default());
        let options = PoseOptions { keep_tip_direction: true, ..PoseOptions::default() };
        let found = drag(&mut kept, length, target, &options);
        let angle = |shape: &StrandShape| {
            let (now, then) = (shape.frame_at(length).rotation * Vector3::x(), before.rotation * Vector3::x());
            now.cross(&then).norm().atan2(now.dot(&then))
        };
        assert!(found.distance < 1e-6 && angle(&kept) < 1e-6, "{:e} m, {:e} rad", found.distance, angle(&kept));
        turned = turned.max(angle(&free));
    }
    assert!(turned > 0.1, "without it tips turn: {turned}");
}

/// The shape to stay near decides which of the many is taken: with the natural one a strand bent by hand springs back when its tip is put
/// where it naturally is.
#[test]
fn natural_pull_brings_the_natural_shape_back() {
    let mut noise = Noise(6);
    let natural = noise.strand(8, 0.3);
    let length = natural.length();
    let mut bent = natural.clone();
    for (row, element) in bent.curvatures.iter_mut().zip(&natural.element_lengths) {
        row[1] += 0.3 * noise.next() / element;
        row[2] += 0.3 * noise.next() / element;
    }
    let far = |shape: &StrandShape| {
        let pairs = shape.curvatures.iter().flatten().zip(natural.curvatures.iter().flatten());
        pairs.map(|(a, b)| (a - b) * length / 8.0).fold(0.0_f64, |most, off| most.max(off.abs()))
    };
    let target = DragTarget { arclength: length, position: natural.frame_at(length).origin };
    for (natural_pull, least, most) in [(0.0, 0.05, 0.4), (1.0, 0.0, 0.01)] {
        let mut shape = bent.clone();
        let surroundings = Surroundings { natural: Some(&natural.curvatures), ..Surroundings::default() };
        let options = PoseOptions { natural_pull, ..PoseOptions::default() };
        let found = shape.drag(&target, &options, &surroundings, &mut PoseScratch::default()).unwrap();
        println!("pull {natural_pull}: {:.2e} rad from natural, before {:.2e}", far(&shape), far(&bent));
        assert!(found.distance < 1e-6 && (least..=most).contains(&far(&shape)), "{natural_pull}: {}", far(&shape));
    }
}

fn depth(shape: &StrandShape, centre: Vector3<f64>, radius: f64) -> f64 {
    let length = shape.length();
    let at = |k: u32| (shape.frame_at(length * f64::from(k) / 4000.0).origin - centre).norm();
    radius - (0..=4000).map(at).fold(f64::INFINITY, f64::min)
}

/// A sphere between the strand and where its tip is dragged to; the strand has to go round it. Depth is looked for at 4,001 places.
#[test]
fn strands_are_kept_out_of_a_sphere() {
    let (centre, radius) = (Vector3::new(0.12, 0.0, -0.06), 0.05);
    let sphere = Shape::new_sphere(radius).unwrap();
    let pose = Frame { origin: centre, ..Frame::default() };
    let bodies = [BodyAt::new(0, &sphere, pose, pose, 1e-4)];
    let surroundings = Surroundings { bodies: &bodies, radius: 5e-5, ..Surroundings::default() };
    let options = PoseOptions { clearance: 1e-3, ..PoseOptions::default() };
    let outside = radius + 1e-4 + 5e-5 + 1e-3;
    let mut hit = 0;
    for target in [
        Vector3::new(0.16, 0.0, -0.1),
        Vector3::new(0.15, 0.05, -0.08),
        // In the sphere, and in its middle but for a little.
        Vector3::new(0.14, 0.01, -0.03),
        Vector3::new(0.121, 0.0, -0.06),
    ] {
        let mut scratch = PoseScratch::default();
        let drag = DragTarget { arclength: 0.25, position: target };
        let mut through = straight(0.25, 12);
        let blind = PoseOptions { keep_out: false, ..options.clone() };
        through.drag(&drag, &blind, &surroundings, &mut scratch).unwrap();
        hit += usize::from(depth(&through, centre, outside) > 1e-3);
        let mut shape = straight(0.25, 12);
        let found = shape.drag(&drag, &options, &surroundings, &mut scratch).unwrap();
        let deep = depth(&shape, centre, outside);
        println!(
            "{target:?}: {deep:.1e} m deep (without: {:.1e}), {:.1e} m off, {} iterations",
            depth(&through, centre, outside),
            found.distance,
            found.iterations
        );
        // What lies between the touches found is no deeper than two micrometres.
        assert!(deep < 3e-6, "{deep:e}");
        assert!(found.depth < 1e-8);
        let in_it = (target - centre).norm() < outside;
        let expected = if in_it { outside - (target - centre).norm() } else { 0.0 };
        let left = (shape.frame_at(0.25).origin - target).norm();
        assert!((left - expected).abs() < 1e-4, "{left} {expected}");
    }
    assert!(hit >= 2, "{hit}");
}

#[test]
fn a_brush_moves_what_lies_in_it_and_nothing_else() {
    let mut noise = Noise(8);
    let (mut touched, mut full, mut followed) = (0, 0, 0.0_f64);
    for trial in 0..80 {
        let shape = noise.strand(10, 0.2);
        let length = shape.length();
        let tip = shape.frame_at(length);
        let centre = tip.origin + if trial % 4 == 0 { 0.005 } else { 0.03 } * noise.vector();
        let brush = Brush { centre, radius: 0.02, falloff: f64::from(trial % 4), movement: 0.01 * noise.vector() };
        let inside = |shape: &StrandShape, radius: f64| {
            (0..=500).any(|k| (shape.frame_at(length * f64::from(k) / 500.0).origin - centre).norm() < radius)
        };
        let mut brushed = shape.clone();
        let found =
            brushed.brush(&brush, &PoseOptions::default(), &Surroundings::default(), &mut PoseScratch::default()).unwrap();
        if found.touched {
            assert!(inside(&shape, brush.radius));
            assert_ne!(shape, brushed);
            touched += 1;
        } else {
            assert_eq!(shape, brushed);
            // Its points are a quarter of the radius apart at most.
            assert!(!inside(&shape, 0.9 * brush.radius));
        }
        assert_eq!((shape.root, &shape.element_lengths), (brushed.root, &brushed.element_lengths));
        if brush.falloff == 0.0 && (tip.origin - centre).norm() < 0.5 * brush.radius {
            // Across the strand a tip can follow; along it a strand does not stretch.
            let way = brushed.frame_at(length).origin - tip.origin;
            let tangent = tip.rotation * Vector3::x();
            let across = brush.movement - tangent * tangent.dot(&brush.movement);
            if across.norm() > 0.9 * brush.movement.norm() {
                followed = followed.max((way.dot(&across) / across.norm_squared() - 1.0).abs());
                full += 1;
            }
        }
    }
    println!("{touched} of 80 touched, {full} wholly, off by {followed:.2}");
    assert!((15..=70).contains(&touched) && full > 5, "{touched} {full}");
    // As near as bending lets it come.
    assert!(followed < 0.15, "{followed}");
}

#[test]
fn one_element_is_bent_twisted_and_lengthened() {
    let mut noise = Noise(9);
    let before = noise.strand(6, 0.3);
    let end = |shape: &StrandShape, element: usize| shape.frame_at(shape.element_lengths[..element].iter().sum());
    let relative =
        |shape: &StrandShape, element: usize| end(shape, element).rotation.inverse() * end(shape, element + 1).rotation;
    let mut shape = straight(0.3, 6);
    shape.change_element(2, &ElementChange { bend: [0.0, 0.5], ..ElementChange::default() }).unwrap();
    assert!(relative(&shape, 2).angle_to(&UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5)) < 1e-7);
    shape.change_element(3, &ElementChange { twist: -0.4, ..ElementChange::default() }).unwrap();
    assert!(relative(&shape, 3).angle_to(&UnitQuaternion::from_axis_angle(&Vector3::x_axis(), -0.4)) < 1e-7);
    for (keep_curvature, turned) in [(true, 2.0), (false, 1.0)] {
        let mut shape = before.clone();
        shape.change_element(4, &ElementChange { stretch: 2.0, keep_curvature, ..ElementChange::default() }).unwrap();
        assert_eq!(shape.element_lengths[4], 2.0 * before.element_lengths[4]);
        let angle = |shape: &StrandShape| Vector3::from(shape.curvatures[4]).norm() * shape.element_lengths[4];
        assert!((angle(&shape) / angle(&before) - turned).abs() < 1e-14);
        assert_eq!((&shape.curvatures[..4], shape.curvatures[5]), (&before.curvatures[..4], before.curvatures[5]));
        // What lies beyond goes along rigidly.
        let beyond = |shape: &StrandShape| end(shape, 5).rotation.inverse() * (end(shape, 6).origin - end(shape, 5).origin);
        assert!((beyond(&shape) - beyond(&before)).norm() < 1e-15);
    }
}

#[test]
fn cuts_keep_the_shape_and_growth_goes_on() {
    let mut noise = Noise(10);
    for elements in [1, 4, 9] {
        let shape = noise.strand(elements, 2.0);
        for share in [0.05, 0.31, 0.5, 0.99, 1.0] {
            let arclength = share * shape.length();
            let mut cut = shape.clone();
            assert_eq!(cut.cut(arclength).unwrap(), cut.curvatures.len());
            assert!((cut.length() - arclength).abs() < 1e-15);
            assert_eq!(cut.root, shape.root);
            for k in 0..=40 {
                let s = arclength * f64::from(k) / 40.0;
                let (a, b) = (shape.frame_at(s), cut.frame_at(s));
                assert!((a.origin - b.origin).norm() < 1e-12 && a.rotation.angle_to(&b.rotation) < 1e-7);
            }
            if share == 1.0 {
                assert_eq!(cut, shape);
            }
            // The cut part grows again from the cut element, if that was the last one.
            if cut.curvatures.len() == elements {
                cut.grow(&Growth { length: shape.length() - arclength + 0.01, elements: 0, curvatures: None }).unwrap();
                assert!((cut.frame_at(shape.length()).origin - shape.frame_at(shape.length()).origin).norm() < 1e-12);
            }
        }
        // At a node no sliver is left.
        let node: f64 = shape.element_lengths[..elements.div_ceil(2)].iter().sum();
        let mut cut = shape.clone();
        assert_eq!(cut.cut(node).unwrap(), elements.div_ceil(2));
        let mut grown = shape.clone();
        grown.grow(&Growth { length: 0.06, elements: 3, curvatures: Some([1.0, 2.0, 3.0]) }).unwrap();
        assert_eq!(grown.curvatures[elements..], [[1.0, 2.0, 3.0]; 3]);
        assert_eq!(grown.element_lengths[elements..], [0.02; 3]);
        let mut longer = shape.clone();
        longer.grow(&Growth { length: 0.06, elements: 2, curvatures: None }).unwrap();
        assert_eq!(longer.curvatures[elements..], [shape.curvatures[elements - 1]; 2]);
    }
}

#[test]
fn mirrored_strands_wind_the_other_way_and_twice_mirrored_ones_as_before() {
    let mut noise = Noise(11);
    let (point, normal) = (noise.vector(), 3.0 * noise.vector());
    let plane = Plane::new(point, normal).unwrap();
    let n = normal.normalize();
    let reflect = |v: Vector3<f64>| v - 2.0 * n * n.dot(&v);
    for elements in [1, 5] {
        let shape = noise.strand(elements, 1.0);
        let image = shape.mirrored(&plane).unwrap();
        for k in 0..=20 {
            let s = shape.length() * f64::from(k) / 20.0;
            let (a, b) = (shape.frame_at(s), image.frame_at(s));
            assert!((b.origin - point - reflect(a.origin - point)).norm() < 1e-14);
            let axis = |frame: &Frame, k: usize| frame.rotation * Vector3::ith(k, 1.0);
            for (k, sign) in [(0, 1.0), (1, 1.0), (2, -1.0)] {
                assert!((axis(&b, k) - sign * reflect(axis(&a, k))).norm() < 1e-14, "n{k}");
            }
        }
        // The sign of the torsion, which is that of the twist for an element's helix.
        assert!(shape.curvatures.iter().zip(&image.curvatures).all(|(a, b)| a[0] == -b[0] && a[0] != 0.0));
        let back = image.mirrored(&plane).unwrap();
        assert_eq!((&back.curvatures, &back.element_lengths), (&shape.curvatures, &shape.element_lengths));
        assert!((back.root.origin - shape.root.origin).norm() < 1e-15);
        assert!((back.root.rotation.coords - shape.root.rotation.coords).norm() < 1e-15);
    }
    let flat = straight(0.1, 2);
    assert_eq!(flat.mirrored(&plane).unwrap().curvatures, flat.curvatures);
}

#[test]
fn bad_input_is_named_and_changes_nothing() {
    let good = straight(0.2, 4);
    let scratch = &mut PoseScratch::default();
    let options = PoseOptions::default();
    let (nothing, tip) = (Surroundings::default(), Vector3::new(0.1, 0.1, 0.0));
    let target = DragTarget { arclength: 0.2, position: tip };
    let brush = Brush { centre: Vector3::zeros(), radius: 0.1, falloff: 1.0, movement: tip };
    let mut shape = good.clone();
    let named = |name: &str, result: Result<(), Error>| match result {
        Err(Error::InvalidArgument { argument, .. }) => assert_eq!(argument, name),
        other => panic!("{name}: {other:?}"),
    };
    for arclength in [0.0, -1.0, 0.21, f64::NAN] {
        named("target.arclength", shape.drag(&DragTarget { arclength, ..target }, &options, &nothing, scratch).map(drop));
        named("arclength", shape.cut(arclength).map(drop));
    }
    let far = DragTarget { position: Vector3::new(0.0, f64::INFINITY, 0.0), ..target };
    named("target.position[1]", shape.drag(&far, &options, &nothing, scratch).map(drop));
    for natural_pull in [-0.1, 1.1, f64::NAN] {
        let options = PoseOptions { natural_pull, ..options.clone() };
        named("options.natural_pull", shape.drag(&target, &options, &nothing, scratch).map(drop));
        named("options.natural_pull", shape.brush(&brush, &options, &nothing, scratch).map(drop));
    }
    let few = PoseOptions { movable: Some(vec![true; 3]), ..options.clone() };
    named("options.movable (count)", shape.drag(&target, &few, &nothing, scratch).map(drop));
    let near = PoseOptions { clearance: -1.0, ..options.clone() };
    named("options.clearance", shape.drag(&target, &near, &nothing, scratch).map(drop));
    named("surroundings.radius", shape.drag(&target, &options, &Surroundings { radius: -1.0, ..nothing }, scratch).map(drop));
    let rows = [[0.0; 3]; 3];
    let other = Surroundings { natural: Some(&rows), ..nothing };
    named("surroundings.natural (count)", shape.drag(&target, &options, &other, scratch).map(drop));
    let limp = Surroundings { charge: [1.0, 0.0, 1.0], ..nothing };
    named("surroundings.charge[1]", shape.drag(&target, &options, &limp, scratch).map(drop));
    named("brush.radius", shape.brush(&Brush { radius: 0.0, ..brush }, &options, &nothing, scratch).map(drop));
    named("brush.falloff", shape.brush(&Brush { falloff: f64::NAN, ..brush }, &options, &nothing, scratch).map(drop));
    let lost = Brush { centre: Vector3::new(f64::NAN, 0.0, 0.0), ..brush };
    named("brush.centre[0]", shape.brush(&lost, &options, &nothing, scratch).map(drop));
    named("element", shape.change_element(4, &ElementChange::default()));
    named("change.stretch", shape.change_element(0, &ElementChange { stretch: 0.0, ..ElementChange::default() }));
    named("change.bend[1]", shape.change_element(0, &ElementChange { bend: [0.0, f64::NAN], ..ElementChange::default() }));
    named(
        "change",
        shape
            .change_element(0, &ElementChange { stretch: 1e-310, ..ElementChange::default() })
            .and(shape.clone().change_element(0, &ElementChange { twist: 1e308, stretch: 1e-3, ..ElementChange::default() })),
    );
    shape = good.clone();
    named("growth.length", shape.grow(&Growth { length: 0.0, elements: 1, curvatures: None }));
    named("growth.elements", shape.grow(&Growth { length: 0.1, elements: 100_000, curvatures: None }));
    named("growth.curvatures", shape.grow(&Growth { length: 0.1, elements: 0, curvatures: Some([0.0; 3]) }));
    named("growth.curvatures[2]", shape.grow(&Growth { length: 0.1, elements: 1, curvatures: Some([0.0, 0.0, f64::NAN]) }));
    named("normal", Plane::new(tip, Vector3::zeros()).map(drop));
    named("point[0]", Plane::new(Vector3::new(f64::NAN, 0.0, 0.0), tip).map(drop));
    assert_eq!(shape, good);
    shape.curvatures[2][1] = f64::NAN;
    named("shape.curvatures[2][1]", shape.drag(&target, &options, &nothing, scratch).map(drop));
}
