"""photopic optimize: its files and pictures, the table over N, measured reflectances, interruption."""

import pathlib
import re
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from harness import BINARY, DEADLINE, CommandTest

SVG = "{http://www.w3.org/2000/svg}"
PAINTS = "nm,red,green\n400,0.1,0.1\n500,0.1,0.6\n600,0.8,0.2\n700,0.9,0.1\n"


class Optimize(CommandTest):
    def optimize(self, *options):
        return self.photopic("optimize", "cie:FL11", "-o", "d.json", "--effort", "quick", *options)

    def test_labelled_color_bar(self):
        self.optimize("--color-bar", "bar.SVG", "--quiet")
        root = xml.etree.ElementTree.parse(self.folder / "bar.SVG").getroot()
        texts = [text.text for text in root.iter(SVG + "text")]
        for label in ["uniform", "visible", "illuminant", "optimized", "true colour", "cie:FL11", "0.0", "0.5", "1.0"]:
            self.assertIn(label, texts)
        self.assertTrue(any(text.startswith("u,") for text in texts))
        bars = root.findall(SVG + "linearGradient")
        self.assertEqual(len(bars), 5)
        true = {stop.get("stop-color") for stop in bars[4]}
        self.assertEqual(len(true), 1)
        seen = [len({stop.get("stop-color") for stop in bar}) for bar in bars]
        self.assertGreater(seen[0], 20)
        # Most of what an optimised path sees is the lamp's colour within a few steps of 8 bits.
        (r, g, b) = self.bytes_of(next(iter(true)))
        near = [all(abs(x - y) <= 12 for x, y in zip(self.bytes_of(s.get("stop-color")), (r, g, b))) for s in bars[3]]
        self.assertGreater(sum(near), 0.8 * len(near))

    def bytes_of(self, color):
        return [int(color[i : i + 2], 16) for i in (1, 3, 5)]

    def test_nodes(self):
        self.optimize("--nodes", "48", "--json", "r.json", "--quiet")
        self.assertEqual(self.read_json("r.json")["nodes"], 48)
        self.assertEqual(len(self.read_json("d.json")["components"][0]["nodes"]), 48)

    def test_table_over_wavelengths(self):
        result = self.photopic("optimize", "cie:FL11", "--compare-wavelengths", "--effort", "quick", "--json", "n.json")
        rows = self.read_json("n.json")["wavelengths"]
        self.assertEqual([row["wavelengths"] for row in rows], [1, 2, 4, 8, 16])
        errors = [row["optimized"]["delta_e_64_paths_reflectances"] for row in rows]
        self.assertEqual(errors, sorted(errors, reverse=True))
        for row in rows:
            self.assertLess(row["optimized"]["delta_e_64_paths_reflectances"],
                            row["best_baseline"]["delta_e_64_paths_reflectances"])  # fmt: skip
            self.assertGreater(row["optimize_seconds"], 0)
        self.assertIn(f"{errors[2]:.3f}", result.stdout)
        self.assertIn("illuminant", result.stdout)
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"n.json", "tiny.gltf"})

    def test_table_or_file(self):
        self.assert_refused(["optimize", "cie:A"], "--output")
        table = ["optimize", "cie:A", "--compare-wavelengths"]
        for option in [["-o", "d.json"], ["--wavelengths", "4"], ["--plot", "a.svg"], ["--color-bar", "a.png"]]:
            self.assert_refused(table + option, "--compare-wavelengths")
        self.assert_refused(["optimize", "cie:A", "-o", "d.json", "--nodes", "2"], "--nodes")


