"""tlab.run: the command is the oracle of results and of messages."""

import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
import unittest
import unittest.mock

import matplotlib.image
import numpy
import pandas
from support import read_rows, tlab_command

import tlab
import tlab.spelling

FARM = {
    "image": {"width": 16, "height": 12},
    "sweep": {"objects": [20, 30], "workers": [1, 3]},
}
FARM_TEXT = """
[image]
width = 16
height = 12
[sweep]
objects = [20, 30]
workers = [1, 3]
"""
MESSAGE = {"program": {"name": "message"}, "sweep": {"bytes": [1, 10]}}
TOO_STRICT = {**MESSAGE, "check": [{"name": "too strict", "of": "latency_s", "at_most": 1e-9}]}


class FolderTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, text, name="mine.toml"):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path


class ResultsTest(FolderTest):
    def check_table(self, result):
        """The table has the cells of results.csv, each with its type."""
        rows = read_rows(result.folder / "results.csv")
        self.assertEqual(list(result.table.columns), list(rows[0]))
        self.assertEqual(len(result.table), len(rows))
        for name in rows[0]:
            column = result.table[name]
            for text, value in zip((row[name] for row in rows), column):
                if text == "":
                    self.assertTrue(pandas.isna(value), name)
                elif column.dtype == object:
                    self.assertEqual(value, text, name)
                elif column.dtype == bool:
                    self.assertEqual(value, {"1": True, "true": True, "0": False, "false": False}[text], name)
                else:
                    self.assertEqual(float(value), float(text), name)

    def test_table_of_the_farm(self):
        result = tlab.run(FARM)
        self.check_table(result)
        kinds = {name: str(dtype) for name, dtype in result.table.dtypes.items()}
        for name, kind in {"topology": "object", "workers": "int64", "objects": "int64", "time_s": "float64",
                           "speedup": "float64", "efficiency": "float64", "rays": "int64", "bottleneck": "object",
                           "ended": "object"}.items():
            self.assertEqual(kinds[name], kind, name)
        self.assertTrue(result.complete)
        self.assertEqual(result.programs, ["farm"])
        self.assertEqual(result.columns.loc["time_s", "unit"], "s")
        self.assertIn("first task", result.columns.loc["time_s", "meaning"])
        self.assertEqual(len(result), 4)

    def test_gaps_and_flags(self):
        programs = tlab.run({"network": {"topology": "line"}, "image": {"width": 8, "height": 8},
                             "scene": {"objects": 9}, "sweep": {"program": ["farm", "task_farm"], "workers": [2]}})
        self.check_table(programs)
        self.assertEqual(set(programs.programs), {"farm", "task_farm"})
        self.assertEqual(str(programs["rays"].dtype), "Int64")
        flags = tlab.programs.soft(reader_first=[True, False], bytes=[1, 2])
        self.check_table(flags)
        self.assertEqual(str(flags["reader_first"].dtype), "bool")
        self.assertEqual(list(flags.columns.loc["reader_first", ["type", "unit"]]), ["boolean", ""])
        self.assertEqual(list(flags["reader_first"]), [True, True, False, False])

    def test_the_same_bytes_as_the_command(self):
        path = self.write(FARM_TEXT)
        self.assertEqual(tlab_command("run", path, "-o", self.folder / "command").returncode, 0)
        expected = (self.folder / "command/results.csv").read_bytes()
        for experiment in (path, str(path), FARM_TEXT, FARM):
            result = tlab.run(experiment)
            self.assertEqual((result.folder / "results.csv").read_bytes(), expected)

    def test_settings_nested_and_dotted(self):
        path = self.write(FARM_TEXT)
        done = tlab_command("run", path, "-o", self.folder / "command", "--set", "sweep.workers=[2,4]", "--set",
                            "scene.source=spheres", "--set", "model.link.one_way_rate=1e6")
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = (self.folder / "command/results.csv").read_bytes()
        nested = {"sweep": {"workers": [2, 4]}, "scene": {"source": "spheres"}, "model": {"link": {"one_way_rate": 1e6}}}
        dotted = {"sweep.workers": numpy.array([2, 4]), "scene.source": "spheres", "model.link.one_way_rate": 1e6}
        for settings in (nested, dotted):
            result = tlab.run(path, **settings)
            self.assertEqual((result.folder / "results.csv").read_bytes(), expected)

    def test_checks_record_and_images(self):
        experiment = {**FARM, "check": [{"name": "efficient", "of": "efficiency", "at_most": 1.01}]}
        result = tlab.run(experiment)
        self.assertEqual(list(result.checks["check"]), ["efficient"] * 4)
        self.assertEqual(result.record["models"][0]["name"], "t805-25")
        self.assertEqual(sorted(result.images), ["spheres-20", "spheres-30"])
        for name, image in result.images.items():
            png = matplotlib.image.imread(result.folder / f"image-{name}.png")
            numpy.testing.assert_array_equal(image, numpy.rint(255 * png[..., :3]))
        self.assertEqual(len(tlab.run(MESSAGE).checks), 0)

    def test_a_folder_is_kept_and_a_temporary_one_is_not(self):
        result = tlab.run(FARM, folder=self.folder / "results")
        again = tlab.run(FARM, folder=self.folder / "results")
        self.assertIn("4 of 4 points were already recorded", again.output)
        pandas.testing.assert_frame_equal(again.table, result.table)
        pandas.testing.assert_frame_equal(tlab.load(self.folder / "results").table, result.table)
        with self.assertRaisesRegex(tlab.BadInput, "expected a folder of results"):
            tlab.load(self.folder)
        temporary = tlab.run(MESSAGE)
        folder = temporary.folder
        self.assertTrue(folder.is_dir())
        del temporary
        self.assertFalse(folder.exists())

    def test_one_row(self):
        self.assertGreater(tlab.run(MESSAGE, sweep={"bytes": [5]}).row["latency_s"], 0)
        with self.assertRaisesRegex(ValueError, "found 2 rows"):
            tlab.run(MESSAGE).row


