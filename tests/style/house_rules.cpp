#include "style/house_rules.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace genu::style {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestFile = 400;       // lines; past this something wants to be two things
constexpr std::size_t kFilesPerLibrary = 2;     // .cpp files that may include one guarded library
constexpr double kLargestRoom = 0.1;            // of all lines of the house
constexpr const char* kRoomPrefix = "genu/";    // of an include
constexpr const char* kRoomRoot = "src/genu/";  // of a file

// What the judge may know of meshes: triangles as they stand in a file. It shares no code with what it judges.
const std::set<std::string>& needed_by_judge() {
  static const std::set<std::string> headers = {"genu/mesh/mesh.h", "genu/mesh_files/mesh_reader.h"};
  return headers;
}

// Libraries that stay behind one or two .cpp, by the first letters of their headers.
const std::map<std::string, std::vector<std::string>>& guarded_libraries() {
  static const std::map<std::string, std::vector<std::string>> libraries = {
      {"FCL", {"fcl/", "ccd/"}},
      {"assimp", {"assimp/"}},
      {"CGAL", {"CGAL/"}},
      {"pugixml", {"pugixml"}},
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

// "core" for "genu/core/pose.h" behind the prefix "genu/"; empty for a path elsewhere or directly under the prefix. The
// umbrella over the API belongs to its room.
std::string room_of(const std::string& path, const std::string& prefix) {
  if (!path.starts_with(prefix)) return {};
  if (path == prefix + "genu.h") return "api";
  const std::size_t slash = path.find('/', prefix.size());
  return slash == std::string::npos ? std::string() : path.substr(prefix.size(), slash - prefix.size());
}

std::string at(const SourceFile& file, const Include& include) {
  return file.path + ":" + std::to_string(include.line) + ": includes " + include.header + ": ";
}

// Why a file of the room `from` (empty: a tool) must not include `header`; empty if it may.
std::string why_wrong(const Rooms& rooms, const std::string& from, const std::string& header) {
  const std::string to = room_of(header, kRoomPrefix);
  const bool ours = header.starts_with(kRoomPrefix);
  if (!ours) return from.empty() || header.find("../") == std::string::npos ? "" : "write it as genu/ROOM/FILE";
  if (!rooms.contains(to)) return "there is no room " + (to.empty() ? "in it" : to);
  if (from.empty() || from == to) return {};
  const bool files_alone = from == "judge" && to.starts_with("mesh");
  if (files_alone ? needed_by_judge().contains(header) : rooms.at(from).contains(to)) return {};
  return "wrong arrow " + from + " -> " + to;
}

// A unit is a header with its source: "genu/core/pose" for both, empty for files that stand in no room.
std::string unit_of(const std::string& path) {
  const std::string inside = path.starts_with("src/") ? path.substr(4) : path;
  return inside.starts_with(kRoomPrefix) ? inside.substr(0, inside.rfind('.')) : std::string();
}

using Graph = std::map<std::string, std::set<std::string>>;

Graph units_of(const std::vector<SourceFile>& files) {
  Graph graph;
  for (const SourceFile& file : files) {
    const std::string from = unit_of(file.path);
    if (from.empty()) continue;
    std::set<std::string>& uses = graph[from];
    for (const Include& include : includes_of(file))
      if (const std::string to = unit_of(include.header); !to.empty() && to != from) uses.insert(to);
  }
  return graph;
}

// Everything that can be reached from `start`, without `start` itself unless a way leads back to it.
std::set<std::string> reached_from(const Graph& graph, const std::string& start) {
  std::set<std::string> reached;
  std::vector<std::string> open = {start};
  while (!open.empty()) {
    const auto unit = graph.find(open.back());
    open.pop_back();
    if (unit == graph.end()) continue;
    for (const std::string& next : unit->second)
      if (reached.insert(next).second) open.push_back(next);
  }
  return reached;
}

}  // namespace

std::vector<SourceFile> read_sources(const fs::path& root, const std::vector<std::string>& tops) {
  std::vector<SourceFile> files;
  for (const std::string& top : tops) {
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

Rooms read_rooms(const fs::path& root) {
  static const std::regex pattern(R"re(set\(genu_([a-z_]+)_uses([^)]*)\))re");
  std::ifstream stream(root / "cmake/rooms.cmake");
  const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  Rooms rooms;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    std::istringstream names((*match)[2].str());
    std::set<std::string>& uses = rooms[(*match)[1]];
    for (std::string name; names >> name;) uses.insert(name);
  }
  return rooms;
}

std::vector<std::string> wrong_arrows(const std::vector<SourceFile>& files, const Rooms& rooms) {
  std::vector<std::string> wrong;
  for (const SourceFile& file : files) {
    const bool in_house = file.path.starts_with("src/");
    const std::string from = room_of(file.path, kRoomRoot);
    if (in_house && !rooms.contains(from)) {
      wrong.push_back(file.path + ":1: stands in no room");
      continue;
    }
    for (const Include& include : includes_of(file)) {
      if (const std::string why = why_wrong(rooms, from, include.header); !why.empty())
        wrong.push_back(at(file, include) + why);
    }
  }
  return wrong;
}

std::vector<std::string> room_cycles(const Rooms& rooms) {
  std::vector<std::string> found;
  for (const auto& [room, uses] : rooms)
    if (reached_from(rooms, room).contains(room)) found.push_back("room " + room + " uses itself by way of others");
  return found;
}

std::vector<std::string> unit_cycles(const std::vector<SourceFile>& files) {
  const Graph graph = units_of(files);
  std::map<std::string, std::set<std::string>> reached;
  for (const auto& [unit, uses] : graph) reached[unit] = reached_from(graph, unit);
  std::vector<std::string> found;
  std::set<std::string> seen;
  for (const auto& [unit, far] : reached) {
    if (!far.contains(unit) || seen.contains(unit)) continue;
    std::string line = "cycle of units:";
    for (const std::string& other : far) {
      if (!reached.contains(other) || !reached.at(other).contains(unit)) continue;
      seen.insert(other);
      line += " " + other;
    }
    found.push_back(line);
  }
  return found;
}

std::vector<std::string> crowded_rooms(const std::vector<SourceFile>& files) {
  std::map<std::string, std::size_t> lines;
  std::size_t all = 0;
  for (const SourceFile& file : files) {
    const std::string room = room_of(file.path, kRoomRoot);
    if (room.empty()) continue;
    lines[room] += file.lines.size();
    all += file.lines.size();
  }
  std::vector<std::string> found;
  for (const auto& [room, count] : lines) {
    if (static_cast<double>(count) <= kLargestRoom * static_cast<double>(all)) continue;
    found.push_back("room " + room + " has " + std::to_string(count) + " of " + std::to_string(all) +
                    " lines, more than a tenth");
  }
  return found;
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
