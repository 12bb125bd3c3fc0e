#!/usr/bin/env bash
# The single header compiles alone as C++17 without a warning; a program of two files that include it links and prints
# what a program with the folder of headers prints.
# Usage: check_single_header.sh BUILD_FOLDER COMPILER...   BUILD_FOLDER has all_techniques.h
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../..
generated=$1 work=$1/work
shift
# In float and in packs, with 20 seeds each.
lines=$(($(wc -l <"$generated/all_techniques.h") * 2 * 20))

rm -rf "$work"
mkdir -p "$work"
cmake -D OUTPUT="$work/include/nusselt.h" -P "$root/scripts/amalgamate.cmake"
printf '#include <nusselt.h>\n#include <nusselt.h>\n' >"$work/alone.cpp"
for compiler in "$@"; do
    flags=(-std=c++17 -O0 -march=x86-64-v2 -ffp-contract=off -I"$generated")
    strict=(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
    for isa in x86-64 x86-64-v4; do
        "$compiler" -std=c++17 -march=$isa "${strict[@]}" -I"$work/include" -fsyntax-only "$work/alone.cpp"
    done
    "$compiler" "${flags[@]}" -I"$root/include" "$here/use_folder.cpp" -o "$work/folder" &
    "$compiler" "${flags[@]}" "${strict[@]}" -I"$work/include" "$here"/use_single{,_packs}.cpp -o "$work/single"
    wait $!
    "$work/folder" >"$work/folder.txt"
    "$work/single" >"$work/single.txt"
    [ "$(wc -l <"$work/folder.txt")" -eq "$lines" ] || { echo "$compiler: the program prints too little"; exit 1; }
    cmp "$work/folder.txt" "$work/single.txt"
    ! grep -q nan "$work/single.txt" || { echo "$compiler: NaN"; exit 1; }
done
if grep -n 'nusselt/related\|^#include <nusselt/' "$work/include/nusselt.h"; then
    echo "not for the single header"
    exit 1
fi
