// Tests the HTTP server with clients on loopback sockets.

#include "tools/service/http/server.h"

#include <chrono>
#include <csignal>
#include <thread>

#include "catch.h"
#include "client.h"
#include "served.h"
#include "test_handler.h"

using namespace sgm;
using namespace sgm::service::http;
using namespace std::chrono_literals;

TEST_CASE("A connection takes one request after another", "[threads]") {
  Served served;
  Client client(served.server->port());
  for (int i = 0; i < 20; ++i) {
    const auto answer = client.ask(i % 2 ? post("/p", "body" + std::to_string(i)) : kGet);
    REQUIRE(answer);
    CHECK(answer->status == 200);
    CHECK(answer->body == (i % 2 ? "POST /p body" + std::to_string(i) : "GET /a "));
    CHECK(answer->fields.count("Connection") == 0);
  }
  CHECK(served.server->counts().accepted == 1);
  CHECK(served.server->counts().answers[200] == 20);
}

TEST_CASE("Pipelined requests are answered in order, whoever answers first", "[threads]") {
  Served served;
  Client client(served.server->port());
  client.say(get("/later") + post("/p", "1") + get("/2") + get("/later") + get("/3"));
  Reply first = served.handler.takeReply();
  CHECK_FALSE(client.ended(20ms));
  std::thread([&] { first(makeResponse(200, "text/plain", "first")); }).join();
  for (const char* body : {"first", "POST /p 1", "GET /2 "}) {
    const auto answer = client.hear();
    REQUIRE(answer);
    CHECK(answer->body == body);
  }
  served.handler.takeReply()(makeResponse(200, "text/plain", "fourth"));
  CHECK(client.hear().value().body == "fourth");
  CHECK(client.hear().value().body == "GET /3 ");
}

TEST_CASE("HTTP/1.0 closes unless asked not to, and Connection: close is honoured", "[threads]") {
  Served served;
  const uint16_t port = served.server->port();
  Client old(port);
  const auto answer = old.ask("GET /a HTTP/1.0\r\n\r\n");
  REQUIRE(answer);
  CHECK(answer->fields.at("Connection") == "close");
  CHECK(old.ended());
  Client kept(port);
  for (int i = 0; i < 2; ++i)
    CHECK(kept.ask("GET /a HTTP/1.0\r\nConnection: keep-alive\r\n\r\n").value().fields.at("Connection") ==
          "keep-alive");
  Client closing(port);
  CHECK(closing.ask("GET /a HTTP/1.1\r\nHost: h\r\nConnection: close\r\n\r\n").value().fields.at("Connection") ==
        "close");
  CHECK(closing.ended());
  Client told(port);
  CHECK(told.ask(get("/bye")).value().fields.at("Connection") == "close");
  CHECK(told.ended());
}

TEST_CASE("HEAD says what GET would, without the body", "[threads]") {
  Served served;
  Client client(served.server->port());
  client.say("HEAD /a HTTP/1.1\r\nHost: h\r\n\r\n");
  const auto answer = client.hear(true);
  REQUIRE(answer);
  CHECK(answer->fields.at("Content-Length") == "8");
  CHECK(client.ask(kGet).value().body == "GET /a ");
}

TEST_CASE("Every answer has the fields that the server writes", "[threads]") {
  Served served;
  Client client(served.server->port());
  const auto answer = client.ask(kGet);
  REQUIRE(answer);
  CHECK(answer->fields.at("X-Content-Type-Options") == "nosniff");
  CHECK(answer->fields.at("Cache-Control") == "no-store");
  CHECK(answer->fields.at("Referrer-Policy") == "no-referrer");
  CHECK(answer->fields.at("Content-Type") == "text/plain");
  CHECK(answer->fields.at("Date").size() == 29);
  CHECK(client.ask(get("/cached")).value().fields.at("Cache-Control") == "no-cache");
  const auto empty = client.ask(get("/empty"));
  CHECK(empty->status == 204);
  CHECK(empty->fields.count("Content-Length") == 0);
  const auto problem = client.ask("GET / HTTP/1.1\r\n\r\n");
  CHECK(problem->status == 400);
  CHECK(problem->fields.at("Content-Type") == "application/problem+json");
  CHECK(problem->fields.at("X-Content-Type-Options") == "nosniff");
}

