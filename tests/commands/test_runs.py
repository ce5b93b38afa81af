"""The commands at work on a tiny scene: files, JSON, reproducible bits, the cache, interruption."""

import json
import os
import pathlib
import re
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from exr import read_exr
from harness import BINARY, DEADLINE, CommandTest

RUN_FIELDS = {
    "sampler", "image", "spp", "wavelengths", "render_seconds", "samples_per_second", "rays_per_second",
    "mean_delta_e", "median_delta_e", "p95_delta_e", "max_delta_e", "mse", "relmse", "non_finite_samples",
    "optimize_seconds",
}  # fmt: skip

SVG = "{http://www.w3.org/2000/svg}"


def start_with_signals(ignored):
    """As a terminal's shell starts its commands, but for a signal."""
    for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
        signal.signal(number, signal.SIG_IGN if number == ignored else signal.SIG_DFL)


class Render(CommandTest):
    def render(self, name, *options, sampler="uniform"):
        self.photopic("render", self.scene, "-o", name, "--sampler", sampler, "--spp", "4", "--quiet", *options)

    def mean_difference(self, first, second):
        self.photopic("diff", first, second, "--json", "diff.json")
        return self.read_json("diff.json")["runs"][0]["mean_delta_e"]

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
        self.assertEqual(run["non_finite_causes"], {})
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

    def test_time_and_target_error_end_a_render(self):
        self.photopic("render", self.scene, "-o", "a.exr", "--sampler", "uniform", "--time", "0.5", "--json", "a.json")
        run = self.read_json("a.json")
        self.assertGreaterEqual(run["mean_spp"], 1)
        self.assertEqual(run["spp"], round(run["mean_spp"]))
        self.assertGreater(run["render_seconds"], 0.5)
        self.assertIsNone(run["expected_mean_delta_e"])
        self.photopic(
            "render", self.scene, "-o", "b.exr", "--sampler", "uniform", "--target-error", "3", "--json", "b.json"
        )
        run = self.read_json("b.json")
        self.assertLessEqual(run["expected_mean_delta_e"], 3)
        self.assertNotIn("--target-error", self.photopic("render", self.scene, "-o", "b.exr", "--sampler", "uniform",
                                                         "--target-error", "3", "--spp", "32").stderr)  # fmt: skip
        few = ("--sampler", "uniform", "--target-error", "3", "--spp", "8", "--json", "few.json", "--quiet")
        result = self.photopic("render", self.scene, "-o", "few.exr", *few)
        self.assertNotIn("expected", result.stdout)
        self.assertEqual(result.stderr, "warning: --target-error was not judged: that takes 32 samples a pixel, not 8\n")
        self.assertIsNone(self.read_json("few.json")["expected_mean_delta_e"])
        self.photopic("render", self.scene, "-o", "c.exr", "--sampler", "illuminant", "--spp", "4096", "--seed", "9")
        self.assertLess(self.mean_difference("c.exr", "b.exr"), 3.3)

    def test_xyz_holds_the_same_colors(self):
        self.render("a.exr", "-o", "a.png")
        self.render("xyz.exr", "-o", "xyz.png", "--color", "xyz")
        self.assertIn(b"CIE XYZ", (self.folder / "xyz.exr").read_bytes())
        self.assertLess(self.max_difference("a.exr", "xyz.exr"), 0.001)
        self.assertEqual(self.max_difference("a.png", "xyz.png"), 0)
        self.assert_refused(["render", self.scene, "-o", "a.hdr", "--color", "xyz"], "--color xyz", ".exr")

    def test_white_balance_makes_the_lamp_white(self):
        lamp = ("--emitter", "cie:A")
        self.render("day.exr")
        self.render("warm.exr", *lamp)
        self.render("balanced.exr", *lamp, "--white-balance", "illuminant")
        self.render("named.exr", *lamp, "--white-balance", "cie:A")
        self.assertEqual(self.max_difference("balanced.exr", "named.exr"), 0)
        self.photopic("diff", "day.exr", "warm.exr", "balanced.exr", "--json", "diff.json")
        warm, balanced = (run["mean_delta_e"] for run in self.read_json("diff.json")["runs"])
        self.assertLess(balanced, 0.5 * warm)
        self.assert_refused(
            ["render", self.scene, "-o", "a.exr", "--white-balance", "line:700"], "--white-balance line:700"
        )

    def test_observers_see_daylight_white_but_not_every_lamp_alike(self):
        for lamp in ("cie:D65", "cie:FL11"):
            for observer in ("1931", "1964"):
                self.render(f"{lamp[4:]}-{observer}.exr", "--emitter", lamp, "--observer", observer)
        self.assertGreater(self.max_difference("FL11-1931.exr", "FL11-1964.exr"), 1)
        means = {}
        for observer in ("1931", "1964"):
            self.render("a.exr", "--observer", observer, "--json", "a.json", "--emitter", "cie:D65")
            means[observer] = self.read_json("a.json")["mean_xyz"]
        self.assertNotEqual(means["1931"], means["1964"])

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

    def wait_for_handler(self, pid, awaited=signal.SIGINT):
        """Until the process catches the signal."""
        for _ in range(DEADLINE * 20):
            status = pathlib.Path(f"/proc/{pid}/status").read_text()
            caught = int(re.search(r"SigCgt:\s*([0-9a-f]+)", status).group(1), 16)
            if caught >> (awaited - 1) & 1:
                return
            time.sleep(0.05)
        self.fail(f"{awaited} is not caught")

    def interrupt(self, seconds, *options, sent=signal.SIGINT, ignored=None):
        """Renders until the signal, sent some time after it is caught, and after one that is ignored. Returns what
        stderr held."""
        command = [BINARY, "render", str(self.scene), "-o", "a.exr", "--json", "a.json", *options]
        process = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True, env=self.environment,
                                   preexec_fn=lambda: start_with_signals(ignored))  # fmt: skip
        self.wait_for_handler(process.pid, sent)
        if ignored:
            process.send_signal(ignored)
        time.sleep(seconds)
        process.send_signal(sent)
        if sent == signal.SIGHUP:  # the terminal's, and the shell's after it
            process.send_signal(sent)
        _, stderr = process.communicate(timeout=DEADLINE)
        self.assertEqual(process.returncode, 128 + sent, stderr)
        self.assertIn("interrupted", stderr)
        return stderr

    def test_interrupt_saves_the_partial_image(self):
        self.check_partial_image(signal.SIGINT)

    def test_so_does_sigterm(self):
        self.check_partial_image(signal.SIGTERM)

    def test_so_does_a_closed_terminal(self):
        self.check_partial_image(signal.SIGHUP)

    def test_ignored_signals_stay_ignored(self):
        self.check_partial_image(signal.SIGINT, ignored=signal.SIGHUP)  # nohup
        self.check_partial_image(signal.SIGTERM, ignored=signal.SIGINT)  # in the background of a script

    def check_partial_image(self, sent, ignored=None):
        self.interrupt(1, "--sampler", "uniform", "--spp", str(1 << 24), sent=sent, ignored=ignored)
        run = self.read_json("a.json")
        self.assertTrue(run["interrupted"])
        self.assertGreater(run["mean_xyz"][1], 0)
        self.render("b.exr", sampler="visible")
        self.photopic("diff", "b.exr", "a.exr", "--json", "diff.json")
        self.assertLess(self.read_json("diff.json")["runs"][0]["mean_delta_e"], 50)  # black is much farther

    def test_interrupt_before_the_first_sample_writes_nothing(self):
        for name in ["a.exr", "a.json"]:
            (self.folder / name).write_text("precious")
        stderr = self.interrupt(0, "--sampler", "optimized", "--no-cache", "--wavelengths", "16", "--quiet")
        self.assertEqual(len(stderr.splitlines()), 1, stderr)
        for name in ["a.exr", "a.json"]:
            self.assertEqual((self.folder / name).read_text(), "precious")

    def test_png_says_how_it_was_made(self):
        self.render("a.PNG", "--seed", "7")
        png = (self.folder / "a.PNG").read_bytes()
        for keyword, text in [("sampler", "uniform"), ("spp", "4"), ("seed", "7"), ("scene", str(self.scene))]:
            self.assertIn(f"tEXt{keyword}\0{text}".encode(), png)
        self.assertNotIn(b"render_seconds", png)
        for keyword, text in [("color", "sRGB"), ("exposure", "0 EV"), ("observer", "CIE 1931")]:
            self.assertIn(f"tEXt{keyword}\0{text}".encode(), png)
        self.assertNotIn(b"linear sRGB", png)
        self.render("a.EXR")
        self.assertIn(b"render_seconds", (self.folder / "a.EXR").read_bytes())

    def test_exr_and_json_say_how_it_was_made(self):
        self.render("sky.exr", "--resolution", "8x4")
        self.render("a.exr", "--sequence", "independent", "--max-depth", "5", "--observer", "1964", "--white-balance",
                    "cie:A", "--environment", "sky.exr", "--environment-strength", "2", "--environment-rotation", "-30",
                    "--json", "a.json")  # fmt: skip
        settings = {"sequence": "independent", "max_depth": 5, "observer": "CIE 1964", "white_balance": "cie:A",
                    "environment": "sky.exr", "environment_strength": 2, "environment_rotation": -30}  # fmt: skip
        self.assertLessEqual(settings.items(), self.read_json("a.json").items())
        attributes, _ = read_exr(self.folder / "a.exr")
        for key, value in settings.items():
            text = value if isinstance(value, str) else f"{value}" if key == "max_depth" else f"{value:.1f}"
            self.assertEqual(attributes[key].decode(), text, key)
        self.render("plain.exr", "--color", "xyz", "--json", "plain.json")
        attributes, _ = read_exr(self.folder / "plain.exr")
        self.assertEqual(attributes["sequence"], b"sobol")
        for key in ["environment", "environment_rotation", "white_balance"]:  # XYZ is as it was observed
            self.assertNotIn(key, attributes)
        self.assertIsNone(self.read_json("plain.json")["environment"])
        self.assertEqual(self.read_json("plain.json")["white_balance"], "D65")

    def test_pipes_are_written_to(self):
        out = self.photopic("render", self.scene, "-o", "a.exr", "--sampler", "uniform", "--spp", "1", "--quiet",
                            "--json", "/dev/stdout").stdout  # fmt: skip
        self.assertEqual(json.loads(out)["spp"], 1)
        self.assertIsNone(json.loads(out)["mean_xyz_standard_error"])  # one sample has no variance

    def test_names_that_are_no_utf8(self):
        self.render(os.fsdecode(b"\xff.exr"), "--json", "a.json")
        self.assertEqual(self.read_json("a.json")["image"], "\ufffd.exr")


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
        self.assertEqual(self.read_json("a.json")["optimize_seconds"], result["optimize_seconds"])

    def test_same_seed_same_result_whatever_threads(self):
        def result(threads):
            self.optimize("--threads", threads)
            return re.sub(r'"optimize_seconds": .*', "", (self.folder / "d.json").read_text())

        self.assertEqual(result("1"), result("2"))

    def test_plot_and_table(self):
        out = self.optimize("--wavelengths", "5", "--plot", "d.svg", "--json", "result.json").stdout
        root = xml.etree.ElementTree.parse(self.folder / "d.svg").getroot()
        self.assertEqual(root.tag, SVG + "svg")
        # The spectrum's outline, five densities, X, Y, Z before and after.
        self.assertEqual(len(root.findall(SVG + "polyline")), 1 + 5 + 6)
        self.assertIn("wavelength [nm]", [text.text for text in root.iter(SVG + "text")])

        samplers = self.read_json("result.json")["samplers"]
        self.assertEqual([s["sampler"] for s in samplers], ["uniform", "visible", "illuminant", "optimized"])
        uniform, optimized = samplers[0], samplers[-1]
        for measure in ["objective_value", "delta_e_64_paths_white", "delta_e_64_paths_reflectances"]:
            self.assertLess(optimized[measure], 0.5 * uniform[measure], measure)
        self.assertIn(f"{optimized['delta_e_64_paths_reflectances']:.3f}", out)


