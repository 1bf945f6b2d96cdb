#pragma once
// Pages connected to a live run: their messages, and the choice of the page that steers.
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <map>
#include <set>

#include "experiments/laboratory/live/admission.hpp"
#include "experiments/laboratory/live/session.hpp"

namespace laboratory {

constexpr std::size_t MOST_CLIENTS = 64;           ///< authenticated, and as many unauthenticated
constexpr auto TO_ASK = std::chrono::seconds(10);  ///< time allowed for a client to authenticate

class Page;

/// State common to all pages. While the server runs, only its thread uses it.
struct Pages {
  explicit Pages(Session& session) : session(session) {}

  /// Lets each page look for news.
  void look();
  /// Sends the steering state to all pages. A page that does not read may be removed meanwhile.
  void tell_steering();
  /// The frame as text, made once for all pages.
  std::shared_ptr<const std::string> dump(const Frame& frame);

  Session& session;
  std::string token = make_token();
  std::set<std::shared_ptr<Page>> known;  ///< authenticated by the token
  std::uint64_t known_so_far = 0;
  std::weak_ptr<Page> steers;
  /// Closes unauthenticated connections; the oldest is the first.
  std::map<std::uint64_t, std::function<void()>> pending;
  std::uint64_t pending_so_far = 0;
  boost::asio::io_context io{1};  ///< after all members that its handlers' destructors use

 private:
  std::uint64_t dumped_number_ = 0;  // of the frame in dumped_
  std::shared_ptr<const std::string> dumped_;
};

/// An unauthenticated connection, counted during its lifetime. If there are too many, a new one
/// closes the oldest. A page loses its place only if MOST_CLIENTS others connect before it
/// authenticates.
class PendingConnection {
 public:
  PendingConnection(Pages& pages, std::function<void()> close);
  ~PendingConnection() { pages_.pending.erase(number_); }
  PendingConnection(const PendingConnection&) = delete;
  PendingConnection& operator=(const PendingConnection&) = delete;

 private:
  Pages& pages_;
  std::uint64_t number_;
};

/// A page with an open web socket.
class Page : public std::enable_shared_from_this<Page> {
 public:
  Page(Pages& pages, boost::beast::tcp_stream stream);

  void accept(const boost::beast::http::request<boost::beast::http::empty_body>& request);
  /// Checks for a frame or an outline that the page wants and sends it.
  void look();
  void tell_steering();
  void close();

 private:
  using Error = boost::beast::error_code;
  using Json = nlohmann::ordered_json;
  using Picture = std::shared_ptr<const std::vector<std::uint8_t>>;
  using HostClock = std::chrono::steady_clock;
  struct Waiting {
    std::shared_ptr<const std::string> text;
    bool is_text;
  };

  bool is_known() const { return number_ > 0; }
  bool steers() const { return pages_.steers.lock().get() == this; }
  void read();
  bool obey(const std::string& text);
  bool welcome(const Json& message);
  void look_later();
  void reply(const Json& id, const std::string& refusal);
  void send_frame(const Frame& frame);
  void send_picture(char which, const Picture& picture, Picture& known);
  void send_json(const Json& message);
  void send(std::shared_ptr<const std::string> text, bool is_text);
  void write();

  Pages& pages_;
  std::optional<PendingConnection> stranger_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  boost::asio::steady_timer patience_, later_;
  boost::beast::flat_buffer buffer_;
  Allowance allowance_;
  bool has_outline_ = false, wants_frame_ = false, looks_later_ = false, is_closed_ = false;
  std::uint64_t number_ = 0;  // count of authenticated pages, from 1
  std::uint64_t sent_ = 0;    // number of the last frame
  HostClock::time_point next_frame_at_;
  Picture shown_, sequential_;   // on the page's screen
  std::deque<Waiting> waiting_;  // the first is being written
};

}  // namespace laboratory
