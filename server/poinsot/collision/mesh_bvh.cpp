#include "poinsot/collision/mesh_bvh.h"

#include <memory>

#include <fcl/geometry/bvh/BVH_model.h>

#include "poinsot/base/check.h"

namespace poinsot {

MeshBvh::MeshBvh(std::span<const Vec3> vertices, std::span<const std::array<int, 3>> triangles) {
  using Box = fcl::AABB<double>;
  fcl::BVHModel<Box> model;
  // Split at the median: never deeper than that, however triangles are spread.
  model.bv_splitter =
      std::make_shared<fcl::detail::BVSplitter<Box>>(fcl::detail::SPLIT_METHOD_MEDIAN);
  std::vector<fcl::Triangle> faces;
  faces.reserve(triangles.size());
  for (const auto& t : triangles)
    faces.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                       static_cast<std::size_t>(t[2]));
  model.beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model.addSubModel({vertices.begin(), vertices.end()}, faces);
  POINSOT_CHECK(model.endModel() == fcl::BVH_OK);

  nodes_.reserve(static_cast<std::size_t>(model.getNumBVs()));
  for (int i = 0; i < model.getNumBVs(); ++i) {
    const auto& from = model.getBV(i);
    const bool leaf = from.isLeaf();
    nodes_.push_back({from.bv.min_, from.bv.max_, leaf ? -1 : from.leftChild(),
                      leaf ? -1 : from.rightChild(), leaf ? from.primitiveId() : -1});
  }
}

}  // namespace poinsot
