// How lax a new knee is, and what of its chosen ligaments is changed until it is within the ranges of docs/laxity.md.
#pragma once

#include <string>

#include "genu/assemble/prepare.h"
#include "genu/core/cancelled.h"

namespace genu {

/// Changes of what new_ligaments.h and new_menisci.h choose.
struct NewKneeAims {
  double anterior = 0;     ///< subtracted from the strains at which fibres of the ACL settle
  double sideways = 0;     ///< added to those of the collateral ligaments and of the PCL
  double collaterals = 1;  ///< times their stiffness
  double rotation = 0;     ///< subtracted from those of the posteromedial capsule and the popliteofibular ligament
  double menisci = 1;      ///< times the stiffness of the menisci
};

/// For the terminal: what was changed, "; for it collaterals 1.44 times as stiff"; empty where nothing was.
std::string text_of(const NewKneeAims& aims);

struct NewKneeLaxity {
  struct Range {
    double least = 0, most = 0;  ///< over the angles
  };
  Range drawer;      ///< m: anterior
  Range sideways;    ///< rad: varus and valgus together
  Range rotation;    ///< rad: internal and external together
  int complete = 0;  ///< curves

  /// All curves, and each within its range.
  bool usual() const;
  /// For the terminal.
  std::string text() const;
};

/// At 0, 30, 60 and 90 deg, under the loads of `genu laxity`.
NewKneeLaxity laxity_of_new(const Prepared& prepared, const Cancelled& cancelled);

/// One step of `aims` toward the ranges; false where nothing is left to be changed.
bool aim_at_ranges(const NewKneeLaxity& found, NewKneeAims& aims);

}  // namespace genu
