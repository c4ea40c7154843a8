#include "poinsot/runner/whole_file.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>

#include "poinsot/base/error.h"
#include "poinsot/runner/file_handle.h"

namespace poinsot {
namespace {

constexpr mode_t kReadableByAll = 0644;

constexpr std::string_view kPartial = ".partial";

// The name ".<file>.<process>.partial": no checkpoint or log begins with a dot.
std::filesystem::path partial(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  name.insert(0, 1, '.').append(".").append(std::to_string(::getpid())).append(kPartial);
  return file.parent_path() / name;
}

// Who writes has it locked until it has its last name. Numbers of processes do not tell who died:
// they come again, and mean another one in another container.
bool lock(int descriptor) {
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

// What processes that died while they wrote have left behind.
void remove_left_partials(const std::filesystem::path& directory) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with('.') || !name.ends_with(kPartial)) continue;
    const FileHandle left(
        ::open(entry.path().c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC));
    if (left.is_open() && lock(left.get())) ::unlink(entry.path().c_str());
  }
}

}  // namespace

void write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  const std::filesystem::path temporary = partial(file);
  const auto fail = [&](int error) {
    ::unlink(temporary.c_str());
    throw std::runtime_error("cannot write '" + file.string() + "': " + std::strerror(error));
  };
  const std::filesystem::path directory =
      file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) fail(error.value());
  remove_left_partials(directory);

  const FileHandle handle(::open(
      temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, kReadableByAll));
  // Not every file system can lock; it is then removed by nobody else either.
  if (handle.is_open()) lock(handle.get());
  if (!handle.is_open() || !write_all(handle.get(), bytes) || !bring_to_disk(handle.get()) ||
      std::rename(temporary.c_str(), file.c_str()) != 0)
    fail(errno);
  // The name lasts only when the directory is on the disk as well; some file systems cannot say.
  const FileHandle names(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (names.is_open()) ::fsync(names.get());
}

std::vector<std::byte> read_whole_file(const std::filesystem::path& file, std::size_t most) {
  const auto fail = [&](const std::string& why) -> void {
    throw Error(file.string() + ": cannot be read: " + why);
  };
  const FileHandle handle(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  struct stat status {};
  if (!handle.is_open() || ::fstat(handle.get(), &status) != 0) fail(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) fail("it is not a file");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > most) fail("it has more than " + std::to_string(most) + " bytes");

  std::vector<std::byte> bytes(size);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::read(handle.get(), bytes.data() + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(std::strerror(errno));
    if (count == 0) break;  // it has become shorter
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace poinsot
