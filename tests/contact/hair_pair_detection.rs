//! Hair against hair: every contact is detected once, exactly. Against dense sampling of the centrelines, and against a fresh search.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use nalgebra::{Rotation3, Vector3};
use superhelix::editing::PermittedOverlap;
use superhelix::internals::contact::broad_phase::hair_pairs::{HairPairs, HeldRoots, PairOptions};
use superhelix::internals::contact::broad_phase::pieces::Wisp;
use superhelix::internals::contact::contact_point::{ContactPoint, Partner, StrandCurve, StrandPath, StrandPoint};
use superhelix::internals::contact::narrow_phase::strand_contacts::PairScratch;
use superhelix::internals::math::quadrature::Rule;
use superhelix::internals::math::vector::Mat3;
use superhelix::internals::rod::kinematics::Kinematics;

/// Counts what each thread asks for.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: hands everything on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's layout.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's pointer and layout.
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's pointer, layout and size.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// Random numbers in 0..1 (PCG's multiplier).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn centred(&mut self) -> f64 {
        2.0 * self.next() - 1.0
    }
    fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.centred(), self.centred(), self.centred())
    }
}

#[derive(Clone)]
struct Strand {
    origin: Vector3<f64>,
    root: Rotation3<f64>,
    lengths: Vec<f64>,
    curvatures: Vec<[f64; 3]>,
}

impl Strand {
    fn straight(from: Vector3<f64>, along: Vector3<f64>, elements: usize) -> Self {
        let root = Rotation3::rotation_between(&Vector3::x(), &along).expect("not opposite to x");
        let length = along.norm() / elements as f64;
        Self { origin: from, root, lengths: vec![length; elements], curvatures: vec![[0.0; 3]; elements] }
    }

    /// Elements of up to 25 mm that turn by up to `turn` rad.
    fn random(random: &mut Random, elements: usize, turn: f64, room: f64) -> Self {
        let lengths: Vec<f64> = (0..elements).map(|_| 0.005 + 0.02 * random.next()).collect();
        let row = |random: &mut Random, length: f64| {
            let way = random.vector().normalize() * (turn * random.next() / length);
            [way.x, way.y, way.z]
        };
        let curvatures = lengths.iter().map(|length| row(random, *length)).collect();
        let root = Rotation3::new(random.vector() * 3.0);
        Self { origin: random.vector() * room, root, lengths, curvatures }
    }

    fn pose(&self) -> Kinematics<f64> {
        let mut kinematics = Kinematics::default();
        kinematics.update(&Mat3::from(self.root.into_inner()), &self.lengths, &self.curvatures, &Rule::gauss_legendre(1));
        kinematics
    }

    fn curve<'a>(&self, pose: &'a Kinematics<f64>) -> StrandCurve<'a> {
        StrandCurve { origin: self.origin, elements: &pose.elements }
    }

    fn along(&self, place: &StrandPoint) -> f64 {
        self.lengths[..place.element as usize].iter().sum::<f64>() + place.s
    }
}

/// All contacts of strands moving from `then` to `now`.
fn contacts_between(pairs: &mut HairPairs, then: &[Strand], now: &[Strand]) -> (bool, Vec<ContactPoint>) {
    pairs.begin_step();
    contacts_at_iterate(pairs, then, now)
}

/// The same at an iterate of a step that has begun.
fn contacts_at_iterate(pairs: &mut HairPairs, then: &[Strand], now: &[Strand]) -> (bool, Vec<ContactPoint>) {
    contacts_with_overlap(pairs, then, now, None)
}

/// The same if every strand may overlap others.
fn contacts_with_overlap(
    pairs: &mut HairPairs,
    then: &[Strand],
    now: &[Strand],
    permitted_overlap: Option<&PermittedOverlap>,
) -> (bool, Vec<ContactPoint>) {
    let poses: Vec<[Kinematics<f64>; 2]> = then.iter().zip(now).map(|(a, b)| [a.pose(), b.pose()]).collect();
    let paths: Vec<StrandPath> = (0..now.len())
        .map(|k| StrandPath {
            index: k as u32,
            start: then[k].curve(&poses[k][0]),
            now: now[k].curve(&poses[k][1]),
            permitted_overlap,
        })
        .collect();
    let searched = pairs.update(&paths).unwrap();
    let (mut out, mut scratch) = (Vec::new(), PairScratch::default());
    for group in pairs.groups() {
        pairs.contacts(group, &paths, f64::INFINITY, &mut scratch, &mut out);
    }
    (searched, out)
}

fn options(activation: f64, margin: f64) -> PairOptions {
    PairOptions { activation, margin, held_roots: HeldRoots::Ignored }
}

fn contacts_at(strands: &[Strand], wisps: &[Wisp], options: &PairOptions) -> Vec<ContactPoint> {
    let mut pairs = HairPairs::default();
    pairs.set(wisps, options).unwrap();
    contacts_between(&mut pairs, strands, strands).1
}

