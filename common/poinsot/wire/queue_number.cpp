#include "poinsot/wire/queue_number.h"

#include <random>
#include <string>
#include <unistd.h>

namespace poinsot {

std::uint32_t draw_queue_number() {
  std::random_device random;
  std::uniform_int_distribution<std::uint32_t> distribution(kFirstQueue, kLastQueue);
  std::uint32_t number = 0;
  do number = distribution(random);
  while (access(("/dev/shm/fastrtps_port" + std::to_string(number)).c_str(), F_OK) == 0);
  return number;
}

}  // namespace poinsot
