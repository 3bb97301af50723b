#!/usr/bin/env bash
# The checks beyond `cargo test`, each a command that anyone can run: scripts/check.sh NAME …
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
    cat <<'EOF'
usage: scripts/check.sh NAME …
  fmt         formatting
  clippy      lints, warnings denied, with all features but `parquet`, and without the standard library
  docs        rustdoc, warnings denied
  integration behaviour from a user's crate: hundreds of systems
  engine      random, mutilated and unfinished systems through the engine
  examples    every example runs
  features    the book's programs, tests that need a feature (lanes of SIMD vectors, 31 digits), slow tests of the runtime
  companions  tests of the command, of studies and of pictures
  book        its pictures are what the examples draw; where mdbook is there, it builds and its links resolve
  ui          messages about mistakes, each beside its case; none of an unfinished description where its system is used
  random      10 000 random systems (or CASES of them) against dual numbers
  command     `cargo lagrange new`, its program and `verify`, in a package from nothing
  editor      rust-analyzer in a body that is being written: completion, hover, no false message (installs it by rustup)
  packages    what publishing asks for: complete packages, licences, oldest versions, pages of docs.rs (PACKAGES names a part
              of scripts/packages.sh; installs cargo-deny and compilers)
  benchmarks  the benchmark crate builds, optimised, and its lints with the peers from crates
  lanes       motions in the lanes of SIMD vectors with the instructions of the present processor
  tables      tables of studies, read by NumPy, pandas and Polars (installs them by pip)
  mpi         the same bytes by 1, 2 and 4 ranks and after a kill (installs Open MPI and libclang by apt-get)
  digits      31 digits with the other library of math, and the example that uses them
  long        energy and angular momentum over millions of steps
  drift       constraints and their energy over millions of steps
  roots       a million polynomials and steps cut anywhere: no zero is missed, none is found twice
  contacts    ten thousand random systems with contacts and friction, as many balls in a corner, stools, and as many random
              guards of events beside 31 digits
  stack       analyses of 100 coordinates on a stack of 3 MiB, in code that is not optimised
  stack-release
              the same in release, on the 2 MiB of a common thread: the compiler needs more than 16 GB for it, so it is in no list
  firmware    the same bits on microcontrollers and WebAssembly, no panic, no double, sizes (installs emulators); FIRMWARE
              names another part of scripts/firmware.sh
  gallery     the systems in the browser: they move in Chromium (installs it), on a phone and for a screen reader, too
  gpu         kernels of a graphics processor: built, assembled, interpreted bit by bit, and run where one is (installs a
              nightly toolchain and NVIDIA's assembler)
  all         everything above but stack-release
  ci          the same without book, random, editor, benchmarks, lanes, tables, mpi, digits, long, drift, roots, contacts, gallery
              and gpu, of packages the files alone, and of firmware without sizes, instructions and Miri; in two halves at once
EOF
}

lagrangian_features=lagrangian/wide,lagrangian/double-double,lagrangian/ensemble,lagrangian/pictures

fmt() { cargo fmt --all --check; }

clippy() {
    # Cargo locks a folder while it builds: tests can be built at the same time in theirs.
    local -x CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-target}/clippy
    # The tests of the benchmark crate are the benchmarks again: `benchmarks` has them.
    cargo clippy --workspace --exclude benchmarks --all-targets --features $lagrangian_features -- -D warnings
    # Tests that `cargo test` leaves out are no targets of the former.
    cargo clippy --workspace --bins --test '*' --features $lagrangian_features -- -D warnings
    cargo clippy -p lagrange-runtime --no-default-features --features libm,double-double -- -D warnings
}

# In the folder of the lints, with their features: both check the same dependencies.
docs() {
    CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-target}/clippy RUSTDOCFLAGS="-D warnings" \
        cargo doc --workspace --no-deps --exclude benchmarks --features $lagrangian_features
}

