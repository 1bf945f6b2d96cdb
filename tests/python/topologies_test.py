"""Topologies: networkx is the oracle of metrics and routes; graphs survive conversion both ways."""

import itertools
import pathlib
import tempfile
import unittest

import networkx
import numpy
from support import random_source, tlab_command

import tlab

SPECS = ["line:1", "line:2", "line:9", "ring:3", "ring:8", "tree:13", "tree:7:1", "binary:15", "mesh:1x5", "mesh:4x5",
         "torus:3x3", "torus:2x4", "torus:4x5", "hypercube:0", "hypercube:4", "star:5", "amp:24"]


def random_graph(source):
    """A random connected multigraph with at most four edges per node. It may have labels, ports and
    a root."""
    size = source.randrange(1, 20)
    names = source.choice([list(range(size)), [f"p{i}" for i in range(size)],
                           [f'"{i}" <&> \u00e9' for i in range(size)]])
    graph = networkx.MultiGraph(name="random")
    order = list(names)
    if source.random() < 0.5:
        source.shuffle(order)
    graph.add_nodes_from(order)
    free = {name: source.sample(range(4), 4) for name in names}
    for i in range(1, size):
        other = source.choice([n for n in names[:i] if free[n]] or [names[i - 1]])
        _add_edge(graph, names[i], other, free, source)
    for _ in range(source.randrange(2 * size)):
        open_ones = [n for n in names if free[n]]
        if len(open_ones) < 2:
            break
        _add_edge(graph, *source.sample(open_ones, 2), free, source)
    if source.random() < 0.7:
        graph.nodes[source.choice(names)]["root"] = True
    return graph


def _add_edge(graph, a, b, free, source):
    with_ports = source.random() < 0.5
    port = {a: free[a].pop(), b: free[b].pop()}
    if not with_ports:
        graph.add_edge(a, b)
        return
    first = min(a, b, key=list(graph.nodes).index)  # the ends in the order of graph.edges
    graph.add_edge(a, b, port_a=port[first], port_b=port[b if first == a else a])


def make_graphs(count):
    """Random graphs that are valid topologies: a free port remains for every end without a port."""
    source = random_source()
    return [random_graph(source) for _ in range(count)]


