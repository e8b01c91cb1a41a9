//! Files: grooms, meshes, motions and distance grids in; caches of frames in and out.
//!
//! Every reader checks the lengths that a file states against the bytes that are there before it asks for memory. Errors say what was found,
//! where, and what was expected. All functions may be called on any thread.
//!
//! ```
//! use superhelix::io::{CurveCache, CurveCacheWriter, Curves};
//!
//! let directory = std::env::temp_dir().join("superhelix-io-example");
//! std::fs::create_dir_all(&directory).unwrap();
//! let path = directory.join("cache.usda");
//!
//! // Two strands of two points; a second frame in which they have moved.
//! let rest = [[0.0, 0.0, 0.0], [0.0, 0.0, -0.1], [0.1, 0.0, 0.0], [0.1, 0.0, -0.1]];
//! let moved = rest.map(|[x, y, z]: [f32; 3]| [x + 0.02, y, z]);
//! let curves = Curves::from_counts(vec![2, 2], rest.to_vec())?;
//! let mut cache = CurveCacheWriter::create(&path, &curves, 24.0)?;
//! cache.write(0.0, &rest, None)?;
//! cache.write(1.0 / 24.0, &moved, None)?;
//! cache.finish()?;
//!
//! let cache = CurveCache::read(&path)?;
//! assert_eq!(cache.times().len(), 2);
//! assert_eq!(cache.frame(1)?.strand(0)[0], [0.02, 0.0, 0.0]);
//! # Ok::<(), superhelix::Error>(())
//! ```

pub use crate::files::curve_cache::{CurveCache, CurveCacheWriter, time_as_read};
pub use crate::files::curves::{Curves, CurvesFormat, Extras, UpAxis};
pub use crate::files::distance_grid;
pub use crate::files::mesh_cache::MeshCache;
pub use crate::files::motion::{Motion, MotionOptions};
pub use crate::files::recorded_curve::{Measured, RecordedCurve};
pub use crate::files::sequence::{CacheFormat, Existing, Sequence, SequenceWriter};
pub use crate::files::strands::hair::HairHeader;
pub use crate::files::strands::point_strands::StrandsBy;
pub use crate::files::strands::raw_strands::RawStrands;
pub use crate::files::strands::strand_attributes::StrandAttributes;
pub use crate::files::strands::tfx::TfxVersion;
pub use crate::files::strands::{hair, strand_data, tfx};
pub use crate::files::usd::usda;
pub use crate::files::wavefront::obj_mesh::{ObjMesh, Texture};
pub use crate::files::wavefront::{obj, obj_mesh};
