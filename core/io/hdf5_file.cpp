#include "core/io/hdf5_file.hpp"

#include <hdf5.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/io/errors.hpp"
#include "core/io/hdf5_handle.hpp"

namespace xpr {

using hdf5::Handle;

namespace {

// What HDF5's error stack says: the deepest entry's words, and the errno that a system call left there, if any.
struct StackStory {
  std::string deepest;
  int error_number = 0;
};

herr_t read_stack_entry(unsigned, const H5E_error2_t* entry, void* data) {
  auto& story = *static_cast<StackStory*>(data);
  if (entry->desc == nullptr) return 0;
  story.deepest = entry->desc;
  if (const char* mark = std::strstr(entry->desc, "errno = ")) story.error_number = std::atoi(mark + 8);
  return 0;
}

StackStory error_story() {
  StackStory story;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, read_stack_entry, &story);
  H5Eclear2(H5E_DEFAULT);
  return story;
}

// HDF5 prints its error stack and cleans up at exit unless told not to; after a full disk that clean-up never ends.
void prepare_library() {
  static const bool prepared = [] {
    H5dont_atexit();
    H5open();
    return true;
  }();
  static_cast<void>(prepared);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* data) {
  static_cast<std::vector<std::string>*>(data)->emplace_back(name);
  return 0;
}

}  // namespace

Hdf5File::Hdf5File(std::filesystem::path path, Id file, bool writing)
    : path_(std::move(path)), file_(file), writing_(writing) {}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), writing_(other.writing_) {}

Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(file_, other.file_);
  std::swap(writing_, other.writing_);
  return *this;
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

Hdf5File Hdf5File::create(const std::filesystem::path& path) {
  prepare_library();
  const Handle creation = hdf5::creation_list(H5P_FILE_CREATE);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  Hdf5File file(path, H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), true);
  if (file.file_ < 0) file.fail("cannot create the file");
  return file;
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  prepare_library();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  Hdf5File file(path, H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), false);
  if (file.file_ < 0) file.fail("cannot be read as HDF5");
  return file;
}

void Hdf5File::fail(const std::string& what) const {
  const StackStory story = error_story();
  if (story.error_number != 0) throw_system_error(path_, what, story.error_number);
  const std::string line = path_.string() + ": " + what + (story.deepest.empty() ? "" : " (" + story.deepest + ")");
  if (writing_) throw FaultError(line);
  throw InputError(line);
}

void Hdf5File::close() {
  if (file_ < 0) return;
  // Flushing first keeps a failure apart from a file that HDF5 can no longer close.
  const bool flushed = !writing_ || H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  const StackStory story = flushed ? StackStory{} : error_story();
  const bool closed = H5Fclose(std::exchange(file_, -1)) >= 0;
  if (!flushed) {
    if (story.error_number != 0) throw_system_error(path_, "cannot write the file", story.error_number);
    throw FaultError(path_.string() + ": cannot write the file (" + story.deepest + ")");
  }
  if (!closed) fail("cannot close the file");
}

void Hdf5File::make_group(const std::string& path) {
  if (exists(path)) return;
  const Handle links = hdf5::links_with_parents();
  const Handle creation = hdf5::creation_list(H5P_GROUP_CREATE);
  const Handle group(H5Gcreate2(file_, path.c_str(), links.id(), creation.id(), H5P_DEFAULT), H5Gclose);
  if (!group.good()) fail("cannot create group " + path);
}

bool Hdf5File::exists(const std::string& path) const {
  if (path == "/") return true;
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    if (H5Lexists(file_, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) {
      H5Eclear2(H5E_DEFAULT);
      return false;
    }
    if (slash == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  const Handle handle(exists(group) ? H5Gopen2(file_, group.c_str(), H5P_DEFAULT) : -1, H5Gclose);
  if (!handle.good()) fail("no group " + group);
  std::vector<std::string> names;
  if (H5Literate(handle.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names) < 0) {
    fail("cannot list group " + group);
  }
  return names;
}

bool Hdf5File::is_group(const std::string& path) const {
  if (!exists(path)) return false;
  const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
  return object.good() && H5Iget_type(object.id()) == H5I_GROUP;
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

}  // namespace xpr
