#include "simulator/radiosity/root.hpp"

#include "simulator/machine/process.hpp"

namespace amp {

void Root::run() {
  Candidate best = reduce();
  for (; !is_over(best); best = reduce()) {
    if (is_time_to_show()) take_frame(best);
    send(network::make_global(AMP_PROCESS), *best.shot);
    shoot(*best.shot);
    ++shots_;
  }
  machine::this_process().sync();
  on_solved_();
  take_frame(best);
  send(network::make_global(AMP_PROCESS), Stop{});
}

// The shots end as in radiosity::solve.
bool Root::is_over(const Candidate& best) const {
  const auto& solve = common_.params.solve;
  return shots_ >= solve.shots || eval_share(best.unshot) <= solve.tolerance || !best.shot;
}

bool Root::is_time_to_show() const {
  const int every = common_.params.show_every;
  return every > 0 && shots_ > 0 && shots_ % every == 0;
}

// Polls the processors one after the other, a message at a time (thesis, 5.3): no more can be on
// its way than routers have room for.
void Root::take_frame(const Candidate& best) {
  Frame frame;
  frame.shots = shots_;
  frame.unshot = eval_share(best.unshot);
  frame.ambient = eval_ambient(common_.mesh, best.unshot);
  frame.vertices.resize(common_.mesh.vertices.size());
  for (const Node& node : nodes_) take_vertices(node, frame.vertices);
  frame.at_s = machine::this_process().now().value;
  frames_.push_back(std::move(frame));
}

void Root::take_vertices(const Node& node, std::vector<radiosity::Rgb>& vertices) {
  const auto& theirs = node.share.vertices;
  if (node.id == node_.id) {
    for (const auto v : theirs) vertices[v] = state_.radiosity[v];
    return;
  }
  for (std::size_t first = 0; first < theirs.size();) {
    send({node.id, AMP_PROCESS}, Show{first});
    const network::Message message = wait_message();
    for (const auto& value : std::get<Shown>(read(message)).values)
      vertices[theirs[first++]] = value;
  }
}

}  // namespace amp
