#!/usr/bin/env bash
# Measures what the documentation shows and fills it in again: docs/data, the tables of all pages, and pictures.
# Usage: scripts/update-docs.sh [tables|pictures|viewer|lines|notebooks]
#   tables    only fills the tables of pages from docs/data, which takes a second
#   pictures  only the pictures of docs/techniques, which are the same on every machine
#   viewer    only the picture of docs/viewer.md, which takes a Vulkan driver and xvfb-run
#   lines     only the numbers and plots of docs/line-samples.md, which take half an hour and an idle machine;
#             NUSSELT_SCENES must name the folder with sponza/
#   notebooks only the pages of docs/notebooks, which take the Python module
# Without an argument, pictures, accuracy and cost of the samplers. Other files of docs/data name the command that wrote
# them; run it again with `--json docs/data/FILE` and then `scripts/update-docs.sh tables`.
# NUSSELT names the program; default: build/release/apps/nusselt-lab/nusselt-lab
set -euo pipefail
cd "$(dirname "$0")/.."
program=${NUSSELT:-build/release/apps/nusselt-lab/nusselt-lab}
viewer=build/release/apps/nusselt/nusselt

draw_pictures() {
    for picture in docs/techniques/images/*.svg; do
        "$program" map "$(basename "$picture" .svg)" "$picture"
    done
}

picture_viewer() {
    local script
    script=$(mktemp)
    cat >"$script" <<'END'
tone-curve filmic
exposure 1
light-add tube
light-move 0 -0.2 0
light-turn 0 1 0 30
light-kelvin 2700
frames 6
window-screenshot docs/images/viewer.png
quit
END
    xvfb-run --auto-servernum --server-args='-screen 0 1280x1024x24' "$viewer" view scenes/room.pbrt \
        --resolution 480x360 --script "$script"
    rm "$script"
}

measure_lines() {
    local reports=build/reproduce name plot
    [ -f "${NUSSELT_SCENES:-}/sponza/sponza.pbrt" ] || {
        echo "a scene would be skipped: set NUSSELT_SCENES to the folder that has sponza/sponza.pbrt" >&2
        return 1
    }
    rm -rf "$reports"
    # 1: an expectation does not hold; 3: one could not be evaluated. The numbers are what they are.
    "$program" reproduce lines-orientation lines-offsets lines-pieces lines-large lines-small lines-visibility \
        --full -o "$reports" || case $? in 1 | 3) echo "not all expectations hold" >&2 ;; *) return 1 ;; esac
    for name in lines-orientation lines-offsets lines-pieces lines-large lines-small lines-visibility; do
        cp "$reports/$name/full/numbers.json" "docs/data/$name.json"
    done
    for plot in docs/images/lines-large-*.svg; do
        cp "$reports/lines-large/full/${plot#docs/images/lines-large-}" "$plot"
    done
}

case ${1:-} in
tables) ;;
pictures) draw_pictures ;;
viewer) picture_viewer ;;
lines) measure_lines ;;
notebooks) PYTHONPATH=build/release/python /usr/bin/python3 python/notebooks/run.py docs/notebooks ;;
'')
    draw_pictures
    "$program" bench accuracy --json docs/data/accuracy.json >/dev/null
    "$program" bench samplers --compilers --repetitions 61 --json docs/data/samplers.json >/dev/null
    "$program" bench instructions --isa avx2 --json docs/data/instructions.json >/dev/null
    ;;
*)
    sed -n '3,12s/^# //p' "$0" >&2
    exit 2
    ;;
esac
python3 scripts/fill-docs.py
