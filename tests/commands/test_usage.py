"""Help, and what is refused: exit code 1, one line on stderr that says what and where, nothing written."""

import base64
import json
import os
import unittest

from harness import CommandTest
from tiny_scene import write_tiny_scene

COMMANDS = {
    "render": "--output --spp --sampler --wavelengths --emitter --distribution --resolution --scene --camera --max-depth "
    "--sequence --exposure --seed --threads --quiet --json --stats --batch-size --no-cache "
    "--aov --spectral-bins --crop",
    "optimize": "--output --wavelengths --objective --effort --white --seed --threads --color-bar --plot --json --quiet "
    "--compare-wavelengths --nodes --reflectances",
    "compare": "--samplers --reference --reference-spp --curve --white --json --report --repeat --spp --emitter --scene --camera "
    "--crop --time",
    "diff": "--json --threads --white --quiet --exposure --map",
    "info": "--emitter --resolution --scene --camera --threads --json --quiet",
    "spectrum": "--plot --json --quiet --threads",
}


class Help(CommandTest):
    def test_each_command_explains_its_options_and_gives_an_example(self):
        for command, options in COMMANDS.items():
            text = self.photopic(command, "--help").stdout
            for option in options.split():
                self.assertIn(option, text, command)
            self.assertIn(f"Example: photopic {command} ", text)

    def test_main_help_names_the_commands(self):
        text = self.photopic("--help").stdout
        for command in COMMANDS:
            self.assertIn(command, text)

    def test_version(self):
        self.assertRegex(self.photopic("--version").stdout, r"^photopic \d+\.\d+\.\d+\n$")


