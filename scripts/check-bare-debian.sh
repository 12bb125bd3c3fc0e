#!/usr/bin/env bash
# Shows that targets of the Makefile need only a bare Debian 12 or 13 with git and make: creates one in a
# folder, copies the tree there, runs the targets twice and prints the times; fails if one of them fails. Needs root, debootstrap and the network.
# Usage: scripts/check-bare-debian.sh FOLDER bookworm|trixie TARGET...      (trixie is Debian 13)
#   FOLDER   where the root is created; must not exist. About 3 GB; remove it afterwards.
#   TARGET   such as demo, check, test
#   MIRROR   (environment) Debian mirror; default: the first one that this machine's apt uses for Debian
set -euo pipefail
[ $# -ge 3 ] || { sed -n '2,7s/^# //p' "$0"; exit 2; }
tree=$(cd "$(dirname "$0")/.." && pwd)
root=$(realpath -m "$1")
suite=$2
shift 2
mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' |
    awk '$2 ~ /^(bookworm|trixie)$/ && !found { print $1; found = 1 }')}

[ "$(id -u)" -eq 0 ] || { echo "must run as root, for debootstrap and chroot" >&2; exit 1; }
[[ $suite =~ ^(bookworm|trixie)$ ]] || { echo "unknown suite $suite; use bookworm or trixie" >&2; exit 2; }
[ -n "$mirror" ] || { echo "apt has no mirror of Debian; set MIRROR=..." >&2; exit 1; }
[ ! -e "$root" ] || { echo "$root exists; use a folder that does not" >&2; exit 1; }

times=()
finish() {
    ! mountpoint -q "$root/proc" || umount -l "$root/proc"
    [ ${#times[@]} -eq 0 ] || printf '%s\n' "${times[@]}"
}
trap finish EXIT

failed=0
# Runs a command and notes its time. The next one runs, too, if it fails.
timed() {
    local start=$SECONDS result=''
    echo "== $1"
    "${@:2}" || { result=', failed' failed=1; }
    times+=("$(printf '%5d s  %s%s' $((SECONDS - start)) "$1" "$result")")
}
inside() { env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin CI="${CI:-}" chroot "$root" "$@"; }

timed "debootstrap" debootstrap --variant=minbase "$suite" "$root" "$mirror" >/dev/null
[ $failed -eq 0 ] || exit 1
cp /etc/resolv.conf "$root/etc/"
# Networks may have certificates of their own.
mkdir -p "$root/usr/local/share/ca-certificates"
cp -r /usr/local/share/ca-certificates/. "$root/usr/local/share/ca-certificates/"
mount -t proc proc "$root/proc"

mkdir "$root/nusselt"
# Files that git tracks or would add, that is, the content of a commit of this tree, without build folders.
git -C "$tree" ls-files -z --cached --others --exclude-standard --deduplicate |
    tar -C "$tree" --null --ignore-failed-read -cf - -T - | tar -C "$root/nusselt" --no-same-owner -xf -

inside apt-get install -y -qq -o Dpkg::Use-Pty=0 --no-install-recommends git make >/dev/null
for run in first second; do
    for target in "$@"; do
        timed "make $target, $run run" inside make -C /nusselt "$target"
    done
done
exit $failed
