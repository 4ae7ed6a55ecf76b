#include "tools/classify/base.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <system_error>

#include "base/bytes.h"
#include "base/checksum.h"
#include "base/file_writer.h"
#include "tools/classify/sqlite.h"

namespace sgm::masters {
namespace {

using measure::HistogramMode;
using measure::Master;
using measure::MasterKey;
using measure::MasterLimits;

constexpr int64_t kApplication = 0x53474D4D;  // "SGMM"
constexpr int64_t kSchemaVersion = 1;
constexpr int64_t kMaxMasters = 100'000;
/// Maximum number of bytes of a value or SQL statement: enough for valid databases, and small enough that a crafted
/// file cannot make SQLite allocate gigabytes.
constexpr int kMaxBytes = 1 << 20;

// A table is recognized by the exact text of its CREATE statement, which SQLite stores.
constexpr const char* kKeysTable =
    "CREATE TABLE keys(id INTEGER PRIMARY KEY, bins INTEGER NOT NULL, mode TEXT NOT NULL, length REAL NOT NULL, "
    "density REAL NOT NULL, version INTEGER NOT NULL, limit_mse REAL NOT NULL, limit_emd REAL NOT NULL, "
    "checksum INTEGER NOT NULL) STRICT";
constexpr const char* kMastersTable =
    "CREATE TABLE masters(id INTEGER PRIMARY KEY, key INTEGER NOT NULL REFERENCES keys(id), class TEXT NOT NULL, "
    "name TEXT NOT NULL, models INTEGER NOT NULL, shares BLOB NOT NULL, checksum INTEGER NOT NULL) STRICT";
/// This table holds the number of rows of the other two tables and the sum of their checksums, to detect a missing row.
constexpr const char* kSealTable =
    "CREATE TABLE seal(id INTEGER PRIMARY KEY, rows INTEGER NOT NULL, checksum INTEGER NOT NULL) STRICT";

/// A checksum of all columns of a row, which detects any changed bit.
class RowSum {
 public:
  template <class T>
  RowSum& add(T value) {
    ByteWriter(bytes_).put(value);
    return *this;
  }
  RowSum& add(std::string_view text) {
    add(uint64_t{text.size()});
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    bytes_.insert(bytes_.end(), first, first + text.size());
    return *this;
  }
  uint64_t value() const { return checksum(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

uint64_t sumOf(int64_t id, const MasterLimits& limits) {
  const MasterKey& key = limits.key;
  return RowSum()
      .add(id)
      .add(key.bins)
      .add(measure::nameOf(key.mode))
      .add(key.length)
      .add(key.density)
      .add(key.version)
      .add(limits.mse)
      .add(limits.emd)
      .value();
}

uint64_t sumOf(int64_t key, const Master& master) {
  RowSum sum;
  sum.add(key).add(std::string_view(master.class_name)).add(std::string_view(master.name)).add(master.models);
  for (const double share : master.shares) sum.add(share);
  return sum.value();
}

ReadBase failed(int code, const std::string& message) {
  const int primary = code & 0xFF;
  if (primary == SQLITE_NOTADB) return {{}, Damage::damaged, "it is not a database"};
  if (primary == SQLITE_CORRUPT) return {{}, Damage::damaged, "the database is damaged: " + message};
  return {{}, Damage::io, message};
}

ReadBase failed(const Database& database) {
  return failed(sqlite3_extended_errcode(database.get()), sqlite3_errmsg(database.get()));
}

ReadBase damaged(const std::string& what) { return {{}, Damage::damaged, what}; }

/// Opens a database file. If that fails, returns null, and sets `code` to SQLite's error code.
Database openFile(const std::string& name, int flags, int& code) {
  sqlite3* raw = nullptr;
  code = sqlite3_open_v2(name.c_str(), &raw, flags | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE, nullptr);
  Database database(raw);
  if (code != SQLITE_OK) return nullptr;
  sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, kMaxBytes);
  sqlite3_busy_timeout(raw, 5000);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  return database;
}

/// The file's URI for SQLite, followed by a query string.
std::string uriOf(const std::filesystem::path& file, const std::string& query) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    if (c == '%' || c == '?' || c == '#') {
      static constexpr char kDigits[] = "0123456789ABCDEF";
      uri += {'%', kDigits[c >> 4], kDigits[c & 15]};
    } else {
      uri += c;
    }
  }
  return uri + query;
}

/// Opens a database for reading. If the file is writable, SQLite replays the write-ahead log that a killed process may
/// have left. Otherwise the file is opened as immutable, so that SQLite does not try to create files beside the
/// database.
Database openForReading(const std::filesystem::path& file, int& code) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (access(file.c_str(), W_OK) == 0 && access(folder.c_str(), W_OK) == 0) {
    return openFile(file.string(), SQLITE_OPEN_READWRITE, code);
  }
  return openFile(uriOf(file, "?immutable=1"), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, code);
}

std::optional<int64_t> pragma(const Database& database, const char* text) {
  Statement statement(database, text);
  if (!statement.step()) return std::nullopt;
  return statement.whole(0);
}

/// The reason why the file cannot be used: SQLite finds it corrupt, or its application id, version or tables are not
/// those of this program. nullopt if the file is intact.
std::optional<ReadBase> unsound(const Database& database) {
  const std::optional<int64_t> application = pragma(database, "PRAGMA application_id");
  const std::optional<int64_t> version = pragma(database, "PRAGMA user_version");
  if (!application || !version) return failed(database);
  if (*application != kApplication) return damaged("it is a database, but not of reference histograms");
  if (*version > kSchemaVersion) return ReadBase{{}, Damage::newer, "it was written by a later version of sgm"};
  Statement check(database, "PRAGMA quick_check(1)");
  if (!check.step()) return failed(database);
  if (const std::string said = check.text(0); said != "ok") return damaged("PRAGMA quick_check reports: " + said);
  Statement tables(database, "SELECT sql FROM sqlite_schema ORDER BY name");
  for (const char* wanted : {kKeysTable, kMastersTable, kSealTable}) {
    if (!tables.step() || tables.text(0) != wanted)
      return damaged("its tables are not those of a database of reference histograms");
  }
  if (tables.step()) return damaged("it has tables beside those of a database of reference histograms");
  return std::nullopt;
}

bool isShares(const std::vector<double>& shares, const MasterKey& key) {
  if (shares.size() != measure::binsOf(key.settings())) return false;
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  return std::ranges::all_of(shares, [](double s) { return s >= 0 && s <= 1; }) && std::fabs(sum - 1) < 1e-9;
}

std::vector<double> doublesOf(std::span<const std::byte> blob) {
  ByteReader reader(blob);
  std::vector<double> values(blob.size() / sizeof(double));
  for (double& value : values) value = reader.get<double>();
  return values;
}

ReadBase readRows(const Database& database) {
  MasterSet set;
  uint64_t sum = 0;
  int64_t rows = 0;
  std::vector<int64_t> ids;
  Statement keys(
      database,
      "SELECT id, bins, mode, length, density, version, limit_mse, limit_emd, checksum FROM keys ORDER BY id");
  while (keys.step()) {
    const std::optional<HistogramMode> mode = measure::modeNamed(keys.text(2));
    const int64_t bins = keys.whole(1);
    if (!mode || bins < 1 || bins > 4096) return damaged("a key is invalid");
    MasterLimits limits;
    limits.key = {static_cast<uint32_t>(bins), *mode, keys.real(3), keys.real(4), static_cast<uint32_t>(keys.whole(5))};
    limits.mse = keys.real(6);
    limits.emd = keys.real(7);
    const uint64_t row = sumOf(keys.whole(0), limits);
    if (row != static_cast<uint64_t>(keys.whole(8))) return damaged("the checksum of a key is wrong");
    sum += row;
    ids.push_back(keys.whole(0));
    set.limits.push_back(limits);
    if (++rows > kMaxMasters) return damaged("it has too many keys");
  }
  if (keys.code() != SQLITE_OK) return failed(database);
  Statement masters(database, "SELECT key, class, name, models, shares, checksum FROM masters ORDER BY id");
  while (masters.step()) {
    const auto id = std::ranges::find(ids, masters.whole(0));
    if (id == ids.end()) return damaged("a reference histogram has no key");
    Master master;
    master.class_name = masters.text(1);
    master.name = masters.text(2);
    master.key = set.limits[static_cast<size_t>(id - ids.begin())].key;
    master.models = static_cast<uint32_t>(masters.whole(3));
    master.shares = doublesOf(masters.blob(4));
    const uint64_t row = sumOf(*id, master);
    if (row != static_cast<uint64_t>(masters.whole(5)) || !isShares(master.shares, master.key)) {
      return damaged("the checksum of a reference histogram is wrong");
    }
    sum += row;
    set.masters.push_back(std::move(master));
    if (++rows > kMaxMasters) return damaged("it has too many reference histograms");
  }
  if (masters.code() != SQLITE_OK) return failed(database);
  Statement seal(database, "SELECT rows, checksum FROM seal");
  if (!seal.step()) return seal.code() == SQLITE_OK ? damaged("it is incomplete") : failed(database);
  if (seal.whole(0) != rows || static_cast<uint64_t>(seal.whole(1)) != sum)
    return damaged("some of its rows are missing");
  ReadBase read;
  read.set = std::move(set);
  return read;
}

Error cannotWrite(const std::filesystem::path& file, const Database& database) {
  return {Code::io, "cannot write " + file.string() + ": " + sqlite3_errmsg(database.get())};
}

/// Inserts all rows of the set into empty tables. Returns whether it succeeded.
bool insertRows(const Database& database, const MasterSet& set) {
  uint64_t sum = 0;
  Statement key(database, "INSERT INTO keys VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (size_t i = 0; i < set.limits.size(); ++i) {
    const MasterLimits& l = set.limits[i];
    const auto id = static_cast<int64_t>(i) + 1;
    const uint64_t row = sumOf(id, l);
    sum += row;
    key.bind(id).bind(int64_t{l.key.bins}).bind(measure::nameOf(l.key.mode)).bind(l.key.length).bind(l.key.density);
    key.bind(int64_t{l.key.version}).bind(l.mse).bind(l.emd).bind(static_cast<int64_t>(row)).run();
  }
  Statement master(database, "INSERT INTO masters VALUES(NULL, ?, ?, ?, ?, ?, ?)");
  for (const Master& m : set.masters) {
    const auto of = std::ranges::find(set.limits, m.key, &MasterLimits::key);
    const int64_t id = of - set.limits.begin() + 1;
    const uint64_t row = sumOf(id, m);
    sum += row;
    master.bind(id).bind(std::string_view(m.class_name)).bind(std::string_view(m.name)).bind(int64_t{m.models});
    master.bind(std::as_bytes(std::span(m.shares))).bind(static_cast<int64_t>(row)).run();
  }
  Statement seal(database, "INSERT INTO seal VALUES(1, ?, ?)");
  seal.bind(static_cast<int64_t>(set.limits.size() + set.masters.size())).bind(static_cast<int64_t>(sum)).run();
  return key.code() == SQLITE_OK && master.code() == SQLITE_OK && seal.code() == SQLITE_OK;
}

/// Writes a new file. The database is first built in memory, so that the file appears completely or not at all.
Result<void> writeNew(const std::filesystem::path& file, const MasterSet& set) {
  int code = SQLITE_OK;
  const Database database = openFile(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, code);
  if (!database) return Error{Code::io, std::string("cannot open a database: ") + sqlite3_errstr(code)};
  const std::string schema = "BEGIN; PRAGMA application_id = " + std::to_string(kApplication) +
                             "; PRAGMA user_version = " + std::to_string(kSchemaVersion) + ";" + kKeysTable + ";" +
                             kMastersTable + ";" + kSealTable;
  if (execute(database, schema.c_str()) != SQLITE_OK || !insertRows(database, set) ||
      execute(database, "COMMIT") != SQLITE_OK) {
    return cannotWrite(file, database);
  }
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(
      sqlite3_serialize(database.get(), "main", &size, 0), &sqlite3_free);
  if (!bytes) return Error{Code::out_of_memory, "cannot write " + file.string() + ": out of memory"};
  Result<FileWriter> writer = FileWriter::create(file);
  if (!writer) return writer.error();
  writer->write(bytes.get(), static_cast<size_t>(size));
  if (Result<void> done = writer->commit(); !done) return done;
  // The mode WAL lets readers and one writer work concurrently. If setting the mode fails, the database is still valid.
  if (const Database made = openFile(file.string(), SQLITE_OPEN_READWRITE, code)) {
    execute(made, "PRAGMA journal_mode = WAL");
  }
  return {};
}

Result<void> writeOver(const std::filesystem::path& file, const MasterSet& set) {
  int code = SQLITE_OK;
  const Database database = openFile(file.string(), SQLITE_OPEN_READWRITE, code);
  if (!database) return Error{Code::io, "cannot write " + file.string() + ": " + sqlite3_errstr(code)};
  execute(database, "PRAGMA journal_mode = WAL");
  if (execute(database, "BEGIN IMMEDIATE; DELETE FROM masters; DELETE FROM keys; DELETE FROM seal") != SQLITE_OK ||
      !insertRows(database, set) || execute(database, "COMMIT") != SQLITE_OK) {
    const Error error = cannotWrite(file, database);
    execute(database, "ROLLBACK");
    return error;
  }
  return {};
}

}  // namespace

