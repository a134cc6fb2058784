#!/usr/bin/env python3
"""`berm study`: designs, resumption, interruption, tables. See berm_cli.py."""

import csv
import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import time
import unittest

from berm_cli import (BERM, CAN_PLOT, CASES, COARSE, DRY, HAS_SEEPAGE, NO_FIGURES, SOURCE, BermTest)


class Study(BermTest):
    def study(self, *arguments, code=0):
        """A study of the coarse dry case, two members at a time."""
        return self.berm("study", DRY, *COARSE, *NO_FIGURES, "--jobs", 2, *arguments, code=code)

    def table(self, directory):
        with (self.dir / directory / "study.csv").open(encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def start_study(self, *arguments, spacing=1):
        """In the background, one member at a time, each of a second or so."""
        angles = "soil.fill.friction_angle_deg=30:38:5"
        command = [BERM, "study", DRY, "--vary", angles, "--set", f"sph.spacing_m={spacing}",
                   *NO_FIGURES, "--jobs", "1", "--out", "out", *arguments]
        study = subprocess.Popen(command, cwd=self.dir, text=True, stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE)
        self.addCleanup(study.kill)
        self.addCleanup(study.communicate)
        return study

    def wait_for(self, what):
        """Its value, once that is true."""
        deadline = time.monotonic() + 60
        while not (value := what()):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        return value

    def results(self):
        return sorted((self.dir / "out" / "members").glob("*/result.json"))

    @staticmethod
    def children(process):
        """Their ids; of a Popen or of an id."""
        number = getattr(process, "pid", process)
        path = pathlib.Path(f"/proc/{number}/task/{number}/children")
        return [int(child) for child in path.read_text().split()]

    def test_a_study_runs_every_combination_and_tabulates_it(self):
        out, err = self.study("--vary", "soil.fill.cohesion_kPa=5,20", "--vary",
                              "soil.fill.friction_angle_deg=25:35:2", "--out", "out")
        self.assertIn("4 of 4", err)
        self.assertEqual(out.count("F = "), 4)
        rows = self.table("out")
        self.assertEqual([(r["soil.fill.cohesion_kPa"], r["soil.fill.friction_angle_deg"])
                          for r in rows], [("5", "25"), ("5", "35"), ("20", "25"), ("20", "35")])
        factors = [float(row["factor"]) for row in rows]
        self.assertEqual(factors[0], min(factors))
        self.assertEqual(factors[3], max(factors))
        study = json.loads((self.dir / "out" / "study.json").read_text())
        self.assertTrue(study["complete"])
        for member, row in zip(study["members"], rows):
            stability = self.result(pathlib.Path("out") / member["directory"])["stability"]
            self.assertEqual(member["factor"], stability["factor"])
            self.assertAlmostEqual(float(row["factor"]), stability["factor"], places=7)
        # A member alone, as its overrides say, finds the same.
        last = study["members"][3]
        self.berm("run", DRY, *[x for o in last["overrides"] for x in ("--set", o)], "--out", "one")
        self.assertEqual(self.result("one")["stability"]["factor"], last["factor"])
        if CAN_PLOT:
            reading = "import h5py,sys; f=h5py.File(sys.argv[1]); print(*f['factor'][()])"
            done = subprocess.run(["/usr/bin/python3", "-c", reading, self.dir / "out/study.h5"],
                                  check=True, text=True, capture_output=True)
            self.assertEqual([float(x) for x in done.stdout.split()], factors)

    def test_pairs_and_one_at_a_time_are_designs_of_their_own(self):
        vary = ["--vary", "soil.fill.cohesion_kPa=5,13.8,20", "--vary",
                "soil.fill.friction_angle_deg=30,36,40"]
        out, _ = self.study(*vary, "--pairs", "--check")
        self.assertEqual(out.count("not run"), 3)
        out, _ = self.study(*vary, "--one-at-a-time", "--check")
        self.assertEqual(out.count("not run"), 6)  # the base has 13.8 itself
        _, err = self.study(*vary[:2], "--vary", "sph.spacing_m=1,2", "--pairs", code=2)
        self.assertIn("allowed: 3, as of soil.fill.cohesion_kPa", err)
        self.study(*vary, "--pairs", "--one-at-a-time", code=2)
        self.assertEqual(list(self.dir.iterdir()), [])

    def test_all_mistakes_of_all_members_are_told_before_anything_runs(self):
        _, err = self.study("--vary", "soil.fill.cohesion_kPa=-1,5,-2", "--vary",
                            "soil.fill.poisson_ratio=0.3,0.7", "--vary", "sph.spcing_m=1", code=2)
        for text in (
            "cohesion_kPa=-1: soil.fill.cohesion_kPa = -1\n",
            "cohesion_kPa=-2: soil.fill.cohesion_kPa = -2\n",
            "poisson_ratio = 0.7\n  allowed: 0 <= poisson_ratio < 0.5\n  members: 3 of 6",
            "unknown key sph.spcing_m",
            "did you mean spacing_m?",
            "4 mistakes; nothing was run.",
        ):
            self.assertIn(text, err)
        for wrong, text in (("a", "not of the form"), ("a=1,,2", "is empty"), ("a=1:2", "range")):
            _, err = self.study("--vary", wrong, code=2)
            self.assertIn(text, err)
        self.berm("study", DRY, code=2)
        self.assertEqual(list(self.dir.iterdir()), [])

    def test_a_study_goes_on_where_it_was_and_refuses_to_be_another(self):
        vary = ["--vary", "soil.fill.cohesion_kPa=5,20", "--out", "out"]
        self.study(*vary)
        written = [path.stat().st_mtime_ns for path in self.results()]
        before = (self.dir / "out" / "study.json").read_bytes()
        _, err = self.study(*vary)
        self.assertIn("2 of them there already", err)
        self.assertEqual(written, [path.stat().st_mtime_ns for path in self.results()])
        self.assertEqual(before, (self.dir / "out" / "study.json").read_bytes())
        text = (self.dir / "out" / "study.json").read_text()
        older = re.sub('"commit": "[^"]*"', '"commit": "another"', text)
        (self.dir / "out" / "study.json").write_text(older)
        self.study(*vary)  # by another build: run again
        self.assertNotEqual(written, [path.stat().st_mtime_ns for path in self.results()])
        before = (self.dir / "out" / "study.json").read_bytes()
        _, err = self.study("--vary", "soil.fill.cohesion_kPa=5,21", "--out", "out", code=2)
        self.assertIn("holds another study, which differs in --vary", err)
        self.assertEqual(before, (self.dir / "out" / "study.json").read_bytes())
        self.study("--vary", "soil.fill.cohesion_kPa=5,21", "--out", "out", "--fresh")
        self.assertEqual(len(self.results()), 2)
        self.assertEqual(self.table("out")[1]["soil.fill.cohesion_kPa"], "21")

    def test_a_member_that_fails_does_not_stop_the_others(self):
        vary = ["--vary", "soil.fill.cohesion_kPa=5,13,20", "--out", "out"]
        folder = self.dir / "out" / "members" / "002_cohesion_kPa_13"
        folder.parent.mkdir(parents=True)
        folder.write_text("in the way")
        out, _ = self.study(*vary, code=3)
        self.assertIn("failed: cannot be started", out)
        self.assertEqual([r["status"] for r in self.table("out")],
                         ["complete", "failed", "complete"])
        folder.unlink()
        self.study(*vary)
        self.assertEqual({r["status"] for r in self.table("out")}, {"complete"})

    def test_a_member_without_an_answer_has_no_number_and_is_not_run_again(self):
        vary = ["--vary", "runout.duration_s=1,60", "--set", "stability.enabled=false", "--set",
                "runout.factor=3", "--set", "runout.shake_g=0.5", "--set",
                "runout.shake_duration_s=1", "--out", "out"]
        out, _ = self.study(*vary, code=3)
        self.assertIn("undecided: the soil still moves", out)
        moving, at_rest = self.table("out")
        self.assertEqual((moving["run_out_m"], moving["status"]), ("", "undecided"))
        self.assertGreater(float(at_rest["run_out_m"]), 0)
        self.assertEqual(at_rest["complete"], "1")
        _, err = self.study(*vary, code=3)
        self.assertIn("2 of them there already", err)

    def test_a_killed_study_takes_its_children_along_and_resumes(self):
        study = self.start_study()
        children = self.wait_for(lambda: len(self.results()) >= 2 and self.children(study))
        study.kill()
        study.wait()
        self.wait_for(lambda: not any(pathlib.Path(f"/proc/{child}/exe").exists()
                                      for child in children))
        kept = {path: path.stat().st_mtime_ns for path in self.results()}
        self.assertLess(len(kept), 5)
        _, err = self.start_study().communicate(timeout=60)
        self.assertIn(f"5 members, {len(kept)} of them there already", err)
        self.assertEqual(len(self.results()), 5)
        for path, written in kept.items():
            self.assertEqual(path.stat().st_mtime_ns, written)

    def test_a_killed_member_is_reported_with_its_signal(self):
        study = self.start_study()
        os.kill(self.wait_for(lambda: self.children(study))[0], signal.SIGKILL)
        out, err = study.communicate(timeout=60)
        self.assertEqual(study.returncode, 3, out + err)
        statuses = [row["status"] for row in self.table("out")]
        self.assertEqual(sorted(statuses), ["complete"] * 4 + ["failed"])
        self.assertIn("killed by signal 9", out)

    def test_an_interrupted_study_stops_its_children_and_leaves_its_table(self):
        study = self.start_study(spacing=0.7)
        children = self.wait_for(lambda: self.results() and self.children(study))
        study.send_signal(signal.SIGINT)
        out, err = study.communicate(timeout=30)
        self.assertEqual(study.returncode, 3, out + err)
        self.assertFalse(any(pathlib.Path(f"/proc/{child}").exists() for child in children))
        statuses = [row["status"] for row in self.table("out")]
        self.assertEqual(statuses[0], "complete")
        self.assertEqual(statuses[-1], "not run")
        self.assertFalse(list((self.dir / "out").rglob("*.part")))

    def test_one_study_at_a_time_works_in_a_directory(self):
        study = self.start_study()
        self.wait_for((self.dir / "out" / "study.json").exists)
        _, err = self.study("--vary", "soil.fill.cohesion_kPa=5", "--out", "out", code=4)
        self.assertIn("another berm works", err)
        study.send_signal(signal.SIGTERM)
        study.communicate(timeout=30)

    @unittest.skipUnless(HAS_SEEPAGE and shutil.which("mpirun"), "no MPI")
    def test_ranks_share_the_members_of_a_study_and_make_the_same_table(self):
        vary = ["--vary", "soil.fill.cohesion_kPa=5,10,13,20,25", *COARSE, *NO_FIGURES]

        def tables(directory):
            """study.json and study.csv but for times and the directory's name."""
            text = (self.dir / directory / "study.json").read_text()
            rows = self.table(directory)
            for row in rows:
                row.pop("seconds")
            text = re.sub('"seconds": [0-9.e+-]+', '"seconds": 0', text)
            return (text + json.dumps(rows)).replace(f"{directory}/", "")

        for directory in ("alone", "shared"):  # one member fails, in both
            folder = self.dir / directory / "members" / "002_cohesion_kPa_10"
            folder.parent.mkdir(parents=True)
            folder.write_text("in the way")
        self.berm("study", DRY, *vary, "--jobs", 1, "--out", "alone", code=3)
        out, err = self.mpirun(2, "study", DRY, *vary, "--out", "shared", code=3)
        self.assertEqual(tables("shared"), tables("alone"))
        self.assertIn("5 members, 0 of them there already, 1 at a time on each of 2 ranks", err)
        self.assertEqual(out.count("Results in"), 1)
        (self.dir / "shared" / "members" / "002_cohesion_kPa_10").unlink()
        _, err = self.mpirun(2, "study", DRY, *vary, "--out", "shared")  # goes on
        self.assertIn("4 of them there already", err)
        _, err = self.mpirun(2, "study", DRY, "--vary", "soil.fill.cohesion_kPa=5", "--out",
                             "shared", code=2)
        self.assertEqual(err.count("holds another study"), 1)
        _, err = self.mpirun(2, "study", DRY, "--vary", "soil.fill.cohesion_kPa=-5", code=2)
        self.assertEqual(err.count("1 mistake; nothing was run."), 1)

    @unittest.skipUnless(HAS_SEEPAGE and shutil.which("mpirun"), "no MPI")
    def test_a_killed_team_takes_its_children_along_and_its_study_resumes(self):
        angles = "soil.fill.friction_angle_deg=30:38:6"
        command = ["study", DRY, "--vary", angles, "--set", "sph.spacing_m=1", *NO_FIGURES, "--out",
                   "out"]
        team = subprocess.Popen(["mpirun", "--oversubscribe", "-n", "2", BERM, *command],
                                cwd=self.dir, text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, env=os.environ | self.ANY_USER)
        self.addCleanup(team.kill)
        self.addCleanup(team.communicate)
        ranks = self.wait_for(lambda: len(self.results()) >= 2 and self.children(team))
        members = [child for rank in ranks for child in self.children(rank)]
        team.kill()
        team.wait()
        self.wait_for(lambda: not any(pathlib.Path(f"/proc/{process}/exe").exists()
                                      for process in [*ranks, *members]))
        kept = {path: path.stat().st_mtime_ns for path in self.results()}
        self.assertLess(len(kept), 6)
        _, err = self.mpirun(2, *command)
        self.assertIn(f"6 members, {len(kept)} of them there already", err)
        self.assertEqual(len(self.results()), 6)
        for path, written in kept.items():
            self.assertEqual(path.stat().st_mtime_ns, written)

    @unittest.skipUnless(HAS_SEEPAGE and shutil.which("mpirun"), "no MPI")
    def test_mpirun_may_start_a_study_of_one_process(self):
        self.mpirun(1, "study", CASES / "seepage.toml", "--seepage", "--vary",
                    "water.left_level_m=20", "--set", "seepage.adaptive=false", *NO_FIGURES)

    @unittest.skipUnless(HAS_SEEPAGE, "no seepage stage")
    def test_a_study_of_the_seepage_alone_scales_with_the_conductivity(self):
        figures = [] if CAN_PLOT else NO_FIGURES
        (self.dir / "points.csv").write_text("x,discharge_m2_s,source\n1e-7,3.317e-7,exact\n")
        self.berm("study", CASES / "seepage.toml", "--seepage", "--set", "seepage.adaptive=false",
                  "--vary", "soil.fill.conductivity_m_s=1e-7,4e-7", *figures, "--out", "out",
                  "--reference", "points.csv")
        first, second = self.table("out")
        self.assertEqual(first["factor"], "")
        self.assertAlmostEqual(float(second["discharge_m2_s"]) / float(first["discharge_m2_s"]), 4,
                               places=6)  # linear in k
        self.assertEqual(first["exit_y_m"], second["exit_y_m"])
        for name in ("study_discharge", "study_phreatic"):
            self.assertEqual((self.dir / "out" / f"{name}.png").exists(), CAN_PLOT)
        (self.dir / "points.csv").write_text("a,b\n")
        _, err = self.berm("study", CASES / "seepage.toml", "--seepage", "--vary",
                           "soil.fill.conductivity_m_s=1e-7,4e-7", "--reference", "points.csv",
                           code=2)
        self.assertIn("columns are missing", err)

    def test_the_studies_of_the_cases_are_sound(self):
        page = (SOURCE / "cases" / "README.md").read_text().replace("\\\n", "")
        commands = [shlex.split(line)[1:] for line in page.splitlines()
                    if line.startswith("    berm study")]
        self.assertGreater(len(commands), 5)
        for command in commands:
            seepage = 'pore_pressure = "seepage"' in (SOURCE / command[1]).read_text()
            if HAS_SEEPAGE or not seepage:
                files = [str(SOURCE / a) if a.startswith("cases/") else a for a in command]
                out, _ = self.berm(*files, "--check")
                self.assertIn("No mistakes", out)


if __name__ == "__main__":
    unittest.main(verbosity=2)
