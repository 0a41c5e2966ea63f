// What tests do with the text of scenes, files and messages.
#pragma once

#include <string>

#include <gtest/gtest.h>

namespace genu::test {

/// `text` with the first `piece` replaced, which must be there.
inline std::string with_first(std::string text, const std::string& piece, const std::string& by) {
  const std::size_t at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return at == std::string::npos ? text : text.replace(at, piece.size(), by);
}

inline bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

/// How often `piece` stands in a text, without overlap.
inline int occurrences(const std::string& text, const std::string& piece) {
  int n = 0;
  for (std::size_t at = 0; (at = text.find(piece, at)) != std::string::npos; at += piece.size()) ++n;
  return n;
}

}  // namespace genu::test
