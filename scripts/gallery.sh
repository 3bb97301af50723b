#!/usr/bin/env bash
# The gallery: systems in the browser, built and tested in a real one.
set -euo pipefail
cd "$(dirname "$0")/../gallery"

usage() {
    cat <<'END'
usage: scripts/gallery.sh COMMAND
  build       builds all pages into gallery/target/site/ (needs the target wasm32-unknown-unknown)
  lint        formatting and lints of the models
  test        builds and lints them and opens each in Chromium without a window: it moves, energy stays, sliders, keys, dragging and
              addresses act, nothing is wrong for a screen reader or on a phone; pictures go to gallery/target/screens/
              (needs node; installs Chromium where apt-get may)
  serve       builds them and serves them at http://localhost:8000/
END
}

wasm=wasm32-unknown-unknown
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}
out=$PWD/target/site
# The largest module, compressed [bytes]: contacts with friction take 89 kB, friction 50 kB, all others stay below 45 kB.
largest=92160

build() {
    rustup target list --installed | grep -qx $wasm || rustup target add $wasm
    cargo build -q --release --target $wasm --examples
    rm -rf "$out"
    mkdir -p "$out"
    cp site/* "$out/"
    local page module size
    for page in examples/*.rs; do
        cp "$CARGO_TARGET_DIR/$wasm/release/examples/$(basename "$page" .rs).wasm" "$out/"
    done
    cargo run -q --bin gallery >"$out/catalogue.json"
    cargo run -q --manifest-path ../Cargo.toml -p cargo-lagrange -- equations --json >"$out/equations.json"
    for module in "$out"/*.wasm; do
        size=$(gzip -9 <"$module" | wc -c)
        printf '%7d bytes, compressed %6d: %s\n' "$(wc -c <"$module")" "$size" "$(basename "$module")"
        [ "$size" -le $largest ] || { echo "gallery: $module is larger than $largest bytes" >&2; exit 1; }
    done
}

lint() {
    cargo fmt --check
    cargo clippy -q --lib --bins -- -D warnings
    cargo clippy -q --release --target $wasm --examples -- -D warnings
}

browser() {
    local name
    for name in chromium chromium-browser google-chrome; do
        type -P $name && return
    done
    { [ "$(id -u)" = 0 ] && apt-get install -y -qq --no-install-recommends chromium fonts-dejavu-core >/dev/null; } ||
        { echo "gallery: no Chromium here" >&2; exit 1; }
    type -P chromium
}

check() {
    build
    lint
    command -v node >/dev/null || { echo "gallery: no node here" >&2; exit 1; }
    (cd test && npm ci --silent --no-audit --no-fund)
    CHROMIUM=$(browser) SITE=$out SCREENS=$PWD/target/screens node --test test/pages.test.mjs
}

serve() {
    build
    node test/server.mjs "$out" 8000
}

case ${1:-} in
    build | lint | serve) "$1" ;;
    test) check ;;
    *) usage; exit 2 ;;
esac
