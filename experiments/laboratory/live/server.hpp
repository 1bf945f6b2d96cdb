#pragma once
// The server of the page, on the loopback of this computer: the page's own files, and a web socket
// that tells of a session and takes its commands.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "experiments/laboratory/live/session.hpp"

namespace laboratory {

/// Runs in a thread of its own as long as it lives. A page has to know a random token, which is in
/// the address that is given to the user, before it is told anything; requests that name another
/// host, or come from a page of another site, are refused. What a client sends is limited in size
/// and rate, and clients in number. A page is sent a frame when it has drawn the one before: slow
/// ones get fewer.
class Server {
 public:
  /// Listens at `port`; none: at 8080 or, if that is taken, at any that is free. Throws Failure if
  /// the port that was asked for is taken.
  Server(Session& session, std::optional<std::uint16_t> port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// "http://127.0.0.1:8080/#token=..."
  std::string address() const;

  class Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace laboratory
