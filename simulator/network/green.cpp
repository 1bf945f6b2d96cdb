// Green's router (S. Green, 1991), adapted to any topology as in the thesis (figures 5.12 to 5.14).
// Each client, and each link to a processor with a lower number, has a sender process. Messages for
// a busy sender wait in its FIFO. On a link to a processor with a higher number, the router itself
// sends, and waits until the message is sent. In a chain of routers that wait for each other, the
// numbers therefore ascend, so the chain is not a cycle.
#include "simulator/network/routers.hpp"
#include "simulator/occam/process.hpp"

namespace network {

namespace {

class GreenRouter {
 public:
  explicit GreenRouter(Node& node) : node_(node), inputs_(node.inputs()) {
    for (const int way : node.ways()) {
      const bool to_lower = way < CLIENT && node.routing->neighbour(node.id, way) < node.id;
      if (!to_lower && way < CLIENT) continue;
      const auto name = fmt::format("{}.sender{}", node.processor->name(), way);
      auto& sender = senders_.emplace_back(way, name);
      sender_of_[way] = &sender;
      from_senders_.push_back(&sender.ready_signal);
      start_server(node, fmt::format("sender{}", way), [this, &sender] { send(sender); });
    }
  }

  // Loop of figure 5.14 of the thesis. Signals from senders that are ready have precedence over
  // inputs. Inputs are served in rotation.
  void run() {
    for (std::size_t favourite = 0; occam::turn(true);)
      pri_alt(each(from_senders_, 0, [&](std::size_t k, Signal) { serve(senders_[k]); }),
              each(inputs_, favourite, [&](std::size_t i, std::optional<Message> message) {
                favourite = (favourite + 1) % inputs_.size();
                if (message) route(std::move(*message), inputs_[i].way);
              }));
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
    std::vector<Message> failed;  // messages that could not be sent because the link was cut
  };

  // The sender process of figure 5.13 of the thesis.
  void send(Sender& sender) {
    while (occam::turn(true)) {
      out(sender.ready_signal, Signal{});
      const Message message = sender.into.in().message;
      if (!node_.pass(sender.way, message)) sender.failed.push_back(message);
    }
  }

  // Called when a sender is ready: passes it the next message of its FIFO, if there is one.
  void serve(Sender& sender) {
    for (auto& message : std::exchange(sender.failed, {}))
      for (auto& again : node_.send_around(std::move(message), sender.way)) route(again, NO_WAY);
    sender.ready = sender.fifo.empty();
    if (sender.ready) return node_.charge_empty_fifo();
    const Message message = std::move(sender.fifo.front());
    sender.fifo.pop_front();
    node_.release(message);
    out(sender.into, Handed{message, node_.pointers});
  }

  void route(Message message, int came_by) {
    for (const int way : node_.find_ways_out(message, came_by)) {
      occam::this_process().charge(node_.costs.way_served);
      Sender* sender = sender_of_.at(way);
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
  const std::vector<WayIn> inputs_;
  std::deque<Sender> senders_;
  std::vector<Channel<Signal>*> from_senders_;
  std::array<Sender*, WAYS> sender_of_{};
};

}  // namespace

void start_green(Node& node) {
  auto router = std::make_shared<GreenRouter>(node);
  start_server(node, "router", [router] { router->run(); });
}

}  // namespace network
