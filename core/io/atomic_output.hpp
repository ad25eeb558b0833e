// Output that is complete or absent: written aside, synced to the disk, renamed into place.
//
// What stands at the target is replaced whole, and untouched until then. An object that goes out of scope without
// commit() leaves nothing behind; what a killed process left of a directory, the next output to the same place removes.
// Errors: InputError for a path that cannot be written, FaultError for the disk.
#pragma once

#include <filesystem>
#include <string>

namespace xpr {

/// A file. Where the target is no regular file (a pipe, a device), commit() copies into it instead of renaming.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// Write here, and close before commit().
  [[nodiscard]] const std::filesystem::path& path() const { return aside_; }
  /// Writes the whole content aside.
  void write(const std::string& content) const;
  /// The target is, or will be, a regular file: files may be put beside it.
  [[nodiscard]] bool regular() const { return regular_; }
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path aside_;
  bool regular_ = true;
};

/// A directory. One that stands at the target is replaced only where it is empty or holds a file named `marker`, that
/// is, where it is an earlier output of ours; anything else is refused at construction, before any work is done.
class AtomicDirectory {
 public:
  AtomicDirectory(std::filesystem::path target, std::string marker);
  AtomicDirectory(const AtomicDirectory&) = delete;
  AtomicDirectory& operator=(const AtomicDirectory&) = delete;
  ~AtomicDirectory();

  /// Write here.
  [[nodiscard]] const std::filesystem::path& path() const { return aside_; }
  void commit();

 private:
  void check_target() const;

  std::filesystem::path target_;
  std::string marker_;
  std::filesystem::path aside_;
  int lock_ = -1;  // on the directory aside, while this lives: a directory that nobody has locked is nobody's
};

/// Writes a small file whole, aside and renamed.
void write_file(const std::filesystem::path& target, const std::string& content);

}  // namespace xpr
