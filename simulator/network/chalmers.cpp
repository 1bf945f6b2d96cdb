// Chalmers's method (A. Chalmers, 1991; figure 5.11): one process, which while it sends a message
// memorises every message that comes. No router ever waits without receiving, so no waiting closes
// a cycle, as long as there is room. It has one message on its way out at a time.
#include "simulator/network/routers.hpp"
#include "simulator/occam/process.hpp"

namespace network {

namespace {

class Router {
 public:
  explicit Router(Node& node) : node_(node), inputs_(node) {
    name_ = node.processor->name() + ".to.handle.input";
    sender_ = node.processor->name() + ".send";
  }

  void run() {
    for (;;) {
      if (buffer_.empty()) {
        memorise(inputs_.wait());
        continue;
      }
      Waiting next = std::move(buffer_.front());
      buffer_.pop_front();
      node_.release(next.message);
      send(next);
      for (const int way : next.failed)
        for (auto& again : node_.send_around(next.message, way)) put(again, NO_WAY);
    }
  }

 private:
  struct Waiting {
    Message message;
    WaysOut ways;
    std::vector<int> failed = {};  // its link is cut
  };

  // PRI PAR: the message goes out, a GLOBAL one by all its ways at once; all that come meanwhile
  // are memorised.
  void send(Waiting& next) {
    Channel<Signal> to_handle_input(name_);
    const auto pass = [&](int way) {
      if (!node_.pass(way, next.message)) next.failed.push_back(way);
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
    occam::par({{sender_, machine::Priority::high, pass_all},
                {"", machine::Priority::high, [&] { memorise_while_sending(to_handle_input); }}});
  }

  void memorise_while_sending(Channel<Signal>& to_handle_input) {
    std::array<Guard, WAYS + 1> guards;
    for (;;) {
      guards[0] = Guard(&to_handle_input);
      for (std::size_t i = 0; i < inputs_.count(); ++i) guards.at(i + 1) = inputs_.guard(i);
      const std::size_t chosen = occam::select({guards.data(), inputs_.count() + 1});
      if (chosen == 0) break;
      const int way = inputs_.way(chosen - 1);
      inputs_.next_turn();
      memorise(way);
    }
    in(to_handle_input);
  }

  void memorise(int way) {
    if (auto message = node_.take(way)) put(std::move(*message), way);
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
  FairInputs inputs_;
  std::string name_, sender_;
  std::deque<Waiting> buffer_;
};

}  // namespace

void start_chalmers(Node& node) {
  start_server(node, "router", [&node] { Router(node).run(); });
}

}  // namespace network
