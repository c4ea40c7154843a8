// poinsot <verb>: see poinsot/cli/verbs.h.

#include "poinsot/cli/verbs.h"

int main(int argc, char** argv) {
  return poinsot::run_client(argc, argv);
}
