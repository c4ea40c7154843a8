// Who saw what: the hash of every frame that reached a client, against a run that nobody disturbed.

#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace poinsot::faults {

// Hashes of frames 0 to `frames` of a shipped scene or a scene file, computed in this process: the
// physics alone, no bus.
std::vector<std::uint64_t> undisturbed_hashes(const std::string& scene, std::uint64_t frames);

// A client that notes (session, frame, hash) of all that it gets, in a thread of its own.
class Witness {
 public:
  Witness(int domain, const std::string& world, bool lan = false);
  ~Witness();

  // What has been seen of the newest session: frame → hash.
  std::map<std::uint64_t, std::uint64_t> seen() const;
  std::uint64_t session() const;  // the newest; 0: none yet
  std::uint64_t frame() const;    // the newest

 private:
  void run(const std::stop_token& stop, int domain, const std::string& world, bool lan);

  mutable std::mutex mutex_;
  std::map<std::uint64_t, std::uint64_t> seen_;
  std::uint64_t session_ = 0;
  std::uint64_t frame_ = 0;
  std::jthread thread_;
};

}  // namespace poinsot::faults
