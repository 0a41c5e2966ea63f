// A new scene is written and tried out until it is as good as it gets: slack lengths settle by the poses that are
// found, and the knee's laxity is brought into the usual ranges.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/new_scene/asked_scene.h"
#include "genu/new_scene/new_patella.h"
#include "genu/new_scene/new_picture.h"
#include "genu/new_scene/new_words.h"
#include "genu/study/run_scene.h"

namespace genu {

/// A new scene's text with the words in it that are still to be filled in.
struct Composed {
  std::string text;
  Words words;
  std::vector<std::string> choices;
  std::string ligaments{};  ///< of kind stl: their text, and what stands for its words
  Words lengths{};
  NewPatella patella{};           ///< which comes last
  std::optional<NewKnee> knee{};  ///< for its picture
  bool with_patella = false;

  std::string whole();
};

/// The text of a scene that is finished, and what its trial gave.
struct Tried {
  std::string text;
  std::optional<Solution> found;
  std::string laxity{};           ///< what it gives, where that was tested
  std::string aimed{};            ///< what was changed for it
  std::string without_patella{};  ///< what the trial without it gave, where there is one
};

/// Works on the file `staged`; messages call it `name`. An error in words; empty: none.
std::string settle_new_scene(const NewScene& asked, const std::string& staged, const std::string& name,
                             Composed& composed, Tried& tried, Diagnostics& out);

}  // namespace genu
