#include "genu/mesh_care/mesh_examination.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "genu/core/length_units.h"
#include "genu/core/units.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/solid_inertia.h"
#include "genu/mesh/vertex_fans.h"
#include "genu/mesh_care/mesh_crossings.h"
#include "genu/mesh_care/mesh_shape.h"
#include "genu/mesh_care/tolerances.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

using Verdict = MeshFinding::Verdict;

/// Sizes (m) in mm, with so many decimals; where that leaves less than two digits of the least, three digits of each.
std::string lengths(std::initializer_list<double> sizes, int decimals) {
  const bool small = std::min(sizes) * to::kMillimetre < std::pow(10.0, 1 - decimals);
  std::string out;
  for (const double m : sizes)
    out += (out.empty() ? "" : " / ") +
           (small ? fmt::format("{:.3g}", to::kMillimetre * m) : fmt::format("{:.{}f}", to::kMillimetre * m, decimals));
  return out + " mm";
}

class Examiner {
 public:
  Examiner(const Mesh& mesh, const MeshFileFacts& facts, double metres_per_unit)
      : mesh_(mesh), facts_(facts), unit_(metres_per_unit), report_(check_mesh(mesh)), wound_(mesh) {
    make_winding_consistent(wound_, mesh_edges(wound_));
    clean_ = wound_;
    out_.flaws = cut_out_flaws(clean_);
  }

  MeshExamination take() {
    for (const std::string& note : facts_.notes) say("format", "read all the same", Verdict::note, note);
    say_size();
    say_pieces();
    say_triangles();
    say_edges();
    say_orientation();
    say_crossings();
    say_shape();
    say_volume();
    return std::move(out_);
  }

 private:
  void say(const std::string& question, const std::string& number, Verdict verdict, const std::string& why = {}) {
    out_.findings.push_back({question, number, verdict, why});
  }

  /// A count that should be 0; `places` adds where the first ones are.
  void count(const std::string& question, std::size_t n, Verdict otherwise, const std::string& why) {
    say(question, std::to_string(n), n == 0 ? Verdict::good : otherwise, n == 0 ? "" : why);
  }

  std::string where(Flaw::Kind kind) const {
    constexpr int kFlawsListed = 3;
    std::string text;
    int told = 0, all = 0;
    for (const Flaw& flaw : out_.flaws) {
      if (flaw.kind != kind || ++all > kFlawsListed) continue;
      text += (told++ > 0 ? "; " : "") + describe(flaw, unit_);
    }
    return all > told ? text + fmt::format("; and {} more", all - told) : text;
  }

  std::size_t places(Flaw::Kind kind) const {
    return static_cast<std::size_t>(
        std::count_if(out_.flaws.begin(), out_.flaws.end(), [&](const Flaw& f) { return f.kind == kind; }));
  }

  void say_size() {
    const double diagonal = report_.box.diagonal() / unit_;
    const char* unit = length_unit_name(unit_);
    const std::string guess = guess_unit(diagonal);
    say("size", fmt::format("{:.4g} {} across", diagonal, unit), guess == unit ? Verdict::good : Verdict::bad,
        guess == unit   ? ""
        : guess.empty() ? "no unit makes this a knee's surface: 5 to 500 mm"
                        : "a knee's in " + guess + ": say --units " + guess + ", and units in the scene");
    say("vertices, triangles", fmt::format("{}, {}", report_.vertices, report_.triangles),
        report_.triangles < kMinTrianglesOfMesh   ? Verdict::bad
        : report_.triangles < kFewTrianglesOfMesh ? Verdict::note
                                                  : Verdict::good,
        report_.triangles < kMinTrianglesOfMesh   ? "too few to be a surface"
        : report_.triangles < kFewTrianglesOfMesh ? "few: a joint's surface has hundreds"
                                                  : "");
    say("edges 5/50/95 %", lengths({report_.edge_length[1], report_.edge_length[2], report_.edge_length[3]}, 3),
        Verdict::good);
    say_rounding();
  }

