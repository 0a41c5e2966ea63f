#include "scene/scene_text.h"
#include "support/temporary_folder.h"

namespace genu::scene_test {
namespace {

using Comparison = RegionDef::Comparison;
const std::string kPair = R"(surfaces = ["ball", "floor"])";
const std::string kRegions = R"(regions = { inner = "z < 0", outer = "z >= 0 and x < 5" })";

TEST(ReadContacts, PairAndRegions) {
  const Scene scene = good(kGoodScene);
  ASSERT_EQ(scene.contacts.size(), 1u);
  const ContactDef& contact = scene.contacts[0];
  EXPECT_EQ(contact.name, "medial");
  EXPECT_EQ(contact.surface_a, 0);
  EXPECT_EQ(contact.surface_b, 1);
  ASSERT_EQ(contact.regions.size(), 2u);
  EXPECT_EQ(contact.regions[0].name, "inner");
  const auto& outer = contact.regions[1].conditions;
  ASSERT_EQ(outer.size(), 2u);
  EXPECT_EQ(outer[0].axis, 2);
  EXPECT_EQ(outer[0].comparison, Comparison::greater_equal);
  EXPECT_EQ(outer[1].axis, 0);
  EXPECT_EQ(outer[1].comparison, Comparison::less);
  EXPECT_DOUBLE_EQ(outer[1].value, 5e-3);
}

TEST(ReadContacts, RegionsInEveryWayOfWriting) {
  const Scene scene = good(edited(kRegions, "regions = { a = \" y<=-1.5e1and x>2\", b = 'z  >  0.25  ' }"));
  const auto& a = scene.contacts[0].regions[0].conditions;
  ASSERT_EQ(a.size(), 2u);
  EXPECT_EQ(a[0].axis, 1);
  EXPECT_EQ(a[0].comparison, Comparison::less_equal);
  EXPECT_DOUBLE_EQ(a[0].value, -0.015);
  EXPECT_EQ(a[1].comparison, Comparison::greater);
  EXPECT_DOUBLE_EQ(scene.contacts[0].regions[1].conditions[0].value, 0.25e-3);
  EXPECT_TRUE(good(edited(kRegions, "")).contacts[0].regions.empty());
}

TEST(ReadContacts, RegionErrors) {
  for (const std::string bad : {"", "z", "z <", "w < 0", "z = 0", "z < 0 or x < 0", "z < 0 and", "0 < z", "z < nan",
                                "z < inf", "z < 1e999", "z < 0 x", "z << 0", "and z < 0", "z < 5 mm"}) {
    expect_refused("\"z < 0\"", "@\"" + bad + "\"", "contact.medial.regions.inner", "\"" + bad + "\"",
                   "must be conditions such as");
  }
  expect_refused("\"z < 0\"", "@0", "contact.medial.regions.inner", "0", "must be a string");
  expect_refused("inner =", "@\"in.ner\" =", "contact.medial.regions.in.ner", "\"in.ner\"", "a name is a letter");
  expect_refused(kRegions, "regions = @[1]", "contact.medial.regions", "[1]", "must be a table");
}

TEST(ReadContacts, Pair) {
  expect_refused("\"ball\", \"floor\"", "@\"bal\", \"floor\"", "contact.medial.surfaces[1]", "\"bal\"",
                 "unknown surface; known: \"ball\", \"floor\"; did you mean \"ball\"?");
  expect_refused("\"ball\", \"floor\"", "\"ball\", @2", "contact.medial.surfaces[2]", "2", "must be a string");
  expect_refused(kPair, "surfaces = @[\"ball\"]", "contact.medial.surfaces", "[\"ball\"]",
                 "must be the names of two surfaces");
  expect_refused(kPair, "surfaces = @[\"ball\", \"ball\"]", "contact.medial.surfaces", "[\"ball\", \"ball\"]",
                 "both surfaces are on body.femur");
  expect_refused("[contact.medial]\n" + kPair, "[contact.@medial]", "contact.medial.surfaces", "", "is missing");
}

TEST(ReadContacts, BodiesOfThePair) {
  const std::string other = "[surface.cup]\nbody = \"femur\"\nshape = \"plane\"\n";
  expect_one_error(edited(kPair, "surfaces = @[\"ball\", \"cup\"]", kGoodScene + other), "contact.medial.surfaces",
                   "[\"ball\", \"cup\"]", "both surfaces are on body.femur");
}

TEST(ReadContacts, FixedBodiesNeverMeet) {
  const std::string ground = "[body.ground]\nfixed = true\n[surface.rock]\nbody = \"ground\"\nshape = \"plane\"\n";
  expect_one_error(edited(kPair, "surfaces = @[\"rock\", \"floor\"]", kGoodScene + ground), "contact.medial.surfaces",
                   "[\"rock\", \"floor\"]", "both surfaces are on fixed bodies");
}

TEST(ReadContacts, SamePairTwice) {
  expect_one_error(kGoodScene + "[contact.again]\nsurfaces = @[\"floor\", \"ball\"]\nmodel = \"rigid\"\n",
                   "contact.again.surfaces", "[\"floor\", \"ball\"]", "contact.medial has the same pair");
}

TEST(ReadContacts, Model) {
  expect_refused("model = \"rigid\"", "model = @\"rigit\"", "contact.medial.model", "\"rigit\"",
                 "must be one of \"rigid\", \"cartilage\"; did you mean \"rigid\"?");
  expect_refused("[contact.medial]\n" + kPair + "\nmodel = \"rigid\"", "[contact.@medial]\n" + kPair,
                 "contact.medial.model", "", "is missing");
  for (const std::string key : {"modulus", "poisson", "thickness", "law", "quadrature", "cast_from", "rim",
                                "search_depth", "tolerance", "damping"}) {
    expect_refused("model = \"rigid\"", "model = \"rigid\"\n@" + key + " = 1", "contact.medial." + key, "1",
                   "is no key of a rigid contact");
  }
  expect_refused("model = \"rigid\"", "model = \"rigid\"\n@friction = 1", "contact.medial.friction", "1",
                 "is no key of a rigid contact");
}

/// A layer as the tests spoil it.
const std::string kLayer =
    "model = \"cartilage\"\nmodulus = 10\npoisson = 0.45\nthickness = 6\nlaw = \"logarithmic\"\n"
    "quadrature = \"triangles\"\ncast_from = \"floor\"\nsearch_depth = 4";

TEST(ReadContacts, Layer) {
  const Scene scene = good(edited("model = \"rigid\"", kLayer));
  ASSERT_EQ(scene.layers.size(), 1u);
  EXPECT_TRUE(scene.contacts.empty());
  const LayerDef& layer = scene.layers[0];
  EXPECT_EQ(layer.pair.name, "medial");
  EXPECT_EQ(layer.pair.regions.size(), 2u);
  EXPECT_EQ(layer.modulus, 10e6);
  EXPECT_EQ(layer.poisson, 0.45);
  EXPECT_DOUBLE_EQ(layer.thickness, 6e-3);
  EXPECT_DOUBLE_EQ(layer.search_depth, 4e-3);
  EXPECT_EQ(layer.law, LayerDef::Law::logarithmic);
  EXPECT_EQ(layer.quadrature, LayerDef::Quadrature::triangles);
  EXPECT_EQ(layer.cast_from, layer.pair.surface_b);
  EXPECT_EQ(layer.rim, LayerDef::Rim::weighted);
  for (const auto& [word, rim] : {std::pair("weighted", LayerDef::Rim::weighted), {"cut", LayerDef::Rim::cut}}) {
    const Scene other = good(edited("model = \"rigid\"", kLayer + "\nrim = \"" + word + "\""));
    ASSERT_EQ(other.layers.size(), 1u);
    EXPECT_EQ(other.layers[0].rim, rim);
  }
}

TEST(ReadContacts, LayerOverSmoothSurfaces) {
  const std::string triangles = "\nquadrature = \"triangles\"\ncast_from = \"floor\"";
  for (const std::string other : {"", "\nquadrature = \"smooth\"", "\ntolerance = 1e-3"}) {
    const Scene scene = good(edited("model = \"rigid\"", edited(triangles, other, kLayer)));
    ASSERT_EQ(scene.layers.size(), 1u);
    EXPECT_EQ(scene.layers[0].quadrature, LayerDef::Quadrature::smooth);
    EXPECT_EQ(scene.layers[0].tolerance, other.find("tolerance") == std::string::npos ? 1e-4 : 1e-3);
    EXPECT_DOUBLE_EQ(scene.layers[0].search_depth, 4e-3);
  }
}

TEST(ReadContacts, QuadratureThatNobodyNames) {
  using Quadrature = LayerDef::Quadrature;
  const test::TemporaryFolder folder;
  for (const char* file : {"upper.stl", "lower.stl"}) folder.write(file, "solid\nendsolid\n");
  const auto layer = [&](const std::string& a, const std::string& keys) {
    const auto surface = [](const std::string& name, const std::string& body, const std::string& shape) {
      return "[surface." + name + "]\nbody = \"" + body + "\"\nshape = \"" + shape + "\"\n" +
             (shape == "mesh" ? "file = \"" + name + ".stl\"\nunits = \"mm\"\n" : "radius = 20\n");
    };
    Diagnostics out;
    const auto scene = read_scene(
        folder.write(
            "scene.toml",
            "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.ground]\nfixed = true\n[body.bone]\n"
            "[joint.j]\ntype = \"free\"\nparent = \"ground\"\nchild = \"bone\"\nrotations = [\"a x\", \"b y\", \"c "
            "z\"]\n"
            "translations = [\"x\", \"y\", \"z\"]\n" +
                surface("upper", "bone", a) + surface("lower", "ground", "mesh") +
                "[contact.foot]\nsurfaces = [\"upper\", \"lower\"]\nmodel = \"cartilage\"\nmodulus = 5\npoisson = 0.4\n"
                "thickness = 4\n" +
                keys + "\n[[step]]\nprescribe = { \"j.z\" = 0 }\n"),
        out);
    for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
    return scene ? scene->layers.at(0) : LayerDef{};
  };
  const LayerDef meshes = layer("mesh", "");
  EXPECT_EQ(meshes.quadrature, Quadrature::triangles);
  EXPECT_EQ(meshes.cast_from, meshes.pair.surface_b);
  EXPECT_EQ(layer("sphere", "").quadrature, Quadrature::smooth);
  EXPECT_EQ(layer("mesh", "tolerance = 1e-3").quadrature, Quadrature::smooth);
  EXPECT_EQ(layer("mesh", "quadrature = \"smooth\"").quadrature, Quadrature::smooth);
  EXPECT_EQ(layer("sphere", "rim = \"cut\"").quadrature, Quadrature::triangles);
  const LayerDef cast = layer("sphere", "cast_from = \"upper\"");
  EXPECT_EQ(cast.quadrature, Quadrature::triangles);
  EXPECT_EQ(cast.cast_from, cast.pair.surface_a);
}

TEST(ReadContacts, LayerDefaults) {
  const std::string less = edited("\nsearch_depth = 4", "", edited("\nlaw = \"logarithmic\"", "", kLayer));
  const Scene scene = good(edited("model = \"rigid\"", less));
  ASSERT_EQ(scene.layers.size(), 1u);
  EXPECT_EQ(scene.layers[0].law, LayerDef::Law::linear);
  EXPECT_DOUBLE_EQ(scene.layers[0].search_depth, 6e-3);
}

TEST(ReadContacts, LayerRefused) {
  const auto refused = [](const std::string& from, const std::string& to, const std::string& key,
                          const std::string& found, const std::string& rule) {
    const std::size_t mark = to.find('@');
    ASSERT_NE(mark, std::string::npos);
    expect_one_error(edited("model = \"rigid\"", edited(from, to, kLayer)), "contact.medial." + key, found, rule);
  };
  refused("modulus = 10", "modulus = @0", "modulus", "0", "must be > 0 MPa");
  refused("modulus = 10", "modulus = @-3", "modulus", "-3", "must be > 0 MPa");
  refused("poisson = 0.45", "poisson = @0.5", "poisson", "0.5", "must be < 0.5");
  refused("poisson = 0.45", "poisson = @-0.1", "poisson", "-0.1", "must be >= 0");
  refused("thickness = 6", "thickness = @0", "thickness", "0", "must be > 0 mm");
  refused("search_depth = 4", "search_depth = @-1", "search_depth", "-1", "must be > 0 mm");
  refused("search_depth = 4", "search_depth = @1e-6", "search_depth", "1e-06",
          "must be at least a thousandth of the thickness");
  refused("search_depth = 4", "search_depth = 4\n@damping = 2", "damping", "2", "only in a scene with [dynamics]");
  refused("\"floor\"", "@\"flour\"", "cast_from", "\"flour\"", "unknown surface");
  refused("\"logarithmic\"", "@\"log\"", "law", "\"log\"", "must be one of");
  refused("\"triangles\"", "@\"gauss\"", "quadrature", "\"gauss\"", "must be one of");
  refused("\"triangles\"\ncast_from = \"floor\"", "\"smooth\"\ncast_from = @\"floor\"", "cast_from", "\"floor\"",
          "belongs to quadrature = \"triangles\"");
  refused("search_depth = 4", "rim = @\"wieghted\"", "rim", "\"wieghted\"", "did you mean \"weighted\"?");
  refused("\"triangles\"\ncast_from = \"floor\"", "\"smooth\"\nrim = @\"cut\"", "rim", "\"cut\"",
          "belongs to quadrature = \"triangles\"");
  refused("search_depth = 4", "tolerance = @1e-3", "tolerance", "0.001", "belongs to quadrature = \"smooth\"");
  const std::string smooth = "quadrature = \"triangles\"\ncast_from = \"floor\"";
  refused(smooth, "tolerance = @1e-9", "tolerance", "1e-09", "must be >= 1e-08");
  refused(smooth, "tolerance = @0.5", "tolerance", "0.5", "must be <= 0.1");
}

TEST(ReadContacts, ABadQuadratureHidesNothing) {
  const auto messages = [](const std::string& keys) {
    Diagnostics out;
    const std::string layer = edited("quadrature = \"triangles\"\ncast_from = \"floor\"", keys, kLayer);
    EXPECT_FALSE(parse_scene(edited("model = \"rigid\"", layer), "scene.toml", out));
    std::string text;
    for (const Diagnostic& d : out.items()) text += to_string(d) + "\n";
    return text;
  };
  const std::string text = messages("quadrature = \"gauss\"\ntolerance = 7\ncast_from = \"flour\"");
  EXPECT_NE(text.find("quadrature = \"gauss\""), std::string::npos) << text;
  EXPECT_NE(text.find("tolerance = 7: must be <= 0.1"), std::string::npos) << text;
  EXPECT_NE(text.find("cast_from = \"flour\": unknown surface"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << text;
  // What is right by itself is none, whichever quadrature was meant.
  const std::string one = messages("quadrature = 3\ntolerance = 1e-3\ncast_from = \"floor\"");
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 1) << one;
}

}  // namespace
}  // namespace genu::scene_test
