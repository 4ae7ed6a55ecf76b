// Tests clients that try to use up a server's time, memory and descriptors. Time limits are some tens of milliseconds.

#include <sys/resource.h>
#include <sys/socket.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "catch.h"
#include "client.h"
#include "served.h"
#include "test_handler.h"
#include "tools/service/http/server.h"

using namespace sgm;
using namespace sgm::service::http;
using namespace std::chrono_literals;

TEST_CASE("A slow client has the time of its phase and no more, however it drips", "[threads]") {
  ServerSettings settings;
  settings.idle_time = 150ms;
  settings.head_time = 200ms;
  settings.body_time = 250ms;
  Served served(settings);
  const uint16_t port = served.server->port();
  const auto drips = [&](const std::string& before, const char* drip, std::chrono::milliseconds time) {
    Client client(port);
    const auto begin = Clock::now();
    client.say(before);
    std::atomic<bool> heard{false};
    std::thread dripping([&] {
      while (!heard && client.say(drip)) std::this_thread::sleep_for(10ms);
    });
    const auto answer = client.hear();
    heard = true;
    dripping.join();
    REQUIRE(answer);
    CHECK(answer->status == 408);
    CHECK(Clock::now() - begin >= time);
    CHECK(Clock::now() - begin < time + 2s);
  };
  drips("G", "E", settings.head_time);
  drips("GET / HTTP/1.1\r\n", "A: b\r\n", settings.head_time);
  drips("POST /p HTTP/1.1\r\nHost: h\r\nContent-Length: 900\r\n\r\n", "x", settings.body_time);
  drips("POST /p HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n", "1\r\nx\r\n", settings.body_time);

  Client silent(port), between(port);
  between.ask(kGet);
  const auto begin = Clock::now();
  CHECK(silent.ended());
  CHECK(between.ended());
  CHECK(Clock::now() - begin >= 100ms);
  CHECK(Clock::now() - begin < 2s);
  CHECK(soon([&] { return served.server->counts().connections == 0; }));
}

TEST_CASE("A client that does not take its answer is let go", "[threads]") {
  ServerSettings settings;
  settings.write_time = 100ms;
  Served served(settings);
  Client client(served.server->port());
  client.say(get("/big"));
  CHECK(soon([&] { return served.server->counts().answers[200] == 1; }));
  CHECK(soon([&] { return served.server->counts().connections == 0; }));
}

TEST_CASE("A client that never ends is not drained for ever", "[threads]") {
  ServerSettings settings;
  settings.drain_time = 100ms;
  settings.drain_bytes = 100000;
  Served served(settings);
  Client silent(served.server->port());
  CHECK(silent.ask("bad\r\n\r\n").value().status == 400);
  CHECK(soon([&] { return served.server->counts().connections == 0; }));
  Client loud(served.server->port());
  CHECK(loud.ask("bad\r\n\r\n").value().status == 400);
  const auto begin = Clock::now();
  while (loud.say(std::string(10000, 'x'))) REQUIRE(Clock::now() - begin < 5s);
}

TEST_CASE("Slow clients and long work do not delay others", "[threads]") {
  Served served;
  std::vector<std::unique_ptr<Client>> slow;
  for (int i = 0; i < 100; ++i) {
    slow.push_back(std::make_unique<Client>(served.server->port()));
    slow.back()->say(i % 3 == 0   ? "GET / HT"
                     : i % 3 == 1 ? "POST /p HTTP/1.1\r\nHost: h\r\nContent-Length: 9\r\n\r\nx"
                                  : get("/later"));
  }
  const auto begin = Clock::now();
  for (int i = 0; i < 20; ++i) {
    Client client(served.server->port());
    CHECK(client.ask(kGet).value().status == 200);
  }
  CHECK(Clock::now() - begin < 5s);
}

