#!/usr/bin/env bash
# What is promised of targets without an operating system, checked on them: scripts/firmware.sh NAME …
set -euo pipefail
cd "$(dirname "$0")/../firmware"

usage() {
    cat <<'TEXT'
usage: scripts/firmware.sh NAME …
  tools         installs what the others need where that is possible, and says what is missing
  build         all programs for all targets
  bits          every motion has the same bits on the host, Cortex-M4F, Cortex-M0, RV32 and WebAssembly
  run           the same, and shows them
  panics        no program can panic or allocate: one that could would not link
  doubles       a program in f32 for a Cortex-M4F holds no operation of doubles
  unused        what a program does not call is not in it
  size          flash and RAM of a program for each system and method
  instructions  instructions and stack of a step, counted and painted in QEMU
  figures       writes both, with the errors of the steps, into firmware/README.md and book/src/bare-metal.md
  example       the cart-pole balances and the arm follows its motion, with the gains that their equations give; flash of the controllers
  features      a crate without math does not build and says why
  lint          formatting and lints of the programs
  miri          the tests of the runtime under Miri (needs a nightly toolchain)
  ci            tools, build, lint, bits, panics, doubles, unused, example, features
  all           the same, size, instructions and miri
TEXT
}

m4f=thumbv7em-none-eabihf
m0=thumbv6m-none-eabi
rv32=riscv32imac-unknown-none-elf
wasm=wasm32-unknown-unknown
built=${CARGO_TARGET_DIR:-$PWD/../target}
results=$built/firmware
mkdir -p "$results"
sysroot_tools=$(rustc --print target-libdir)/../bin

fail() {
    echo "firmware: $*" >&2
    exit 1
}

# A tool of LLVM: that of the Rust toolchain, else one on the path.
llvm() {
    local tool=$1
    shift
    if [ -x "$sysroot_tools/llvm-$tool" ]; then "$sysroot_tools/llvm-$tool" "$@"; else "llvm-$tool" "$@"; fi
}

have() { command -v "$1" >/dev/null; }

packages() {
    local as=() install=("$@") utils wanted
    have apt-get || return 1
    if [ "$(id -u)" != 0 ]; then
        have sudo && sudo -n true 2>/dev/null || return 1
        as=(sudo -n)
    fi
    "${as[@]}" apt-get update -qq || true
    # qemu-utils of another release keeps the emulators from being installed.
    utils=$(dpkg-query -W -f '${Version}' qemu-utils 2>/dev/null || true)
    wanted=$(apt-cache policy qemu-system-arm | sed -n 's/^ *Candidate: //p')
    if [ -n "$utils" ] && [ "$utils" != "$wanted" ]; then install+=("qemu-utils=$wanted"); fi
    "${as[@]}" apt-get install -y -qq --no-install-recommends --allow-downgrades "${install[@]}" >/dev/null
}

tools() {
    local target missing=()
    for target in $m4f $m0 $rv32 $wasm; do
        rustup target list --installed | grep -qx "$target" || rustup target add "$target" ||
            missing+=("the target $target (rustup target add $target)")
    done
    [ -x "$sysroot_tools/llvm-nm" ] || rustup component add llvm-tools || have llvm-nm ||
        missing+=("llvm-nm, llvm-size and llvm-objdump (rustup component add llvm-tools)")
    have qemu-system-arm && have qemu-system-riscv32 || packages qemu-system-arm qemu-system-misc || true
    have qemu-system-arm || missing+=("qemu-system-arm (apt-get install qemu-system-arm)")
    have qemu-system-riscv32 || missing+=("qemu-system-riscv32 (apt-get install qemu-system-misc)")
    have node || packages nodejs || true
    have node || missing+=("node (apt-get install nodejs)")
    [ ${#missing[@]} = 0 ] || fail "missing: $(printf '\n  %s' "${missing[@]}")"
}

build() {
    cargo build -q --release
    cargo build -q --release -p bare --target $m4f
    cargo build -q --release -p bare --target $m0
    cargo build -q --release -p bare --bin bits --target $rv32
    cargo build -q --release -p wasm --target $wasm
    cargo build -q --release -p cart_pole -p arm --target $m4f
}

# The bits of all motions on a target, by `cargo run`, whose runner is an emulator.
bits_of() {
    case $1 in
        host) cargo run -q --release -p host bits ;;
        "$wasm")
            cargo build -q --release -p wasm --target $wasm
            node wasm/run.mjs "$built/$wasm/release/wasm.wasm"
            ;;
        *) timeout 300 cargo run -q --release -p bare --bin bits --target "$1" ;;
    esac
}

