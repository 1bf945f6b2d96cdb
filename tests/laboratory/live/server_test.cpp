// Access to the server of the live page, and its behaviour towards clients without access.
#include "experiments/laboratory/live/server.hpp"

#include <sys/resource.h>

#include <boost/asio/connect.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstdlib>
#include <fstream>

#include "base/random.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/live/pages.hpp"
#include "tests/laboratory/live/random_requests.hpp"
#include "tests/laboratory/live/watched_run.hpp"

namespace laboratory {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using Socket = beast::websocket::stream<tcp::socket>;

constexpr const char* SMALL_FARM =
    "[network]\nworkers = 2\n[scene]\nobjects = 10\n[image]\nwidth = 16\nheight = 12\n";

// A server with its session, and the parts of its address.
struct Served {
  test::TemporaryFolder folder;
  ExperimentFile file = read(SMALL_FARM, folder.path.string());
  Session session{file, std::numeric_limits<double>::infinity()};
  Server server{session, {}};
  asio::io_context io;

  std::string port() const {
    const auto address = server.address();
    const auto from = address.rfind(':') + 1;
    return address.substr(from, address.find('/', from) - from);
  }
  std::string token() const {
    const auto address = server.address();
    return address.substr(address.find("token=") + 6);
  }
  std::string host() const { return "127.0.0.1:" + port(); }

  tcp::socket connect() {
    tcp::socket socket(io);
    socket.connect(
        {asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(std::stoi(port()))});
    return socket;
  }

  http::response<http::string_body> get(const std::string& target, const std::string& host,
                                        http::verb verb = http::verb::get) {
    auto socket = connect();
    http::request<http::empty_body> request{verb, target, 11};
    request.set(http::field::host, host);
    http::write(socket, request);
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    http::read(socket, buffer, response);
    return response;
  }

  // Opens a web socket. Throws beast::system_error if the server refuses it.
  Socket open(const std::string& origin, const std::string& host) {
    Socket socket(connect());
    socket.set_option(
        beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
          if (!origin.empty()) request.set(http::field::origin, origin);
        }));
    socket.handshake(host, "/live");
    return socket;
  }
  Socket open() { return open("http://" + host(), host()); }

  // Simulates the session's point to its end.
  PointResult run() {
    RunOptions options;
    options.file = "e.toml";
    return run_point(file.points[0], options, folder.path / "images", {.controller = &session});
  }
};

std::string hear(Socket& socket) {
  beast::flat_buffer buffer;
  socket.read(buffer);
  return beast::buffers_to_string(buffer.data());
}

void say(Socket& socket, const std::string& text) { socket.write(asio::buffer(text)); }

// Sends the token, and returns the first message that follows, the outline.
std::string enter(const Served& served, Socket& socket) {
  say(socket, "{\"token\": \"" + served.token() + "\"}");
  return hear(socket);
}

// Reads an update. Returns its history (null if the page has it) and state.
std::pair<nlohmann::json, nlohmann::json> hear_update(Socket& socket) {
  nlohmann::json history;
  for (;;) {
    const auto text = hear(socket);
    if (!text.starts_with('{')) continue;  // a picture
    const auto message = nlohmann::json::parse(text);
    if (message.contains("history")) history = message.at("history");
    if (message.contains("state")) return {history, message.at("state")};
  }
}

// Requests an update and reads it.
auto look(Socket& socket) {
  say(socket, R"({"want": "frame"})");
  return hear_update(socket);
}

bool is_closed_to(Socket& socket, const std::string& text) {
  try {
    say(socket, text);
    hear(socket);
    return false;
  } catch (const beast::system_error&) {
    return true;
  }
}

TEST(LiveServer, GivesItsFilesAndNothingElse) {
  Served served;
  const auto page = served.get("/", served.host());
  EXPECT_EQ(page.result(), http::status::ok);
  EXPECT_NE(page.body().find("<!DOCTYPE html>"), std::string::npos);
  EXPECT_NE(page["Content-Security-Policy"].find("default-src 'none'"), beast::string_view::npos);
  for (const char* file :
       {"/live.js", "/live.css", "/picture.js", "/machine.js", "/charts.js", "/orders.js"})
    EXPECT_EQ(served.get(file, served.host()).result(), http::status::ok) << file;
  for (const char* path : {"/../../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd", "/live.js/..",
                           "/results", "/index.html?x", "*", "/LIVE.JS"})
    EXPECT_EQ(served.get(path, served.host()).result(), http::status::not_found) << path;
  EXPECT_EQ(served.get("/", served.host(), http::verb::delete_).result(),
            http::status::method_not_allowed);
}