class TopologiesTest(FolderTest):
    def test_networks_of_python_in_an_experiment(self):
        import networkx

        ring = networkx.cycle_graph(6)
        ring.add_edge(0, 3)
        ring.name = "ring with a chord"
        chord = tlab.from_networkx(ring)
        chord.save(self.folder / "chord.dot")
        experiment = {"image": {"width": 8, "height": 8}, "scene": {"objects": 20},
                      "sweep": {"topology": [chord, tlab.topology("ring:6"), "mesh:2x3"]}}
        expected = tlab.run(experiment, sweep={"topology": [self.folder / "chord.dot", "ring:6", "mesh:2x3"]})
        for result in (tlab.run(experiment),
                       tlab.run(self.write("image = {width = 8, height = 8}\nscene.objects = 20\n"),
                                sweep={"topology": experiment["sweep"]["topology"]})):
            self.assertEqual(list(result["topology"]), ["ring with a chord", "ring:6", "mesh:2x3"])
            pandas.testing.assert_frame_equal(result.table.drop(columns="topology"),
                                              expected.table.drop(columns="topology"))

    def test_networks_of_one_name_are_told_apart(self):
        import networkx

        def path(size, name):
            return tlab.from_networkx(networkx.path_graph(size), name)

        given = [path(2, "a-2"), path(3, "a"), path(4, "a"), path(5, "a b"), path(6, "a-b")]
        table = tlab.programs.metrics(topology=given).table
        self.assertEqual(list(table["processors"]), [2, 3, 4, 5, 6])
        self.assertEqual(list(table["topology"]), ["a-2", "a", "a-3", "a b", "a-b"])

    def test_labels_that_look_like_numbers_are_texts(self):
        import networkx

        for labels in (["0_1", "0_2"], ["007", "008"], ["nan", "inf"], ["1e", "0x1"]):
            network = tlab.from_networkx(networkx.relabel_nodes(networkx.path_graph(2), dict(enumerate(labels))), "pair")
            table = tlab.programs.census(topology=network).table
            self.assertEqual(list(table["processor"]), labels)

    def test_paths_are_found_from_the_current_folder(self):
        tlab.topology("mesh:2x2").save(self.folder / "square.graphml")
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder)
        experiment = {"program": {"name": "metrics"}, "network": {"topology": pathlib.Path("square.graphml")}}
        self.assertEqual(tlab.run(experiment).row["processors"], 4)


