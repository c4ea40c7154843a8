#include "poinsot/collision/half_space.h"

namespace poinsot {

void shape_on_half_space(const Collider& shape, const Vec3& plane_normal, double plane_offset,
                         double margin, Manifold& manifold) {
  manifold.clear();
  PointSet set;
  const auto add = [&](const Vec3& on_core) {
    const double gap = plane_normal.dot(on_core) - plane_offset - shape.core_radius;
    if (gap < margin) set.add(on_core - (shape.core_radius + 0.5 * gap) * plane_normal, gap);
  };
  if (const auto* box = std::get_if<Box>(&shape.shape)) {
    for (int corner = 0; corner < 8; ++corner)
      add(0.5 * Vec3(corner & 1 ? box->size.x() : -box->size.x(),
                     corner & 2 ? box->size.y() : -box->size.y(),
                     corner & 4 ? box->size.z() : -box->size.z()));
  } else if (const auto* convex = std::get_if<Convex>(&shape.shape)) {
    for (const Vec3& vertex : convex->vertices) add(vertex);
  } else {
    const Vec3 deepest = support(shape, -plane_normal);
    const Feature feature = support_feature(shape, -plane_normal, deepest);
    for (int i = 0; i < feature.count; ++i) add(feature[i]);
    // A cone's apex may be nearer than its facing cap.
    if (set.count() == 0 ||
        plane_normal.dot(deepest) - plane_offset - shape.core_radius < set.least_gap())
      add(deepest);
  }
  if (set.count() > 0) set.reduce_into(plane_normal, manifold);
}

}  // namespace poinsot
