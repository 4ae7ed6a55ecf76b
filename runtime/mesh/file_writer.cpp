#include "mesh/file_writer.h"

#include <cerrno>
#include <system_error>
#include <utility>

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace sgm {
namespace {

constexpr size_t kBufferBytes = size_t{1} << 20;

Error writeError(const std::filesystem::path& target, const std::string& reason) {
  return {Code::io, "cannot write '" + target.string() + "': " + reason};
}

}  // namespace

Result<FileWriter> FileWriter::create(const std::filesystem::path& target) {
  std::error_code ignored;
  if (std::filesystem::is_directory(target, ignored)) return writeError(target, "it is a folder");
  // Exclusive creation, so that two writers of one target never share a temporary file.
  for (int attempt = 0;; ++attempt) {
    std::filesystem::path temporary = target;
    temporary += ".part" + std::to_string(attempt);
    std::FILE* file = std::fopen(temporary.string().c_str(), "wbx");
    if (file != nullptr) return FileWriter(target, std::move(temporary), file);
    if (errno != EEXIST || attempt == 999) return writeError(target, std::generic_category().message(errno));
  }
}

FileWriter::FileWriter(std::filesystem::path target, std::filesystem::path temporary, std::FILE* file)
    : target_(std::move(target)), temporary_(std::move(temporary)), file_(file), exists_(true) {
  std::setvbuf(file_, nullptr, _IONBF, 0);
  buffer_.reserve(kBufferBytes);
}

FileWriter::FileWriter(FileWriter&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)),
      file_(std::exchange(other.file_, nullptr)),
      buffer_(std::move(other.buffer_)),
      first_error_(other.first_error_),
      exists_(std::exchange(other.exists_, false)) {}

FileWriter::~FileWriter() {
  if (file_ != nullptr) std::fclose(file_);
  std::error_code ignored;
  if (exists_) std::filesystem::remove(temporary_, ignored);
}

void FileWriter::write(const void* bytes, size_t count) {
  const char* from = static_cast<const char*>(bytes);
  if (buffer_.size() + count > kBufferBytes) flush();
  if (count > kBufferBytes) {
    if (first_error_ == 0 && std::fwrite(from, 1, count, file_) != count) first_error_ = errno;
  } else {
    buffer_.insert(buffer_.end(), from, from + count);
  }
}

void FileWriter::flush() {
  if (first_error_ == 0 && std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size())
    first_error_ = errno;
  buffer_.clear();
}

Error FileWriter::errorFrom(int code) const { return writeError(target_, std::generic_category().message(code)); }

Result<void> FileWriter::finish() {
  if (file_ != nullptr) {
    flush();
#if __has_include(<unistd.h>)
    // Some file systems only tell here that they are full.
    if (first_error_ == 0 && fsync(fileno(file_)) != 0 && errno != EINVAL) first_error_ = errno;
#endif
    if (std::fclose(std::exchange(file_, nullptr)) != 0 && first_error_ == 0) first_error_ = errno;
  }
  if (first_error_ != 0) return errorFrom(first_error_);
  return {};
}

Result<void> FileWriter::commit() {
  if (Result<void> done = finish(); !done) return done;
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) return writeError(target_, error.message());
  exists_ = false;
  return {};
}

}  // namespace sgm
