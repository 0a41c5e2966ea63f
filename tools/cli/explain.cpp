// genu explain knee.toml: the system a scene asks for, before anything is solved.
#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "commands.h"
#include "genu/run/explain.h"
#include "genu/run/run_scene.h"
#include "genu/scene/reader.h"

namespace genu::cli {

void add_explain(CLI::App& app, int& exit_code) {
  auto file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("explain", "Say what system a scene asks for: genu explain knee.toml");
  command->add_option("SCENE", *file, "scene file (TOML)")->required();
  command->callback([file, &exit_code] {
    Diagnostics diagnostics;
    const auto scene = read_scene(*file, diagnostics);
    print(diagnostics);
    if (scene) fmt::print("{}", explain(*scene));
    exit_code = scene ? kExitOk : kExitRefused;
  });
}

}  // namespace genu::cli
