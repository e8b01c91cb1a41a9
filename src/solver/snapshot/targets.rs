//! Targets in a snapshot.

use super::bytes::{Reader, Writer, bad};
use crate::error::Result;
use crate::math::vector::Vec3;
use crate::rod::target::{Target, TargetMotion, TargetPoint};

impl Writer {
    /// What a strand is drawn to.
    pub fn target(&mut self, target: &Target) {
        let Target { points, weights, time_constant, motion } = target;
        self.u64(points.len() as u64);
        for TargetPoint { arclength, from, to, velocity } in points {
            self.f64(*arclength);
            for vector in [from, to, velocity] {
                self.vector((*vector).into());
            }
        }
        self.u64(weights.len() as u64);
        weights.iter().flatten().for_each(|number| self.f64(*number));
        self.f64(*time_constant);
        match *motion {
            TargetMotion::Rests => self.u32(0),
            TargetMotion::Moves { duration, elapsed } => {
                self.u32(1);
                self.f64(duration);
                self.f64(elapsed);
            }
        }
    }
}

impl Reader<'_> {
    /// What a strand is drawn to.
    pub fn target(&mut self) -> Result<Target> {
        let count = self.count(8 * 10)?;
        let point = |reader: &mut Self| -> Result<TargetPoint> {
            let arclength = reader.finite("an arclength of a target")?;
            let mut vector = || Ok(Vec3::from(reader.finite_vector("a point of a target")?));
            Ok(TargetPoint { arclength, from: vector()?, to: vector()?, velocity: vector()? })
        };
        let points = (0..count).map(|_| point(self)).collect::<Result<Vec<_>>>()?;
        let count = self.count(8 * 2)?;
        let key = |reader: &mut Self| Ok([reader.finite("a target's key")?, reader.finite("a target's weight")?]);
        let weights = (0..count).map(|_| key(self)).collect::<Result<Vec<_>>>()?;
        let time_constant = self.finite("a target's time constant")?;
        let motion = match self.u32()? {
            0 => TargetMotion::Rests,
            1 => TargetMotion::Moves {
                duration: self.finite("a target's time")?,
                elapsed: self.finite("a target's elapsed time")?,
            },
            other => return Err(bad(format!("a target's motion is {other}"))),
        };
        let good = points.len() >= 2
            && points.windows(2).all(|pair| pair[0].arclength <= pair[1].arclength)
            && !weights.is_empty()
            && weights.windows(2).all(|pair| pair[0][0] <= pair[1][0])
            && weights.iter().all(|key| (0.0..=1.0).contains(&key[1]))
            && time_constant > 0.0
            && !matches!(motion, TargetMotion::Moves { duration, elapsed } if duration < 0.0 || elapsed < 0.0);
        if !good {
            return Err(bad("a strand's target has points or weights that no host can give"));
        }
        Ok(Target { points: points.into(), weights: weights.into(), time_constant, motion })
    }
}
