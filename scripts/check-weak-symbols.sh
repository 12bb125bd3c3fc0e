#!/usr/bin/env bash
# Fails if an object file compiled for one instruction set defines a weak symbol whose name lacks the
# instruction set (the inline namespace isa_*). The linker keeps one copy of such a symbol for the whole program:
# an AVX-512 copy would crash the baseline. Usage: scripts/check-weak-symbols.sh OBJECT...
set -euo pipefail

[ $# -gt 0 ] || { echo "check-weak-symbols: no object files given" >&2; exit 2; }

# DW.ref.* are pointers to the exception personality: the same data in every object, and no instructions.
symbols=$(nm --demangle --defined-only --print-file-name -- "$@")
awk '
match($0, /:[0-9a-f]+ [WwVvu] /) {
    object = substr($0, 1, RSTART - 1)
    name = substr($0, RSTART + RLENGTH)
    if (name ~ /(^|[^a-zA-Z0-9_])isa_[a-z0-9]+::/ || name ~ /^DW\.ref\./) next
    # nm does not demangle names of some thousand letters, which lists of techniques have.
    if (name ~ /^_ZN7nusselt[0-9]+isa_/) next
    print object ": weak symbol outside the namespace of its instruction set: " name
    failed = 1
}
END { exit failed }' <<<"$symbols"
