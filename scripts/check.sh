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
  random      10 000 random systems (or CASES of them) against dual numbers
  bare-metal  the runtime and a generated system for Cortex-M without an allocator
  benchmarks  the benchmark crate builds (its lints cover the peers from crates, too)
  lanes       several motions in the lanes of SIMD vectors
  long        energy over millions of steps
  drift       constraints and their energy over millions of steps
  firmware    the same bits on microcontrollers and WebAssembly, no panic, no double, sizes (installs emulators)
  all         everything above
  ci          all of it but drift and firmware
EOF
}

fmt() { cargo fmt --all --check; }

clippy() {
    cargo clippy --workspace --all-targets --features lagrangian/wide -- -D warnings
    cargo clippy -p benchmarks --all-targets --features peers -- -D warnings
    cargo clippy -p lagrange-runtime --no-default-features --features libm -- -D warnings
}

docs() { RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --exclude benchmarks; }

random() { PROPTEST_CASES=${CASES:-10000} cargo test --release -p lagrange-codegen --test random; }

bare_metal() {
    local target
    for target in thumbv7em-none-eabihf thumbv6m-none-eabi; do
        if ! rustup target add "$target"; then
            echo "bare-metal: the target $target is missing and 'rustup target add $target' failed" >&2
            return 1
        fi
        cargo build --release -p lagrange-runtime --no-default-features --features libm --target "$target"
        cargo build --release -p bare-metal --target "$target"
    done
}

benchmarks() { cargo build --release -p benchmarks; }

lanes() { cargo test --features wide --test batch; }

long() { cargo test --release --test integration jets::long:: -- --ignored --nocapture; }

drift() { cargo test --release --test integration jets::long_constrained:: -- --ignored --nocapture; }

firmware() { scripts/firmware.sh all; }

[ $# -gt 0 ] || { usage; exit 2; }
for name in "$@"; do
    case $name in
        fmt | clippy | docs | random | benchmarks | lanes | long | drift | firmware) "$name" ;;
        bare-metal) bare_metal ;;
        all) fmt; clippy; docs; random; bare_metal; benchmarks; lanes; long; drift; firmware ;;
        ci) fmt; clippy; docs; random; bare_metal; benchmarks; lanes; long ;;
        *) usage; exit 2 ;;
    esac
done
