// The three figures of Dortmans et al. 1984, which the report gives in words, from meshes/dortmans1984 in both readings
// of "tori of 15 and 5 mm": rotation of the femur, strain of the anterior cruciate springs, shift of the contacts.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "studies/solved_scene.h"

namespace genu::studies {

/// How far a contact has gone since extension, at each row (m): along either surface, and how far the surfaces have
/// slid on one another there. Pure rolling has equal paths and no sliding.
struct ContactShift {
  std::string name;
  std::vector<double> tibia, femur, sliding;
};

struct DortmansReading {
  std::string scene;                                      ///< file name
  std::string words;                                      ///< how "15 and 5 mm" is read
  std::vector<double> flexion;                            ///< deg
  std::vector<double> exorotation;                        ///< deg, of the femur on the tibia since extension
  std::vector<double> anterior_strain, posterior_strain;  ///< AAC, PAC: strain less that in extension
  std::vector<double> moment;                             ///< N m, that holds the flexion
  std::vector<std::vector<double>> strains;               ///< of every spring less that in extension
  std::vector<std::string> springs;                       ///< their names
  std::array<ContactShift, 2> shifts;                     ///< medial, lateral
  bool all_stable = false;
};

/// What the figures show, of a solved scene of either reading.
DortmansReading reading_of(const SolvedScene& scene);

/// Solves both readings in `folder` (meshes/dortmans1984); fewer than two where a scene is refused.
std::vector<DortmansReading> solve_dortmans(const std::string& folder, Diagnostics& out);

/// Of a shift between two rows: the share of the femur's path that was slid over.
double sliding_share(const ContactShift& shift, std::size_t from, std::size_t to);

/// STUDY.md and one chart a reading.
Files dortmans_files(const std::vector<DortmansReading>& readings);

}  // namespace genu::studies
