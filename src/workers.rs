//! Running work on many strands: on the calling thread, in a private pool, or by the host's task system. Pieces of work do not see each
//! other, so that the result does not depend on who ran which.

use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use crate::error::{Error, Result};

/// A host's own task system: `run(count, min_range, task)` must call `task(begin, end, worker)` over disjoint ranges that cover
/// `[0, count)` exactly once, on any threads, and return when all are done.
pub trait ParallelFor: Send + Sync {
    /// Runs `task` over `[0, count)`; a range should hold at least `min_range` items (the last may be shorter).
    fn run(&self, count: u32, min_range: u32, task: &(dyn Fn(u32, u32, u32) + Sync));
}

/// Who runs the strands of a step.
#[derive(Clone, Default)]
pub enum Workers {
    /// The calling thread.
    #[default]
    Serial,
    /// A private pool of that many threads (2 to 256), made with the solver and joined when it is dropped.
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
    /// Checks the number of threads; `argument` is the name put before the field in the message.
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

/// Items a task takes at a time where nothing else is said: enough to be worth handing out, few enough to share evenly.
const CHUNK: usize = 8;
/// Tasks a thread, at least: so many that the last to end is not far behind the first.
const TASKS_PER_THREAD: usize = 4;

/// Who runs, and the scratch memory of those who do.
pub(crate) struct Crew<S> {
    runner: Runner,
    workspaces: Mutex<Vec<S>>,
}

enum Runner {
    Serial,
    Pool(Pool),
    Host(std::sync::Arc<dyn ParallelFor>),
}

/// A private rayon pool whose threads are joined when it goes: rayon's own drop only tells them to stop, and a library that is
/// unloaded with a thread still on its way out takes the process down.
struct Pool {
    pool: Option<rayon::ThreadPool>,
    threads: Vec<JoinHandle<()>>,
    /// The process that has the threads. In a child made by `fork` they are not there, and waiting for them would never end.
    process: u32,
}

impl Pool {
    fn new(count: usize) -> Result<Self> {
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
                value: count.to_string(),
                hint: format!("the threads could not be started ({error})"),
            })?;
        Ok(Self { pool: Some(pool), threads, process: std::process::id() })
    }

    fn is_here(&self) -> bool {
        self.process == std::process::id()
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
            // A worker that panicked has already reported it through the step that it was running.
            let _ = thread.join();
        }
    }
}

impl<S: Default + Send> Crew<S> {
    /// The calling thread alone.
    pub fn serial() -> Self {
        Self { runner: Runner::Serial, workspaces: Mutex::default() }
    }

    pub fn new(workers: &Workers) -> Result<Self> {
        let runner = match workers {
            Workers::Serial => Runner::Serial,
            Workers::Pool(count) => Runner::Pool(Pool::new(*count)?),
            Workers::Host(host) => Runner::Host(host.clone()),
        };
        Ok(Self { runner, workspaces: Mutex::new(vec![S::default()]) })
    }

    /// Calls `work` on every item once, each call with scratch memory of its own.
    pub fn for_each<T: Send>(&self, items: &mut [T], work: impl Fn(&mut T, &mut S) + Sync) {
        self.for_each_task(items, CHUNK, CHUNK, |chunk, scratch| {
            for item in chunk {
                work(item, scratch);
            }
        });
    }

    /// Calls `work` on slices that make up `items`, each call with scratch memory of its own. Slices are multiples of `least` long (the
    /// last may be shorter), and at most `most`.
    pub fn for_each_task<T: Send>(&self, items: &mut [T], least: usize, most: usize, work: impl Fn(&mut [T], &mut S) + Sync) {
        let run = |chunk: &mut [T]| {
            let mut scratch = self.lock().pop().unwrap_or_default();
            work(chunk, &mut scratch);
            self.lock().push(scratch);
        };
        // A host's threads are not known: its tasks are as small as may be.
        let threads = match &self.runner {
            Runner::Serial => 1,
            Runner::Pool(Pool { pool: Some(pool), .. }) => pool.current_num_threads() * TASKS_PER_THREAD,
            Runner::Pool(_) => 1,
            Runner::Host(_) => usize::MAX,
        };
        let chunk = (items.len() / threads / least * least).clamp(least, most);
        match &self.runner {
            Runner::Pool(crew @ Pool { pool: Some(pool), .. }) if items.len() > chunk && crew.is_here() => pool.install(|| {
                use rayon::prelude::*;
                items.par_chunks_mut(chunk).for_each(run);
            }),
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
                // A host that left a range out must not leave strands behind in time.
                for index in 0..chunks.len() {
                    take(index);
                }
            }
        }
    }

    /// As [`Crew::for_each`], but never on the host's threads: the calling thread does what the host's would.
    pub fn for_each_on_own<T: Send>(&self, items: &mut [T], work: impl Fn(&mut T, &mut S) + Sync) {
        if let Runner::Host(_) = self.runner {
            let mut workspace = self.lock().pop().unwrap_or_default();
            for item in items {
                work(item, &mut workspace);
            }
            self.lock().push(workspace);
        } else {
            self.for_each(items, work);
        }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Vec<S>> {
        self.workspaces.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}
