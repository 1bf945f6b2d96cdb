"""Writes Python values as TOML."""

import json
import math
import operator
import pathlib
import re

import numpy

from tlab.errors import BadInput


def plain(value):
    """Converts numpy values to values of Python, and a pathlib.Path to the text of its absolute path."""
    if isinstance(value, numpy.generic):
        return value.item()
    if isinstance(value, numpy.ndarray):
        return value.tolist()
    if isinstance(value, pathlib.PurePath):
        return str(pathlib.Path(value).absolute())
    if isinstance(value, (bytes, bytearray)):
        raise BadInput(f"found {value!r}, expected a text")
    if hasattr(value, "add_edge"):
        raise BadInput("found a graph, expected a topology: tlab.from_networkx(graph)")
    return value


def whole(value, name):
    """Converts a number of an integer type to int; errors name `name`."""
    try:
        if not isinstance(value, bool):
            return operator.index(value)
        raise TypeError
    except TypeError:
        raise BadInput(f"{name}: found {value!r}, expected a whole number") from None


def spell_key(key):
    """A table's key, in quotes if it needs them."""
    if not isinstance(key, str):
        raise BadInput(f"found the key {key!r}, expected a text")
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key, ensure_ascii=False)


def spell(value, key="a value"):
    """A value on one line; errors name `key`."""
    value = plain(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and not math.isfinite(value):
        return {math.inf: "inf", -math.inf: "-inf"}.get(value, "nan")
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(value, dict):
        return "{" + ", ".join(f"{spell_key(k)} = {spell(v, f'{key}.{k}')}" for k, v in value.items()) + "}"
    try:
        return "[" + ", ".join(spell(item, key) for item in value) + "]"
    except TypeError:
        raise BadInput(f"{key}: found {value!r}, expected a number, a text, true or false, a list or a dict") from None


def spell_file(tables):
    """A whole file. Each table of `tables` becomes a section with one key per line."""
    plain_keys = "".join(f"{spell_key(k)} = {spell(v, k)}\n" for k, v in tables.items() if not isinstance(v, dict))
    sections = (f"\n[{spell_key(name)}]\n" + "".join(f"{spell_key(k)} = {spell(v, f'{name}.{k}')}\n"
                                                     for k, v in table.items())
                for name, table in tables.items() if isinstance(table, dict))
    return plain_keys + "".join(sections)


def flatten(settings):
    """Flattens nested tables to pairs of a dotted key and its value."""
    for key, value in settings.items():
        if isinstance(value, dict):
            yield from ((f"{key}.{inner}", v) for inner, v in flatten(value))
        else:
            yield key, value
