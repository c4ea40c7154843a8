// What Fast DDS 2.9 leaves in /dev/shm when a process dies, and how to tell that it did:
//
//   fastrtps_<16 hex>      a participant's segment; its owner holds a lock on fastrtps_<16 hex>_el
//   fastrtps_port<number>  a receive queue; its reader holds a lock on …_el (or a shared one on
//   …_sl);
//                          sem.fastrtps_port<number>_mutex guards opening it
//   fast_datasharing_<id>  histories of other applications (Poinsot makes none); no lock
//
// The kernel drops locks with their process. A queue of Poinsot's has a number of its own: nobody
// reads it after its reader. Queues of others are found again by whoever takes the same number, and
// those who still map one would then write into nowhere: they and the histories go only if no
// process maps them, and only where every process can be seen, in the initial process namespace.

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <ctime>
#include <dirent.h>
#include <fcntl.h>
#include <fstream>
#include <map>
#include <semaphore.h>
#include <set>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

#include "poinsot/wire/diagnosis.h"
#include "poinsot/wire/participant.h"
#include "poinsot/wire/queue_number.h"

namespace poinsot {
namespace {

constexpr std::string_view kShm = "/dev/shm/";
// A file is made before its lock is taken or its memory is mapped: younger ones are left alone.
constexpr std::time_t kMinAge = 5;  // [s]

std::string path_of(std::string_view name) {
  return std::string(kShm).append(name);
}

bool is_old(const std::string& name) {
  struct stat status {};
  return stat(path_of(name).c_str(), &status) == 0 &&
         std::time(nullptr) - std::max(status.st_ctime, status.st_mtime) >= kMinAge;
}

int remove_file(const std::string& name) {
  return unlink(path_of(name).c_str()) == 0 ? 1 : 0;
}

// A lock file seen from outside. While `free`, this object holds the lock itself.
class LockProbe {
 public:
  enum class State { absent, held, free };

  explicit LockProbe(const std::string& name)
      : file_(open(path_of(name).c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC)) {
    if (file_ < 0)
      state_ = errno == ENOENT ? State::absent : State::held;
    else
      state_ = flock(file_, LOCK_EX | LOCK_NB) == 0 ? State::free : State::held;
  }
  ~LockProbe() {
    if (file_ >= 0) close(file_);
  }
  LockProbe(const LockProbe&) = delete;
  LockProbe& operator=(const LockProbe&) = delete;

  State state() const { return state_; }

 private:
  int file_;
  State state_;
};

// Holds the semaphore that guards opening a queue, if it is free, and removes it at the end if
// told.
class QueueGuard {
 public:
  explicit QueueGuard(const std::string& queue)
      : name_("/" + queue + "_mutex"), semaphore_(sem_open(name_.c_str(), 0)) {
    held_ = semaphore_ == SEM_FAILED ? errno == ENOENT : sem_trywait(semaphore_) == 0;
  }
  ~QueueGuard() {
    if (semaphore_ == SEM_FAILED) return;
    if (held_) sem_post(semaphore_);
    sem_close(semaphore_);
  }
  QueueGuard(const QueueGuard&) = delete;
  QueueGuard& operator=(const QueueGuard&) = delete;

  bool held() const { return held_; }
  int remove() const { return sem_unlink(name_.c_str()) == 0 ? 1 : 0; }

