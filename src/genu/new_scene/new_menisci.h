// The menisci of a new knee, which no mesh shows: fibres that hold its condyles on the tibia.
#pragma once

#include <map>
#include <string>

#include "genu/atlas/fitted_knee.h"
#include "genu/results/result_table.h"

namespace genu {

/// Tables of a scene, in the frame of the meshes: two fibres to the centre of each posterior condyle, one from the
/// front of the rim, which holds it from sliding back as the posterior horn does, and one from its rear. Their lengths
/// and stiffnesses are words between @.
std::string menisci_text(const FittedKnee& fitted);

/// What stands for these words in the first trial: so long that they are slack.
std::map<std::string, std::string> slack_menisci(const FittedKnee& fitted);

/// Sets their lengths such that each strains by kMeniscusStrain in the mean of the poses that were found. Whether one
/// changed by more than kSettledLength.
bool settle_menisci(const ResultTable& poses, std::map<std::string, std::string>& lengths);

}  // namespace genu
