#!/bin/bash
# Programs of others, unmodified, on this library: FreeFEM of Debian with libtet.so.1.5, and on the program: iso2mesh and meshio from PyPI,
# Bullet. Installs them if that is possible; what cannot be run is skipped, and said.
#   capi-tests/tetgen/clients.sh DRIVERS LIBRARY_FOLDER PROGRAM WORK
set -u
drivers=$1 library=$2 program=$3 work=$4
mkdir -p "$work"
passed=0 failed=0 skipped=0
skip() { skipped=$((skipped + 1)); echo "SKIPPED: $1"; }
# drive NAME: the driver of a client.
drive() {
    if BUILD_DIR="$work/$1" TETGEN_SO_DIR="$library" TETGEN_BIN="$program" PYTHON="$work/python/bin/python3" \
        bash "$drivers/$1/run.sh" > "$work/$1.log" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        tail -n 30 "$work/$1.log"
    fi
    grep -a 'passed, [0-9]* failed' "$work/$1.log"
}
debian() {
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || {
            (apt-get update -qq && apt-get install -y -qq --no-install-recommends "$@") > "$work/apt.log" 2>&1
            return
        }
    done
}
python() {
    "$work/python/bin/python3" -c 'import iso2mesh, meshio, skfem' 2>/dev/null && return
    python3 -m venv "$work/python" > "$work/pip.log" 2>&1 || { debian python3-venv && python3 -m venv "$work/python" > "$work/pip.log" 2>&1; }
    "$work/python/bin/pip" install -q iso2mesh meshio scikit-fem >> "$work/pip.log" 2>&1
}
if [ ! -d "$drivers" ]; then
    skip "there are no drivers in $drivers"
else
    if debian freefem++ libfreefem++; then drive abi_debian; else skip "FreeFEM cannot be installed"; fi
    if debian libbullet-dev; then drive bullet_text; else skip "Bullet cannot be installed"; fi
    if python; then drive iso2mesh_cli; else skip "iso2mesh cannot be installed"; fi
fi
echo "clients: $passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