fn wisps(count: usize, radius: f64) -> Vec<Wisp> {
    vec![Wisp { radius, ..Wisp::default() }; count]
}

fn partner(contact: &ContactPoint) -> StrandPoint {
    match contact.partner {
        Partner::Strand(place) => place,
        Partner::Body { .. } => panic!("no bodies here"),
    }
}

/// Points on a strand, with their arclengths.
fn sampled(strand: &Strand, spacing: f64) -> Vec<(f64, Vector3<f64>)> {
    let pose = strand.pose();
    let curve = strand.curve(&pose);
    let (mut out, mut along) = (Vec::new(), 0.0);
    for (index, length) in strand.lengths.iter().enumerate() {
        let count = (length / spacing).ceil() as usize;
        let last = if index + 1 == strand.lengths.len() { count + 1 } else { count };
        for k in 0..last {
            let s = length * k as f64 / count as f64;
            out.push((along + s, curve.position(index, s)));
        }
        along += length;
    }
    out
}

/// From a minimum of samples down to one of the distance: the partner's nearest point by ternary search, this strand's by trial.
fn descended(strands: &[Strand], s: f64, u: f64, spacing: f64) -> (f64, f64, f64) {
    let poses = [strands[0].pose(), strands[1].pose()];
    let length = |k: usize| strands[k].lengths.iter().sum::<f64>();
    let point = |k: usize, along: f64| {
        let (mut element, mut rest) = (0, along.clamp(0.0, length(k)));
        while element + 1 < strands[k].lengths.len() && rest > strands[k].lengths[element] {
            rest -= strands[k].lengths[element];
            element += 1;
        }
        strands[k].curve(&poses[k]).position(element, rest)
    };
    let opposite = |s: f64, u: f64| {
        let at = point(0, s);
        let (mut low, mut high) = ((u - 3.0 * spacing).max(0.0), (u + 3.0 * spacing).min(length(1)));
        for _ in 0..45 {
            let (p, q) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if (point(1, p) - at).norm() < (point(1, q) - at).norm() { high = q } else { low = p }
        }
        (s, 0.5 * (low + high), (point(1, 0.5 * (low + high)) - at).norm())
    };
    let (mut best, mut step) = (opposite(s, u), spacing);
    while step > 1e-7 {
        let tried = [-step, step].map(|off| opposite((best.0 + off).clamp(0.0, length(0)), best.1));
        match tried.into_iter().find(|other| other.2 < best.2) {
            Some(other) => best = other,
            None => step *= 0.5,
        }
    }
    best
}

#[test]
fn every_local_minimum_between_sampled_strands_is_an_exact_contact() {
    let mut random = Random(1);
    let spacing = 1e-4;
    let (radius, activation) = (0.4e-3, 1e-3);
    let (mut minima, mut touching) = (0, 0);
    for round in 0..240 {
        let turn = [0.0, 0.5, 3.0, 10.0][round % 4];
        let mut strands: Vec<Strand> = (0..2).map(|_| Strand::random(&mut random, 1 + round % 3, turn, 0.005)).collect();
        // Some point of one comes within 3 mm of some point of the other.
        let some = [0, 1].map(|k| {
            let points = sampled(&strands[k], 1e-3);
            points[(random.next() * points.len() as f64) as usize].1
        });
        strands[1].origin += some[0] - some[1] + random.vector() * 1.7e-3;
        let contacts = contacts_at(&strands, &wisps(2, radius), &options(activation, 0.0));
        let samples = [sampled(&strands[0], spacing), sampled(&strands[1], spacing)];
        let columns = samples[1].len();
        let distances: Vec<f64> =
            samples[0].iter().flat_map(|(_, p)| samples[1].iter().map(move |(_, q)| (p - q).norm())).collect();
        let mut least = f64::INFINITY;
        for (i, row) in distances.chunks(columns).enumerate() {
            for (j, distance) in row.iter().enumerate() {
                least = least.min(*distance);
                // A minimum of the samples, ends of the strands included, clear of rounding and of the sampling: what is flat is not asked.
                let (rows, columns) = (samples[0].len() as isize, columns as isize);
                let at = |di: isize, dj: isize| {
                    let (i, j) = (i as isize + di, j as isize + dj);
                    ((0..rows).contains(&i) && (0..columns).contains(&j)).then(|| distances[(i * columns + j) as usize])
                };
                let is_least = (-2..=2).all(|di| (-2..=2).all(|dj| at(di, dj).is_none_or(|other| other >= *distance)));
                if is_least && distance - 2.0 * radius < activation - 1e-6 {
                    minima += 1;
                    let (s, u, distance) = descended(&strands, samples[0][i].0, samples[1][j].0, spacing);
                    let near = contacts.iter().any(|contact| {
                        let (off_a, off_b) = (strands[0].along(&contact.point) - s, strands[1].along(&partner(contact)) - u);
                        off_a.abs().max(off_b.abs()) < 0.5 * radius + 1e-5 && contact.gap + 2.0 * radius <= distance + 1e-12
                    });
                    assert!(near, "round {round}: nothing at {s}, {u}, {distance} apart; found {contacts:?}");
                }
            }
        }
        let found = contacts.iter().map(|contact| contact.gap + 2.0 * radius).fold(f64::INFINITY, f64::min);
        if least < activation + 2.0 * radius {
            touching += 1;
            // Samples half a spacing off either way are at most their spacing too far apart.
            assert!(found <= least + 1e-12 && found > least - spacing, "round {round}: {found} for {least}");
        } else if least > activation + 2.0 * radius + spacing {
            assert!(contacts.is_empty(), "round {round}");
        }
        let poses = [strands[0].pose(), strands[1].pose()];
        for contact in &contacts {
            let other = partner(contact);
            let curves = [strands[0].curve(&poses[0]), strands[1].curve(&poses[1])];
            let apart = curves[0].position(contact.point.element as usize, contact.point.s)
                - curves[1].position(other.element as usize, other.s);
            assert!((contact.normal.norm() - 1.0).abs() < 1e-12);
            assert!((contact.normal.dot(&apart) - 2.0 * radius - contact.gap).abs() < 1e-12);
            assert!((apart.norm() - 2.0 * radius - contact.gap).abs() < 1e-12 && contact.gap <= activation);
        }
    }
    // (Three thousand rounds, run once: 3248 places, none missed.)
    println!("{touching} pairs of strands touch, at {minima} places");
    assert!(touching >= 200 && minima >= 240);
}

