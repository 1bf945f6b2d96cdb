"""What a run of an experiment leaves, as Python has it."""

import functools
import json
import pathlib
import re
import tomllib

import pandas

from tlab.pictures import read_image


# Numbers as tlab writes them. Labels of processors may look nearly so: 007, 1_2.
WHOLE = re.compile(r"-?(0|[1-9][0-9]*)")
NUMBER = re.compile(r"-?(0|[1-9][0-9]*)(\.[0-9]+)?(e[-+]?[0-9]+)?")
FLAGS = {"0": False, "1": True, "false": False, "true": True}

# What cells of a type of results.schema.json look like, what they are, and their column's dtype: where each row has a
# value, and where some have none.
TYPES = {"boolean": (FLAGS.__contains__, FLAGS.get, "bool", "boolean"),
         "integer": (WHOLE.fullmatch, int, "int64", "Int64"),
         "number": (NUMBER.fullmatch, float, "float64", "float64"),
         "string": (lambda text: True, str, object, object)}


def _type_of(texts, declared):
    """The declared type where all cells are of it, else that of their spelling; a number where there are none."""
    for name in (declared, "integer" if len(texts) else "number", "number"):
        if name in TYPES and all(map(TYPES[name][0], texts)):
            return name
    return "string"


def _give_type(texts, declared):
    """A column of texts as one of what they say; an empty cell is NaN or <NA> among numbers, None among texts."""
    given = texts[texts != ""]
    _, value_of, dtype, dtype_with_gaps = TYPES[_type_of(given, declared)]
    values = [value_of(text) if text else None for text in texts]
    dtype = dtype if len(given) == len(texts) else dtype_with_gaps
    return pandas.Series(values, index=texts.index, dtype=dtype, name=texts.name)


class Result:
    """The results of an experiment in their folder.

    table: results.csv, a row for each point, as a pandas.DataFrame. Networks of from_networkx() that run()
        was given have their names there
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
        self.table = self._read("results")

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

    @functools.cached_property
    def columns(self):
        """What each column of the table is: a DataFrame with its type, unit and meaning; "" where one has none."""
        path = self.folder / "results.schema.json"
        fields = json.loads(path.read_text(encoding="utf-8"))["fields"] if path.exists() else []
        about = {field["name"]: [field.get(key, "") for key in ("type", "unit", "description")] for field in fields}
        columns = self._read_texts("results").columns
        return pandas.DataFrame([about.get(name, ["", "", ""]) for name in columns],
                                columns=["type", "unit", "meaning"], index=pandas.Index(columns, name="column"))

    @property
    def programs(self):
        """The names of the programs that were run."""
        if "program" in self.table:
            return list(self.table["program"].unique())
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

    def _read_texts(self, name):
        return pandas.read_csv(self.folder / f"{name}.csv", dtype=str, keep_default_na=False)

    def _read(self, name):
        texts, types = self._read_texts(name), self.columns["type"]
        columns = [_give_type(texts[column], types.get(column)) for column in texts]
        table = pandas.concat([pandas.DataFrame(index=texts.index), *columns], axis=1)
        if "topology" in table and self._files:
            table["topology"] = table["topology"].replace(self._files.names)
        return table
