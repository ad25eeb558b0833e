#include "core/film/film.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "core/film/dense_path.hpp"
#include "core/film/sky.hpp"
#include "integrators/stepper.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/schwarzschild_exact.hpp"

namespace xpr {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A square wall of half side `half` in the plane x = level, facing +x.
std::shared_ptr<const TriangleMesh> wall(double level, double half) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = {{level, -half, -half}, {level, half, -half}, {level, half, half}, {level, -half, half}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

GeometryModel model_of(std::shared_ptr<const TriangleMesh> mesh) {
  GeometryModel model;
  model.meshes = {std::move(mesh)};
  model.instances = {{.mesh = 0, .to_world = {}, .owner = 7, .material = std::nullopt, .solid = false}};
  return model;
}

SceneCamera camera_at(double x, double fov) {
  SceneCamera camera;
  camera.position = {x, 0.0, 0.0};
  camera.forward = {-1.0, 0.0, 0.0};
  camera.up = {0.0, 0.0, 1.0};
  camera.fov = fov;
  return camera;
}

SceneFilm film_of(std::int64_t width, std::int64_t height) {
  SceneFilm film;
  film.width = width;
  film.height = height;
  film.aovs = {Aov::depth,       Aov::normal,          Aov::n_dot_v,    Aov::two_sided_n_dot_v,
               Aov::pixel_class, Aov::frequency_shift, Aov::deflection, Aov::swept_angle,
               Aov::null_drift,  Aov::steps,           Aov::owner};
  return film;
}

FilmTracerSettings settings_of(const char* method, double tol, int lanes) {
  FilmTracerSettings settings;
  settings.trace.method = method;
  settings.trace.tol = tol;
  settings.trace.r_max = 500.0;
  settings.lanes = lanes;
  settings.has_sky = true;
  return settings;
}

Colour grey(const RayRecord& ray) {
  const double value = ray.film_class == FilmClass::geom_hit ? 0.5 : 0.1;
  return {value, value, value};
}

FilmSpace space_of(const char* metric, const char* scene, const char* transport) {
  return {make_spacetime(metric, scene, {}), make_spacetime(metric, transport, {}), false};
}

TEST(Film, a_wall_in_flat_space_is_where_perspective_has_it) {
  const auto geometry = make_geometry(model_of(wall(-5.0, 3.0)));
  const SceneFilm film = film_of(32, 24);
  const GeodesicTracer tracer(space_of("minkowski", "cartesian", "cartesian"), *geometry, camera_at(4.0, 60.0 * degree),
                              {}, 32.0 / 24.0, settings_of("dopri54", 1e-10, 4));
  const FilmFrame frame = expose(tracer, film, grey, {});
  std::int64_t hits = 0;
  for (int row = 0; row < 24; ++row) {
    for (int column = 0; column < 32; ++column) {
      const double tan_up = std::tan(30.0 * degree);
      const double y = 9.0 * ((column + 0.5) / 16.0 - 1.0) * tan_up * 32.0 / 24.0;
      const double z = 9.0 * ((row + 0.5) / 12.0 - 1.0) * tan_up;
      const auto place = static_cast<std::size_t>(row * 32 + column);
      const bool inside = std::abs(y) < 3.0 && std::abs(z) < 3.0;
      EXPECT_EQ(frame.plane("class")->values[place],
                static_cast<double>(inside ? FilmClass::geom_hit : FilmClass::background_hit));
      EXPECT_EQ(frame.planes[0].values[place], inside ? 0.5 : 0.1);
      if (!inside) {
        EXPECT_TRUE(std::isnan(frame.plane("depth")->values[place]));
        continue;
      }
      ++hits;
      const double depth = std::sqrt(81.0 + y * y + z * z);
      // Rounding of lengths of ten.
      EXPECT_NEAR(frame.plane("depth")->values[place], depth, 1e-14);
      EXPECT_NEAR(frame.plane("n_dot_v")->values[place], 9.0 / depth, 1e-15);
      EXPECT_EQ(frame.plane("normal.x")->values[place], 1.0);
      EXPECT_EQ(frame.plane("owner")->values[place], 7.0);
      EXPECT_NEAR(frame.plane("frequency_shift")->values[place], 1.0, 1e-15);
      EXPECT_NEAR(frame.plane("deflection")->values[place], 0.0, 1e-15);
    }
  }
  EXPECT_EQ(frame.telemetry.classes[static_cast<std::size_t>(FilmClass::geom_hit)], hits);
  EXPECT_GT(hits, 100);
}

TEST(Film, does_not_depend_on_threads_lanes_or_tiles) {
  const auto geometry = make_geometry(model_of(wall(-12.0, 9.0)));
  SceneFilm film = film_of(40, 30);
  film.samples = 3;
  std::vector<FilmFrame> frames;
  for (const auto& [threads, lanes, tile] : {std::tuple{1, 1, 32}, {2, 4, 8}, {2, 8, 17}, {1, 2, 64}}) {
    film.tile = tile;
    const GeodesicTracer tracer(space_of("schwarzschild", "kerr-schild-outgoing", "kerr-schild-outgoing"), *geometry,
                                camera_at(20.0, 50.0 * degree), {}, 40.0 / 30.0, settings_of("dopri54", 1e-7, lanes));
    FilmOptions options;
    options.threads = threads;
    frames.push_back(expose(tracer, film, grey, options));
  }
  for (std::size_t k = 1; k < frames.size(); ++k) {
    for (std::size_t p = 0; p < frames[0].planes.size(); ++p) {
      const auto &first = frames[0].planes[p].values, &other = frames[k].planes[p].values;
      for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(first[i]), std::bit_cast<std::uint64_t>(other[i]))
            << frames[0].planes[p].name << " of pixel " << i;
      }
    }
  }
}

