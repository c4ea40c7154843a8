#include "poinsot/scene/body_reader.h"

#include <vector>

#include "poinsot/scene/mass_properties.h"
#include "poinsot/scene/pose_reader.h"
#include "poinsot/scene/shape_reader.h"

namespace poinsot {
namespace {

class BodyReader {
 public:
  BodyReader(const YamlNode& node, const std::string& path, FaultList& faults, YamlReader& reader)
      : node_(node), path_(path), faults_(faults), reader_(reader) {}

  BodyDef read() {
    body_.where = faults_.where(node_);
    faults_.place(path_, node_);
    const std::optional<Fields> fields = reader_.fields(node_, "a body", kBodyTable);
    if (!fields) {
      distrust_all();
      return body_;
    }
    read_name(*fields);
    if (const YamlNode* node = fields->find("static"))
      body_.is_static = reader_.boolean(*node, "static").value_or(false);
    if (const YamlNode* node = fields->find("kinematic")) {
      faults_.place(path_ + ".kinematic", *node);
      body_.is_kinematic = reader_.boolean(*node, "kinematic").value_or(false);
    }
    read_motion(*fields);
    if (const YamlNode* node = fields->find("material")) read_material(*node);
    if (const YamlNode* node = fields->find("drag")) read_drag(*node);
    read_shapes(*fields);
    read_mass(*fields);
    return body_;
  }

 private:
  void distrust_all() {
    for (const char* key : {".name", ".mass"}) faults_.distrust(path_ + key);
  }

  void read_name(const Fields& fields) {
    const YamlNode* node = reader_.required(fields, node_, "a body", "name");
    const auto name = node ? reader_.text(*node, "name") : std::nullopt;
    if (node) faults_.place(path_ + ".name", *node);
    if (name)
      body_.name = *name;
    else
      faults_.distrust(path_ + ".name");
  }

  // Pose and velocities ---------------------------------------------------------------------------

  void read_motion(const Fields& fields) {
    read_pose(fields, path_, body_.pose, faults_, reader_);
    read_vector(fields, "linear_velocity", path_, body_.linear_velocity, faults_, reader_);
    read_vector(fields, "angular_velocity", path_, body_.angular_velocity, faults_, reader_);
  }

  void read_material(const YamlNode& node) {
    const auto fields = reader_.fields(node, "material", kMaterialTable);
    if (!fields) return;
    const std::string path = path_ + ".material";
    read_number(*fields, "friction", path, body_.material.friction, faults_, reader_);
    read_number(*fields, "restitution", path, body_.material.restitution, faults_, reader_);
  }

  void read_drag(const YamlNode& node) {
    const std::string path = path_ + ".drag";
    faults_.place(path, node);
    const auto fields = reader_.fields(node, "drag", kDragTable);
    if (!fields) return;
    read_number(*fields, "linear", path, body_.drag.linear, faults_, reader_);
    read_number(*fields, "quadratic", path, body_.drag.quadratic, faults_, reader_);
    read_number(*fields, "angular", path, body_.drag.angular, faults_, reader_);
  }

  // Shapes ----------------------------------------------------------------------------------------

  void read_shapes(const Fields& fields) {
    const YamlNode* one = fields.find("shape");
    const YamlNode* many = fields.find("shapes");
    if (one && many)
      faults_.add(*fields.find_key("shapes"), "a body must have either shape or shapes");
    if (one) {
      add_shape(*one, "shape");
    } else if (many) {
      const auto* items = reader_.list(*many, "shapes");
      if (items && items->empty()) faults_.add(*many, "shapes must not be empty");
      sound_ = items && !items->empty();
      if (items)
        for (const YamlNode* item : *items) add_shape(*item, "an entry of shapes");
    }
    for (const ShapeEntry& entry : shapes_) body_.shapes.push_back(entry.def);
  }

  void add_shape(const YamlNode& node, std::string_view what) {
    const std::string path = path_ + ".shapes[" + std::to_string(shapes_.size()) + "]";
    shapes_.push_back(read_shape(node, what, path, faults_, reader_));
    sound_ = sound_ && shapes_.back().sound;
  }

  bool is_dynamic() const { return !body_.is_static && !body_.is_kinematic; }

  // Mass ------------------------------------------------------------------------------------------

