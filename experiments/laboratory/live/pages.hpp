#pragma once
// Pages that watch: what each is told, and which of them steers.
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

constexpr std::size_t MOST_CLIENTS = 64;           ///< known, and as many strangers
constexpr auto TO_ASK = std::chrono::seconds(10);  ///< so long may a stranger say nothing

class Page;

/// What the pages share. While it runs, only the server's thread uses it.
struct Pages {
  explicit Pages(Session& session) : session(session) {}

  /// Pages look whether there is something for them.
  void look();
  /// All are told who steers. One that reads nothing may go at this.
  void tell_steering();
  /// The frame as text, made once for all.
  std::shared_ptr<const std::string> dump(const Frame& frame);

  Session& session;
  std::string token = make_token();
  std::set<std::shared_ptr<Page>> known;  ///< that have shown the token
  std::uint64_t known_so_far = 0;
  std::weak_ptr<Page> steers;
  /// How to close the connections that have not shown the token; the oldest is the first.
  std::map<std::uint64_t, std::function<void()>> strangers;
  std::uint64_t strangers_so_far = 0;
  boost::asio::io_context io{1};  ///< after all that the ends of its handlers use

 private:
  std::uint64_t dumped_number_ = 0;  // of the frame whose text this is
  std::shared_ptr<const std::string> dumped_;
};

/// A connection that has not shown the page's token yet: it is counted as long as it is there. When
/// there are too many the oldest is closed, so that a new one finds room. A page is shut out only
/// if that many others connect before it shows its token.
class Stranger {
 public:
  Stranger(Pages& pages, std::function<void()> close);
  ~Stranger() { pages_.strangers.erase(number_); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

 private:
  Pages& pages_;
  std::uint64_t number_;
};

/// A page that has opened a web socket.
class Page : public std::enable_shared_from_this<Page> {
 public:
  Page(Pages& pages, boost::beast::tcp_stream stream);

  void accept(const boost::beast::http::request<boost::beast::http::empty_body>& request);
  /// It is time to look whether the page wants something that is there.
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
  std::optional<Stranger> stranger_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  boost::asio::steady_timer patience_, later_;
  boost::beast::flat_buffer buffer_;
  Allowance allowance_;
  bool has_outline_ = false, wants_frame_ = false, looks_later_ = false, is_closed_ = false;
  std::uint64_t number_ = 0;  // of those that have shown the token, from 1
  std::uint64_t sent_ = 0;    // number of the last frame
  HostClock::time_point next_frame_at_;
  Picture shown_, sequential_;   // that the page has
  std::deque<Waiting> waiting_;  // the first is being written
};

}  // namespace laboratory
