#include "poinsot/base/utf8.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

TEST(Utf8, AcceptsTextOfEveryLength) {
  EXPECT_TRUE(is_printable_utf8(""));
  EXPECT_TRUE(is_printable_utf8("box 1"));
  EXPECT_TRUE(is_printable_utf8("Würfel"));            // two bytes
  EXPECT_TRUE(is_printable_utf8("箱"));                // three
  EXPECT_TRUE(is_printable_utf8("\xF0\x9F\xA7\x8A"));  // four
}

TEST(Utf8, RefusesControlCharacters) {
  EXPECT_FALSE(is_printable_utf8("a\nb"));
  EXPECT_FALSE(is_printable_utf8("\x1B[2J"));
  EXPECT_FALSE(is_printable_utf8("\x7F"));
  EXPECT_FALSE(is_printable_utf8("\xC2\x85"));  // C1 next line
}

TEST(Utf8, RefusesIllFormedBytes) {
  EXPECT_FALSE(is_printable_utf8("\x80"));              // continuation first
  EXPECT_FALSE(is_printable_utf8("\xC3"));              // cut short
  EXPECT_FALSE(is_printable_utf8("\xE7\xAE"));          // cut short
  EXPECT_FALSE(is_printable_utf8("\xC0\xAF"));          // overlong
  EXPECT_FALSE(is_printable_utf8("\xE0\x80\xAF"));      // overlong
  EXPECT_FALSE(is_printable_utf8("\xED\xA0\x80"));      // surrogate
  EXPECT_FALSE(is_printable_utf8("\xF4\x90\x80\x80"));  // beyond U+10FFFF
  EXPECT_FALSE(is_printable_utf8("\xC3("));             // no continuation
}

TEST(Utf8, LinesArePrintableOrMadeSo) {
  EXPECT_TRUE(are_printable_lines("Würfel\n\nbox"));
  EXPECT_FALSE(are_printable_lines("a\rb"));
  EXPECT_EQ(to_printable_lines("Würfel\nbox"), "Würfel\nbox");
  EXPECT_EQ(to_printable_lines("\r\x1B[\xC2\x85\xC3("), "??[???(");
  EXPECT_EQ(to_printable_lines(""), "");
}

}  // namespace
}  // namespace poinsot
