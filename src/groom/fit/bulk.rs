//! Fits many curves at once.

use super::{Fit, FitCurve, FitOptions, FitScratch, fit_curve};
use crate::error::Result;
use crate::workers::{WorkerSet, Workers};

/// Smallest and largest number of curves per task: one may be as long as thousands of others.
const MIN_CURVES_PER_TASK: usize = 4;
const MAX_CURVES_PER_TASK: usize = 256;

/// Fits a strand to each curve, with several workers. Results are in the curves' order and do not depend on the number of
/// workers. A curve that cannot be fitted (real grooms have some without length) gets its error, as from [`fit_curve`], and does
/// not affect the others.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::error::Error::InvalidArgument) for options or a number of workers out of range,
/// [`Error::Unsupported`](crate::error::Error::Unsupported) where threads cannot be started. A pool's threads last for the call.
pub fn fit_curves(curves: &[FitCurve<'_>], options: &FitOptions, workers: &Workers) -> Result<Vec<Result<Fit>>> {
    let mut fits = Vec::with_capacity(curves.len());
    fit_each(
        curves.len(),
        options,
        workers,
        |index, scratch| fit_curve(&curves[index], options, scratch),
        |_, fit| fits.push(fit),
    )?;
    Ok(fits)
}

/// The same for curves built one by one: `one` fits the curve of an index, on any worker; `take` receives the results in order,
/// on the calling thread.
///
/// # Errors
/// As [`fit_curves`].
pub fn fit_each<T: Send>(
    count: usize,
    options: &FitOptions,
    workers: &Workers,
    one: impl Fn(usize, &mut FitScratch) -> T + Sync,
    mut take: impl FnMut(usize, T),
) -> Result<()> {
    options.check("options.")?;
    workers.check("workers")?;
    let workers = WorkerSet::<FitScratch>::new(workers)?;
    let mut slots: Vec<(usize, Option<T>)> = (0..count).map(|index| (index, None)).collect();
    workers.for_each_task(&mut slots, MIN_CURVES_PER_TASK, MAX_CURVES_PER_TASK, |slots, scratch| {
        for (index, slot) in slots {
            *slot = Some(one(*index, scratch));
        }
    });
    for (index, slot) in slots {
        if let Some(fit) = slot {
            take(index, fit);
        }
    }
    Ok(())
}
