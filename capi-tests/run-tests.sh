#!/usr/bin/env bash
# Installs missing packages and runs all tests, in well under half an hour on two cores.
#   bash capi-tests/run-tests.sh
# With DELOTET_TESTS=list in the environment it only lists its steps.
# The whole corpus is another command: capi-tests/run-corpus.sh.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2
. capi-tests/common.sh

packages g++ cmake make pkg-config python3 python3-numpy python3-scipy valgrind abigail-tools binutils libcgal-dev libgmp-dev libmpfr-dev libeigen3-dev \
  calculix-ccx tetgen libtet1.5-dev ninja-build
command -v cargo >/dev/null || { echo "cargo (1.86 or later) is needed: see https://rustup.rs"; exit 2; }

regenerate() {
  local name bad=0
  python3 $data/generate.py all "$work/models" || return 1
  for name in $(python3 $data/generate.py list); do
    cmp "$data/$name" "$work/models/$name" || bad=1
  done
  return $bad
}

picture() {
  "$bin" mesh $data/nested.off -o "$work/nested.ele" --quiet && python3 capi-tests/picture.py "$work/nested.ele" -o "$work/cut.png" &&
    ls -s "$work/cut.png"
}

# A table written by a script: on a page without it, the script must produce it exactly as in the guide.
page() {
  local guide=src/doc/figures.md
  sed '/^<!-- figures: preserve-classics -->/,/^<!-- \/figures -->/{/^<!--/!d}' $guide > "$work/figures.md"
  ! cmp -s $guide "$work/figures.md" || return 1
  python3 capi-tests/preserve_figures.py classics --tetgen --bin "$bin" --page "$work/figures.md" --write &&
    diff <(grep -v '^Measured' $guide) <(grep -v '^Measured' "$work/figures.md")
}

# For all builds of this run, those that CMake starts among them, so that each is made once: code is generated in parts, which all processors
# share, there is nothing to keep for incremental builds, and of debug information what stacks need. Results are the same bytes.
export CARGO_INCREMENTAL=0 CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 CARGO_PROFILE_DEV_DEBUG=limited

step "format" cargo fmt --check
# Every profile is compiled once: documents need what lints have checked, the tests of the release build bring the program and the libraries
# that all steps below use, CMake's among them, and pages of documentation are run as tests in one profile. What is long runs at the same
# time as something else, since each part has stretches that only one processor works on.
step "lints" cargo clippy --all-targets -- -D warnings
step "documents" env RUSTDOCFLAGS="-D warnings -A rustdoc::private_intra_doc_links" cargo doc --no-deps --lib
# With the program's optional command, which costs no build of its own here.
aside "tests, debug" cargo test --features tetgen --no-fail-fast
step "tests, release" cargo test --release --tests --no-fail-fast
step "program" cargo build --release
await
# Without a fresh build an old program would be tested.
case ${failures[*]:-} in *program:*) closing; exit 1 ;; esac
# A copy, since the steps for C and C++ build in the same folder at the same time.
[ "${DELOTET_TESTS:-}" = list ] || { cp $bin "$work/delotet" && bin=$work/delotet; } || exit 2
aside "C and C++: API, package, examples, sanitizers, valgrind, ABI, peers" sh capi-tests/check.sh
step "models are what their generator makes" regenerate
step "models are what they claim" python3 $data/check_models.py
step "meshes of our models" python3 capi-tests/mesh_models.py --bin $bin
for change in turn shift jitter; do
  step "our models, $change" python3 capi-tests/turned_models.py --bin $bin --change $change --seeds 2
done
step "quality agrees with an independent tool" python3 capi-tests/quality_agreement.py --bin $bin
step "small angles end in proportion" python3 capi-tests/small_angles.py --bin $bin
step "picture of a mesh cut open" picture
step "figures that are the same everywhere" python3 capi-tests/preserve_figures.py classics --tetgen --check --bin $bin
step "figures: a page is rewritten" page

if make_judge; then
  python3 $data/generate.py list | sed "s|^|$PWD/$data/|" > "$work/own"
  grep -v '/invalid/' "$work/own" > "$work/own-valid.txt"
  grep '/invalid/' "$work/own" > "$work/own-invalid.txt"
  sed "s|^|$PWD/$shared/corpus/models/|" capi-tests/corpus-sample.txt > "$work/sample"
  grep -v '/bad_' "$work/sample" > "$work/sample-valid.txt"
  grep '/bad_' "$work/sample" > "$work/sample-invalid.txt"
  run() { python3 "$shared/tools/run-corpus" --bin "$bin" --judge "$judge" "$@"; }
  merged() { python3 capi-tests/judge_merged.py --bin "$bin" --judge "$judge" "$@"; }
  for mode in cdt preserve; do
    step "our models, $mode, judged" run --list "$work/own-valid.txt" --mode $mode
    step "sample of the corpus, $mode, judged" run --list "$work/sample-valid.txt" --mode $mode
  done
  step "our models, facets merged, judged" merged --list "$work/own-valid.txt"
  step "sample of the corpus, facets merged, judged" merged --list "$work/sample-valid.txt"
  step "our broken models" run --invalid --list "$work/own-invalid.txt"
  step "sample of the broken models" run --invalid --list "$work/sample-invalid.txt"
  for set in uniform:20000 clustered:10000 sphere:10000 cylinder:5000 grid:8000 plane+1:5000 parabola:300 moment:300; do
    step "Delaunay of ${set#*:} points, ${set%:*}" delaunay "${set%:*}" "${set#*:}"
  done
else
  echo
  echo "NOT RUN: no corpus and judge at $shared; meshes were checked by the program's own check only."
fi
await
closing
