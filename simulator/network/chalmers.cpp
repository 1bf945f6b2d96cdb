// Chalmers's router (A. Chalmers, 1991). A single process sends one message at a time and meanwhile
// buffers all messages that arrive. A router therefore never waits without receiving, and there is
// no deadlock as long as no buffer overflows.
#include "simulator/network/routers.hpp"
#include "simulator/occam/process.hpp"

namespace network {

namespace {

class ChalmersRouter {
 public:
  explicit ChalmersRouter(Node& node) : node_(node), inputs_(node.inputs()) {
    name_ = node.processor->name() + ".to.handle.input";
    sender_ = node.processor->name() + ".send";
  }

  void run() {
    while (occam::turn(true))
      if (buffer_.empty())
        pri_alt(each(inputs_, favourite_,
                     [&](std::size_t k, std::optional<Message> y) { memorise(k, std::move(y)); }));
      else
        send_next();
  }

 private:
  struct Waiting {
    Message message;
    WaysOut ways;
  };

  void send_next() {
    Waiting next = std::move(buffer_.front());
    buffer_.pop_front();
    node_.release(next.message);
    std::vector<int> failed;  // ways whose link was cut before the message had passed
    send(next, failed);
    for (const int way : failed)
      for (auto& again : node_.send_around(next.message, way)) put(again, NO_WAY);
  }

  // The PRI PAR of figure 5.11 of the thesis: sends the message and meanwhile buffers all messages
  // that arrive. A broadcast (GLOBAL) message leaves by all its ways in parallel.
  void send(const Waiting& next, std::vector<int>& failed) {
    Channel<Signal> to_handle_input(name_);
    const auto pass = [&](int way) {
      if (!node_.pass(way, next.message)) failed.push_back(way);
    };
    const auto pass_all = [&] {
      std::vector<occam::Branch> branches;
      for (const int way : next.ways)
        branches.push_back({sender_, machine::Priority::high, [&, way] { pass(way); }});
      if (branches.size() == 1)
        pass(*next.ways.begin());
      else
        occam::par(branches);
      out(to_handle_input, Signal{});
    };
    const auto memorise_all = [&] {
      Signal dummy;
      for (bool sending = true; occam::turn(sending);)
        pri_alt(when(to_handle_input, dummy, [&] { sending = false; }),
                each(inputs_, favourite_,
                     [&](std::size_t k, std::optional<Message> y) { memorise(k, std::move(y)); }));
    };
    occam::par(
        {{sender_, machine::Priority::high, pass_all}, {"", machine::Priority::low, memorise_all}});
  }

  void memorise(std::size_t k, std::optional<Message> message) {
    favourite_ = (favourite_ + 1) % inputs_.size();
    if (message) put(std::move(*message), inputs_[k].way);
  }

  void put(Message message, int came_by) {
    const WaysOut ways = node_.find_ways_out(message, came_by);
    if (ways.count > 0) {
      node_.hold(message);
      buffer_.push_back({std::move(message), ways});
    }
    for (auto& left_out : node_.take_unreached()) put(std::move(left_out), NO_WAY);
  }

  Node& node_;
  const std::vector<WayIn> inputs_;
  std::size_t favourite_ = 0;
  std::string name_, sender_;
  std::deque<Waiting> buffer_;
};

}  // namespace

void start_chalmers(Node& node) {
  start_server(
      node, "router", [&node] { ChalmersRouter(node).run(); }, machine::Priority::low);
}

}  // namespace network
