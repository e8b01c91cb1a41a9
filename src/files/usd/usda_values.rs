//! Attributes of a USD text file: a value, values over time, or both.

use super::usda_scan::Scan;
use crate::error::{Error, Result};

/// How many values a curve has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::files) enum Interpolation {
    /// One for all curves.
    Constant,
    /// One per curve.
    Uniform,
    /// One at each end of a span.
    Varying,
    /// One per control point, or per vertex of a mesh.
    Vertex,
    /// One per corner of each face of a mesh; for curves the same as one per control point.
    FaceVarying,
}

/// The values of an attribute over time. An empty attribute allocates nothing.
#[derive(Debug, Clone)]
pub(in crate::files) struct Attribute<T> {
    default: Option<T>,
    /// Times, ascending, and values; `None` means no value from here on.
    samples: Vec<(f64, Option<T>)>,
    /// The file's choice, if it makes one.
    pub interpolation: Option<Interpolation>,
}

impl<T> Default for Attribute<T> {
    fn default() -> Self {
        Self { default: None, samples: Vec::new(), interpolation: None }
    }
}

impl<T> Attribute<T> {
    /// Reads the value of a statement `name = value` or, with `over_time`, `name.timeSamples = { time: value, ... }`.
    pub fn read(&mut self, scan: &mut Scan<'_>, over_time: bool, read: impl Fn(&mut Scan<'_>) -> Result<T>) -> Result<()> {
        let one = |scan: &mut Scan<'_>| if scan.accept_none() { Ok(None) } else { read(scan).map(Some) };
        if !over_time {
            self.default = one(scan)?;
            return Ok(());
        }
        self.samples.clear();
        scan.expect(b'{', "before time samples")?;
        while !scan.accept(b'}') {
            let time = scan.double("a time")?;
            scan.expect(b':', "after a time")?;
            let value = one(scan)?;
            if self.samples.len() == self.samples.capacity() {
                self.samples.try_reserve(1).map_err(|_| Error::OutOfMemory { bytes: size_of::<(f64, Option<T>)>() })?;
            }
            self.samples.push((time, value));
            if !scan.accept(b',') {
                scan.expect(b'}', "after time samples")?;
                break;
            }
        }
        self.samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        match self.samples.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            Some(pair) => Err(scan.error(format_args!("time {} is sampled twice", pair[0].0))),
            None => Ok(()),
        }
    }

    /// The times of its samples.
    pub fn times(&self) -> impl Iterator<Item = f64> + '_ {
        self.samples.iter().map(|(time, _)| *time)
    }

    /// The value at a time: that of the last sample not after it; before all samples that of the first; without samples the
    /// default.
    pub fn at(&self, time: f64) -> Option<&T> {
        match self.samples.partition_point(|(sample, _)| *sample <= time) {
            0 => self.samples.first().map_or(self.default.as_ref(), |(_, value)| value.as_ref()),
            after => self.samples[after - 1].1.as_ref(),
        }
    }

    /// The samples around a time between two present samples, and how far it is from the first to the second.
    pub fn between(&self, time: f64) -> Option<(&T, &T, f64)> {
        let after = self.samples.partition_point(|(sample, _)| *sample <= time);
        if after == 0 || after == self.samples.len() || self.samples[after - 1].0 == time {
            return None;
        }
        let ((begin, first), (end, second)) = (&self.samples[after - 1], &self.samples[after]);
        Some((first.as_ref()?, second.as_ref()?, (time - begin) / (end - begin)))
    }
}

impl<T: PartialEq> Attribute<T> {
    /// Whether all its samples are equal.
    pub fn stands_still(&self) -> bool {
        self.samples.windows(2).all(|pair| pair[0].1 == pair[1].1)
    }
}

impl<const N: usize> Attribute<Vec<[f32; N]>> {
    /// The vectors at a time, interpolated linearly between two samples of equal length.
    pub fn vectors_at(&self, time: f64) -> Option<Vec<[f32; N]>> {
        match self.between(time) {
            Some((before, after, fraction)) if before.len() == after.len() => {
                let mix = |a: f32, b: f32| (f64::from(a) + (f64::from(b) - f64::from(a)) * fraction) as f32;
                let pairs = before.iter().zip(after);
                Some(pairs.map(|(a, b)| std::array::from_fn(|axis| mix(a[axis], b[axis]))).collect())
            }
            _ => self.at(time).cloned(),
        }
    }
}

/// The entries of a primvar in their order, or the index without an entry.
pub(super) fn indexed<T: Copy>(values: Option<&Vec<T>>, indices: Option<&Vec<u32>>) -> std::result::Result<Option<Vec<T>>, u32> {
    match (values, indices) {
        (None, _) => Ok(None),
        (Some(values), None) => Ok(Some(values.clone())),
        (Some(values), Some(indices)) => indices
            .iter()
            .map(|index| values.get(*index as usize).copied().ok_or(*index))
            .collect::<std::result::Result<_, _>>()
            .map(Some),
    }
}

/// Appends to a list, or reports that memory ran out.
fn push<T>(list: &mut Vec<T>, item: T) -> Result<()> {
    if list.len() == list.capacity() {
        list.try_reserve(1).map_err(|_| Error::OutOfMemory { bytes: 2 * list.len() * size_of::<T>() })?;
    }
    list.push(item);
    Ok(())
}

/// `[a, b, ...]`.
pub(super) fn list<T>(scan: &mut Scan<'_>, what: &str, read: impl Fn(&mut Scan<'_>) -> Result<T>) -> Result<Vec<T>> {
    scan.expect(b'[', format_args!("before {what}"))?;
    let mut items = Vec::new();
    while !scan.accept(b']') {
        push(&mut items, read(scan)?)?;
        if !scan.accept(b',') {
            scan.expect(b']', format_args!("after {what} {}", items.len() - 1))?;
            break;
        }
    }
    Ok(items)
}

/// `(a, b, c)`.
pub(super) fn tuple<const N: usize>(scan: &mut Scan<'_>, what: &str) -> Result<[f32; N]> {
    scan.expect(b'(', format_args!("before {what}"))?;
    let mut values = [0.0; N];
    for (index, value) in values.iter_mut().enumerate() {
        if index > 0 {
            scan.expect(b',', format_args!("between the {N} numbers of {what}"))?;
        }
        *value = scan.single(what)?;
    }
    scan.expect(b')', format_args!("after the {N} numbers of {what}"))?;
    Ok(values)
}

/// All numbers of any nesting: `1`, `(1, 2, 3)`, `((1, 0), (0, 1))`; at most `most`.
pub(super) fn flat(scan: &mut Scan<'_>, what: &str, most: usize) -> Result<Vec<f64>> {
    let (mut values, mut depth) = (Vec::new(), 0_usize);
    loop {
        if scan.accept(b'(') {
            depth += 1;
            continue;
        }
        values.push(scan.double(what)?);
        if values.len() > most {
            return Err(scan.error(format_args!("{what} has more than {most} numbers")));
        }
        while depth > 0 && scan.accept(b')') {
            depth -= 1;
        }
        if depth == 0 {
            return Ok(values);
        }
        scan.expect(b',', format_args!("between the numbers of {what}"))?;
    }
}
