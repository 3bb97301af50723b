#!/usr/bin/env bash
# Motions on a graphics processor: builds kernels, checks them without one, runs them where one is. scripts/gpu.sh NAME …
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
    cat <<'TEXT'
usage: scripts/gpu.sh NAME …
  tools        installs what the others need (a nightly toolchain with the sources of `core`; ptxas of NVIDIA by pip) and says so
  build [DIR]  the kernels of a package (default: lagrange-gpu/kernels) as PTX, checked: no panic, no allocation, nothing
               unresolved, nothing fused. The name of the file is printed
  assemble     the same kernels through ptxas, with exact and with fused arithmetic
  report       the same; writes registers, stack and spills into benchmarks/GPU.md
  emulate      interprets the PTX without a processor: memory must have the bits that the functions leave here
  run          where a processor is: all kernels against this machine, bits and motions a second, into the same page.
               Elsewhere it says that there is none
  test         formatting, lints and tests of the packages, on this machine
  all          tools, test, assemble, emulate, run
GPU names the processors that kernels are for: sm_90 (default) is Hopper, sm_80 Ampere, sm_75 Turing. Later ones run them, too.
TEXT
}

gpu=${GPU:-sm_90}
ptxas_version=12.9.86
page=benchmarks/GPU.md
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}
built=$CARGO_TARGET_DIR
results=$built/gpu
mkdir -p "$results"
host=(cargo run --quiet --release --manifest-path lagrange-gpu/Cargo.toml)

fail() {
    echo "gpu: $*" >&2
    exit 1
}

# The assembler of NVIDIA: one on the path, else that which `tools` installed.
assembler() { command -v ptxas || find "$results/nvidia" -path '*/bin/ptxas' 2>/dev/null | head -1; }

tools() {
    command -v rustup >/dev/null || fail "missing: rustup, for a nightly toolchain"
    if ! rustup toolchain list | grep -q '^nightly'; then
        echo "installing a nightly toolchain by rustup: kernels need \`abi_ptx\`"
        rustup toolchain install nightly --profile minimal
    fi
    if ! rustup component list --toolchain nightly --installed | grep -q '^rust-src'; then
        echo "installing the sources of \`core\` by rustup: it is built for $gpu with the kernels"
        rustup component add rust-src --toolchain nightly
    fi
    if [ -z "$(assembler)" ]; then
        echo "installing ptxas by pip (nvidia-cuda-nvcc-cu12 $ptxas_version) into $results/nvidia"
        python3 -m pip install --quiet --no-deps --target "$results/nvidia" "nvidia-cuda-nvcc-cu12==$ptxas_version"
        chmod +x "$(assembler)"
    fi
    echo "tools: $(rustc +nightly --version), $("$(assembler)" --version | tail -1)"
}

# The kernels of a package as PTX. All crates are one module, optimised as a whole, which the compiler prints; nothing is
# left to a linker, so none is needed. What follows the folder goes to cargo.
ptx_of() {
    local manifest=$1/Cargo.toml name
    shift
    [ -f "$manifest" ] || fail "there is no package in $(dirname "$manifest")"
    name=$(sed -n '/^\[package\]/,/^\[[^p]/s/^name *= *"\(.*\)"/\1/p' "$manifest" | head -1 | tr - _)
    CARGO_PROFILE_RELEASE_LTO=fat CARGO_PROFILE_RELEASE_CODEGEN_UNITS=1 CARGO_PROFILE_RELEASE_DEBUG=false \
        CARGO_TARGET_NVPTX64_NVIDIA_CUDA_RUSTFLAGS="-C target-cpu=$gpu" \
        cargo +nightly rustc --quiet --release --manifest-path "$manifest" --lib --crate-type cdylib \
        --target nvptx64-nvidia-cuda -Z build-std=core "$@" -- --emit=asm -C linker=true >&2 ||
        fail "$manifest does not compile as kernels: they are \`no_std\`, and allocate nothing"
    # The same text keeps its date: what was assembled from it stays.
    cmp --silent "$built/nvptx64-nvidia-cuda/release/deps/$name.s" "$results/$name.ptx" ||
        cp "$built/nvptx64-nvidia-cuda/release/deps/$name.s" "$results/$name.ptx"
    echo "$results/$name.ptx"
}

