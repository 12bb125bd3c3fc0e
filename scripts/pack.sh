#!/usr/bin/env bash
# Packs the programs that were built, with all libraries that they need, for other x86-64 Linux systems. Needs Debian, whose
# packages say where libraries come from and under which licences.
# Usage: scripts/pack.sh gpu-kit|archive [BUILD_FOLDER [OUTPUT]]
#   gpu-kit   nusselt without its viewer, the part of nusselt-lab for GPUs, and run.sh: out/nusselt-gpu-kit.tar.xz
#   archive   nusselt, the library, scenes and documentation: out/nusselt-VERSION-linux-x86_64.tar.xz
# Prints the name of the archive, its size and the glibc that it needs.
set -euo pipefail
here=$(pwd)
what=${1:-} build=${2:-}
[[ $what =~ ^(gpu-kit|archive)$ ]] || { sed -n '4,7s/^# //p' "$0" >&2; exit 2; }
[ -z "$build" ] || build=$(realpath -m "$build")
cd "$(dirname "$0")/.."
build=${build:-build/release}

fail() {
    echo "pack: $*" >&2
    exit 1
}
[ "$(uname -m)" = x86_64 ] || fail "archives are for x86-64; this machine is $(uname -m)"
command -v dpkg-query >/dev/null || fail "needs Debian, for the licences of libraries"

# Libraries that drivers load, too. The archive's copies serve systems that lack them (scripts/archive/launch.sh).
spare=' libvulkan.so.1 libstdc++.so.6 libgcc_s.so.1 libz.so.1 libX11.so.6 libxcb.so.1 libXau.so.6 libXdmcp.so.6 libbsd.so.0 libmd.so.0 '
# What is compiled into the programs, from packages with headers and static libraries.
compiled_in=(libcli11-dev nlohmann-json3-dev libvulkan-dev libimgui-dev)

version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
case $what in
    gpu-kit) built=$build/apps/kit programs=(nusselt nusselt-lab) name=gpu-kit output=out/nusselt-gpu-kit.tar.xz ;;
    archive)
        built=$build/apps/nusselt programs=(nusselt) name=nusselt-$version-linux-x86_64
        output=out/$name.tar.xz
        ;;
esac
[ -z "${3:-}" ] || output=$(cd "$here" && realpath -m "$3")
for program in "${programs[@]}"; do
    [ -x "$built/$program" ] || fail "$built/$program is not built; run make $what"
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/$name
mkdir -p "$root"/{bin,lib/programs,lib/spare,share/nusselt,share/doc/nusselt/licences}

# The name of the package that has a file.
package_of() {
    local path
    for path in "$1" "/usr$1" "${1#/usr}"; do
        dpkg-query -S "$path" 2>/dev/null | head -1 | cut -d: -f1 | grep . && return
    done
    fail "no Debian package has $1, so its licence is unknown"
}

# Lines "NAME PATH" for all libraries that the programs need, and for the one that they open when they need it.
libraries() {
    ldd "${programs[@]/#/$root/lib/programs/}" | awk '/not found/ { print "missing", $1 } $2 == "=>" && $3 ~ /^\// { print $1, $3 }' |
        sort -u
    echo "libvulkan.so.1 $(realpath "$(c++ -print-file-name=libvulkan.so.1)")"
}

if [ "$what" = archive ]; then
    cmake --install "$build" --prefix "$root" >/dev/null
    rm -rf "$root"/bin/*
    mkdir -p "$root/share/doc/nusselt/docs"
    cp README.md CHANGELOG.md CITATION.cff "$root/share/doc/nusselt"
    # The pictures would be an eighth of the archive.
    tar -C docs --exclude='*.png' --exclude='*.jpg' -cf - . | tar -C "$root/share/doc/nusselt/docs" -xf -
else
    cp -r shaders/nusselt "$root/share/nusselt/shaders"
    # The kit has no other pages to link to.
    sed -E 's/\[([^]]+)\]\([a-z-]+\.md[^)]*\)/\1/g' docs/gpu-kit.md >"$root/README.md"
    cp scripts/archive/{each-scene,run}.sh "$root"
fi
cp -r scenes "$root/share/nusselt/scenes"
cp LICENSE "$root/share/doc/nusselt/LICENSE"
for program in "${programs[@]}"; do
    strip -o "$root/lib/programs/$program" "$built/$program"
    install -m 755 scripts/archive/launch.sh "$root/bin/$program"
done

packages=("${compiled_in[@]}")
while read -r library path; do
    [ "$library" != missing ] || fail "$path is not installed"
    package=$(package_of "$path")
    # The C library belongs to the system, as drivers do.
    [ "$package" != libc6 ] || continue
    folder=$root/lib
    [[ $spare != *" $library "* ]] || folder=$root/lib/spare/$library
    mkdir -p "$folder"
    strip --strip-unneeded -o "$folder/$library" "$(realpath "$path")"
    packages+=("$package")
    echo "$library: $package $(dpkg-query -W -f '${Version}' "$package")"
done < <(libraries) >"$work/libraries"

for package in $(printf '%s\n' "${packages[@]}" | sort -u); do
    cp -L "/usr/share/doc/$package/copyright" "$root/share/doc/nusselt/licences/$package"
done
# The copyright files refer to texts of licences that other systems lack.
grep -ohE '/usr/share/common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]' -r "$root/share/doc/nusselt/licences" | sort -u |
    while read -r text; do
        [ ! -e "$text" ] || cp -L "$text" "$root/share/doc/nusselt/licences/common-${text##*/}"
    done

# The newest version of glibc that files ask for.
glibc_of() { objdump -T "$@" | grep -oE 'GLIBC_[0-9.]+' | sort -uV | tail -1 | cut -d_ -f2; }
glibc=$(glibc_of "$root/lib/programs/"* "$root/lib/"*.so*)
spare_glibc=$(glibc_of "$root/lib/spare/"*/*)
commit=$(git rev-parse HEAD 2>/dev/null || echo unknown)
[ -z "$(git status --porcelain 2>/dev/null)" ] || commit+=" with changes"
{
    echo "version: $version"
    echo "commit: $commit"
    echo "built on: $(. /etc/os-release && echo "$PRETTY_NAME"), $(c++ --version | head -1)"
    echo "processors: x86-64-v2 and newer"
    echo "glibc: $glibc"
    echo "glibc for spare libraries: $spare_glibc"
    sort -u "$work/libraries"
} >"$root/MANIFEST"

mkdir -p "$(dirname "$output")"
date=$(git log -1 --format=%cI 2>/dev/null || date -Iseconds)
tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mtime="$date" -cf - "$name" | xz --x86 --lzma2=preset=9,dict=64MiB,lc=4 >"$output"
size=$(stat -c %s "$output")
echo "$output: $((size / 1000000)).$((size / 100000 % 10)) MB, needs glibc $(sed -n 's/^glibc: //p' "$root/MANIFEST") or newer"
# Whoever downloads it shall not wait.
[ "$size" -le 22000000 ] || fail "$output is larger than 22 MB"
