// Where the words of a plot stand: at points that are far from those of other curves, and from
// words that stand already.

#pragma once

#include <string>
#include <vector>

namespace poinsot {

// A point of a plot with log axes. Both coordinates are > 0.
struct PlotPoint {
  double x = 0;
  double y = 0;
  std::string label;  // of its setting
};

struct Curve {
  std::string name;
  std::vector<PlotPoint> points;
};

struct PlotLabel {
  std::string text;
  std::size_t curve = 0;  // whose colour it has
  double x = 0;
  double y = 0;
  bool is_name = true;  // of a curve; else of a setting
};

// The name of each curve at the point of it that is farthest from all other curves; then the first
// and last setting of each where there is room.
std::vector<PlotLabel> place_labels(const std::vector<Curve>& curves);

}  // namespace poinsot
