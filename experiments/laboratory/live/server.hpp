#pragma once
// Web server of the live page, on the loopback interface. It serves static files, and a web socket
// for frames (snapshots of the run) and commands.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "experiments/laboratory/live/session.hpp"

namespace laboratory {

/// Serves a session to browser pages, in a thread of its own, while the object lives. A page
/// receives data only after it has presented the random token from the address shown to the user.
/// Refuses requests for another host name and from pages of other sites. Limits the number of
/// clients, and the size and rate of their messages. Sends a frame only after the page has drawn
/// the previous one, so slow pages receive fewer frames.
class Server {
 public:
  /// Listens on `port`. Without a port, listens on 8080, or on any free port if 8080 is in use.
  /// Throws Failure if a given port is in use.
  Server(Session& session, std::optional<std::uint16_t> port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The address for the browser, "http://127.0.0.1:8080/#token=...".
  std::string address() const;

  class Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace laboratory
