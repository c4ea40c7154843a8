#include "poinsot/contact/contact_colors.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

// Each contact is in one group and no movable body is twice in one.
void expect_valid(const ContactColors& colors, std::span<const ColorPair> pairs) {
  std::vector<int> seen(pairs.size(), 0);
  for (std::size_t k = 0; k < colors.groups(); ++k) {
    std::set<int> bodies;
    for (const int contact : colors.group(k)) {
      ++seen[static_cast<std::size_t>(contact)];
      const auto [a, b] = pairs[static_cast<std::size_t>(contact)];
      for (const int body : {a, b}) {
        if (body >= 0) {
          EXPECT_TRUE(bodies.insert(body).second);
        }
      }
    }
  }
  EXPECT_EQ(seen, std::vector<int>(pairs.size(), 1));
}

TEST(ContactColors, HaveNoMovableBodyTwiceInAGroup) {
  std::mt19937 random(7);
  std::vector<ColorPair> pairs;
  for (int k = 0; k < 3000; ++k) {
    const int a = static_cast<int>(random() % 500);
    const int b = static_cast<int>(random() % 501) - 1;
    if (a != b) pairs.push_back({a, b});
  }
  ContactColors colors;
  for (int round = 0; round < 2; ++round) {
    colors.assign(pairs, 500);
    expect_valid(colors, pairs);
  }
  EXPECT_LE(colors.groups(), 32u);
}

TEST(ContactColors, SolveTheGroundLast) {
  const std::vector<ColorPair> pairs = {{0, -1}, {1, 0}, {2, 1}, {2, 0}};
  ContactColors colors;
  colors.assign(pairs, 3);
  expect_valid(colors, pairs);
  const auto last = colors.group(colors.groups() - 1);
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0], 0);
  EXPECT_EQ(colors.contacts_of(0), 3);
}

TEST(ContactColors, PutContactsBeyondTheLastColourOneToAGroup) {
  std::vector<ColorPair> pairs;
  for (int k = 1; k <= 200; ++k) pairs.push_back({0, k});
  ContactColors colors;
  colors.assign(pairs, 201);
  expect_valid(colors, pairs);
  EXPECT_EQ(colors.groups(), 200u);
}

TEST(ContactColors, OfNothingAreNone) {
  ContactColors colors;
  colors.assign({}, 0);
  EXPECT_EQ(colors.groups(), 0u);
}

}  // namespace
}  // namespace poinsot
