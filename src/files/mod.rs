//! Files: grooms in, motions in, caches out.
