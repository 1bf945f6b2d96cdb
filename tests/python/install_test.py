"""Tests the install component `python`: the installed package must work, and must start the command
of its own installation."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import tlab.command

BUILD = pathlib.Path(tlab.command.__file__).parents[2]
CODE = ("import tlab; print(tlab.command.find()); print(tlab.__version__); "
        "print(tlab.programs.message(bytes=1)['latency_s'].round(9).tolist())")


@unittest.skipUnless((BUILD / "CMakeCache.txt").exists(), "this is no build tree")
class InstallTest(unittest.TestCase):
    def test_the_component_alone_beside_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            prefix = pathlib.Path(folder)
            subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--prefix", prefix], check=True,
                           stdout=subprocess.DEVNULL)
            (prefix / "bin").mkdir()
            shutil.copy(BUILD / "tlab", prefix / "bin/tlab")
            package = prefix / "lib/python3/dist-packages"
            environment = {**os.environ, "PYTHONPATH": str(package), "PYTHONDONTWRITEBYTECODE": "1"}
            environment.pop("TLAB", None)
            done = subprocess.run([sys.executable, "-c", CODE], capture_output=True, text=True, env=environment,
                                  cwd=prefix, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            command, version, result = done.stdout.splitlines()
            self.assertEqual(pathlib.Path(command).resolve(), (prefix / "bin/tlab").resolve())
            self.assertRegex(version, r"^\d+\.\d+\.\d+$")
            self.assertEqual(result, "[1.682e-06]")
            self.assertEqual(sorted(path.name for path in (prefix / "share/tlab/notebooks").iterdir()),
                             ["history.ipynb", "lecture.ipynb", "study.ipynb"])
            files = [path for path in prefix.rglob("*") if path.is_file()]
            self.assertFalse([path for path in files if path.is_symlink()])
            for path in files:  # no installed file may contain a path of the build tree
                self.assertNotIn(str(BUILD).encode(), path.read_bytes() if path.name != "tlab" else b"", path.name)


if __name__ == "__main__":
    unittest.main()
