// A scene that is written anew, with what a user has changed in it since it was written: a merge of three texts, key by
// key.
#pragma once

#include <string>
#include <vector>

#include "genu/core/source_location.h"

namespace genu {

/// Where a user's change and the new scene do not agree: the user's stays.
struct MergeConflict {
  SourceLocation where;     ///< in the user's text
  std::string key;          ///< "ligament.LCL1.from"
  std::string mine, fresh;  ///< both values; fresh is empty where the new scene has no such table any more
};

struct MergedScene {
  std::string text;
  int kept = 0;  ///< changes of the user: values, keys and tables that were changed, added or taken out
  std::vector<MergeConflict> conflicts;
};

/// `written`: what was written before, `mine`: what the user has made of it, `fresh`: what is written now. Lines end
/// with LF or CR LF; [[tables]] of one name are counted.
MergedScene merge_scenes(const std::string& written, const std::string& mine, const std::string& fresh);

}  // namespace genu