class Spectrum(CommandTest):
    def test_describes_a_lamp(self):
        out = self.photopic("spectrum", "cie:FL11", "--plot", "a.svg", "--json", "a.json").stdout
        lamp = self.read_json("a.json")
        self.assertAlmostEqual(lamp["cct_kelvin"], 4000, delta=5)
        self.assertAlmostEqual(lamp["x"], 0.3805, delta=5e-4)  # CIE 015:2018
        self.assertAlmostEqual(lamp["y"], 0.3769, delta=5e-4)
        self.assertIn(545, [line["nm"] for line in lamp["lines"]])
        self.assertIn("x 0.3805, y 0.377", out)
        self.assertIn("545.00", out)
        self.assertEqual(xml.etree.ElementTree.parse(self.folder / "a.svg").getroot().tag, SVG + "svg")

    def test_no_temperature_far_from_the_locus(self):
        out = self.photopic("spectrum", "line:532", "--json", "a.json").stdout
        self.assertIsNone(self.read_json("a.json")["cct_kelvin"])
        self.assertIn("none", out)

    def test_flat_light_has_no_peak(self):
        self.photopic("spectrum", "constant", "--plot", "a.svg", "--json", "a.json", "--quiet")
        self.assertIsNone(self.read_json("a.json")["peak_nm"])

    def test_dark_lamps_are_refused(self):
        (self.folder / "dark.csv").write_text("400 0\n700 0\n")
        self.assert_refused(["spectrum", "dark.csv"], "dark.csv", "no visible light")

    def test_titles_are_escaped(self):
        name = '<a> & "b".csv'
        (self.folder / name).write_text("400 1\n500 2\n600 1\n")
        self.photopic("spectrum", name, "--plot", "a.svg")
        root = xml.etree.ElementTree.parse(self.folder / "a.svg").getroot()
        self.assertIn(name, [text.text for text in root.iter(SVG + "text")])


