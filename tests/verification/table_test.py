#!/usr/bin/env python3
"""The table of what the verification tests measured. Environment: BERM_BUILD."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import table

SCRIPT = pathlib.Path(table.__file__)


def result(*measurements):
    """What gtest writes of one test with these records."""
    records = {f"measured_{i}": json.dumps(dict(zip(("quantity", "measured", "reference", "bound"),
                                                    m))) for i, m in enumerate(measurements)}
    return {"testsuites": [{"name": "Dam", "testsuite": [{"name": "Leaks", "time": "1s"} | records]}]}


class Table(unittest.TestCase):
    def test_of_several_places_the_worst_is_shown(self):
        found = table.worst_records(result(("S-1 head", 5.1, 5, 0.2), ("S-1 head", 4.85, 5, 0.2),
                                           ("S-1 discharge", 2, 2, 1)))
        self.assertEqual([(test, r["measured"]) for test, r in found],
                         [("Dam.Leaks", 4.85), ("Dam.Leaks", 2)])

    def test_rows_are_in_the_order_of_the_claims(self):
        text = table.table(table.worst_records(result(
            ("F-1 factor", 1.6, 1.7, 0.2), ("S-10 head", 1, 0, 4), ("S-2 head", 1, 0, 1))))
        self.assertEqual(text.splitlines(), [
            "| S-2 | head | `Dam.Leaks` | 0 | 1 | 1 | 100 % |",
            "| S-10 | head | `Dam.Leaks` | 0 | 1 | 4 | 25 % |",
            "| F-1 | factor | `Dam.Leaks` | 1.7 | 1.6 | 0.2 | 50 % |"])

    def write(self, programs, *options):
        """Runs the script on programs: by name, scripts for a shell. Its exit code and the table."""
        with tempfile.TemporaryDirectory() as folder:
            build = pathlib.Path(folder) / "tests" / "verification"
            build.mkdir(parents=True)
            for name, text in programs.items():
                (build / name).write_text(f"#!/bin/sh\n{text}\n")
                (build / name).chmod(0o755)
            out = pathlib.Path(folder) / "table.md"
            done = subprocess.run([sys.executable, SCRIPT, folder, "--out", out, *options],
                                  check=False, stderr=subprocess.DEVNULL)
            return done.returncode, out.read_text("utf-8") if out.exists() else None

    def test_nothing_is_written_where_a_test_failed_or_none_measured(self):
        writing = f"echo '{json.dumps(result(('S-1 head', 1, 0, 2)))}' >\"${{1#*json:}}\""
        code, text = self.write({"seepage_verification": writing})
        self.assertEqual(code, 0)
        self.assertTrue(text.endswith("| S-1 | head | `Dam.Leaks` | 0 | 1 | 2 | 50 % |\n"))
        self.assertEqual(self.write({"seepage_verification": f"{writing}; exit 1"}), (1, None))
        self.assertEqual(self.write({"another": writing}), (1, None))

    def test_the_tests_of_the_program_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "table.md"
            subprocess.run([sys.executable, SCRIPT, os.environ["BERM_BUILD"], "--out", out,
                            "--filter", "SoilColumn.Swings*"], check=True)
            rows = [line for line in out.read_text("utf-8").splitlines() if "Swings" in line]
        self.assertEqual(len(rows), 1)
        row, quantity, _, reference, measured, bound, _ = rows[0].strip("| ").split(" | ")
        self.assertEqual((row, quantity), ("D-1", "period [s]"))
        self.assertLess(abs(float(measured) - float(reference)), float(bound))


if __name__ == "__main__":
    unittest.main(verbosity=2)
