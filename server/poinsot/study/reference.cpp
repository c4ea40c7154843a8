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

// Relative to the limit; NaN counts as infinitely far.
double distance(const PoseError& error, const PoseError& limit) {
  const double x = std::max(error.position / limit.position, error.orientation / limit.orientation);
  return std::isfinite(x) ? x : INFINITY;
}

// One candidate and those that certify it.
struct Verdict {
  std::size_t reference = 0;
  std::vector<std::size_t> witnesses;
};

class Comparison {
 public:
  Comparison(const Scene& scene, const std::vector<Setting>& settings, const PoseError& limit)
      : limit_(limit), apart_(settings.size() * settings.size(), std::vector<PoseError>(1)) {
    candidates_.reserve(settings.size());
    for (const Setting& setting : settings) candidates_.emplace_back(scene, setting);
  }

  void advance() {
    for (Candidate& candidate : candidates_) candidate.advance();
  }

  void keep() {
    for (Candidate& candidate : candidates_) candidate.path.keep(candidate.layer.snapshot());
    for (std::size_t a = 0; a < size(); ++a)
      for (std::size_t b = 0; b < size(); ++b)
        apart(a, b).push_back(largest(apart(a, b).back(), apart_now(a, b)));
  }

  void thin() {
    for (Candidate& candidate : candidates_) candidate.path.thin();
    for (auto& history : apart_) thin_out(history);
  }

  // By what is known up to kept frame k.
  Verdict verdict(std::size_t k) const {
    const auto flown = std::find_if(candidates_.begin(), candidates_.end(),
                                    [](const Candidate& c) { return c.used.only_flight(); });
    Verdict verdict;
    if (flown != candidates_.end()) {
      verdict.reference = static_cast<std::size_t>(flown - candidates_.begin());
      verdict.witnesses = others(verdict.reference);
      const auto nearest = std::min_element(
          verdict.witnesses.begin(), verdict.witnesses.end(), [&](std::size_t a, std::size_t b) {
            return far(verdict.reference, a, k) < far(verdict.reference, b, k);
          });
      verdict.witnesses = {*nearest};
      return verdict;
    }
    for (std::size_t i = 1; i < size(); ++i)
      if (farthest(i, k) < farthest(verdict.reference, k)) verdict.reference = i;
    verdict.witnesses = others(verdict.reference);
    return verdict;
  }

  PoseError certificate(const Verdict& verdict, std::size_t k) const {
    PoseError error;
    for (const std::size_t w : verdict.witnesses)
      error = largest(error, apart(verdict.reference, w)[k]);
    return error;
  }
  bool agrees(std::size_t k) const { return distance(certificate(verdict(k), k), limit_) <= 1; }

  // Is there a witness that no method of the reference moves bodies in?
  bool is_independent(const Verdict& verdict) const {
    const MethodsUsed& used = candidates_[verdict.reference].used;
    return std::any_of(verdict.witnesses.begin(), verdict.witnesses.end(),
                       [&](std::size_t w) { return !used.shares_one_with(candidates_[w].used); });
  }

  std::string names(const std::vector<std::size_t>& indices) const {
    std::string text;
    for (const std::size_t i : indices) text += (text.empty() ? "" : " and ") + candidates_[i].name;
    return text;
  }
  std::size_t bodies() const { return candidates_.front().layer.snapshot().bodies.size(); }
  Path take_path(std::size_t i) { return std::move(candidates_[i].path); }

 private:
  std::size_t size() const { return candidates_.size(); }
  std::vector<PoseError>& apart(std::size_t a, std::size_t b) { return apart_[a * size() + b]; }
  const std::vector<PoseError>& apart(std::size_t a, std::size_t b) const {
    return apart_[a * size() + b];
  }

  // Bodies that were frozen where they are agree on nothing.
  PoseError apart_now(std::size_t a, std::size_t b) const {
    const Candidate &x = candidates_[a], &y = candidates_[b];
    if (x.layer.report().quarantined + y.layer.report().quarantined > 0)
      return {INFINITY, INFINITY};
    return Path::last_distance(x.path, y.path);
  }

  std::vector<std::size_t> others(std::size_t than) const {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < size(); ++i)
      if (i != than) all.push_back(i);
    return all;
  }
  double far(std::size_t a, std::size_t b, std::size_t k) const {
    return distance(apart(a, b)[k], limit_);
  }
  double farthest(std::size_t a, std::size_t k) const {
    double most = 0;
    for (const std::size_t b : others(a)) most = std::max(most, far(a, b, k));
    return most;
  }

  PoseError limit_;
  std::vector<Candidate> candidates_;
  std::vector<std::vector<PoseError>> apart_;  // of a and b: largest up to each kept frame
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
  Comparison comparison(scene, candidates, options.limit);
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
    if (!comparison.agrees(kept + 1)) {
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

  const Verdict verdict = comparison.verdict(kept);
  info.name = comparison.names({verdict.reference});
  info.check = comparison.names(verdict.witnesses);
  info.independent = comparison.is_independent(verdict);
  for (std::size_t k = 0; k <= kept; ++k)
    reference.certificate.push_back(comparison.certificate(verdict, k));
  info.certificate = reference.certificate.back();
  reference.path = comparison.take_path(verdict.reference);
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
