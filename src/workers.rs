//! Runs work on many strands: on the calling thread, in a private pool, or by the host's task system.
//!
//! Pieces of work do not depend on each other, so the result does not depend on which thread runs which.
//!
//! Files:
//!
//! - `team.rs`: Threads that stay together through many short rounds, each shorter than the cost of handing out work.

mod team;

use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

pub(crate) use self::team::Team;
use crate::error::{Error, Result};
use crate::platform::{HAS_THREADS, process_id};

/// A host's task system. `run(count, min_range, task)` must call `task(begin, end, worker)` over disjoint ranges that cover `[0,
/// count)` exactly once, on any threads, and return when all are done.
///
/// ```
/// use std::sync::Arc;
///
/// use superhelix::{ParallelFor, Solver, SolverOptions, StrandDef, Workers};
///
/// /// A task system of one thread.
/// struct Tasks;
///
/// impl ParallelFor for Tasks {
///     fn run(&self, count: u32, min_range: u32, task: &(dyn Fn(u32, u32, u32) + Sync)) {
///         for begin in (0..count).step_by(min_range.max(1) as usize) {
///             task(begin, count.min(begin + min_range.max(1)), 0);
///         }
///     }
/// }
///
/// let mut solver = Solver::new(SolverOptions { workers: Workers::Host(Arc::new(Tasks)), ..SolverOptions::default() })?;
/// solver.add_strands(&vec![StrandDef::straight(0.2, 5); 100])?;
/// solver.step(1.0 / 60.0, 1)?;
/// # Ok::<(), superhelix::Error>(())
/// ```
pub trait ParallelFor: Send + Sync {
    /// Runs `task` over `[0, count)`; a range should hold at least `min_range` items (the last may be shorter).
    fn run(&self, count: u32, min_range: u32, task: &(dyn Fn(u32, u32, u32) + Sync));
}

/// Which threads run the strands of a step.
///
/// ```
/// use superhelix::{Solver, SolverOptions, Workers};
///
/// let solver = Solver::new(SolverOptions { workers: Workers::Pool(2), ..SolverOptions::default() })?;
/// # drop(solver);
/// assert!(Workers::Pool(1000).check("options").is_err());
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Clone, Default)]
pub enum Workers {
    /// The calling thread.
    #[default]
    Serial,
    /// This many threads (2 to 256): the calling one and a private pool of the others, created with the solver and joined when it
    /// is dropped.
    Pool(usize),
    /// The host's task system.
    Host(Arc<dyn ParallelFor>),
}

impl std::fmt::Debug for Workers {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Workers::Serial => write!(f, "Serial"),
            Workers::Pool(count) => write!(f, "Pool({count})"),
            Workers::Host(_) => write!(f, "Host"),
        }
    }
}

impl Workers {
    /// Checks the number of threads; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a pool of fewer than 2 or more than 256.
    pub fn check(&self, argument: &str) -> Result<()> {
        if let Workers::Pool(count) = self
            && !(2..=256).contains(count)
        {
            return Err(Error::invalid(format!("{argument}.worker_count"), count, "2 to 256 threads, or 0 or 1 for none"));
        }
        Ok(())
    }
}

/// Default number of items per task: enough to be worth a task, few enough for an even load.
const CHUNK: usize = 8;
/// Least number of tasks per thread: enough for the last thread to finish soon after the first.
const TASKS_PER_THREAD: usize = 4;
/// The most groups that items are divided into; with more threads some start with the same group.
const MAX_GROUPS: usize = 32;

/// The threads, and their scratch memory.
pub(crate) struct WorkerSet<S> {
    runner: Runner,
    /// Each thread of the pool gets its own back; all others share the first one's. Boxed: scratch memory is large, and is lent
    /// out for every few strands.
    workspaces: Vec<Mutex<Vec<Box<S>>>>,
}

enum Runner {
    Serial,
    Pool(Pool),
    Host(std::sync::Arc<dyn ParallelFor>),
}

/// A private rayon pool of all threads but the calling one. Dropping it joins the threads: rayon's own drop only signals them,
/// and unloading a library while a thread still exits crashes the process.
struct Pool {
    pool: Option<rayon::ThreadPool>,
    threads: Vec<JoinHandle<()>>,
    /// The process that owns the threads. In a child made by `fork` they do not exist, and joining them would never return.
    process: u32,
}

