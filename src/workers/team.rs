//! Threads that stay together through many short rounds, each shorter than the cost of handing out work.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

/// The most pieces in a round.
const MAX_PIECES: usize = 1 << 15;
/// How often a thread checks for work before it yields its processor.
const LOOKS: u32 = 1000;

/// The threads, and their work.
pub(crate) struct Team<'a> {
    rounds: Rounds,
    /// Does one piece of the current round.
    work: &'a (dyn Fn(usize) + Sync),
    /// Whether there are no threads but the leader.
    alone: bool,
}

/// The progress of a team.
#[derive(Default)]
struct Rounds {
    /// The number of pieces of the round (above the lowest 16 bits), and the next piece that no thread has taken.
    ticket: AtomicU64,
    /// How many of its pieces are done.
    done: AtomicUsize,
    /// No more rounds follow.
    over: AtomicBool,
    /// A piece panicked.
    failed: AtomicBool,
}

impl<'a> Team<'a> {
    pub(super) fn new(work: &'a (dyn Fn(usize) + Sync), alone: bool) -> Self {
        Self { rounds: Rounds::default(), work, alone }
    }

    /// A round: calls the team's work once for each of `0..pieces`. The order must not matter. Only the leader may call it.
    pub(crate) fn each(&self, pieces: usize) {
        if self.alone || pieces == 1 {
            return (0..pieces).for_each(self.work);
        }
        assert!(pieces <= MAX_PIECES, "{pieces} pieces in a round");
        let Rounds { ticket, done, failed, .. } = &self.rounds;
        // All pieces of the last round are done: nobody else writes here now.
        done.store(0, Ordering::Relaxed);
        ticket.store((pieces as u64) << 16, Ordering::Release);
        while self.take() {}
        let mut looks = 0;
        while done.load(Ordering::Acquire) < pieces {
            assert!(!failed.load(Ordering::Relaxed), "a thread of the team panicked");
            pause(&mut looks);
        }
    }

    /// Works on pieces until the team is dismissed.
    pub(super) fn help(&self) {
        let mut looks = 0;
        while !self.rounds.over.load(Ordering::Acquire) {
            if self.take() { looks = 0 } else { pause(&mut looks) }
        }
    }

    /// Does the next piece; false if there is none.
    fn take(&self) -> bool {
        let next = |ticket: u64| {
            let (next, pieces) = (ticket & 0xffff, ticket >> 16);
            (next < pieces).then_some(next as usize)
        };
        // Checked first, so that the count of taken pieces stays close to that of existing ones.
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

/// Runs something when dropped, also by a panic.
struct OnDrop<F: Fn()>(F);

impl<F: Fn()> Drop for OnDrop<F> {
    fn drop(&mut self) {
        (self.0)();
    }
}
