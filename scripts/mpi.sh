#!/usr/bin/env bash
# Many motions on a cluster: what lagrange-mpi needs, and its test. scripts/mpi.sh tools | test | all
set -euo pipefail
cd "$(dirname "$0")/../lagrange-mpi"

tools() {
    if command -v mpirun mpicc >/dev/null && ls /usr/lib/llvm-*/lib/libclang*.so* >/dev/null 2>&1; then
        echo "Open MPI and libclang are there"
        return
    fi
    echo "installing Open MPI (libopenmpi-dev, openmpi-bin) and libclang (libclang-dev, for the bindings of crate mpi) by apt-get"
    if [ "$(id -u)" = 0 ]; then local as=(); else local as=(sudo); fi
    "${as[@]}" apt-get update
    "${as[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
        libopenmpi-dev openmpi-bin libclang-dev clang
}

check() {
    cargo clippy --all-targets -- -D warnings
    cargo test
}

case ${1:-} in
    tools) tools ;;
    test) check ;;
    all) tools; check ;;
    *) echo "usage: scripts/mpi.sh tools | test | all"; exit 2 ;;
esac
