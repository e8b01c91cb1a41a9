//! tfx_text
