#include "poinsot/service/run_store.h"

#include <exception>
#include <utility>
#include <vector>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

constexpr std::size_t kAutosavesKept = 3;

// Of no name: the newest that can be read.
std::shared_ptr<const Checkpoint> read(const Store& store, const std::string& name) {
  if (!name.empty()) return store.load(name);
  std::vector<std::string> faults;
  if (auto checkpoint = store.load_newest(faults)) return checkpoint;
  throw Error("no checkpoint is in memory or on disk");
}

}  // namespace

std::optional<Store> open_store(const DaemonOptions& options, const std::string& world) {
  if (const std::string fault = options.record.empty() ? "" : store_name_fault(options.record);
      !fault.empty())
    throw Error("--record: " + fault);
  try {
    return Store(options.data.empty() ? Store::default_directory() : options.data, world);
  } catch (const Error&) {
    if (!options.data.empty() || !options.restore.empty() || !options.record.empty() ||
        options.autosave.count() > 0)
      throw;
    return std::nullopt;
  }
}

RunStore run_store(const Store& store, const std::string& world, Logger logger) {
  return {.write = [&store](const Checkpoint& checkpoint) { store.save(checkpoint); },
          .read = [&store](const std::string& name) { return read(store, name); },
          .log =
              [&store, world](const std::string& name, LogStart start) {
                start.file = store.log_file(name);
                start.world = world;
                return std::make_shared<CommandLogWriter>(std::move(start));
              },
          .autosave =
              [&store, logger = std::move(logger)](const Checkpoint& checkpoint) {
                try {
                  store.save(checkpoint);
                  store.prune_autosaves(kAutosavesKept);
                } catch (const std::exception& error) {
                  logger->warn("autosave_failed reason={}", poinsot::quoted(error.what()));
                }
              }};
}

std::shared_ptr<const Checkpoint> first_checkpoint(const DaemonOptions& options, const Store& store,
                                                   const Logger& logger) {
  if (options.restore.empty()) return nullptr;
  if (options.restore != kLatest) return store.load(options.restore);
  std::vector<std::string> faults;
  auto checkpoint = store.load_newest(faults);
  for (const std::string& fault : faults)
    logger->warn("checkpoint_skipped reason={}", poinsot::quoted(fault));
  if (!checkpoint)
    logger->warn("no_checkpoint directory={}: the scene begins anew",
                 poinsot::quoted(store.directory().string()));
  return checkpoint;
}

}  // namespace poinsot
