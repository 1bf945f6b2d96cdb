#pragma once
// The application process of a processor. In AMP, the system of the thesis's chapter 5.1,
// computing, tasks, data and control are separate processes besides the router (figure 5.3). Here
// they are a single process, as section 5.1 proposes for IIRRA. For each shot (one patch
// distributing its light) it executes:
//   SEQ
//     SEQ i = 0 FOR children         -- in the order of arrival
//       from.router ? candidate
//     parent ! brightest
//     from.router ? shot             -- GLOBAL, from the root; or Show; or Stop
//     receive
//     others ! border, others ? border
//     settle
#include "simulator/kernels/by_model.hpp"
#include "simulator/kernels/kernels.hpp"
#include "simulator/parallel_radiosity/messages.hpp"
#include "simulator/parallel_radiosity/radiosity.hpp"
#include "simulator/shared_memory/scene_items.hpp"

namespace parallel_radiosity {

using machine::Cycles;

/// Kernels (numerical functions) that all processes share. If costs are host times, the kernels run
/// again on the scratch objects to be timed.
struct Kernels {
  Kernels(const Setup& setup, const radiosity::Mesh& mesh, const Params& params);
  kernels::KernelCost choose, receive, settle, draw;
  Candidate scratch_candidate;
  radiosity::State scratch;
};

/// Costs of a message for its sender or its receiver, without those of the routers.
struct MessageWork {
  explicit MessageWork(const machine::Model& model);
  kernels::MessageCosts identification;
  Cycles colour_copied;  ///< cost of copying one colour into a message or out of it
};

/// State that all processes share.
struct Common {
  const radiosity::Mesh& mesh;
  const Setup& setup;
  const Params& params;
  MessageBytes bytes;
  Kernels& kernels;
  /// Set only if the geometry is distributed over the processors.
  std::optional<shared_memory::SceneItems> items;
  int root = 0;
  kernels::ByModel<MessageWork> messages;
};

/// Position of a processor in the reduction tree, and its access to the network.
struct Node {
  int id = 0, parent = 0;  ///< the root is its own parent
  std::size_t children = 0;
  Share share;
  network::Client* client = nullptr;
  /// Set only if the geometry is distributed over the processors.
  shared_memory::DataManager* manager = nullptr;
};

class Application {
 public:
  Application(const Common& common, const Node& node);
  virtual ~Application() = default;
  /// Body of the process. Returns when it has received Stop.
  virtual void run();

  const Node& node() const { return node_; }
  const radiosity::State& state() const { return state_; }
  const renderer::Work& work() const { return work_; }
  Cycles kernel_cycles() const { return kernel_cycles_; }
  /// Duration in seconds of the cycles charged for this process's kernels, by shot.
  const std::vector<double>& charged_s() const { return charged_s_; }

 protected:
  /// Returns the brightest patch among those of this processor and of its subtree.
  Candidate reduce();
  void shoot(const radiosity::Shot& shot);
  network::Message wait_message();
  void charge_message(Cycles kernels::MessageCosts::*identification, const AmpMessage& content);
  void send(network::Address to, AmpMessage content);

  const Common& common_;
  const Node node_;
  radiosity::State state_;  ///< only entries of this processor's own vertices and patches are valid

 private:
  Candidate find_best();
  void shoot_at_shared(const radiosity::Shot& shot);
  Displayed show(const Show& asked) const;
  void light(const radiosity::Eye& eye, const radiosity::Shot& shot, radiosity::State& state,
             renderer::Work& work) const;
  void give();
  void wait_for_borders();
  void keep(const network::Message& message);
  void note_charged(Cycles cycles);
  template <class Changed, class Kernel>
  void charge(kernels::KernelCost& cost, Changed& state, Changed& scratch, Kernel kernel);

  renderer::Work work_;
  Cycles kernel_cycles_{};
  std::vector<double> charged_s_ = {0};
  // Messages that arrived before they were needed: candidates from children, and light from
  // processors that share vertices with this one.
  std::vector<Candidate> candidates_;
  std::vector<network::Message> borders_;
};

/// The application at the root of the reduction tree. Like all others it computes a part of the
/// solution. It also selects the patch that shoots next, and it is the display.
class Root : public Application {
 public:
  /// `nodes` are the nodes of all processors. `on_solved` is called when all processors have
  /// finished the last shot.
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

}  // namespace parallel_radiosity
