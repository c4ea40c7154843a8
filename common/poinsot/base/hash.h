// A 64-bit hash of numbers, in order: the fingerprint of a state. The same bits in, the same bits
// out, on every machine. Not cryptographic. 8 bytes per multiplication, so 1000 bodies cost ~15 µs.
//
// Source: the multiply-and-fold mixing of wyhash (Wang Yi), one word at a time.

#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace poinsot {

class Hash64 {
 public:
  void add(std::uint64_t word) { value_ = fold(value_ ^ word ^ kFirst, kSecond) ^ (value_ >> 29); }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(std::span<const double> numbers) {
    for (const double x : numbers) add(x);
  }

  std::uint64_t value() const { return fold(value_ ^ kSecond, kFirst); }

 private:
  static constexpr std::uint64_t kFirst = 0xa0761d6478bd642full;
  static constexpr std::uint64_t kSecond = 0xe7037ed1a0b428dbull;

  static std::uint64_t fold(std::uint64_t a, std::uint64_t b) {
    __extension__ using Wide = unsigned __int128;
    const Wide product = static_cast<Wide>(a) * b;
    return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
  }

  std::uint64_t value_ = 0x8ebc6af09c88c6e3ull;
};

}  // namespace poinsot
