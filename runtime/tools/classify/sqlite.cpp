#include "tools/classify/sqlite.h"

namespace sgm::masters {

Statement::Statement(const Database& database, const char* text) {
  code_ = sqlite3_prepare_v2(database.get(), text, -1, &statement_, nullptr);
}

Statement& Statement::bind(int64_t value) {
  if (code_ == SQLITE_OK) code_ = sqlite3_bind_int64(statement_, ++bound_, value);
  return *this;
}

Statement& Statement::bind(double value) {
  if (code_ == SQLITE_OK) code_ = sqlite3_bind_double(statement_, ++bound_, value);
  return *this;
}

Statement& Statement::bind(std::string_view text) {
  if (code_ == SQLITE_OK) {
    code_ = sqlite3_bind_text64(statement_, ++bound_, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  }
  return *this;
}

Statement& Statement::bind(std::span<const std::byte> blob) {
  if (code_ == SQLITE_OK) {
    code_ = sqlite3_bind_blob64(statement_, ++bound_, blob.data(), blob.size(), SQLITE_TRANSIENT);
  }
  return *this;
}

bool Statement::step() {
  if (code_ != SQLITE_OK) return false;
  const int step = sqlite3_step(statement_);
  if (step != SQLITE_ROW && step != SQLITE_DONE) code_ = step;
  return step == SQLITE_ROW;
}

void Statement::run() {
  step();
  if (code_ != SQLITE_OK) return;
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
  bound_ = 0;
}

std::string Statement::text(int column) const {
  const unsigned char* text = sqlite3_column_text(statement_, column);
  const int bytes = sqlite3_column_bytes(statement_, column);
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text), static_cast<size_t>(bytes));
}

std::span<const std::byte> Statement::blob(int column) const {
  const void* blob = sqlite3_column_blob(statement_, column);
  const int bytes = sqlite3_column_bytes(statement_, column);
  return {static_cast<const std::byte*>(blob), blob == nullptr ? 0 : static_cast<size_t>(bytes)};
}

int execute(const Database& database, const char* text) {
  return sqlite3_exec(database.get(), text, nullptr, nullptr, nullptr);
}

}  // namespace sgm::masters