class Refused(CommandTest):
    def render(self, *options):
        return ["render", self.scene, "-o", "out.exr", "--sampler", "uniform", "--spp", "1", *options]

    def test_bad_usage(self):
        self.assert_refused([], "--help")
        self.assert_refused(["paint"], "paint: there is no such command; see")
        self.assert_refused(["render"], "SCENE", "photopic render --help")
        self.assert_refused(["render", self.scene], "--output")
        self.assert_refused(self.render("--frobnicate"), "frobnicate")
        self.assert_refused(["diff", "one.exr"], "IMAGE")
        self.assert_refused(["compare", self.scene, "--reference", "a.exr", "--reference-spp", "4"], "--reference")

    def test_the_culprit_is_named(self):
        again = "; give {} anew before each value; see"
        crop = "; --crop takes one value, X0,Y0,X1,Y1; see"
        for arguments, needles in [
            (["render", "-o", "a.exr", "a.png", self.scene], [f"not expected: {self.scene}", again.format("--output")]),
            (["render", "--aov", "albedo", "normal", "-o", "a.exr", self.scene], [again.format("--aov")]),
            (["render", "--emitter", "cie:A", "cie:D65", "-o", "a.exr", self.scene], [again.format("--emitter")]),
            (["render", "-o", "a.exr", self.scene, "b.glb"], ["not expected: b.glb; give one SCENE; see"]),
            (["render", self.scene, "b.glb", "-o", "a.exr"], ["not expected: b.glb; give one SCENE; see"]),
            (["render", self.scene, "-o", "a.exr", "--crop", "0", "0", "4", "4"], ["not expected: 0 4 4" + crop]),
            (["render", self.scene, "-o", "a.exr", "--crop=0", "0", "4", "4"], [crop]),
            (["render", "-o", "a.exr", "--quiet", "b.glb", self.scene], ["give one SCENE"]),
            (["info", self.scene, "b", "c"], ["not expected: b c; give one SCENE; see"]),
            (["spectrum", "--plot", "a.svg", "cie:A", "cie:D65"], ["not expected: cie:D65; give one SPECTRUM; see"]),
            (["render", "--out", "a.exr", self.scene], ["--out: there is no such option (--output?); see"]),
            (["render", "--camra", "eye", self.scene], ["--camra: there is no such option (--camera?); see"]),
            (["optimise", "cie:A"], ["optimise: there is no such command (optimize?); see"]),
            (["render", "--frobnicate=1", self.scene], ["--frobnicate: there is no such option; see"]),
            (["render", self.scene, "a.exr"], ["--output is required"]),
            (["render", "--", self.scene], ["--output is required"]),
            (["compare", self.scene, "--sampler", "uniform"], ["--sampler: there is no such option (--samplers?);"]),
        ]:
            self.assert_refused(arguments, *needles)

    def test_options_given_too_often_or_without_a_value(self):
        for option in ["--spp", "--seed", "--json", "--scene", "--camera"]:
            self.assert_refused(self.render(option, "1", option, "2"), option + " is given ", "times; give it once")
            self.assert_refused(["render", self.scene, "-o", "out.exr", option], option + ": its value is missing")
        self.assert_refused(["optimize", "cie:A", "-o", "a.json", "-o", "b.json"], "--output is given 2 times")
        self.assert_refused(["render", self.scene, "-o", "a.exr", "-o", "b.exr", "-o"], "--output: its value is missing")

    def test_values_out_of_range(self):
        for option, value in [
            ("--spp", "0"),
            ("--spp", "-3"),
            ("--spp", "16777217"),
            ("--spp", "99999999999999999999"),
            ("--spp", "many"),
            ("--spp", "1e3"),
            ("--wavelengths", "3"),
            ("--wavelengths", "32"),
            ("--sampler", "magic"),
            ("--sequence", "halton"),
            ("--max-depth", "0"),
            ("--batch-size", "0"),
            ("--threads", "-1"),
            ("--seed", "-1"),
            ("--seed", "4294967296"),
            ("--exposure", "nan"),
            ("--exposure", "inf"),
            ("--exposure", "bright"),
            ("--time", "0"),
            ("--time", "nan"),
            ("--target-error", "nan"),
        ]:
            self.assert_refused(self.render(option, value), option)
        for size in ["0x5", "12", "x", "12x", "70000x1", "-4x4", "4x4x4", "4.5x4", " 4x4"]:
            self.assert_refused(self.render("--resolution=" + size), "--resolution")
        self.assert_refused(self.render("--resolution", "65536x65536"), "too large")

    def test_outputs_are_checked_first(self):
        (self.folder / "folder.exr").mkdir()
        for output in ["missing/out.exr", "out.bmpx", "out", "folder.exr"]:
            self.assert_refused(["render", self.scene, "-o", output], output)
        self.assert_refused(self.render("--json", "missing/run.json"), "missing/run.json")
        self.assert_refused(["optimize", "cie:A", "-o", "missing/d.json"], "missing/d.json")
        self.assert_refused(["optimize", "cie:A", "-o", "d.json", "--color-bar", "missing/bar.png"], "missing/bar.png")
        self.assert_refused(["optimize", "cie:A", "-o", "d.json", "--plot", "missing/a.svg"], "missing/a.svg")
        self.assert_refused(["spectrum", "cie:A", "--plot", "missing/a.svg"], "missing/a.svg")
        self.assert_refused(["spectrum", "cie:A", "--json", "missing/a.json"], "missing/a.json")
        self.assert_refused(["compare", self.scene, "--report", "missing/report"], "missing/report")
        self.assertFalse((self.folder / "out.exr").exists())

    def test_inputs_and_other_outputs_are_not_overwritten(self):
        (self.folder / "lamp.csv").write_text("400 1\n700 1\n")
        (self.folder / "lamp*2.csv").write_text("400 1\n700 1\n")
        (self.folder / "link.json").symlink_to("lamp.csv")
        self.photopic(*self.render("--quiet"))
        before = {path: path.read_bytes() for path in self.folder.iterdir()}
        render = ["render", self.scene, "-o", "new.exr", "--sampler", "uniform"]
        for command, name in [
            (render + ["--json", "tiny.gltf"], "tiny.gltf"),
            (render + ["--json", "./new.exr"], "new.exr"),
            (render + ["-o", self.folder / "new.exr"], "new.exr"),
            (render + ["--emitter", "lamp=lamp.csv", "--json", "lamp.csv"], "lamp.csv"),
            (["optimize", "lamp.csv", "-o", "lamp.csv"], "lamp.csv"),
            (["optimize", "cie:A", "lamp.csv*0.5", "-o", "link.json"], "link.json"),
            (["optimize", "lamp*2.csv", "-o", "lamp*2.csv"], "lamp*2.csv"),
            (["optimize", "cie:A", "-o", "a.json", "--json", "a.json"], "a.json"),
            (["optimize", "cie:A", "-o", "a.json", "--color-bar", "a.svg", "--plot", "../" + self.folder.name + "/a.svg"], "a.svg"),
            (["spectrum", "lamp.csv", "--json", "lamp.csv"], "lamp.csv"),
            (["diff", "out.exr", "out.exr", "--json", "out.exr"], "out.exr"),
            (["compare", self.scene, "--json", self.scene], "tiny.gltf"),
            (["compare", self.scene, "--reference", "out.exr", "--json", "out.exr"], "out.exr"),
            (["compare", self.scene, "--report", ".", "--json", "comparison.txt"], "comparison.txt"),
        ]:
            self.assert_refused(command, name, "written")
        self.assertEqual({path: path.read_bytes() for path in self.folder.iterdir()}, before)

    def test_files_that_a_scene_names_are_not_overwritten(self):
        scene = json.loads(self.scene.read_text())
        buffer = scene["buffers"][0]["uri"].split(",")[1]
        scene["buffers"][0]["uri"] = "the%20data.json"
        scene["images"] = [{"uri": "unused.png"}]
        scene["materials"][0]["extras"] = {"reflectance_spectrum": "grey.csv"}
        (self.folder / "the data.json").write_bytes(base64.b64decode(buffer))
        (self.folder / "unused.png").write_text("precious")
        (self.folder / "grey.csv").write_text("400 0.5\n700 0.5\n")
        (self.folder / "apart.gltf").write_text(json.dumps(scene))
        render = ["render", "apart.gltf", "--sampler", "uniform", "--spp", "1", "--quiet"]
        before = {path: path.read_bytes() for path in self.folder.iterdir()}
        self.assert_refused(render + ["-o", "new.exr", "--json", "the data.json"], "the data.json", "overwritten")
        self.assert_refused(render + ["-o", "unused.png"], "unused.png", "overwritten")
        self.assert_refused(render + ["-o", "new.exr", "--json", "grey.csv"], "grey.csv", "overwritten")
        self.assert_refused(["compare", "apart.gltf", "--json", "grey.csv"], "grey.csv", "overwritten")
        self.assert_refused(["info", "apart.gltf", "--json", "grey.csv"], "grey.csv", "overwritten")
        self.assertEqual({path: path.read_bytes() for path in self.folder.iterdir()}, before)

    def test_links_are_followed_when_nothing_is_there_yet(self):
        (self.folder / "far").mkdir()
        (self.folder / "near.json").symlink_to("middle.json")
        (self.folder / "middle.json").symlink_to("far/end.json")
        self.photopic("spectrum", "cie:A", "--quiet", "--json", "near.json")
        self.assertTrue((self.folder / "near.json").is_symlink())
        self.assertFalse((self.folder / "far" / "end.json").is_symlink())
        self.assertEqual(self.read_json("far/end.json")["spectrum"], "cie:A")
        (self.folder / "lost.json").symlink_to("nowhere/end.json")
        self.assert_refused(["spectrum", "cie:A", "--json", "lost.json"], "lost.json", "nowhere")
        (self.folder / "loop.json").symlink_to("loop.json")
        self.assert_refused(["spectrum", "cie:A", "--json", "loop.json"], "loop.json", "link")
        (self.folder / "one.json").symlink_to("new.json")
        self.assert_refused(["optimize", "cie:A", "-o", "new.json", "--json", "one.json"], "one.json", "twice")

    def test_bad_inputs_are_named(self):
        (self.folder / "broken.gltf").write_text('{"asset": {"version": ')
        (self.folder / "broken.csv").write_text("400, 1\n500, two\n")
        (self.folder / "broken.json").write_text("[1, 2")
        (self.folder / "broken.exr").write_text("no image")
        self.assert_refused(["render", "missing.gltf", "-o", "out.exr"], "missing.gltf")
        self.assert_refused(["render", "broken.gltf", "-o", "out.exr"], "broken.gltf")
        self.assert_refused(self.render("--emitter", "cie:FL99"), "FL99")
        self.assert_refused(self.render("--emitter", "missing.spd"), "missing.spd")
        self.assert_refused(self.render("--emitter", "broken.csv"), "broken.csv:2")
        self.assert_refused(self.render("--emitter", "torch=cie:A"), "torch")
        self.assert_refused(self.render("--camera", "eye"), "eye")
        self.assert_refused(["optimize", "broken.csv", "-o", "d.json"], "broken.csv:2")
        self.assert_refused(["render", self.scene, "-o", "out.exr", "--distribution", "broken.json"], "broken.json")
        self.assert_refused(["diff", "missing.exr", "broken.exr"], "missing.exr")
        self.assert_refused(["diff", "broken.exr", "broken.exr"], "broken.exr")
        self.photopic(*self.render("-o", "broken.png", "--quiet"))
        png = bytearray((self.folder / "broken.png").read_bytes())
        png[len(png) // 2] ^= 0xFF
        (self.folder / "broken.png").write_bytes(png)
        self.assert_refused(["diff", "broken.png", "broken.png"], "broken.png")  # libpng says nothing beside
        self.assert_refused(["compare", self.scene, "--samplers", "uniform,uniform"], "uniform")
        self.assert_refused(["compare", self.scene, "--samplers", "uniform,odd"], "odd")

    def test_what_is_no_file_is_told_apart(self):
        (self.folder / "folder.exr").mkdir()
        os.mkfifo(self.folder / "pipe.exr")
        (self.folder / "locked.exr").write_text("secret")
        self.photopic(*self.render("--quiet"))
        for reader in [
            lambda name: ["info", name],
            lambda name: ["render", name, "-o", "a.exr"],
            lambda name: ["diff", "out.exr", name],
            lambda name: ["compare", self.scene, "--reference", name],
            lambda name: self.render("--environment", name),
            lambda name: ["render", self.scene, "-o", "a.exr", "--distribution", name],
            lambda name: ["optimize", "cie:A", "-o", "d.json", "--reflectances", name],
        ]:
            self.assert_refused(reader("missing.exr"), "missing.exr: there is no such file; check its name")
            self.assert_refused(reader("folder.exr"), "folder.exr: is a folder")
            self.assert_refused(reader("pipe.exr"), "pipe.exr: is a pipe or device")
            if os.geteuid() != 0:  # whom nothing is forbidden
                (self.folder / "locked.exr").chmod(0)
                self.assert_refused(reader("locked.exr"), "locked.exr: may not be read", "permissions")

    def test_a_lamp_without_light_has_no_distribution(self):
        (self.folder / "dark.csv").write_text("400, 0\n700, 0\n")
        (self.folder / "negative.csv").write_text("400, 1\n500, -1\n")
        self.assert_refused(["optimize", "dark.csv", "-o", "d.json"], "dark.csv")
        self.assert_refused(["optimize", "negative.csv", "-o", "d.json"], "negative.csv")
        self.assertFalse((self.folder / "d.json").exists())

    def test_a_scene_without_light_gets_a_sky(self):
        dark = write_tiny_scene(self.folder / "dark.gltf", emission=None)
        result = self.photopic("render", dark, "-o", "out.exr", "--sampler", "illuminant", "--spp", "1", "--quiet")
        self.assertIn("nothing in", result.stderr)
        self.assertIn("lit by an overcast sky", result.stderr)
        self.photopic("render", dark, "-o", "sky.hdr", "--sampler", "uniform", "--spp", "1", "--quiet",
                      "--resolution", "64x32")
        lit = self.photopic("render", dark, "-o", "lit.exr", "--sampler", "uniform", "--spp", "1", "--quiet",
                            "--environment", "sky.hdr", "--environment-rotation", "90", "--environment-strength", "2")  # fmt: skip
        self.assertNotIn("sky", lit.stderr)

    def test_environments_and_factors_must_make_sense(self):
        self.assert_refused(self.render("--environment", "missing.exr"), "missing.exr")
        self.assert_refused(self.render("--environment", "broken.csv"), "broken.csv")
        self.assert_refused(self.render("--environment-strength", "2"), "--environment")
        self.assert_refused(self.render("--punctual-scale", "0"), "above 0")
        self.assert_refused(self.render("--environment", "out.exr"), "out.exr")

    def test_distribution_must_fit(self):
        self.photopic("optimize", "cie:A", "-o", "a.json", "--effort", "quick", "--quiet")
        self.photopic("optimize", "cie:A", "-o", "a3.json", "--wavelengths", "3", "--effort", "quick", "--quiet")
        render = ["render", self.scene, "-o", "out.exr", "--spp", "1"]
        self.assert_refused(render + ["--distribution", "a.json", "--emitter", "cie:A", "--wavelengths", "8"], "a.json", "4")
        self.assert_refused(render + ["--distribution", "a3.json", "--emitter", "cie:A"], "a3.json", "3")
        self.assert_refused(self.render("--distribution", "a.json"), "--distribution", "optimized")
        self.assertFalse((self.folder / "out.exr").exists())
        self.photopic(*self.render("--quiet"))
        compare = ["compare", self.scene, "--emitter", "cie:A", "--spp", "1", "--quiet", "--distribution", "a.json"]
        existing = compare + ["--reference", "out.exr", "--samplers"]
        self.assert_refused(existing + ["uniform,visible"], "--distribution", "optimised sampler alone", "--samplers")
        self.photopic(*existing, "optimized")
        self.photopic(*compare, "--samplers", "uniform", "--reference-spp", "2")  # the reference's

    def assert_warned(self, arguments, *needles):
        """The command must succeed with one warning, which must hold the needles."""
        (warning,) = self.photopic(*arguments).stderr.splitlines()
        for needle in needles:
            self.assertIn(needle, warning)

    def test_distribution_of_another_lamp_is_warned_of_unless_it_leaves_a_gap(self):
        self.photopic("optimize", "cie:A", "-o", "a.json", "--effort", "quick", "--quiet")
        render = ["render", self.scene, "-o", "out.exr", "--emitter", "cie:FL11", "--spp", "1", "--quiet", "--distribution"]
        self.assert_warned(render + ["a.json"], "a.json", "another lamp", "cie:A", "cie:FL11", "unbiased")
        (self.folder / "out.exr").unlink()
        gap = self.read_json("a.json")
        at = gap["base"]["nm"].index(700)
        gap["base"]["density"][at - 1 : at + 2] = [0, 0, 0]
        (self.folder / "gap.json").write_text(json.dumps(gap))
        self.assert_refused(render + ["gap.json"], f"gap.json#/base/density/{at - 1}", "must be positive")
        self.assertFalse((self.folder / "out.exr").exists())

    def test_lamps_have_powers(self):
        self.assert_refused(["optimize", "cie:A", "cie:FL11*much", "-o", "d.json"], "cie:FL11*much", "much")
        for power in ["0", "-1", "1e300", "1e-300", "1e999", "inf", "nan", ""]:
            self.assert_refused(["optimize", "cie:D65", f"cie:A*{power}", "-o", "d.json"], f"cie:A*{power}: ", "1e+100")
        self.photopic("optimize", "cie:D65*1e-100", "cie:A*1e100", "-o", "d.json", "--effort", "quick", "--quiet")
        self.assert_refused(["optimize", "cie:A*2", "cie:FL99*2", "-o", "d.json"], "FL99")

    def test_distribution_of_several_lamps_fits_all_and_their_powers(self):
        scene = json.loads(self.scene.read_text())
        wall = scene["materials"][1]
        wall["emissiveFactor"] = [1.0, 1.0, 1.0]  # 4 m2 of 1 cd/m2; the lamp 0.64 m2 of 5 cd/m2: 0.8 of its power
        (self.folder / "two.gltf").write_text(json.dumps(scene))
        render = ["render", "two.gltf", "-o", "out.exr", "--spp", "1", "--quiet", "--resolution", "8x8",
                  "--emitter", "wall=blackbody:2700", "--emitter", "lamp=cie:FL11", "--distribution", "d.json"]  # fmt: skip
        for lamps in [["cie:FL11"], ["cie:FL11", "blackbody:2700"], ["cie:FL11*1.25", "blackbody:2700"]]:
            self.photopic("optimize", *lamps, "-o", "d.json", "--effort", "quick", "--quiet")
            self.assert_warned(render, "d.json", "another lamp", "blackbody:2700", "cie:FL11*0.8")
        self.photopic("optimize", "cie:FL11*8", "blackbody:2700*10", "-o", "d.json", "--effort", "quick", "--quiet")
        self.assertEqual(self.photopic(*render).stderr, "")

    def test_images_of_other_sizes_are_refused(self):
        self.photopic(*self.render("--quiet"))
        self.photopic("render", self.scene, "-o", "small.exr", "--resolution", "8x4", "--sampler", "uniform", "--quiet")
        self.assert_refused(["diff", "out.exr", "small.exr"], "small.exr", "8x4")
        self.assert_refused(["compare", self.scene, "--reference", "small.exr", "--samplers", "uniform"], "small.exr")

    def test_the_white_of_a_diff_gives_light(self):
        self.photopic(*self.render("--quiet"))
        (self.folder / "dark.csv").write_text("400 0\n700 0\n")
        for white in ["dark.csv", "line:900", "illuminant"]:
            self.assert_refused(["diff", "out.exr", "out.exr", "--white", white], white)
        self.assert_refused(["diff", "out.exr", "out.exr", "--white", "dark.csv", "--json", "dark.csv"], "overwritten")

    def test_failure_leaves_existing_files_alone(self):
        for name in ["out.exr", "run.json", "d.json"]:
            (self.folder / name).write_text("precious")
        self.assert_refused(self.render("--json", "run.json", "--emitter", "cie:FL99"))
        self.assert_refused(["render", "missing.gltf", "-o", "out.exr", "--json", "run.json"])
        self.assert_refused(["optimize", "cie:FL99", "-o", "d.json"])
        for name in ["out.exr", "run.json", "d.json"]:
            self.assertEqual((self.folder / name).read_text(), "precious")
        self.assertFalse(list(self.folder.glob(".*")), "temporary files are left")


if __name__ == "__main__":
    unittest.main()
