"""The scenes in scenes/: small, without warnings, lit by lamps with spectra of their own, and finite at every sample."""

import pathlib
import unittest

from harness import CommandTest

SCENES = pathlib.Path(__file__).parent.parent.parent / "scenes"
LARGEST = 5_000_000  # bytes of a scene with all that belongs to it


class Scenes(CommandTest):
    def scene_files(self):
        files = sorted(SCENES.glob("*/scene.gl*"))
        self.assertGreater(len(files), 5)
        return files

    def test_each_is_small_and_free_of_warnings(self):
        for file in self.scene_files():
            with self.subTest(scene=file.parent.name):
                size = sum(part.stat().st_size for part in file.parent.iterdir())
                self.assertLess(size, LARGEST)
                self.photopic("info", file, "--json", "info.json")
                info = self.read_json("info.json")
                self.assertEqual(info["warnings"], [])
                self.assertGreater(len(info["lamps"]), 0)
                for lamp in info["lamps"]:
                    self.assertRegex(lamp["spectrum"], r"^(cie|blackbody|line):|\.(csv|sp|spd|spdx)$", lamp["name"])

    def test_each_renders_without_losing_a_sample(self):
        for file in self.scene_files():
            with self.subTest(scene=file.parent.name):
                sky = file.parent / "sky.hdr"
                options = ["--environment", sky] if sky.exists() else []
                self.photopic("render", file, "-o", "image.exr", "--resolution", "24x18", "--spp", "4", "--sampler", "uniform",
                              "--quiet", "--json", "run.json", *options)
                run = self.read_json("run.json")
                self.assertEqual(run["non_finite_samples"], 0)
                self.assertGreater(run["mean_xyz"][1], 0.02)  # exposed to be seen: white is 1
                self.assertLess(run["mean_xyz"][1], 2)


if __name__ == "__main__":
    unittest.main()
