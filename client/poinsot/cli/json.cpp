#include "poinsot/cli/json.h"

#include <array>
#include <charconv>
#include <cmath>

#include "poinsot/cli/json_line.h"
#include "poinsot/cli/units.h"

namespace poinsot {
namespace {

// The shortest digits that read back as the same double, always as a floating-point number.
void append(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  const std::string_view text(digits.data(), static_cast<std::size_t>(end - digits.data()));
  out += text;
  if (text.find_first_of(".e") == std::string_view::npos) out += ".0";
}

void append(std::string& out, std::string_view key, const Vec3& v) {
  out += ",\"";
  out += key;
  out += "\":[";
  for (int i = 0; i < 3; ++i) {
    if (i > 0) out += ',';
    append(out, v[i]);
  }
  out += ']';
}

void append(std::string& out, std::string_view key, const Quat& q) {
  out += ",\"";
  out += key;
  out += "\":{";
  constexpr std::string_view kNames = "xyzw";
  for (int i = 0; i < 4; ++i) {
    out += i > 0 ? ",\"" : "\"";
    out += kNames[static_cast<std::size_t>(i)];
    out += "\":";
    append(out, q.coeffs()[i]);
  }
  out += '}';
}

std::string quoted_name(const std::string& name) {
  return Json(name).dump();
}

Json code_name(ResultCode code) {
  return name_of<ResultCode>(kResultCodeNames, code);
}

}  // namespace

// Written by hand: a thousand bodies at full frame rate would keep a tree of values busy.
std::string pose_json(const PoseSnapshot& poses, const Roster& roster, double frame_rate) {
  std::string out = "{\"frame\":" + std::to_string(poses.frame) + ",\"time\":";
  append(out, end_time(poses.frame, frame_rate));
  out += ",\"bodies\":[";
  const char* separator = "";
  for (const BodyState& body : poses.bodies) {
    const std::string* const name = roster.shown(body.id);
    if (name == nullptr) continue;
    out += std::exchange(separator, ",");
    out += "{\"name\":" + quoted_name(*name);
    append(out, "position", body.position);
    append(out, "orientation", body.orientation);
    append(out, "linear_velocity", body.linear_velocity);
    append(out, "angular_velocity", body.angular_velocity);
    out += '}';
  }
  return out + (poses.complete ? "]}\n" : "],\"complete\":false}\n");
}

std::string impact_json(const ImpactNotice& impact, const std::string& a, const std::string& b) {
  const auto body = [](const ImpactedBody& from, const std::string& name) {
    return Json{{"name", name},
                {"linear_before", vector_json(from.linear_before)},
                {"angular_before", vector_json(from.angular_before)},
                {"linear_after", vector_json(from.linear_after)},
                {"angular_after", vector_json(from.angular_after)}};
  };
  return json_line({{"frame", impact.frame},
                    {"epoch", impact.epoch},
                    {"time", impact.time},
                    {"a", body(impact.a, a)},
                    {"b", body(impact.b, b)},
                    {"point", vector_json(impact.point)},
                    {"normal", vector_json(impact.normal)},
                    {"impulse", vector_json(impact.impulse)}});
}

std::string contacts_json(const ContactSnapshot& contacts, const Roster& roster,
                          double frame_rate) {
  Json list = Json::array();
  for (const ContactState& contact : contacts.contacts) {
    const std::string* const a = roster.name(contact.a);
    const std::string* const b = roster.name(contact.b);
    if (a == nullptr || b == nullptr || !(roster.shown(contact.a) || roster.shown(contact.b)))
      continue;
    list.push_back({{"a", *a},
                    {"b", *b},
                    {"point", vector_json(contact.point)},
                    {"normal", vector_json(contact.normal)},
                    {"force", vector_json(contact.force)}});
  }
  return json_line({{"frame", contacts.frame},
                    {"epoch", contacts.epoch},
                    {"time", end_time(contacts.frame, frame_rate)},
                    {"left_out", contacts.left_out},
                    {"contacts", std::move(list)}});
}

std::string push_json(const WrenchCommand& command, const Reply& reply, double frame_rate) {
  Json json = {
      {"body", command.body_name},
      {"kind",
       command.hold == Hold::clear ? "clear" : name_of<WrenchKind>(kWrenchKindNames, command.kind)},
      {"slot", command.slot == 0 ? Json(nullptr) : Json(command.slot)},
      {"code", code_name(reply.code)},
      {"message", reply.message},
      {"epoch", reply.epoch}};
  if (reply.code != ResultCode::ok) return json_line(json);
  json["first_frame"] = reply.first_frame;
  json["last_frame"] = nullptr;
  json["start_time"] = start_time(reply.first_frame, frame_rate);
  json["end_time"] = nullptr;
  if (reply.last_frame != kForever) {
    json["last_frame"] = reply.last_frame;
    json["end_time"] = end_time(reply.last_frame, frame_rate);
  }
  return json_line(json);
}

std::string control_json(std::string_view action, const Reply& reply, double frame_rate) {
  return json_line({{"action", action},
                    {"code", code_name(reply.code)},
                    {"message", reply.message},
                    {"epoch", reply.epoch},
                    {"frame", reply.last_frame},
                    {"time", end_time(reply.last_frame, frame_rate)},
                    {"state_hash", hex(reply.state_hash)}});
}

}  // namespace poinsot