# `cargo test` is quick from nothing. What it leaves out has one selection of packages and features here, so that each
# crate is built once more at most. The engine runs at every expansion: optimised, it repays its compilation.
tests() {
    cargo --config profile.dev.package.lagrange-codegen.opt-level=1 test \
        -p lagrangian -p lagrange-codegen -p lagrange-runtime \
        --features $lagrangian_features "$@"
}

integration() { tests --test integration --test motions; }

engine() { tests --test random --test names --test editor --test fuzz; }

examples() { tests --test examples; }

features() {
    tests --test batch --test digits
    tests --doc book/src/
    # With the slow ones; what takes minutes is `roots`. The engine's own tests need no feature: `cargo test` has them.
    cargo test -p lagrange-runtime --lib --features lagrange-runtime/wide,lagrange-runtime/double-double -- \
        --include-ignored --skip a_million --skip many_steps
}

companions() { cargo test -p cargo-lagrange -p lagrange-ensemble -p lagrange-pictures; }

book() { scripts/book.sh check; }

ui() { tests --test ui --test unfinished; }

random() { PROPTEST_CASES=${CASES:-10000} cargo test --release -p lagrange-codegen --test random; }

command_line() { cargo test -p cargo-lagrange --test models -- --ignored; }

editor() {
    rustup component add rust-analyzer
    scripts/editor.py
}

packages() { scripts/packages.sh "${PACKAGES:-all}"; }

benchmarks() {
    cargo clippy -p benchmarks --all-targets --features peers -- -D warnings
    cargo build --release -p benchmarks
}

# `companions` has the vectors of any processor; others have other instructions, such as fused multiplications.
lanes() {
    RUSTFLAGS="-C target-cpu=native" cargo test -p lagrange-ensemble --test lanes --target-dir "${CARGO_TARGET_DIR:-target}/present"
}

tables() { scripts/tables.sh; }

mpi() { scripts/mpi.sh all; }

digits() {
    cargo test --features double-double,libm --test digits
    cargo run --release --features double-double --example true_digits
}

long() { cargo test --release --test long -- free:: turning:: --nocapture; }

drift() { cargo test --release --test long constrained:: -- --nocapture; }

roots() { cargo test --release -p lagrange-runtime --lib motion::roots -- --ignored; }

contacts() {
    cargo test --release --features double-double --test motions -- --ignored --nocapture contact:: events::
}

stack() { tests --test stack; }

stack-release() { cargo test --release --test stack; }

firmware() { scripts/firmware.sh "${FIRMWARE:-all}"; }

gallery() { scripts/gallery.sh test; }

gpu() { scripts/gpu.sh all; }

# Two halves that use folders of their own: most of either keeps one core busy.
tested="fmt packages integration engine examples features companions ui stack command"
beside="clippy docs firmware"
all="$tested $beside book random editor benchmarks lanes tables mpi digits long drift roots contacts gallery gpu"

# The checks that a name stands for.
names() {
    case " $all stack-release " in
        *" $1 "*) echo "$1" ;;
        *) [ "$1" = all ] && echo "$all" ;;
    esac
}

# Both halves of `ci`; what the second says follows the first. The half that fails ends the other.
halves() {
    local log first second failed=0
    log=$(mktemp)
    set -m
    PACKAGES=${PACKAGES:-files} scripts/check.sh $tested & first=$!
    FIRMWARE=${FIRMWARE:-ci} scripts/check.sh $beside >"$log" 2>&1 & second=$!
    wait -n || failed=$?
    if [ $failed != 0 ]; then kill -- -$first -$second 2>/dev/null || true; fi
    wait $first || failed=$?
    wait $second || failed=$?
    cat "$log"
    rm "$log"
    return $failed
}

[ $# -gt 0 ] || { usage; exit 2; }
for list in "$@"; do
    if [ "$list" = ci ]; then
        halves
        continue
    fi
    checks=$(names "$list") || { usage; exit 2; }
    for name in $checks; do
        SECONDS=0
        case $name in
            command) command_line ;;
            *) "$name" ;;
        esac
        echo "check: $name took $SECONDS s"
    done
done
