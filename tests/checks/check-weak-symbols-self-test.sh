#!/usr/bin/env bash
# Shows that scripts/check-weak-symbols.sh accepts inline functions inside an isa_ namespace and rejects shared ones.
# Usage: tests/checks/check-weak-symbols-self-test.sh COMPILER
set -euo pipefail
compiler=$1
check=$(cd "$(dirname "$0")/../../scripts" && pwd)/check-weak-symbols.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Compiles standard input without inlining, so that every inline function used becomes a weak symbol.
compile() { "$compiler" -std=c++17 -O0 -x c++ -c - -o "$folder/$1.o"; }

compile inside <<'CODE'
namespace nusselt { inline namespace isa_avx2 {
template <class T> T twice(T x) { return x + x; }
} }
float use(float x) { return nusselt::twice(x); }
CODE
compile function <<'CODE'
namespace nusselt { template <class T> T twice(T x) { return x + x; } }
float use(float x) { return nusselt::twice(x); }
CODE
compile container <<'CODE'
#include <algorithm>
float use(float a, float b) { return std::max(a, b); }
CODE
compile variable <<'CODE'
namespace nusselt { inline int counter = 0; }
int& use() { return nusselt::counter; }
CODE

"$check" "$folder/inside.o" || { echo "a function inside the namespace was rejected"; exit 1; }
for bad in function container variable; do
    if "$check" "$folder/inside.o" "$folder/$bad.o" >"$folder/report"; then
        echo "the weak symbol of the case '$bad' was not found"
        exit 1
    fi
    grep -q "$bad.o: weak symbol" "$folder/report" || { echo "case '$bad': no object and symbol named"; exit 1; }
done
if "$check" "$folder/absent.o" 2>/dev/null || "$check" 2>/dev/null; then
    echo "no object files, and the check passed"
    exit 1
fi
