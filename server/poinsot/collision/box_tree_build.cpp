// Building a BoxTree top down: the boxes of a node are parted in up to four groups, each time
// where surface area times number of boxes, summed over both sides, becomes least.

#include <algorithm>
#include <bit>
#include <cmath>
#include <emmintrin.h>
#include <limits>
#include <span>

#include "poinsot/collision/box_tree.h"

namespace poinsot {
namespace {

constexpr std::size_t kBins = 16;
// So few boxes of one size are halved.
constexpr std::size_t kFew = 16;
// Centres closer than this [m] are one place.
constexpr float kOnePlace = 1e-30f;
// Sizes within an octave are one size (the fourth axis counts twice, as centres do).
constexpr float kOneSize = 2;
// Coordinates while building [m]: their products are finite.
constexpr double kFarthest = 1e17;
constexpr float kNoSize = -200;  // [octaves] of an empty box

struct Bounds4 {
  __m128 low = _mm_set1_ps(std::numeric_limits<float>::infinity());
  __m128 high = _mm_set1_ps(-std::numeric_limits<float>::infinity());

  void include(__m128 l, __m128 h) {
    low = _mm_min_ps(low, l);
    high = _mm_max_ps(high, h);
  }
  float area() const {
    alignas(16) std::array<float, 4> d;
    _mm_store_ps(d.data(), _mm_sub_ps(high, low));
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
};

std::array<float, 4> stored(__m128 x) {
  alignas(16) std::array<float, 4> result;
  _mm_store_ps(result.data(), x);
  return result;
}

// The logarithm to base 2, straight between powers of two.
float octaves(float x) {
  return static_cast<float>(std::bit_cast<std::int32_t>(x)) / 8388608.0f - 127.0f;
}

// The bins of boxes by their centres on one axis.
struct Binning {
  std::size_t axis = 0;
  float first = 0, scale = 0;  // centres count twice: low + high

