//! The C library as the tests link it (`SHX_PROFILE=test scripts/build_lib.sh`): the crate that `cargo test` has compiled, and nothing else.

extern crate superhelix as _;
