// What becomes of each element of a file.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "genu/osim/model.h"

namespace genu::osim {

enum class Fate { kept, frozen, left_out };

/// "kept", "frozen", "left out"
const char* word_of(Fate fate);

struct Outcome {
  Fate fate = Fate::left_out;
  std::string in_scene;  ///< where it is in the scene: "ligament.ACLpl1"; empty where it is left out
  std::string reason;    ///< the same words for all elements that share it
  std::string detail;    ///< of this one: "hip_flex_r = 30 deg"
};

class Outcomes {
 public:
  void kept(const SourceLocation& where, const std::string& in_scene, const std::string& reason = {},
            const std::string& detail = {}) {
    set(where, {Fate::kept, in_scene, reason, detail});
  }
  void frozen(const SourceLocation& where, const std::string& in_scene, const std::string& reason,
              const std::string& detail = {}) {
    set(where, {Fate::frozen, in_scene, reason, detail});
  }
  void left_out(const SourceLocation& where, const std::string& reason, const std::string& detail = {}) {
    set(where, {Fate::left_out, {}, reason, detail});
  }
  bool has(const SourceLocation& where) const { return by_place_.count(key(where)) > 0; }
  const Outcome& of(const SourceLocation& where) const { return by_place_.at(key(where)); }

 private:
  using Key = std::pair<int, int>;
  static Key key(const SourceLocation& where) { return {where.line, where.column}; }
  void set(const SourceLocation& where, Outcome outcome) { by_place_[key(where)] = std::move(outcome); }
  std::map<Key, Outcome> by_place_;
};

/// Gives each element without an outcome the one of its kind: markers, display meshes, what genu does not know.
void settle_the_rest(const std::vector<Item>& items, Outcomes& outcomes);

/// import.csv: line, set, type, name, fate, in_scene, reason; a row for each element.
std::string outcome_table(const std::vector<Item>& items, const Outcomes& outcomes);

/// In words, a line for each kind of element and reason: how many, which, and what they would have done. Then a line
/// for each element with a WARNING of its own.
std::vector<std::string> outcome_summary(const std::vector<Item>& items, const Outcomes& outcomes);

}  // namespace genu::osim
