"""The manual's page on the package: its examples run and print the output shown."""

import doctest
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from support import ROOT

import tlab.command

PAGE = ROOT / "docs/manual/python.md"
BUILD = pathlib.Path(tlab.command.__file__).parents[2]


class ManualTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        # makes the folder look like a clone of the repository, which no command may change
        (self.folder / "experiments").symlink_to(ROOT / "experiments")
        (self.folder / "build").mkdir()
        (self.folder / "build/release").symlink_to(BUILD)
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder)

    def test_examples_print_what_the_page_shows(self):
        blocks = re.findall(r"^```pycon\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 5)
        page = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, PAGE.name, str(PAGE), 0)
        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
        self.assertEqual(runner.run(page).failed, 0)

    def test_commands_do_what_the_page_says(self):
        commands = re.findall(r"^    (PYTHONPATH=.*)$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual(len(commands), 1)
        command = commands[0].replace(" python3 ", f" {sys.executable} ")
        done = subprocess.run(command, shell=True, capture_output=True, text=True, check=True, env=os.environ)
        self.assertEqual(done.stdout, "<tlab.Topology ring:8: 8 processors, 8 links>\n")

    def test_names_on_the_page_exist(self):
        text = PAGE.read_text(encoding="utf-8")
        for name in set(re.findall(r"`tlab\.(\w+)", text)):
            self.assertTrue(hasattr(tlab, name), name)
        for name in re.findall(r"^\| `([a-z]+)(?:\(name\))?`(?:, `(\w+)`)? \|", text, re.MULTILINE):
            for attribute in filter(None, name):
                self.assertTrue(hasattr(tlab.Result, attribute) or attribute in
                                ("table", "record", "output", "folder"), attribute)
        for notebook in re.findall(r"`(\w+\.ipynb)`", text):
            self.assertTrue((ROOT / "experiments/notebooks" / notebook).is_file())


if __name__ == "__main__":
    unittest.main()
