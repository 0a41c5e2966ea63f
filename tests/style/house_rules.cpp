#include "style/house_rules.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>

namespace genu::style {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestFile = 400;        // lines; past this something wants to be two things
constexpr std::size_t kFilesPerLibrary = 2;      // .cpp files that may include one guarded library
constexpr const char* kLayerPrefix = "genu/";    // of an include
constexpr const char* kLayerRoot = "src/genu/";  // of a file

// What each layer may include besides itself. Each names layers above it alone, so there can be no cycle.
const std::map<std::string, std::set<std::string>>& allowed_layers() {
  static const std::map<std::string, std::set<std::string>> allowed = {
      {"core", {}},
      {"geometry", {"core"}},
      {"scene", {"core"}},
      {"contact", {"core", "geometry"}},
      {"model", {"core", "geometry", "scene", "contact"}},
      {"solver", {"core", "contact", "model"}},  // never a torus, an STL or a scene file
      {"results", {"core", "scene", "model", "solver"}},
      {"judge", {"core", "scene"}},  // and needed_by_judge(): it shares no code with what it judges
      {"run", {"core", "geometry", "scene", "contact", "model", "solver", "results"}},
  };
  return allowed;
}

// What the judge may know of geometry: triangles as they stand in a file.
const std::set<std::string>& needed_by_judge() {
  static const std::set<std::string> headers = {"genu/geometry/mesh.h", "genu/geometry/mesh_reader.h"};
  return headers;
}

// Libraries that stay behind one or two .cpp, by the first letters of their headers.
const std::map<std::string, std::vector<std::string>>& guarded_libraries() {
  static const std::map<std::string, std::vector<std::string>> libraries = {
      {"FCL", {"fcl/", "ccd/"}},
      {"assimp", {"assimp/"}},
      {"CGAL", {"CGAL/"}},
      {"cereal", {"cereal/"}},
      {"xxHash", {"xxhash"}},
      {"toml++", {"toml++/", "toml.hpp", "toml.h"}},
      {"SUNDIALS", {"cvode/", "nvector/", "sundials/", "sunlinsol/", "sunmatrix/", "sunnonlinsol/"}},
  };
  return libraries;
}

struct Include {
  std::size_t line;  // 1-based
  std::string header;
};

std::vector<Include> includes_of(const SourceFile& file) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  std::vector<Include> includes;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    std::smatch match;
    if (std::regex_search(file.lines[i], match, pattern)) includes.push_back({i + 1, match[1]});
  }
  return includes;
}

// "core" for "genu/core/pose.h" behind the prefix "genu/"; empty for a path elsewhere or directly under the prefix.
std::string layer_of(const std::string& path, const std::string& prefix) {
  if (!path.starts_with(prefix)) return {};
  const std::size_t slash = path.find('/', prefix.size());
  return slash == std::string::npos ? std::string() : path.substr(prefix.size(), slash - prefix.size());
}

std::string at(const SourceFile& file, const Include& include) {
  return file.path + ":" + std::to_string(include.line) + ": includes " + include.header + ": ";
}

// Why a file of the layer `from` (empty: a tool) must not include `header`; empty if it may.
std::string why_wrong(const std::string& from, const std::string& header) {
  const std::string to = layer_of(header, kLayerPrefix);
  const bool ours = header.starts_with(kLayerPrefix);
  if (!ours) return from.empty() || header.find("../") == std::string::npos ? "" : "write it as genu/LAYER/FILE";
  if (!allowed_layers().contains(to)) return "there is no layer " + (to.empty() ? "in it" : to);
  if (from == "judge" && needed_by_judge().contains(header)) return {};
  if (from.empty() || from == to || allowed_layers().at(from).contains(to)) return {};
  return "wrong arrow " + from + " -> " + to;
}

}  // namespace

std::vector<SourceFile> read_sources(const fs::path& root) {
  std::vector<SourceFile> files;
  for (const char* top : {"src", "tools"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      SourceFile& file = files.emplace_back();
      file.path = fs::relative(entry.path(), root).generic_string();
      std::ifstream stream(entry.path());
      for (std::string line; std::getline(stream, line);) file.lines.push_back(line);
    }
  }
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

std::vector<std::string> wrong_arrows(const std::vector<SourceFile>& files) {
  std::vector<std::string> wrong;
  for (const SourceFile& file : files) {
    const bool in_house = file.path.starts_with("src/");
    const std::string from = layer_of(file.path, kLayerRoot);
    if (in_house && !allowed_layers().contains(from)) {
      wrong.push_back(file.path + ":1: stands in no layer");
      continue;
    }
    for (const Include& include : includes_of(file)) {
      if (const std::string why = why_wrong(from, include.header); !why.empty())
        wrong.push_back(at(file, include) + why);
    }
  }
  return wrong;
}

std::vector<std::string> wandering_libraries(const std::vector<SourceFile>& files) {
  std::vector<std::string> wandering;
  for (const auto& [library, prefixes] : guarded_libraries()) {
    std::set<std::string> users;
    for (const SourceFile& file : files) {
      for (const Include& include : includes_of(file)) {
        const auto matches = [&](const std::string& prefix) { return include.header.starts_with(prefix); };
        if (std::none_of(prefixes.begin(), prefixes.end(), matches)) continue;
        users.insert(file.path);
        if (!file.path.ends_with(".cpp")) {
          wandering.push_back(at(file, include) + library + " belongs in a .cpp");
        } else if (users.size() > kFilesPerLibrary) {
          wandering.push_back(at(file, include) + library + " is already in " + std::to_string(kFilesPerLibrary) +
                              " other files");
        }
      }
    }
  }
  return wandering;
}

std::vector<std::string> long_files(const std::vector<SourceFile>& files) {
  std::vector<std::string> found;
  for (const SourceFile& file : files) {
    if (file.lines.size() <= kLongestFile) continue;
    found.push_back(file.path + ": " + std::to_string(file.lines.size()) + " lines, more than " +
                    std::to_string(kLongestFile) + ": it wants to be two files");
  }
  return found;
}

}  // namespace genu::style
