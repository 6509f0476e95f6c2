#!/bin/sh
# Everything about the C and C++ side in one run: the CMake build and its tests, installation, consumers of the moved prefix,
# sanitizers, valgrind and the ABI guard. Needs cargo, cmake 3.18, gcc, g++, pkg-config and python3; and for the parts that use them
# valgrind, abidiff (abigail-tools), Eigen (libeigen3-dev), CalculiX (calculix-ccx), CGAL (libcgal-dev), TetGen (libtet1.5-dev).
#   capi-tests/check.sh [folder for builds, default target/check]
# The library is that of `cargo build --release`, in cargo's usual folder, so existing builds are reused.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "${1:-$root/target/check}"
work=$(cd "${1:-$root/target/check}" && pwd)
target=${CARGO_TARGET_DIR:-$root/target}
jobs=$(nproc 2>/dev/null || echo 2)
log=$work/log.txt

begin=$(date +%s)
step() { printf '== %s (after %d s)\n' "$*" "$(($(date +%s) - begin))"; }
# Runs a command quietly; shows what it said if it fails.
quiet() {
    "$@" >"$log" 2>&1 || { status=$?; tail -n 60 "$log"; printf 'failed: %s\n' "$*"; exit "$status"; }
}
# A consumer project: source folder, build folder, further arguments for cmake.
consumer() {
    source=$1 build=$2
    shift 2
    rm -rf "$work/$build"
    quiet cmake -S "$root/capi-tests/consumer/$source" -B "$work/$build" "$@"
    quiet cmake --build "$work/$build" -j "$jobs"
    quiet ctest --test-dir "$work/$build" --output-on-failure --no-tests=error
}

