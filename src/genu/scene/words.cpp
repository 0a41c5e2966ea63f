#include "genu/scene/words.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

#include "genu/scene/tolerances.h"

namespace genu {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Letters that are changed, left out or added, and neighbours that are swapped: each counts once.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto equal = [&](std::size_t i, std::size_t j) { return lower(a[i - 1]) == lower(b[j - 1]); };
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j - 1] + (equal(i, j) ? 0 : 1), last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && equal(i, j - 1) && equal(i - 1, j)) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = std::exchange(last, row);
  }
  return last.back();
}

}  // namespace

bool is_name(std::string_view word) {
  return !word.empty() && word.size() <= kLongestName && is_letter(word[0]) &&
         std::all_of(word.begin(), word.end(), [](char c) { return is_letter(c) || is_digit(c) || c == '-'; });
}

std::string with_quotes(std::string_view word) { return "\"" + std::string(word) + "\""; }

std::string quoted_list(const std::vector<std::string>& words) {
  std::string s;
  for (const std::string& word : words) s += (s.empty() ? "" : ", ") + with_quotes(word);
  return s;
}

bool matches(std::string_view pattern, std::string_view word) {
  // After a mismatch the last * takes one letter more: linear in each star, no recursion.
  std::size_t p = 0, w = 0, star = std::string_view::npos, taken = 0;
  while (w < word.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = w;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == word[w])) {
      ++p;
      ++w;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      w = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() > kLongestSuggested) return {};
  const std::string* best = nullptr;
  std::size_t best_distance = std::clamp<std::size_t>((word.size() + 1) / 3, 1, 3) + 1;
  for (const std::string& candidate : known) {
    if (candidate.empty() || candidate.size() > kLongestSuggested) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance && distance < candidate.size()) {
      best = &candidate;
      best_distance = distance;
    }
  }
  const auto begins = [&](const std::string& candidate) {
    return candidate.size() > word.size() && candidate.size() <= kLongestSuggested &&
           std::equal(word.begin(), word.end(), candidate.begin(), [](char a, char b) { return lower(a) == lower(b); });
  };
  if (best == nullptr && word.size() >= kShortestBeginning)
    if (const auto found = std::find_if(known.begin(), known.end(), begins); found != known.end()) best = &*found;
  return best ? "; did you mean " + with_quotes(*best) + "?" : std::string();
}

}  // namespace genu
