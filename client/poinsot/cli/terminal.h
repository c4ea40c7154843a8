// A terminal whose picture is redrawn in place, and left as it was found.

#pragma once

#include <string>
#include <vector>

#include "poinsot/cli/format.h"

namespace poinsot {

// Is the standard output a terminal that can be drawn on?
bool stdout_is_terminal();

class LiveScreen {
 public:
  LiveScreen();   // switches to the alternate screen, hides the cursor
  ~LiveScreen();  // back to the normal one, where the last picture stays
  LiveScreen(const LiveScreen&) = delete;
  LiveScreen& operator=(const LiveScreen&) = delete;

  Screen size() const;  // now: a window may be resized
  void draw(const std::vector<std::string>& lines);

 private:
  std::vector<std::string> last_;
};

}  // namespace poinsot