# A program under valgrind, in a folder of its own, since several run at once; its report is shown if there is one.
# shellcheck disable=SC2016
memcheck='
    folder=$2/${3##*/}
    mkdir -p "$folder" && cd "$folder" || exit 1
    valgrind -q --suppressions="$1/capi-tests/valgrind.supp" --leak-check=full --show-leak-kinds=definite,indirect,possible \
        --error-exitcode=9 --errors-for-leak-kinds=definite,indirect,possible "$3" >log.txt 2>&1 ||
        { status=$?; tail -n 60 log.txt; echo "failed: valgrind $3, exit code $status"; exit 1; }
'

step "build and test, shared and static"
quiet cmake -S "$root/cmake" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DDELOTET_SANITIZE=OFF -DDELOTET_BUILD_TESTS=ON -DDELOTET_INSTALL=ON \
    -DCMAKE_INSTALL_LIBDIR=lib -DDELOTET_CARGO_TARGET_DIR="$target"
quiet cmake --build "$work/build" -j "$jobs"
quiet ctest --test-dir "$work/build" -j "$jobs" --output-on-failure --no-tests=error
grep 'tests passed' "$log"
sed -n 's/.*\( microseconds per cube\)/&/p' "$work/build/Testing/Temporary/LastTest.log"

step "install, move the prefix, look at the files"
rm -rf "$work/stage" "$work/prefix"
quiet env DESTDIR="$work/stage" cmake --install "$work/build" --prefix /opt/delotet
mv "$work/stage/opt/delotet" "$work/prefix"
version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$root/Cargo.toml" | head -n 1)
soname=libdelotet.so.${version%.*}
for file in include/delotet/delotet.h include/delotet/delotet.hpp lib/libdelotet.a lib/libdelotet.so "lib/$soname" \
    "lib/libdelotet.so.$version" lib/cmake/delotet/delotetConfig.cmake lib/cmake/delotet/delotetConfigVersion.cmake \
    lib/pkgconfig/delotet.pc; do
    [ -e "$work/prefix/$file" ] || { echo "missing: $file"; exit 1; }
done
[ "$(readlink "$work/prefix/lib/libdelotet.so")" = "$soname" ]
[ "$(readlink "$work/prefix/lib/$soname")" = "libdelotet.so.$version" ]
readelf -d "$work/prefix/lib/libdelotet.so" | grep -q "SONAME.*\[$soname\]"
readelf --dyn-syms -W "$work/prefix/lib/libdelotet.so" | grep -q "delotet_version@@$soname\$"
! grep -rn "$work\|/opt/delotet" "$work/prefix/lib/cmake" "$work/prefix/lib/pkgconfig" || { echo "not relocatable"; exit 1; }

# The rest is two halves that run at the same time, each in a process of its own with its own log: what is built around the package, and
# what only uses what is built so far.
around() {
    step "find_package: versions, components, targets"
    minor=${version%.*}
    for request in "" "$minor" "$version" "$minor COMPONENTS shared" "$minor COMPONENTS static" "$minor COMPONENTS shared static"; do
        consumer find find -DCMAKE_PREFIX_PATH="$work/prefix" -DREQUEST="$request"
    done
    for linked in delotet::shared delotet::static; do
        consumer find find -DCMAKE_PREFIX_PATH="$work/prefix" -DTARGET="$linked"
    done
    consumer find find -DCMAKE_PREFIX_PATH="$work/prefix" -DBUILD_SHARED_LIBS=OFF
    ! readelf -d "$work/find/consumer_c" | grep -q libdelotet || { echo "BUILD_SHARED_LIBS=OFF linked the shared library"; exit 1; }
    consumer find find -DCMAKE_PREFIX_PATH="$work/prefix" -DBUILD_SHARED_LIBS=ON
    readelf -d "$work/find/consumer_c" | grep -q "NEEDED.*\[$soname\]"
    for request in 1.0 99 "0.$((${minor#*.} + 1))" "${version%.*}.$((${version##*.} + 1))" "$minor COMPONENTS nonsense"; do
        rm -rf "$work/find"
        quiet cmake -S "$root/capi-tests/consumer/find" -B "$work/find" -DCMAKE_PREFIX_PATH="$work/prefix" \
            -DREQUEST="$request" -DEXPECT_FAILURE=ON
    done

    step "pkg-config, plain gcc"
    export PKG_CONFIG_PATH="$work/prefix/lib/pkgconfig"
    [ "$(pkg-config --modversion delotet)" = "$version" ]
    main=$root/capi-tests/consumer/main
    # shellcheck disable=SC2046
    quiet gcc "$main.c" -o "$work/plain" $(pkg-config --cflags --libs delotet) -Wl,-rpath,"$work/prefix/lib"
    quiet "$work/plain"
    # shellcheck disable=SC2046
    quiet g++ -std=c++17 "$main.cpp" -o "$work/plain" $(pkg-config --cflags --libs delotet) -Wl,-rpath,"$work/prefix/lib"
    quiet "$work/plain"
    # shellcheck disable=SC2046
    quiet gcc -static "$main.c" -o "$work/plain" $(pkg-config --static --cflags --libs delotet)
    quiet "$work/plain"

    step "packaging: cargo, Ninja, strip, manifest, absolute folders, components, exports, plugins"
    quiet "$root/capi-tests/packaging.sh" "$work" "$target"
    grep -e 'bytes, stripped' -e passed "$log"

    step "README and guide: their code blocks, as they stand, in a fresh clone"
    quiet python3 "$root/capi-tests/readme.py" --work "$work/readme" --target "$target" --vendored "$work/vendored"
    grep passed "$log"

    step "add_subdirectory and FetchContent"
    consumer subdirectory subdirectory -DDELOTET_CARGO_TARGET_DIR="$work/vendored"
    # The clone that the README's blocks ran in, under the address and the tag of the guide.
    GIT_CONFIG_GLOBAL="$work/readme/gitconfig"
    export GIT_CONFIG_GLOBAL
    consumer fetch fetch -DDELOTET_CARGO_TARGET_DIR="$work/vendored" -DREPOSITORY="https://example.org/delotet.git" -DREVISION="v$version"
    unset GIT_CONFIG_GLOBAL

    step "ABI: abidiff of two builds, and of one with a function removed"
    if command -v abidiff >/dev/null; then
        "$root/capi-tests/abi/guard.sh" "$work"
    else
        echo "skipped: abidiff is not installed"
    fi
}

inside() {
    log=$work/log-inside.txt
    # The other half renews the links to the shared library in cargo's folder: programs here load the installed one, which is the same.
    LD_LIBRARY_PATH=$work/prefix/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
    export LD_LIBRARY_PATH

    step "examples, through the installed package"
    rm -rf "$work/examples"
    quiet cmake -S "$root/examples-c" -B "$work/examples" -DCMAKE_PREFIX_PATH="$work/prefix"
    quiet cmake --build "$work/examples" -j "$jobs"
    quiet ctest --test-dir "$work/examples" -j "$jobs" --output-on-failure --no-tests=error
    grep 'tests passed' "$log"
    for solved in heat adaptive cantilever; do # Those that could be built and run.
        [ ! -e "$work/examples/$solved.txt" ] || quiet python3 "$root/capi-tests/picture.py" "$work/examples/$solved.ele" \
            --values "$work/examples/$solved.txt" -o "$work/examples/$solved.png"
    done

    step "comparison with CGAL and TetGen"
    if [ -e /usr/include/tetgen.h ] && [ -d /usr/include/CGAL ]; then
        quiet cmake -S "$root/capi-tests/peers" -B "$work/peers" -DCMAKE_PREFIX_PATH="$work/prefix"
        quiet cmake --build "$work/peers" -j "$jobs"
        ctest --test-dir "$work/peers" -V --no-tests=error >"$log" 2>&1 || { cat "$log"; exit 1; }
        sed -n 's/^[0-9]*: //p; /tests passed/p' "$log" | grep -v '^Test \(command\|timeout\)'
    else
        echo "skipped: libcgal-dev or libtet1.5-dev is not installed"
    fi

    step "valgrind"
    if command -v valgrind >/dev/null; then
        rm -rf "$work/valgrind"
        find "$work/build/capi-tests" -maxdepth 1 -type f -perm -u+x \( -name 'c_test_*' -o -name cxx_wrapper -o -name cxx_exceptions \
            -o -name cxx_callbacks -o -name tetgen_memory \) -print0 | quiet xargs -0 -n 1 -P "$jobs" sh -c "$memcheck" sh "$root" "$work/valgrind"
        echo "$(ls "$work"/build/capi-tests/c_test_* | grep -vc '\.') C programs and 4 C++ programs: no errors, no leaks"
    else
        echo "skipped: valgrind is not installed"
    fi

    step "AddressSanitizer and UndefinedBehaviorSanitizer"
    quiet cmake -S "$root/cmake" -B "$work/build" -DDELOTET_SANITIZE=ON
    quiet cmake --build "$work/build" -j "$jobs"
    nm "$work/build/capi-tests/cxx_wrapper" | grep -q __asan_init
    quiet ctest --test-dir "$work/build" -j "$jobs" --output-on-failure --no-tests=error
    grep 'tests passed' "$log"
}

first='' second=''
trap 'exit 130' INT
trap 'exit 143' TERM
trap 'kill $first $second 2>/dev/null || :' EXIT
around &
first=$!
inside >"$work/inside.txt" 2>&1 &
second=$!
status=0
wait "$first" || status=$?
wait "$second" || status=$?
trap - EXIT
cat "$work/inside.txt"
[ "$status" -eq 0 ] || exit "$status"
step "all passed"