class Cache(CommandTest):
    def render(self, *options):
        result = self.photopic("render", self.scene, "-o", "a.exr", "--emitter", "cie:A", "--wavelengths", "1",
                               "--spp", "1", "--json", "a.json", "--quiet", *options)  # fmt: skip
        return result.stderr.splitlines(), self.read_json("a.json")["optimize_seconds"]

    def test_keeps_and_reuses_by_content(self):
        first = self.render()  # the seconds are the search's, whenever it was
        self.assertGreater(first[1], 0)
        self.assertEqual(self.render(), first)
        self.assertNotEqual(self.render("--no-cache"), first)
        self.assertEqual(len(list((self.folder / "cache/photopic").iterdir())), 1)

    def test_damaged_file_is_reported_and_mended(self):
        self.render()
        (file,) = (self.folder / "cache/photopic").iterdir()
        file.write_text(file.read_text()[:-100])
        warnings, seconds = self.render()
        self.assertEqual(len(warnings), 1)
        self.assertIn(str(file), warnings[0])
        self.assertGreater(seconds, 0)
        self.assertEqual(self.render(), ([], seconds))


class Compare(CommandTest):
    def test_report(self):
        self.photopic("optimize", "cie:FL11", "-o", "d.json", "--effort", "quick", "--quiet")
        out = self.photopic(
            "compare", self.scene, "--emitter", "cie:FL11", "--distribution", "d.json", "--samplers", "uniform,optimized",
            "--spp", "8", "--reference-spp", "256", "--curve", "1,8", "--repeat", "2", "--report", "report",
            "--json", "c.json",
        ).stdout  # fmt: skip
        self.assertEqual(out, (self.folder / "report/comparison.txt").read_text())
        for name in ["uniform", "optimized", "reference"]:
            self.assertTrue((self.folder / f"report/{name}.exr").exists())
            self.assertTrue((self.folder / f"report/{name}.png").exists())
        self.assertTrue((self.folder / "report/color-bars.png").exists())

        result = self.read_json("c.json")
        self.assertEqual((result["sequence"], result["white_balance"], result["environment"]), ("sobol", "D65", None))
        uniform, optimized = result["runs"]
        self.assertLessEqual(RUN_FIELDS, set(uniform))
        self.assertLess(optimized["mean_delta_e"], uniform["mean_delta_e"])
        self.assertAlmostEqual(optimized["gain"], uniform["mean_delta_e"] / optimized["mean_delta_e"], places=9)
        # Half a million samples: five standard errors are an error in the renderer.
        self.assertLess(result["channel_agreement"]["largest_z"], 5)
        self.assertGreater(result["reference"]["estimated_mean_delta_e"], 0)
        self.assertLess(result["reference"]["estimated_mean_delta_e"], optimized["mean_delta_e"])
        for run, curve in zip(result["runs"], result["curves"]):
            self.assertEqual(curve["spp"], [1, 8])
            self.assertEqual(curve["mean_delta_e"][1], run["mean_delta_e"])  # the run itself
            self.assertEqual(curve["seconds"][1], run["render_seconds"])
            self.assertGreater(curve["mean_delta_e"][0], run["mean_delta_e"])
            self.assertIn(f"{curve['seconds'][0]:.3f}", out)
        self.assertEqual(optimized["optimize_seconds"], self.read_json("d.json")["optimize_seconds"])

        # The images written are those measured.
        self.photopic("diff", "report/reference.exr", "report/uniform.exr", "--json", "diff.json")
        measured = self.read_json("diff.json")["runs"][0]["mean_delta_e"]
        self.assertAlmostEqual(measured, uniform["mean_delta_e"], places=4)

    def test_densities_of_another_lamp_are_unbiased(self):
        self.photopic("optimize", "cie:FL11", "-o", "d.json", "--effort", "quick", "--quiet")
        for lamp in ["cie:FL9", "cie:A"]:
            result = self.photopic("compare", self.scene, "--emitter", lamp, "--distribution", "d.json", "--samplers",
                                   "illuminant,optimized", "--spp", "64", "--reference-spp", "2", "--json", "c.json",
                                   "--quiet")  # fmt: skip
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
            self.assertIn("d.json: was made for another lamp or other powers (cie:FL11)", result.stderr)
            self.assertLess(self.read_json("c.json")["channel_agreement"]["largest_z"], 5)

    def test_a_window_is_measured_alone(self):
        common = ["--spp", "4", "--sequence", "independent", "--resolution", "40x24", "--quiet"]
        compare = ["compare", self.scene, "--samplers", "uniform", *common]
        crop = ["--crop", "11,3,29,22"]
        self.photopic(*compare, "--reference-spp", "8", "--report", "whole")
        self.photopic(*compare, *crop, "--reference-spp", "8", "--report", "part", "--json", "c.json")
        result = self.read_json("c.json")
        self.assertEqual(result["scene"]["crop"], [11, 3, 29, 22])
        self.assertEqual(result["runs"][0]["mean_spp"], 4)
        self.photopic("render", self.scene, "-o", "part.exr", "--sampler", "uniform", *crop, *common)
        self.photopic("diff", "part.exr", "part/uniform.exr", "--json", "d.json")
        self.assertEqual(self.read_json("d.json")["runs"][0]["max_delta_e"], 0)
        for reference in ["whole/reference.exr", "part/reference.exr"]:  # the one is cut, the other is cut already
            self.photopic(*compare, *crop, "--reference", reference, "--json", "c.json")
            error = self.read_json("c.json")["runs"][0]["mean_delta_e"]
            self.assertAlmostEqual(error, result["runs"][0]["mean_delta_e"], places=4)
        self.assert_refused(compare + ["--crop", "0,0,18,18", "--reference", "part/reference.exr"], "18x19", "18x18")
        self.assert_refused(compare + ["--crop", "0,0,41,24"], "--crop", "40x24")

    def test_equal_times(self):
        compare = ["compare", self.scene, "--samplers", "uniform,visible", "--time", "0.1", "--json", "c.json"]
        out = self.photopic(*compare, "--curve", "1").stdout
        result = self.read_json("c.json")
        for run in result["runs"]:
            self.assertIn(f" {run['mean_spp']:.1f} ", out)
            self.assertGreater(run["mean_spp"], 1)
            self.assertEqual(run["spp"], round(run["mean_spp"]))
            self.assertGreaterEqual(run["render_seconds"], 0.1)
        self.assertIn("samples/pixel", out)
        self.assertGreater(result["reference"]["render_seconds"], 1.6)
        self.assertGreater(result["reference"]["spp"], result["runs"][0]["spp"])
        self.assertIn(f"optimized, {result['reference']['spp']} spp", out)
        self.photopic(*compare, "--spp", "1", "--reference-spp", "8")
        result = self.read_json("c.json")
        self.assertEqual([run["mean_spp"] for run in result["runs"]], [1, 1])
        self.assertEqual(result["reference"]["spp"], 8)

    def test_diff_measures_with_the_same_whites(self):
        self.photopic("render", self.scene, "-o", "r.exr", "--sampler", "uniform", "--spp", "8", "--seed", "9", "--quiet")
        errors = []
        for white, lamp in [("D65", "D65"), ("illuminant", "cie:FL11")]:
            self.photopic("compare", self.scene, "--emitter", "cie:FL11", "--reference", "r.exr", "--samplers", "uniform",
                          "--spp", "4", "--report", "report", "--white", white, "--json", "c.json", "--quiet")  # fmt: skip
            out = self.photopic("diff", "r.exr", "report/uniform.exr", "--white", lamp, "--json", "d.json", "--quiet").stdout
            self.assertEqual(out, "")
            self.assertEqual(self.read_json("d.json")["white"], lamp)
            errors.append(self.read_json("d.json")["runs"][0]["mean_delta_e"])
            self.assertAlmostEqual(errors[-1], self.read_json("c.json")["runs"][0]["mean_delta_e"], places=4)
        self.assertGreater(abs(errors[0] - errors[1]), 0.01)

    def interrupt_after_the_reference(self, *options):
        """Returns what stderr held after it."""
        command = [BINARY, "compare", str(self.scene), "--samplers", "uniform", "--spp", str(1 << 24), "--reference-spp",
                   "4", "--no-cache", *options]  # fmt: skip
        process = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True, env=self.environment,
                                   preexec_fn=lambda: start_with_signals(None))  # fmt: skip
        while "reference, half 2" not in process.stderr.readline():
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=DEADLINE)
        self.assertEqual(process.returncode, 130, stderr)
        return stderr

    def test_interrupt_of_the_first_run_keeps_the_reference(self):
        self.assertIn("--reference report/reference.exr", self.interrupt_after_the_reference("--report", "report"))
        self.assertEqual({p.name for p in (self.folder / "report").iterdir()}, {"reference.exr", "reference.png"})
        self.photopic("compare", self.scene, "--reference", "report/reference.exr", "--samplers", "uniform", "--spp", "1",
                      "--quiet")  # fmt: skip
        self.assertIn("before there was anything to compare", self.interrupt_after_the_reference())

    def test_one_sample_has_no_variance(self):
        out = self.photopic("compare", self.scene, "--samplers", "uniform,visible", "--spp", "1", "--reference-spp", "2",
                            "--json", "c.json", "--stats").stdout  # fmt: skip
        self.assertNotIn("|z|", out)
        self.assertNotIn("inf", out)
        self.assertIn("± -", out)
        self.assertNotIn("channel_agreement", self.read_json("c.json"))

    def test_existing_reference(self):
        self.photopic("render", self.scene, "-o", "r.exr", "--sampler", "uniform", "--spp", "8", "--quiet")
        self.photopic("compare", self.scene, "--reference", "r.exr", "--samplers", "uniform", "--spp", "8",
                      "--json", "c.json", "--quiet")  # fmt: skip
        result = self.read_json("c.json")
        self.assertEqual(result["reference"]["image"], "r.exr")
        self.assertEqual(result["runs"][0]["max_delta_e"], 0)  # the first sampler renders with the seed itself


if __name__ == "__main__":
    unittest.main()
