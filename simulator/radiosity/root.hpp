#pragma once
// The root of AMP's tree: it computes as all do, decides what is shot next, and is the display.
#include "simulator/radiosity/application.hpp"

namespace amp {

class Root : public Application {
 public:
  /// `nodes`: all processors, whose vertices are shown. `on_solved` is called when the last shot is
  /// done everywhere.
  Root(const Common& common, const Node& node, const std::vector<Node>& nodes,
       std::function<void()> on_solved)
      : Application(common, node), nodes_(nodes), on_solved_(std::move(on_solved)) {}
  void run() override;

  const std::vector<Frame>& frames() const { return frames_; }
  int shots() const { return shots_; }

 private:
  bool is_over(const Candidate& best) const;
  bool is_time_to_show() const;
  void take_frame(const Candidate& best);
  void take_vertices(const Node& node, std::vector<radiosity::Rgb>& vertices);

  const std::vector<Node>& nodes_;
  std::function<void()> on_solved_;
  std::vector<Frame> frames_;
  int shots_ = 0;
};

}  // namespace amp