TEST(LiveServer, ANameOfAnotherHostIsRefused) {
  Served served;
  EXPECT_EQ(served.get("/", "localhost:" + served.port()).result(), http::status::ok);
  for (const auto& host : {std::string("evil.example"), "evil.example:" + served.port(),
                           std::string("127.0.0.1"), std::string("127.0.0.1:1"), std::string()})
    EXPECT_EQ(served.get("/", host).result(), http::status::misdirected_request) << host;
}

TEST(LiveServer, APageOfAnotherSiteIsRefused) {
  Served served;
  for (const auto& origin : {std::string(), std::string("null"), std::string("http://evil.example"),
                             "https://" + served.host(), std::string("http://127.0.0.1:1"),
                             "http://" + served.host() + ".evil.example"})
    EXPECT_THROW(served.open(origin, served.host()), beast::system_error) << origin;
  EXPECT_NO_THROW(served.open("http://localhost:" + served.port(), served.host()));
}

TEST(LiveServer, WithoutTheTokenNothingIsTold) {
  Served served;
  const auto token = served.token();
  ASSERT_EQ(token.size(), 32u);
  std::string wrong = token;
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  for (const auto& text :
       {std::string("{}"), std::string("{\"token\": 5}"), std::string("{\"want\": \"frame\"}"),
        "{\"token\": \"" + wrong + "\"}", "{\"token\": \"" + token.substr(1) + "\"}",
        "\"" + token + "\"", std::string("[")}) {
    auto socket = served.open();
    EXPECT_TRUE(is_closed_to(socket, text)) << text;
  }
}

// The page sends commands while the simulation runs in another thread.
TEST(LiveServer, APageSeesTheRunAndSteersIt) {
  test::run_isolated([] {
    Served served;
    PointResult result;
    std::thread run([&] { result = served.run(); });
    auto socket = served.open();
    const auto outline = nlohmann::json::parse(enter(served, socket)).at("outline");
    EXPECT_EQ(outline.at("program"), "farm");
    EXPECT_EQ(outline.at("processors").size(), 5u);
    EXPECT_EQ(outline.at("picture").at("width"), 16);
    auto second = served.open();
    EXPECT_EQ(nlohmann::json::parse(enter(served, second)).at("steers"), false);
    say(second, "{\"do\": \"pause\", \"id\": 1}");
    EXPECT_NE(hear(second).find("another page controls the run"), std::string::npos);
    // The first order may arrive before the interactive phase begins, and is refused then. So it is
    // sent again until it is accepted.
    for (std::string reply; reply != "{\"reply\":2,\"refusal\":\"\"}";) {
      say(socket, "{\"do\": \"order\", \"order\": {\"non_interactive\": true}, \"id\": 2}");
      reply = hear(socket);
      if (reply.find("over") != std::string::npos) break;
    }
    run.join();
    say(socket, "{\"want\": \"frame\"}");
    std::string tiles = hear(socket);
    ASSERT_GT(tiles.size(), 9u);
    // the tiles belong to the picture of the run, not to the sequential picture
    EXPECT_EQ(tiles[0], 0);
    EXPECT_EQ(tiles.size(), 1 + 8 + 3 * 16 * 12u);
    const auto state = hear_update(socket).second;
    EXPECT_EQ(state.at("state"), "over");
    EXPECT_EQ(state.at("cpus").size(), 5u);
    EXPECT_EQ(result.ended, "done");
    say(second, "{\"do\": \"steer\", \"id\": 7}");
    EXPECT_EQ(hear(second), "{\"steers\":true}");
    EXPECT_EQ(hear(second), "{\"reply\":7,\"refusal\":\"\"}");
  });
}

