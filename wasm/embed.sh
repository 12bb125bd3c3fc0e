#!/usr/bin/env bash
# Writes a module of WebAssembly as a module of JavaScript: compressed, in base64.
# Usage: wasm/embed.sh NUSSELT.WASM OUTPUT.JS
set -euo pipefail
printf 'export const compressed = "%s";\n' "$(gzip --best --no-name <"$1" | base64 --wrap=0)" >"$2"