/// Strands beside each other whose elements are bowed by more than they are apart: each meets its neighbours only, found by chords of the
/// elements, and goes on meeting them when the bows turn, whose ends stay where they were.
#[test]
fn bowed_strands_beside_each_other_are_held_against_their_neighbours_only() {
    let (count, spacing, length) = (24, 1.5e-3, 0.06);
    // 0.48 rad of an element are one piece, 3.6 mm off its chord.
    let bowed = |k: usize, turn: f64| Strand {
        origin: Vector3::new(0.0, 0.0, spacing * k as f64),
        root: Rotation3::from_axis_angle(&Vector3::x_axis(), turn),
        lengths: vec![length; 3],
        curvatures: vec![[0.0, 8.0, 0.0], [0.0, -8.0, 0.0], [0.0, 8.0, 0.0]],
    };
    let all = |turn: &dyn Fn(usize) -> f64| (0..count).map(|k| bowed(k, turn(k))).collect::<Vec<_>>();
    let pairs_of = |radius: f64| {
        let mut pairs = HairPairs::default();
        pairs.set(&wisps(count, radius), &options(0.1 * radius, 0.1 * radius)).unwrap();
        pairs
    };
    let still = all(&|_| 0.0);
    let mut pairs = pairs_of(0.8e-3);
    let (_, contacts) = contacts_between(&mut pairs, &still, &still);
    assert!(contacts.len() >= 2 * (count - 1), "{} contacts", contacts.len());
    assert!(pairs.groups().iter().all(|group| group.b == group.a + 1), "{:?}", pairs.groups());
    assert_eq!(pairs.groups().len(), count - 1);
    // The ends of every third strand's first element stay, and its bow goes from one side to the other, through its neighbours.
    let turned = all(&|k| if k % 3 == 1 { 3.0 } else { 0.0 });
    let (searched, contacts) = contacts_at_iterate(&mut pairs, &still, &turned);
    assert!(searched, "its bow has gone further than its candidates allow");
    let mut fresh = pairs_of(0.8e-3);
    let (_, expected) = contacts_between(&mut fresh, &still, &turned);
    assert_same(&turned, &contacts, &expected, 0);
    assert!(contacts.len() > count);
}

#[test]
fn contacts_do_not_depend_on_which_strand_is_first() {
    let mut random = Random(2);
    let strands: Vec<Strand> = (0..30).map(|_| Strand::random(&mut random, 4, 1.5, 0.008)).collect();
    let radii: Vec<Wisp> = (0..30).map(|k| Wisp { radius: 1e-3 + 1e-5 * f64::from(k), ..Wisp::default() }).collect();
    let there = contacts_at(&strands, &radii, &options(0.5e-3, 0.0));
    let reversed: Vec<Strand> = strands.iter().rev().cloned().collect();
    let back: Vec<Wisp> = radii.iter().rev().copied().collect();
    let back = contacts_at(&reversed, &back, &options(0.5e-3, 0.0));
    assert!(there.len() > 50 && there.len() == back.len(), "{} and {}", there.len(), back.len());
    // In order.
    let key = |contact: &ContactPoint| {
        let other = partner(contact);
        (contact.point.strand, other.strand, contact.point.element, contact.point.s)
    };
    assert!(there.windows(2).all(|two| key(&two[0]) <= key(&two[1])));
    for contact in &there {
        assert!(contact.point.strand < partner(contact).strand);
        let near = |a: &StrandPoint, b: &StrandPoint, strands: &[Strand], others: &[Strand]| {
            a.strand == 29 - b.strand && (strands[a.strand as usize].along(a) - others[b.strand as usize].along(b)).abs() < 1e-9
        };
        let same = back.iter().filter(|other| {
            near(&contact.point, &partner(other), &strands, &reversed)
                && near(&partner(contact), &other.point, &strands, &reversed)
                && (contact.normal + other.normal).norm() < 1e-7
                && (contact.gap - other.gap).abs() < 1e-12
        });
        assert_eq!(same.count(), 1, "{contact:?}");
    }
}

