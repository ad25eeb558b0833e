#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <bit>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "core/io/errors.hpp"
#include "core/io/hdf5_file.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;
using testing::slurp;
using testing::spill;
using testing::TemporaryDirectory;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void write_sample(const std::filesystem::path& path) {
  Hdf5File file = Hdf5File::create(path);
  const std::vector<double> doubles{0.1, -0.0, nan, infinity, 5e-324};
  const std::vector<std::int64_t> integers{1, std::numeric_limits<std::int64_t>::min()};
  const std::vector<std::string> words{"pass", "", "b/M = 5.2 \xce\xb1"};
  const std::array<std::string_view, 2> names{"escaped", "captured"};
  const std::vector<std::int64_t> codes{1, 0, 1};
  file.write("/cases/flat/value", doubles, {.units = "m", .long_name = "a length"});
  file.write("/cases/flat/id", integers, {.units = "1", .long_name = "row"});
  file.write("/cases/flat/label", words, {});
  file.write_enum("/cases/flat/status", codes, names, {});
  file.write("/cases/flat/none", std::span<const double>{}, {});
  file.make_scale("/cases/flat/id", "row");
  file.attach_scale("/cases/flat/value", "/cases/flat/id");
  file.set_attribute("/", "schema", "sample");
  file.set_attribute("/", "schema_version", std::int64_t{3});
  file.set_attribute("/cases/flat", "tolerance", 0.25);
  file.close();
}

TEST(Hdf5File, gives_back_the_same_bits) {
  const TemporaryDirectory directory;
  write_sample(directory / "a.h5");
  const Hdf5File file = Hdf5File::open(directory / "a.h5");
  const std::vector<double> doubles = file.read_doubles("/cases/flat/value");
  ASSERT_EQ(doubles.size(), 5u);
  EXPECT_EQ(doubles[0], 0.1);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(doubles[1]), std::bit_cast<std::uint64_t>(-0.0));
  EXPECT_NE(doubles[2], doubles[2]);
  EXPECT_EQ(doubles[3], infinity);
  EXPECT_EQ(doubles[4], 5e-324);
  EXPECT_EQ(file.read_doubles("/cases/flat/value", 3, 2), (std::vector<double>{infinity, 5e-324}));
  EXPECT_EQ(file.read_integers("/cases/flat/id"),
            (std::vector<std::int64_t>{1, std::numeric_limits<std::int64_t>::min()}));
  EXPECT_EQ(file.read_strings("/cases/flat/label"), (std::vector<std::string>{"pass", "", "b/M = 5.2 \xce\xb1"}));
  EXPECT_EQ(file.read_enum("/cases/flat/status"), (std::vector<std::string>{"captured", "escaped", "captured"}));
  EXPECT_TRUE(file.read_doubles("/cases/flat/none").empty());
  EXPECT_EQ(file.text_attribute("/cases/flat/value", "units"), "m");
  EXPECT_EQ(file.text_attribute("/cases/flat/value", "long_name"), "a length");
  EXPECT_EQ(file.text_attribute("/", "schema"), "sample");
  EXPECT_EQ(file.number_attribute("/", "schema_version"), 3.0);
  EXPECT_EQ(file.number_attribute("/cases/flat", "tolerance"), 0.25);
  EXPECT_EQ(file.members("/cases/flat"), (std::vector<std::string>{"id", "label", "none", "status", "value"}));
  EXPECT_TRUE(file.is_group("/cases"));
  EXPECT_FALSE(file.is_group("/cases/flat/id"));
  EXPECT_FALSE(file.exists("/cases/curved/value"));
}

TEST(Hdf5File, of_equal_content_has_equal_bytes) {
  const TemporaryDirectory directory;
  write_sample(directory / "a.h5");
  timespec pause{1, 100'000'000};  // object times count whole seconds
  nanosleep(&pause, nullptr);
  write_sample(directory / "b.h5");
  EXPECT_EQ(slurp(directory / "a.h5"), slurp(directory / "b.h5"));
}

