// What comes from a store on a server is what would have been derived, whatever is wrong with the server.

#include <thread>

#include "file_server.h"
#include "store/http_files.h"
#include "store_support.h"

using namespace sgm;

namespace {

/// Part of a cave, baked once for all.
struct Baked {
  CacheFolder folder;
  Baking baking;
  std::vector<ChunkRequest> requests;
  std::vector<MeshedChunk> expected;

  explicit Baked(size_t count = 16) : baking(scenes()[0].settings(), regionOf(scenes()[0], 0, 1), folder.path) {
    baking.bakeAll();
    baking.merge();
    std::mt19937 random(11);
    while (requests.size() < count) {
      ChunkRequest request = requests.empty() ? caveRequest() : randomRequest(random, scenes()[0]);
      if (request.key.level > 1) continue;
      request.outermost = false;
      request.seams &= store::seamsOf(request.key);
      if (request.key.level != 0) request.anchors = request.signs = false;
      requests.push_back(request);
      expected.push_back(meshed(baking.machine.mesher(baking.world, nullptr), request));
    }
  }

  /// How many are not what they should be.
  size_t unlike(BakedParts& source, DiskCache* cache = nullptr, size_t stride = 1) const {
    ChunkMesher mesher = baking.machine.mesher(baking.world, cache);
    mesher.baked = &source;
    size_t count = 0;
    for (size_t i = 0; i < requests.size(); ++i) {
      const size_t number = i * stride % requests.size();
      const Result<MeshedChunk> chunk = mesher.mesh(requests[number], nullptr);
      count += !chunk || !same(*chunk, expected[number]);
    }
    return count;
  }
};

}  // namespace

TEST_CASE("a store on a server is read as one in a folder", "[store][threads]") {
  const Baked baked;
  FileServer server(baked.folder.path);
  Told told;
  const auto far = sourceAt(server.address() + "/", told.log()), near = sourceAt(baked.folder.path.string());
  CHECK(server.requests == 0);
  std::atomic<size_t> unlike = 0;
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t) threads.emplace_back([&, t] { unlike += baked.unlike(*far, nullptr, 2 * t + 1); });
  for (std::thread& thread : threads) thread.join();
  CHECK(unlike == 0);
  for (size_t t = 0; t < 4; ++t) CHECK(baked.unlike(*near, nullptr, 2 * t + 1) == 0);
  CHECK(far->stats().hits == near->stats().hits);
  CHECK(far->stats().hits > 0);
  CHECK(far->stats().bytes == near->stats().bytes);
  CHECK(far->stats().misses + far->stats().errors == 0);
  CHECK(told.messages.empty());
  // Read ahead, in blocks: there are far fewer of them than parts.
  CHECK(server.requests < 40);
  CHECK(far->isFar());
  CHECK(!near->isFar());
}

TEST_CASE("what a server gave once is kept in the disk cache", "[store]") {
  const Baked baked;
  FileServer server(baked.folder.path);
  const CacheFolder cache_folder;
  const auto cache = openCache(cache_folder, kAmple);
  {
    const auto first = sourceAt(server.address());
    CHECK(baked.unlike(*first, cache.get()) == 0);
    CHECK(first->stats().hits > 0);
    CHECK(!cache_folder.files().empty());
  }
  server.fault = Fault::fails;
  Told told;
  const auto again = sourceAt(server.address(), told.log());
  const uint64_t found = cache->stats().hits;
  CHECK(baked.unlike(*again, cache.get()) == 0);
  CHECK(again->stats().hits == 0);
  uint64_t drawn = 0;
  for (const MeshedChunk& chunk : baked.expected) drawn += drawnParts(chunk.surface);
  CHECK(cache->stats().hits - found >= drawn);
}