  void read_mass(const Fields& fields) {
    const YamlNode* mass_node = fields.find("mass");
    const YamlNode* density_node = fields.find("density");
    const YamlNode* inertia_node = fields.find("inertia");
    const YamlNode* center_node = fields.find("center_of_mass");
    // 0: not there, or refused.
    const double mass = mass_node ? reader_.positive(*mass_node, "mass", "kg").value_or(0) : 0;
    const double density =
        density_node ? reader_.positive(*density_node, "density", "kg/m³").value_or(0) : 0;
    const auto inertia = inertia_node ? read_inertia(*inertia_node) : std::nullopt;
    if (mass_node && density_node)
      return refuse(*fields.find_key("density"), "a body must have either density or mass");
    if (inertia_node && !mass_node)
      return refuse(*fields.find_key("inertia"), "inertia needs the key 'mass'");
    if (center_node && !inertia_node)
      return refuse(*fields.find_key("center_of_mass"), "center_of_mass needs the key 'inertia'");
    if ((mass_node && mass == 0) || (density_node && density == 0) || (inertia_node && !inertia))
      return faults_.distrust(path_ + ".mass");

    if (mass_node) faults_.place(path_ + ".mass", *mass_node);
    if (density_node) faults_.place(path_ + ".mass", *density_node);
    if (inertia_node) faults_.place(path_ + ".inertia", *inertia_node);
    MassProperties result;
    if (inertia) {
      read_vector(fields, "center_of_mass", path_, result.center_of_mass, faults_, reader_);
      result.mass = mass;
      result.J = *inertia;
    } else {
      result = mass_from_shapes(mass, density);
    }
    if (is_dynamic()) body_.mass_properties = result;
  }

  void refuse(const YamlNode& node, std::string what) {
    faults_.add(node, std::move(what), path_ + ".mass");
  }

  std::optional<Mat3> read_inertia(const YamlNode& node) {
    const auto fields = reader_.fields(node, "inertia", kInertiaTable);
    if (!fields) return std::nullopt;
    Mat3 J = Mat3::Zero();
    bool complete = true;
    auto read = [&](std::string_view key, int i, int j) {
      const YamlNode* value = fields->find(key);
      if (!value && i == j) reader_.required(*fields, node, "inertia", key);
      const auto number = value ? reader_.number(*value, key) : std::optional<double>();
      complete = complete && (number || (!value && i != j));
      J(i, j) = J(j, i) = number.value_or(0);
    };
    read("ixx", 0, 0);
    read("iyy", 1, 1);
    read("izz", 2, 2);
    read("ixy", 0, 1);
    read("ixz", 0, 2);
    read("iyz", 1, 2);
    return complete ? std::optional(J) : std::nullopt;
  }

  // The homogeneous solids of the shapes: of their densities, or scaled to a given mass. 0 for
  // mass or density means that it is not given.
  MassProperties mass_from_shapes(double mass, double density) {
    if (!is_dynamic()) return {};
    if (shapes_.empty() && sound_) {
      faults_.add(node_,
                  mass > 0 ? "a body without a shape needs the key 'inertia'"
                           : "a body that is neither static nor kinematic needs a shape with a "
                             "density, or mass and "
                             "inertia",
                  path_ + ".mass");
      return {};
    }
    bool any_density = false, all_densities = true;
    for (const ShapeEntry& entry : shapes_) {
      any_density = any_density || entry.has_density;
      all_densities = all_densities && entry.has_density;
      // Half-spaces and meshes have no mass; validate() refuses them on a body that has one.
      if (!entry.sound || std::holds_alternative<HalfSpace>(entry.def.shape) ||
          std::holds_alternative<Mesh>(entry.def.shape))
        sound_ = false;
    }
    if (mass > 0 && any_density)
      refuse(node_, "a body must have either mass or shapes with a density");
    if (mass == 0 && density == 0 && !all_densities)
      refuse(
          node_,
          any_density
              ? "a body that is neither static nor kinematic needs a density for each of its shapes"
              : "a body that is neither static nor kinematic needs density or mass");
    if (!sound_) faults_.distrust(path_ + ".mass");
    if (faults_.distrusted(path_ + ".mass")) return {};
    std::vector<MassProperties> parts;
    for (const ShapeEntry& entry : shapes_) {
      const double rho = mass > 0 ? 1 : entry.has_density ? entry.density : density;
      parts.push_back(transformed(mass_properties(entry.def.shape, rho), entry.def.pose));
    }
    MassProperties sum = combined(parts);
    if (mass > 0) {
      sum.J *= mass / sum.mass;
      sum.mass = mass;
    }
    return sum;
  }

  const YamlNode& node_;
  const std::string& path_;
  FaultList& faults_;
  YamlReader& reader_;
  BodyDef body_;
  std::vector<ShapeEntry> shapes_;
  bool sound_ = true;  // all shapes could be read and have mass properties
};

}  // namespace

BodyDef read_body(const YamlNode& node, const std::string& path, FaultList& faults,
                  YamlReader& reader) {
  return BodyReader(node, path, faults, reader).read();
}

}  // namespace poinsot
