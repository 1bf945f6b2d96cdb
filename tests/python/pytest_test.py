"""The plug-in of pytest: each check of an experiment file is a test."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

EXPERIMENT = """
[program]
name = "message"
[sweep]
bytes = [1, 10]
[[check]]
name = "quick"
of = "latency_s"
at_most = 1
[[check]]
name = "too strict"
of = "latency_s"
at_most = 1e-9
"""


class PytestTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "conftest.py").write_text('pytest_plugins = ["tlab.pytest_plugin"]\n', encoding="utf-8")

    def collect(self, **files):
        """Runs pytest in a folder with these TOML files. Returns its exit code and output."""
        for name, text in files.items():
            (self.folder / f"{name}.toml").write_text(text, encoding="utf-8")
        path = os.pathsep.join(filter(None, (str(pathlib.Path(sys.path[0])), os.environ.get("PYTHONPATH"))))
        done = subprocess.run([sys.executable, "-m", "pytest", "-v", "-p", "no:cacheprovider", "--color=no"],
                              cwd=self.folder, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True,
                              check=False)
        return done.returncode, done.stdout + done.stderr

    def test_each_check_is_a_test(self):
        code, output = self.collect(latency=EXPERIMENT)
        self.assertEqual(code, 1, output)
        self.assertIn("latency.toml::quick PASSED", output)
        self.assertIn("latency.toml::too strict FAILED", output)
        self.assertIn("FAILED   too strict: latency_s at 2 point(s)", output)  # only the message, without a traceback
        self.assertNotIn("pytest_plugin.py", output)
        self.assertIn("1 failed, 1 passed", output)
        self.assertEqual({path.name for path in self.folder.iterdir()} - {"__pycache__"},
                         {"conftest.py", "latency.toml"})  # the results are in a temporary folder

    def test_an_experiment_that_does_not_run_fails_with_the_message(self):
        code, output = self.collect(wrong=EXPERIMENT.replace("bytes = [", "byts = ["))
        self.assertEqual(code, 1, output)
        self.assertIn('unknown axis "byts" in [sweep]', output)
        self.assertIn("2 failed", output)

    def test_other_files_are_not_collected(self):
        code, output = self.collect(pyproject='[project]\nname = "x"\n', broken="=", quick="check = 3\n",
                                    experiment=EXPERIMENT.partition("[[check]]")[0])
        self.assertEqual(code, 5, output)  # pytest's exit code if it collects no tests


if __name__ == "__main__":
    unittest.main()
