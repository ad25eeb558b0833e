#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/io/csv.hpp"
#include "core/io/errors.hpp"
#include "core/io/hdf5_file.hpp"
#include "core/io/ray_table.hpp"
#include "metrics/catalogue.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;
using testing::spill;
using testing::TemporaryDirectory;

const Card& kerr() {
  static const auto spacetime = make_spacetime("kerr", "boyer-lindquist");
  return spacetime->card();
}

const std::string header = "id,x0,x1,x2,x3,p0,p1,p2,p3\n";
const std::string good_row = "1,0,10,1.5,0,-1,-1,0,3\n";

std::vector<Ray> read_rays(const std::filesystem::path& path, std::size_t block = 3) {
  const auto reader = open_table(path, ray_schema(kerr()));
  std::vector<Ray> rays;
  for (TableBlock rows = reader->read(block); rows.rows > 0; rows = reader->read(block)) {
    const std::vector<Ray> some = rays_of(rows);
    rays.insert(rays.end(), some.begin(), some.end());
  }
  return rays;
}

std::string refused(const std::string& csv) {
  const TemporaryDirectory directory;
  spill(directory / "in.csv", csv);
  std::string message = message_of<InputError>([&] { read_rays(directory / "in.csv"); });
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_NE(message.find("in.csv: "), std::string::npos) << message;
  return message;
}

#define EXPECT_SAYS(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

TEST(RayTable, takes_columns_in_any_order_and_an_optional_sheet) {
  const TemporaryDirectory directory;
  spill(directory / "in.csv", "p3,p2,p1,p0,x3,x2,x1,x0,sheet,id\n8,7,6,5,4,3,2,1,-1,42\n");
  const std::vector<Ray> rays = read_rays(directory / "in.csv");
  ASSERT_EQ(rays.size(), 1u);
  EXPECT_EQ(rays[0].id, 42);
  EXPECT_EQ(rays[0].sheet, -1);
  EXPECT_EQ(rays[0].start.c, (std::array<double, 8>{1, 2, 3, 4, 5, 6, 7, 8}));
  spill(directory / "plain.csv", header + good_row);
  EXPECT_EQ(read_rays(directory / "plain.csv")[0].sheet, 1);
}

TEST(RayTable, names_what_is_wrong_with_a_header) {
  EXPECT_SAYS(refused(""), "is empty, needs a header row with id,x0");
  EXPECT_SAYS(refused("id,x0,x1,x2,x3,p0,p1,p2\n"), "line 1: column 'p3' is missing");
  EXPECT_SAYS(refused("id,x0,x1,x2,x3,p0,p1,p2,p3,x1\n"), "line 1: column 'x1' appears twice");
  EXPECT_SAYS(refused("id,x0,x1,x2,x3,p0,p1,p2,p3,sheets\n"), "unknown column 'sheets'; did you mean 'sheet'?");
  EXPECT_SAYS(refused("id,x0,x1,x2,x3,p0,p1,p2,p3,temperature\n"), "unknown column 'temperature'");
}

TEST(RayTable, names_line_and_column_of_a_bad_value) {
  EXPECT_SAYS(refused(header + good_row + "2,0,10,1.5,0,-1,-1,0\n"), "line 3: has 8 fields where the header has 9");
  EXPECT_SAYS(refused(header + good_row + "\n"), "line 3: is blank");
  EXPECT_SAYS(refused(header + "1,0,ten,1.5,0,-1,-1,0,3\n"), "line 2, column x1: 'ten' is not a number");
  EXPECT_SAYS(refused(header + "1,0,,1.5,0,-1,-1,0,3\n"), "line 2, column x1: '' is not a number");
  EXPECT_SAYS(refused(header + "1,0,nan,1.5,0,-1,-1,0,3\n"), "column x1: 'nan' needs to be a finite number");
  EXPECT_SAYS(refused(header + "1,0,10,1.5,0,-1,-inf,0,3\n"), "column p1: '-inf' needs to be a finite number");
  EXPECT_SAYS(refused(header + "1.5,0,10,1.5,0,-1,-1,0,3\n"), "column id: '1.5' is not an integer");
  EXPECT_SAYS(refused(header + "1,0,1e999,1.5,0,-1,-1,0,3\n"), "column x1: '1e999' is outside the range of a double");
}

TEST(RayTable, needs_a_name_that_says_its_format) {
  EXPECT_SAYS(message_of<InputError>([] { return table_format("rays.txt"); }), "ends in .csv or .h5");
  EXPECT_EQ(table_format("rays.h5"), TableFormat::hdf5);
  EXPECT_EQ(table_format("rays.hdf5"), TableFormat::hdf5);
  EXPECT_EQ(table_format("/dev/stdout"), TableFormat::csv);
}