 private:
  std::string name_;
  sem_t* semaphore_;
  bool held_;
};

std::vector<std::string> names_in(const char* directory) {
  std::vector<std::string> names;
  if (DIR* entries = opendir(directory)) {
    while (const dirent* entry = readdir(entries)) names.emplace_back(entry->d_name);
    closedir(entries);
  }
  return names;
}

bool all_processes_are_visible() {
  struct stat self {};
  constexpr ino_t kInitialNamespace = 0xEFFFFFFC;  // PROC_PID_INIT_INO of the kernel's proc_ns.h
  return stat("/proc/self/ns/pid", &self) == 0 && self.st_ino == kInitialNamespace;
}

// Names in /dev/shm that some process maps.
std::set<std::string> mapped_files() {
  std::set<std::string> mapped;
  for (const std::string& process : names_in("/proc")) {
    if (!std::isdigit(static_cast<unsigned char>(process[0]))) continue;
    std::ifstream maps("/proc/" + process + "/maps");
    for (std::string line; std::getline(maps, line);)
      if (const auto at = line.find(kShm); at != std::string::npos)
        mapped.insert(line.substr(at + kShm.size()));
  }
  return mapped;
}

bool consists_of(std::string_view text, std::string_view characters) {
  return !text.empty() && text.find_first_not_of(characters) == std::string_view::npos;
}

// `name` without the affixes, if it has them.
bool strip(std::string_view& name, std::string_view prefix, std::string_view suffix) {
  if (name.size() < prefix.size() + suffix.size() || !name.starts_with(prefix) ||
      !name.ends_with(suffix))
    return false;
  name.remove_prefix(prefix.size());
  name.remove_suffix(suffix.size());
  return true;
}

struct Leftovers {
  std::set<std::string> segments;  // without the suffix of their locks
  std::set<std::string> queues;    // without affixes of their locks and semaphores
  std::set<std::string> histories;
};

Leftovers sort_names(const std::vector<std::string>& names) {
  Leftovers found;
  for (const std::string& name : names) {
    if (name.starts_with("fast_datasharing_")) found.histories.insert(name);
    for (const std::string_view suffix : {"", "_el", "_sl"}) {
      std::string_view segment = name;
      if (strip(segment, "fastrtps_", suffix) && segment.size() == 16 &&
          consists_of(segment, "0123456789abcdef"))
        found.segments.insert("fastrtps_" + std::string(segment));
      std::string_view queue = name;
      if (strip(queue, "fastrtps_port", suffix) && consists_of(queue, "0123456789"))
        found.queues.insert("fastrtps_port" + std::string(queue));
    }
    std::string_view guarded = name;
    if (strip(guarded, "sem.fastrtps_port", "_mutex") && consists_of(guarded, "0123456789"))
      found.queues.insert("fastrtps_port" + std::string(guarded));
  }
  return found;
}

int remove_segment(const std::string& segment) {
  const LockProbe owner(segment + "_el");
  if (owner.state() == LockProbe::State::held) return 0;
  if (owner.state() == LockProbe::State::absent && !is_old(segment)) return 0;
  return remove_file(segment) + remove_file(segment + "_el");
}

int remove_queue(const std::string& queue, const QueueGuard& guard) {
  const LockProbe exclusive(queue + "_el");
  const LockProbe shared(queue + "_sl");
  if (exclusive.state() == LockProbe::State::held || shared.state() == LockProbe::State::held)
    return 0;
  if (exclusive.state() == LockProbe::State::absent && !is_old(queue)) return 0;
  return remove_file(queue) + remove_file(queue + "_el") + remove_file(queue + "_sl") +
         guard.remove();
}

bool is_own(const std::string& queue) {
  constexpr std::string_view kPrefix = "fastrtps_port";
  constexpr std::size_t kDigits = 5;
  return queue.size() == kPrefix.size() + kDigits &&
         is_own_queue(std::stoul(queue.substr(kPrefix.size())));
}

int remove_unmapped(const Leftovers& found) {
  // Nobody can open a queue between the look at all processes and its removal.
  std::map<std::string, QueueGuard> guards;
  for (const std::string& queue : found.queues)
    if (!is_own(queue)) guards.try_emplace(queue, queue);
  const std::set<std::string> mapped = mapped_files();
  int removed = 0;
  for (const auto& [queue, guard] : guards)
    if (guard.held() && !mapped.contains(queue)) removed += remove_queue(queue, guard);
  for (const std::string& history : found.histories)
    if (!mapped.contains(history) && is_old(history)) removed += remove_file(history);
  return removed;
}

}  // namespace

int remove_stale_segments() {
  const Leftovers found = sort_names(names_in("/dev/shm"));
  int removed = 0;
  for (const std::string& segment : found.segments) removed += remove_segment(segment);
  for (const std::string& queue : found.queues)
    if (is_own(queue))
      if (const QueueGuard guard(queue); guard.held()) removed += remove_queue(queue, guard);
  if (all_processes_are_visible()) removed += remove_unmapped(found);
  return removed;
}

SharedFiles shared_files() {
  const std::vector<std::string> names = names_in("/dev/shm");
  SharedFiles files;
  for (const std::string& name : names)
    files.files +=
        name.find("fastrtps_") != std::string::npos || name.starts_with("fast_datasharing_");
  for (const std::string& segment : sort_names(names).segments)
    files.stale_segments += LockProbe(segment + "_el").state() == LockProbe::State::free;
  return files;
}

}  // namespace poinsot
