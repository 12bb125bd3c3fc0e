#!/usr/bin/env bash
# Shows that scripts/fill-docs.py fills tables, and that its check accepts good pages and finds each kind of offence.
set -euo pipefail
fill=$(cd "$(dirname "$0")/../../scripts" && pwd)/fill-docs.py
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/docs/data" "$tree/docs/techniques"
page=$tree/docs/techniques/page.md

# Expects that the check passes, or fails with a message that has the text $2.
expect() {
    local result=passes
    python3 "$fill" --check "$tree" >"$tree/log" 2>&1 || result=fails
    if [ "$result" != "$1" ] || { [ "$1" = fails ] && ! grep -qF -- "$2" "$tree/log"; }; then
        echo "the check $result, expected: $*"
        cat "$page" "$tree/log"
        exit 1
    fi
}

cat >"$tree/docs/data/times.json" <<'END'
{"bench": "times", "command": "times --json", "version": null, "machine": {"processor": "Some CPU", "threads": 2},
 "settings": {"isa": "avx2"},
 "tables": [
  {"name": "other", "columns": [{"name": "x"}], "rows": [[1]]},
  {"name": "times", "columns": [{"name": "technique"}, {"name": "lights"}, {"name": "code"},
                                {"name": "time", "unit": "ns"}, {"name": "error"}, {"name": "dark"}], "rows": [
   ["A", "small", "scalar", 1234567, 0, false],
   ["A", "small", "packs", 2.50, 1.5e-7, false],
   ["A", "large", "packs", 20, 0.25, false],
   ["A", "none", "packs", null, null, true],
   ["B", "small", "scalar", 7, 0.5, false]]}]}
END
sed 's/Some CPU/Another/; s/"small"/"tiny"/' "$tree/docs/data/times.json" >"$tree/docs/data/times-2.json"
cat >"$page" <<'END'
Before
<!-- table: times.json times; technique = A; dark = no
| lights | {code} [ns], {isa} |
| {lights} | {time:,} / {1000*error:.1e} |
On {processor}. -->
old text
<!-- end -->
Between
<!-- table: times*.json times; technique != A | C; once
## {technique}, {lights}
| technique | lights | share | half | dark |
| {technique} | {lights} | {error:.0f%} | {time/2:.2f} | {dark} | -->
<!-- end -->
<!-- table: times.json + times-2.json times; code = packs; once
| technique | lights | time |
| {technique} | {lights} | {time} | -->
<!-- end -->
After
END
expect fails 'lags behind'
python3 "$fill" "$tree"
diff "$page" - <<'END'
Before
<!-- table: times.json times; technique = A; dark = no
| lights | {code} [ns], {isa} |
| {lights} | {time:,} / {1000*error:.1e} |
On {processor}. -->
| lights | scalar [ns], avx2 | packs [ns], avx2 |
| --- | --- | --- |
| small | 1 234 567 / 0 | 2.5 / 1.5e-04 |
| large |  | 20 / 2.5e+02 |

On Some CPU.
<!-- end -->
Between
<!-- table: times*.json times; technique != A | C; once
## {technique}, {lights}
| technique | lights | share | half | dark |
| {technique} | {lights} | {error:.0f%} | {time/2:.2f} | {dark} | -->
## B, tiny

| technique | lights | share | half | dark |
| --- | --- | --- | --- | --- |
| B | tiny | 50 % | 3.50 | no |

## B, small

| technique | lights | share | half | dark |
| --- | --- | --- | --- | --- |
| B | small | 50 % | 3.50 | no |
<!-- end -->
<!-- table: times.json + times-2.json times; code = packs; once
| technique | lights | time |
| {technique} | {lights} | {time} | -->
| technique | lights | time |
| --- | --- | --- |
| A | small | 2.50 |
|  | large | 20 |
|  | none |  |
|  | tiny | 2.50 |
|  | large | 20 |
|  | none |  |
<!-- end -->
After
END
expect passes

# Another number in the page, or in the data.
cp "$page" "$tree/good.md"
sed -i 's/| 20 |/| 21 |/' "$page"
expect fails "$page: lags behind"
cp "$tree/good.md" "$page"
sed -i 's/2\.50/2.51/' "$tree/docs/data/times.json"
expect fails "$page: lags behind"
python3 "$fill" "$tree"
expect passes

# Numbers of unknown origin, also in other pages; a reason of one word is none.
cp "$page" "$tree/good.md"
numbers='| a | b |\n|---|---|\n| x | 1.5 |\n| y | 2 |\n'
printf "$numbers" >"$tree/README.md"
expect fails 'README.md: numbers of unknown origin'
printf '<!-- by hand: because -->\n'"$numbers" >"$tree/README.md"
expect fails 'README.md: numbers of unknown origin'
printf '<!-- by hand: These are targets that\nsomebody set. -->\n'"$numbers" >"$tree/README.md"
expect passes
printf '<!-- by hand: These are targets. -->\nThe table:\n\n'"$numbers" >"$tree/README.md"
expect fails 'README.md: numbers of unknown origin'
printf '| a | b |\n|---|---|\n| x | word |\n\n```\n'"$numbers"'```\n' >"$tree/README.md"
expect passes

# A technique without numbers, and numbers that no page shows.
echo 'Only text.' >"$tree/docs/techniques/other.md"
expect fails 'other.md: no table of numbers'
rm "$tree/docs/techniques/other.md"
cp "$tree/docs/data/times.json" "$tree/docs/data/unused.json"
expect fails 'unused.json: no page shows it'
rm "$tree/docs/data/unused.json"
expect passes

# Markers and data that are wrong: also filling fails then.
broken() {
    expect fails "$1"
    if python3 "$fill" "$tree" 2>/dev/null; then echo "filled in spite of '$1'"; exit 1; fi
    cp "$tree/good.md" "$page"
}
sed -i 's/technique = A;/technique = C;/' "$page"
broken 'no such rows'
sed -i 's/times.json times; technique = A/none.json times; technique = A/' "$page"
broken 'no file none.json'
sed -i 's/{time:,}/{speed}/' "$page"
broken 'speed'
sed -i '0,/<!-- end -->/s///' "$page"
broken 'without a template or an end'
sed -i 's/| {lights} | {time:,}/| {time:,}/' "$page"
broken 'not as many cells'
sed -i 's/| lights | {code} \[ns\]/| lights | {isa} [ns]/' "$page"
broken 'two values in one cell'
sed -i 's/"machine"/"host"/' "$tree/docs/data/times.json"
broken "no 'machine'"
