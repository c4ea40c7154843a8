// The checkpoints that were saved last, by name: the oldest makes room for the newest.

#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "poinsot/presentation/checkpoint.h"

namespace poinsot {

class CheckpointRing {
 public:
  static constexpr std::size_t kCapacity = 16;

  // Takes the place of the one of the same name, as the newest.
  void add(std::shared_ptr<const Checkpoint> checkpoint);
  // Of no name: the newest. Nothing if there is none.
  std::shared_ptr<const Checkpoint> find(std::string_view name) const;
  std::shared_ptr<const Checkpoint> newest() const { return find({}); }

  std::size_t size() const { return checkpoints_.size(); }
  std::vector<std::string_view> names() const;  // oldest first

 private:
  std::vector<std::shared_ptr<const Checkpoint>> checkpoints_;  // oldest first
};

}  // namespace poinsot
