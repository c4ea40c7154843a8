#include "poinsot/cli/held.h"

#include <spdlog/fmt/fmt.h>

#include "poinsot/cli/json_line.h"
#include "poinsot/cli/slots.h"
#include "poinsot/cli/units.h"
#include "poinsot/cli/words.h"

namespace poinsot {
namespace {

std::string client_text(const HeldView& view, std::uint64_t client) {
  if (client == 0) return "scene";
  return client == view.me ? "you" : hex(client);
}

std::string slot_text(std::uint32_t slot) {
  if (slot == 0) return "-";
  return is_drag_slot(slot) ? "drag" : std::to_string(slot);
}

std::string body_name(const HeldView& view, BodyId id) {
  const std::string* const name = view.roster.name(id);
  return name != nullptr ? *name : fmt::format("({}, {})", id.slot, id.generation);
}

std::string what_text(const HeldItem& item) {
  const std::string at = " at " + vector_text(item.point_B) + " m";
  if (item.kind == WrenchKind::tether)
    return fmt::format("tether to {} m, {:g} N/m, {:g} N s/m,{}", vector_text(item.target),
                       item.stiffness, item.damping, at);
  const bool impulse = item.kind == WrenchKind::impulse;
  std::string text;
  if (item.force != Vec3::Zero())
    text = (impulse ? "impulse " : "force ") + vector_text(item.force) + (impulse ? " N s" : " N") +
           at;
  if (item.torque != Vec3::Zero())
    text += (text.empty() ? "" : ", ") + std::string(impulse ? "angular impulse " : "torque ") +
            vector_text(item.torque) + (impulse ? " N m s" : " N m");
  return text + (item.axes == Axes::world ? ", world axes" : ", body axes");
}

std::string frames_text(const HeldItem& item) {
  return item.last_frame == kForever ? fmt::format("{}-", item.first_frame)
                                     : fmt::format("{}-{}", item.first_frame, item.last_frame);
}

}  // namespace

std::string held_text(const HeldView& view) {
  const HeldList& held = view.held;
  if (held.items.empty()) return fmt::format("frame {}: nothing is held\n", held.frame);
  std::string text =
      fmt::format("{:<16} {:<6} {:<20} {:<16} {}\n", "client", "slot", "body", "frames", "what");
  for (const HeldItem& item : held.items)
    text += fmt::format("{:<16} {:<6} {:<20} {:<16} {}{}\n", client_text(view, item.client),
                        slot_text(item.slot), body_name(view, item.body), frames_text(item),
                        what_text(item),
                        item.outlives_client || item.client == 0 ? "" : ", ends with its client");
  if (held.left_out > 0) text += fmt::format("and {} more\n", held.left_out);
  return text;
}

std::string held_json(const HeldView& view) {
  Json items = Json::array();
  for (const HeldItem& item : view.held.items) {
    Json json = {{"client", item.client == 0 ? "scene" : hex(item.client)},
                 {"you", item.client == view.me},
                 {"seq", item.seq},
                 {"slot", item.slot == 0 ? Json(nullptr) : Json(item.slot)},
                 {"body", body_name(view, item.body)},
                 {"kind", name_of<WrenchKind>(kWrenchKindNames, item.kind)},
                 {"point", vector_json(item.point_B)}};
    if (item.kind == WrenchKind::tether) {
      json["target"] = vector_json(item.target);
      json["stiffness"] = item.stiffness;
      json["damping"] = item.damping;
    } else {
      json["axes"] = name_of<Axes>(kAxesNames, item.axes);
      json["force"] = vector_json(item.force);
      json["torque"] = vector_json(item.torque);
    }
    json["first_frame"] = item.first_frame;
    json["last_frame"] = item.last_frame == kForever ? Json(nullptr) : Json(item.last_frame);
    json["start_time"] = start_time(item.first_frame, view.frame_rate);
    json["outlives_client"] = item.outlives_client;
    items.push_back(std::move(json));
  }
  return json_line({{"frame", view.held.frame},
                    {"epoch", view.held.epoch},
                    {"held", std::move(items)},
                    {"left_out", view.held.left_out}});
}

}  // namespace poinsot
