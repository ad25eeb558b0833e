#include <gtest/gtest.h>
#include <unistd.h>

#include "core/io/atomic_output.hpp"
#include "core/io/errors.hpp"
#include "tests/core/temporary_directory.hpp"

namespace xpr {
namespace {

using testing::message_of;
using testing::slurp;
using testing::spill;
using testing::TemporaryDirectory;
namespace fs = std::filesystem;

TEST(AtomicFile, appears_whole_on_commit_and_not_before) {
  const TemporaryDirectory directory;
  const fs::path target = directory / "out.csv";
  spill(target, "old");
  {
    AtomicFile file(target);
    spill(file.path(), "new");
    EXPECT_EQ(slurp(target), "old");
    file.commit();
  }
  EXPECT_EQ(slurp(target), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), {}), 1);
}

TEST(AtomicFile, leaves_nothing_behind_when_the_work_fails) {
  const TemporaryDirectory directory;
  EXPECT_THROW(
      {
        AtomicFile file(directory / "out.csv");
        spill(file.path(), "half");
        throw InputError("bad row");
      },
      InputError);
  EXPECT_TRUE(directory.empty());
}

TEST(AtomicFile, refuses_a_path_that_cannot_be_written) {
  const TemporaryDirectory directory;
  EXPECT_NE(message_of<InputError>([&] { AtomicFile(directory / "absent/out.csv"); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { AtomicFile file(directory.path()); }).find("is a directory"),
            std::string::npos);
  spill(directory / "file", "");
  EXPECT_NE(message_of<InputError>([&] { AtomicFile(directory / "file/out.csv"); }).find("Not a directory"),
            std::string::npos);
}

TEST(AtomicFile, keeps_a_symbolic_link_and_replaces_what_it_names) {
  const TemporaryDirectory directory;
  spill(directory / "real.csv", "old");
  fs::create_symlink("real.csv", directory / "link.csv");
  write_file(directory / "link.csv", "new");
  EXPECT_TRUE(fs::is_symlink(directory / "link.csv"));
  EXPECT_EQ(slurp(directory / "real.csv"), "new");
}

TEST(AtomicFile, on_a_full_device_is_a_fault) {
  EXPECT_NE(message_of<FaultError>([] { write_file("/dev/full", "row"); }).find("No space left on device"),
            std::string::npos);
}

TEST(AtomicDirectory, replaces_an_earlier_output_whole) {
  const TemporaryDirectory directory;
  const fs::path target = directory / "report";
  for (const std::string content : {"first", "second"}) {
    AtomicDirectory output(target, "summary.json");
    fs::create_directory(output.path() / "figures");
    spill(output.path() / "figures" / (content + ".svg"), content);
    spill(output.path() / "summary.json", content);
    output.commit();
  }
  EXPECT_EQ(slurp(target / "summary.json"), "second");
  EXPECT_FALSE(fs::exists(target / "figures/first.svg"));
  EXPECT_TRUE(fs::exists(target / "figures/second.svg"));
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), {}), 1);
}

TEST(AtomicDirectory, never_replaces_what_is_not_ours) {
  const TemporaryDirectory directory;
  fs::create_directory(directory / "thesis");
  spill(directory / "thesis/chapter1.tex", "years of work");
  spill(directory / "file", "");
  EXPECT_NE(message_of<InputError>([&] {
              AtomicDirectory(directory / "thesis", "summary.json");
            }).find("holds other files and no summary.json"),
            std::string::npos);
  EXPECT_NE(
      message_of<InputError>([&] { AtomicDirectory(directory / "file", "summary.json"); }).find("is not a directory"),
      std::string::npos);
  EXPECT_EQ(slurp(directory / "thesis/chapter1.tex"), "years of work");
}

TEST(AtomicDirectory, leaves_the_earlier_output_when_the_work_fails) {
  const TemporaryDirectory directory;
  fs::create_directory(directory / "report");
  spill(directory / "report/summary.json", "old");
  {
    AtomicDirectory output(directory / "report/", "summary.json");
    spill(output.path() / "summary.json", "half");
  }
  EXPECT_EQ(slurp(directory / "report/summary.json"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), {}), 1);
}

// 2026-11-22: a second Ctrl-C killed validate before it could remove its hidden directory, which stayed for ever.
TEST(AtomicDirectory, removes_what_a_killed_process_left_and_nothing_else) {
  const TemporaryDirectory directory;
  fs::create_directory(directory / ".report.part.Ab12Cd");
  spill(directory / ".report.part.Ab12Cd/summary.json", "half");
  fs::create_directory(directory / ".report.part.mine");
  fs::create_directory(directory / ".other.part.Ab12Cd");
  AtomicDirectory running(directory / "report", "summary.json");
  EXPECT_FALSE(fs::exists(directory / ".report.part.Ab12Cd"));
  spill(running.path() / "summary.json", "first");
  {
    AtomicDirectory second(directory / "report", "summary.json");
    EXPECT_TRUE(fs::exists(running.path() / "summary.json"));
    EXPECT_NE(second.path(), running.path());
  }
  running.commit();
  EXPECT_EQ(slurp(directory / "report/summary.json"), "first");
  EXPECT_TRUE(fs::exists(directory / ".report.part.mine"));
  EXPECT_TRUE(fs::exists(directory / ".other.part.Ab12Cd"));
}

}  // namespace
}  // namespace xpr
