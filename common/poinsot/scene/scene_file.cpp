#include "poinsot/scene/scene_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "poinsot/base/error.h"
#include "poinsot/scene/body_reader.h"
#include "poinsot/scene/force_reader.h"
#include "poinsot/scene/pair_reader.h"
#include "poinsot/scene/pose_reader.h"
#include "poinsot/scene/yaml_reader.h"

namespace poinsot {
namespace {

// A world's name from a file's: what may not stand in it becomes '_'.
std::string default_world(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string();
  std::ranges::replace_if(
      name,
      [](char c) {
        return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                 c == '_' || c == '-');
      },
      '_');
  return name.empty() ? "scene" : name;
}

class SceneReader {
 public:
  SceneReader(const YamlNode& root, const std::string& file)
      : root_(root), faults_(file), reader_(faults_) {
    scene_.world = default_world(file);
  }

  Scene read() {
    if (const auto fields = reader_.fields(root_, "a scene", kSceneTable)) {
      read_top(*fields);
      if (const YamlNode* node = fields->find("presentation")) read_presentation(*node);
      if (const YamlNode* node = fields->find("collision")) read_collision(*node);
      if (const YamlNode* node = fields->find("simulation")) read_simulation(*node);
      if (const YamlNode* node = reader_.required(*fields, root_, "a scene", "bodies"))
        read_bodies(*node);
      // Whether a name is that of a body can be said only if all names are known.
      bool names_known = fields->find("bodies") != nullptr && bodies_read_;
      for (std::size_t i = 0; i < scene_.bodies.size() && names_known; ++i)
        names_known = !faults_.distrusted("bodies[" + std::to_string(i) + "].name");
      if (const YamlNode* node = fields->find("springs"))
        read_list(*node, "springs", names_known, scene_.springs, read_spring);
      if (const YamlNode* node = fields->find("wrenches"))
        read_list(*node, "wrenches", names_known, scene_.wrenches, read_wrench);
      if (const YamlNode* node = fields->find("pairs"))
        read_list(*node, "pairs", names_known, scene_.pairs, read_pair);
    }
    faults_.add(validate(scene_), root_);
    if (const auto faults = faults_.sorted(); !faults.empty()) throw_faults(faults);
    return std::move(scene_);
  }

 private:
  void read_top(const Fields& fields) {
    if (const YamlNode* node = fields.find("world")) {
      faults_.place("world", *node);
      scene_.world = reader_.text(*node, "world").value_or(scene_.world);
    }
    if (const YamlNode* node = fields.find("profile"))
      if (const auto profile = reader_.named<Profile>(*node, "profile", kProfileNames, {}))
        scene_.collision = collision_defaults(*profile);
    if (const YamlNode* node = fields.find("allow_overlap"))
      scene_.allow_overlap = reader_.boolean(*node, "allow_overlap").value_or(false);
  }

  void read(const Fields& fields, const std::string& table, std::string_view key, double& value) {
    read_number(fields, key, table, value, faults_, reader_);
  }
  void read(const Fields& fields, const std::string& table, std::string_view key, int& value) {
    const YamlNode* node = fields.find(key);
    if (!node) return;
    faults_.place(table + "." + std::string(key), *node);
    value = reader_.whole(*node, key).value_or(value);
  }

  void read_presentation(const YamlNode& node) {
    if (const auto fields = reader_.fields(node, "presentation", kPresentationTable))
      read(*fields, "presentation", "frame_rate", scene_.presentation.frame_rate);
  }

  void read_collision(const YamlNode& node) {
    const auto fields = reader_.fields(node, "collision", kCollisionTable);
    if (!fields) return;
    CollisionDef& def = scene_.collision;
    if (const YamlNode* item = fields->find("impact_search"))
      def.impact_search =
          reader_.named<ImpactSearchKind>(*item, "impact_search", kImpactSearchNames, {})
              .value_or(def.impact_search);
    if (const YamlNode* item = fields->find("contact_solver"))
      def.contact_solver =
          reader_.named<ContactSolverKind>(*item, "contact_solver", kContactSolverNames, {})
              .value_or(def.contact_solver);
    if (const YamlNode* item = fields->find("sleeping"))
      def.sleeping = reader_.boolean(*item, "sleeping").value_or(def.sleeping);
    read(*fields, "collision", "contact_tolerance", def.contact_tolerance);
    read(*fields, "collision", "max_impacts", def.max_impacts);
    read(*fields, "collision", "threads", def.threads);
    read(*fields, "collision", "contact_step", def.contact_step);
    read(*fields, "collision", "contact_margin", def.contact_margin);
    read(*fields, "collision", "push_out_speed", def.push_out_speed);
    read(*fields, "collision", "contact_band", def.contact_band);
    read(*fields, "collision", "sleep_acceleration", def.sleep_acceleration);
  }

  void read_simulation(const YamlNode& node) {
    const auto fields = reader_.fields(node, "simulation", kSimulationTable);
    if (!fields) return;
    SimulationDef& def = scene_.simulation;
    if (const YamlNode* item = fields->find("integrator"))
      def.integrator = reader_.named<IntegratorKind>(*item, "integrator", kIntegratorNames, {})
                           .value_or(def.integrator);
    read(*fields, "simulation", "step", def.step);
    read(*fields, "simulation", "tolerance", def.tolerance);
    read_vector(*fields, "gravity", "simulation", def.gravity, faults_, reader_);
  }

  void read_bodies(const YamlNode& node) {
    const auto* items = reader_.list(node, "bodies");
    bodies_read_ = items != nullptr;
    if (!items) return;
    scene_.bodies.reserve(items->size());
    for (const YamlNode* item : *items)
      scene_.bodies.push_back(read_body(
          *item, "bodies[" + std::to_string(scene_.bodies.size()) + "]", faults_, reader_));
  }

  template <class Def>
  void read_list(const YamlNode& node, const std::string& key, bool names_known,
                 std::vector<Def>& defs,
                 Def (*read_one)(const YamlNode&, const std::string&, bool, FaultList&,
                                 YamlReader&)) {
    const auto* items = reader_.list(node, key);
    if (!items) return;
    faults_.place(key, node);
    defs.reserve(items->size());
    for (const YamlNode* item : *items)
      defs.push_back(read_one(*item, key + "[" + std::to_string(defs.size()) + "]", names_known,
                              faults_, reader_));
  }

  const YamlNode& root_;
  FaultList faults_;
  YamlReader reader_;
  Scene scene_;
  bool bodies_read_ = false;
};

}  // namespace

Scene read_scene_text(std::string_view text, const std::string& name) {
  const YamlTree tree = parse_yaml(text, name);
  return SceneReader(*tree.root, name).read();
}

Scene read_scene_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw Error(file.string() + ": cannot be read: it is a directory");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  std::array<char, 1 << 16> part;
  // One byte beyond the limit is enough to be refused, and a device may never end.
  while (stream && text.size() <= kMaxYamlText) {
    stream.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.is_open() || stream.bad())
    throw Error(file.string() + ": cannot be read: " + std::strerror(errno ? errno : EIO));
  return read_scene_text(text, file.string());
}

}  // namespace poinsot
