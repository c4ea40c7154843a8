#include "poinsot/study/compare_searches.h"

#include <optional>

#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/study/settings.h"

namespace poinsot {
namespace {

// Work of a whole run.
struct Work {
  double impacts = 0, searches = 0, poses = 0, gaps = 0, contacts = 0;

  void add(const CollisionReport& report) {
    impacts += report.impacts;
    searches += report.searches;
    poses += static_cast<double>(report.search_poses);
    gaps += static_cast<double>(report.search_gaps);
    contacts += report.contacts;
  }
};

// Nothing if the limit comes first. Keeps every `stride` frames, and the last, if there is a path.
std::optional<Work> count_work(const Scene& scene, std::uint64_t frames, std::uint64_t stride,
                               const RunLimit& limit, Path* path) {
  PresentationLayer layer(scene);
  Work work;
  if (path != nullptr) path->keep(layer.snapshot());
  while (layer.frame() < frames) {
    if (limit.stop.stop_requested() || std::chrono::steady_clock::now() > limit.deadline)
      return std::nullopt;
    layer.advance_frame();
    work.add(layer.collision_report());
    if (path != nullptr && (layer.frame() % stride == 0 || layer.frame() == frames))
      path->keep(layer.snapshot());
  }
  return work;
}

}  // namespace

std::vector<SearchRow> compare_searches(const Scene& scene, std::uint64_t frames,
                                        std::uint64_t stride, const RunLimit& limit) {
  std::vector<SearchRow> rows;
  Reference one_sided;
  one_sided.frames = frames;
  one_sided.stride = stride;
  const double seconds = static_cast<double>(frames) / scene.presentation.frame_rate;
  for (const Named<ImpactSearchKind>& row : kImpactSearchNames) {  // `conservative` first
    Scene changed = scene;
    changed.collision.impact_search = row.value;
    const bool is_reference = rows.empty();
    const auto work =
        count_work(changed, frames, stride, limit, is_reference ? &one_sided.path : nullptr);
    if (!work || (is_reference && work->searches == 0 && work->contacts == 0)) break;
    const Setting own = make_setting(scene.simulation);
    auto measured = measure(changed, own, one_sided, limit);
    if (!measured) break;
    measure_cost(measured->row, changed, frames, limit);
    rows.push_back({.search = row.value,
                    .of_the_scene = row.value == scene.collision.impact_search,
                    .difference = measured->row.measured,
                    .energy_error = measured->row.energy_error,
                    .cost = measured->row.cost,
                    .runs = measured->row.runs,
                    .impacts = work->impacts / seconds,
                    .searches = work->searches / seconds,
                    .poses = work->poses / seconds,
                    .gaps = work->gaps / seconds});
  }
  return rows;
}

}  // namespace poinsot
