#include "genu/new_scene/new_scene_text.h"

namespace genu {

std::string analytic_scene_text() {
  return R"(# @title@: a knee made of formulas. Written by `genu new`; every line is yours to change.
#   genu run @file@ --out out/@name@      solves it
#   genu explain contact                  says what can stand in [contact.NAME]; so for every other section
# Right knee; x lateral, y anterior, z proximal.
format = 1
title = "@title@"
units = { length = "mm", angle = "deg" }   # of every length and angle below; forces are N, moments N m

# --- Bodies: one is fixed, the others move ---
[body.tibia]
fixed = true

[body.femur]

# Six coordinates of the femur in the tibia, under the names you give them. It constrains nothing.
# The order of the rotations is physics: what is prescribed acts along its own axis.
[joint.knee]
type = "free"
parent = "tibia"
child = "femur"
rotations = ["flexion x", "adduction y", "rotation z"]
translations = ["x", "y", "z"]
reference = { z = 22 }    # the pose that `reference_strain` means, and where the search starts

# --- Surfaces: outward sides face each other. `genu explain surface` lists all shapes ---
[surface.femur_medial]
body = "femur"
shape = "ellipsoid"
origin = [-23, 0, 0]
radii = [16, 24, 22]

[surface.femur_lateral]
body = "femur"
shape = "ellipsoid"
origin = [23, 0, 0]
radii = [16, 25, 22]

[surface.tibia_medial]    # hollow: z = r^2 / 160, a radius of 80 mm
body = "tibia"
shape = "polynomial"
origin = [-23, 0, 0]
terms = [[2, 0, 0.00625], [0, 2, 0.00625]]
patch = { x = [-18, 18], y = [-25, 25] }

[surface.tibia_lateral]   # flat
body = "tibia"
shape = "plane"
origin = [23, 0, 0]
patch = { x = [-18, 18], y = [-25, 25] }

# --- Contacts: however many points of contact a pair needs are found ---
[contact.medial]
surfaces = ["femur_medial", "tibia_medial"]
model = "rigid"           # or "cartilage", an elastic layer: `genu explain cartilage`

[contact.lateral]
surfaces = ["femur_lateral", "tibia_lateral"]
model = "rigid"

# --- Ligaments: F = K e^2, K in N, strain e from the slack length; they pull only. Values of common size, not measured ---
[ligament.ACL]
from = { body = "femur", point = [8, -8, 2] }
to = { body = "tibia", point = [-3, 8, -2] }
law = "quadratic"
stiffness = 30000
reference_strain = 0.02

[ligament.PCL]
from = { body = "femur", point = [-6, 2, 0] }
to = { body = "tibia", point = [0, -22, -8] }
law = "quadratic"
stiffness = 30000
reference_strain = 0.02

[ligament.LCL]
from = { body = "femur", point = [38, 0, 4] }
to = { body = "tibia", point = [36, -10, -45] }
law = "quadratic"
stiffness = 20000
reference_strain = 0.03

[ligament.MCL_anterior]
from = { body = "femur", point = [-38, 3, 4] }
to = { body = "tibia", point = [-28, 8, -60] }
law = "quadratic"
stiffness = 25000
reference_strain = 0.02

[ligament.MCL_posterior]
from = { body = "femur", point = [-38, -2, 4] }
to = { body = "tibia", point = [-30, -10, -55] }
law = "quadratic"
stiffness = 25000
reference_strain = 0.03

# --- Loads: N in the world's axes, or the body's own with frame = "body" ---
[load.weight]
body = "femur"
force = [0, 0, -100]

# --- Steps: what is prescribed, from where to where, in how many increments. All else finds its balance ---
[[step]]
prescribe = { "knee.flexion" = [0, 60] }
increments = 30
)";
}

std::string motion_scene_text() {
  return R"(# @title@: a shank that is let go and swings (the pendulum test). Written by `genu new`; every line is yours to change.
#   genu run @file@ --out out/@name@      integrates the motion
#   genu explain dynamics                 says what can stand in [dynamics]; so for every other section
# Sitting; x anterior, y up, z to the right. The thigh is level and the shank hangs at angle 0.
format = 1
title = "@title@"
units = { length = "mm", angle = "deg" }   # of every length and angle below; masses are kg, times s
gravity = [0, -9.81, 0]                    # m/s^2

[body.thigh]
fixed = true

# Shank and foot of a person of common size. With inertia every moving body needs these three,
# or `solid = { file = "shank.stl", units = "mm", density = 1100 }` in their place.
[body.shank]
mass = 4.3
centre_of_mass = [0, -250, 0]
inertia = [0.12, 0.01, 0.12]               # kg m^2 about the centre of mass: [xx, yy, zz]

# A hinge. Its spring rests at angle 0; damper and stop are what tissue does.
[joint.knee]
type = "revolute"
parent = "thigh"
child = "shank"
axis = [0, 0, 1]                           # angle positive: the foot goes forward (extension)
stiffness = 0.02                           # N m per degree
damping = 0.004                            # N m s per degree
limits = { from = -60, to = 90, stiffness = 5 }
start = { angle = 80 }                     # where it is let go, at rest

# The quadriceps as a spring that is slack at first: F = k (L - L0), both ways, with a damper.
[ligament.quadriceps]
from = { body = "thigh", point = [-200, 40, 0] }
to = { body = "shank", point = [45, -40, 0] }
law = "linear"                             # F = K e, tension only
stiffness = 400                            # N at a strain of 1
reference_strain = 0                       # slack length: that of the pose at angle 0

[dynamics]
duration = 5                               # s
output_interval = 0.02                     # s between rows of results.csv
tolerance = 1e-8                           # relative, of the integration
)";
}