#[test]
fn parallel_strands_have_contacts_at_the_ends_of_their_common_length() {
    // Elements end at 0, 25, 50, 75 and 100 mm, and the partner's at 30, 70 and 110 mm: they share 30 to 100 mm.
    for tilt in [0.0, 1e-9, 1e-3] {
        let a = Strand::straight(Vector3::zeros(), Vector3::new(0.1, 0.0, 0.0), 4);
        let b = Strand::straight(Vector3::new(0.03, 0.0, 1.9e-3), Vector3::new(0.08, 0.08 * tilt, 0.0), 2);
        let strands = [a, b];
        let contacts = contacts_at(&strands, &wisps(2, 1e-3), &options(1e-3, 1e-3));
        let places: Vec<f64> = contacts.iter().map(|contact| (1e6 * strands[0].along(&contact.point)).round() / 1e6).collect();
        for end in [0.03, 0.05, 0.07, 0.075, 0.1] {
            assert!(places.contains(&end), "tilt {tilt}: {places:?}");
        }
        assert!(places.len() <= 7, "{places:?}");
        for contact in &contacts {
            assert!((contact.gap + 0.1e-3).abs() < 2e-6 && (contact.normal + Vector3::z()).norm() < 0.05, "{contact:?}");
        }
    }
}

#[test]
fn the_contacts_found_stay_complete_while_strands_move() {
    let mut random = Random(3);
    let mut strands: Vec<Strand> = (0..60).map(|_| Strand::random(&mut random, 4, 1.5, 0.05)).collect();
    let kept_options = options(0.5e-3, 1e-3);
    let mut kept = HairPairs::default();
    kept.set(&wisps(60, 1e-3), &kept_options).unwrap();
    let (mut total, mut searches) = (0, 0);
    let steps = 60;
    for step in 0..steps {
        let before = strands.clone();
        // All turn with a head, quickly, and each wanders a little.
        let head = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.1);
        for strand in &mut strands {
            strand.origin = head * strand.origin + random.vector() * 1e-4;
            strand.root = Rotation3::new(random.vector() * 2e-3) * head * strand.root;
            for row in &mut strand.curvatures {
                *row = row.map(|k| k + 0.1 * random.centred());
            }
        }
        let (searched, contacts) = contacts_between(&mut kept, &before, &strands);
        searches += usize::from(searched);
        let mut fresh = HairPairs::default();
        fresh.set(&wisps(60, 1e-3), &options(0.5e-3, 0.0)).unwrap();
        let (_, expected) = contacts_between(&mut fresh, &before, &strands);
        assert_same(&strands, &contacts, &expected, step);
        total += contacts.len();
    }
    println!("{total} contacts in {steps} steps, {searches} searches");
    assert!(total > 15 * steps && (4..steps / 2).contains(&searches));
}

fn assert_same(strands: &[Strand], contacts: &[ContactPoint], expected: &[ContactPoint], step: usize) {
    assert_eq!(contacts.len(), expected.len(), "step {step}");
    for (contact, other) in contacts.iter().zip(expected) {
        let (p, q) = (partner(contact), partner(other));
        assert_eq!((contact.point.strand, p.strand), (other.point.strand, q.strand));
        let of = |place: &StrandPoint| strands[place.strand as usize].along(place);
        let off = (of(&contact.point) - of(&other.point)).abs().max((of(&p) - of(&q)).abs());
        assert!(off < 1e-8 && (contact.gap - other.gap).abs() < 1e-12 && (contact.normal - other.normal).norm() < 1e-6);
    }
}

