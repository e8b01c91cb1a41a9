//! tfx_binary
