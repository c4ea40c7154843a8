#include "poinsot/study/plot.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <spdlog/fmt/fmt.h>

namespace poinsot {
namespace {

constexpr double kMicro = 1e-6;
constexpr double kLowest = 1e-17;  // what a zero is drawn as
constexpr double kHighest = 1e2;   // a run that flies apart must not flatten the others

// Distinct for people who do not see all colours as well. Source: Okabe, Ito, Color Universal
// Design.
constexpr std::array<std::string_view, 7> kColors = {"#D55E00", "#0072B2", "#009E73", "#CC79A7",
                                                     "#E69F00", "#56B4E9", "#000000"};
constexpr std::array kPointTypes = {7, 5, 9, 13, 11, 15, 3};

struct Point {
  double cost;   // [us/s]
  double error;  // [m], [rad]
  std::string label;
};

struct Curve {
  std::string family;
  std::vector<Point> points;
};

Point point_of(const Row& row, const ReferenceInfo& reference) {
  return {row.cost.simulation / kMicro, std::max(known_error(row, reference).larger(), kLowest),
          row.setting.label};
}

std::vector<Curve> curves_of(const StudyResult& result) {
  std::vector<Curve> curves;
  for (const Row& row : result.rows) {
    if (curves.empty() || curves.back().family != row.setting.family)
      curves.push_back({row.setting.family, {}});
    curves.back().points.push_back(point_of(row, result.reference));
  }
  return curves;
}

// The front, from cheap to accurate.
std::vector<Point> front_of(const StudyResult& result) {
  std::vector<Point> front;
  for (const Row& row : result.rows)
    if (row.pareto) front.push_back(point_of(row, result.reference));
  std::sort(front.begin(), front.end(),
            [](const Point& a, const Point& b) { return a.cost < b.cost; });
  return front;
}

std::string data_block(const std::string& name, const std::vector<Point>& points) {
  std::string text = "$" + name + " << END\n";
  for (const Point& p : points) text += fmt::format("{:.9g} {:.9g}\n", p.cost, p.error);
  return text + "END\n";
}

std::string label(std::string_view text, double x, double y, std::string_view color,
                  std::string_view placing) {
  return fmt::format("set label '{}' at {:.9g},{:.9g} {} noenhanced textcolor rgb '{}' front\n",
                     text, x, y, placing, color);
}

std::string frame(const StudyResult& result, double lowest, double highest) {
  std::string text = fmt::format(
      "set terminal svg size 960,640 enhanced font 'sans,14' background '#ffffff'\n"
      "set title '{}: speed against error up to {:.6g} s' noenhanced\n"
      "set xlabel 'CPU time of simulation [µs per simulated second]'\n"
      "set ylabel 'largest error [m], [rad]'\n"
      "set logscale xy\nset format xy '10^{{%T}}'\n"
      "set grid xtics ytics linecolor rgb '#dddddd' linetype 1\n"
      "set key outside right top noenhanced spacing 1.3\n"
      "set yrange [{:.3g}:{:.3g}]\nset offsets graph 0.08, graph 0.08, 0, 0\n",
      result.scene, result.horizon_time(), lowest / 5, highest * 5);
  return text;
}

std::string certificate_line(double certificate) {
  if (certificate < kLowest) return {};
  return fmt::format(
      "set arrow from graph 0, first {0:.9g} to graph 1, first {0:.9g} nohead dashtype 2 "
      "linecolor rgb '#555555'\n"
      "set label 'certificate of the reference' at graph 0.01, first {0:.9g} offset 0,-0.7 "
      "textcolor rgb '#555555' font ',11'\n",
      certificate);
}

}  // namespace

std::string plot_script(const StudyResult& result) {
  const std::vector<Curve> curves = curves_of(result);
  const std::vector<Point> front = front_of(result);
  const double certificate = result.reference.certificate.larger();
  double lowest = kHighest, highest = std::max(certificate, kLowest);
  for (const Curve& curve : curves)
    for (const Point& p : curve.points) {
      lowest = std::min(lowest, p.error);
      highest = std::max(highest, std::min(p.error, kHighest));
    }

  std::string text = frame(result, lowest, highest) + certificate_line(certificate);
  std::string plot = "plot $front using 1:2 with lines linewidth 6 linecolor rgb '#e8e8e8' notitle";
  text += data_block("front", front);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Curve& curve = curves[i];
    const std::string block = "curve" + std::to_string(i);
    const std::string_view color = kColors[i % kColors.size()];
    text += data_block(block, curve.points);
    const Point& first = curve.points.front();
    const Point& last = curve.points.back();
    text += label(curve.family, first.cost, std::min(first.error, highest), color,
                  "center offset 0,0.9");
    if (curve.points.size() > 1)
      text += label(last.label, last.cost, last.error, color, "left offset 0.8,0 font ',11'");
    plot += fmt::format(
        ", ${} using 1:2 with linespoints linewidth 2 pointtype {} pointsize 0.7 linecolor rgb "
        "'{}' "
        "title '{}'",
        block, kPointTypes[i % kPointTypes.size()], color, curve.family);
  }
  return text + plot +
         ", $front using 1:2 with points pointtype 6 pointsize 1.6 linewidth 2 linecolor rgb "
         "'#000000' title 'Pareto front'\n";
}

}  // namespace poinsot
