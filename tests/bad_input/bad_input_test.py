#!/usr/bin/env python3
"""Broken input breaks nothing: each entry of the corpus ends with its exit code, in time, in little
memory, with a message that says where, what and what is allowed, and nothing is run or written.

usage: bad_input_test.py GROUP    Environment: BERM, BERM_HAS_SEEPAGE, BERM_HAS_REPORT
"""

import concurrent.futures
import os
import pathlib
import resource
import sys
import tempfile
import time

import broken_drawings
import broken_files
import broken_texts
import doubtful
import every_key

BERM = os.environ["BERM"]
HAS_SEEPAGE = os.environ.get("BERM_HAS_SEEPAGE", "ON").upper() in ("ON", "1", "TRUE")
SLOWDOWN = int(os.environ.get("BERM_SLOWDOWN", "1"))  # of a build with sanitizers
SECONDS = 5 * SLOWDOWN  # of a processor, the longest anything may take
LONGEST = 30 * SLOWDOWN  # seconds of a busy machine
MEGABYTES = 1000 * SLOWDOWN

GROUPS = {
    "texts": lambda: broken_texts.SYNTAX,
    "keys": lambda: broken_texts.KEYS,
    "settings": lambda: broken_texts.SETTINGS,
    "drawings": lambda: broken_drawings.BROKEN,
    "meshes": lambda: broken_files.MESHES,
    "places": lambda: broken_files.PLACES,
    "results": lambda: broken_files.RESULTS,
    "commands": lambda: broken_files.COMMANDS,
    "every_key": every_key.entries,
    "doubtful": lambda: doubtful.ENTRIES,
}


def needs_seepage(entry):
    """Whether another mistake would be told first by a build without the seepage stage."""
    text = entry.files.get("case.toml", "")
    text = text if isinstance(text, str) else ""
    return '"seepage"' in text or entry.code == 0 and "mesh_file" in text or "links" in entry.name \
        or "for a mesh" in entry.name or entry.name.startswith("a mesh")


def limit():
    """No core files; the memory is measured, as libraries reserve more than they use."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST))


def run(command, folder):
    """Exit code, stdout, stderr, seconds of a processor and in all, peak memory in MB."""
    out, err = folder.parent / "out", folder.parent / "err"
    began = time.monotonic()
    child = os.fork()
    if child == 0:
        limit()
        os.chdir(folder)
        for number, path in ((1, out), (2, err)):
            os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
        if command[1] == "as nobody":
            command[:2] = [*broken_files.NOBODY, command[0]]
        os.execvp(command[0], command)
    _, status, used = os.wait4(child, 0)
    return (os.waitstatus_to_exitcode(status), out.read_text(errors="replace"),
            err.read_text(errors="replace"), used.ru_utime + used.ru_stime,
            time.monotonic() - began, used.ru_maxrss / 1000)


def write(folder, files):
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if data is None:
            path.mkdir()
        elif callable(data):
            data(path)
        else:
            path.write_bytes(data if isinstance(data, bytes) else data.encode())


def listing(folder):
    return sorted(str(p.relative_to(folder)) for p in folder.rglob("*"))


def problems(entry):
    """What is wrong with the answer to an entry; the answer."""
    with tempfile.TemporaryDirectory() as scratch:
        os.chmod(scratch, 0o755)
        folder = pathlib.Path(scratch) / "here"
        folder.mkdir()
        write(folder, entry.files)
        before = listing(folder)
        command = [BERM, *(a.replace("@", str(folder)) for a in entry.command)]
        code, out, err, cpu, wall, memory = run(command, folder)
        after = listing(folder)
    said = err + (out if entry.code == 0 else "")
    found = [f"does not say {word!r}" for word in entry.words if word not in said]
    if code != entry.code:
        found.append(f"exit code {code}, not {entry.code}")
    if cpu > SECONDS or wall > LONGEST:
        found.append(f"took {cpu:.1f} s of a processor, {wall:.1f} s in all")
    if memory > MEGABYTES:
        found.append(f"took {memory:.0f} MB")
    if entry.code in (2, 4):
        if after != before:
            found.append(f"left {sorted(set(after) - set(before))}")
        if out:
            found.append(f"printed {out[:200]!r}")
        if entry.nothing_run and entry.code == 2 and "nothing was run" not in err:
            found.append("does not say that nothing was run")
        if len(err) > 1_000_000:
            found.append(f"said {len(err)} bytes")
    return found, said, cpu, memory


def main():
    entries = [entry for entry in GROUPS[sys.argv[1]]() if HAS_SEEPAGE or not needs_seepage(entry)]
    names = [entry.name for entry in entries]
    assert len(names) == len(set(names)), "a name is there twice"
    failed = slowest = largest = 0
    with concurrent.futures.ProcessPoolExecutor(2) as pool:
        for entry, (found, said, cpu, memory) in zip(entries, pool.map(problems, entries)):
            slowest, largest = max(slowest, cpu), max(largest, memory)
            if found:
                failed += 1
                print(f"{entry.name}:", *found, said[:1500], sep="\n  ")
            elif "-v" in sys.argv:
                print(f"{entry.name}: {cpu:.2f} s\n{said[:400]}")
    print(f"{len(entries)} inputs, {failed} failed; slowest {slowest:.1f} s, "
          f"largest {largest:.0f} MB")
    return failed > 0 or not entries


if __name__ == "__main__":
    sys.exit(main())
