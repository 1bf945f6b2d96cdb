"""Functions of the package, one for each program. Their signatures must agree with the command's
help, and their results with the command's runs."""

import inspect
import keyword
import unittest

import pandas
from support import tlab_command

import tlab
from tlab import _native as native

# Programs whose defaults run quickly and need no file.
QUICK = ["message", "soft", "both_ways", "unicast", "pipeline", "sources", "broadcast", "request", "alternative",
         "interrupt", "commstime", "flops", "metrics", "census", "law", "task_farm", "global_", "in_path"]


def help_on(program):
    """Keys with their defaults, and columns, from `tlab help`."""
    text = tlab_command("help", program).stdout
    # commands and topics have the same names as some programs
    text = next(part for part in text.split("In an experiment file:\n") if "\nResults of " in part).rstrip()
    keys, columns = text.split("\nResults of ")
    found = {}
    for line in keys.strip().splitlines()[1:]:
        key, _, about = line.strip().partition(" ")
        found[key] = about.rpartition(" [")[2].removesuffix("]") if about.endswith("]") else None
    return found, [line.split()[0] for line in columns.strip().splitlines()[1:]]


class FunctionsTest(unittest.TestCase):
    def test_there_is_one_for_each_program(self):
        names = tlab_command("list", "programs", "--names").stdout.split()
        self.assertGreater(len(names), 25)
        self.assertEqual([f"{n}_" if keyword.iskeyword(n) else n for n in names], tlab.programs.__all__)

    def test_parameters_have_known_kinds(self):
        kinds = {p["key"]: p["kind"] for program in native.programs() for p in program["parameters"]}
        for key, kind in {"scene.source": "source", "program.reference": "file", "image.width": "whole",
                          "image.lens": "number", "image.feelers": "choice", "image.area": "list",
                          "farm.task": "text", "iirra.borders": "flag"}.items():
            self.assertEqual(kind, kinds[key], key)

    def test_signatures_are_what_help_says(self):
        for name in tlab.programs.__all__:
            with self.subTest(name):
                function = getattr(tlab.programs, name)
                keys, columns = help_on(name.rstrip("_"))
                parameters = inspect.signature(function).parameters
                for key, default in keys.items():
                    short = key.rpartition(".")[2]
                    if key.split(".")[0] in ("order", "stage") or short in ("order", "stage") and default is None:
                        continue  # skips tables with one row for each stage or order
                    value = (parameters.get(short) or parameters[key.replace(".", "_")]).default
                    if default is not None:
                        self.assertEqual(*_comparable(value, default), key)
                for column in columns:
                    self.assertIn(f"    {column}: ", function.__doc__)

    def test_defaults_of_files_are_their_names_or_none(self):
        defaults = {p["key"]: p["default"] for program in native.programs() for p in program["parameters"]
                    if program["name"] in ("farm", "traffic")}
        self.assertEqual(defaults["scene.source"], "spheres")
        self.assertIsNone(defaults["program.pattern_file"])

    def test_quick_programs_give_their_columns(self):
        for name in QUICK:
            with self.subTest(name):
                result = getattr(tlab.programs, name)()
                _, columns = help_on(name.rstrip("_"))
                missing = set(columns) - set(result.table.columns)
                self.assertFalse([c for c in missing if "{}" not in c])
                self.assertEqual(result.programs, [name.rstrip("_")])
                self.assertTrue(result.complete)
                known = result.columns["meaning"] != ""
                self.assertTrue(known.all(), list(known[~known].index))


def _comparable(value, text):
    """Converts a default, and the spelling of a default in the help, to values that can be
    compared: truth values, numbers, lists of numbers, or texts."""
    if text in ("true", "false"):
        return bool(value), text == "true"
    if isinstance(value, (int, float)):
        return value, float(text)
    if isinstance(value, list):
        return value, [float(item) for item in text.split(", ") if item]
    return str(value or "none"), text or "none"


class RunsTest(unittest.TestCase):
    def test_a_function_is_the_experiment_of_its_arguments(self):
        result = tlab.programs.message(bytes=50, switches=2)
        same = tlab.run({"program": {"name": "message", "bytes": 50, "switches": 2}})
        pandas.testing.assert_frame_equal(result.table, same.table)

    def test_lists_are_axes_in_the_order_of_the_call(self):
        table = tlab.programs.unicast(topology=["line", "ring"], workers=range(4, 6), bytes=[1, 80]).table
        self.assertEqual(list(table.columns[:3]), ["topology", "processors", "bytes"])
        self.assertEqual(list(zip(table["topology"], table["processors"], table["bytes"])),
                         [(t, p, b) for t in ("line", "ring") for p in (4, 5) for b in (1, 80)])
        other = tlab.programs.unicast(bytes=[1, 80], workers=[4, 5], topology="line").table
        self.assertEqual(list(other["bytes"]), [1, 1, 80, 80])

    def test_the_farm_has_its_keys_from_all_sections(self):
        result = tlab.programs.farm(workers=[1, 2], objects=20, width=8, height=8, weights=[1, 0, 0], model="t800-20")
        self.assertEqual(result.record["models"][0]["name"], "t800-20")
        same = tlab.run({"machine": {"model": "t800-20"}, "scene": {"objects": 20}, "image": {"width": 8, "height": 8},
                         "farm": {"weights": [1, 0, 0]}, "sweep": {"workers": [1, 2]}})
        pandas.testing.assert_frame_equal(result.table, same.table)
        weights = tlab.programs.farm(workers=1, objects=20, width=8, height=8, weights=[[1, 0, 0], [0, 0, 1]])
        self.assertEqual(len(weights), 2)

    def test_other_keys_and_networks(self):
        import networkx

        square = tlab.from_networkx(networkx.cycle_graph(4), "square")
        table = tlab.programs.metrics(topology=[square, "ring:4"]).table
        self.assertEqual(list(table["topology"]), ["square", "ring:4"])
        slow = tlab.programs.message(bytes=1000, **{"model.link.one_way_rate": 1e5}).row
        self.assertGreater(slow["latency_s"], 1000 / 1e5)
        with self.assertRaisesRegex(tlab.BadInput, 'unknown key "byts"'):
            tlab.programs.message(byts=3)


if __name__ == "__main__":
    unittest.main()
