#include "poinsot/scene/scene_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "poinsot/base/error.h"
#include "poinsot/scene/body_reader.h"
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
    if (const YamlNode* node = fields.find("allow_overlap"))
      scene_.allow_overlap = reader_.boolean(*node, "allow_overlap").value_or(false);
  }

  void read_number(const Fields& fields, const std::string& table, std::string_view key,
                   double& value) {
    const YamlNode* node = fields.find(key);
    if (!node) return;
    faults_.place(std::string(table).append(".").append(key), *node);
    value = reader_.number(*node, key).value_or(value);
  }

  void read_presentation(const YamlNode& node) {
    if (const auto fields = reader_.fields(node, "presentation", kPresentationTable))
      read_number(*fields, "presentation", "frame_rate", scene_.presentation.frame_rate);
  }

  void read_collision(const YamlNode& node) {
    const auto fields = reader_.fields(node, "collision", kCollisionTable);
    if (!fields) return;
    CollisionDef& def = scene_.collision;
    if (const YamlNode* item = fields->find("impact_search"))
      def.impact_search = reader_
                              .named<ImpactSearchKind>(*item, "impact_search", kImpactSearchNames,
                                                       kImpactSearchesLater)
                              .value_or(def.impact_search);
    if (const YamlNode* item = fields->find("contact_solver"))
      def.contact_solver = reader_
                               .named<ContactSolverKind>(*item, "contact_solver",
                                                         kContactSolverNames, kContactSolversLater)
                               .value_or(def.contact_solver);
    if (const YamlNode* item = fields->find("iterations")) {
      faults_.place("collision.iterations", *item);
      def.iterations = reader_.whole(*item, "iterations").value_or(def.iterations);
    }
    read_number(*fields, "collision", "contact_step", def.contact_step);
    read_number(*fields, "collision", "contact_margin", def.contact_margin);
    read_number(*fields, "collision", "push_out_speed", def.push_out_speed);
  }

  void read_simulation(const YamlNode& node) {
    const auto fields = reader_.fields(node, "simulation", kSimulationTable);
    if (!fields) return;
    SimulationDef& def = scene_.simulation;
    if (const YamlNode* item = fields->find("integrator"))
      def.integrator = reader_.named<IntegratorKind>(*item, "integrator", kIntegratorNames, {})
                           .value_or(def.integrator);
    read_number(*fields, "simulation", "step", def.step);
    if (const YamlNode* item = fields->find("gravity")) {
      faults_.place("simulation.gravity", *item);
      def.gravity = reader_.vector(*item, "gravity").value_or(def.gravity);
    }
  }

  void read_bodies(const YamlNode& node) {
    const auto* items = reader_.list(node, "bodies");
    if (!items) return;
    scene_.bodies.reserve(items->size());
    for (const YamlNode* item : *items)
      scene_.bodies.push_back(read_body(
          *item, "bodies[" + std::to_string(scene_.bodies.size()) + "]", faults_, reader_));
  }

  const YamlNode& root_;
  FaultList faults_;
  YamlReader reader_;
  Scene scene_;
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
  const std::string text((std::istreambuf_iterator<char>(stream)),
                         std::istreambuf_iterator<char>());
  if (!stream.is_open() || stream.bad())
    throw Error(file.string() + ": cannot be read: " + std::strerror(errno ? errno : EIO));
  return read_scene_text(text, file.string());
}

}  // namespace poinsot
