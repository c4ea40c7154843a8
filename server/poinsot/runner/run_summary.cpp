#include "poinsot/runner/run_summary.h"

#include <cstdio>

#include "poinsot/protocol/methods_text.h"

namespace poinsot {
namespace {

// printf into a string; the formats below are far shorter than the buffer.
template <class... Values>
std::string print(const char* format, Values... values) {
  char buffer[512];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

}  // namespace

RunSummary summarize(const PresentationLayer& layer, std::uint64_t frames, double wall_s,
                     const Elapsed& publishing) {
  RunSummary summary;
  summary.frames = frames;
  summary.sim_time = static_cast<double>(frames) / layer.frame_rate();
  summary.wall_s = wall_s;
  summary.times = layer.times();
  summary.times.publishing = publishing;
  summary.last = layer.report();
  summary.state_hash = layer.snapshot().state_hash;
  return summary;
}

std::string to_text(const RunSummary& s) {
  const LayerTimes& t = s.times;
  std::string text;
  text += print("frames        %llu\n", static_cast<unsigned long long>(s.frames));
  text += print("simulated     %.6g s\n", s.sim_time);
  text += print("wall          %.6g s (real-time factor %.4g)\n", s.wall_s,
                s.wall_s > 0 ? s.sim_time / s.wall_s : 0.0);
  text += print("cpu           presentation %.4g s, collision %.4g s, contact %.4g s,\n",
                t.presentation.cpu_s, t.collision.cpu_s, t.contact.cpu_s);
  text += print("              simulation %.4g s, publishing %.4g s\n", t.simulation.cpu_s,
                t.publishing.cpu_s);
  const std::string methods = methods_text(s.last);
  text += print("bodies        %u", s.last.bodies) + (methods.empty() ? "" : ": " + methods) + '\n';
  text += print("impacts       %llu; last frame: %u islands, %u restarts, %u searches, %u asleep\n",
                static_cast<unsigned long long>(s.last.impacts_so_far), s.last.islands,
                s.last.restarts, s.last.impact_searches, s.last.asleep);
  text += print("contacts      %u, deepest %.3g m (last frame)\n", s.last.contacts,
                s.last.max_penetration);
  text += print(
      "solvers       last frame: %u bodies soft_step, %u convex_newton in %u iterations,\n"
      "              %u unconverged, residual %.3g m/s\n",
      s.last.soft_bodies, s.last.direct_bodies, s.last.solver_iterations, s.last.unconverged,
      s.last.contact_residual);
  text += print("energy error  %.3g\n", s.last.energy_error);
  text += print("momentum      error %.3g\n", s.last.momentum_error);
  text += print("local error   %.3g m, %.3g rad (last frame)\n", s.last.position_error,
                s.last.orientation_error);
  text += print("state hash    %016llx\n", static_cast<unsigned long long>(s.state_hash));
  return text;
}

std::string to_json(const RunSummary& s) {
  const LayerTimes& t = s.times;
  std::string methods;
  for (const Named<Method>& row : kMethodNames) {
    methods.append(methods.empty() ? "\"" : ", \"").append(row.name).append("\": ");
    methods += std::to_string(s.last.methods[static_cast<std::size_t>(row.value)]);
  }
  std::string text = print(
      "{\"frames\": %llu, \"sim_time\": %.17g, \"wall_s\": %.9g, \"cpu_s\": {\"presentation\": "
      "%.9g, \"collision\": %.9g, \"contact\": %.9g, \"simulation\": %.9g, \"publishing\": %.9g}, ",
      static_cast<unsigned long long>(s.frames), s.sim_time, s.wall_s, t.presentation.cpu_s,
      t.collision.cpu_s, t.contact.cpu_s, t.simulation.cpu_s, t.publishing.cpu_s);
  text += print(
      "\"bodies\": %u, \"energy_error\": %.9g, \"momentum_error\": %.9g, \"position_error\": %.9g, "
      "\"orientation_error\": %.9g, ",
      s.last.bodies, s.last.energy_error, s.last.momentum_error, s.last.position_error,
      s.last.orientation_error);
  text += print(
      "\"impacts\": %llu, \"islands\": %u, \"restarts\": %u, \"impact_searches\": %u, \"asleep\": "
      "%u, \"crowded\": %s, ",
      static_cast<unsigned long long>(s.last.impacts_so_far), s.last.islands, s.last.restarts,
      s.last.impact_searches, s.last.asleep,
      has_flag(s.last.flags, FrameFlag::crowded) ? "true" : "false");
  text += print(
      "\"soft_bodies\": %u, \"direct_bodies\": %u, \"solver_iterations\": %u, \"unconverged\": %u, "
      "\"contact_residual\": %.9g, \"max_penetration\": %.9g, ",
      s.last.soft_bodies, s.last.direct_bodies, s.last.solver_iterations, s.last.unconverged,
      s.last.contact_residual, s.last.max_penetration);
  text += "\"methods\": {" + methods + "}, ";
  return text +
         print("\"state_hash\": \"%016llx\"}\n", static_cast<unsigned long long>(s.state_hash));
}

}  // namespace poinsot
