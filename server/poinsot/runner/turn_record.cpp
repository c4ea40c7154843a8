#include "poinsot/runner/turn_record.h"

#include <algorithm>
#include <span>
#include <tuple>

namespace poinsot {

void apply_turn(TurnRecord& turn, PresentationLayer& layer, std::vector<Reply>& replies) {
  layer.begin_turn();
  std::span<const WrenchCommand> left = turn.wrenches;
  const auto accept = [&](std::size_t count) {
    layer.accept(left.first(count), replies);
    left = left.subspan(count);
  };
  for (Order& order : turn.orders) {
    const RunControl& control = order.control;
    const auto first_behind = std::ranges::find_if(left, [&](const WrenchCommand& wrench) {
      return std::tuple(wrench.client, wrench.seq) >= std::tuple(control.client, control.seq);
    });
    accept(static_cast<std::size_t>(first_behind - left.begin()));
    if (control.action == ControlAction::restore && !order.checkpoint)
      order.checkpoint = layer.find_checkpoint(control.name);
    replies.push_back(layer.obey(order));
  }
  accept(left.size());
}

}  // namespace poinsot
