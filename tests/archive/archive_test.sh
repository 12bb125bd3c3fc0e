#!/usr/bin/env bash
# Packs an archive, unpacks it in an empty folder and checks it there. Shows that the checks reject what is wrong.
# Usage: archive_test.sh gpu-kit|archive BUILD_FOLDER WORK_FOLDER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
what=$1 build=$2 work=$3
fail() {
    echo "$*"
    exit 1
}

rm -rf "$work"
mkdir -p "$work"
"$here/../../scripts/pack.sh" "$what" "$build" "$work/packed.tar.xz"
[ "$(stat -c %s "$work/packed.tar.xz")" -le 22000000 ] || fail "larger than 22 MB"
tar -C "$work" -xf "$work/packed.tar.xz"
root=$(find "$work" -mindepth 1 -maxdepth 1 -type d)
"$here/check_folder.sh" "$root"

# Fails unless the check complains with the text $2 after the change $1.
rejects() {
    local complaint
    rm -rf "$work/broken"
    cp -rl "$root" "$work/broken"
    (cd "$work/broken" && eval "$1")
    if complaint=$("$here/check_folder.sh" "$work/broken" 2>&1); then fail "accepted: $1"; fi
    grep -qF "$2" <<<"$complaint" || fail "$1 gives: $complaint"
}
rejects 'rm lib/libImath*' 'takes libImath'
rejects 'rm -r lib/spare/libz.so.1' 'takes libz.so.1'
rejects 'rm -r lib/spare/libvulkan.so.1' 'the Vulkan loader is missing'
rejects 'sed "s/^glibc: .*/glibc: 2.17/" MANIFEST >M && mv M MANIFEST' 'MANIFEST states glibc 2.17'
rejects 'rm share/doc/nusselt/licences/libtbb*' 'no licence of libtbb'
rejects 'cp lib/libfmt* lib/libc.so.6' 'these belong to the system'
rm -rf "$work/broken"

# Paths of libraries are separated by colons and semicolons, so none can be in the path of the archive.
for separator in ':' ';'; do
    mv "$root" "$root${separator}x"
    if complaint=$("$root${separator}x/bin/nusselt" --version 2>&1); then fail "runs in a path with $separator"; fi
    grep -qF 'move the archive' <<<"$complaint" || fail "in a path with $separator: $complaint"
    mv "$root${separator}x" "$root"
done
