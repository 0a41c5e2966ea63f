// A table of the scene file being read: keys are asked for by name, and what nobody asked for is refused at the end.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "genu/scene/values.h"

namespace genu {

class Section {
 public:
  /// `item` must be a table (see as_section); `what` names it in messages, e.g. "a torus".
  Section(ReadContext& context, Item item, std::string what);

  /// The key's value; an item without a node where it is absent.
  Item find(const char* key);
  /// As find, but absence is an error.
  Item require(const char* key);
  /// Keys that are known to the format, but that this version refuses rather than ignores.
  void not_built(std::initializer_list<const char*> keys, const std::string& feature);
  /// Refuses every key that was not asked for. Call it once, last.
  void finish();

  bool has(const char* key) const { return item_.node->member(key) != nullptr; }
  const Item& item() const { return item_; }
  /// The path of a key of this table, present or not.
  std::string path(const std::string& key) const { return item_.path.empty() ? key : item_.path + "." + key; }
  /// Reports at the table's name.
  void error(Code code, const std::string& key, std::string rule);
  void rename(std::string what) { what_ = std::move(what); }

 private:
  ReadContext& context_;
  Item item_;
  std::string what_;
  std::vector<std::string> asked_;      ///< keys this table may have
  std::vector<std::string> not_built_;  ///< reported already
};

/// True if the item is a table; else reports it. Absent items are false, silently.
bool is_table(ReadContext& context, const Item& item);

/// The tables [GROUP.NAME] in the order of the file; bad names and values that are no tables are reported.
/// The item's node has the name as its key.
std::vector<Item> named_tables(ReadContext& context, Section& root, const char* group);

/// Reports a name that is not allowed.
void check_name(ReadContext& context, SourceLocation where, const std::string& path, const std::string& name);

}  // namespace genu
