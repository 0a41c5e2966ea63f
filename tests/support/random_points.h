// Points drawn by lot, the same in every run.
#pragma once

#include <random>

#include "genu/core/types.h"

namespace genu::test {

class RandomPoints {
 public:
  explicit RandomPoints(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 in_ball(double radius) {
    Vec3 x;
    do {
      x = Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    } while (x.norm() > 1);
    return radius * x;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace genu::test