impl Pool {
    /// A pool with `count` threads.
    fn new(count: usize) -> Result<Self> {
        if !HAS_THREADS {
            return Err(Error::Unsupported {
                argument: "worker_count".into(),
                value: (count + 1).to_string(),
                hint: "there are no threads on this platform; take 0 or 1".into(),
            });
        }
        let mut threads = Vec::with_capacity(count);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(count)
            .spawn_handler(|thread| {
                let handle = std::thread::Builder::new().name("superhelix".into()).spawn(|| thread.run())?;
                threads.push(handle);
                Ok(())
            })
            .build()
            .map_err(|error| Error::Unsupported {
                argument: "worker_count".into(),
                value: (count + 1).to_string(),
                hint: format!("the threads could not be started ({error})"),
            })?;
        Ok(Self { pool: Some(pool), threads, process: process_id() })
    }

    fn is_here(&self) -> bool {
        self.process == process_id()
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        if !self.is_here() {
            std::mem::forget(self.pool.take());
            std::mem::take(&mut self.threads).into_iter().for_each(std::mem::forget);
            return;
        }
        drop(self.pool.take());
        for thread in self.threads.drain(..) {
            // A worker that panicked has already reported it through its step.
            let _ = thread.join();
        }
    }
}

impl<S: Default + Send> WorkerSet<S> {
    /// The calling thread alone, with scratch memory created for each loop.
    pub fn serial() -> Self {
        Self { runner: Runner::Serial, workspaces: Vec::new() }
    }

    pub fn new(workers: &Workers) -> Result<Self> {
        let (runner, threads) = match workers {
            Workers::Serial => (Runner::Serial, 1),
            Workers::Pool(count) => (Runner::Pool(Pool::new(count - 1)?), *count),
            Workers::Host(host) => (Runner::Host(host.clone()), 1),
        };
        Ok(Self { runner, workspaces: (0..threads).map(|_| Mutex::new(vec![Box::default()])).collect() })
    }

    /// Calls `work` on every item once, each call with scratch memory of its own.
    pub fn for_each<T: Send>(&self, items: &mut [T], work: impl Fn(&mut T, &mut S) + Sync) {
        self.for_each_task(items, CHUNK, CHUNK, |chunk, scratch| {
            for item in chunk {
                work(item, scratch);
            }
        });
    }

    /// Calls `work` on slices that make up `items`, each call with scratch memory of its own. Slices are multiples of `least`
    /// long (the last may be shorter), and at most `most`.
    pub fn for_each_task<T: Send>(&self, items: &mut [T], least: usize, most: usize, work: impl Fn(&mut [T], &mut S) + Sync) {
        let run = |chunk: &mut [T]| self.with_scratch(0, |scratch| work(chunk, scratch));
        let threads = self.threads();
        let tasks = if threads == 1 { 1 } else { threads.saturating_mul(TASKS_PER_THREAD) };
        let chunk = (items.len() / tasks / least * least).clamp(least, most);
        match &self.runner {
            Runner::Pool(Pool { pool: Some(pool), .. }) if threads > 1 && items.len() > chunk => {
                let groups = Groups::new(items, chunk, threads);
                let do_share = |thread| {
                    self.with_scratch(thread, |scratch| groups.work(thread, &mut |chunk: &mut [T]| work(chunk, scratch)));
                };
                pool.in_place_scope(|scope| {
                    for thread in 1..threads {
                        let do_share = &do_share;
                        scope.spawn(move |_| do_share(thread));
                    }
                    do_share(0);
                });
            }
            Runner::Serial | Runner::Pool(_) => items.chunks_mut(chunk).for_each(run),
            Runner::Host(host) => {
                let chunks: Vec<Mutex<Option<&mut [T]>>> = items.chunks_mut(chunk).map(|chunk| Mutex::new(Some(chunk))).collect();
                let take = |index: usize| {
                    let chunk = chunks[index].lock().unwrap_or_else(std::sync::PoisonError::into_inner).take();
                    if let Some(chunk) = chunk {
                        run(chunk);
                    }
                };
                host.run(chunks.len() as u32, 1, &|begin, end, _worker| {
                    for index in begin..end.min(chunks.len() as u32) {
                        take(index as usize);
                    }
                });
                // Strands stay in step even if the host left out a range.
                for index in 0..chunks.len() {
                    take(index);
                }
            }
        }
    }

