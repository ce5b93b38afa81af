"""Layers, spectra and windows of EXR files: names, values against the scene's, what is refused."""

import math
import re
import signal
import struct
import subprocess
import time
import unittest

from exr import read_exr
from harness import BINARY, DEADLINE, CommandTest

AOVS = {
    "albedo": ["albedo.R", "albedo.G", "albedo.B"],
    "normal": ["normal.X", "normal.Y", "normal.Z"],
    "depth": ["depth.Z"],
    "alpha": ["alpha.A"],
    "samples": ["samples.Y"],
    "variance": ["variance.R", "variance.G", "variance.B"],
}


class Layers(CommandTest):
    def render(self, name, *options):
        self.photopic("render", self.scene, "-o", name, "--sampler", "uniform", "--spp", "8", "--quiet", *options)

    def read(self, name):
        return read_exr(self.folder / name)

    def at(self, channels, x, y, *names):
        return [channels[name][32 * y + x] for name in names]

    def test_any_subset_is_written(self):
        self.render("plain.exr")
        attributes, plain = self.read("plain.exr")
        self.assertEqual(set(plain), {"R", "G", "B"})
        self.assertNotIn("spectralLayoutVersion", attributes)
        for aovs in [*([name] for name in AOVS), ["variance", "albedo", "variance"], list(AOVS)]:
            self.render("a.exr", "--aov", ",".join(aovs), "--json", "a.json")
            _, channels = self.read("a.exr")
            self.assertEqual(set(channels), {"R", "G", "B"}.union(*(AOVS[name] for name in aovs)))
            self.assertEqual(self.read_json("a.json")["aov"], aovs)
            for name in "RGB":
                self.assertEqual(channels[name], plain[name])
        self.assertEqual(self.read_json("a.json")["spectral_bins"], 0)

    def test_values_are_those_of_the_scene(self):
        self.render("a.exr", "--aov", "albedo,normal,depth,alpha,samples,variance", "--aov", "depth")
        _, channels = self.read("a.exr")
        # The wall fills the middle, 5 m away; the floor lies below it, the sky beside it holds nothing.
        for value, expected in zip(self.at(channels, 16, 16, *AOVS["albedo"]), [0.6, 0.1, 0.05]):
            self.assertAlmostEqual(value, expected, delta=1e-3)
        for value, expected in zip(self.at(channels, 16, 16, *AOVS["normal"]), [0, 0, 1]):
            self.assertAlmostEqual(value, expected, delta=1e-6)
        self.assertAlmostEqual(self.at(channels, 16, 16, "depth.Z")[0], 5, delta=1e-5)
        for value, expected in zip(self.at(channels, 16, 28, *AOVS["normal"]), [0, 1, 0]):
            self.assertAlmostEqual(value, expected, delta=1e-6)
        for value in self.at(channels, 16, 28, *AOVS["albedo"]):
            self.assertAlmostEqual(value, 0.7, delta=1e-3)
        self.assertEqual(self.at(channels, 16, 16, "alpha.A"), [1])
        self.assertTrue(any(0 < alpha < 1 for alpha in channels["alpha.A"]))  # where edges pass through pixels
        for name in AOVS["albedo"] + AOVS["normal"] + AOVS["depth"] + AOVS["alpha"] + AOVS["variance"]:
            self.assertEqual(self.at(channels, 0, 16, name), [0], name)
        self.assertEqual(set(channels["samples.Y"]), {8})
        self.assertGreater(min(self.at(channels, 16, 16, *AOVS["variance"])), 0)

    def test_every_exr_has_them_and_no_other_file(self):
        self.render("a.png", "-o", "a.exr", "-o", "b.EXR", "-o", "a.hdr", "--aov", "depth", "--spectral-bins", "2")
        self.render("plain.png", "-o", "plain.hdr")
        a, b = self.read("a.exr")[1], self.read("b.EXR")[1]
        self.assertEqual(set(a), {"R", "G", "B", "depth.Z", "S0.477,500000nm", "S0.712,500000nm"})
        self.assertEqual(a, b)
        for ending in ["png", "hdr"]:
            self.assertEqual((self.folder / f"a.{ending}").read_bytes(), (self.folder / f"plain.{ending}").read_bytes())

    def test_diff_reads_the_color_among_layers(self):
        for color in ["srgb", "xyz"]:
            self.render("plain.exr", "--color", color)
            self.render("a.exr", "--color", color, "--aov", ",".join(AOVS), "--spectral-bins", "5")
            self.photopic("diff", "plain.exr", "a.exr", "--json", "diff.json")
            self.assertEqual(self.read_json("diff.json")["runs"][0]["max_delta_e"], 0)

    def test_variance_of_xyz_is_that_of_its_channels(self):
        self.render("a.exr", "--aov", "variance", "--color", "xyz")
        _, channels = self.read("a.exr")
        self.assertEqual(set(channels), {"X", "Y", "Z", "variance.X", "variance.Y", "variance.Z"})
        self.render("b.exr", "--aov", "variance")
        _, rgb = self.read("b.exr")
        # Y's variance is at least what the three channels would give alone and at most what they would in step.
        weights = {"R": 0.2126, "G": 0.7152, "B": 0.0722}
        for i in range(32 * 32):
            steps = [weight * math.sqrt(rgb[f"variance.{c}"][i]) for c, weight in weights.items()]
            self.assertLessEqual(channels["variance.Y"][i], (1 + 1e-3) * sum(steps) ** 2)
        self.assertGreater(max(channels["variance.Y"]), 0)

    def test_spectral_layout(self):
        self.render("a.exr", "--spectral-bins", "470", "--color", "xyz", "--json", "a.json")
        attributes, channels = self.read("a.exr")
        self.assertEqual(attributes["spectralLayoutVersion"], b"1.0")
        self.assertEqual(attributes["emissiveUnits"], b"W.m^-2.sr^-1")
        spectrum = {name: values for name, values in channels.items() if name.startswith("S0.")}
        self.assertEqual(len(spectrum), 470)
        self.assertEqual(self.read_json("a.json")["spectral_bins"], 470)
        for name in spectrum:
            self.assertRegex(name, r"^S0\.\d{3},50{5}nm$")

    def test_spectrum_of_a_line_holds_the_images_y(self):
        """One bin holds all: 683.002 lm/W · ȳ·L·Δλ = Y with ȳ(555 nm) = 1."""
        self.photopic("render", self.scene, "-o", "a.exr", "--sampler", "illuminant", "--spp", "8", "--quiet",
                      "--emitter", "line:555:0.5", "--spectral-bins", "47", "--color", "xyz")  # fmt: skip
        _, channels = self.read("a.exr")
        lit = [i for i, y in enumerate(channels["Y"]) if y > 0]
        self.assertGreater(len(lit), 100)
        for i in lit:
            y = channels["S0.555,000000nm"][i] * 10 * 683.002
            self.assertAlmostEqual(y / channels["Y"][i], 1, delta=1e-3)
        for name, values in channels.items():
            if name.startswith("S0.") and name != "S0.555,000000nm":
                self.assertEqual(max(values), 0, name)

    def test_same_bits_whatever_threads_and_batches(self):
        options = ["--aov", ",".join(AOVS), "--spectral-bins", "7"]
        self.render("one.exr", *options, "--threads", "1")
        self.render("two.exr", *options, "--threads", "2", "--batch-size", "7")
        self.assertEqual(self.read("one.exr")[1], self.read("two.exr")[1])

    def test_samples_vary_with_the_target_error(self):
        self.photopic("render", self.scene, "-o", "a.exr", "--sampler", "uniform", "--target-error", "1", "--quiet",
                      "--aov", "samples,depth,variance", "--spectral-bins", "3", "--json", "a.json")  # fmt: skip
        _, channels = self.read("a.exr")
        samples = channels["samples.Y"]
        self.assertAlmostEqual(sum(samples) / len(samples), self.read_json("a.json")["mean_spp"], delta=1e-3)
        self.assertGreater(max(samples), min(samples))

    def test_interrupted_and_timed_renders_have_them(self):
        options = ["--sampler", "uniform", "--aov", "depth,samples", "--spectral-bins", "3", "--quiet"]
        self.photopic("render", self.scene, "-o", "timed.exr", "--time", "0.3", *options)
        process = subprocess.Popen(
            [BINARY, "render", str(self.scene), "-o", "a.exr", "--spp", str(1 << 24), *options],
            cwd=self.folder, stderr=subprocess.PIPE, text=True, env=self.environment,
        )  # fmt: skip
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=DEADLINE)
        self.assertEqual(process.returncode, 130, stderr)
        for name in ["timed.exr", "a.exr"]:
            _, channels = self.read(name)
            self.assertGreaterEqual(min(channels["samples.Y"]), 1)
            self.assertAlmostEqual(self.at(channels, 16, 16, "depth.Z")[0], 5, delta=1e-5)
            self.assertGreater(max(channels["S0.595,000000nm"]), 0)

    def test_refused(self):
        render = ["render", self.scene, "--sampler", "uniform", "--spp", "1"]
        for names in ["colour", "depth,colour", "", "Depth", "depth;albedo"]:
            self.assert_refused(render + ["-o", "a.exr", "--aov", names], "--aov", *AOVS)
        for bins in ["0", "471", "-1", "many", "1.5"]:
            self.assert_refused(render + ["-o", "a.exr", "--spectral-bins", bins], "--spectral-bins")
        for option, value in [("--aov", "depth"), ("--spectral-bins", "4")]:
            self.assert_refused(render + ["-o", "a.png", "-o", "a.hdr", option, value], option, "add -o NAME.exr")
        self.assert_refused(
            render + ["-o", "a.exr", "--spectral-bins", "470", "--resolution", "16384x16384"], "--spectral-bins", "GB"
        )
        self.assert_refused(["compare", self.scene, "--aov", "depth"], "--aov")
        self.assertEqual([path.name for path in self.folder.iterdir() if path.suffix in {".exr", ".png"}], [])

    def test_help_names_them(self):
        text = re.sub(r"\s+", " ", self.photopic("render", "--help").stdout)
        for word in [*AOVS, "--aov", "--spectral-bins", "S0.", "samples.Y", "W/(m² sr nm)"]:
            self.assertIn(word, text)


