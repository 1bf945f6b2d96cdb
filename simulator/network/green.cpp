// Green's method (S. Green, 1991) for any topology, as the thesis has it (figures 5.12 to 5.14): a
// link to a processor of a lower number, and a client, has a sender, which waits in the router's
// place; messages for a busy sender wait in its FIFO. On a link to a higher number the router waits
// itself: such waiting climbs the numbers, and ends.
#include "simulator/network/routers.hpp"

namespace network {

namespace {

class Router {
 public:
  explicit Router(Node& node) : node_(node), inputs_(node) {
    for (const int way : node.ways()) {
      const bool to_lower = way < CLIENT && node.routing->neighbour(node.id, way) < node.id;
      if (!to_lower && way < CLIENT) continue;
      const auto name = fmt::format("{}.sender{}", node.processor->name(), way);
      auto& sender = senders_.emplace_back(way, name);
      sender_of_[way] = &sender;
      start_server(node, fmt::format("sender{}", way), [this, &sender] { send(sender); });
    }
  }

  void run() {
    std::array<Guard, 2 * WAYS> guards;
    const std::size_t n = senders_.size();
    for (;;) {
      for (std::size_t k = 0; k < n; ++k) guards.at(k) = Guard(&senders_[k].ready_signal);
      for (std::size_t i = 0; i < inputs_.count(); ++i) guards.at(n + i) = inputs_.guard(i);
      const std::size_t chosen = occam::select({guards.data(), n + inputs_.count()});
      if (chosen < n) {
        serve(senders_[chosen]);
      } else {
        const int way = inputs_.way(chosen - n);
        inputs_.next_turn();
        if (auto message = node_.take(way)) route(std::move(*message), way);
      }
    }
  }

 private:
  struct Sender {
    Sender(int way, const std::string& name)
        : way(way), ready_signal(name + ".ready"), into(name + ".into") {}
    int way;
    Channel<Signal> ready_signal;
    Channel<Handed> into;
    std::deque<Message> fifo;
    bool ready = false;
    std::vector<Message> failed;  // that it could not send: its link is cut
  };

  // Figure 5.13.
  void send(Sender& sender) {
    for (;;) {
      out(sender.ready_signal, Signal{});
      const Message message = sender.into.in().message;
      if (!node_.pass(sender.way, message)) sender.failed.push_back(message);
    }
  }

  // The sender has sent: the next of its FIFO, if there is one.
  void serve(Sender& sender) {
    in(sender.ready_signal);
    for (auto& message : std::exchange(sender.failed, {}))
      for (auto& again : node_.send_around(std::move(message), sender.way)) route(again, NO_WAY);
    sender.ready = sender.fifo.empty();
    if (sender.ready) return;
    const Message message = std::move(sender.fifo.front());
    sender.fifo.pop_front();
    node_.release(message);
    out(sender.into, Handed{message, node_.pointers});
  }

  void route(Message message, int came_by) {
    if (node_.pointers)
      occam::this_process().charge(node_.buffer_step + node_.buffer_step);  // taken, given back
    for (const int way : node_.find_ways_out(message, came_by)) {
      Sender* sender = sender_of_.at(static_cast<std::size_t>(way));
      if (!sender) {
        if (!node_.pass(way, message))
          for (auto& again : node_.send_around(message, way)) route(again, NO_WAY);
      } else if (std::exchange(sender->ready, false)) {
        out(sender->into, Handed{message, node_.pointers});
      } else {
        node_.hold(message);
        sender->fifo.push_back(message);
      }
    }
    for (auto& left_out : node_.take_unreached()) route(std::move(left_out), NO_WAY);
  }

  Node& node_;
  FairInputs inputs_;
  std::deque<Sender> senders_;
  std::array<Sender*, WAYS> sender_of_{};
};

}  // namespace

void start_green(Node& node) {
  auto router = std::make_shared<Router>(node);
  start_server(node, "router", [router] { router->run(); });
}

}  // namespace network
