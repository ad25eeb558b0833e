#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/io/errors.hpp"
#include "core/io/ray_table.hpp"
#include "core/trace_table.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;
using testing::slurp;
using testing::spill;
using testing::TemporaryDirectory;

Transport kerr() {
  TransportSettings settings{.metric = "kerr", .parameters = {{"a", 0.9}}, .chart = "boyer-lindquist"};
  settings.trace.tol = 1e-8;
  settings.trace.r_max = 20.0;
  return Transport(settings);
}

// Rays that end in several ways, ids neither sorted nor close together.
std::vector<Ray> sample_rays(const Transport& transport, std::int64_t count) {
  std::vector<Ray> rays;
  for (std::int64_t k = 0; k < count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(count);
    Ray ray{.id = (k * 7919) % 104729 - 5000,
            .start = {{0.0, 15.0, 1.2 + part, 0.1}, {-1.0, -1.0, 2.0 * part, 12.0 * part - 6.0}}};
    ray = transport.renormalised(ray);
    if (k % 50 == 7) ray.start[1] = -1.0;  // not admitted
    rays.push_back(ray);
  }
  return rays;
}

void write_rays(const std::filesystem::path& path, const Transport& transport, std::span<const Ray> rays) {
  const auto writer = create_table(path, table_format(path), ray_schema(transport.chart().card()));
  writer->write(block_of(rays));
  writer->close();
}

TraceTableResult trace(const std::filesystem::path& in, const std::filesystem::path& out, const Transport& transport,
                       const TraceTableSettings& settings) {
  const std::int64_t rays = check_rays(in, transport, settings);
  const Card& chart = transport.chart().card();
  const auto reader = open_table(in, ray_schema(chart));
  const auto writer = create_table(out, table_format(out), traced_ray_schema(chart));
  const TraceTableResult result = trace_table(transport, *reader, *writer, rays, settings);
  writer->close();
  return result;
}

TEST(TraceTable, gives_a_row_for_each_ray_in_order_whatever_the_threads_the_lanes_and_the_format) {
  const TemporaryDirectory directory;
  const Transport transport = kerr();
  const std::vector<Ray> rays = sample_rays(transport, 17000);  // more than a block
  write_rays(directory / "in.csv", transport, rays);
  write_rays(directory / "in.h5", transport, rays);
  const TraceTableResult one = trace(directory / "in.csv", directory / "one.csv", transport, {.threads = 1});
  const TraceTableResult two = trace(directory / "in.csv", directory / "two.csv", transport, {.threads = 2});
  const TraceTableResult h5 = trace(directory / "in.h5", directory / "two.h5", transport, {.threads = 2});
  EXPECT_EQ(slurp(directory / "one.csv"), slurp(directory / "two.csv"));
  EXPECT_EQ(one.rays_hash, two.rays_hash);
  EXPECT_EQ(one.rays_hash, h5.rays_hash);
  EXPECT_EQ(one.rays, 17000);
  for (const int lanes : {1, 2, 4, 8}) {
    EXPECT_EQ(trace(directory / "in.h5", directory / "lanes.h5", transport, {.lanes = lanes}).rays_hash, one.rays_hash)
        << lanes;
  }

  const TableBlock block = open_table(directory / "two.h5", traced_ray_schema(transport.chart().card()))->read(20000);
  const std::vector<TracedRay> ends = traced_rays_of(block);
  ASSERT_EQ(ends.size(), rays.size());
  std::int64_t escaped = 0;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    EXPECT_EQ(ends[k].id, rays[k].id);
    EXPECT_EQ(ends[k].status == Status::outside_domain, k % 50 == 7);
    if (ends[k].status == Status::escaped) ++escaped;
  }
  EXPECT_EQ(one.with_status[static_cast<std::size_t>(Status::escaped)], escaped);
  EXPECT_EQ(one.with_status[static_cast<std::size_t>(Status::outside_domain)], 340);
  EXPECT_GT(escaped, 1000);
  EXPECT_GT(one.with_status[static_cast<std::size_t>(Status::captured)], 100);
}

TEST(TraceTable, refuses_rays_off_the_light_cone_unless_asked_to_renormalise) {
  const TemporaryDirectory directory;
  const Transport transport = kerr();
  std::vector<Ray> rays = sample_rays(transport, 5);
  rays[3].start[4] *= 1.0 + 1e-4;
  write_rays(directory / "in.csv", transport, rays);
  const std::string message = message_of<InputError>([&] { return check_rays(directory / "in.csv", transport, {}); });
  EXPECT_NE(message.find("line 5, id " + std::to_string(rays[3].id) + ": off the light cone: null residual 0.000"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("--renormalise"), std::string::npos);
  EXPECT_EQ(check_rays(directory / "in.csv", transport, {.renormalise = true}), 5);
  // The same ray typed with ten digits is light.
  rays[3].start[4] /= 1.0 + 1e-4;
  rays[3].start[4] = std::round(rays[3].start[4] * 1e10) / 1e10;
  write_rays(directory / "in.csv", transport, rays);
  EXPECT_EQ(check_rays(directory / "in.csv", transport, {}), 5);
}

TEST(TraceTable, names_the_two_lines_that_share_an_id) {
  const TemporaryDirectory directory;
  const Transport transport = kerr();
  std::vector<Ray> rays = sample_rays(transport, 5000);
  rays[4567].id = rays[12].id;
  write_rays(directory / "in.csv", transport, rays);
  write_rays(directory / "in.h5", transport, rays);
  const auto refused = [&](const std::string& name) {
    return message_of<InputError>([&] { return check_rays(directory / name, transport, {}); });
  };
  EXPECT_NE(refused("in.csv").find("lines 14 and 4569 have the same id"), std::string::npos) << refused("in.csv");
  EXPECT_NE(refused("in.h5").find("rows 12 and 4567 have the same id"), std::string::npos) << refused("in.h5");
}

TEST(TraceTable, refuses_a_sheet_that_is_neither_side) {
  const TemporaryDirectory directory;
  const Transport transport = kerr();
  std::vector<Ray> rays = sample_rays(transport, 3);
  rays[1].sheet = 2;
  write_rays(directory / "in.csv", transport, rays);
  EXPECT_NE(message_of<InputError>([&] {
              return check_rays(directory / "in.csv", transport, {});
            }).find("sheet 2, needs 1 or -1"),
            std::string::npos);
}

TEST(TraceTable, stops_when_interrupted) {
  const TemporaryDirectory directory;
  const Transport transport = kerr();
  write_rays(directory / "in.csv", transport, sample_rays(transport, 5000));
  int asked = 0;
  const TraceTableSettings settings{.threads = 1, .interrupted = [&asked] { return ++asked > 5; }};
  EXPECT_THROW(trace(directory / "in.csv", directory / "out.csv", transport, settings), Interrupted);
}

TEST(TraceTable, takes_a_table_without_rays) {
  const TemporaryDirectory directory;
  const Transport transport = kerr();
  write_rays(directory / "in.csv", transport, {});
  EXPECT_EQ(trace(directory / "in.csv", directory / "out.csv", transport, {}).rays, 0);
  EXPECT_EQ(slurp(directory / "out.csv"),
            "id,status,sheet,x0,x1,x2,x3,p0,p1,p2,p3,lambda,steps,rejected,null_residual,null_residual_max\n");
}

}  // namespace
}  // namespace xpr
