//! The budget of a substep: work, which is counted and the same on every machine; a deadline; and a flag with which the host
//! cancels.

use std::sync::atomic::{AtomicU8, AtomicU32, AtomicU64, Ordering};

use crate::platform::Instant;

/// Limits on the cost of a call's steps. The default limits nothing but the work of each step: see [`StepLimits::work`].
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
    /// The most work on strands in contact or with constraints in each substep, in units of about a microsecond of one core of
    /// 2026. Work is counted, not measured: the result is the same to the bit on every machine and for any number of threads.
    /// `None`: [`usual_work`], which keeps a host responsive whatever happens. A search for contacts is always finished: a step may
    /// spend more by one of them, and limits below its cost stop every step before a strand moves.
    pub work: Option<u64>,
    /// Seconds that the call may take. What is done by then depends on the clock, and so do the result's bits. `None`: no limit.
    pub seconds: Option<f64>,
    /// Another thread cancels the step by setting it to anything but 0. `None`: no such flag.
    pub cancel: Option<&'a AtomicU32>,
}

/// Why a step ended before all strands converged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
#[repr(u8)]
pub enum Stopped {
    /// It did not.
    #[default]
    No = 0,
    /// It used up its work.
    Work = 1,
    /// Its time ran out.
    Time = 2,
    /// The host cancelled it.
    Cancelled = 3,
}

/// Units of work for every element, and the number of elements for which there is work at least: see [`usual_work`].
const WORK_PER_ELEMENT: u64 = 500;
const MIN_ELEMENTS: usize = 900;

/// The default work of a substep, in units: as much for every element as tufts of strands that cross each other need, and about half
/// a second of one core for 900 elements and for fewer. Where islands are solved in substeps it may take up to three times as long.
pub fn usual_work(elements: usize) -> u64 {
    WORK_PER_ELEMENT * elements.max(MIN_ELEMENTS) as u64
}

/// Nanoseconds of work in a unit, approximately.
const UNIT: u64 = 1000;

/// How often loops over contacts and the like check the meter: a check takes as long as some of their items.
const LOOK: usize = 64;

/// The meter of a substep.
#[derive(Debug)]
pub(crate) struct Meter<'a> {
    /// Approximate nanoseconds of one core.
    spent: AtomicU64,
    most: u64,
    deadline: Option<Instant>,
    cancel: Option<&'a AtomicU32>,
    /// A [`Stopped`]: time or cancelled.
    halted: AtomicU8,
}

impl<'a> Meter<'a> {
    /// A meter for `work` units, with a deadline.
    pub fn new(work: u64, deadline: Option<Instant>, cancel: Option<&'a AtomicU32>) -> Self {
        let most = work.saturating_mul(UNIT);
        Self { spent: AtomicU64::new(0), most, deadline, cancel, halted: AtomicU8::new(Stopped::No as u8) }
    }

    /// A meter without limits.
    pub fn unlimited() -> Self {
        Self::new(u64::MAX, None, None)
    }

    /// Whether there is a deadline.
    pub fn has_deadline(&self) -> bool {
        self.deadline.is_some()
    }

    /// Counts work, in approximate nanoseconds. The sum does not depend on the order of threads.
    #[inline]
    pub fn spend(&self, work: u64) {
        self.spent.fetch_add(work, Ordering::Relaxed);
    }

    /// Does something without counting it, for checks of finished work. Call it while no other thread works.
    pub fn uncounted(&self, look: impl FnOnce()) {
        let spent = self.spent.load(Ordering::Relaxed);
        look();
        self.spent.store(spent, Ordering::Relaxed);
    }

    /// Work spent so far, in the same measure. Call it while no thread works.
    pub fn spent(&self) -> u64 {
        self.spent.load(Ordering::Relaxed)
    }

    /// The remaining work, in the same measure. Call it while no thread works, so that it is the same for any number of threads.
    pub fn left(&self) -> u64 {
        self.most.saturating_sub(self.spent())
    }

    /// Units spent so far.
    pub fn units(&self) -> u64 {
        self.spent() / UNIT
    }

    /// Whether the time is up or the host has cancelled: the current work must end.
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

    /// The same for a loop over many small items: checks at one in [`LOOK`] of them.
    #[inline]
    pub fn is_halted_at(&self, index: usize) -> bool {
        index.is_multiple_of(LOOK) && self.is_halted()
    }

    /// Why work must end, if it must. Call it while no thread works.
    pub fn stopped(&self) -> Stopped {
        if self.is_halted() {
            // A flag that is set after the time is up counts as well.
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
    fn a_meter_reports_why_it_ended() {
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
        assert_eq!(usual_work(10), usual_work(900));
        assert_eq!(usual_work(12_280), 6_140_000);
    }
}
