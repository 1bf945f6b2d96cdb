#include "experiments/laboratory/live/pages.hpp"

#include <boost/asio/post.hpp>

#include "experiments/laboratory/live/tiles.hpp"

namespace laboratory {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using std::chrono_literals::operator""ms, std::chrono_literals::operator""s;

namespace {

constexpr std::size_t LONGEST_MESSAGE = 16384;  // limit on a received message, bytes
constexpr std::size_t MOST_WAITING = 256;       // limit on messages queued for sending to a page
constexpr auto FRAME_EVERY = 20ms;              // least host time between two frames
constexpr char PICTURE = 0, SEQUENTIAL = 1;

// Converts a message to text. Replaces invalid UTF-8, which file names may contain.
std::string to_text(const nlohmann::ordered_json& message) {
  return message.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

// --- functions for all pages -------------------------------------------------------------------

void Pages::look() {
  const auto pages = known;  // sending may remove a page from `known`
  for (const auto& page : pages) page->look();
}

void Pages::tell_steering() {
  const auto pages = known;
  for (const auto& page : pages) page->tell_steering();
}

std::shared_ptr<const std::string> Pages::dump(const Frame& frame) {
  if (frame.number != dumped_number_ || !dumped_) {
    auto state = frame.state;
    state["frame"] = frame.number;
    dumped_ = std::make_shared<const std::string>(to_text({{"state", state}}));
    dumped_number_ = frame.number;
  }
  return dumped_;
}

PendingConnection::PendingConnection(Pages& pages, std::function<void()> close)
    : pages_(pages), number_(++pages.pending_so_far) {
  if (pages.pending.size() == MOST_CLIENTS) pages.pending.extract(pages.pending.begin()).mapped()();
  pages.pending.emplace(number_, std::move(close));
}

// --- functions of one page ----------------------------------------------------------------------

Page::Page(Pages& pages, beast::tcp_stream stream)
    : pages_(pages),
      socket_(std::move(stream)),
      authentication_timeout_(pages.io),
      later_(pages.io) {}

void Page::accept(const beast::http::request<beast::http::empty_body>& request) {
  beast::get_lowest_layer(socket_).expires_never();
  auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
  timeout.idle_timeout = 60s;
  timeout.keep_alive_pings = true;
  socket_.set_option(timeout);
  socket_.read_message_max(LONGEST_MESSAGE);
  socket_.auto_fragment(false);
  pending_.emplace(pages_, [self = weak_from_this()] {
    if (const auto page = self.lock()) page->close();
  });
  authentication_timeout_.expires_after(TO_ASK);
  authentication_timeout_.async_wait([self = weak_from_this()](Error error) {
    const auto page = self.lock();
    if (!error && page && !page->is_known()) page->close();
  });
  socket_.async_accept(request, [self = shared_from_this()](Error error) {
    if (!error) self->read();
  });
}

void Page::look() {
  if (!is_known()) return;
  if (!has_outline_) {
    const auto outline = pages_.session.outline();
    if (!outline) return;
    has_outline_ = true;
    send_json({{"outline", *outline}, {"steers", steers()}});
  }
  if (!wants_frame_ || !waiting_.empty()) return;  // the page has not received the last frame yet
  if (HostClock::now() < next_frame_at_) return look_later();
  const auto frame = pages_.session.frame();
  if (!frame || frame->number <= sent_) return pages_.session.want_frame();
  send_frame(*frame);
}

void Page::look_later() {
  if (std::exchange(looks_later_, true)) return;
  later_.expires_at(next_frame_at_);
  later_.async_wait([self = weak_from_this()](Error error) {
    const auto page = self.lock();
    if (error || !page) return;
    page->looks_later_ = false;
    page->look();
  });
}

void Page::tell_steering() {
  if (has_outline_) send_json({{"steers", steers()}});
}

void Page::close() {
  if (std::exchange(is_closed_, true)) return;
  const auto self = shared_from_this();
  pending_.reset();
  pages_.known.erase(self);
  Error ignored;
  auto& stream = beast::get_lowest_layer(socket_);
  stream.socket().shutdown(asio::socket_base::shutdown_both, ignored);
  stream.close();
  if (pages_.steers.lock() == self) {
    pages_.steers.reset();
    if (!pages_.known.empty()) pages_.steers = *pages_.known.begin();
    pages_.tell_steering();
  }
  if (is_known())  // deselects the processors of this page
    pages_.session.ask({{"do", "select"}, {"page", number_}, {"processors", Json::array()}}, {});
}

void Page::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) {
    if (error || self->is_closed_) return self->close();
    const bool goes_on = self->socket_.got_text() && self->allowance_.take() &&
                         self->obey(beast::buffers_to_string(self->buffer_.data()));
    self->buffer_.consume(self->buffer_.size());
    if (!goes_on) return self->close();
    self->read();
  });
}

