#pragma once
// Layout of a machine in a film, and drawing of its frames.
#include <map>
#include <string>
#include <vector>

#include "experiments/laboratory/film/canvas.hpp"
#include "experiments/laboratory/film/frame.hpp"
#include "simulator/machine/machine.hpp"
#include "topologies/graph/topology.hpp"

namespace laboratory {

/// Shares of a frame's time, 0 to 1: by id in the machine, and by index into Machine::links().
struct Busy {
  std::vector<double> processors, links;
};

/// The constant parts of all frames.
class MachineDrawing {
 public:
  struct Node {
    topologies::Place place;  ///< pixels
    std::string label;
    bool is_box = false;  ///< outside the network
    bool is_root = false;
  };

  /// Places the network as reports draw its topology, with processors attached to the root in rows
  /// above, and others beside their neighbours. `network` maps network processors to ids in the
  /// machine; empty: equal numbers. Throws as make_layout does.
  MachineDrawing(const machine::Machine& machine, const topologies::Topology& topology,
                 const std::vector<int>& network);

  int width() const { return width_; }
  int height() const { return height_; }
  /// By id in the machine.
  const std::vector<Node>& nodes() const { return nodes_; }
  double radius() const { return radius_; }
  /// The control points of the half of a link that shows one direction, by index into
  /// Machine::links().
  const std::vector<std::array<topologies::Place, 4>>& halves() const { return halves_; }

  /// Draws the frame of the loads during `now`, an interval of `film`.
  renderer::Bitmap draw(const std::string& title, const Busy& busy, const Span& film,
                        const Span& now) const;

 private:
  /// Keyed by two processors of the machine, lower first; several places for several links.
  using Swerves = std::map<std::pair<int, int>, std::vector<topologies::Place>>;
  void place(const topologies::Places& places);
  void join(const machine::Machine& machine, const Swerves& swerves);
  static double box_width(const Node& node);
  void draw_node(Canvas& canvas, const Node& node, double busy) const;
  void draw_legend(Canvas& canvas, double window_s) const;

  int width_ = 0, height_ = 0;
  double unit_ = 0, radius_ = 0;  // pixels
  std::vector<Node> nodes_;
  std::vector<std::array<topologies::Place, 4>> halves_;
};

}  // namespace laboratory
