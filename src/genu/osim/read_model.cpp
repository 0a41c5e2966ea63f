#include "genu/osim/read_model.h"

#include <charconv>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "genu/core/file_text.h"
#include "genu/osim/frames.h"
#include "genu/osim/read_parts.h"
#include "genu/osim/references.h"
#include "genu/osim/tolerances.h"

namespace genu::osim {
namespace {

/// Calls f(element) for each member of a set of the model.
template <typename F>
void for_each_member(const XmlElement& model, const char* set, const F& f) {
  if (const XmlElement* objects = model.objects_of(set))
    for (const XmlElement& e : objects->children) f(e);
}

Mat3 inertia_of(const PropertyReader& body) {
  const std::vector<double> v = body.numbers("inertia");
  Mat3 inertia = Mat3::Zero();
  if (v.size() == 6) inertia << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  if (!v.empty() && v.size() != 6)
    body.refuse(Code::wrong_form, body.where("inertia"), "inertia", {}, "must be six numbers: xx yy zz xy xz yz");
  return inertia;
}

/// What the body, ground or offset frame at `path` carries: frames and wrap objects.
void read_carried(const FileReader& reader, const XmlElement& e, const std::string& path, Model& model) {
  read_offset_frames(reader, e, "components", path, model);
  if (const XmlElement* wraps = e.objects_of("WrapObjectSet"))
    for (const XmlElement& wrap : wraps->children) read_wrap_object(reader, wrap, path, model);
}

void read_body(const FileReader& reader, const XmlElement& e, Model& model) {
  if (e.tag != "Body") return;
  const PropertyReader p(reader, e);
  Body b{e.name(), p.number("mass", 0), p.vector("mass_center", Vec3::Zero()), inertia_of(p), e.where};
  if (b.name.empty()) p.refuse(Code::missing_key, e.where, "name", {}, "is missing");
  if (b.mass < 0) p.refuse(Code::out_of_range, p.where("mass"), "mass", fmt::format("{}", b.mass), "must be >= 0 kg");
  read_carried(reader, e, "/bodyset/" + b.name, model);
  model.bodies.push_back(std::move(b));
}

/// Two bodies, joints or coordinates of one name cannot be told apart.
class UniqueNames {
 public:
  UniqueNames(const FileReader& reader, const char* kind) : reader_(reader), kind_(kind) {}
  void add(const std::string& name, const SourceLocation& where) {
    if (!names_.insert(name).second)
      reader_.out.add(error_at({reader_.file, where}, Code::duplicate, {}, name,
                               fmt::format("is the name of another {} too", kind_)));
  }

 private:
  const FileReader& reader_;
  const char* kind_;
  std::set<std::string> names_;
};

void refuse_repeated_names(const FileReader& reader, const Model& model) {
  UniqueNames bodies(reader, "body"), joints(reader, "joint"), coordinates(reader, "coordinate"),
      frames(reader, "frame"), meshes(reader, "contact mesh");
  for (const ContactMesh& m : model.contact_meshes) meshes.add(m.name, m.where);
  for (const OffsetFrame& f : model.frames) frames.add(f.path, f.where);
  for (const Body& b : model.bodies) bodies.add(b.name, b.where);
  for (const Joint& j : model.joints) {
    joints.add(j.name, j.where);
    for (const Coordinate& c : j.coordinates) coordinates.add(c.name, c.where);
  }
}

/// The version of the format: 40000 is OpenSim 4.0. An error where genu does not read it.
bool check_version(const XmlElement& root, const std::string& file, Diagnostics& out) {
  const std::string text = root.attribute("Version");
  int version = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), version);
  const auto refuse = [&](Code code, const std::string& rule) {
    out.add(error_at({file, root.where}, code, "OpenSimDocument.Version", text, rule));
    return false;
  };
  if (text.empty() || fault != std::errc() || end != text.data() + text.size())
    return refuse(Code::wrong_form, "must be the version of the format, such as 40000");
  if (version < 40000)
    return refuse(Code::not_built,
                  "is the format of OpenSim 3 or older, whose joints and frames have other elements; OpenSim 4 "
                  "converts it: `opensim-cmd update-file OLD.osim NEW.osim`, or open it and save it again");
  if (version >= 50000) return refuse(Code::not_built, "is newer than OpenSim 4, which genu reads");
  return true;
}

