#include "genu/new_scene/new_edit.h"

#include <tuple>

#include <fmt/format.h>

#include "genu/core/atomic_output.h"
#include "genu/core/file_text.h"
#include "genu/scene/reader.h"

namespace genu {
namespace {

constexpr const char* kCopyLine =
    "# As `genu new` wrote it: by this, `genu new --edit` knows what you have changed. Leave it as it is.\n";

}  // namespace

std::string written_copy(const std::string& text) { return kCopyLine + text; }

std::optional<EarlierScene> read_earlier(const NewSceneFiles& files, const NewScene& asked, Diagnostics& out) {
  std::error_code ignored;
  const auto mine = text_of_file(files.scene(), out);
  if (mine && !parse_scene(*mine, files.scene(), out)) return std::nullopt;
  if (mine && !std::filesystem::exists(files.written(), ignored)) {
    out.error(Code::no_such_file, files.written(),
              "is not there: without what genu wrote, --edit cannot know what you have changed. Write a scene of "
              "another name and move your changes there");
    return std::nullopt;
  }
  const auto written = mine ? text_of_file(files.written(), out) : std::nullopt;
  if (!mine || !written) return std::nullopt;
  const std::string line = kCopyLine;
  if (!written->starts_with(line)) {
    out.error(Code::broken_file, files.written(), "does not begin as genu wrote it: it is no copy of what genu wrote");
    return std::nullopt;
  }
  for (const auto& [bone, given, table] : {std::tuple("patella", &asked.patella, "\n[body.patella]\n"),
                                           std::tuple("fibula", &asked.fibula, "\n[surface.fibula]\n")})
    if (given->empty() && written->find(table) != std::string::npos)
      out.error(Code::meshes_needed, files.scene(), fmt::format("has a {0}: give --{0} again", bone));
  if (out.has_errors()) return std::nullopt;
  return EarlierScene{written->substr(line.size()), *mine};
}

MergedScene with_changes(const EarlierScene& earlier, const std::string& fresh, const std::string& file,
                         Diagnostics& out) {
  MergedScene merged = merge_scenes(earlier.written, earlier.mine, fresh);
  for (const MergeConflict& c : merged.conflicts)
    out.add(warning_at({file, c.where}, Code::conflict, c.key, c.mine,
                       c.fresh.empty() ? "is yours and stays, though genu does not write this table any more"
                                       : "is yours and stays; genu has " + c.fresh + " now"));
  return merged;
}

std::string write_edited(const NewSceneFiles& files, const EarlierScene& earlier, const std::string& merged,
                         const std::string& fresh) {
  std::string error = write_file_atomically(files.before(), earlier.mine);
  if (error.empty()) error = write_file_atomically(files.scene(), merged);
  if (error.empty()) error = write_file_atomically(files.written(), written_copy(fresh));
  return error;
}

}  // namespace genu
