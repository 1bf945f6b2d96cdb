// Our own method: no FIFOs on the way, so nothing to overflow there. A receiver for each way in
// and a sender for each link out; who cannot go on waits, and the link behind it too. Routes are
// such that links never wait for each other in a cycle (see make_acyclic_routing), and every route
// ends at an inbox, the one place that can overflow.
//
//   link in ----> receiver ---.   .---> sender ----> link out
//   link in ----> receiver ----\ /----> sender ----> link out
//   client -----> receiver ----/ \----> inbox -----> deliverer ----> client
#include "simulator/network/routers.hpp"

namespace network {

namespace {

// Messages that turn back here, or whose link has been cut, come on a way of their own.
constexpr int AGAIN = WAYS;

class Router {
 public:
  explicit Router(Node& node) : node_(node), ways_(node.ways()) {
    const auto own = [&](const char* what, int way) {
      return fmt::format("{}.{}{}", node.processor->name(), what, way);
    };
    for (const int out : ways_) {
      inputs_.at(out) = std::make_unique<Inputs>();
      for (const int in : ways_)
        inputs_[out]->from.emplace_back(in, own("out", out) + own(".", in));
      inputs_[out]->from.emplace_back(AGAIN, own("again", out));
      if (out >= CLIENT) delivery_.at(out - CLIENT) = std::make_unique<Delivery>(own("inbox", out));
    }
  }

  void start(const std::shared_ptr<Router>& self) {
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
  struct Input {
    Input(int came_by, std::string name) : came_by(came_by), channel(std::move(name)) {}
    int came_by;
    Channel<Handed> channel;
  };
  struct Inputs {
    std::deque<Input> from;
    std::size_t favourite = 0;
    Input& at(std::size_t i) { return from[(favourite + i) % from.size()]; }
  };
  struct Delivery {
    explicit Delivery(const std::string& name) : ready(name + ".ready"), into(name + ".into") {}
    Channel<Signal> ready;
    Channel<Handed> into;
    std::deque<Message> inbox;
  };

  void receive(int way) {
    while (auto message = node_.take(way)) hand_on(std::move(*message), way, way);
  }

  // To the senders of the ways that it takes; `as` is whose channels into them are used.
  void hand_on(Message message, int came_by, int as) {
    if (node_.pointers)  // a buffer taken from those that all share, and given back
      occam::this_process().charge(node_.buffer_step + node_.buffer_step);
    const Returned before = message.returned;
    const WaysOut ways = node_.find_ways_out(message, came_by);
    const bool turns_back = came_by >= 0 && came_by < CLIENT && message.returned != before;
    if (turns_back && ways.count > 0) return send_later(std::move(message));
    for (auto& left_out : node_.take_unreached()) send_later(std::move(left_out));
    for (const int out_by : ways)
      for (Input& input : inputs_.at(out_by)->from)
        if (input.came_by == as) out(input.channel, Handed{message, node_.pointers});
  }

  // Guards for every input, from number `first` on.
  template <std::size_t N>
  static std::size_t wait(Inputs& inputs, std::array<Guard, N>& guards, std::size_t first) {
    const std::size_t n = inputs.from.size();
    for (std::size_t i = 0; i < n; ++i) guards.at(first + i) = Guard(&inputs.at(i).channel);
    return occam::select({guards.data(), first + n});
  }
  static Message take(Inputs& inputs, std::size_t input) {
    Message message = inputs.at(input).channel.in().message;
    inputs.favourite = (inputs.favourite + 1) % inputs.from.size();
    return message;
  }

  void send(int way) {
    Inputs& inputs = *inputs_.at(way);
    std::array<Guard, WAYS + 1> guards;
    for (;;) {
      const Message message = take(inputs, wait(inputs, guards, 0));
      if (node_.pass(way, message)) continue;
      for (auto& again : node_.send_around(message, way)) send_later(std::move(again));
    }
  }

  void keep(int way) {
    Inputs& inputs = *inputs_.at(way);
    Delivery& delivery = *delivery_.at(way - CLIENT);
    std::array<Guard, WAYS + 2> guards;
    bool is_free = false;
    for (;;) {
      guards[0] = Guard(&delivery.ready, !is_free);
      const std::size_t chosen = wait(inputs, guards, 1);
      if (chosen == 0) {
        in(delivery.ready);
        is_free = true;
      } else {
        delivery.inbox.push_back(take(inputs, chosen - 1));
        node_.hold(delivery.inbox.back());
      }
      if (!is_free || delivery.inbox.empty()) continue;
      is_free = false;
      const Message message = std::move(delivery.inbox.front());
      delivery.inbox.pop_front();
      node_.release(message);
      out(delivery.into, Handed{message, node_.pointers});
    }
  }

  void deliver(int way) {
    Delivery& delivery = *delivery_.at(way - CLIENT);
    for (;;) {
      out(delivery.ready, Signal{});
      node_.pass(way, delivery.into.in().message);
    }
  }

  // By a process of its own, as long as there are any, for which nothing waits: no sender may wait
  // for another, nor a link in for a link out that no route takes after it.
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
  std::array<std::unique_ptr<Inputs>, WAYS> inputs_;  // by way out
  std::array<std::unique_ptr<Delivery>, MAX_CLIENTS> delivery_;
  std::deque<Message> again_;
  bool sends_again_ = false;
};

}  // namespace

void start_acyclic(Node& node) {
  const auto router = std::make_shared<Router>(node);
  router->start(router);
}

}  // namespace network