class Reflectances(CommandTest):
    def setUp(self):
        super().setUp()
        (self.folder / "paints.csv").write_text(PAINTS)

    def optimize(self, *options):
        return ["optimize", "cie:FL11", "-o", "d.json", "--effort", "quick", "--quiet", *options]

    def test_are_named_in_the_file_and_change_the_result(self):
        self.photopic(*self.optimize())
        without = self.read_json("d.json")
        self.photopic(*self.optimize("--reflectances", "paints.csv", "--json", "r.json"))
        with_paints = self.read_json("d.json")
        targets = with_paints["targets"]
        self.assertEqual((targets["constructed"], targets["measured"], targets["measured_file"]), (48, 2, "paints.csv"))
        self.assertRegex(targets["measured_digest"], "^[0-9a-f]{16}$")
        self.assertEqual(without["targets"]["measured"], 0)
        self.assertNotEqual(without["components"], with_paints["components"])
        result = self.read_json("r.json")
        self.assertEqual((result["targets"], result["measured_targets"]), (50, 2))
        self.photopic("render", self.scene, "-o", "a.exr", "--emitter", "cie:FL11", "--distribution", "d.json",
                      "--spp", "1", "--quiet")  # fmt: skip

    def test_do_not_judge_themselves(self):
        """The table's other rows, measured with held-back reflectances, stay as they are."""
        reports = []
        for options in [[], ["--reflectances", "paints.csv"]]:
            self.photopic(*self.optimize("--json", "r.json", *options))
            reports.append(self.read_json("r.json")["samplers"][0])
        self.assertNotEqual(reports[0].pop("objective_value"), reports[1].pop("objective_value"))
        self.assertEqual(reports[0], reports[1])

    def test_what_is_wrong_is_named(self):
        (self.folder / "percent.csv").write_text("400,10\n500,45\n")
        (self.folder / "short.csv").write_text("400,0.1,0.2\n500,0.3\n")
        for name, needle in [("percent.csv", "percentages"), ("short.csv", "short.csv:2"), ("none.csv", "none.csv")]:
            self.assert_refused(self.optimize("--reflectances", name), name, needle)
        self.assert_refused(self.optimize("--reflectances", "paints.csv", "--objective", "mean-delta-e"), "--reflectances")
        self.assert_refused(
            ["optimize", "cie:A", "-o", "paints.csv", "--reflectances", "paints.csv"], "paints.csv", "overwritten"
        )
        self.assertFalse((self.folder / "d.json").exists())


class Interrupt(CommandTest):
    """Ctrl-C during the search: 130, one line, soon, and nothing written."""

    def interrupt(self, *command):
        process = subprocess.Popen(
            [BINARY, *map(str, command)], cwd=self.folder, stderr=subprocess.PIPE, text=True, env=self.environment
        )
        status = pathlib.Path(f"/proc/{process.pid}/status")
        deadline = time.monotonic() + DEADLINE
        while not int(re.search(r"SigCgt:\s*([0-9a-f]+)", status.read_text()).group(1), 16) >> (signal.SIGINT - 1) & 1:
            self.assertLess(time.monotonic(), deadline, "SIGINT is not caught")
            time.sleep(0.02)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=60)  # such a search would take minutes
        self.assertEqual(process.returncode, 130, stderr)
        self.assertEqual(len(stderr.splitlines()), 1, stderr)
        self.assertIn("interrupted while optimising", stderr)
        self.assertEqual({path.name for path in self.folder.rglob("*")} - {"cache", "photopic"}, {"tiny.gltf"})

    def test_optimize(self):
        long = ["optimize", "cie:FL11", "--effort", "thorough", "--quiet"]
        self.interrupt(*long, "-o", "d.json", "--wavelengths", "16", "--plot", "d.svg", "--json", "r.json")
        self.interrupt(*long, "--compare-wavelengths", "--json", "r.json")

    def test_render_and_compare(self):
        rows = "".join(f"{360 + 0.005 * i:.3f} {1 + (i * 7919) % 97}\n" for i in range(90000))
        lamp = self.folder.parent / (self.folder.name + "-lamp.txt")
        self.addCleanup(lamp.unlink)
        lamp.write_text(rows)  # so many rows, and 16 wavelengths, that the search is still at work
        options = ["--emitter", lamp, "--wavelengths", "16", "--spp", "1", "--quiet", "--json", "r.json"]
        self.interrupt("render", self.scene, "-o", "a.exr", *options)
        self.interrupt("compare", self.scene, "--samplers", "optimized", "--report", "report", *options)


if __name__ == "__main__":
    unittest.main()
