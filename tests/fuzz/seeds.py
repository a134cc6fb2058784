#!/usr/bin/env python3
"""Seeds for the fuzz targets: the shipped cases, the corpus of broken inputs, a sound result.

usage: seeds.py FOLDER    BERM: the program that makes the sound result [build/release/berm]
"""

import hashlib
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "bad_input"))
import broken_drawings
import broken_files
import broken_texts
import doubtful

LARGEST = 20000  # bytes


def put(folder, data):
    data = data if isinstance(data, bytes) else data.encode()
    if len(data) <= LARGEST:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / hashlib.sha256(data).hexdigest()[:16]).write_bytes(data)


def after(option, command):
    return [text for flag, text in zip(command, command[1:]) if flag == option]


def grid(columns, rows):
    """Squares of 5 m as bytes of the target `mesh`: a core between shells, a drain at the bottom."""
    across = columns + 1
    data = bytes([across * (rows + 1)])
    for r in range(rows + 1):
        data += b"".join(bytes([20 * (c - columns // 2) & 255, 20 * r]) for c in range(across))
    for r in range(rows):
        for c in range(columns):
            corner = r * across + c + 1
            data += bytes([c == columns // 2, 1, corner, corner + 1, corner + across + 1,
                           corner + across])
    return data + bytes([3, 0, 1, 2, 0, 0]) + bytes([3, 0, 2, 3, 0, 0])


def main():
    out = pathlib.Path(sys.argv[1])
    berm = os.environ.get("BERM", str(ROOT / "build" / "release" / "berm"))
    for path in (ROOT / "cases").glob("*/*.toml"):
        put(out / "case", path.read_bytes())
    corpus = [*broken_texts.BROKEN, *broken_drawings.BROKEN, *doubtful.ENTRIES,
              *broken_files.COMMANDS]
    for entry in corpus:
        text = entry.files.get("case.toml")
        if isinstance(text, (str, bytes)):
            put(out / "case", text)
        for option, target in (("--set", "set"), ("--vary", "vary")):
            if texts := after(option, entry.command):
                put(out / target, "\n".join(texts))
    for entry in broken_files.RESULTS:
        for number, name in enumerate(("result.json", "results.h5", "comparison.json",
                                       "study.json")):
            data = entry.files.get("out/" + name)
            if isinstance(data, (str, bytes)):
                put(out / "result", bytes([number]) + (data if isinstance(data, bytes)
                                                       else data.encode()))
    for columns, rows in ((1, 1), (2, 1), (3, 2), (5, 4)):
        put(out / "mesh", grid(columns, rows))
    sound = out / "sound_results"
    if not sound.exists():
        (out / "case.toml").write_text(doubtful.DAM)
        subprocess.run([berm, "run", str(out / "case.toml"), "--out", str(sound), "--quiet", "--set",
                        "sph.spacing_m=2", "--set", "stability.tolerance=0.2", "--set",
                        "output.figures=false", "--set", "output.report=false"], check=True)
    put(out / "result", b"\0" + (sound / "result.json").read_bytes()[:LARGEST - 1])


if __name__ == "__main__":
    main()
