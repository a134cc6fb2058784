#!/usr/bin/env python3
"""Run the verification tests and write what they measured as the table of
docs/verification_measured.md.

    tests/verification/table.py BUILD [--out docs/verification_measured.md] [--filter TESTS]

BUILD is a build directory, such as build/release. What a test records by
tests/support/measured.h becomes a row: of what a test measures more than once, the worst.
Exit code 1 if a test failed; nothing is written then.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

HEAD = """# What the verification tests measured

Written by `tests/verification/table.py build/release`, which runs the tests; not by hand. Rows, claims and references are
those of [verification.md](verification.md). Where an error is measured, its reference is 0. Share: of the bound, how much is
used; the test fails beyond 100 %. Of what one test measures at several places, the worst is shown.

| row | quantity | test | reference | measured | bound | share |
|---|---|---|---|---|---|---|
"""


PROGRAMS = ["seepage_verification", "stability/sph_verification",
            "stability/embankment_verification"]  # whose tests record something


def results(program, tests):
    """gtest's JSON of one program's tests, and whether all of them passed."""
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        done = subprocess.run([program, f"--gtest_output=json:{file.name}",
                               f"--gtest_filter={tests}"], check=False, stdout=subprocess.DEVNULL)
        return json.loads(pathlib.Path(file.name).read_text("utf-8")), done.returncode == 0


def share(record):
    return abs(record["measured"] - record["reference"]) / record["bound"]


def percent(part):
    """Two digits; of what is next to nothing, that it is."""
    return "< 0.01 %" if part < 1e-4 else f"{100 * part:.2g} %" if part < 0.995 else "100 %"


def worst_records(result):
    """(test, record) of every quantity of every test, in the tests' order."""
    worst = {}
    for suite in result["testsuites"]:
        for test in suite["testsuite"]:
            name = f"{suite['name']}.{test['name']}"
            for key, text in test.items():
                if not key.startswith("measured_"):
                    continue
                record = json.loads(text)
                at = (name, record["quantity"])
                if at not in worst or share(record) > share(worst[at]):
                    worst[at] = record
    return [(name, record) for (name, _), record in worst.items()]


def place(row):
    """S-2 comes before S-10."""
    letter, number = re.fullmatch(r"([A-Z]+)-(\d+)", row).groups()
    return "SDFL".find(letter), int(number)


def table(records):
    """The rows as Markdown, by the claims' numbers."""
    lines = []
    for test, record in records:
        row, quantity = record["quantity"].split(" ", 1)
        cells = [row, quantity, f"`{test}`", f"{record['reference']:.6g}",
                 f"{record['measured']:.6g}", f"{record['bound']:.3g}",
                 percent(share(record))]
        lines.append((place(row), "| " + " | ".join(cells) + " |\n"))
    return "".join(line for _, line in sorted(lines, key=lambda pair: pair[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    root = pathlib.Path(__file__).resolve().parents[2]
    parser.add_argument("--out", type=pathlib.Path, default=root / "docs/verification_measured.md")
    parser.add_argument("--filter", default="*", help="as gtest has it")
    options = parser.parse_args()
    records, failed = [], []
    programs = [options.build / "tests" / "verification" / name for name in PROGRAMS]
    for program in filter(pathlib.Path.exists, programs):  # a build may have no seepage stage
        result, good = results(program, options.filter)
        records += worst_records(result)
        if not good:
            failed.append(program.name)
    if failed or not records:
        sys.exit(f"nothing is written: {', '.join(failed)} failed" if failed else "no records")
    options.out.write_text(HEAD + table(records), encoding="utf-8")


if __name__ == "__main__":
    main()
