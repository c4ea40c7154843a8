// Packets byte by byte, as section 9.4 of RTPS 2.3 lays them out.

#include "poinsot/wire/packet_check.h"

#include <vector>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

using Bytes = std::vector<unsigned char>;

void append(Bytes& bytes, std::uint64_t number, int size, bool little_endian = true) {
  for (int i = 0; i < size; ++i)
    bytes.push_back(static_cast<unsigned char>(number >> (8 * (little_endian ? i : size - 1 - i))));
}

Bytes header() {
  Bytes bytes;
  bytes.reserve(20);
  for (const char byte : {'R', 'T', 'P', 'S', '\2', '\3', '\1', '\17'})
    bytes.push_back(static_cast<unsigned char>(byte));
  while (bytes.size() < 20) bytes.push_back(7);
  return bytes;
}

void append_submessage(Bytes& packet, unsigned char kind, const Bytes& body, bool little = true) {
  packet.push_back(kind);
  packet.push_back(little ? 1 : 0);
  append(packet, body.size(), 2, little);
  packet.insert(packet.end(), body.begin(), body.end());
}

void append_sequence_number(Bytes& bytes, std::int64_t number, bool little) {
  append(bytes, static_cast<std::uint64_t>(number) >> 32, 4, little);
  append(bytes, static_cast<std::uint64_t>(number), 4, little);
}

Bytes gap(std::int64_t start, std::int64_t base, std::uint32_t bits = 0, bool little = true) {
  Bytes body(8);
  append_sequence_number(body, start, little);
  append_sequence_number(body, base, little);
  append(body, bits, 4, little);
  Bytes packet = header();
  append_submessage(packet, 0x08, body, little);
  return packet;
}

Bytes fragment(std::uint32_t first, std::uint16_t count, std::uint16_t size, std::uint32_t sample) {
  Bytes body(12);
  append_sequence_number(body, 1, true);
  append(body, first, 4);
  append(body, count, 2);
  append(body, size, 2);
  append(body, sample, 4);
  Bytes packet = header();
  append_submessage(packet, 0x16, body);
  return packet;
}

TEST(PacketCheck, AGapIsHarmlessUpToItsBound) {
  for (const bool little : {true, false}) {
    EXPECT_TRUE(is_harmless(gap(1, 1, 0, little)));
    EXPECT_TRUE(is_harmless(gap(5'000'000'000, 5'000'000'000 + kMaxGap, 256, little)));
    EXPECT_FALSE(is_harmless(gap(1, 2 + kMaxGap, 0, little)));
    EXPECT_FALSE(is_harmless(gap(1, std::int64_t{1} << 62, 0, little)));
    EXPECT_FALSE(is_harmless(gap(2, 1, 0, little)));
    EXPECT_FALSE(is_harmless(gap(0, 1, 0, little)));
    EXPECT_FALSE(is_harmless(gap(-5, 1, 0, little)));
    EXPECT_FALSE(is_harmless(gap(1, 1, 257, little)));
  }
}

TEST(PacketCheck, AFragmentLiesInASampleOfAUsefulSize) {
  EXPECT_TRUE(is_harmless(fragment(1, 1, 1000, 3000)));
  EXPECT_TRUE(is_harmless(fragment(3, 1, 1000, 3000)));
  EXPECT_TRUE(is_harmless(fragment(1, 3, 1000, 2500)));
  EXPECT_FALSE(is_harmless(fragment(4, 1, 1000, 3000)));
  EXPECT_FALSE(is_harmless(fragment(2, 3, 1000, 3000)));
  EXPECT_FALSE(is_harmless(fragment(0, 1, 1000, 3000)));
  EXPECT_FALSE(is_harmless(fragment(1, 0, 1000, 3000)));
  EXPECT_FALSE(is_harmless(fragment(1, 1, 0, 3000)));
  EXPECT_FALSE(is_harmless(fragment(1, 1, 1000, 0)));
  EXPECT_FALSE(is_harmless(fragment(1, 1, 1000, kMaxSample + 1)));
  EXPECT_FALSE(is_harmless(fragment(0xFFFFFFFF, 0xFFFF, 0xFFFF, kMaxSample)));
}

TEST(PacketCheck, WhoReadsCommandsOnlyHasNoUseForMore) {
  EXPECT_TRUE(is_harmless(fragment(1, 1, 1000, 2'000'000)));
  EXPECT_FALSE(is_harmless(fragment(1, 1, 1000, 2'000'000), kMaxCommandSample));
  EXPECT_TRUE(is_harmless(fragment(1, 1, 1000, 70'000), kMaxCommandSample));
}

TEST(PacketCheck, LooksBehindOtherSubmessages) {
  Bytes packet = header();
  append_submessage(packet, 0x09, Bytes(8));
  append_submessage(packet, 0x15, Bytes(60));
  EXPECT_TRUE(is_harmless(packet));
  const Bytes bad = gap(1, std::int64_t{1} << 62);
  packet.insert(packet.end(), bad.begin() + 20, bad.end());
  EXPECT_FALSE(is_harmless(packet));
}

TEST(PacketCheck, TheLastSubmessageMayLeaveItsLengthOut) {
  Bytes good = gap(1, 2), bad = gap(1, std::int64_t{1} << 62);
  for (Bytes* packet : {&good, &bad}) (*packet)[22] = (*packet)[23] = 0;
  EXPECT_TRUE(is_harmless(good));
  EXPECT_FALSE(is_harmless(bad));
}

TEST(PacketCheck, WhatIsCutIsNoPacketAndNothingIsReadBehindIt) {
  Bytes whole = gap(1, 2);
  append_submessage(whole, 0x16, Bytes(32, 1));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    is_harmless(cut);  // the sanitizer watches
  }
  EXPECT_FALSE(is_harmless(Bytes(19)));
  EXPECT_TRUE(is_harmless(header()));
  Bytes too_long = gap(1, 2);
  too_long[22] = 200;
  EXPECT_FALSE(is_harmless(too_long));
}

}  // namespace
}  // namespace poinsot
