#!/usr/bin/env bash
# What publishing asks of the packages.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
    cat <<'END'
usage: scripts/packages.sh COMMAND …
  files       each package is made of what would be published, its licences and README among it
  build       the same, and each is built from that alone
  deny        licences, sources and known faults of what they depend on, by deny.toml (installs cargo-deny: minutes)
  oldest      they build with the oldest compiler and the oldest versions of dependencies that they say are enough (installs
              that compiler and a nightly one, which finds these versions)
  docs        pages as docs.rs builds them, with the feature that an item needs beside it (needs a nightly compiler)
  semver [REV]
              what the present version promises, held against that of a revision, the last tag if none is named (installs
              cargo-semver-checks: minutes)
  all         everything above; without a tag there is no promise yet, and semver says so
END
}

published=(lagrangian lagrange-{codegen,ensemble,macros,pictures,runtime} cargo-lagrange)
features=lagrangian/wide,lagrangian/double-double,lagrangian/parquet,lagrangian/pictures
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}

toolchain() { rustup toolchain list | grep -q "^$1-" || rustup toolchain install --profile minimal "$1"; }

files() {
    local package file files
    for package in "${published[@]}"; do
        files=$(cargo package --list --allow-dirty -p "$package")
        for file in LICENSE-APACHE LICENSE-MIT README.md; do
            grep -qx "$file" <<<"$files" || { echo "packages: $package lacks $file" >&2; exit 1; }
        done
    done
    cargo package --workspace --exclude benchmarks --allow-dirty --quiet --no-verify
}

build() {
    files
    cargo package --workspace --exclude benchmarks --allow-dirty --quiet
}

deny() {
    command -v cargo-deny >/dev/null || cargo install --locked --quiet cargo-deny
    cargo deny --all-features check licenses bans sources
    local offline=()
    cargo deny fetch db 2>/dev/null || offline=(--offline)
    # A fetch that fails leaves a folder without a database.
    if [ ${#offline[@]} = 0 ] || compgen -G "${CARGO_HOME:-$HOME/.cargo}/advisory-dbs/*/" >/dev/null; then
        cargo deny "${offline[@]}" --all-features check advisories
    else
        echo "packages: the database of known faults is out of reach: they are not looked for"
    fi
}

# In a copy, because cargo has one lock file a workspace. Peers of the benchmarks ask for newer versions of what they
# share with us, and are not published.
oldest() {
    local rust copy
    rust=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
    toolchain "$rust"
    toolchain nightly
    copy=$(mktemp -d)
    git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -t "$copy"
    rm "$copy/Cargo.lock"
    sed -i '/^    "benchmarks",$/d' "$copy/Cargo.toml"
    (
        cd "$copy"
        cargo +nightly generate-lockfile --quiet -Z direct-minimal-versions
        cargo "+$rust" check --quiet --workspace --lib --bins --features $features
        cargo "+$rust" check --quiet -p lagrange-runtime --no-default-features --features libm,double-double
    )
    rm -r "$copy"
}

docs() {
    toolchain nightly
    RUSTDOCFLAGS="--cfg docsrs -D warnings" cargo +nightly doc --quiet --no-deps --features $features \
        -p lagrangian -p lagrange-runtime -p lagrange-ensemble
    local shown
    for shown in lagrangian:ensemble lagrangian:pictures lagrange_runtime:double-double lagrange_ensemble:parquet; do
        grep -rqF "<code>${shown#*:}</code>" "$CARGO_TARGET_DIR/doc/${shown%:*}" ||
            { echo "packages: no page of ${shown%:*} names the feature ${shown#*:}" >&2; exit 1; }
    done
}

# Libraries whose interface is promised; `__private` is hidden from documentation, and so from the comparison. That of
# the attribute is a grammar, which no tool compares.
semver() {
    local revision=${1:-$(git describe --tags --abbrev=0 2>/dev/null || true)} package
    if [ -z "$revision" ]; then
        echo "packages: there is no tag yet, so no promise; scripts/packages.sh semver REV compares with a revision"
        return
    fi
    command -v cargo-semver-checks >/dev/null || cargo install --locked --quiet cargo-semver-checks
    for package in lagrangian lagrange-{ensemble,pictures,runtime}; do
        cargo semver-checks --baseline-rev "$revision" --package "$package"
    done
}

[ $# -gt 0 ] || { usage; exit 2; }
if [ "$1" = semver ]; then
    [ $# -le 2 ] || { usage; exit 2; }
    semver "${2:-}"
    exit
fi
for name in "$@"; do
    case $name in
        files | build | deny | oldest | docs) "$name" ;;
        all) build; deny; oldest; docs; semver ;;
        *) usage; exit 2 ;;
    esac
done
