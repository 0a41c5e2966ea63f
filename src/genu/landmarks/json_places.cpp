#include "genu/landmarks/json_places.h"

#include <cctype>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "genu/landmarks/tolerances.h"

namespace genu {
namespace {

using nlohmann::json;

/// Follows the parser through the text: from token to token there is nothing but blanks, commas and colons.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
  }

  /// The next token, as it stands.
  std::string_view next() {
    while (at_ < text_.size() && std::string_view(" \t\r\n,:").find(text_[at_]) != std::string_view::npos) pass();
    place_ = {line_, column_};
    const std::size_t begin = at_;
    if (at_ >= text_.size()) return {};
    if (text_[at_] == '"')
      pass_string();
    else if (std::string_view("[]{}").find(text_[at_]) != std::string_view::npos)
      pass();
    else
      while (at_ < text_.size() && is_literal(text_[at_])) pass();
    return text_.substr(begin, at_ - begin);
  }

  /// Of the token that came last.
  SourceLocation place() const { return place_; }

  /// Of a byte, from here on.
  SourceLocation place_of(std::size_t byte) {
    while (at_ < std::min(byte, text_.size())) pass();
    return {line_, column_};
  }

 private:
  static bool is_literal(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
  }

  void pass() {
    const char c = text_[at_++];
    if (c == '\n') {
      ++line_;
      column_ = 1;
    } else if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) {
      ++column_;
    }
  }

  void pass_string() {
    pass();
    while (at_ < text_.size() && text_[at_] != '"') {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) pass();
      pass();
    }
    if (at_ < text_.size()) pass();
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, column_ = 1;
  SourceLocation place_;
};

class Builder : public nlohmann::json_sax<json> {
 public:
  Builder(const std::string& file, std::string_view text, Diagnostics& out) : file_(file), cursor_(text), out_(out) {}

  bool null() override { return leaf(JsonValue::Kind::null, 0); }
  bool boolean(bool value) override { return leaf(JsonValue::Kind::boolean, value ? 1 : 0); }
  bool number_integer(number_integer_t value) override {
    return leaf(JsonValue::Kind::number, static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return leaf(JsonValue::Kind::number, static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t& /*text*/) override {
    return leaf(JsonValue::Kind::number, value);
  }
  bool string(string_t& value) override {
    leaf(JsonValue::Kind::string, 0);
    last_->text = value;
    return true;
  }
  bool binary(binary_t& /*value*/) override { return false; }
  bool start_object(std::size_t /*elements*/) override { return open(JsonValue::Kind::object); }
  bool start_array(std::size_t /*elements*/) override { return open(JsonValue::Kind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& value) override {
    cursor_.next();
    name_ = value;
    return true;
  }
  bool parse_error(std::size_t position, const std::string& /*token*/, const json::exception& /*error*/) override {
    const SourceLocation place = cursor_.place_of(position > 0 ? position - 1 : 0);
    out_.add(
        error_at({file_, place}, Code::broken_file, {}, {}, "is no JSON from here on: the file is damaged or cut"));
    return false;
  }

  JsonValue root{};

 private:
  bool leaf(JsonValue::Kind kind, double number) {
    const std::string_view token = cursor_.next();
    add({kind, name_, cursor_.place(), number, std::string(token), {}});
    return true;
  }

  bool open(JsonValue::Kind kind) {
    leaf(kind, 0);
    if (open_.size() >= kMostNested) {
      out_.add(error_at({file_, cursor_.place()}, Code::broken_file, {}, {},
                        fmt::format("is nested more than {} deep: this is no list of landmarks", kMostNested)));
      return false;
    }
    open_.push_back(last_);
    return true;
  }

  bool close() {
    cursor_.next();
    open_.pop_back();
    return true;
  }

  void add(JsonValue value) {
    if (open_.empty()) {
      root = std::move(value);
      last_ = &root;
    } else {
      if (open_.back()->kind == JsonValue::Kind::array) value.name.clear();
      open_.back()->children.push_back(std::move(value));
      last_ = &open_.back()->children.back();
    }
  }

  std::string file_;
  Cursor cursor_;
  Diagnostics& out_;
  std::string name_;
  JsonValue* last_ = nullptr;
  std::vector<JsonValue*> open_;  // each an ancestor of the next, which stays where it is while it is open
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view member) const {
  if (kind != Kind::object) return nullptr;
  for (const JsonValue& child : children)
    if (child.name == member) return &child;
  return nullptr;
}

std::optional<JsonValue> read_json(const std::string& file, const std::string& text, Diagnostics& out) {
  Builder builder(file, text, out);
  if (!json::sax_parse(text, &builder)) return std::nullopt;
  return std::move(builder.root);
}

}  // namespace genu
