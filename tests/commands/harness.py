"""What the command tests share: a folder of their own, the binary and how to call it."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from tiny_scene import write_tiny_scene

BINARY = os.environ["PHOTOPIC_BINARY"]
DEADLINE = 300  # seconds; far beyond what a command takes, so that a hang is an error


class CommandTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.environment = dict(os.environ, XDG_CACHE_HOME=str(self.folder / "cache"))
        self.scene = write_tiny_scene(self.folder / "tiny.gltf")

    def run_photopic(self, *arguments, **settings):
        """@param settings for subprocess.run"""
        return subprocess.run(
            [BINARY, *map(str, arguments)],
            cwd=self.folder,
            env=self.environment,
            capture_output=True,
            text=True,
            timeout=DEADLINE,
            **settings,
        )

    def photopic(self, *arguments):
        """Runs a command that must succeed. Returns what it printed."""
        result = self.run_photopic(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def assert_refused(self, arguments, *needles):
        """The command must exit with 1, print nothing but one line on stderr, and that must hold the needles."""
        result = self.run_photopic(*arguments)
        self.assertEqual(result.returncode, 1, f"{arguments}: {result.stderr}")
        self.assertEqual(result.stdout, "", arguments)
        self.assertEqual(len(result.stderr.splitlines()), 1, f"{arguments}: {result.stderr}")
        for needle in needles:
            self.assertIn(needle, result.stderr)

    def read_json(self, name):
        return json.loads((self.folder / name).read_text())
