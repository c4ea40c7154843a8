// Checkpoints as bytes, on disk or inside a command log.
//
// The bytes are those of one build of this program (base/archive.h): another build refuses them by
// name. A checksum covers all; what was cut or changed anywhere is refused and never looked into.

#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "poinsot/presentation/checkpoint.h"

namespace poinsot {

std::vector<std::byte> checkpoint_bytes(const Checkpoint& checkpoint);

// Throws Error "<source>: …" that says what is wrong.
std::shared_ptr<const Checkpoint> checkpoint_from(std::span<const std::byte> bytes,
                                                  const std::string& source);

// The same in a file, which is there as a whole or not at all. Writing throws std::runtime_error.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);
std::shared_ptr<const Checkpoint> read_checkpoint(const std::filesystem::path& file);

}  // namespace poinsot
