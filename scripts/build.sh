#!/usr/bin/env bash
# Builds the programs in build/release, without the tests unless that folder is already configured for them.
set -euo pipefail
cd "$(dirname "$0")/.."

[ -e build/release/build.ninja ] || cmake --preset release -DNUSSELT_BUILD_TESTS=OFF
cmake --build build/release --target apps/nusselt/all