class ErrorsTest(FolderTest):
    def check_message(self, kind, experiment, **settings):
        with self.assertRaises(kind) as caught:
            tlab.run(experiment, **settings)
        return caught.exception

    def test_bad_input_has_the_commands_message(self):
        path = self.write("[program]\nname = 'message'\nbyts = 3\n")
        error = self.check_message(tlab.BadInput, path)
        done = tlab_command("run", path, "-o", self.folder / "results")
        self.assertEqual((done.returncode, error.exit_code), (2, 2))
        self.assertEqual(f"tlab: {error}\n", done.stderr)
        self.assertIsNone(error.result)
        self.assertIsInstance(error, ValueError)
        self.assertIn("cannot be read", str(self.check_message(tlab.BadInput, self.folder / "none.toml")))
        self.assertIn("program.bytes", str(self.check_message(tlab.BadInput, MESSAGE, program={"byts": 3})))
        self.assertIn("found <object", str(self.check_message(tlab.BadInput, MESSAGE, title=object())))

    def test_messages_on_a_dict_or_text_do_not_name_a_temporary_file(self):
        self.assertEqual(str(self.check_message(tlab.BadInput, {"image": {"width": -3}})),
                         "image.width: found -3, expected a whole number from 1 to 65536")
        self.assertRegex(str(self.check_message(tlab.BadInput, MESSAGE, program={"byts": 3})),
                         "^unknown key \"program.byts\"")
        self.assertRegex(str(self.check_message(tlab.BadInput, "[image]\nwidth = -3\n")),
                         "^line 2 of the text: image.width: found -3")

    def test_wrong_values_are_refused_in_words_of_tlab(self):
        itself = {}
        itself["scene"] = itself
        for experiment, settings, message in (
                ("", {}, "found '', expected the path of an experiment"),
                ("title = '\ud800'", {}, "expected text without surrogates"),
                ({"scene": {1: 2}}, {}, "found the key 1, expected a text"),
                (itself, {}, "contains itself"),
                (MESSAGE, {"program.bytes": itself}, "contains itself"),
                (self.folder / "a\0b.toml", {}, "expected a text without zero bytes"),
                (MESSAGE, {"title": "\ud800"}, "expected a text without zero bytes")):
            with self.subTest(message), self.assertRaisesRegex(tlab.BadInput, re.escape(message)):
                tlab.run(experiment, **settings)
        with self.assertRaisesRegex(tlab.BadInput, "size: found '4x4', expected"):
            tlab.render("spheres:2", size="4x4")
        with self.assertRaisesRegex(tlab.BadInput, r"^a\\x1b.nff: "):
            tlab.render("a\x1b.nff")

    def test_a_check_that_fails_leaves_results(self):
        error = self.check_message(tlab.CheckFailed, TOO_STRICT)
        self.assertIn("1 of 1 check(s) do not hold", str(error))
        self.assertEqual(error.exit_code, 1)
        self.assertEqual(len(error.result.table), 2)
        self.assertEqual(list(error.result.checks["simulated"]), list(error.result["latency_s"]))
        self.assertEqual(len(tlab.run(TOO_STRICT, check=[]).table), 2)

    def test_old_results_are_not_those_of_a_failure(self):
        tlab.run(MESSAGE, folder=self.folder / "results")
        error = self.check_message(tlab.BadInput, MESSAGE, folder=self.folder / "results", program={"byts": 3})
        self.assertIsNone(error.result)

    def test_a_deadlock_is_a_simulated_fault(self):
        error = self.check_message(tlab.SimulatedFault, {"program": {"name": "deadlock"}})
        self.assertEqual(error.exit_code, 3)
        self.assertRegex(str(error), "(?i)deadlock")
        drawing = re.search("who waits for whom: (.*)", str(error))[1]
        self.assertTrue(pathlib.Path(drawing).is_file())

    def test_with_another_command(self):
        with unittest.mock.patch.dict(os.environ, {"TLAB": "/bin/true"}):
            with self.assertRaisesRegex(tlab.NotFound, "/bin/true has written no results"):
                tlab.run(MESSAGE)

    def test_without_the_command(self):
        before = os.environ.get("TLAB")
        self.addCleanup(lambda: os.environ.pop("TLAB") if before is None else os.environ.update(TLAB=before))
        os.environ["TLAB"] = str(self.folder / "none")
        error = self.check_message(tlab.NotFound, MESSAGE)
        self.assertIn("none", str(error))

    def test_an_interrupt_ends_the_command_and_keeps_what_there_is(self):
        # Interrupts a child process during a long sweep, as soon as the first point has a record.
        results = self.folder / "results"
        code = ("import sys, tlab\n"
                "try: tlab.run({'scene': {'objects': 800}, 'sweep': {'workers': list(range(1, 60))}}, "
                "folder=sys.argv[1], jobs=1)\n"
                "except KeyboardInterrupt: print('interrupted')\n")
        child = subprocess.Popen([sys.executable, "-c", code, results], stdout=subprocess.PIPE, text=True,
                                 env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
        deadline = time.monotonic() + 60
        while not list(results.glob("points/*/*.json")) and time.monotonic() < deadline:
            time.sleep(0.05)
        child.send_signal(signal.SIGINT)
        output, _ = child.communicate(timeout=60)
        self.assertEqual(output, "interrupted\n")
        self.assertFalse(tlab.load(results).complete)


class SpellingTest(unittest.TestCase):
    def test_values_read_back_as_they_were(self):
        for value in [True, False, 0, -7, 10**15, 1.5, 1e-300, 1e22, 0.1, "", 'a "b" \\ \n\t\x7f \u00e9 \U0001f600', [],
                      [1, [2, 3]], ["a", "b"], {"a b": {"c": [1.0]}}, [{"name": "x", "at_most": 1e-9}]]:
            with self.subTest(repr(value)):
                self.assertEqual(tomllib.loads(f"value = {tlab.spelling.spell(value)}")["value"], value)
                tables = {"one": value, "section": {"key": value, "width, height": [[1, 2]]}}
                self.assertEqual(tomllib.loads(tlab.spelling.spell_file(tables)), tables)
        self.assertEqual(tlab.spelling.spell(numpy.float64(2)), "2.0")
        self.assertEqual(tlab.spelling.spell(numpy.arange(3)), "[0, 1, 2]")
        self.assertEqual(tlab.spelling.spell(range(3)), "[0, 1, 2]")


class ExperimentsTest(unittest.TestCase):
    def test_those_that_come_with_tlab(self):
        found = tlab.experiments()
        path = tlab.find_experiment("thesis/table-4.2")
        self.assertTrue(path.is_file())
        self.assertEqual(found[path], "Tables 4.2 to 4.8 of the thesis")
        self.assertEqual(tlab.find_experiment("farm.toml").name, "farm.toml")
        with self.assertRaisesRegex(tlab.BadInput, "found 0 experiments"):
            tlab.find_experiment("table-4.200")


if __name__ == "__main__":
    unittest.main()
