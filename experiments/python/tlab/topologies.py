"""Topologies with their metrics and routes, and conversion from and to networkx."""

import collections
import functools
import os
import pathlib
import re

from tlab import _native
from tlab.errors import BadInput
from tlab.spelling import whole

# A link: the lower processor and its port, then the higher processor and its port.
Link = collections.namedtuple("Link", "a port_a b port_b")


class Topology:
    """A machine's wiring: processors with four ports each, and links between ports. It is immutable.

    Methods take a processor by its name. If no name is a whole number, they also accept the processor's number.
    """

    def __init__(self, native, spec=None, nodes=()):
        self._native = native
        self.spec = spec  # the text that stands for this topology in an experiment, or None
        self._nodes = list(nodes)  # the nodes of the graph from which the topology was made

    @property
    def name(self):
        """The spec, the path of a file, or the name of the graph."""
        return self._native.name

    @property
    def processors(self):
        """The number of processors. They are numbered from 0."""
        return self._native.processors

    @property
    def root(self):
        """The processor nearest to the host."""
        return self._native.root

    @property
    def labels(self):
        """The labels of the processors; an empty list if they only have numbers."""
        return self._native.labels

    @functools.cached_property
    def names(self):
        """The names of the processors: the nodes of the graph or the labels in the file, else their numbers."""
        return (self._nodes or self.labels) if self.labels else list(range(self.processors))

    @functools.cached_property
    def links(self):
        """All links, sorted by processors; several links may join the same two."""
        return [Link(a, port_a, b, port_b) for a, b, port_a, port_b in self._native.links()]

    def metrics(self, routes=""):
        """A dict of the metrics that `tlab topology` prints, optionally with other routes than the shortest.

        If every processor sends the root a message and gets a reply, farm_link is the busiest direction of a link,
        and farm_messages is the number of messages over it. all_to_all_link and all_to_all_messages have these
        meanings if every processor sends every other processor a message. If `routes` is given, the dict also has
        closes_cycle. bisection_width is None if it is unknown.
        """
        found = self._native.metrics()
        if routes:
            found.update(self.routes(routes).metrics())
        return found

    def routes(self, name=""):
        """Routes: "" for the shortest, "xy" for dimension order, or the path of a CSV file from,to,path."""
        return Routes(self, _native.make_routes(self._native, os.fspath(name)))

    @functools.cached_property
    def _shortest(self):
        return self.routes()

    def distance(self, start, end):
        """The distance between two processors, in links."""
        return self._shortest.distance(start, end)

    def path(self, start, end):
        """The processors on the shortest route, both ends included."""
        return self._shortest.path(start, end)

    def distances(self):
        """The distances between all processors in links, as a numpy array."""
        return self._shortest.distances()

    def to_networkx(self):
        """A networkx.MultiGraph with a node for each processor, by its name, and an edge for each link.

        An edge has the attributes port_a and port_b: the ports at its first and second node, in the order of `edges`.
        The root's node has the attribute root. from_networkx() restores the same topology.
        """
        import networkx

        graph = networkx.MultiGraph(name=self.name)
        graph.add_nodes_from(self.names)
        graph.nodes[self.names[self.root]]["root"] = True
        for a, port_a, b, port_b in self.links:
            graph.add_edge(self.names[a], self.names[b], port_a=port_a, port_b=port_b)
        return graph

    def save(self, path):
        """Writes a .dot, .gv or .graphml file; tlab and topology() read it as the same network."""
        path = pathlib.Path(path)
        writers = {".dot": self._native.to_dot, ".gv": self._native.to_dot, ".graphml": self._native.to_graphml}
        if path.suffix not in writers:
            raise BadInput(f"{path}: expected a name that ends in {', '.join(writers)}")
        try:
            path.write_text(writers[path.suffix](), encoding="utf-8")
        except OSError as error:
            raise BadInput(f"{path}: cannot be written: {error.strerror}") from None

    @functools.cached_property
    def _numbers(self):  # the processor's number for each name, and for each name as a string
        named = list(zip(self.names, range(self.processors)))
        return {**{str(name): number for name, number in named}, **dict(named)}

    @functools.cached_property
    def _has_whole_names(self):
        return any(re.fullmatch("-?[0-9]+", label) for label in self.labels)

    def number_of(self, processor):
        """The number of a processor, given by its name; also by its number if no name is a whole number."""
        try:
            if processor in self._numbers and not isinstance(processor, bool):
                return self._numbers[processor]
        except TypeError:
            pass  # an unhashable value, such as a list, is no name
        if not isinstance(processor, str):
            number = whole(processor, f"{self.name}: processor")
            if str(number) in self._numbers:
                return self._numbers[str(number)]
            if not self._has_whole_names:
                if not 0 <= number < self.processors:
                    raise BadInput(f"{self.name}: found processor {number}, expected 0 to {self.processors - 1}")
                return number
        raise BadInput(f"{self.name}: found no processor called {processor!r}")

    def _repr_svg_(self):
        return self._native.to_svg()

    def __eq__(self, other):
        if not isinstance(other, Topology):
            return NotImplemented
        return (self.processors, self.root, self.labels, self.links) == \
            (other.processors, other.root, other.labels, other.links)

    def __hash__(self):
        return hash((self.processors, self.root, tuple(self.links)))

    def __repr__(self):
        return f"<tlab.Topology {self.name}: {self.processors} processors, {len(self.links)} links>"


