#include "tools/support/ending_signals.h"

namespace sgm::cli {

constinit UnfinishedFiles unfinished_files;
constinit EndingSignals ending_signals;

}  // namespace sgm::cli
