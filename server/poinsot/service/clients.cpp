#include "poinsot/service/clients.h"

#include <algorithm>

#include "poinsot/base/limits.h"
#include "poinsot/presentation/scene_wrenches.h"

namespace poinsot {

bool Clients::admit(std::uint64_t client, const WriterKey& writer, double cost, std::int64_t now) {
  const std::lock_guard lock(mutex_);
  Client* const known = meet(client, writer, now);
  if (known != nullptr && known->commands.take(cost, now)) return true;
  if (known != nullptr) ++known->limited;
  ++limited_;
  return false;
}

// The client, told that this writer is one of its own. None: there are too many.
Clients::Client* Clients::meet(std::uint64_t client, const WriterKey& writer, std::int64_t now) {
  if (client == kSceneClient) return nullptr;
  auto found = clients_.find(client);
  if (found != clients_.end()) {
    const auto& writers = found->second.writers;
    if (std::find(writers.begin(), writers.end(), writer) != writers.end()) return &found->second;
  }
  const auto speaks_for = clients_of_.find(writer);
  if (speaks_for != clients_of_.end() && speaks_for->second >= kClientsOfOneWriter) return nullptr;
  if (found == clients_.end()) {
    if (clients_.size() >= kKnown && !make_room()) return nullptr;
    found =
        clients_
            .emplace(
                client,
                Client{.writers = {},
                       .commands = {limits_.commands_per_second, limits_.commands_at_once, now},
                       .refusals = {limits_.refusals_per_second, limits_.refusals_at_once, now}})
            .first;
  }
  found->second.writers.push_back(writer);
  ++clients_of_[writer];
  return &found->second;
}

// Forgets the one that died first.
bool Clients::make_room() {
  auto oldest = clients_.end();
  for (auto it = clients_.begin(); it != clients_.end(); ++it)
    if (it->second.writers.empty() &&
        (oldest == clients_.end() || it->second.died < oldest->second.died))
      oldest = it;
  if (oldest == clients_.end()) return false;
  clients_.erase(oldest);
  return true;
}

bool Clients::refuse(std::uint64_t client, std::int64_t now) {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(client);
  if (found != clients_.end()) {
    ++found->second.refused;
    if (found->second.refusals.take(1, now)) return true;
  } else if (client != kSceneClient && strangers_.take(1, now)) {
    return true;
  }
  ++unanswered_;
  return false;
}

void Clients::count(std::uint64_t client, bool accepted) {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(client);
  if (found == clients_.end()) return;
  ++(accepted ? found->second.accepted : found->second.refused);
}

void Clients::lose(const WriterKey& writer, std::int64_t now, std::vector<std::uint64_t>& left) {
  const std::lock_guard lock(mutex_);
  if (clients_of_.erase(writer) == 0) return;
  for (auto& [number, client] : clients_) {
    if (std::erase(client.writers, writer) == 0 || !client.writers.empty()) continue;
    client.died = now;
    left.push_back(number);
  }
}

void Clients::report(std::int64_t now, const std::function<void(ClientStatus&)>& complete,
                     std::vector<ClientStatus>& clients) {
  clients.clear();
  const std::lock_guard lock(mutex_);
  for (auto it = clients_.begin(); it != clients_.end();) {
    const Client& client = it->second;
    ClientStatus status{.client = it->first,
                        .alive = !client.writers.empty(),
                        .accepted = client.accepted,
                        .refused = client.refused,
                        .limited = client.limited};
    complete(status);
    const bool tell = status.alive || status.held > 0;
    if (tell && clients.size() < kMaxClients) clients.push_back(status);
    it = !tell && now - client.died > kRemembered ? clients_.erase(it) : std::next(it);
  }
}

std::uint64_t Clients::limited() const {
  const std::lock_guard lock(mutex_);
  return limited_;
}

std::uint64_t Clients::unanswered() const {
  const std::lock_guard lock(mutex_);
  return unanswered_;
}

std::size_t Clients::known() const {
  const std::lock_guard lock(mutex_);
  return clients_.size();
}

}  // namespace poinsot
