// Paths for a test's files in a directory of its own process: tests run side by side. Removed with
// all that is in it when the process ends.

#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace poinsot::test {

// A new directory; whoever asks removes it.
inline std::string make_temp_directory() {
  std::string name = (std::filesystem::temp_directory_path() / "poinsot_test_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no directory " + name);
  return name;
}

class TempDirectory {
 public:
  TempDirectory() : path_(make_temp_directory()) {}
  ~TempDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempDirectory(const TempDirectory&) = delete;
  TempDirectory& operator=(const TempDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::filesystem::path temp_path(const std::string& name) {
  static const TempDirectory directory;
  return directory.path() / name;
}

}  // namespace poinsot::test