TEST_CASE("Clients beyond the limit are told so", "[threads]") {
  ServerSettings settings;
  settings.connections = 3;
  Served served(settings);
  {
    std::vector<std::unique_ptr<Client>> clients;
    for (int i = 0; i < 3; ++i) {
      clients.push_back(std::make_unique<Client>(served.server->port()));
      CHECK(clients.back()->ask(kGet).value().status == 200);
    }
    for (int i = 0; i < 5; ++i) {
      Client more(served.server->port());
      const auto answer = more.ask(kGet);
      REQUIRE(answer);
      CHECK(answer->status == 503);
      CHECK(answer->fields.at("Retry-After") == "1");
      CHECK(answer->body.find("\"code\":\"too_many_connections\"") != std::string::npos);
      CHECK(more.ended());
      CHECK_FALSE(more.wasReset());
    }
    const ServerCounts counts = served.server->counts();
    CHECK(counts.connections == 3);
    CHECK(counts.accepted == 3);
    CHECK(counts.turned_away == 5);
  }
  CHECK(soon([&] { return served.server->counts().connections == 0; }));
  Client again(served.server->port());
  CHECK(again.ask(kGet).value().status == 200);
}

/// Limits the number of files that the process may open, during this object's lifetime.
class FileLimit {
 public:
  explicit FileLimit(rlim_t files) {
    REQUIRE(getrlimit(RLIMIT_NOFILE, &before_) == 0);
    rlimit scarce = before_;
    scarce.rlim_cur = files;
    REQUIRE(setrlimit(RLIMIT_NOFILE, &scarce) == 0);
  }
  ~FileLimit() { setrlimit(RLIMIT_NOFILE, &before_); }
  FileLimit(const FileLimit&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;

 private:
  rlimit before_{};
};

TEST_CASE("A server without a file descriptor for another client closes it, and does not spin", "[threads]") {
  Served served;
  Client first(served.server->port());
  CHECK(first.ask(kGet).value().status == 200);
  const int lowest = ::dup(first.socket());
  REQUIRE(lowest >= 0);
  ::close(lowest);
  const auto seconds = [] {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  };
  {
    const FileLimit scarce(static_cast<rlim_t>(lowest) + 1);
    for (int i = 0; i < 20; ++i) {
      Client more(served.server->port());  // this client takes the last free file descriptor
      CHECK(more.ended());
    }
    Client more(served.server->port());
    const double begin = seconds();
    std::this_thread::sleep_for(300ms);
    CHECK(seconds() - begin < 0.15);
    CHECK(first.ask(kGet).value().status == 200);
  }
  CHECK(soon([&] { return served.server->counts().turned_away == 21; }));
  CHECK(served.server->counts().accepted == 1);
  Client again(served.server->port());
  CHECK(again.ask(kGet).value().status == 200);
}

TEST_CASE("One server with all the clients that it takes leaves another's to be answered", "[threads]") {
  const FileLimit scarce(400);
  CHECK(connectionsWithin(2048, 5) == 80);
  CHECK(connectionsWithin(20, 5) == 20);
  CHECK(connectionsWithin(2048, 1000) == 8);
  ServerSettings work_settings, operations_settings;
  work_settings.connections = connectionsWithin(2048, 5);
  operations_settings.connections = connectionsWithin(64, 16);
  Served work(work_settings), operations(operations_settings);
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 200; ++i) {
    clients.push_back(std::make_unique<Client>(work.server->port()));
    clients.back()->say(kGet);
  }
  CHECK(soon([&] { return work.server->counts().turned_away == 120; }));
  CHECK(work.server->counts().connections == 80);
  Client asking(operations.server->port());
  CHECK(asking.ask(kGet).value().status == 200);
}

TEST_CASE("A request that is worked on for too long is answered, and its reply does nothing", "[threads]") {
  ServerSettings settings;
  settings.work_time = 100ms;
  Served served(settings);
  Client client(served.server->port());
  const auto begin = Clock::now();
  client.say(get("/later") + kGet);
  Reply reply = served.handler.takeReply();
  const auto gone = served.handler.lastGone();
  REQUIRE(gone);
  CHECK_FALSE(*gone);
  const auto answer = client.hear();
  REQUIRE(answer);
  CHECK(Clock::now() - begin >= 100ms);
  CHECK(answer->status == 503);
  CHECK(answer->fields.at("Retry-After") == "1");
  CHECK(answer->fields.at("Connection") == "close");
  CHECK(answer->body.find("\"code\":\"work_timeout\"") != std::string::npos);
  CHECK(*gone);
  reply(makeResponse(200, "text/plain", "late"));
  CHECK(client.ended());
  CHECK(served.server->counts().answers[200] == 0);
}

