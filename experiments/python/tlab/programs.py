"""The programs of the simulated machine: one function per program, which runs it and returns its Result.

The functions are generated from the programs' declarations. They take a program's parameters by name. A list runs
every value of a parameter, and several lists run every combination: message(bytes=[1, 80], switches=[0, 1]) has four
rows. Other keys of the experiment file are given as in tlab.run.
"""

import inspect
import keyword

from tlab import _native
from tlab.running import run as _run
from tlab.spelling import plain

# Short names for keys that most programs have: for each, the key and its default value.
_COMMON = {"model": ("machine.model", "t805-25")}
_NETWORK = {"topology": ("network.topology", "tree"), "workers": ("network.workers", 7)}


def _common_of(program):
    return {**_COMMON, **(_NETWORK if program["network"] else {})}


# Maps short names to the parameters of a program. A parameter whose short name is not unique gets
# its whole key as its name, with _ for each dot.
def _names_of(program):
    keys = [parameter["key"] for parameter in program["parameters"]]
    short = [key.rpartition(".")[2] for key in keys]
    taken = {*_common_of(program), "folder", "jobs", "until"}
    return {(key.replace(".", "_") if short.count(s) > 1 or s in taken else s): parameter
            for s, key, parameter in zip(short, keys, program["parameters"])}


def _domain_of(parameter):
    kind = parameter["kind"]
    if kind in ("whole", "number"):
        return f"{'whole, ' if kind == 'whole' else ''}{parameter['low']:.15g} to {parameter['high']:.15g}"
    return {"choice": "one of " + ", ".join(parameter["choices"]), "flag": "True or False"}.get(kind, kind)


def _document(program, names):
    def line(name, parameter):
        unit = f", {parameter['unit']}" if parameter["unit"] else ""
        return f"    {name}: {parameter['help']}{unit}; {_domain_of(parameter)} [{parameter['default']}]"

    common = [f"    {name}: {key} [{default}]" for name, (key, default) in _common_of(program).items()]
    return "\n".join([f"{program['help'][0].upper()}{program['help'][1:]}.", "", "Parameters:",
                      *(line(name, parameter) for name, parameter in names.items()), *common,
                      "    folder, jobs, until, and other keys of the experiment: as of tlab.run", "", "Results:",
                      *(f"    {name}: {about}" for name, about in program["columns"])])


def _is_several(value, kind):
    if isinstance(value, (str, dict)) or not hasattr(value, "__iter__"):
        return False
    if kind != "list":
        return True
    return any(hasattr(item, "__iter__") for item in value)


def _make_function(program):
    names = _names_of(program)
    keys = {name: (parameter["key"], parameter["kind"]) for name, parameter in names.items()}
    keys.update({name: (key, "whole") for name, (key, _) in _common_of(program).items()})

    def function(*, folder=None, jobs=None, until=None, **arguments):
        settings, sweep = {}, {}
        for name, value in arguments.items():
            value = plain(value)
            if name not in keys:
                settings[name] = value
            elif _is_several(value, keys[name][1]):
                sweep[keys[name][0]] = list(value)
            else:
                settings[keys[name][0]] = value
        experiment = {"program": {"name": program["name"]}}
        if sweep:
            experiment["sweep"] = sweep
        return _run(experiment, folder=folder, jobs=jobs, until=until, **settings)

    only = inspect.Parameter.KEYWORD_ONLY
    defaults = {name: parameter["default"] for name, parameter in names.items()}
    defaults |= {name: default for name, (_, default) in _common_of(program).items()}
    defaults |= {"folder": None, "jobs": None, "until": None}
    function.__name__ = function.__qualname__ = _python_name(program["name"])
    function.__module__ = __name__
    function.__doc__ = _document(program, names)
    function.__signature__ = inspect.Signature(
        [*(inspect.Parameter(name, only, default=default) for name, default in defaults.items()),
         inspect.Parameter("settings", inspect.Parameter.VAR_KEYWORD)])
    return function


def _python_name(name):
    return f"{name}_" if keyword.iskeyword(name) else name


_FUNCTIONS = {_python_name(program["name"]): _make_function(program) for program in _native.programs()}
globals().update(_FUNCTIONS)
__all__ = list(_FUNCTIONS)
