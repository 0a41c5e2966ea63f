#include "genu/new_scene/knee_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "genu/new_scene/bone_view.h"
#include "genu/new_scene/tolerances.h"
#include "genu/results/indexed_png.h"
#include "genu/results/packed_numbers.h"
#include "genu/results/svg_text.h"

namespace genu {
namespace {

constexpr double kScale = 3000;                                            // units of the picture for a metre
constexpr double kNamesBeside = 108, kHeading = 26, kGap = 10, kTop = 30;  // units: room for names beside a view, ...
constexpr double kLine = 15;                                               // units from line to line
constexpr int kShades = 60;

/// Dark and light end of the colours of a mesh: femur, its cartilage, tibia, its cartilage.
using Colour = std::array<double, 3>;
constexpr std::array<std::array<Colour, 2>, 4> kRamps = {{{{{70, 60, 48}, {250, 242, 224}}},
                                                          {{{48, 66, 74}, {214, 238, 242}}},
                                                          {{{58, 60, 66}, {232, 234, 240}}},
                                                          {{{48, 66, 74}, {204, 228, 240}}}}};
constexpr std::array<const char*, 12> kColours = {"#c8102e", "#f0563a", "#1f4fbf", "#3c9be8", "#1b7f3b", "#7ab51d",
                                                  "#00877a", "#d97a00", "#8e3bb0", "#8c5a2b", "#d6408f", "#555555"};

struct Panel {
  std::string name;
  ViewAxes axes;
  bool femur = true, tibia = true;  ///< what is shown
  const char *left, *right;         ///< sides of the body
};

std::vector<Panel> panels_of(const KneePicture& k) {
  // Of a left knee lateral is the other way: its pictures are mirror images, as the knee is.
  const Vec3 right_hand = k.anterior.cross(k.proximal);
  const bool left = right_hand.dot(k.lateral) < 0;
  const auto looking = [](const Vec3& toward, const Vec3& up) { return ViewAxes{up.cross(toward), up, toward}; };
  const char *medial = "medial", *lateral = "lateral";
  const auto across = [&](bool lateral_is_right) {
    return lateral_is_right ? std::pair(medial, lateral) : std::pair(lateral, medial);
  };
  const auto front = across(left), back = across(!left);
  return {{"anterior", looking(k.anterior, k.proximal), true, true, front.first, front.second},
          {"posterior", looking(-k.anterior, k.proximal), true, true, back.first, back.second},
          {"femur from below", looking(-k.proximal, k.anterior), true, false, front.first, front.second},
          {"medial", looking(-k.lateral, k.proximal), true, true, left ? "posterior" : "anterior",
           left ? "anterior" : "posterior"},
          {"lateral", looking(k.lateral, k.proximal), true, true, left ? "anterior" : "posterior",
           left ? "posterior" : "anterior"},
          {"tibia from above", looking(k.proximal, k.anterior), false, true, back.first, back.second}};
}

/// Ends of a group on one bone that lie together, and their middle.
struct EndCluster {
  std::string group;
  bool femur = true;
  std::vector<PictureEnd> ends;
  Vec3 middle = Vec3::Zero();
  double error = 0;
  bool given = false;
};

std::vector<EndCluster> clusters_of(const KneePicture& knee) {
  std::vector<EndCluster> out;
  for (const PictureFibre& fibre : knee.fibres)
    for (const bool femur : {true, false}) {
      const PictureEnd& end = femur ? fibre.femur : fibre.tibia;
      const auto near = std::find_if(out.begin(), out.end(), [&](const EndCluster& c) {
        return c.group == fibre.group && c.femur == femur &&
               std::any_of(c.ends.begin(), c.ends.end(),
                           [&](const PictureEnd& e) { return (e.at - end.at).norm() < kEndsTogether; });
      });
      if (near == out.end())
        out.push_back({fibre.group, femur, {end}, {}, 0, false});
      else
        near->ends.push_back(end);
    }
  for (EndCluster& c : out) {
    const auto count = static_cast<double>(c.ends.size());
    for (const PictureEnd& e : c.ends) {
      c.middle += e.at / count;
      c.error += e.error / count;
      c.given = c.given || e.given;
    }
  }
  return out;
}

/// All that is drawn of one view.
class PanelDrawing {
 public:
  PanelDrawing(const KneePicture& knee, const Panel& panel, const std::map<std::string, std::string>& colours)
      : knee_(knee), panel_(panel), colours_(colours) {
    frame();
    for (const bool femur : {true, false})
      if (femur ? panel.femur : panel.tibia)
        for (const Mesh* mesh : femur ? knee.femur : knee.tibia) {
          ramps_.push_back((femur ? 0 : 2) + (mesh == (femur ? knee.femur : knee.tibia).front() ? 0 : 1));
          meshes_.push_back(mesh);
        }
    view_ = view_of(meshes_, panel.axes, low_, high_, 1 / (2 * kScale));
  }

