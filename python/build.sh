#!/usr/bin/env bash
# Builds the wheel, with the program inside, into python/dist. Needs Rust and `pip install maturin`.
# `build.sh dev` takes the profile of the tests, which is built faster.
set -euo pipefail
cd "$(dirname "$0")"

profile=${1:-release}
target=${CARGO_TARGET_DIR:-$PWD/../target}
case $profile in dev) folder=debug ;; *) folder=$profile ;; esac
cargo build --profile "$profile" --locked --target-dir "$target" -p peenpose -p peenpose-python
mkdir -p peenpose.data/scripts
strip -o peenpose.data/scripts/peenpose "$target/$folder/peenpose"
CARGO_TARGET_DIR=$target maturin build --profile "$profile" --locked --strip --out dist
