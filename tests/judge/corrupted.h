// A table of good results in which a test changes a number.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/judge/judge.h"
#include "genu/scene/reader.h"
#include "genu/study/run_motion.h"
#include "genu/study/run_scene.h"

namespace genu::test {

class Corrupted {
 public:
  Corrupted(Scene scene, const std::string& csv) : scene_(std::move(scene)) {
    for (const std::string& line : split(csv, '\n'))
      if (!line.empty()) cells_.push_back(split(line, ','));
  }

  /// Solves a scene's file that has to be good.
  static Corrupted of(const std::string& file) {
    Diagnostics out;
    const auto prepared = prepare(file, out);
    for (const Diagnostic& d : out.items())
      if (d.severity == Diagnostic::Severity::error) ADD_FAILURE() << to_string(d);
    EXPECT_TRUE(prepared.has_value()) << file;
    if (!prepared) return {{}, ""};
    Solution solution;
    if (prepared->scene.dynamics) {
      solution = solve_motion(*prepared, {});
    } else {
      ContactField field(prepared->model);
      solution = solve(*prepared, field, {});
    }
    return {*read_scene(file, out), solution.poses.to_csv()};
  }

  std::string& cell(std::size_t row, const std::string& column) {
    for (std::size_t c = 0; c < cells_[0].size(); ++c)
      if (cells_[0][c] == column) return cells_[row + 1][c];
    ADD_FAILURE() << "no column " << column;
    return cells_[0][0];
  }
  double number(std::size_t row, const std::string& column) { return std::stod(cell(row, column)); }
  Corrupted& add(std::size_t row, const std::string& column, double delta) {
    cell(row, column) = fmt::format("{:.17g}", number(row, column) + delta);
    return *this;
  }
  Corrupted& swap_rows(std::size_t one, std::size_t other) {
    std::swap(cells_[one + 1], cells_[other + 1]);
    return *this;
  }
  std::size_t rows() const { return cells_.size() - 1; }
  Scene& scene() { return scene_; }

  std::string csv() const {
    std::string text;
    for (const auto& row : cells_) {
      for (std::size_t c = 0; c < row.size(); ++c) text += (c > 0 ? "," : "") + row[c];
      text += "\n";
    }
    return text;
  }

  judge::Judgement judge(judge::Options options = {.samples = 60}) const {
    Diagnostics out;
    auto found = judge::judge_results(scene_, csv(), "results.csv", options, out);
    for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
    return found ? std::move(*found) : judge::Judgement();
  }

  /// The kinds of checks that reject something.
  std::vector<std::string> rejections() const {
    std::vector<std::string> kinds;
    const judge::Judgement found = judge();
    for (const judge::Finding& f : found.findings.all())
      if (!f.good()) kinds.push_back(f.check);
    return kinds;
  }

 private:
  static std::vector<std::string> split(const std::string& text, char by) {
    std::vector<std::string> parts(1);
    for (const char c : text)
      if (c == by)
        parts.emplace_back();
      else
        parts.back() += c;
    return parts;
  }

  Scene scene_;
  std::vector<std::vector<std::string>> cells_;
};

}  // namespace genu::test
