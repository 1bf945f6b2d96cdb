#include "experiments/laboratory/live/server.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <thread>

#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/live/page_files.hpp"
#include "experiments/laboratory/live/pages.hpp"

namespace laboratory {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using std::chrono_literals::operator""ms;
using Error = beast::error_code;

namespace {

constexpr std::uint16_t USUAL_PORT = 8080;
constexpr std::size_t LONGEST_HEADER = 8192;  // limit on the header of an HTTP request, bytes

constexpr const char* POLICY =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' "
    "data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

const PageFile* find_file(std::string_view target) {
  const std::string_view path = target == "/" ? "/index.html" : target;
  const auto found = std::ranges::find(PAGE_FILES, path, &PageFile::path);
  return found == std::end(PAGE_FILES) ? nullptr : &*found;
}

// Makes the system close the socket in child processes that execute another program.
void keep_from_children(auto& socket) { fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC); }

// A connected client until its first request, which either asks for a file of the page or opens a
// web socket.
class Client : public std::enable_shared_from_this<Client> {
 public:
  Client(Pages& pages, std::uint16_t port, tcp::socket socket)
      : pages_(pages), port_(port), stream_(std::move(socket)), buffer_(LONGEST_HEADER) {}

  void read() {
    pending_.emplace(pages_, [self = weak_from_this()] {
      if (const auto client = self.lock()) client->stream_.close();
    });
    parser_.header_limit(LONGEST_HEADER);
    parser_.body_limit(0);
    stream_.expires_after(TO_ASK);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](Error error, std::size_t) {
                       if (!error) self->answer();
                     });
  }

 private:
  // True if `host` is a name of this server that our own pages use. Pages of other sites use other
  // names.
  bool is_own(beast::string_view host) const {
    if (port_ == 80 && (host == "127.0.0.1" || host == "localhost")) return true;
    return host == fmt::format("127.0.0.1:{}", port_) || host == fmt::format("localhost:{}", port_);
  }

  void answer() {
    const auto& request = parser_.get();
    if (request.count(http::field::host) > 1)
      return refuse(http::status::bad_request, "found two hosts");
    if (request.count(http::field::origin) > 1)
      return refuse(http::status::bad_request, "found two origins");
    if (!is_own(request[http::field::host]))
      return refuse(http::status::misdirected_request, "found another host");
    if (websocket::is_upgrade(request)) {
      auto origin = request[http::field::origin];
      const beast::string_view scheme = "http://";
      if (!origin.starts_with(scheme) || !is_own(origin.substr(scheme.size())))
        return refuse(http::status::forbidden, "found a page of another site");
      if (request.target() != "/live") return refuse(http::status::not_found, "not found");
      pending_.reset();
      std::make_shared<Page>(pages_, std::move(stream_))->accept(parser_.release());
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

  Pages& pages_;
  std::uint16_t port_;  // port of this server
  std::optional<PendingConnection> pending_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  http::response<http::string_body> response_;
};

}  // namespace

class Server::Impl {
 public:
  Impl(Session& session, std::optional<std::uint16_t> port)
      : pages_(session), acceptor_(pages_.io), end_(pages_.io), retry_(pages_.io) {
    listen(port);
    session.on_frame([this] { asio::post(pages_.io, [this] { pages_.look(); }); });
    accept();
    thread_ = std::thread([this] { pages_.io.run(); });
  }
  ~Impl() {
    pages_.session.on_frame({});
    // sends the last messages to pages that still receive
    asio::post(pages_.io, [this] {
      pages_.look();
      end_.expires_after(200ms);
      end_.async_wait([this](Error) { pages_.io.stop(); });
    });
    thread_.join();
    pages_.known.clear();
  }

  std::string address() const {
    return fmt::format("http://127.0.0.1:{}/#token={}", port_, pages_.token);
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
      complain(taken + "; using another one");
      acceptor_.close();
      acceptor_.open(tcp::v4());
      acceptor_.bind({loopback, 0});
      acceptor_.listen();
      keep_from_children(acceptor_);
    }
    port_ = acceptor_.local_endpoint().port();
  }

  void accept() {
    acceptor_.async_accept([this](Error error, tcp::socket socket) {
      if (error) return accept_later();
      keep_from_children(socket);
      std::make_shared<Client>(pages_, port_, std::move(socket))->read();
      accept();
    });
  }

  // Waits before it accepts again, since a lack of descriptors or memory on the host may last.
  void accept_later() {
    retry_.expires_after(100ms);
    retry_.async_wait([this](Error error) {
      if (!error) accept();
    });
  }

  Pages pages_;
  std::uint16_t port_ = 0;
  tcp::acceptor acceptor_;
  asio::steady_timer end_, retry_;
  std::thread thread_;
};

Server::Server(Session& session, std::optional<std::uint16_t> port)
    : impl_(std::make_unique<Impl>(session, port)) {}
Server::~Server() = default;
std::string Server::address() const { return impl_->address(); }

}  // namespace laboratory
