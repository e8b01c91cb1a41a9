//! Files of grooms, meshes, motions and caches, good and bad ones.

mod alembic;
mod hair;
mod motion;
#[path = "../numpy/mod.rs"]
mod numpy;
mod obj;
mod obj_mesh;
mod sequence;
mod strand_attributes;
mod strand_data;
mod tfx;
mod usd_mesh;
mod usda;