TEST(Film, a_hole_hides_what_its_shadow_covers_and_shifts_the_rest) {
  const auto geometry = make_geometry({});
  const SceneFilm film = film_of(64, 64);
  FilmTracerSettings settings = settings_of("dop853", 1e-11, 4);
  settings.trace.r_min = 2.02;
  const GeodesicTracer tracer(space_of("schwarzschild", "kerr-schild-outgoing", "kerr-schild-outgoing"), *geometry,
                              camera_at(20.0, 60.0 * degree), {}, 1.0, settings);
  const FilmFrame frame = expose(tracer, film, grey, {});
  // [Synge1966]: an observer at rest at r sees rays within this angle of the hole captured.
  const double shadow = std::asin(std::sqrt(27.0 * (1.0 - 2.0 / 20.0)) / 20.0);
  for (int row = 0; row < 64; ++row) {
    for (int column = 0; column < 64; ++column) {
      const auto place = static_cast<std::size_t>(row * 64 + column);
      const double u = (column + 0.5) / 32.0 - 1.0, v = (row + 0.5) / 32.0 - 1.0;
      const double angle = std::atan(std::tan(30.0 * degree) * std::hypot(u, v));
      const bool captured = angle < shadow;
      EXPECT_EQ(frame.plane("class")->values[place],
                static_cast<double>(captured ? FilmClass::captured : FilmClass::background_hit))
          << column << ", " << row;
      if (captured) continue;
      EXPECT_NEAR(frame.plane("frequency_shift")->values[place], 1.0 / std::sqrt(1.0 - 2.0 / 20.0), 1e-10);
    }
  }
}

TEST(Film, a_picture_does_not_change_with_the_transport_chart) {
  const auto geometry = make_geometry(model_of(wall(-12.0, 9.0)));
  const SceneFilm film = film_of(16, 12);
  std::vector<FilmFrame> frames;
  for (const char* transport : {"kerr-schild-outgoing", "isotropic", "areal"}) {
    FilmTracerSettings settings = settings_of("dop853", 1e-12, 4);
    settings.trace.r_min = 2.05;
    const GeodesicTracer tracer(space_of("schwarzschild", "kerr-schild-outgoing", transport), *geometry,
                                camera_at(20.0, 50.0 * degree), {}, 16.0 / 12.0, settings);
    frames.push_back(expose(tracer, film, grey, {}));
  }
  int compared = 0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    EXPECT_EQ(frames[k].plane("class")->values, frames[0].plane("class")->values);
    for (std::size_t i = 0; i < frames[0].plane("depth")->values.size(); ++i) {
      const double a = frames[0].plane("depth")->values[i], b = frames[k].plane("depth")->values[i];
      if (std::isnan(a)) continue;
      ++compared;
      // Tolerance 1e-12 a step of twenty, over a path of 40, amplified by less than ten off the photon sphere.
      EXPECT_NEAR(a, b, 1e-8) << "pixel " << i;
    }
  }
  EXPECT_GT(compared, 50);
}

