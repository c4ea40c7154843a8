// Reads a command log (command_log.h) entry by entry.

#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "poinsot/presentation/checkpoint.h"
#include "poinsot/runner/turn_record.h"

namespace poinsot {

using LogEntry = std::variant<TurnRecord, FrameRecord>;

class CommandLogReader {
 public:
  struct Header {
    std::string build;
    std::string world;
    std::uint64_t frame = 0;  // where the log begins
    std::uint32_t epoch = 0;
    std::uint64_t hash = 0;
  };

  // Throws Error "<file>:<line>: …" if the file cannot be read or does not begin as a log.
  explicit CommandLogReader(const std::filesystem::path& file);

  const Header& header() const { return header_; }
  // Where the log begins. Throws Error if its bytes are damaged or of another build.
  std::shared_ptr<const Checkpoint> start() const;

  // The next entry, with all that it takes to repeat it: the bodies of a spawn are read, the
  // checkpoint of a restore is there. Nothing: the end, be it that of the run or a cut.
  //
  // Throws Error "<file>:<line>: …" for a whole line that is none of a log.
  std::optional<LogEntry> next();

  std::string where() const;            // "<file>:<line>" of the last line read
  bool is_cut() const { return cut_; }  // at its end: the log was not ended, or has lost its end

 private:
  bool read_line(std::string& line);
  std::optional<LogEntry> read_entry(const std::string& line);
  [[noreturn]] void fail(const std::string& what) const;
  template <class Read>
  auto checked(const Read& read) const;

  std::string name_;
  std::ifstream stream_;
  std::uint64_t line_ = 0;
  Header header_;
  std::string start_;  // base64
  std::map<std::uint64_t, std::shared_ptr<const Checkpoint>> checkpoints_;
  bool cut_ = false;
  bool ended_ = false;
};

}  // namespace poinsot
