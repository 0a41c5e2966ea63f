// All of genu that a program of your own needs: scenes that are read once, changed in memory and solved.
//
//   #include <genu/genu.h>
//   genu::api::Scene knee = genu::api::load("knee.toml");
//   const genu::api::Results found = knee.run();
//   for (const double z : found["knee.z_mm"]) std::printf("%g\n", z);
//
// Compile with C++20 and link genu::genu (find_package(genu)). Nothing else is needed: no header of another library.
#pragma once

#include "genu/api/meshes.h"
#include "genu/api/problem.h"
#include "genu/api/results.h"
#include "genu/api/scene.h"
#include "genu/api/table.h"
