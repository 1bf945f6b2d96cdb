#include "simulator/radiosity/application.hpp"

#include <algorithm>

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
  else if (!std::holds_alternative<Stop>(read(message)))
    keep(message);
  return !std::holds_alternative<Stop>(read(message));
}

// What comes from others who are ahead.
void Application::keep(const Message& message) {
  if (const auto* candidate = std::get_if<Candidate>(&read(message)))
    candidates_.push_back(*candidate);
  else
    borders_.push_back(message);
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
  const auto& patches = node_.share.patches;
  charge([&](Work& work) {
    best.shot = find_shot(common_.mesh, state_, patches, work);
    best.unshot = sum_unshot(common_.mesh, state_, patches);
  });
  return best;
}

void Application::shoot(const Shot& shot) {
  const radiosity::Patch& sender = common_.mesh.patches[shot.patch];
  if (common_.items)
    shoot_at_shared(shot);
  else
    charge([&](Work& work) {
      const radiosity::Eye eye{common_.mesh, common_.params.solve.factor};
      light(eye, sender, shot.radiosity, work);
    });
  give();
  wait_for_borders();
  charge([&](Work& work) {
    settle(common_.mesh, shot, node_.share.patches, common_.params.solve.mean, state_, work);
  });
  charged_.emplace_back();
}

// What others need of its vertices.
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
    const auto& given = std::get<Given>(read(message));
    const auto border = std::ranges::find(node_.share.in, message.from.processor, &Border::other);
    for (std::size_t i = 0; i < given.values.size(); ++i)
      state_.received[border->vertices[given.first + i]] = given.values[i];
  }
  borders_.clear();
}

void Application::light(const radiosity::Eye& eye, const radiosity::Patch& sender,
                        const radiosity::Rgb& radiosity, Work& work) {
  receive(eye, sender, radiosity, node_.share.vertices, state_, work);
  if (common_.params.solve.mean == radiosity::Mean::simpson)
    receive_in_centres(eye, sender, radiosity, node_.share.patches, state_, work);
}

// The same with geometry that may be elsewhere: what is done is charged between accesses.
void Application::shoot_at_shared(const Shot& shot) {
  const radiosity::Patch& sender = common_.mesh.patches[shot.patch];
  Work work;
  shared_memory::SceneReader reader(*common_.items, *node_.manager, common_.costs);
  const radiosity::Eye eye{common_.mesh, common_.params.solve.factor, &reader};
  light(eye, sender, shot.radiosity, work);
  reader.charge(work);
  charged_.back() += reader.charged();
  work_ += work;
}

// The vertices from `first` on, as many as a message takes.
Shown Application::show(const Show& asked) const {
  const auto& vertices = node_.share.vertices;
  Shown shown{asked.first, {}};
  for (auto i = asked.first; i < vertices.size() && shown.values.size() < MessageBytes::MOST; ++i)
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

// Of a message's identification, and of the colours that go into it or out of it.
void Application::charge_message(Cycles identification, const AmpMessage::Content& content) {
  std::size_t colours = 0;
  if (const auto* given = std::get_if<Given>(&content)) colours = given->values.size();
  if (const auto* shown = std::get_if<Shown>(&content)) colours = shown->values.size();
  const auto each = common_.colour_copied.value;
  machine::this_process().charge(
      {identification.value + each * static_cast<std::int64_t>(colours)});
}

Message Application::wait_message() {
  Message message = node_.manager ? node_.manager->serve_at_once() : node_.client->receive();
  charge_message(common_.message_read, read(message));
  return message;
}

void Application::send(network::Address to, AmpMessage::Content content) {
  Message message;
  message.to = to;
  message.from.process = AMP_PROCESS;
  message.length = common_.bytes.of(content);
  charge_message(common_.message_made, content);
  message.contents = std::make_shared<const AmpMessage>(std::move(content));
  node_.client->send(std::move(message));
}

}  // namespace amp
