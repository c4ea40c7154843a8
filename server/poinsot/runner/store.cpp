#include "poinsot/runner/store.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <system_error>
#include <tuple>
#include <utility>

#include "poinsot/base/error.h"
#include "poinsot/base/names.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/runner/checkpoint_file.h"

namespace poinsot {
namespace {

constexpr std::string_view kCheckpoint = ".checkpoint", kLog = ".log";

// Newest first; of equal times the longer name, then the later, so that of a series the larger
// number counts.
std::vector<StoredFile> list(const std::filesystem::path& directory, std::string_view extension) {
  std::vector<StoredFile> files;
  std::error_code missing;  // a directory that is not there holds nothing
  for (const auto& entry : std::filesystem::directory_iterator(directory, missing)) {
    std::error_code gone;  // since it was listed
    StoredFile file{entry.path().stem().string(), entry.file_size(gone),
                    entry.last_write_time(gone)};
    if (!gone && entry.path().extension() == extension &&
        entry.symlink_status(gone).type() == std::filesystem::file_type::regular &&
        store_name_fault(file.name).empty())
      files.push_back(std::move(file));
  }
  std::ranges::sort(files, std::greater(), [](const StoredFile& file) {
    return std::tuple(file.written, file.name.size(), std::string_view(file.name));
  });
  return files;
}

std::filesystem::path file_in(const std::filesystem::path& directory, std::string_view name,
                              std::string_view extension) {
  if (const std::string fault = store_name_fault(name); !fault.empty()) throw Error(fault);
  return directory / std::string(name).append(extension);
}

// The clock may have been set back since the others were written. Where it cannot be done the file
// keeps its time.
void make_newest(const std::filesystem::path& file, std::string_view name,
                 const std::vector<StoredFile>& files) {
  const auto other = std::ranges::find_if(files, [&](const auto& f) { return f.name != name; });
  std::error_code ignored;
  if (other == files.end() || std::filesystem::last_write_time(file, ignored) > other->written)
    return;
  constexpr std::chrono::milliseconds kStep(1);  // that file systems tell apart
  std::filesystem::last_write_time(file, other->written + kStep, ignored);
}

}  // namespace

Store::Store(std::filesystem::path directory, const std::string& world)
    : directory_(std::move(directory) / world) {
  if (const std::string fault = store_name_fault(world.substr(0, kMaxStoreName)); !fault.empty())
    throw Error("world " + fault);
}

std::filesystem::path Store::default_directory() {
  const auto variable = [](const char* name) -> std::filesystem::path {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
  };
  if (const auto data = variable("POINSOT_DATA_DIR"); !data.empty()) return data;
  // The XDG rules pass over a path that is not absolute.
  if (const auto state = variable("XDG_STATE_HOME"); state.is_absolute()) return state / "poinsot";
  if (const auto home = variable("HOME"); home.is_absolute())
    return home / ".local" / "state" / "poinsot";
  throw Error("POINSOT_DATA_DIR: not set, and neither is HOME: nowhere to keep checkpoints");
}

std::filesystem::path Store::checkpoint_file(std::string_view name) const {
  return file_in(directory_, name, kCheckpoint);
}

std::filesystem::path Store::log_file(std::string_view name) const {
  return file_in(directory_, name, kLog);
}

void Store::save(const Checkpoint& checkpoint) const {
  const std::filesystem::path file = checkpoint_file(checkpoint.name);
  write_checkpoint(file, checkpoint);
  make_newest(file, checkpoint.name, checkpoints());
}

std::shared_ptr<const Checkpoint> Store::load(std::string_view name) const {
  const std::filesystem::path file = checkpoint_file(name);
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
    return read_checkpoint(file);
  const std::vector<StoredFile> files = checkpoints();
  std::vector<std::string_view> names;
  for (const StoredFile& stored : files) names.push_back(stored.name);
  throw Error("no checkpoint '" + std::string(name) + "'" + did_you_mean(name, names));
}

std::shared_ptr<const Checkpoint> Store::load_newest(std::vector<std::string>& faults) const {
  for (const StoredFile& file : checkpoints()) {
    try {
      return read_checkpoint(checkpoint_file(file.name));
    } catch (const Error& error) {
      faults.push_back(error.what());
    }
  }
  return nullptr;
}

std::vector<StoredFile> Store::checkpoints() const {
  return list(directory_, kCheckpoint);
}

std::vector<StoredFile> Store::logs() const {
  return list(directory_, kLog);
}

void Store::prune_autosaves(std::size_t keep) const {
  std::size_t seen = 0;
  for (const StoredFile& file : checkpoints()) {
    if (!is_autosave_name(file.name) || ++seen <= keep) continue;
    std::error_code gone;  // another daemon may have been faster
    std::filesystem::remove(checkpoint_file(file.name), gone);
  }
}

}  // namespace poinsot