  void say_rounding() {
    const double step = facts_.rounding;
    const bool coarse = step > kCoarseCoordinateStep, far = coarse && facts_.single;
    say("coordinates rounded to", step > 0 ? fmt::format("{:.2g} mm", to::kMillimetre * step) : "double precision",
        far      ? Verdict::bad
        : coarse ? Verdict::note
                 : Verdict::good,
        far      ? "single precision, far from the origin: export it again about an origin near the joint"
        : coarse ? fmt::format("noise of {:.2g} mm rms: export it again with more digits",
                               to::kMillimetre * step / std::sqrt(12.0))
                 : "");
  }

  void say_pieces() {
    const std::size_t strays = places(Flaw::Kind::stray_piece), inner = places(Flaw::Kind::inner_piece);
    say("components", std::to_string(report_.components), Verdict::good);
    count("stray pieces", strays, Verdict::bad, where(Flaw::Kind::stray_piece));
    count("pieces inside others", inner, Verdict::note, where(Flaw::Kind::inner_piece) + "; contact leaves them out");
    for (const FreeLoop& loop : free_loops(mesh_)) borders_ += loop.border ? 1 : 0;
    say("borders of open sheets", std::to_string(borders_), borders_ == 0 ? Verdict::good : Verdict::note,
        borders_ == 0 ? "" : "contact cannot run over them");
    count("holes", places(Flaw::Kind::hole), Verdict::bad, where(Flaw::Kind::hole));
  }

  void say_triangles() {
    const std::size_t left = facts_.vertices - facts_.weld.joined - facts_.weld.joined_near;
    const bool soup = facts_.vertices == 3 * facts_.triangles;
    say("duplicate vertices", fmt::format("{}, {} nearly", facts_.weld.joined, facts_.weld.joined_near),
        (facts_.weld.joined == 0 || soup) && facts_.weld.joined_near == 0 ? Verdict::good : Verdict::note,
        facts_.weld.joined + facts_.weld.joined_near == 0 ? ""
        : soup && facts_.weld.joined_near == 0            ? "as every STL has"
                                                          : fmt::format("joined to {}", left));
    const bool mostly = facts_.weld.duplicate > report_.triangles;
    count("duplicate faces", facts_.weld.duplicate, mostly ? Verdict::bad : Verdict::note,
          mostly ? "dropped: more than are left; export the mesh again"
          : facts_.weld.both_ways > 0
              ? fmt::format("dropped; {} were the other side of one that is left", facts_.weld.both_ways)
              : "dropped");
    count("degenerate faces", facts_.weld.degenerate + report_.degenerate, Verdict::note, "without area: not used");
    count("sliver faces", report_.slivers, Verdict::note, "an angle below 5 deg: fits use the vertices alone");
  }

  void say_edges() {
    count("non-manifold edges", report_.non_manifold_edges, Verdict::bad, where(Flaw::Kind::non_manifold));
    Mesh split = mesh_;
    count("non-manifold vertices", split_fans(split), Verdict::note, "sheets that touch in one vertex");
    count("flipped faces", report_.flipped, Verdict::note, "wound against most of their piece; turned when read");
    count("spikes", places(Flaw::Kind::spike), Verdict::bad, where(Flaw::Kind::spike));
    const std::size_t unorientable = places(Flaw::Kind::unorientable);
    count("no winding agrees", unorientable, Verdict::bad, where(Flaw::Kind::unorientable));
  }

  void say_orientation() {
    const Orientation o = orientation_of(wound_);
    if (o.closed_pieces > 0)
      count("inside-out pieces", static_cast<std::size_t>(o.inside_out), Verdict::bad,
            "normals point into the volume they close: inside = true in the scene turns the surface round");
    if (o.open_area <= 0) return;
    say("open sheets face", fmt::format("({:.2f}, {:.2f}, {:.2f})", o.facing.x(), o.facing.y(), o.facing.z()),
        Verdict::note,
        fmt::format("mean outward normal; a sheet does not tell its outward side: it must face the other bone "
                    "(inside = true turns it)"));
  }

  void say_crossings() {
    const std::size_t pairs = crossing_triangles(wound_).size();
    count("self-intersections", pairs, Verdict::bad, where(Flaw::Kind::crossing));
  }

