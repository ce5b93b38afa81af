"""Outputs that cannot be written: told in a line each, exit code 1, nothing old is lost, everything else is written."""

import json
import os
import resource
import subprocess
import unittest

from harness import BINARY, DEADLINE, CommandTest

LIMIT = 8192  # bytes a file may have; a full disk fails alike, but takes root to make


def limit_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, LIMIT))


class OutputTest(CommandTest):
    def run_limited(self, *arguments):
        """With files limited to LIMIT bytes."""
        return self.run_photopic(*arguments, preexec_fn=limit_files)

    def render(self, *options, size="128x128"):
        return ["render", self.scene, "--sampler", "uniform", "--spp", "1", "--resolution", size, "--quiet", *options]

    def assert_no_partial_files(self):
        self.assertEqual([path.name for path in self.folder.rglob("*.partial*")], [])


class FullDisk(OutputTest):
    def test_each_kind_of_image_fails_in_one_line_and_leaves_the_old_one(self):
        for name in ["a.png", "a.jpg", "a.exr", "a.hdr"]:
            (self.folder / name).write_text("precious")
            result = self.run_limited(*self.render("-o", name))
            self.assertEqual(result.returncode, 1, name)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
            self.assertIn(f"photopic: {name}: cannot be written: File too large", result.stderr)
            self.assertEqual((self.folder / name).read_text(), "precious")
        self.assert_no_partial_files()

    def test_the_remedy_is_that_of_the_cause(self):
        (self.folder / "full.exr").symlink_to("/dev/full")
        result = self.run_photopic(*self.render("-o", "full.exr"))
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr, "photopic: full.exr: cannot be written: No space left on device; "
                                        "free space on the disk or choose another\n")  # fmt: skip
        self.assertIn("ulimit -f", self.run_limited(*self.render("-o", "a.exr")).stderr)
        self.assertIn("a shorter name", self.run_photopic(*self.render("-o", "n" * 256 + ".exr")).stderr)

    def test_what_can_be_written_is(self):
        result = self.run_limited(*self.render("-o", "a.jpg", "-o", "b.exr", "-o", "c.png", "--json", "d.json"))
        self.assertEqual(result.returncode, 1)
        lines = result.stderr.splitlines()
        self.assertEqual([line.split(": ")[1] for line in lines], ["a.jpg", "b.exr", "c.png"])
        self.assertEqual(self.read_json("d.json")["spp"], 1)
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"tiny.gltf", "d.json"})

    def test_images_that_fit_are_the_same_as_ever(self):
        small = self.render("-o", "a.exr", "-o", "b.png", "--stats", size="40x40")
        self.photopic(*small)
        (self.folder / "b.png").rename(self.folder / "whole.png")
        result = self.run_limited(*small)
        self.assertEqual(result.returncode, 1)
        self.assertEqual([line.split(": ")[1] for line in result.stderr.splitlines()], ["a.exr"])
        self.assertEqual((self.folder / "b.png").read_bytes(), (self.folder / "whole.png").read_bytes())
        self.assertIn("M samples/s", result.stdout)

    def test_optimize(self):
        result = self.run_limited("optimize", "cie:FL11", "-o", "d.json", "--effort", "quick", "--quiet",
                                  "--color-bar", "bar.svg", "--json", "r.json")  # fmt: skip
        self.assertEqual(result.returncode, 1)
        self.assertEqual([line.split(": ")[1] for line in result.stderr.splitlines()], ["d.json", "bar.svg"])
        self.assertLess(self.read_json("r.json")["objective_value"], 5)
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"tiny.gltf", "r.json"})

    def test_compare(self):
        result = self.run_limited("compare", self.scene, "--samplers", "uniform,visible", "--spp", "1",
                                  "--reference-spp", "2", "--resolution", "128x128", "--no-cache", "--report", "report",
                                  "--json", "c.json")  # fmt: skip
        self.assertEqual(result.returncode, 1)
        failed = [line.split(": ")[1] for line in result.stderr.splitlines()]
        for name in ["uniform.exr", "uniform.png", "visible.exr", "reference.png"]:
            self.assertIn(f"report/{name}", failed)
        self.assertEqual(result.stdout, (self.folder / "report/comparison.txt").read_text())
        self.assertEqual(len(self.read_json("c.json")["runs"]), 2)
        self.assert_no_partial_files()

    def test_standard_output(self):
        for arguments in [["info", self.scene], ["--version"], ["render", "--help"], ["spectrum", "cie:A"]]:
            with open("/dev/full", "w") as full:
                result = subprocess.run([BINARY, *map(str, arguments)], cwd=self.folder, env=self.environment,
                                        stdout=full, stderr=subprocess.PIPE, text=True, timeout=DEADLINE)  # fmt: skip
            self.assertEqual(result.returncode, 1, arguments)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
            self.assertIn("standard output", result.stderr)
        self.assertIn("No space left", result.stderr)

    def test_a_pipe_without_a_reader(self):
        """As after `| head -1`: what goes there is missed, and nothing else. A report's reader may have read enough; of JSON
        half is none."""
        reader, writer = os.pipe()
        os.close(reader)
        for arguments in [["info", self.scene], self.render("-o", "a.png", "--stats"),
                          ["info", self.scene, "--json", "/dev/stdout"]]:  # fmt: skip
            result = subprocess.run([BINARY, *map(str, arguments)], cwd=self.folder, env=self.environment,
                                    stdout=writer, stderr=subprocess.PIPE, text=True, timeout=DEADLINE)  # fmt: skip
            self.assertEqual(result.returncode, 1, arguments)
            if "--json" not in arguments:
                self.assertEqual(result.stderr, "", arguments)
        self.assertIn("Broken pipe; what was to read it has ended", result.stderr)
        os.close(writer)
        self.assertTrue((self.folder / "a.png").exists())


