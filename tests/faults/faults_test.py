"""Runs that are killed, stopped, refused their disk or their memory.

What is promised: results on disk are those of one complete run, old or new; `berm run --resume`
goes on where a run was killed, and its results are those of a run that was not, bit for bit.
"""

import json
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np
from berm_cli import BERM, DRY, HAS_SEEPAGE, SLOWDOWN, BermTest, without_times

SEEPAGE = str(pathlib.Path(DRY).with_name("seepage.toml"))
# Settling, coarse and fine trials, and a run-out that is cut short: about two seconds.
# Bits are compared, no factor: a bracket of 0.04 takes a handful of trials, one of 0.4 three.
CUT_SHORT = 3  # the soil still moves
CASE = [DRY, "--set", "sph.spacing_m=1.5", "--set", "stability.tolerance=0.02",
        "--set", "output.figures=false", "--set", "output.report=false",
        "--set", "runout.shake_g=0.3", "--set", "runout.shake_duration_s=1",
        "--set", "runout.duration_s=3", "--set", "runout.frame_interval_s=0.5"]
EARLIER = [DRY, "--set", "sph.spacing_m=3", "--set", "stability.tolerance=0.2",
           "--set", "output.figures=false", "--set", "output.report=false"]
ROOM = 100_000  # bytes: more than a case file, less than a file of fields


