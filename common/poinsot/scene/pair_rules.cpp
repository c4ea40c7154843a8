#include "poinsot/scene/pair_rules.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

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
  std::unordered_map<std::string_view, Eigen::Index> columns;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyDef& body = scene.bodies[i];
    materials_.push_back(body.material);
    if (!body.absent) columns.emplace(body.name, static_cast<Eigen::Index>(i));
  }
  const auto column = [&](const std::string& name) {
    const auto found = columns.find(name);
    return found == columns.end() ? kNobody : found->second;
  };
  for (const PairDef& def : scene.pairs) {
    named_.push_back({def, column(def.a), column(def.b)});
    const Named& named = named_.back();
    if (named.a == kNobody || named.b == kNobody) continue;
    entries_.push_back(entry_of(named));
    is_named_[static_cast<std::size_t>(named.a)] = is_named_[static_cast<std::size_t>(named.b)] =
        true;
  }
  std::ranges::sort(entries_, {}, &Entry::bodies);
}

PairRules::Entry PairRules::entry_of(const Named& named) const {
  PairRule rule = of_materials(materials_[static_cast<std::size_t>(named.a)],
                               materials_[static_cast<std::size_t>(named.b)]);
  rule.friction = named.def.friction.value_or(rule.friction);
  rule.restitution = named.def.restitution.value_or(rule.restitution);
  rule.collide = named.def.collide;
  return {key_of(named.a, named.b), rule};
}

void PairRules::add(Eigen::Index column, const BodyDef& body) {
  const auto k = static_cast<std::size_t>(column);
  if (k == materials_.size()) {
    materials_.emplace_back();
    is_named_.push_back(false);
  }
  materials_[k] = body.material;
  for (Named& named : named_) {
    if (named.def.a != body.name && named.def.b != body.name) continue;
    (named.def.a == body.name ? named.a : named.b) = column;
    if (named.a == kNobody || named.b == kNobody) continue;
    const Entry entry = entry_of(named);
    entries_.insert(std::ranges::upper_bound(entries_, entry.bodies, {}, &Entry::bodies), entry);
    is_named_[static_cast<std::size_t>(named.a)] = is_named_[static_cast<std::size_t>(named.b)] =
        true;
  }
}

void PairRules::remove(Eigen::Index column) {
  std::erase_if(entries_, [column](const Entry& entry) {
    return static_cast<Eigen::Index>(entry.bodies >> 32U) == column ||
           static_cast<Eigen::Index>(entry.bodies & 0xffffffffU) == column;
  });
  for (Named& named : named_) {
    if (named.a == column) named.a = kNobody;
    if (named.b == column) named.b = kNobody;
  }
  is_named_[static_cast<std::size_t>(column)] = false;
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