class WhereTheyLead(OutputTest):
    def info(self, target, **redirection):
        return subprocess.run([BINARY, "info", str(self.scene), "--json", target], cwd=self.folder, timeout=DEADLINE,
                              env=self.environment, **redirection)  # fmt: skip

    def test_standard_output_is_written_where_it_stands(self):
        log = self.folder / "log.txt"
        for target in ["/dev/stdout", "/proc/self/fd/1", "/dev/fd/1"]:
            log.write_text("before\n")
            with open(log, "a") as out:
                out.write("mine\n")
                out.flush()
                self.assertEqual(self.info(target, stdout=out).returncode, 0)
                out.write("after\n")
            text = log.read_text()
            self.assertTrue(text.startswith("before\nmine\n"), text)
            self.assertTrue(text.endswith("after\n"), text)
            self.assertIn('"cameras"', text)
            self.assertEqual({p.name for p in self.folder.iterdir()}, {"tiny.gltf", "log.txt"})

    def test_standard_error_too(self):
        with open(self.folder / "log.txt", "w") as out:
            self.assertEqual(self.info("/dev/stderr", stderr=out, stdout=subprocess.DEVNULL).returncode, 0)
        self.assertIn('"cameras"', (self.folder / "log.txt").read_text())

    def test_links_are_followed_and_permissions_kept(self):
        (self.folder / "there").mkdir()
        real = self.folder / "there/real.exr"
        (self.folder / "link.exr").symlink_to(real)
        self.photopic(*self.render("-o", "link.exr", size="8x8"))
        real.chmod(0o640)
        self.photopic(*self.render("-o", "link.exr", size="8x8"))
        self.assertTrue((self.folder / "link.exr").is_symlink())
        self.assertEqual(real.stat().st_mode & 0o777, 0o640)

    def test_long_names_can_be_written(self):
        name = "n" * 251 + ".exr"
        self.photopic(*self.render("-o", name, size="8x8"))
        self.assertTrue((self.folder / name).exists())
        self.assert_refused(self.render("-o", "n" + name), "n" + name, "File name too long")
        self.assert_no_partial_files()

    @unittest.skipIf(os.geteuid() == 0, "root may write everything")
    def test_protected_files_and_folders_are_refused(self):
        (self.folder / "keep.exr").write_text("precious")
        (self.folder / "keep.exr").chmod(0o444)
        self.assert_refused(self.render("-o", "keep.exr"), "keep.exr", "cannot be written to")
        self.assertEqual((self.folder / "keep.exr").read_text(), "precious")
        (self.folder / "closed").mkdir(0o555)
        self.assert_refused(self.render("-o", "closed/a.exr"), "closed/a.exr", "Permission denied")

    def test_what_cannot_take_its_place_is_kept(self):
        """A folder that appears under the file's name while the image before it, too large for the pipe, waits."""
        os.mkfifo(self.folder / "first.exr")
        command = [BINARY, *map(str, self.render("-o", "first.exr", "-o", "a.exr", size="256x256"))]
        process = subprocess.Popen(command, cwd=self.folder, env=self.environment, stderr=subprocess.PIPE, text=True)
        with open(self.folder / "first.exr", "rb") as pipe:
            (self.folder / "a.exr").mkdir()
            (self.folder / "a.exr/occupied").touch()
            first = pipe.read()
        error = process.communicate(timeout=DEADLINE)[1]
        self.assertEqual(process.returncode, 1)
        self.assertGreater(len(first), 1 << 17)
        self.assertIn("a.exr: cannot be replaced", error)
        kept = [path for path in self.folder.iterdir() if ".partial" in path.name]
        self.assertEqual(len(kept), 1)
        self.assertIn(kept[0].name, error)
        self.assertEqual(kept[0].read_bytes()[:4], first[:4])

    def test_processes_of_the_same_number_do_not_share_a_partial_file(self):
        """Containers number theirs apart; here each free name has been taken by another."""
        names = [f".a.{{}}{number}.partial.exr" for number in ["", "-0", "-1"]]

        def take_names():
            for name in names:
                (self.folder / name.format(os.getpid())).write_text("another's")

        result = self.run_photopic(*self.render("-o", "a.exr", size="8x8"), preexec_fn=take_names)
        self.assertEqual(result.returncode, 0, result.stderr)
        others = list(self.folder.glob(".a.*.partial.exr"))
        self.assertEqual([path.read_text() for path in others], ["another's"] * len(names))
        self.assertTrue((self.folder / "a.exr").exists())
