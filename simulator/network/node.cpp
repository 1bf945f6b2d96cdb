#include "simulator/network/node.hpp"

namespace network {

std::string_view to_string(Returned reason) {
  constexpr std::string_view names[] = {"delivered", "no such processor", "no such process there",
                                        "no way is left"};
  return names[static_cast<int>(reason)];
}

RouterUse& RouterUse::operator+=(const RouterUse& other) {
  taken += other.taken;
  passed += other.passed;
  delivered += other.delivered;
  returned += other.returned;
  lost += other.lost;
  most_held = std::max(most_held, other.most_held);
  return *this;
}

occam::ChannelBase& channel_of(const WayIn& input) {
  const Node& node = *input.node;
  if (input.way < CLIENT) return *node.link_in[input.way];
  return *node.client_in[input.way - CLIENT];
}

std::optional<Message> input_from(const WayIn& input) { return input.node->take(input.way); }

std::vector<int> Node::ways() const {
  std::vector<int> ways;
  for (int port = 0; port < topologies::PORTS; ++port)
    if (link_in[port]) ways.push_back(port);
  for (int n = 0; n < static_cast<int>(client_in.size()); ++n) ways.push_back(CLIENT + n);
  return ways;
}

std::vector<WayIn> Node::inputs() {
  std::vector<WayIn> inputs;
  for (const int way : ways()) inputs.push_back({this, way});
  return inputs;
}

std::optional<Message> Node::take(int way) {
  if (way >= CLIENT) {
    ++use.taken;
    return client_in[way - CLIENT]->in().message;
  }
  auto message = in_or_fail(*link_in[way]);
  if (message) ++message->links;
  return message;
}

bool Node::pass(int way, const Message& message) {
  if (way < CLIENT) return out_or_fail(*link_out[way], message);
  ++(message.returned == Returned::no ? use.delivered : use.returned);
  out(*client_out[way - CLIENT], Handed{message, pointers});
  return true;
}

int Node::client_of(int process) const {
  for (std::size_t n = 0; n < processes.size(); ++n)
    if (process >= 0 && process < MAX_PROCESSES && (processes[n] >> process & 1U))
      return CLIENT + static_cast<int>(n);
  return NO_WAY;
}

void Node::turn_back(Message& message, Returned reason) {
  std::swap(message.to, message.from);
  message.to.mode = Mode::unicast;
  message.returned = reason;
}

WaysOut Node::find_ways_out(Message& message, int came_by) {
  occam::this_process().charge(look_up);
  const bool from_link = came_by >= 0 && came_by < CLIENT;
  WaysOut ways;
  if (message.to.mode == Mode::global) {
    if (!from_link) {
      message.tree = routing->epoch();
      note_unreached(message);
    }
    for (const int port : routing->tree_ports(message.tree, message.from.processor, id))
      ways.add(port);
    if (from_link && ways.count > 0) ++use.passed;
    if (const int client = client_of(message.to.process); from_link && client != NO_WAY)
      ways.add(client);
    return ways;
  }
  for (;;) {
    const int to = message.to.processor, client = client_of(message.to.process);
    const bool is_offered = message.to.mode == Mode::in_path_to && from_link;
    if (client != NO_WAY && (to == id || is_offered)) {
      ways.add(client);
      return ways;
    }
    const bool exists = to >= 0 && to < routing->processors();
    if (const int port = exists ? routing->port_to(id, to) : -1; port >= 0) {
      if (from_link) ++use.passed;
      ways.add(port);
      return ways;
    }
    if (message.returned != Returned::no) {
      ++use.lost;
      return ways;
    }
    turn_back(message, !exists    ? Returned::no_processor
                       : to == id ? Returned::no_process
                                  : Returned::no_route);
  }
}

void Node::note_unreached(const Message& message) {
  if (message.tree == 0) return;  // no link has been cut
  const auto reached = routing->below(message.tree, id, id);
  for (int to = 0; to < routing->processors(); ++to) {
    if (std::ranges::find(reached, to) != reached.end()) continue;
    unreached_.push_back(message);
    unreached_.back().to = {to, message.to.process, Mode::unicast};
  }
}

std::vector<Message> Node::send_around(Message message, int way) {
  std::vector<Message> instead;
  if (message.to.mode == Mode::global) {
    for (const int processor :
         routing->below(message.tree, message.from.processor, routing->neighbour(id, way))) {
      instead.push_back(message);
      instead.back().to.processor = processor;
      instead.back().to.mode = Mode::unicast;
    }
  } else {
    instead.push_back(std::move(message));
  }
  return instead;
}

void Node::charge_shared_buffer() const {
  if (pointers) occam::this_process().charge(buffer_step + buffer_step);
}

void Node::charge_step(const Message& message) const {
  occam::this_process().charge(fifo_step);
  if (pointers) return;
  const auto words = static_cast<std::int64_t>((message.bytes() + 3) / 4);
  occam::this_process().charge(copy_setup + words * copy_word);
}

void Node::hold(const Message& message) {
  charge_step(message);
  if (++held > buffers)
    throw Overflow(processor->name(), occam::this_process().own_time(),
                   fmt::format("the router of {} has no room for another message: it holds {}",
                               processor->name(), buffers));
  use.most_held = std::max(use.most_held, held);
}

void Node::release(const Message& message) {
  charge_step(message);
  --held;
}

}  // namespace network