class Routes:
    """One route from each processor of a topology to each other."""

    def __init__(self, topology, native):
        self.topology, self._native = topology, native

    def _ends(self, start, end):
        return self.topology.number_of(start), self.topology.number_of(end)

    def distance(self, start, end):
        """The length of the route between two processors, in links."""
        return self._native.distance(*self._ends(start, end))

    def path(self, start, end):
        """The processors on the route, both ends included."""
        return [self.topology.names[p] for p in self._native.path(*self._ends(start, end))]

    def distances(self):
        """The lengths of all routes in links, as an array: a row for each start, a column for each end."""
        return self._native.distances()

    def metrics(self):
        """A dict of the metrics that depend on routes.

        mean_distance: the mean length of the routes, in links
        all_to_all_link, all_to_all_messages: the busiest direction of a link, and the number of messages over it, if
        every processor sends every other a message
        closes_cycle: whether the routes may deadlock, because they wait for each other's links in a cycle
        """
        link, messages = self._native.busiest()
        return {"mean_distance": self._native.mean_distance(), "all_to_all_messages": messages,
                "all_to_all_link": link, "closes_cycle": self._native.closes_cycle()}


def topology(spec):
    """The topology of a spec, such as "torus:4x4" or "tree:13", or of a .dot, .gv or .graphml file.

    generators() lists the forms of a spec.
    """
    spec = os.fspath(spec)
    return Topology(_native.make_topology(spec), None if pathlib.Path(spec).suffix else spec)


def generators():
    """A dict of the forms of a spec, such as "mesh:RxC", with one line of help for each."""
    return dict(_native.generators())


# The value of an attribute as a string, spelled as in a file; "" if the attribute is missing.
def _spell(attributes, name):
    value = attributes.get(name)
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return "" if value is None else str(value)


def from_networkx(graph, name=None):
    """The topology of a graph of networkx: each edge, directed or not, is one link.

    Nodes are numbered in the graph's order unless they are exactly 0 to n-1. The nodes stay the processors' names.
    The edges' attributes port_a and port_b are the ports, 0 to 3, at the first and second node, in the order of
    `graph.edges`. Ends without a port get the lowest free one. The root is the node with the attribute root (true or
    false), or the node named by the graph's attribute root, else processor 0. Raises BadInput for a graph that
    transputers cannot be wired to.
    """
    name = str(name or graph.name or "network")
    nodes = list(graph.nodes)
    index = {node: number for number, node in enumerate(nodes)}
    names = [str(node) for node in nodes]
    if len(set(names)) < len(names):
        twice = next(n for n, count in collections.Counter(names).items() if count > 1)
        raise BadInput(f"{name}: found two nodes called {twice!r}, expected different ones")
    roots = [_spell(graph.nodes[node], "root") for node in nodes]
    edges = [(index[a], index[b], *(_spell(edge, key) for key in ("port_a", "port_b", "tailport", "headport")))
             for a, b, edge in graph.edges(data=True)]
    native = _native.make_graph(name, names, roots, _spell(graph.graph, "root"), edges, graph.is_directed())
    return Topology(native, nodes=nodes)
