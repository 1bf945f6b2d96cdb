#pragma once
// Random requests to the server of the live page, most of them invalid.
#include <string>

#include "base/random.hpp"

namespace laboratory {

inline std::string random_bytes(base::Random& random, int most) {
  std::string bytes;
  for (int i = random.below(most); i >= 0; --i) bytes += static_cast<char>(random.below(256));
  return bytes;
}

// Makes a request that contains a random error.
inline std::string random_request(base::Random& random, const std::string& host) {
  std::string request = "GET /live HTTP/1.1\r\nHost: " + host +
                        "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nOrigin: http://" + host +
                        "\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
                        "dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  switch (random.below(5)) {
    case 0:
      return random_bytes(random, 300);
    case 1:
      return request.substr(0, static_cast<std::size_t>(random.below(int(request.size()))));
    case 2:
      for (int i = random.below(8); i >= 0; --i)
        request[static_cast<std::size_t>(random.below(int(request.size())))] =
            static_cast<char>(random.below(256));
      return request;
    case 3:
      return "GET /" + std::string(static_cast<std::size_t>(random.below(20'000)), 'a');
    default:
      // sends random bytes after the request, as frames of a web socket
      return request + random_bytes(random, 200);
  }
}

}  // namespace laboratory
