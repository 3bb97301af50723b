#!/usr/bin/env bash
# Draws the pictures of the book and builds it.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
    cat <<'END'
usage: scripts/book.sh COMMAND
  pictures    draws the pictures by the examples and copies them into book/src/pictures/
  build       builds the book into target/book/ (needs mdbook: `cargo install mdbook --locked`, four minutes)
  check       what is drawn is what is committed; where mdbook is there, the book builds and its links resolve

The pictures are committed, because chapters are read on the hosting site as they are, without a build. So they
are small, which `tests/book.rs` sees to, and come from these examples:
END
    printf '  %s\n' "${pictures[@]}"
}

# Each is what an example of that name draws; after a dot stands which of several.
pictures=(arm_control cartesian_pendulum chain_modes double_pendulum heavy_top rocking_block rocking_block.film
    stick_slip whirling_hoop)

staged=target/book-src
built=target/book

pictures() {
    local name
    mkdir -p book/src/pictures
    for name in "${pictures[@]}"; do
        cargo run -q --release --features pictures --example "${name%%.*}" >/dev/null
        cp "target/$name.svg" book/src/pictures/
    done
}

# Chapters link to other files of the repository, `../../benchmarks/STABILITY.md`. In the built book these are pages at
# its end, and other files stand beside them.
build() {
    command -v mdbook >/dev/null || { echo "book: no mdbook here; cargo install mdbook --locked" >&2; exit 1; }
    rm -rf "$staged" "$built"
    mkdir -p "$staged/src"
    cp book/book.toml "$staged/"
    cp -r book/src/. "$staged/src/"
    sed -i 's#](\.\./\.\./#](#g' "$staged"/src/*.md
    local file title
    {
        echo
        echo "# From the repository"
        echo
        sed -nE 's#.*\]\(\.\./\.\./([^)`#]+).*#\1#p; ' book/src/*.md | grep '\.md$' | sort -u | while read -r file; do
            title=$(sed -n 's/^# //p' "$file" | head -n 1)
            echo "- [$title]($file)"
        done
    } >>"$staged/src/SUMMARY.md"
    grep -ohE '\]\(\.\./\.\./[^)#]+' book/src/*.md | sed 's#](\.\./\.\./##' | sort -u | while read -r file; do
        mkdir -p "$staged/src/$(dirname "$file")"
        sed 's#](book/src/#](#g' "$file" >"$staged/src/$file"
    done
    cp -r benchmarks/plots "$staged/src/benchmarks/"
    mdbook build "$staged" -d "$PWD/$built"
    echo "book: $built/index.html"
}

links() {
    local page target broken=0
    while IFS= read -r page; do
        while IFS= read -r target; do
            [ -e "$(dirname "$page")/$target" ] || { echo "$page: $target is not there" >&2; broken=1; }
        done < <(grep -oE '(href|src)="[^"#]+' "$page" | sed -E 's/^[^"]*"//' | grep -vE '^(https?:|mailto:|data:|javascript:)')
    done < <(find "$built" -name '*.html' ! -name 404.html ! -name toc.html)
    return "$broken"
}

check() {
    pictures
    git diff --exit-code --stat -- book/src/pictures || { echo "book: the examples draw other pictures" >&2; exit 1; }
    if command -v mdbook >/dev/null; then
        build
        links
    else
        echo "book: no mdbook here; tests/book.rs has checked links and programs"
    fi
}

case ${1:-} in
    pictures | build | check) "$1" ;;
    *) usage; exit 2 ;;
esac
