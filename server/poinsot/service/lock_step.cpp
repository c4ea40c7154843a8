#include "poinsot/service/lock_step.h"

#include <algorithm>
#include <utility>

#include "poinsot/base/check.h"

namespace poinsot {
namespace {

constexpr auto before = [](const auto& member, std::uint64_t client) {
  return member.client < client;
};

}  // namespace

const LockStep::Member* LockStep::find(std::uint64_t client) const {
  const auto found = std::lower_bound(members_.begin(), members_.end(), client, before);
  return found != members_.end() && found->client == client ? &*found : nullptr;
}

LockStep::Member* LockStep::find(std::uint64_t client) {
  return const_cast<Member*>(std::as_const(*this).find(client));
}

void LockStep::join(std::uint64_t client, std::int64_t timeout_ns) {
  if (Member* member = find(client)) {
    member->timeout_ns = timeout_ns;
    return;
  }
  members_.insert(std::lower_bound(members_.begin(), members_.end(), client, before),
                  {.client = client, .timeout_ns = timeout_ns});
}

std::optional<RunControl> LockStep::leave(std::uint64_t client) {
  Member* const member = find(client);
  if (member == nullptr) return std::nullopt;
  std::optional<RunControl> advance = std::move(member->advance);
  members_.erase(members_.begin() + (member - members_.data()));
  return advance;
}

bool LockStep::offer(const RunControl& advance) {
  Member* const member = find(advance.client);
  POINSOT_CHECK(member != nullptr);
  if (member->advance) return false;
  member->advance = advance;
  return true;
}

bool LockStep::ready() const {
  return std::all_of(members_.begin(), members_.end(),
                     [](const Member& member) { return member.advance.has_value(); });
}

std::int64_t LockStep::timeout_ns() const {
  POINSOT_CHECK(!members_.empty());
  return std::min_element(
             members_.begin(), members_.end(),
             [](const Member& a, const Member& b) { return a.timeout_ns < b.timeout_ns; })
      ->timeout_ns;
}

void LockStep::take(std::vector<RunControl>& advances) {
  advances.clear();
  for (Member& member : members_)
    if (member.advance) advances.push_back(*std::exchange(member.advance, std::nullopt));
}

}  // namespace poinsot