  std::size_t of(float low, float high) const {
    const auto bin = static_cast<std::size_t>((low + high - first) * scale);
    return std::min(bin, kBins - 1);
  }
};

struct Cut {
  float cost = std::numeric_limits<float>::infinity();
  Binning binning;
  std::size_t bin = 0;  // the first on the right
};

template <class Parts>
Cut best_cut(const Parts& parts, const Binning& binning) {
  std::array<Bounds4, kBins> bounds;
  std::array<float, kBins> count{};
  for (const auto& part : parts) {
    const std::size_t bin = binning.of(part.low[binning.axis], part.high[binning.axis]);
    bounds[bin].include(_mm_load_ps(part.low.data()), _mm_load_ps(part.high.data()));
    ++count[bin];
  }
  std::array<float, kBins> left_cost;
  Bounds4 side;
  float n = 0;
  for (std::size_t k = 0; k + 1 < kBins; ++k) {
    side.include(bounds[k].low, bounds[k].high);
    n += count[k];
    left_cost[k] = n * side.area();
  }
  Cut best{.binning = binning};
  side = {};
  n = 0;
  for (std::size_t k = kBins - 1; k > 0; --k) {
    side.include(bounds[k].low, bounds[k].high);
    n += count[k];
    const float cost = n * side.area() + left_cost[k - 1];
    if (cost < best.cost) {
      best.cost = cost;
      best.bin = k;
    }
  }
  return best;
}

}  // namespace

void BoxTree::build() {
  const std::size_t n = leaves_.size();
  gather();
  old_leaves_.swap(leaves_);
  std::swap(was_changed_, changed_);
  leaves_.clear();
  leaves_.reserve(n);
  nodes_.clear();
  nodes_.reserve(n);
  depth_ = 0;
  add_node({0, n}, -1, 0, 1);
  loose_.resize(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k) loose_.set(k);
  changed_.resize(n);
  for (std::size_t s = 0; s < n; ++s) {
    Leaf& leaf = leaves_[s];
    Item& item = items_[static_cast<std::size_t>(leaf.item)];
    if (was_changed_.test(static_cast<std::size_t>(item.slot))) changed_.set(s);
    item.slot = static_cast<std::int32_t>(s);
    write(leaf);
  }
  refit();
  scale_travel();
  // Two nodes against each other leave at most sixteen tasks behind at each level of both.
  tasks_.resize(32 * depth_ + 32);
  travel_ = debt_ = 0;
  ++builds_;
}

void BoxTree::gather() {
  const double share = 1 / static_cast<double>(leaves_.size());
  origin_.setZero();
  for (const Leaf& leaf : leaves_)
    if (leaf.box.low[0] <= leaf.box.high[0])
      origin_ += 0.5 * share * leaf.box.low + 0.5 * share * leaf.box.high;
  parts_.resize(leaves_.size());
  for (std::size_t s = 0; s < leaves_.size(); ++s) {
    Part& part = parts_[s];
    const Aabb& box = leaves_[s].box;
    part.leaf = static_cast<std::int32_t>(s);
    if (box.low[0] > box.high[0]) {
      part.low = part.high = {0, 0, 0, kNoSize};
      continue;
    }
    float size = 0;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      part.low[axis] =
          static_cast<float>(std::clamp(box.low[k] - origin_[k], -kFarthest, kFarthest));
      part.high[axis] =
          static_cast<float>(std::clamp(box.high[k] - origin_[k], -kFarthest, kFarthest));
      size = std::max(size, part.high[axis] - part.low[axis]);
    }
    part.low[3] = part.high[3] = octaves(size);
  }
}

std::int32_t BoxTree::add_node(Range range, std::int32_t parent, std::size_t parent_lane,
                               std::size_t depth) {
  const std::size_t index = nodes_.size();
  const auto self = static_cast<std::int32_t>(index);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Node& node = nodes_.emplace_back();
  for (std::size_t k = 0; k < 3; ++k) {
    node.low[k].fill(kInfinity);
    node.high[k].fill(-kInfinity);
  }
  node.child.fill(0);
  node.parent = parent;
  node.lane = static_cast<std::int32_t>(parent_lane);
  depth_ = std::max(depth_, depth);

  std::array<Range, kWidth> groups{range};
  std::size_t count = 1;
  const std::size_t enough = range.count > kWidth ? kWidth : 1;
  const auto larger = [](const Range& a, const Range& b) { return a.count < b.count; };
  while (count < kWidth) {
    const auto last = groups.begin() + static_cast<std::ptrdiff_t>(count);
    Range& largest = *std::max_element(groups.begin(), last, larger);
    if (largest.count <= enough) break;
    const std::size_t left = enough == 1 ? 1 : part(largest);
    groups[count++] = {largest.first + left, largest.count - left};
    largest.count = left;
  }
  for (std::size_t lane = 0; lane < count; ++lane) {
    if (groups[lane].count == 1) {
      nodes_[index].child[lane] = ~static_cast<std::int32_t>(leaves_.size());
      Leaf& leaf = leaves_.emplace_back(
          old_leaves_[static_cast<std::size_t>(parts_[groups[lane].first].leaf)]);
      leaf.node = self;
      leaf.lane = static_cast<std::uint8_t>(lane);
    } else {
      const std::int32_t child = add_node(groups[lane], self, lane, depth + 1);
      nodes_[index].child[lane] = child;
    }
  }
  return self;
}

// Parts the parts of a range in two and returns how many are in the first part.
std::size_t BoxTree::part(Range range) {
  const std::span<Part> parts(parts_.begin() + static_cast<std::ptrdiff_t>(range.first),
                              range.count);
  Bounds4 centres;
  for (const Part& part : parts) {
    const __m128 twice = _mm_add_ps(_mm_load_ps(part.low.data()), _mm_load_ps(part.high.data()));
    centres.include(twice, twice);
  }
  const std::array<float, 4> low = stored(centres.low);
  const std::array<float, 4> extent = stored(_mm_sub_ps(centres.high, centres.low));
  const auto longest = static_cast<std::size_t>(
      std::max_element(extent.begin(), extent.begin() + 3) - extent.begin());
  if (range.count <= kFew && extent[3] <= kOneSize) return halve(parts, longest);

  const auto binning = [&](std::size_t axis) {
    return Binning{axis, low[axis], static_cast<float>(kBins) / extent[axis]};
  };
  Cut cut;
  if (extent[longest] > kOnePlace) cut = best_cut(parts, binning(longest));
  if (extent[3] > kOneSize) {
    const Cut by_size = best_cut(parts, binning(3));
    if (by_size.cost < cut.cost) cut = by_size;
  }
  if (cut.bin == 0) return range.count / 2;
  const auto middle = std::partition(parts.begin(), parts.end(), [&](const Part& part) {
    return cut.binning.of(part.low[cut.binning.axis], part.high[cut.binning.axis]) < cut.bin;
  });
  return static_cast<std::size_t>(middle - parts.begin());
}

// In two halves of full nodes.
std::size_t BoxTree::halve(std::span<Part> parts, std::size_t axis) {
  const std::size_t left = kWidth * ((parts.size() + 2 * kWidth - 1) / (2 * kWidth));
  const auto centre = [axis](const Part& part) { return part.low[axis] + part.high[axis]; };
  std::nth_element(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(left), parts.end(),
                   [&](const Part& a, const Part& b) { return centre(a) < centre(b); });
  return left;
}

void BoxTree::scale_travel() {
  for (const Node& node : nodes_) {
    float size = kOnePlace;
    for (std::size_t k = 0; k < 3; ++k)
      size = std::max(size, *std::max_element(node.high[k].begin(), node.high[k].end()) -
                                *std::min_element(node.low[k].begin(), node.low[k].end()));
    for (const std::int32_t child : node.child)
      if (child < 0) travel_scale_[static_cast<std::size_t>(~child)] = 1 / size;
  }
}

}  // namespace poinsot
