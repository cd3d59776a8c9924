#include "files/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <utility>

#include "files/error.hpp"
#include "files/interrupts.hpp"

namespace app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_write(const std::string& name, int error) {
  throw InputError(name + ": cannot be written: " + (error ? std::strerror(error) : "unknown reason"));
}

std::optional<struct stat> status(const std::string& path) {
  struct stat found;
  if (stat(path.c_str(), &found) != 0) return std::nullopt;
  return found;
}

bool same_file(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

bool names_open_file(const std::string& path) {
  std::error_code error;
  const std::string folder = fs::canonical(folder_of(path), error).string();
  return folder.rfind("/proc/", 0) == 0;
}

// What links lead to, which need not be there. The last one, of a descriptor, is kept.
std::string behind_links(const std::string& name) {
  constexpr int kMost = 40;
  fs::path path = name;
  std::error_code error;
  for (int i = 0; fs::is_symlink(path, error) && !names_open_file(path.string()); ++i) {
    if (i == kMost) fail_to_write(name, ELOOP);
    path = path.parent_path() / fs::read_symlink(path, error);
    if (error) fail_to_write(name, error.value());
  }
  return path.string();
}

#ifdef STATX_ATTR_MOUNT_ROOT
std::uint64_t attributes(const std::string& path) {
  struct statx file;
  return statx(AT_FDCWD, path.c_str(), 0, STATX_TYPE, &file) == 0 ? file.stx_attributes : 0;
}
#endif

// Whether another file may be renamed to its place. What is only known then costs the run, no file.
void check_replaceable(const OutputTarget& target) {
#ifdef STATX_ATTR_MOUNT_ROOT
  constexpr std::uint64_t kFixed = STATX_ATTR_IMMUTABLE | STATX_ATTR_APPEND;
  if (attributes(folder_of(target.path)) & kFixed) fail_to_write(target.name, EPERM);
  if (!target.now) return;
  const std::uint64_t file = attributes(target.path);
  if (file & STATX_ATTR_MOUNT_ROOT)
    throw InputError(
        target.name +
        ": cannot be written: it is a mount point, and no complete file can take its place; mount "
        "its folder, or write to - and redirect that");
  if (file & kFixed) fail_to_write(target.name, EPERM);
#endif
  // In a folder such as /tmp, where everybody renames what is his own.
  const uid_t user = geteuid();
  if (target.now && (target.folder->st_mode & S_ISVTX) && user != 0 && target.now->st_uid != user &&
      target.folder->st_uid != user)
    fail_to_write(target.name, EPERM);
}

void check_permissions(const OutputTarget& target) {
  const auto may = [&](const std::string& path, int how) {
    if (faccessat(AT_FDCWD, path.c_str(), how, AT_EACCESS) != 0) fail_to_write(target.name, errno);
  };
  if (target.kind == OutputTarget::Kind::standard) return;
  if (target.now) may(target.path, W_OK);
  if (target.kind == OutputTarget::Kind::in_place) return;
  if (!target.folder) may(folder_of(target.path), F_OK);
  if (!S_ISDIR(target.folder->st_mode)) fail_to_write(target.name, ENOTDIR);
  may(folder_of(target.path), W_OK | X_OK);
  check_replaceable(target);
}

// As the file that it takes the place of; what the system does not allow is left.
void take_mode(int descriptor, const struct stat& old) {
  if (old.st_uid != geteuid() && fchown(descriptor, old.st_uid, -1) != 0) errno = 0;
  if (old.st_gid != getegid() && fchown(descriptor, -1, old.st_gid) != 0) errno = 0;
  if (fchmod(descriptor, old.st_mode & 07777) != 0) errno = 0;
}

}  // namespace

bool OutputTarget::is(const struct stat& file) const { return now && same_file(*now, file); }

bool OutputTarget::is_same(const OutputTarget& other) const {
  if (kind == Kind::standard || other.kind == Kind::standard) return kind == other.kind;
  if (path == other.path) return true;
  if (now && other.now) return !S_ISCHR(now->st_mode) && same_file(*now, *other.now);
  return !now && !other.now && same_file(*folder, *other.folder) &&
         fs::path(path).filename() == fs::path(other.path).filename();
}

OutputTarget output_target(const std::string& name) {
  using Kind = OutputTarget::Kind;
  struct stat out;
  const bool has_out = fstat(STDOUT_FILENO, &out) == 0;
  if (name == "-") return {Kind::standard, "stdout", "", has_out ? std::optional(out) : std::nullopt, {}};
  OutputTarget target{Kind::beside, name, behind_links(name), {}, {}};
  target.now = status(target.path);
  if (target.now && S_ISDIR(target.now->st_mode)) fail_to_write(name, EISDIR);
  if (target.now && has_out && same_file(*target.now, out))
    target.kind = Kind::standard;
  else if (target.now && (!S_ISREG(target.now->st_mode) || names_open_file(target.path)))
    target.kind = Kind::in_place;
  else
    target.folder = status(folder_of(target.path));
  check_permissions(target);
  return target;
}

Output::~Output() {
  if (file_ && file_ != stdout) std::fclose(file_);
  if (!unfinished_.empty()) discard_unfinished(unfinished_);
}

void Output::fail(int error) { fail_to_write(target_.name, error); }

void Output::open_beside() {
  const int descriptor = create_unfinished(folder_of(target_.path), unfinished_);
  if (descriptor < 0) fail(errno);
  if (target_.now) take_mode(descriptor, *target_.now);
  file_ = fdopen(descriptor, "wb");
}

void Output::open() {
  errno = 0;
  if (target_.kind == OutputTarget::Kind::standard)
    file_ = stdout;
  else if (target_.kind == OutputTarget::Kind::in_place)
    file_ = std::fopen(target_.path.c_str(), "ab");
  else
    open_beside();
  if (!file_) fail(errno);
}

void Output::write(std::string_view text) {
  if (!file_) open();
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(errno);
}

void Output::flush() {
  if (finished_) return;
  if (!file_) open();
  errno = 0;
  if (std::fflush(file_) != 0) fail(errno);
}

void Output::finish() {
  flush();
  if (finished_) return;
  if (is_replaced_at_end() && fsync(fileno(file_)) != 0 && errno != EINVAL) fail(errno);
  std::FILE* file = std::exchange(file_, nullptr);
  finished_ = true;
  if (file != stdout && std::fclose(file) != 0) fail(errno);
}

void Output::publish() {
  finish();
  if (unfinished_.empty()) return;
  if (publish_unfinished({{unfinished_, target_.path}}) != 1) fail(errno);
  published();
}

std::string format(const char* pattern, ...) {
  va_list arguments, again;
  va_start(arguments, pattern);
  va_copy(again, arguments);
  std::string text(std::size_t(std::vsnprintf(nullptr, 0, pattern, arguments)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  va_end(arguments);
  return text;
}

}  // namespace app