TEST(Hdf5File, grows_by_blocks) {
  const TemporaryDirectory directory;
  const std::array<std::string_view, 2> names{"escaped", "captured"};
  {
    Hdf5File file = Hdf5File::create(directory / "a.h5");
    file.create_doubles("/rays/x0", {.units = "m", .long_name = "t"}, 4);
    file.create_integers("/rays/id", {}, 4);
    file.create_enum("/rays/status", names, {}, 4);
    for (std::int64_t block = 0; block < 3; ++block) {
      const std::vector<double> x(3, 0.5 * static_cast<double>(block));
      const std::vector<std::int64_t> id{3 * block, 3 * block + 1, 3 * block + 2};
      const std::vector<std::int64_t> status{0, 1, 0};
      file.append("/rays/x0", x);
      file.append("/rays/id", id);
      file.append("/rays/status", status);
    }
    file.close();
  }
  const Hdf5File file = Hdf5File::open(directory / "a.h5");
  EXPECT_EQ(file.size("/rays/x0"), 9u);
  EXPECT_EQ(file.read_doubles("/rays/x0", 2, 3), (std::vector<double>{0.0, 0.5, 0.5}));
  EXPECT_EQ(file.read_integers("/rays/id"), (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(file.read_enum("/rays/status")[4], "captured");
}

TEST(Hdf5File, says_what_is_wrong_in_one_line) {
  const TemporaryDirectory directory;
  write_sample(directory / "a.h5");
  const Hdf5File file = Hdf5File::open(directory / "a.h5");
  const auto error = [](const auto& action) { return message_of<InputError>(action); };
  EXPECT_NE(error([&] { return file.read_doubles("/cases/flat/nothing"); }).find("no dataset /cases/flat/nothing"),
            std::string::npos);
  EXPECT_NE(error([&] { return file.read_doubles("/cases/flat/id"); }).find("/cases/flat/id is int64, needs float64"),
            std::string::npos);
  EXPECT_NE(error([&] { return file.read_integers("/cases/flat/value"); }).find("is float64, needs int64"),
            std::string::npos);
  EXPECT_NE(
      error([&] { return file.read_strings("/cases/flat/value"); }).find("is float64, needs variable-length text"),
      std::string::npos);
  EXPECT_NE(error([&] { return file.read_doubles("/cases/flat/value", 4, 2); }).find("has 5 values where 6 are needed"),
            std::string::npos);
  EXPECT_NE(error([&] { return file.read_doubles("/cases"); }).find("/cases is not a dataset"), std::string::npos);
  for (const std::string& message : {error([&] { return Hdf5File::open(directory / "absent.h5"); }),
                                     error([&] { return Hdf5File::create(directory / "absent/a.h5"); })}) {
    EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Hdf5File, refuses_what_is_truncated_or_no_hdf5_at_all) {
  const TemporaryDirectory directory;
  write_sample(directory / "a.h5");
  const std::string whole = slurp(directory / "a.h5");
  spill(directory / "short.h5", whole.substr(0, whole.size() / 2));
  spill(directory / "text.h5", "id,x0\n1,2\n");
  spill(directory / "empty.h5", "");
  EXPECT_NE(message_of<InputError>([&] { return Hdf5File::open(directory / "short.h5"); }).find("truncated file"),
            std::string::npos);
  EXPECT_NE(
      message_of<InputError>([&] { return Hdf5File::open(directory / "text.h5"); }).find("file signature not found"),
      std::string::npos);
  EXPECT_NE(
      message_of<InputError>([&] { return Hdf5File::open(directory / "empty.h5"); }).find("cannot be read as HDF5"),
      std::string::npos);
}

// In a process of its own, which HDF5 leaves with chunks that it can neither write nor free. A limit on the size of
// files stands in for a full disk: the write fails in the same call, with EFBIG for ENOSPC.
[[noreturn]] void write_beyond_the_limit(const std::filesystem::path& path) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tight{.rlim_cur = 100'000, .rlim_max = 100'000};
  setrlimit(RLIMIT_FSIZE, &tight);
  const std::string message = message_of<FaultError>([&] {
    Hdf5File file = Hdf5File::create(path);
    const std::vector<double> many(100'000, 1.0);
    file.create_doubles("/rays/x0", {}, 4096);
    for (int block = 0; block < 20; ++block) file.append("/rays/x0", many);
    file.close();
  });
  std::fputs(message.c_str(), stderr);
  std::_Exit(0);
}

TEST(Hdf5File, calls_a_full_disk_a_fault) {
  const TemporaryDirectory directory;
  EXPECT_EXIT(write_beyond_the_limit(directory / "a.h5"), ::testing::ExitedWithCode(0), "a.h5: .*File too large");
}

}  // namespace
}  // namespace xpr
