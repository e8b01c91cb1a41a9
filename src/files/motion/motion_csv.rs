//! A motion as a table: one sample per line under the header `time_s,px_m,py_m,pz_m,qw,qx,qy,qz`.

use crate::error::{Error, Result};
use crate::files::io::text::{Quote, Text, number};
use crate::math::frame::Frame;

/// The first line.
const HEADER: &str = "time_s,px_m,py_m,pz_m,qw,qx,qy,qz";

/// Reads times (s), strictly increasing, and poses (m).
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<(Vec<f64>, Vec<Frame>)> {
    let mut text = Text::new(name, bytes);
    match text.next_line()? {
        Some((_, header)) if header.trim() == HEADER => {}
        Some((line, header)) => {
            return Err(text.error(line, format_args!("{}; expected the header \"{HEADER}\"", Quote(header))));
        }
        None => return Err(Error::file(name, format_args!("is empty; expected the header \"{HEADER}\""))),
    }
    let columns: Vec<&str> = HEADER.split(',').collect();
    let mut times: Vec<f64> = Vec::new();
    let mut frames = Vec::new();
    while let Some((line, content)) = text.next_full_line()? {
        let fields = content.split(',').count();
        if fields != columns.len() {
            return Err(text.error(line, format_args!("{fields} numbers; expected {}: {HEADER}", columns.len())));
        }
        let mut row = [0.0; 8];
        for ((value, word), column) in row.iter_mut().zip(content.split(',')).zip(&columns) {
            *value = number(&text, line, column, word.trim())?;
        }
        let [time, px, py, pz, qw, qx, qy, qz] = row;
        if let Some(before) = times.last()
            && time <= *before
        {
            return Err(text.error(line, format_args!("time_s is {time}; expected more than {before}, the one before")));
        }
        let frame = Frame::from_arrays("the sample", [px, py, pz], [qx, qy, qz, qw]).map_err(|error| text.error(line, error))?;
        times.push(time);
        frames.push(frame);
    }
    if times.is_empty() {
        return Err(Error::file(name, "has no samples under its header"));
    }
    Ok((times, frames))
}
