"""photopic diff: which channels and which window it compares, what it warns of, its map. Environments share the reader."""

import struct
import unittest

from exr import read_exr, write_exr
from harness import CommandTest

GREY = {"R": 0.5, "G": 0.5, "B": 0.5}


def layer(name, r, g, b):
    return {f"{name}.R": r, f"{name}.G": g, f"{name}.B": b}


class DiffTest(CommandTest):
    def write(self, name, channels, width=8, height=4, **windows):
        write_exr(self.folder / name, channels, width, height, **windows)

    def difference(self, *images):
        self.photopic("diff", *images, "--json", "diff.json", "--quiet")
        return self.read_json("diff.json")["runs"][0]

    def render(self, name, *options):
        self.photopic("render", self.scene, "-o", name, "--sampler", "uniform", "--spp", "4", "--resolution", "40x24",
                      "--quiet", *options)  # fmt: skip


class Channels(DiffTest):
    OTHERS = {
        "spectral.exr": {f"S0.{nm},000000nm": 1 for nm in range(400, 800, 25)},
        "normals.exr": {"normal.X": 0, "normal.Y": 0, "normal.Z": 1},
        "junk.exr": {"u": 2, "v": 3, "depth.Z": 5},
        "two.exr": layer("a", 1, 2, 3) | layer("b", 1, 2, 3),
        "red.exr": {"R": 1},
    }

    def test_the_rendered_layer_of_several_is_read(self):
        self.write("rgb.exr", {"R": 1, "G": 2, "B": 3})
        self.write("blender.exr", layer("ViewLayer.AO", 7, 8, 9) | layer("ViewLayer.Combined", 1, 2, 3) | {"ViewLayer.Depth.Z": 4})
        self.write("layer.exr", layer("view", 1, 2, 3) | {"view.A": 0})
        for name in ["blender.exr", "layer.exr"]:
            self.assertEqual(self.difference("rgb.exr", name)["max_delta_e"], 0, name)
        self.write("grey.exr", {"Y": 0.5})
        self.write("same.exr", GREY)
        self.assertEqual(self.difference("same.exr", "grey.exr")["max_delta_e"], 0)

    def test_what_is_no_picture_is_refused_by_its_channels(self):
        self.write("same.exr", GREY)
        for name, channels in self.OTHERS.items():
            self.write(name, channels)
            environment = ["render", self.scene, "-o", "a.exr", "--environment", name]
            reference = ["compare", self.scene, "--reference", name, "--samplers", "uniform"]
            for command in [["diff", "same.exr", name], ["diff", name, "same.exr"], environment, reference]:
                self.assert_refused(command, f"{name}: its channels are not those of one picture: ", min(channels))
        self.assert_refused(["diff", "same.exr", "spectral.exr"], "S0.400,000000nm", " and 8 more")


class Windows(DiffTest):
    def test_a_crop_is_compared_with_that_window_of_the_whole(self):
        self.render("whole.exr")
        self.render("other.exr", "--seed", "1")
        self.render("a.exr", "--crop", "20,10,25,13", "--seed", "1")
        self.render("w.exr", "--crop", "20,10,25,13")
        expected = self.difference("w.exr", "a.exr")
        for pair, whole in [(["whole.exr", "a.exr"], "whole.exr"), (["w.exr", "other.exr"], "other.exr")]:
            result = self.photopic("diff", *pair)
            self.assertIn(f"note: {whole}: of it the window 20,10,25,13 alone", result.stderr)
            found = self.difference(*pair)
            self.assertEqual(found["crop"], [20, 10, 25, 13])
            self.assertEqual(found["mean_delta_e"], expected["mean_delta_e"])
        self.assertEqual(self.photopic("diff", "whole.exr", "a.exr", "--quiet").stderr, "")
        self.assertIsNone(self.difference("whole.exr", "other.exr")["crop"])

    def test_other_windows_are_refused(self):
        self.render("whole.exr")
        self.render("a.exr", "--crop", "20,10,25,13", "-o", "a.png")
        self.render("b.exr", "--crop", "0,0,5,3", "--seed", "1")
        self.write("small.exr", GREY, 5, 3)
        self.assert_refused(["diff", "a.exr", "b.exr"], "b.exr: is the window 0,0,5,3 of 40x24", "not 20,10,25,13")
        self.assert_refused(["diff", "a.exr", "small.exr"], "small.exr: is the window 0,0,5,3 of 5x3")
        self.write("odd.exr", GREY, 5, 3, left=38, top=0, full=(40, 24))
        self.assert_refused(["diff", "whole.exr", "odd.exr"], "5x3", "40x24")  # it reaches beyond
        self.photopic("diff", "a.exr", "a.png")  # which does not tell
        self.assert_refused(["compare", self.scene, "--resolution", "5x3", "--samplers", "uniform", "--reference", "b.exr"],
                            "b.exr: is the window 0,0,5,3 of 40x24")  # fmt: skip


