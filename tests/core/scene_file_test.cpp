#include "core/scene/scene_file.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/io/errors.hpp"
#include "core/scene/describe_scene.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;

std::shared_ptr<const SceneSnapshot> scene_of(const std::string& text, SceneFlags flags = {}) {
  return make_snapshot(SceneFile(text, "a.toml", "."), std::move(flags));
}
std::string refusal(const std::string& text, SceneFlags flags = {}) {
  return message_of<InputError>([&] { (void)scene_of(text, flags); });
}

/// A right-handed frame from cross products written out here.
void expect_frame(const SceneCamera& camera, const Vec3& forward, const Vec3& right) {
  EXPECT_NEAR(length(camera.forward - forward), 0.0, 1e-15);  // two roundings of a unit vector
  EXPECT_NEAR(length(camera.right - right), 0.0, 1e-15);
  EXPECT_NEAR(dot(camera.up, camera.forward), 0.0, 1e-16);
  EXPECT_NEAR(length(camera.up), 1.0, 1e-15);
}

TEST(SceneFile, an_empty_one_is_flat_space_with_every_default) {
  const auto scene = scene_of("");
  EXPECT_EQ(scene->spacetime.metric, "minkowski");
  EXPECT_EQ(scene->header.chart, "cartesian");
  EXPECT_EQ(scene->transport.tier, 1);
  EXPECT_EQ(scene->transport.method, "dopri54");
  EXPECT_EQ(scene->transport.project, Projection::none);
  EXPECT_EQ(scene->film.columns(), 640);
  EXPECT_EQ(scene->film.aovs.size(), aov_names.size());
  EXPECT_FALSE(scene->research.config.research_enabled);
  expect_frame(scene->camera, {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0});
}

TEST(SceneFile, says_all_that_it_says) {
  const auto scene = scene_of(R"(
[scene]
name = "a scene"
units = "m"

[camera]
model = "fisheye"
position = [1, 2, 3.5]
look_at = [1, 2, 10]
up = [0, 2, 0.1]
fov = "180deg"
time = 4.0

[observer]
kind = "boosted"
velocity = [0.0, 0.3, 0.4]

[transport]
tier = 2
tol = 1e-11
max_steps = 500
r_max = 60
project = "energy"

[transport.kick_drift]
max_steps = 350
step_length = 0.05
max_step = 0.2
gain = 0.7
low_curvature = 0.3

[fields]
beta = 2.0

[[field]]
name = "b"
curve = "power"
amplitude = 0.9
r_outer = 5
a = 1.8
translate = [2, 0, 0]

[[field]]
name = "a"
shape = "box"
r_outer = 1
half_size = [1, 2, 3]
rotate = { axis = [0, 0, 2], angle = "90deg" }
scale = [2, 1, 1]

[sky]
kind = "checker"
squares = 36
colour_a = [0, 0, 0]

[film]
width = 100
height = 50
scale = 0.75
samples = 4
tile = 16
seed = 3
aovs = ["owner", "depth", "owner"]
)");
  EXPECT_EQ(scene->header.name, "a scene");
  EXPECT_EQ(scene->header.units, "m");
  EXPECT_EQ(scene->camera.model, CameraModel::fisheye);
  EXPECT_EQ(scene->camera.position, (Vec3{1.0, 2.0, 3.5}));
  expect_frame(scene->camera, {0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0});  // forward x up with up towards +y
  EXPECT_NEAR(scene->camera.fov, std::numbers::pi, 1e-15);
  EXPECT_EQ(scene->camera.time, 4.0);
  EXPECT_EQ(scene->observer.kind, ObserverKind::boosted);
  EXPECT_EQ(scene->observer.velocity, (Vec3{0.0, 0.3, 0.4}));
  EXPECT_EQ(scene->transport.method, "dop853");
  EXPECT_EQ(scene->transport.tol, 1e-11);
  EXPECT_EQ(scene->transport.max_steps, 500);
  EXPECT_EQ(scene->transport.r_max, 60.0);
  EXPECT_EQ(scene->transport.project, Projection::energy);
  EXPECT_EQ(scene->transport.preview.max_steps, 350);
  EXPECT_EQ(scene->transport.preview.gain, 0.7);
  ASSERT_EQ(scene->fields.sources.size(), 2U);
  EXPECT_EQ(scene->fields.gains.beta, 2.0);
  const FieldSource& box = scene->fields.sources[0];  // by name, not by the file's order
  EXPECT_EQ(box.name, "a");
  EXPECT_EQ(box.shape, FieldShape::box);
  // Scaled, then turned by 90 degrees about z: x goes to 2 y, y to -x.
  EXPECT_NEAR(box.world_from_local.axes[0][1], 2.0, 1e-15);
  EXPECT_NEAR(box.world_from_local.axes[1][0], -1.0, 1e-15);
  EXPECT_EQ(box.half_size, (std::array{1.0, 2.0, 3.0}));
  const FieldSource& sphere = scene->fields.sources[1];
  EXPECT_EQ(sphere.curve, FieldCurve::power);
  EXPECT_EQ(sphere.a, 1.8);
  EXPECT_EQ(sphere.world_from_local.origin, (std::array{2.0, 0.0, 0.0}));
  EXPECT_EQ(scene->sky.squares, 36);
  EXPECT_EQ(scene->film.columns(), 75);
  EXPECT_EQ(scene->film.rows(), 38);  // 37.5 rounded
  EXPECT_EQ(scene->film.aovs, (std::vector{Aov::depth, Aov::owner}));
}

