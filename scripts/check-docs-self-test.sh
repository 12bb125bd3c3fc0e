#!/usr/bin/env bash
# Shows that scripts/fill-docs.py and scripts/fill-line-samples.py fill regions, and that scripts/check-docs.py accepts good pages
# and finds each kind of offence.
set -euo pipefail
scripts=$(cd "$(dirname "$0")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/docs/techniques/images" "$tree/examples"
page=$tree/docs/techniques/page.md

# Expects that the check $1 succeeds or fails ($2); further arguments go to the check.
expect() {
    local check=$1 expected=$2 result
    shift 2
    if "$scripts/check-docs.py" "$check" "$tree" "$@" >"$tree/log" 2>&1; then result=passes; else result=fails; fi
    [ "$result" = "$expected" ] || { echo "check '$check' $result:"; cat "$page" "$tree/log"; exit 1; }
}

# Regions: two reports in the shapes that the program has had, with members that are not known.
cat >"$tree/accuracy.json" <<'END'
{"count": 5, "rows": [
  {"technique": "A", "scalar": "float", "lights": "small", "method": "ours", "backward": [1e-7, 2e-7, 3e-7, null], "new": 1},
  {"technique": "A", "scalar": "double", "lights": "small", "method": "ours", "backward": [9, 9, 9, 9]},
  {"technique": "A", "lights": "small", "method": "floor",
   "backward": {"median": 4e-8, "p99": 5e-8, "p999": 6e-8, "max": 7e-8}},
  {"technique": "A", "lights": "small", "method": "ours, packs", "backward": [9, 9, 9, 9]},
  {"technique": "B", "lights": "large", "method": "ours", "backward": [8, 8, 8, 8]}]}
END
cat >"$tree/samplers.json" <<'END'
[{"technique": "A", "lights": "small", "isa": "avx2", "lanes": 1, "prepare_ns": 12.34, "sample_ns": 5},
 {"technique": "A", "lights": "small", "isa": "avx2", "lanes": 8, "prepare_ns": 2.5, "sample_ns": 0.5, "new": 1}]
END
cat >"$page" <<'END'
Before
<!-- generated: accuracy A -->
<!-- end -->
<!-- generated: cost A -->
old text
<!-- end -->
After
END
expect regions fails
python3 "$scripts/fill-docs.py" "$tree/accuracy.json" "$tree/samplers.json" "Some CPU" "$tree"
diff "$page" - <<'END'
Before
<!-- generated: accuracy A -->
| lights | float | median | 99 % | 99.9 % | max |
| --- | --- | --- | --- | --- | --- |
| small | this library | 1.0e-07 | 2.0e-07 | 3.0e-07 | inf |
|  | exact, rounded | 4.0e-08 | 5.0e-08 | 6.0e-08 | 7.0e-08 |
<!-- end -->
<!-- generated: cost A -->
| lights | scalar | packs of 8, per lane |
| --- | --- | --- |
| small | 12.3 / 5 | 2.5 / 0.5 |

One thread of Some CPU, avx2; ns per light for preparing / per sample.
<!-- end -->
After
END
expect regions passes
echo '<!-- generated: accuracy A -->' >>"$page"
expect regions fails
echo '<!-- generated: cost A --> without accuracy' >"$page"
expect regions fails
printf '<!-- generated: accuracy C -->\n<!-- end -->\n' >"$page"
if python3 "$scripts/fill-docs.py" "$tree/accuracy.json" "$tree/samplers.json" CPU "$tree" 2>/dev/null; then
    echo "a technique without rows was accepted"
    exit 1
fi

# The page of line samples.
mkdir -p "$tree/reports/lines-a" "$tree/docs/images"
cat >"$tree/reports/lines-a/numbers.json" <<'END'
{"scenes": [{"scene": "one", "skipped": false, "series": [{"series": "lines", "order": -1.234, "fit": [4, 256]}]}]}
END
echo drawn >"$tree/reports/lines-a/one-time.svg"
lines=$tree/docs/line-samples.md
printf '<!-- generated: orders lines-a -->\n<!-- end -->\n![one](images/lines-a-one-time.svg)\n' >"$lines"
python3 "$scripts/fill-line-samples.py" "$tree/reports" "Some CPU" "$tree"
diff "$lines" - <<'END'
<!-- generated: orders lines-a -->
|  | one |
| --- | --- |
| lines, N = 4 to 256 | -1.23 |

On Some CPU.
<!-- end -->
![one](images/lines-a-one-time.svg)
END
grep -q drawn "$tree/docs/images/lines-a-one-time.svg"
sed -i 's/false/true/' "$tree/reports/lines-a/numbers.json"
if python3 "$scripts/fill-line-samples.py" "$tree/reports" CPU "$tree" 2>/dev/null; then
    echo "a page without a scene was accepted"
    exit 1
fi
rm "$lines"

# Code.
echo 'int two() { return 1 + 1; } int three();' >"$tree/examples/a.cpp"
printf '```cpp\nint two() {  // comment\n    return 1 + 1;\n}\n\nint three();\n```\n' >"$page"
cp "$page" "$tree/README.md"
expect code passes
printf '```cpp\nint two() { return 2; }\n```\n' >"$page"
expect code fails

# Links.
echo '[a](page.md#part), [b](https://example.org), ![c](images/a.svg)' >"$page"
expect links fails
echo drawn >"$tree/docs/techniques/images/a.svg"
expect links passes

# Pictures, by a program that draws the name that it is told.
printf '#!/bin/sh\nprintf "%%s\\n" "$2" >"$3"\n' >"$tree/program"
chmod +x "$tree/program"
expect pictures fails "$tree/program"
echo a >"$tree/docs/techniques/images/a.svg"
expect pictures passes "$tree/program"
