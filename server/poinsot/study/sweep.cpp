#include "poinsot/study/sweep.h"

#include <algorithm>
#include <map>
#include <utility>

#include "poinsot/base/error.h"
#include "poinsot/study/budget.h"
#include "poinsot/study/compare_searches.h"
#include "poinsot/study/measure.h"
#include "poinsot/study/pareto.h"
#include "poinsot/study/reference.h"
#include "poinsot/study/settings.h"

namespace poinsot {
namespace {

// Of its share of the time: the settings that are dearer than the reference must fit as well, and a
// median needs more than one run.
constexpr double kReferencePart = 0.5;

// The rows so far, by the place of their settings in the list.
class Rows {
 public:
  // Nothing if a row of the family has the same states: it speaks for both.
  Row* add(std::size_t place, Measurement measurement) {
    const auto equal = std::find_if(rows_.begin(), rows_.end(), [&](const auto& entry) {
      return entry.second.state_hash == measurement.state_hash &&
             entry.second.row.setting.family == measurement.row.setting.family;
    });
    if (equal == rows_.end())
      return &rows_.emplace(place, std::move(measurement)).first->second.row;
    Row& row = equal->second.row;
    Setting other = std::move(measurement.row.setting);
    if (speaks_for(other, row.setting)) std::swap(other, row.setting);
    row.setting.of_the_scene |= other.of_the_scene;
    row.equal.push_back(other.label);
    return nullptr;
  }

  std::vector<Row> take() {
    std::vector<Row> rows;
    for (auto& [place, measurement] : rows_) rows.push_back(std::move(measurement.row));
    return rows;
  }

 private:
  std::map<std::size_t, Measurement> rows_;
};

void measure_all(StudyResult& result, const Scene& scene, const std::vector<Setting>& settings,
                 const Reference& reference, Budget& budget, const ShowProgress& show,
                 const std::stop_token& stop) {
  Rows rows;
  std::vector<std::size_t> skipped;
  for (const std::size_t place : running_order(settings)) {
    const Setting& setting = settings[place];
    show(budget.shared_out(), setting.name());
    const RunLimit limit{budget.deadline(), stop};
    std::optional<Measurement> measured = measure(scene, setting, reference, limit);
    if (stop.stop_requested()) break;
    if (!measured)
      skipped.push_back(place);
    else if (Row* row = rows.add(place, *std::move(measured)))
      measure_cost(*row, scene, reference.frames, limit);
  }
  result.rows = rows.take();
  std::sort(skipped.begin(), skipped.end());
  for (const std::size_t place : skipped) result.skipped.push_back(settings[place]);
}

std::uint32_t moving_bodies(const Scene& scene) {
  return static_cast<std::uint32_t>(
      std::count_if(scene.bodies.begin(), scene.bodies.end(),
                    [](const BodyDef& body) { return !body.is_static; }));
}

}  // namespace

bool speaks_for(const Setting& a, const Setting& b) {
  if (is_default(a) != is_default(b)) return is_default(a);
  if (a.of_the_scene != b.of_the_scene) return a.of_the_scene;
  const SimulationDef &x = a.simulation, &y = b.simulation;
  return is_adaptive(x.integrator) ? x.tolerance < y.tolerance : x.step < y.step;
}

StudyResult sweep(const Scene& scene, const SweepOptions& options, const ShowProgress& show,
                  std::stop_token stop) {
  const std::uint32_t bodies = moving_bodies(scene);
  if (bodies == 0) throw Error("nothing moves in this scene: there is nothing to study");
  const std::vector<Setting> settings = settings_for(scene);
  const std::vector<Setting> candidates = reference_settings(scene);
  constexpr std::size_t kSearches = kImpactSearchNames.size();
  const std::size_t all = candidates.size() + settings.size() + kSearches;
  const double reference_part = static_cast<double>(candidates.size()) / static_cast<double>(all);
  Budget budget(options.budget, all);

  const Reference reference =
      make_reference(scene, candidates,
                     {.frames = options.frames,
                      .limit = agreement_limit(scene, options.wanted_error),
                      .deadline = budget.deadline(candidates.size(), kReferencePart),
                      .progress = [&](double done) { show(done * reference_part, "reference"); }},
                     stop);

  StudyResult result{.scene = scene.world,
                     .bodies = bodies,
                     .frame_rate = scene.presentation.frame_rate,
                     .asked = options.frames,
                     .horizon = reference.frames,
                     .stride = reference.stride,
                     .reference = reference.info};
  if (reference.frames > 0) {
    measure_all(result, scene, settings, reference, budget, show, stop);
    show(budget.shared_out(), "impact searches");
    if (!stop.stop_requested())
      result.searches = compare_searches(scene, reference.frames, reference.stride,
                                         {budget.deadline(kSearches), stop});
  }
  result.interrupted = stop.stop_requested();
  mark_pareto(result);
  return result;
}

}  // namespace poinsot