TEST(SceneFile, a_metric_takes_its_parameters) {
  const auto scene =
      scene_of("[spacetime]\nmetric = \"kerr\"\nset = { a = 0.9, M = 1 }\n[scene]\nchart = \"kerr-schild\"");
  EXPECT_EQ(scene->spacetime.parameters, (std::vector<std::pair<std::string, double>>{{"M", 1.0}, {"a", 0.9}}));
  EXPECT_EQ(scene->header.chart, "kerr-schild");
}

TEST(SceneFile, flags_beat_the_file) {
  const std::string text = "[transport]\ntier = 2\ntol = 1e-9\n[film]\nwidth = 80\nheight = 80\nsamples = 2";
  const auto scene = scene_of(text, {.tier = 1, .tol = 1e-5, .scale = 0.5, .samples = 9});
  EXPECT_EQ(scene->transport.method, "dopri54");
  EXPECT_EQ(scene->transport.tol, 1e-5);
  EXPECT_EQ(scene->film.columns(), 40);
  EXPECT_EQ(scene->film.samples, 9);
}

TEST(SceneFile, research_mode_configures_the_transport) {
  const std::string text =
      "[transport]\ntier = 0\nmax_steps = 700\n[transport.kick_drift]\nmax_step = 0.2\nstep_length = 0.08\n"
      "[[field]]\nname = \"f\"\nr_outer = 5\n";
  EXPECT_EQ(scene_of(text)->transport.method, "tier0_kick_drift");
  const auto validate = scene_of(text, {.preset = "validate"});
  EXPECT_EQ(validate->research.preset, "validate");
  EXPECT_TRUE(validate->research.config.research_enabled);
  EXPECT_EQ(validate->transport.tier, 1);
  EXPECT_EQ(validate->transport.method, "dopri54");
  EXPECT_EQ(validate->transport.tol, 1e-10);
  EXPECT_EQ(validate->transport.max_steps, 700);  // the smaller of the scene's and the preset's
  EXPECT_EQ(validate->transport.preview.max_step, 0.1);
  EXPECT_EQ(validate->research.clamps.max_step, 1);
  EXPECT_EQ(hash_of(validate->research.overrides), hash_of(preset_overrides("validate")));

  const auto paper = scene_of(text + "[research]\npreset = \"paper-match\"\nfixed_seed = 5\n");
  EXPECT_EQ(paper->transport.project, Projection::full);
  EXPECT_EQ(paper->transport.method, "dop853");
  EXPECT_EQ(paper->research.config.fixed_seed, 5);
  EXPECT_NE(hash_of(paper->research.overrides), hash_of(preset_overrides("paper-match")));

  // Off for good: by a flag, and by the master switch.
  const auto off = scene_of(text + "[research]\npreset = \"paper-match\"\n", {.preset = "off"});
  EXPECT_EQ(scene_json(*off)["transport"], scene_json(*scene_of(text))["transport"]);
  const auto master = scene_of(text + "[research]\npreset = \"paper-match\"\nenabled = false\n");
  EXPECT_EQ(scene_json(*master)["transport"], scene_json(*scene_of(text))["transport"]);
  EXPECT_FALSE(master->research.config.research_enabled);
}

TEST(SceneFile, a_tier_that_research_mode_sets_brings_its_method) {
  const auto scene = scene_of("[research]\nresearch_enabled = true\nresearch_tier = 2\n");
  EXPECT_EQ(scene->transport.method, "dop853");
}

/// The part of a scene that is wrong, and the line that says so.
struct WrongScene {
  std::string text, says;
};

