// Reads plain structs of the protocol from their topic of one world, and waits for any of several.
// Messages are checked on conversion (finite numbers, sizes, known enumerators): what is malformed
// comes out as a Malformed with the reason, never as a struct.

#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "poinsot/wire/participant.h"

namespace poinsot {

// A sample that could not be converted. client and seq are zero where the type has none.
struct Malformed {
  std::uint64_t client = 0;
  std::uint64_t seq = 0;
  std::string reason;
};

// Who wrote a sample: unique among the endpoints on the bus.
using WriterKey = std::array<std::uint8_t, 16>;

template <class Message>
class Subscriber {
 public:
  // Told of each writer that left or was not heard of for its lease. Called by a thread of the bus:
  // it must be quick and not use the subscriber.
  using WriterLost = std::function<void(const WriterKey&)>;

  // Throws Error if the endpoint cannot be made. Suffix: as of Publisher.
  Subscriber(Participant& participant, std::string_view world, std::string_view suffix = {},
             WriterLost lost = {});
  ~Subscriber();
  Subscriber(Subscriber&&) noexcept;
  Subscriber& operator=(Subscriber&&) noexcept;

  // Takes the next sample into `message` (reused, so that a steady stream does not allocate).
  // Malformed samples go to `refused`, if given, and are skipped. False when there is none.
  bool take(Message& message, const std::function<void(const Malformed&)>& refused = {});
  // Of the sample taken last, malformed ones included.
  const WriterKey& writer() const;

  // Writers matched now.
  int writers() const;

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

// Waits until one of the attached subscribers has data, or until woken. The subscribers outlive it.
class Waiter {
 public:
  Waiter();
  ~Waiter();

  template <class Message>
  void attach(Subscriber<Message>& subscriber);  // before the first wait

  // True if there may be data, false on time-out. Returns at once after wake().
  bool wait(std::chrono::nanoseconds timeout);
  void wake();  // from any thread

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace poinsot
