#include "poinsot/runner/base64.h"

#include <gtest/gtest.h>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

std::string encoded(std::string_view text) {
  return to_base64(std::as_bytes(std::span(text)));
}

TEST(Base64, GivesTheTextsOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(Base64, EveryByteComesBack) {
  std::vector<std::byte> bytes;
  for (int k = 0; k < 1000; ++k) {
    EXPECT_EQ(from_base64(to_base64(bytes)), bytes);
    bytes.push_back(static_cast<std::byte>(k * 37 + k / 256));
  }
}

TEST(Base64, RefusesWhatItDoesNotMake) {
  for (const char* text :
       {"Z", "Zg", "Zg=", "Zh==", "Zm9=", "=Zg=", "Zg==Zg==", "Zm 9", "====", "Zm9v\n"})
    EXPECT_THROW(from_base64(text), Error) << text;
}

}  // namespace
}  // namespace poinsot
