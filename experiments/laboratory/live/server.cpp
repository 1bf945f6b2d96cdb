#include "experiments/laboratory/live/server.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <set>
#include <thread>

#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/live/admission.hpp"
#include "experiments/laboratory/live/page_files.hpp"
#include "experiments/laboratory/live/tiles.hpp"

namespace laboratory {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using nlohmann::ordered_json;
using namespace std::chrono_literals;
using Error = beast::error_code;

namespace {

constexpr std::uint16_t USUAL_PORT = 8080;
constexpr std::size_t MOST_CLIENTS = 64;
constexpr std::size_t LONGEST_HEADER = 8192, LONGEST_MESSAGE = 16384;  // bytes
constexpr std::size_t MOST_WAITING = 256;                              // messages to a page
constexpr auto TO_ASK = 10s;        // a client has so long to say what it wants
constexpr auto FRAME_EVERY = 33ms;  // at most

constexpr const char* POLICY =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' "
    "data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

const PageFile* find_file(std::string_view target) {
  const std::string_view path = target == "/" ? "/index.html" : target;
  const auto found = std::ranges::find(PAGE_FILES, path, &PageFile::path);
  return found == std::end(PAGE_FILES) ? nullptr : &*found;
}

// Names of files may be no UTF-8.
std::string to_text(const ordered_json& message) {
  return message.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// What is started from here does not have the connection.
void keep_from_children(auto& socket) { fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC); }

class Page;

// What the pages share. All of it belongs to the server's thread.
struct Shared {
  explicit Shared(Session& session) : session(session) {}

  Session& session;
  asio::io_context io{1};
  std::string token = make_token();
  std::uint16_t port = 0;
  std::size_t clients = 0;
  std::uint64_t known = 0;                // pages that have shown the token so far
  std::set<std::shared_ptr<Page>> pages;  // that have shown the token
  std::weak_ptr<Page> steers;
  std::uint64_t dumped_number = 0;  // of the frame whose text this is
  std::shared_ptr<const std::string> dumped;

  bool is_own(beast::string_view host) const {
    if (port == 80 && (host == "127.0.0.1" || host == "localhost")) return true;
    return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
  }
  std::shared_ptr<const std::string> dump(const Frame& frame) {
    if (frame.number != dumped_number || !dumped) {
      auto state = frame.state;
      state["frame"] = frame.number;
      dumped = std::make_shared<const std::string>(to_text({{"state", state}}));
      dumped_number = frame.number;
    }
    return dumped;
  }
};

// Counts a client as long as it is there.
class Counted {
 public:
  explicit Counted(Shared& shared) : shared_(shared) { ++shared_.clients; }
  ~Counted() { --shared_.clients; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  Shared& shared_;
};

// A page that has opened a web socket.
class Page : public std::enable_shared_from_this<Page> {
 public:
  Page(Shared& shared, std::shared_ptr<Counted> counted, beast::tcp_stream stream)
      : shared_(shared),
        counted_(std::move(counted)),
        socket_(std::move(stream)),
        patience_(shared.io) {}

  void accept(const http::request<http::empty_body>& request) {
    beast::get_lowest_layer(socket_).expires_never();
    auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeout.idle_timeout = 60s;
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.read_message_max(LONGEST_MESSAGE);
    socket_.auto_fragment(false);
    patience_.expires_after(TO_ASK);
    patience_.async_wait([self = weak_from_this()](Error error) {
      const auto page = self.lock();
      if (!error && page && !page->is_known_) page->close();
    });
    socket_.async_accept(request, [self = shared_from_this()](Error error) {
      if (!error) self->read();
    });
  }

  // It is time to look whether the page wants something that is there.
  void look() {
    if (!is_known_) return;
    if (!has_outline_) {
      const auto outline = shared_.session.outline();
      if (!outline) return;
      has_outline_ = true;
      send_json({{"outline", *outline}, {"steers", steers()}});
    }
    if (!wants_frame_ || !waiting_.empty()) return;  // it has not read the last yet
    if (std::chrono::steady_clock::now() < next_frame_at_) return;
    const auto frame = shared_.session.frame();
    if (!frame || frame->number <= sent_) return shared_.session.want_frame();
    send_frame(*frame);
  }

  void tell_steering() {
    if (has_outline_) send_json({{"steers", steers()}});
  }

  void close() {
    if (std::exchange(is_closed_, true)) return;
    const auto self = shared_from_this();
    shared_.pages.erase(self);
    Error ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(tcp::socket::shutdown_both, ignored);
    beast::get_lowest_layer(socket_).close();
    if (shared_.steers.lock() == self) {
      shared_.steers.reset();
      if (!shared_.pages.empty()) shared_.steers = *shared_.pages.begin();
      tell_all_steering();
    }
    if (is_known_)  // it looks at no processor any more
      shared_.session.ask({{"do", "select"}, {"page", number_}, {"processors", Json::array()}}, {});
  }

