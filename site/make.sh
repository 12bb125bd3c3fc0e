#!/usr/bin/env bash
# Makes the site with all that belongs to it: out/site. Pictures and reports that exist are not made again.
set -euo pipefail
cd "$(dirname "$0")/.."

mkdir -p out/gallery
for scene in $(<site/gallery.txt); do
    [ -e "out/gallery/$scene.png" ] ||
        build/release/apps/nusselt/nusselt render "scenes/$scene.pbrt" --resolution 960x540 --spp 16 --quiet -o "out/gallery/$scene.png"
done
build/release/apps/nusselt-lab/nusselt-lab reproduce --quick -o out/report
python3 site/build.py out/site --pictures out/gallery --report out/report --live out/page
echo "The site: out/site/index.html"
