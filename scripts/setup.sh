#!/usr/bin/env bash
# Sees to it that the tools named on the command line are there: installs what is missing by apt-get when run by root on Debian or
# Ubuntu, otherwise says what to install and fails. Usage: scripts/setup.sh build|test|python|csharp|abi|wasm|platforms|figures|dist ...
set -euo pipefail

missing=()
need() { # need COMMAND PACKAGE
  command -v "$1" >/dev/null 2>&1 || missing+=("$2")
}

for part in "$@"; do
  case $part in
    build)
      need cc gcc
      need make make
      need install coreutils
      need objcopy binutils
      ;;
    test)
      need cc gcc
      need c++ g++
      need make make
      need nm binutils
      need readelf binutils
      need cmake cmake
      need pkg-config pkg-config
      # valgrind looks for the C library's symbols when it starts.
      command -v valgrind >/dev/null 2>&1 || missing+=(valgrind libc6-dbg)
      ;;
    csharp)
      need python3 python3
      need mcs mono-mcs
      need mono mono-runtime
      ;;
    abi)
      need cc gcc
      need python3 python3
      need abidiff abigail-tools
      ;;
    wasm)
      need cc gcc
      need node nodejs
      ;;
    platforms)
      need x86_64-w64-mingw32-gcc gcc-mingw-w64-x86-64
      need wine wine
      ;;
    figures | python)
      need python3 python3
      if command -v python3 >/dev/null 2>&1; then
        python3 -c 'import venv, ensurepip' 2>/dev/null || missing+=(python3-venv)
        if [ "$part" = python ] && ! python3 -c 'import sys; sys.exit(sys.version_info < (3, 10))'; then
          echo "setup.sh: Python 3.10 or later is needed, and python3 is $(python3 --version)" >&2
          exit 1
        fi
      fi
      ;;
    dist)
      need objdump binutils
      need python3 python3
      if command -v python3 >/dev/null 2>&1; then
        python3 -c 'import venv, ensurepip' 2>/dev/null || missing+=(python3-venv)
      fi
      ;;
    *)
      echo "setup.sh: unknown part '$part'" >&2
      exit 2
      ;;
  esac
done

if [ ${#missing[@]} -gt 0 ]; then
  if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
    echo "setup.sh: installing ${missing[*]}"
    export DEBIAN_FRONTEND=noninteractive
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends "${missing[@]}" libc6-dev
  else
    echo "setup.sh: please install: ${missing[*]} (Debian: sudo apt-get install ${missing[*]})" >&2
    exit 1
  fi
fi

if ! command -v cargo >/dev/null 2>&1; then
  echo "setup.sh: cargo is missing: install Rust from https://rustup.rs" >&2
  exit 1
fi
for part in "$@"; do
  if [ "$part" = test ]; then
    # rustup's minimal profile comes without these two.
    for component in rustfmt clippy; do
      if ! cargo "${component/rustfmt/fmt}" --version >/dev/null 2>&1; then
        command -v rustup >/dev/null 2>&1 || { echo "setup.sh: $component is missing" >&2; exit 1; }
        rustup component add "$component"
      fi
    done
  fi
done
