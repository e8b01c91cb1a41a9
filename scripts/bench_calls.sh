#!/usr/bin/env bash
# The cost of a call through the C++ and the C# binding beside the same call from C, on one thread: the tables of docs/reference/cpp.md and docs/reference/csharp.md.
# Environment: SUPERHELIX_BUILD, a folder with lib/ and include/; else scripts/build_lib.sh, into build.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ -z "${SUPERHELIX_BUILD:-}" ]; then
  SUPERHELIX_BUILD=build
  scripts/build_lib.sh
fi
library=$(cd "$SUPERHELIX_BUILD/lib" && pwd)
headers=$(cd "$SUPERHELIX_BUILD/include" && pwd)
out=build/bench_calls
mkdir -p "$out"
link=(-L"$library" -lsuperhelix -Wl,-rpath,"$library")
c++ -std=c++17 -O2 -Ibindings/cpp/include -I"$headers" bindings/cpp/bench_calls.cpp -o "$out/cpp" "${link[@]}"
find bindings/csharp/com.superhelix.hair/Runtime -name '*.cs' -print0 |
  xargs -0 mcs -unsafe -optimize+ -langversion:7.2 -out:"$out/bench.exe" bindings/csharp/BenchCalls.cs

printf '%-16s %12s %12s %12s %8s %8s\n' call "C, s" "C++, s" "C#, s" C++/C C#/C
while read -r what count calls; do
  rm -f "$out"/times.*
  # Taken in turns, so that what else the machine does meets all of them.
  for _ in 1 2 3 4 5 6; do
    "$out/cpp" "$what" "$count" "$calls" 5 >>"$out/times.cpp"
    LD_LIBRARY_PATH=$library mono "$out/bench.exe" "$what" "$count" "$calls" 5 >>"$out/times.cs"
  done
  paste -d ' ' "$out/times.cpp" "$out/times.cs" | awk -v call="$what $count" '
    { for (i = 1; i <= 3; i++) if (NR == 1 || $i < best[i]) best[i] = $i }
    END { printf "%-16s %12.3e %12.3e %12.3e %8.3f %8.3f\n", call, best[1], best[2], best[3], best[2] / best[1], best[3] / best[1] }'
done <<'CALLS'
count 1 200000
step 1 20000
step 100 300
step 10000 3
sample 150000 5
CALLS
