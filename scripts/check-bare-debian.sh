#!/usr/bin/env bash
# Shows that `make demo` and `make test` need nothing but a bare Debian 12 with git and make: creates one in a
# folder, copies the tree there, runs both twice and prints the times. Needs root, debootstrap and the network.
# Usage: scripts/check-bare-debian.sh FOLDER [MIRROR]
#   FOLDER  where the root is created; must not exist. About 3 GB; remove it afterwards.
#   MIRROR  Debian mirror; default: the first one that this machine's apt uses for bookworm
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,6s/^# //p' "$0"; exit 2; }
tree=$(cd "$(dirname "$0")/.." && pwd)
root=$(realpath -m "$1")
mirror=${2:-$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' |
    awk '$2 == "bookworm" && !found { print $1; found = 1 }')}

[ "$(id -u)" -eq 0 ] || { echo "needs root, for debootstrap and chroot" >&2; exit 1; }
[ -n "$mirror" ] || { echo "no mirror of bookworm is known to apt; give one as second argument" >&2; exit 1; }
[ ! -e "$root" ] || { echo "$root exists; give a folder that does not" >&2; exit 1; }

trap '! mountpoint -q "$root/proc" || umount -l "$root/proc"' EXIT

times=()
# Runs a command and notes its time.
timed() {
    local start=$SECONDS
    echo "== $1"
    "${@:2}"
    times+=("$(printf '%5d s  %s' $((SECONDS - start)) "$1")")
}
inside() { env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin CI="${CI:-}" chroot "$root" "$@"; }

timed "debootstrap" debootstrap --variant=minbase bookworm "$root" "$mirror" >/dev/null
cp /etc/resolv.conf "$root/etc/"
mount -t proc proc "$root/proc"

mkdir "$root/nusselt"
# Files that git knows or would add: what a commit of this tree holds, without build folders.
git -C "$tree" ls-files -z --cached --others --exclude-standard --deduplicate |
    tar -C "$tree" --null --ignore-failed-read -cf - -T - | tar -C "$root/nusselt" --no-same-owner -xf -

inside apt-get install -y -qq -o Dpkg::Use-Pty=0 --no-install-recommends git make >/dev/null
for run in first second; do
    for target in demo test; do
        timed "make $target, $run run" inside make -C /nusselt "$target"
    done
done
printf '%s\n' "${times[@]}"
