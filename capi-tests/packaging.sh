#!/bin/sh
# Special cases of the CMake project and its package: no suitable cargo, Ninja, --strip, the manifest, absolute folders, missing components,
# exported targets of a project that contains delotet, plugins that contain the static library.
#   capi-tests/packaging.sh WORK TARGET      folder for builds, cargo's folder for the default features
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1/packaging"
work=$(cd "$1/packaging" && pwd)
vendored=$(mkdir -p "$1/vendored" && cd "$1/vendored" && pwd)
target=$(mkdir -p "$2" && cd "$2" && pwd)
version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$root/Cargo.toml" | head -n 1)
rust=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' "$root/Cargo.toml")
log=$work/log.txt
good=0
bad=0

# check NAME COMMAND...: counts; shows what the command said if it fails.
check() {
    name=$1
    shift
    if "$@" >"$log" 2>&1; then
        good=$((good + 1))
        printf '%s: ok\n' "$name"
    else
        bad=$((bad + 1))
        tail -n 40 "$log"
        printf '%s: FAILED\n' "$name"
    fi
}
# configure FOLDER ARGUMENT...: the project itself.
configure() {
    build=$1
    shift
    cmake -S "$root/cmake" -B "$work/$build" -DDELOTET_CARGO_TARGET_DIR="$target" -DCMAKE_INSTALL_LIBDIR=lib "$@"
}

# says PATTERN COMMAND...: it fails, and its message, joined into one line, matches.
says() {
    pattern=$1
    shift
    if words=$("$@" 2>&1); then
        printf '%s\nsucceeded\n' "$words"
        return 1
    fi
    printf '%s\n' "$words" | tr -s '\n ' '  ' | grep -q "$pattern" || { printf '%s\nlacks: %s\n' "$words" "$pattern"; return 1; }
}