class OtherLight(DiffTest):
    def test_is_warned_of_in_a_line(self):
        self.render("reference.exr", "--emitter", "cie:A")
        self.render("same.exr", "--emitter", "cie:A", "--seed", "1", "--max-depth", "3")
        self.render("other.exr", "--emitter", "cie:FL11", "--seed", "1", "-o", "other.png")
        self.render("eye.exr", "--emitter", "cie:A", "--seed", "1", "--observer", "1964", "--white-balance", "cie:A")
        self.write("silent.exr", GREY, 40, 24)
        lines = self.photopic("diff", "reference.exr", "same.exr", "other.exr", "eye.exr", "other.png", "silent.exr").stderr
        lines = lines.splitlines()
        self.assertEqual(len(lines), 3, lines)
        for line, name in zip(lines, ["other.exr", "eye.exr", "other.png"]):
            self.assertTrue(line.startswith(f"warning: {name}: cannot match the reference"), line)
        self.assertRegex(lines[0], "spectra .*FL11, not .*A$")
        self.assertIn("observer CIE 1964, not CIE 1931; white balance cie:A, not D65", lines[1])
        compare = ["compare", self.scene, "--reference", "reference.exr", "--samplers", "visible,illuminant", "--spp", "1",
                   "--resolution", "40x24", "--quiet"]  # fmt: skip
        lines = self.photopic(*compare).stderr.splitlines()
        self.assertEqual(len(lines), 1, lines)
        self.assertIn("tiny.gltf: cannot match the reference, by what both files tell: spectra", lines[0])
        self.assertEqual(self.photopic(*compare, "--emitter", "cie:A").stderr, "")


