#!/usr/bin/env bash
# Reads the tables of a study with NumPy, pandas and Polars, which it installs into target/tables by pip.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${CARGO_TARGET_DIR:-target}/tables
[ -x "$folder/venv/bin/python" ] || python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q numpy pandas polars pyarrow
cargo run -q --release -p lagrange-ensemble --features parquet --example tables -- "$folder"
"$folder/venv/bin/python" - "$folder" <<'PYTHON'
import sys
import numpy, pandas, polars

folder = sys.argv[1]
plain = numpy.load(f"{folder}/plain.npy")
assert plain.shape == (4, 5) and plain.dtype == float, (plain.shape, plain.dtype)
assert numpy.isnan(plain[1, 2]) and numpy.isnan(plain).sum() == 1 and plain[3, 4] == 19.5
mixed = numpy.load(f"{folder}/mixed.npy")
assert mixed.dtype.names == ("time", "single", "turns", "small", "byte", "long", "short", "over", "error"), mixed.dtype
assert mixed["long"][3] == 2**50 + 3 and mixed["short"][3] == 2**32 - 4
assert mixed["turns"][3] == -3 and mixed["over"][4] and mixed["error"].nonzero()[0].tolist() == [7]
tables = [
    pandas.read_csv(f"{folder}/mixed.csv"),
    pandas.read_parquet(f"{folder}/mixed.parquet"),
    polars.read_csv(f"{folder}/mixed.csv").to_pandas(),
    polars.read_parquet(f"{folder}/mixed.parquet").to_pandas(),
]
for table in tables:
    there = table.drop(index=7)
    for name in ("time", "single", "turns", "small", "byte", "long", "short", "over"):
        assert (there[name].astype(mixed[name].dtype).to_numpy() == numpy.delete(mixed[name], 7)).all(), name
    assert table["index"].tolist() == list(range(20))
    assert there["error"].isna().all() and there["error_time"].isna().all()
    assert table["error"][7] == 'no "result",\nover two lines' and table["error_time"][7] == 0.25
part = numpy.load(f"{folder}/stored.parts/0000000001.npy", mmap_mode="r")
assert part.tolist() == list(range(10, 20))
print("NumPy", numpy.__version__, "pandas", pandas.__version__, "Polars", polars.__version__, "read all tables")
PYTHON
