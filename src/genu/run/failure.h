// What is needed to see a failure again, in one text file: a failed run of a scene becomes FILE, FILE becomes a scene
// that fails in the same way.
//
// FILE is JSON: the scene; of its meshes what the failure needs, cut out round the contact where that is enough, found
// by trying; where the path rested last before it failed; the last accepted poses in hexadecimal numbers; events and
// messages; what the failure looks like. No folder of the user's is named in it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/run/run_scene.h"

namespace genu {

struct Failure {
  std::string version, program;                             ///< of genu, and program_hash()
  std::vector<std::string> verdict;                         ///< what was refused or failed, one line each, numbers as #
  std::string scene;                                        ///< the text of the scene; meshes are named mesh1.stl, ...
  std::vector<std::pair<std::string, std::string>> meshes;  ///< name and bytes
  std::string meshes_are;                                   ///< "whole", "within 10 mm of contact", ... in words
  std::string rest;                                         ///< Solution::rest; empty: from the reference pose
  std::uint64_t memory_limit = 0;                           ///< bytes of address space that it had; 0: no limit
  std::vector<std::string> last_poses, events, messages;    ///< to be read by people
};

/// FILE's text and back. Nothing, with the reason in `out`, where `text` is none or has been changed.
std::string to_json(const Failure& failure);
std::optional<Failure> read_failure(const std::string& text, const std::string& file, Diagnostics& out);

/// Whether two lists of lines of Failure::verdict say the same.
bool alike(std::vector<std::string> expected, std::vector<std::string> found);

/// Writes `file` after a run of `scene` that was refused (`prepared` may then be null) or `found` not every pose to be
/// ok. Errors and warnings of that run stand in `out`, which gets a warning that says what was written, or why not.
void save_failure(const std::string& file, const std::string& scene, const Prepared* prepared, const Solution& found,
                  const RunOptions& options, Diagnostics& out);

/// Writes scene.toml and the meshes into `folder`. An error as text; the empty text is success.
std::string unpack(const Failure& failure, const std::string& folder);

/// Runs what was unpacked into `folder`, and gives the lines that Failure::verdict would have.
std::vector<std::string> reproduce(const Failure& failure, const std::string& folder, const RunOptions& options);

}  // namespace genu
