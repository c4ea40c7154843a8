#include "poinsot/study/plot.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "poinsot/study/plot_labels.h"

namespace poinsot {
namespace {

constexpr double kMicro = 1e-6;
constexpr double kLowest = 1e-17;   // what a zero is drawn as
constexpr double kHighest = 1e2;    // a run that flies apart must not flatten the others
constexpr double kCheapest = 1e-6;  // [us/s] as a zero

// Distinct for people who do not see all colours as well. Source: Okabe, Ito, Color Universal
// Design.
constexpr std::array<std::string_view, 7> kColors = {"#D55E00", "#0072B2", "#009E73", "#CC79A7",
                                                     "#E69F00", "#56B4E9", "#000000"};
constexpr std::array kPointTypes = {7, 5, 9, 13, 11, 15, 3};

PlotPoint point_of(const Row& row, const ReferenceInfo& reference) {
  const double error = known_error(row, reference).larger();
  return {std::max(row.cost.simulation / kMicro, kCheapest), std::clamp(error, kLowest, kHighest),
          row.setting.label};
}

std::vector<Curve> curves_of(const StudyResult& result) {
  std::vector<Curve> curves;
  for (const Row& row : result.rows) {
    if (curves.empty() || curves.back().name != row.setting.family)
      curves.push_back({row.setting.family, {}});
    curves.back().points.push_back(point_of(row, result.reference));
  }
  return curves;
}

// The front, from cheap to accurate.
std::vector<PlotPoint> front_of(const StudyResult& result) {
  std::vector<PlotPoint> front;
  for (const Row& row : result.rows)
    if (row.pareto) front.push_back(point_of(row, result.reference));
  std::sort(front.begin(), front.end(),
            [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
  return front;
}

std::string data_block(const std::string& name, const std::vector<PlotPoint>& points) {
  std::string text = "$" + name + " << END\n";
  for (const PlotPoint& p : points) text += fmt::format("{:.9g} {:.9g}\n", p.x, p.y);
  return text + "END\n";
}

// Names stand above and right of their point, settings below and left: curves fall to the right.
std::string label_line(const PlotLabel& label) {
  return fmt::format("set label '{}' at {:.9g},{:.9g} {} noenhanced textcolor rgb '{}' front\n",
                     label.text, label.x, label.y,
                     label.is_name ? "left offset 0.7,0.5" : "right offset -0.7,-0.4 font ',10'",
                     kColors[label.curve % kColors.size()]);
}

std::string frame(const StudyResult& result, const std::vector<Curve>& curves) {
  PlotPoint least = curves.front().points.front(), most = least;
  for (const Curve& curve : curves)
    for (const PlotPoint& p : curve.points) {
      least = {std::min(least.x, p.x), std::min(least.y, p.y), {}};
      most = {std::max(most.x, p.x), std::max(most.y, p.y), {}};
    }
  return fmt::format(
      "set terminal svg size 960,640 enhanced font 'sans,14' background '#ffffff'\n"
      "set title '{}: speed against error up to {:.6g} s' noenhanced\n"
      "set xlabel 'CPU time of simulation [µs per simulated second]'\n"
      "set ylabel 'largest error [m], [rad]'\n"
      "set logscale xy\nset format xy '10^{{%T}}'\n"
      "set grid xtics ytics linecolor rgb '#dddddd' linetype 1\n"
      "set key outside right top noenhanced spacing 1.3\n"
      "set xrange [{:.3g}:{:.3g}]\nset yrange [{:.3g}:{:.3g}]\n",
      result.scene, result.horizon_time(), least.x / 2, most.x * 4, least.y / 5, most.y * 5);
}

std::string certificate_line(double certificate) {
  if (certificate < kLowest) return {};
  return fmt::format(
      ", {:.9g} with lines dashtype 2 linewidth 2 linecolor rgb '#555555' title "
      "'certificate'",
      certificate);
}

}  // namespace

std::string plot_script(const StudyResult& result) {
  const std::vector<Curve> curves = curves_of(result);

  std::string text = frame(result, curves);
  for (const PlotLabel& label : place_labels(curves)) text += label_line(label);
  text += data_block("front", front_of(result));
  std::string plot = "plot $front using 1:2 with lines linewidth 6 linecolor rgb '#e8e8e8' notitle";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string block = "curve" + std::to_string(i);
    text += data_block(block, curves[i].points);
    plot += fmt::format(
        ", ${} using 1:2 with linespoints linewidth 2 pointtype {} pointsize 0.7 linecolor rgb "
        "'{}' "
        "title '{}'",
        block, kPointTypes[i % kPointTypes.size()], kColors[i % kColors.size()], curves[i].name);
  }
  return text + plot + certificate_line(result.reference.certificate.larger()) +
         ", $front using 1:2 with points pointtype 6 pointsize 1.6 linewidth 2 linecolor rgb "
         "'#000000' title 'Pareto front'\n";
}

}  // namespace poinsot
