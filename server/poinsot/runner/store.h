// The store: what a daemon keeps on disk, by name. One directory per world:
//
//   <directory>/<world>/<name>.checkpoint      <directory>/<world>/<name>.log
//
// Names are words of letters, digits, '_', '-' and '.', not beginning with '.', so that none leads
// out of the directory, and what begins with '.' is nobody's but the store's. Any thread but the
// loop may use it: every call waits for the disk.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "poinsot/presentation/checkpoint.h"
#include "poinsot/presentation/store_name.h"

namespace poinsot {

struct StoredFile {
  std::string name;
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type written;
};

class Store {
 public:
  // Makes nothing: directories are made when something is written.
  Store(std::filesystem::path directory, const std::string& world);

  // $POINSOT_DATA_DIR, else $XDG_STATE_HOME/poinsot, else ~/.local/state/poinsot. Throws Error if
  // the environment names none.
  static std::filesystem::path default_directory();

  const std::filesystem::path& directory() const { return directory_; }  // of this world
  // These throw Error for what is no name.
  std::filesystem::path checkpoint_file(std::string_view name) const;
  std::filesystem::path log_file(std::string_view name) const;

  // Under the checkpoint's own name; one that is there is replaced. It is then the newest by
  // its file's time, whatever the clock says. Throws std::runtime_error.
  void save(const Checkpoint& checkpoint) const;
  // Throws Error that names what is wrong, and for a name that is not there the nearest.
  std::shared_ptr<const Checkpoint> load(std::string_view name) const;
  // The newest that can be read, or nothing; why newer ones could not is appended to `faults`.
  std::shared_ptr<const Checkpoint> load_newest(std::vector<std::string>& faults) const;

  std::vector<StoredFile> checkpoints() const;  // newest first
  std::vector<StoredFile> logs() const;

  // Removes all but the newest `keep` checkpoints of the autosaves.
  void prune_autosaves(std::size_t keep) const;

 private:
  std::filesystem::path directory_;
};

}  // namespace poinsot