class BrokenStderr(OutputTest):
    """Nobody can be told, but the work is done all the same."""

    def run_mute(self, stderr, *arguments, **settings):
        return subprocess.run([BINARY, *map(str, arguments)], cwd=self.folder, env=self.environment, stderr=stderr,
                              stdout=subprocess.PIPE, timeout=DEADLINE, **settings)  # fmt: skip

    def assert_works(self, stderr, **settings):
        talkative = ["render", self.scene, "-o", "a.exr", "--sampler", "uniform", "--spp", "2", "--exposure", "1"]
        self.assertEqual(self.run_mute(stderr, *talkative, "--json", "a.json", **settings).returncode, 0)
        self.assertEqual(self.read_json("a.json")["spp"], 2)
        self.photopic("diff", "a.exr", "a.exr")  # an image, and no words in it
        self.assertEqual(self.run_mute(stderr, "info", "missing.gltf", **settings).returncode, 1)
        for file in ["a.exr", "a.json"]:
            (self.folder / file).unlink()

    def test_full(self):
        with open("/dev/full", "w") as full:
            self.assert_works(full)

    def test_closed(self):
        self.assert_works(None, preexec_fn=lambda: os.close(2))

    def test_pipe_without_a_reader(self):
        reader, writer = os.pipe()
        os.close(reader)
        self.assert_works(writer)
        os.close(writer)


