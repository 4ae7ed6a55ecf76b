#pragma once
// SQLite's C interface with RAII and sgm::Error.

#include <sqlite3.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sgm::masters {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;

/// An SQL statement, executed row by row. After a failed step, code() is the reason, and further steps do nothing.
class Statement {
 public:
  Statement(const Database& database, const char* text);
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int64_t value);
  Statement& bind(double value);
  Statement& bind(std::string_view text);
  Statement& bind(std::span<const std::byte> blob);
  /// Executes the statement up to its next row; returns whether there is one.
  bool step();
  /// Executes the statement as step() does, then resets it and its bindings for the next execution.
  void run();

  int64_t whole(int column) const { return sqlite3_column_int64(statement_, column); }
  double real(int column) const { return sqlite3_column_double(statement_, column); }
  std::string text(int column) const;
  std::span<const std::byte> blob(int column) const;

  int code() const { return code_; }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
  int code_ = SQLITE_OK;  // SQLite's code of the first failure
};

/// Runs SQL statements that return no rows. Returns SQLite's code.
int execute(const Database& database, const char* text);

}  // namespace sgm::masters
