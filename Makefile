# deldrift: `make help` lists what there is. Needed are Rust, make and a C compiler; on Debian the rest is
# installed where it is missing, as root or through sudo.

# quick (bench within ten minutes on two cores, report within ten) or full (report within half an hour)
PRESET ?= quick
PREFIX ?= /usr/local
# Further arguments of cpp-bench/run, as in: make bench ARGS="--series positions.npy",
# make report ARGS="--scenario man", make bench ARGS="--structured", make targets ARGS="--target loop"
ARGS ?=
# What is fuzzed, and for how long.
TARGET ?= calls
SECONDS ?= 60
# How long `make soak` goes on; fractions are allowed.
HOURS ?= 1

# Debian packages that the benchmark is built with.
BENCHMARK_NEEDS := cmake g++ libcgal-dev libcli11-dev libfmt-dev doctest-dev voro++-dev libnanoflann-dev

# ... and the examples.
EXAMPLE_NEEDS := cmake g++ libeigen3-dev

# ... and the page of the report.
PAGE_NEEDS := python3-jinja2 python3-matplotlib

# Where cargo builds, and all others look for the library: one absolute path, CARGO_TARGET_DIR if that is set.
override CARGO_TARGET_DIR := $(or $(CARGO_TARGET_DIR),target)
override CARGO_TARGET_DIR := $(if $(filter /%,$(CARGO_TARGET_DIR)),,$(CURDIR)/)$(CARGO_TARGET_DIR)
export CARGO_TARGET_DIR
# Where rustup puts cargo, for shells that do not know.
export PATH := $(PATH):$(HOME)/.cargo/bin

.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help quick test counts soak bench report memory large targets calibrate costs table records sizes lint header doc picture install uninstall
.PHONY: examples cgal-examples platforms js js-bench page
.PHONY: compat demo deb dist packages wheel library benchmark clean faults tsan miri fuzz mutants coverage

help: ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-13s %s\n", $$1, $$2 }' Makefile

quick: ## two minutes after a change of one line: format, clippy, unit tests, small oracles, the header's freshness
	cargo fmt --check
	cargo clippy --lib --tests -- -D warnings
	cargo test --profile quick --lib --test quick
	cargo test --profile quick --test ffi -- header:: functions:: algorithms::

test: ## all tests, two steps at a time: Rust; C, C++, valgrind, sanitizers; installation; the benchmark's own
	@.ci/packages $(BENCHMARK_NEEDS) $(PAGE_NEEDS) $(EXAMPLE_NEEDS) pkg-config valgrind dpkg-dev
	-@.ci/packages chromium
	-@.ci/packages libtet1.5-dev
	-@.ci/packages libqhull-dev
	-@.ci/packages clang lld mold
	-@.ci/packages python3-numpy python3-scipy python3-pytest
	-@.ci/packages libopenmpi-dev openmpi-bin
	-@.ci/packages python3-mpi4py
	tests/run

counts: ## what has changed in the counts of work since they were recorded; RECORD=1 records them
	$(if $(RECORD),DELDRIFT_RECORD=1) cargo test --profile quick --test library work:: -- --nocapture --test-threads 1

soak: ## random histories against fresh builds, on two threads: cpp-bench/results/soak.csv (HOURS=1, or ARGS="--seed 7")
	cargo bench --bench soak -- $(or $(ARGS),--hours $(HOURS) --csv cpp-bench/results/soak.csv)
	$(if $(ARGS),,.ci/records write cpp-bench/results/environment_soak.txt "make soak HOURS=$(HOURS)")

bench: benchmark ## deldrift beside CGAL, and the Python package beside scipy: tables, cpp-bench/results/bench.csv and structured.csv (PRESET=quick or full)
	cpp-bench/run --preset $(PRESET) $(ARGS)
	$(if $(ARGS),,@python/bench/run $(PRESET))