std::vector<TracedRay> random_ends() {
  std::mt19937_64 random(5);
  std::vector<TracedRay> ends;
  for (std::int64_t k = 0; k < 1000; ++k) {
    TracedRay end{.id = 1'000'000'007 * k - 500, .status = static_cast<Status>(k % 10), .sheet = k % 3 == 0 ? -1 : 1};
    for (double& c : end.end.c) c = std::bit_cast<double>(random());
    end.lambda = std::bit_cast<double>(random());
    end.steps = k;
    end.rejected = 2 * k;
    end.null_residual = std::numeric_limits<double>::quiet_NaN();
    end.null_residual_max = 1e-16 * static_cast<double>(k);
    ends.push_back(end);
  }
  return ends;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

TEST(RayTable, gives_back_the_same_bits_in_both_formats) {
  const TemporaryDirectory directory;
  const TableSchema schema = traced_ray_schema(kerr());
  const std::vector<TracedRay> ends = random_ends();
  std::vector<std::string> hashes;
  for (const std::string name : {"out.csv", "out.h5"}) {
    const auto writer = create_table(directory / name, table_format(name), schema);
    writer->write(block_of(std::span(ends).first(700)));
    writer->write(block_of(std::span(ends).subspan(700)));
    writer->close();
    const auto reader = open_table(directory / name, schema);
    const TableBlock block = reader->read(5000);
    CanonicalHash hash;
    add_to_hash(hash, schema, block);
    hashes.push_back(hash.hex());
    const std::vector<TracedRay> back = traced_rays_of(block);
    ASSERT_EQ(back.size(), ends.size());
    for (std::size_t k = 0; k < ends.size(); ++k) {
      EXPECT_EQ(back[k].id, ends[k].id);
      EXPECT_EQ(back[k].status, ends[k].status);
      EXPECT_EQ(back[k].sheet, ends[k].sheet);
      EXPECT_EQ(back[k].steps, ends[k].steps);
      EXPECT_EQ(back[k].rejected, ends[k].rejected);
      EXPECT_TRUE(same_bits(back[k].lambda, ends[k].lambda));
      EXPECT_TRUE(same_bits(back[k].null_residual_max, ends[k].null_residual_max));
      for (std::size_t i = 0; i < 8; ++i) EXPECT_TRUE(same_bits(back[k].end[i], ends[k].end[i]));
    }
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

// A good table of starts in HDF5, with one thing done to it before it is closed.
std::string refused_hdf5(const std::function<void(Hdf5File&)>& spoil, const std::string& leave_out = "") {
  const TemporaryDirectory directory;
  {
    Hdf5File file = Hdf5File::create(directory / "in.h5");
    const std::vector<std::int64_t> ids{0, 1};
    const std::vector<double> values{1.0, 2.0};
    file.make_group("/rays");
    if (leave_out != "id") file.write("/rays/id", ids, {});
    for (const std::string name : {"x0", "x1", "x2", "x3", "p0", "p1", "p2", "p3"}) {
      if (name != leave_out) file.write("/rays/" + name, values, {});
    }
    spoil(file);
    file.close();
  }
  return message_of<InputError>([&] { read_rays(directory / "in.h5"); });
}

TEST(RayTable, names_what_is_wrong_with_an_hdf5_table) {
  const std::vector<double> three{1.0, 2.0, 3.0};
  const std::vector<std::int64_t> integers{1, 2};
  const std::vector<double> with_nan{1.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(refused_hdf5([](Hdf5File&) {}), "no exception");
  EXPECT_SAYS(refused_hdf5([](Hdf5File&) {}, "p2"), "dataset /rays/p2 is missing");
  EXPECT_SAYS(refused_hdf5([](Hdf5File&) {}, "id"), "dataset /rays/id is missing");
  EXPECT_SAYS(refused_hdf5([&](Hdf5File& file) { file.write("/rays/x1", three, {}); }, "x1"),
              "dataset /rays/x1 has 3 values where /rays/id has 2");
  EXPECT_SAYS(refused_hdf5([&](Hdf5File& file) { file.write("/rays/x1", integers, {}); }, "x1"),
              "dataset /rays/x1 is int64, needs float64");
  EXPECT_SAYS(refused_hdf5([&](Hdf5File& file) { file.write("/rays/x1", with_nan, {}); }, "x1"),
              "dataset /rays/x1, row 1: 'nan' needs to be a finite number");
  EXPECT_SAYS(refused_hdf5([&](Hdf5File& file) { file.make_group("/rays/x1"); }, "x1"), "/rays/x1 is not a dataset");
  EXPECT_SAYS(refused_hdf5([&](Hdf5File& file) { file.write("/rays/x4", with_nan, {}); }), "unknown column 'x4'");
  const TemporaryDirectory directory;
  Hdf5File::create(directory / "in.h5").close();
  EXPECT_SAYS(message_of<InputError>([&] { read_rays(directory / "in.h5"); }), "no group /rays");
}

TEST(RayTable, finds_an_id_that_occurs_twice) {
  IdCheck rising;
  for (std::int64_t k = -5; k < 100; ++k) rising.add(k);
  EXPECT_FALSE(rising.duplicate());
  IdCheck mixed;
  for (const std::int64_t id : {7, 3, 9, 3, 1}) mixed.add(id);
  EXPECT_EQ(mixed.duplicate(), 3);
}

}  // namespace
}  // namespace xpr