TEST_CASE("A client that resets is noticed while its request is worked on", "[threads]") {
  Served served;
  auto client = std::make_unique<Client>(served.server->port());
  const bool urgent = GENERATE(false, true);
  client->say(get("/later"));
  if (urgent) REQUIRE(::send(client->socket(), "!", 1, MSG_OOB) == 1);
  Reply reply = served.handler.takeReply();
  const auto gone = served.handler.lastGone();
  REQUIRE(gone);
  std::this_thread::sleep_for(20ms);
  CHECK_FALSE(*gone);
  const linger at_once{1, 0};
  REQUIRE(::setsockopt(client->socket(), SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once) == 0);
  client.reset();
  if (!urgent) {
    CHECK(soon([&] { return gone->load(); }));
    CHECK(soon([&] { return served.server->counts().connections == 0; }));
  }
  reply(makeResponse(200, "text/plain", "late"));
  CHECK(soon([&] { return served.server->counts().connections == 0; }));
  CHECK(*gone);
  CHECK(served.server->counts().answers[200] == (urgent ? 1 : 0));
}

TEST_CASE("A client that ends its saying has its answer", "[threads]") {
  Served served;
  Client client(served.server->port());
  client.say(get("/later"));
  client.endSaying();
  Reply reply = served.handler.takeReply();
  const auto gone = served.handler.lastGone();
  CHECK_FALSE(client.ended(50ms));
  CHECK_FALSE(*gone);
  reply(makeResponse(200, "text/plain", "still"));
  CHECK(client.hear().value().body == "still");
  CHECK(client.ended());
  CHECK(soon([&] { return gone->load(); }));
}

TEST_CASE("Answers that are not taken are held up to a limit, and small ones always go", "[threads]") {
  constexpr size_t kMost = size_t{128} << 20, kAnswer = size_t{32} << 20;
  ServerSettings settings;
  settings.unsent_bytes = kMost;
  Served served(settings);
  const uint16_t port = served.server->port();
  std::vector<std::unique_ptr<Client>> clients;
  const auto count = [&](size_t status) { return served.server->counts().answers[status]; };
  for (uint64_t i = 1; i <= kMost / kAnswer; ++i) {
    clients.push_back(std::make_unique<Client>(port));
    clients.back()->say(get("/big"));
    CHECK(soon([&] { return count(200) == i; }));
  }
  {
    Client more(port);
    const auto answer = more.ask(get("/big"));
    REQUIRE(answer);
    CHECK(answer->status == 503);
    CHECK(answer->fields.at("Retry-After") == "1");
    CHECK(answer->fields.at("Connection") == "close");
    CHECK(answer->body.find("\"code\":\"too_much_unsent\"") != std::string::npos);
    Client small(port);
    CHECK(small.ask(kGet).value().status == 200);
    small.say("HEAD /big HTTP/1.1\r\nHost: h\r\n\r\n");
    CHECK(small.hear(true).value().fields.at("Content-Length") == std::to_string(kAnswer));
  }
  // A client that reads its answer, or one that disconnects, frees room for others.
  const bool taken = GENERATE(true, false);
  if (taken) CHECK(clients.back()->hear().value().body.size() == kAnswer);
  const uint64_t before = served.server->counts().connections;
  if (!taken) clients.pop_back();
  if (!taken) CHECK(soon([&] { return served.server->counts().connections < before; }));
  Client again(port);
  CHECK(again.ask(get("/big")).value().status == 200);
}

TEST_CASE("A body that answers share is held once, and one alone may be larger than the limit", "[threads]") {
  ServerSettings settings;
  settings.unsent_bytes = 5000;
  Served served(settings);
  const auto shared = std::make_shared<const std::string>(size_t{16} << 20, 's');
  std::vector<std::unique_ptr<Client>> clients;
  for (uint64_t i = 1; i <= 20; ++i) {
    clients.push_back(std::make_unique<Client>(served.server->port()));
    clients.back()->say(get("/later"));
    served.handler.takeReply()({200, "text/plain", {}, shared, false});
    CHECK(soon([&] { return served.server->counts().answers[200] == i; }));
  }
  Client other(served.server->port());
  CHECK(other.ask(get("/big")).value().status == 503);
}
