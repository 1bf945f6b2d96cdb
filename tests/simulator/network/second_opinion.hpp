// Independent simulation of a store-and-forward network: a simple event queue, without code of the
// simulator.
//
// Packets of equal length pass from processor to processor. Each outgoing link carries one packet
// at a time and has an unbounded queue in order of arrival. Nothing but links takes time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace second_opinion {

struct Packet {
  double at_s;  // date in seconds at which it enters the network
  int from, to;
};

// Returns the next processor on the route between two different processors.
using NextHop = std::function<int(int from, int to)>;

class Network {
 public:
  // `service_s` is the time in seconds that a packet takes on a link.
  Network(const std::vector<Packet>& packets, double service_s, NextHop next)
      : packets_(packets), service_s_(service_s), next_(std::move(next)) {}

  // Returns the date of arrival of each packet, in the order of the packets.
  std::vector<double> run() {
    arrived_s_.assign(packets_.size(), 0);
    for (std::size_t i = 0; i < packets_.size(); ++i)
      events_.push({packets_[i].at_s, order_++, i, packets_[i].from, nullptr});
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      if (event.freed) free_link(*event.freed, event.at_s);
      come(event.packet, event.at, event.at_s);
    }
    return arrived_s_;
  }

 private:
  struct Link {
    int to;
    bool busy = false;
    std::deque<std::size_t> waiting;
  };
  // An event at processor `at`: a packet enters the network there, or arrives there. If it arrives,
  // `freed` is the link that it leaves.
  struct Event {
    double at_s;
    std::uint64_t order;  // order of events at the same date
    std::size_t packet;
    int at;
    Link* freed;
    bool operator<(const Event& o) const {  // reversed, so that the queue's top is the next event
      return at_s != o.at_s ? at_s > o.at_s : order > o.order;
    }
  };

  void come(std::size_t packet, int at, double now_s) {
    const int to = packets_[packet].to;
    if (at == to) {
      arrived_s_[packet] = now_s;
      return;
    }
    const int next = next_(at, to);
    Link& link = links_.try_emplace({at, next}, Link{next, false, {}}).first->second;
    link.waiting.push_back(packet);
    if (!link.busy) send(link, now_s);
  }

  void send(Link& link, double now_s) {
    link.busy = true;
    events_.push({now_s + service_s_, order_++, link.waiting.front(), link.to, &link});
    link.waiting.pop_front();
  }

  void free_link(Link& link, double now_s) {
    link.busy = false;
    if (!link.waiting.empty()) send(link, now_s);
  }

  const std::vector<Packet>& packets_;
  double service_s_;
  NextHop next_;
  std::map<std::pair<int, int>, Link> links_;
  std::priority_queue<Event> events_;
  std::uint64_t order_ = 0;
  std::vector<double> arrived_s_;
};

}  // namespace second_opinion
