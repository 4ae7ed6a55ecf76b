#include "log.h"

#include "interface.h"

namespace sgm_godot {

void logError(const std::string& message, const std::string& file, int line) {
  engine().print_error_with_message(message.c_str(), "", "SG+M", file.empty() ? "sgm" : file.c_str(), line, 1);
}

void logOutOfMemory(const char* what) { engine().print_error_with_message(what, "", "SG+M", "sgm", 0, 1); }

void logWarning(const std::string& message, const std::string& file, int line) {
  engine().print_warning_with_message(message.c_str(), "", "SG+M", file.empty() ? "sgm" : file.c_str(), line, 1);
}

}  // namespace sgm_godot