class RefusedEarly(OutputTest):
    def test_a_jpeg_has_a_largest_size(self):
        for size in ["65501x1", "1x65536"]:
            self.assert_refused(self.render("-o", "a.png", "-o", "wide.JPG", size=size), "wide.JPG", "65500", size)
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"tiny.gltf"})
        self.photopic(*self.render("-o", "wide.jpg", size="65500x1"))
        self.photopic(*self.render("-o", "wide.png", size="65536x1"))

    def test_plots_are_svg(self):
        self.assert_refused(["spectrum", "cie:A", "--plot", "a.png"], "a.png", ".svg")
        self.assert_refused(["optimize", "cie:A", "-o", "d.json", "--plot", "a"], "a:", ".svg")
        self.assert_refused(["optimize", "cie:A", "-o", "d.json", "--color-bar", "c.txt"], "c.txt", ".svg", ".png")
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"tiny.gltf"})
        help_ = " ".join(self.photopic("optimize", "--help").stdout.split())
        self.assertIn(".svg with labels, or an image, .exr .hdr .png .jpg", help_)
        self.photopic("spectrum", "cie:A", "--quiet", "--plot", "a.SVG")

    def test_a_report_needs_a_folder(self):
        (self.folder / "nowhere").symlink_to("missing")
        (self.folder / "file").write_text("precious")
        compare = ["compare", self.scene, "--samplers", "uniform", "--no-cache", "--report"]
        for report in ["nowhere", "nowhere/"]:
            self.assert_refused(compare + [report], report, "a symbolic link to no folder")
        self.assert_refused(compare + ["file"], "file", "is not a folder")
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"tiny.gltf", "nowhere", "file"})

    def test_an_empty_name_is_none(self):
        for option in ["-o", "--json", "--distribution", "--environment", "--white-balance", "--camera"]:
            self.assert_refused(["render", self.scene, "-o", "a.exr", option, ""], "it is empty")
        for option in ["--report", "--reference", "--json"]:
            self.assert_refused(["compare", self.scene, option, ""], option, "it is empty")
        for option in ["-o", "--plot", "--color-bar", "--reflectances", "--json"]:
            self.assert_refused(["optimize", "cie:A", option, ""], "it is empty")
        self.assert_refused(["spectrum", "cie:A", "--plot", ""], "--plot", "it is empty")

    def test_a_hyphen_is_standard_output_for_json_alone(self):
        self.assert_refused(["optimize", "cie:A", "-o", "-"], "-: ", "/dev/stdout")
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"tiny.gltf"})
        self.assertIn('"cameras"', self.photopic("info", self.scene, "--json", "-").stdout)
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"tiny.gltf"})


class JsonOnStandardOutput(OutputTest):
    """Nothing else goes there; and --quiet leaves nothing but warnings."""

    COMPARE = ["--samplers", "uniform", "--spp", "1", "--reference-spp", "2", "--no-cache", "--resolution", "8x8"]
    WAVELENGTHS = ["optimize", "cie:A", "--compare-wavelengths", "--effort", "quick", "--nodes", "9"]

    def commands(self):
        self.photopic(*self.render("-o", "a.exr", size="8x8"))
        return [
            ["info", self.scene],
            ["spectrum", "cie:A"],
            ["diff", "a.exr", "a.exr"],
            ["render", self.scene, "-o", "b.exr", "--sampler", "uniform", "--spp", "1", "--stats"],
            ["render", self.scene, "-o", "b.exr", "--sampler", "uniform", "--target-error", "50"],
            ["compare", self.scene, *self.COMPARE, "--stats"],
            ["optimize", "cie:A", "-o", "d.json", "--effort", "quick", "--nodes", "9"],
            self.WAVELENGTHS,
        ]

    def test_is_json_and_nothing_else(self):
        for command in self.commands():
            for name in ["-", "/dev/stdout"]:
                self.assertIn("version", json.loads(self.photopic(*command, "--json", name).stdout), command)

    def test_quiet_is_quiet(self):
        for command in self.commands():
            if "--stats" not in command:
                self.assertEqual(self.photopic(*command, "--quiet").stdout, "", command)
        self.assertEqual(self.photopic("compare", self.scene, *self.COMPARE, "--quiet").stdout, "")


