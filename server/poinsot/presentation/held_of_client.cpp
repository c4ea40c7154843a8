#include "poinsot/presentation/held_of_client.h"

#include <algorithm>

namespace poinsot {
namespace {

constexpr std::uint64_t kNever = 0;  // the last frame of what has not begun and never will

}  // namespace

void HeldOfClient::add(const Held& held) {
  const auto after = std::upper_bound(items_.begin(), items_.end(), held.seq,
                                      [](auto seq, const Held& h) { return seq < h.seq; });
  tags_.insert(tags_.begin() + (after - items_.begin()),
               {held.slot, static_cast<std::uint32_t>(held.column)});
  items_.insert(after, held);
  ++counts_[static_cast<std::size_t>(held.kind)];
  ++live_;
  next_end_ = std::min(next_end_, held.changes_after(held.first_frame));
  digest_ = 0;
}

bool HeldOfClient::matches(std::size_t k, const Selection& selection) const {
  return (selection.slot == 0 || tags_[k].slot == selection.slot) &&
         (!selection.column || tags_[k].column == static_cast<std::uint32_t>(*selection.column));
}

void HeldOfClient::end_item(Held& held, std::uint64_t last, std::uint64_t next) {
  if (held.last_frame >= next && last < next) --live_;
  held.last_frame = last;
  next_end_ = std::min(next_end_, last + 1);
  digest_ = 0;
}

KindSet HeldOfClient::end(const Selection& selection, std::uint64_t frame, std::uint64_t next) {
  KindSet kinds = 0;
  for (std::size_t k = 0; k < items_.size(); ++k) {
    if (!matches(k, selection)) continue;
    Held& held = items_[k];
    if (held.last_frame < frame) continue;
    kinds |= set_of(held.kind);
    end_item(held, held.first_frame < frame ? frame - 1 : kNever, next);
  }
  return kinds;
}

std::size_t HeldOfClient::count_over(const Selection& selection, std::uint64_t frame,
                                     std::uint64_t next) const {
  std::size_t count = 0;
  for (std::size_t k = 0; k < items_.size(); ++k) {
    if (!matches(k, selection)) continue;
    const Held& held = items_[k];
    if (held.last_frame < next || held.last_frame < frame) continue;
    if (held.first_frame >= frame || frame <= next) ++count;
  }
  return count;
}

KindSet HeldOfClient::release() {
  KindSet kinds = 0;
  for (Held& held : items_) {
    if (held.outlives_client) continue;
    kinds |= set_of(held.kind);
    end_item(held, kNever, kNever + 1);
  }
  return kinds;
}

bool HeldOfClient::sweep(std::uint64_t next) {
  if (next < next_end_) return false;
  std::size_t kept = 0;
  counts_ = {};
  next_end_ = kForever;
  for (std::size_t k = 0; k < items_.size(); ++k) {
    if (items_[k].last_frame < next) continue;
    if (kept != k) {
      items_[kept] = items_[k];
      tags_[kept] = tags_[k];
    }
    const Held& held = items_[kept++];
    ++counts_[static_cast<std::size_t>(held.kind)];
    if (held.last_frame != kForever) next_end_ = std::min(next_end_, held.last_frame + 1);
  }
  const bool forgot = kept < items_.size();
  items_.resize(kept);
  tags_.resize(kept);
  live_ = kept;
  if (forgot) digest_ = 0;
  return forgot;
}

std::uint64_t HeldOfClient::digest() const {
  if (digest_ != 0) return digest_;
  Hash64 hash;
  for (const Held& held : items_) {
    hash.add(held.seq);
    hash.add(held.first_frame);
    hash.add(held.last_frame);
    hash.add(static_cast<std::uint64_t>(held.column));
    hash.add(std::uint64_t{held.slot} << 32 | static_cast<std::uint64_t>(held.kind) << 16 |
             static_cast<std::uint64_t>(held.axes) << 8 | (held.outlives_client ? 1U : 0U));
    for (const Vec3* v : {&held.force, &held.torque, &held.p_B, &held.target})
      hash.add(std::span(v->data(), 3));
    hash.add(held.stiffness);
    hash.add(held.damping);
  }
  return digest_ = hash.value() | 1;
}

}  // namespace poinsot
