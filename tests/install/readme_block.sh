#!/usr/bin/env bash
# Prints the only block of README.md that is written in a language and has a line with some words.
# Usage: readme_block.sh LANGUAGE WORDS
set -euo pipefail
readme=$(cd "$(dirname "$0")/../.." && pwd)/README.md
awk -v fence="\`\`\`$1" -v words="$2" '
    $0 == fence { inside = 1; block = ""; next }
    inside && /^```/ { if (index(block, words)) { printf "%s", block; ++found } inside = 0 }
    inside { block = block $0 "\n" }
    END { exit found != 1 }' "$readme" ||
    { echo "README.md does not have exactly one block of $1 with: $2" >&2; exit 1; }
