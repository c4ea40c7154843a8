#include "poinsot/client/scene_book.h"

#include <algorithm>
#include <utility>

namespace poinsot {

void SceneBook::join() {
  for (auto& [session, sheet] : sheets_) sheet.first_report = sheet.reported;
}

void SceneBook::add(BodyInfo body) {
  if (body.removed) {
    const auto sheet = sheets_.find(body.session);
    if (sheet == sheets_.end()) return;
    sheet->second.bodies.erase(body.id);
    sheet->second.removal_came_last = true;
    return;
  }
  newest_session_ = body.session;
  Sheet& sheet = sheets_[body.session];
  sheet.newest = std::max(sheet.newest, body.revision);
  sheet.removal_came_last = false;
  sheet.bodies[body.id] = std::move(body);
  forget_others();
}

void SceneBook::add(const RunReport& report) {
  session_ = report.session;
  Sheet& sheet = sheets_[report.session];
  if (sheet.first_report == 0) sheet.first_report = report.scene_revision;
  sheet.reported = report.scene_revision;
  sheet.expected = report.scene_bodies;
  sheet.epoch = report.epoch;
  sheet.frame = report.frame.frame;
  forget_others();
}

void SceneBook::add(const PoseSnapshot& poses) {
  session_ = read_session_ = poses.session;
  read_epoch_ = poses.epoch;
  read_frame_ = poses.frame;
  read_.resize(poses.bodies.size());
  for (std::size_t i = 0; i < read_.size(); ++i) read_[i] = poses.bodies[i].id;
}

bool SceneBook::is_complete() const {
  const Sheet& sheet = looked_at();
  const bool last_change_came = sheet.reported == sheet.first_report ||
                                sheet.newest >= sheet.reported || sheet.removal_came_last;
  return sheet.first_report != 0 && sheet.bodies.size() == sheet.expected && last_change_came &&
         knows_what_was_read(sheet);
}

std::vector<BodyInfo> SceneBook::bodies() const {
  std::vector<BodyInfo> bodies;
  for (const auto& [id, body] : looked_at().bodies) bodies.push_back(body);
  return bodies;
}

const SceneBook::Sheet& SceneBook::looked_at() const {
  static const Sheet kNone;
  const auto found = sheets_.find(session_ != 0 ? session_ : newest_session_);
  return found == sheets_.end() ? kNone : found->second;
}

// A frame may arrive before the report of what was spawned in it: a report of that frame or a later
// one settles it.
bool SceneBook::knows_what_was_read(const Sheet& sheet) const {
  if (read_session_ != session_) return true;
  if (std::pair(sheet.epoch, sheet.frame) >= std::pair(read_epoch_, read_frame_)) return true;
  return std::all_of(read_.begin(), read_.end(),
                     [&](BodyId id) { return sheet.bodies.contains(id); });
}

// A daemon that is gone is looked at a little longer than it lives; older ones are not.
void SceneBook::forget_others() {
  std::erase_if(sheets_, [this](const auto& entry) {
    return entry.first != session_ && entry.first != newest_session_;
  });
}

}  // namespace poinsot
