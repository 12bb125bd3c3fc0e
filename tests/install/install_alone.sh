#!/usr/bin/env bash
# A machine with cmake and a compiler only: the commands in README.md install the library without a build, the programs
# and the tests are left out with a line each, and asking for them is an error that names packages.
# Usage: install_alone.sh WORK_FOLDER COMPILER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$1 compiler=$2

fail() { echo "$*"; exit 1; }

rm -rf "$work"
mkdir -p "$work/tree" "$work/home"
# What the library consists of; the rest of the tree must not matter.
cp -r "$root"/{CMakeLists.txt,LICENSE,cmake,data,include,scripts,shaders} "$work/tree"
# cmake looks for packages and programs in an empty folder.
cat >"$work/alone.cmake" <<END
set(CMAKE_MAKE_PROGRAM $(command -v ninja) CACHE FILEPATH "")
set(CMAKE_CXX_COMPILER $compiler)
set(CMAKE_FIND_ROOT_PATH $work/home)
foreach(kind PACKAGE LIBRARY INCLUDE PROGRAM)
    set(CMAKE_FIND_ROOT_PATH_MODE_\${kind} ONLY)
endforeach()
END
export CMAKE_TOOLCHAIN_FILE=$work/alone.cmake CMAKE_GENERATOR=Ninja HOME=$work/home

cd "$work/tree"
commands=$("$here/readme_block.sh" sh "cmake --install")
bash -euxo pipefail -c "$commands" | tee "$work/output" || fail "the commands in README.md fail"
for part in programs tests; do
    [ "$(grep -c "^-- The $part are left out because these Debian packages are missing: lib" "$work/output")" -eq 1 ] ||
        fail "no line says that the $part are left out"
done

! cmake -S . -B "$work/programs" -DNUSSELT_BUILD_RENDERER=ON &>"$work/output" || fail "the programs need no packages"
grep -q libembree-dev "$work/output" || fail "the programs do not name their packages"
! cmake -S . -B "$work/tests" -DNUSSELT_BUILD_TESTS=ON &>"$work/output" || fail "the tests need no packages"
grep -q qemu-user "$work/output" || fail "the tests do not name their packages"

unset CMAKE_TOOLCHAIN_FILE CMAKE_GENERATOR
"$here/consume.sh" "$HOME/nusselt-library" "$work" "$compiler"
