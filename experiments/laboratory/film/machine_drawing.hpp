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

/// Shares of a frame's time interval in which parts were busy, 0 to 1: processors by id, and link
/// directions by index in Machine::links().
struct Busy {
  std::vector<double> processors, links;
};

/// The parts of the drawing that are the same in all frames: positions of processors and links.
class MachineDrawing {
 public:
  struct Node {
    topologies::Place place;  ///< position, pixels
    std::string label;
    bool is_box = false;  ///< true: drawn as a box, because the processor is outside the network
    bool is_root = false;
  };

  /// Lays out the network as in reports. Processors outside the network that are linked to its
  /// root, directly or through each other, are in rows above the root. All others are beside their
  /// neighbours. `network` gives the machine id of each processor of the network; if it is empty,
  /// the processors' numbers are the ids. Throws as make_layout() does.
  MachineDrawing(const machine::Machine& machine, const topologies::Topology& topology,
                 const std::vector<int>& network);

  int width() const { return width_; }
  int height() const { return height_; }
  /// The processors, by machine id.
  const std::vector<Node>& nodes() const { return nodes_; }
  double radius() const { return radius_; }
  /// The control points of the curve for each direction of a link, by index in Machine::links().
  /// The curve of a direction is one half of the drawn link.
  const std::vector<std::array<topologies::Place, 4>>& halves() const { return halves_; }

  /// Draws the frame for the interval `now` of the film, in which the parts were busy as in `busy`.
  renderer::Bitmap draw(const std::string& title, const Busy& busy, const Span& film,
                        const Span& now) const;

 private:
  /// Offsets of links' midpoints from the straight line, by the machine ids of their two
  /// processors, the lower id first. There is one value for each link between the two processors.
  using Swerves = std::map<std::pair<int, int>, std::vector<topologies::Place>>;
  void place(const topologies::Places& places);
  void join(const machine::Machine& machine, const Swerves& swerves);
  static double box_width(const Node& node);
  void draw_node(Canvas& canvas, const Node& node, double busy) const;
  void draw_legend(Canvas& canvas, double window_s) const;

  int width_ = 0, height_ = 0;
  double unit_ = 0, radius_ = 0;  // pixels for 1 in the layout, and radius of a processor in pixels
  std::vector<Node> nodes_;
  std::vector<std::array<topologies::Place, 4>> halves_;
};

}  // namespace laboratory