class Map(DiffTest):
    def test_exr_has_delta_e_as_it_is(self):
        self.render("a.exr")
        self.render("b.exr", "--seed", "1")
        self.photopic("diff", "a.exr", "b.exr", "--map", "map.exr", "--json", "diff.json")
        run = self.read_json("diff.json")["runs"][0]
        attributes, channels = read_exr(self.folder / "map.exr")
        self.assertEqual(list(channels), ["dE"])
        self.assertEqual(len(channels["dE"]), 40 * 24)
        self.assertAlmostEqual(sum(channels["dE"]) / (40 * 24), run["mean_delta_e"], delta=1e-5 * run["mean_delta_e"])
        self.assertAlmostEqual(max(channels["dE"]), run["max_delta_e"], places=4)
        self.assertEqual(attributes["reference"], b"a.exr")

    def test_of_a_crop_it_lies_where_that_does(self):
        self.render("a.exr", "--crop", "20,10,25,13")
        self.render("b.exr", "--seed", "1")
        for pair in [("a.exr", "b.exr"), ("b.exr", "a.exr")]:
            self.photopic("diff", *pair, "--map", "map.exr")
            attributes, channels = read_exr(self.folder / "map.exr")
            self.assertEqual(struct.unpack("<4i", attributes["dataWindow"]), (20, 10, 24, 12))
            self.assertEqual(struct.unpack("<4i", attributes["displayWindow"]), (0, 0, 39, 23))
            self.assertEqual(len(channels["dE"]), 15)

    def test_png_is_as_light_as_the_error_is_large(self):
        """Of greys: L* and ΔE follow by hand. A map is read as what it is, a picture."""
        self.write("black.exr", dict.fromkeys("RGB", 0))
        self.photopic("diff", "black.exr", "black.exr", "--map", "none.png")
        self.assertEqual(self.difference("black.exr", "none.png")["max_delta_e"], 0)
        self.write("white.exr", dict.fromkeys("RGB", 1))
        self.photopic("diff", "black.exr", "white.exr", "--map", "most.png")  # 100, far beyond the scale
        self.assertLess(self.difference("white.exr", "most.png")["max_delta_e"], 0.5)
        self.assertIn(b"tEXtscale\0black to white: CIEDE2000 of 0 to 10", (self.folder / "most.png").read_bytes())

    def test_refused(self):
        self.write("a.exr", GREY)
        for name in ["map.jpg", "map.hdr", "map"]:
            self.assert_refused(["diff", "a.exr", "a.exr", "--map", name], name, ".exr or .png")
        self.assert_refused(["diff", "a.exr", "a.exr", "a.exr", "--map", "map.exr"], "--map map.exr", "not of 2")
        self.assert_refused(["diff", "a.exr", "a.exr", "--map", "a.exr"], "overwritten")
        self.assert_refused(["diff", "a.exr", "a.exr", "--map", "none/a.exr"], "none")


class Exposure(DiffTest):
    def test_is_before_delta_e_alone(self):
        self.write("a.exr", GREY)
        self.write("b.exr", {"R": 0.5, "G": 0.25, "B": 0.5})
        self.write("a2.exr", dict.fromkeys("RGB", 2))
        self.write("b2.exr", {"R": 2, "G": 1, "B": 2})
        plain, bright = self.difference("a.exr", "b.exr"), self.difference("a2.exr", "b2.exr")
        exposed = self.difference("a.exr", "b.exr", "--exposure", "2")
        self.assertAlmostEqual(exposed["mean_delta_e"], bright["mean_delta_e"], places=4)
        self.assertNotAlmostEqual(exposed["mean_delta_e"], plain["mean_delta_e"], places=1)
        self.assertEqual(exposed["mse"], plain["mse"])
        self.assertEqual(self.read_json("diff.json")["exposure"], 2)
        self.assert_refused(["diff", "a.exr", "b.exr", "--exposure", "nan"], "--exposure")


class Environments(DiffTest):
    def warnings(self, name):
        return self.photopic("render", self.scene, "-o", "a.exr", "--sampler", "uniform", "--spp", "1", "--quiet",
                             "--environment", name).stderr  # fmt: skip

    def test_are_twice_as_wide_as_high(self):
        for size in [(8, 4), (9, 4), (1, 1), (1, 64)]:
            self.write("sky.exr", GREY, *size)
            self.assertEqual(self.warnings("sky.exr"), "", size)
        self.write("sky.exr", GREY, 8, 8)
        self.assertEqual(self.warnings("sky.exr"), "warning: sky.exr: is 8x8 pixels where an equirectangular map is twice as "
                                                   "wide as high: it is stretched over the sky\n")  # fmt: skip

    def test_are_whole(self):
        self.write("part.exr", GREY, 8, 4, full=(16, 8))
        self.assert_refused(["render", self.scene, "-o", "a.exr", "--environment", "part.exr"], "part.exr", "8x4", "16x8")

    def test_may_be_grey(self):
        self.write("grey.exr", {"Y": 0.5})
        self.write("same.exr", GREY)
        images = []
        for name in ["grey.exr", "same.exr"]:
            self.assertEqual(self.warnings(name), "")
            images.append(read_exr(self.folder / "a.exr")[1])
        self.assertEqual(*images)


if __name__ == "__main__":
    unittest.main()