 private:
  using Json = ordered_json;

  // A page that reads nothing may go at this.
  void tell_all_steering() {
    const auto pages = shared_.pages;
    for (const auto& page : pages) page->tell_steering();
  }

  bool steers() const { return shared_.steers.lock().get() == this; }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) {
      if (error || self->is_closed_) return self->close();
      const bool goes_on = self->socket_.got_text() && self->allowance_.take() &&
                           self->obey(beast::buffers_to_string(self->buffer_.data()));
      self->buffer_.consume(self->buffer_.size());
      if (!goes_on) return self->close();
      self->read();
    });
  }

  // Returns false for what no page of ours would say.
  bool obey(const std::string& text) {
    auto message = ordered_json::parse(text, nullptr, false);
    if (!message.is_object()) return false;
    if (!is_known_) {
      if (!message.contains("token") || !message["token"].is_string()) return false;
      if (!is_same_secret(message["token"].get_ref<const std::string&>(), shared_.token))
        return false;
      is_known_ = true;
      number_ = ++shared_.known;
      shared_.pages.insert(shared_from_this());
      if (shared_.steers.expired()) shared_.steers = shared_from_this();
      look();
      return true;
    }
    if (message.contains("want")) {
      wants_frame_ = true;
      look();
      return true;
    }
    if (!message.contains("do")) return false;
    if (message["do"] == "steer") {
      shared_.steers = shared_from_this();
      tell_all_steering();
      return true;
    }
    const ordered_json id = message.contains("id") && message["id"].is_number_unsigned()
                                ? message["id"]
                                : ordered_json();
    message["page"] = number_;
    if (!steers() && message["do"] != "select") {
      reply(id, "another page steers; take the wheel first");
      return true;
    }
    shared_.session.ask(
        message, [self = weak_from_this(), &io = shared_.io, id](const std::string& refusal) {
          asio::post(io, [self, id, refusal] {
            if (const auto page = self.lock()) page->reply(id, refusal);
          });
        });
    return true;
  }

  void reply(const ordered_json& id, const std::string& refusal) {
    send_json({{"reply", id}, {"refusal", refusal}});
  }

  void send_frame(const Frame& frame) {
    wants_frame_ = false;
    sent_ = frame.number;
    next_frame_at_ = std::chrono::steady_clock::now() + FRAME_EVERY / 2;  // and the next tick
    send_picture(PICTURE, frame.rgb8, shown_);
    send_picture(SEQUENTIAL, frame.sequential, sequential_);
    send(shared_.dump(frame), /*is_text=*/true);
  }

  using Picture = std::shared_ptr<const std::vector<std::uint8_t>>;
  static constexpr char PICTURE = 0, SEQUENTIAL = 1;

  // A byte that says which picture it is, and the tiles that differ from what the page has.
  void send_picture(char which, const Picture& picture, Picture& known) {
    if (!picture || picture == known) return;
    const int width = shared_.session.outline()->at("picture").at("width").get<int>();
    const auto tiles = make_tiles(*picture, known.get(), width);
    known = picture;
    if (!tiles.empty()) send(std::make_shared<const std::string>(which + tiles), /*is_text=*/false);
  }

  void send_json(const ordered_json& message) {
    send(std::make_shared<const std::string>(to_text(message)), /*is_text=*/true);
  }

  void send(std::shared_ptr<const std::string> text, bool is_text) {
    if (is_closed_) return;
    if (waiting_.size() == MOST_WAITING) return close();
    waiting_.push_back({std::move(text), is_text});
    if (waiting_.size() == 1) write();
  }

  void write() {
    socket_.text(waiting_.front().is_text);
    socket_.async_write(asio::buffer(*waiting_.front().text),
                        [self = shared_from_this()](Error error, std::size_t) {
                          if (error || self->is_closed_) return self->close();
                          self->waiting_.pop_front();
                          self->waiting_.empty() ? self->look() : self->write();
                        });
  }

  struct Waiting {
    std::shared_ptr<const std::string> text;
    bool is_text;
  };

  Shared& shared_;
  std::shared_ptr<Counted> counted_;
  websocket::stream<beast::tcp_stream> socket_;
  asio::steady_timer patience_;
  beast::flat_buffer buffer_;
  Allowance allowance_;
  bool is_known_ = false, has_outline_ = false, wants_frame_ = false, is_closed_ = false;
  std::uint64_t number_ = 0;  // of the page, from 1
  std::uint64_t sent_ = 0;    // number of the last frame
  std::chrono::steady_clock::time_point next_frame_at_;
  Picture shown_, sequential_;   // that the page has
  std::deque<Waiting> waiting_;  // the first is being written
};

