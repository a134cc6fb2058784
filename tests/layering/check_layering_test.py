#!/usr/bin/env python3
"""check_layering.py finds each planted violation, and nothing in a clean tree."""
import tempfile
import unittest
from pathlib import Path

from check_layering import violations

CLEAN = {
    "core/tensor.h": "#pragma once\n#include <Eigen/Core>\n",
    "meshes/section.h": '#include "core/tensor.h"\n',
    "meshes/mesher.cpp": '#include "meshes/section.h"\n#include <gmsh.h>\n',
    "seepage/solver.cpp": '#include "meshes/section.h"\n#include <dolfinx/fem/Form.h>\n'
                          '#include <petscksp.h>\n#include "flow.h"\n',
    "sph/fill.cpp": '#include "meshes/section.h"\n// printf("x"), #include <gmsh.h>\n'
                    '/* std::cout\n#include "app/x.h" */\nusing namespace std;\n',
    "sph/fill.h": '#include "core/tensor.h"\n',
    "sph/text.cpp": 'auto s = std::snprintf(b, n, "//"); auto t = "printf";\n',
    "coupling/analysis.h": '#include "sph/fill.h"\n#include "seepage/solver.h"\n',
    "app/case_file.cpp": '#include "coupling/analysis.h"\n#include <toml++/toml.h>\n',
    "app/run_writer.cpp": "#include <hdf5.h>\nstd::cout << 1;\n",
    "tests/unit/sph/a.cpp": '#include "app/x.h"\n#include <gmsh.h>\nstd::cout << 1;\n',
}

# file, text, part of the message
PLANTED = [
    ("core/a.h", '#include "meshes/section.h"\n', 'core includes "meshes/section.h"'),
    ("meshes/a.cpp", '#include "sph/fill.h"\n', 'meshes includes "sph/fill.h"'),
    ("sph/a.cpp", '#include "seepage/solver.h"\n', 'sph includes "seepage/solver.h"'),
    ("seepage/a.cpp", '#include "sph/fill.h"\n', 'seepage includes "sph/fill.h"'),
    ("coupling/a.h", '\n  #  include "app/cli.h"\n', "coupling/a.h:2: coupling includes"),
    ("app/a.cpp", '#include "tests/support/meshes.h"\n', 'app includes "tests/support/meshes.h"'),
    ("sph/deep/a.h", '#include "app/cli.h"\n', 'sph includes "app/cli.h"'),
    ("sph/a.cpp", '#include "fill.h"\n', "not written from the root"),
    ("seepage/a.h", "#include <dolfinx/fem/Form.h>\n", "allowed only in seepage/[sd]ol[vf]*"),
    ("coupling/a.cpp", "#include <petscvec.h>\n", "allowed only in seepage/[sd]ol[vf]*"),
    ("meshes/section.cpp", "#include <gmsh.h>\n", "allowed only in meshes/[gm][me]s*.cpp"),
    ("coupling/a.cpp", "#include <toml++/toml.h>\n", "allowed only in app/*.cpp"),
    ("app/a.cpp", "#include <toml++/toml.h>\n", "one user of TOML, so 1 file only"),
    ("app/a.cpp", "#include <hdf5.h>\n", "one user of HDF5, so 1 file only"),
    ("sph/a.cpp", "void f()\n{\n  std::cout << 1;\n}\n", "sph/a.cpp:3: prints"),
    ("core/a.h", "printf(\"x\");\n", "core/a.h:1: prints"),
    ("seepage/a.cpp", "fprintf (stderr, \"x\");\n", "prints"),
    ("coupling/a.cpp", "std::cerr << 1; // yes\n", "prints"),
    ("meshes/a.h", "using namespace std;\n", "`using namespace` in a header"),
    ("app/a.h", "using  namespace std;\n", "`using namespace` in a header"),
]


class CheckLayering(unittest.TestCase):
    def found(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return violations(Path(folder))

    def test_finds_nothing_in_a_clean_tree(self):
        self.assertEqual(self.found(CLEAN), [])

    def test_finds_each_planted_violation_alone(self):
        for name, text, message in PLANTED:
            with self.subTest(name=name, text=text):
                found = self.found({**CLEAN, name: text})
                self.assertEqual(len(found), 1, found)
                self.assertIn(message, found[0])

    def test_finds_all_of_them_at_once(self):
        files = dict(CLEAN)
        for name, text, _ in PLANTED:
            files[name] = files.get(name, "") + text
        # TOML and HDF5 each have one line for all their files.
        self.assertEqual(len(self.found(files)), len(PLANTED))


if __name__ == "__main__":
    unittest.main()
