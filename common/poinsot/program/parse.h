// Vectors, orientations and durations as a user writes them on a command line.

#pragma once

#include <chrono>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace poinsot {

// "x,y,z": three finite numbers, with or without spaces after the commas. Throws Error.
Eigen::Vector3d parse_vector(std::string_view text);

// "x,y,z,w" of a quaternion that is not zero; it becomes a unit one. Throws Error.
Eigen::Quaterniond parse_orientation(std::string_view text);

// "0.5s", "200ms", "50us", "7ns", "2min", "1h" or a plain number of seconds; rounded to
// nanoseconds, not negative. Throws Error.
std::chrono::nanoseconds parse_duration(std::string_view text);

}  // namespace poinsot
