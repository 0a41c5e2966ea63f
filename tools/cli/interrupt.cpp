#include <atomic>
#include <csignal>

#include "commands.h"

namespace genu::cli {
namespace {

std::atomic<bool> interrupted{false};
void interrupt(int) { interrupted = true; }

}  // namespace

std::function<bool()> stop_on_interrupt() {
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  if (std::signal(SIGHUP, interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // as nohup wants it
  return [] { return interrupted.load(); };
}

}  // namespace genu::cli
