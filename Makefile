# superhelix: what can be made. `make help` lists it.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help

TARGET := $(if $(CARGO_TARGET_DIR),$(CARGO_TARGET_DIR),target)
DATA := tests/data/grooms

.PHONY: help lib install uninstall dist dist-check deb test test-docs docs python test-blender blender blender-pictures hosts godot cpp csharp abi abi-baseline rust-api package wasm platforms demo soak bench contact pictures fit haptics \
	instructions figures tradeoff peers clean

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)$$/make \1\t\2/p' Makefile | expand -t 16

lib: ## the shared and the static library, the header and superhelix.pc, into build/
	@scripts/setup.sh build
	scripts/build_lib.sh
	@echo "build/lib/libsuperhelix.so, build/lib/libsuperhelix.a, build/include/superhelix.h"

# scripts/install.sh reads these from the environment.
export PREFIX LIBDIR INCLUDEDIR CMAKEDIR DESTDIR
install: ## what `make lib` built, into PREFIX (default /usr/local; LIBDIR, INCLUDEDIR, CMAKEDIR, DESTDIR: docs/reference/install.md)
	@[ -f $${SHX_BUILD_DIR:-build}/lib/pkgconfig/superhelix.pc ] || $(MAKE) lib
	scripts/install.sh

uninstall: ## removes it, with the same variables
	scripts/install.sh --uninstall

dist: ## the release archive, against an old C library, with licences and a bill of materials: out/dist/
	@scripts/setup.sh dist
	scripts/dist/archive.sh

dist-check: dist ## the archive, and Debian packages where there is dpkg, unpacked; programs built against them and run
	@scripts/setup.sh test
	if command -v dpkg-deb >/dev/null; then scripts/dist/debian.sh; fi
	scripts/dist/check.sh

deb: dist ## Debian packages of the release: out/dist/*.deb
	scripts/dist/debian.sh

test: ## everything: format, lints, documentation, tests in Rust, C and of all bindings, examples (about three quarters of an hour on two cores, with nothing compiled)
	@scripts/setup.sh test python csharp
	cargo fmt --check
	scripts/lint_python.sh
	cargo clippy --locked --all-targets --all-features -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --locked --no-deps --all-features
	scripts/rust_api.sh
	scripts/package.sh
	cargo test --locked --all-features
	scripts/test_python.sh
	scripts/test_blender.sh core
	scripts/test_cpp.sh
	scripts/test_csharp.sh
	scripts/test_godot.sh
	scripts/test_docs.sh
	$(MAKE) --no-print-directory abi wasm
	SHX_PROFILE=test DIST=$(TARGET)/dist $(MAKE) dist-check

docs: ## the pages as a site with search, and the C header's reference: build/docs/ (mdBook is compiled once: five minutes)
	@scripts/setup.sh figures
	scripts/docs/build.sh

test-docs: ## the pages alone: links and anchors, what folders of src say they hold, the code of the pages compiled and run (a minute)
	@scripts/setup.sh test python csharp
	scripts/test_docs.sh

cpp: ## the tests of the C++ binding alone: C++17 and C++20, with and without exceptions, sanitizers, the game loop (a minute)
	@scripts/setup.sh test python
	scripts/test_cpp.sh

csharp: ## the tests of the C# binding alone, under mono: arrays, spans, the Unity component and its package (half a minute)
	@scripts/setup.sh test csharp
	scripts/test_csharp.sh

python: ## the tests of the Python binding alone: lints, types, pytest, the guide's examples, an installed wheel (two minutes)
	@scripts/setup.sh test python
	scripts/lint_python.sh
	scripts/test_python.sh

test-blender: ## the Blender extension in Blender as a Python module, which pip installs (1 GB, once): a real groom, bakes, errors, the .zip installed (two minutes)
	@scripts/setup.sh test python
	scripts/test_blender.sh

blender: ## the Blender extension as a .zip for this platform: out/blender/
	@scripts/setup.sh build python
	python3 bindings/blender/pack.py

blender-pictures: ## the pictures of the Blender guide, by the extension and Cycles: docs/figures/blender_*.jpg (half an hour; says so where pip has no Blender)
	@scripts/setup.sh test python
	scripts/blender_pictures.sh

hosts: ## how long each host takes from nothing to hair: out/hosts/, docs/figures/hosts.csv (half an hour; with Blender, 2 GB; HOSTS="python usd": some)
	@scripts/setup.sh build python csharp
	scripts/hosts.sh $(HOSTS)

godot: ## the host of Godot 3 in C, compiled and tested in the engine under a virtual display: 20,000 lit strands on a head that turns (a minute); says so where it is skipped
	@scripts/setup.sh build python
	scripts/test_godot.sh

