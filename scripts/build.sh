#!/usr/bin/env bash
# Builds the programs in build/release, without the tests unless that folder is already configured for them.
# Usage: scripts/build.sh [TARGET...]     (default: the programs of users)
set -euo pipefail
cd "$(dirname "$0")/.."
export CCACHE_BASEDIR=$PWD # clones share what ccache keeps

[ -e build/release/build.ninja ] || cmake --preset release -DNUSSELT_BUILD_TESTS=OFF
[ $# -gt 0 ] || set -- apps/nusselt/all
cmake --build build/release --target "$@"
