//! A recorded curve as a table: `time_s`, one measured column, and the root's position if it was recorded.

use std::path::Path;

use nalgebra::Vector3;

use super::io::bytes;
use super::io::text::{Quote, Text, number};
use crate::error::{Error, Result};

/// What the measured column holds; its name is in the header.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measured {
    /// `span_m`: distance from root to tip, m.
    Span,
    /// `depth_m`: depth of the tip below the root, m.
    Depth,
    /// `offset_m`: offset of the tip from the root along a direction, m.
    Offset,
    /// `angle_rad`: the angle of the chord from root to tip against gravity, rad.
    Angle,
}

const MEASURED: [(&str, Measured); 4] =
    [("span_m", Measured::Span), ("depth_m", Measured::Depth), ("offset_m", Measured::Offset), ("angle_rad", Measured::Angle)];
const ROOT: [&str; 3] = ["root_x_m", "root_y_m", "root_z_m"];

/// A recorded curve, as in the file.
///
/// ```
/// use superhelix::io::{Measured, RecordedCurve};
///
/// let curve = RecordedCurve::read_from_bytes("tip.csv", b"time_s,depth_m\n0,0.2\n0.01,0.19\n0.02,0.17\n")?;
/// assert_eq!((curve.times.len(), curve.measured), (3, Measured::Depth));
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedCurve {
    /// Times, s, strictly increasing.
    pub times: Vec<f64>,
    /// One measured value per time.
    pub values: Vec<f64>,
    /// What the values are.
    pub measured: Measured,
    /// The root's position in the world at each time, m, if it was recorded.
    pub root: Option<Vec<Vector3<f64>>>,
}

impl RecordedCurve {
    /// Reads a `.csv` file with the header `time_s`, one of `span_m`, `depth_m`, `offset_m`, `angle_rad`, and optionally
    /// `root_x_m,root_y_m,root_z_m`.
    ///
    /// # Errors
    /// [`Error::File`] with the line number; [`Error::OutOfMemory`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        Self::read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
    }

    /// [`RecordedCurve::read`] from memory. `name` replaces the path in errors.
    ///
    /// # Errors
    /// As [`RecordedCurve::read`].
    pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Self> {
        let mut text = Text::new(name, bytes);
        let expected = "expected the header \"time_s\", one of span_m, depth_m, offset_m, angle_rad, and root_x_m,root_y_m,root_z_m \
                        or nothing more";
        let Some((line, header)) = text.next_line()? else {
            return Err(Error::file(name, format_args!("is empty; {expected}")));
        };
        let columns: Vec<&str> = header.split(',').take(6).map(str::trim).collect();
        let measured = columns.get(1).and_then(|column| MEASURED.iter().find(|(name, _)| name == column));
        let has_root = columns.len() == 5 && columns[2..] == ROOT;
        let (Some((_, measured)), true) = (measured, columns[0] == "time_s" && (has_root || columns.len() == 2)) else {
            return Err(text.error(line, format_args!("{}; {expected}", Quote(header))));
        };
        let (mut times, mut values, mut root) = (Vec::new(), Vec::new(), Vec::new());
        while let Some((line, content)) = text.next_full_line()? {
            let count = content.split(',').count();
            if count != columns.len() {
                return Err(text.error(line, format_args!("{count} numbers; expected {}: {header}", columns.len())));
            }
            let mut row = [0.0; 5];
            for ((value, word), column) in row.iter_mut().zip(content.split(',')).zip(&columns) {
                *value = number(&text, line, column, word.trim())?;
            }
            if let Some(before) = times.last()
                && row[0] <= *before
            {
                return Err(text.error(line, format_args!("time_s is {}; expected more than {before}, the one before", row[0])));
            }
            times.push(row[0]);
            values.push(row[1]);
            if has_root {
                root.push(Vector3::new(row[2], row[3], row[4]));
            }
        }
        if times.is_empty() {
            return Err(Error::file(name, "has no samples under its header"));
        }
        Ok(Self { times, values, measured: *measured, root: has_root.then_some(root) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_with_and_without_the_root_are_read() {
        let curve = RecordedCurve::read_from_bytes("a", b"time_s, span_m\n0,0.1\r\n0.5,2e-1\n\n").unwrap();
        assert_eq!(
            (curve.times, curve.values, curve.measured, curve.root),
            (vec![0.0, 0.5], vec![0.1, 0.2], Measured::Span, None)
        );
        let text = b"time_s,angle_rad,root_x_m,root_y_m,root_z_m\n-1,0.1,1,2,3\n";
        let curve = RecordedCurve::read_from_bytes("a", text).unwrap();
        assert_eq!((curve.measured, curve.root), (Measured::Angle, Some(vec![Vector3::new(1.0, 2.0, 3.0)])));
    }

    #[test]
    fn what_cannot_be_read_is_named_with_its_line() {
        for (text, named) in [
            ("", "is empty"),
            ("span_m,time_s\n0,1\n", "line 1"),
            ("time_s\n0\n", "line 1"),
            ("time_s,span_m,root_x_m\n0,1,2\n", "line 1"),
            ("time_s,span_m,root_x_m,root_z_m,root_y_m\n0,1,2,3,4\n", "line 1"),
            ("time_s,width_m\n0,1\n", "\"time_s,width_m\""),
            ("time_s,span_m\n", "no samples"),
            ("time_s,span_m\n0,1\n1,2,3\n", "line 3: 3 numbers"),
            ("time_s,span_m\n0,1\n1,nan\n", "line 3: span_m"),
            ("time_s,span_m\n0,1\n0,1\n", "line 3: time_s is 0"),
            ("time_s,span_m\n0,1\n1,x\n", "\"x\""),
        ] {
            let error = RecordedCurve::read_from_bytes("name", text.as_bytes()).unwrap_err().to_string();
            assert!(error.starts_with("name") && error.contains(named), "{text:?}: {error}");
        }
        let error = RecordedCurve::read_from_bytes("name", b"time_s,span_m\n0,\xff\n").unwrap_err().to_string();
        assert!(error.contains("UTF-8"), "{error}");
    }
}
