#include "simulator/network/node.hpp"

#include "base/random.hpp"

namespace network {

std::string_view to_string(Returned reason) {
  constexpr std::string_view names[] = {"delivered", "no such processor", "no such process there",
                                        "no path is left"};
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

RouterCosts::RouterCosts(const machine::Model& model)
    : route_found(get_compiled(model, "route_found")),
      tree_way_looked_at(get_compiled(model, "tree_way_looked_at")),
      way_served(get_compiled(model, "way_served")),
      fifo_looked_at(get_compiled(model, "fifo_looked_at")),
      fifo_step(get_compiled(model, "fifo_step")),
      buffer_shared(get_compiled(model, "buffer_shared")),
      copy_setup(get_instruction(model, "move_setup")),
      copy_word(model.channel.copy_word) {}

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
  occam::Cycles spent = costs.route_found;
  if (message.to.mode == Mode::global) spent += topologies::PORTS * costs.tree_way_looked_at;
  const WaysOut ways = determine_ways(message, came_by);
  const auto n = static_cast<std::int64_t>(std::max<std::size_t>(1, ways.count));
  if (pointers) spent += 2 * n * costs.buffer_shared;
  occam::this_process().charge(spent);
  return ways;
}

WaysOut Node::determine_ways(Message& message, int came_by) {
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
    // After a cut, the route of a message may lead through the message's sender again. A sender is
    // never offered its own message.
    const bool is_offered =
        message.to.mode == Mode::in_path_to && from_link && message.from.processor != id;
    if (client != NO_WAY && (to == id || is_offered)) {
      ways.add(client);
      return ways;
    }
    const bool exists = to >= 0 && to < routing->processors();
    if (const int port = exists ? routing->port_to(id, to) : -1; port >= 0) {
      if (from_link) ++use.passed;
      ways.add(choose_link(message, port));
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

// Chooses one of several parallel links to a neighbour. `port` is the lowest port to that
// neighbour. The choice depends only on the sending and the receiving process, so that messages
// between the two stay in order.
int Node::choose_link(const Message& message, int port) const {
  const int links = routing->links_beside(id, port);
  if (links == 1) return port;
  std::uint64_t mixed = 0;
  for (const int part :
       {message.from.processor, message.from.process, message.to.processor, message.to.process})
    mixed = base::random_at(mixed, static_cast<std::uint64_t>(part));
  for (auto turns = mixed % static_cast<std::uint64_t>(links); turns > 0; --turns)
    port = routing->beside(id, port);
  return port;
}

void Node::note_unreached(const Message& message) {
  if (message.tree == 0) return;  // tree 0, made before any cut, covers all processors
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

void Node::charge_empty_fifo() const { occam::this_process().charge(costs.fifo_looked_at); }

void Node::charge_step(const Message& message) const {
  occam::this_process().charge(costs.fifo_step);
  if (pointers) return;
  const auto words = static_cast<std::int64_t>((message.bytes() + 3) / 4);
  occam::this_process().charge(costs.copy_setup + words * costs.copy_word);
}

void Node::hold(const Message& message) {
  charge_step(message);
  if (++held > buffers)
    throw Overflow(
        processor->name(), occam::this_process().own_time(),
        fmt::format("the router of {} has no free buffer for another message: all {} are in use",
                    processor->name(), buffers));
  use.most_held = std::max(use.most_held, held);
}

void Node::release(const Message& message) {
  charge_step(message);
  --held;
}

}  // namespace network