/// Within a step only the strands that have left their room are searched for again.
#[test]
fn the_contacts_found_stay_complete_if_few_strands_move_far_within_a_step() {
    let mut random = Random(5);
    let before: Vec<Strand> = (0..60).map(|_| Strand::random(&mut random, 4, 1.5, 0.04)).collect();
    let mut strands = before.clone();
    let mut kept = HairPairs::default();
    kept.set(&wisps(60, 1e-3), &options(0.5e-3, 1e-3)).unwrap();
    kept.begin_step();
    let (mut total, mut searches) = (0, 0);
    let iterates = 30;
    for iterate in 0..iterates {
        for (k, strand) in strands.iter_mut().enumerate() {
            // A few strands go five millimetres, others a tenth of one.
            let far = (k + iterate).is_multiple_of(9);
            strand.origin += random.vector() * if far { 5e-3 } else { 1e-4 };
        }
        let (searched, contacts) = contacts_at_iterate(&mut kept, &before, &strands);
        searches += usize::from(searched);
        let mut fresh = HairPairs::default();
        fresh.set(&wisps(60, 1e-3), &options(0.5e-3, 0.0)).unwrap();
        let (_, expected) = contacts_between(&mut fresh, &before, &strands);
        assert_same(&strands, &contacts, &expected, iterate);
        total += contacts.len();
    }
    println!("{total} contacts in {iterates} iterates, {searches} searches");
    assert!(total > 15 * iterates && searches == iterates);
}

/// Two straight strands, the second passing through the first from above by `down` (m).
fn crossing(from: f64, down: f64, angle: f64) -> (Vec<Strand>, Vec<Strand>) {
    let a = Strand::straight(Vector3::zeros(), Vector3::new(0.1, 0.0, 0.0), 5);
    let way = Vector3::new(angle.cos(), angle.sin(), 0.0);
    let b = |height: f64| Strand::straight(Vector3::new(0.047, 0.0, height) - way * 0.047, way * 0.1, 5);
    (vec![a.clone(), b(from)], vec![a, b(from - down)])
}

#[test]
fn strands_that_passed_through_each_other_keep_their_side() {
    for angle in [0.0, 0.05, 0.7, 1.5] {
        // A displacement of thirty radii in a step: 2 m/s in 1/60 s.
        let (then, now) = crossing(5e-3, 33e-3, angle);
        let mut pairs = HairPairs::default();
        pairs.set(&wisps(2, 1e-3), &options(0.5e-3, 0.0)).unwrap();
        let (_, contacts) = contacts_between(&mut pairs, &then, &now);
        assert!(!contacts.is_empty(), "angle {angle}");
        for contact in &contacts {
            // Pieces beside the crossing began 13 mm from it: 0.65 mm to the side, of 5 mm.
            let tilt = if angle == 0.05 { 0.131 } else { 0.0 };
            assert!(contact.normal.z < -1.0 + 0.51 * tilt * tilt + 1e-9, "angle {angle}: {contact:?}");
            assert!((contact.gap + 30e-3).abs() < 1e-6 + 0.02 * tilt * tilt, "angle {angle}: {contact:?}");
        }
        assert!(
            contacts.iter().any(|contact| contact.normal.z < -1.0 + 1e-12 && (contact.gap + 30e-3).abs() < 1e-9),
            "angle {angle}"
        );
        // A small step through: the second strand lies 1.5 mm above the first one's centreline and then 0.5 mm below it. Far from the
        // crossing strands at a small angle are beside each other, and have no side to keep.
        let (then, now) = crossing(1.5e-3, 2.0e-3, angle);
        let (_, contacts) = contacts_between(&mut pairs, &then, &now);
        let at_crossing = |contact: &&ContactPoint| angle == 0.0 || (now[0].along(&contact.point) - 0.047).abs() < 3e-3;
        assert!(contacts.iter().filter(at_crossing).count() >= 1);
        for contact in contacts.iter().filter(at_crossing) {
            assert!(contact.normal.z < -0.999_999 && (contact.gap + 2.5e-3).abs() < 1e-6, "angle {angle}: {contact:?}");
        }
        // Deep inside from the start: out along the shortest path.
        let (then, now) = crossing(0.2e-3, 0.4e-3, angle);
        let (_, contacts) = contacts_between(&mut pairs, &then, &now);
        assert!(contacts.iter().filter(at_crossing).count() >= 1);
        for contact in contacts.iter().filter(at_crossing) {
            assert!(contact.normal.z > 0.999_999 && (contact.gap + 1.8e-3).abs() < 1e-6, "angle {angle}: {contact:?}");
        }
    }
}

/// A straight strand that falls through one element that is bowed by nine radii, 1.5 mm above it and then 0.5 mm below it, at any place.
#[test]
fn a_strand_that_passed_through_a_bowed_one_keeps_its_side() {
    let radius = 0.4e-3;
    let bowed =
        Strand { origin: Vector3::zeros(), root: Rotation3::identity(), lengths: vec![0.06], curvatures: vec![[0.0, 0.0, 8.0]] };
    let (pose, mut pairs) = (bowed.pose(), HairPairs::default());
    for k in 1..30 {
        let along = 0.002 * f64::from(k);
        let at = bowed.curve(&pose).position(0, along);
        assert!(at.z.abs() < 1e-12);
        let across = |height: f64| {
            let way = Vector3::new(0.0, 0.03, 0.0);
            Strand::straight(at - way + Vector3::z() * height, 2.0 * way, 3)
        };
        let (then, now) = ([bowed.clone(), across(1.5e-3)], [bowed.clone(), across(-0.5e-3)]);
        pairs.set(&wisps(2, radius), &options(0.1 * radius, 0.0)).unwrap();
        let (_, contacts) = contacts_between(&mut pairs, &then, &now);
        let crossed = contacts.iter().find(|contact| (now[0].along(&contact.point) - along).abs() < 1e-6);
        let contact = crossed.unwrap_or_else(|| panic!("nothing at {along}: {contacts:?}"));
        assert!(contact.normal.z < -0.999_999 && (contact.gap + 0.5e-3 + 2.0 * radius).abs() < 1e-7, "{along}: {contact:?}");
    }
}

