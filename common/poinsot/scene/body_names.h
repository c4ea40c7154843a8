// The bodies of a scene by name, for the rules that name them. Private to this module.

#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "poinsot/base/names.h"
#include "poinsot/scene/fault_text.h"
#include "poinsot/scene/scene.h"

namespace poinsot {

class BodyNames {
 public:
  explicit BodyNames(const Scene& scene) : scene_(scene) {
    for (const BodyDef& body : scene.bodies)
      if (!body.absent) bodies_.emplace(body.name, &body);
  }

  // The body of that name (of two, the first), or nothing.
  const BodyDef* find(std::string_view name) const {
    const auto found = bodies_.find(name);
    return found == bodies_.end() ? nullptr : found->second;
  }

  // Why there is none, and which name is near. Looking for it goes through all bodies: a scene full
  // of misspelt names must not take minutes.
  std::string unknown(std::string_view name) {
    constexpr std::size_t kLongestSuggested = 64;
    std::string what = "no body " + in_quotes(name);
    if (name.size() > kLongestSuggested || suggestions_-- <= 0) return what;
    std::vector<std::string_view> names;
    for (const BodyDef& body : scene_.bodies) names.push_back(body.name);
    return what + did_you_mean(name, names);
  }

 private:
  const Scene& scene_;
  std::unordered_map<std::string_view, const BodyDef*> bodies_;
  int suggestions_ = 8;
};

}  // namespace poinsot
