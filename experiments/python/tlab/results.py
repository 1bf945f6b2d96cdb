"""What a run of an experiment leaves, as Python has it."""

import functools
import json
import pathlib
import re
import tomllib

import pandas

from tlab import declared
from tlab.pictures import read_image


# Numbers as tlab writes them. Labels of processors may look nearly so: 007, 1_2.
WHOLE = re.compile(r"-?(0|[1-9][0-9]*)")
NUMBER = re.compile(r"-?(0|[1-9][0-9]*)(\.[0-9]+)?(e[-+]?[0-9]+)?")


def _type_of(name, texts, floats, flags):
    """The dtype of a column by the spelling of its cells, and None where they are texts."""
    given = [text for text in texts if text != ""]
    has_gaps = len(given) < len(texts)
    if not given:
        return None
    if name in flags and set(given) <= {"0", "1", "false", "true"}:
        return "boolean" if has_gaps else "bool"
    if all(map(WHOLE.fullmatch, given)) and name not in floats:
        return "Int64" if has_gaps else "int64"
    return "float64" if all(map(NUMBER.fullmatch, given)) else None


def read_texts(path):
    """A CSV file of tlab as a DataFrame of texts."""
    return pandas.read_csv(path, dtype=str, keep_default_na=False)


def give_types(raw, floats=(), flags=()):
    """A table of texts as one of whole numbers, numbers, booleans and texts.

    An empty cell says that the column does not apply: NaN or <NA> among numbers, None among texts. In the columns
    `floats` whole numbers are numbers all the same, in the columns `flags` 0 and 1 are booleans.
    """
    table = pandas.DataFrame(index=raw.index)
    columns = {}
    for name in raw.columns:
        texts = raw[name]
        dtype = _type_of(name, list(texts), floats, flags)
        if dtype is None:
            columns[name] = texts.where(texts != "", None).astype(object)
        elif dtype in ("bool", "boolean"):
            columns[name] = texts.map({"0": False, "1": True, "false": False, "true": True}).astype(dtype)
        elif dtype == "float64":
            columns[name] = pandas.Series([float(t) if t else float("nan") for t in texts], index=raw.index)
        else:
            columns[name] = pandas.Series([int(t) if t else None for t in texts], index=raw.index, dtype=dtype)
    return pandas.concat([table, *(column.rename(name) for name, column in columns.items())], axis=1)


class Result:
    """The results of an experiment in their folder.

    table: results.csv, a row for each point, as a pandas.DataFrame. Networks of from_networkx() have their names there
    checks: what the experiment's checks came to, likewise; no rows where it has none
    record: run.json: settings, models, how busy everything was
    images: the pictures of the points by their names, as arrays (height, width, 3)
    output: what the command has printed
    folder: where all of this is. A temporary folder lasts as long as this object.
    """

    def __init__(self, folder, output="", files=None):
        self.folder = pathlib.Path(folder)
        self.output = output
        self._files = files  # which it needs: a temporary folder goes with them
        self.record = json.loads((self.folder / "run.json").read_text(encoding="utf-8"))
        self.table = self._read("results", self._floats())

    @functools.cached_property
    def checks(self):
        """What each check came to at each point."""
        if not (self.folder / "checks.csv").exists():
            return pandas.DataFrame(columns=["check", "simulated", "expected", "error", "kind"])
        return self._read("checks")

    @functools.cached_property
    def images(self):
        """Pictures by the names of their files, without "image-" and ".png"."""
        paths = sorted(self.folder.glob("image-*.png"))
        return {path.stem.removeprefix("image-"): read_image(path) for path in paths}

    @property
    def columns(self):
        """What each column of the table is: a DataFrame with its unit and its meaning, as far as they are known."""
        return declared.describe_columns(self.table.columns, self.programs)

    @property
    def programs(self):
        """The names of the programs that were run."""
        return self._programs_of(self.table)

    def _programs_of(self, table):
        if "program" in table:
            return list(table["program"].unique())
        return [tomllib.loads(self.record["experiment"]).get("program", {}).get("name", "farm")]

    @property
    def row(self):
        """The one row of the table. Raises ValueError where there are more."""
        if len(self.table) != 1:
            raise ValueError(f"found {len(self.table)} rows, expected one")
        return self.table.iloc[0]

    @property
    def complete(self):
        """Whether every point came to its end."""
        return bool(self.record["complete"])

    @property
    def ended(self):
        """A sentence that says how the run has ended."""
        return self.record["ended"]

    @property
    def report(self):
        """The path of report.html."""
        return self.folder / "report.html"

    def read(self, name):
        """Another table of the folder, such as "fits", "best" or "intervals"."""
        return self._read(name)

    def __getitem__(self, column):
        return self.table[column]

    def __len__(self):
        return len(self.table)

    def __repr__(self):
        return f"<tlab.Result: {self.ended}, {len(self.table)} rows, {len(self.table.columns)} columns>"

    def _repr_html_(self):
        return self.table._repr_html_()

    def _read(self, name, floats=()):
        raw = read_texts(self.folder / f"{name}.csv")
        table = give_types(raw, floats, declared.flags_of(self._programs_of(raw)))
        if "topology" in table and self._files:
            table["topology"] = table["topology"].replace(self._files.names)
        return table

    def _floats(self):
        """Columns that the points' records hold as numbers with a fraction, be it none; those without any value there."""
        whole, floats, seen = set(), set(), set()
        for point in self.record["points"]:
            path = self.folder / point["record"] if point.get("record") else None
            if path is None or not path.is_file():
                continue
            for row in json.loads(path.read_text(encoding="utf-8"))["rows"]:
                for name, cell in row.items():
                    seen.add(name)
                    if isinstance(cell, float):
                        floats.add(name)
                    elif cell is not None:
                        whole.add(name)
        return floats | (seen - whole)
