//! Running the strands of a step: on the calling thread, in a private pool, or by the host's task system. Strands do not see each
//! other, so that the result does not depend on who ran which.

use std::sync::Mutex;
use std::thread::JoinHandle;

use super::definition::{ParallelFor, Workers};
use crate::error::{Error, Result};
use crate::step::workspace::Workspace;

/// Strands a task takes at a time: enough to be worth handing out, few enough to share evenly.
const CHUNK: usize = 8;

/// Who runs, and the scratch memory of those who do.
pub(super) struct Crew {
    runner: Runner,
    workspaces: Mutex<Vec<Workspace>>,
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

impl Crew {
    pub fn new(workers: &Workers) -> Result<Self> {
        let runner = match workers {
            Workers::Serial => Runner::Serial,
            Workers::Pool(count) => Runner::Pool(Pool::new(*count)?),
            Workers::Host(host) => Runner::Host(host.clone()),
        };
        Ok(Self { runner, workspaces: Mutex::new(vec![Workspace::default()]) })
    }

    /// Calls `work` on every item once, each call with scratch memory of its own.
    pub fn for_each<T: Send>(&self, items: &mut [T], work: impl Fn(&mut T, &mut Workspace) + Sync) {
        let run = |chunk: &mut [T]| {
            let mut workspace = self.lock().pop().unwrap_or_default();
            for item in chunk {
                work(item, &mut workspace);
            }
            self.lock().push(workspace);
        };
        match &self.runner {
            Runner::Serial => run(items),
            Runner::Pool(crew @ Pool { pool: Some(pool), .. }) if items.len() > CHUNK && crew.is_here() => pool.install(|| {
                use rayon::prelude::*;
                items.par_chunks_mut(CHUNK).for_each(run);
            }),
            Runner::Pool(_) => run(items),
            Runner::Host(host) => {
                let chunks: Vec<Mutex<Option<&mut [T]>>> = items.chunks_mut(CHUNK).map(|chunk| Mutex::new(Some(chunk))).collect();
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
    pub fn for_each_on_own<T: Send>(&self, items: &mut [T], work: impl Fn(&mut T, &mut Workspace) + Sync) {
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

    fn lock(&self) -> std::sync::MutexGuard<'_, Vec<Workspace>> {
        self.workspaces.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}
