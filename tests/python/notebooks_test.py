"""Notebooks: they run without errors and are stored without outputs. Outputs remain in the build tree."""

import base64
import os
import pathlib
import sys
import tempfile
import time
import unittest

import nbclient
import nbformat
from support import ROOT

import tlab.command

NOTEBOOKS = ROOT / "experiments/notebooks"
# folder for executed notebooks, in the build tree beside the package
SHOWN = pathlib.Path(tlab.command.__file__).parents[1] / "notebooks"


class NotebooksTest(unittest.TestCase):
    def setUp(self):
        # lets the notebook's kernel find the package
        os.environ["PYTHONPATH"] = os.pathsep.join(sys.path)
        os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"

    def run_notebook(self, name):
        book = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
        for cell in book.cells:
            self.assertFalse(cell.get("outputs"), f"{name} is kept with outputs")
            self.assertIsNone(cell.get("execution_count"))
        begun = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            client = nbclient.NotebookClient(book, timeout=600, kernel_name="python3",
                                             resources={"metadata": {"path": folder}})
            client.execute()
        print(f"{name}: {time.monotonic() - begun:.1f} s", flush=True)
        return self.keep(book, name)

    def keep(self, book, name):
        """Writes the notebook with its outputs, and each of its pictures; returns the printed text."""
        SHOWN.mkdir(parents=True, exist_ok=True)
        nbformat.write(book, SHOWN / f"{name}.ipynb")
        pictures, text = [], ""
        for output in (output for cell in book.cells for output in cell.get("outputs", [])):
            if output.output_type == "stream":
                # warnings would be shown to readers of the notebook
                self.assertEqual(output.name, "stdout", output.text)
                text += output.text
            elif "image/png" in output.get("data", {}):
                pictures.append(base64.b64decode(output.data["image/png"]))
        for number, picture in enumerate(pictures):
            (SHOWN / f"{name}-{number}.png").write_bytes(picture)
        return len(pictures), text

    def test_lecture(self):
        pictures, text = self.run_notebook("lecture")
        self.assertEqual(pictures, 3)
        self.assertIn("of the law.", text)
        self.assertIn("it grows: it is overhead", text)

    def test_study(self):
        pictures, text = self.run_notebook("study")
        self.assertEqual(pictures, 2)
        self.assertRegex(text, r"Rays: speed-up 6\.\d to 6\.\d, on any network")
        self.assertRegex(text, r"the fastest with each size: 40: \w+, 48: \w+, ")

    def test_history(self):
        pictures, text = self.run_notebook("history")
        self.assertEqual(pictures, 4)
        self.assertRegex(text, r"19 predicted times: 2\.\d% off on average, at worst [+-]4\.\d%")


if __name__ == "__main__":
    unittest.main()
