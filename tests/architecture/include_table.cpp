#include "include_rules.h"

namespace poinsot {

namespace {

// Physics knows no clock and no thread of its own, and is silent.
constexpr std::string_view kSilent = "chrono ctime thread iostream fstream sys/time.h unistd.h";

}  // namespace

// In the order of dependence: a module includes only what stands above it.
const std::vector<ModuleRule>& module_rules() {
  static const std::vector<ModuleRule> rules = {
      // module, may include, libraries, never
      {"base", "", "", ""},
      {"math", "base", "", kSilent},
      {"program", "base", "cli11 spdlog json", ""},
      {"scene", "base math", "yaml-cpp qhull", "chrono ctime thread iostream"},
      {"protocol", "base math scene", "", kSilent},
      {"wire", "base math scene protocol msg", "dds", ""},
      {"simulation", "base math scene", "", kSilent},
      {"contact", "base math scene simulation", "", kSilent},
      {"collision", "base math scene simulation contact", "fcl", kSilent},
      {"presentation", "base math scene simulation contact collision protocol", "",
       "ctime thread iostream fstream sys/time.h unistd.h"},
      {"runner", "base math scene simulation contact collision presentation protocol program",
       "cli11 spdlog json", ""},
      {"study", "base math scene simulation contact collision presentation protocol program runner",
       "cli11 spdlog json", ""},
      {"service",
       "base math scene simulation contact collision presentation protocol program runner wire",
       "cli11 spdlog json", ""},
      {"server_main",
       "base math scene simulation contact collision presentation protocol program runner study "
       "wire service",
       "cli11 spdlog json", ""},
      {"client", "base math protocol wire", "", ""},
      {"cli", "base math protocol wire program client", "cli11 spdlog json", ""},
      {"client_main", "base math protocol wire program client cli", "cli11 spdlog json", ""},
      {"examples", "base math protocol client", "", ""},
  };
  return rules;
}

const std::vector<LibraryRule>& library_rules() {
  static const std::vector<LibraryRule> rules = {
      // library, include prefixes, only in files of these names
      {"eigen", "Eigen/*", ""},
      {"yaml-cpp", "yaml-cpp/*", "scene_file* yaml_*"},
      {"qhull", "libqhull* qhull/*", "convex_hull"},
      {"fcl", "fcl/* ccd/* octomap/*", "proximity_fcl mesh_bvh"},
      {"dds", "fastdds/* fastrtps/* fastcdr/*", ""},
      {"cli11", "CLI/*", ""},
      {"spdlog", "spdlog/* fmt/*", ""},
      {"json", "nlohmann/*", ""},
  };
  return rules;
}

}  // namespace poinsot
