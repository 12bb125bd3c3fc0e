#!/bin/sh
# Runs a program of this archive with the libraries of this archive: bin/NAME runs lib/programs/NAME.
#
# A process has one copy of each library, and drivers bring needs of their own. Libraries that drivers use, too, therefore
# come from the system; lib/spare has one folder for each of them, for systems that lack it or have an older one.
set -eu
self=$(readlink -f "$0")
root=${self%/bin/*}
program=$root/lib/programs/${self##*/}
path=$root/lib
case $root in
    *[:\;]*)
        echo "${self##*/}: the path '$root' has a colon or a semicolon, which separate folders of libraries; move the archive" >&2
        exit 1
        ;;
esac

# What the system's loader finds, with "not found" where a library or one of its versions is missing. Programs open
# libvulkan.so.1 only when they need it; as a library to preload, it is in the list.
list() { LD_LIBRARY_PATH=$path LD_PRELOAD=libvulkan.so.1 LD_TRACE_LOADED_OBJECTS=1 "$program" 2>&1 || true; }

found=$(list)
case $found in
    *"libc.so.6: version"*)
        needed=$(sed -n 's/^glibc: //p' "$root/MANIFEST")
        echo "${self##*/}: this system's glibc is too old; the program needs version $needed or newer" >&2
        exit 1
        ;;
    *libc.so.6*) ;;
    *)
        echo "${self##*/}: this system cannot run programs for x86-64 Linux with glibc: $found" >&2
        exit 1
        ;;
esac
# A spare library may need another one, so the list is read again until nothing is missing.
changed=yes
while [ "$changed" = yes ]; do
    changed=no
    for folder in "$root/lib/spare/"*; do
        name=${folder##*/}
        case $path: in *:"$folder":*) continue ;; esac
        case $found in
            *"$name => not found"* | *"$name: version"* | *"'$name' from LD_PRELOAD cannot be preloaded"*)
                path=$path:$folder
                changed=yes
                ;;
        esac
    done
    [ "$changed" = no ] || found=$(list)
done

LD_LIBRARY_PATH=$path${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} exec "$program" "$@"