// Sends an order until the program accepts it, since orders before the first task are refused.
void give(Socket& socket, const std::string& order) {
  for (std::string reply; reply != "{\"reply\":2,\"refusal\":\"\"}";) {
    say(socket, R"({"do": "order", "id": 2, "order": )" + order + "}");
    reply = hear(socket);
    ASSERT_EQ(reply.find("after the end"), std::string::npos) << reply;
  }
}

TEST(LiveServer, ANewPageGetsTheCompleteState) {
  test::run_isolated([] {
    Served served;
    std::thread run([&] { served.run(); });
    auto first = served.open();
    const auto outline = nlohmann::json::parse(enter(served, first)).at("outline");
    give(first, R"({"min_cell": 4, "area": [2, 3, 8, 6]})");
    nlohmann::json seen = look(first).first.at("samples");
    give(first, R"({"non_interactive": true})");
    run.join();
    const auto [rest, last] = look(first);
    for (const auto& sample : rest.at("samples")) {
      // A sample replaces the sample of the same time.
      if (seen.back()[1] == sample[1]) seen.erase(seen.size() - 1);
      seen.push_back(sample);
    }

    auto late = served.open();
    enter(served, late);
    const auto [history, state] = look(late);
    EXPECT_EQ(state, last);
    const auto& actions = history.at("actions");
    ASSERT_GE(actions.size(), 2u);
    EXPECT_EQ(actions[0].at("order").at("min_cell"), 4);
    EXPECT_EQ(actions[1].at("order"), nlohmann::json({{"non_interactive", true}}));
    std::map<std::string, nlohmann::json> limits;
    for (std::size_t i = 0; i < state.at("limits").size(); ++i)
      limits[outline.at("limits").at(i).at("name")] = state.at("limits").at(i);
    EXPECT_EQ(limits["min_cell"], 4);
    EXPECT_EQ(limits["area"], nlohmann::json({2, 3, 8, 6}));
    const auto& samples = history.at("samples");
    EXPECT_EQ(samples[0][1], 0) << "the time of the first sample";
    EXPECT_EQ(samples.back()[1], state.at("t_s"));
    EXPECT_EQ(samples.back()[2], state.at("gauges")[0]);
    EXPECT_EQ(samples[0].size(), outline.at("gauges").size() + 5) << "number, time, loads, error";
    EXPECT_EQ(seen, samples) << "the page that was open all the time has the same history";
  });
}

// The page requests control repeatedly, and reads nothing.
TEST(LiveServer, APageThatReadsNothingIsShutAndHurtsNobody) {
  test::run_isolated([] {
    Served served;
    served.run();
    std::vector<Socket> pages;
    for (int i = 0; i < 3; ++i) {
      pages.push_back(served.open());
      enter(served, pages.back());
    }
    beast::error_code error;
    for (int i = 0; i < 300 && !error; ++i)
      pages[0].write(asio::buffer(std::string(R"({"do": "steer"})")), error);
    EXPECT_EQ(served.get("/", served.host()).result(), http::status::ok);
    auto late = served.open();
    EXPECT_NE(enter(served, late).find("outline"), std::string::npos);
  });
}

void expect_bad_request(Served& served, const std::string& request) {
  auto socket = served.connect();
  asio::write(socket, asio::buffer(request));
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  http::read(socket, buffer, response);
  EXPECT_EQ(response.result(), http::status::bad_request);
}