std::string stl_scene_text() {
  return R"(# @title@: a knee from two meshes. Written by `genu new`; every line is yours to change.
#   genu run @file@ --out out/@name@      solves it
#   genu mesh-check FILE                  says whether a mesh can be trusted; --repair OUT mends it
#   genu explain ligament                 says what can stand in [ligament.NAME]; so for every other section
#
# What the meshes say: lengths and axes are those of the files. Proximal is @proximal@@proximal_how@,
# anterior is @anterior@@anterior_how@. The tibia is @width@ mm wide and @depth@ mm deep at the joint.
# What they do not say, and was CHOSEN; look at each line marked so before you believe a result:
#   CHOSEN: a @side@ knee. (`genu new --side` decides; only names and signs depend on it.)
#   CHOSEN: the ligaments: where they are fixed, how stiff and how long they are.
#   CHOSEN: the cartilage, a layer of @layer@. @cartilage_note@
#   CHOSEN: the load and the motion.
format = 1
title = "@title@"
units = { length = "mm", angle = "deg" }   # of every length and angle below; forces are N, moments N m

# --- Bodies: the femur stands still. Both have the frame of the files, so points can be picked in the meshes ---
[body.femur]
fixed = true

[body.tibia]

# --- The tibia in the femur: all coordinates are 0 where the files have it. Nothing is constrained here ---
[joint.knee]
type = "free"
parent = "femur"
child = "tibia"
rotations = ["flexion @flexion_axis@", "adduction @adduction_axis@", "rotation @rotation_axis@"]   # in this order
translations = ["x", "y", "z"]
# @reference_note@: where the search starts, and the pose that `reference_strain` means.
reference = { @reference@ }
# The same pose as clinicians describe it (Grood and Suntay), columns knee.gs...; origins amid the plateau.
grood_suntay = { side = "@side@", femur = { body = "femur", proximal = @femur_proximal@, anterior = @femur_anterior@, origin = @femur_origin@ }, tibia = { body = "tibia", proximal = @tibia_proximal@, anterior = @tibia_anterior@, origin = @tibia_origin@ } }

# --- Surfaces: your meshes ---
[surface.femur]
body = "femur"
shape = "mesh"
file = @femur_file@
units = "@femur_unit@"@femur_unit_how@@femur_thickness@

[surface.tibia]
body = "tibia"
shape = "mesh"
file = @tibia_file@
units = "@tibia_unit@"@tibia_unit_how@@tibia_thickness@
@fibula@
# --- Contact: an elastic layer on each triangle of the tibia. For rigid contact on smooth surfaces write
# model = "rigid" and take out the keys from modulus to cast_from ---
[contact.tibiofemoral]
surfaces = ["femur", "tibia"]
model = "cartilage"
modulus = 10                   # CHOSEN: MPa
poisson = 0.45                 # CHOSEN
@thickness@quadrature = "triangles"
cast_from = "tibia"
regions = { medial = "@medial@", lateral = "@lateral@" }   # results of the two halves

# --- Ligaments: CHOSEN throughout. @ligaments_note@
# Put your own points (picked in the meshes), stiffness (N at a strain of 1) and strain in the reference pose there ---
@ligaments@@patella@
# --- Load: CHOSEN. 100 N press the tibia against the femur, always along the tibia's own axis ---
[load.compression]
body = "tibia"
force = @compression@
point = @centre@
frame = "body"

# --- Steps: what is prescribed and loaded, from where to where. All else finds its balance ---
[[step]]                                   # settle: the load grows from a twentieth to the whole of it
prescribe = { "knee.flexion" = 0 }
load = { compression = [0.05, 1]@patella_ramp@ }
increments = 9

[[step]]                                   # bend
prescribe = { "knee.flexion" = [0, @flexion@] }   # CHOSEN@flexion_note@
increments = @increments@
)";
}

std::string patella_text() {
  return R"(
# --- The patella: where the files have it all its coordinates are 0. The reference patella lies on it (@patella_fit@) ---
[body.patella]

[joint.patella]
type = "free"
parent = "femur"
child = "patella"
rotations = ["flexion @flexion_axis@", "rotation @adduction_axis@", "tilt @rotation_axis@"]   # in this order
translations = ["x", "y", "z"]
grood_suntay = { side = "@side@", femur = { body = "femur", proximal = @femur_proximal@, anterior = @femur_anterior@, origin = @femur_origin@ }, patella = { body = "patella", proximal = @femur_proximal@, anterior = @femur_anterior@, origin = @patella_origin@ } }

[surface.patella]
body = "patella"
shape = "mesh"
file = @patella_file@
units = "@patella_unit@"@patella_thickness@

[contact.patellofemoral]
surfaces = ["femur", "patella"]
model = "cartilage"
modulus = 10                   # CHOSEN: MPa
poisson = 0.45                 # CHOSEN
@patella_layer@quadrature = "triangles"
cast_from = "patella"

# Its ligaments: CHOSEN, those of the measured knee. `reference_strain` is that of the measured knee in extension.
@patella_ligaments@# The quadriceps: CHOSEN. Four cables of constant tension, @tension@ N in all, each over a cylinder in front of the femur.
@quadriceps@)";
}

std::string filled_in(std::string text, const std::map<std::string, std::string>& values) {
  std::string out;
  std::size_t from = 0;
  for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@', from)) {
    const std::size_t end = text.find('@', at + 1);
    out += text.substr(from, at - from) + values.at(text.substr(at + 1, end - at - 1));
    from = end + 1;
  }
  return out + text.substr(from);
}

}  // namespace genu
