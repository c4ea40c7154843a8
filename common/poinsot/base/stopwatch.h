// Wall and CPU time of a piece of work, summed over its laps: the one clock below the service.
// Nothing in the physics reads it to decide; it only fills the report.

#pragma once

#include <ctime>

namespace poinsot {

struct Elapsed {
  double wall_s = 0;  // [s]
  double cpu_s = 0;   // [s] of the calling thread

  Elapsed& operator+=(const Elapsed& other) {
    wall_s += other.wall_s;
    cpu_s += other.cpu_s;
    return *this;
  }
};

class Stopwatch {
 public:
  // Adds the time between construction and destruction to a total.
  class Lap {
   public:
    explicit Lap(Elapsed& total) : total_(total), start_(now()) {}
    ~Lap() {
      const Elapsed end = now();
      total_.wall_s += end.wall_s - start_.wall_s;
      total_.cpu_s += end.cpu_s - start_.cpu_s;
    }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    Elapsed& total_;
    Elapsed start_;
  };

  // Adds wall time only: cheap enough (some 25 ns) for pieces that repeat within a frame.
  class WallLap {
   public:
    explicit WallLap(double& total_s) : total_s_(total_s), start_s_(read(CLOCK_MONOTONIC)) {}
    ~WallLap() { total_s_ += read(CLOCK_MONOTONIC) - start_s_; }
    WallLap(const WallLap&) = delete;
    WallLap& operator=(const WallLap&) = delete;

   private:
    double& total_s_;
    double start_s_;
  };

  static Elapsed now() { return {read(CLOCK_MONOTONIC), read(CLOCK_THREAD_CPUTIME_ID)}; }

 private:
  static double read(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
};

}  // namespace poinsot
