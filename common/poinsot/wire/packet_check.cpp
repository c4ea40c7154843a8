#include "poinsot/wire/packet_check.h"

#include <algorithm>
#include <array>
#include <bit>

namespace poinsot {
namespace {

using Packet = std::span<const unsigned char>;

// RTPS 2.3, section 9.4.
constexpr std::size_t kHeader = 20;           // [bytes] of a message
constexpr std::size_t kSubmessageHeader = 4;  // [bytes]
constexpr unsigned char kPad = 0x01, kGap = 0x08, kInfoTimestamp = 0x09, kDataFragment = 0x16;
constexpr unsigned char kLittleEndian = 0x01;  // flag
constexpr std::uint32_t kMaxBits = 256;        // of a set of sequence numbers

// A submessage without its header.
struct Body {
  Packet bytes;
  bool little_endian = false;

  template <class Number>
  Number at(std::size_t offset) const {
    std::array<unsigned char, sizeof(Number)> raw = {};
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), raw.size(), raw.begin());
    if (little_endian != (std::endian::native == std::endian::little))
      std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Number>(raw);
  }
  std::int64_t sequence_number(std::size_t offset) const {
    return static_cast<std::int64_t>(at<std::int32_t>(offset)) * (std::int64_t{1} << 32) +
           at<std::uint32_t>(offset + 4);
  }
};

// Two entities, the first number of the range; then those behind it, as a set.
bool is_harmless_gap(const Body& gap) {
  constexpr std::size_t kStart = 8, kBase = 16, kBits = 24, kSize = 28;
  if (gap.bytes.size() < kSize) return false;
  const std::int64_t start = gap.sequence_number(kStart), base = gap.sequence_number(kBase);
  return start > 0 && base >= start && base - start <= kMaxGap &&
         gap.at<std::uint32_t>(kBits) <= kMaxBits;
}

// Flags, offset, two entities, a sequence number; then which fragments of what.
bool is_harmless_fragment(const Body& data, std::uint32_t largest) {
  constexpr std::size_t kFirst = 20, kCount = 24, kFragmentSize = 26, kSampleSize = 28, kSize = 32;
  if (data.bytes.size() < kSize) return false;
  const std::uint64_t first = data.at<std::uint32_t>(kFirst);
  const std::uint64_t count = data.at<std::uint16_t>(kCount);
  const std::uint64_t size = data.at<std::uint16_t>(kFragmentSize);
  const std::uint32_t sample = data.at<std::uint32_t>(kSampleSize);
  // The last one begins inside the sample.
  return first > 0 && count > 0 && size > 0 && sample <= largest &&
         (first + count - 2) * size < sample;
}

bool is_harmless(unsigned char kind, const Body& body, std::uint32_t largest) {
  if (kind == kGap) return is_harmless_gap(body);
  if (kind == kDataFragment) return is_harmless_fragment(body, largest);
  return true;
}

}  // namespace

bool is_harmless(Packet packet, std::uint32_t largest) {
  if (packet.size() < kHeader) return false;
  for (Packet rest = packet.subspan(kHeader); !rest.empty();) {
    if (rest.size() < kSubmessageHeader) return false;
    const unsigned char kind = rest[0];
    Body body{rest.subspan(kSubmessageHeader), (rest[1] & kLittleEndian) != 0};
    std::size_t length = Body{rest, body.little_endian}.at<std::uint16_t>(2);
    if (length > body.bytes.size()) return false;
    // The last submessage may leave its length out: it goes to the end.
    if (length == 0 && kind != kPad && kind != kInfoTimestamp) length = body.bytes.size();
    body.bytes = body.bytes.first(length);
    if (!is_harmless(kind, body, largest)) return false;
    rest = rest.subspan(kSubmessageHeader + length);
  }
  return true;
}

}  // namespace poinsot
