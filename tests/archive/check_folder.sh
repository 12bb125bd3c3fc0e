#!/usr/bin/env bash
# Checks an unpacked archive: it has all libraries that its programs need, the glibc that it states is sufficient, licences
# are there, and a picture is rendered with its libraries alone.
# Usage: check_folder.sh FOLDER
set -euo pipefail
root=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
    echo "archive: $*"
    exit 1
}

# The glibc that symbols need, read with another tool than that of scripts/pack.sh.
stated=$(sed -n 's/^glibc: //p' "$root/MANIFEST")
[[ $stated =~ ^2\.[0-9]+$ ]] || fail "MANIFEST does not state the glibc"
needed=$(find "$root/lib" -path "$root/lib/spare" -prune -o -type f -print0 | xargs -0 readelf -V |
    grep -oE 'Name: GLIBC_2\.[0-9]+' | cut -d_ -f2 | sort -uV | tail -1)
[ "$(printf '%s\n' "$needed" "$stated" | sort -V | tail -1)" = "$stated" ] ||
    fail "MANIFEST states glibc $stated, but symbols need $needed"

# What belongs to the system. Everything else has to be in the archive: with the spare libraries, all paths begin there.
system='^(linux-vdso|ld-linux-x86-64|libc|libm|libdl|libpthread|librt|libresolv)\.so'
path=$root/lib$(printf ':%s' "$root/lib/spare/"*)
count=0
for program in "$root/lib/programs/"*; do
    while read -r name arrow file _; do
        [[ ${name##*/} =~ $system ]] && continue
        [ "$arrow" = "=>" ] && [[ $file == "$root"/* ]] || fail "$(basename "$program") takes $name from $file, not from the archive"
        count=$((count + 1))
    done < <(LD_LIBRARY_PATH=$path LD_TRACE_LOADED_OBJECTS=1 "$program")
done
[ "$count" -ge 8 ] || fail "only $count libraries were found; the list is wrong"
[ -e "$root/lib/spare/libvulkan.so.1/libvulkan.so.1" ] || fail "the Vulkan loader is missing"
if find "$root" -name 'libc.so*' -o -name 'libvulkan_*' -o -name 'ld-linux*' | grep .; then
    fail "these belong to the system"
fi

# Each library comes from a package whose licence is there.
for library in "$root/lib/"*.so* "$root/lib/spare/"*/*; do
    package=$(sed -n "s/^$(basename "$library"): \([^ ]*\) .*/\1/p" "$root/MANIFEST")
    [ -n "$package" ] && [ -s "$root/share/doc/nusselt/licences/$package" ] || fail "no licence of $(basename "$library")"
done
[ -s "$root/share/doc/nusselt/LICENSE" ] || fail "no licence of Nusselt"

# What the process really loads.
LD_DEBUG=libs LD_DEBUG_OUTPUT=$work/loaded LD_LIBRARY_PATH=$path "$root/lib/programs/nusselt" \
    render "$root/share/nusselt/scenes/planes.pbrt" --resolution 32x24 --spp 1 --quiet -o "$work/a.exr" -o "$work/a.png" ||
    fail "nusselt does not run with the libraries of the archive"
foreign=$(sed -n 's/^.*calling init: \(.*\)$/\1/p' "$work"/loaded.* | grep -v "^$root/" | sed 's|.*/||' | grep -vE "$system" || true)
[ -z "$foreign" ] || fail "these libraries came from the system: $foreign"
# As users start it.
"$root/bin/nusselt" convert "$work/a.exr" "$work/b.png" || fail "bin/nusselt does not run"
[ -s "$work/b.png" ] || fail "no picture"
