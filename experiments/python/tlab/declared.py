"""What tlab's programs declare of themselves: parameters, ranges, columns."""

import functools
import re

import pandas

from tlab import _native

# What the end of a column's name says of its unit.
UNITS = {"s": "s", "ms": "ms", "us": "us", "bytes": "bytes", "Bps": "bytes/s", "per_s": "1/s", "cycles": "cycles"}


@functools.cache
def programs():
    """What each program declares, by its name."""
    return {program["name"]: program for program in _native.programs()}


def flags_of(names):
    """The parameters of programs of these names that are true or false."""
    parameters = [parameter for name in names if name in programs() for parameter in programs()[name]["parameters"]]
    return {parameter["name"] for parameter in parameters if parameter["kind"] == "flag"}


def unit_of(column):
    """The unit that the end of a column's name says; "" for a count, a share or a ratio."""
    found = re.search(r"_(per_s|ms|us|s|bytes|Bps|cycles)$", column)
    return UNITS[found[1]] if found else ""


# Columns that every program may have.
COMMON = {"topology": ("", "what the network was made of"), "workers": ("", "processors that work"),
          "processors": ("", "processors of the network"), "program": ("", "the program"),
          "ended": ("", "done, or why the point was cut short")}


@functools.cache
def _about(names):
    """Units and meanings of the columns of some programs; {} in a column's name is a number."""
    about = dict(COMMON)
    for program in map(programs().get, names):
        for parameter in program["parameters"]:
            about.setdefault(parameter["name"], (parameter["unit"], parameter["help"]))
        for name, meaning in program["columns"]:
            about.setdefault(name, (unit_of(name), meaning))
    return about


def describe_columns(columns, names):
    """A DataFrame of the unit and the meaning of each column of the programs of these names.

    Both are "" where nothing is known, as of entries of the machine model.
    """
    about = _about(tuple(names))

    def find(name):
        return about.get(name) or about.get(re.sub(r"\d+", "{}", name, count=1)) or (unit_of(name), "")

    found = [find(name) for name in columns]
    return pandas.DataFrame({"unit": [unit for unit, _ in found], "meaning": [meaning for _, meaning in found]},
                            index=pandas.Index(list(columns), name="column"))