    /// The number of threads. A host's threads are unknown, so its tasks are as small as possible.
    fn threads(&self) -> usize {
        match &self.runner {
            Runner::Pool(workers @ Pool { pool: Some(pool), .. }) if workers.is_here() => pool.current_num_threads() + 1,
            Runner::Serial | Runner::Pool(_) => 1,
            Runner::Host(_) => usize::MAX,
        }
    }

    /// Calls `lead` once, on some thread, whose [`Team`] does `work`; at most `most` threads are useful.
    pub fn together(&self, most: usize, work: &(dyn Fn(usize) + Sync), lead: impl FnOnce(&Team) + Send) {
        let threads = self.threads().min(most);
        let team = &Team::new(work, threads <= 1);
        match &self.runner {
            Runner::Pool(Pool { pool: Some(pool), .. }) if threads > 1 => pool.in_place_scope(|scope| {
                for _ in 1..threads {
                    scope.spawn(|_| team.help());
                }
                team.lead(lead);
            }),
            Runner::Host(host) if threads > 1 => {
                // The host decides which of its threads come, and when. The first one leads, so that nobody waits for one that
                // never comes.
                let lead = Mutex::new(Some(lead));
                let take = || lead.lock().unwrap_or_else(std::sync::PoisonError::into_inner).take();
                let join = |_| take().map_or_else(|| team.help(), |lead| team.lead(lead));
                host.run(threads as u32, 1, &|begin, end, _worker| (begin..end).for_each(join));
                if let Some(lead) = take() {
                    team.lead(lead);
                }
            }
            Runner::Serial | Runner::Pool(_) | Runner::Host(_) => team.lead(lead),
        }
    }

    /// As [`WorkerSet::for_each`], but never on the host's threads: the calling thread replaces them.
    pub fn for_each_on_own<T: Send>(&self, items: &mut [T], work: impl Fn(&mut T, &mut S) + Sync) {
        if let Runner::Host(_) = self.runner {
            self.with_scratch(0, |scratch| items.iter_mut().for_each(|item| work(item, scratch)));
        } else {
            self.for_each(items, work);
        }
    }

    /// Calls `work` once on the calling thread, with scratch memory.
    pub fn with_own_scratch(&self, work: impl FnOnce(&mut S)) {
        self.with_scratch(0, work);
    }

    fn with_scratch(&self, thread: usize, work: impl FnOnce(&mut S)) {
        let Some(workspaces) = self.workspaces.get(thread) else { return work(&mut S::default()) };
        let free = || workspaces.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let mut scratch = free().pop().unwrap_or_default();
        work(&mut scratch);
        free().push(scratch);
    }
}

/// Items in chunks, and chunks in groups, one group per thread. Loops over the same strands give a strand to the same thread each
/// time, whose caches hold it: a shared queue loses half of what a second thread gains in contact.
struct Groups<'a, T> {
    groups: [Mutex<std::slice::ChunksMut<'a, T>>; MAX_GROUPS],
    count: usize,
}

impl<'a, T: Send> Groups<'a, T> {
    fn new(items: &'a mut [T], chunk: usize, threads: usize) -> Self {
        let count = threads.min(MAX_GROUPS);
        let (all, mut rest, mut taken) = (items.len().div_ceil(chunk), items, 0);
        let groups = std::array::from_fn(|k| {
            let to = all * (k + 1).min(count) / count;
            let length = ((to - taken) * chunk).min(rest.len());
            let (own, others) = std::mem::take(&mut rest).split_at_mut(length);
            (rest, taken) = (others, to);
            Mutex::new(own.chunks_mut(chunk))
        });
        Self { groups, count }
    }

