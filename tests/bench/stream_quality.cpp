// How well a running daemon's poses reach another process: gaps, the error of the interval between
// frames as received and as published, and the time from publication to reception.
//
//   bench_stream_quality [--domain 77] [--world NAME] [--frames 3600]
//
// Stamps are of one machine's clock: run it on the daemon's host.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "poinsot/client/client.h"

namespace {

using namespace std::chrono_literals;

struct Options {
  int domain = 77;
  std::string world;
  std::size_t frames = 3600;
};

Options read(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view name = argv[i];
    if (name == "--domain") options.domain = std::atoi(argv[i + 1]);
    if (name == "--world") options.world = argv[i + 1];
    if (name == "--frames") options.frames = static_cast<std::size_t>(std::atoll(argv[i + 1]));
  }
  return options;
}

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

void print(const char* what, std::vector<double> values) {  // [ns]
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const auto index = static_cast<std::size_t>(share * static_cast<double>(values.size()));
    return values[std::min(index, values.size() - 1)] / 1e3;
  };
  std::printf("%-38s p50 %9.1f  p99 %9.1f  max %9.1f µs\n", what, at(0.5), at(0.99), at(1));
}

int measure(int argc, char** argv) {
  const Options options = read(argc, argv);
  poinsot::Client client({.world = options.world, .domain = options.domain});
  client.wait_for_server(5s);
  const double period = 1e9 / client.report(5s).frame_rate;  // [ns]

  std::vector<double> latency, received_error, published_error;
  poinsot::PoseSnapshot poses;
  std::uint64_t gaps = 0, missing = 0, last_frame = 0;
  std::int64_t last_received = 0, last_published = 0;
  std::size_t frames = 0;
  for (; frames < options.frames; ++frames) {
    if (!client.next_poses(poses, 5s)) break;
    const std::int64_t received = now_ns();
    latency.push_back(static_cast<double>(received - poses.publish_time_ns));
    if (frames > 0 && poses.frame == last_frame + 1) {
      received_error.push_back(std::abs(static_cast<double>(received - last_received) - period));
      published_error.push_back(
          std::abs(static_cast<double>(poses.publish_time_ns - last_published) - period));
    } else if (frames > 0) {
      ++gaps;
      missing += poses.frame - last_frame - 1;
    }
    last_frame = poses.frame;
    last_received = received;
    last_published = poses.publish_time_ns;
  }
  const poinsot::RunReport report = client.report(5s);
  std::printf(
      "frames received %zu of %zu, gaps %llu (%llu frames), late frames of the daemon %llu\n",
      frames, options.frames, static_cast<unsigned long long>(gaps),
      static_cast<unsigned long long>(missing), static_cast<unsigned long long>(report.overruns));
  print("|interval received − period|", received_error);
  print("|interval published − period|", published_error);
  print("published to received", latency);
  return frames == options.frames && gaps == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return measure(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
