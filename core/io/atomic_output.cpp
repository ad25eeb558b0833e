#include "core/io/atomic_output.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <span>
#include <system_error>
#include <utility>

#include "core/io/errors.hpp"

namespace xpr {
namespace {

namespace fs = std::filesystem;

// A file descriptor, closed when it goes out of scope.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : path_(path), fd_(::open(path.c_str(), flags | O_CLOEXEC)) {
    if (fd_ < 0) throw_system_error(path_, "cannot be opened", errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(fd_); }

  void sync() const {
    // Pipes, and directories of some file systems, know no sync (EINVAL): there is nothing to wait for there.
    if (::fsync(fd_) != 0 && errno != EINVAL && errno != EROFS) throw_system_error(path_, "cannot be synced", errno);
  }
  [[nodiscard]] std::size_t read(std::span<char> buffer) const {
    for (;;) {
      const ssize_t n = ::read(fd_, buffer.data(), buffer.size());
      if (n >= 0) return static_cast<std::size_t>(n);
      if (errno != EINTR) throw_system_error(path_, "cannot be read", errno);
    }
  }
  void write(std::span<const char> bytes) const {
    while (!bytes.empty()) {
      const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
      if (n >= 0) {
        bytes = bytes.subspan(static_cast<std::size_t>(n));
      } else if (errno != EINTR) {
        throw_system_error(path_, "cannot be written", errno);
      }
    }
  }

 private:
  fs::path path_;
  int fd_;
};

fs::path parent_of(const fs::path& path) { return path.parent_path().empty() ? fs::path(".") : path.parent_path(); }

// A name beside the target that says whose it is: ".rays.csv.XXXXXX.part".
std::string aside_pattern(const fs::path& folder, const fs::path& target) {
  return (folder / ("." + target.filename().string() + ".XXXXXX.part")).string();
}

// mkstemp makes files for the owner alone; ours get the rights that any new file of this user gets.
mode_t usual_rights(mode_t wanted) {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return wanted & ~mask;
}

fs::path make_aside_file(const fs::path& folder, const fs::path& target) {
  std::string name = aside_pattern(folder, target);
  const int fd = ::mkstemps(name.data(), 5);
  if (fd < 0) throw_system_error(target, "cannot create a file in " + folder.string(), errno);
  ::fchmod(fd, usual_rights(0666));
  ::close(fd);
  return name;
}

fs::path make_aside_directory(const fs::path& target) {
  // Folders on the way to the target are made; if one cannot be, making the directory in it says why.
  std::error_code made_below;
  fs::create_directories(parent_of(target), made_below);
  // mkdtemp wants the X at the very end.
  std::string name = (parent_of(target) / ("." + target.filename().string() + ".part.XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw_system_error(target, "cannot create a directory in " + parent_of(target).string(), errno);
  }
  ::chmod(name.c_str(), usual_rights(0777));
  return name;
}

// Locks a directory, and returns the descriptor that holds the lock; -1 where another holds it, or where the file
// system knows no locks.
int locked(const fs::path& directory, int how) {
  const int fd = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0 || ::flock(fd, how) == 0) return fd;
  ::close(fd);
  return -1;
}

// A process that was killed had no time to remove its directory aside.
void remove_abandoned(const fs::path& target) {
  const std::string prefix = "." + target.filename().string() + ".part.";
  std::error_code error;
  for (fs::directory_iterator at(parent_of(target), error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.size() != prefix.size() + 6 || !name.starts_with(prefix)) continue;
    const int lock = locked(at->path(), LOCK_EX | LOCK_NB);
    if (lock < 0) continue;
    std::error_code ignored;
    fs::remove_all(at->path(), ignored);
    ::close(lock);
  }
}

void rename_into_place(const fs::path& from, const fs::path& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) throw_system_error(to, "cannot be replaced", errno);
}

// "out/" names the directory "out".
fs::path without_trailing_slash(fs::path path) {
  path = path.lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (target_.filename().empty() || fs::is_directory(status)) {
    throw InputError(target_.string() + ": is a directory, a file name is needed");
  }
  regular_ = !fs::exists(status) || fs::is_regular_file(status);
  if (regular_) {
    // A symbolic link stays a link: what it points to is replaced.
    if (fs::is_symlink(fs::symlink_status(target_, error))) target_ = fs::weakly_canonical(target_);
    if (fs::exists(status) && ::access(target_.c_str(), W_OK) != 0) {
      throw_system_error(target_, "cannot be written", errno);
    }
    aside_ = make_aside_file(parent_of(target_), target_);
  } else {
    aside_ = make_aside_file(fs::temp_directory_path(), target_);
  }
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!aside_.empty()) fs::remove(aside_, ignored);
}

void AtomicFile::write(const std::string& content) const { Descriptor(aside_, O_WRONLY | O_TRUNC).write(content); }

void AtomicFile::commit() {
  if (regular_) {
    Descriptor(aside_, O_RDONLY).sync();
    rename_into_place(aside_, target_);
    aside_.clear();
    Descriptor(parent_of(target_), O_RDONLY | O_DIRECTORY).sync();
    return;
  }
  const Descriptor from(aside_, O_RDONLY);
  const Descriptor to(target_, O_WRONLY);
  std::array<char, 65536> buffer;
  while (const std::size_t n = from.read(buffer)) to.write({buffer.data(), n});
  to.sync();
}

AtomicDirectory::AtomicDirectory(fs::path target, std::string marker)
    : target_(without_trailing_slash(std::move(target))), marker_(std::move(marker)) {
  check_target();
  remove_abandoned(target_);
  do {
    aside_ = make_aside_directory(target_);
    lock_ = locked(aside_, LOCK_EX);
    // Another process may have taken it for an abandoned one before it was locked.
  } while (!fs::exists(aside_));
}

AtomicDirectory::~AtomicDirectory() {
  std::error_code ignored;
  if (!aside_.empty()) fs::remove_all(aside_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

void AtomicDirectory::check_target() const {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) throw InputError(target_.string() + ": is not a directory");
  const bool empty = fs::is_empty(target_, error);
  if (error) throw_system_error(target_, "cannot be read", error.value());
  if (!empty && !fs::exists(target_ / marker_, error)) {
    throw InputError(target_.string() + ": holds other files and no " + marker_ +
                     ", so it is no earlier output to replace; name another directory");
  }
}

void AtomicDirectory::commit() {
  check_target();
  for (const auto& entry : fs::recursive_directory_iterator(aside_)) {
    if (entry.is_directory()) {
      Descriptor(entry.path(), O_RDONLY | O_DIRECTORY).sync();
    } else if (entry.is_regular_file()) {
      Descriptor(entry.path(), O_RDONLY).sync();
    }
  }
  Descriptor(aside_, O_RDONLY | O_DIRECTORY).sync();
  if (fs::exists(target_)) {
    // Both names change in one step, so the target is the old output or the new one at any moment.
    if (::renameat2(AT_FDCWD, aside_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) != 0) {
      // A file system without exchange (some network ones): the old output steps aside first.
      const fs::path old = make_aside_directory(target_);
      rename_into_place(target_, old);
      rename_into_place(aside_, target_);
      aside_ = old;
    }
  } else {
    rename_into_place(aside_, target_);
    aside_.clear();
  }
  Descriptor(parent_of(target_), O_RDONLY | O_DIRECTORY).sync();
  // After an exchange `aside_` names the old output: the destructor removes it.
}

void write_file(const fs::path& target, const std::string& content) {
  AtomicFile file(target);
  file.write(content);
  file.commit();
}

}  // namespace xpr
