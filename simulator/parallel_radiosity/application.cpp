#include "simulator/parallel_radiosity/application.hpp"

#include "simulator/occam/case_of.hpp"

namespace parallel_radiosity {

using network::Message;
using occam::case_of;
using radiosity::Shot;
using radiosity::State;
using renderer::Work;

namespace {

kernels::KernelCost make_cost(const char* name, const Setup& setup) {
  const auto costs_of = [](const machine::Model& its) -> machine::OperationCosts {
    return {its, "radiosity", renderer::op_names()};
  };
  return {name, {setup.model, costs_of}, setup.cycles_per_host_s};
}

}  // namespace

Kernels::Kernels(const Setup& setup, const radiosity::Mesh& mesh, const Params& params)
    : choose(make_cost("choose", setup)),
      receive(make_cost("receive", setup)),
      settle(make_cost("settle", setup)),
      draw(make_cost("draw", setup)) {
  if (setup.cycles_per_host_s) scratch = make_state(mesh, params.solve.sends);
}

// Copying a colour between a table and a message takes a block move of the colour's words.
MessageWork::MessageWork(const machine::Model& model)
    : identification(kernels::message_costs(model)),
      colour_copied{get_instruction(model, "move_setup").value +
                    static_cast<std::int64_t>(get_bytes(model, "colour") / 4) *
                        model.channel.copy_word.value} {}

Application::Application(const Common& common, const Node& node)
    : common_(common), node_(node), state_(make_state(common.mesh, common.params.solve.sends)) {}

void Application::run() {
  for (bool going = true; going;) {
    send({node_.parent, AMP_PROCESS}, reduce());
    for (bool between_shots = true; between_shots;) {
      const Message message = wait_message();
      case_of(
          read<AmpMessage>(message),
          [&](const Shot& shot) {
            shoot(shot);
            between_shots = false;
          },
          [&](const Show& asked) {
            send({message.from.processor, AMP_PROCESS}, show(asked));
          },
          [&](Stop) { between_shots = going = false; }, [&](const auto&) { keep(message); });
    }
  }
}

// Stores a message that has arrived before this process needs it, because its sender is ahead.
void Application::keep(const Message& message) {
  case_of(
      read<AmpMessage>(message),
      [&](const Candidate& candidate) { candidates_.push_back(candidate); },
      [&](const auto&) { borders_.push_back(message); });
}

Candidate Application::reduce() {
  Candidate best = find_best();
  while (candidates_.size() < node_.children) keep(wait_message());
  for (const Candidate& candidate : candidates_) best += candidate;
  candidates_.clear();
  return best;
}

Candidate Application::find_best() {
  Candidate best;
  auto& kernels = common_.kernels;
  charge(kernels.choose, best, kernels.scratch_candidate, [this](Candidate& found, Work& work) {
    const auto& patches = node_.share.patches;
    found.shot = find_shot(common_.mesh, state_, patches, work);
    found.unshot = sum_unshot(common_.mesh, state_, patches);
  });
  return best;
}

void Application::shoot(const Shot& shot) {
  auto& kernels = common_.kernels;
  if (common_.items)
    shoot_at_shared(shot);
  else
    charge(kernels.receive, state_, kernels.scratch, [this, shot](State& state, Work& work) {
      light({common_.mesh, common_.params.solve.factor}, shot, state, work);
    });
  give();
  wait_for_borders();
  charge(kernels.settle, state_, kernels.scratch, [this, shot](State& state, Work& work) {
    settle(common_.mesh, shot, node_.share.patches, common_.params.solve.mean, state, work);
  });
  charged_s_.emplace_back();
}

// Sends the light that shared vertices have received to the other processors that need it.
void Application::give() {
  for (const Border& border : node_.share.out)
    for (std::size_t first = 0; first < border.vertices.size(); first += MessageBytes::MOST) {
      Given given{first, {}};
      const auto end = std::min(border.vertices.size(), first + MessageBytes::MOST);
      for (auto i = first; i < end; ++i)
        given.values.push_back(state_.received[border.vertices[i]]);
      send({border.other, AMP_PROCESS}, std::move(given));
    }
}

void Application::wait_for_borders() {
  std::size_t missing = 0;
  for (const Border& border : node_.share.in)
    missing += (border.vertices.size() + MessageBytes::MOST - 1) / MessageBytes::MOST;
  while (borders_.size() < missing) keep(wait_message());
  for (const Message& message : borders_) {
    const auto& given = std::get<Given>(read<AmpMessage>(message));
    const auto border = std::ranges::find(node_.share.in, message.from.processor, &Border::other);
    for (std::size_t i = 0; i < given.values.size(); ++i)
      state_.received[border->vertices[given.first + i]] = given.values[i];
  }
  borders_.clear();
}

void Application::light(const radiosity::Eye& eye, const Shot& shot, State& state,
                        Work& work) const {
  const radiosity::Sender sender(common_.mesh.patches[shot.patch], shot.glow);
  receive(eye, sender, node_.share.vertices, state, work);
  if (common_.params.solve.mean == radiosity::Mean::simpson)
    receive_in_centres(eye, sender, node_.share.patches, state, work);
}

// Executes `light` on geometry that may be on other processors. Before each access to the geometry,
// charges the work done since the previous access.
void Application::shoot_at_shared(const Shot& shot) {
  auto& kernels = common_.kernels;
  const double scale =
      kernels.receive.eval_scale(kernels.scratch, [this, shot](State& state, Work& work) {
        light({common_.mesh, common_.params.solve.factor}, shot, state, work);
      });
  Work work;
  shared_memory::SceneReader reader(*common_.items, *node_.manager, kernels.receive.counted(),
                                    scale);
  light({common_.mesh, common_.params.solve.factor, &reader}, shot, state_, work);
  reader.charge(work);
  note_charged(reader.charged());
  work_ += work;
}

// Returns the radiosity of vertices from index `asked.first` on, as many as fit into a message.
Displayed Application::show(const Show& asked) const {
  const auto& vertices = node_.share.vertices;
  Displayed shown{asked.first, {}};
  for (auto i = asked.first; i < vertices.size() && shown.values.size() < MessageBytes::MOST; ++i)
    shown.values.push_back(state_.radiosity[vertices[i]]);
  return shown;
}

template <class Changed, class Kernel>
void Application::charge(kernels::KernelCost& cost, Changed& state, Changed& scratch,
                         Kernel kernel) {
  const Cycles before = cost.charged();
  work_ += cost(state, scratch, kernel);
  note_charged({cost.charged().value - before.value});
}

void Application::note_charged(Cycles cycles) {
  kernel_cycles_ += cycles;
  const auto& cpu = machine::this_process().processor().model().cpu;
  charged_s_.back() += static_cast<double>(cycles.value) / cpu.clock.value;
}

// Charges the making or the reading of a message's header, and the copying of the message's
// colours.
void Application::charge_message(Cycles kernels::MessageCosts::*identification,
                                 const AmpMessage& content) {
  const auto colours = static_cast<std::int64_t>(count_colours(content));
  const MessageWork& work = common_.messages.here();
  machine::this_process().charge(work.identification.*identification +
                                 colours * work.colour_copied);
}

Message Application::wait_message() {
  Message message = node_.manager ? node_.manager->serve_at_once() : node_.client->receive();
  charge_message(&kernels::MessageCosts::read, read<AmpMessage>(message));
  return message;
}

void Application::send(network::Address to, AmpMessage content) {
  charge_message(&kernels::MessageCosts::made, content);
  const auto length = common_.bytes.of(content);
  node_.client->send(network::make_message(AMP_PROCESS, to, length, std::move(content)));
}

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

// True if the solution is complete. The condition is that of radiosity::solve.
bool Root::is_over(const Candidate& best) const {
  const auto& solve = common_.params.solve;
  return shots_ >= solve.shots || eval_share(best.unshot) <= solve.tolerance || !best.shot;
}

bool Root::is_time_to_show() const {
  const int every = common_.params.show_every;
  return every > 0 && shots_ > 0 && shots_ % every == 0;
}

// Collects a frame from one processor after another (thesis, 5.3), so that the routers' buffers
// suffice.
void Root::take_frame(const Candidate& best) {
  Frame frame;
  frame.shots = shots_;
  frame.unshot = eval_share(best.unshot);
  frame.ambient = eval_ambient(common_.mesh, best.unshot);
  frame.vertices.resize(common_.mesh.vertices.size());
  for (const Node& node : nodes_) take_vertices(node, frame.vertices);
  if (common_.params.draw)
    common_.kernels.draw([&draw = common_.params.draw, frame](Work&) { return draw(frame), 0; });
  frame.at_s = machine::this_process().now().value;
  observe::notify_change(common_.setup.monitor, {frame.at_s});
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
    const Message message = wait_message();
    for (const auto& value : std::get<Displayed>(read<AmpMessage>(message)).values)
      vertices[theirs[first++]] = value;
  }
}

}  // namespace parallel_radiosity