  double width() const { return kScale * (high_.x() - low_.x()); }
  double height() const { return kScale * (high_.y() - low_.y()); }

  /// With its left upper corner at (x, y), in a cell of that width.
  std::string at(double x, double y, double cell) {
    x_ = x + (cell - width()) / 2;
    y_ = y + kHeading;
    std::string out = svg_text(x + cell / 2, y + 15, panel_.name, "class=\"h\"") + image();
    out += svg_text(x_, y_ + height() + 13, panel_.left, "class=\"s\"") +
           svg_text(x_ + width(), y_ + height() + 13, panel_.right, "class=\"s e\"");
    if (panel_.femur && panel_.tibia) out += lines();
    out += ends();
    out += places();
    return out + names();  // of what was drawn
  }

 private:
  struct Name {
    Vec2 at;  ///< units
    std::string words, colour;
  };

  void frame() {
    std::vector<Vec3> points;
    for (const PictureFibre& f : knee_.fibres) {
      if (panel_.femur) points.push_back(f.femur.at);
      if (panel_.tibia) points.push_back(f.tibia.at);
    }
    const double w = knee_.width;
    for (const double s : {-0.58, 0.58}) {
      points.push_back(knee_.centre + s * w * knee_.lateral);
      points.push_back(knee_.centre + 0.85 * s * w * knee_.anterior);
      points.push_back(knee_.centre + 0.9 * s * w * knee_.proximal);
    }
    low_ = high_ = panel_.axes.flat(points.front());
    for (const Vec3& p : points) {
      low_ = low_.cwiseMin(panel_.axes.flat(p));
      high_ = high_.cwiseMax(panel_.axes.flat(p));
    }
    low_.array() -= kPictureRim;
    high_.array() += kPictureRim;
  }

  Vec2 place(const Vec3& p) const {
    const Vec2 flat = panel_.axes.flat(p);
    return {x_ + kScale * (flat.x() - low_.x()), y_ + kScale * (high_.y() - flat.y())};
  }
  bool seen(const Vec3& p) const { return view_.shows(panel_.axes, p, kSeenBehind); }

  std::string image() const {
    IndexedPicture picture{view_.width, view_.height, {}, {{255, 255, 255}}};
    for (const int ramp : ramps_)
      for (int s = 0; s < kShades; ++s) {
        std::array<std::uint8_t, 3> colour{};
        const auto& [dark, light] = kRamps[genu::at(ramp)];
        for (std::size_t k = 0; k < 3; ++k)
          colour[k] = static_cast<std::uint8_t>(std::lround(dark[k] + (light[k] - dark[k]) * s / (kShades - 1)));
        picture.colours.push_back(colour);
      }
    for (std::size_t i = 0; i < view_.mesh.size(); ++i) {
      const int shade = static_cast<int>(std::lround((kShades - 1) * static_cast<double>(view_.light[i])));
      picture.pixels.push_back(view_.mesh[i] < 0 ? 0 : static_cast<std::uint8_t>(1 + view_.mesh[i] * kShades + shade));
    }
    return fmt::format(
        "<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" preserveAspectRatio=\"none\" "
        "href=\"data:image/png;base64,{}\"/>\n",
        x_, y_, view_.width / 2.0, view_.height / 2.0, packed_text(indexed_png(picture)));
  }

