//! What a substep may cost: work, which is counted and the same on every machine; a moment when it is to be over; and a flag by which the host
//! calls it off.

use std::sync::atomic::{AtomicU8, AtomicU32, AtomicU64, Ordering};

use crate::platform::Instant;

/// What the steps of a call may cost. The default has no limits but the one that every step has, see [`StepLimits::work`].
///
/// ```
/// use superhelix::{Solver, SolverOptions, StepLimits, Stopped};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let report = solver.step_within(1.0 / 60.0, 1, &StepLimits { work: Some(10_000), ..StepLimits::default() })?;
/// assert_eq!(report.stopped, Stopped::No);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct StepLimits<'a> {
    /// Most work on strands in contact or held by constraints, in each substep, in units that each take about a microsecond of one core of 2026. What is
    /// spent is counted, not measured: the result is the same to the bit on every machine and for any number of threads. None: as much as
    /// keeps a host going whatever happens, [`usual_work`].
    pub work: Option<u64>,
    /// Seconds that the call may take. What is done by then depends on the clock, and so do the result's bits. None: any.
    pub seconds: Option<f64>,
    /// Set to anything but 0 by another thread, it calls the step off. None: nobody does.
    pub cancel: Option<&'a AtomicU32>,
}

/// Why a step was ended before all strands were at their end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
#[repr(u8)]
pub enum Stopped {
    /// It was not.
    #[default]
    No = 0,
    /// Its work was spent.
    Work = 1,
    /// Its time was up.
    Time = 2,
    /// It was called off.
    Cancelled = 3,
}

/// Units of work for so many elements and for fewer, and for every further one, see [`usual_work`].
const LEAST_WORK: f64 = 136_800.0;
const FEWEST_ELEMENTS: usize = 2280;
const WORK_PER_ELEMENT: f64 = 200.0;

/// The work that a substep may take where nothing else is said, in units: a quarter of a second of one core for 228 strands of ten elements and for less.
/// Every further element adds what a thousand strands on each other and on a head need that is shaken as hard as a head can be.
pub fn usual_work(elements: usize) -> u64 {
    (LEAST_WORK + WORK_PER_ELEMENT * elements.saturating_sub(FEWEST_ELEMENTS) as f64) as u64
}

/// Nanoseconds of work, about, in a unit.
const UNIT: u64 = 1000;

/// How often loops over touches and the like look at the meter: it takes as long as some of them.
const LOOK: usize = 64;

/// The meter of a substep.
#[derive(Debug)]
pub(crate) struct Meter<'a> {
    /// About nanoseconds of one core.
    spent: AtomicU64,
    most: u64,
    deadline: Option<Instant>,
    cancel: Option<&'a AtomicU32>,
    /// A [`Stopped`]: time or cancelled.
    halted: AtomicU8,
}

impl<'a> Meter<'a> {
    /// One for `work` units, to be over by `deadline`.
    pub fn new(work: u64, deadline: Option<Instant>, cancel: Option<&'a AtomicU32>) -> Self {
        let most = work.saturating_mul(UNIT);
        Self { spent: AtomicU64::new(0), most, deadline, cancel, halted: AtomicU8::new(Stopped::No as u8) }
    }

    /// One without limits.
    pub fn unlimited() -> Self {
        Self::new(u64::MAX, None, None)
    }

    /// Whether it is to be over at some moment.
    pub fn has_deadline(&self) -> bool {
        self.deadline.is_some()
    }

    /// Counts work, in nanoseconds or so. In whatever order threads do, the sum is the same once all have.
    #[inline]
    pub fn spend(&self, work: u64) {
        self.spent.fetch_add(work, Ordering::Relaxed);
    }

    /// Does something that is not counted: it only looks at what was done. While no other thread works.
    pub fn uncounted(&self, look: impl FnOnce()) {
        let spent = self.spent.load(Ordering::Relaxed);
        look();
        self.spent.store(spent, Ordering::Relaxed);
    }

    /// What is left, in the same measure. To be asked while no thread works, so that it is the same for any number of them.
    pub fn left(&self) -> u64 {
        self.most.saturating_sub(self.spent.load(Ordering::Relaxed))
    }

    /// Units spent so far.
    pub fn units(&self) -> u64 {
        self.spent.load(Ordering::Relaxed) / UNIT
    }

    /// Whether the time is up or the step was called off: what is being done is to be left.
    #[inline]
    pub fn is_halted(&self) -> bool {
        if self.halted.load(Ordering::Relaxed) != Stopped::No as u8 {
            return true;
        }
        let cancelled = self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed) != 0);
        let late = || self.deadline.is_some_and(|deadline| Instant::now() >= deadline);
        let now = match () {
            () if cancelled => Stopped::Cancelled,
            () if late() => Stopped::Time,
            () => return false,
        };
        self.halted.fetch_max(now as u8, Ordering::Relaxed);
        true
    }

    /// The same in a loop over many small things, at one in [`LOOK`] of them.
    #[inline]
    pub fn is_halted_at(&self, index: usize) -> bool {
        index.is_multiple_of(LOOK) && self.is_halted()
    }

    /// Why no more is to be done, if so. To be asked while no thread works.
    pub fn stopped(&self) -> Stopped {
        if self.is_halted() {
            // A flag that is set while time is up counts as well.
            let cancelled = self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed) != 0);
            return if cancelled { Stopped::Cancelled } else { Stopped::Time };
        }
        if self.left() == 0 { Stopped::Work } else { Stopped::No }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_meter_tells_what_ended_it() {
        let flag = AtomicU32::new(0);
        let meter = Meter::new(2, None, Some(&flag));
        assert_eq!((meter.stopped(), meter.left()), (Stopped::No, 2000));
        meter.spend(1999);
        assert_eq!((meter.stopped(), meter.units()), (Stopped::No, 1));
        meter.spend(5);
        assert_eq!((meter.stopped(), meter.left(), meter.is_halted()), (Stopped::Work, 0, false));
        let other = Meter::new(2, None, None);
        other.uncounted(|| other.spend(5000));
        assert_eq!((other.units(), other.left()), (0, 2000));
        flag.store(1, Ordering::Relaxed);
        assert_eq!(meter.stopped(), Stopped::Cancelled);
        let late = Meter::new(u64::MAX, Some(Instant::now()), None);
        assert!(late.is_halted());
        assert_eq!(late.stopped(), Stopped::Time);
        assert_eq!(Meter::unlimited().stopped(), Stopped::No);
    }

    #[test]
    fn usual_work_grows_with_the_elements() {
        assert_eq!(usual_work(10), usual_work(2280));
        assert_eq!(usual_work(12280), usual_work(2280) + 2_000_000);
    }
}