/// A strand wound round a straight one is on all sides of it within a centimetre. A place that is where it was is on its old side, wherever the strands
/// have crossed beside it.
#[test]
fn of_strands_wound_round_each_other_only_places_that_crossed_keep_their_side() {
    let mut random = Random(5);
    let (mut kept, mut stayed) = (0, 0);
    for _ in 0..2000 {
        // The axis is x; the wound strand begins at a radius from it.
        let (radius, pitch) = (1e-3 * (2.2 + 1.5 * random.next()), 0.01 + 0.02 * random.next());
        let step = pitch / std::f64::consts::TAU;
        let square = radius * radius + step * step;
        let (twist, bend) = (step / square, radius / square);
        let tilt = Rotation3::from_axis_angle(&Vector3::z_axis(), -bend.atan2(twist));
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::TAU * random.next());
        let coil = Strand {
            origin: turn * Vector3::new(0.0, 0.0, radius),
            root: turn * tilt,
            lengths: vec![2.4 * std::f64::consts::TAU * square.sqrt() / 8.0; 8],
            curvatures: vec![[twist, bend, 0.0]; 8],
        };
        let straight = Strand::straight(Vector3::new(-0.05, 0.0, 0.0), Vector3::new(0.15, 0.0, 0.0), 8);
        // (The roots keep their orientation: common rotations do not count.)
        let rebent = coil.curvatures.iter().map(|row| row.map(|k| k * (1.0 + 1.5 * random.centred()))).collect();
        let moved = Strand { origin: coil.origin + random.vector() * 8e-3, curvatures: rebent, ..coil.clone() };
        let (then, now) = (vec![straight.clone(), coil], vec![straight, moved]);
        let mut pairs = HairPairs::default();
        pairs.set(&wisps(2, 1e-3), &options(0.1e-3, 0.0)).unwrap();
        let (_, contacts) = contacts_between(&mut pairs, &then, &now);
        let poses = [&then, &now].map(|strands| [strands[0].pose(), strands[1].pose()]);
        for contact in &contacts {
            let other = partner(contact);
            let apart = |k: usize| {
                let strands = [&then, &now][k];
                strands[0].curve(&poses[k][0]).position(contact.point.element as usize, contact.point.s)
                    - strands[1].curve(&poses[k][1]).position(other.element as usize, other.s)
            };
            let (before, after) = (apart(0), apart(1));
            if contact.normal.dot(&after) > 0.0 {
                stayed += 1;
            } else {
                kept += 1;
                assert!(before.dot(&contact.normal) > 0.0 || before.dot(&after) < 0.0, "{contact:?}: from {before} to {after}");
            }
        }
    }
    assert!(kept > 10_000 && stayed > 200, "{kept} crossed, {stayed} did not");
}

#[test]
fn common_rotations_and_detours_are_not_crossings() {
    // Both turn by two radians about the first: normals turn with them.
    let (then, _) = crossing(1.95e-3, 0.0, 0.7);
    let mut now = then.clone();
    for strand in &mut now {
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), 2.0);
        (strand.origin, strand.root) = (turn * strand.origin, turn * strand.root);
    }
    let mut pairs = HairPairs::default();
    pairs.set(&wisps(2, 1e-3), &options(0.5e-3, 0.0)).unwrap();
    let (_, contacts) = contacts_between(&mut pairs, &then, &now);
    let normal = Rotation3::from_axis_angle(&Vector3::x_axis(), 2.0) * -Vector3::z();
    assert_eq!(contacts.len(), 1);
    assert!((contacts[0].gap + 0.05e-3).abs() < 1e-9 && (contacts[0].normal - normal).norm() < 1e-9);
    // The second goes round the first one's tip, from above to below.
    let above = |x: f64, z: f64| {
        vec![
            Strand::straight(Vector3::zeros(), Vector3::new(0.1, 0.0, 0.0), 5),
            Strand::straight(Vector3::new(x, -0.05, z), Vector3::new(0.0, 0.1, 0.0), 5),
        ]
    };
    let places = [(0.099, 2e-3), (0.1 + 2.2e-3, 0.0), (0.099, -2e-3)];
    for two in places.windows(2) {
        let (then, now) = (above(two[0].0, two[0].1), above(two[1].0, two[1].1));
        let (_, contacts) = contacts_between(&mut pairs, &then, &now);
        assert!(contacts.len() == 1 && contacts[0].gap > -1e-9, "{contacts:?}");
    }
}

