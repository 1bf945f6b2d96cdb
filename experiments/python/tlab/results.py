"""The results of an experiment as pandas tables and numpy arrays."""

import functools
import json
import pathlib
import re
import tomllib

import pandas

from tlab.pictures import read_image


# Integers in the way that tlab writes them. Labels of processors, such as 007 or 1_2, do not match.
WHOLE = re.compile(r"-?(0|[1-9][0-9]*)")
NUMBER = re.compile(r"-?(0|[1-9][0-9]*)(\.[0-9]+)?(e[-+]?[0-9]+)?")
FLAGS = {"0": False, "1": True, "false": False, "true": True}

# For each type in results.schema.json: a test whether a text has the type, the conversion of a text,
# and the dtypes of a column without and with missing values.
TYPES = {"boolean": (FLAGS.__contains__, FLAGS.get, "bool", "boolean"),
         "integer": (WHOLE.fullmatch, int, "int64", "Int64"),
         "number": (NUMBER.fullmatch, float, "float64", "float64"),
         "string": (lambda text: True, str, object, object)}


def _type_of(texts, declared):
    """The declared type if it fits all cells, else the type that their texts have; "number" without cells."""
    for name in (declared, "integer" if len(texts) else "number", "number"):
        if name in TYPES and all(map(TYPES[name][0], texts)):
            return name
    return "string"


def _give_type(texts, declared):
    """Converts a column of texts to its type; an empty cell becomes NaN or <NA> among numbers, None among texts."""
    given = texts[texts != ""]
    _, value_of, dtype, dtype_with_gaps = TYPES[_type_of(given, declared)]
    values = [value_of(text) if text else None for text in texts]
    dtype = dtype if len(given) == len(texts) else dtype_with_gaps
    return pandas.Series(values, index=texts.index, dtype=dtype, name=texts.name)


class Result:
    """The results of an experiment in their folder.

    table: results.csv, a row for each point, as a pandas.DataFrame. Networks of from_networkx() passed to run()
        appear by name
    checks: the outcomes of the experiment's checks as a pandas.DataFrame; no rows without checks
    record: run.json: settings, models, loads of processors and links
    images: the pictures of the points by name, as arrays (height, width, 3)
    output: the standard output of the command
    folder: the folder with all of this. A temporary folder lasts as long as this object.
    """

    def __init__(self, folder, output="", files=None):
        self.folder = pathlib.Path(folder)
        self.output = output
        self._files = files  # keeps the temporary folder until this object is deleted
        self.record = json.loads((self.folder / "run.json").read_text(encoding="utf-8"))
        self.table = self._read("results")

    @functools.cached_property
    def checks(self):
        """The outcome of each check at each point."""
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
        """A DataFrame with the type, unit and meaning of each column of the table; "" for a missing entry."""
        path = self.folder / "results.schema.json"
        fields = json.loads(path.read_text(encoding="utf-8"))["fields"] if path.exists() else []
        about = {field["name"]: [field.get(key, "") for key in ("type", "unit", "description")] for field in fields}
        columns = self._read_texts("results").columns
        return pandas.DataFrame([about.get(name, ["", "", ""]) for name in columns],
                                columns=["type", "unit", "meaning"], index=pandas.Index(columns, name="column"))

    @property
    def programs(self):
        """The names of the programs in this run."""
        if "program" in self.table:
            return list(self.table["program"].unique())
        return [tomllib.loads(self.record["experiment"]).get("program", {}).get("name", "farm")]

    @property
    def row(self):
        """The only row of the table. Raises ValueError unless there is exactly one."""
        if len(self.table) != 1:
            raise ValueError(f"found {len(self.table)} rows, expected one")
        return self.table.iloc[0]

    @property
    def complete(self):
        """True if every point ran to its end."""
        return bool(self.record["complete"])

    @property
    def ended(self):
        """A sentence on how the run ended."""
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
