#!/usr/bin/env bash
# File hygiene. Usage: scripts/check-files.sh format|length|folders|paths [ROOT]
#   format  sources agree with .clang-format (clang-format-14, or the program named by CLANG_FORMAT)
#   length  no source file, shader or script is longer than 600 lines
#   folders no folder has more than 30 files; folders of data (corpora, pictures) do not count
#   paths   no text file names an absolute path that exists on one machine only
set -euo pipefail
cd "${2:-$(dirname "$0")/..}"

sources() { find include src proof lab apps wasm python tests examples \( -name '*.h' -o -name '*.cpp' -o -name '*.cu' \) -print0; }
code() {
    find CMakeLists.txt Makefile include src proof lab apps web wasm python site tests examples shaders scripts cmake -type f \( -name '*.h' \
        -o -name '*.cpp' -o -name '*.cu' -o -name '*.glsl' -o -name '*.comp' -o -name '*.vert' -o -name '*.frag' -o -name '*.in' \
        -o -name '*.py' -o -name '*.ts' -o -name '*.sh' -o -name '*.cmake' -o -name CMakeLists.txt -o -name Makefile \) -print0
}
all_files() { find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o -type f -print0; }

case "${1:-}" in
    format) sources | xargs -0r "${CLANG_FORMAT:-clang-format-14}" --dry-run --Werror ;;
    length)
        code | xargs -0r awk 'FNR == 601 { print FILENAME ": longer than 600 lines"; bad = 1 } END { exit bad }'
        ;;
    folders)
        code | xargs -0r dirname | sort | uniq -c |
            awk '$1 > 30 { print $2 ": " $1 " files, more than 30"; bad = 1 } END { exit bad }'
        ;;
    paths)
        found=$(all_files | xargs -0r grep -nIoE "(^|[ \"'=(<])/[A-Za-z][A-Za-z0-9_]*/[A-Za-z0-9_.-]+" |
            grep -vE ":[^/]?/(bin|dev|etc|proc|sys|tmp|usr)/" || true)
        [ -z "$found" ] || { echo "absolute paths of one machine:"; echo "$found"; exit 1; }
        ;;
    *) echo "usage: scripts/check-files.sh format|length|folders|paths [ROOT]" >&2; exit 2 ;;
esac
