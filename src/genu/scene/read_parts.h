// The parts of a scene, in the order in which they are read: each may refer to those before it.
#pragma once

#include "genu/scene/read_numbers.h"

namespace genu {

void read_header(ReadContext& context, Section& root);  ///< format, title, units
void read_bodies(ReadContext& context, Section& root);  ///< and gravity, which gives them weight
void read_joints(ReadContext& context, Section& root);
void read_combinations(ReadContext& context, Section& root);
void read_moment_arms(ReadContext& context, Section& root);
void read_surfaces(ReadContext& context, Section& root);
void read_contacts(ReadContext& context, Section& root);
void read_compartments(ReadContext& context, Section& root);  ///< after the contacts
void read_ligaments(ReadContext& context, Section& root);
void read_bundles(ReadContext& context, Section& root);  ///< after the ligaments
void read_bushings(ReadContext& context, Section& root);
void read_loads(ReadContext& context, Section& root);
void read_steps(ReadContext& context, Section& root);
/// `drive` of a step whose `prescribe` and `load` are known: one load, a list, or a table of either by coordinate.
void read_drive(ReadContext& context, const Item& item, StepDef& step);
void read_solver(ReadContext& context, Section& root);
void read_plausible(ReadContext& context, Section& root);
void read_dynamics(ReadContext& context, Section& root);  ///< and what motion over time asks of all that was read

/// `enabled` of a table GROUP.NAME. Where it is false the table is noted in Scene::disabled, and must be left out of
/// the scene after it has been read (a body: by the reader, with all that is on it).
bool read_enabled(ReadContext& context, Section& section, const char* group);

/// Whether the scene has a table GROUP.NAME with `enabled = false`.
bool is_disabled(const Scene& scene, const std::string& group, const std::string& name);

/// [solid.NAME] of a file for `genu mesh`; no scene has them.
void read_solid_shapes(ReadContext& context, Section& root);

/// What no single part can see: the tree of bodies, ligaments at the reference pose, names of result columns.
void check_scene(ReadContext& context);

/// `solid` of a body, in the place of the next three keys. False where there is none.
bool read_solid(ReadContext& context, Section& section, BodyDef& body);

/// The numbers of a body's table; a fixed body may have none.
void read_mass(ReadContext& context, Section& section, const NumbersOf& how, BodyDef& body);

/// The numbers of a body and `inertia`, in a scene with dynamics.
void read_inertia(ReadContext& context, Section& section, BodyDef& body);

/// `x_axis`, `z_axis` of a surface. Without x_axis, x is the body's x made orthogonal to z_axis; where z_axis lies
/// along the body's x, the axes are the body's in cyclic order (x = the body's y).
Mat3 read_axes(ReadContext& context, Section& section);

/// The same with `origin` before them.
Pose read_placement(ReadContext& context, Section& section);

/// The path of `what`, "a ligament" or "a cable": its points from end to end, and the surfaces between them.
struct ReadPath {
  std::vector<PathEnd> points;
  std::vector<WrapDef> wraps;
};
ReadPath read_path(ReadContext& context, Section& section, const std::string& what);

/// The file of a mesh, or a list of the files of its pieces. They must exist, and are as they are to be opened.
PieceFiles read_mesh_files(ReadContext& context, const Item& item);

/// `thickness` of a surface.
std::optional<SurfaceDef::Thickness> read_surface_thickness(ReadContext& context, const Item& item);

/// `thickness` and `search_depth` of a layer whose surfaces are known; the thickness may be that of the surfaces.
void read_layer_thickness(ReadContext& context, Section& section, LayerDef& layer);

/// A surface's thickness says something only where a layer uses it.
void check_thickness_used(ReadContext& context);

/// `patch` of a surface whose shape is known.
std::optional<SurfaceDef::Patch> read_patch(ReadContext& context, const Item& item, const SurfaceDef& surface);

/// "z < 0", "z >= 0 and x < 5" with lengths in the file's unit.
std::vector<RegionDef::Condition> read_region(ReadContext& context, const Item& item);

/// `scale` of a load.
std::optional<ScaleDef> read_scale(ReadContext& context, const Item& item);

/// What a coordinate follows over time: a table, sine or step, or a number that holds it. `rule`: of its values.
ScaleDef read_course(ReadContext& context, const Item& item, const NumberRule& rule);

/// The coordinate "JOINT.NAME"; where it does not exist, or a joint holds it, an error is reported at `where` with
/// `path` and `found`, unless the joint itself was not understood. `also_known` are other names that could stand there,
/// for the message.
std::optional<CoordinateRef> find_coordinate(ReadContext& context, SourceLocation where, const std::string& path,
                                             const std::string& name, const std::string& found = {},
                                             const std::vector<std::string>& also_known = {});

/// The same for what can be prescribed: a coordinate or a combination, which has no dot in its name.
std::optional<QuantityRef> find_quantity(ReadContext& context, SourceLocation where, const std::string& path,
                                         const std::string& name);

/// A value with the name of the coordinate that it belongs to.
struct NamedItem {
  std::string name;
  Item item;
};
/// The entries of a table whose keys are coordinates: "knee.flexion" = ... in quotes, or knee.flexion = ..., which TOML
/// reads as a table in a table.
std::vector<NamedItem> coordinate_items(const Item& table);
/// The same where the values may be tables themselves.
std::vector<NamedItem> course_items(const ReadContext& context, const Item& table);

/// Values that are prescribed together must be free of each other, or they contradict each other or say one thing
/// twice: errors at the entries that say too much.
void check_independent(ReadContext& context, const std::vector<NamedItem>& entries,
                       const std::vector<QuantityRef>& quantities);

/// What a revolute or fixed joint has beside its bodies; `joint.type` is known. True if its coordinates are.
bool read_held_joint(ReadContext& context, Section& section, JointDef& joint);

/// `grood_suntay` of a joint whose bodies are known.
void read_grood_suntay(ReadContext& context, const Item& item, JointDef& joint);

/// Warnings about numbers that are allowed, and probably meant in another unit: strains in percent, a stiffness a
/// hundred times that of the bundle's name, sizes of metres or microns.
void warn_unlikely(ReadContext& context, Section& section, const LigamentDef& ligament);
void warn_unlikely(ReadContext& context, Section& section, const SurfaceDef& surface);
void warn_unlikely(ReadContext& context, Section& section, const LayerDef& layer);

/// The frames of bushings that are given on one body alone: where they coincide at the reference. The tree must be
/// sound.
void place_bushings(Scene& scene);

/// Poses X_world_body of all bodies at the joints' reference. The tree must be sound.
std::vector<Pose> reference_poses(const SceneTables& scene);

}  // namespace genu
