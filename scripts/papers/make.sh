#!/usr/bin/env bash
# Makes a PDF of each paper in docs/papers: out/papers/*.pdf. Needs pandoc and chromium; no LaTeX.
# Usage: scripts/papers/make.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
for program in pandoc chromium; do
    command -v "$program" >/dev/null || { echo "papers/make.sh: needs $program; scripts/setup.sh site test installs it" >&2; exit 1; }
done
rm -rf out/papers
mkdir -p out/papers
cp docs/papers/*.svg docs/papers/paper.css out/papers/
for paper in docs/papers/*.md; do
    name=$(basename "$paper" .md)
    pandoc "$paper" --from=markdown-smart --to=html5 --mathml --standalone --css=paper.css --metadata pagetitle="$name" \
        --output="out/papers/$name.html"
    # Numbers such as 1e-7, which programs print as 1e-07, stay in one piece.
    sed -i -E 's/([0-9]e)-0?([0-9])/\1\&#8209;\2/g' "out/papers/$name.html"
    chromium --headless --no-sandbox --disable-gpu --no-pdf-header-footer --print-to-pdf="out/papers/$name.pdf" \
        "file://$PWD/out/papers/$name.html" 2>"out/papers/$name.log"
    [ -s "out/papers/$name.pdf" ] || { cat "out/papers/$name.log" >&2; exit 1; }
    echo "out/papers/$name.pdf"
done
