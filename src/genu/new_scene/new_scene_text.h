// The texts that `genu new` starts from. Words between @ stand for what is filled in.
#pragma once

#include <map>
#include <string>

namespace genu {

std::string analytic_scene_text();
std::string motion_scene_text();
std::string stl_scene_text();
/// What @patella@ stands for there.
std::string patella_text();

/// `text` with each @word@ in the place of which `values` has something; every word must be there.
std::string filled_in(std::string text, const std::map<std::string, std::string>& values);

}  // namespace genu
