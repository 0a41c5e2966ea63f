#include "genu/api/own_law.h"

#include <cmath>
#include <limits>

#include "genu/api/inside.h"

namespace genu::api {
namespace {

class OwnLaw final : public ForceLaw {
 public:
  explicit OwnLaw(Law law) : law_(std::move(law)) {
    const LawValue above = beyond(std::nextafter(law_.slack_length, std::numeric_limits<double>::infinity()));
    breaks_ = {{law_.slack_length, {0, 0, true}, {above.force, above.stiffness}}};
  }
  LawValue evaluate(double length) const override { return length <= law_.slack_length ? LawValue() : beyond(length); }
  std::vector<LawBreak> breaks() const override { return breaks_; }
  std::optional<double> slack_length() const override { return law_.slack_length; }

 private:
  LawValue beyond(double length) const {
    const Tension t = law_.tension(length);
    return {t.force, t.stiffness, t.energy};
  }

  Law law_;
  std::vector<LawBreak> breaks_;
};

}  // namespace

LigamentLaw law_of(const std::string& ligament, const Law& law) {
  const std::string key = "ligament." + ligament;
  if (!law.tension) refuse(Code::missing_key, key, {}, "the law has no function");
  if (!(law.slack_length > 0) || !std::isfinite(law.slack_length))
    refuse(Code::out_of_range, key, {}, "the law's slack length must be > 0 m");
  std::string why;
  const auto made = LigamentLaw::custom(std::make_shared<OwnLaw>(law), why);
  if (!made) refuse(Code::out_of_range, key, {}, why);
  return *made;
}

}  // namespace genu::api
