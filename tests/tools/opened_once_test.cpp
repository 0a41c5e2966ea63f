// Each input file is opened once in a run, whoever needs it: counted by inotify.
#include <sys/inotify.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "support/leskovar.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

/// How often each file of a folder is opened while a command runs.
std::map<std::string, int> opens(const std::string& folder, const std::string& command) {
  std::map<std::string, int> count;
  const int watch = inotify_init1(IN_NONBLOCK);
  if (watch < 0 || inotify_add_watch(watch, folder.c_str(), IN_OPEN) < 0) return count;
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  alignas(inotify_event) char buffer[1 << 16];
  for (ssize_t size = read(watch, buffer, sizeof buffer); size > 0; size = read(watch, buffer, sizeof buffer))
    for (ssize_t at = 0; at < size;) {
      const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
      if (event->len > 0 && (event->mask & IN_ISDIR) == 0) ++count[event->name];
      at += static_cast<ssize_t>(sizeof(inotify_event)) + event->len;
    }
  close(watch);
  return count;
}

TEST(OpenedOnce, TheSceneAndItsMeshesInARunWithAReport) {
  const test::TemporaryFolder folder, results;
  for (const auto& entry : fs::directory_iterator(test::kLeskovar))
    if (entry.path().extension() == ".stl" || entry.path().filename() == "scene-bones.toml")
      fs::copy_file(entry.path(), folder / entry.path().filename().string());
  const auto count = opens(folder / "", test::program() + " run " + (folder / "scene-bones.toml") + " --out " +
                                            (results / "out") + " --quiet > /dev/null 2>&1");
  if (count.empty()) GTEST_SKIP() << "inotify counts nothing here";
  EXPECT_GE(count.size(), 2u) << "the scene and a mesh at least";
  for (const auto& [file, times] : count) EXPECT_EQ(times, 1) << file;
}

}  // namespace
}  // namespace genu
