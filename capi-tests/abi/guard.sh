#!/bin/sh
# Tests the ABI guard: abidiff finds no change between two builds of the same sources, with and without the program's features, and reports
# a removed function.
#   capi-tests/abi/guard.sh <folder for builds>
# To compare with an older release, build that one with full debug information and run abidiff <old> <new> (no --headers-dir:
# with it changes of structs are filtered out).
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$1
# abidiff reads the types in full debug information; optimization would only take time.
export CARGO_PROFILE_DEV_DEBUG=full CARGO_PROFILE_DEV_OPT_LEVEL=0
rm -rf "$work/abi-source"
mkdir -p "$work/abi-source"
# What the build needs, in a folder of its own, so that the second build is another one and a function can be removed.
(cd "$root" && tar cf - Cargo.toml Cargo.lock src capi-tests/*.rs) | (cd "$work/abi-source" && tar xf -)

# build NAME FOLDER ARGUMENT...: the sources in this folder.
build() {
    name=$1 folder=$2
    shift 2
    cargo build --quiet --lib --locked --manifest-path "$folder/Cargo.toml" --target-dir "$work/abi-target" "$@"
    cp "$work/abi-target/debug/libdelotet.so" "$work/$name"
}
build first.so "$root"
build second.so "$work/abi-source" --no-default-features --features io
abidiff "$work/first.so" "$work/second.so" >"$work/abidiff.txt" || { cat "$work/abidiff.txt"; echo "two builds differ"; exit 1; }

removed=delotet_plc_facet_marker
awk -v name="$removed" '
    /^#\[no_mangle\]/ { held = $0; next }
    held != "" { if (index($0, "fn " name "(") == 0) print held; held = "" }
    { print }' "$root/src/ffi/plc_view.rs" >"$work/abi-source/src/ffi/plc_view.rs"
build removed.so "$work/abi-source" --no-default-features --features io
if abidiff "$work/first.so" "$work/removed.so" >"$work/abidiff.txt"; then
    echo "abidiff did not notice that $removed was removed"
    exit 1
fi
grep -q "$removed" "$work/abidiff.txt"
echo "two builds: no change; without $removed: reported"