class IdleOptions(OutputTest):
    def warnings(self, *options, scene=None):
        command = ["render", scene or self.scene, "--sampler", "uniform", "--spp", "1", "--quiet", *options]
        return self.photopic(*command).stderr.splitlines()

    def test_each_is_warned_of_in_one_line(self):
        xyz = ["--color", "xyz", "--white-balance", "cie:A"]
        for options, name in [
            (["-o", "a.exr", "-o", "b.hdr", "--exposure", "1"], "--exposure"),
            (["-o", "a.exr", "--punctual-scale", "0.001464"], "--punctual-scale"),
            (["-o", "a.exr", *xyz], "--white-balance"),
        ]:
            lines = self.warnings(*options)
            self.assertEqual(len(lines), 1, lines)
            self.assertRegex(lines[0], f"^warning: {name} has no effect")
        result = self.photopic("compare", self.scene, "--samplers", "uniform", "--spp", "1", "--reference-spp", "2",
                               "--quiet", "--exposure", "1", "--no-cache")  # fmt: skip
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn("--exposure has no effect", result.stderr)

    def test_a_cache_that_cannot_be_kept(self):
        (self.folder / "file").write_text("precious")
        self.environment["XDG_CACHE_HOME"] = str(self.folder / "file")
        lines = self.photopic("render", self.scene, "-o", "a.exr", "--wavelengths", "1", "--spp", "1", "--quiet")
        lines = lines.stderr.splitlines()
        self.assertEqual(len(lines), 1, lines)
        for needle in ["warning: cannot keep the distribution", "XDG_CACHE_HOME", "--no-cache"]:
            self.assertIn(needle, lines[0])

    def test_not_where_they_have_one(self):
        scene = json.loads(self.scene.read_text())
        scene["extensionsUsed"] += ["KHR_lights_punctual"]
        scene["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 5}]}}
        scene["nodes"][1]["extensions"] = {"KHR_lights_punctual": {"light": 0}}
        (self.folder / "lit.gltf").write_text(json.dumps(scene))
        self.assertEqual(self.warnings("-o", "a.exr", "-o", "a.png", "--exposure", "1"), [])
        self.assertEqual(self.warnings("-o", "a.exr", "--punctual-scale", "0.5", scene="lit.gltf"), [])
        self.assertEqual(
            self.warnings("-o", "a.exr", "-o", "a.png", "--color", "xyz", "--white-balance", "cie:A"), []
        )


class ClippedReference(OutputTest):
    def test_is_warned_of_once(self):
        self.photopic("render", self.scene, "-o", "a.exr", "-o", "a.png", "-o", "a.jpg", "--sampler", "uniform", "--spp", "2",
                      "--seed", "9", "--quiet")  # fmt: skip
        for reference in ["a.png", "a.jpg"]:
            for command in [
                ["diff", reference, "a.jpg", "a.exr"],
                ["compare", self.scene, "--reference", reference, "--samplers", "visible,illuminant", "--spp", "1", "--quiet"],
            ]:
                clipped = [line for line in self.photopic(*command).stderr.splitlines() if "clipped" in line]
                self.assertEqual(len(clipped), 1, command)
                self.assertIn(f"warning: {reference}: ", clipped[0])
        self.assertNotIn("clipped", self.photopic("diff", "a.exr", "a.png").stderr)


class SharedNoise(OutputTest):
    def render_to(self, name, seed, sampler="uniform"):
        self.photopic("render", self.scene, "-o", name, "--sampler", sampler, "--spp", "2", "--seed", seed, "--quiet")

    def test_is_warned_of(self):
        self.render_to("reference.exr", 3)
        self.render_to("same.exr", 3)
        self.render_to("same.png", 3)
        self.render_to("seed.exr", 4)
        self.render_to("sampler.exr", 3, "visible")
        result = self.photopic("diff", "reference.exr", "same.exr", "seed.exr", "sampler.exr", "same.png")
        self.assertEqual([line.split(": ")[1] for line in result.stderr.splitlines()], ["same.exr", "same.png"])
        self.assertIn("--seed", result.stderr)
        compare = ["compare", self.scene, "--reference", "reference.exr", "--samplers", "visible,uniform", "--spp", "2",
                   "--quiet", "--seed"]  # fmt: skip
        self.assertIn("warning: uniform: has the reference's", self.photopic(*compare, "2").stderr)
        self.assertEqual(self.photopic(*compare, "3").stderr, "")


if __name__ == "__main__":
    unittest.main()
