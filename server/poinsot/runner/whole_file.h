// Files that are there as a whole or not at all.

#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace poinsot {

// Writes beside the file, brings the bytes to the disk, and puts them in its place in one step: who
// reads, or looks after the machine has died, finds the old bytes or the new ones. Makes the
// directory if it is not there, and removes from it what dead processes left half written. Throws
// std::runtime_error that names the file.
void write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes);

// Throws Error that names the file if it cannot be read or is longer than `most` bytes. A symbolic
// link in the place of the file is not followed.
std::vector<std::byte> read_whole_file(const std::filesystem::path& file, std::size_t most);

}  // namespace poinsot
