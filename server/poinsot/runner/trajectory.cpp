#include "poinsot/runner/trajectory.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <span>
#include <stdexcept>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

void append(std::string& row, double x) {
  char buffer[32];
  // The same text as printf's %.17g, whatever the locale.
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, 17).ptr;
  row.append(buffer, end);
}

void append(std::string& row, std::span<const double> numbers) {
  for (const double x : numbers) {
    row += ',';
    append(row, x);
  }
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + '"';
}

Trajectory::Trajectory(const std::filesystem::path& file, const World& world, double frame_rate)
    : name_(file.string()), file_(std::fopen(name_.c_str(), "wb")), frame_rate_(frame_rate) {
  if (!file_) throw Error("--trajectory: cannot create '" + name_ + "': " + std::strerror(errno));
  follow(world);
  rows_ = "frame,time,body,px,py,pz,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n";
  if (std::fwrite(rows_.data(), 1, rows_.size(), file_.get()) != rows_.size()) error_ = errno;
}

void Trajectory::follow(const World& world) {
  names_.resize(world.names.size());
  bodies_.resize(world.names.size());
  for (std::size_t k = 0; k < names_.size(); ++k)
    if (names_[k] != world.names[k]) {
      names_[k] = world.names[k];
      bodies_[k] = csv_field(names_[k]);
    }
}

void Trajectory::write(const World& world, std::uint64_t frame) {
  std::string start = std::to_string(frame) + ',';
  append(start, static_cast<double>(frame) / frame_rate_);
  start += ',';

  follow(world);
  rows_.clear();
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    if (world.is_absent(i)) continue;
    const Pose pose = body_pose(world, i);
    const Vec3 v = linear_velocity(world, i);
    const Vec3 omega = angular_velocity(world, i);
    rows_ += start;
    rows_ += bodies_[static_cast<std::size_t>(i)];
    append(rows_, std::span(pose.c.data(), 3));
    append(rows_, std::span(pose.q.coeffs().data(), 4));
    append(rows_, std::span(v.data(), 3));
    append(rows_, std::span(omega.data(), 3));
    rows_ += '\n';
  }
  if (std::fwrite(rows_.data(), 1, rows_.size(), file_.get()) != rows_.size() && error_ == 0)
    error_ = errno;
}

void Trajectory::close() {
  if (std::fclose(file_.release()) != 0 && error_ == 0) error_ = errno;
  if (error_ != 0)
    throw std::runtime_error("cannot write trajectory '" + name_ + "': " + std::strerror(error_));
}

}  // namespace poinsot
