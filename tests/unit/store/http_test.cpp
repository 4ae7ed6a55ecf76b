// Tests chunks whose parts come from a store on a server: they equal derived chunks, whatever fault the server has.

#include <thread>

#include "failing_memory.h"
#include "file_server.h"
#include "store/outage.h"
#include "store_support.h"
#include "world/version_0_2.h"

using namespace sgm;

namespace {

/// Part of a cave, baked once for all tests.
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

  /// The number of parts from `source` that differ from the expected ones.
  size_t unlike(BakedParts& source, DiskCache* cache = nullptr, size_t stride = 1) const {
    ChunkMesher mesher = baking.machine.mesher(baking.world, cache);
    mesher.baked = &source;
    size_t count = 0;
    for (size_t i = 0; i < requests.size(); ++i) {
      const size_t number = i * stride % requests.size();
      const Result<MeshedChunk> chunk = tryToMesh(mesher, requests[number]);
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
  const auto far = sourceAt(server.address() + "/", told.log());
  const auto near = sourceAt(baked.folder.path.string());
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
  // The source reads ahead in blocks, so there are far fewer requests than parts.
  CHECK(server.requests < 40);
  CHECK(far->isFar());
  CHECK(!near->isFar());
}

TEST_CASE("what lies in a folder is asked of no server, whichever comes first", "[store]") {
  const Baked baked(4);
  FileServer server(baked.folder.path);
  const auto source =
      store::openStores(std::array{server.address(), baked.folder.path.string()}, {}, std::pmr::get_default_resource());
  REQUIRE(source);
  CHECK((*source)->isFar());
  CHECK(baked.unlike(**source) == 0);
  CHECK((*source)->stats().hits > 0);
  CHECK(server.requests == 0);
  // A request with Reach::near sends nothing to a server, even if the server has the part.
  const auto far = sourceAt(server.address());
  const ChunkRequest& request = baked.requests[0];
  const DiskKey world = far->worldOf(*bakedWorldInputs(baked.baking.world, false));
  std::pmr::memory_resource* const memory = std::pmr::get_default_resource();
  CHECK(!far->get({world}, request.key, 0, Reach::near, memory));
  CHECK(server.requests == 0);
  CHECK(far->get({world}, request.key, 0, Reach::far, memory));
}

TEST_CASE("a bake of version 0.2 is found on a server too", "[store]") {
  FileServer server(formerFile("store"));
  const WorldField world(formerWorld(), std::pmr::get_default_resource());
  const auto far = sourceAt(server.address());
  BakedWorld asked{far->worldOf(*bakedWorldInputs(world, false)),
                   [&] { return far->worldOf(*formerBakedWorldInputs(world, false)); }};
  std::pmr::memory_resource* const memory = std::pmr::get_default_resource();
  CHECK(far->get(asked, {0, {}}, 0, Reach::far, memory));
  asked.former_key = nullptr;
  CHECK(!far->get(asked, {0, {}}, 0, Reach::far, memory));
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
    bool is_away;  ///< true: after the fault, the source does not contact the server for a while
  };
  for (const Case& c :
       {Case{Fault::no_ranges, "ignores range requests", false},
        Case{Fault::other_range, "another part of the file than the requested one", false},
        Case{Fault::cut_off, "cannot be read (", true},
        Case{Fault::endless, "another part of the file than the requested one", false},
        Case{Fault::damaged, "is not a store of baked worlds", false}, Case{Fault::fails, "status 503", true},
        Case{Fault::refuses, "status 403", false}, Case{Fault::is_silent, "cannot be read (", true},
        Case{Fault::hangs_up, "cannot be read (", true}}) {
    for (const bool at_once : {true, false}) {
      // The detection of a silent server takes seconds, so it is tested only once.
      if (c.fault == Fault::is_silent && !at_once) continue;
      CAPTURE(static_cast<int>(c.fault), at_once);
      FileServer server(baked.folder.path);
      Told told;
      const auto source = sourceAt(server.address(), told.log());
      if (!at_once) {
        ChunkMesher mesher = baked.baking.machine.mesher(baked.baking.world, nullptr);
        mesher.baked = source.get();
        // This request makes the source read the store's index while the server works. Most parts are read later, when
        // the server fails.
        ChunkRequest uniform;
        uniform.key = {0, {baked.requests[0].key.at.x, baked.requests[0].key.at.y, baked.requests[0].key.at.z}};
        uniform.seams = 0;
        REQUIRE(tryToMesh(mesher, uniform));
        CHECK(source->stats().hits == 1);
        CHECK(told.messages.empty());
      }
      server.fault = c.fault;
      CHECK(baked.unlike(*source) == 0);
      // A file of a single block can be read completely without range requests.
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
  CHECK(told.messages[0].find("cannot be read (") != std::string::npos);
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
  std::atomic<size_t> unlike = 0;
  std::thread reader([&] { unlike += baked.unlike(*source); });
  while (server.requests == 0) std::this_thread::yield();
  const auto stopped = std::chrono::steady_clock::now();
  source->stop();
  reader.join();
  // The request's timeout is four seconds. Cancelling must end it earlier, since libcurl checks for cancellation once a
  // second.
  CHECK(std::chrono::steady_clock::now() - stopped < std::chrono::milliseconds(3500));
  unlike += baked.unlike(*source);
  CHECK(unlike == 0);
  CHECK(source->stats().hits == 0);
  CHECK(server.requests == 1);
  CHECK(told.messages.empty());
}

TEST_CASE("a file that cannot be had is asked for once, and costs what lies in it", "[store]") {
  const Baked baked(12);
  const CacheFolder lacking;
  fs::copy(baked.folder.path, lacking.path, fs::copy_options::recursive);
  size_t removed = 0;
  for (const fs::path& file : lacking.files()) {
    if (file.extension() == ".sgmp") removed += fs::remove(file);
  }
  REQUIRE(removed > 0);
  FileServer server(lacking.path);
  Told told;
  const auto source = sourceAt(server.address(), told.log());
  CHECK(baked.unlike(*source) == 0);
  const int requests = server.requests;
  CHECK(baked.unlike(*source) == 0);
  CHECK(server.requests == requests);
  CHECK(source->stats().damaged > 0);
  CHECK(!told.messages.empty());
  CHECK(told.messages.size() <= removed);
}

TEST_CASE("memory that gives out while a server is read costs a try", "[store]") {
  const Baked baked(2);
  FileServer server(baked.folder.path);
  bool troubled = true;
  int64_t n = 0;
  for (; troubled; n += 1 + n / 8) {
    CAPTURE(n);
    Failing memory;
    Told told;
    {
      const auto opened = store::openStores(std::array{server.address()}, told.log(), &memory);
      REQUIRE(opened);
      BakedParts& source = **opened;
      memory.until = n;
      memory.failures = 1 + n % 3;
      ChunkMesher mesher = baked.baking.machine.mesher(baked.baking.world, nullptr);
      mesher.baked = &source;
      mesher.memory = &memory;
      for (size_t i = 0; i < baked.requests.size(); ++i) {
        std::optional<Result<MeshedChunk>> chunk;
        while (!chunk || !*chunk) {
          try {
            chunk.emplace(tryToMesh(mesher, baked.requests[i]));
          } catch (const std::bad_alloc&) {
            // Once more.
          }
        }
        CHECK(same(**chunk, baked.expected[i]));
      }
      CHECK(source.stats().hits > 0);
      CHECK(source.stats().damaged == 0);
      CHECK(told.messages.empty());
      troubled = memory.failed > 0;
    }
    CHECK(memory.live == 0);
  }
  CHECK(n > 20);
}

TEST_CASE("an outage is told once a minute, and rests grow until it has been well for one", "[store]") {
  using Look = store::Outage::Look;
  store::Outage outage;
  store::Outage::Clock::time_point now{std::chrono::hours(1)};
  const auto pass = [&](double seconds) {
    now += std::chrono::duration_cast<store::Outage::Clock::duration>(std::chrono::duration<double>(seconds));
  };
  CHECK(outage.look(now) == Look::there);
  const auto early = now;
  pass(1);
  CHECK(outage.failed(early, now));
  CHECK(!outage.failed(early, now));
  // The server answers a request that was sent before the failure. This answer does not show that the server works
  // again.
  CHECK(!outage.answered(early, now));
  for (double rest : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 60.0, 60.0}) {
    CAPTURE(rest);
    pass(rest - 0.1);
    CHECK(outage.look(now) == Look::away);
    pass(0.2);
    CHECK(outage.look(now) == Look::find_out);
    CHECK(outage.look(now) == Look::away);
    outage.gaveUp();
    CHECK(outage.look(now) == Look::find_out);
    const auto begun = now;
    pass(0.1);
    CHECK(!outage.failed(begun, now));
  }
  pass(61);
  CHECK(outage.look(now) == Look::find_out);
  auto begun = now;
  pass(0.1);
  CHECK(outage.answered(begun, now));
  CHECK(outage.look(now) == Look::there);
  // This failure follows soon after an answer. It is reported, because the last report was long ago. But the server is
  // not tried again at once.
  begun = now;
  pass(0.1);
  CHECK(outage.failed(begun, now));
  pass(30);
  CHECK(outage.look(now) == Look::away);
  pass(31);
  CHECK(outage.look(now) == Look::find_out);
  begun = now;
  pass(0.1);
  CHECK(outage.answered(begun, now));
  pass(100);
  begun = now;
  pass(0.1);
  CHECK(outage.failed(begun, now));
  pass(1.1);
  CHECK(outage.look(now) == Look::find_out);
  // If a server fails repeatedly within a short time, not every failure is reported.
  begun = now;
  pass(0.1);
  CHECK(outage.answered(begun, now));
  begun = now;
  pass(0.1);
  CHECK(!outage.failed(begun, now));
  pass(3);
  CHECK(outage.look(now) == Look::find_out);
  begun = now;
  pass(0.1);
  CHECK(!outage.answered(begun, now));
}

TEST_CASE("addresses that are none are refused, and passwords stay unsaid", "[store]") {
  for (const char* address : {"http://", "http:///path", "https://host/a?b", "http://host/#x", "http://host/a b",
                              "http://user:secret@host/\xC3\xA4", "ftp://user:secret@host/x",
                              "HTTPS://user:secret@host/?", "http://me:se/secret@host/x?"}) {
    CAPTURE(address);
    const auto files = store::storeFiles(address, {}, std::pmr::get_default_resource());
    REQUIRE(!files);
    CHECK(files.error().code == Code::bad_input);
    CHECK(files.error().message.find("secret") == std::string::npos);
  }
  const auto files = store::storeFiles("http://user:secret@host:99/store//", {}, std::pmr::get_default_resource());
  REQUIRE(files);
  CHECK((*files)->nameOf("format") == "http://host:99/store/format");
  const auto plain = store::storeFiles("https://host/a@b", {}, std::pmr::get_default_resource());
  REQUIRE(plain);
  CHECK((*plain)->nameOf("") == "https://host/a@b");
}