// A client that has not said yet what it wants: a file of the page, or a web socket.
class Client : public std::enable_shared_from_this<Client> {
 public:
  Client(Shared& shared, tcp::socket socket)
      : shared_(shared),
        counted_(std::make_shared<Counted>(shared)),
        stream_(std::move(socket)),
        buffer_(LONGEST_HEADER) {}

  void read() {
    parser_.header_limit(LONGEST_HEADER);
    parser_.body_limit(0);
    stream_.expires_after(TO_ASK);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](Error error, std::size_t) {
                       if (!error) self->answer();
                     });
  }

 private:
  void answer() {
    const auto& request = parser_.get();
    if (!shared_.is_own(request[http::field::host]))
      return refuse(http::status::misdirected_request, "found another host");
    if (websocket::is_upgrade(request)) {
      auto origin = request[http::field::origin];
      const beast::string_view scheme = "http://";
      if (!origin.starts_with(scheme) || !shared_.is_own(origin.substr(scheme.size())))
        return refuse(http::status::forbidden, "found a page of another site");
      if (request.target() != "/live") return refuse(http::status::not_found, "not found");
      std::make_shared<Page>(shared_, counted_, std::move(stream_))->accept(parser_.release());
      return;
    }
    if (request.method() != http::verb::get)
      return refuse(http::status::method_not_allowed, "expected GET");
    const auto target = request.target();
    const auto* file = find_file({target.data(), target.size()});
    if (!file) return refuse(http::status::not_found, "not found");
    send(http::status::ok, file->type, file->text);
  }

  void refuse(http::status status, const char* why) { send(status, "text/plain", why); }

  void send(http::status status, const char* type, const char* text) {
    response_.result(status);
    response_.version(11);
    response_.set(http::field::content_type, type);
    response_.set(http::field::cache_control, "no-store");
    response_.set("Content-Security-Policy", POLICY);
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.keep_alive(false);
    response_.body() = text;
    response_.prepare_payload();
    http::async_write(stream_, response_, [self = shared_from_this()](Error, std::size_t) {
      Error ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  Shared& shared_;
  std::shared_ptr<Counted> counted_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  http::response<http::string_body> response_;
};

}  // namespace

class Server::Impl {
 public:
  Impl(Session& session, std::optional<std::uint16_t> port)
      : shared_(session), acceptor_(shared_.io), frames_(shared_.io) {
    listen(port);
    session.on_frame([this] { asio::post(shared_.io, [this] { look(); }); });
    accept();
    tick();
    thread_ = std::thread([this] { shared_.io.run(); });
  }
  ~Impl() {
    shared_.session.on_frame({});
    // What has been said last is still sent, to pages that read.
    asio::post(shared_.io, [this] {
      look();
      end_.expires_after(200ms);
      end_.async_wait([this](Error) { shared_.io.stop(); });
    });
    thread_.join();
    shared_.pages.clear();
  }

  std::string address() const {
    return fmt::format("http://127.0.0.1:{}/#token={}", shared_.port, shared_.token);
  }

 private:
  void listen(std::optional<std::uint16_t> port) {
    const auto loopback = asio::ip::address_v4::loopback();
    acceptor_.open(tcp::v4());
    acceptor_.set_option(asio::socket_base::reuse_address(true));
    Error error;
    acceptor_.bind({loopback, port.value_or(USUAL_PORT)}, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    keep_from_children(acceptor_);
    if (error) {
      const auto taken = fmt::format("port {}: {}", port.value_or(USUAL_PORT), error.message());
      if (port)
        throw Failure(fmt::format("--port: {}; expected one that is free", taken), EXIT_HOST);
      complain(taken + "; another one is taken");
      acceptor_.close();
      acceptor_.open(tcp::v4());
      acceptor_.bind({loopback, 0});
      acceptor_.listen();
      keep_from_children(acceptor_);
    }
    shared_.port = acceptor_.local_endpoint().port();
  }

  void accept() {
    acceptor_.async_accept([this](Error error, tcp::socket socket) {
      if (!error) keep_from_children(socket);
      if (!error && shared_.clients < MOST_CLIENTS)
        std::make_shared<Client>(shared_, std::move(socket))->read();
      accept();
    });
  }

  void tick() {
    frames_.expires_after(FRAME_EVERY);
    frames_.async_wait([this](Error error) {
      if (error) return;
      look();
      tick();
    });
  }

  void look() {
    const auto pages = shared_.pages;  // one may go meanwhile
    for (const auto& page : pages) page->look();
  }

  Shared shared_;
  tcp::acceptor acceptor_;
  asio::steady_timer frames_, end_{shared_.io};
  std::thread thread_;
};

Server::Server(Session& session, std::optional<std::uint16_t> port)
    : impl_(std::make_unique<Impl>(session, port)) {}
Server::~Server() = default;
std::string Server::address() const { return impl_->address(); }

}  // namespace laboratory
