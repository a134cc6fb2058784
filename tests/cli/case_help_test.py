#!/usr/bin/env python3
"""What helps to write a case, to give a command and to read a result. See berm_cli.py."""

import json
import pathlib
import re
import shutil
import subprocess
import unittest

from berm_cli import (BERM, CAN_PLOT, CAN_VALIDATE, CASES, COARSE, DRY, HAS_SEEPAGE, NO_FIGURES,
                      SOURCE, SYSTEM_PYTHON, BermTest)


class CaseHelp(BermTest):
    def test_every_template_is_a_sound_case_and_no_file_is_overwritten(self):
        for kind in ("embankment", "dam_with_core", "levee", "cut"):
            out, _ = self.berm("init", kind, "--template", kind)
            self.assertIn(f"berm check {kind}.toml", out)
            text = (SOURCE / "cases" / "templates" / f"{kind}.toml").read_bytes()
            self.assertEqual((self.dir / f"{kind}.toml").read_bytes(), text)
            if HAS_SEEPAGE or b'pore_pressure = "seepage"' not in text:
                self.berm("check", f"{kind}.toml")
        (self.dir / "mine.toml").write_text("mine")
        _, err = self.berm("init", "mine", code=4)
        self.assertIn("mine.toml: is there already", err)
        self.assertEqual((self.dir / "mine.toml").read_text(), "mine")
        _, err = self.berm("init", "other", "--template", "bridge", code=2)
        for kind in ("embankment", "dam_with_core", "levee", "cut"):
            self.assertIn(kind, err)
        self.berm("init", "no/such/folder", code=4)
        if HAS_SEEPAGE:
            self.berm("seepage", "levee.toml", "--set", "seepage.adaptive=false", *NO_FIGURES,
                      "--out", "out")
            heave = self.result("out")["seepage"]["heave"]["factor"]
            self.assertTrue(1 < heave < 2, heave)  # what the template is there to show

    def validate(self, schema, paths):
        """Each file's first offence against the schema, or "sound"."""
        script = ("import json, sys, tomllib, jsonschema\n"
                  "schema = json.load(open(sys.argv[1]))\n"
                  "jsonschema.Draft7Validator.check_schema(schema)\n"
                  "for path in sys.argv[2:]:\n"
                  "    with open(path, 'rb') as file:\n"
                  "        data = (tomllib if path.endswith('toml') else json).load(file)\n"
                  "    found = list(jsonschema.Draft7Validator(schema).iter_errors(data))\n"
                  "    print([*found[0].absolute_path, found[0].message] if found else 'sound')\n")
        done = subprocess.run([SYSTEM_PYTHON, "-c", script, schema, *map(str, paths)],
                              cwd=self.dir, check=False, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.splitlines()

    @unittest.skipUnless(CAN_VALIDATE, "no python3-jsonschema")
    def test_the_schema_takes_every_case_and_refuses_wrong_types_and_keys(self):
        self.write(self.berm("reference", "--format", "json-schema")[0], "schema.json")
        cases = sorted((SOURCE / "cases").glob("*/*.toml"))
        self.assertGreater(len(cases), 10)
        self.assertEqual(self.validate("schema.json", cases), ["sound"] * len(cases))
        text = pathlib.Path(DRY).read_text()
        for right, wrong, offence in (
            ("base_m   = 0", 'base_m   = "0"', "'section', 'base_m'"),
            ("cohesion_kPa       = 13.8", "cohesion_Pa = 13800", "'cohesion_Pa' was unexpected"),
            ("cohesion_kPa       = 13.8", "", "'cohesion_kPa' is a required property"),
            ("friction_angle_deg = 37", "friction_angle_deg = 90", "90"),
            ('"none"', '"some"', "'some' is not one of"),
        ):
            self.assertIn(right, text)
            name = self.write(text.replace(right, wrong))
            self.assertIn(offence, self.validate("schema.json", [name])[0])
            self.berm("check", name, code=2)

    @unittest.skipUnless(CAN_VALIDATE, "no python3-jsonschema")
    def test_results_of_every_kind_are_as_their_schema_says(self):
        case = CASES / ("seepage.toml" if HAS_SEEPAGE else "hydrostatic.toml")
        mesh = ["--set", "seepage.adaptive=false"]
        probe = [*mesh, "--set", "output.line=[{points_m=[[103,0],[103,20]]}]"]
        self.berm("run", case, *COARSE, *NO_FIGURES, *probe, "--out", "run")
        self.berm("run", DRY, *COARSE, *NO_FIGURES, "--set", "stability.side=both", "--out", "both")
        self.run_out("motion", *NO_FIGURES)
        self.run_out("moving", "--set", "runout.duration_s=1", *NO_FIGURES, code=3)
        kinds = ["run", "both", "motion", "moving"]
        if HAS_SEEPAGE:
            self.berm("seepage", SOURCE / "cases" / "sheet_pile" / "seepage.toml", *mesh,
                      *NO_FIGURES, "--out", "pile")
            kinds.append("pile")
        schema = SOURCE / "docs" / "result.schema.json"
        paths = [self.dir / kind / "result.json" for kind in kinds]
        self.assertEqual(self.validate(schema, paths), ["sound"] * len(kinds))
        wrong = self.result("run")
        wrong["stability"]["trials"][0]["outcome"] = "perhaps"
        (self.dir / "wrong.json").write_text(json.dumps(wrong))
        self.assertIn("'perhaps'", self.validate(schema, ["wrong.json"])[0])

    def complete(self, *words):
        """What bash offers for the last word."""
        line = " ".join(f"'{word}'" for word in ("berm", *words))
        script = (f"source <('{BERM}' completion bash)\nCOMP_WORDS=({line}); "
                  f"COMP_CWORD={len(words)}; _berm; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        done = subprocess.run(["bash", "-c", script], cwd=self.dir, text=True, check=True,
                              capture_output=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_completes_commands_options_choices_keys_and_files(self):
        self.assertEqual(self.complete("se"), ["seepage"])
        self.assertEqual(self.complete("study", "x.toml", "--one"), ["--one-at-a-time"])
        self.assertIn("--resume", self.complete("run", "--"))
        self.assertNotIn("--resume", self.complete("seepage", "--"))
        self.assertEqual(self.complete("init", "x", "--template", "d"), ["dam_with_core"])
        self.assertEqual(self.complete("reference", "--format", "j"), ["json-schema"])
        self.assertEqual(self.complete("completion", "b"), ["bash"])
        self.assertEqual(self.complete("run", "x", "--set", "water.l"), ["water.left_level_m="])
        self.write("", "section.toml")
        self.assertEqual(self.complete("run", "sec"), ["section.toml"])
        self.berm("completion", "tcsh", code=2)

    def test_zsh_completes_the_same(self):
        script, _ = self.berm("completion", "zsh")
        self.assertTrue(script.startswith("#compdef berm\n"))
        for command in ("run", "seepage", "study", "init", "reference", "completion"):
            self.assertIn(f"\n    '{command}:", script)
            out, _ = self.berm(command, "--help")
            arguments = script.split(f"\n    {command})\n")[1].split(";;")[0]
            for option in re.findall(r"--[a-z-]+", out):
                self.assertIn(f"{option}[", arguments)
        self.assertIn(":(bash zsh)'", script)
        self.assertIn(" water.left_level_m= ", script)
        if shutil.which("zsh"):
            subprocess.run(["zsh", "-n"], input=script, text=True, check=True)

    def test_the_manual_page_names_every_command_and_option(self):
        page, _ = self.berm("man")
        for command in ("run", "seepage", "study", "init", "reference", "completion"):
            self.assertIn(f".SS berm {command}\n", page)
            out, _ = self.berm(command, "--help")
            for option in re.findall(r"--[a-z-]+", out):
                if option != "--help":
                    self.assertIn(option.replace("-", r"\-"), page)
        if shutil.which("groff"):
            done = subprocess.run(["groff", "-man", "-ww", "-Tascii"], input=page, text=True,
                                  capture_output=True, check=True)
            self.assertEqual(done.stderr, "")
            self.assertIn("EXIT STATUS", re.sub(".\b", "", done.stdout))

    def test_an_installed_program_has_all_it_needs_beside_it(self):
        prefix = self.dir / "prefix"
        subprocess.run(["cmake", "--install", pathlib.Path(BERM).parent, "--prefix", prefix],
                       check=True, stdout=subprocess.DEVNULL)
        program, share = prefix / "bin" / "berm", prefix / "share"

        def installed(*arguments):
            return subprocess.run([program, *arguments], cwd=self.dir, check=True, text=True,
                                  capture_output=True).stdout

        version = re.search(r"project\(berm VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())
        self.assertIn(f"berm {version[1]}\n", installed("version"))
        page = (share / "man" / "man1" / "berm.1").read_text()
        self.assertIn(f'"berm {version[1]}"', page)
        self.assertEqual(page, installed("man"))
        for shell, place in (("bash", "bash-completion/completions/berm"),
                             ("zsh", "zsh/site-functions/_berm")):
            self.assertEqual((share / place).read_text(), installed("completion", shell))
        for name in ("LICENSE", "README.md", "docs/output_format.md"):
            self.assertEqual((share / "doc" / "berm" / name).read_bytes(),
                             (SOURCE / name).read_bytes())
        case = share / "berm" / "cases" / "two_sided_embankment" / "dry.toml"
        self.assertIn("no mistakes", installed("check", case))
        if CAN_PLOT:  # by the scripts beside it: nothing of the sources is asked for
            script = share / "berm" / "plots" / "figures.py"
            with script.open("a", encoding="utf-8") as file:
                file.write(f"    pathlib.Path({str(self.dir / 'drawn')!r}).touch()\n")
            installed("run", case, *COARSE, "--out", "out")
            self.assertTrue((self.dir / "drawn").exists())
            self.assertTrue((self.dir / "out" / "slip.png").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
