#include <span>

#include "poinsot/base/limits.h"
#include "poinsot/wire/checks.h"
#include "poinsot/wire/convert.h"

namespace poinsot {
namespace {

using Parameters = std::array<double, 4>;

void assign(msg::v1::PoseValue& out, const Pose& pose) {
  poinsot::assign(out.position(), pose.c);
  poinsot::assign(out.orientation(), pose.q);
}

Pose pose_from(Checks& checks, const msg::v1::PoseValue& in, std::string_view name) {
  const Pose pose{from(in.position()), from(in.orientation())};
  checks.vector(pose.c, std::string(name) + ".position");
  checks.unit(pose.q, std::string(name) + ".orientation");
  return pose;
}

// Shape → parameters. Convex shapes and meshes have none.
struct ToParameters {
  Parameters operator()(const Sphere& s) const { return {s.radius, 0, 0, 0}; }
  Parameters operator()(const Box& s) const { return {s.size.x(), s.size.y(), s.size.z(), 0}; }
  Parameters operator()(const Capsule& s) const { return {s.radius, s.length, 0, 0}; }
  Parameters operator()(const Cylinder& s) const { return {s.radius, s.length, 0, 0}; }
  Parameters operator()(const Cone& s) const { return {s.radius, s.length, 0, 0}; }
  Parameters operator()(const Ellipsoid& s) const {
    return {s.semi_axes.x(), s.semi_axes.y(), s.semi_axes.z(), 0};
  }
  Parameters operator()(const Convex&) const { return {}; }
  Parameters operator()(const HalfSpace& s) const {
    return {s.normal.x(), s.normal.y(), s.normal.z(), s.offset};
  }
  Parameters operator()(const Mesh&) const { return {}; }
};

double length(Checks& checks, double value, std::string_view name) {
  checks.number(value, name);
  checks.require(value > 0, std::string(name) + " is not positive");
  return value;
}

Vec3 lengths(Checks& checks, const Parameters& p, std::string_view name) {
  return {length(checks, p[0], name), length(checks, p[1], name), length(checks, p[2], name)};
}

std::string put_convex(const Convex& convex, msg::v3::ShapeInfo& out) {
  std::size_t indices = 0;
  for (const Convex::Face& face : convex.faces) indices += 1 + face.loop.size();
  if (convex.vertices.size() > kMaxVertices || indices > kMaxFaceIndices)
    return "convex shape with more than " + std::to_string(kMaxVertices) + " vertices";
  out.vertices().resize(convex.vertices.size());
  for (std::size_t i = 0; i < convex.vertices.size(); ++i)
    poinsot::assign(out.vertices()[i], convex.vertices[i]);
  out.face_loops().clear();
  for (const Convex::Face& face : convex.faces) {
    out.face_loops().push_back(static_cast<std::uint32_t>(face.loop.size()));
    for (const int corner : face.loop)
      out.face_loops().push_back(static_cast<std::uint32_t>(corner));
  }
  return {};
}

std::string put_mesh(const Mesh& mesh, msg::v3::ShapeInfo& out) {
  if (mesh.vertices.size() > kMaxMeshVertices || mesh.triangles.size() > kMaxTriangles)
    return "mesh with more than " + std::to_string(kMaxMeshVertices) + " vertices or " +
           std::to_string(kMaxTriangles) + " triangles";
  out.vertices().resize(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    poinsot::assign(out.vertices()[i], mesh.vertices[i]);
  out.triangles().clear();
  out.triangles().reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle) out.triangles().push_back(static_cast<std::uint32_t>(corner));
  return {};
}

// Normal and offset of the plane through a loop. Source: Newell's method (Sutherland et al. 1974).
void fit_plane(Checks& checks, const std::vector<Vec3>& vertices, Convex::Face& face) {
  Vec3 area = Vec3::Zero();
  Vec3 middle = Vec3::Zero();
  const Vec3& base = vertices[static_cast<std::size_t>(face.loop[0])];
  for (std::size_t k = 0; k < face.loop.size(); ++k) {
    const Vec3& a = vertices[static_cast<std::size_t>(face.loop[k])];
    const Vec3& b = vertices[static_cast<std::size_t>(face.loop[(k + 1) % face.loop.size()])];
    area += (a - base).cross(b - base);
    middle += a;
  }
  checks.require(area.squaredNorm() > 0, "a face without area");
  face.normal = area.stableNormalized();
  face.offset = face.normal.dot(middle) / static_cast<double>(face.loop.size());
}

Convex convex_from(Checks& checks, const msg::v3::ShapeInfo& in) {
  Convex convex;
  checks.require(in.vertices().size() >= 4 && in.vertices().size() <= kMaxVertices,
                 "number of vertices is not between 4 and " + std::to_string(kMaxVertices));
  checks.require(in.face_loops().size() <= kMaxFaceIndices, "too many faces");
  if (!checks.ok()) return convex;
  for (const msg::v1::Vector3& vertex : in.vertices()) {
    convex.vertices.push_back(from(vertex));
    checks.vector(convex.vertices.back(), "vertices");
  }
  std::span<const std::uint32_t> rest(in.face_loops());
  while (!rest.empty() && checks.ok()) {
    const std::size_t corners = rest[0];
    checks.require(corners >= 3 && corners < rest.size(), "a face loop of wrong length");
    if (!checks.ok()) break;
    Convex::Face face;
    for (const std::uint32_t corner : rest.subspan(1, corners)) {
      checks.require(corner < convex.vertices.size(), "a face index without vertex");
      face.loop.push_back(static_cast<int>(corner));
    }
    if (checks.ok()) fit_plane(checks, convex.vertices, face);
    convex.faces.push_back(std::move(face));
    rest = rest.subspan(1 + corners);
  }
  checks.require(convex.faces.size() >= 4, "fewer than 4 faces");
  return convex;
}

Mesh mesh_from(Checks& checks, const msg::v3::ShapeInfo& in) {
  Mesh mesh;
  checks.require(in.vertices().size() <= kMaxMeshVertices, "too many vertices");
  checks.require(!in.triangles().empty() && in.triangles().size() % 3 == 0 &&
                     in.triangles().size() <= 3 * kMaxTriangles,
                 "number of triangle corners is not a multiple of 3 up to " +
                     std::to_string(3 * kMaxTriangles));
  if (!checks.ok()) return mesh;
  for (const msg::v1::Vector3& vertex : in.vertices()) {
    mesh.vertices.push_back(from(vertex));
    checks.vector(mesh.vertices.back(), "vertices");
  }
  for (std::size_t k = 0; k < in.triangles().size() && checks.ok(); ++k) {
    const std::uint32_t corner = in.triangles()[k];
    checks.require(corner < mesh.vertices.size(), "a triangle index without vertex");
    if (k % 3 == 0) mesh.triangles.push_back({});
    mesh.triangles.back()[k % 3] = static_cast<int>(corner);
  }
  return mesh;
}

Shape shape_from(Checks& checks, const msg::v3::ShapeInfo& in) {
  const Parameters& p = in.parameters();
  switch (in.kind()) {
    case msg::v3::SHAPE_SPHERE:
      return Sphere{length(checks, p[0], "radius")};
    case msg::v3::SHAPE_BOX:
      return Box{lengths(checks, p, "size")};
    case msg::v3::SHAPE_CAPSULE:
      return Capsule{length(checks, p[0], "radius"), length(checks, p[1], "length")};
    case msg::v3::SHAPE_CYLINDER:
      return Cylinder{length(checks, p[0], "radius"), length(checks, p[1], "length")};
    case msg::v3::SHAPE_CONE:
      return Cone{length(checks, p[0], "radius"), length(checks, p[1], "length")};
    case msg::v3::SHAPE_ELLIPSOID:
      return Ellipsoid{lengths(checks, p, "semi-axes")};
    case msg::v3::SHAPE_CONVEX:
      return convex_from(checks, in);
    case msg::v3::SHAPE_MESH:
      return mesh_from(checks, in);
    case msg::v3::SHAPE_HALF_SPACE: {
      const HalfSpace half_space{{p[0], p[1], p[2]}, p[3]};
      checks.number(half_space.offset, "offset");
      checks.require(std::abs(half_space.normal.squaredNorm() - 1) <= kUnitSlack,
                     "normal is not a unit vector");
      return half_space;
    }
  }
  checks.require(false,
                 "kind " + std::to_string(static_cast<std::uint32_t>(in.kind())) + " is unknown");
  return Sphere{};
}

std::string put_shapes(const std::vector<ShapeDef>& in, std::vector<msg::v3::ShapeInfo>& out) {
  if (in.size() > kMaxShapes) return "more than " + std::to_string(kMaxShapes) + " shapes";
  out.resize(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    out[i].kind(static_cast<msg::v3::ShapeKind>(in[i].shape.index()));
    out[i].parameters(std::visit(ToParameters{}, in[i].shape));
    assign(out[i].pose(), in[i].pose);
    out[i].vertices().clear();
    out[i].face_loops().clear();
    out[i].triangles().clear();
    if (const auto* convex = std::get_if<Convex>(&in[i].shape)) {
      const std::string reason = put_convex(*convex, out[i]);
      if (!reason.empty()) return reason;
    }
    if (const auto* mesh = std::get_if<Mesh>(&in[i].shape)) {
      const std::string reason = put_mesh(*mesh, out[i]);
      if (!reason.empty()) return reason;
    }
  }
  return {};
}

std::array<double, 6> put_inertia(const Mat3& J) {
  return {J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2)};
}

Mat3 inertia_from(Checks& checks, const std::array<double, 6>& v) {
  for (const double element : v) checks.number(element, "inertia");
  Mat3 J;
  J << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  return J;
}

}  // namespace

