#include "poinsot/presentation/body_search.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "poinsot/base/names.h"

namespace poinsot {
namespace {

constexpr std::size_t kLongestSuggestedName = 64;

}  // namespace

std::string Suggestions::nearest(const std::string& name, const World& world) {
  if (name.size() > kLongestSuggestedName || left_ <= 0 || names_left_ == 0) return {};
  --left_;
  names_left_ -= std::min(names_left_, world.names.size());
  const std::vector<std::string_view> names(world.names.begin(), world.names.end());
  return did_you_mean(name, names);
}

std::optional<Eigen::Index> find_body(BodyId id, const std::string& name, const World& world) {
  if (id) return world.find(id);
  if (name.empty()) return std::nullopt;  // absent columns have no name either
  return world.find(name);
}

Refusal unknown_body(BodyId id, const std::string& name, const World& world,
                     Suggestions& suggestions) {
  if (id)
    return {ResultCode::not_found,
            "no body with id " + std::to_string(id.slot) + "." + std::to_string(id.generation)};
  if (name.empty()) return {ResultCode::not_found, "no body named: give its name or its id"};
  return {ResultCode::not_found, "no body '" + name + "'" + suggestions.nearest(name, world)};
}

}  // namespace poinsot
