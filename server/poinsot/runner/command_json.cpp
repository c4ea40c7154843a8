#include "poinsot/runner/command_json.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<Named<Hold>, 4> kHoldNames = {{
    {"frame", Hold::frame},
    {"duration", Hold::duration},
    {"until_cleared", Hold::until_cleared},
    {"clear", Hold::clear},
}};

// Members ---------------------------------------------------------------------------------------

template <class Visitor>
void members(Visitor& with, const WrenchCommand&) {
  using C = WrenchCommand;
  with("client", &C::client);
  with("seq", &C::seq);
  with("epoch", &C::epoch);
  with("slot", &C::slot);
  with("body", &C::body);
  with("body_name", &C::body_name);
  with("kind", &C::kind, kWrenchKindNames);
  with("force", &C::force);
  with("torque", &C::torque);
  with("axes", &C::axes, kAxesNames);
  with("point", &C::point);
  with("point_frame", &C::point_frame, kPointFrameNames);
  with("target", &C::target);
  with("stiffness", &C::stiffness);
  with("damping", &C::damping);
  with("hold", &C::hold, kHoldNames);
  with("duration_ns", &C::duration_ns);
  with("start_frame", &C::start_frame);
  with("outlives_client", &C::outlives_client);
}

template <class Visitor>
void members(Visitor& with, const RunControl&) {
  using C = RunControl;
  with("client", &C::client);
  with("seq", &C::seq);
  with("epoch", &C::epoch);
  with("action", &C::action, kControlActionNames);
  with("frames", &C::frames);
  with("scope", &C::scope);
  with("value", &C::value);
  with("timeout_ns", &C::timeout_ns);
  with("name", &C::name);
  with("on_disk", &C::on_disk);
  with("text", &C::text);
  with("body", &C::body);
  with("body_name", &C::body_name);
  with("sets_position", &C::sets_position);
  with("sets_orientation", &C::sets_orientation);
  with("sets_linear", &C::sets_linear);
  with("sets_angular", &C::sets_angular);
  with("position", &C::position);
  with("orientation", &C::orientation);
  with("linear_velocity", &C::linear_velocity);
  with("angular_velocity", &C::angular_velocity);
}

// Values -----------------------------------------------------------------------------------------

// JSON has no word for these.
constexpr std::string_view kNan = "nan", kInfinity = "inf", kMinusInfinity = "-inf";

Json value_of(double x) {
  if (std::isfinite(x)) return x;
  return std::string(std::isnan(x) ? kNan : x > 0 ? kInfinity : kMinusInfinity);
}
Json value_of(const Vec3& v) {
  return {value_of(v[0]), value_of(v[1]), value_of(v[2])};
}
Json value_of(const Quat& q) {
  return {value_of(q.x()), value_of(q.y()), value_of(q.z()), value_of(q.w())};
}
Json value_of(BodyId id) {
  return {id.slot, id.generation};
}
template <class Value>
Json value_of(const Value& value) {
  return value;
}

void get(const Json& json, bool& value) {
  if (!json.is_boolean()) throw Error("must be true or false");
  value = json.get<bool>();
}
void get(const Json& json, std::string& value) {
  if (!json.is_string()) throw Error("must be text");
  value = json.get<std::string>();
}
void get(const Json& json, double& value) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  if (json.is_number())
    value = json.get<double>();
  else if (json == kNan)
    value = std::numeric_limits<double>::quiet_NaN();
  else if (json == kInfinity || json == kMinusInfinity)
    value = json == kInfinity ? kInf : -kInf;
  else
    throw Error("must be a number");
}
template <class Whole>
requires std::is_integral_v<Whole>
void get(const Json& json, Whole& value) {
  const bool fits = json.is_number_unsigned() ? std::in_range<Whole>(json.get<std::uint64_t>())
                                              : json.is_number_integer() &&
                                                    std::in_range<Whole>(json.get<std::int64_t>());
  if (!fits) throw Error("must be a whole number that fits");
  value = json.get<Whole>();
}
void check_list(const Json& json, std::size_t size) {
  if (!json.is_array() || json.size() != size)
    throw Error("must be a list of " + std::to_string(size));
}
void get(const Json& json, Vec3& v) {
  check_list(json, 3);
  for (std::size_t k = 0; k < 3; ++k) get(json[k], v[static_cast<Eigen::Index>(k)]);
}
void get(const Json& json, Quat& q) {
  check_list(json, 4);
  for (std::size_t k = 0; k < 4; ++k) get(json[k], q.coeffs()[static_cast<Eigen::Index>(k)]);
}
void get(const Json& json, BodyId& id) {
  check_list(json, 2);
  get(json[0], id.slot);
  get(json[1], id.generation);
}

// Bit for bit: −0 is not 0, and a not-a-number is itself.
template <class Value>
bool same(const Value& a, const Value& b) {
  return a == b;
}
bool same(const double& a, const double& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}
bool same(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * 3) == 0;
}
bool same(const Quat& a, const Quat& b) {
  return std::memcmp(a.coeffs().data(), b.coeffs().data(), sizeof(double) * 4) == 0;
}

// Visitors ---------------------------------------------------------------------------------------

template <class Command>
class Writer {
 public:
  explicit Writer(const Command& command) : command_(command) { members(*this, command); }
  Json take() { return std::move(json_); }

  template <class Value>
  void operator()(const char* key, Value Command::*member) {
    const Value& value = command_.*member;
    if (!same(value, fresh_.*member)) json_[key] = value_of(value);
  }
  template <class E, std::size_t n>
  void operator()(const char* key, E Command::*member, const std::array<Named<E>, n>& names) {
    const E value = command_.*member;
    if (value == fresh_.*member) return;
    json_[key] = static_cast<unsigned>(value);  // came from outside with no meaning: was refused
    for (const Named<E>& row : names)
      if (row.value == value) json_[key] = std::string(row.name);
  }

 private:
  const Command& command_;
  const Command fresh_;
  Json json_ = Json::object();
};

template <class Command>
class Reader {
 public:
  explicit Reader(const Json& json) : json_(json) {
    if (!json.is_object()) throw Error("a command must be an object");
    members(*this, command_);
    if (read_ != json.size()) throw Error("a command has a key that is not known");
  }
  Command take() { return std::move(command_); }

  template <class Value>
  void operator()(const char* key, Value Command::*member) {
    read(key, [&](const Json& json) { get(json, command_.*member); });
  }
  template <class E, std::size_t n>
  void operator()(const char* key, E Command::*member, const std::array<Named<E>, n>& names) {
    read(key, [&](const Json& json) {
      E& value = command_.*member;
      if (json.is_string()) {
        const auto found = find_named<E>(names, json.get<std::string>());
        if (!found) throw Error("is a word that is not known");
        value = *found;
      } else {
        std::underlying_type_t<E> number = 0;
        get(json, number);
        value = static_cast<E>(number);
      }
    });
  }

 private:
  template <class Read>
  void read(const char* key, const Read& read_value) {
    const auto found = json_.find(key);
    if (found == json_.end()) return;
    ++read_;
    try {
      read_value(*found);
    } catch (const Error& error) {
      throw Error(std::string(key) + " " + error.what());
    }
  }

  const Json& json_;
  Command command_;
  std::size_t read_ = 0;
};

}  // namespace

Json to_json(const WrenchCommand& command) {
  return Writer(command).take();
}
Json to_json(const RunControl& control) {
  return Writer(control).take();
}
WrenchCommand wrench_from(const Json& json) {
  return Reader<WrenchCommand>(json).take();
}
RunControl control_from(const Json& json) {
  return Reader<RunControl>(json).take();
}

}  // namespace poinsot
