//! Whether two moving pieces of strands plainly keep their sides to each other: a quick test that spares the search for
//! crossings most of its work, and must never hide a crossing.

use nalgebra::Vector3;

use crate::contact::narrow_phase::strand_contacts::MovingPiece;

/// Whether no point of one piece comes closer than `room` (m) to one of the other between the start of the step and now, in
/// straight motion: some direction, of those between the chords where they are nearest (`apart`: at the start, and now),
/// separates the pieces at both times by more than that. All positions between the two lie on the same side, so that it
/// separates them all the time. False says nothing.
pub(in crate::contact) fn keep_sides(a: &MovingPiece, b: &MovingPiece, apart: [Vector3<f64>; 2], room: f64) -> bool {
    let room = room + a.sagitta + b.sagitta;
    let parts = |direction: &Vector3<f64>| {
        let least = |a: &[Vector3<f64>; 2], b: &[Vector3<f64>; 2]| {
            let (low, high) = (a[0].dot(direction).min(a[1].dot(direction)), b[0].dot(direction).max(b[1].dot(direction)));
            low - high
        };
        let enough = room * direction.norm();
        least(&a.start, &b.start) > enough && least(&a.now, &b.now) > enough
    };
    parts(&apart[0]) || parts(&apart[1]) || parts(&(apart[0] + apart[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::broad_phase::pieces::Piece;
    use crate::contact::narrow_phase::segment_distance::closest_of_segments;
    use crate::math::random::Seeded;

    /// A curve within `bow` of its chord, at two times; its points go straight from the one to the other.
    struct Curve {
        start: [Vector3<f64>; 2],
        now: [Vector3<f64>; 2],
        bows: [Vector3<f64>; 2],
    }

    /// Edges that a curve is sampled with, and times of a step.
    const EDGES: usize = 8;
    const TIMES: usize = 60;

    struct Random(Seeded, u64);

    impl Random {
        fn unit(&mut self) -> f64 {
            self.1 += 1;
            self.0.unit(self.1)
        }

        fn ball(&mut self) -> Vector3<f64> {
            loop {
                let v = Vector3::from_fn(|_, _| 2.0 * self.unit() - 1.0);
                if v.norm() <= 1.0 {
                    return v;
                }
            }
        }
    }

    impl Curve {
        fn point(&self, s: f64, t: f64) -> Vector3<f64> {
            let at = |ends: &[Vector3<f64>; 2], bow: &Vector3<f64>| ends[0].lerp(&ends[1], s) + bow * (4.0 * s * (1.0 - s));
            at(&self.start, &self.bows[0]).lerp(&at(&self.now, &self.bows[1]), t)
        }

        fn sampled(&self, t: f64) -> Vec<Vector3<f64>> {
            (0..=EDGES).map(|k| self.point(k as f64 / EDGES as f64, t)).collect()
        }

        fn sagitta(&self) -> f64 {
            self.bows[0].norm().max(self.bows[1].norm())
        }
    }

    fn distance(a: &Curve, b: &Curve, t: f64) -> f64 {
        let (a, b) = (a.sampled(t), b.sampled(t));
        let of = |p: &[Vector3<f64>], q: &[Vector3<f64>]| closest_of_segments([&p[0], &p[1]], [&q[0], &q[1]]).distance;
        a.windows(2).flat_map(|p| b.windows(2).map(move |q| of(p, q))).fold(f64::INFINITY, f64::min)
    }

    /// The least distance of two curves during the motion, in which points move by at most `motion` each.
    fn nearest_in_motion(a: &Curve, b: &Curve, motion: f64) -> f64 {
        let at: Vec<f64> = (0..=TIMES).map(|k| distance(a, b, k as f64 / TIMES as f64)).collect();
        let mut least = at.iter().copied().fold(f64::INFINITY, f64::min);
        for k in 0..=TIMES {
            // Whether they may meet between the neighbouring times: then the time is searched for.
            let may_meet = at[k] <= 2.0 * motion / TIMES as f64;
            if !may_meet || at[k] > at[k.saturating_sub(1)] || at[k] > at[(k + 1).min(TIMES)] {
                continue;
            }
            let mut range = [k as f64 - 1.0, k as f64 + 1.0].map(|k| (k / TIMES as f64).clamp(0.0, 1.0));
            for _ in 0..45 {
                let times = [1.0 / 3.0, 2.0 / 3.0].map(|fraction| range[0] + fraction * (range[1] - range[0]));
                let found = times.map(|t| distance(a, b, t));
                least = least.min(found[0].min(found[1]));
                if found[0] < found[1] {
                    range[1] = times[1];
                } else {
                    range[0] = times[0];
                }
            }
        }
        least
    }

    /// Curves of about a unit's length; their ends move in any direction by up to `motion`, and they are bowed by up to `bow`.
    fn random_pair(random: &mut Random, motion: f64, bow: f64) -> [Curve; 2] {
        let away = 0.8 * random.unit();
        [0.0, away].map(|away| {
            let middle = random.ball() * away;
            let half = random.ball().normalize() * (0.3 + 0.2 * random.unit());
            let start = [middle - half, middle + half];
            let now = start.map(|end| end + random.ball() * motion);
            Curve { start, now, bows: [0; 2].map(|_| random.ball() * bow) }
        })
    }

    fn keep(a: &Curve, b: &Curve) -> bool {
        let piece = Piece { strand: 0, element: 0, s: [0.0, 1.0], along: 0.0, node: 0, chords: 1, continued: [true; 2] };
        let moving = |curve: &Curve| MovingPiece { piece: &piece, start: curve.start, now: curve.now, sagitta: curve.sagitta() };
        let apart = |a: &[Vector3<f64>; 2], b: &[Vector3<f64>; 2]| {
            let near = closest_of_segments([&a[0], &a[1]], [&b[0], &b[1]]);
            a[0].lerp(&a[1], near.t) - b[0].lerp(&b[1], near.u)
        };
        keep_sides(&moving(a), &moving(b), [apart(&a.start, &b.start), apart(&a.now, &b.now)], 0.0)
    }

    /// However far curves move and however they are bowed: curves that cross are never said to keep their sides; and most that
    /// are plainly apart all the time, by more than half of their motion and than their bow, are.
    #[test]
    fn no_crossing_is_said_to_keep_its_side() {
        let mut random = Random(Seeded::new(7, 0), 0);
        let (mut crossed, mut kept, mut all) = (0, 0, 0);
        for (motion, bow) in [(0.05, 0.01), (0.3, 0.02), (0.3, 0.1), (1.5, 0.05)] {
            let (mut plain, mut of_these) = (0, 0);
            for _ in 0..1500 {
                let [a, b] = random_pair(&mut random, motion, bow);
                let (keep, least) = (keep(&a, &b), nearest_in_motion(&a, &b, motion));
                assert!(!(keep && least < 1e-7), "{least:e}: {:?} {:?} {:?} {:?}", a.start, a.now, b.start, b.now);
                (crossed, kept) = (crossed + u32::from(least < 1e-7), kept + u32::from(keep));
                let far = least > 0.5 * motion + 2.0 * bow;
                (plain, of_these) = (plain + u32::from(far), of_these + u32::from(far && keep));
            }
            println!("go {motion}, bowed {bow}: {plain} plainly apart, {of_these} of these found so");
            assert!(f64::from(of_these) >= 0.9 * f64::from(plain), "{plain} {of_these}");
            all += plain;
        }
        println!("{crossed} cross, {kept} are found to keep their sides");
        assert!(crossed > 500 && kept > 1000 && all > 1000, "{crossed} {kept} {all}");
    }

    /// The offsets between the chords at the start and now may point alike though they crossed: one turns by 150 degrees about
    /// its end, and through the other on its way.
    #[test]
    fn a_piece_that_swings_round_has_not_kept_its_side() {
        let v = Vector3::new;
        let swinging = [[v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.0)], [v(0.0, 0.0, 0.0), v(-0.87, 0.0, 0.5)]];
        let still = [[v(0.2, -0.5, 0.12), v(0.2, 0.5, 0.12)]; 2];
        let [a, b] = [still, swinging].map(|[start, now]| Curve { start, now, bows: [Vector3::zeros(); 2] });
        assert!(nearest_in_motion(&a, &b, 2.0) < 1e-7);
        assert!(!keep(&a, &b) && !keep(&b, &a));
    }
}
