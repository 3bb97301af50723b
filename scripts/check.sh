#!/usr/bin/env bash
# The checks beyond `cargo test`, each a command that anyone can run: scripts/check.sh NAME …
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
    cat <<'EOF'
usage: scripts/check.sh NAME …
  fmt         formatting
  clippy      lints, warnings denied, with and without the standard library's math
  docs        rustdoc, warnings denied
  book        its programs with all features; its pictures are what the examples draw; where mdbook is there, it builds
              and its links resolve
  ui          messages about mistakes that the compiler finds in types
  random      10 000 random systems (or CASES of them) against dual numbers
  command     `cargo lagrange new`, its program and `verify`, in a package from nothing
  packages    each package is complete: it is built from what would be published
  benchmarks  the benchmark crate builds (its lints cover the peers from crates, too)
  lanes       several motions in the lanes of SIMD vectors, for any processor and for the present one
  tables      tables of studies, read by NumPy, pandas and Polars (installs them by pip)
  mpi         the same bytes by 1, 2 and 4 ranks and after a kill (installs Open MPI and libclang by apt-get)
  digits      the scalar of 31 digits, with both libraries of math, and the example that uses it
  long        energy over millions of steps
  drift       constraints and their energy over millions of steps
  contacts    ten thousand random systems with contacts and friction
  stack       analyses of 100 coordinates on the stack of a common thread
  stack-release
              the same in release: the compiler needs more than 16 GB for it, so it is in no list
  firmware    the same bits on microcontrollers and WebAssembly, no panic, no double, sizes (installs emulators); FIRMWARE
              names another part of scripts/firmware.sh
  all         everything above
  ci          the same without contacts, packages, tables and mpi, of firmware what needs no nightly toolchain
EOF
}

fmt() { cargo fmt --all --check; }

clippy() {
    cargo clippy --workspace --all-targets --features lagrangian/wide,lagrangian/double-double -- -D warnings
    cargo clippy -p benchmarks --all-targets --features peers -- -D warnings
    cargo clippy -p lagrange-runtime --no-default-features --features libm,double-double -- -D warnings
}

docs() { RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --exclude benchmarks --features lagrangian/double-double; }

# `cargo test` runs its programs but for those that need a feature.
book() {
    cargo test --features wide,double-double --doc book/src/
    scripts/book.sh check
}

ui() { cargo test --test ui_types; }

random() { PROPTEST_CASES=${CASES:-10000} cargo test --release -p lagrange-codegen --test random; }

command_line() { cargo test -p cargo-lagrange --test models -- --ignored; }

packages() { cargo package --workspace --exclude benchmarks --allow-dirty --quiet; }

benchmarks() { cargo build --release -p benchmarks; }

# Other processors have other instructions for the same vectors.
lanes() {
    cargo test --features wide --test batch
    cargo test -p lagrange-runtime --features wide --lib -- lanes
    cargo test -p lagrange-ensemble --test lanes
    RUSTFLAGS="-C target-cpu=native" cargo test -p lagrange-ensemble --test lanes --target-dir "${CARGO_TARGET_DIR:-target}/present"
}

tables() { scripts/tables.sh; }

mpi() { scripts/mpi.sh all; }

digits() {
    cargo test -p lagrange-runtime --features double-double --lib -- double_double digits
    cargo test --features double-double --test digits
    cargo test --features double-double,libm --test digits
    cargo run --release --features double-double --example true_digits
}

long() { cargo test --release --test long free:: -- --nocapture; }

drift() { cargo test --release --test long constrained:: -- --nocapture; }

contacts() { cargo test --release --test integration contact::random::ten_thousand -- --ignored --nocapture; }

stack() { cargo test --test stack; }

stack-release() { cargo test --release --test stack; }

firmware() { scripts/firmware.sh "${FIRMWARE:-all}"; }

[ $# -gt 0 ] || { usage; exit 2; }
for name in "$@"; do
    case $name in
        command) command_line ;;
        fmt | clippy | docs | book | ui | random | packages | benchmarks | lanes | tables | mpi | digits | long | drift | contacts | stack | stack-release | firmware)
            "$name" ;;
        all) fmt; clippy; docs; book; ui; stack; random; command_line; packages; benchmarks; lanes; tables; mpi; digits; long; drift; contacts; firmware ;;
        ci)
            fmt; clippy; docs; book; ui; stack; random; command_line; benchmarks; lanes; digits; long; drift
            FIRMWARE=ci firmware ;;
        *) usage; exit 2 ;;
    esac
done