TEST(LiveServer, TwoHostsOrOriginsAreABadRequest) {
  Served served;
  const auto host = "Host: " + served.host() + "\r\n";
  const auto origin = "Origin: http://" + served.host() + "\r\n";
  expect_bad_request(served, "GET / HTTP/1.1\r\n" + host + host + "\r\n");
  expect_bad_request(served, "GET /live HTTP/1.1\r\n" + host +
                                 "Upgrade: websocket\r\nConnection: Upgrade\r\n" + origin +
                                 "Origin: http://other\r\n\r\n");
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// A client waits to be accepted while the process may not open another descriptor.
TEST(LiveServer, IsIdleWithoutDescriptors) {
  test::run_isolated([] {
    Served served;
    tcp::socket socket(served.io, tcp::v4());
    const auto port = static_cast<std::uint16_t>(std::stoi(served.port()));
    rlimit before{};
    getrlimit(RLIMIT_NOFILE, &before);
    rlimit none = before;
    // the process already has descriptors with these numbers, so it can open no more
    none.rlim_cur = 3;
    setrlimit(RLIMIT_NOFILE, &none);
    socket.connect({asio::ip::address_v4::loopback(), port});
    const double from_s = cpu_seconds();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    EXPECT_LT(cpu_seconds() - from_s, 0.1);
    setrlimit(RLIMIT_NOFILE, &before);
    EXPECT_EQ(served.get("/", served.host()).result(), http::status::ok);
  });
}

// Many silent clients neither keep new pages out nor disconnect a page that is already there.
TEST(LiveServer, StrangersLeaveRoomForPages) {
  test::run_isolated([] {
    Served served;
    served.run();
    std::vector<tcp::socket> pending;
    std::vector<Socket> silent;  // connected by web sockets, but without sending the token
    const auto bring_strangers = [&] {
      for (int i = 0; i < 150; ++i) pending.push_back(served.connect());
      for (int i = 0; i < 80; ++i) silent.push_back(served.open());
      // the server still accepts clients
      EXPECT_EQ(served.get("/", served.host()).result(), http::status::ok);
    };
    bring_strangers();
    auto page = served.open();
    EXPECT_NE(enter(served, page).find("outline"), std::string::npos);
    bring_strangers();
    EXPECT_EQ(look(page).second.at("state"), "over");
    std::vector<Socket> pages;
    for (std::size_t i = 1; i < MOST_CLIENTS; ++i) {
      pages.push_back(served.open());
      enter(served, pages.back());
    }
    auto one_too_many = served.open();
    EXPECT_TRUE(is_closed_to(one_too_many, "{\"token\": \"" + served.token() + "\"}"));
  });
}

// File names in messages need not be valid UTF-8.
TEST(LiveServer, AnyTextCanBeTold) {
  test::run_isolated([] {
    Served served;
    served.run();
    served.session.say_results("caf\xe9");
    auto socket = served.open();
    enter(served, socket);
    const auto results = look(socket).second.at("results").get<std::string>();
    EXPECT_TRUE(results.starts_with("caf")) << results;
  });
}

long memory_kb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

// The environment variable TLAB_HOSTILE gives the number of clients, for example 100000.
TEST(LiveServer, HostileClientsDoNotGetInNorStopIt) {
  const char* asked = std::getenv("TLAB_HOSTILE");
  const int clients = asked ? std::atoi(asked) : 2000;
  constexpr std::uint64_t SEED = 21;
  base::Random random(SEED);
  Served served;
  std::vector<tcp::socket> half_open;
  const long before_kb = memory_kb();
  for (int i = 0; i < clients; ++i) {
    auto socket = served.connect();
    beast::error_code error;
    const auto request = random_request(random, served.host());
    asio::write(socket, asio::buffer(request), error);
    if (random.below(20) == 0 && half_open.size() < 40) {
      half_open.push_back(std::move(socket));
      continue;
    }
    socket.shutdown(tcp::socket::shutdown_send, error);
    std::string answer(4096, '\0');
    const auto length = socket.read_some(asio::buffer(answer), error);
    answer.resize(error ? 0 : length);
    EXPECT_EQ(answer.find("outline"), std::string::npos) << "seed " << SEED << ", client " << i;
  }
  half_open.clear();
  EXPECT_LT(memory_kb() - before_kb, 32 * 1024);
  // until the server has closed the half-open connections
  for (int tries = 0; tries < 100; ++tries) {
    try {
      EXPECT_EQ(served.get("/", served.host()).result(), http::status::ok);
      return;
    } catch (const beast::system_error&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  FAIL() << "the server does not answer any more";
}

TEST(LiveServer, APortThatIsTakenIsNamed) {
  Served first;
  try {
    const Server second(first.session, static_cast<std::uint16_t>(std::stoi(first.port())));
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_NE(std::string(failure.what()).find("port " + first.port()), std::string::npos);
    EXPECT_EQ(failure.exit_code, EXIT_HOST);
  }
}

}  // namespace
}  // namespace laboratory
