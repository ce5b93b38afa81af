"""The commands at work on a tiny scene: files, JSON, reproducible bits, the cache, interruption."""

import pathlib
import re
import signal
import subprocess
import time
import unittest

from harness import BINARY, DEADLINE, CommandTest

RUN_FIELDS = {
    "sampler", "image", "spp", "wavelengths", "render_seconds", "samples_per_second", "rays_per_second",
    "mean_delta_e", "median_delta_e", "p95_delta_e", "max_delta_e", "mse", "relmse", "non_finite_samples",
    "optimize_seconds",
}  # fmt: skip


class Render(CommandTest):
    def render(self, name, *options, sampler="uniform"):
        self.photopic("render", self.scene, "-o", name, "--sampler", sampler, "--spp", "4", "--quiet", *options)

    def max_difference(self, first, second):
        self.photopic("diff", first, second, "--json", "diff.json")
        return self.read_json("diff.json")["runs"][0]["max_delta_e"]

    def test_writes_every_output_and_the_json(self):
        self.render("a.exr", "-o", "a.png", "--json", "a.json", "--resolution", "20x10")
        self.assertEqual((self.folder / "a.exr").read_bytes()[:4], b"\x76\x2f\x31\x01")
        self.assertEqual((self.folder / "a.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        run = self.read_json("a.json")
        self.assertLessEqual(RUN_FIELDS, set(run))
        self.assertEqual((run["spp"], run["wavelengths"], run["sampler"]), (4, 4, "uniform"))
        self.assertEqual(run["resolution"], [20, 10])
        self.assertEqual(run["non_finite_samples"], 0)
        paths = run["samples_per_second"] * run["render_seconds"]
        self.assertAlmostEqual(paths, 20 * 10 * 4, delta=1e-3)
        self.assertGreater(run["mean_xyz"][1], 0)

    def test_stats_are_printed(self):
        out = self.photopic("render", self.scene, "-o", "a.exr", "--sampler", "uniform", "--spp", "1", "--stats").stdout
        self.assertIn("6 triangles", out)
        self.assertIn("M samples/s", out)

    def test_same_seed_same_bits_whatever_threads_and_batches(self):
        self.render("one.exr", "-o", "one.png", "--threads", "1")
        self.render("two.exr", "-o", "two.png", "--threads", "2")
        self.render("small.exr", "--batch-size", "7", "--threads", "2")
        self.render("other.exr", "--seed", "1")
        self.assertEqual((self.folder / "one.png").read_bytes(), (self.folder / "two.png").read_bytes())
        self.assertEqual(self.max_difference("one.exr", "two.exr"), 0)
        self.assertEqual(self.max_difference("one.exr", "small.exr"), 0)
        self.assertGreater(self.max_difference("one.exr", "other.exr"), 0)

    def test_exposure_moves_8_bit_images_only(self):
        self.render("dark.exr", "-o", "dark.png")
        self.render("bright.exr", "-o", "bright.png", "--exposure", "-2")
        self.assertEqual(self.max_difference("dark.exr", "bright.exr"), 0)
        self.assertGreater(self.max_difference("dark.png", "bright.png"), 1)

    def test_each_number_of_wavelengths_and_sampler(self):
        for count in [1, 4, 8, 16]:
            for sampler in ["uniform", "visible", "illuminant"]:
                self.render("a.exr", f"--wavelengths={count}", "--json", "a.json", sampler=sampler)
                run = self.read_json("a.json")
                self.assertEqual((run["wavelengths"], run["sampler"]), (count, sampler))

    def wait_for_handler(self, pid):
        """Until the process catches SIGINT."""
        for _ in range(DEADLINE * 20):
            status = pathlib.Path(f"/proc/{pid}/status").read_text()
            caught = int(re.search(r"SigCgt:\s*([0-9a-f]+)", status).group(1), 16)
            if caught >> (signal.SIGINT - 1) & 1:
                return
            time.sleep(0.05)
        self.fail("SIGINT is not caught")

    def test_interrupt_saves_the_partial_image(self):
        command = [BINARY, "render", str(self.scene), "-o", "a.exr", "--sampler", "uniform", "--spp", str(1 << 24)]
        process = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True, env=self.environment)
        self.wait_for_handler(process.pid)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=DEADLINE)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertIn("interrupted", stderr)
        self.assertEqual(self.max_difference("a.exr", "a.exr"), 0)


