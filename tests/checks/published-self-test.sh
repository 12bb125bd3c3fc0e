#!/usr/bin/env bash
# Shows that published.py accepts the repository and rejects lists and pages that are wrong.
# Usage: published-self-test.sh NUSSELT_LAB
set -euo pipefail
program=$(realpath "$1")
cd "$(dirname "$0")/../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
list=$folder/lab/report/published.json

fresh() {
    mkdir -p "$folder/lab/report" "$folder/docs"
    cp lab/report/published.json "$list"
    cp docs/reproduce.md "$folder/docs"
}

# Fails unless the script complains with the text $2 after the change $1 of the copy.
rejects() {
    fresh
    eval "$1"
    if complaint=$(python3 scripts/published.py --root "$folder" --program "$program"); then
        echo "accepted: $1"
        exit 1
    fi
    grep -qF "$2" <<<"$complaint" || { echo "$1 gives: $complaint"; exit 1; }
}

fresh
python3 scripts/published.py --root "$folder" --program "$program"
rejects 'sed -i "0,/^      \"wall\"/s//      \"walls\"/" "$list"' "there is neither an experiment nor a command 'walls'"
rejects 'sed -i "0,/^      \"bench gpu\"/s//      \"bench gpus\"/" "$list"' "nor a command 'bench gpus'"
rejects 'sed -i "0,/^      \"bench gpu\"/s//      \"bench\"/" "$list"' "nor a command 'bench'"
rejects 'sed -i "s/\"id\": \"polygons-fig-7\"/\"id\": \"polygons-fig-6\"/" "$list"' "polygons-fig-6: is there twice"
rejects 'sed -i "0,/\"not_applicable\"/s//\"notapplicable\"/" "$list"' "needs one of by, not_applicable and missing"
rejects 'sed -i "0,/\"kind\": \"figure\"/s//\"kind\": \"picture\"/" "$list"' "unknown kind"
rejects 'sed -i "0,/\"why\"/s//\"because\"/" "$list"' "has an own scene without a reason"
rejects 'sed -i "s/An edge of a polygon/A side of a polygon/" "$folder/docs/reproduce.md"' "is out of date"
rejects 'sed -i "s/items: lines /items: tubes /" "$folder/docs/reproduce.md"' "has no lines"
fresh
sed -i 's/An edge of a polygon/A side of a polygon/' "$folder/docs/reproduce.md"
python3 scripts/published.py --root "$folder" --program "$program" --update
cmp docs/reproduce.md "$folder/docs/reproduce.md"
