#!/usr/bin/env python3
"""Text of a case is text: no shell sees it, no page runs it, no path in it leads astray.
Environment: as for tests/cli/berm_cli.py."""

import pathlib
import re
import subprocess
import unittest

from berm_cli import BERM, COARSE, DRY, HAS_REPORT, HAS_SEEPAGE, NO_FIGURES, SOURCE, BermTest

MODULES = ("core", "meshes", "seepage", "sph", "coupling", "app")
SHELLS = re.compile(r"\b(?:std::)?(?:system|popen|execl[pe]?|wordexp)\s*\(|/bin/sh|\bsh -c")
SCRIPT = "<script>alert(1)</script></script><!-- <img src=x onerror=alert(1)> ]]>"
HOSTILE = ["$(touch made)", "`touch made`", "; touch made", "| touch made", "&& touch made",
           "a'b\"c", "--out=made", "../made", "made\\nmade", "%s%n%x", "{0}{}", "~", "*"]


class Security(BermTest):
    def paths(self):
        return sorted(str(p.relative_to(self.dir)) for p in self.dir.rglob("*"))

    def test_no_source_starts_a_shell(self):
        found = []
        for module in MODULES:
            for path in (SOURCE / module).rglob("*"):
                if path.suffix in (".cpp", ".h") and "node_modules" not in path.parts:
                    for number, line in enumerate(path.read_text().splitlines(), 1):
                        if SHELLS.search(line.split("//")[0]):
                            found.append(f"{path}:{number}: {line.strip()}")
        for path in (SOURCE / "docs" / "plots").glob("*.py"):
            if re.search(r"os\.system|shell=True|\beval\(|\bexec\(", path.read_text()):
                found.append(str(path))
        self.assertEqual(found, [])

    def test_hostile_titles_and_folders_start_nothing(self):
        for text in HOSTILE:
            if "/" in text:
                continue
            folder = self.dir / text
            folder.mkdir()
            (folder / "case.toml").write_bytes(pathlib.Path(DRY).read_bytes())
            before = set(self.paths())
            self.berm("check", f"{text}/case.toml" if not text.startswith("-") else f"./{text}/case.toml",
                      "--set", f"title='''{text}'''")
            self.assertEqual(set(self.paths()), before)
        # With all that a run starts beside itself: the script of the figures.
        where = self.dir / "$(touch made)`touch made`; touch made"
        self.berm("run", DRY, "--out", where, "--set", "title='$(touch made); `touch made`'", *COARSE)
        made = [p for p in self.dir.rglob("made")]
        self.assertEqual(made, [])
        self.assertEqual([p for p in (SOURCE / "docs" / "plots").rglob("made")], [])
        self.assertTrue((where / "result.json").exists())

    def test_study_values_start_nothing_and_stay_in_their_folder(self):
        self.berm("study", DRY, "--out", "out", "--vary",
                  "title='$(touch made)','../../../made','`touch made`'", *COARSE, *NO_FIGURES)
        self.assertEqual([p for p in self.dir.rglob("made")], [])
        self.assertEqual([p.name for p in self.dir.iterdir()], ["out"])
        self.assertEqual(len(list((self.dir / "out" / "members").iterdir())), 3)

    @unittest.skipUnless(HAS_SEEPAGE, "meshes are read by gmsh")
    def test_relative_paths_stay_in_the_folder_of_the_case_and_absolute_ones_are_taken(self):
        sound = (SOURCE / "cases" / "gmsh_dam" / "steady.toml").read_text()
        drawing = (SOURCE / "cases" / "gmsh_dam" / "dam.geo").read_text()
        (self.dir / "case" / "in").mkdir(parents=True)
        for place in (self.dir, self.dir / "case", self.dir / "case" / "in"):
            (place / "dam.geo").write_text(drawing)
        (self.dir / "case" / "link.geo").symlink_to(self.dir / "dam.geo")
        (self.dir / "case" / "up").symlink_to(self.dir)
        for path, code in (("dam.geo", 0), ("in/dam.geo", 0), ("in/../dam.geo", 0),
                           (str(self.dir / "dam.geo"), 0), ("../dam.geo", 2),
                           ("in/../../dam.geo", 2), ("link.geo", 2), ("up/dam.geo", 2)):
            (self.dir / "case" / "case.toml").write_text(sound.replace("dam.geo", path))
            _, err = self.berm("check", "case/case.toml", code=code)
            if code == 2:
                self.assertIn("leads out of the case file's folder", err, path)

    @unittest.skipUnless(HAS_SEEPAGE, "lines are read off the seepage")
    def test_names_of_lines_become_names_of_files_in_their_folder(self):
        names = ["../../made", "/tmp/made", "a/b", ".."]
        text = (SOURCE / "cases" / "two_sided_embankment" / "seepage.toml").read_text()
        for i, name in enumerate(names):
            text += f'\n[[output.line]]\nname = "{name}"\npoints_m = [[50, {2 + i}], [60, {2 + i}]]\n'
        self.berm("seepage", self.write(text), "--out", "out", *NO_FIGURES, "--set",
                  "seepage.adaptive=false", "--set", "output.report=false")
        files = {p.name for p in (self.dir / "out" / "lines").iterdir()}
        self.assertLessEqual({"______made.csv", "_tmp_made.csv", "a_b.csv", "__.csv"}, files)
        self.assertEqual({p.name for p in self.dir.iterdir()}, {"case.toml", "out"})

    @unittest.skipUnless(HAS_REPORT, "built without the page")
    def test_the_report_holds_text_of_the_user_as_text(self):
        self.berm("run", DRY, "--out", "plain", *COARSE, *NO_FIGURES)
        text = pathlib.Path(DRY).read_text()
        case = self.write(f"# {SCRIPT}\n" + re.sub("title .*", f"title = '{SCRIPT}'", text, count=1))
        self.berm("run", case, "--out", "hostile", *COARSE, *NO_FIGURES)
        plain, hostile = ((self.dir / d / "report.html").read_text() for d in ("plain", "hostile"))
        self.assertNotIn(SCRIPT, hostile)
        self.assertIn(SCRIPT.replace("<", "\\u003c").replace('"', '\\"'), hostile)
        for mark in ("<script", "</script", "<!--", "<img"):
            self.assertEqual(hostile.count(mark), plain.count(mark), mark)

    @unittest.skipUnless(HAS_REPORT, "built without the page")
    def test_the_report_asks_for_nothing(self):
        self.berm("run", DRY, "--out", "out", *COARSE, *NO_FIGURES)
        page = (self.dir / "out" / "report.html").read_text()
        self.assertRegex(page, r"Content-Security-Policy[^>]*default-src 'none'")
        for loads in (r"<(?:script|img|iframe|link|object|embed)[^>]*(?:src|href|data)\s*=\s*[\"']?"
                      r"(?:https?:)?//", r"url\(\s*[\"']?https?:", r"@import", r"<link\b"):
            self.assertIsNone(re.search(loads, page), loads)

    def test_a_run_needs_no_network(self):
        away = ["unshare", "--net", "--map-root-user"]
        if subprocess.run([*away, "true"], check=False, capture_output=True).returncode != 0:
            self.skipTest("this machine gives no network of its own (unshare --net)")
        done = subprocess.run([*away, BERM, "run", DRY, "--out", "out", *COARSE, *NO_FIGURES],
                              cwd=self.dir, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.berm("run", DRY, "--out", "with", *COARSE, *NO_FIGURES)
        self.assertEqual(self.result("out")["stability"]["factor"],
                         self.result("with")["stability"]["factor"])


if __name__ == "__main__":
    unittest.main()
