//! superhelix in other people's builds: installed under a prefix, moved, found by pkg-config and by CMake, linked shared and static,
//! beside another Rust library, and built from source by CMake. The installed library was linked from what the tests were compiled to
//! (`SHX_PROFILE=test`). Programs are built in a folder outside the repository.
#![cfg(target_os = "linux")]

mod cmake;
mod layout;
mod pkg_config;
mod static_library;
mod support;
