#include "poinsot/wire/checks.h"
#include "poinsot/wire/convert.h"

namespace poinsot {
namespace {

void write(msg::v2::ImpactedBody& out, const ImpactedBody& in) {
  assign(out.body(), in.id);
  assign(out.linear_before(), in.linear_before);
  assign(out.angular_before(), in.angular_before);
  assign(out.linear_after(), in.linear_after);
  assign(out.angular_after(), in.angular_after);
}

ImpactedBody read(Checks& checks, const msg::v2::ImpactedBody& in) {
  const ImpactedBody body = {.id = from(in.body()),
                             .linear_before = from(in.linear_before()),
                             .angular_before = from(in.angular_before()),
                             .linear_after = from(in.linear_after()),
                             .angular_after = from(in.angular_after())};
  checks.require(static_cast<bool>(body.id), "body has no generation");
  checks.vector(body.linear_before, "linear_before");
  checks.vector(body.angular_before, "angular_before");
  checks.vector(body.linear_after, "linear_after");
  checks.vector(body.angular_after, "angular_after");
  return body;
}

}  // namespace

std::string to_message(const ImpactNotice& in, msg::v2::ImpactEvent& out) {
  out.session(in.session);
  out.epoch(in.epoch);
  out.frame_index(in.frame);
  out.sample_number(in.sequence);
  out.time(in.time);
  write(out.a(), in.a);
  write(out.b(), in.b);
  assign(out.point(), in.point);
  assign(out.normal(), in.normal);
  assign(out.impulse(), in.impulse);
  return {};
}

std::string from_message(const msg::v2::ImpactEvent& in, ImpactNotice& out) {
  Checks checks;
  out.session = in.session();
  out.epoch = in.epoch();
  out.frame = in.frame_index();
  out.sequence = in.sample_number();
  out.time = in.time();
  checks.number(out.time, "time");
  out.a = read(checks, in.a());
  out.b = read(checks, in.b());
  out.point = from(in.point());
  out.normal = from(in.normal());
  out.impulse = from(in.impulse());
  checks.vector(out.point, "point");
  checks.vector(out.normal, "normal");
  checks.require(std::abs(out.normal.squaredNorm() - 1) <= kUnitSlack, "normal is not of length 1");
  checks.vector(out.impulse, "impulse");
  return checks.take();
}

}  // namespace poinsot
