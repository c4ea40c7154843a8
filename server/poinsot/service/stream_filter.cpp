#include "poinsot/service/stream_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace poinsot {
namespace {

// [rad] by which b is turned against a.
double turned(const Quat& a, const Quat& b) {
  const Quat turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

}  // namespace

void StreamFilter::set_bodies(std::span<const NamedBody> bodies) {
  std::fill(wanted_.begin(), wanted_.end(), 0u);
  for (const NamedBody& body : bodies) {
    if (!body.id) continue;
    if (body.id.slot >= wanted_.size()) wanted_.resize(body.id.slot + 1, 0);
    if (matches(filter_.match, body.name)) wanted_[body.id.slot] = body.id.generation;
  }
  if (filter_.change) sent_.resize(wanted_.size());
}

bool StreamFilter::take(const PoseSnapshot& frame, std::int64_t now, PoseSnapshot& out) {
  const bool known = frame.epoch == epoch_ && frame.frame == frame_ && frame.state_hash == hash_;
  if ((known && !joined_) || !is_due(now)) return false;
  // A complete sample for who joins, and after a reset, when bodies may be anywhere.
  const bool complete = !filter_.change || joined_ || frame.epoch != epoch_;

  out.epoch = frame.epoch;
  out.frame = frame.frame;
  out.sim_time_ns = frame.sim_time_ns;
  out.state_hash = frame.state_hash;
  out.total = 0;
  out.complete = complete;
  out.bodies.clear();
  for (const BodyState& body : frame.bodies) {
    if (body.id.slot >= wanted_.size() || wanted_[body.id.slot] != body.id.generation) continue;
    ++out.total;
    if (filter_.change && !changed(body, sent_[body.id.slot]) && !complete) continue;
    if (filter_.change) sent_[body.id.slot] = {body.id.generation, body.position, body.orientation};
    out.bodies.push_back(body);
  }
  epoch_ = frame.epoch;
  frame_ = frame.frame;
  hash_ = frame.state_hash;
  if (!complete && out.bodies.empty()) return false;
  joined_ = false;
  set_next_due(now);
  return true;
}

// Evenly spaced, without making up for times when nothing came.
void StreamFilter::set_next_due(std::int64_t now) {
  if (filter_.rate == 0) return;
  const auto period = static_cast<std::int64_t>(1e9 / filter_.rate);
  due_ = std::min(due_ + period, now + period);  // who joins early delays nobody
  if (due_ <= now) due_ = now - now % period + period;
}

bool StreamFilter::changed(const BodyState& body, Sent& sent) const {
  if (sent.generation != body.id.generation) return true;
  return (body.position - sent.position).norm() > *filter_.change ||
         turned(sent.orientation, body.orientation) > *filter_.change;
}

}  // namespace poinsot
