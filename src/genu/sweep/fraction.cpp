#include "genu/sweep/fraction.h"

#include <algorithm>
#include <bit>

#include "genu/sweep/tolerances.h"

namespace genu {
namespace {

/// Sums of at most some number of words that were chosen.
class Sums {
 public:
  Sums(int bits, int most) : within_(static_cast<std::size_t>(most) + 1, std::vector<bool>(std::size_t{1} << bits)) {
    for (std::vector<bool>& sums : within_) sums[0] = true;
  }
  bool have(std::uint32_t word) const { return within_.back()[word]; }
  void add(std::uint32_t word) {
    for (std::size_t k = within_.size() - 1; k > 0; --k)
      for (std::uint32_t sum = 0; sum < within_[k].size(); ++sum)
        if (within_[k - 1][sum]) within_[k][sum ^ word] = true;
  }

 private:
  std::vector<std::vector<bool>> within_;
};

std::vector<std::uint32_t> words_of(int bits, std::size_t factors, int resolution) {
  Sums sums(bits, resolution - 2);
  std::vector<std::uint32_t> words;
  const auto add = [&](std::uint32_t word) {
    if (words.size() == factors || sums.have(word)) return;
    sums.add(word);
    words.push_back(word);
  };
  for (int bit = 0; bit < bits; ++bit) add(std::uint32_t{1} << bit);
  for (std::uint32_t word = 1; word < std::uint32_t{1} << bits && words.size() < factors; ++word) add(word);
  return words;
}

}  // namespace

std::optional<Fraction> find_fraction(std::size_t factors, int resolution) {
  for (int bits = 1; bits <= kMostFractionBits; ++bits)
    if (auto words = words_of(bits, factors, resolution); words.size() == factors) return Fraction{bits, words};
  return std::nullopt;
}

bool second_level(std::uint32_t word, std::uint64_t sample) { return std::popcount(word & sample) % 2 != 0; }

}  // namespace genu
