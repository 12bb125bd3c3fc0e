"""Processes of this machine, for tests that end or expect some."""
import os
import pathlib


def processes_with(text):
    """Command lines of other processes with this text, by their ids."""
    found = {}
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if text in words and int(folder.name) != os.getpid():
            found[int(folder.name)] = words
    return found
