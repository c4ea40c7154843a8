#include "faults/payloads.h"

#include <cstring>

namespace poinsot::faults {
namespace {

constexpr std::size_t kHeader = 4;  // [bytes] of CDR
constexpr std::array<unsigned char, kHeader> kLittleEndian = {0, 1, 0, 0};

// None of them is a number that a field may well have: small ones would.
constexpr std::array<std::uint32_t, 6> kHuge = {0xFFFFFFFF, 0x7FFFFFFF, 0x80000000,
                                                0x10000,    0xFFFFFF,   0xDEADBEEF};
// Quiet and signalling NaN, ±infinity, ±1.8e308, 1e300.
constexpr std::array<std::uint64_t, 7> kOdd = {
    0x7FF8000000000001, 0x7FF0000000000001, 0x7FF0000000000000, 0xFFF0000000000000,
    0x7FEFFFFFFFFFFFFF, 0xFFEFFFFFFFFFFFFF, 0x7E37E43C8800759C};

std::size_t below(std::size_t bound, Random& random) {
  return std::uniform_int_distribution<std::size_t>(0, bound - 1)(random);
}

void append_noise(Bytes& bytes, std::size_t count, Random& random) {
  for (std::size_t i = 0; i < count; ++i) bytes.push_back(static_cast<unsigned char>(random()));
}

// Puts one of `values` in place of an aligned field of its size.
template <class Values>
void overwrite(Bytes& bytes, const Values& values, Random& random) {
  const auto value = values[below(values.size(), random)];
  const std::size_t fields = (bytes.size() - kHeader) / sizeof value;
  std::memcpy(&bytes[kHeader + below(fields, random) * sizeof value], &value, sizeof value);
}

}  // namespace

Bytes spoil(const Bytes& valid, Kind kind, Random& random) {
  Bytes bytes = valid;
  switch (kind) {
    case Kind::well_formed:
      break;
    case Kind::random_bytes:
      bytes.assign(kLittleEndian.begin(), kLittleEndian.end());
      append_noise(bytes, below(400, random), random);
      break;
    case Kind::no_header:
      bytes.clear();
      append_noise(bytes, 1 + below(400, random), random);
      break;
    case Kind::truncated:
      bytes.resize(1 + below(bytes.size() - 1, random));
      break;
    case Kind::bit_flips:
      for (std::size_t n = 1 + below(8, random); n > 0; --n)
        bytes[below(bytes.size(), random)] ^= static_cast<unsigned char>(1u << below(8, random));
      break;
    case Kind::huge_length:
      overwrite(bytes, kHuge, random);
      break;
    case Kind::non_finite:
      overwrite(bytes, kOdd, random);
      break;
    case Kind::trailing_bytes:
      append_noise(bytes, below(60'000, random), random);
      break;
  }
  return bytes;
}

}  // namespace poinsot::faults