TEST_CASE("whatever a server does, chunks are as they would be derived, which is told once", "[store]") {
  const Baked baked(6);
  struct Case {
    Fault fault;
    const char* message;
    bool is_away;  ///< the server is left alone for a while
  };
  for (const Case& c :
       {Case{Fault::no_ranges, "answers no range requests", false},
        Case{Fault::other_range, "another part of the file than was asked for", false},
        Case{Fault::cut_off, "cannot be read from", true},
        Case{Fault::endless, "another part of the file than was asked for", false},
        Case{Fault::damaged, "is no store of baked worlds", false}, Case{Fault::fails, "status 503", true},
        Case{Fault::refuses, "status 403", false}, Case{Fault::is_silent, "cannot be read from", true},
        Case{Fault::hangs_up, "cannot be read from", true}}) {
    for (const bool at_once : {true, false}) {
      // Saying nothing takes seconds to be noticed: once will do.
      if (c.fault == Fault::is_silent && !at_once) continue;
      CAPTURE(static_cast<int>(c.fault), at_once);
      FileServer server(baked.folder.path);
      Told told;
      const auto source = sourceAt(server.address(), told.log());
      if (!at_once) {
        ChunkMesher mesher = baked.baking.machine.mesher(baked.baking.world, nullptr);
        mesher.baked = source.get();
        // The index is open, and most is yet to come.
        ChunkRequest uniform;
        uniform.key = {0, {baked.requests[0].key.at.x, baked.requests[0].key.at.y, baked.requests[0].key.at.z}};
        uniform.seams = 0;
        REQUIRE(mesher.mesh(uniform, nullptr));
        CHECK(source->stats().hits == 1);
        CHECK(told.messages.empty());
      }
      server.fault = c.fault;
      CHECK(baked.unlike(*source) == 0);
      // Files of one block are whole then, too.
      if (c.fault == Fault::no_ranges && !at_once) continue;
      REQUIRE(!told.messages.empty());
      for (const std::string& message : told.messages) {
        INFO(message);
        CHECK(message.find("127.0.0.1") != std::string::npos);
        CHECK(message.find("derived") != std::string::npos);
      }
      if (at_once) {
        CHECK(source->stats().hits == 0);
        CHECK(told.messages.size() == 1);
        INFO(told.messages[0]);
        CHECK(told.messages[0].find(c.message) != std::string::npos);
        if (c.is_away) CHECK(source->stats().damaged == 0);
      }
    }
  }
}

TEST_CASE("a server that was away is asked again, and told of once each time", "[store]") {
  const Baked baked(4);
  uint16_t port = 0;
  {
    const FileServer server(baked.folder.path);
    port = server.port();
  }
  Told told;
  const auto source = sourceAt("http://127.0.0.1:" + std::to_string(port), told.log());
  CHECK(baked.unlike(*source) == 0);
  CHECK(baked.unlike(*source) == 0);
  CHECK(source->stats().hits == 0);
  REQUIRE(told.messages.size() == 1);
  CHECK(told.messages[0].find("cannot be read from") != std::string::npos);
  const FileServer server(baked.folder.path, port);
  for (int i = 0; i < 100 && source->stats().hits == 0; ++i) {
    CHECK(baked.unlike(*source) == 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  CHECK(source->stats().hits > 0);
  REQUIRE(told.messages.size() == 2);
  CHECK(told.messages[1].find("answers again") != std::string::npos);
  CHECK(source->stats().damaged == 0);
}

TEST_CASE("nobody waits for a silent server once reading is stopped", "[store][threads]") {
  const Baked baked(4);
  FileServer server(baked.folder.path);
  server.fault = Fault::is_silent;
  Told told;
  const auto source = sourceAt(server.address(), told.log());
  std::thread reader([&] { CHECK(baked.unlike(*source) == 0); });
  while (server.requests == 0) std::this_thread::yield();
  source->stop();
  reader.join();
  CHECK(baked.unlike(*source) == 0);
  CHECK(source->stats().hits == 0);
  CHECK(server.requests == 1);
  CHECK(told.messages.empty());
}

TEST_CASE("addresses that are none are refused, and passwords stay unsaid", "[store]") {
  for (const char* address : {"http://", "http:///path", "https://host/a?b", "http://host/#x", "http://host/a b",
                              "http://user:secret@host/\xC3\xA4"}) {
    CAPTURE(address);
    const auto files = store::httpFiles(address, {}, std::pmr::get_default_resource());
    REQUIRE(!files);
    CHECK(files.error().code == Code::bad_input);
    CHECK(files.error().message.find("secret") == std::string::npos);
  }
  const auto files = store::httpFiles("http://user:secret@host:99/store//", {}, std::pmr::get_default_resource());
  REQUIRE(files);
  CHECK((*files)->nameOf("format") == "http://host:99/store/format");
  const auto plain = store::httpFiles("https://host/a@b", {}, std::pmr::get_default_resource());
  REQUIRE(plain);
  CHECK((*plain)->nameOf("") == "https://host/a@b");
}
