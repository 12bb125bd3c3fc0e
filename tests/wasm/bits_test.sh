#!/usr/bin/env bash
# The package in Node.js has the bits of native code, for hostile and for ordinary lights. The number of lights is no
# multiple of four, so that columns are padded.
# Usage: bits_test.sh NODE PACKAGE NATIVE FILE
set -euo pipefail
cd "$(dirname "$0")/../.."
count=301
[ "${NUSSELT_TEST_EFFORT:-quick}" = quick ] || count=30001
"$3" results "$count" 2 "$4"
"$1" lab/wasm/compare_bits.mjs "$2" "$4"
rm "$4"
