#include "genu/new_scene/new_menisci.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "genu/new_scene/new_numbers.h"
#include "genu/new_scene/tolerances.h"

namespace genu {
namespace {

/// The sphere that is nearest to the cartilage of a posterior condyle of the reference knee (rms 0.6 mm). m.
struct MeniscusCondyle {
  const char* name;
  double anterior, proximal, lateral;
};
constexpr MeniscusCondyle kCondyles[] = {{"medial", 0.9e-3, 1.0e-3, -20.5e-3}, {"lateral", -2.4e-3, 1.0e-3, 23.0e-3}};

/// Where the tibia holds it, so far in front of the centre and behind it that the fibre stays nearly level, and 30 deg
/// outward, as the rim is held by the capsule: a condyle is held from side to side too. m.
constexpr double kMeniscusReach = 0.08, kMeniscusSplay = 0.046;

/// N at a strain of 1, and the strain up to which the force grows with its square: of 92 mm a condyle is held by
/// 4.9 N/mm from front to back and 1.6 N/mm from side to side where both fibres strain by 0.025, and by 52 N where it
/// has slid 8 mm further back.
constexpr double kMeniscusStiffness = 1200, kMeniscusTransition = 0.1;

struct MeniscusFibre {
  std::string name;
  Vec3 femur, tibia;  ///< m
};
std::vector<MeniscusFibre> meniscus_fibres(const FittedKnee& fitted) {
  std::vector<MeniscusFibre> out;
  for (const MeniscusCondyle& c : kCondyles)
    for (const auto& [horn, forward] :
         {std::pair("posterior", kMeniscusReach), std::pair("anterior", -kMeniscusReach)}) {
      const Vec3 centre(c.anterior, c.proximal, c.lateral);
      const Vec3 rim(forward, 0, std::copysign(kMeniscusSplay, c.lateral));
      out.push_back({fmt::format("meniscus_{}_{}", c.name, horn), fitted.femur.placed(centre),
                     fitted.tibia.placed(centre + rim)});
    }
  return out;
}

}  // namespace

std::string menisci_text(const FittedKnee& fitted) {
  std::string out =
      R"(# menisci: CHOSEN. They hold each condyle where the ligaments are slack, and when one is cut. They have no mesh here: each
# is two fibres to the centre of the posterior condyle, one from the front of the rim, which holds it from sliding back
# as the posterior horn does, and one from its rear. Neutral is the mean of the passive flexion.
[bundle.menisci]
fibres = "meniscus_*"

)";
  for (const MeniscusFibre& f : meniscus_fibres(fitted))
    out += fmt::format(
        "[ligament.{}]\nfrom = {{ body = \"femur\", point = {} }}\nto = {{ body = \"tibia\", point = {} }}\n"
        "law = \"blankevoort\"\n@{}@\ntransition_strain = {:g}\n@{}@\n\n",
        f.name, point_text(f.femur), point_text(f.tibia), stiffness_word(f.name), kMeniscusTransition,
        length_word(f.name));
  return out;
}

std::map<std::string, std::string> slack_menisci(const FittedKnee& fitted) {
  std::map<std::string, std::string> out;
  for (const MeniscusFibre& f : meniscus_fibres(fitted)) {
    set_slack(out[length_word(f.name)], 2 * (f.tibia - f.femur).norm());
    out[stiffness_word(f.name)] = stiffness_text(kMeniscusStiffness);
  }
  return out;
}

bool settle_menisci(const ResultTable& poses, std::map<std::string, std::string>& lengths) {
  bool any = false;
  for (auto& [word, text] : lengths) {
    if (!word.starts_with(length_word("meniscus_"))) continue;
    const std::string fibre = word.substr(length_word("").size());
    double sum = 0;
    int known = 0;
    for (std::size_t row = 0; row < poses.rows(); ++row)
      if (const auto length = length_in(poses, row, fibre)) sum += *length, ++known;
    if (known > 0) any = set_slack(text, sum / known / (1 + kMeniscusStrain)) || any;
  }
  return any;
}

}  // namespace genu
