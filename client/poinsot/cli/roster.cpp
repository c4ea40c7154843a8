#include "poinsot/cli/roster.h"

#include <algorithm>

#include "poinsot/base/error.h"
#include "poinsot/base/names.h"

namespace poinsot {
namespace {

void check_wanted(const std::vector<BodyInfo>& bodies, const std::string& name) {
  const auto body = std::find_if(bodies.begin(), bodies.end(),
                                 [&](const BodyInfo& info) { return info.name == name; });
  if (body == bodies.end()) {
    std::vector<std::string_view> names;
    for (const BodyInfo& info : bodies) names.push_back(info.name);
    throw Error("no body '" + name + "'" + did_you_mean(name, names));
  }
  if (body->is_static) throw Error("body '" + name + "' is static: it has no stream of poses");
}

}  // namespace

Roster::Roster(const std::vector<BodyInfo>& bodies, const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted) check_wanted(bodies, name);
  for (const BodyInfo& body : bodies) {
    session_ = body.session;
    const bool named = std::find(wanted.begin(), wanted.end(), body.name) != wanted.end();
    entries_[body.id] = {body.name, wanted.empty() || named};
  }
}

const std::string* Roster::shown(BodyId id) const {
  const auto entry = entries_.find(id);
  return entry == entries_.end() || !entry->second.shown ? nullptr : &entry->second.name;
}

const std::string* Roster::name(BodyId id) const {
  const auto entry = entries_.find(id);
  return entry == entries_.end() ? nullptr : &entry->second.name;
}

bool Roster::describes(const PoseSnapshot& poses) const {
  return poses.session == session_ &&
         std::all_of(poses.bodies.begin(), poses.bodies.end(),
                     [this](const BodyState& body) { return entries_.contains(body.id); });
}

}  // namespace poinsot