/// Where strands may overlap, what they keep apart is less, and they keep their sides as long as they were outside of that.
#[test]
fn strands_that_may_overlap_keep_their_side_too() {
    let overlap = PermittedOverlap { along: vec![0.0], wisp_fractions: vec![0.25], sunk: vec![0.0] };
    for angle in [0.0, 0.7, 1.5] {
        // Of 2 mm they keep 0.5 mm; from 0.7 mm above to 0.5 mm below.
        let (then, now) = crossing(0.7e-3, 1.2e-3, angle);
        let mut pairs = HairPairs::default();
        pairs.set(&wisps(2, 1e-3), &options(0.5e-3, 1e-3)).unwrap();
        let mut found = |permitted_overlap| {
            pairs.begin_step();
            let (_, contacts) = contacts_with_overlap(&mut pairs, &then, &now, permitted_overlap);
            let at_crossing = |contact: &ContactPoint| angle == 0.0 || (now[0].along(&contact.point) - 0.047).abs() < 1e-3;
            let of = contacts.into_iter().filter(at_crossing).map(|contact| (contact.normal.z, contact.gap)).collect::<Vec<_>>();
            assert!(!of.is_empty(), "angle {angle}");
            of
        };
        for (normal, gap) in found(Some(&overlap)) {
            assert!(normal < -0.999_999 && (gap + 1e-3).abs() < 1e-6, "angle {angle}: {normal}, {gap}");
        }
        // With their full radii they were inside each other, and leave by the shortest path.
        for (normal, gap) in found(None) {
            assert!(normal > 0.999_999 && (gap + 1.5e-3).abs() < 1e-6, "angle {angle}: {normal}, {gap}");
        }
    }
    // What they may overlap is no contact, however near the search looks.
    let (strands, _) = crossing(0.6e-3, 0.0, 1.5);
    let mut pairs = HairPairs::default();
    pairs.set(&wisps(2, 1e-3), &options(0.05e-3, 1e-3)).unwrap();
    pairs.begin_step();
    assert!(contacts_with_overlap(&mut pairs, &strands, &strands, Some(&overlap)).1.is_empty());
}

/// Strands whose roots are closer than the sum of their radii touch from that arclength on; others all along.
#[test]
fn strands_rooted_in_each_other_do_not_touch_at_their_roots() {
    let wisps = wisps(2, 1e-3);
    let meet = |root: Vector3<f64>, way: Vector3<f64>| {
        let strands = [Strand::straight(Vector3::zeros(), Vector3::new(0.1, 0.0, 0.0), 5), Strand::straight(root, way * 0.1, 5)];
        let along = |contact: &ContactPoint| [strands[0].along(&contact.point), strands[1].along(&partner(contact))];
        contacts_at(&strands, &wisps, &options(0.0, 0.0)).iter().map(along).collect::<Vec<_>>()
    };
    let beside = Vector3::new(0.0, 0.5e-3, 0.0);
    // Diverging from their roots they touch nowhere; side by side at each joint and their tips, but not at their roots.
    assert_eq!(meet(beside, Vector3::new(0.98, 0.199, 0.0)), Vec::<[f64; 2]>::new());
    let joints = meet(beside, Vector3::x());
    assert!(joints.len() == 5 && joints.iter().flatten().all(|along| *along > 0.0199), "{joints:?}");
    // Across each other 20 mm away.
    let across = meet(Vector3::new(0.0, 0.5e-3, 0.5e-3), Vector3::new(0.9997, -0.025, 0.0).normalize());
    assert!(across.iter().any(|along| (along[0] - 0.02).abs() < 1e-3), "{across:?}");
    // Across each other next to roots that are less than 2 mm apart, and more.
    assert_eq!(meet(Vector3::new(1e-3, 1.2e-3, 1.2e-3), -Vector3::y()).len(), 0);
    assert_eq!(meet(Vector3::new(1e-3, 1.5e-3, 1.5e-3), -Vector3::y()).len(), 1);
}

