#include "poinsot/study/plot_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {
namespace {

// A word is some ten times as wide as it is high: what is near beside is far above. In parts of the
// picture's height; the picture is half as wide again.
constexpr double kWordHeight = 0.035;
constexpr double kWidthPerHeight = 4;
constexpr double kAspect = 1.5;

class Placing {
 public:
  explicit Placing(const std::vector<Curve>& curves) : curves_(curves) {
    for (const Curve& curve : curves)
      for (const PlotPoint& p : curve.points) {
        x_ = {std::min(x_.low, std::log10(p.x)), std::max(x_.high, std::log10(p.x))};
        y_ = {std::min(y_.low, std::log10(p.y)), std::max(y_.high, std::log10(p.y))};
      }
  }

  // From a place to the points and words of other curves.
  double room(const PlotPoint& at, std::size_t curve) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < curves_.size(); ++i)
      for (const PlotPoint& p : curves_[i].points)
        if (i != curve) least = std::min(least, distance(at, p.x, p.y));
    for (const PlotLabel& label : labels_)
      if (label.curve != curve || !label.is_name)
        least = std::min(least, distance(at, label.x, label.y));
    return least;
  }

  void add_name(std::size_t curve) {
    const auto& points = curves_[curve].points;
    const auto best = std::max_element(
        points.begin(), points.end(),
        [&](const PlotPoint& a, const PlotPoint& b) { return room(a, curve) < room(b, curve); });
    labels_.push_back({curves_[curve].name, curve, best->x, best->y, true});
  }

  void add_setting(std::size_t curve, const PlotPoint& point) {
    if (room(point, curve) < kWordHeight) return;
    labels_.push_back({point.label, curve, point.x, point.y, false});
  }

  std::vector<PlotLabel> take() { return std::move(labels_); }

 private:
  struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double part(double value) const {
      return high > low ? (std::log10(value) - low) / (high - low) : 0;
    }
  };

  double distance(const PlotPoint& at, double x, double y) const {
    const double across = kAspect * (x_.part(at.x) - x_.part(x)) / kWidthPerHeight;
    return std::hypot(across, y_.part(at.y) - y_.part(y));
  }

  const std::vector<Curve>& curves_;
  std::vector<PlotLabel> labels_;
  Range x_, y_;
};

}  // namespace

std::vector<PlotLabel> place_labels(const std::vector<Curve>& curves) {
  Placing placing(curves);
  for (std::size_t i = 0; i < curves.size(); ++i) placing.add_name(i);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto& points = curves[i].points;
    placing.add_setting(i, points.front());
    if (points.size() > 1) placing.add_setting(i, points.back());
  }
  return placing.take();
}

}  // namespace poinsot
