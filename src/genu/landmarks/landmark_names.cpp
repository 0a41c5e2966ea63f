#include "genu/landmarks/landmark_names.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>

namespace genu {
namespace {

using Words = std::vector<std::string>;
using Kind = LandmarkMeaning::Kind;

/// A ligament, the bundles of the reference knee that are its, and what people call it.
struct LigamentNames {
  const char *name, *bundles;
  bool to_fibula;
  std::initializer_list<const char*> spellings;
};
const std::initializer_list<LigamentNames> kLigamentNames = {
    {"ACL", "ACLam ACLpl", false, {"acl", "anterior cruciate"}},
    {"ACLam", "ACLam", false, {"aclam", "acl am", "amb", "am", "anteromedial", "acl anteromedial"}},
    {"ACLpl", "ACLpl", false, {"aclpl", "acl pl", "plb", "pl", "posterolateral", "acl posterolateral"}},
    {"PCL", "PCLal PCLpm", false, {"pcl", "posterior cruciate"}},
    {"PCLal", "PCLal", false, {"pclal", "pcl al", "alb", "anterolateral", "pcl anterolateral"}},
    {"PCLpm", "PCLpm", false, {"pclpm", "pcl pm", "pmb", "posteromedial", "pcl posteromedial"}},
    {"MCL",
     "MCLs",
     false,
     {"mcl", "mcls", "smcl", "mcl superficial", "medial collateral", "medial collateral superficial"}},
    {"MCLd", "MCLd", false, {"mcld", "dmcl", "mcl deep", "medial collateral deep"}},
    {"MCLp", "MCLp", false, {"mclp", "pol", "posterior oblique", "posteromedial capsule"}},
    {"LCL", "LCL", true, {"lcl", "fcl", "lateral collateral", "fibular collateral"}},
    {"PFL", "PFL", true, {"pfl", "popliteofibular"}},
    {"pCAP", "pCAP", false, {"pcap", "posterior capsule"}},
};

struct PlaceNames {
  const char* name;
  Kind kind;
  std::initializer_list<const char*> spellings;
};
const std::initializer_list<PlaceNames> kPlaceNames = {
    {"medial epicondyle",
     Kind::medial_epicondyle,
     {"medial epicondyle", "medial epicondyle femur", "medial femoral epicondyle", "med epicondyle", "med epi", "mec",
      "fme", "medepi"}},
    {"lateral epicondyle",
     Kind::lateral_epicondyle,
     {"lateral epicondyle", "lateral epicondyle femur", "lateral femoral epicondyle", "lat epicondyle", "lat epi",
      "lec", "fle", "latepi"}},
    {"knee centre", Kind::knee_centre, {"knee centre", "knee joint centre", "joint centre", "kjc"}},
    {"hip centre",
     Kind::hip_centre,
     {"hip centre", "hip joint centre", "femoral head centre", "femur head centre", "femoral head", "hjc"}},
    {"ankle centre", Kind::ankle_centre, {"ankle centre", "ankle joint centre", "ajc"}},
};

const std::initializer_list<const char*> kFemurWords = {"femur", "femoral", "fem", "f", "femurs", "proximal", "origin"};
const std::initializer_list<const char*> kTibiaWords = {"tibia", "tibial", "tib", "t", "distal", "insertion"};
const std::initializer_list<const char*> kFibulaWords = {"fibula", "fibular", "fib", "fibula head", "fibular head"};
/// Words that say nothing where a bone is named.
const std::initializer_list<const char*> kFillers = {
    "ligament", "lig",  "attachment", "attach", "footprint", "site",   "centre",   "point", "pt",     "end",
    "the",      "of",   "at",         "on",     "bundle",    "fiber",  "fibre",    "mid",   "middle", "to",
    "and",      "bone", "insertion",  "origin", "proximal",  "distal", "centroid", "from"};
/// Those of them that can stand for a bone, where none is named.
const std::initializer_list<const char*> kEnds = {"insertion", "origin", "proximal", "distal"};

bool among(const std::string& word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

char lower_letter(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Whether a word begins at i: "aclFemur", "ACLFemur", "femur2".
bool begins_word(std::string_view name, std::size_t i) {
  const auto is = [&](std::size_t k, int (*kind)(int)) { return kind(static_cast<unsigned char>(name[k])) != 0; };
  if (i == 0) return false;
  if (is(i, std::isdigit) != is(i - 1, std::isdigit)) return true;
  if (is(i, std::isupper) && is(i - 1, std::islower)) return i > 1 && is(i - 2, std::islower);  // not in "pCAP"
  return is(i, std::isupper) && is(i - 1, std::isupper) && i + 2 < name.size() && is(i + 1, std::islower) &&
         is(i + 2, std::islower);
}

/// The words of a name, in small letters.
Words words_of(std::string_view name) {
  Words out;
  std::string word;
  const auto end = [&] {
    if (word == "center" || word == "centr") word = "centre";
    if (!word.empty()) out.push_back(word);
    word.clear();
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (std::isalnum(static_cast<unsigned char>(name[i])) == 0) {
      end();
      continue;
    }
    if (begins_word(name, i)) end();
    word += lower_letter(name[i]);
  }
  end();
  return out;
}

std::string joined(const Words& words) {
  std::string out;
  for (const std::string& word : words) out += word;
  return out;
}
std::string sorted(Words words) {
  std::sort(words.begin(), words.end());
  return joined(words);
}

/// In the same words in any order, or run together in this one.
bool same(const Words& said, const Words& known) {
  return joined(said) == joined(known) || sorted(said) == sorted(known);
}

Words both(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bool says_both(const Words& said, const Words& ligament, std::initializer_list<const char*> bones) {
  return std::any_of(bones.begin(), bones.end(), [&](const char* bone) {
    const Words word = words_of(bone);
    return same(said, both(ligament, word)) || same(said, both(word, ligament));
  });
}

Words without(Words words, std::initializer_list<const char*> fillers, std::initializer_list<const char*> kept = {}) {
  std::erase_if(words, [&](const std::string& w) { return among(w, fillers) && !among(w, kept); });
  return words;
}

std::optional<LandmarkMeaning> ligament_end(const Words& said) {
  for (const LigamentNames& ligament : kLigamentNames)
    for (const char* spelling : ligament.spellings) {
      const Words words = words_of(spelling);
      const bool femur = says_both(said, words, kFemurWords);
      const bool fibula = !femur && ligament.to_fibula && says_both(said, words, kFibulaWords);
      if (!femur && !fibula && !says_both(said, words, kTibiaWords)) continue;
      const std::string bone = femur ? "femur" : ligament.to_fibula ? "fibula" : "tibia";
      LandmarkMeaning out{
          Kind::ligament_end, std::string(ligament.name) + " " + bone, {}, femur, !femur && ligament.to_fibula};
      const std::string bundles = ligament.bundles;
      const std::size_t space = bundles.find(' ');
      out.bundles = {bundles.substr(0, space)};
      if (space != std::string::npos) out.bundles.push_back(bundles.substr(space + 1));
      return out;
    }
  return std::nullopt;
}

std::optional<LandmarkMeaning> known_place(const Words& said) {
  for (const PlaceNames& known : kPlaceNames)
    for (const char* spelling : known.spellings)
      if (same(said, words_of(spelling))) return LandmarkMeaning{known.kind, known.name, {}, false, false, {}};
  return std::nullopt;
}

/// The side that a word says, where it says one.
std::optional<bool> side_in(const std::string& word) {
  if (among(word, {"left", "l", "lt", "links"})) return true;
  if (among(word, {"right", "r", "rt"})) return false;
  return std::nullopt;
}

}  // namespace

std::optional<LandmarkMeaning> meaning_of(std::string_view name) {
  Words words = words_of(name);
  std::optional<bool> left;
  for (const std::string& word : words)
    if (const auto side = side_in(word)) left = side;
  std::erase_if(words, [](const std::string& w) {
    return side_in(w) || std::isdigit(static_cast<unsigned char>(w.front())) != 0;
  });
  if (words.empty()) return std::nullopt;
  auto found = known_place(words);
  if (!found) found = known_place(without(words, {"the", "of", "point", "pt", "mid", "middle"}));
  if (!found) found = ligament_end(without(words, kFillers, kEnds));
  if (!found) found = ligament_end(without(words, kFillers));
  if (found) found->left = left;
  return found;
}

std::string known_landmarks() {
  std::string ligaments, fibular, places;
  for (const LigamentNames& l : kLigamentNames) (l.to_fibula ? fibular : ligaments) += std::string(l.name) + ", ";
  for (const PlaceNames& p : kPlaceNames) places += std::string(", ") + p.name;
  fibular.resize(fibular.size() - 2);
  return ligaments + "each with femur or tibia; " + fibular + " with femur or fibula" + places;
}

}  // namespace genu
