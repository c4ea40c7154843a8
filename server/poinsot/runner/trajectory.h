// Trajectory: a run as a table (CSV), without loss. One row per frame, from frame 0, and body that
// is there, in the order of the scene file, static bodies included; spawned ones take the places of
// those that were removed, or follow:
//
//   frame,time,body,px,py,pz,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz
//
// time [s] is frame / frame_rate; p [m] and q are the pose of the body frame in W; v [m/s] is the
// velocity of the centre of mass, w [rad/s] the angular velocity, both in W. Numbers as printf's
// %.17g, which reads back to the same bits; names quoted by RFC 4180 where they must be.

#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "poinsot/simulation/world.h"

namespace poinsot {

// A field of a CSV file: in quotes if it holds a comma, a quote or a line break.
std::string csv_field(std::string_view text);

class Trajectory {
 public:
  // Creates the file and writes the header. Throws Error if it cannot.
  Trajectory(const std::filesystem::path& file, const World& world, double frame_rate);

  // Appends the rows of one frame. Never throws: a full disk is told by close().
  void write(const World& world, std::uint64_t frame);

  // Throws std::runtime_error if anything could not be written.
  void close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::string name_;
  std::unique_ptr<std::FILE, Closer> file_;
  double frame_rate_;  // [Hz]
  void follow(const World& world);

  std::vector<std::string> names_;   // of who was there in the last frame …
  std::vector<std::string> bodies_;  // … as fields
  std::string rows_;                 // of one frame, reused
  int error_ = 0;                    // errno of the first failure
};

}  // namespace poinsot
