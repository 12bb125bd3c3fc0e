#!/usr/bin/env bash
# Installs the Debian packages of scripts/debian-packages.txt that are missing, on Debian 12 and Debian 13.
# Usage: scripts/setup.sh GROUP
#   check   packages for the library and its tests
#   build   also packages for the programs
#   page    packages for the live page
#   three   packages for the live page and the module for three.js
#   site    packages for the programs, the live page and the site of the documentation
#   wasm    packages for the programs and the library in WebAssembly
#   hlsl    packages for the programs and the shaders in other languages
#   python  packages for the programs and the Python module
#   test    all packages
set -euo pipefail
cd "$(dirname "$0")"

fail() {
    echo "setup: $*" >&2
    exit 1
}

declare -A packages_of=(
    [check]='check' [build]='check|build' [page]='page' [three]='page|three' [site]='check|build|page|site'
    [wasm]='check|build|page|wasm' [hlsl]='check|build|hlsl' [python]='check|build|python' [test]='[a-z]+')
wanted=${packages_of[${1:-none}]:-}
[ -n "$wanted" ] || { sed -n '3,12s/^# //p' setup.sh >&2; exit 2; }

system=$(. /etc/os-release 2>/dev/null && echo "${ID:-unknown} ${VERSION_ID:-}") || system=unknown
case "$system" in
    "debian 12" | "debian 13") ;;
    *) fail "'$system' is not supported; use Debian 12 or Debian 13. Or install the equivalents of" \
        "the packages listed in scripts/debian-packages.txt, then run: cmake --preset release && cmake --build --preset release" ;;
esac

missing=()
while read -r group package in_debian_13 _; do
    [[ $group =~ ^($wanted)$ ]] || continue
    if [ "$system" = "debian 13" ] && [ "$in_debian_13" != "=" ]; then package=$in_debian_13; fi
    [ "$package" != "-" ] || continue
    state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || state=absent
    # npm also comes with other archives' Node.js, which forbids Debian's package of it.
    [ "$state" = installed ] || { [ "$package" = npm ] && command -v npm >/dev/null; } || missing+=("$package")
done <debian-packages.txt
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "packages are missing, and installing them needs root or sudo." \
        "As root: apt-get update && apt-get install ${missing[*]}"
    as_root=(sudo)
fi
echo "setup: installing ${#missing[@]} Debian packages and their dependencies (a few minutes without output): ${missing[*]}"
"${as_root[@]}" apt-get update -qq || fail "apt-get update failed (see above); the packages cannot be installed"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq -o Dpkg::Use-Pty=0 --no-install-recommends "${missing[@]}" >/dev/null ||
    fail "apt-get install failed (see above). Missing: ${missing[*]}"
