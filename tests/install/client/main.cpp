// A client in a program of its own: it joins the bus, and is told in words that nobody is there.

#include <cstdio>
#include <string>

#include <poinsot/client/client.h>

int main() {
  using namespace std::chrono_literals;
  poinsot::Client client({.world = "nowhere", .domain = 99});
  try {
    client.wait_for_server(100ms);
  } catch (const poinsot::NoAnswer& error) {
    std::printf("%s\n", error.what());
    return std::string(error.what()).starts_with("no daemon found on domain 99") ||
                   std::string(error.what()).starts_with("world 'nowhere' not found")
               ? 0
               : 1;
  }
  return 1;
}
