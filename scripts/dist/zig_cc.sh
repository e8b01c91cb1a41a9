#!/usr/bin/env bash
# A linker for rustc that links against an old C library: zig's, of the version SHX_GLIBC, default 2.17. SHX_PYTHON is a Python that
# has the package ziglang.
set -euo pipefail

arguments=()
for argument in "$@"; do
  case $argument in
    # The unwinder that every system has: zig would link one of its own in.
    -lgcc_s) arguments+=("$(gcc -print-file-name=libgcc_s.so.1)") ;;
    *) arguments+=("$argument") ;;
  esac
done
exec "${SHX_PYTHON:-python3}" -m ziglang cc -target "$(uname -m)-linux-gnu.${SHX_GLIBC:-2.17}" "${arguments[@]}"
