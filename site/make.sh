#!/usr/bin/env bash
# Makes the site with all that belongs to it: out/site. Pictures are kept that are newer than their scene and the renderer.
set -euo pipefail
cd "$(dirname "$0")/.."
nusselt=build/release/apps/nusselt/nusselt
samples=16

mkdir -p out/gallery
for scene in $(<site/gallery.txt); do
    picture=out/gallery/$scene.png
    if [ "$picture" -ot "$nusselt" ] || [ "$picture" -ot "scenes/$scene.pbrt" ]; then
        "$nusselt" render "scenes/$scene.pbrt" --resolution 960x540 --spp $samples --quiet -o "$picture"
    fi
done
echo "Scenes that come with the renderer, as it renders them with $samples samples per pixel and light." >out/gallery/about.txt
build/release/apps/nusselt-lab/nusselt-lab reproduce --quick -o out/report
python3 site/build.py out/site --pictures out/gallery --report out/report --live out/page
echo "The site: out/site/index.html"
