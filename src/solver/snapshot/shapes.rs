//! Static shapes, stored once beside any number of snapshots, each under its content's hash.
//!
//! Layout: "SHXSHAP\0", format version of snapshots (u32), 4 zero bytes, number of shapes (u64); for each shape its hash (16
//! bytes), its size (u64) and its bytes. A shape's hash verifies its bytes.

use std::sync::Arc;

use super::bytes::{Reader, Writer, bad, content_hash};
use super::{SNAPSHOT_VERSION, Solver};
use crate::contact::shape::{Parts, Shape};
use crate::error::Result;
use crate::memory;
use crate::solver::bodies::SceneBody;

const MAGIC: &[u8; 8] = b"SHXSHAP\0";

impl SceneBody {
    /// The hash of a shape that is worth storing separately: meshes, hulls and grids that never deformed.
    pub(super) fn content(&self) -> Option<u128> {
        let shape = &self.body.def().shape;
        let large = matches!(shape.parts(), Parts::Mesh(_) | Parts::Hull(_) | Parts::Grid(_));
        (large && !self.deforms).then(|| *self.content.get_or_init(|| hash_of(shape)))
    }
}

fn hash_of(shape: &Shape) -> u128 {
    let mut writer = Writer::hashing_content();
    writer.shape(shape);
    writer.content_hash()
}

/// A shape in an image of shapes, if present.
pub(super) fn find(image: &[u8], content: u128) -> Result<Option<Arc<Shape>>> {
    let mut reader = Reader { left: image };
    if &reader.take::<8>().map_err(|_| bad("the shapes are too few bytes"))? != MAGIC {
        return Err(bad("the shapes do not begin with SHXSHAP"));
    }
    let version = reader.u32()?;
    if version != SNAPSHOT_VERSION {
        return Err(bad(format!("the shapes are of version {version}; this library reads version {SNAPSHOT_VERSION}")));
    }
    reader.u32()?;
    for _ in 0..reader.count(16 + 8)? {
        let found = u128::from_le_bytes(reader.take()?);
        let size = reader.count(1)?;
        let bytes = reader.bytes(size)?;
        if found != content {
            continue;
        }
        if content_hash(bytes) != content {
            return Err(bad(format!("shape {content:032x} is damaged")));
        }
        memory::check_room(bytes.len().saturating_mul(4))?;
        let mut own = Reader { left: bytes };
        let shape = own.shape()?;
        return if own.left.is_empty() { Ok(Some(Arc::new(shape))) } else { Err(bad("a shape has bytes left over")) };
    }
    Ok(None)
}

impl Solver {
    /// The shapes that snapshots with [`SnapshotShapes::Referenced`](super::SnapshotShapes) refer to, each once: those of meshes,
    /// hulls and grids that never deformed. One image serves all snapshots until a body is added.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::error::Error).
    pub fn snapshot_shapes(&self) -> Result<Vec<u8>> {
        let mut writer = Writer::into(memory::list(self.snapshot_shapes_size())?);
        self.write_shapes(&mut writer);
        Ok(writer.finished())
    }

    /// The size of [`Solver::snapshot_shapes`], bytes, without writing it.
    pub fn snapshot_shapes_size(&self) -> usize {
        let mut writer = Writer::counting();
        self.write_shapes(&mut writer);
        writer.size()
    }

    fn write_shapes(&self, writer: &mut Writer) {
        let mut shapes = std::collections::BTreeMap::new();
        for body in &self.bodies {
            if let Some(content) = body.content() {
                shapes.entry(content).or_insert(&*body.body.def().shape);
            }
        }
        writer.bytes(MAGIC);
        writer.u32(SNAPSHOT_VERSION);
        writer.u32(0);
        writer.u64(shapes.len() as u64);
        for (content, shape) in shapes {
            let mut size = Writer::counting();
            size.shape(shape);
            writer.content(content);
            writer.u64(size.size() as u64);
            writer.shape(shape);
        }
    }

    /// A shape of this solver, by its content.
    pub(super) fn own_shape(&self, content: u128) -> Option<Arc<Shape>> {
        let same = |body: &&SceneBody| body.content() == Some(content);
        self.bodies.iter().find(same).map(|body| body.body.def().shape.clone())
    }
}