class MetricsTest(unittest.TestCase):
    def check(self, topology):
        graph = topology.to_networkx()
        found = topology.metrics()
        lengths = dict(networkx.all_pairs_shortest_path_length(graph))
        degrees = [degree for _, degree in graph.degree()]
        self.assertEqual(found["processors"], graph.number_of_nodes())
        self.assertEqual(found["links"], graph.number_of_edges())
        self.assertEqual((found["degree_min"], found["degree_max"]), (min(degrees), max(degrees)))
        self.assertEqual(found["diameter"], networkx.diameter(graph))
        mean = networkx.average_shortest_path_length(graph) if topology.processors > 1 else 0
        self.assertAlmostEqual(found["mean_distance"], mean, places=12)
        names = topology.names
        numpy.testing.assert_array_equal(topology.distances(), [[lengths[a][b] for b in names] for a in names])
        for start, end in itertools.product(names, names):
            path = topology.path(start, end)
            self.assertEqual((path[0], path[-1]), (start, end))
            self.assertEqual(len(path) - 1, lengths[start][end])
            self.assertTrue(networkx.is_path(graph, path))

    def test_generators_against_networkx(self):
        for spec in SPECS:
            with self.subTest(spec):
                self.check(tlab.topology(spec))

    def test_random_graphs_against_networkx(self):
        for number, graph in enumerate(make_graphs(60)):
            with self.subTest(number):
                self.check(tlab.from_networkx(graph))

    def test_known_graphs_of_networkx(self):
        for spec, graph in [("torus:4x5", networkx.grid_2d_graph(4, 5, periodic=True)),
                            ("mesh:3x4", networkx.grid_2d_graph(3, 4)), ("ring:8", networkx.cycle_graph(8)),
                            ("hypercube:4", networkx.hypercube_graph(4)), ("star:5", networkx.star_graph(4)),
                            ("binary:15", networkx.balanced_tree(2, 3)), ("line:9", networkx.path_graph(9))]:
            with self.subTest(spec):
                simple = networkx.Graph(tlab.topology(spec).to_networkx())
                self.assertTrue(networkx.is_isomorphic(simple, graph))

    def test_bisection_against_all_halves(self):
        for graph in make_graphs(30):
            topology = tlab.from_networkx(graph)
            n = topology.processors
            if n > 11:
                continue
            halves = itertools.combinations(range(n), n // 2)
            cut = min(sum((link.a in half) != (link.b in half) for link in topology.links) for half in halves)
            self.assertEqual(topology.metrics()["bisection_width"], cut)

    def test_busiest_link_and_cycles_against_the_routes_themselves(self):
        for spec, name in [("mesh:4x4", ""), ("mesh:4x4", "xy"), ("torus:4x5", "xy"), ("torus:4x5", ""),
                           ("ring:7", ""), ("hypercube:4", ""), ("tree:13", ""), ("amp:16", "")]:
            with self.subTest(spec + name):
                topology = tlab.topology(spec)
                messages, waits = {}, networkx.DiGraph()
                for start, end in itertools.permutations(range(topology.processors), 2):
                    steps = list(itertools.pairwise(topology.routes(name).path(start, end)))
                    for step in steps:
                        messages[step] = messages.get(step, 0) + 1
                    waits.add_edges_from(itertools.pairwise(steps))
                found = topology.routes(name).metrics()
                self.assertEqual(found["all_to_all_messages"], max(messages.values()))
                self.assertEqual(messages[found["all_to_all_link"]], max(messages.values()))
                self.assertEqual(found["closes_cycle"], not networkx.is_directed_acyclic_graph(waits))

    def test_what_the_command_prints(self):
        printed = tlab_command("topology", "mesh:8x8", "--routes", "xy").stdout
        found = tlab.topology("mesh:8x8").metrics("xy")
        for name, text in [("mean distance", f"{found['mean_distance']:.4f}"), ("links", str(found["links"])),
                           ("busiest, all to all", f"{found['all_to_all_messages']} messages"),
                           ("routes close a cycle", "yes" if found["closes_cycle"] else "no")]:
            self.assertRegex(printed, rf"(?m)^{name} +{text}")


class GraphsTest(unittest.TestCase):
    def test_generators_to_networkx_and_back(self):
        for spec in SPECS:
            with self.subTest(spec):
                topology = tlab.topology(spec)
                self.assertEqual(tlab.from_networkx(topology.to_networkx()), topology)

    def test_random_graphs_there_and_back(self):
        for number, graph in enumerate(make_graphs(200)):
            with self.subTest(number):
                topology = tlab.from_networkx(graph)
                again = topology.to_networkx()
                self.assertEqual(tlab.from_networkx(again), topology)
                self.assertEqual(sorted(map(sorted, map(_texts, again.edges()))),
                                 sorted(map(sorted, map(_texts, graph.edges()))))
                self.assertEqual(set(map(str, again)), set(map(str, graph)))

    def test_ports_and_root_are_those_of_the_graph(self):
        for graph in make_graphs(100):
            topology = tlab.from_networkx(graph)
            roots = [str(n) for n, root in graph.nodes(data="root") if root]
            if roots:
                self.assertEqual(str(topology.names[topology.root]), roots[0])
            ends = {(str(topology.names[link.a]), link.port_a, str(topology.names[link.b]), link.port_b)
                    for link in topology.links}
            for a, b, edge in graph.edges(data=True):
                if "port_a" in edge:
                    one = (str(a), edge["port_a"], str(b), edge["port_b"])
                    self.assertTrue(one in ends or one[2:] + one[:2] in ends)

    def test_files_keep_everything(self):
        with tempfile.TemporaryDirectory() as folder:
            for number, graph in enumerate(make_graphs(40)):
                topology = tlab.from_networkx(graph)
                for ending in ("dot", "gv", "graphml"):
                    path = pathlib.Path(folder) / f"{number}.{ending}"
                    topology.save(path)
                    self.assertEqual(tlab.topology(path), topology)

    def test_tlab_reads_what_networkx_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "torus.graphml"
            for spec in ("torus:3x3", "tree:7", "amp:12"):
                topology = tlab.topology(spec)
                networkx.write_graphml(topology.to_networkx(), path)
                self.assertEqual(tlab.topology(path), topology)
                self.assertEqual(tlab.from_networkx(networkx.read_graphml(path, node_type=int)), topology)

    def test_other_names_change_names_alone(self):
        topology = tlab.topology("torus:3x4")
        graph = networkx.relabel_nodes(topology.to_networkx(), {i: f"board {i}" for i in range(12)})
        renamed = tlab.from_networkx(graph)
        self.assertEqual(renamed.links, topology.links)
        self.assertEqual(renamed.labels, [f"board {i}" for i in range(12)])
        self.assertEqual(renamed.distance("board 0", "board 7"), topology.distance(0, 7))
        self.assertEqual(renamed.path("board 0", "board 7"), [f"board {i}" for i in topology.path(0, 7)])

    def test_nodes_that_are_numbers_are_names(self):
        for first, step in [(1, 1), (10, -2), (-3, 1), (0, 2)]:
            nodes = [first + step * i for i in range(5)]
            graph = networkx.path_graph(nodes)
            topology = tlab.from_networkx(graph)
            for a, b in itertools.product(nodes, nodes):
                self.assertEqual(topology.path(a, b), networkx.shortest_path(graph, a, b))
                self.assertEqual(topology.distance(str(a), numpy.int64(b)), abs(a - b) // abs(step))
            with self.assertRaisesRegex(tlab.BadInput, "found no processor called 99"):
                topology.path(nodes[0], 99)
            self.assertEqual(list(topology.to_networkx()), nodes)
            with tempfile.TemporaryDirectory() as folder:
                topology.save(f"{folder}/path.dot")
                again = tlab.topology(f"{folder}/path.dot")
            self.assertEqual(again.path(nodes[0], nodes[2]), [str(node) for node in nodes[:3]])
        with self.assertRaisesRegex(tlab.BadInput, "found no processor called 0"):
            tlab.from_networkx(networkx.path_graph([1, 2, 3])).path(0, 1)

    def test_nodes_may_be_of_any_kind(self):
        grid = tlab.from_networkx(networkx.grid_2d_graph(3, 3))
        self.assertEqual(grid.path((0, 0), (0, 2)), [(0, 0), (0, 1), (0, 2)])
        self.assertEqual(grid.distance("(0, 0)", 8), 4)
        self.assertEqual(tlab.topology("ring:4").path("0", 1), [0, 1])
        with self.assertRaisesRegex(tlab.BadInput, "processor: found True"):
            grid.distance(True, 0)

    def test_root_is_a_flag_or_a_node(self):
        for mark, root in [(True, 2), ("true", 2), (1.0, 2), ("1", 2), (False, 0), ("False", 0), (0, 0), (None, 0)]:
            graph = networkx.path_graph(3)
            graph.nodes[2]["root"] = mark
            self.assertEqual(tlab.from_networkx(graph).root, root)
        self.assertEqual(tlab.from_networkx(networkx.Graph([(1, 2), (2, 3)], root=2)).root, 1)

    def test_parallel_links_are_kept(self):
        graph = networkx.MultiGraph([("a", "b"), ("a", "b"), ("b", "c")])
        topology = tlab.from_networkx(graph)
        self.assertEqual([link[::2] for link in topology.links], [(0, 1), (0, 1), (1, 2)])
        self.assertEqual(topology.to_networkx().number_of_edges("a", "b"), 2)

    def test_refusals(self):
        two_roots = networkx.path_graph(3)
        two_roots.nodes[0]["root"] = two_roots.nodes[2]["root"] = True
        one_port = networkx.path_graph(3)
        one_port.edges[0, 1]["port_b"] = one_port.edges[1, 2]["port_a"] = 2
        no_port = networkx.path_graph(2)
        no_port.edges[0, 1]["port_a"] = 4
        marked = networkx.path_graph(2)
        marked.nodes[1]["root"] = "yes"
        word, half = networkx.path_graph(2), networkx.path_graph(2)
        word.edges[0, 1]["port_a"], half.edges[0, 1]["port_b"] = "left", 1.5
        for graph, message in [
                (word, "network: edge \"0\" to \"1\": found port 'left', expected 0 to 3"), (half, "found port '1.5'"),
                (networkx.Graph(), "found an empty graph"), (networkx.star_graph(5), "found 5 links of processor 0"),
                (networkx.Graph([(0, 0)]), "to itself"), (networkx.Graph([(0, 1), (2, 3)]), "found no path from the root 0 to processor 2"),
                (networkx.Graph([(1, "1")]), "found two nodes called '1'"), (two_roots, "found two roots"),
                (one_port, "port 2"), (no_port, "found port '4', expected 0 to 3"),
                (networkx.Graph([(0, 1)], root=7), 'found root "7", expected a vertex'),
                (marked, "vertex \"1\": found root = 'yes', expected true or false")]:
            with self.subTest(message), self.assertRaisesRegex(tlab.BadInput, message):
                tlab.from_networkx(graph)
        with self.assertRaisesRegex(tlab.BadInput, 'did you mean "torus"'):
            tlab.topology("trous:4x4")
        with self.assertRaisesRegex(tlab.BadInput, "found processor 9, expected 0 to 3"):
            tlab.topology("line:4").distance(0, 9)
        with self.assertRaisesRegex(tlab.BadInput, "line:4: processor: found 2.7, expected a whole number"):
            tlab.topology("line:4").path(0, 2.7)
        with self.assertRaisesRegex(tlab.BadInput, "found processor 1099511627776, expected 0 to 3"):
            tlab.topology("line:4").distance(1 << 40, 1)
        with self.assertRaisesRegex(tlab.BadInput, "cannot be written: No such file"):
            tlab.topology("line:4").save("/no/such/folder/x.dot")
        with self.assertRaisesRegex(tlab.BadInput, "found a graph, expected a topology"):
            tlab.programs.metrics(topology=networkx.cycle_graph(4))


def _texts(edge):
    return [str(end) for end in edge[:2]]


if __name__ == "__main__":
    unittest.main()
