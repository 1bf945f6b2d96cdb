#include "topologies/graph/search.hpp"

#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>

namespace topologies {
namespace {

// In compressed-row form, neighbours keep their order of insertion, here by ascending port.
using Graph = boost::compressed_sparse_row_graph<boost::directedS>;

Graph make_graph(const Topology& topology) {
  std::vector<std::pair<int, int>> arcs;
  arcs.reserve(2 * topology.links.size());
  const auto around = neighbours(topology);
  for (int p = 0; p < topology.processors; ++p)
    for (const auto& n : around[p]) arcs.emplace_back(p, n.processor);
  return Graph(boost::edges_are_sorted, arcs.begin(), arcs.end(), topology.processors);
}

struct Recorder : boost::default_bfs_visitor {
  explicit Recorder(Search& search) : search(search) {}
  void discover_vertex(size_t v, const Graph&) { search.order.push_back(static_cast<int>(v)); }
  void tree_edge(Graph::edge_descriptor e, const Graph& graph) {
    search.parent[target(e, graph)] = static_cast<int>(source(e, graph));
    search.distance[target(e, graph)] = search.distance[source(e, graph)] + 1;
  }
  Search& search;
};

void run_search(const Graph& graph, int start, Search& search) {
  search.order.clear();
  search.parent.assign(num_vertices(graph), -1);
  search.distance.assign(num_vertices(graph), -1);
  search.distance[start] = 0;
  boost::breadth_first_search(graph, start, boost::visitor(Recorder(search)));
}

}  // namespace

Search make_search(const Topology& topology, int start) {
  Search search;
  run_search(make_graph(topology), start, search);
  return search;
}

bool is_connected(const Topology& topology) {
  return static_cast<int>(make_search(topology, topology.root).order.size()) == topology.processors;
}

void for_each_piece(const Topology& topology,
                    const std::function<void(int, const Search&)>& visit) {
  const Graph graph = make_graph(topology);
  std::vector<bool> reached(topology.processors);
  Search search;
  const auto walk = [&](int start) {
    if (reached[start]) return;
    run_search(graph, start, search);
    for (const int p : search.order) reached[p] = true;
    visit(start, search);
  };
  walk(topology.root);
  for (int p = 0; p < topology.processors; ++p) walk(p);
}

}  // namespace topologies
