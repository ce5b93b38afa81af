"""Malformed scenes: refused in one line or loaded, never a crash, a hang or much memory.

As a script it takes files of its own (else the fixture), --all to try all their mutations, which takes an hour, or
--write FOLDER to leave them there, which gltf_replay reads in seconds:
    PHOTOPIC_BINARY=build/release/src/photopic tests/commands/test_malformed.py --all [FILE.gltf|.glb…]
    PHOTOPIC_BINARY= tests/commands/test_malformed.py --write DIR [FILE…]; build/release/tests/fuzz/gltf_replay DIR"""

import base64
import concurrent.futures
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

from harness import CommandTest
from mutations import all_mutations, encode
from tiny_scene import tiny_scene

BINARY = os.environ["PHOTOPIC_BINARY"]
FIXTURE = pathlib.Path(__file__).parent.parent / "gltf" / "all_features.gltf"
SHARED = pathlib.Path(os.environ.get("PHOTOPIC_SHARED", "/nonexistent"), "gltf")
SECONDS = 20  # of processor time, to tell a hang on the slowest machine; a good one takes a fraction of one
MEGABYTES = 200
ODD_BUT_VALID = {"geo_degenerate_all", "node_chain_50000", "node_scale_zero"}
EITHER = {"mat_bad_values"}

# What wait4 measures would be this process's and its earlier children's without a process between.
MEASURE = """
import json, os, resource, subprocess, sys
limit = int(sys.argv[1])
resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
try:
    result = subprocess.run(sys.argv[2:], capture_output=True, timeout=120)
except subprocess.TimeoutExpired:
    sys.exit("it hangs")
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
print(json.dumps([result.returncode, result.stderr.decode(errors="replace"), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024]))
"""


class Outcome:
    def __init__(self, arguments):
        command = [sys.executable, "-S", "-c", MEASURE, "60", BINARY, *map(str, arguments)]
        measured = subprocess.run(command, capture_output=True, text=True)
        hung = (-1, measured.stderr, 0, 0)
        self.code, self.stderr, self.seconds, self.megabytes = json.loads(measured.stdout or "null") or hung

    def faults(self):
        """What must not be, whatever the file."""
        if self.code not in (0, 1):
            yield f"exit code {self.code}: {self.stderr[:300]}"
        if self.seconds > SECONDS:
            yield f"{self.seconds:.2f} s"
        if self.megabytes > MEGABYTES:
            yield f"{self.megabytes:.0f} MB"
        lines = self.stderr.splitlines()
        if self.code == 1 and len(lines) != 1:
            yield f"{len(lines)} lines for a refusal: {self.stderr[:300]!r}"
        if self.code == 1 and "scene.gl" not in self.stderr:
            yield f"the refusal names no file: {self.stderr[:300]}"
        if self.code == 1 and len(self.stderr) > 1500:
            yield f"a refusal of {len(self.stderr)} characters"
        if re.search(r"[\x00-\x09\x0b-\x1f\x7f]", self.stderr):
            yield f"control characters: {self.stderr[:300]!r}"


def try_file(name, data, folder):
    """Loads it as `photopic info` does; what that accepts is rendered, too."""
    folder.mkdir()
    scene = folder / ("scene.glb" if data[:4] == b"glTF" else "scene.gltf")
    scene.write_bytes(data)
    outcome = Outcome(["info", scene, "--threads", "1"])
    faults = list(outcome.faults())
    if outcome.code == 0:
        image = folder / "image.exr"
        options = ["--sampler", "uniform", "--spp", "1", "--resolution", "8x8", "--threads", "1", "--quiet", "-o", image]
        rendered = Outcome(["render", scene, *options])
        faults += [f"rendering: {fault}" for fault in rendered.faults()]
        if "not finite" in rendered.stderr and "samples" in rendered.stderr:
            faults.append("rendering: samples that are not finite")
    for path in folder.iterdir():
        path.unlink()
    folder.rmdir()
    return outcome.code, [f"{name}: {fault}" for fault in faults]


def try_all(mutations):
    """@return (files tried, refused, faults)"""
    workers = os.cpu_count()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(workers) as pool:
        jobs = [pool.submit(try_file, name, data, pathlib.Path(folder, str(i))) for i, (name, data) in enumerate(mutations)]
        results = [job.result() for job in jobs]
    faults = [fault for _, found in results for fault in found]
    return len(results), sum(code == 1 for code, _ in results), faults


