#!/usr/bin/env python3
"""Break geometries, meshes and fields at random, and let the program read them: it must end with 0, 2
or 4, in 10 s, whatever gmsh and HDF5 do inside.

usage: fuzz_files.py MINUTES FINDINGS    BERM: the program [build/release/berm]
"""

import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "bad_input"))
from bases import GEO, MESH, MSH

BERM = os.environ.get("BERM", str(ROOT / "build" / "release" / "berm"))
SOUND = ROOT / "build" / "fuzz" / "corpus" / "sound_results"
PARTS = [b"-1", b"0", b"99999999999", b"nan", b"1e308", b"{", b"}", b";", b"\n", b"\0", b'"']


def broken(data, dice):
    data = bytearray(data)
    for _ in range(dice.choice((1, 1, 2, 4, 16))):
        at, kind = dice.randrange(len(data) + 1), dice.randrange(6)
        length = dice.choice((1, 1, 2, 8, 64))
        if kind == 0 and at < len(data):
            data[at] ^= 1 << dice.randrange(8)
        elif kind == 1:
            data[at:at + length] = dice.randbytes(length)
        elif kind == 2:
            del data[at:at + length]
        elif kind == 3:
            data[at:at] = dice.choice(PARTS)
        elif kind == 4:
            data[at:at] = data[dice.randrange(len(data) + 1):][:length]
        elif dice.random() < 0.1:
            del data[at:]
    return bytes(data)


def main():
    minutes, findings = float(sys.argv[1]), pathlib.Path(sys.argv[2])
    seed = int(time.time())
    dice = random.Random(seed)
    ran = found = 0
    codes = {}
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        shutil.copytree(SOUND, folder / "out")
        for kind in ("geo", "msh"):
            (folder / f"{kind}.toml").write_text(MESH.replace("drawing.geo", f"drawing.{kind}"))
        seeds = {"drawing.geo": GEO.encode(), "drawing.msh": MSH.encode(),
                 "out/results.h5": (SOUND / "results.h5").read_bytes()}
        commands = {"drawing.geo": ["check", "geo.toml"], "drawing.msh": ["check", "msh.toml"],
                    "out/results.h5": ["report", "out"]}
        end = time.monotonic() + 60 * minutes
        while time.monotonic() < end:
            name = dice.choice(list(seeds))
            data = broken(seeds[name], dice)
            if name == "out/results.h5" and dice.random() < 0.7:  # the tables of contents
                data = broken(seeds[name][:4000], dice) + seeds[name][4000:]
            (folder / name).write_bytes(data)
            try:
                done = subprocess.run([BERM, *commands[name]], cwd=folder, capture_output=True,
                                      timeout=10, check=False)
                code = done.returncode
            except subprocess.TimeoutExpired:
                code = "hangs"
            ran += 1
            codes[code] = codes.get(code, 0) + 1
            if code not in (0, 2, 4):
                found += 1
                kept = findings / f"files-{seed}-{ran}-{name.replace('/', '_')}"
                kept.write_bytes(data)
    print(f"files: {ran} executions in {minutes:g} min, exit codes {codes}, "
          + (f"FOUND {found}: see {findings}" if found else "nothing found"))


if __name__ == "__main__":
    main()