void read_sets(const FileReader& reader, const XmlElement& e, Model& model) {
  model.gravity = PropertyReader(reader, e).vector("gravity", Vec3(0, -9.80665, 0));
  if (const XmlElement* ground = e.child("Ground")) read_carried(reader, *ground, "/ground", model);
  read_offset_frames(reader, e, "components", {}, model);
  for_each_member(e, "BodySet", [&](const XmlElement& body) { read_body(reader, body, model); });
  for_each_member(e, "JointSet", [&](const XmlElement& joint) { read_joint(reader, joint, model); });
  for_each_member(e, "ConstraintSet", [&](const XmlElement& one) { read_coupler(reader, one, model); });
  for_each_member(e, "ForceSet", [&](const XmlElement& force) { read_force(reader, force, model); });
  for_each_member(e, "ContactGeometrySet", [&](const XmlElement& one) { read_contact_geometry(reader, one, model); });
}

}  // namespace

const Coordinate* Joint::coordinate(const std::string& wanted) const {
  for (const Coordinate& c : coordinates)
    if (c.name == wanted) return &c;
  return nullptr;
}

std::string last_name(const std::string& socket) { return socket.substr(socket.rfind('/') + 1); }

void read_offset_frames(const FileReader& reader, const XmlElement& e, const char* tag, const std::string& owner,
                        Model& model) {
  const XmlElement* list = e.child(tag);
  if (list == nullptr) return;
  for (const XmlElement& frame : list->children) {
    if (frame.tag != "PhysicalOffsetFrame") continue;
    const PropertyReader p(reader, frame);
    const std::string path = owner + "/" + frame.name();
    model.frames.push_back({frame.name(), path, frame_path(model, p.socket("parent"), path),
                            p.placement("orientation", "translation"), frame.where});
    read_carried(reader, frame, path, model);
  }
}

std::optional<Model> parse_model(const std::string& text, const std::string& path, Diagnostics& out) {
  const std::size_t before = out.count(Diagnostic::Severity::error);
  const auto root = parse_xml(text, path, out);
  if (!root) return std::nullopt;
  if (root->tag != "OpenSimDocument") {
    out.add(error_at({path, root->where}, Code::broken_file, root->tag, {},
                     "is no model of OpenSim: its root element is not OpenSimDocument"));
    return std::nullopt;
  }
  if (!check_version(*root, path, out)) return std::nullopt;
  const XmlElement* element = root->child("Model");
  if (element == nullptr) {
    out.add(error_at({path, root->where}, Code::missing_key, "Model", {},
                     "is missing: the file holds something else of OpenSim"));
    return std::nullopt;
  }
  Model model;
  model.file = path;
  model.name = element->name();
  const FileReader reader{path, element->child("defaults"), out};
  read_sets(reader, *element, model);
  refuse_repeated_names(reader, model);
  check_references(model, out);
  model.items = items_of(*element);
  if (out.count(Diagnostic::Severity::error) > before) return std::nullopt;
  return model;
}

std::optional<Model> read_model(const std::string& path, Diagnostics& out) {
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  if (!unknown && size > kMaxFileSize) {
    out.error(Code::too_large, path,
              fmt::format("has {} MB; a model may have {}", size / 1'000'000, kMaxFileSize / 1'000'000));
    return std::nullopt;
  }
  const auto text = text_of_file(path, out);
  return text ? parse_model(*text, path, out) : std::nullopt;
}

}  // namespace genu::osim