TEST_CASE("A body in chunks, or waited for with 100, arrives", "[threads]") {
  Served served;
  Client client(served.server->port());
  const std::string chunked = "POST /c HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n";
  CHECK(client.ask(chunked + "\r\n3\r\nabc\r\n2;x=y\r\nde\r\n0\r\nA: b\r\n\r\n").value().body == "POST /c abcde");
  client.say(chunked + "Expect: 100-continue\r\n\r\n");
  CHECK(client.hear().value().status == 100);
  CHECK(client.ask("1\r\nz\r\n0\r\n\r\n").value().body == "POST /c z");
  CHECK(client.ask(kGet).value().status == 200);
  // The server answers a refused request at once, without waiting for the request's body.
  client.say("POST /c HTTP/1.1\r\nHost: h\r\nContent-Length: 1001\r\nExpect: 100-continue\r\n\r\n");
  CHECK(client.hear().value().status == 413);
  CHECK(client.ended());
}

TEST_CASE("A client that is refused in the middle of its body sees why", "[threads]") {
  Served served;
  const uint16_t port = served.server->port();
  const std::string much(size_t{8} << 20, 'x');
  // Like a simple client, this client sends its whole body before it reads the answer.
  const auto refused = [&](const std::string& head, const std::string& body, int status) {
    INFO(head.substr(0, 80));
    Client client(port);
    CHECK(client.say(head));
    CHECK(client.say(body));
    const auto answer = client.hear();
    REQUIRE(answer);
    CHECK(answer->status == status);
    CHECK(answer->fields.at("Connection") == "close");
    client.endSaying();
    CHECK(client.ended());
    CHECK_FALSE(client.wasReset());
  };
  const std::string length = "\r\nHost: h\r\nContent-Length: " + std::to_string(much.size()) + "\r\n\r\n";
  const std::string chunks = "\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n800000\r\n";
  refused("POST /p HTTP/1.1" + length, much, 413);
  refused("POST /p HTTP/1.1" + chunks, much, 413);
  refused("GET /p HTTP/1.1" + length, much, 413);
  refused("GET /p HTTP/1.1" + chunks, much, 413);
  refused("POST /large HTTP/1.1" + length, "STOP" + much.substr(4), 422);
  refused("POST /large HTTP/1.1" + length, "THROW" + much.substr(5), 500);
  refused("POST /forbidden HTTP/1.1" + length, much, 403);
  refused("POST /throw/admit HTTP/1.1" + length, much, 500);
  refused("POST /large HTTP/1.1\r\nHost: h\r\nContent-Encoding: gzip\r\nContent-Length: 8388608\r\n\r\n", much, 415);
  refused("GET /" + much, "", 414);
  refused("GET / HTTP/1.1\r\nA: " + much, "", 431);
}

TEST_CASE("A refusal of a request without a body leaves the connection open", "[threads]") {
  Served served;
  Client client(served.server->port());
  CHECK(client.ask(get("/forbidden") + kGet).value().status == 403);
  CHECK(client.hear().value().body == "GET /a ");
  CHECK(client.ask("POST /forbidden HTTP/1.1\r\nHost: h\r\n\r\n").value().status == 403);
  CHECK(client.ask(kGet).value().body == "GET /a ");
}

TEST_CASE("Whatever a handler does, the client has one answer", "[threads]") {
  Served served;
  Client client(served.server->port());
  CHECK(client.ask(get("/throw")).value().status == 500);
  CHECK(client.ask(get("/drop")).value().status == 500);
  CHECK(client.ask(get("/twice")).value().body == "first");
  const auto split = client.ask(get("/split"));
  CHECK(split->status == 500);
  CHECK(split->fields.count("X-B") == 0);
  CHECK(client.ask(get("/throw/admit")).value().status == 500);
  client.say(get("/later"));
  served.handler.takeReply() = nullptr;
  CHECK(client.hear().value().status == 500);
  CHECK(client.ask(kGet).value().body == "GET /a ");
  CHECK(served.server->counts().answers[500] == 5);
}

TEST_CASE("A server that stops lets requests in work be answered, and no others", "[threads]") {
  Served served;
  const uint16_t port = served.server->port();
  Client idle(port), head(port), work(port), body(port);
  CHECK(idle.ask(kGet).value().status == 200);
  head.say("GET / HT");
  work.say(get("/later"));
  Reply reply = served.handler.takeReply();
  body.say("POST /p HTTP/1.1\r\nHost: h\r\nContent-Length: 4\r\n\r\nab");
  CHECK(soon([&] { return served.server->counts().connections == 4; }));
  std::this_thread::sleep_for(20ms);
  std::thread stopping([&] { served.server->stop(10s); });
  CHECK(idle.ended());
  CHECK(head.ended());
  CHECK_FALSE(work.ended(20ms));
  reply(makeResponse(200, "text/plain", "in time"));
  const auto answer = work.hear();
  REQUIRE(answer);
  CHECK(answer->body == "in time");
  CHECK(answer->fields.at("Connection") == "close");
  CHECK(work.ended());
  CHECK(body.ask("cd").value().body == "POST /p abcd");
  const auto begin = Clock::now();
  work.endSaying();
  body.endSaying();
  stopping.join();
  CHECK(Clock::now() - begin < 5s);
  CHECK(served.server->counts().connections == 0);
  served.server->stop(10s);
}