  void say_shape() {
    if (clean_.empty()) return say("smooth surface", "none", Verdict::bad, "nothing is left without the flaws");
    const MeshShape s = shape_of(clean_);
    const double edge = report_.edge_length[2];
    if (s.steps) {
      const Vec3& d = s.steps->direction;
      say("steps",
          fmt::format("{} of {:.3g} mm along ({:.2g}, {:.2g}, {:.2g})", s.steps->levels,
                      to::kMillimetre * s.steps->height, d.x(), d.y(), d.z()),
          Verdict::bad,
          fmt::format("a segmentation that was not smoothed: smooth it there, or --repair OUT --smooth {:.2g}",
                      to::kMillimetre * s.steps->height));
    } else {
      say("steps", "0", Verdict::good);
    }
    say("noise", fmt::format("{:.2g} mm rms", to::kMillimetre * s.noise),
        s.noise > 0.1 * edge ? Verdict::note : Verdict::good, "fit radius " + lengths({s.fit_radius}, 2));
    if (s.fits > 0) {
      const double tightest = 1 / std::max(s.sharpest, 1e-300);
      say("curvature 1/50/99 %",
          fmt::format("{:.3g} / {:.3g} / {:.3g} 1/m", s.curvature[0], s.curvature[1], s.curvature[2]),
          tightest < 2 * edge ? Verdict::note : Verdict::good,
          tightest < 2 * edge
              ? fmt::format("the sharpest twentieth bends within {:.2g} mm, less than two edges: too coarse there",
                            to::kMillimetre * tightest)
              : fmt::format("positive bulges outward; sharpest twentieth: radius {:.2g} mm",
                            to::kMillimetre * tightest));
    }
    if (s.thickness_rays > 0 && borders_ > 0)  // the air in a bowl, the hollow of a shaft: no thickness of anything
      say("across, 5/50/95 %", lengths({s.thickness[0], s.thickness[1], s.thickness[2]}, 2), Verdict::good,
          "from face to face of an open surface: not the thickness of a solid");
    else if (s.thickness_rays > 0)
      say("thickness 5/50/95 %", lengths({s.thickness[0], s.thickness[1], s.thickness[2]}, 2),
          s.thickness[0] < edge ? Verdict::note : Verdict::good,
          s.thickness[0] < edge ? "thinner than an edge in places: the two faces are kept apart by their normals" : "");
    else
      say("thickness", "-", Verdict::good, "nothing behind the surface");
  }

  /// Of what a scene can take as `solid`.
  void say_volume() {
    if (report_.boundary_loops > 0 || report_.non_manifold_edges > 0 || !report_.orientable) return;
    Mesh outward = wound_;
    const OutwardReport report = turn_outward(outward);
    if (report.cavities > 0)
      say("nested pieces", std::to_string(report.cavities), Verdict::note,
          "closed, inside another one, and facing outward as that does: the volume takes them for cavities");
    const SolidInertia solid = solid_inertia(outward);
    const Vec3 c = solid.centroid / unit_;
    say("volume", fmt::format("{:.5g} cm3", 1e6 * std::abs(solid.volume)), Verdict::good,
        fmt::format("closed; centroid ({:.5g}, {:.5g}, {:.5g}) {}", c.x(), c.y(), c.z(), length_unit_name(unit_)));
  }

  const Mesh& mesh_;
  const MeshFileFacts& facts_;
  double unit_;
  std::size_t borders_ = 0;  ///< of open sheets
  MeshReport report_;
  Mesh wound_, clean_;
  MeshExamination out_;
};

}  // namespace

const char* to_string(MeshFinding::Verdict verdict) {
  return verdict == Verdict::good ? "ok" : verdict == Verdict::note ? "note" : "BAD";
}

bool MeshExamination::bad() const {
  return std::any_of(findings.begin(), findings.end(), [](const MeshFinding& f) { return f.verdict == Verdict::bad; });
}

MeshExamination examine_mesh(const Mesh& mesh, const MeshFileFacts& facts, double metres_per_unit) {
  return Examiner(mesh, facts, metres_per_unit).take();
}

}  // namespace genu
