// The file of reference poses: for each case in order, for each output from the first after the
// start, for each body, c and q (x y z w) as doubles of this machine.

#pragma once

#include <istream>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "cases.h"

namespace poinsot::bench {

using PoseRecord = Eigen::Matrix<double, 7, 1>;

inline void write_reference(std::ostream& file, const std::vector<Pose>& poses) {
  for (const Pose& pose : poses) {
    PoseRecord record;
    record << pose.c, pose.q.coeffs();
    file.write(reinterpret_cast<const char*>(record.data()), sizeof(PoseRecord));
  }
}

inline std::vector<Pose> read_reference(std::istream& file, const Case& c) {
  std::vector<Pose> poses(static_cast<std::size_t>(c.frames()) * c.bodies.size());
  for (Pose& pose : poses) {
    PoseRecord record;
    file.read(reinterpret_cast<char*>(record.data()), sizeof(PoseRecord));
    pose = {record.head<3>(), Quat(Eigen::Vector4d(record.tail<4>()))};
  }
  if (!file) throw std::runtime_error("the reference file cannot be read or is too short");
  return poses;
}

}  // namespace poinsot::bench
