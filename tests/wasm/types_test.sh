#!/usr/bin/env bash
# A program in TypeScript compiles with the types of the package, and does not where it is wrong (types_test.ts).
# Usage: types_test.sh TSC PACKAGE FOLDER
set -euo pipefail
source=$(cd "$(dirname "$0")" && pwd)/types_test.ts
mkdir -p "$3/node_modules"
ln -sfn "$2" "$3/node_modules/nusselt"
cp "$source" "$3"
cd "$3"
echo '{ "type": "module" }' >package.json
"$1" --strict --noEmit --target es2022 --lib es2022,dom --module node16 --moduleResolution node16 types_test.ts