// Executes a message from the page. Returns false for messages that our own pages never send.
bool Page::obey(const std::string& text) {
  auto message = Json::parse(text, nullptr, false);
  if (!message.is_object()) return false;
  if (!is_known()) return welcome(message);
  if (message.contains("want")) {
    wants_frame_ = true;
    look();
    return true;
  }
  if (!message.contains("do")) return false;
  const Json id =
      message.contains("id") && message["id"].is_number_unsigned() ? message["id"] : Json();
  if (message["do"] == "steer") {
    pages_.steers = shared_from_this();
    pages_.tell_steering();
    reply(id, "");
    return true;
  }
  message["page"] = number_;
  if (!steers() && message["do"] != "select") {
    reply(id, "another page controls the run; press \"Take control\" first");
    return true;
  }
  pages_.session.ask(message,
                     [self = weak_from_this(), &io = pages_.io, id](const std::string& refusal) {
                       asio::post(io, [self, id, refusal] {
                         if (const auto page = self.lock()) page->reply(id, refusal);
                       });
                     });
  return true;
}

// Authenticates a page. Returns true if its token is right and there are fewer than MOST_CLIENTS
// pages.
bool Page::welcome(const Json& message) {
  if (!message.contains("token") || !message["token"].is_string()) return false;
  if (!is_same_secret(message["token"].get_ref<const std::string&>(), pages_.token)) return false;
  if (pages_.known.size() == MOST_CLIENTS) return false;
  pending_.reset();
  number_ = ++pages_.known_so_far;
  pages_.known.insert(shared_from_this());
  if (pages_.steers.expired()) pages_.steers = shared_from_this();
  look();
  return true;
}

void Page::reply(const Json& id, const std::string& refusal) {
  constexpr std::size_t LONGEST_REPLY = 2000;
  send_json({{"reply", id}, {"refusal", refusal.substr(0, LONGEST_REPLY)}});
}

void Page::send_frame(const Frame& frame) {
  wants_frame_ = false;
  sent_ = frame.number;
  next_frame_at_ = HostClock::now() + FRAME_EVERY;
  send_picture(PICTURE, frame.rgb8, shown_);
  send_picture(SEQUENTIAL, frame.sequential, sequential_);
  const auto news = pages_.session.history().take_after(history_);
  if (!news.is_null()) send_json({{"history", news}});
  send(pages_.dump(frame), /*is_text=*/true);
}

// Sends a picture: one byte for its kind, then the tiles that differ from the picture `known` to
// the page.
void Page::send_picture(char which, const Picture& picture, Picture& known) {
  if (!picture || picture == known) return;
  const int width = pages_.session.outline()->at("picture").at("width").get<int>();
  const auto tiles = make_tiles(*picture, known.get(), width);
  known = picture;
  if (!tiles.empty()) send(std::make_shared<const std::string>(which + tiles), /*is_text=*/false);
}

void Page::send_json(const Json& message) {
  send(std::make_shared<const std::string>(to_text(message)), /*is_text=*/true);
}

void Page::send(std::shared_ptr<const std::string> text, bool is_text) {
  if (is_closed_) return;
  if (waiting_.size() == MOST_WAITING) return close();
  waiting_.push_back({std::move(text), is_text});
  if (waiting_.size() == 1) write();
}

void Page::write() {
  socket_.text(waiting_.front().is_text);
  socket_.async_write(asio::buffer(*waiting_.front().text),
                      [self = shared_from_this()](Error error, std::size_t) {
                        if (error || self->is_closed_) return self->close();
                        self->waiting_.pop_front();
                        self->waiting_.empty() ? self->look() : self->write();
                      });
}

}  // namespace laboratory
