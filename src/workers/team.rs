//! Threads that stay together through many short rounds of work: what handing it out anew would cost is more than what they do in one.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

/// Most pieces of a round.
const MOST_PIECES: usize = 1 << 15;
/// How often a thread looks for work before it lets others run, who may need the processor that it is on.
const LOOKS: u32 = 1000;

/// The threads, and what they do.
pub(crate) struct Team<'a> {
    rounds: Rounds,
    /// Does a piece of the present round.
    work: &'a (dyn Fn(usize) + Sync),
    /// Whether there are others than the one who leads.
    alone: bool,
}

/// Where a team is.
#[derive(Default)]
struct Rounds {
    /// How many pieces the round has (above the lowest 16 bits) and which is the next that nobody has taken.
    ticket: AtomicU64,
    /// How many of its pieces are done.
    done: AtomicUsize,
    /// There are no more rounds.
    over: AtomicBool,
    /// Some piece was left in a panic.
    failed: AtomicBool,
}

impl<'a> Team<'a> {
    pub(super) fn new(work: &'a (dyn Fn(usize) + Sync), alone: bool) -> Self {
        Self { rounds: Rounds::default(), work, alone }
    }

    /// A round: the team's work on each of `0..pieces` once, which may not depend on the order. Only for who leads.
    pub(crate) fn each(&self, pieces: usize) {
        if self.alone || pieces == 1 {
            return (0..pieces).for_each(self.work);
        }
        assert!(pieces <= MOST_PIECES, "{pieces} pieces in a round");
        let Rounds { ticket, done, failed, .. } = &self.rounds;
        // All pieces of the round before are done: nobody else writes here now.
        done.store(0, Ordering::Relaxed);
        ticket.store((pieces as u64) << 16, Ordering::Release);
        while self.take() {}
        let mut looks = 0;
        while done.load(Ordering::Acquire) < pieces {
            assert!(!failed.load(Ordering::Relaxed), "a thread of the team panicked");
            pause(&mut looks);
        }
    }

    /// Does what pieces there are until the team is dismissed.
    pub(super) fn help(&self) {
        let mut looks = 0;
        while !self.rounds.over.load(Ordering::Acquire) {
            if self.take() { looks = 0 } else { pause(&mut looks) }
        }
    }

    /// Does the next piece. False where there is none.
    fn take(&self) -> bool {
        let next = |ticket: u64| {
            let (next, pieces) = (ticket & 0xffff, ticket >> 16);
            (next < pieces).then_some(next as usize)
        };
        // Looked at first, so that the count of those taken stays next to that of those there are.
        if next(self.rounds.ticket.load(Ordering::Relaxed)).is_none() {
            return false;
        }
        let Some(piece) = next(self.rounds.ticket.fetch_add(1, Ordering::Acquire)) else { return false };
        let guard = OnDrop(|| self.rounds.failed.store(true, Ordering::Relaxed));
        (self.work)(piece);
        std::mem::forget(guard);
        self.rounds.done.fetch_add(1, Ordering::Release);
        true
    }

    /// Leads the team through rounds, and dismisses it.
    pub(super) fn lead(&self, lead: impl FnOnce(&Self)) {
        let _dismiss = OnDrop(|| self.rounds.over.store(true, Ordering::Release));
        lead(self);
    }
}

/// Waits a little.
fn pause(looks: &mut u32) {
    *looks += 1;
    if *looks < LOOKS {
        std::hint::spin_loop();
    } else {
        std::thread::yield_now();
    }
}

/// Does something when it goes, by a panic too.
struct OnDrop<F: Fn()>(F);

impl<F: Fn()> Drop for OnDrop<F> {
    fn drop(&mut self) {
        (self.0)();
    }
}
