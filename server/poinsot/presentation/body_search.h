// Which body a command or a control means: by its id or, if that is none, by its name.

#pragma once

#include <optional>
#include <string>

#include "poinsot/presentation/value_check.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

// Looking for the nearest name costs far more than the rest of a refusal, so a flood of misspelt
// names must not make a frame late: in one go of commands it is done a few times, and no more once
// so many names were compared.
class Suggestions {
 public:
  // ", did you mean 'x'?" or nothing.
  std::string nearest(const std::string& name, const World& world);

 private:
  int left_ = 8;  // times
  std::size_t names_left_ = 20'000;
};

std::optional<Eigen::Index> find_body(BodyId id, const std::string& name, const World& world);

// Why there is none.
Refusal unknown_body(BodyId id, const std::string& name, const World& world,
                     Suggestions& suggestions);

}  // namespace poinsot
