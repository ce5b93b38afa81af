"""scripts/check_layers.py finds what it is there for."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(os.environ["PHOTOPIC_SCRIPTS"]) / "check_layers.py"


class CheckLayers(unittest.TestCase):
    def offences(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(exist_ok=True)
                path.write_text(text)
            result = subprocess.run([sys.executable, SCRIPT, folder], capture_output=True, text=True)
            return result.stdout.splitlines() if result.returncode else []

    def test_the_right_direction_passes(self):
        files = {
            "spectral/color.h": "#include <cmath>\n",
            "core/film.h": '#include "spectral/color.h"\n#include "error.h"\n',
            "error.h": "",
            "main.cpp": '#include "core/film.h"\n#include <CLI/CLI.hpp>\n',
        }
        self.assertEqual(self.offences(files), [])

    def test_the_wrong_direction_and_homeless_libraries_are_named(self):
        bad = {
            "spectral/color.h": '#include "core/film.h"\n',
            "optimize/solver.h": '#include "core/film.h"\n',
            "core/scene.h": "#include <embree3/rtcore.h>\n",
            "core/math.h": "#include <boost/math.hpp>\n",
            "integrator/path.h": '#include "commands.h"\n',
        }
        for name, text in bad.items():
            good = {"core/film.h": "", "commands.h": ""}
            found = self.offences({**good, name: text})
            self.assertEqual(len(found), 1, name)
            self.assertTrue(found[0].startswith(f"src/{name}:1: "), found)


if __name__ == "__main__":
    unittest.main()
