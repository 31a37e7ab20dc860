#!/usr/bin/env bash
# Builds the wheel, with the program inside, into python/dist. Needs Rust and `pip install maturin wheel`.
# `build.sh dev` takes the profile of the tests, which is built faster. `build.sh release 2.17` links against that glibc,
# so that the wheel runs on older systems than this one, too; it needs `pip install cargo-zigbuild ziglang` besides.
set -euo pipefail
cd "$(dirname "$0")"

profile=${1:-release}
glibc=${2:-}
target=${CARGO_TARGET_DIR:-$PWD/../target}
case $profile in dev) folder=debug ;; *) folder=$profile ;; esac
build=(cargo build)
wheel=()
if [ -n "$glibc" ]; then
    triple=$(uname -m)-unknown-linux-gnu
    build=(cargo zigbuild --target "$triple.$glibc")
    wheel=(--zig --target "$triple" --compatibility "manylinux_${glibc/./_}")
    folder=$triple/$folder
fi
python3 -m wheel version >/dev/null
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${build[@]}" --profile "$profile" --locked --target-dir "$target" -p peenpose -p peenpose-python
CARGO_TARGET_DIR=$target maturin build --profile "$profile" --locked --strip --out "$work" "${wheel[@]}"

# What maturin builds is the package alone, as a wheel from the source distribution is.
python3 -m wheel unpack --dest "$work" "$work"/*.whl
unpacked=$(echo "$work"/peenpose-*/)
name=$(basename "$unpacked")
mkdir -p "$unpacked/$name.data/scripts"
strip -o "$unpacked/$name.data/scripts/peenpose" "$target/$folder/peenpose"
mkdir -p dist
python3 -m wheel pack --dest-dir dist "$unpacked"
