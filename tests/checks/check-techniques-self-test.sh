#!/usr/bin/env bash
# Shows that check-techniques.py accepts the repository and rejects rows, texts and suites that are wrong.
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
registry=$folder/include/nusselt/techniques.json

fresh() {
    rm -rf "${folder:?}"/*
    mkdir -p "$folder/docs"
    cp -r include shaders "$folder"
    cp -r docs/techniques "$folder/docs"
}

check() { python3 scripts/check-techniques.py "$1" --root "$folder" "${@:2}"; }

# Fails unless the check named $2 complains with the text $3 after the change $1 of the copy.
rejects() {
    fresh
    eval "$1"
    if complaint=$(check "${@:2:1}" "${@:4}"); then
        echo "accepted: $1"
        exit 1
    fi
    grep -qF "$3" <<<"$complaint" || { echo "$1 gives: $complaint"; exit 1; }
}

fresh
check registry
check texts

rejects 'sed -i "s/\"LineArea\"/\"LineAera\"/" "$registry"' registry "does not contain LineAera"
rejects 'sed -i "s/\"density\": \"length\",//" "$registry"' registry "LineArea: the field density is missing"
rejects 'sed -i "s/\"density\": \"length\"/\"densty\": \"length\"/" "$registry"' registry "unknown field densty"
rejects 'sed -i "/\"file\": \"sampling\/line_area\"/d" "$registry"' registry "LineArea: the field glsl is missing"
rejects 'sed -i "s/\"light\": \"line\"/\"light\": \"lamp\"/" "$registry"' registry "light must be one of"
rejects 'sed -i "s/\"inversion\": \"[^\"]*\"/\"inversion\": \"Later.\"/" "$registry"' registry "reason to exempt it"
rejects 'sed -i "s/\"inversion\":/\"inversoin\":/" "$registry"' registry "inversoin, which is not a suite"
rejects 'sed -i "s/^class LineArea/class LineCount {\n LightSample<Real> sample(int);\n};\nclass LineArea/" \
    "$folder/include/nusselt/sampling/line_area.h"' registry "LineCount is not in the registry"
rejects 'sed -i "/line_area.h/d" "$folder/include/nusselt/nusselt.h"' texts "nusselt.h: does not follow"
rejects 'sed -i "/^| .LineArea/d" "$folder/docs/techniques/README.md"' texts "README.md: does not follow"
rejects 'sed -i "s/, .PolygonLtcBiased., / , /" "$folder/docs/techniques/README.md"' texts \
    "the row of ltc.md does not name PolygonLtcBiased"
rejects 'sed -i "/^| .Polygon, area/d" "$folder/docs/techniques/README.md"' texts \
    "the row of polygon_area.md does not name PolygonArea"
rejects 'sed -i "s/^\(| .Line, length.*\`LineArea\`\)/\1, \`LineLtc\`/" "$folder/docs/techniques/README.md"' texts \
    "the row of line_area.md names LineLtc, which has another page"
rejects 'sed -i "/<!-- .techniques -->/d" "$folder/docs/techniques/README.md"' texts "are missing"

# A list of a suite without one technique, or with one that is exempt.
all=$folder.names
# The techniques for which the condition $1 on their row holds.
names() { python3 -c "
import json
print('PacksTest')
for row in json.load(open('include/nusselt/techniques.json')):
    if $1: print('PacksTest/' + row['name'] + '4_float.Name')"; }
trap 'rm -rf "$folder" "$all"' EXIT
names "'packs' not in ' '.join(row.get('exempt', {})).split()" >"$all"
fresh
# The suites that are not given are missing, and nothing else.
complaints=$(check suites "packs=$all") || true
if grep -v "is missing on the command line" <<<"$complaints"; then
    echo "a complete suite was rejected"
    exit 1
fi
names "'packs' not in ' '.join(row.get('exempt', {})).split() and row['name'] != 'LineLtc'" >"$all"
rejects : suites "LineLtc: is not in the suite packs" "packs=$all"
names True >"$all"
rejects : suites "PolygonBrdf: is in the suite packs, although" "packs=$all"
rejects : suites "the suite density is missing" "packs=$all"
