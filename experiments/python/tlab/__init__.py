"""tlab, the transputer laboratory: experiments, topologies and pictures from Python.

    import tlab
    result = tlab.run("experiments/farm.toml", sweep={"workers": [1, 7]})
    result.table                                    # a pandas.DataFrame
    tlab.topology("torus:4x4").metrics()
    tlab.programs.message(bytes=[1, 10, 100])["latency_s"]
    tlab.render("spheres:200", size=(160, 120))     # an array of numpy
"""

from tlab import programs
from tlab._native import VERSION as __version__
from tlab.errors import BadInput, CheckFailed, Error, NotFound, SimulatedFault
from tlab.pictures import read_image, render, render_options
from tlab.results import Result
from tlab.running import experiments, find_experiment, load, run
from tlab.topologies import Link, Routes, Topology, from_networkx, generators, topology

__all__ = ["BadInput", "CheckFailed", "Error", "Link", "NotFound", "Result", "Routes", "SimulatedFault", "Topology",
           "experiments", "find_experiment", "from_networkx", "generators", "load", "programs", "read_image", "render",
           "render_options", "run", "topology"]
