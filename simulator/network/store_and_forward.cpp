#include "simulator/network/store_and_forward.hpp"

#include <boost/circular_buffer.hpp>

#include "simulator/network/join.hpp"
#include "simulator/occam/alt.hpp"

namespace network {

using machine::Priority;

namespace {

std::string name(const machine::Processor& on, const char* what, int way) {
  return way < topologies::PORTS ? fmt::format("{}.{}{}", on.name(), what, way)
                                 : fmt::format("{}.{}.client", on.name(), what);
}

template <class Message>
Channel<Message>* soft(std::deque<Channel<Message>>& pool, std::string name) {
  return &pool.emplace_back(std::move(name));
}

// The numbers of a processor's ways: the ports to its neighbours, and the way to its client.
std::vector<int> ways_of(const std::vector<topologies::Neighbour>& around) {
  std::vector<int> ways;
  for (const auto& neighbour : around) ways.push_back(neighbour.port);
  ways.push_back(topologies::PORTS);
  return ways;
}

// Process that stores packets until the sender is free. Updates `longest`, the maximum number of
// packets stored so far.
Proc queue(std::vector<Channel<Pointer>*> inputs, Channel<Signal>& sent,
           Channel<Pointer>& to_sender, std::uint32_t& longest) {
  boost::circular_buffer<Pointer> waiting(4);  // an empty deque would take 600 bytes
  std::size_t favourite = 0;
  bool is_free = true;
  Signal dummy;
  for (;;) {
    co_await alternative(when(!is_free, sent, dummy, [&] { is_free = true; }),
                         each(inputs, favourite, [&](std::size_t input, Pointer packet) {
                           if (waiting.full()) waiting.set_capacity(2 * waiting.size());
                           waiting.push_back(packet);
                           longest = std::max(longest, static_cast<std::uint32_t>(waiting.size()));
                           favourite = (input + 1) % inputs.size();
                         }));
    if (is_free && !waiting.empty()) {
      co_await to_sender.output(waiting.front());
      waiting.pop_front();
      is_free = false;
    }
  }
}

// Process that sends the packets of a queue to a link. If `link` is null, delivers them to the
// client.
Proc send(Channel<Pointer>& from_queue, Channel<Signal>& sent, Channel<Packet>* link,
          Channel<Pointer>& client) {
  for (;;) {
    const Pointer packet = co_await from_queue.input();
    if (link)
      co_await link->output(packet.to);
    else
      co_await client.output(packet);
    co_await sent.output({});
  }
}

}  // namespace

StoreAndForward::StoreAndForward(machine::Machine& machine, const topologies::Topology& topology,
                                 topologies::RoutingTable routes, int first)
    : topology_(topology), routes_(std::move(routes)), parallel_(parallel_ports(topology)) {
  const auto& processors = machine.processors();
  const auto at = [&](int id) -> machine::Processor& { return *processors.at(first + id); };
  const auto joined = join(machine, topology, at);
  const auto around = topologies::neighbours(topology);
  for (int id = 0; id < topology.processors; ++id) {
    const auto& own = at(id).name();
    into_.emplace_back(own + ".into");
    delivered_.emplace_back(own + ".delivered");
    Node& node = nodes_.emplace_back(Node{&at(id)});
    const auto ways = ways_of(around[id]);
    for (int out : ways) {
      node.sent[out] = soft(signals_, name(at(id), "sent", out));
      node.to_sender[out] = soft(pointers_, name(at(id), "to.sender", out));
      for (int in : ways)
        if (in != out || out == CLIENT)
          node.queue_in[out][in] = soft(pointers_, name(at(id), "queue", out));
    }
  }
  for (int id = 0; id < topology.processors; ++id) {
    for (const auto& neighbour : around[id]) {
      auto& link = *joined[neighbour.link][id < neighbour.processor ? 0 : 1];
      Channel<Packet>& channel = links_.emplace_back(link.name(), link);
      start_way_out(id, neighbour.port, &channel);
      start_way_in(neighbour.processor, neighbour.its_port, &channel);
    }
    start_way_out(id, CLIENT, nullptr);
    start_way_in(id, CLIENT, nullptr);
  }
}

void StoreAndForward::start(int id, const char* what, int way, Proc body) {
  machine::Processor& processor = *nodes_[id].processor;
  processor.start(name(processor, what, way), Priority::high, std::move(body)).set_server();
}

void StoreAndForward::start_way_out(int id, int way, Channel<Packet>* link) {
  Node& node = nodes_[id];
  std::vector<Channel<Pointer>*> inputs;
  for (auto* input : node.queue_in[way])
    if (input) inputs.push_back(input);
  auto& sent = *node.sent[way];
  auto& to_sender = *node.to_sender[way];
  start(id, "queue", way, queue(std::move(inputs), sent, to_sender, node.longest_queue));
  start(id, "sender", way, send(to_sender, sent, link, delivered_[id]));
}

void StoreAndForward::start_way_in(int id, int way, Channel<Packet>* link) {
  start(id, "receiver", way, receive(id, way, link));
}

// Chooses the link or client to which a processor passes a packet. If several links lead to the
// next processor, uses them in turn.
int StoreAndForward::take_way_to(int from, int to) {
  if (from == to) return CLIENT;
  auto& turn = nodes_[from].turn[routes_.next_port(from, to)];
  return std::exchange(turn, parallel_[from][turn]);
}

int StoreAndForward::guards_of(int id, int way) const {
  const auto& inputs = nodes_[id].queue_in[way];
  return 1 + static_cast<int>(std::ranges::count_if(inputs, [](auto* c) { return c != nullptr; }));
}

int StoreAndForward::guards_on_the_way(int from, int to) {
  const auto around = topologies::neighbours(topology_);
  int guards = guards_of(to, CLIENT);
  while (from != to) {
    const int port = routes_.next_port(from, to);
    guards += guards_of(from, port);
    from = std::ranges::find(around[from], port, &topologies::Neighbour::port)->processor;
  }
  return guards;
}

// Process that receives packets from a link. If `link` is null, receives the packets of the client.
Proc StoreAndForward::receive(int id, int way, Channel<Packet>* link) {
  const auto& model = nodes_[id].processor->model();
  const std::array look_up{get_instruction(model, "ldl"), get_instruction(model, "ldl"),
                           get_instruction(model, "load")};
  Pointer packet;
  for (;;) {
    if (link)
      packet.to = co_await link->input();
    else
      packet = co_await into_[id].input();
    for (const occam::Cycles instruction : look_up) occam::charge(instruction);
    co_await nodes_[id].queue_in[take_way_to(id, packet.to.to)][way]->output(packet);
  }
}

std::size_t StoreAndForward::longest_queue() const {
  return std::ranges::max(nodes_, {}, &Node::longest_queue).longest_queue;
}

}  // namespace network
