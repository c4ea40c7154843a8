// A user of the client library, with no server about: it joins the bus and says so.

#include <chrono>
#include <cstdio>

#include "poinsot/client/client.h"

int main() {
  constexpr int kQuietDomain = 231;
  poinsot::Client client({.world = "nobody", .domain = kQuietDomain});
  try {
    client.wait_for_server(std::chrono::milliseconds(100));
  } catch (const poinsot::NoAnswer& none) {
    std::printf("%s\n", none.what());
    return 0;
  }
  return 1;
}
