#include "genu/scene/section.h"

#include <algorithm>

#include "genu/scene/words.h"

namespace genu {

namespace {

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

Section::Section(ReadContext& context, Item item, std::string what)
    : context_(context), item_(std::move(item)), what_(std::move(what)) {}

Item Section::find(const char* key) {
  if (!contains(asked_, key)) asked_.emplace_back(key);
  const TomlNode* child = item_.node->member(key);
  return child ? item_.member(*child) : Item{nullptr, path(key)};
}

Item Section::require(const char* key) {
  Item found = find(key);
  if (!found) error(Code::missing_key, key, "is missing: " + what_ + " needs it");
  return found;
}

void Section::not_built(std::initializer_list<const char*> keys, const std::string& feature) {
  for (const char* key : keys) {
    not_built_.emplace_back(key);
    const TomlNode* child = item_.node->member(key);
    if (child)
      context_.error(child->key_where, Code::not_built, path(key), literal(*child), "not built yet: " + feature);
  }
}

void Section::finish() {
  for (const TomlNode& child : item_.node->children) {
    if (contains(asked_, child.key) || contains(not_built_, child.key)) continue;
    const std::string rule = "is no key of " + what_ + did_you_mean(child.key, asked_) + " (its keys: ";
    std::string keys;
    for (const std::string& key : asked_) keys += (keys.empty() ? "" : ", ") + key;
    context_.error(child.key_where, Code::unknown_key, path(child.key), literal(child), rule + keys + ")");
  }
}

void Section::error(Code code, const std::string& key, std::string rule) {
  context_.error(item_.node->key_where, code, key.empty() ? item_.path : path(key), {}, std::move(rule));
}

bool is_table(ReadContext& context, const Item& item) {
  if (!item) return false;
  if (item.node->kind == TomlNode::Kind::table) return true;
  refuse(context, item, Code::wrong_form, "must be a table");
  return false;
}

std::vector<Item> named_tables(ReadContext& context, Section& root, const char* group) {
  std::vector<Item> tables;
  const Item all = root.find(group);
  if (!all) return tables;
  if (all.node->kind != TomlNode::Kind::table) {
    refuse(context, all, Code::wrong_form, "must be tables with names: [" + std::string(group) + ".NAME]");
    return tables;
  }
  for (const TomlNode& child : all.node->children) {
    const Item item = all.member(child);
    check_name(context, child.key_where, item.path, child.key);
    if (is_table(context, item)) tables.push_back(item);
  }
  return tables;
}

void check_name(ReadContext& context, SourceLocation where, const std::string& path, const std::string& name) {
  if (is_name(name)) return;
  context.error(where, Code::wrong_form, path, with_quotes(name),
                "a name is a letter or _, then letters, digits, _ or -, 100 characters at most");
}

}  // namespace genu
