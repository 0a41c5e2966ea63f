#include "hard_cases/population/process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

namespace genu::population {

ProcessEnd run_process(const std::vector<std::string>& words, const std::string& output, double seconds) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ProcessEnd out;
  const pid_t child = fork();
  if (child < 0) return out;
  if (child == 0) {
    const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(file, 1);
    dup2(file, 2);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  const auto begin = std::chrono::steady_clock::now();
  auto pause = std::chrono::microseconds(200);
  for (int status = 0;;) {
    if (waitpid(child, &status, WNOHANG) == child) {
      if (WIFEXITED(status)) out.exit_code = WEXITSTATUS(status);
      if (WIFSIGNALED(status)) out.signal = WTERMSIG(status);
      return out;
    }
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > seconds) {
      out.too_long = true;
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return out;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(5000));
  }
}

}  // namespace genu::population
