#!/usr/bin/env bash
# The first program of a stranger in each language, from nothing: a fresh clone of this repository, nothing compiled, a fresh prefix and a fresh Python
# environment. Prints what each way took and the last line of what its program printed: the table of docs/reference/install.md.
# Usage: scripts/first_programs.sh [FOLDER]; the clone and all that it makes go there (default: a new folder under /tmp), which is kept.
set -euo pipefail
cd "$(dirname "$0")/.."

source=$PWD
work=${1:-$(mktemp -d)}
mkdir -p "$work"
work=$(cd "$work" && pwd)
unset CARGO_TARGET_DIR SHX_BUILD_DIR SUPERHELIX_LIBRARY
git clone --quiet "$source" "$work/superhelix"
cd "$work/superhelix"
prefix=$work/prefix

# way NAME FUNCTION: runs it in a shell of its own, and prints its time and what it printed last.
way() {
  local begin end
  begin=$(date +%s%N)
  bash -euo pipefail -c "$2" >"$work/$2.log" 2>&1 || { echo "$1: FAILED, see $work/$2.log" >&2; exit 1; }
  end=$(date +%s%N)
  printf '| %s | %s | %s |\n' "$1" "$(awk "BEGIN { printf \"%.1f\", ($end - $begin) / 1e9 }")" "$(tail -n 1 "$work/$2.log")"
}

library() {
  make lib
  make install PREFIX="$prefix"
}
c_pkg_config() {
  export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
  cc examples_c/hello.c -o "$work/hello" $(pkg-config --cflags --libs superhelix) -Wl,-rpath,"$prefix/lib"
  "$work/hello"
}
c_cmake() {
  cmake -S examples_c -B "$work/c_cmake" -DCMAKE_PREFIX_PATH="$prefix"
  cmake --build "$work/c_cmake" --target hello
  "$work/c_cmake/hello"
}
cpp_cmake() {
  cmake -S bindings/cpp/examples -B "$work/cpp_cmake" -DCMAKE_PREFIX_PATH="$prefix"
  cmake --build "$work/cpp_cmake" --target hello
  "$work/cpp_cmake/hello"
}
cpp_fetch_content() {
  mkdir -p "$work/fetch"
  cat >"$work/fetch/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.16)
project(first CXX)
include(FetchContent)
FetchContent_Declare(superhelix SOURCE_DIR $work/superhelix)
FetchContent_MakeAvailable(superhelix)
add_executable(first $work/superhelix/bindings/cpp/examples/hello.cpp)
target_compile_features(first PRIVATE cxx_std_17)
target_link_libraries(first PRIVATE superhelix::superhelix)
CMAKE
  cmake -S "$work/fetch" -B "$work/fetch/build"
  cmake --build "$work/fetch/build"
  "$work/fetch/build/first"
}
python_pip() {
  python3 -m venv "$work/venv"
  "$work/venv/bin/pip" install ./bindings/python
  "$work/venv/bin/python" bindings/python/examples/hello.py
}
csharp_mono() {
  find bindings/csharp/com.superhelix.hair/Runtime -name '*.cs' -print0 |
    xargs -0 mcs -unsafe -langversion:7.2 -target:library -out:"$work/Superhelix.dll"
  mcs -r:"$work/Superhelix.dll" -out:"$work/Hello.exe" bindings/csharp/examples/Hello.cs
  LD_LIBRARY_PATH=$prefix/lib mono "$work/Hello.exe"
}
wasm_node() {
  make wasm
  node examples_wasm/hello.mjs build/wasm/superhelix.wasm
}

export work prefix
export -f library c_pkg_config c_cmake cpp_cmake cpp_fetch_content python_pip csharp_mono wasm_node
echo '| way | seconds | it printed last |'
echo '|---|---|---|'
way 'the library: `make lib`, `make install`' library
way 'C, pkg-config' c_pkg_config
way 'C, CMake' c_cmake
way 'C++, CMake' cpp_cmake
way 'C++, FetchContent' cpp_fetch_content
way 'Python, `pip install ./bindings/python`' python_pip
way 'C#, mono' csharp_mono
way 'WebAssembly, node' wasm_node
