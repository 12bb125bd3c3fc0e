#!/usr/bin/env bash
# Shows that the kit for GPUs runs in a bare Debian: creates one in a folder, unpacks the kit there, renders without any
# driver, installs a driver in software and runs the kit. Needs root, debootstrap, the network, and `make gpu-kit` before.
# Usage: scripts/check-bare-archive.sh FOLDER bookworm|trixie [OPTION-OF-RUN.SH...]      (trixie is Debian 13)
#   FOLDER   where the root is created; must not exist. About 1.5 GB; remove it afterwards. The report stays in
#            FOLDER/results
#   MIRROR   (environment) Debian mirror; default: the first one that this machine's apt uses for Debian
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,7s/^# //p' "$0" >&2; exit 2; }
kit=$(realpath -m "$(dirname "$0")/../out/nusselt-gpu-kit.tar.xz")
root=$(realpath -m "$1")
suite=$2
shift 2
mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' |
    awk '$2 ~ /^(bookworm|trixie)$/ && !found { print $1; found = 1 }')}

[ "$(id -u)" -eq 0 ] || { echo "must run as root, for debootstrap and chroot" >&2; exit 1; }
[ -e "$kit" ] || { echo "$kit is missing; run make gpu-kit" >&2; exit 1; }
[[ $suite =~ ^(bookworm|trixie)$ ]] || { echo "unknown suite $suite; use bookworm or trixie" >&2; exit 2; }
[ -n "$mirror" ] || { echo "apt has no mirror of Debian; set MIRROR=..." >&2; exit 1; }
[ ! -e "$root" ] || { echo "$root exists; use a folder that does not" >&2; exit 1; }

trap '! mountpoint -q "$root/proc" || umount -l "$root/proc"' EXIT
inside() { env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$root" "$@"; }

debootstrap --variant=minbase "$suite" "$root" "$mirror" >/dev/null
cp /etc/resolv.conf "$root/etc/"
mount -t proc proc "$root/proc"
tar -C "$root" -xf "$kit" # the bare system has no xz

echo "== without a driver and its libraries"
inside /gpu-kit/bin/nusselt render /gpu-kit/share/nusselt/scenes/room.pbrt --spp 4 -o /room.png
if inside /gpu-kit/bin/nusselt-lab gpu device; then echo "a device without a driver" >&2; exit 1; fi

echo "== with a driver in software"
inside apt-get update -qq
inside env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq -o Dpkg::Use-Pty=0 --no-install-recommends \
    mesa-vulkan-drivers >/dev/null
time inside /gpu-kit/run.sh "$@" /results
sed -n 1,20p "$root/results/report.md"