build() {
    local ptx
    ptx=$(ptx_of "${1:-lagrange-gpu/kernels}")
    "${host[@]}" -- check "$ptx"
}

# What ptxas says of the kernels of this repository, by arithmetic.
assemble() {
    local ptx=$results/kernels.ptx arithmetic
    [ -n "$(assembler)" ] || fail "missing: ptxas (scripts/gpu.sh tools)"
    build
    "${host[@]}" -- fuse "$ptx" "$results/fused.ptx"
    for arithmetic in kernels fused; do
        "$(assembler)" --gpu-name "$gpu" --verbose "$results/$arithmetic.ptx" -o "$results/$arithmetic.cubin" \
            2>"$results/$arithmetic.txt" || fail "ptxas refuses $arithmetic: $(grep -v '^ptxas info' "$results/$arithmetic.txt")"
    done
    "${host[@]}" -- table "$results/kernels.txt" "$results/fused.txt" | tee "$results/table.md"
}

report() {
    assemble
    {
        cat <<TEXT
# Kernels of a graphics processor

Written by \`scripts/gpu.sh report\` and \`scripts/gpu.sh run\`.

## Assembled

For $gpu by $("$(assembler)" --version | tail -1), from the PTX of $(rustc +nightly --version). Nothing is unresolved in it, so
nothing can panic or allocate, and no operation rounds otherwise than on a CPU; in the columns after \`fused\` products and sums may round together. A thread has
at most 255 registers of 32 bits. The stack is memory of a thread, for arrays that are indexed: tables of series, the reduction of large arguments of trigonometric functions, factors of matrices. Spills are bytes
that stand in this memory because registers are too few.

TEXT
        cat "$results/table.md"
        echo
        if grep -q '^## On a processor' "$page" 2>/dev/null; then
            sed -n '/^## On a processor/,$p' "$page"
        else
            printf '## On a processor\n\nNot run yet: no machine with a processor was at hand.\n'
        fi
    } >"$results/page.md"
    mv "$results/page.md" "$page"
    echo "report: written into $page"
}

emulate() {
    local ptx
    ptx=$(ptx_of lagrange-gpu/kernels --features contacts)
    cargo run --quiet --release --manifest-path lagrange-gpu/kernels/Cargo.toml --features contacts --bin emulate -- "$ptx"
}

run() {
    local ptx
    ptx=$(ptx_of lagrange-gpu/kernels)
    local kernels=("$ptx") assembled=("$results/kernels.cubin" "$results/fused.cubin")
    # Assembled from this text, they are loaded at once; the driver takes minutes for it.
    if [ "${assembled[0]}" -nt "$ptx" ] && [ "${assembled[1]}" -nt "$ptx" ]; then
        kernels=("${assembled[@]}")
    fi
    cargo run --quiet --release --manifest-path lagrange-gpu/kernels/Cargo.toml --bin run -- "${kernels[@]}" >"$results/run.md" ||
        { cat "$results/run.md"; fail "the kernels do not run as they should"; }
    cat "$results/run.md"
    if grep -q '^## On a processor' "$results/run.md" && [ -f "$page" ]; then
        { sed '/^## On a processor/,$d' "$page"; cat "$results/run.md"; } >"$results/page.md"
        mv "$results/page.md" "$page"
        echo "run: written into $page"
    fi
}

test_here() {
    local manifest=lagrange-gpu/Cargo.toml
    cargo fmt --manifest-path $manifest --all --check
    cargo clippy --quiet --manifest-path $manifest --workspace --features kernels/contacts --all-targets -- -D warnings
    cargo test --quiet --manifest-path $manifest --workspace
}

[ $# -gt 0 ] || { usage; exit 2; }
while [ $# -gt 0 ]; do
    case $1 in
        build)
            if [ -d "${2:-}" ]; then build "$2"; shift; else build; fi ;;
        tools | assemble | report | emulate | run) $1 ;;
        test) test_here ;;
        # Interpreted first: what is assembled has no contacts, and stays for `run`.
        all) tools; test_here; emulate; assemble; run ;;
        *) usage; exit 2 ;;
    esac
    shift
done
