"""Runs experiments with the command."""

import itertools
import os
import pathlib
import re
import shutil
import tempfile
import weakref

from tlab import command
from tlab.errors import BadInput, NotFound
from tlab.results import Result
from tlab.spelling import flatten, plain, spell, spell_file
from tlab.topologies import Topology


class _Files:
    """A temporary folder for a run's input files; it lasts as long as this object.

    It holds the experiment, if that is not yet a file, and networks. names: the names of the networks, keyed by the
    texts that replace them in the experiment.
    """

    def __init__(self):
        self.folder, self.names = pathlib.Path(tempfile.mkdtemp(prefix="tlab-")), {}
        weakref.finalize(self, shutil.rmtree, self.folder, ignore_errors=True)

    def put_networks(self, value, absolute):
        """Replaces each topology in the value by its spec or by the path of a new file."""
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


# Returns a name that is not taken: the given one, or this name with a number from 2, such as ring-2.
def _find_free(name, is_taken):
    names = itertools.chain([name], (f"{name}-{number}" for number in itertools.count(2)))
    return next(free for free in names if not is_taken(free))


# True if the argument is the text of an experiment, not a path: only TOML text contains a line end
# or "=".
def _is_text(experiment):
    return isinstance(experiment, str) and ("\n" in experiment or "=" in experiment)


# The path of the experiment's file. A text or a dict is first written to a new file.
def _file_of(experiment, files):
    if isinstance(experiment, dict):
        text = spell_file(files.put_networks(experiment, absolute=False))
    elif _is_text(experiment):
        text = experiment
    elif experiment == "":
        raise BadInput("found '', expected the path of an experiment, a dict or TOML text")
    else:
        return pathlib.Path(os.fspath(experiment))
    path = files.folder / "experiment.toml"
    try:
        path.write_text(text, encoding="utf-8")
    except UnicodeEncodeError as error:
        raise BadInput(f"found {text[error.start]!r}, expected text without surrogates") from None
    return path


# A message without the path of the temporary file that holds the experiment. For a text, keeps the
# line number. For a dict, which has no lines, removes it.
def _hide_file(message, path, experiment):
    if isinstance(experiment, dict):
        return re.sub(rf"{re.escape(str(path))}(:\d+)?(, with --set)?: ", "", message)
    return re.sub(rf"{re.escape(str(path))}:(\d+): ", r"line \1 of the text: ", message)


# The identity of a file on disk, which changes when another file replaces it.
def _identity(path):
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns


def run(experiment, /, *, folder=None, jobs=None, until=None, **settings):
    """Runs an experiment with the command `tlab run`, and gives its Result.

    experiment: the path of a file, a dict of its tables, or TOML text with a line end or a =. Paths in a text must be
        absolute; a dict may hold pathlib.Paths relative to the current folder
    folder: folder for the results, by default a temporary one; points already there are not run again
    jobs: number of points run in parallel, by default the host's number of processors
    until: simulated time in seconds at which a point is cut short
    settings: keys of the experiment with values that replace those of the file: network={"topology": "mesh"},
        sweep={"workers": [1, 7]}, or **{"sweep.workers": [1, 7]}. A topology may come from topology() or
        from_networkx()

    Raises BadInput, CheckFailed or SimulatedFault with tlab's message; the last two hold the available results.
    """
    files = _Files()
    folder = files.folder / "results" if folder is None else pathlib.Path(folder)
    try:
        path = _file_of(experiment, files)
        is_ours = path.parent == files.folder
        arguments = ["run", path, "-o", folder]
        for key, value in flatten(settings):
            arguments += ["--set", f"{key}={spell(files.put_networks(value, absolute=not is_ours), key)}"]
    except RecursionError:
        raise BadInput("found a dict or list that contains itself, expected a finite one") from None
    for option, value in (("--jobs", jobs), ("--until", until)):
        if value is not None:
            arguments += [option, str(value)]
    before = _identity(folder / "run.json")
    done = command.start(arguments)
    if is_ours:
        done.errors = _hide_file(done.errors, path, experiment)
    has_results = _identity(folder / "run.json") not in (None, before)
    result = Result(folder, done.output, files) if has_results else None
    if failure := done.failure(result):
        failure.files = files  # drawings of a fault may be in the temporary folder
        raise failure
    if result is None:
        raise NotFound(f"{command.find()} has written no results, expected the program tlab")
    return result


def load(folder):
    """The Result of an earlier run, from its folder."""
    if not (pathlib.Path(folder) / "run.json").is_file():
        raise BadInput(f"{folder}: expected a folder of results, with a run.json")
    return Result(folder)


def experiments():
    """A dict of the experiments that come with tlab: their titles by path."""
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
