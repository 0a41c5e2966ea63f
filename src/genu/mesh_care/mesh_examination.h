// Everything there is to say about a mesh file before contact is computed on it: one line a question, each with a
// number and a verdict.
#pragma once

#include <string>
#include <vector>

#include "genu/mesh_care/mesh_flaws.h"
#include "genu/mesh_files/mesh_reader.h"

namespace genu {

struct MeshFinding {
  enum class Verdict {
    good,
    note,  ///< worth knowing; contact can be computed
    bad    ///< contact near it cannot be trusted
  };
  std::string question;  ///< "non-manifold edges"
  std::string number;    ///< "3", with its unit
  Verdict verdict = Verdict::good;
  std::string why;  ///< or where, or what to do; may be empty
};
const char* to_string(MeshFinding::Verdict verdict);

struct MeshExamination {
  std::vector<MeshFinding> findings;
  std::vector<Flaw> flaws;  ///< places, largest of each kind first
  bool bad() const;
};

/// `mesh` in m as read_mesh() gave it with `facts`; `metres_per_unit` is the file's unit, for places.
MeshExamination examine_mesh(const Mesh& mesh, const MeshFileFacts& facts, double metres_per_unit);

}  // namespace genu
