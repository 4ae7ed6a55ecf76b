// Benchmarks with many viewers, many worlds, many edits, small budgets and long flights, through the C interface alone.
// streaming.sh prints these rows together with flights of `sgm fly`. All rows use grid cells of 0.5 m and two threads:
// one worker and the engine's thread.
//
//   crowds GRAMMAR ROW [--seconds S] [--count N] [--rate HZ] [--speed M_S] [--spread M]
//
// The rows, and what each measures:
//   walkers   N viewers at 2 m/s: the time until all of them see cells of at most 4 m within 32 m
//   worlds    N worlds with one viewer each, updated HZ times a second: numbers of chunks meshed and used
//   fast      4 viewers at 5, 30, 100 and 300 m/s, and 80 edits a second: numbers of chunks meshed and used
//   budget    65,536 bytes per update for two seconds, then 1 MiB: the time until level 0 is drawn, compared with the
//             time without a limit
//   walk      a viewer that walks and digs: number of new colliders, and of those equal to the one that they replace
//   far       a flight over new ground: resident memory after a sixth of the flight, and its maximum afterwards
//
// Prints one line of JSON.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <utility>

#include <unistd.h>

#include "crowds/ground.h"

namespace crowds {
namespace {

constexpr uint64_t kBudget = uint64_t{1} << 20;
// A viewer counts as served if all chunks that are drawn within kDrawnRadius of it have grid cells of at most
// kDrawnCell; both in metres.
constexpr double kDrawnRadius = 32, kDrawnCell = 4;

struct Options {
  std::string grammar, row;
  double seconds = 10, rate = 125, speed = 60;
  unsigned count = 0;
  int32_t spread = 1000;  ///< maximum distance of the viewers from the origin on each axis, in metres
};

void walkers(const Options& options) {
  const Ground ground(options.grammar);
  Engine engine(ground.field.get(), worldDesc());
  std::vector<Mover> movers;
  std::mt19937 random(kSeed);
  for (const Place& place : placesInVoid(ground, options.count != 0 ? options.count : 64, options.spread))
    movers.push_back({place, 2, static_cast<double>(random() % 6283) / 1000});
  std::vector<bool> seen(movers.size());
  double all_drawn = -1, first_drawn = -1;
  paced(options.seconds, options.rate, [&](double seconds) {
    std::vector<sgm_viewer> viewers;
    for (const Mover& mover : movers) viewers.push_back(mover.viewer(seconds));
    engine.setViewers(viewers);
    engine.frame(kBudget);
    size_t drawn = 0;
    for (size_t i = 0; i < movers.size(); ++i) {
      const bool is_drawn = engine.isDrawn(movers[i].at(seconds), kDrawnRadius, kDrawnCell);
      seen[i] = seen[i] || is_drawn;
      drawn += is_drawn;
    }
    if (drawn > 0 && first_drawn < 0) first_drawn = seconds;
    if (drawn == movers.size()) all_drawn = seconds;
    return all_drawn < 0;
  });
  Work work;
  work.add(engine);
  std::printf("\"walkers\": %zu, \"drawn\": %lld, \"first_drawn_s\": %.3f, \"all_drawn_s\": %.3f, ", movers.size(),
              static_cast<long long>(std::count(seen.begin(), seen.end(), true)), first_drawn, all_drawn);
  work.print(ground);
}

void worlds(const Options& options) {
  const Ground ground(options.grammar);
  const size_t count = options.count != 0 ? options.count : 32;
  std::vector<std::unique_ptr<Engine>> engines;
  std::vector<Mover> movers;
  std::mt19937 random(kSeed);
  for (const Place& place : placesInVoid(ground, count, options.spread)) {
    engines.push_back(std::make_unique<Engine>(ground.field.get(), worldDesc()));
    movers.push_back({place, 5, static_cast<double>(random() % 6283) / 1000});
  }
  std::vector<double> drawn(count, -1);
  paced(options.seconds, options.rate, [&](double seconds) {
    for (size_t i = 0; i < count; ++i) {
      const sgm_viewer viewer = movers[i].viewer(seconds);
      engines[i]->setViewers({&viewer, 1});
      engines[i]->frame(kBudget);
      if (drawn[i] < 0 && engines[i]->isDrawn(movers[i].at(seconds), kDrawnRadius, kDrawnCell)) drawn[i] = seconds;
    }
    return true;
  });
  Work work;
  uint64_t least = UINT64_MAX;
  for (const auto& engine : engines) {
    work.add(*engine);
    least = std::min(least, engine->stats().chunks_meshed);
  }
  const bool all = std::all_of(drawn.begin(), drawn.end(), [](double at) { return at >= 0; });
  std::printf("\"worlds\": %zu, \"rate\": %g, \"least_chunks\": %llu, \"all_drawn_s\": %.3f, ", count, options.rate,
              static_cast<unsigned long long>(least), all ? *std::max_element(drawn.begin(), drawn.end()) : -1.0);
  work.print(ground);
}

void fast(const Options& options) {
  constexpr double kEditsPerSecond = 80;
  const Ground ground(options.grammar);
  Engine engine(ground.field.get(), worldDesc());
  std::vector<Mover> movers;
  const std::array<double, 4> speeds{5, 30, 100, 300};
  const std::vector<Place> places = placesInVoid(ground, speeds.size(), options.spread);
  for (size_t i = 0; i < speeds.size(); ++i) movers.push_back({places[i], speeds[i], 1.5 * static_cast<double>(i)});
  std::mt19937 random(kSeed);
  uint64_t edits = 0, frames = 0, drawn_frames = 0;
  double first_drawn = -1;
  paced(options.seconds, options.rate, [&](double seconds) {
    std::vector<sgm_viewer> viewers;
    for (const Mover& mover : movers) viewers.push_back(mover.viewer(seconds));
    engine.setViewers(viewers);
    for (; static_cast<double>(edits) < seconds * kEditsPerSecond; ++edits) {
      Place place = movers[edits % movers.size()].at(seconds);
      for (double& p : place) p += static_cast<double>(random() % 8001) / 1000 - 4;
      dig(engine, place, 1.5);
    }
    engine.frame(kBudget);
    ++frames;
    const auto isDrawn = [&](const Mover& mover) {
      return engine.isDrawn(mover.at(seconds), kDrawnRadius, kDrawnCell);
    };
    // Below, count only frames in which the slowest viewer (the first one) is served.
    if (!isDrawn(movers[0])) return true;
    ++drawn_frames;
    if (first_drawn < 0) first_drawn = seconds;
    return true;
  });
  Work work;
  work.add(engine);
  const sgm_world_stats stats = engine.stats();
  std::printf(
      "\"edits\": %llu, \"frames\": %llu, \"frame\": %llu, \"edits_drawn\": %llu, \"first_drawn_s\": %.3f, "
      "\"drawn_frames\": %llu, ",
      static_cast<unsigned long long>(edits), static_cast<unsigned long long>(frames),
      static_cast<unsigned long long>(stats.frame), static_cast<unsigned long long>(stats.edits_drawn), first_drawn,
      static_cast<unsigned long long>(drawn_frames));
  work.print(ground);
}

void budget(const Options& options) {
  constexpr uint64_t kSmall = 65536;
  constexpr double kSmallSeconds = 2;
  const Ground ground(options.grammar);
  const Mover mover{placesInVoid(ground, 1, options.spread)[0], 0, 0};
  const sgm_viewer viewer = mover.viewer(0);
  size_t wanted = 0;
  {
    const Engine engine = [&] {
      Engine made(ground.field.get(), worldDesc());
      made.setViewers({&viewer, 1});
      paced(60, options.rate, [&](double) {
        made.frame(UINT64_MAX);
        return made.stats().idle == 0;
      });
      return made;
    }();
    wanted = engine.countDrawn(0);
  }
  Engine engine(ground.field.get(), worldDesc());
  engine.setViewers({&viewer, 1});
  uint64_t peak_small = 0;
  size_t drawn_small = 0;
  double back = -1;
  paced(options.seconds, options.rate, [&](double seconds) {
    const bool is_small = seconds < kSmallSeconds;
    engine.frame(is_small ? kSmall : kBudget);
    const size_t drawn = engine.countDrawn(0);
    if (is_small) {
      drawn_small = drawn;
      peak_small = engine.counts().peak_bytes;
    } else if (drawn >= wanted && back < 0) {
      back = seconds - kSmallSeconds;
    }
    return true;
  });
  std::printf(
      "\"level_0_wanted\": %zu, \"level_0_while_small\": %zu, \"level_0\": %zu, \"level_0_back_s\": %.3f, "
      "\"failed\": %llu, \"most_bytes_while_small\": %llu",
      wanted, drawn_small, engine.countDrawn(0), back, static_cast<unsigned long long>(engine.counts().failed),
      static_cast<unsigned long long>(peak_small));
}

void walk(const Options& options) {
  const Ground ground(options.grammar);
  Engine engine(ground.field.get(), worldDesc());
  const Mover mover{placesInVoid(ground, 1, options.spread)[0], 5, 0};
  std::mt19937 random(kSeed);
  uint64_t digs = 0;
  double longest = 0;
  paced(options.seconds, options.rate, [&](double seconds) {
    const sgm_viewer viewer = mover.viewer(seconds);
    engine.setViewers({&viewer, 1});
    for (; static_cast<double>(digs) < 2 * seconds; ++digs) {
      Place place = mover.at(seconds);
      for (double& p : place) p += static_cast<double>(random() % 6001) / 1000 - 3;
      dig(engine, place, 1.5);
    }
    const Clock::time_point start = Clock::now();
    engine.frame(kBudget);
    longest = std::max(longest, std::chrono::duration<double>(Clock::now() - start).count());
    return true;
  });
  std::printf(
      "\"digs\": %llu, \"colliders\": %llu, \"equal_colliders\": %llu, \"most_colliders_a_frame\": %llu, "
      "\"longest_frame_ms\": %.3f, ",
      static_cast<unsigned long long>(digs), static_cast<unsigned long long>(engine.counts().colliders),
      static_cast<unsigned long long>(engine.counts().equal_colliders),
      static_cast<unsigned long long>(engine.counts().max_colliders), 1000 * longest);
  Work work;
  work.add(engine);
  work.print(ground);
}

double residentMegabytes() {
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0;
  statm >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

void far(const Options& options) {
  const Ground ground(options.grammar);
  Engine engine(ground.field.get(), worldDesc());
  const Mover mover{placesInVoid(ground, 1, options.spread)[0], options.speed, 0.3};
  double settled = 0, most = 0, next_told = 0;
  uint64_t max_counted = 0;
  paced(options.seconds, options.rate, [&](double seconds) {
    const sgm_viewer viewer = mover.viewer(seconds);
    engine.setViewers({&viewer, 1});
    engine.frame(kBudget);
    const double resident = residentMegabytes();
    (seconds < options.seconds / 6 ? settled : most) =
        std::max(seconds < options.seconds / 6 ? settled : most, resident);
    max_counted = std::max(max_counted, ground.memory());
    if (seconds >= next_told) {
      next_told += options.seconds / 60;
      const sgm_world_stats stats = engine.stats();
      std::fprintf(stderr, "%7.1f s: resident %.1f MB, counted %.1f, meshes %.1f, kept %llu, drawn %llu, meshed %llu\n",
                   seconds, resident, static_cast<double>(ground.memory()) / 1e6,
                   static_cast<double>(stats.mesh_bytes) / 1e6, static_cast<unsigned long long>(stats.kept),
                   static_cast<unsigned long long>(stats.drawn), static_cast<unsigned long long>(stats.chunks_meshed));
    }
    return true;
  });
  std::printf(
      "\"metres\": %.0f, \"resident_mb_first_sixth\": %.1f, \"resident_mb_later\": %.1f, \"counted_mb\": %.1f, "
      "\"kept\": %llu, ",
      options.speed * options.seconds, settled, most, static_cast<double>(max_counted) / 1e6,
      static_cast<unsigned long long>(engine.stats().kept));
  Work work;
  work.add(engine);
  work.print(ground);
}

int run(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto number = [&] { return i + 1 < argc ? std::atof(argv[++i]) : 0; };
    if (word == "--seconds") {
      options.seconds = number();
    } else if (word == "--count") {
      options.count = static_cast<unsigned>(number());
    } else if (word == "--rate") {
      options.rate = number();
    } else if (word == "--spread") {
      options.spread = static_cast<int32_t>(number());
    } else if (word == "--speed") {
      options.speed = number();
    } else {
      (options.grammar.empty() ? options.grammar : options.row) = word;
    }
  }
  const std::pair<const char*, void (*)(const Options&)> rows[] = {
      {"walkers", walkers}, {"worlds", worlds}, {"fast", fast}, {"budget", budget}, {"walk", walk}, {"far", far}};
  for (const auto& [name, row] : rows) {
    if (options.row != name) continue;
    std::printf("{\"row\": \"%s\", \"seconds\": %g, ", name, options.seconds);
    row(options);
    std::printf("}\n");
    return 0;
  }
  std::fprintf(stderr,
               "usage: crowds GRAMMAR walkers|worlds|fast|budget|walk|far [--seconds S] [--count N] "
               "[--rate HZ] [--speed M_S] [--spread M]\n");
  return 2;
}

}  // namespace
}  // namespace crowds

int main(int argc, char** argv) { return crowds::run(argc, argv); }
