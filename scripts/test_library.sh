# What the tests of the bindings begin with; sourced by scripts/test_*.sh. Sets `library` and `headers`, the folders of the library under test and of its
# header. Environment:
#   SUPERHELIX_BUILD   a folder with lib/ and include/ to test; else SHX_PROFILE=test scripts/build_lib.sh, into build/test

if [ -z "${SUPERHELIX_BUILD:-}" ]; then
  SUPERHELIX_BUILD=build/test
  SHX_PROFILE=test SHX_BUILD_DIR=$SUPERHELIX_BUILD scripts/build_lib.sh
fi
library=$(cd "$SUPERHELIX_BUILD/lib" && pwd)
headers=$(cd "$SUPERHELIX_BUILD/include" && pwd)

# build_binary: the `superhelix` of `cargo test`. With an example beside it, the dependencies have the features that they have for tests: else cargo
# compiles the library a second time.
build_binary() {
  cargo build --quiet --locked --all-features --lib --bin superhelix --example c_library
}

# prints_as_c FOLDER COMMAND ...: the command is examples_c/hello.c in another language, and prints the same.
prints_as_c() {
  local folder=$1
  shift
  mkdir -p "$folder"
  cc -std=c99 -I"$headers" examples_c/hello.c -o "$folder/hello_c" -L"$library" -lsuperhelix -Wl,-rpath,"$library"
  "$folder/hello_c" >"$folder/hello_c.txt"
  "$@" | diff "$folder/hello_c.txt" - || { echo "$0: $* does not print what examples_c/hello.c prints" >&2; return 1; }
  tail -n 1 "$folder/hello_c.txt"
}
