#include "genu/sweep/whole_file.h"

#include <fmt/format.h>

namespace genu {
namespace {

constexpr const char* kEnd = "# end ";

std::string end_line(std::uint64_t count, const std::string& sum) { return fmt::format("{}{} {}", kEnd, count, sum); }

}  // namespace

void WholeFileWriter::write(std::string_view text) {
  sum_.add(text);
  file_.write(text);
}

std::string WholeFileWriter::commit(std::uint64_t count) {
  file_.write(end_line(count, sum_.sum().xxh128) + "\n");
  return file_.commit();
}

bool WholeFile::ends_with(std::uint64_t count) const { return end == end_line(count, sum); }

WholeFile look_through(std::istream& in, const std::function<void(std::uint64_t number, std::string_view line)>& each) {
  WholeFile file;
  RunningChecksum sum;
  std::string line;
  while (std::getline(in, line)) {
    file.whole = !in.eof() && line.starts_with(kEnd);
    file.end = line;
    if (file.whole) continue;  // what follows an end belongs to no shard: then the last line is none
    if (file.lines == 0) file.head = line;
    each(file.lines++, line);
    sum.add(line.append("\n"));
  }
  file.sum = sum.sum().xxh128;
  return file;
}

}  // namespace genu
