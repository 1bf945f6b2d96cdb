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

/// Busy shares of a frame's interval, 0 to 1: for each processor by id, and for each link direction
/// by its index in Machine::links().
struct Busy {
  std::vector<double> processors, links;
};

/// The parts of the drawing that are equal in all frames.
class MachineDrawing {
 public:
  struct Node {
    topologies::Place place;  ///< position, pixels
    std::string label;
    bool is_box = false;  ///< true outside the network: drawn as a box
    bool is_root = false;
  };

  /// Lays out the network as in reports. Processors outside the network that lead to its root are
  /// in rows above it; all others are beside their neighbours. `network` maps the network's
  /// processors to machine ids; if it is empty, the numbers equal the ids. Throws as make_layout
  /// does.
  MachineDrawing(const machine::Machine& machine, const topologies::Topology& topology,
                 const std::vector<int>& network);

  int width() const { return width_; }
  int height() const { return height_; }
  /// The processors, by machine id.
  const std::vector<Node>& nodes() const { return nodes_; }
  double radius() const { return radius_; }
  /// The control points of each half link, by index in Machine::links(). A half shows one direction
  /// of a link.
  const std::vector<std::array<topologies::Place, 4>>& halves() const { return halves_; }

  /// Draws the frame with the loads of the interval `now` of the film.
  renderer::Bitmap draw(const std::string& title, const Busy& busy, const Span& film,
                        const Span& now) const;

 private:
  /// Curvatures of links, by the machine ids of their two processors, lower first. Several links
  /// between the same two have one value each.
  using Swerves = std::map<std::pair<int, int>, std::vector<topologies::Place>>;
  void place(const topologies::Places& places);
  void join(const machine::Machine& machine, const Swerves& swerves);
  static double box_width(const Node& node);
  void draw_node(Canvas& canvas, const Node& node, double busy) const;
  void draw_legend(Canvas& canvas, double window_s) const;

  int width_ = 0, height_ = 0;
  double unit_ = 0, radius_ = 0;  // size of a unit, and radius of a processor, in pixels
  std::vector<Node> nodes_;
  std::vector<std::array<topologies::Place, 4>> halves_;
};

}  // namespace laboratory