class Optimize(CommandTest):
    def optimize(self, *options):
        return self.photopic("optimize", "cie:FL11", "-o", "d.json", "--effort", "quick", *options)

    def test_result_serves_a_render(self):
        self.optimize("--color-bar", "bar.png", "--json", "result.json", "--quiet")
        result = self.read_json("result.json")
        self.assertLess(result["objective_value"], result["uniform_value"])
        self.assertEqual((self.folder / "bar.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.photopic("render", self.scene, "-o", "a.exr", "--emitter", "lamp=cie:FL11", "--distribution", "d.json",
                      "--spp", "2", "--json", "a.json", "--quiet")  # fmt: skip
        self.assertEqual(self.read_json("a.json")["optimize_seconds"], 0)

    def test_same_seed_same_result_whatever_threads(self):
        self.optimize("--threads", "1")
        one = (self.folder / "d.json").read_bytes()
        self.optimize("--threads", "2")
        self.assertEqual(one, (self.folder / "d.json").read_bytes())


class Cache(CommandTest):
    def render(self, *options):
        result = self.photopic("render", self.scene, "-o", "a.exr", "--emitter", "cie:A", "--wavelengths", "1",
                               "--spp", "1", "--json", "a.json", "--quiet", *options)  # fmt: skip
        return result.stderr.splitlines(), self.read_json("a.json")["optimize_seconds"]

    def test_keeps_and_reuses_by_content(self):
        self.assertGreater(self.render()[1], 0)
        self.assertEqual(self.render(), ([], 0))
        self.assertGreater(self.render("--no-cache")[1], 0)
        self.assertEqual(len(list((self.folder / "cache/photopic").iterdir())), 1)

    def test_damaged_file_is_reported_and_mended(self):
        self.render()
        (file,) = (self.folder / "cache/photopic").iterdir()
        file.write_text(file.read_text()[:-100])
        warnings, seconds = self.render()
        self.assertEqual(len(warnings), 1)
        self.assertIn(str(file), warnings[0])
        self.assertGreater(seconds, 0)
        self.assertEqual(self.render(), ([], 0))


class Compare(CommandTest):
    def test_report(self):
        self.photopic("optimize", "cie:FL11", "-o", "d.json", "--effort", "quick", "--quiet")
        out = self.photopic(
            "compare", self.scene, "--emitter", "cie:FL11", "--distribution", "d.json", "--samplers", "uniform,optimized",
            "--spp", "8", "--reference-spp", "256", "--curve", "1,4", "--repeat", "2", "--report", "report",
            "--json", "c.json", "--quiet",
        ).stdout  # fmt: skip
        self.assertEqual(out, (self.folder / "report/comparison.txt").read_text())
        for name in ["uniform", "optimized", "reference"]:
            self.assertTrue((self.folder / f"report/{name}.exr").exists())
            self.assertTrue((self.folder / f"report/{name}.png").exists())
        self.assertTrue((self.folder / "report/color-bars.png").exists())

        result = self.read_json("c.json")
        uniform, optimized = result["runs"]
        self.assertLessEqual(RUN_FIELDS, set(uniform))
        self.assertLess(optimized["mean_delta_e"], uniform["mean_delta_e"])
        self.assertAlmostEqual(optimized["gain"], uniform["mean_delta_e"] / optimized["mean_delta_e"], places=9)
        # Half a million samples: five standard errors are an error in the renderer.
        self.assertLess(result["channel_agreement"]["largest_z"], 5)
        self.assertGreater(result["reference"]["estimated_mean_delta_e"], 0)
        self.assertLess(result["reference"]["estimated_mean_delta_e"], optimized["mean_delta_e"])
        self.assertEqual([curve["spp"] for curve in result["curves"]], [[1, 4], [1, 4]])

        # The images written are those measured.
        self.photopic("diff", "report/reference.exr", "report/uniform.exr", "--json", "diff.json")
        measured = self.read_json("diff.json")["runs"][0]["mean_delta_e"]
        self.assertAlmostEqual(measured, uniform["mean_delta_e"], places=4)

    def test_existing_reference(self):
        self.photopic("render", self.scene, "-o", "r.exr", "--sampler", "uniform", "--spp", "8", "--quiet")
        self.photopic("compare", self.scene, "--reference", "r.exr", "--samplers", "uniform", "--spp", "8",
                      "--json", "c.json", "--quiet")  # fmt: skip
        result = self.read_json("c.json")
        self.assertEqual(result["reference"]["image"], "r.exr")
        self.assertEqual(result["runs"][0]["max_delta_e"], 0)  # the first sampler renders with the seed itself


if __name__ == "__main__":
    unittest.main()