    /// Works through a thread's own group from its front, then through the rest of the others' groups from their backs.
    fn work(&self, thread: usize, run: &mut impl FnMut(&mut [T])) {
        for k in 0..self.count {
            let group = &self.groups[(thread + k) % self.count];
            let next = || {
                let mut group = group.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                if k == 0 { group.next() } else { group.next_back() }
            };
            while let Some(chunk) = next() {
                run(chunk);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn every_item_is_worked_on_once() {
        for threads in [2, 3, 40] {
            let workers = WorkerSet::<()>::new(&Workers::Pool(threads)).unwrap();
            for count in [0, 1, 7, 8, 9, 65, 1000] {
                for (least, most) in [(1, 1), (4, 4), (4, 64)] {
                    let mut items = vec![0_u32; count];
                    workers.for_each_task(&mut items, least, most, |chunk, _| {
                        assert!(chunk.len() <= most);
                        chunk.iter_mut().for_each(|item| *item += 1);
                    });
                    assert!(items.iter().all(|item| *item == 1), "{threads} threads, {count} items, {least} to {most}");
                }
            }
        }
    }

    #[test]
    fn a_thread_starts_with_its_own_group_and_ends_with_the_rest_of_others() {
        let mut items: Vec<usize> = (0..100).collect();
        let groups = Groups::new(&mut items, 8, 3);
        let mut order = Vec::new();
        groups.work(1, &mut |chunk: &mut [usize]| order.push(chunk[0]));
        assert_eq!(order, [32, 40, 48, 56, 96, 88, 80, 72, 64, 24, 16, 8, 0]);
    }

    /// A host that runs its tasks in some way.
    struct Host<F>(F);

    impl<F: Fn(u32, &(dyn Fn(u32, u32, u32) + Sync)) + Send + Sync> ParallelFor for Host<F> {
        fn run(&self, count: u32, _: u32, task: &(dyn Fn(u32, u32, u32) + Sync)) {
            (self.0)(count, task);
        }
    }

    fn all_workers() -> Vec<Workers> {
        vec![
            Workers::Serial,
            Workers::Pool(2),
            Workers::Pool(5),
            Workers::Host(Arc::new(Host(|count: u32, task: &(dyn Fn(u32, u32, u32) + Sync)| task(0, count, 0)))),
            Workers::Host(Arc::new(Host(|count: u32, task: &(dyn Fn(u32, u32, u32) + Sync)| {
                (0..count).rev().for_each(|k| task(k, k + 1, 0));
            }))),
            Workers::Host(Arc::new(Host(|count: u32, task: &(dyn Fn(u32, u32, u32) + Sync)| {
                std::thread::scope(|scope| (0..count).for_each(|k| drop(scope.spawn(move || task(k, k + 1, k)))));
            }))),
            // A host that forgets to run tasks.
            Workers::Host(Arc::new(Host(|_: u32, _: &(dyn Fn(u32, u32, u32) + Sync)| {}))),
        ]
    }

    #[test]
    fn a_team_goes_through_rounds_together() {
        const PIECES: usize = 4;
        for (k, workers) in all_workers().iter().enumerate() {
            let workers = WorkerSet::<()>::new(workers).unwrap();
            // Each piece needs the results of all pieces of the round before: none may start before those are done.
            let next = |values: &[u64; PIECES], piece: usize| {
                values.iter().fold(piece as u64, |all, value| all.rotate_left(9).wrapping_add(*value).wrapping_mul(5))
            };
            let (first, rounds) = (std::array::from_fn(|piece| piece as u64), AtomicUsize::new(0));
            let values = [Mutex::new(first), Mutex::new([0; PIECES])];
            let work = |piece: usize| {
                let round = rounds.load(Ordering::Relaxed);
                if (round + piece).is_multiple_of(20) {
                    std::thread::sleep(std::time::Duration::from_micros(20));
                }
                let value = next(&values[round % 2].lock().unwrap(), piece);
                values[(round + 1) % 2].lock().unwrap()[piece] = value;
            };
            let (mut expected, mut calls) = (first, 0);
            workers.together(PIECES, &work, |team| {
                calls += 1;
                for round in 0..1000 {
                    rounds.store(round, Ordering::Relaxed);
                    team.each(PIECES);
                    expected = std::array::from_fn(|piece| next(&expected, piece));
                }
            });
            assert_eq!((calls, *values[0].lock().unwrap()), (1, expected), "crew {k}");
        }
    }

    #[test]
    fn a_team_in_which_one_panics_ends_in_that_panic() {
        for (k, workers) in all_workers()[..3].iter().enumerate() {
            let workers = WorkerSet::<()>::new(workers).unwrap();
            for piece in 0..8 {
                let work = |own: usize| assert_ne!(own, piece);
                let run = || workers.together(8, &work, |team| (0..100).for_each(|_| team.each(8)));
                std::panic::catch_unwind(std::panic::AssertUnwindSafe(run)).expect_err("a panic");
            }
            let done = AtomicUsize::new(0);
            let work = |_: usize| {
                done.fetch_add(1, Ordering::Relaxed);
            };
            workers.together(8, &work, |team| team.each(8));
            assert_eq!(done.into_inner(), 8, "crew {k}");
        }
    }
}