# cargo_says PATTERN LINE: with a fake cargo that consists of this line of shell.
cargo_says() {
    rm -rf "$work/cargo-build" "$work/fake"
    mkdir -p "$work/fake"
    printf '#!/bin/sh\n%s\n' "$2" >"$work/fake/cargo"
    chmod +x "$work/fake/cargo"
    says "$1" env PATH="$work/fake:$PATH" cmake -S "$root/cmake" -B "$work/cargo-build"
}
# A PATH with what CMake needs, and no cargo.
no_cargo() {
    rm -rf "$work/cargo-build" "$work/bare"
    mkdir -p "$work/bare"
    for tool in cmake cc c++ gcc g++ make ld as ar ranlib nm strip uname sh; do
        ! command -v $tool >/dev/null || ln -s "$(command -v $tool)" "$work/bare/$tool"
    done
    says 'cargo, which builds the library, .*https://rustup.rs' \
        env -u CARGO_HOME HOME="$work/bare" PATH="$work/bare" cmake -S "$root/cmake" -B "$work/cargo-build"
}
older=1.$((${rust#1.} - 1)).3
check "no cargo: CMake names rustup" no_cargo
check "an old cargo: CMake names both versions and rustup" \
    cargo_says "version $older, but delotet needs $rust or later.*https://rustup.rs" "echo 'cargo $older (0123456 2025-01-01)'"
check "a cargo without toolchain: CMake shows what it says" \
    cargo_says 'no default is configured.*https://rustup.rs' 'echo "error: no default is configured" >&2; exit 1'
enough() { ! cargo_says nothing "echo 'cargo $rust.0 (0123456 2025-01-01)'" && [ -e "$work/cargo-build/Makefile" ]; }
check "the oldest cargo that will do" enough

# Ninja, and the whole installation from its build folder.
ninja() {
    rm -rf "$work/ninja"
    configure ninja -G Ninja && cmake --build "$work/ninja" && cmake --build "$work/ninja" | grep -q 'no work to do'
}
# A folder that cargo filled before CMake saw it, as after `cargo build --release`: only the name that the loader looks for is missing.
# (Ninja runs every command in a new build folder; Make asks only which files are old.)
filled() {
    rm -rf "$work/filled" "$target"/release/libdelotet.so.*
    configure filled -G 'Unix Makefiles' && cmake --build "$work/filled" && [ -e "$target/release/libdelotet.so.${version%.*}" ]
}
installed() { (cd "$1" && find . ! -type d | sed 's|^\.||' | sort); }
manifest() {
    rm -rf "$work/plain"
    DESTDIR="$work/plain" cmake --install "$work/ninja" --prefix /opt/d &&
        sort "$work/ninja/install_manifest.txt" >"$work/manifest" && installed "$work/plain" | diff "$work/manifest" - &&
        grep -qx "/opt/d/lib/libdelotet.so.$version" "$work/manifest" && grep -qx /opt/d/bin/delotet "$work/manifest" &&
        for file in include/delotet/tetgen/tetgen.h lib/libdelotet_tetgen.a lib/pkgconfig/delotet-tetgen.pc lib/delotet/tetgen/tetgen \
            lib/delotet/tetgen/libtet.so.1.5 lib/delotet/tetgen/libtet.so; do
            grep -qx "/opt/d/$file" "$work/manifest" || { echo "missing: $file"; return 1; }
        done
}
size() { wc -c <"$1/opt/d/$2"; }
strip_() {
    rm -rf "$work/stripped"
    DESTDIR="$work/stripped" cmake --install "$work/ninja" --prefix /opt/d --strip || return 1
    installed "$work/stripped" | diff "$work/manifest" - || return 1
    for file in "lib/libdelotet.so.$version" lib/libdelotet.a bin/delotet; do
        [ "$(size "$work/stripped" "$file")" -lt "$(size "$work/plain" "$file")" ] || { echo "$file is no smaller"; return 1; }
    done
    ! readelf -S "$work/stripped/opt/d/lib/libdelotet.so" | grep -q debug_line && "$work/stripped/opt/d/bin/delotet" --version &&
        gcc "$root/capi-tests/consumer/main.c" -o "$work/main" -I"$work/stripped/opt/d/include" \
            "$work/stripped/opt/d/lib/libdelotet.a" -lutil -lrt -lpthread -lm -ldl && "$work/main"
}
check "Ninja: builds, and then has nothing to do" ninja
check "a folder that cargo filled before: the library gets the name that the loader looks for" filled
check "install: the manifest is complete" manifest
check "install --strip: library, archive and program" strip_
for file in "lib/libdelotet.so.$version" lib/libdelotet.a bin/delotet; do
    printf '%s: %d bytes, stripped %d\n' "$file" "$(size "$work/plain" "$file")" "$(size "$work/stripped" "$file")"
done

# Folders given as absolute paths, as some distributions do.
absolute() {
    rm -rf "$work/absolute" "$work/dev" "$work/out"
    configure absolute -DCMAKE_INSTALL_PREFIX="$work/out" -DCMAKE_INSTALL_LIBDIR="$work/dev/lib64" \
        -DCMAKE_INSTALL_INCLUDEDIR="$work/dev/include" && cmake --build "$work/absolute" && cmake --install "$work/absolute" &&
        rm -rf "$work/absolute-user" &&
        cmake -S "$root/capi-tests/consumer/find" -B "$work/absolute-user" -DREQUEST="$version" \
            -Ddelotet_DIR="$work/dev/lib64/cmake/delotet" && cmake --build "$work/absolute-user" &&
        ctest --test-dir "$work/absolute-user" --output-on-failure --no-tests=error &&
        [ "$(readlink "$work/dev/lib64/libdelotet.so")" = "libdelotet.so.${version%.*}" ] &&
        # shellcheck disable=SC2046
        PKG_CONFIG_PATH="$work/dev/lib64/pkgconfig" sh -c \
            'gcc "$1" -o "$2" $(pkg-config --cflags --libs delotet) -Wl,-rpath,$(pkg-config --variable=libdir delotet) && "$2"' \
            sh "$root/capi-tests/consumer/main.c" "$work/main"
}
check "absolute CMAKE_INSTALL_LIBDIR and CMAKE_INSTALL_INCLUDEDIR" absolute

# What takes TetGen's place: delotet::tetgen, pkg-config, and a library and a program in a folder of their own.
tetgen_target() {
    rm -rf "$work/tetgen"
    cmake -S "$root/capi-tests/consumer/tetgen" -B "$work/tetgen" -DCMAKE_PREFIX_PATH="$work/plain/opt/d" "$@" &&
        cmake --build "$work/tetgen" && ctest --test-dir "$work/tetgen" --output-on-failure --no-tests=error
}
# tetgen_compiled ARGUMENT...: what pkg-config says, with these arguments for it.
tetgen_compiled() {
    # shellcheck disable=SC2046
    PKG_CONFIG_PATH="$work/plain/opt/d/lib/pkgconfig" sh -c \
        'source=$1 program=$2; shift 2; g++ "$source" -o "$program" $(pkg-config --cflags --libs "$@" delotet-tetgen)' \
        sh "$root/capi-tests/consumer/tetgen/main.cpp" "$work/main" "$@" && LD_LIBRARY_PATH="$work/plain/opt/d/lib" "$work/main"
}
# A program that was linked to another libtet gets this one without being compiled again: here to one that has the names and nothing else.
tetgen_swapped() {
    mkdir -p "$work/other"
    include=$work/plain/opt/d/include/delotet/tetgen
    library=$work/plain/opt/d/lib/delotet/tetgen
    printf '#include <tetgen.h>\nint tetrahedralize(char *, tetgenio *, tetgenio *, tetgenio *, tetgenio *) { return 1; }\n' >"$work/other/tet.cpp"
    g++ -shared -fPIC -I"$include" "$work/other/tet.cpp" -Wl,-soname,libtet.so.1.5 -o "$work/other/libtet.so" &&
        ln -sf libtet.so "$work/other/libtet.so.1.5" &&
        g++ "$root/capi-tests/consumer/tetgen/main.cpp" -o "$work/swapped" -I"$include" -L"$work/other" -ltet &&
        ! LD_LIBRARY_PATH="$work/other" "$work/swapped" && LD_LIBRARY_PATH="$library" "$work/swapped" || return 1
    readelf -d "$library/libtet.so" | grep -q 'SONAME.*\[libtet.so.1.5\]' && ! readelf -d "$library/libtet.so" | grep -q libdelotet || return 1
    ! nm -D --defined-only "$library/libtet.so" | grep -v -e _Z14tetrahedralizeP -e _ZN8tetgenio -e _ZN14tetgenbehavior
}
tetgen_program() {
    (cd "$work" && printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' >simplex.off &&
        "$work/plain/opt/d/lib/delotet/tetgen/tetgen" -pQ simplex.off && head -n 1 simplex.1.ele | grep -qx '1  4  0')
}
check "delotet::tetgen: both layouts" tetgen_target
check "delotet::tetgen: static" tetgen_target -DBUILD_SHARED_LIBS=OFF
check "pkg-config delotet-tetgen" tetgen_compiled
check "pkg-config delotet-tetgen, static" tetgen_compiled --static
check "libtet.so.1.5 takes the place of another" tetgen_swapped
check "the program tetgen" tetgen_program

# What find_package says.
find_says() {
    rm -rf "$work/find"
    says "$1" cmake -S "$root/capi-tests/consumer/find" -B "$work/find" -DCMAKE_PREFIX_PATH="$work/half/opt/d" -DREQUEST="$2"
}
rm -rf "$work/half"
cp -a "$work/plain" "$work/half"
rm "$work/half/opt/d/lib/libdelotet.a"
check "a component that there is not: said" \
    find_says "there is no component 'nonsense': the components are shared and static" "$version COMPONENTS nonsense"
check "a component that is not installed: said" \
    find_says "the component 'static' is not installed: .*libdelotet.a does not exist" "$version COMPONENTS static"

# A project that contains delotet and exports its own targets.
export_() {
    rm -rf "$work/export" "$work/wrap" "$work/user"
    cmake -S "$root/capi-tests/consumer/export" -B "$work/export" -DDELOTET_CARGO_TARGET_DIR="$vendored" -DCMAKE_INSTALL_LIBDIR=lib &&
        cmake --build "$work/export" && cmake --install "$work/export" --prefix "$work/wrap" &&
        [ ! -e "$work/wrap/bin/delotet" ] &&
        cmake -S "$root/capi-tests/consumer/export/user" -B "$work/user" -DCMAKE_PREFIX_PATH="$work/wrap" &&
        cmake --build "$work/user" && ctest --test-dir "$work/user" --output-on-failure --no-tests=error
}
check "install(EXPORT) of a project that contains delotet" export_

# Plugins: they export nothing of the archive.
plugin() {
    rm -rf "$work/plugin"
    cmake -S "$root/capi-tests/consumer/plugin" -B "$work/plugin" -DCMAKE_PREFIX_PATH="$work/plain/opt/d" &&
        cmake --build "$work/plugin" && ctest --test-dir "$work/plugin" --output-on-failure --no-tests=error || return 1
    [ "$(nm -D --defined-only "$work/plugin/libone.so" | sed 's/.* //')" = wrap_cube ] || { nm -D --defined-only "$work/plugin/libone.so"; return 1; }
}
check "two plugins with the static library: they export nothing of it" plugin
printf '%d passed, %d failed\n' "$good" "$bad"
[ "$bad" -eq 0 ]
