// What is needed to see a failure again, as one text file.
//
// FILE is JSON: the scene; of its meshes what the failure needs, cut out round the contact where that is enough, found
// by trying; where the path rested last before it failed; the last accepted poses in hexadecimal numbers; events and
// messages; what the failure looks like. No folder of the user's is named in it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/core/diagnostics.h"

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
[[nodiscard]] std::optional<Failure> read_failure(const std::string& text, const std::string& file, Diagnostics& out);

}  // namespace genu