#[test]
fn filters_exempt_lengths_and_a_strand_with_itself() {
    let (strands, _) = crossing(1.5e-3, 0.0, 1.5);
    let meet = |a: Wisp, b: Wisp| contacts_at(&strands, &[a, b], &options(0.0, 0.0)).len();
    let plain = Wisp { radius: 1e-3, ..Wisp::default() };
    assert_eq!(meet(plain, plain), 1);
    assert_eq!(meet(plain, Wisp { radius: 0.0, ..plain }), 0);
    assert_eq!(meet(plain, Wisp { radius: 0.4e-3, ..plain }), 0);
    assert_eq!(meet(plain, Wisp { group: 2, ..plain }), 1);
    assert_eq!(meet(Wisp { mask: !2, ..plain }, Wisp { group: 2, ..plain }), 0);
    assert_eq!(meet(Wisp { group: 2, ..plain }, Wisp { mask: !2, ..plain }), 0);
    // They cross 47 mm from either root.
    assert_eq!(meet(Wisp { exempt: 0.0465, ..plain }, plain), 1);
    assert_eq!(meet(Wisp { exempt: 0.06, ..plain }, plain), 0);
    assert_eq!(meet(plain, Wisp { exempt: 1.0, ..plain }), 0);

    // Two turns of a coil of radius 10 mm whose step is 1.5 mm: each turn lies on the one before.
    let (radius, step) = (0.01, 1.5e-3 / std::f64::consts::TAU);
    let square: f64 = radius * radius + step * step;
    let coil = Strand {
        origin: Vector3::zeros(),
        root: Rotation3::identity(),
        lengths: vec![2.0 * std::f64::consts::TAU * square.sqrt() / 10.0; 10],
        curvatures: vec![[step / square, radius / square, 0.0]; 10],
    };
    let meet = |wisp: Wisp| contacts_at(std::slice::from_ref(&coil), &[wisp], &options(0.0, 0.0));
    assert!(meet(plain).is_empty());
    let contacts = meet(Wisp { meets_itself: true, ..plain });
    assert!(contacts.len() >= 5, "{contacts:?}");
    for contact in &contacts {
        let turn = std::f64::consts::TAU * square.sqrt();
        let apart = coil.along(&partner(contact)) - coil.along(&contact.point);
        assert!((apart - turn).abs() < 0.3e-3 && (contact.gap + 0.5e-3).abs() < 1e-5, "{contact:?}");
    }
    assert!(meet(Wisp { meets_itself: true, radius: 0.7e-3, ..plain }).is_empty());
}

#[test]
fn bad_numbers_are_refused_by_name_and_change_nothing() {
    let (strands, _) = crossing(1.5e-3, 0.0, 1.5);
    let mut pairs = HairPairs::default();
    pairs.set(&wisps(2, 1e-3), &options(0.0, 0.0)).unwrap();
    let bad = [Wisp::default(), Wisp { radius: -1.0, ..Wisp::default() }];
    assert!(pairs.set(&bad, &options(0.0, 0.0)).unwrap_err().to_string().contains("wisps[1].radius is -1"));
    let bad = [Wisp { exempt: f64::NAN, ..Wisp::default() }];
    assert!(pairs.set(&bad, &options(0.0, 0.0)).unwrap_err().to_string().contains("wisps[0].exempt is NaN"));
    assert!(pairs.set(&[], &options(f64::INFINITY, 0.0)).unwrap_err().to_string().contains("activation is inf"));
    assert!(pairs.set(&[], &options(0.0, -1.0)).unwrap_err().to_string().contains("margin is -1"));
    assert!(pairs.update(&[]).unwrap_err().to_string().contains("strands is 0; expected 2"));
    assert_eq!(contacts_between(&mut pairs, &strands, &strands).1.len(), 1);
    // A strand that is not finite meets nothing, and disturbs no other.
    let mut three = strands.clone();
    three.push(Strand { origin: Vector3::repeat(f64::NAN), ..strands[0].clone() });
    let mut pairs = HairPairs::default();
    pairs.set(&wisps(3, 1e-3), &options(0.0, 0.0)).unwrap();
    assert_eq!(contacts_between(&mut pairs, &three, &three).1.len(), 1);
}

#[test]
fn nothing_is_allocated_once_memory_has_grown() {
    let mut random = Random(4);
    let strands: Vec<Strand> = (0..40).map(|_| Strand::random(&mut random, 4, 1.5, 0.012)).collect();
    let poses: Vec<Kinematics<f64>> = strands.iter().map(Strand::pose).collect();
    let paths: Vec<StrandPath> = (0..40)
        .map(|k| StrandPath {
            index: k as u32,
            start: strands[k].curve(&poses[k]),
            now: strands[k].curve(&poses[k]),
            permitted_overlap: None,
        })
        .collect();
    let wisps = wisps(40, 1e-3);
    let (mut pairs, mut scratch, mut out) = (HairPairs::default(), PairScratch::default(), Vec::new());
    let mut counts = Vec::with_capacity(2);
    for _ in 0..2 {
        let before = ALLOCATIONS.with(Cell::get);
        pairs.set(&wisps, &options(0.5e-3, 1e-3)).unwrap();
        assert!(pairs.update(&paths).unwrap() && !pairs.update(&paths).unwrap());
        out.clear();
        for group in pairs.groups() {
            pairs.contacts(group, &paths, f64::INFINITY, &mut scratch, &mut out);
        }
        counts.push(ALLOCATIONS.with(Cell::get) - before);
    }
    assert!(out.len() > 50 && counts[0] > 0 && counts[1] == 0, "{counts:?}");
}
