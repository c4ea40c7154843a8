// Handle of a body: passed by value, valid in the daemon and on the wire alike.
//
// A slot is reused after its body is gone, with the next generation, so that an old handle never
// means a new body. Generation 0 is no body.

#pragma once

#include <compare>
#include <cstdint>

namespace poinsot {

struct BodyId {
  std::uint32_t slot = 0;
  std::uint32_t generation = 0;

  constexpr explicit operator bool() const { return generation != 0; }
  friend constexpr auto operator<=>(BodyId, BodyId) = default;
};

}  // namespace poinsot
