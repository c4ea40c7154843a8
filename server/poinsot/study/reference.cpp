#include "poinsot/study/reference.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/study/methods_used.h"
#include "poinsot/study/settings.h"

namespace poinsot {
namespace {

constexpr double kAgreement = 1e-6;            // [rad], and relative to a body's size
constexpr double kAgreementPerError = 0.1;     // [-] a wanted error is resolved ten times
constexpr double kReferenceTolerance = 1e-13;  // of dop853

struct Candidate {
  Candidate(const Scene& scene, const Setting& setting)
      : name(setting.name()), layer(with(scene, setting)) {
    path.keep(layer.snapshot());
  }

  void advance() {
    layer.advance_frame();
    used.see(layer.report());
  }

  std::string name;
  PresentationLayer layer;
  MethodsUsed used;
  Path path;
};

// Two candidates and how far they were apart, up to each kept frame.
struct Pair {
  std::size_t a, b;
  std::vector<PoseError> apart = {{}};
};

// Relative to the limit; NaN counts as infinitely far.
double distance(const PoseError& error, const PoseError& limit) {
  const double x = std::max(error.position / limit.position, error.orientation / limit.orientation);
  return std::isfinite(x) ? x : INFINITY;
}

class Comparison {
 public:
  Comparison(const Scene& scene, const std::vector<Setting>& settings) {
    candidates_.reserve(settings.size());
    for (const Setting& setting : settings) candidates_.emplace_back(scene, setting);
    for (std::size_t a = 0; a < candidates_.size(); ++a)
      for (std::size_t b = a + 1; b < candidates_.size(); ++b) pairs_.push_back({a, b});
  }

  void advance() {
    for (Candidate& candidate : candidates_) candidate.advance();
  }

  void keep() {
    for (Candidate& candidate : candidates_) candidate.path.keep(candidate.layer.snapshot());
    for (Pair& pair : pairs_) pair.apart.push_back(largest(pair.apart.back(), apart_now(pair)));
  }

  void thin() {
    for (Candidate& candidate : candidates_) candidate.path.thin();
    for (Pair& pair : pairs_) thin_out(pair.apart);
  }

  // Independent pairs go first; then the one that is least apart up to kept frame k.
  const Pair& best(std::size_t k, const PoseError& limit) const {
    return *std::min_element(pairs_.begin(), pairs_.end(), [&](const Pair& x, const Pair& y) {
      if (independent(x) != independent(y)) return independent(x);
      return distance(x.apart[k], limit) < distance(y.apart[k], limit);
    });
  }
  bool independent(const Pair& pair) const {
    return !candidates_[pair.a].used.shares_one_with(candidates_[pair.b].used);
  }
  std::size_t bodies() const { return candidates_.front().layer.snapshot().bodies.size(); }
  Candidate& candidate(std::size_t i) { return candidates_[i]; }

 private:
  // Bodies that were frozen where they are agree on nothing.
  PoseError apart_now(const Pair& pair) const {
    const Candidate &a = candidates_[pair.a], &b = candidates_[pair.b];
    if (a.layer.report().quarantined + b.layer.report().quarantined > 0)
      return {INFINITY, INFINITY};
    return Path::last_distance(a.path, b.path);
  }

  std::vector<Candidate> candidates_;
  std::vector<Pair> pairs_;
};

std::optional<HorizonEnd> must_end(const ReferenceOptions& options, std::size_t kept,
                                   const std::stop_token& stop) {
  if (stop.stop_requested()) return HorizonEnd::interrupted;
  const bool late = kept > 0 && std::chrono::steady_clock::now() > options.deadline;
  return late ? std::optional(HorizonEnd::budget) : std::nullopt;
}

}  // namespace

std::vector<Setting> reference_settings(const Scene& scene) {
  std::vector<Setting> settings;
  for (const auto& [kind, tolerance] :
       {std::pair(IntegratorKind::exact, 0.0), std::pair(IntegratorKind::taylor, 0.0),
        std::pair(IntegratorKind::dop853, kReferenceTolerance)}) {
    SimulationDef simulation = scene.simulation;
    simulation.integrator = kind;
    simulation.tolerance = tolerance;
    settings.push_back(make_setting(simulation));
  }
  return settings;
}

Reference make_reference(const Scene& scene, const std::vector<Setting>& candidates,
                         const ReferenceOptions& options, std::stop_token stop) {
  Comparison comparison(scene, candidates);
  Reference reference;
  ReferenceInfo& info = reference.info;
  info.limit = options.limit;
  std::size_t kept = 0;  // frames after the first that are agreed on
  for (std::uint64_t frame = 1; frame <= options.frames; ++frame) {
    if (const auto end = must_end(options, kept, stop)) {
      info.end = *end;
      break;
    }
    comparison.advance();
    if (frame % reference.stride != 0 && frame != options.frames) continue;
    comparison.keep();
    if (distance(comparison.best(kept + 1, info.limit).apart.back(), info.limit) > 1) {
      info.end = HorizonEnd::disagreement;
      break;
    }
    ++kept;
    reference.frames = frame;
    if (kept % 2 == 0 && kept * comparison.bodies() > options.max_poses) {
      comparison.thin();
      kept /= 2;
      reference.stride *= 2;
    }
    options.progress(static_cast<double>(frame) / static_cast<double>(options.frames));
  }

  const Pair& pair = comparison.best(kept, info.limit);
  info.name = comparison.candidate(pair.a).name;
  info.check = comparison.candidate(pair.b).name;
  info.independent = comparison.independent(pair);
  reference.certificate.assign(pair.apart.begin(),
                               pair.apart.begin() + static_cast<std::ptrdiff_t>(kept + 1));
  info.certificate = reference.certificate.back();
  reference.path = std::move(comparison.candidate(pair.a).path);
  reference.path.cut(kept + 1);
  return reference;
}

PoseError agreement_limit(const Scene& scene, double wanted_error) {
  double size = 0;  // [m]
  for (const BodyDef& body : scene.bodies) {
    if (body.is_static) continue;
    const MassProperties& m = body.mass_properties;
    size = std::max(size, std::sqrt(m.J.trace() / (2 * m.mass)));
  }
  PoseError limit{kAgreement * size, kAgreement};
  if (wanted_error > 0) {
    limit.position = std::min(limit.position, kAgreementPerError * wanted_error);
    limit.orientation = std::min(limit.orientation, kAgreementPerError * wanted_error);
  }
  return limit;
}

}  // namespace poinsot
