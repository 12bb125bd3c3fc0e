#!/usr/bin/env bash
# Compares the time of samples in WebAssembly with that of native packs of SSE 4.2 (docs/wasm.md).
# Usage: lab/wasm/time.sh [REPETITIONS [FILE.JSON]]
set -euo pipefail
cd "$(dirname "$0")/../.."
scripts/build.sh nusselt_wasm nusselt_wasm_native >&2
node lab/wasm/time_samples.mjs build/release/wasm/package build/release/lab/nusselt_wasm_native "$@"
