#pragma once
// The page's server on the loopback interface: static files, and a web socket that reports a
// session and takes its commands.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "experiments/laboratory/live/session.hpp"

namespace laboratory {

/// Runs in its own thread during its lifetime. A page must present a random token, part of the
/// address shown to the user, before it receives any data. Requests with another host name, or from
/// a page of another site, are refused. Messages of clients are limited in size and rate, and so is
/// the number of clients. A page receives a frame only after drawing the previous one: slow pages
/// receive fewer.
class Server {
 public:
  /// Listens on `port`; none: on 8080 or, if that is taken, on any free port. Throws Failure if an
  /// explicit port is taken.
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
