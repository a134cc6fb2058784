#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Four cases by two builds of berm, coarse, and what differs in their results.

    builds.py BERM_A BERM_B                 bit for bit
    builds.py BERM_A BERM_B --relative X    same outcomes; answers and fields within X

Times, versions and what names the build are left aside. Needs h5py. Exit code 1 if the results differ.
"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases" / "two_sided_embankment"
COARSE = ["--set", "sph.spacing_m=1", "--set", "output.figures=false", "--set", "output.report=false"]
# Builds are compared with each other, not with a reference: two meshes will do.
SEEPAGE = ["--set", "seepage.tolerance=3e-3"]
SHAKE = ["--set", "stability.enabled=false", "--set", "runout.factor=3", "--set", "runout.shake_g=0.5",
         "--set", "runout.shake_duration_s=1"]
ASIDE = ("seconds", "performance", "berm", "case")
# What a trial was and found, and the bracket: the same on every build, or the answer is another one.
OUTCOMES = ("outcome", "stands", "fails", "complete", "factor", "at_rest", "kind", "side")
# Held to X. Not so the fields of soil that slides or falls: each particle's way there grows from rounding errors.
ANSWERS = ("factor", "discharge_m2_s", "head", "pore_pressure", "settlement_m", "run_out_m",
           "crest_settlement_m", "settled/displacement", "standing/displacement")


def flattened(value, name=""):
    """Leaves of a result.json by their paths, lists of numbers as one array."""
    if isinstance(value, dict):
        for key, below in value.items():
            if key not in ASIDE:
                yield from flattened(below, f"{name}/{key}")
        return
    try:
        array = np.asarray(value)
    except ValueError:  # ragged
        array = np.asarray(None)
    if isinstance(value, list) and array.dtype.kind not in "if":
        yield f"{name}/length", len(value)
        for i, below in enumerate(value):
            yield from flattened(below, f"{name}/{i}")
    else:
        yield name, array if array.dtype.kind in "if" else value


def results_of(directory):
    """Everything in result.json and in the data sets of results.h5 and the frames, by its name."""
    found = dict(flattened(json.loads((directory / "result.json").read_text())))
    for path in [directory / "results.h5", *sorted(directory.glob("run_out/*.h5"))]:
        with h5py.File(path) as file:
            prefix = f"{path.relative_to(directory)}:"
            file.visititems(lambda name, item, prefix=prefix: found.__setitem__(prefix + name, item[()])
                            if isinstance(item, h5py.Dataset) else None)
    return found


def difference(a, b):
    """Largest difference over the largest value; infinite if the two cannot be compared."""
    if not (isinstance(a, (np.ndarray, np.number)) and isinstance(b, (np.ndarray, np.number))):
        return 0 if np.array_equal(a, b) else math.inf
    if np.shape(a) != np.shape(b):
        return math.inf
    if np.asarray(a).tobytes() == np.asarray(b).tobytes():
        return 0
    largest = float(np.max(np.abs(np.subtract(a, b, dtype=float))))
    scale = float(np.max(np.abs(a)))
    return largest / scale if scale > 0 and math.isfinite(largest) else math.inf


def run(berm, case, directory):
    done = subprocess.run([berm, "run", *case, "--out", directory, "--threads", "1", "--quiet"],
                          capture_output=True, text=True, check=False, timeout=1800)
    if done.returncode not in (0, 3):  # 3: coarse, and perhaps without an answer
        sys.exit(f"{berm} run {' '.join(map(str, case))}: {done.stderr}")
    return results_of(pathlib.Path(directory)) | {"exit code": done.returncode}


def has_seepage(berm):
    text = subprocess.run([berm, "version"], capture_output=True, text=True, check=True).stdout
    return "not built in" not in text


def cases(with_seepage):
    yield "dry", [CASES / "dry.toml", *COARSE]
    yield "hydrostatic", [CASES / "hydrostatic.toml", *COARSE]
    if with_seepage:
        yield "seepage", [CASES / "seepage.toml", *COARSE, *SEEPAGE]
    yield "run-out", [CASES / "dry.toml", *COARSE, *SHAKE]


def compare(name, a, b, relative):
    """Tell what differs; the names of what differs by more than is allowed."""
    if a.keys() != b.keys():
        print(f"{name}: only in one: {sorted(a.keys() ^ b.keys())[:8]}")
    differ = {key: difference(a[key], b[key]) for key in a.keys() & b.keys()}
    bad = list(a.keys() ^ b.keys())
    for key, value in differ.items():
        outcome = key.rsplit("/", 1)[-1] in OUTCOMES or key == "exit code"
        answer = key.endswith(ANSWERS)
        if value > 0 and (relative is None or outcome or answer and value > relative):
            bad.append(key)
    ordered = sorted((k for k in differ if differ[k] > 0), key=differ.get, reverse=True)
    print(f"{name}: {len(differ)} quantities, {len(ordered)} not bitwise equal, {len(bad)} not allowed")
    for end in ANSWERS if relative is not None else ():
        found = [differ[k] for k in differ if k.endswith(end)]
        if found:
            print(f"  {end:24} {max(found):.1e}")
    for key in ordered[:8]:
        print(f"  {differ[key]:8.1e} {key}")
    return bad


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("berm", nargs=2, type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("--relative", type=float, help="largest relative difference allowed")
    options = parser.parse_args()
    bad = []
    with tempfile.TemporaryDirectory() as scratch:
        for name, case in cases(all(map(has_seepage, options.berm))):
            a, b = (run(berm, case, f"{scratch}/{name}_{i}") for i, berm in enumerate(options.berm))
            bad += compare(name, a, b, options.relative)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
