//! The C library as the tests link it (`SHX_PROFILE=test scripts/build_lib.sh`): the crate that `cargo test` has compiled, with the allocator
//! that the C libraries have, and nothing else.

use superhelix::internals::capi::base::allocator::HostAllocator;

#[global_allocator]
static GLOBAL: HostAllocator = HostAllocator;
