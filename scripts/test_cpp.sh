#!/usr/bin/env bash
# Tests the C++ binding: generated headers, warnings in C++17 and C++20, exceptions, results, no exceptions, sanitizers, every C function called, the
# examples, a game loop on a real groom among them, the code of docs/reference/cpp.md. Environment: SUPERHELIX_BUILD (scripts/test_library.sh); CXX, the compiler,
# default c++.
set -euo pipefail
cd "$(dirname "$0")/.."

. scripts/test_library.sh
out=build/cpp
mkdir -p "$out/files"

python3 bindings/cpp/generate.py --check

compile() { # compile NAME SOURCES AND FLAGS ...
  local name=$1
  shift
  "${CXX:-c++}" -g -Wall -Wextra -Wpedantic -Werror -Ibindings/cpp/include -I"$headers" "$@" -o "$out/$name" \
    -L"$library" -lsuperhelix -Wl,-rpath,"$library" -pthread
}
tests=bindings/cpp/tests
sanitize=(-fsanitize=address,undefined -fno-sanitize-recover=all)
# The guide's code, as one program.
{
  printf '#undef NDEBUG\n#include <superhelix/superhelix.hpp>\n#include <cassert>\n#include <thread>\nint main() {\n'
  sed -n '/^```cpp$/,/^```$/{/^```/d;p}' docs/reference/cpp.md
  printf '}\n'
} >"$out/guide.cpp"
# Two at a time: a name each, then how it is compiled.
builds=(
  "tests17 -std=c++17 $tests/main.cpp"
  "tests20 -std=c++20 $tests/main.cpp"
  "results -std=c++17 -DSUPERHELIX_USE_RESULTS=1 ${sanitize[*]} $tests/main.cpp"
  "no_exceptions -std=c++17 -fno-exceptions $tests/main.cpp"
  "sanitized -std=c++17 ${sanitize[*]} $tests/main.cpp"
  "guide -std=c++17 ${sanitize[*]} $out/guide.cpp"
  "mixed -std=c++17 $tests/mixed/exceptions.cpp $tests/mixed/results.cpp"
  "hello -std=c++17 bindings/cpp/examples/hello.cpp"
  "game_loop -std=c++17 -O1 bindings/cpp/examples/hair_component.cpp bindings/cpp/examples/game_loop.cpp"
)
# Every header stands by itself.
for header in bindings/cpp/include/superhelix/*.hpp bindings/cpp/include/superhelix/solver/*.hpp; do
  builds+=("header.o -std=c++17 -fsyntax-only -include $header -x c++ /dev/null")
done
export -f compile
export out headers library
printf '%s\n' "${builds[@]}" | xargs -P 2 -d '\n' -I{} bash -euo pipefail -c 'compile {}'

for program in tests17 tests20 results no_exceptions sanitized; do
  "$out/$program" "$out/files"
done
"$out/mixed"
"$out/guide"
prints_as_c "$out" "$out/hello"

# Inline functions are compiled where they are called: what the tests link is what they call.
nm -u "$out/tests17" | sed -n 's/^ *U \(shx_[a-z0-9_]*\).*/\1/p' | LC_ALL=C sort >"$out/called.txt"
nm -D --defined-only "$library/libsuperhelix.so" | awk '{ print $3 }' | LC_ALL=C sort >"$out/exported.txt"
diff "$out/called.txt" "$out/exported.txt" || { echo "test_cpp.sh: the tests do not call these functions" >&2; exit 1; }

data=tests/data/grooms
"$out/game_loop" "$data/sintel_hair_001.tfx" "$data/sintel_bust.obj" "$data/walk_figure8_head.csv" 1 | tee "$out/game_loop.txt"
grep -q "^228 guides, 4000 render strands" "$out/game_loop.txt"
grep -q " 0 quarantined" "$out/game_loop.txt"