bits() {
    local target hashes
    for target in host $m4f $m0 $rv32 $wasm; do
        bits_of $target >"$results/bits-$target" || fail "the motions do not run on $target"
        diff "$results/bits-host" "$results/bits-$target" >"$results/bits-difference" ||
            fail "$target differs from the host: $(head -5 "$results/bits-difference")"
    done
    hashes=$(grep -c ': [0-9a-f]\{16\}$' "$results/bits-host")
    ! grep -q failed "$results/bits-host" || fail "a motion failed: $(grep failed "$results/bits-host")"
    [ "$hashes" -ge 60 ] || fail "only $hashes hashes"
    echo "bits: $hashes hashes are the same on host, $m4f, $m0, $rv32 and $wasm"
}

run() {
    bits
    cat "$results/bits-host"
}

# Builds the smallest program with some features; prints its path.
footprint() {
    local target=$1 features=$2
    cargo build -q --release -p footprint --target "$target" --features "$features" 2>"$results/link" || {
        grep -q this_program_can_panic "$results/link" && fail "footprint with $features can panic on $target"
        cat "$results/link" >&2
        fail "footprint with $features does not build for $target"
    }
    cp "$built/$target/release/footprint" "$results/footprint-$target-$features"
    echo "$results/footprint-$target-$features"
}

# Target, system, method and scalar of the programs in the table.
table() {
    local scalar system method
    for scalar in f32 f64; do
        for system in double_pendulum rod cart_pole; do
            for method in rk4 jet4 jet6; do echo "$m4f $system $method $scalar"; done
        done
    done
    for system in double_pendulum rod cart_pole; do
        for method in rk4 jet4 jet6; do echo "$m0 $system $method f32"; done
    done
}

# The controllers of the arm alone.
controllers="computed_torque,f32 regulator,f32"

# Programs with more in them.
larger="double_pendulum,simulate,f32 rod,simulate,f32 rod,jet6,f32,consistent rod,jet6,f32,reactions \
    double_pendulum,jet6,f32,energy"

# A program with contacts and dry friction.
contacts="puck,jet6,f32 puck,jet6,f64"

panics() {
    local target system method scalar features program count=0
    while read -r target system method scalar; do
        program=$(footprint "$target" "$system,$method,$scalar")
        no_allocator "$program"
        count=$((count + 1))
    done < <(table)
    for features in $larger $controllers $contacts double_pendulum,dop853,f32; do
        program=$(footprint $m4f "$features")
        no_allocator "$program"
        count=$((count + 1))
    done
    # A check that cannot fail is none.
    if (footprint $m4f double_pendulum,jet6,f32,panic) >/dev/null 2>&1; then fail "a panic was not noticed"; fi
    echo "panics: none of $count programs can panic or allocate"
}

no_allocator() {
    ! llvm nm "$1" | grep -E '__rust_alloc|__rg_alloc|panicking' || fail "an allocator or a panic is in $1"
}

# Operations of doubles in a program: calls of the emulation, or instructions.
double_operations() {
    llvm objdump -d --no-show-raw-insn "$1" |
        grep -cE '__aeabi_(d|cd|[a-z0-9]+2d)|__[a-z]+df[a-z0-9]*|\.f64' || true
}

doubles() {
    local target system method scalar features program found count=0
    while read -r target system method scalar; do
        if [ "$target" = $m4f ] && [ "$scalar" = f32 ]; then
            found=$(double_operations "$(footprint $m4f "$system,$method,f32")")
            [ "$found" = 0 ] || fail "$system by $method in f32 holds $found operations of doubles"
            count=$((count + 1))
        fi
    done < <(table)
    # All but Dormand–Prince, which converts its table where a stage fails.
    for features in $larger $controllers; do
        found=$(double_operations "$(footprint $m4f "$features")")
        [ "$found" = 0 ] || fail "$features holds $found operations of doubles"
        count=$((count + 1))
    done
    cargo build -q --release -p cart_pole -p arm --target $m4f
    for program in cart_pole arm; do
        found=$(double_operations "$built/$m4f/release/$program")
        [ "$found" = 0 ] || fail "$program in f32 holds $found operations of doubles"
        count=$((count + 1))
    done
    [ "$(double_operations "$(footprint $m4f double_pendulum,jet6,f64)")" -gt 10 ] || fail "doubles are not noticed"
    echo "doubles: none in $count programs in f32"
}

# Code and constants of a program.
flash() { llvm size -A "$1" | awk '/^\.(text|rodata|data) / { sum += $2 } END { print sum }'; }