TEST(Film, samples_lie_in_their_pixel_and_spread) {
  double left = 0.0;
  for (std::int64_t s = 1; s < 17; ++s) {
    const auto [x, y] = sample_place(1, 42, s, 17);
    EXPECT_GT(x, left);
    EXPECT_LT(x, static_cast<double>(s) / 16.0);
    left = static_cast<double>(s - 1) / 16.0;
    EXPECT_TRUE(y >= 0.0 && y < 1.0);
    EXPECT_NE(sample_place(2, 42, s, 17), sample_place(1, 42, s, 17));
  }
  EXPECT_EQ(sample_place(1, 42, 0, 4), (std::array<double, 2>{0.5, 0.5}));
}

TEST(Sky, turns_from_minus_z_over_plus_x_and_rises_to_plus_y) {
  EXPECT_EQ(sky_direction({0.0, 0.0, -1.0}).longitude, 0.0);
  EXPECT_NEAR(sky_direction({1.0, 0.0, 0.0}).longitude, 90.0 * degree, 1e-16);
  EXPECT_NEAR(sky_direction({0.0, 2.0, 0.0}).latitude, 90.0 * degree, 1e-16);
  SceneSky sky;
  sky.kind = SkyKind::checker;
  sky.squares = 4;
  const auto direction = [](double longitude, double latitude) {
    return Vec3{std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                -std::cos(longitude) * std::cos(latitude)};
  };
  EXPECT_EQ(sky_colour(sky, direction(0.1, 0.1)), sky.colour_a);
  EXPECT_EQ(sky_colour(sky, direction(-0.1, 0.1)), sky.colour_b);
  EXPECT_EQ(sky_colour(sky, direction(0.1, -0.1)), sky.colour_b);
  EXPECT_EQ(sky_colour(sky, direction(1.6, 0.1)), sky.colour_b);
}

TEST(DensePath, is_the_interpolant_of_every_method) {
  const auto hole = make_spacetime("schwarzschild", "kerr-schild", {});
  PhaseState<double> start({0.0, 12.0, 3.0, 1.0}, {-1.0, -1.0, 0.0, 0.0});
  for (const MethodCard& card : methods()) {
    if (card.separable_only) continue;
    TraceSettings settings;
    settings.method = std::string(card.id);
    settings.tol = 1e-6;
    settings.step = 0.5;
    settings.lambda_max = 8.0;
    double worst = 0.0;
    (void)trace_ray(*hole, start, 1, settings, {}, [&](const StepView& step) {
      const std::vector<RayPath> pieces = dense_path(step, {}, 0.0);
      ASSERT_EQ(pieces.size(), 1U);
      const RayPath& path = pieces.front();
      for (const double theta : {0.11, 0.5, 0.83}) {
        std::array<Vec3, RayPath::max_degree + 1> c = path.control;
        for (int level = path.degree; level > 0; --level) {
          for (std::size_t k = 0; k < static_cast<std::size_t>(level); ++k)
            c[k] = (1.0 - theta) * c[k] + theta * c[k + 1];
        }
        const PhaseState<double> y = step.at(theta);
        worst = std::max(worst, length(c[0] - Vec3{y[1], y[2], y[3]}));
      }
    });
    // The same polynomial: rounding of positions of size ten, a few times over in the change of basis.
    EXPECT_LT(worst, 1e-12) << card.id;
  }
}

}  // namespace
}  // namespace xpr