std::string to_message(const BodyInfo& in, msg::v3::BodyDescription& out) {
  Checks checks;
  if (!in.removed) checks.text(in.name, "name", kMaxNameLength);
  out.removed(in.removed);
  out.slot(in.id.slot);
  out.generation(in.id.generation);
  out.session(in.session);
  out.scene_index(in.index);
  out.scene_revision(in.revision);
  out.name(in.name);
  out.kind(in.is_static      ? msg::v3::BODY_STATIC
           : in.is_kinematic ? msg::v3::BODY_KINEMATIC
                             : msg::v3::BODY_DYNAMIC);
  out.mass(in.mass_properties.mass);
  assign(out.center_of_mass(), in.mass_properties.center_of_mass);
  out.inertia(put_inertia(in.mass_properties.J));
  assign(out.pose(), in.pose);
  out.friction(in.material.friction);
  out.restitution(in.material.restitution);
  const std::string shapes = put_shapes(in.shapes, out.shapes());
  checks.require(shapes.empty(), shapes);
  return checks.take();
}

std::string from_message(const msg::v3::BodyDescription& in, BodyInfo& out) {
  Checks checks;
  out.session = in.session();
  out.id = {in.slot(), in.generation()};
  checks.require(static_cast<bool>(out.id), "body has no generation");
  out.index = in.scene_index();
  out.revision = in.scene_revision();
  out.removed = in.removed();
  if (out.removed) return checks.take();
  out.name = in.name().c_str();
  checks.text(out.name, "name", kMaxNameLength);
  checks.require(in.kind() == msg::v3::BODY_DYNAMIC || in.kind() == msg::v3::BODY_STATIC ||
                     in.kind() == msg::v3::BODY_KINEMATIC,
                 "kind " + std::to_string(static_cast<std::uint32_t>(in.kind())) + " is unknown");
  out.is_static = in.kind() == msg::v3::BODY_STATIC;
  out.is_kinematic = in.kind() == msg::v3::BODY_KINEMATIC;
  out.mass_properties.mass = in.mass();
  checks.number(in.mass(), "mass");
  checks.require(in.mass() >= 0, "mass is negative");
  out.mass_properties.center_of_mass = from(in.center_of_mass());
  checks.vector(out.mass_properties.center_of_mass, "center_of_mass");
  out.mass_properties.J = inertia_from(checks, in.inertia());
  out.pose = pose_from(checks, in.pose(), "pose");
  out.material = {.friction = in.friction(), .restitution = in.restitution()};
  checks.number(in.friction(), "friction");
  checks.require(in.friction() >= 0, "friction is negative");
  checks.require(in.restitution() >= 0 && in.restitution() <= 1, "restitution is not 0 to 1");
  checks.require(in.shapes().size() <= kMaxShapes, "too many shapes");
  out.shapes.clear();
  for (std::size_t i = 0; i < in.shapes().size() && checks.ok(); ++i) {
    Checks of_shape;
    const Shape shape = shape_from(of_shape, in.shapes()[i]);
    const Pose pose = pose_from(of_shape, in.shapes()[i].pose(), "pose");
    if (!of_shape.ok())
      checks.require(false, "shapes[" + std::to_string(i) + "]: " + of_shape.take());
    out.shapes.push_back({shape, pose});
  }
  return checks.take();
}

}  // namespace poinsot
