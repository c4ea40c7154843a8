// What a hard case measured, as properties of its test: run with --gtest_output=xml to read them.

#pragma once

#include <cstdio>
#include <string>

#include <gtest/gtest.h>

namespace poinsot::test {

inline void measured(const std::string& name, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  testing::Test::RecordProperty(name, text);
}

}  // namespace poinsot::test
