#include "tools/service/judge/upload.h"
#include "seed.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <random>

#include "../rounds.h"
#include "../temporary_folder.h"

using namespace sgm;
using namespace sgm::service;

TEST_CASE("the kind of an upload comes from its type, or else from its name") {
  const auto kind = [](const char* type, const char* name) {
    const std::optional<UploadKind> found = uploadKind(type, name);
    return found ? std::string(nameOf(*found)) : "none";
  };
  CHECK(kind("model/gltf-binary", "a.obj") == "glb");
  CHECK(kind("Model/OBJ; charset=utf-8", "") == "obj");
  CHECK(kind("model/ply", "") == "ply");
  CHECK(kind("application/x-ply", "") == "ply");
  CHECK(kind("model/stl", "x.glb") == "stl");
  CHECK(kind("text/x-sgm", "") == "sgm");
  CHECK(kind("", "a.b.GLB") == "glb");
  CHECK(kind("application/octet-stream", "cave.Sgm") == "sgm");
  CHECK(kind("application/octet-stream ; x=y", "a.stl") == "stl");
  CHECK(kind("", "glb") == "none");
  CHECK(kind("", "a.gltf") == "glb");
  CHECK(kind("model/gltf+json", "") == "glb");
  CHECK(kind("", "a.") == "none");
  CHECK(kind("", "") == "none");
  CHECK(kind("text/html", "a.glb") == "none");
  CHECK(kind("model/gltf-binary2", "a.glb") == "none");
}

TEST_CASE("an upload holds what was appended, in a file without a name") {
  const TemporaryFolder folder;
  const unsigned seed = testSeed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(20); ++round) {
    Result<Upload> made = Upload::create(folder.path.string());
    REQUIRE(made);
    std::string wanted;
    for (unsigned pieces = random() % 8; pieces > 0; --pieces) {
      std::string piece(random() % 100'000, '\0');
      for (char& c : piece) c = static_cast<char>(random());
      REQUIRE(made->append(piece));
      wanted += piece;
    }
    CHECK(std::filesystem::is_empty(folder.path));
    CHECK((fcntl(made->file(), F_GETFD) & FD_CLOEXEC) != 0);
    made->name = "a.glb";
    Upload moved = std::move(*made);
    CHECK(made->file() < 0);
    CHECK(moved.name == "a.glb");
    CHECK(moved.bytes() == wanted.size());
    std::string held(wanted.size() + 1, '\0');
    const ssize_t size = pread(moved.file(), held.data(), held.size(), 0);
    REQUIRE(size == static_cast<ssize_t>(wanted.size()));
    held.resize(wanted.size());
    CHECK(held == wanted);
    const int file = moved.file();
    moved = std::move(*Upload::create(folder.path.string()));
    CHECK((fcntl(file, F_GETFD) < 0 || moved.file() == file));
  }
}

TEST_CASE("a disk that is full is an error") {
  const TemporaryFolder folder;
  Result<Upload> upload = Upload::create(folder.path.string());
  REQUIRE(upload);
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  rlimit scarce = before;
  scarce.rlim_cur = 1000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  REQUIRE(setrlimit(RLIMIT_FSIZE, &scarce) == 0);
  const Result<void> fits = upload->append(std::string(900, 'a'));
  const Result<void> too_much = upload->append(std::string(900, 'b'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(fits);
  REQUIRE_FALSE(too_much);
  CHECK(too_much.error().code == Code::io);
}

TEST_CASE("an upload needs a folder to write to") {
  const TemporaryFolder folder;
  const Result<Upload> upload = Upload::create((folder.path / "none").string());
  REQUIRE_FALSE(upload);
  CHECK(upload.error().code == Code::io);
  CHECK(upload.error().message.find("none") != std::string::npos);
  CHECK(Upload::create(""));
}

TEST_CASE("who opens an upload's file again may only read it") {
  const TemporaryFolder folder;
  Result<Upload> upload = Upload::create(folder.path.string());
  REQUIRE(upload);
  REQUIRE(upload->append("content"));
  struct stat info {};
  REQUIRE(fstat(upload->file(), &info) == 0);
  CHECK((info.st_mode & 0777) == 0400);
}
