// Texts for people: pure functions from what came over the bus to what is printed.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "poinsot/cli/roster.h"
#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/contact_snapshot.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

struct Screen {
  std::size_t columns = 80;
  std::size_t rows = 24;
};

// What stands above the table of poses.
struct WatchHeader {
  std::string world;
  std::string state;             // of the run, in words
  double frames_per_second = 0;  // received, by the wall clock
};

// The live table, a string per line: at most screen.rows lines of at most screen.columns
// characters. Narrow screens show fewer columns, low ones fewer bodies, and the last line says how
// many more.
std::vector<std::string> pose_table(const PoseSnapshot& poses, const Roster& roster,
                                    const WatchHeader& header, const Screen& screen);

// One line per body, for files and pipes, and the comment that names the columns.
std::string pose_lines(const PoseSnapshot& poses, const Roster& roster, double frame_rate);
inline constexpr std::string_view kPoseLinesTitle =
    "# frame time name px py pz qx qy qz qw vx vy vz wx wy wz\n";

// One line per impact, with the names of its bodies, and the comment that names the columns.
std::string impact_line(const ImpactNotice& impact, const std::string& a, const std::string& b);
inline constexpr std::string_view kImpactLinesTitle =
    "# frame time a b px py pz nx ny nz jx jy jz "
    "va_x va_y va_z va'_x va'_y va'_z vb_x vb_y vb_z vb'_x vb'_y vb'_z\n";

// One line per contact of the frame of which a body is shown, and the comment that names the
// columns.
std::string contact_lines(const ContactSnapshot& contacts, const Roster& roster, double frame_rate);
inline constexpr std::string_view kContactLinesTitle =
    "# frame time a b px py pz nx ny nz fx fy fz\n";

// The answer to a wrench that was accepted; `frame_rate` [Hz] turns frames into times.
std::string push_text(const WrenchCommand& command, const Reply& reply, double frame_rate);

// Why a command or control was refused.
std::string refusal_text(std::string_view what, const Reply& reply);

// "step: frame 12 (0.200 s), epoch 1, state hash 0123456789abcdef", with what else the daemon says.
std::string control_text(std::string_view done, const Reply& reply, double frame_rate);

std::string status_text(const std::string& world, const RunReport& report);

// A daemon and its bodies.
std::string list_text(const std::string& world, const RunReport& report,
                      const std::vector<BodyInfo>& bodies);

}  // namespace poinsot
