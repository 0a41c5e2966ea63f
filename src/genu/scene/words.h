// Words in messages: names, lists of choices and suggestions for what was mistyped.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace genu {

/// True for [A-Za-z_][A-Za-z0-9_-]*, what a body, joint, coordinate, surface, contact, ligament or load may be called.
bool is_name(std::string_view word);

/// "word" as it stands
std::string with_quotes(std::string_view word);

/// "a", "b", "c"
std::string quoted_list(const std::vector<std::string>& words);

/// `; did you mean "flexion"?` where one of `known` is near to `word` (edit distance, a swap is one, any case, at most
/// a third of the word and never more than 3), or else begins with it; empty where none does. The first of equally near
/// ones.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

/// Whether `word` is what `pattern` means, where * stands for any letters, also none, and ? for any one.
bool matches(std::string_view pattern, std::string_view word);

}  // namespace genu
