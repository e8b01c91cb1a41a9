#!/usr/bin/env bash
# Counts instructions by callgrind: of an element's step with three Newton iterations, and of one more iteration, into
# docs/figures/instructions.csv. Counts do not depend on what else the machine does, and not on the machine, but on the compiler.
# Valgrind knows no AVX-512: the sets counted are those below it.
#   scripts/instructions.sh [FILE]
#   INSTRUCTIONS_CHECK=1   compares with the committed file instead and fails where a count grew by more than a tenth; another compiler
#                          than the file's is no failure, and nothing is compared then
set -euo pipefail
cd "$(dirname "$0")/.."
file=${1:-docs/figures/instructions.csv}

# The test harness's way to say where the program is.
program=$(cargo bench --locked --profile demo --bench performance --no-run --message-format=json 2>/dev/null |
  sed -n 's/.*"name":"performance".*"executable":"\([^"]*\)".*/\1/p' | tail -n 1)
[ -n "$program" ] || { echo "instructions.sh: the program was not built" >&2; exit 1; }

counted() { # counted STEPS N PRECISION SET ITERATIONS: instructions, and iterations that the steps took
  local log
  if ! log=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" --steps "$@" 2>&1); then
    echo "$log" >&2
    return 1
  fi
  echo "$(sed -n 's/.*Collected : \([0-9]*\).*/\1/p' <<<"$log") $(grep -E '^[0-9]+$' <<<"$log")"
}

# Two runs that differ in their number of steps: what starting costs falls out.
between() { # between N PRECISION SET ITERATIONS
  local few many
  few=$(counted 2 "$@")
  many=$(counted 6 "$@")
  echo "$((${many% *} - ${few% *})) $((${many#* } - ${few#* }))"
}

compiler=$(rustc --version)
{
  echo "set,precision,elements,per_element_step,per_element_iteration,compiler"
  for set in scalar baseline avx2; do
    for precision in f64 f32; do
      for elements in 5 10 50; do
        three=$(between "$elements" "$precision" "$set" 3)
        seven=$(between "$elements" "$precision" "$set" 7)
        # 16 strands, 4 steps; iterations are means over the strands.
        awk -v a="${three% *}" -v b="${seven% *}" -v i="${three#* }" -v j="${seven#* }" -v n="$elements" -v s="$set" -v p="$precision" \
          -v c="$compiler" 'BEGIN { printf "%s,%s,%d,%.0f,%.0f,%s\n", s, p, n, a / (64 * n), (b - a) / (16 * n * (j - i)), c }'
      done
    done
  done
} >"$file.new"

if [ -z "${INSTRUCTIONS_CHECK:-}" ]; then
  mv "$file.new" "$file"
  column -s, -t "$file"
  exit
fi
trap 'rm -f "$file.new"' EXIT
if ! grep -qF "$compiler" "$file"; then
  echo "$file was made by another compiler than $compiler: nothing compared"
  exit
fi
paste -d, "$file" "$file.new" | awk -F, 'NR > 1 {
  for (k = 4; k <= 5; k++) if ($(k + 6) > 1.1 * $k) { printf "%s %s N=%s: %d instructions, committed %d\n", $1, $2, $3, $(k + 6), $k; bad = 1 }
} END { exit bad }'
echo "instruction counts are within a tenth of $file"
