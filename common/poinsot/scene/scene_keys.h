// The keys of scene files, table by table: what is read, and what is known but comes later (and is
// refused by name). README.md gives units and defaults.

#pragma once

#include <array>
#include <span>
#include <string_view>

namespace poinsot {

struct KeyTable {
  std::string_view name;                    // as the user sees it
  std::span<const std::string_view> keys;   // understood
  std::span<const std::string_view> later;  // known, not supported yet
};

namespace scene_keys {

using Words = std::string_view[];

inline constexpr Words kSceneKeys = {"world",      "profile",       "presentation", "collision",
                                     "simulation", "allow_overlap", "bodies",       "springs",
                                     "wrenches",   "pairs"};
inline constexpr Words kFragmentKeys = {"bodies"};
inline constexpr Words kPresentationKeys = {"frame_rate"};
inline constexpr Words kCollisionKeys = {"impact_search",      "contact_solver", "contact_step",
                                         "contact_tolerance",  "contact_margin", "push_out_speed",
                                         "contact_band",       "max_impacts",    "sleeping",
                                         "sleep_acceleration", "threads"};
inline constexpr Words kSimulationKeys = {"integrator", "step", "tolerance", "gravity"};
inline constexpr Words kBodyKeys = {
    "name",           "static",   "shape",       "shapes",          "density",          "mass",
    "inertia",        "position", "orientation", "linear_velocity", "angular_velocity", "material",
    "center_of_mass", "drag",     "kinematic"};
inline constexpr Words kBodyLater = {"surface_velocity"};
inline constexpr Words kDragKeys = {"linear", "quadratic", "angular"};
inline constexpr Words kShapeKeys = {"sphere",   "box",         "capsule", "cylinder",
                                     "cone",     "ellipsoid",   "convex",  "half_space",
                                     "position", "orientation", "density", "mesh"};
inline constexpr Words kRoundKeys = {"radius", "length"};
inline constexpr Words kConvexKeys = {"points"};
inline constexpr Words kConvexLater = {"file"};
inline constexpr Words kMeshKeys = {"file"};
inline constexpr Words kHalfSpaceKeys = {"normal", "offset"};
inline constexpr Words kMaterialKeys = {"friction", "restitution"};
inline constexpr Words kMaterialLater = {"static_friction"};
inline constexpr Words kInertiaKeys = {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};
inline constexpr Words kOrientationKeys = {"x", "y", "z", "w", "rpy"};
inline constexpr Words kSpringKeys = {"a",         "b",       "point_a",    "point_b",
                                      "stiffness", "damping", "rest_length"};
inline constexpr Words kPairKeys = {"a", "b", "friction", "restitution", "collide"};
inline constexpr Words kWrenchKeys = {"body",  "force",       "torque", "frame",
                                      "point", "point_frame", "start",  "duration"};

}  // namespace scene_keys

inline constexpr KeyTable kSceneTable = {"scene", scene_keys::kSceneKeys, {}};
inline constexpr KeyTable kFragmentTable = {"a fragment", scene_keys::kFragmentKeys, {}};
inline constexpr KeyTable kPresentationTable = {"presentation", scene_keys::kPresentationKeys, {}};
inline constexpr KeyTable kCollisionTable = {"collision", scene_keys::kCollisionKeys, {}};
inline constexpr KeyTable kSimulationTable = {"simulation", scene_keys::kSimulationKeys, {}};
inline constexpr KeyTable kBodyTable = {"bodies[]", scene_keys::kBodyKeys, scene_keys::kBodyLater};
inline constexpr KeyTable kShapeTable = {"shape", scene_keys::kShapeKeys, {}};
inline constexpr KeyTable kRoundTable = {"capsule, cylinder, cone", scene_keys::kRoundKeys, {}};
inline constexpr KeyTable kConvexTable = {"convex", scene_keys::kConvexKeys,
                                          scene_keys::kConvexLater};
inline constexpr KeyTable kMeshTable = {"mesh", scene_keys::kMeshKeys, {}};
inline constexpr KeyTable kHalfSpaceTable = {"half_space", scene_keys::kHalfSpaceKeys, {}};
inline constexpr KeyTable kMaterialTable = {"material", scene_keys::kMaterialKeys,
                                            scene_keys::kMaterialLater};
inline constexpr KeyTable kInertiaTable = {"inertia", scene_keys::kInertiaKeys, {}};
inline constexpr KeyTable kOrientationTable = {"orientation", scene_keys::kOrientationKeys, {}};
inline constexpr KeyTable kDragTable = {"drag", scene_keys::kDragKeys, {}};
inline constexpr KeyTable kSpringTable = {"springs[]", scene_keys::kSpringKeys, {}};
inline constexpr KeyTable kPairKeyTable = {"pairs[]", scene_keys::kPairKeys, {}};
inline constexpr KeyTable kWrenchTable = {"wrenches[]", scene_keys::kWrenchKeys, {}};

// Where a misplaced key may belong, nearest to the top first.
inline constexpr std::array<const KeyTable*, 12> kPlaces = {
    &kSceneTable, &kPresentationTable, &kCollisionTable, &kSimulationTable,
    &kBodyTable,  &kMaterialTable,     &kShapeTable,     &kInertiaTable,
    &kDragTable,  &kSpringTable,       &kWrenchTable,    &kPairKeyTable};

}  // namespace poinsot
