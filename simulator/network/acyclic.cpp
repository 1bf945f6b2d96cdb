// Router with acyclic routes, a method of this project. Messages in transit are not queued, so no
// queue on the way can overflow. Each way in has a receiver process, and each link out has a sender
// process. A blocked process also blocks the link from which its message came (back-pressure). This
// cannot deadlock, because the routes are chosen so that links never wait for each other in a cycle
// (make_acyclic_routing). Every route ends at a client's inbox, the only queue that can overflow.
//
//   link in ----> receiver ---.   .---> sender ----> link out
//   link in ----> receiver ----\ /----> sender ----> link out
//   client -----> receiver ----/ \----> inbox -----> deliverer ----> client
#include "simulator/network/routers.hpp"
#include "simulator/occam/process.hpp"

namespace network {

namespace {

// Number of an additional way in. It has channels of its own, for messages that this processor
// sends again.
constexpr int AGAIN = WAYS;

// The inputs of one way out: a channel from each way in. A way out to a client also has an inbox.
struct WayOut {
  std::array<std::unique_ptr<Channel<Handed>>, WAYS + 1> from;  // index: way in, or AGAIN
  std::vector<Channel<Handed>*> inputs;
  std::size_t favourite = 0;
  Channel<Signal> ready;
  Channel<Handed> into;
  std::deque<Message> inbox;

  WayOut(const std::string& processor, int way, const std::vector<int>& ways_in)
      : ready(fmt::format("{}.inbox{}.ready", processor, way)),
        into(fmt::format("{}.inbox{}.into", processor, way)) {
    for (const int in : ways_in) add(in, fmt::format("{}.out{}.{}", processor, way, in));
    add(AGAIN, fmt::format("{}.again{}", processor, way));
  }
  void add(int in, std::string name) {
    from[in] = std::make_unique<Channel<Handed>>(std::move(name));
    inputs.push_back(from[in].get());
  }
};

class AcyclicRouter {
 public:
  explicit AcyclicRouter(Node& node) : node_(node), ways_(node.ways()) {
    for (const int way : ways_)
      outs_.at(way) = std::make_unique<WayOut>(node.processor->name(), way, ways_);
  }

  void start(const std::shared_ptr<AcyclicRouter>& self) {
    for (const int way : ways_) {
      start_server(node_, fmt::format("receiver{}", way), [self, way] { self->receive(way); });
      if (way < CLIENT) {
        start_server(node_, fmt::format("sender{}", way), [self, way] { self->send(way); });
      } else {
        start_server(node_, fmt::format("inbox{}", way), [self, way] { self->keep(way); });
        start_server(node_, fmt::format("deliverer{}", way), [self, way] { self->deliver(way); });
      }
    }
  }

 private:
  void receive(int way) {
    for (bool is_whole = true; occam::turn(is_whole);) {
      auto message = node_.take(way);
      is_whole = message.has_value();
      if (message) hand_on(std::move(*message), way, way);
    }
  }

  // Passes the message to the processes at its ways out. `came_by` is the way by which the message
  // came, or NO_WAY; the channels of the input way `as` are used.
  void hand_on(Message message, int came_by, int as) {
    const Returned before = message.returned;
    const WaysOut ways = node_.find_ways_out(message, came_by);
    const bool turns_back = came_by >= 0 && came_by < CLIENT && message.returned != before;
    if (turns_back && ways.count > 0) return send_later(std::move(message));
    for (auto& left_out : node_.take_unreached()) send_later(std::move(left_out));
    for (const int out_by : ways) {
      occam::this_process().charge(node_.costs.way_served);
      out(*outs_.at(out_by)->from.at(as), Handed{message, node_.pointers});
    }
  }

  // Replicated guards `inputs[i] ? message` over the inputs of a way out. Precedence rotates among
  // them.
  template <class Then>
  static auto each_of(WayOut& way, Then then) {
    return each(way.inputs, way.favourite, [&way, then](std::size_t, Handed handed) {
      way.favourite = (way.favourite + 1) % way.inputs.size();
      then(std::move(handed.message));
    });
  }

  void send(int way) {
    while (occam::turn(true))
      pri_alt(each_of(*outs_.at(way), [&](const Message& message) {
        if (node_.pass(way, message)) return;
        for (auto& again : node_.send_around(message, way)) send_later(std::move(again));
      }));
  }

  void keep(int way) {
    WayOut& client = *outs_.at(way);
    bool is_free = false;
    Signal dummy;
    while (occam::turn(true)) {
      pri_alt(when(!is_free, client.ready, dummy, [&] { is_free = true; }),
              each_of(client, [&](Message message) {
                node_.hold(message);
                client.inbox.push_back(std::move(message));
              }));
      if (!is_free || client.inbox.empty()) continue;
      is_free = false;
      const Message message = std::move(client.inbox.front());
      client.inbox.pop_front();
      node_.release(message);
      out(client.into, Handed{message, node_.pointers});
    }
  }

  void deliver(int way) {
    WayOut& client = *outs_.at(way);
    while (occam::turn(true)) {
      out(client.ready, Signal{});
      node_.pass(way, client.into.in().message);
    }
  }

  // Queues a message that must be sent again, for a temporary process that sends it. No other
  // process waits for the temporary process. If receivers or senders sent such messages, they could
  // wait for each other in a cycle.
  void send_later(Message message) {
    node_.hold(message);
    again_.push_back(std::move(message));
    if (std::exchange(sends_again_, true)) return;
    start_server(node_, "again", [this] {
      while (!again_.empty()) {
        Message next = std::move(again_.front());
        again_.pop_front();
        node_.release(next);
        hand_on(std::move(next), NO_WAY, AGAIN);
      }
      sends_again_ = false;
    });
  }

  Node& node_;
  std::vector<int> ways_;
  std::array<std::unique_ptr<WayOut>, WAYS> outs_;
  std::deque<Message> again_;
  bool sends_again_ = false;
};

}  // namespace

void start_acyclic(Node& node) {
  const auto router = std::make_shared<AcyclicRouter>(node);
  router->start(router);
}

}  // namespace network