  /// Fibres, where they can be seen.
  std::string lines() const {
    std::string out;
    for (const PictureFibre& f : knee_.fibres) {
      std::string path;
      bool drawing = false;
      constexpr int kLineParts = 40;
      for (int i = 0; i <= kLineParts; ++i) {
        const Vec3 p = f.femur.at + (f.tibia.at - f.femur.at) * (static_cast<double>(i) / kLineParts);
        const bool visible = seen(p);
        if (visible) {
          const Vec2 q = place(p);
          path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", q.x(), q.y());
        }
        drawing = visible;
      }
      if (!path.empty()) out += fmt::format("<path class=\"f\" stroke=\"{}\" d=\"{}\"/>\n", colours_.at(f.group), path);
    }
    return out;
  }

  /// Dots of what is seen, pale rings of what is behind, and a circle of one error round what is seen.
  std::string ends() {
    std::string out;
    for (const EndCluster& c : clusters_of(knee_)) {
      if (!(c.femur ? panel_.femur : panel_.tibia)) continue;
      const std::string& colour = colours_.at(c.group);
      std::size_t visible = 0;
      for (const PictureEnd& e : c.ends) {
        const Vec2 q = place(e.at);
        const bool is_seen = seen(e.at);
        if (is_seen) ++visible;
        out += fmt::format("<circle class=\"{}\" {}=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>\n",
                           is_seen ? "d" : "b", is_seen ? "fill" : "stroke", colour, q.x(), q.y(), is_seen ? 2.2 : 1.8);
      }
      if (2 * visible <= c.ends.size()) continue;
      const Vec2 middle = place(c.middle);
      const std::string words = c.error > 0 ? fmt::format("{} \xc2\xb1{:.1f}", c.group, 1e3 * c.error) : c.group;
      names_.push_back({middle, words, colour});
      if (c.error > 0)
        out += fmt::format("<circle class=\"{}\" stroke=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n",
                           c.given ? "c g" : "c", colour, middle.x(), middle.y(), kScale * c.error);
    }
    return out;
  }

  std::string places() {
    std::string out;
    if (!panel_.femur) return out;  // all that are known are on the femur or above it, or between
    for (const auto& [name, p] : knee_.places) {
      const Vec2 flat = panel_.axes.flat(p);
      if ((flat.array() < low_.array()).any() || (flat.array() > high_.array()).any() || !seen(p)) continue;
      const Vec2 q = place(p);
      out += fmt::format("<path class=\"x\" d=\"M{0:.1f} {1:.1f}h8m-4 -4v8\"/>\n", q.x() - 4, q.y());
      names_.push_back({q, name, "#111"});
    }
    return out;
  }

  /// Names beside the view, in the order of what they name, so that no two lines cross.
  std::string names() {
    std::string out;
    for (const bool left : {true, false}) {
      std::vector<Name> side;
      for (const Name& n : names_)
        if ((n.at.x() < x_ + width() / 2) == left) side.push_back(n);
      std::stable_sort(side.begin(), side.end(), [](const Name& a, const Name& b) { return a.at.y() < b.at.y(); });
      std::vector<double> rows;
      for (const Name& n : side) rows.push_back(std::max(n.at.y(), rows.empty() ? y_ + 8 : rows.back() + kLine));
      for (std::size_t i = rows.size(); i-- > 0;)
        rows[i] = std::min(rows[i], i + 1 < rows.size() ? rows[i + 1] - kLine : y_ + height() - 4);
      for (std::size_t i = 0; i < side.size(); ++i) {
        const double edge = left ? x_ - 4 : x_ + width() + 4, x = left ? edge - 4 : edge + 4;
        out += fmt::format("<path class=\"l\" stroke=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", side[i].colour,
                           edge, rows[i] - 4, side[i].at.x(), side[i].at.y());
        out += svg_text(x, rows[i], side[i].words,
                        fmt::format("fill=\"{}\"{}", side[i].colour, left ? " class=\"e\"" : ""));
      }
    }
    return out;
  }

