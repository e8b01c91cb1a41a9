#!/usr/bin/env bash
# Wants a shared library to need no later C library than a version, and prints the version it needs. Usage: glibc.sh LIBRARY [VERSION]
set -euo pipefail

newest=$(objdump -T "$1" | grep -o 'GLIBC_[0-9.]*' | sort -u -V | tail -n 1)
newest=${newest#GLIBC_}
if [ -z "$newest" ]; then
  echo "glibc.sh: $1 names no version of the C library" >&2
  exit 1
fi
if [ -n "${2:-}" ] && [ "$(printf '%s\n' "$newest" "$2" | sort -V | tail -n 1)" != "$2" ]; then
  echo "glibc.sh: $1 needs glibc $newest, later than $2:" >&2
  objdump -T "$1" | grep "GLIBC_$newest" >&2
  exit 1
fi
echo "$newest"
