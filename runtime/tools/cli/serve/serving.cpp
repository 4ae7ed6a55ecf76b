#include "tools/support/serving.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include "base/file_reader.h"
#include "base/platform/process.h"
#include "tools/flight/flight_engine.h"

namespace sgm::cli {
namespace {

Result<std::string> readToken(const std::string& file) {
  constexpr uint64_t kMaxTokenBytes = uint64_t{1} << 20;
  const Result<std::string> text = readFile(file, kMaxTokenBytes, Readable::all_but_folders);
  if (!text) return text.error();
  if (text->empty())
    return Error{Code::io, fmt::format("cannot read a token from the first line of {}: it is empty", file)};
  std::string token = text->substr(0, text->find('\n'));
  while (!token.empty() && (token.back() == '\r' || token.back() == ' ')) token.pop_back();
  return token;
}

std::string urlOf(const std::string& address, uint16_t port) {
  return address.find(':') == std::string::npos ? fmt::format("http://{}:{}", address, port)
                                                : fmt::format("http://[{}]:{}", address, port);
}

/// Raises the limit of open files: each client needs a file descriptor, and shells set limits as low as 1,024.
void allowManyFiles() {
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  files.rlim_cur = files.rlim_max;
  setrlimit(RLIMIT_NOFILE, &files);
}

}  // namespace

Result<Serving> Serving::start(const ServingOptions& options) {
  allowManyFiles();
  std::string token;
  if (!options.token_file.empty()) {
    Result<std::string> read = readToken(options.token_file);
    if (!read) return read.error();
    token = std::move(*read);
  }
  // The service inspects each upload in a new process of this same program.
  const Result<std::string> program = platform::ownProgram();
  if (!program) return program.error();
  std::vector<const char*> hosts;
  for (const std::string& host : options.hosts) hosts.push_back(host.c_str());
  const auto textOrNull = [](const std::string& text) { return text.empty() ? nullptr : text.c_str(); };

  sgm_service_desc desc = SGM_SERVICE_DESC_INIT;
  desc.work_port = options.port;
  desc.operations_port = options.operations_port;
  desc.address = options.listen.c_str();
  desc.token = options.token_file.empty() ? nullptr : token.c_str();
  desc.host_names = hosts.data();
  desc.host_name_count = hosts.size();
  desc.inspector = program->c_str();
  desc.masters = textOrNull(options.masters);
  desc.upload_folder = textOrNull(options.upload_folder);
  desc.upload_bytes = options.upload_mb << 20;
  desc.inspector_memory = options.memory_mb << 20;
  desc.inspector_seconds = options.seconds;
  desc.inspector_jobs = options.jobs;
  desc.inspector_waiting = options.waiting;
  sgm_error error = SGM_ERROR_INIT;
  sgm_service* service = nullptr;
  if (sgm_service_start(&desc, &service, &error) != SGM_OK) return errorOf(error);
  Serving serving;
  serving.service_.reset(service);
  uint16_t work = 0, operations = 0;
  static_cast<void>(sgm_service_get_ports(service, &work, &operations, nullptr));
  serving.work_ = urlOf(options.listen, work);
  serving.operations_ = urlOf(options.listen, operations);
  return serving;
}

void Serving::Stop::operator()(sgm_service* service) const {
  static_cast<void>(sgm_service_stop(service, kGraceMilliseconds));
}

Result<void> Serving::watch(const std::string& name, sgm_world* world) {
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_service_watch_world(service_.get(), name.c_str(), world, &error) != SGM_OK) return errorOf(error);
  return {};
}

}  // namespace sgm::cli
