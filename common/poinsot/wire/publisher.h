// Writes plain structs of the protocol to their topic of one world. RAII: the endpoint leaves the
// bus with the object. Instantiated for the protocol's types in publisher.cpp; no Fast DDS type
// shows.

#pragma once

#include <memory>
#include <string_view>

#include "poinsot/wire/participant.h"

namespace poinsot {

template <class Message>
class Publisher {
 public:
  // Throws Error if the endpoint cannot be made. A suffix makes another topic of the same type:
  // poinsot/<world>/<topic>/<suffix>.
  Publisher(Participant& participant, std::string_view world, std::string_view suffix = {});
  ~Publisher();
  Publisher(Publisher&&) noexcept;
  Publisher& operator=(Publisher&&) noexcept;

  // False if the bus refused the sample. Never blocks for a slow or stopped reader.
  bool write(const Message& message);

  // Of a keyed topic: forgets the instance of this key; late joiners do not get it any more. Its
  // last sample should have told those who have it.
  bool forget(const Message& message);

  // Readers matched now.
  int readers() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace poinsot
