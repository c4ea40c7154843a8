#include "poinsot/scene/pair_rules.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "poinsot/base/check.h"

namespace poinsot {
namespace {

std::uint64_t key_of(Eigen::Index a, Eigen::Index b) {
  const auto [low, high] = std::minmax(a, b);
  return static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint64_t>(high);
}

PairRule of_materials(const Material& a, const Material& b) {
  return {std::sqrt(a.friction * b.friction), std::max(a.restitution, b.restitution), true};
}

}  // namespace

PairRules::PairRules(const Scene& scene) : is_named_(scene.bodies.size()) {
  std::unordered_map<std::string_view, std::size_t> columns;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    materials_.push_back(scene.bodies[i].material);
    columns.emplace(scene.bodies[i].name, i);
  }
  for (const PairDef& pair : scene.pairs) {
    const auto a = columns.find(pair.a), b = columns.find(pair.b);
    POINSOT_CHECK(a != columns.end() && b != columns.end());
    PairRule rule = of_materials(materials_[a->second], materials_[b->second]);
    rule.friction = pair.friction.value_or(rule.friction);
    rule.restitution = pair.restitution.value_or(rule.restitution);
    rule.collide = pair.collide;
    entries_.push_back(
        {key_of(static_cast<Eigen::Index>(a->second), static_cast<Eigen::Index>(b->second)), rule});
    is_named_[a->second] = is_named_[b->second] = true;
  }
  std::ranges::sort(entries_, {}, &Entry::bodies);
}

const PairRule* PairRules::find(Eigen::Index a, Eigen::Index b) const {
  if (entries_.empty() || !is_named_[static_cast<std::size_t>(a)] ||
      !is_named_[static_cast<std::size_t>(b)])
    return nullptr;
  const std::uint64_t key = key_of(a, b);
  const auto entry = std::ranges::lower_bound(entries_, key, {}, &Entry::bodies);
  return entry != entries_.end() && entry->bodies == key ? &entry->rule : nullptr;
}

PairRule PairRules::rule(Eigen::Index a, Eigen::Index b) const {
  if (const PairRule* entry = find(a, b)) return *entry;
  return of_materials(materials_[static_cast<std::size_t>(a)],
                      materials_[static_cast<std::size_t>(b)]);
}

}  // namespace poinsot
