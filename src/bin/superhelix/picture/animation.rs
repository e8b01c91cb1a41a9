//! Animated PNG: what a browser plays, and what shows its first frame where animation is not known.

use std::io::Write;

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Writer};
use tiny_skia::Pixmap;

/// Most frames a second: delays are written in hundredths of one.
pub const MAX_PER_SECOND: f64 = 600.0;

/// An animation on its way into a file.
pub struct Animation<W: Write> {
    writer: Writer<W>,
}

impl<W: Write> Animation<W> {
    /// Of so many frames of a size (pixels), so many a second (0.01 to [`MAX_PER_SECOND`]), played again and again.
    pub fn new(file: W, size: [u32; 2], frames: u32, per_second: f64) -> Result<Self, EncodingError> {
        let mut encoder = Encoder::new(file, size[0], size[1]);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Balanced);
        encoder.set_animated(frames, 0)?;
        encoder.set_frame_delay(100, (100.0 * per_second).round() as u16)?;
        Ok(Self { writer: encoder.write_header()? })
    }

    /// Adds a frame, which has the animation's size and no transparency.
    pub fn add(&mut self, frame: &Pixmap) -> Result<(), EncodingError> {
        let bytes: Vec<u8> = frame.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
        self.writer.write_image_data(&bytes)
    }

    /// Ends the file, which must have all its frames.
    pub fn finish(self) -> Result<(), EncodingError> {
        self.writer.finish()
    }
}
