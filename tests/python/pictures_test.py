"""Pictures: the command's files are the oracle of render(), and matplotlib of read_image()."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import matplotlib.image
import numpy
from support import ROOT, tlab_command

import tlab

# Cases: a scene, a size, and the same options for Python and for the command.
CASES = [("spheres:200", (160, 120), {}, []), ("spheres:1", (1, 1), {}, []), ("hills:200", (31, 17), {}, []),
         ("room:2", (24, 40), {"depth": 3}, ["--depth", "3"]),
         ("spheres:30", (40, 30), {"min_influence": 0.2, "sample": "center", "feelers": "front", "ambient": 0.3},
          ["--influence", "0.2", "--sample", "center", "--feelers", "front", "--ambient", "0.3"]),
         ("spheres:30", (20, 30), {"traversal": "linear", "area": [5, 6, 7, 8]},
          ["--traversal", "linear", "--area", "5,6,7x8"]),
         (ROOT / "experiments/scenes/still-life.nff", (32, 24), {"pixel_samples": 9, "sample_seed": 4},
          ["--pixel-samples", "9", "--sample-seed", "4"]),
         (ROOT / "experiments/scenes/still-life.nff", (32, 24), {"pixel_samples": 64, "adaptive": 0.05},
          ["--pixel-samples", "64", "--adaptive", "0.05"])]


class PicturesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_picture_is_the_commands(self):
        for scene, size, options, words in CASES:
            with self.subTest(str(scene), size=size):
                path = self.folder / "picture.png"
                done = tlab_command("render", scene, "-o", path, "--size", "{}x{}".format(*size), *words)
                self.assertEqual(done.returncode, 0, done.stderr)
                picture = tlab.render(scene, size=size, **options)
                self.assertEqual((picture.shape, picture.dtype), ((size[1], size[0], 3), numpy.uint8))
                numpy.testing.assert_array_equal(picture, tlab.read_image(path))
                png = matplotlib.image.imread(path)
                numpy.testing.assert_array_equal(picture, numpy.rint(255 * png[..., :3]))

    def test_an_interrupt_ends_a_rendering_and_the_next_call_works(self):
        # A single row of pixels takes minutes. The signal comes from another process.
        code = ("import threading, time, tlab\n"
                "print('ready', flush=True)\n"
                "try: tlab.render('spheres:800', size=(4000, 3), pixel_samples=4096, threads=2)\n"
                "except KeyboardInterrupt: ended = time.monotonic()\n"
                "print(ended, threading.active_count(), tlab.render('spheres:9', size=(2, 2)).shape, flush=True)\n")
        child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True,
                                 env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
        self.addCleanup(child.kill)
        self.assertEqual(child.stdout.readline(), "ready\n")
        time.sleep(0.5)
        threads = pathlib.Path(f"/proc/{child.pid}/task")
        self.assertGreaterEqual(len(list(threads.iterdir())), 3)
        asked = time.monotonic()
        child.send_signal(signal.SIGINT)
        output, _ = child.communicate(timeout=60)
        ended, rest = output.split(" ", 1)
        self.assertLess(float(ended) - asked, 1)
        self.assertEqual(rest, "1 (2, 2, 3)\n")

    def test_sums_of_light_round_to_the_picture(self):
        light = tlab.render("spheres:200", size=(50, 40), linear=True)
        self.assertEqual(light.dtype, numpy.float64)
        rounded = numpy.floor(255 * numpy.clip(light, 0, 1) + 0.5)
        numpy.testing.assert_array_equal(rounded, tlab.render("spheres:200", size=(50, 40)))

    def test_threads_change_nothing(self):
        pictures = [tlab.render("spheres:50", size=(33, 21), threads=threads) for threads in (1, 2, 5)]
        for picture in pictures[1:]:
            numpy.testing.assert_array_equal(picture, pictures[0])

    def test_every_declared_default_changes_nothing(self):
        plain = tlab.render("spheres:20", size=(20, 20))
        for name, option in tlab.render_options().items():
            default = option["default"]
            if default is None:
                continue
            with self.subTest(name):
                numpy.testing.assert_array_equal(tlab.render("spheres:20", size=(20, 20), **{name: default}), plain)

    def test_refusals(self):
        for arguments, message in [
                ({"scene": "sphere:3"}, "sphere:3"), ({"scene": "spheres:3", "dpth": 3}, 'the nearest is "depth"'),
                ({"scene": "spheres:3", "depth": 0}, "found 0, expected a whole number from 1 to 1000"),
                ({"scene": "spheres:3", "depth": "deep"}, "found 'deep'"),
                ({"scene": "spheres:3", "sample": "middle"}, "expected one of center, corner, lattice"),
                ({"scene": "spheres:3", "depth": {}}, "found {}, expected a number"),
                ({"scene": "spheres:3", "size": (0, 5)}, "1 to 65536"),
                ({"scene": "spheres:3", "size": 4}, "size: found 4, expected"),
                ({"scene": "spheres:3", "width": 4}, "width: expected it in size"),
                ({"scene": "spheres:3", "threads": 2.5}, "threads: found 2.5, expected a whole number"),
                ({"scene": "spheres:3", "size": (4.5, 5)}, "width: found 4.5, expected a whole number"),
                ({"scene": "spheres:3", "threads": 0}, "threads"),
                ({"scene": self.folder / "none.nff"}, "none.nff: cannot be read")]:
            with self.subTest(message), self.assertRaisesRegex(tlab.BadInput, message):
                tlab.render(**arguments)
        with self.assertRaisesRegex(tlab.BadInput, "none.png: cannot be read"):
            tlab.read_image(self.folder / "none.png")

    def test_pictures_of_any_kind_are_read(self):
        source = numpy.random.default_rng(1).integers(0, 256, (9, 7, 3), dtype=numpy.uint8)
        matplotlib.image.imsave(self.folder / "colours.png", source)
        numpy.testing.assert_array_equal(tlab.read_image(self.folder / "colours.png"), source)


if __name__ == "__main__":
    unittest.main()
