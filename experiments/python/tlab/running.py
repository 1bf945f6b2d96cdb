"""Experiments: running them with the command."""

import itertools
import os
import pathlib
import re
import shutil
import tempfile
import weakref

from tlab import command
from tlab.errors import BadInput
from tlab.results import Result
from tlab.spelling import flatten, plain, spell, spell_file
from tlab.topologies import Topology


class _Files:
    """A temporary folder, which lasts as long as this object, for the files that a run is given.

    These are the experiment, where it is no file yet, and networks. names: what the networks are called, by the texts
    that the experiment has in their place.
    """

    def __init__(self):
        self.folder, self.names = pathlib.Path(tempfile.mkdtemp(prefix="tlab-")), {}
        weakref.finalize(self, shutil.rmtree, self.folder, ignore_errors=True)

    def put_networks(self, value, absolute):
        """The value with a spec or a file's path in place of each topology in it."""
        value = plain(value)
        if isinstance(value, Topology):
            return value.spec or self._save(value, absolute)
        if isinstance(value, dict):
            return {key: self.put_networks(v, absolute) for key, v in value.items()}
        if hasattr(value, "__iter__") and not isinstance(value, str):
            return [self.put_networks(v, absolute) for v in value]
        return value

    def _save(self, topology, absolute):
        stem = re.sub(r"[^A-Za-z0-9_-]+", "-", topology.name).strip("-") or "network"
        path = self.folder / f"{_find_free(stem, lambda s: (self.folder / f'{s}.graphml').exists())}.graphml"
        topology.save(path)
        text = str(path) if absolute else path.name
        self.names[text] = _find_free(topology.name, lambda name: name in self.names.values())
        return text


# The name, or with the first number behind it with which it is not taken.
def _find_free(name, is_taken):
    names = itertools.chain([name], (f"{name}-{number}" for number in itertools.count(2)))
    return next(free for free in names if not is_taken(free))


# A text in TOML, where a path has neither of these.
def _is_text(experiment):
    return isinstance(experiment, str) and ("\n" in experiment or "=" in experiment)


# The experiment as a file: its own, or one that is written now.
def _file_of(experiment, files):
    if isinstance(experiment, dict):
        text = spell_file(files.put_networks(experiment, absolute=False))
    elif _is_text(experiment):
        text = experiment
    else:
        return pathlib.Path(os.fspath(experiment))
    path = files.folder / "experiment.toml"
    path.write_text(text, encoding="utf-8")
    return path


# Tells one file from another that has been written in its place.
def _identity(path):
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns


def run(experiment, /, *, folder=None, jobs=None, until=None, **settings):
    """Runs an experiment with the command `tlab run`, and gives its Result.

    experiment: the path of a file; or a dict of its tables, or a text in TOML, which has a line end or a =. Paths in
        a text are absolute; in a dict they may be pathlib.Paths, which are found from the current folder
    folder: where results are written; points that are there already are not run again. Else a temporary folder
    jobs: points run side by side, else as many as the host has processors
    until: seconds of simulated time after which a point is cut short
    settings: keys of the experiment, and what they are in place of what it says: network={"topology": "mesh"},
        sweep={"workers": [1, 7]}, or **{"sweep.workers": [1, 7]}. A topology may be one of topology() and
        from_networkx()

    Raises BadInput, CheckFailed or SimulatedFault with tlab's message; the two last have the results that there are.
    """
    files = _Files()
    path = _file_of(experiment, files)
    is_ours = path.parent == files.folder
    folder = files.folder / "results" if folder is None else pathlib.Path(folder)
    arguments = ["run", path, "-o", folder]
    for key, value in flatten(settings):
        arguments += ["--set", f"{key}={spell(files.put_networks(value, absolute=not is_ours), key)}"]
    for option, value in (("--jobs", jobs), ("--until", until)):
        if value is not None:
            arguments += [option, str(value)]
    before = _identity(folder / "run.json")
    done = command.start(arguments)
    has_results = _identity(folder / "run.json") not in (None, before)
    result = Result(folder, done.output, files) if has_results else None
    if failure := done.failure(result):
        raise failure
    return result


def load(folder):
    """The Result of a run that has been before, from its folder."""
    if not (pathlib.Path(folder) / "run.json").is_file():
        raise BadInput(f"{folder}: expected a folder of results, with a run.json")
    return Result(folder)


def experiments():
    """The experiments that come with tlab: their paths, and their titles."""
    lines = command.ask("list", "experiments").splitlines()[1:]
    found = {}
    for line in lines:
        path, _, title = line.strip().partition("  ")
        found[pathlib.Path(path).absolute()] = title.strip()
    return found


def find_experiment(name):
    """The path of an experiment that comes with tlab, such as "farm" or "thesis/table-4.2"."""
    wanted = pathlib.PurePath(name if str(name).endswith(".toml") else f"{name}.toml").parts
    found = [path for path in experiments() if path.parts[-len(wanted):] == wanted]
    if len(found) != 1:
        raise BadInput(f"found {len(found)} experiments that end in {name}, expected one of experiments()")
    return found[0]