class Crop(CommandTest):
    LAYERS = ["--aov", ",".join(AOVS), "--spectral-bins", "3"]

    def render(self, name, *options):
        self.photopic("render", self.scene, "-o", name, "--sampler", "uniform", "--spp", "8", "--resolution", "40x24",
                      "--quiet", *options)  # fmt: skip

    def window(self, attribute):
        return struct.unpack("<4i", attribute)

    def test_pixels_are_those_of_the_whole_picture(self):
        self.render("whole.exr", *self.LAYERS)
        attributes, whole = read_exr(self.folder / "whole.exr")
        self.assertEqual(self.window(attributes["dataWindow"]), (0, 0, 39, 23))
        for x0, y0, x1, y1 in [(11, 3, 29, 22), (0, 0, 40, 24), (39, 23, 40, 24)]:
            crop = f"{x0},{y0},{x1},{y1}"
            self.render("a.exr", "--crop", crop, "--json", "a.json", *self.LAYERS)
            attributes, part = read_exr(self.folder / "a.exr")
            self.assertEqual(self.window(attributes["dataWindow"]), (x0, y0, x1 - 1, y1 - 1))
            self.assertEqual(self.window(attributes["displayWindow"]), (0, 0, 39, 23))
            self.assertEqual(set(part), set(whole))
            for name, pixels in part.items():
                self.assertEqual(pixels, [whole[name][40 * y + x] for y in range(y0, y1) for x in range(x0, x1)], name)
            run = self.read_json("a.json")
            self.assertEqual(run["crop"], [x0, y0, x1, y1])
            self.assertEqual(run["mean_spp"], 8)
            mean = sum(part["G"]) / len(part["G"])
            self.assertAlmostEqual(run["mean_xyz"][1], mean, delta=0.3 * mean)  # not diluted by what is left out

    def test_other_files_have_its_size(self):
        self.render("whole.hdr", "-o", "whole.exr")
        self.render("a.hdr", "-o", "a.png", "-o", "a.exr", "--color", "xyz", "--crop", "20,10,25,13")
        self.assertEqual(struct.unpack(">2I", (self.folder / "a.png").read_bytes()[16:24]), (5, 3))
        self.assertIn(b"oFFs" + bytes(9), (self.folder / "a.png").read_bytes())  # shown where others are
        self.photopic("diff", "a.exr", "a.hdr", "a.png")
        self.assert_refused(["diff", "whole.exr", "a.hdr"], "5x3", "40x24")  # which does not say where it lies

    def test_limits_look_at_it_alone(self):
        self.photopic("render", self.scene, "-o", "a.exr", "--sampler", "uniform", "--crop", "8,8,20,20", "--quiet",
                      "--target-error", "2", "--json", "a.json")  # fmt: skip
        run = self.read_json("a.json")
        self.assertLessEqual(run["expected_mean_delta_e"], 2)
        self.assertAlmostEqual(run["mean_spp"] * 144, run["samples_per_second"] * run["render_seconds"], delta=1e-2)

    def test_refused(self):
        render = ["render", self.scene, "-o", "a.exr", "--sampler", "uniform", "--spp", "1", "--resolution", "40x24"]
        for crop in ["0,0,40", "0,0,40,24,1", "0,0,40,24,", "0 0 40 24", "5,5,5,9", "9,5,5,9", "a,0,4,4", "0,0,4.5,4",
                     "-1,0,4,4", "0,0,4,99999999999"]:  # fmt: skip
            self.assert_refused(render + ["--crop=" + crop], "--crop " + crop, "X0,Y0,X1,Y1")
        for crop in ["0,0,41,24", "0,0,40,25"]:
            self.assert_refused(render + ["--crop", crop], crop, "40x24")
        self.assert_refused(render + ["--crop", ""], "--crop", "empty")
        self.assertFalse((self.folder / "a.exr").exists())


if __name__ == "__main__":
    unittest.main()
