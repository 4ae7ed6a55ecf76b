// Tests sgm_service.h: which arguments it rejects, and that services that it starts can be stopped.

#include <arpa/inet.h>
#include <sgm/sgm_service.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "../catch.h"

namespace {

/// Returns the whole answer to a request on this port; empty if no server listens there.
std::string ask(uint16_t port, const std::string& path) {
  const std::string request = "GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int client = socket(AF_INET, SOCK_STREAM, 0);
  std::string answer;
  if (connect(client, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0 &&
      write(client, request.data(), request.size()) == static_cast<ssize_t>(request.size())) {
    char piece[4096];
    for (ssize_t size = 0; (size = read(client, piece, sizeof piece)) > 0;)
      answer.append(piece, static_cast<size_t>(size));
  }
  close(client);
  return answer;
}

struct Service {
  sgm_service* handle = nullptr;
  uint16_t work = 0, operations = 0;

  explicit Service(const sgm_service_desc& desc) {
    sgm_error error = SGM_ERROR_INIT;
    const sgm_result result = sgm_service_start(&desc, &handle, &error);
    INFO(error.message);
    REQUIRE(result == SGM_OK);
    REQUIRE(sgm_service_get_ports(handle, &work, &operations, nullptr) == SGM_OK);
  }
  ~Service() { sgm_service_stop(handle, 0); }
};

sgm_result startWith(const sgm_service_desc* desc, std::string* message = nullptr) {
  sgm_error error = SGM_ERROR_INIT;
  auto* service = reinterpret_cast<sgm_service*>(1);
  const sgm_result result = sgm_service_start(desc, &service, &error);
  CHECK(service == nullptr);
  CHECK(error.code == result);
  CHECK(std::strlen(error.message) > 0);
  if (message != nullptr) *message = error.message;
  return result;
}

size_t openFiles() {
  size_t count = 0;
  for (const auto& each : std::filesystem::directory_iterator("/proc/self/fd")) count += each.path().empty() ? 0u : 1u;
  return count;
}

}  // namespace

TEST_CASE("a service starts, answers on both ports, and leaves nothing behind", "[threads]") {
  { const Service warm_up(SGM_SERVICE_DESC_INIT); }
  const size_t before = openFiles();
  for (int i = 0; i < 3; ++i) {
    const Service service(SGM_SERVICE_DESC_INIT);
    CHECK(service.work != service.operations);
    CHECK(ask(service.operations, "/healthz").starts_with("HTTP/1.1 200 OK\r\n"));
    CHECK(ask(service.operations, "/readyz").find("\"degraded\":true") != std::string::npos);
    CHECK(ask(service.operations, "/metrics").find("sgm_worlds 0") != std::string::npos);
    CHECK(ask(service.work, "/").find("<!doctype html>") != std::string::npos);
    CHECK(ask(service.work, "/api/v1/summary").find("\"worlds\":[]") != std::string::npos);
    CHECK(ask(service.work, "/healthz").starts_with("HTTP/1.1 404 "));
  }
  CHECK(openFiles() == before);
}

TEST_CASE("many ask while it stops", "[threads]") {
  auto service = std::make_unique<Service>(sgm_service_desc(SGM_SERVICE_DESC_INIT));
  const uint16_t work = service->work;
  const uint16_t operations = service->operations;
  std::vector<std::thread> clients;
  for (int i = 0; i < 4; ++i) {
    clients.emplace_back([=] {
      for (int j = 0; j < 20; ++j) {
        ask(work, "/api/v1/summary");
        ask(operations, "/metrics");
      }
    });
  }
  service.reset();
  for (std::thread& client : clients) client.join();
  CHECK(ask(work, "/").empty());
}

TEST_CASE("what cannot be is refused, with a word on what to do") {
  CHECK(startWith(nullptr) == SGM_ERR_INVALID_ARGUMENT);
  sgm_error error = SGM_ERROR_INIT;
  const sgm_service_desc whole = SGM_SERVICE_DESC_INIT;
  CHECK(sgm_service_start(&whole, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  const auto with = [](auto change) {
    sgm_service_desc desc = SGM_SERVICE_DESC_INIT;
    change(desc);
    return startWith(&desc);
  };
  CHECK(with([](auto& d) { d.struct_size = 4; }) == SGM_ERR_STRUCT_SIZE);
  CHECK(with([](auto& d) { d.next = &d; }) == SGM_ERR_UNSUPPORTED);
  CHECK(with([](auto& d) { d.api_version = 1; }) == SGM_ERR_VERSION);
  CHECK(with([](auto& d) { d.address = "localhost"; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.address = "0.0.0.0"; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.token = "short"; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.token = ""; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.host_name_count = 1; }) == SGM_ERR_INVALID_ARGUMENT);
  const char* names[] = {nullptr};
  CHECK(with([&](auto& d) { d.host_names = names, d.host_name_count = 1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.work_port = d.operations_port = 9; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.upload_bytes = (uint64_t{1} << 32) + 1; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.inspector_jobs = 65; }) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(with([](auto& d) { d.inspector_waiting = 4097; }) == SGM_ERR_INVALID_ARGUMENT);
}

TEST_CASE("a port that is in use is said") {
  const Service first(SGM_SERVICE_DESC_INIT);
  sgm_service_desc desc = SGM_SERVICE_DESC_INIT;
  desc.work_port = first.work;
  std::string message;
  CHECK(startWith(&desc, &message) == SGM_ERR_IO);
  CHECK(message.find(std::to_string(first.work)) != std::string::npos);
}

TEST_CASE("NULL for what is needed is refused, and for an end does nothing") {
  const Service service(SGM_SERVICE_DESC_INIT);
  sgm_error error = SGM_ERROR_INIT;
  CHECK(sgm_service_get_ports(nullptr, nullptr, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_service_get_ports(service.handle, nullptr, nullptr, &error) == SGM_OK);
  CHECK(sgm_service_watch_world(nullptr, "a", nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_service_watch_world(service.handle, "a", nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_service_forget_world(service.handle, nullptr, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_service_stop(nullptr, 0) == SGM_OK);
}
