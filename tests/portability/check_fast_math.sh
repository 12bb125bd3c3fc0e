#!/usr/bin/env bash
# Shows that the library refuses to compile with options that break IEEE arithmetic, with a message that says what to
# do, and compiles with those that do not. Usage: check_fast_math.sh COMPILER...
set -euo pipefail
include=$(cd "$(dirname "$0")/../../include" && pwd)

output() { printf '#include <nusselt/nusselt.h>\n' | "$compiler" -std=c++17 -O2 "$@" -I"$include" -fsyntax-only -x c++ - 2>&1; }

must_fail() {
    local text
    ! text=$(output "$@") || { echo "$compiler $*: compiles"; exit 1; }
    grep -q 'nusselt needs IEEE arithmetic.*-fno-fast-math' <<<"$text" || { echo "$compiler $*: $text"; exit 1; }
}
must_compile() { output "$@" || { echo "$compiler $*: does not compile"; exit 1; }; }

for compiler in "$@"; do
    for option in -ffast-math -Ofast -ffinite-math-only; do
        must_fail $option
        must_compile $option -fno-fast-math
    done
    must_fail -D_M_FP_FAST
    must_compile -ffp-contract=fast
    must_compile -fno-math-errno -fno-trapping-math
    # The parts that only GCC reports.
    if "$compiler" --version | grep -q 'Free Software Foundation'; then
        for option in -funsafe-math-optimizations -freciprocal-math -fno-signed-zeros; do must_fail $option; done
        must_fail -fassociative-math -fno-signed-zeros -fno-trapping-math
    fi
done