report: benchmark ## the experiments of RR-6750, beside CGAL: cpp-bench/results/report/index.html (PRESET=quick or full)
	@.ci/packages $(PAGE_NEEDS)
	-@cpp-bench/report/fetch_man
	cpp-bench/run --report --preset $(PRESET) $(ARGS)
	cpp-bench/report/regret
	cpp-bench/report/page/page.py

memory: benchmark ## bytes per vertex, beside CGAL's: cpp-bench/results/memory.csv
	cpp-bench/run --memory $(ARGS)

large: benchmark ## 50 million points in 2D, 20 million in 3D: cpp-bench/results/large.csv
	cpp-bench/run --large $(ARGS)

targets: benchmark ## special cases beside the speed-up wanted: cpp-bench/results/targets.csv
	cpp-bench/run --targets $(ARGS)
	cpp-bench/peclet_voro

calibrate: ## the constants by which algorithms are chosen: cpp-bench/results/calibrate.csv (ARGS=NAME... for some)
	MALLOC_MMAP_MAX_=0 MALLOC_TRIM_THRESHOLD_=-1 cargo bench --bench calibrate -- $(or $(ARGS),--csv cpp-bench/results/calibrate.csv)
	$(if $(ARGS),,.ci/records write cpp-bench/results/environment_calibrate.txt "make calibrate")

costs: library ## how time grows, of every function on sets that are hard: docs/COSTS.md, cpp-bench/results/costs.csv
	@.ci/packages g++
	benches/costs/run $(ARGS)

faults: ## calls that fail midway, at every point: tests/results/faults.csv (some five minutes)
	tests/faults_table
	.ci/records write tests/results/environment_faults.txt "make faults"

tsan: ## tests of the library's threads under ThreadSanitizer, with a nightly toolchain
	.ci/nightly tsan

miri: ## tests of what needs no system under Miri, with a nightly toolchain that has it
	.ci/nightly miri

js: ## npm package in build/packages, tested in Node and Chromium beside d3-delaunay and Delaunator; needs a network
	@.ci/packages nodejs npm
	-@.ci/packages chromium
	js/build
	js/make_package

js-bench: ## deldrift in JavaScript beside d3-delaunay and Delaunator: js/bench/results.csv; after make js
	cd js && node bench/bench.js
	.ci/records write js/bench/environment.txt "make js-bench"

page: ## a page whose points move, in a browser of this machine; after make js
	node js/page/serve.js

platforms: ## the library for other machines, tested under emulators: docs/PLATFORMS.md (ARGS=arm64 for one)
	platforms/run $(ARGS)
	.ci/records write tests/results/environment_platforms.txt "$(strip make platforms $(if $(ARGS),ARGS='$(ARGS)'))"

mutants: ## changes of the sources that no test notices: tests/results/mutants.csv (an hour; ARGS="--sample 0" for all)
	mutants/run $(ARGS)
	.ci/records write tests/results/environment_mutants.txt "$(strip make mutants $(if $(ARGS),ARGS='$(ARGS)'))"

coverage: ## lines and branches that the tests run: tests/results/coverage.csv (an hour)
	@.ci/packages llvm-19
	tests/coverage $(ARGS)
	.ci/records write tests/results/environment_coverage.txt "$(strip make coverage $(if $(ARGS),ARGS='$(ARGS)'))"

table: ## fill in the tables and sentences with figures of README.md and docs, from the records
	cpp-bench/readme_table
	.ci/figures --write
	platforms/run --table

records: ## where the recorded figures come from: command, date, commit, and how many commits to the sources since
	.ci/records

lint: ## format, clippy, documentation, freshness of the header
	@.ci/packages g++
	cargo fmt --check
	cargo clippy -- -D warnings
	cargo clippy --all-targets -- -D warnings
	RUSTDOCFLAGS=-Dwarnings cargo doc --no-deps
	cargo test --test ffi header

