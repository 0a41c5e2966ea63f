// The fenced blocks of a Markdown page, and what is said of each in the comment before it:
//   <!-- not run: installs packages -->      never
//   <!-- long: an hour on two cores -->      with GENU_LONG=1 alone
//   <!-- needs: lenhart2015/some.stl -->     where the public data has that file
//   <!-- exit: 3 -->                         its commands end with this code, not 0
// In ```sh every line is a command; in ```console those after "$ ", and what follows each is a part of its output.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace genu::test {

/// README.md and every page of docs/, from the tree's root.
inline std::vector<std::string> doc_pages(const std::string& root) {
  std::vector<std::string> pages{"README.md"};
  for (const auto& entry : std::filesystem::directory_iterator(root + "/docs"))
    if (entry.path().extension() == ".md") pages.push_back("docs/" + entry.path().filename().string());
  std::sort(pages.begin() + 1, pages.end());
  return pages;
}

struct DocCommand {
  std::string text;
  std::vector<std::string> output;  ///< lines that it prints, in this order; others may stand between
  int line = 0;
};

struct DocBlock {
  std::string language;
  std::map<std::string, std::string> said;  ///< "not run", "long", "needs", "exit"
  std::vector<std::string> lines;
  int line = 0;  ///< of its first one
  std::vector<DocCommand> commands;
};

/// Joins lines that end in a backslash, leaves out comments and empty lines.
inline std::vector<DocCommand> commands_of(const DocBlock& block) {
  std::vector<DocCommand> commands;
  bool goes_on = false;
  for (std::size_t i = 0; i < block.lines.size(); ++i) {
    std::string line = block.lines[i];
    const bool console = block.language == "console";
    if (!goes_on && console && line.rfind("$ ", 0) != 0) {
      if (!commands.empty()) commands.back().output.push_back(line);
      continue;
    }
    if (!goes_on && (line.empty() || line.front() == '#')) continue;
    if (console && !goes_on) line = line.substr(2);
    if (!goes_on) commands.push_back({{}, {}, block.line + static_cast<int>(i)});
    goes_on = line.ends_with("\\");
    commands.back().text += goes_on ? line.substr(0, line.size() - 1) : line;
  }
  return commands;
}

inline void read_marker(const std::string& line, std::map<std::string, std::string>& said) {
  const std::size_t colon = line.find(": ");
  if (line.rfind("<!-- ", 0) != 0 || !line.ends_with(" -->") || colon == std::string::npos) return;
  said[line.substr(5, colon - 5)] = line.substr(colon + 2, line.size() - colon - 6);
}

inline std::vector<DocBlock> blocks_of(const std::string& markdown) {
  std::vector<DocBlock> blocks;
  std::map<std::string, std::string> said;
  std::istringstream in(markdown);
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.rfind("```", 0) == 0) {
      inside = !inside;
      if (inside) blocks.push_back({line.substr(3), said, {}, number + 1, {}});
      if (!inside && (blocks.back().language == "sh" || blocks.back().language == "console"))
        blocks.back().commands = commands_of(blocks.back());
      said.clear();
    } else if (inside) {
      blocks.back().lines.push_back(line);
    } else if (line.rfind("    ", 0) == 0) {
      blocks.push_back({"indented", said, {line.substr(4)}, number, {}});
    } else if (line.rfind("<!--", 0) == 0) {
      read_marker(line, said);
    } else {
      said.clear();
    }
  }
  return blocks;
}

}  // namespace genu::test
