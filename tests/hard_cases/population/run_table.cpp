#include "hard_cases/population/run_table.h"

#include <fstream>
#include <sstream>

namespace genu::population {
namespace {

/// Fields of a line; a field in quotes may hold commas, and quotes twice.
std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"')
        out.back() += line[++i];
      else
        quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      out.emplace_back();
    } else {
      out.back() += line[i];
    }
  }
  return out;
}

}  // namespace

RunTable RunTable::read(const std::string& path) {
  RunTable out;
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) return out;
  out.columns = fields(line);
  for (std::size_t i = 0; i < out.columns.size(); ++i) out.index_[out.columns[i]] = i;
  while (std::getline(in, line)) {
    out.rows.push_back(fields(line));
    out.rows.back().resize(out.columns.size());
  }
  return out;
}

}  // namespace genu::population