unused() {
    local base with features call target system method scalar program
    while read -r target system method scalar; do
        program=$(footprint "$target" "$system,$method,$scalar")
        ! llvm nm -C "$program" | grep -iE 'energy|reactions_at|dense|dop853|samples|simulation|momenta|consistent' ||
            fail "$program holds what it does not call"
    done < <(table)
    for features in rod,jet6,f32,consistent rod,jet6,f32,reactions double_pendulum,jet6,f32,energy; do
        call=${features##*,}
        base=$(flash "$(footprint $m4f "${features%,*}")")
        with=$(flash "$(footprint $m4f "$features")")
        [ "$with" -gt "$base" ] || fail "$call is linked though nothing calls it"
        echo "unused: $call adds $((with - base)) bytes to ${features%,*}, $base without it"
    done
}

size() {
    local target system method scalar
    while read -r target system method scalar; do
        llvm size -A "$(footprint "$target" "$system,$method,$scalar")" |
            awk -v of="$target $system $method $scalar" '
                { bytes[$1] = $2 }
                END {
                    print "size", of, bytes[".text"] + 0, bytes[".rodata"] + 0, bytes[".data"] + 0, \
                        bytes[".bss"] + 0, bytes[".vector_table"] + 0
                }'
    done < <(table)
}

instructions() {
    local target runner
    for target in $m4f $m0; do
        cargo build -q --release -p bare --bin measure --target $target
        runner=$(sed -n "/$target/,/^runner/s/^runner = \"\(.*\)\"/\1/p" .cargo/config.toml)
        # shellcheck disable=SC2086  # the runner is several words
        timeout 300 ${runner%-kernel} -icount shift=6 -kernel "$built/$target/release/measure" >"$results/measure" ||
            fail "measuring on $target failed"
        grep -qE '^# 200000 instructions take [0-9]+ ticks$' "$results/measure" || fail "no calibration on $target"
        sed -n "/^#/!s/^/step $target /p" "$results/measure" | awk '{ print $1, $2, $3, $4, $5, $6, $7 }'
    done
}

figures() {
    { size; instructions; } | cargo run -q --release -p host figures README.md ../book/src/bare-metal.md
    echo "figures: written into firmware/README.md and book/src/bare-metal.md"
}

example() {
    local program features
    cargo test -q --release -p cart_pole -p arm
    cargo build -q --release -p cart_pole -p arm --target $m4f
    for program in cart_pole arm; do
        timeout 120 qemu-system-arm -machine mps2-an386 -icount shift=5,sleep=off -nographic \
            -semihosting-config enable=on,target=native -kernel "$built/$m4f/release/$program" | tee "$results/$program"
    done
    grep -qx balanced "$results/cart_pole" || fail "the pole fell"
    grep -qx followed "$results/arm" || fail "the arm is astray"
    for features in $controllers; do
        echo "$features: $(flash "$(footprint $m4f "$features")") bytes of flash"
    done
}

features() {
    if cargo build -q --manifest-path ../lagrange-runtime/Cargo.toml --no-default-features 2>"$results/features"; then
        fail "a crate without math builds"
    fi
    grep -q 'needs math functions: enable feature `std` (default), or `libm`' "$results/features" ||
        fail "a crate without math does not say what to do: $(cat "$results/features")"
    [ "$(grep -c '^error' "$results/features")" -le 2 ] || fail "more than one error: $(cat "$results/features")"
    echo "features: a crate without math says what to do"
}

lint() {
    cargo fmt --all --check
    cargo clippy -q --release --all-targets -- -D warnings
    cargo clippy -q --release -p bare --target $m4f -- -D warnings
    cargo clippy -q --release -p bare --bin bits --target $rv32 -- -D warnings
    cargo clippy -q --release -p cart_pole -p arm --bins --target $m4f -- -D warnings
    cargo clippy -q --release -p footprint --features rod,jet6,f32,energy,reactions,consistent --target $m4f -- -D warnings
    cargo clippy -q --release -p footprint --features regulator,f32 --target $m4f -- -D warnings
    cargo clippy -q --release -p wasm --target $wasm -- -D warnings
}

miri() {
    have rustup && rustup toolchain list | grep -q nightly || fail "missing: a nightly toolchain (rustup toolchain install nightly)"
    rustup component list --toolchain nightly --installed | grep -q miri || rustup component add miri rust-src --toolchain nightly
    # Tests of many thousand steps are left out. Miri varies the results of mathematical functions unless it is told not to,
    # and tests compare digits.
    MIRIFLAGS=-Zmiri-deterministic-floats cargo +nightly miri test --manifest-path ../lagrange-runtime/Cargo.toml --lib
}

[ $# -gt 0 ] || { usage; exit 2; }
for name in "$@"; do
    case $name in
        tools | build | bits | run | panics | doubles | unused | size | instructions | figures | example | features | lint | miri) $name ;;
        ci) tools; build; lint; bits; panics; doubles; unused; example; features ;;
        all) tools; build; lint; bits; panics; doubles; unused; size; instructions; example; features; miri ;;
        *) usage; exit 2 ;;
    esac
done
