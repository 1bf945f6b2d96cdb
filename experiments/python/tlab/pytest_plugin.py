"""A plug-in of pytest that collects experiment files with checks. Each check is a test.

    # conftest.py
    pytest_plugins = ["tlab.pytest_plugin"]
"""

import pathlib
import tempfile
import tomllib
import xml.etree.ElementTree

import pytest

from tlab import command
from tlab.errors import CheckFailed, Error


def pytest_collect_file(file_path, parent):
    if file_path.suffix == ".toml" and _count_checks(file_path) > 0:
        return ExperimentFile.from_parent(parent, path=file_path)
    return None


# The number of tables [[check]] in a file; 0 if the file is not TOML.
def _count_checks(path):
    try:
        checks = tomllib.loads(path.read_text(encoding="utf-8")).get("check")
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError):
        return 0
    return len(checks) if isinstance(checks, list) else 0


class ExperimentFile(pytest.File):
    """An experiment, which runs once, before the first of its checks."""

    _cases = None

    def collect(self):
        checks = tomllib.loads(self.path.read_text(encoding="utf-8"))["check"]
        for number, check in enumerate(checks):
            yield Check.from_parent(self, name=str(check.get("name", number + 1)), number=number)

    def find_case(self, number):
        """The element <testcase> of a check. Raises an Error with tlab's message if the experiment did not run."""
        if self._cases is None:
            with tempfile.TemporaryDirectory(prefix="tlab-") as folder:
                junit = pathlib.Path(folder) / "junit.xml"
                self._done = command.start(["verify", self.path, "-o", f"{folder}/results", "--junit", junit])
                root = xml.etree.ElementTree.parse(junit).getroot() if junit.is_file() else ()
                self._cases = [case for suite in root for case in suite]
        if number >= len(self._cases) or self._cases[number].find("error") is not None:
            raise self._done.failure() or Error("tlab wrote no outcome of this check")
        return self._cases[number]


class Check(pytest.Item):
    """One check of an experiment. number: its position in the file, from 0."""

    def __init__(self, *, number, **others):
        super().__init__(**others)
        self.number = number

    def runtest(self):
        case = self.parent.find_case(self.number)
        skipped, failed = case.find("skipped"), case.find("failure")
        if skipped is not None:
            pytest.skip(skipped.get("message"))
        if failed is not None:
            raise CheckFailed(f"{failed.get('message')}\n{failed.text}")

    def repr_failure(self, excinfo, style=None):
        if isinstance(excinfo.value, Error):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self):
        return self.path, None, f"check: {self.name}"
