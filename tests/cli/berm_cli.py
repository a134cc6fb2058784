"""What the tests of the command line share. Environment: BERM (the program), BERM_SOURCE."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BERM = os.environ["BERM"]
SOURCE = pathlib.Path(os.environ["BERM_SOURCE"])
HAS_SEEPAGE = os.environ.get("BERM_HAS_SEEPAGE", "ON").upper() in ("ON", "1", "TRUE")
HAS_REPORT = os.environ.get("BERM_HAS_REPORT", "ON").upper() in ("ON", "1", "TRUE")
SLOWDOWN = int(os.environ.get("BERM_SLOWDOWN", "1"))  # of a build with sanitizers
CAN_PLOT = os.environ.get("BERM_PLOTS") == "1"
SYSTEM_PYTHON = "/usr/bin/python3"
CAN_VALIDATE = subprocess.run([SYSTEM_PYTHON, "-c", "import jsonschema, tomllib"], check=False,
                              stderr=subprocess.DEVNULL).returncode == 0
CASES = SOURCE / "cases" / "two_sided_embankment"
DRY = str(CASES / "dry.toml")
# Coarse: seconds, not an answer to rely on.
COARSE = ["--set", "sph.spacing_m=3", "--set", "stability.tolerance=0.2"]
NO_FIGURES = ["--set", "output.figures=false"]


def without_times(value):
    """result.json without what a repeated run may change."""
    if isinstance(value, dict):
        kept = {k: v for k, v in value.items() if k not in ("seconds", "performance")}
        return {k: without_times(v) for k, v in kept.items()}
    if isinstance(value, list):
        return [without_times(v) for v in value]
    return value


class BermTest(unittest.TestCase):
    """A scratch directory, and berm run in it."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.dir = pathlib.Path(scratch.name)

    def berm(self, *arguments, code=0):
        """Run in the scratch directory; stdout and stderr, after a look at the exit code."""
        command = [BERM, *map(str, arguments)]
        done = subprocess.run(command, cwd=self.dir, text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout, done.stderr

    def write(self, text, name="case.toml"):
        path = self.dir / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path.name

    def result(self, directory):
        return json.loads((self.dir / directory / "result.json").read_text())

    def run_out(self, directory, *more, code=0):
        shake = ["--set", "runout.shake_g=0.5", "--set", "runout.shake_duration_s=1"]
        return self.berm("run", DRY, "--out", directory, "--set", "stability.enabled=false",
                         "--set", "runout.factor=3", *shake, *COARSE, *more, code=code)

    ANY_USER = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

    def mpirun(self, ranks, *arguments, code=0):
        """As `berm`, in a team. Any user, more ranks than processors."""
        command = ["mpirun", "--oversubscribe", "-n", str(ranks), BERM, *map(str, arguments)]
        done = subprocess.run(command, cwd=self.dir, text=True, capture_output=True, check=False,
                              env=os.environ | self.ANY_USER)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout, done.stderr
