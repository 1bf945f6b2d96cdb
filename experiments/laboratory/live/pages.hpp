#pragma once
// Browser pages connected to a live run: messages to and from each page, and the choice of the one
// page that may control the run.
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

/// limit on authenticated clients, and also on clients that are not authenticated yet
constexpr std::size_t MOST_CLIENTS = 64;
constexpr auto TO_ASK = std::chrono::seconds(10);  ///< time allowed for a client to authenticate

class Page;

/// State common to all pages. Only the server's thread may use it while the server runs.
struct Pages {
  explicit Pages(Session& session) : session(session) {}

  /// Sends the newest frame to every page that waits for one.
  void look();
  /// Tells every page whether it controls the run. May remove a page that does not read its
  /// messages.
  void tell_steering();
  /// Returns the text of a frame. It is made once for all pages.
  std::shared_ptr<const std::string> dump(const Frame& frame);

  Session& session;
  std::string token = make_token();
  std::set<std::shared_ptr<Page>> known;  ///< pages that have authenticated
  std::uint64_t known_so_far = 0;
  std::weak_ptr<Page> steers;
  /// functions that close unauthenticated connections, the oldest connection first
  std::map<std::uint64_t, std::function<void()>> pending;
  std::uint64_t pending_so_far = 0;
  /// declared last and so destroyed first: destructors of its handlers use the members above
  boost::asio::io_context io{1};

 private:
  std::uint64_t dumped_number_ = 0;  // number of the frame whose text is in dumped_
  std::shared_ptr<const std::string> dumped_;
};

/// Counts an unauthenticated connection while the object lives. If MOST_CLIENTS of them exist, a
/// new connection closes the oldest one. Thus a page is closed before it can authenticate only if
/// MOST_CLIENTS other clients connect in the meantime.
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

/// A browser page that is connected by a web socket.
class Page : public std::enable_shared_from_this<Page> {
 public:
  Page(Pages& pages, boost::beast::tcp_stream stream);

  void accept(const boost::beast::http::request<boost::beast::http::empty_body>& request);
  /// Sends the outline or the newest frame, if the page wants it.
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
  std::optional<PendingConnection> pending_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  boost::asio::steady_timer authentication_timeout_, later_;
  boost::beast::flat_buffer buffer_;
  Allowance allowance_;
  bool has_outline_ = false, wants_frame_ = false, looks_later_ = false, is_closed_ = false;
  // number of this page, counted from 1; 0: the page is not authenticated
  std::uint64_t number_ = 0;
  std::uint64_t sent_ = 0;  // number of the last frame sent to this page
  HostClock::time_point next_frame_at_;
  History::Place history_;       // the part of the history that the page has
  Picture shown_, sequential_;   // pictures last sent to the page
  std::deque<Waiting> waiting_;  // messages to send; the first is being written
};

}  // namespace laboratory