std::vector<Master> MasterSet::of(const MasterKey& key) const {
  std::vector<Master> found;
  std::ranges::copy_if(masters, std::back_inserter(found), [&](const Master& master) { return master.key == key; });
  return found;
}

const MasterLimits* MasterSet::limitsOf(const MasterKey& key) const {
  const auto found = std::ranges::find(limits, key, &MasterLimits::key);
  return found == limits.end() ? nullptr : &*found;
}

ReadBase readBase(const std::filesystem::path& file) {
  int code = SQLITE_OK;
  const Database database = openForReading(file, code);
  if (!database) return failed(code, sqlite3_errstr(code));
  // Read in one transaction, so that all rows come from the same state of the database.
  if (execute(database, "BEGIN") != SQLITE_OK) return failed(database);
  if (std::optional<ReadBase> wrong = unsound(database)) return *wrong;
  return readRows(database);
}

Result<void> checkWritable(const std::filesystem::path& file) {
  std::error_code why;
  std::filesystem::create_directories(std::filesystem::absolute(file).parent_path(), why);
  if (!std::filesystem::exists(file, why)) {
    const Result<FileWriter> writer = FileWriter::create(file);
    return writer ? Result<void>() : writer.error();
  }
  const ReadBase there = readBase(file);
  if (there.damage == Damage::io) return Error{Code::io, "cannot read " + file.string() + ": " + there.what};
  if (there.damage != Damage::none) {
    return Error{Code::bad_input, file.string() + " exists and is not a writable database of reference histograms: " +
                                      there.what + "; move it, or name another file"};
  }
  return {};
}

Result<void> writeBase(const std::filesystem::path& file, const MasterSet& set) {
  if (Result<void> can = checkWritable(file); !can) return can;
  std::error_code why;
  return std::filesystem::exists(file, why) ? writeOver(file, set) : writeNew(file, set);
}

}  // namespace sgm::masters
