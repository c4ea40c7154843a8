#include "poinsot/cli/bodies.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "poinsot/base/error.h"
#include "poinsot/cli/control.h"
#include "poinsot/cli/send.h"
#include "poinsot/client/client.h"
#include "poinsot/math/rotation.h"

namespace poinsot {
namespace {

constexpr int kSliceMs = 100;  // longest wait before a stop is noticed

class InputFile {
 public:
  explicit InputFile(const std::string& path)
      : file_(path == "-" ? dup(STDIN_FILENO) : open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (file_ < 0) throw Error(path + ": " + std::strerror(errno));
  }
  ~InputFile() { close(file_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  int descriptor() const { return file_; }

 private:
  int file_;
};

// All of a file, or of stdin if it is "-". Throws Error, or Stopped if that comes first.
std::string read_all(const std::string& path, const std::stop_token& stop) {
  const InputFile file(path);
  std::string text;
  while (text.size() <= kMaxFragment) {
    pollfd ready{file.descriptor(), POLLIN, 0};
    while (poll(&ready, 1, kSliceMs) == 0)
      if (stop.stop_requested()) throw Stopped();
    std::array<char, 4096> part{};
    const ssize_t count = read(file.descriptor(), part.data(), part.size());
    if (count < 0) throw Error(path + ": " + std::strerror(errno));
    if (count == 0) return text;
    text.append(part.data(), static_cast<std::size_t>(count));
  }
  throw Error(path + ": more than " + std::to_string(kMaxFragment) +
              " bytes do not fit on the bus: spawn it in parts");
}

void add_body(CLI::App& app, RunControl& control) {
  app.add_option("body", control.body_name, "name of the body")->required()->type_name("BODY");
}

}  // namespace

Action declare_spawn(CLI::App& app) {
  const auto file = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  app.add_option("file", *file, "YAML with 'bodies:', as in a scene file; -: from stdin")
      ->required()
      ->type_name("FILE");
  app.add_flag("--json", *json, "print the answer as a JSON object");
  return [file, json](const Context& context) {
    RunControl control;
    control.action = ControlAction::spawn;
    control.text = read_all(*file, context.stop);
    return send(context, control, *json);
  };
}

Action declare_remove(CLI::App& app) {
  const auto options = std::make_shared<ControlOptions>();
  options->control.action = ControlAction::remove;
  add_body(app, options->control);
  app.add_flag("--json", options->json, "print the answer as a JSON object");
  return
      [options](const Context& context) { return send(context, options->control, options->json); };
}

void add_set_options(CLI::App& app, SetOptions& options) {
  RunControl& control = options.control;
  const auto tells = [](bool& flag) { return [&flag](const std::string&) { flag = true; }; };
  add_body(app, control);
  add_vector_option(app, "--position", control.position, "[m] of the body frame, in the world")
      ->each(tells(control.sets_position));
  CLI::Option* const orientation =
      add_orientation_option(app, "--orientation", control.orientation,
                             "a quaternion from body to world; it is scaled to length 1")
          ->each(tells(control.sets_orientation));
  add_vector_option(app, "--rpy", options.rpy,
                    "[rad] the same as roll, pitch and yaw: turned about x, then y, then z of the "
                    "world")
      ->each(tells(options.has_rpy))
      ->excludes(orientation);
  add_vector_option(app, "--velocity", control.linear_velocity,
                    "[m/s] of the centre of mass, in the world")
      ->each(tells(control.sets_linear));
  add_vector_option(app, "--angular-velocity", control.angular_velocity, "[rad/s] in the world")
      ->each(tells(control.sets_angular));
  app.add_flag("--json", options.json, "print the answer as a JSON object");
}

RunControl to_control(const SetOptions& options) {
  RunControl control = options.control;
  control.action = ControlAction::set_state;
  if (options.has_rpy) {
    control.sets_orientation = true;
    control.orientation = from_roll_pitch_yaw(options.rpy);
  }
  if (!control.sets_position && !control.sets_orientation && !control.sets_linear &&
      !control.sets_angular)
    throw Error(
        "nothing to set: give --position, --orientation, --rpy, --velocity or "
        "--angular-velocity");
  return control;
}

Action declare_set(CLI::App& app) {
  const auto options = std::make_shared<SetOptions>();
  add_set_options(app, *options);
  return [options](const Context& context) {
    return send(context, to_control(*options), options->json);
  };
}

}  // namespace poinsot