header: ## include/deldrift.h and its parts, from the sources in src/capi, docs/FUNCTIONS.md and docs/ABUSE.md
	DELDRIFT_UPDATE_HEADER=1 cargo test --test ffi header_is_what_the_sources_say
	DELDRIFT_UPDATE_HEADER=1 cargo test --test ffi table_of_functions
	DELDRIFT_UPDATE_HEADER=1 cargo test --test ffi abuse

doc: ## documentation as web pages: build/doc/html/index.html (C, C++) and, for Rust, doc/deldrift in cargo's folder
	@.ci/packages doxygen
	mkdir -p build/doc
	doxygen docs/Doxyfile
	cargo doc --no-deps

picture: ## docs/moving.svg and docs/lloyd.svg, from runs of the library
	cargo run --release --example moving_picture > docs/moving.svg.new
	mv docs/moving.svg.new docs/moving.svg
	cargo run --release --example lloyd_picture > docs/lloyd.svg.new
	mv docs/lloyd.svg.new docs/lloyd.svg

examples: WITH_PACKAGE = DELDRIFT_LIBRARY="$(CARGO_TARGET_DIR)/release/libdeldrift.so" PYTHONPATH=python /usr/bin/python3
examples: library ## all examples, and their pictures in docs; particle finite elements also beside CGAL
	@.ci/packages $(EXAMPLE_NEEDS) libcgal-dev python3-numpy
	cmake -S examples -B build/examples -DDELDRIFT_LIBRARY="$(CARGO_TARGET_DIR)/release/libdeldrift.so"
	cmake --build build/examples
	build/examples/solver docs/solver.svg
	build/examples/tour
	build/examples/comparison
	build/examples/plate
	build/examples/rejecting
	build/examples/stirred docs/stirred.svg
	build/examples/periodic docs/periodic.svg
	build/examples/domain 10000 docs/domain.svg build/examples/domain.html
	build/examples/overnight 100000 docs/overnight.svg
	build/examples/heat 4000 100 docs/heat.svg
	build/examples/smoothing 60 docs/smoothing.svg
	build/examples/densities 1225 docs/densities.svg
	build/examples/gas 400 4000 docs/gas.svg
	build/examples/transport 300 docs/transport.svg
	build/examples/euler 1600 docs/euler.svg
	build/examples/packing 300 docs/packing.svg
	build/examples/molecule 34 docs/molecule.svg
	build/examples/particle_fem 3.6 0.05 docs/particle_fem.svg
	build/examples/particle_fem_cgal
	$(WITH_PACKAGE) python/examples/tissue.py docs/tissue.svg
	$(WITH_PACKAGE) python/examples/foam.py docs/foam.svg

cgal-examples: library ## CGAL's examples with deldrift in its place, beside CGAL (ARGS=--write: docs/CGAL_EXAMPLES.md)
	@.ci/packages g++ libcgal-dev libeigen3-dev
	ffi-tests/cgal/examples $(ARGS)

sizes: library ## how large the library is, and of what: tests/results/sizes.csv
	@.ci/packages cmake
	cmake/sizes
	.ci/records write tests/results/environment_sizes.txt "make sizes"

install: ## library, headers, compat, mpi where there is one, CMake and pkg-config files, to PREFIX (/usr/local), below DESTDIR
	@.ci/packages cmake g++
	cmake -S . -B build/install -DCMAKE_INSTALL_PREFIX="$(PREFIX)"
	cmake --build build/install
	DESTDIR="$(DESTDIR)" cmake --install build/install

uninstall: ## remove what make install has installed, below DESTDIR
	cmake -DBUILD=build/install -P cmake/uninstall.cmake

deb: ## packages for Debian in build/packages: libraries, and -dev for what programs are built with
	@.ci/packages cmake dpkg-dev g++ libopenmpi-dev
	-@.ci/packages libqhull-dev
	-@.ci/packages libgetfem-dev
	cmake -S . -B build/deb -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_INSTALL_DOCDIR=share/doc/libdeldrift-dev \
	    -DDELDRIFT_COMPAT_DOCDIR=share/doc/libdeldrift-compat-dev -DDELDRIFT_MPI_DOCDIR=share/doc/libdeldrift-mpi-dev
	cmake --build build/deb
	cd build/deb && cpack -G DEB -B "$(CURDIR)/build/packages"
	rm -rf build/packages/_CPack_Packages