abi: ## the binary interface against its baseline (docs/reference/abi.md)
	@scripts/setup.sh abi
	python3 abi/test_abi.py
	python3 abi/abi.py check
	python3 abi/abi.py abidiff

rust-api: ## the public Rust interface against its text, abi/rust.txt (scripts/rust_api.sh --bless writes it); says so where it is skipped
	scripts/rust_api.sh

package: ## what crates.io would get: that nothing is missing, and that it compiles
	scripts/package.sh

abi-baseline: ## makes the present header and the present examples what later ones are held to
	python3 abi/abi.py baseline

wasm: ## the library as WebAssembly, and the golden hashes under node (docs/reference/platforms.md); says so where it is skipped
	@scripts/setup.sh wasm
	scripts/wasm.sh

platforms: ## what can be checked here for Windows and macOS: compiled for both, linked for Windows and run under wine; says so where it is skipped
	@scripts/setup.sh platforms
	scripts/platforms.sh

# The profile `demo` compiles in a third of the time of `release` and runs nearly as fast.
demo: ## a head of hair on a recorded walk, hosted by a C program, drawn lit: out/demo/ holds an animation, a contact sheet, the frames (under 3 minutes)
	@scripts/setup.sh build
	scripts/demo.sh

soak: ## strands from the whole space for a million strand-seconds (docs/theory/extremes.md), bodies thrown through hair for 100000 steps, a million strokes of hands, and the randomised tests with 100000 cases each (an hour)
	@scripts/setup.sh test
	EXTREMES_CASES=$${EXTREMES_CASES:-12000} EXTREMES_LONG=$${EXTREMES_LONG:-7500} EXTREMES_CSV="$(CURDIR)/docs/figures" \
	  cargo test --locked --profile demo --test extremes -- --nocapture
	CONTACT_SOAK_STEPS=$${CONTACT_SOAK_STEPS:-100000} cargo test --locked --profile demo --test contact_soak -- --nocapture
	SUPERHELIX_STROKES=$${SUPERHELIX_STROKES:-1000000} SUPERHELIX_HAIR_STROKES=$${SUPERHELIX_HAIR_STROKES:-500} \
	  cargo test --locked --profile demo --test haptics passivity:: -- --nocapture
	PROPTEST_CASES=$${PROPTEST_CASES:-100000} cargo test --locked --all-features --test kernels --test files_fuzz --test integrators -- \
	  kernel_mathematics:: pose_spline:: readers_survive_anything_and_ask_for_little hard_cases:: --nocapture

bench: ## what the engine costs: every table of docs/notebook/performance.md, the costs that were asked for first (under 10 minutes)
	@scripts/setup.sh build figures
	scripts/bench.sh

contact: ## what contact costs and errs by, a thousand guides on a shaken head: the tables of docs/notebook/contact.md, and a head that walks (a quarter of an hour; CONTACT_QUICK=yes: a try)
	@scripts/setup.sh build figures
	scripts/bench_contact.sh

pictures: ## the pictures of docs/ and README: scenes with contact (docs/figures/contact_*.png), and where pip has Mitsuba those that it path-traces (docs/figures/*.jpg; a quarter of an hour)
	@scripts/setup.sh build figures
	scripts/contact_figures.sh
	scripts/path_traced.sh

fit: ## how close strands come to real grooms: the tables of docs/notebook/groom_fit.md and how still they lie (GROOMS=directory of .hair, .tfx, .usda and .data, also .gz; a few minutes)
	@scripts/setup.sh build figures
	scripts/groom_fit.sh

instructions: ## instructions an element costs, by callgrind: docs/figures/instructions.csv (INSTRUCTIONS_CHECK=1 compares with it)
	@scripts/setup.sh test
	scripts/instructions.sh

haptics: ## a comb in a hand: the tables and figures of docs/notebook/haptics.md, partly in real time (10 minutes; wants two free cores)
	@scripts/setup.sh build figures
	scripts/haptics.sh

figures: ## every figure and table of docs/, from their programs
	@scripts/setup.sh build figures
	scripts/figures.sh

tradeoff: ## what accuracy costs: docs/notebook/tradeoff.md, its figures, and src/analysis/measured.rs (about half an hour of one core)
	@scripts/setup.sh build figures
	scripts/tradeoff.sh

peers: ## beside pyPBD, MuJoCo and PyElastica: docs/notebook/peers.md and its figures (under a quarter of an hour; PEERS_QUICK=yes: a try)
	@scripts/setup.sh build figures
	scripts/peers.sh

clean: ## removes what the targets above made (not the figures, which are part of docs/)
	rm -rf build out
	cargo clean
