#pragma once
// Web server of the live page on the loopback interface: static files, and a web socket for frames
// and commands.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "experiments/laboratory/live/session.hpp"

namespace laboratory {

/// Serves a session in its own thread while the object lives. A page must present the random token
/// from the address shown to the user before it receives data. Requests for another host name, or
/// from a page of another site, are refused. The number of clients, and the size and rate of their
/// messages, are limited. A page receives a frame only after it has drawn the previous one, so slow
/// pages receive fewer.
class Server {
 public:
  /// Listens on `port`. Without one, listens on 8080, or on any free port if 8080 is taken. Throws
  /// Failure if an explicit port is taken.
  Server(Session& session, std::optional<std::uint16_t> port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The address to open, "http://127.0.0.1:8080/#token=...".
  std::string address() const;

  class Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace laboratory