def fields(path):
    """Every data set of an HDF5 file, by its name."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.__setitem__(name, item[()])
                        if isinstance(item, h5py.Dataset) else None)
    return found


class FaultTest(BermTest):
    """A directory with the results of an earlier run, and the answer of the run that is to come."""

    maxDiff = None  # which number is another one tells what went wrong

    def begin(self, *arguments, **how):
        where = [] if arguments[0] == "--resume" else ["--out", "out"]
        return subprocess.Popen([BERM, "run", *arguments, *where], cwd=self.dir, text=True,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **how)

    def prepare(self, case=None):
        self.case = case or CASE
        self.berm("run", *EARLIER, "--out", "earlier")
        began = time.monotonic()
        self.berm("run", *self.case, "--out", "whole", code=CUT_SHORT)
        self.takes = time.monotonic() - began
        self.earlier, self.whole = (without_times(self.result(d)) for d in ("earlier", "whole"))
        shutil.copytree(self.dir / "earlier", self.dir / "out")

    def end_with(self, run, code):
        _, err = run.communicate(timeout=120 * SLOWDOWN)
        self.assertEqual(run.returncode, code, err)
        return err

    def expect_one_run(self):
        """The results in `out` are the earlier ones, the new ones, or none: never a mixture."""
        path = self.dir / "out" / "result.json"
        if not path.exists():
            return
        result = without_times(json.loads(path.read_text()))
        if result != self.earlier:
            self.assertEqual(result, self.whole)
        self.expect_fields("earlier" if result == self.earlier else "whole")

    def expect_fields(self, of, file="results.h5"):
        mine, theirs = (fields(self.dir / d / file) for d in ("out", of))
        self.assertEqual(mine.keys(), theirs.keys())
        for name, values in mine.items():
            np.testing.assert_array_equal(values, theirs[name], name)

    def expect_whole(self):
        self.assertEqual(without_times(self.result("out")), self.whole)
        self.expect_fields("whole")
        for frame in sorted((self.dir / "whole" / "run_out").glob("*.h5")):
            self.expect_fields("whole", f"run_out/{frame.name}")
        self.assertFalse((self.dir / "out" / "checkpoint").exists())
        self.assertEqual([p.name for p in (self.dir / "out").rglob("*.part")], [])


class Kills(FaultTest):
    """kill -9."""

    def kill_at_random_moments(self, count, seed):
        self.prepare()
        moments = random.Random(seed)
        kills = during_resume = 0
        while kills < count:
            shutil.rmtree(self.dir / "out")
            shutil.copytree(self.dir / "earlier", self.dir / "out")
            arguments = self.case
            while kills < count:  # the run, and what goes on with it, until one gets to its end
                run = self.begin(*arguments)
                try:
                    run.wait(moments.uniform(0.02, 1.1 * self.takes))
                except subprocess.TimeoutExpired:
                    run.kill()
                    kills += 1
                    during_resume += arguments is not self.case
                run.communicate()
                self.expect_one_run()
                if run.returncode == CUT_SHORT:
                    break
                self.assertEqual(run.returncode, -signal.SIGKILL)
                if (self.dir / "out" / "checkpoint" / "run.json").exists():
                    arguments = ["--resume", "out"]
            if run.returncode != CUT_SHORT:
                self.end_with(self.begin(*arguments), CUT_SHORT)
            self.expect_whole()
        print(f"{kills} kills, {during_resume} of them while going on, within {self.takes:.2f} s")

    def test_a_run_that_is_killed_goes_on_to_the_same_bits(self):
        self.kill_at_random_moments(6, seed=1)

    def test_fifty_kills_at_random_moments(self):
        self.kill_at_random_moments(50, seed=2)

    def test_a_damaged_piece_is_computed_again(self):
        self.prepare()
        run = self.begin(*self.case)
        pieces = self.dir / "out" / "checkpoint"
        while len(list(pieces.glob("trial_*[!t]"))) < 3 and run.poll() is None:
            time.sleep(0.01)
        run.kill()
        run.communicate()
        trials = sorted(pieces.glob("trial_*"))
        self.assertGreaterEqual(len(trials), 3)
        trials[0].write_bytes(trials[0].read_bytes()[:-100])
        whole = bytearray(trials[1].read_bytes())
        whole[-1] ^= 1
        trials[1].write_bytes(whole)
        trials[2].write_bytes(b"")
        self.end_with(self.begin("--resume", "out"), CUT_SHORT)
        self.expect_whole()

    def test_work_on_another_case_is_refused(self):
        self.prepare()
        run = self.begin(*self.case)
        while not list((self.dir / "out" / "checkpoint").glob("settled_*")) and run.poll() is None:
            time.sleep(0.01)
        run.kill()
        run.communicate()
        _, err = self.berm("run", *self.case, "--set", "stability.tolerance=0.03", "--out", "out",
                           "--resume", code=2)  # any other value is another case
        self.assertIn("another case", err)
        _, err = self.berm("run", "--resume", "out", "--set", "stability.tolerance=0.03", code=2)
        self.assertIn("another case", err)
        _, err = self.berm("run", "--resume", "out", "--out", "elsewhere", code=2)
        self.assertIn("--out", err)
        _, err = self.berm("run", "--resume", "earlier", code=2)
        self.assertIn("no run to go on with", err)

    def test_what_else_is_in_the_folder_stays(self):
        self.prepare()
        mine = self.dir / "out" / "checkpoint" / "notes.txt"
        mine.parent.mkdir()
        mine.write_text("mine")
        self.end_with(self.begin(*self.case), CUT_SHORT)
        self.assertEqual([p.name for p in mine.parent.iterdir()], ["notes.txt"])

    @unittest.skipUnless(HAS_SEEPAGE, "mpirun needs the build with MPI")
    def test_a_killed_rank_ends_the_team_and_leaves_the_earlier_results(self):
        self.prepare()
        environment = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        team = subprocess.Popen(["mpirun", "--oversubscribe", "-n", "2", BERM, "run", *self.case,
                                 "--threads", "1", "--out", "out"], cwd=self.dir,
                                env=os.environ | environment, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)
        pieces = self.dir / "out" / "checkpoint"
        while not list(pieces.glob("trial_*")) and team.poll() is None:
            time.sleep(0.01)
        ranks = [int(p.name) for p in pathlib.Path("/proc").glob("[0-9]*")
                 if self.parent_of(p) == team.pid and "berm" in self.name_of(p)]
        self.assertEqual(len(ranks), 2)
        os.kill(ranks[1], signal.SIGKILL)
        team.communicate(timeout=30 * SLOWDOWN)
        self.assertNotEqual(team.returncode, 0)
        self.expect_one_run()
        self.end_with(self.begin("--resume", "out"), CUT_SHORT)  # alone
        self.expect_whole()

    @staticmethod
    def parent_of(process):
        try:
            return int((process / "stat").read_text().rsplit(")", 1)[1].split()[1])
        except OSError:
            return 0

    @staticmethod
    def name_of(process):
        try:
            return (process / "cmdline").read_text()
        except OSError:
            return ""


class Stops(FaultTest):
    """SIGINT and SIGTERM: what is known is written, and the run can go on."""

    def test_a_run_that_is_stopped_goes_on_to_the_same_bits(self):
        self.prepare()
        for number in (signal.SIGINT, signal.SIGTERM):
            run = self.begin(*self.case)
            while not list((self.dir / "out" / "checkpoint").glob("trial_*")) and run.poll() is None:
                time.sleep(0.01)
            run.send_signal(number)
            self.end_with(run, 3)
            self.assertTrue(self.result("out")["interrupted"])
            self.assertTrue(list((self.dir / "out" / "checkpoint").glob("trial_*")))
            self.berm("run", "--resume", "out", code=CUT_SHORT)
            self.expect_whole()


class Limits(FaultTest):
    """Disk, directories, memory."""

    def setUp(self):
        super().setUp()
        self.prepare()

    @staticmethod
    def limited(which, amount):
        return lambda: resource.setrlimit(which, (amount, amount))

    def test_files_that_may_not_grow(self):
        run = self.begin(*self.case, preexec_fn=self.limited(resource.RLIMIT_FSIZE, ROOM))
        err = self.end_with(run, 4)
        self.assertIn("out/", err)
        self.expect_one_run()
        self.assertEqual(without_times(self.result("out")), self.earlier)
        self.end_with(self.begin(*self.case), CUT_SHORT)
        self.expect_whole()

    def test_a_full_disk(self):
        disk = self.dir / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=2m", "berm", str(disk)],
                                 check=False, capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("a small disk can be mounted by root only")
        self.addCleanup(subprocess.run, ["umount", str(disk)], check=False)
        shutil.copytree(self.dir / "earlier", disk / "out")
        shutil.rmtree(self.dir / "out")
        (self.dir / "out").symlink_to(disk / "out")
        filler = disk / "filler"
        filler.write_bytes(b"0" * (2 * 2**20 - sum(f.stat().st_size for f in disk.rglob("*")
                                                   if f.is_file()) - ROOM))
        err = self.end_with(self.begin(*self.case), 4)
        self.assertIn("out/", err)
        self.assertEqual(without_times(self.result("out")), self.earlier)
        self.expect_fields("earlier")

    def test_after_the_last_piece_of_work_only_the_results_are_left_to_write(self):
        in_the_way = self.dir / "out" / "results_particles.xdmf"
        in_the_way.unlink()
        in_the_way.mkdir()
        err = self.end_with(self.begin(*self.case), 4)
        self.assertIn(in_the_way.name, err)
        self.expect_one_run()
        in_the_way.rmdir()
        self.end_with(self.begin("--resume", "out"), CUT_SHORT)
        self.expect_whole()

    def test_a_directory_in_use(self):
        run = self.begin(*self.case)
        while not (self.dir / "out" / "checkpoint" / "run.json").exists() and run.poll() is None:
            time.sleep(0.01)
        run.send_signal(signal.SIGSTOP)  # however slow the machine
        _, err = self.berm("run", *EARLIER, "--out", "out", code=4)
        self.assertIn("another berm works in this directory", err)
        run.send_signal(signal.SIGCONT)
        self.end_with(run, CUT_SHORT)
        self.expect_whole()

    def test_a_directory_that_cannot_be_one(self):
        (self.dir / "file").write_text("")
        for place in ("file", "file/below", "/proc/berm"):
            _, err = self.berm("run", *self.case, "--out", place, code=4)
            self.assertIn(place, err)

    @unittest.skipIf(SLOWDOWN > 1, "sanitizers reserve terabytes of addresses")
    def test_too_little_memory(self):
        free = self.begin(*EARLIER)
        most = 0
        while free.poll() is None:
            try:
                status = pathlib.Path(f"/proc/{free.pid}/status").read_text()
                most = max(most, int(status.split("VmSize:")[1].split()[0]))
            except (OSError, IndexError):
                pass
        free.communicate()
        shutil.rmtree(self.dir / "out")
        shutil.copytree(self.dir / "earlier", self.dir / "out")
        run = self.begin(DRY, "--set", "sph.spacing_m=0.05", "--threads", "1",
                         preexec_fn=self.limited(resource.RLIMIT_AS, (most + 50_000) * 1024))
        err = self.end_with(run, 3)
        self.assertIn("out of memory", err)
        self.assertEqual(without_times(self.result("out")), self.earlier)

    @unittest.skipUnless(HAS_SEEPAGE, "seepage alone fails to converge")
    def test_a_solve_that_does_not_converge(self):
        # More water is drawn out of the crest than the soil yields.
        (self.dir / "well.toml").write_text(
            pathlib.Path(SEEPAGE).read_text() + "\n[[seepage.boundary]]\n"
            'line_m = [[99.83, 28.6], [107.13, 28.6]]\nkind = "inflow"\nvalue = -1e-6\n')
        run = self.begin("well.toml")
        err = self.end_with(run, 3)
        self.assertIn("not converged", err)
        self.assertEqual(without_times(self.result("out")), self.earlier)


if __name__ == "__main__":
    unittest.main()