class Malformed(unittest.TestCase):
    def assert_no_faults(self, mutations):
        tried, refused, faults = try_all(mutations)
        self.assertFalse(faults, "\n".join(faults[:20]))
        return tried, refused

    def test_a_sample_of_all_mutations(self):
        document = json.loads(FIXTURE.read_text())
        mutations = list(all_mutations(document))
        sample = mutations[:: len(mutations) // 100]
        tried, refused = self.assert_no_faults(sample)
        self.assertGreater(refused, tried // 3)

    def test_what_is_no_regular_file(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "scene.gltf").mkdir()
            (folder / "empty").mkdir()
            (folder / "empty" / "scene.glb").write_bytes(b"")
            (folder / "loop_scene.gltf").symlink_to("loop_scene.gltf")
            (folder / "dangling_scene.gltf").symlink_to("nowhere")
            os.mkfifo(folder / "pipe_scene.gltf")
            for path in ["scene.gltf", "empty/scene.glb", "loop_scene.gltf", "dangling_scene.gltf", "pipe_scene.gltf", "no_scene.gltf"]:
                outcome = Outcome(["info", folder / path])
                self.assertEqual(outcome.code, 1, path)
                self.assertEqual(list(outcome.faults()), [], path)

    def test_large_files_load_in_time(self):
        """100,000 of everything: nothing may be quadratic."""
        document, count = tiny_scene(), 100_000
        document["materials"] += [{"name": f"m{i}"} for i in range(count)]
        document["accessors"] += [document["accessors"][0]] * count
        document["meshes"] += [{"primitives": [{"attributes": {"POSITION": 0}, "material": 1}]}] * count
        first = len(document["nodes"])
        document["nodes"] += [{"mesh": i % 2, "name": f"n{i}"} for i in range(count)]
        document["scenes"][0]["nodes"] += list(range(first, first + count // 10))
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "scene.gltf")
            scene.write_bytes(encode(document))
            outcome = Outcome(["info", scene])
        self.assertEqual(outcome.code, 0, outcome.stderr)
        self.assertLess(outcome.seconds, 40)  # about 2 s; quadratic would be minutes

    @unittest.skipUnless(SHARED.is_dir(), "no collection of glTF files")
    def test_the_collection(self):
        for path in sorted([*SHARED.glob("good/**/*.gl*"), *SHARED.glob("bad/*")]):
            outcome = Outcome(["info", path])
            good = path.parent.name != "bad" or path.stem in ODD_BUT_VALID
            with self.subTest(path.name):
                if path.stem not in EITHER:
                    self.assertEqual(outcome.code, 0 if good else 1, outcome.stderr)
                self.assertLess(outcome.seconds, SECONDS)
                self.assertLess(outcome.megabytes, MEGABYTES)
                if outcome.code == 1:
                    self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome.stderr)
                    self.assertIn(path.name, outcome.stderr)


class FilesBeside(CommandTest):
    """Buffers and images in files of their own that cannot be read: the line names the place, the file and what it is."""

    def setUp(self):
        super().setUp()
        document = tiny_scene()
        self.whole = base64.b64decode(document["buffers"][0]["uri"].split(",")[1])
        document["buffers"][0]["uri"] = "the%20corners.bin"
        document["images"], document["textures"] = [{"uri": "paint.png"}], [{"source": 0}]
        document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
        self.buffer, self.image = self.folder / "the corners.bin", self.folder / "paint.png"
        self.scene.write_text(json.dumps(document))
        self.buffer.write_bytes(self.whole)

    def assert_told(self, place, file, what):
        self.assert_refused(["info", "tiny.gltf"], f'photopic: tiny.gltf#{place}/uri: "{file.name}": {what}; ')

    def test_missing(self):
        self.assert_told("/images/0", self.image, "there is no such file")
        self.buffer.unlink()
        self.assert_told("/buffers/0", self.buffer, "there is no such file")

    def test_folders_and_pipes(self):
        self.image.mkdir()
        self.assert_told("/images/0", self.image, "is a folder")
        self.buffer.unlink()
        os.mkfifo(self.buffer)
        self.assert_told("/buffers/0", self.buffer, "is a pipe or device, not a file")

    @unittest.skipIf(os.geteuid() == 0, "root may read everything")
    def test_protected(self):
        self.image.touch(0o200)
        self.assert_told("/images/0", self.image, "may not be read")
        self.buffer.chmod(0o200)
        self.assert_told("/buffers/0", self.buffer, "may not be read")

    def test_cut_short(self):
        self.image.write_bytes(b"\x89PNG\r\n\x1a\n")
        self.assert_told("/images/0", self.image, "the PNG is cut short")
        self.image.write_bytes(b"")
        self.assert_told("/images/0", self.image, "the file holds 0 bytes where 1 are needed")
        self.buffer.write_bytes(self.whole[:-1])
        what = f"the file holds {len(self.whole) - 1} bytes where {len(self.whole)} are needed"
        self.assert_told("/buffers/0", self.buffer, what)


def document_of(path):
    """A valid file as JSON with its buffers inside."""
    data = path.read_bytes()
    binary = b""
    if data[:4] == b"glTF":
        size = struct.unpack_from("<I", data, 12)[0]
        data, binary = data[20 : 20 + size], data[28 + size :]
    document = json.loads(data)
    for buffer in document["buffers"]:
        if not buffer.get("uri", "").startswith("data:"):
            held = (path.parent / buffer["uri"]).read_bytes() if "uri" in buffer else binary
            buffer["uri"] = "data:;base64," + base64.b64encode(held).decode()
    return document


def main(mode, names):
    """--all: tries every mutation of the files. --write FOLDER: leaves them there, for build/*/tests/fuzz/gltf_replay."""
    folder = pathlib.Path(names.pop(0)) if mode == "--write" else None
    bad = 0
    for path in map(pathlib.Path, names or [FIXTURE]):
        mutations = all_mutations(document_of(path))
        if folder:
            for i, (_, data) in enumerate(mutations):
                (folder / f"{path.stem}-{i:05d}").write_bytes(data)
            continue
        tried, refused, faults = try_all(mutations)
        print(f"{path}: {tried} files, {refused} refused, {len(faults)} faults", *faults, sep="\n  ", flush=True)
        bad += len(faults)
    return bad > 0


if __name__ == "__main__":
    if sys.argv[1:2] in (["--all"], ["--write"]):
        sys.exit(main(sys.argv[1], sys.argv[2:]))
    unittest.main()
