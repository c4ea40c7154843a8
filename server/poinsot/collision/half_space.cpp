#include "poinsot/collision/half_space.h"

namespace poinsot {

void shape_on_half_space(const Collider& shape, const Vec3& plane_normal, double plane_offset,
                         double margin, Manifold& manifold) {
  PointSet set(plane_normal, kSameGap * shape.size);
  const auto gap_of = [&](const Vec3& on_core) {
    return plane_normal.dot(on_core) - plane_offset - shape.core_radius;
  };
  const auto add = [&](const Vec3& on_core, std::uint32_t id) {
    const double gap = gap_of(on_core);
    if (gap <= margin) set.add(on_core - (shape.core_radius + 0.5 * gap) * plane_normal, gap, id);
  };
  const Vec3 deepest = support(shape, -plane_normal);
  if (gap_of(deepest) > margin) return manifold.clear();
  const Feature feature = support_feature(shape, -plane_normal);
  for (int i = 0; i < feature.count; ++i)
    add(feature[i], corner_of(true, feature.id[static_cast<std::size_t>(i)]));
  // Not always a corner of the facing feature: a rim's may lie between two of its octagon.
  if (set.count() == 0 || gap_of(deepest) < set.least_gap() - kSameGap * shape.size)
    add(deepest, kNearestFeature);
  set.reduce_into(manifold);
}

}  // namespace poinsot
