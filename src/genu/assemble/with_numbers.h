// The same joint with other numbers: what does not depend on them is not prepared again.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/model/contact_field.h"
#include "genu/model/parameters.h"

namespace genu {

/// A parameter of a scene and its new value (SI; points in the body's frame as the file has it).
using NewNumber = std::pair<Parameter, double>;

/// `prepared` with new numbers of ligaments, loads, bodies and joints (parameter_number() says which can change).
/// Surfaces, bones, and elastic layers that the numbers do not change are shared, and so is Prepared::search. Empty,
/// with errors in `out`, where a number cannot be changed or the scene's laws cannot be with it.
[[nodiscard]] std::optional<Prepared> with_numbers(const Prepared& prepared, const std::vector<NewNumber>& numbers,
                                                   Diagnostics& out);

/// `prepared` with the numbers of another scene: its surfaces, contacts, bodies and joints must be those of `prepared`,
/// but for numbers that with_numbers() can change; ligaments and loads may be others. Shares as much. Empty, with
/// errors in `out`, where the laws of `scene` cannot be.
[[nodiscard]] std::optional<Prepared> with_scene(const Prepared& prepared, Scene scene, Diagnostics& out);

/// Prepares the search for contacts once and for all that with_numbers() makes of `prepared` from now on.
void share_search(Prepared& prepared);

/// The search for contacts of this joint, as if nothing had been looked at yet: with what share_search() has prepared,
/// or from nothing.
ContactField contact_field(const Prepared& prepared);

}  // namespace genu