TEST(SceneFile, says_in_one_line_what_is_wrong_where) {
  const std::string field = "[[field]]\nname = \"f\"\nr_outer = 5\nr_inner = 1\nabsorb = true\n";
  const std::vector<WrongScene> wrong{
      {"[camera]\nfov = 42",
       "a.toml: line 2: [camera] fov needs an angle with its unit, as in \"42deg\" or \"0.7rad\""},
      {"[camera]\nfvo = \"42deg\"", "a.toml: line 2: [camera]: unknown key 'fvo'; did you mean 'fov'?"},
      {"\n[camra]\n", "a.toml: line 2: unknown section 'camra'; did you mean 'camera'?"},
      {"[[camera]]\n", "a.toml: line 1: camera needs to be one section, [camera]"},
      {"[field]\nname = \"f\"", "a.toml: line 1: field needs sections with two brackets, [[field]]"},
      {"[camera]\nmodel = \"pinhol\"",
       "a.toml: line 2: [camera] model is an unknown name 'pinhol'; did you mean 'pinhole'?"},
      {"[camera]\nposition = [1, 2]", "a.toml: line 2: [camera] position has 2 numbers, needs 3"},
      {"[camera]\nposition = [1, 2, nan]", "a.toml: line 2: [camera] position is nan, needs a finite number"},
      {"[camera]\nposition = [1, 2, 3]\nlook_at = [1, 2, 3]",
       "a.toml: line 3: [camera] look_at gives no direction to look in: "
       "it needs to differ from the camera's position"},
      {"[camera]\nup = [0, 0, 3]",
       "a.toml: line 2: [camera] up is parallel to the direction in which the camera looks"},
      {"[camera]\nforward = [0, 0, 1]\nlook_at = [1, 2, 3]",
       "a.toml: line 3: [camera] look_at and forward say the same thing "
       "twice; keep one"},
      {"[camera]\nfov = \"180deg\"",
       "a.toml: line 2: [camera] fov is 180 degrees, needs more than 0 and less than 180"},
      {"[camera]\nfov = \"-1rad\"",
       "a.toml: line 2: [camera] fov is -57.2958 degrees, needs more than 0 and less than 180"},
      {"[observer]\nkind = \"boosted\"\nvelocity = [0.8, 0.6, 0]",
       "a.toml: line 3: [observer] velocity has the size 1, needs less than 1, the speed of light"},
      {"[observer]\nkind = \"falling\"",
       "a.toml: line 2: [observer] kind is falling, which needs gravity: a [spacetime] with a mass"},
      {"[film]\nwidth = 0", "a.toml: line 2: [film] width is 0: the film has no area; needs 1 or more"},
      {"[film]\nwidth = 1000000\nheight = 1000000",
       "a.toml: line 2: [film] width and height make 1000000 x 1000000 pixels, which "
       "need 240 TB of memory; at most 17.2 GB and 1000000 pixels an edge"},
      {"[film]\nwidth = 12.5", "a.toml: line 2: [film] width needs a whole number"},
      {"[film]\nscale = -1.0", "a.toml: line 2: [film] scale is -1, needs > 0"},
      {"[film]\nsamples = 0", "a.toml: line 2: [film] samples is 0, needs 1 to 65536 rays a pixel"},
      {"[film]\naovs = [\"depht\"]",
       "a.toml: line 2: [film] aovs holds an unknown name 'depht'; did you mean 'depth'?"},
      {"[transport]\ntier = 3", "a.toml: line 2: [transport] tier is 3, needs 0, 1 or 2"},
      {"[transport]\ntol = 0.0", "a.toml: line 2: [transport] tol is 0, needs > 0"},
      {"[transport]\nmethod = \"dop835\"", "a.toml: line 2: [transport] method does not do: "},
      {"[transport]\ntier = 0\nmethod = \"rk4\"",
       "a.toml: line 3: [transport] method is rk4, which tier 0 does not take"},
      {"[transport.kick_drift]\nmin_step = 2",
       "a.toml: line 1: [transport.kick_drift] max_step is 0.5, needs at least min_step = 2"},
      {"[transport.kick_drift]\nmax_steps = 0", "a.toml: line 2: [transport.kick_drift] max_steps is 0, needs 1 to"},
      {"[[field]]\nname = \"f\"\nr_outer = 1\nr_inner = 2", "a.toml: line 1: [[field]]: "},
      {"[spacetime]\nmetric = \"ker\"",
       "a.toml: line 2: [spacetime] metric does not do: unknown metric 'ker': did you mean 'kerr'?"},
      {"[spacetime]\nmetric = \"kerr\"\nset = { b = 1 }",
       "a.toml: line 3: [spacetime] set does not do: unknown parameter 'b'"},
      {"[spacetime]\nmetric = \"kerr\"\nset = { a = 1.5 }", "a.toml: line 3: [spacetime] set does not do: "},
      {"[spacetime]\nmetric = \"medium-uniform\"\nset = { n = 0 }", "a.toml: line 3: [spacetime] set does not do: "},
      {"[spacetime]\nset = { n = 0 }", "a.toml: line 1: [spacetime] metric is missing"},
      {"[scene]\nchart = \"boyer-lindquist\"\n[spacetime]\nmetric = \"kerr\"",
       "a.toml: line 2: [scene] chart 'boyer-lindquist' is no Cartesian chart of kerr; there are kerr-schild"},
      {field + "[spacetime]\nmetric = \"kerr\"",
       "a.toml: line 7: [spacetime] metric is kerr and there are 1 [[field]]s: light is bent "
       "by a spacetime or by fields, not by both; take one away"},
      {field + field, "a.toml: line 7: [[field]] name is taken by another field"},
      {field + "[[field]]\nname = \"g\"\nr_outer = 5\nr_inner = 1\nabsorb = true\ntranslate = [1.9, 0, 0]",
       "a.toml: line 10: [[field]] absorb overlaps the absorber of field 'f'"},
      {"[[field]]\nname = \"f\"", "a.toml: line 1: [[field]] r_outer is missing"},
      {"[[field]]\nname = \"f\"\nr_outer = 1\nscale = 0.0",
       "a.toml: line 4: [[field]] scale flattens space: it cannot be undone"},
      {"[[field]]\nname = \"f\"\nr_outer = 1\nrotate = { axis = [0, 0, 0], angle = \"3deg\" }",
       "a.toml: line 4: [[field]] rotate axis is zero, needs a direction"},
      {"[sky]\nkind = \"checker\"\nsquares = 7",
       "a.toml: line 3: [sky] squares is 7, needs an even number from 2 to 3600"},
      {"[sky]\nkind = \"image\"", "a.toml: line 1: [sky] file is missing: kind = \"image\" needs one"},
      {"[research]\npreset = \"validat\"",
       "a.toml: line 2: [research] preset does not do: unknown preset 'validat'; did you mean "
       "'validate'?"},
      {"[research]\npreset = \"validate\"\nmax_work_per_frame_ms = 16",
       "a.toml: line 3: [research] max_work_per_frame_ms is a wall-clock budget, refused in Research Mode"},
      {"[research]\nfixed_sed = 1", "a.toml: line 2: [research]: unknown key 'fixed_sed'; did you mean 'fixed_seed'?"},
      {"[research]\npreset = \"validate\"\ndt_min = 1",
       "a.toml: line 1: [research] dt_max is 0.1, needs at least dt_min = 1"},
      {"[research]\npreset = \"validate\"\nray_dumps = [[640, 0]]",
       "a.toml: line 3: [research] ray_dumps has pixel [640, 0], needs "
       "[0, 0] to [639, 359]"},
      {"[research]\npreset = \"validate\"\ntransport_model = \"GRIN_Optical\"\n[spacetime]\nmetric = \"kerr\"",
       "a.toml: line 3: [research] transport_model is GRIN_Optical, but the scene's light is Metric_NullGeodesic"},
      {"x = ", "a.toml: line 1: "},
      {"[scene]\nname = 1979-05-27", "a.toml: line 2: [scene] name needs a text in quotes"},
  };
  for (const WrongScene& scene : wrong) {
    const std::string says = refusal(scene.text);
    EXPECT_TRUE(says.starts_with(scene.says)) << scene.text << "\n  says " << says << "\n  not  " << scene.says;
    EXPECT_EQ(says.find('\n'), std::string::npos) << says;
  }
}

