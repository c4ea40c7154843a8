// What a hard case measured, as properties of its test: run with --gtest_output=xml to read them.

#pragma once

#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/collision/collision_layer.h"

namespace poinsot::test {

inline void measured(const std::string& name, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  testing::Test::RecordProperty(name, text);
}

// The relative error of energy so far, and the impacts of the last frame.
inline void measured_books(CollisionLayer& layer, const std::string& of = "") {
  measured(of + "energy_error", layer.energy_error());
  measured(of + "impact_loss_J", layer.report().impact_loss);
}

}  // namespace poinsot::test