TEST_CASE("A server that stops without time waits for nobody, and late replies do nothing", "[threads]") {
  Served served;
  Client work(served.server->port());
  work.say(get("/later"));
  Reply reply = served.handler.takeReply();
  SECTION("stopped") { served.server->stop(0ms); }
  SECTION("stopped after a while") { served.server->stop(30ms); }
  SECTION("gone") { served.server.reset(); }
  CHECK(work.ended());
  Reply copy = reply;
  std::thread([&] { reply(makeResponse(200, "text/plain", "late")); }).join();
  copy = nullptr;
}

TEST_CASE("Replies may come from many threads, also where the client has gone", "[threads]") {
  Served served;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 25; ++i) {
        auto client = std::make_unique<Client>(served.server->port());
        client->say(get("/later"));
        if ((i + t) % 3 == 0) client.reset();
        served.handler.takeReply()(makeResponse(200, "text/plain", "x"));
        // Wait at most 1 ms for this connection to end: the reply above may have gone to another thread's client.
        if (client) client->ended(1ms);
      }
    });
  for (std::thread& thread : threads) thread.join();
  Client client(served.server->port());
  CHECK(client.ask(kGet).value().status == 200);
}

TEST_CASE("A server says why it cannot listen", "[threads]") {
  Served served;
  ServerSettings settings;
  settings.port = served.server->port();
  const auto taken = Server::start(settings, served.handler);
  REQUIRE_FALSE(taken);
  CHECK(taken.error().code == Code::io);
  CHECK(taken.error().message.find("in use") != std::string::npos);
  settings.address = "localhost";
  const auto named = Server::start(settings, served.handler);
  REQUIRE_FALSE(named);
  CHECK(named.error().code == Code::invalid_argument);
  settings.address = "192.0.2.1";
  const auto foreign = Server::start(settings, served.handler);
  REQUIRE_FALSE(foreign);
  CHECK(foreign.error().code == Code::io);
}

TEST_CASE("A server listens on an address of IPv6") {
  TestHandler handler;
  ServerSettings settings;
  settings.address = "::1";
  const auto started = Server::start(settings, handler);
  if (!started) {
    WARN("no IPv6 here: " << started.error().message);
    return;
  }
  CHECK((*started)->port() != 0);
}

TEST_CASE("A server's thread leaves signals to the program, but for those of its own faults", "[threads]") {
  struct MaskHandler final : TestHandler {
    void answer(const Request&, std::unique_ptr<Body>, Reply reply) override {
      sigset_t mask;
      pthread_sigmask(SIG_SETMASK, nullptr, &mask);
      std::string blocked;
      for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS, SIGTERM, SIGINT, SIGCHLD})
        blocked += sigismember(&mask, number) ? '1' : '0';
      reply(makeResponse(200, "text/plain", blocked));
    }
  };
  MaskHandler handler;
  sigset_t before, after;
  pthread_sigmask(SIG_SETMASK, nullptr, &before);
  auto server = Server::start({}, handler);
  REQUIRE(server);
  pthread_sigmask(SIG_SETMASK, nullptr, &after);
  for (int number = 1; number < SIGRTMAX; ++number) CHECK(sigismember(&before, number) == sigismember(&after, number));
  Client client((*server)->port());
  CHECK(client.ask(kGet).value().body == "0000000111");
}

TEST_CASE("A problem is written as JSON whatever it says") {
  const Response response = makeResponse(Problem{422, "bad_input", "a \"b\" \\ \n \xC3\xA9 \xFF", "/a/0"});
  CHECK(response.status == 422);
  CHECK(response.type == "application/problem+json");
  CHECK(*response.body ==
        "{\"type\":\"about:blank\",\"title\":\"Unprocessable Entity\",\"status\":422,\"code\":\"bad_input\","
        "\"detail\":\"a \\\"b\\\" \\\\ \\u000a \xC3\xA9 \\ufffd\",\"pointer\":\"/a/0\"}\n");
  CHECK(makeResponse(Problem{400, "a", "b", ""}).body->find("pointer") == std::string::npos);
}