dist: ## archives in build/packages: sources that build without a network, and what is installed
	@.ci/packages cmake g++
	cmake/make_dist

packages: deb dist ## ... both, and programs built with each of them, offline; lintian and clang++ where they are there
	@.ci/packages pkg-config
	cmake/check_packages

# What has the compiler count for libFuzzer, also the stable one. With the nightly one there is AddressSanitizer, too.
FUZZ_COUNTS := level=4 inline-8bit-counters pc-table trace-compares
FUZZ_FLAGS := -Cpasses=sancov-module $(addprefix -Cllvm-args=-sanitizer-coverage-,$(FUZZ_COUNTS))
FUZZ_NIGHTLY = $(shell rustc +nightly --version >/dev/null 2>&1 && echo yes)
FUZZ_HOST = $(shell rustc -vV 2>/dev/null | sed -n 's/^host: //p')
FUZZ_BUILD = $(CARGO_TARGET_DIR)/libfuzzer$(if $(FUZZ_NIGHTLY),-nightly)

fuzz: ## fuzzing guided by coverage: TARGET=predicates, calls or loaders, for SECONDS=60; see fuzz/README.md
	@.ci/packages g++
	RUSTFLAGS="$(FUZZ_FLAGS) --cfg fuzzing $(if $(FUZZ_NIGHTLY),-Zsanitizer=address)" \
	    cargo $(if $(FUZZ_NIGHTLY),+nightly) build --release --manifest-path fuzz/Cargo.toml --target $(FUZZ_HOST) \
	    --target-dir "$(FUZZ_BUILD)" --features libfuzzer --bin $(TARGET)
	mkdir -p build/fuzz/$(TARGET) fuzz/findings
	ASAN_OPTIONS=allocator_may_return_null=1 "$(FUZZ_BUILD)/$(FUZZ_HOST)/release/$(TARGET)" \
	    build/fuzz/$(TARGET) fuzz/corpus/$(TARGET) -max_total_time=$(SECONDS) -timeout=60 -max_len=1500 \
	    -artifact_prefix=fuzz/findings/$(TARGET)-

reproducible: ## two builds in two folders under two homes: the same bytes, or it fails (some ten minutes)
	release/reproducible

sbom: ## what the library is made of, as CycloneDX: build/packages/deldrift.cdx.json
	mkdir -p build/packages
	release/sbom > build/packages/deldrift.cdx.json

wheel: library ## Python package: wheel and sdist in build/packages, and its tests in a clean environment; needs a network
	@.ci/packages python3-venv
	python/make_wheel

compat: library ## Triangle's and TetGen's calling conventions: libdeldrift_triangle_tetgen, in build/compat
	@.ci/packages cmake g++
	cmake -S compat -B build/compat -DDELDRIFT_LIBRARY_DIR="$(CARGO_TARGET_DIR)/release"
	cmake --build build/compat

demo: ## finite-element programs of others run with deldrift in place of Triangle, TetGen, qhull; needs a network
	-@.ci/packages libgetfem-dev python3-getfem
	-@.ci/packages python3-matplotlib
	-@.ci/packages libqhull-dev
	-@.ci/packages octave
	-@.ci/packages gdal-bin
	$(MAKE) compat
	compat/demo/run build/compat $(ARGS)

library: ## the library alone: libdeldrift.so and libdeldrift.a in target/release
	cargo build --release --lib

benchmark: library
	@.ci/packages $(BENCHMARK_NEEDS)
	@echo "building cpp-bench"
	@cpp-bench/run --help >/dev/null

clean: ## remove build outputs
	cargo clean
	rm -rf build cpp-bench/build
