#include "poinsot/presentation/checkpoint_ring.h"

#include <algorithm>
#include <utility>

namespace poinsot {

void CheckpointRing::add(std::shared_ptr<const Checkpoint> checkpoint) {
  std::erase_if(checkpoints_, [&](const auto& old) { return old->name == checkpoint->name; });
  if (checkpoints_.size() == kCapacity) checkpoints_.erase(checkpoints_.begin());
  checkpoints_.push_back(std::move(checkpoint));
}

std::shared_ptr<const Checkpoint> CheckpointRing::find(std::string_view name) const {
  if (checkpoints_.empty()) return nullptr;
  if (name.empty()) return checkpoints_.back();
  const auto found = std::ranges::find(checkpoints_, name,
                                       [](const auto& c) { return std::string_view(c->name); });
  return found == checkpoints_.end() ? nullptr : *found;
}

std::vector<std::string_view> CheckpointRing::names() const {
  std::vector<std::string_view> names;
  for (const auto& checkpoint : checkpoints_) names.push_back(checkpoint->name);
  return names;
}

}  // namespace poinsot
