// Contacts, and what is held.

#include <algorithm>

#include "poinsot/base/limits.h"
#include "poinsot/wire/checks.h"
#include "poinsot/wire/convert.h"

namespace poinsot {

std::string to_message(const ContactSnapshot& in, msg::v1::ContactFrame& out) {
  if (in.contacts.size() > kMaxContacts)
    return "contacts: more than " + std::to_string(kMaxContacts) + " in one frame";
  out.session(in.session);
  out.epoch(in.epoch);
  out.frame_index(in.frame);
  out.sample_number(in.sequence);
  out.sim_time_ns(in.sim_time_ns);
  out.left_out(in.left_out);
  out.contacts().resize(in.contacts.size());
  for (std::size_t i = 0; i < in.contacts.size(); ++i) {
    msg::v1::ContactPoint& to = out.contacts()[i];
    assign(to.a(), in.contacts[i].a);
    assign(to.b(), in.contacts[i].b);
    assign(to.point(), in.contacts[i].point);
    assign(to.normal(), in.contacts[i].normal);
    assign(to.force(), in.contacts[i].force);
  }
  return {};
}

std::string from_message(const msg::v1::ContactFrame& in, ContactSnapshot& out) {
  if (in.contacts().size() > kMaxContacts)
    return "contacts: more than " + std::to_string(kMaxContacts) + " in one frame";
  out.session = in.session();
  out.epoch = in.epoch();
  out.frame = in.frame_index();
  out.sequence = in.sample_number();
  out.sim_time_ns = in.sim_time_ns();
  out.left_out = in.left_out();
  out.contacts.resize(in.contacts().size());
  Checks checks;
  for (std::size_t i = 0; i < out.contacts.size(); ++i) {
    const msg::v1::ContactPoint& point = in.contacts()[i];
    ContactState& contact = out.contacts[i];
    contact = {from(point.a()), from(point.b()), from(point.point()), from(point.normal()),
               from(point.force())};
    checks.require(contact.a && contact.b, "body has no generation");
    checks.vector(contact.point, "point");
    checks.vector(contact.normal, "normal");
    checks.vector(contact.force, "force");
    if (!checks.ok()) return "contacts[" + std::to_string(i) + "]: " + checks.take();
  }
  return {};
}

std::string to_message(const HeldList& in, msg::v1::HeldWrenches& out) {
  if (in.items.size() > kMaxListed)
    return "items: more than " + std::to_string(kMaxListed) + " in one list";
  out.session(in.session);
  out.epoch(in.epoch);
  out.frame_index(in.frame);
  out.sample_number(in.sequence);
  out.left_out(in.left_out);
  out.items().resize(in.items.size());
  for (std::size_t i = 0; i < in.items.size(); ++i) {
    const HeldItem& item = in.items[i];
    msg::v1::HeldWrenchItem& to = out.items()[i];
    to.client(item.client);
    to.seq(item.seq);
    to.slot(item.slot);
    assign(to.body(), item.body);
    to.kind(static_cast<msg::v1::WrenchKind>(item.kind));
    to.axes(static_cast<msg::v1::AxesKind>(item.axes));
    assign(to.force(), item.force);
    assign(to.torque(), item.torque);
    assign(to.point_of_action(), item.point_B);
    assign(to.target(), item.target);
    to.stiffness(item.stiffness);
    to.damping(item.damping);
    to.first_frame(item.first_frame);
    to.last_frame(item.last_frame);
    to.outlives_client(item.outlives_client);
  }
  return {};
}

std::string from_message(const msg::v1::HeldWrenches& in, HeldList& out) {
  if (in.items().size() > kMaxListed)
    return "items: more than " + std::to_string(kMaxListed) + " in one list";
  out.session = in.session();
  out.epoch = in.epoch();
  out.frame = in.frame_index();
  out.sequence = in.sample_number();
  out.left_out = in.left_out();
  out.items.resize(in.items().size());
  Checks checks;
  for (std::size_t i = 0; i < out.items.size(); ++i) {
    const msg::v1::HeldWrenchItem& message = in.items()[i];
    HeldItem& item = out.items[i];
    item = {.client = message.client(),
            .seq = message.seq(),
            .slot = message.slot(),
            .body = from(message.body()),
            .kind = known(checks, message.kind(), WrenchKind::tether, "kind"),
            .axes = known(checks, message.axes(), Axes::body, "axes"),
            .force = from(message.force()),
            .torque = from(message.torque()),
            .point_B = from(message.point_of_action()),
            .target = from(message.target()),
            .stiffness = message.stiffness(),
            .damping = message.damping(),
            .first_frame = message.first_frame(),
            .last_frame = message.last_frame(),
            .outlives_client = message.outlives_client()};
    checks.require(static_cast<bool>(item.body), "body has no generation");
    checks.vector(item.force, "force");
    checks.vector(item.torque, "torque");
    checks.vector(item.point_B, "point_of_action");
    checks.vector(item.target, "target");
    checks.number(item.stiffness, "stiffness");
    checks.number(item.damping, "damping");
    if (!checks.ok()) return "items[" + std::to_string(i) + "]: " + checks.take();
  }
  return {};
}

}  // namespace poinsot