TEST(SceneFile, says_which_flag_is_wrong) {
  EXPECT_EQ(refusal("", {.tier = 5}), "command line: flags tier is 5, needs 0, 1 or 2");
  EXPECT_EQ(refusal("", {.preset = "valid"}).substr(0, 26), "command line: flags preset");
  EXPECT_NE(refusal("[film]\nwidth = 10", {.scale = 1e9}).find("which need"), std::string::npos);
}

TEST(SceneFile, is_refused_where_there_is_none) {
  EXPECT_EQ(message_of<InputError>([] { (void)read_scene("no/such.toml"); }),
            "no/such.toml: cannot be read: No such file or directory");
}

/// An engine that says the same in another order.
class Engine : public SceneHost {
 public:
  void describe(SceneBuilder& builder) const override {
    const SourcePlace place{"engine", "scene", 0, {}};
    const auto field = [&](const char* name, double r_outer) {
      FieldSource source;
      source.name = name;
      source.r_outer = r_outer;
      builder.add(source, place);
    };
    field("b", 2.0);
    SceneHeader header;
    header.name = "two";
    builder.set(header, place);
    field("a", 3.0);
  }
};

TEST(SceneHost, two_hosts_that_say_the_same_give_the_same_snapshot) {
  const auto file =
      scene_of("[[field]]\nname = \"a\"\nr_outer = 3\n[[field]]\nname = \"b\"\nr_outer = 2\n[scene]\nname = \"two\"");
  EXPECT_EQ(scene_json(*file).dump(), scene_json(*make_snapshot(Engine())).dump());
  EXPECT_EQ(scene_text(*file), scene_text(*make_snapshot(Engine())));
}

}  // namespace
}  // namespace xpr
