#!/usr/bin/env bash
# Runs a command with the software Vulkan driver of Debian 13 (Mesa 25), without changes to the system.
# Usage: scripts/mesa25.sh COMMAND [ARGUMENT...]
# The first call downloads the driver and the libraries that it needs, from the mirror in the system's apt
# configuration, to build/mesa25. Needs no root. Exit code 77 if they are not available, else that of the command.
set -euo pipefail
[ $# -gt 0 ] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
folder=$(cd "$(dirname "$0")/.." && pwd)/build/mesa25
libraries=$folder/root/usr/lib/x86_64-linux-gnu

unavailable() {
    echo "mesa25: $*" >&2
    exit 77
}

download() {
    local mirror trusted=
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | grep -m 1 '/debian/*$') ||
        unavailable "no Debian mirror in the configuration of apt"
    apt-get indextargets --format '$(TRUSTED)' "Repo-URI: $mirror" | grep -q yes && trusted='[trusted=yes]'
    rm -rf "$folder" && mkdir -p "$folder"/{lists,archives}/partial "$folder/root"
    echo "deb $trusted $mirror trixie main" >"$folder/sources.list"
    local options=(-qq -o Dir::Etc::SourceList="$folder/sources.list" -o Dir::Etc::SourceParts=- -o Dir::Cache="$folder"
        -o Dir::State="$folder" -o Dir::State::Lists="$folder/lists" -o Dir::Cache::Archives="$folder/archives"
        # The empty status makes apt download all libraries, which must fit each other.
        -o Dir::State::status=/dev/null -o Debug::NoLocking=1)
    echo "mesa25: downloading the driver" >&2
    apt-get "${options[@]}" update >&2 || unavailable "no package lists of Debian 13 from the mirror"
    apt-get "${options[@]}" install --download-only --no-install-recommends -y mesa-vulkan-drivers libvulkan1 libstdc++6 \
        >"$folder/download.log" 2>&1 || unavailable "download failed, see $folder/download.log"
    local package
    for package in "$folder"/archives/*.deb; do dpkg -x "$package" "$folder/root"; done
    # An absolute path would be that of the system's driver.
    sed -i "s|\"library_path\": *\"/[^\"]*/|\"library_path\": \"$libraries/|" \
        "$folder/root/usr/share/vulkan/icd.d/lvp_icd.json"
    rm -rf "$folder"/archives "$folder"/lists "$folder"/*.bin
    touch "$folder/complete"
}

# Two tests at a time may need the driver first.
mkdir -p "$(dirname "$folder")"
exec 9>"$folder.lock"
flock 9
[ -e "$folder/complete" ] || download
exec 9>&-
# The driver comes with its own C library. Missing libraries come from the system.
exec env VK_ICD_FILENAMES="$folder/root/usr/share/vulkan/icd.d/lvp_icd.json" \
    "$libraries/ld-linux-x86-64.so.2" --library-path "$libraries:/usr/lib/x86_64-linux-gnu" "$(command -v "$1")" "${@:2}"
