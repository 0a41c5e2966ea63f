// Every link from README.md and docs/ to a file of the tree leads there, and to a heading that is there.
#include <cctype>
#include <set>

#include <gtest/gtest.h>

#include "doc_blocks.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu::test {
namespace {

namespace fs = std::filesystem;

/// The anchor that GitHub gives a heading: small letters, without signs, - for spaces.
std::string anchor_of(const std::string& heading) {
  std::string out;
  for (const char c : heading) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) != 0 || c == '-' || c == '_') out += static_cast<char>(std::tolower(u));
    if (c == ' ') out += '-';
  }
  return out;
}

/// The lines outside of fenced blocks.
std::vector<std::string> prose_of(const std::string& markdown) {
  std::vector<std::string> lines;
  std::istringstream in(markdown);
  bool fenced = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("```", 0) == 0) fenced = !fenced;
    if (!fenced) lines.push_back(line);
  }
  return lines;
}

std::set<std::string> anchors_of(const std::string& markdown) {
  std::set<std::string> anchors;
  for (const std::string& line : prose_of(markdown))
    if (line.rfind("#", 0) == 0) anchors.insert(anchor_of(line.substr(line.find_first_not_of("# "))));
  return anchors;
}

TEST(DocLinks, LeadToWhatIsThere) {
  const std::string root = genu::test::source_folder();
  int links = 0;
  for (const std::string& page : doc_pages(root))
    for (const std::string& line : prose_of(read_file(root + "/" + page)))
      for (std::size_t at = line.find("]("); at != std::string::npos; at = line.find("](", at + 2)) {
        const std::string target = line.substr(at + 2, line.find(')', at) - at - 2);
        if (target.rfind("http", 0) == 0) continue;
        const std::string file = target.substr(0, target.find('#'));
        const fs::path to = file.empty() ? fs::path(root + "/" + page) : (root + "/" + page) / fs::path("..") / file;
        const fs::path plain = to.lexically_normal();
        EXPECT_TRUE(fs::exists(plain)) << page << ": " << target;
        if (target.find('#') != std::string::npos) {
          const std::string anchor = target.substr(target.find('#') + 1);
          EXPECT_EQ(anchors_of(read_file(plain.string())).count(anchor), 1u) << page << ": " << target;
        }
        ++links;
      }
  EXPECT_GT(links, 60);
  EXPECT_EQ(anchor_of("Solids for `genu mesh`"), "solids-for-genu-mesh");
}

}  // namespace
}  // namespace genu::test
