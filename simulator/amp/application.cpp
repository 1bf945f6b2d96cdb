#include "simulator/amp/application.hpp"

#include "simulator/machine/process.hpp"

namespace amp {

using network::Message;
using radiosity::Shot;
using renderer::Work;

const AmpMessage::Content& read(const Message& message) {
  return static_cast<const AmpMessage&>(*message.contents).content;
}

Application::Application(const Common& common, const Node& node)
    : common_(common),
      node_(node),
      state_(make_state(common.mesh)),
      kernel_(common.costs, common.params.cycles_per_host_s, false) {}

void Application::run() {
  for (bool going = true; going;) {
    send({node_.parent, AMP_PROCESS}, reduce());
    Message message = wait_message();
    while (!std::holds_alternative<Shot>(read(message)) && going) {
      going = obey(message);
      if (going) message = wait_message();
    }
    if (going) shoot(std::get<Shot>(read(message)));
  }
}

// What comes between two shots. Returns whether to go on.
bool Application::obey(const Message& message) {
  if (const auto* asked = std::get_if<Show>(&read(message)))
    send({message.from.processor, AMP_PROCESS}, show(*asked));
  else if (const auto* candidate = std::get_if<Candidate>(&read(message)))
    early_.push_back(*candidate);
  return !std::holds_alternative<Stop>(read(message));
}

Candidate Application::reduce() {
  Candidate best = find_best();
  for (const Candidate& candidate : early_) best += candidate;
  for (auto missing = node_.children - early_.size(); missing > 0; --missing)
    best += std::get<Candidate>(read(wait_message()));
  early_.clear();
  return best;
}

Candidate Application::find_best() {
  Candidate best;
  const auto& patches = node_.share.patches;
  charge([&](Work& work) {
    best.shot = find_shot(common_.mesh, state_, patches, work);
    best.unshot = sum_unshot(common_.mesh, state_, patches);
  });
  return best;
}

void Application::shoot(const Shot& shot) {
  if (common_.items)
    shoot_at_shared(shot);
  else
    charge([&](Work& work) {
      const radiosity::Eye eye{common_.mesh, common_.params.solve.factor};
      receive(eye, shot, node_.share.vertices, state_, work);
    });
  charge([&](Work& work) { settle(common_.mesh, shot, node_.share.patches, state_, work); });
  charged_.emplace_back();
}

// The same with geometry that may be elsewhere: what is done is charged between accesses.
void Application::shoot_at_shared(const Shot& shot) {
  Work work;
  iirra::SceneReader reader(*common_.items, *node_.manager, common_.costs);
  const radiosity::Eye eye{common_.mesh, common_.params.solve.factor, &reader};
  receive(eye, shot, node_.share.vertices, state_, work);
  reader.charge(work);
  charged_.back() += reader.charged();
  work_ += work;
}

// The vertices from `first` on, as many as a message takes.
Shown Application::show(const Show& asked) const {
  const auto& vertices = node_.share.vertices;
  Shown shown{asked.first, {}};
  for (auto i = asked.first; i < vertices.size() && shown.values.size() < MessageBytes::SHOWN; ++i)
    shown.values.push_back(state_.radiosity[vertices[i]]);
  return shown;
}

template <class Kernel>
void Application::charge(Kernel kernel) {
  Work work;
  const Cycles before = kernel_.charged();
  kernel_([&] { return kernel(work), 0; }, work);
  charged_.back() += Cycles{kernel_.charged().value - before.value};
  work_ += work;
}

Message Application::wait_message() {
  return node_.manager ? node_.manager->serve_at_once() : node_.client->receive();
}

void Application::send(network::Address to, AmpMessage::Content content) {
  Message message;
  message.to = to;
  message.from.process = AMP_PROCESS;
  message.length = common_.bytes.of(content);
  message.contents = std::make_shared<const AmpMessage>(std::move(content));
  node_.client->send(std::move(message));
}

}  // namespace amp