  const KneePicture& knee_;
  const Panel& panel_;
  const std::map<std::string, std::string>& colours_;
  Vec2 low_, high_;  // m
  std::vector<const Mesh*> meshes_;
  std::vector<int> ramps_;  // of each mesh
  BoneView view_;
  double x_ = 0, y_ = 0;  // units
  std::vector<Name> names_;
};

std::map<std::string, std::string> colours_of(const KneePicture& knee) {
  std::map<std::string, std::string> out;
  for (const PictureFibre& f : knee.fibres) out.emplace(f.group, kColours[out.size() % kColours.size()]);
  return out;
}

constexpr const char* kPictureStyle =
    "text.h{font-size:14px;font-weight:600;text-anchor:middle}text.t{font-size:17px;font-weight:600}"
    "text.s{fill:#777}text.e{text-anchor:end}"
    ".f{fill:none;stroke-width:1.1;stroke-opacity:.55}.d{stroke:#fff;stroke-width:.5}"
    ".b{fill:none;stroke-width:.8;stroke-opacity:.5}.c{fill:none;stroke-width:1.3}.g{stroke-width:2.6}"
    ".l{fill:none;stroke-width:.6;stroke-opacity:.8}.x{fill:none;stroke:#111;stroke-width:1.6}"
    ".r{fill:none;stroke:#333;stroke-width:2}";

}  // namespace

std::string knee_picture(const KneePicture& knee) {
  const std::vector<Panel> panels = panels_of(knee);
  const std::map<std::string, std::string> colours = colours_of(knee);
  std::vector<PanelDrawing> drawings;
  double cell = 0;
  std::array<double, 2> rows{};
  for (std::size_t i = 0; i < panels.size(); ++i) {
    drawings.emplace_back(knee, panels[i], colours);
    cell = std::max(cell, drawings.back().width() + 2 * kNamesBeside);
    rows[i / 3] = std::max(rows[i / 3], drawings.back().height() + kHeading + 2 * kLine);
  }
  const double top = kTop + kLine * static_cast<double>(knee.notes.size() + 1);
  const double width = 3 * cell + 4 * kGap, height = top + rows[0] + rows[1] + 3 * kGap + 2 * kLine;
  std::string out = svg_opening(width, height, std::string(kSvgLetters) + kPictureStyle) + kKneePictureMark + "\n";
  out += svg_text(2 * kGap, kTop - 8, knee.title, "class=\"t\"");
  for (std::size_t i = 0; i < knee.notes.size(); ++i)
    out += svg_text(2 * kGap, kTop + kLine * static_cast<double>(i) + 9, knee.notes[i]);
  for (std::size_t i = 0; i < panels.size(); ++i)
    out += drawings[i].at(kGap + static_cast<double>(i % 3) * (cell + kGap), top + (i < 3 ? 0 : rows[0] + kGap), cell);
  const double foot = height - kLine;
  out += fmt::format("<path class=\"r\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", 2 * kGap, foot - 4, 0.02 * kScale);
  out += svg_text(
      2 * kGap + 0.02 * kScale + 8, foot,
      "20 mm.  Dots: ends of fibres; rings: those behind a bone.  Circles: one standard deviation (mm behind the "
      "name), thick where a landmark says where.  Crosses: other landmarks.");
  return out + "</svg>\n";
}

}  // namespace genu
